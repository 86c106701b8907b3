#pragma once

#include "core/base/result.h"
#include "core/evolution/population.h"
#include "core/study/settings.h"
#include "core/track/track.h"

namespace trapwright::study {

/// Where evolution's bits and the track's points meet.

/// How long the genes of these settings are.
evolution::ChromosomeLayout chromosomeLayout(const TrackSettings& settings);

/// The settings as the transition function takes them.
evolution::GenerationParameters generationParameters(const EvolutionSettings& settings);

/// Surface smoothing (paper, section 3.2) on gene 1: decoded, smoothed on the grid of sections and points,
/// encoded.
evolution::SmoothPoints makeSmoothing(const TrackSettings& settings);

/// An error if the genes are not as long as the settings say.
base::Status checkGenes(const TrackSettings& settings, const evolution::Chromosome& chromosome);

/// The track that an individual stands for. An error if its genes are not as long as the settings say, or if
/// the track cannot be built.
base::Result<track::Track> decodeTrack(const TrackSettings& settings,
                                       const evolution::Chromosome& chromosome);

/// The track before anything is learned: its trap flat at the lead-in's height, all segments of the mean
/// length (paper, Figure 3). An error if the settings do not give a track.
base::Result<track::Track> buildLayout(const TrackSettings& settings);

}  // namespace trapwright::study
