#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace trapwright::app {

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

}  // namespace trapwright::app
