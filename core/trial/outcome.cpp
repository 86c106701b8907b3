#include "core/trial/outcome.h"

#include <algorithm>
#include <cassert>

namespace trapwright::trial {

std::string_view endingName(Ending ending) {
    switch (ending) {
        case Ending::finished:
            return "finished";
        case Ending::fellOff:
            return "fell off";
        case Ending::stuck:
            return "stuck";
        case Ending::timedOut:
            return "timed out";
    }
    assert(false && "not an ending");
    return "";
}

bool isFinite(const base::Pose& pose) {
    return pose.position.allFinite() && pose.rotation.coeffs().allFinite();
}

bool isFinite(const Outcome& outcome) {
    return std::ranges::all_of(outcome.parts, [](const PartOutcome& part) {
        return isFinite(part.initial) && isFinite(part.farthest);
    });
}

std::size_t countParts(std::span<const Outcome> outcomes) {
    std::size_t parts = 0;
    for (const Outcome& outcome : outcomes)
        parts += outcome.parts.size();
    return parts;
}

bool endAlike(const PartOutcome& a, const PartOutcome& b) {
    return a.ending == b.ending && a.farthest == b.farthest && a.time == b.time && a.entered == b.entered;
}

std::string describe(const OutcomeMaker& maker) {
    return maker.program + ", " + maker.engine + " with " + maker.instructionSet;
}

}  // namespace trapwright::trial
