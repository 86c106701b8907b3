#include "app/trapwright/completion.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/option_values.h"
#include "core/study/settings.h"

namespace trapwright::app {

namespace {

constexpr const char* kBashBegin =
    R"sh(# bash completion for trapwright, written by `trapwright completion bash`

_trapwright_setting()
{
    local key=${cur%%=*} values=
    if [[ $cur != *=* ]]; then
        COMPREPLY=($(compgen -S = -W '@KEYS@' -- "$cur"))
        compopt -o nospace
        return
    fi
    case $key in
@VALUES@    esac
    COMPREPLY=($(compgen -W "$values" -- "${cur#*=}"))
}

_trapwright_value()
{
    case $1 in
@KINDS@    esac
}

_trapwright()
{
    local cur prev words cword split
    _init_completion -s || return

    # The command, and how many arguments there are between it and the cursor.
    local i command= position=0 valued= options='@PROGRAM_OPTIONS@'
    for ((i = 1; i < cword; i++)); do
        case ${words[i]} in
            -*) [[ " $valued " == *" ${words[i]} "* ]] && ((i++)) ;;
            *)
                if [[ -n $command ]]; then
                    ((position++))
                    continue
                fi
                command=${words[i]}
                case $command in
@COMMANDS@                esac
                ;;
        esac
    done

    case "$command $prev" in
@OPTIONS@    esac
    [[ " $valued " == *" $prev "* ]] && return
    if [[ $cur == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$cur"))
        return
    fi
    case $command:$position in
        :*) COMPREPLY=($(compgen -W '@COMMAND_NAMES@' -- "$cur")) ;;
@ARGUMENTS@    esac
} &&
    complete -F _trapwright trapwright
)sh";

constexpr const char* kZshBegin = R"sh(#compdef trapwright
# zsh completion for trapwright, written by `trapwright completion zsh`

_trapwright_setting() {
    if ! compset -P '*='; then
        compadd -S = -- @KEYS@
        return
    fi
    case ${${IPREFIX%=}##*=} in
@VALUES@    esac
}

_trapwright() {
    local curcontext=$curcontext state line
    local -a commands=(
@COMMAND_NAMES@    )
    _arguments -C \
@PROGRAM_OPTIONS@        '1: :->command' '*:: :->rest' && return
    if [[ $state == command ]]; then
        _describe command commands
        return
    fi
    case $line[1] in
@COMMANDS@    esac
}

_trapwright "$@"
)sh";

using Texts = std::vector<std::string>;

void fill(std::string& script, const std::string& place, const std::string& text) {
    const std::string mark = "@" + place + "@";
    script.replace(script.find(mark), mark.size(), text);
}

/// In single quotes, for either shell.
std::string quote(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// The commands that --help lists.
std::vector<const CLI::App*> listCommands(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// Options if `named`, or else the arguments, in their order.
std::vector<const CLI::Option*> listOptions(const CLI::App& command, bool named) {
    return command.get_options(
        [named](const CLI::Option* option) { return option->nonpositional() == named; });
}

/// "--density" and "-h", as they are written.
Texts spellings(const CLI::Option& option) {
    Texts names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

Texts spellings(const std::vector<const CLI::Option*>& options) {
    Texts all;
    for (const CLI::Option* option : options)
        std::ranges::copy(spellings(*option), std::back_inserter(all));
    return all;
}

bool takesValue(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

std::string firstSentence(const std::string& text) {
    return text.substr(0, std::min(text.find('\n'), text.find(". ")));
}

// ---- bash ----

std::string bashPaths(const ValueKind& kind) {
    if (kind.paths == ValueKind::Paths::none) return "";
    if (kind.paths == ValueKind::Paths::folders) return "_filedir -d";
    if (kind.extensions.empty()) return "_filedir";
    return fmt::format("_filedir '@({})'", fmt::join(kind.extensions, "|"));
}

std::string bashKinds() {
    std::string cases = fmt::format("        {}) _trapwright_setting ;;\n", kSettingType);
    for (const ValueKind& kind : listValueKinds()) {
        Texts steps;
        if (!kind.names.empty())
            steps.push_back(
                fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$cur\"))", fmt::join(kind.names, " ")));
        if (kind.paths != ValueKind::Paths::none) steps.push_back(bashPaths(kind));
        cases += fmt::format("        '{}') {} ;;\n", kind.type, fmt::join(steps, "; "));
    }
    return cases;
}

std::string bashCommand(const CLI::App& command) {
    std::vector<const CLI::Option*> valued = listOptions(command, true);
    std::erase_if(valued, [](const CLI::Option* option) { return !takesValue(*option); });
    return fmt::format(
        "                    {})\n                        options='{}'\n                        valued='{}'\n"
        "                        ;;\n",
        command.get_name(), fmt::join(spellings(listOptions(command, true)), " "),
        fmt::join(spellings(valued), " "));
}

/// What is completed after an option of this command.
std::string bashOptions(const CLI::App& command) {
    std::string cases;
    for (const CLI::Option* option : listOptions(command, true)) {
        const auto type = findValueType(command, *option);
        if (!type) continue;
        for (const std::string& name : spellings(*option))
            cases += fmt::format("        '{} {}') _trapwright_value '{}'; return ;;\n", command.get_name(),
                                 name, *type);
    }
    return cases;
}

std::string bashArguments(const CLI::App& command) {
    std::string cases;
    int position = 0;
    for (const CLI::Option* argument : listOptions(command, false)) {
        const bool repeated = argument->get_items_expected_max() > 1;
        const auto type = findValueType(command, *argument);
        if (type)
            cases += fmt::format("        {}:{}) _trapwright_value '{}' ;;\n", command.get_name(),
                                 repeated ? "*" : std::to_string(position), *type);
        ++position;
    }
    return cases;
}

// ---- zsh ----

/// In a specification of _arguments a bracket ends the description, a colon a field.
std::string zshText(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

/// The action that completes a value.
std::string zshAction(const std::optional<std::string>& type) {
    if (!type) return " ";
    if (*type == kSettingType) return "_trapwright_setting";
    const std::vector<ValueKind> kinds = listValueKinds();
    const auto kind = std::ranges::find(kinds, *type, &ValueKind::type);
    if (kind == kinds.end()) return " ";
    std::string files;
    if (kind->paths == ValueKind::Paths::folders) files = "_files -/";
    if (kind->paths == ValueKind::Paths::files)
        files = kind->extensions.empty()
                    ? "_files"
                    : fmt::format("_files -g \"*.({})(-.)\"", fmt::join(kind->extensions, "|"));
    if (kind->names.empty()) return files;
    if (files.empty()) return fmt::format("({})", fmt::join(kind->names, " "));
    return fmt::format("_alternative \"names:name:({})\" \"files:file:{}\"", fmt::join(kind->names, " "),
                       kind->paths == ValueKind::Paths::folders
                           ? files
                           : fmt::format("_files -g '*.({})(-.)'", fmt::join(kind->extensions, "|")));
}

Texts zshOptions(const CLI::App& command) {
    Texts specifications;
    for (const CLI::Option* option : listOptions(command, true)) {
        const auto type = findValueType(command, *option);
        for (const std::string& name : spellings(*option)) {
            // As two words or as one, --seed 3 or --seed=3.
            const bool joined = takesValue(*option) && name.starts_with("--");
            std::string text = (type == kSettingType ? "*" : "") + name + (joined ? "=[" : "[") +
                               zshText(firstSentence(option->get_description())) + "]";
            for (int i = 0; i < option->get_items_expected_min(); ++i)
                text += ":" + zshText(type.value_or("value")) + ":" + zshAction(type);
            specifications.push_back(quote(text));
        }
    }
    return specifications;
}

std::string zshCommand(const CLI::App& command) {
    Texts specifications = zshOptions(command);
    for (const CLI::Option* argument : listOptions(command, false)) {
        const auto type = findValueType(command, *argument);
        const char* times = argument->get_items_expected_max() > 1 ? "*" : "";
        specifications.push_back(
            quote(fmt::format("{}:{}:{}", times, zshText(argument->get_name()), zshAction(type))));
    }
    return fmt::format("        {})\n            _arguments {}\n            ;;\n", command.get_name(),
                       fmt::join(specifications, " \\\n                "));
}

// ---- both ----

Texts settingKeys() {
    Texts keys;
    for (study::SettingKey& setting : study::listSettingKeys())
        keys.push_back(std::move(setting.key));
    return keys;
}

/// `line` gets a key and its values.
std::string settingValues(const char* line) {
    std::string cases;
    for (const study::SettingKey& setting : study::listSettingKeys()) {
        if (!setting.values.empty())
            cases += fmt::format(fmt::runtime(line), setting.key, fmt::join(setting.values, " "));
    }
    return cases;
}

}  // namespace

std::string writeBashCompletion(const CLI::App& program) {
    std::string kinds;
    std::string commands;
    std::string options;
    std::string arguments;
    Texts names;
    for (const CLI::App* command : listCommands(program)) {
        names.push_back(command->get_name());
        commands += bashCommand(*command);
        options += bashOptions(*command);
        arguments += bashArguments(*command);
    }
    std::string script = kBashBegin;
    fill(script, "KEYS", fmt::format("{}", fmt::join(settingKeys(), " ")));
    fill(script, "VALUES", settingValues("        {}) values='{}' ;;\n"));
    fill(script, "KINDS", bashKinds());
    fill(script, "PROGRAM_OPTIONS", fmt::format("{}", fmt::join(spellings(listOptions(program, true)), " ")));
    fill(script, "COMMANDS", commands);
    fill(script, "OPTIONS", options);
    fill(script, "COMMAND_NAMES", fmt::format("{}", fmt::join(names, " ")));
    fill(script, "ARGUMENTS", arguments);
    return script;
}

std::string writeZshCompletion(const CLI::App& program) {
    std::string names;
    std::string commands;
    for (const CLI::App* command : listCommands(program)) {
        names += "        " +
                 quote(zshText(command->get_name()) + ":" + firstSentence(command->get_description())) + "\n";
        commands += zshCommand(*command);
    }
    std::string options;
    for (const std::string& option : zshOptions(program))
        options += "        " + option + " \\\n";
    std::string script = kZshBegin;
    fill(script, "KEYS", fmt::format("{}", fmt::join(settingKeys(), " ")));
    fill(script, "VALUES", settingValues("        {}) compadd -- {} ;;\n"));
    fill(script, "COMMAND_NAMES", names);
    fill(script, "PROGRAM_OPTIONS", options);
    fill(script, "COMMANDS", commands);
    return script;
}

void addCompletionCommand(CLI::App& program, Invocation& invocation) {
    const auto shell = std::make_shared<std::string>();
    Command command =
        addCommand(program, invocation, "completion",
                   "Prints the script by which a shell completes commands, options and their values. The "
                   "packages install it.",
                   "source <(trapwright completion bash)", [shell, &program](const Console& console) {
                       const std::string script =
                           *shell == "bash" ? writeBashCompletion(program) : writeZshCompletion(program);
                       console.print(script);
                       console.emit({{"shell", *shell}, {"script", script}});
                       return ExitCode::ok;
                   });
    command.addOption("SHELL", *shell, "bash or zsh").required().oneOf({"bash", "zsh"});
    // Whoever needs it does so once; it is not among the commands of --help.
    command.hide();
}

}  // namespace trapwright::app
