#pragma once

#include <memory>

#include "core/verify/scenes.h"

/// Parts that have sunk onto a vertex of the track near to one of their borders.
namespace trapwright::testing {

/// The cuboid with its 8 x 12 mm face down, 12 mm along x: half-height 2 mm.
inline base::Quaternion lyingAlong() {
    base::Mat3 r;
    r.col(0) = base::Vec3::UnitZ();
    r.col(1) = base::Vec3::UnitY();
    r.col(2) = -base::Vec3::UnitX();
    return base::Quaternion(r);
}

/// The paper's cuboid, and the contact by which that vertex is to hold it.
struct SunkenScene {
    std::shared_ptr<const track::Track> track;
    base::Pose pose;
    base::Vec3 vertex;
    base::Vec3 normal;  // track -> part
    double depth;       // [m]
};

/// It lies on a valley's end, from which the track rises on the other side of its border.
inline SunkenScene makeSunkenBesideRise() {
    constexpr double kTop = 20e-3;
    constexpr double kDepth = 80e-6;
    constexpr double kInside = 30e-6;
    const auto track = verify::makeSurface({0.0, 0.09, 0.1, 0.11, 0.3}, {-0.03, -0.01, 0.0, 0.01, 0.03},
                                           [](double x, double y) {
                                               if (x == 0.1 && y == 0.0) return kTop;
                                               return x == 0.1 && y == -0.01 ? 24e-3 : 18e-3;
                                           });
    return {track,
            {lyingAlong(), {0.1, 4e-3 - kInside, kTop + 2e-3 - kDepth}},
            {0.1, 0.0, kTop},
            base::Vec3::UnitZ(),
            kDepth};
}

/// It stands on its border in a valley, over the valley's end: the crest there leaves it through one of the
/// two faces, the ridge that rises behind lies along the other. That one carries.
inline SunkenScene makeSunkenInValley() {
    constexpr double kTop = 20e-3;
    constexpr double kDepth = 100e-6;
    constexpr double kDepthOfOther = 150e-6;
    const auto track = verify::makeSurface({0.0, 0.09, 0.1, 0.11, 0.3}, {-0.03, -0.01, 0.0, 0.01, 0.03},
                                           [](double x, double y) {
                                               if (x == 0.1 && y == 0.0) return kTop;
                                               if (x == 0.1 && y == -0.01) return kTop + 2.28e-3;
                                               return x == 0.09 && y == 0.0 ? kTop + 1.2e-3 : kTop - 4e-3;
                                           });
    const base::Quaternion roll(Eigen::AngleAxisd(70.0 * base::kDegree, base::Vec3::UnitX()));
    const base::Vec3 vertex(0.1, 0.0, kTop);
    const base::Vec3 own(0.0, -4e-3 + kDepthOfOther, -2e-3 + kDepth);
    return {track, {roll * lyingAlong(), vertex - roll * own}, vertex, roll * base::Vec3::UnitZ(), kDepth};
}

}  // namespace trapwright::testing
