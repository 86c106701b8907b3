#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/search/methods.h"
#include "core/study/settings.h"
#include "core/track/track.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

/// Where the numbers of a search and the track's points meet.

/// What there is to choose from with these settings: the dimensions of their traps, one after the other
/// (core/traps). Empty if the settings give no track (findProblems tells why).
search::DesignSpace designSpace(const TrackSettings& settings);

/// Functional cross-sections as a text for settings, x from the lead-in's end: "x: y z, y z; x: ...", in mm,
/// with all digits.
std::string describeSections(std::span<const track::CrossSection> sections);
/// The sections of such a text (TrackSettings::given); empty of an empty one. An error that tells where it is
/// wrong.
base::Result<std::vector<track::CrossSection>> readSections(const std::string& text);
/// Those of a track that is there: what settings need so that other traps follow it. The box of its segments,
/// its lead-in and its feeder become the settings', too; where the settings' traps fall, all of it is raised
/// by as much as a typical one does. An error if its sections do not have equally many points.
base::Result<TrackSettings> placeBehind(const track::Track& track, TrackSettings settings);

/// How long a track of these settings can be. [m]
double calcLongestTrack(const TrackSettings& settings);

/// How much lower than the lead-in a track of these settings ends whose numbers are all in the middle of
/// their ranges, were the segment as high as needed. 0 if the settings give no track. [m]
double calcTypicalFall(const TrackSettings& settings);

/// The settings as a search takes them.
search::SearchParameters searchParameters(const EvolutionSettings& settings);

/// What the search that these settings name tells of itself.
const search::MethodInfo& describeSearch(const EvolutionSettings& settings);

/// The search that these settings name, before its first generation.
std::unique_ptr<search::Search> makeSearch(const Settings& settings);

/// The track that a design stands for. An error if it has not as many numbers as the settings say, or if the
/// track cannot be built.
base::Result<track::Track> decodeTrack(const TrackSettings& settings, const search::Design& design);
/// Any chain of traps that these settings have room for, in the place of theirs, each of the form that it has
/// there. `around`: the settings of what is before and behind them; without what is given (TrackSettings::
/// given) parts can only be put on the traps.
base::Result<track::Track> decodeChain(const TrackSettings& settings, const traps::TrapChain& traps,
                                       const search::Design& design, const TrackSettings& around);

/// The track before anything is learned: its trap flat at the lead-in's height, all segments of the mean
/// length (paper, Figure 3); of traps that fall, with all numbers in the middle of their ranges. An error if
/// the settings do not give a track.
base::Result<track::Track> buildLayout(const TrackSettings& settings);

}  // namespace trapwright::study
