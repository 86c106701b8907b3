#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "app/trapwright/exit_codes.h"

namespace trapwright::app {

/// Where a command's results go: text for people on stdout, or with --json one document and nothing else.
/// Notes and errors for people go to stderr in both cases.
class Console {
 public:
    explicit Console(bool json) : json_(json) {}

    [[nodiscard]] bool json() const { return json_; }
    /// Text for people on stdout, as it is; nothing with --json.
    void print(std::string_view text) const;
    /// The command's one document; nothing without --json.
    void emit(const nlohmann::ordered_json& document) const;
    /// A line on stderr that a user should know, whatever goes to stdout.
    void note(std::string_view text) const;
    /// Says why the command failed, and gives its exit status.
    [[nodiscard]] ExitCode fail(const Failure& failure) const;
    /// False if something could not be printed, as on a full disk.
    [[nodiscard]] bool flush() const;

 private:
    bool json_;
};

}  // namespace trapwright::app
