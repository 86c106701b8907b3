#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/part/part.h"
#include "core/stats/binomial.h"
#include "core/track/track.h"
#include "core/trial/conditions.h"
#include "core/trial/goal.h"
#include "core/trial/orientations.h"
#include "core/trial/outcome.h"
#include "core/trial/returns.h"

namespace trapwright::objectives {

/// What is judged: a track and the trials on it.
struct Evaluation {
    const track::Track* track = nullptr;
    const part::SymmetryGroup* symmetry = nullptr;  // of the part
    int overlaps = 0;                               // triangles of the surface that overlap another
    std::span<const trial::Outcome> outcomes{};     // empty: the track was not simulated
    trial::OrientationDistance distance = trial::OrientationDistance::symmetric;  // that F_O measures with
    double tolerance = 0.0;                                                       // of success [rad]
    /// How parts shall end. None: nothing is wanted, so that the mode of those that finished counts
    /// (decisions.md#selection-and-success).
    std::optional<trial::Goal> wanted{};
    /// How many ended so, where that is known already. None: counted when it is needed.
    std::optional<int> oriented{};
    /// Where these trials are in the operating box; empty: they are all alike.
    std::span<const trial::BoxPlace> places{};
    /// Of trials in its corners that are not among these, where there are any.
    std::optional<stats::Count> corners{};
    /// Parts of streams that left the track as wanted, of those that came to it. None: no stream was sent.
    std::optional<stats::Count> streams{};
    trial::Returns returns = trial::Returns::nowhere;  // where parts that fall off come again
    bool isVaried = false;                             // trials are, or would be, all over an operating box
    bool hasCorners = false;                           // and some of them in its corners
};

/// What there is to attain.
struct Task {
    const part::SymmetryGroup* symmetry = nullptr;                                // of the part
    trial::OrientationDistance distance = trial::OrientationDistance::symmetric;  // that F_O measures with
    bool isWanted = false;                                                        // a way of ending
    bool isResting = true;  // parts can lie so on a level surface; of others there is no telling
};

struct Measured {
    double value = 0.0;
    double error = 0.0;  // standard error; 0: exact, or of fewer than two trials
};

/// Something that tracks are judged by.
struct Objective {
    std::string_view key;     // in settings, studies and JSON: "F_C"
    std::string_view symbol;  // in tables and beside axes: "F_C"
    std::string_view name;    // "Collisions"
    std::string_view unit;    // as people read it: "triangles"; empty: none
    std::string_view help;    // two short sentences
    double shownAs = 1.0;     // in people's unit, from the value: 100 for %
    int decimals = 3;         // in people's unit
    bool moreIsBetter = true;
    bool isNoisy = true;         // differs from trials to trials
    bool isDetail = false;       // for those who look into the algorithm
    bool usesTolerance = false;  // differs with the tolerance of success
    bool needsWanted = false;    // there is none where nothing is wanted
    bool isSuccess = false;      // people read it with exact bounds, in a place of its own
    /// Whether it says anything of a study's trials; null: of all. What counts in F is measured all the same.
    bool (*applies)(const Evaluation& evaluation) = nullptr;
    /// Of a track that was not simulated no more than what its trials could give at worst.
    Measured (*measure)(const Evaluation& evaluation) = nullptr;
    /// The value of a perfect feeder from random starts. Null: there is no telling.
    double (*attainable)(const Task& task) = nullptr;

    /// The symbol with its unit: "F_D [segments]".
    [[nodiscard]] std::string title() const;
};

}  // namespace trapwright::objectives
