#include "app/trapwright/command_line.h"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/trapwright/option_values.h"
#include "app/trapwright/program.h"
#include "core/base/spelling.h"

namespace trapwright::app {

namespace {

/// Writes --help in lines that a terminal holds: options at the left with what they take, their text beside
/// them with the range that is allowed. help2man makes the manual pages from it.
class HelpFormatter : public CLI::Formatter {
 public:
    HelpFormatter();

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_subcommand(const CLI::App* sub) const override;
    std::string make_option(const CLI::Option* opt, bool isPositional) const override;
    std::string make_option_opts(const CLI::Option* opt) const override;
    std::string make_option_desc(const CLI::Option* opt) const override;
};

std::vector<std::string> listCommandNames(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command :
         program.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> listOptionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    }
    return names;
}

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

}  // namespace

void buildCommandLine(CLI::App& program, Invocation& invocation) {
    program.formatter(std::make_shared<HelpFormatter>());
    program.footer(
        std::string("`trapwright COMMAND --help` tells a command's options and shows an example.\n\n") +
        kExitCodesText);
    program.set_version_flag("--version", std::string(kProgram), "Print the version and end");
    program.set_help_flag("-h,--help", "Print this help and end");
    program.require_subcommand(1);
    program.failure_message(CLI::FailureMessage::simple);
    for (const auto add :
         {addPartCommand,   addMaterialsCommand, addNewCommand,        addSettingsCommand, addEvolveCommand,
          addSelectCommand, addValidateCommand,  addRobustnessCommand, addStreamCommand,   addPhysicalCommand,
          addMendCommand,   addExportCommand,    addReplayCommand,     addTrackCommand,    addSubmitCommand,
          addSweepCommand,  addVerifyCommand,    addBenchCommand,      addCompareCommand,  addDemoCommand,
          addDumpCommand,   addCompletionCommand}) {
        add(program, invocation);
    }
    nameValueTypes(program);
}

std::string explainParseError(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const CLI::App& command = chosen.empty() ? program : *chosen.front();
    const std::string line = program.get_name() + (chosen.empty() ? "" : " " + command.get_name());
    const std::string help = fmt::format("See {} --help.", line);
    for (const std::string& word : program.remaining(true)) {
        if (word.starts_with("--")) {
            const std::string name = word.substr(0, word.find('='));
            return fmt::format("`{}` has no option {}. {} {}", line, name,
                               base::suggestName(name, listOptionNames(command)), help);
        }
        if (chosen.empty() && !word.starts_with('-')) {
            const std::vector<std::string> names = listCommandNames(program);
            return fmt::format("There is no command \"{}\". {} The commands are {}. {}", word,
                               base::suggestName(word, names), fmt::join(names, ", "), help);
        }
    }
    if (chosen.empty() && program.remaining_size(true) == 0) {
        return fmt::format("Which command? There are {}. {}", fmt::join(listCommandNames(program), ", "),
                           help);
    }
    return fmt::format("{}. {}", error.what(), help);
}

}  // namespace trapwright::app
