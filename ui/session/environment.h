#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/drive/drive.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"
#include "core/trial/engine_registry.h"

namespace trapwright::session {

/// A virtual feeder that is served.
struct ServedFeeder {
    std::shared_ptr<void> feeder;  // ends with the last copy of this
    drive::Address address;
};

/// How the window reaches feeders; without it there are none.
struct DriveAccess {
    /// A drive that is not connected yet. Called on the thread on which it then lives.
    std::function<base::Result<std::unique_ptr<drive::Drive>>(const drive::Profile&, const drive::Address&)>
        makeDrive;
    /// Serves the virtual feeder of a profile that isVirtual. Called in the GUI thread.
    std::function<base::Result<ServedFeeder>(const drive::Profile&)> serveFeeder;
    /// The user's own profiles, beside those that come with the program.
    std::filesystem::path ownProfiles;
};

/// What the program hands to every study.
struct Environment {
    trial::EngineRegistry engines;
    std::string program;  // name and version, noted in the study's file
    /// Where a RecoveryNote is kept while a study learns; empty: none is.
    std::filesystem::path stateFolder{};
    DriveAccess drives{};
    /// The user's own materials, beside those that come with the program (part::readMaterials).
    std::filesystem::path ownMaterials{};
};

}  // namespace trapwright::session
