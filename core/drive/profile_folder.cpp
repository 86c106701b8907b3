#include "core/drive/profile_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/base/file.h"
#include "core/base/resources.h"

namespace trapwright::drive {

namespace {

void addFile(const std::filesystem::path& file, ProfileFolder& folder) {
    const auto text = base::readFile(file);
    if (!text) {
        folder.problems.push_back(text.error().message);
        return;
    }
    auto profile = readProfile(*text);
    if (!profile) {
        folder.problems.push_back(fmt::format("{}: {}", file.string(), profile.error().message));
    } else if (profile->name != file.stem().string()) {
        folder.problems.push_back(
            fmt::format("{}: at \"name\": \"{}\" is not the file's name without .json; "
                        "rename one of them",
                        file.string(), profile->name));
    } else {
        folder.profiles.push_back(std::move(*profile));
    }
}

void sortByTitle(std::vector<Profile>& profiles) {
    std::sort(profiles.begin(), profiles.end(), [](const Profile& a, const Profile& b) {
        return std::pair(a.title, a.name) < std::pair(b.title, b.name);
    });
}

}  // namespace

std::filesystem::path findBundledProfiles() {
    return base::findResource("drives");
}

ProfileFolder readProfileFolder(const std::filesystem::path& folder) {
    ProfileFolder result;
    std::error_code failure;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
        addFile(file, result);
    sortByTitle(result.profiles);
    return result;
}

ProfileFolder readAllProfiles(const std::filesystem::path& own) {
    ProfileFolder result = readProfileFolder(findBundledProfiles());
    ProfileFolder users = readProfileFolder(own);
    for (Profile& profile : users.profiles) {
        std::erase_if(result.profiles, [&](const Profile& other) { return other.name == profile.name; });
        result.profiles.push_back(std::move(profile));
    }
    result.problems.insert(result.problems.end(), users.problems.begin(), users.problems.end());
    sortByTitle(result.profiles);
    return result;
}

}  // namespace trapwright::drive
