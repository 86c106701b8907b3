#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/search/design_space.h"
#include "core/track/track_builder.h"

namespace trapwright::traps {

/// How a free-form point's y value becomes a place across the track (decisions.md#surface-points).
enum class PointEncoding {
    strip,  // point j keeps within its own strip of width / points, so a section never crosses itself
    free    // the paper's: any place in the box, so a surface may overhang or cross itself
};

/// The room that a trap has, and how finely it is shaped (decisions.md#surface-points and what follows). Each
/// kind takes what it needs.
struct TrapParameters : track::TrackParameters {
    int crossSections = 5;  // functional ones of a free-form trap
    int pointsPerSection = 8;
    double minSegmentLength = 15e-3;  // [m]
    PointEncoding encoding = PointEncoding::strip;
};

/// An error that names the first parameter that is out of its range, the track's own among them.
base::Status checkParameters(const TrapParameters& parameters);

/// One kind of trap: what there is to choose, and the surface that a choice stands for. Knows no physics.
struct TrapKind {
    std::string_view key;    // in files and on the command line: "free-form"
    std::string_view title;  // "Free form"
    std::string_view help;   // a sentence

    /// What there is to choose, in the order in which the numbers come.
    std::vector<search::Dimension> (*dimensions)(const TrapParameters& parameters);
    /// The functional cross-sections of these numbers (as many as dimensions, in [0, 1]); x is measured from
    /// where the trap begins and rises, y within half a segment's width to either side, z in [0,
    /// segmentHeight], each section has `pointsPerSection` points. `before`: the last section of what comes
    /// before, of the lead-in or a trap.
    std::vector<track::CrossSection> (*build)(const TrapParameters& parameters,
                                              const track::CrossSection& before,
                                              std::span<const double> numbers);
    /// Where the cross-sections of a typical one are: x from where the trap begins. [m]
    std::vector<double> (*layOut)(const TrapParameters& parameters);
    /// The longest that it can be. [m]
    double (*longest)(const TrapParameters& parameters);
    /// Smoothing of its numbers with a probability for each thing that can be smoothed
    /// (search::SmoothDesign); null: there is nothing to be smoothed.
    std::vector<double> (*smooth)(const TrapParameters& parameters, std::span<const double> numbers,
                                  double probability, base::Random& random) = nullptr;
    /// Behind it parts lie in the groove of groove.h, so that what it does with them can be told by itself.
    bool endsInGroove = false;
    /// It shapes a spiral's ledge beside its wall: it has that form before anything is chosen, and parts come
    /// to it and leave it along the wall.
    bool isLedge = false;
    /// Points a section of which its form can be made.
    int leastPoints = 2;
    /// Nothing can follow it: it goes on to the track's end, as the lead-out does.
    bool isLast = false;
};

/// The kinds that there are. A new one is its own file and its entry in trap_chain.cpp.
std::span<const TrapKind> trapKinds();

}  // namespace trapwright::traps
