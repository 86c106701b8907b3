#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace trapwright::drive {

/// What a drive is told. The default is rest.
struct Command {
    double setPoint = 0.0;            // share of full, 0 ... 1
    std::optional<double> frequency;  // [Hz]; none leaves it as the drive has it
    bool enable = false;

    friend bool operator==(const Command&, const Command&) = default;
};

/// What a drive tells. What it does not measure is not there.
struct Reading {
    std::optional<double> setPoint;      // as the drive has it, share of full
    std::optional<double> frequency;     // [Hz]
    std::optional<double> acceleration;  // [m/s^2], peak along the vibration line
    std::optional<double> halfStroke;    // [m], measured or from acceleration and frequency
    std::optional<double> current;       // share of the rated one
    std::optional<bool> enabled;
    std::optional<std::string> fault;  // in words; none when all is well
};

/// The drive of a feeder, whatever its protocol. Lives in one thread, that of its DriveLoop: no member may be
/// called from another one. Every call returns within the profile's time-out, `connect` within three of them.
class Drive {
 public:
    Drive() = default;
    Drive(const Drive&) = delete;
    Drive& operator=(const Drive&) = delete;
    /// Disconnects.
    virtual ~Drive() = default;

    /// Reaches the drive and writes what it needs at the start, its watchdog included. Moves nothing: the
    /// first thing that it is told is rest. Error: what could not be reached, and what to check; connected()
    /// then says whether it was heard, and disconnect() tells it to rest as well as it can.
    virtual base::Status connect() = 0;
    [[nodiscard]] virtual bool connected() const = 0;

    /// One heartbeat: tells the drive all of the command again and reads back. Error: no answer in time, or
    /// one that makes no sense; then nobody knows what the drive does.
    virtual base::Result<Reading> exchange(const Command& command) = 0;

    /// Set-point zero and enable off, as well as it can be done, then the end of the connection.
    virtual void disconnect() = 0;
};

/// The half-stroke of a sinusoid of this peak acceleration: a / (2 pi f)^2. [m] from [m/s^2] and [Hz] > 0.
double calcHalfStroke(double acceleration, double frequency);
/// The peak acceleration of a sinusoid of this half-stroke. [m/s^2] from [m] and [Hz].
double calcAcceleration(double halfStroke, double frequency);

}  // namespace trapwright::drive
