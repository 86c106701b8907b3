#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/part/part.h"
#include "core/track/track.h"
#include "core/trial/batch.h"
#include "core/trial/engine.h"

/// Small scenes with known outcomes, shared by verification, tests and benchmarks.
namespace trapwright::verify {

/// A homogeneous cuboid centred at the origin; sizes along x, y, z [m], density [kg/m^3].
std::shared_ptr<const part::Part> makeCuboid(const base::Vec3& size, double density);
/// The bundled cuboid of the paper: 4 x 8 x 12 mm, ABS.
std::shared_ptr<const part::Part> makePaperCuboid();

/// A prism along y, as wide as that, of a convex profile in (x, z), counter-clockwise seen from -y; the
/// origin is its centre of mass.
std::shared_ptr<const part::Part> makePrism(const std::vector<base::Vec2>& profile, double width,
                                            double density);

/// A track whose surface is z = height(x, y), sampled at the given x and y; linear unless said otherwise.
/// Start at the first x + 60 mm, finish at the last x.
std::shared_ptr<const track::Track> makeSurface(const std::vector<double>& xs, const std::vector<double>& ys,
                                                const std::function<double(double x, double y)>& height,
                                                const track::FeederShape& shape = {});
/// Flat at z = 15 mm, 400 mm long, 60 mm wide.
std::shared_ptr<const track::Track> makeFlat(const track::FeederShape& shape = {});
/// A level feeder whose surface rises by slopeX along x and slopeY along y [rad].
std::shared_ptr<const track::Track> makeSlope(double slopeX, double slopeY);
/// Hills and valleys of some millimetres, the same every time.
std::shared_ptr<const track::Track> makeRough();
/// Level at z = 15 mm up to x = 100 mm, then hills and valleys, 340 mm long and 60 mm wide. Lower ones than
/// makeRough's let some parts pass: `amplitude` [m] is that of the larger of two waves.
std::shared_ptr<const track::Track> makeHills(double amplitude);

/// Height of a track's surface as makeSurface made it is a function; this asks the mesh: the highest surface
/// point at (x, y). [m]
double findSurfaceHeight(const track::Track& track, double x, double y);

/// A batch of one trial that never ends before `duration` unless the part falls, without vibration.
trial::TrialBatch makeStillScene(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const base::Pose& pose,
                                 double duration);

/// Replays the only trial of a scene, sampled every `interval` seconds. Throws std::runtime_error if the
/// engine fails.
trial::Trajectory replayScene(const trial::Engine& engine, const trial::TrialBatch& scene, double interval,
                              const base::RunControl& control);

/// Largest rise of the energy above what it has been, without anything that drives. [J]
double findEnergyGain(const trial::TrialBatch& scene, const trial::Trajectory& trajectory);

/// Kinetic and potential energy of a sample, the latter 0 at the room's origin. [J]
double calcEnergy(const trial::TrialBatch& scene, const trial::TrajectorySample& sample);

}  // namespace trapwright::verify
