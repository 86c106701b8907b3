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
#include "sim/native/feature_tests.inl"
#include "sim/native/detection.inl"
#include "sim/native/solving.inl"
// clang-format on

void endLap(Herd& herd, double trial::Costs::*what) {
    if (herd.laps != nullptr) herd.laps->end(what);
}

void beginStepOf(Herd& herd) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    herd.looking.clear();
    for (int lane = 0; lane < herd.count(); lane += width) {
        moveFreely(herd, lane);
        moveTrack(herd, lane);
        lookAhead(herd, lane);
    }
}

void finishStepOf(Herd& herd) {
    endLap(herd, &trial::Costs::integration);
    std::size_t next = 0;
    for (int lane = 0; lane < herd.count(); ++lane) {
        herd.found.clear();
        if (next < herd.looking.size() && herd.looking[next] == lane) {
            ++next;
            findContacts(herd, lane);
        }
        if (herd.found.empty() || !anyCarries(herd, lane)) {
            rememberIdle(herd, lane);
            continue;
        }
        if (herd.found.size() > kFew) thinOutFound(herd.found);
        endLap(herd, &trial::Costs::detection);
        enqueue(herd, lane);
        endLap(herd, &trial::Costs::law);
    }
    endLap(herd, &trial::Costs::detection);
    for (SolveBatch& batch : herd.solveBatches) {
        if (batch.filled > 0) solveBatch(herd, batch);
    }
    endLap(herd, &trial::Costs::law);
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int lane = 0; lane < herd.count(); lane += width)
        movePose(herd, lane);
    movePositions(herd);
}

}  // namespace trapwright::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trapwright::native {

HWY_EXPORT(beginStepOf);
HWY_EXPORT(finishStepOf);

void beginStep(Herd& herd) {
    HWY_DYNAMIC_DISPATCH(beginStepOf)(herd);
}

void finishStep(Herd& herd) {
    HWY_DYNAMIC_DISPATCH(finishStepOf)(herd);
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
