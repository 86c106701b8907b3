#pragma once

#include <vector>

#include "core/verify/verify.h"

/// The cases by subject; allCases() strings them together.
namespace trapwright::verify {

std::vector<Row> runTumbling(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runBounce(const EngineFactory& factory, const base::RunControl& control);

std::vector<Row> runSlope(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runSliding(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runToppling(const EngineFactory& factory, const base::RunControl& control);

std::vector<Row> runStickSlip(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runHopping(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runLiftOff(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runPlasticHop(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runStepHalved(const EngineFactory& factory, const base::RunControl& control);

std::vector<Row> runRidgeBalance(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runRidgeDrop(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runRidgeSlide(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runThinWall(const EngineFactory& factory, const base::RunControl& control);
std::vector<Row> runStillTrack(const EngineFactory& factory, const base::RunControl& control);

std::vector<Row> runStablePoses(const EngineFactory& factory, const base::RunControl& control);

}  // namespace trapwright::verify
