#pragma once

#include <cstdint>
#include <vector>

#include "core/track/track.h"

namespace trapwright::scene {

/// Where the key light comes from, in the room. [unit]
base::Vec3 keyLight();

/// How much light reaches a track's surface, on a grid in track coordinates: x from the track's begin to its
/// end, y over its width. Heights are taken from above, so what lies under an overhang gets its roof's light.
struct LightMap {
    int columns = 0;                   // along x
    int rows = 0;                      // along y
    std::vector<std::uint8_t> values;  // row by row, per texel: share of the sky seen, share of the key light
};

/// Ambient occlusion by the horizon in twelve directions (Max 1988), and the key light's soft shadows.
/// Takes a few milliseconds.
LightMap calcLightMap(const track::Track& track);

}  // namespace trapwright::scene
