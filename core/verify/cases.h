#pragma once

#include <vector>

#include "core/verify/verify.h"

/// The cases by subject; allCases() strings them together.
namespace trapwright::verify {

std::vector<Row> runTumbling(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runBounce(const trial::EngineKind& kind, const base::RunControl& control);

std::vector<Row> runSlope(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runTiltedFeeder(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runLedgeSlide(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runSliding(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runToppling(const trial::EngineKind& kind, const base::RunControl& control);

std::vector<Row> runStickSlip(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runStickSlipOnCrests(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runCreep(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runSlopedFeeder(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runClimbingBowl(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runHopping(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runLiftOff(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runPlasticHop(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runStepHalved(const trial::EngineKind& kind, const base::RunControl& control);

std::vector<Row> runRidgeBalance(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runRidgeDrop(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runRidgeSlide(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runThinWall(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runStillTrack(const trial::EngineKind& kind, const base::RunControl& control);

std::vector<Row> runCollision(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runStack(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runColumn(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runClimbing(const trial::EngineKind& kind, const base::RunControl& control);
std::vector<Row> runHeap(const trial::EngineKind& kind, const base::RunControl& control);

std::vector<Row> runStablePoses(const trial::EngineKind& kind, const base::RunControl& control);

}  // namespace trapwright::verify
