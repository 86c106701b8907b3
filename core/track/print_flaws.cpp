#include "core/track/print_flaws.h"

#include <vector>

#include "core/track/print_solid.h"

namespace trapwright::track {

namespace {

constexpr double kLeastLoss = 10e-6;  // of a ridge's height [m]

}  // namespace

PrintFlaws findPrintFlaws(const Track& track, const geometry::PrintLimits& limits) {
    PrintFlaws flaws;
    if (track.solid.triangles.empty()) return flaws;
    PrintOptions asLearned;
    asLearned.rim = limits.thinnestWall;
    const auto printed = buildPrintSolid(track, asLearned);
    const geometry::PrintReport report =
        geometry::checkClosedForPrinting(printed ? *printed : track.solid, limits);
    for (const geometry::ThinWall& wall : report.thinWalls)
        flaws.thin += wall.area;
    for (const geometry::SharpRidge& ridge : report.ridges) {
        if (ridge.lost > kLeastLoss) flaws.ridges += ridge.length * ridge.lost;
    }
    for (const geometry::Overhang& overhang : report.overhangs)
        flaws.overhang += overhang.area;
    return flaws;
}

}  // namespace trapwright::track
