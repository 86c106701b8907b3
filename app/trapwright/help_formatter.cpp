#include "app/trapwright/help_formatter.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace trapwright::app {

namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kTextColumn = 32;

/// The text in lines of at most kWidth, each beginning at the column; what is to begin a line anew does.
std::string wrap(const std::string& text, std::size_t column) {
    std::string wrapped;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!wrapped.empty()) wrapped += "\n" + std::string(column, ' ');
        std::size_t at = column;
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            if (at > column && at + 1 + word.size() > kWidth) {
                wrapped += "\n" + std::string(column, ' ');
                at = column;
            }
            wrapped += (at > column ? " " : "") + word;
            at += word.size() + (at > column ? 1 : 0);
        }
    }
    return wrapped;
}

/// "  name            text", the text on a line of its own where the name is too long.
std::string entry(const std::string& name, const std::string& text) {
    std::string line = "  " + name;
    if (text.empty()) return line + "\n";
    if (line.size() + 2 > kTextColumn) line += "\n";
    line += std::string(kTextColumn - (line.back() == '\n' ? 0 : line.size()), ' ');
    return line + wrap(text, kTextColumn) + "\n";
}

/// CLI11 joins the names of a type and of what checks it: "FLOAT:FLOAT in [0.1 - 89]".
std::string typeOf(const CLI::Option& option) {
    const std::string all = option.get_type_name();
    std::string type = all.substr(0, all.find(':'));
    if (type == "INT" || type == "UINT" || type == "FLOAT") return "N";
    return type;
}

/// "0.1 to 89", where a range is checked.
std::string rangeOf(const CLI::Option& option) {
    const std::string all = option.get_type_name();
    const std::size_t begin = all.find(" in [");
    const std::size_t end = all.find(']', begin);
    if (begin == std::string::npos || end == std::string::npos) return {};
    std::string range = all.substr(begin + 5, end - begin - 5);
    const std::size_t dash = range.find(" - ");
    if (dash != std::string::npos) range.replace(dash, 3, " to ");
    return range;
}

}  // namespace

HelpFormatter::HelpFormatter() {
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    std::string help = Formatter::make_help(app, std::move(name), mode);
    // CLI11 parts its groups of options by two lines.
    for (std::size_t at = help.find("\n\n\n"); at != std::string::npos; at = help.find("\n\n\n", at))
        help.erase(at, 1);
    return help;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return wrap(app->get_description(), 0) + "\n\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* sub) const {
    const std::string text = sub->get_description();
    return entry(sub->get_name(), text.substr(0, text.find('\n')));
}

std::string HelpFormatter::make_option(const CLI::Option* opt, bool isPositional) const {
    if (isPositional) return entry(make_option_name(opt, true), make_option_desc(opt));
    std::string names;
    for (const std::string& name : opt->get_snames())
        names += (names.empty() ? "-" : ", -") + name;
    for (const std::string& name : opt->get_lnames())
        names += (names.empty() ? "--" : ", --") + name;
    return entry(names + make_option_opts(opt), make_option_desc(opt));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* opt) const {
    std::string text;
    for (int i = 0; i < opt->get_items_expected_min(); ++i)
        text += " " + typeOf(*opt);
    return text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* opt) const {
    std::string text = opt->get_description();
    if (const std::string range = rangeOf(*opt); !range.empty()) text += "; " + range;
    if (opt->get_required() && opt->nonpositional()) text += "; required";
    for (const CLI::Option* other : opt->get_needs())
        text += "; with " + other->get_name();
    for (const CLI::Option* other : opt->get_excludes())
        text += "; not with " + other->get_name();
    return text;
}

}  // namespace trapwright::app
