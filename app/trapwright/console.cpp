#include "app/trapwright/console.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace trapwright::app {

namespace {

// Names from the file system need not be UTF-8, JSON must be.
constexpr auto kReplaceBrokenText = nlohmann::ordered_json::error_handler_t::replace;

void write(std::FILE* stream, std::string_view text) {
    // What could not be written is found out by flush().
    (void)std::fwrite(text.data(), 1, text.size(), stream);
}

}  // namespace

void Console::print(std::string_view text) const {
    if (json_) return;
    write(stdout, text);
    (void)std::fflush(stdout);
}

void Console::emit(const nlohmann::ordered_json& document) const {
    if (json_) write(stdout, document.dump(2, ' ', false, kReplaceBrokenText) + "\n");
}

void Console::note(std::string_view text) const {
    write(stderr, fmt::format("trapwright: {}\n", text));
}

ExitCode Console::fail(const Failure& failure) const {
    const int code = static_cast<int>(failure.code);
    emit({{"error", failure.message}, {"exit_code", code}});
    note(failure.message);
    return failure.code;
}

bool Console::flush() const {
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace trapwright::app
