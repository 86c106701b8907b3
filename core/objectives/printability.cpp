#include "core/objectives/printability.h"

#include "core/track/print_flaws.h"

namespace trapwright::objectives {

namespace {

constexpr double kSquareMillimetre = 1e-6;  // [m^2]

Measured measurePrintability(const Evaluation& evaluation) {
    // Without ridges, of which a track drawn at random has twenty times as much as of all else: they would
    // outweigh everything (decisions.md#printability).
    const track::PrintFlaws flaws = track::findPrintFlaws(*evaluation.track);
    return {-(flaws.thin + flaws.overhang) / kSquareMillimetre};
}

}  // namespace

Objective printability() {
    Objective objective;
    objective.key = objective.symbol = "F_P";
    objective.name = "Printability";
    objective.unit = "mm²";
    objective.help =
        "Minus the area that a printer cannot make: walls thinner than 1.2 mm, overhangs of more than 45 "
        "degrees. 0 is perfect.";
    objective.decimals = 1;
    objective.isNoisy = false;
    objective.isDetail = true;
    // It costs milliseconds for each track: only where it counts in F.
    objective.applies = [](const Evaluation&) { return false; };
    objective.measure = &measurePrintability;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

}  // namespace trapwright::objectives
