#pragma once

#include "core/base/result.h"
#include "core/search/methods.h"
#include "core/study/settings.h"
#include "core/track/track.h"

namespace trapwright::study {

/// Where the numbers of a search and the track's points meet.

/// What there is to choose from with these settings (paper, section 4.2.1): y and z of each point, 10 bits
/// each, section by section from the inner to the outer edge, then the length of each segment. It smooths
/// surfaces (section 3.2) on the grid of sections and points.
search::DesignSpace designSpace(const TrackSettings& settings);

/// The settings as a search takes them.
search::SearchParameters searchParameters(const EvolutionSettings& settings);

/// The search that these settings name, before its first generation.
std::unique_ptr<search::Search> makeSearch(const Settings& settings);

/// The track that a design stands for. An error if it has not as many numbers as the settings say, or if the
/// track cannot be built.
base::Result<track::Track> decodeTrack(const TrackSettings& settings, const search::Design& design);

/// The track before anything is learned: its trap flat at the lead-in's height, all segments of the mean
/// length (paper, Figure 3). An error if the settings do not give a track.
base::Result<track::Track> buildLayout(const TrackSettings& settings);

}  // namespace trapwright::study
