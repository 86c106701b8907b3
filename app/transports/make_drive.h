#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/drive/drive.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::transports {

/// The drive of this profile at this address, with the transport of its protocol; not connected yet. To be
/// called on the thread on which the drive then lives. Error: the address lacks what the protocol needs.
base::Result<std::unique_ptr<drive::Drive>> makeDrive(const drive::Profile& profile,
                                                      const drive::Address& address);

}  // namespace trapwright::transports
