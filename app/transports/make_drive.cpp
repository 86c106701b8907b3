#include "app/transports/make_drive.h"

#include <fmt/format.h>

#include "app/transports/modbus_transport.h"
#include "app/transports/serial_transport.h"
#include "core/drive/modbus_drive.h"
#include "core/drive/reo_drive.h"

namespace trapwright::transports {

base::Result<std::unique_ptr<drive::Drive>> makeDrive(const drive::Profile& profile,
                                                      const drive::Address& address) {
    const drive::ModbusMap& map = profile.modbus;
    const int unit = address.unit != 0 ? address.unit : map.unit;
    if (profile.protocol == drive::Protocol::modbusTcp) {
        if (address.host.empty()) {
            return base::Error{fmt::format(
                "\"{}\" is reached over the network. Give its host name or IP address", profile.title)};
        }
        const int port = address.port != 0 ? address.port : map.port;
        return drive::makeModbusDrive(profile, makeTcpTransport(address.host, port, unit));
    }
    if (address.line.empty()) {
        return base::Error{fmt::format("\"{}\" is reached over a serial port. Give its name, as /dev/ttyUSB0",
                                       profile.title)};
    }
    if (profile.protocol == drive::Protocol::modbusRtu) {
        return drive::makeModbusDrive(profile, makeRtuTransport(address.line, map, unit));
    }
    return drive::makeReoDrive(profile, makeSerialTransport(address.line, profile.reo.baud));
}

}  // namespace trapwright::transports
