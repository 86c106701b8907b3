#include "core/verify/conveying.h"

#include <algorithm>
#include <cmath>

#include "core/verify/scenes.h"

namespace trapwright::verify {

namespace {

constexpr double kLength = 2.0;     // no part is conveyed so far [m]
constexpr double kHalfWidth = 0.2;  // nor so far aside [m]
constexpr double kHeight = 15e-3;
constexpr double kClearance = 1e-6;

std::shared_ptr<const track::Track> makeLongFlat(double slope) {
    track::FeederShape shape;
    shape.slope = slope;
    return makeSurface(
        {-kLength, 0.0, kLength}, {-kHalfWidth, 0.0, kHalfWidth}, [](double, double) { return kHeight; },
        shape);
}

/// The part at rest above the track, turned by `heading` out of its most probable pose.
base::Pose layDown(const part::Part& part, double heading) {
    const part::StablePose& pose = part.stablePoses.front();
    const base::Quaternion turn(Eigen::AngleAxisd(heading, base::Vec3::UnitZ()));
    return {(turn * pose.rotation).normalized(), {0.0, 0.0, kHeight + pose.height + kClearance}};
}

/// Of the only trial of the scene, between two whole numbers of periods. [m/s]
base::Result<double> measureSpeed(const trial::Engine& engine, const trial::TrialBatch& batch,
                                  double settling, const base::RunControl& control) {
    const double period = batch.drive.period();
    const auto trajectory = engine.replay(batch, 0, period, control);
    if (!trajectory) return trajectory.error();
    const auto& samples = trajectory->samples;
    const auto first = static_cast<std::size_t>(std::ceil(settling / period));
    // The last sample is taken at the end of the trial, which need not be the end of a period.
    if (samples.size() < first + 3)
        return base::Error{"The part fell off the flat track of the conveying test."};
    const std::size_t last = samples.size() - 2;
    return (samples[last].parts[0].room.position.x() - samples[first].parts[0].room.position.x()) /
           (static_cast<double>(last - first) * period);
}

constexpr int kRows = 32;
constexpr double kLongestThrow = 3.3;

/// The half-stroke of a row, from 1.
double halfStrokeOf(int row, trial::Vibration drive, double gravity) {
    drive.halfStroke = 1.0;
    return kLongestThrow / trial::calcThrowNumber(drive, gravity) * row / kRows;
}

}  // namespace

base::Result<ConveyingSpeed> measureConveyingSpeed(const trial::Engine& engine, const ConveyingScene& scene,
                                                   const base::RunControl& control) {
    if (scene.part->stablePoses.empty())
        return base::Error{"The part " + scene.part->name + " has no stable pose to be conveyed in."};
    ConveyingSpeed speed;
    for (int i = 0; i < scene.headings; ++i) {
        const double heading = 2.0 * base::kPi * i / scene.headings;
        trial::TrialBatch batch = makeStillScene(makeLongFlat(scene.slope), scene.part,
                                                 layDown(*scene.part, heading), scene.duration);
        batch.drive = scene.drive;
        batch.contact = scene.contact;
        const auto one = measureSpeed(engine, batch, scene.settling, control);
        if (!one) return one.error();
        speed.mean += *one / scene.headings;
        speed.least = i == 0 ? *one : std::min(speed.least, *one);
        speed.most = i == 0 ? *one : std::max(speed.most, *one);
    }
    return speed;
}

base::Result<calibration::SpeedTable> measureSpeedTable(const trial::Engine& engine,
                                                        const ConveyingScene& scene,
                                                        const base::RunControl& control) {
    constexpr double kFallen = 0.8;  // of the greatest: what follows is not looked at
    calibration::SpeedTable table;
    ConveyingScene row = scene;
    double greatest = 0.0;
    for (int i = 1; i <= kRows; ++i) {
        row.drive.halfStroke = halfStrokeOf(i, scene.drive, base::kStandardGravity);
        const auto speed = measureConveyingSpeed(engine, row, control);
        if (!speed) return speed.error();
        table.halfStrokes.push_back(row.drive.halfStroke);
        table.speeds.push_back(speed->mean);
        greatest = std::max(greatest, speed->mean);
        const double alongTrack = row.drive.halfStroke * row.drive.angularFrequency();
        if (speed->mean < kFallen * greatest && greatest > 0.1 * alongTrack) break;
    }
    return calibration::risingPart(table);
}

}  // namespace trapwright::verify
