#include "core/verify/verify.h"

#include <exception>

#include "core/verify/cases.h"

namespace trapwright::verify {

std::vector<Case> allCases() {
    return {{"tumbling", runTumbling},
            {"bounce", runBounce},
            {"slope", runSlope},
            {"tilted-feeder", runTiltedFeeder},
            {"ledge-slide", runLedgeSlide},
            {"sliding", runSliding},
            {"toppling", runToppling},
            {"stick-slip", runStickSlip},
            {"stick-slip-on-crests", runStickSlipOnCrests},
            {"creep", runCreep},
            {"sloped-feeder", runSlopedFeeder},
            {"climbing-bowl", runClimbingBowl},
            {"hopping", runHopping},
            {"lift-off", runLiftOff},
            {"plastic-hop", runPlasticHop},
            {"ridge-balance", runRidgeBalance},
            {"ridge-drop", runRidgeDrop},
            {"ridge-slide", runRidgeSlide},
            {"thin-wall", runThinWall},
            {"still-track", runStillTrack},
            {"step-halved", runStepHalved},
            {"collision", runCollision, true},
            {"stack", runStack, true},
            {"column", runColumn, true},
            {"climbing", runClimbing, true},
            {"heap", runHeap, true},
            {"stable-poses", runStablePoses}};
}

bool runCases(const trial::EngineKind& kind, const std::string& filter, const base::RunControl& control,
              const std::function<void(const Row&)>& report) {
    bool passed = true;
    for (const Case& test : allCases()) {
        if (test.name.find(filter) == std::string::npos) continue;
        if (test.hasSeveralParts && !kind.takesStreams) continue;
        if (control.cancelled()) return false;
        try {
            for (const Row& row : test.run(kind, control)) {
                passed = passed && row.passed;
                report(row);
            }
        } catch (const std::exception& e) {
            passed = false;
            report({test.name, "a result", e.what(), false});
        }
    }
    return passed;
}

}  // namespace trapwright::verify
