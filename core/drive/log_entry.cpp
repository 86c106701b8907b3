#include "core/drive/log_entry.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/base/csv.h"

namespace trapwright::drive {

namespace {

constexpr std::array<std::pair<LogKind, std::string_view>, 7> kKinds = {{
    {LogKind::connected, "connected"},
    {LogKind::disconnected, "disconnected"},
    {LogKind::command, "command"},
    {LogKind::reading, "reading"},
    {LogKind::state, "state"},
    {LogKind::fault, "fault"},
    {LogKind::note, "note"},
}};

/// 2026-11-20T13:45:00.125Z
std::string toText(double time) {
    const std::int64_t milliseconds = std::llround(time * 1e3);
    const std::chrono::sys_seconds second{std::chrono::seconds{milliseconds / 1000}};
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(second)), milliseconds % 1000);
}

std::string toText(const std::optional<double>& value, double unit) {
    return value ? fmt::format("{:.6g}", *value / unit) : std::string();
}

std::string toText(const std::optional<bool>& value) {
    if (!value) return {};
    return *value ? "1" : "0";
}

}  // namespace

std::string_view nameOf(LogKind kind) {
    for (const auto& [known, name] : kKinds) {
        if (known == kind) return name;
    }
    return {};
}

std::optional<LogKind> findLogKind(std::string_view name) {
    for (const auto& [kind, known] : kKinds) {
        if (known == name) return kind;
    }
    return std::nullopt;
}

std::string logHeaderCsv() {
    return "number,time (UTC),kind,set-point (%),frequency (Hz),enabled,acceleration (m/s^2),"
           "half-stroke (mm),current (%),text\n";
}

std::string toCsv(const LogEntry& entry) {
    constexpr double kPercent = 0.01;
    constexpr double kMillimetre = 1e-3;
    return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", entry.number, toText(entry.time),
                       nameOf(entry.kind), toText(entry.setPoint, kPercent), toText(entry.frequency, 1.0),
                       toText(entry.enabled), toText(entry.acceleration, 1.0),
                       toText(entry.halfStroke, kMillimetre), toText(entry.current, kPercent),
                       base::csvField(entry.text));
}

std::string toCsv(std::span<const LogEntry> entries) {
    std::string text = logHeaderCsv();
    for (const LogEntry& entry : entries)
        text += toCsv(entry);
    return text;
}

}  // namespace trapwright::drive
