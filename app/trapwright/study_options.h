#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/trapwright/console.h"
#include "app/trapwright/options.h"
#include "app/trapwright/part_source.h"
#include "app/trapwright/study_access.h"
#include "core/store/study_file.h"
#include "core/study/settings.h"

namespace trapwright::app {

/// What a new study is made from.
struct CreationOptions {
    std::optional<std::string> preset;
    PartRequest part;
    std::optional<std::string> contact;       // a pair of materials
    std::optional<std::string> surface;       // of the track, for the part's material
    std::optional<std::string> settingsFile;  // JSON
    bool paper = false;
    // How the track is learned, one of them at most: --sorting, --ledges, --slots, --rails.
    std::array<bool, 4> ideas{};
    std::optional<std::string> time;  // that the user has: "10min"
    unsigned threads = 0;             // which it is for; 0: all processors
    // A study whose part, settings and tracks it begins with; instead of all of the above.
    std::optional<std::string> beginWith;
    // A track, or a study, that traps which throw out what lies wrong are learned behind.
    std::optional<std::string> behind;

    /// Whether the user gave any of them.
    [[nodiscard]] bool given() const;
};

/// What can be set of a new study and, as far as its file allows, of an old one.
struct SettingOptions {
    std::vector<std::string> assignments;  // "track.segmentWidth_mm=50"
    std::optional<int> generations;
    std::optional<int> population;
    std::optional<int> trials;
    std::optional<std::uint64_t> seed;
    std::optional<std::string> engine;

    /// Whether the user gave any of them.
    [[nodiscard]] bool given() const;
};

void addCreationOptions(Command command, CreationOptions& options);
void addSettingOptions(Command command, SettingOptions& options);

/// The settings with what the user set. An unknown engine is a failure; ranges are not looked at.
Attempt<study::Settings> applySettings(study::Settings settings, const SettingOptions& options);

/// Keeps what the user set in a study that is open for writing. Learned generations allow only some changes.
/// True if anything changed.
Attempt<bool> changeSettings(OpenStudy& study, const SettingOptions& options);

/// Makes the study file: preset, then `paper`, the settings file, the part, what is asked of
/// `ideas` or proposed for `time`, the single settings. Refuses settings that cannot be used, and a part that
/// does not fit the track.
Attempt<store::StudyFile> createStudy(const std::string& path, const CreationOptions& creation,
                                      const SettingOptions& settings, const Console& console);

}  // namespace trapwright::app
