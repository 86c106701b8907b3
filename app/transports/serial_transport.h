#pragma once

#include <memory>
#include <string>

#include "core/drive/transport.h"

namespace trapwright::transports {

/// Lines on a serial port of 8 data bits, no parity and 1 stop bit, through Qt SerialPort.
std::unique_ptr<drive::LineTransport> makeSerialTransport(const std::string& line, int baud);

}  // namespace trapwright::transports
