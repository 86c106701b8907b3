#pragma once

#include "core/drive/profile.h"

namespace trapwright::transports {

/// The QModbusDataUnit::RegisterType of a table, as a number: that type is for .cpp files only.
int registerType(drive::Table table);

}  // namespace trapwright::transports
