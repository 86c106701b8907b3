#include "core/base/resources.h"

#include <cstdlib>
#include <system_error>

namespace trapwright::base {

namespace {

/// Beside the executable: <prefix>/bin/trapwright uses <prefix>/share/trapwright/resources.
std::filesystem::path installedResources() {
    std::error_code failure;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
    if (failure) return {};
    return program.parent_path().parent_path() / "share" / "trapwright" / "resources";
}

}  // namespace

std::filesystem::path findResource(const std::filesystem::path& relative) {
    if (const char* folder = std::getenv("TRAPWRIGHT_RESOURCES"); folder != nullptr && *folder != '\0') {
        return std::filesystem::path(folder) / relative;
    }
    std::error_code failure;
    std::filesystem::path installed = installedResources() / relative;
    if (std::filesystem::exists(installed, failure)) return installed;
    return std::filesystem::path(TRAPWRIGHT_SOURCE_RESOURCES) / relative;
}

std::filesystem::path findOwnFolder(const std::filesystem::path& relative) {
    const auto read = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        return value == nullptr ? "" : value;
    };
    std::filesystem::path data = read("XDG_DATA_HOME");
    // As the base directory specification says, a relative path does not count.
    if (!data.is_absolute()) {
        const std::filesystem::path home = read("HOME");
        if (home.empty()) return {};
        data = home / ".local" / "share";
    }
    return data / "Trapwright" / "trapwright-studio" / relative;
}

}  // namespace trapwright::base
