#include "app/trapwright/options.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <optional>

namespace trapwright::app {

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::range(int least, int most) {
    option_->check(CLI::Range(least, most));
    return *this;
}

Option& Option::range(double least, double most) {
    option_->check(CLI::Range(least, most));
    return *this;
}

Option& Option::oneOf(const std::vector<std::string>& values) {
    option_->check(CLI::IsMember(values));
    return *this;
}

Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option& Option::values(int count) {
    option_->expected(count);
    return *this;
}

Option& Option::repeatable() {
    option_->expected(1)->take_all();
    return *this;
}

Option& Option::separatedBy(char character) {
    option_->delimiter(character);
    return *this;
}

Option& Option::type(const std::string& name) {
    option_->type_name(name);
    return *this;
}

Option& Option::group(const std::string& heading) {
    option_->group(heading);
    return *this;
}

template <typename T>
Option Command::addOption(const std::string& name, T& target, const std::string& description) {
    return Option(*command_->add_option(name, target, description));
}

Option Command::addFlag(const std::string& name, bool& target, const std::string& description) {
    return Option(*command_->add_flag(name, target, description));
}

void Command::hide() {
    command_->group("");
}

template Option Command::addOption(const std::string&, std::string&, const std::string&);
template Option Command::addOption(const std::string&, int&, const std::string&);
template Option Command::addOption(const std::string&, unsigned&, const std::string&);
template Option Command::addOption(const std::string&, double&, const std::string&);
template Option Command::addOption(const std::string&, std::uint64_t&, const std::string&);
template Option Command::addOption(const std::string&, std::optional<std::string>&, const std::string&);
template Option Command::addOption(const std::string&, std::optional<int>&, const std::string&);
template Option Command::addOption(const std::string&, std::optional<double>&, const std::string&);
template Option Command::addOption(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option Command::addOption(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::addOption(const std::string&, std::vector<int>&, const std::string&);
template Option Command::addOption(const std::string&, std::vector<double>&, const std::string&);

}  // namespace trapwright::app
