#pragma once

#include <memory>

#include "core/drive/deadline.h"
#include "core/drive/drive.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::drive {

/// A drive that a profile describes as places in a Modbus device. The profile must be one that readProfile
/// returned, of one of the two Modbus protocols. The clock is the one that the transport's time-outs go by.
std::unique_ptr<Drive> makeModbusDrive(const Profile& profile, std::unique_ptr<RegisterTransport> transport,
                                       Clock clock = steadyTime);

}  // namespace trapwright::drive
