#pragma once

#include <memory>

#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::transports {

/// Modbus over TCP, through Qt SerialBus; waits for answers in an event loop of its own.
std::unique_ptr<drive::RegisterTransport> makeTcpTransport(const std::string& host, int port, int unit);

/// Modbus RTU on a serial port, likewise.
std::unique_ptr<drive::RegisterTransport> makeRtuTransport(const std::string& line,
                                                           const drive::ModbusMap& settings, int unit);

}  // namespace trapwright::transports
