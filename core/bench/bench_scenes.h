#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/part/part.h"
#include "core/study/settings.h"
#include "core/track/track.h"
#include "core/trial/batch.h"

namespace trapwright::bench {

/// A part on a track, to be timed on. The drive goes along a line, or is helical where the track is a bowl's.
struct Scene {
    std::string name;
    std::shared_ptr<const track::Track> track;
    std::shared_ptr<const part::Part> part;
    std::optional<base::Quaternion> expected;  // at the finish; none: the most frequent final orientation
    double lift = 0.0;  // of the start, where the lead-in is not the highest place around [m]
    study::SimulationSettings simulation;  // drive, friction, restitution, end conditions
};

/// All scenes: cuboid flat, cuboid rough, cuboid learned, cone learned, bracket rough, bowl (the cuboid on a
/// track that was learned in it). An error if a track file of the resources cannot be read.
base::Result<std::vector<Scene>> makeScenes();

/// Trials of the scene from random starts; the same ones every time.
trial::TrialBatch makeBatch(const Scene& scene, int trials);

}  // namespace trapwright::bench
