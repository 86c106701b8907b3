#pragma once

#include <filesystem>
#include <string>

#include "core/work/study_engines.h"

namespace trapwright::session {

/// What the program hands to every study.
struct Environment {
    work::EngineMaker makeEngine;  // called on the threads that work
    std::string program;           // name and version, noted in the study's file
    /// Where a RecoveryNote is kept while a study learns; empty: none is.
    std::filesystem::path stateFolder{};
};

}  // namespace trapwright::session
