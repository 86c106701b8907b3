#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): that is its name
class App;
class Option;
}  // namespace CLI

namespace trapwright::app {

/// An option or an argument of a command. CLI11 is a header whose every use compiles for seconds: it stays
/// behind this, in a few files. A handle; the command line owns what it stands for.
class Option {
 public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    Option& required();
    /// A number from `least` to `most`, both included.
    Option& range(int least, int most);
    Option& range(double least, double most);
    Option& oneOf(const std::vector<std::string>& values);
    /// Only together with the other one.
    Option& needs(const Option& other);
    /// Never together with the other one.
    Option& excludes(const Option& other);
    /// So many values follow it.
    Option& values(int count);
    /// One value follows it, and it can be given again and again.
    Option& repeatable();
    /// Several values are one word, as in 4,9.
    Option& separatedBy(char character);
    /// What it takes, as --help calls it.
    Option& type(const std::string& name);
    /// The heading in --help under which it stands.
    Option& group(const std::string& heading);

 private:
    CLI::Option* option_;
};

/// A command while it gets its options.
class Command {
 public:
    explicit Command(CLI::App& command) : command_(&command) {}

    /// `name` is that of an option, as in --trials, or that of an argument. What the user gives comes to
    /// `target`, which must outlive the command line. T: std::string, int, unsigned, double, std::uint64_t,
    /// an optional of one of them, or a vector of texts, integers or numbers.
    template <typename T>
    Option addOption(const std::string& name, T& target, const std::string& description);
    Option addFlag(const std::string& name, bool& target, const std::string& description);
    /// Keeps it out of the commands that --help lists.
    void hide();

 private:
    CLI::App* command_;
};

}  // namespace trapwright::app
