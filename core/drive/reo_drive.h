#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/drive/drive.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::drive {

/// Lines of the REO REOVIB MFS 268: three 16-bit words, each as four upper-case hexadecimal digits, and CR.
namespace reo {

using Words = std::array<std::uint16_t, 3>;

inline constexpr std::uint16_t kFullSetPoint = 0xFFFF;  // 100 %
inline constexpr std::uint16_t kFullAnswer = 0x8000;    // 100 % of acceleration and of current
inline constexpr std::string_view::size_type kLength = 13;

/// To the drive: set-point, 0, control. From the drive: acceleration, current, status.
std::string encode(const Words& words);
/// The words of a line, CR included; none where it is no such line.
std::optional<Words> decode(std::string_view line);

}  // namespace reo

/// A REO REOVIB MFS 268 on its serial interface.
std::unique_ptr<Drive> makeReoDrive(const Profile& profile, std::unique_ptr<LineTransport> transport);

}  // namespace trapwright::drive
