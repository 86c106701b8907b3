#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/drive/profile.h"

namespace trapwright::drive {

/// What a folder of profiles holds, and what is wrong with the files that could not be read.
struct ProfileFolder {
    std::vector<Profile> profiles;      // by title
    std::vector<std::string> problems;  // each names its file
};

/// Where the profiles are that come with Trapwright (base::findResource).
std::filesystem::path findBundledProfiles();

/// Reads every *.json of a folder; nothing where there is no such folder.
ProfileFolder readProfileFolder(const std::filesystem::path& folder);

/// The bundled profiles and those of the user's own folder. Of two with one name the user's counts.
ProfileFolder readAllProfiles(const std::filesystem::path& own);

}  // namespace trapwright::drive
