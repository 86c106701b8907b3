#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/trapwright/options.h"
#include "app/trapwright/part_source.h"
#include "core/study/settings.h"
#include "core/track/track.h"

namespace trapwright::app {

/// A track that is of no study, and what a part meets on it.
struct TrackRequest {
    TrackRequest() { part.part = "cuboid"; }

    std::string file;
    PartRequest part;
    std::uint64_t seed = 1;
    double halfStroke = 0.8;  // [mm]
    std::optional<double> friction;
    std::optional<double> restitution;
    double tolerance = 25.0;  // [deg]
};

struct LoadedTrack {
    std::shared_ptr<const track::Track> track;
    std::optional<base::Quaternion> expected;  // the orientation that the file expects
    std::shared_ptr<const part::Part> part;
    study::Settings settings;  // that trials on it go by
};

/// Adds --part and all of addPartOptions(), --seed, --half-stroke, --friction, --restitution and --tolerance.
void addTrackOptions(Command command, TrackRequest& request);

/// Reads the file and builds the part.
Attempt<LoadedTrack> loadTrack(const TrackRequest& request, const Console& console);

}  // namespace trapwright::app
