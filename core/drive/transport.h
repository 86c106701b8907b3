#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/drive/profile.h"

namespace trapwright::drive {

/// Where a drive is reached: what the operator types, beside the profile.
struct Address {
    std::string host;  // of Modbus TCP: a name or an IP address
    int port = 0;      // of Modbus TCP; 0: the profile's
    std::string line;  // of Modbus RTU and REO: the serial port, "/dev/ttyUSB0"
    int unit = 0;      // of Modbus; 0: the profile's
};

/// Speaks Modbus to one device. All calls from one thread, each back within its time-out [s].
class RegisterTransport {
 public:
    RegisterTransport() = default;
    RegisterTransport(const RegisterTransport&) = delete;
    RegisterTransport& operator=(const RegisterTransport&) = delete;
    virtual ~RegisterTransport() = default;

    virtual base::Status open(double timeOut) = 0;
    [[nodiscard]] virtual bool isOpen() const = 0;
    /// `count` registers or coils from `address` on. Error: no answer in time, an exception of the device, or
    /// an answer to another question.
    virtual base::Result<std::vector<std::uint16_t>> read(Table table, int address, int count,
                                                          double timeOut) = 0;
    /// Writes coils or holding registers. Errors as above.
    virtual base::Status write(Table table, int address, std::span<const std::uint16_t> values,
                               double timeOut) = 0;
    virtual void close() = 0;
};

/// Speaks lines to one device. All calls from one thread, each back within its time-out [s].
class LineTransport {
 public:
    LineTransport() = default;
    LineTransport(const LineTransport&) = delete;
    LineTransport& operator=(const LineTransport&) = delete;
    virtual ~LineTransport() = default;

    virtual base::Status open(double timeOut) = 0;
    [[nodiscard]] virtual bool isOpen() const = 0;
    /// Drops what came unasked, sends the line and returns the next one, both with the CR that ends them.
    /// Error: no whole line in time, or the port is gone.
    virtual base::Result<std::string> exchange(std::string_view line, double timeOut) = 0;
    virtual void close() = 0;
};

}  // namespace trapwright::drive
