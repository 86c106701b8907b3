#include "core/drive/modbus_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/drive/deadline.h"
#include "core/drive/register_value.h"

namespace trapwright::drive {

namespace {

class ModbusDrive final : public Drive {
 public:
    ModbusDrive(const Profile& profile, std::unique_ptr<RegisterTransport> transport, Clock clock)
        : profile_(profile),
          map_(profile_.modbus),
          transport_(std::move(transport)),
          clock_(std::move(clock)) {}
    ModbusDrive(const ModbusDrive&) = delete;
    ModbusDrive& operator=(const ModbusDrive&) = delete;
    ~ModbusDrive() override { rest(); }

    base::Status connect() override {
        if (auto status = transport_->open(profile_.timeOut); !status) return status;
        const Deadline deadline(2.0 * profile_.timeOut, clock_);
        auto status = writeAll(map_.atConnect, deadline);
        if (status) status = tell(Command{}, deadline);
        return status;
    }

    [[nodiscard]] bool connected() const override { return transport_->isOpen(); }

    base::Result<Reading> exchange(const Command& command) override {
        const Deadline deadline(profile_.timeOut, clock_);
        if (auto status = tell(command, deadline); !status) return status.error();
        return readBack(deadline);
    }

    void disconnect() override { rest(); }

 private:
    // Each write is tried, whatever became of the one before.
    void rest() {
        if (!transport_->isOpen()) return;
        const Deadline deadline(profile_.timeOut, clock_);
        static_cast<void>(switchEnable(false, deadline.left() / 2.0));
        static_cast<void>(writeSetPoint(0.0, deadline.left()));
        static_cast<void>(writeAll(map_.atDisconnect, deadline));
        transport_->close();
    }

    base::Status tell(const Command& command, const Deadline& deadline) {
        if (auto status = writeAll(map_.atHeartbeat, deadline); !status) return status;
        // Off comes first and on comes last, so that nothing moves on an old set-point.
        if (!command.enable) {
            if (auto status = switchEnable(false, deadline.left()); !status) return status;
            return writeSetPoint(0.0, deadline.left());
        }
        if (command.frequency && map_.frequency) {
            if (auto status = write(*map_.frequency, *command.frequency, deadline.left()); !status)
                return status;
        }
        if (auto status = writeSetPoint(command.setPoint, deadline.left()); !status) return status;
        const bool on = map_.setPoint || command.setPoint > 0.0;
        if (auto status = switchEnable(on, deadline.left()); !status) return status;
        return on ? writeAll(map_.whileEnabled, deadline) : base::success();
    }

    base::Result<Reading> readBack(const Deadline& deadline) {
        Reading reading;
        const auto problem = [&]() -> std::optional<base::Error> {
            const auto& setPoint = map_.setPointReadBack ? map_.setPointReadBack : map_.setPoint;
            if (auto error = read(setPoint, reading.setPoint, deadline)) return error;
            const auto& frequency = map_.frequencyReadBack ? map_.frequencyReadBack : map_.frequency;
            if (auto error = read(frequency, reading.frequency, deadline)) return error;
            if (auto error = read(map_.acceleration, reading.acceleration, deadline)) return error;
            if (auto error = read(map_.current, reading.current, deadline)) return error;
            if (auto error = readEnabled(reading, deadline)) return error;
            return readFault(reading, deadline);
        }();
        if (problem) return *problem;
        if (!reading.frequency) reading.frequency = profile_.frequency;
        if (reading.acceleration && reading.frequency && *reading.frequency > 0.0) {
            reading.halfStroke = calcHalfStroke(*reading.acceleration, *reading.frequency);
        }
        return reading;
    }

    std::optional<base::Error> read(const std::optional<Quantity>& quantity, std::optional<double>& value,
                                    const Deadline& deadline) {
        if (!quantity) return std::nullopt;
        const auto raw = readRaw(quantity->place, deadline);
        if (!raw) return raw.error();
        value = fromRaw(*quantity, *raw);
        if (std::isfinite(*value)) return std::nullopt;
        return describeNoNumber(quantity->place);
    }

    static base::Error describeNoNumber(const Place& place) {
        return base::Error{
            fmt::format("the drive tells no number in {} {}", nameOf(place.table), place.address)};
    }

    std::optional<base::Error> readEnabled(Reading& reading, const Deadline& deadline) {
        const auto& enable = map_.enableReadBack ? map_.enableReadBack : map_.enable;
        if (!enable) return std::nullopt;
        const auto bits = readBits(enable->place, deadline);
        if (!bits) return bits.error();
        reading.enabled = (*bits & enable->mask) == (enable->on & enable->mask);
        return std::nullopt;
    }

    std::optional<base::Error> readFault(Reading& reading, const Deadline& deadline) {
        if (!map_.fault) return std::nullopt;
        const auto bits = readBits(map_.fault->place, deadline);
        if (!bits) return bits.error();
        reading.fault = map_.fault->code.findFault(*bits);
        return std::nullopt;
    }

    base::Result<unsigned> readBits(const Place& place, const Deadline& deadline) {
        const auto raw = readRaw(place, deadline);
        if (!raw) return raw.error();
        const auto bits = toBits(*raw);
        if (!bits) return describeNoNumber(place);
        return *bits;
    }

    base::Result<double> readRaw(const Place& place, const Deadline& deadline) {
        const auto registers = transport_->read(place.table, place.address, place.count(), deadline.left());
        if (!registers) return registers.error();
        return decodeRaw(place, *registers);
    }

    base::Status write(const Quantity& quantity, double value, double timeOut) {
        return writeRaw(quantity.place, toRaw(quantity, value), timeOut);
    }

    base::Status writeRaw(const Place& place, double raw, double timeOut) {
        return transport_->write(place.table, place.address, encodeRaw(place, raw), timeOut);
    }

    base::Status writeSetPoint(double setPoint, double timeOut) {
        if (!map_.setPoint) return base::success();
        return write(*map_.setPoint, std::clamp(setPoint, 0.0, 1.0), timeOut);
    }

    base::Status switchEnable(bool on, double timeOut) {
        if (!map_.enable) return base::success();
        return writeRaw(map_.enable->place, on ? map_.enable->on : map_.enable->off, timeOut);
    }

    base::Status writeAll(const std::vector<Write>& writes, const Deadline& deadline) {
        for (const Write& item : writes) {
            auto status = writeRaw(item.place, item.value, deadline.left());
            if (!status && !item.mayFail) return status;
        }
        return base::success();
    }

    const Profile profile_;
    const ModbusMap& map_;
    std::unique_ptr<RegisterTransport> transport_;
    const Clock clock_;
};

}  // namespace

std::unique_ptr<Drive> makeModbusDrive(const Profile& profile, std::unique_ptr<RegisterTransport> transport,
                                       Clock clock) {
    return std::make_unique<ModbusDrive>(profile, std::move(transport), std::move(clock));
}

}  // namespace trapwright::drive
