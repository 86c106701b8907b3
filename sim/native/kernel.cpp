#include "sim/native/kernel.h"

#include <algorithm>
#include <cmath>

// SSE4 is the least that is worth more than plain instructions.
#define HWY_DISABLED_TARGETS HWY_SSSE3
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/native/kernel.cpp"
#include <hwy/foreach_target.h>
// After it: what is included from here on is compiled once per instruction set.
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trapwright::native::HWY_NAMESPACE {

// Each part needs those before it: lanes, the formulas over them, the kernel over the formulas.
// clang-format off
#include "sim/native/lanes.inl"
#include "sim/contact/formulas/vectors.inl"
#include "sim/contact/formulas/features.inl"
#include "sim/contact/formulas/law.inl"
#include "sim/contact/formulas/step.inl"
#include "sim/native/motion.inl"
#include "sim/native/collecting.inl"
#include "sim/native/detection.inl"
#include "sim/native/solving.inl"
// clang-format on

void endLap(TrialLanes& group, double trial::Costs::*what) {
    if (group.laps != nullptr) group.laps->end(what);
}

void beginStepOf(TrialLanes& group) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int lane = 0; lane < group.count(); lane += width) {
        moveFreely(group, lane);
        moveTrack(group, lane);
        lookAhead(group, lane);
    }
}

void findContactsInAll(TrialLanes& group) {
    endLap(group, &trial::Costs::integration);
    const int width = static_cast<int>(hn::Lanes(Tag()));
    placeCentres(group);
    for (int first = 0; first < group.count(); first += width) {
        const std::uint32_t carries = findContactsOf(group, first);
        const int end = std::min(first + width, group.count());
        for (int lane = first; lane < end; ++lane) {
            const auto place = static_cast<std::size_t>(lane);
            ContactList& found = group.found[place];
            const bool isTouched = group.touched[place] != 0;
            if (!isTouched && ((carries >> static_cast<unsigned>(lane - first)) & 1U) == 0) {
                rememberIdle(group, lane);
                continue;
            }
            found.sort();
            if (found.size() > kFew) reduceContacts(found);
            roughen(group, lane);
            if (!isTouched) beginSolving(group, lane);
        }
    }
    endLap(group, &trial::Costs::detection);
}

void solveAndMoveOf(TrialLanes& group) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    solveCarrying(group);
    endLap(group, &trial::Costs::law);
    for (int lane = 0; lane < group.count(); lane += width)
        movePose(group, lane);
    movePositions(group);
}

}  // namespace trapwright::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trapwright::native {

HWY_EXPORT(beginStepOf);
HWY_EXPORT(findContactsInAll);
HWY_EXPORT(solveAndMoveOf);

void beginStep(TrialLanes& group) {
    HWY_DYNAMIC_DISPATCH(beginStepOf)(group);
}

void findContacts(TrialLanes& group) {
    HWY_DYNAMIC_DISPATCH(findContactsInAll)(group);
}

void solveAndMove(TrialLanes& group) {
    HWY_DYNAMIC_DISPATCH(solveAndMoveOf)(group);
}

void finishStep(TrialLanes& group) {
    findContacts(group);
    solveAndMove(group);
}

std::vector<std::string> instructionSets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names.emplace_back(hwy::TargetName(target));
    return names;
}

std::string instructionSet() {
    return instructionSets().front();
}

bool useInstructionSet(const std::string& name) {
    hwy::SetSupportedTargetsForTest(0);
    bool known = name.empty();
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (known || name != hwy::TargetName(target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        known = true;
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return known;
}

}  // namespace trapwright::native
#endif
