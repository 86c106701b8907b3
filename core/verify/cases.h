#pragma once

#include <vector>

#include "core/verify/verify.h"

/// The cases by subject; allCases() strings them together.
namespace trapwright::verify {

std::vector<Row> runTumbling(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runBounce(const EngineFactory& factory, base::RunControl control);

std::vector<Row> runSlope(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runSliding(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runToppling(const EngineFactory& factory, base::RunControl control);

std::vector<Row> runStickSlip(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runHopping(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runLiftOff(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runPlasticHop(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runStepHalved(const EngineFactory& factory, base::RunControl control);

std::vector<Row> runRidgeBalance(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runRidgeDrop(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runRidgeSlide(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runThinWall(const EngineFactory& factory, base::RunControl control);
std::vector<Row> runStillTrack(const EngineFactory& factory, base::RunControl control);

std::vector<Row> runStablePoses(const EngineFactory& factory, base::RunControl control);

}  // namespace trapwright::verify
