#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace trapwright::app {

/// What an option or an argument takes, as --help calls it and as a shell completes it.
struct ValueKind {
    enum class Paths { none, files, folders };

    std::string type;                       // "ENGINE"
    std::vector<std::string> names{};       // that can be given
    Paths paths = Paths::none;              // whether a path can be given
    std::vector<std::string> extensions{};  // of its files, without the dot; none for every file
};

/// All kinds that know names or paths.
std::vector<ValueKind> listValueKinds();

/// The type of the kind that an option of this command takes, or that of its argument. Empty where it is a
/// number, a text or nothing.
std::optional<std::string> findValueType(const CLI::App& command, const CLI::Option& option);

/// The type of settings, KEY=VALUE (see study::listSettingKeys).
inline constexpr const char* kSettingType = "KEY=VALUE";

/// Calls the values of all commands' options by the types of their kinds.
void nameValueTypes(CLI::App& program);

}  // namespace trapwright::app
