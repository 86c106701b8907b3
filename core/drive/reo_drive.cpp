#include "core/drive/reo_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trapwright::drive {

namespace {

/// What came instead of words, without what a terminal would act on.
std::string quote(const std::string& line) {
    std::string text;
    for (const char c : line.substr(0, 40))
        text += c >= ' ' && c <= '~' ? c : '?';
    return text;
}

class ReoDrive final : public Drive {
 public:
    ReoDrive(const Profile& profile, std::unique_ptr<LineTransport> transport)
        : profile_(profile), transport_(std::move(transport)) {}
    ReoDrive(const ReoDrive&) = delete;
    ReoDrive& operator=(const ReoDrive&) = delete;
    ~ReoDrive() override { rest(); }

    base::Status connect() override {
        if (auto status = transport_->open(profile_.timeOut); !status) return status;
        const auto answer = exchange(Command{});
        return answer ? base::success() : base::Status(answer.error());
    }

    [[nodiscard]] bool connected() const override { return transport_->isOpen(); }

    base::Result<Reading> exchange(const Command& command) override {
        const double share = command.enable ? std::clamp(command.setPoint, 0.0, 1.0) : 0.0;
        const auto setPoint = static_cast<std::uint16_t>(std::lround(share * reo::kFullSetPoint));
        const auto control = static_cast<std::uint16_t>(command.enable ? profile_.reo.enable : 0U);
        const auto line = transport_->exchange(reo::encode({setPoint, 0, control}), profile_.timeOut);
        if (!line) return line.error();
        const auto words = reo::decode(*line);
        if (!words) {
            return base::Error{fmt::format(
                "the drive answered \"{}\", not twelve hexadecimal digits. Check the baud rate and that "
                "it is a REOVIB with its serial interface switched on (menu C 017, S.I.F. = 1)",
                quote(*line))};
        }
        return toReading(*words);
    }

    void disconnect() override { rest(); }

 private:
    void rest() {
        if (!transport_->isOpen()) return;
        static_cast<void>(exchange(Command{}));
        transport_->close();
    }

    [[nodiscard]] Reading toReading(const reo::Words& words) const {
        const auto share = [](std::uint16_t word) { return static_cast<double>(word) / reo::kFullAnswer; };
        const ReoMap& map = profile_.reo;
        Reading reading;
        reading.frequency = profile_.frequency;
        reading.current = share(words[1]);
        if (map.fullAcceleration) reading.acceleration = share(words[0]) * *map.fullAcceleration;
        if (reading.acceleration && reading.frequency && *reading.frequency > 0.0) {
            reading.halfStroke = calcHalfStroke(*reading.acceleration, *reading.frequency);
        }
        if (map.enabled != 0) reading.enabled = (words[2] & map.enabled) != 0;
        reading.fault = map.code.findFault(words[2]);
        return reading;
    }

    const Profile profile_;
    std::unique_ptr<LineTransport> transport_;
};

}  // namespace

namespace reo {

std::string encode(const Words& words) {
    return fmt::format("{:04X}{:04X}{:04X}\r", words[0], words[1], words[2]);
}

std::optional<Words> decode(std::string_view line) {
    if (line.size() != kLength || line.back() != '\r') return std::nullopt;
    Words words{};
    for (std::size_t i = 0; i + 1 < kLength; ++i) {
        // Lower-case digits are not permitted.
        constexpr std::string_view kDigits = "0123456789ABCDEF";
        const auto digit = kDigits.find(line[i]);
        if (digit == std::string_view::npos) return std::nullopt;
        words[i / 4] = static_cast<std::uint16_t>(words[i / 4] * 16U + digit);
    }
    return words;
}

}  // namespace reo

std::unique_ptr<Drive> makeReoDrive(const Profile& profile, std::unique_ptr<LineTransport> transport) {
    return std::make_unique<ReoDrive>(profile, std::move(transport));
}

}  // namespace trapwright::drive
