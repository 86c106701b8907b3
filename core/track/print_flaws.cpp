#include "core/track/print_flaws.h"

namespace trapwright::track {

PrintFlaws findPrintFlaws(const Track& track, const geometry::PrintLimits& limits) {
    PrintFlaws flaws;
    if (track.solid.triangles.empty()) return flaws;
    for (const geometry::ThinWall& wall : geometry::findThinWalls(track.solid, limits))
        flaws.thin += wall.area;
    for (const geometry::Overhang& overhang : geometry::findOverhangs(track.solid, limits))
        flaws.overhang += overhang.area;
    return flaws;
}

}  // namespace trapwright::track
