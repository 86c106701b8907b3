#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/random.h"
#include "core/geometry/convex_separation.h"
#include "core/trial/predicted_speed.h"
#include "core/verify/cases.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kDegree;
using base::kMillimetre;
using base::Pose;
using base::Quaternion;
using base::Vec2;
using base::Vec3;

namespace {

constexpr double kDensity = 1040.0;  // ABS [kg/m^3]
/// The level of makeFlat.
constexpr double kLevel = 15.0 * kMillimetre;

/// No parts yet, on a track that stands still.
trial::TrialBatch makeEmptyScene(std::shared_ptr<const track::Track> track, double duration) {
    trial::TrialBatch scene = makeStillScene(std::move(track), nullptr, {}, duration);
    scene.parts.clear();
    scene.trials[0].parts.clear();
    return scene;
}

/// One more part, of a kind of its own if the batch has it not yet.
void addPart(trial::TrialBatch& scene, const std::shared_ptr<const part::Part>& part, const Pose& pose,
             const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
    auto kind = std::ranges::find(scene.parts, part);
    if (kind == scene.parts.end()) kind = scene.parts.insert(kind, part);
    scene.trials[0].parts.push_back(
        {static_cast<std::size_t>(kind - scene.parts.begin()), pose, velocity, spin});
}

const part::Part& partOf(const trial::TrialBatch& scene, const trial::PartState& state) {
    return *scene.parts[scene.trials[0].parts[state.part].part];
}

struct Momentum {
    Vec3 linear = Vec3::Zero();   // [N s]
    Vec3 angular = Vec3::Zero();  // about the origin [N m s]
};

Momentum calcMomentum(const trial::TrialBatch& scene, const trial::TrajectorySample& sample) {
    Momentum sum;
    for (const trial::PartState& state : sample.parts) {
        const geometry::MassProperties& mass = partOf(scene, state).massProperties;
        const base::Mat3 rotation = state.room.rotation.toRotationMatrix();
        const Vec3 linear = mass.mass * state.velocity;
        sum.linear += linear;
        sum.angular += state.room.position.cross(linear) +
                       rotation * (mass.inertia * (rotation.transpose() * state.angularVelocity));
    }
    return sum;
}

/// How deep two parts are inside each other at worst, as few planes as there are between them. [m]
double findDeepest(const trial::TrialBatch& scene, const trial::Trajectory& trajectory) {
    double deepest = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        for (std::size_t i = 0; i < sample.parts.size(); ++i) {
            for (std::size_t k = i + 1; k < sample.parts.size(); ++k) {
                const trial::PartState& a = sample.parts[i];
                const trial::PartState& b = sample.parts[k];
                deepest = std::max(deepest, -geometry::calcSeparation(partOf(scene, a).hull, a.room,
                                                                      partOf(scene, b).hull, b.room));
            }
        }
    }
    return deepest;
}

/// What the track and the parts behind it press a part along `direction` with, at the last moment. [N]
double calcPush(const trial::TrajectorySample& sample, trial::Body from, trial::Body on,
                const Vec3& direction) {
    double push = 0.0;
    for (const trial::ContactForce& force : sample.forces) {
        if (force.bodyA == from && force.bodyB == on) push += direction.dot(force.force);
        if (force.bodyA == on && force.bodyB == from) push -= direction.dot(force.force);
    }
    return push;
}

/// A track that falls by `slope` along x and ends in a wall at right angles to it.
struct Chute {
    static constexpr double kWallX = 0.25;               // [m]
    static constexpr double kTop = 120.0 * kMillimetre;  // at x = 0
    static constexpr double kWall = 10.0 * kMillimetre;

    explicit Chute(double angle)
        : slope(angle),
          down(std::cos(angle), 0.0, -std::sin(angle)),
          up(std::sin(angle), 0.0, std::cos(angle)) {
        const double over = kWall * std::sin(angle);
        const double foot = heightAt(kWallX);
        track = makeSurface({0.0, 0.05, 0.1, 0.15, 0.2, kWallX, kWallX + over, kWallX + over + 0.05},
                            {-0.03, -0.01, 0.01, 0.03}, [&](double x, double) {
                                return x <= kWallX ? heightAt(x) : foot + kWall * std::cos(angle);
                            });
    }

    /// A part that lies on the slope: how far its centre of mass is up the slope from the wall, and over it.
    [[nodiscard]] Pose place(double back, double over) const {
        const Vec3 foot(kWallX, 0.0, heightAt(kWallX));
        return {Quaternion(Eigen::AngleAxisd(slope, Vec3::UnitY())), foot - back * down + over * up};
    }

    double slope;
    Vec3 down, up;  // unit, along the slope and out of it
    std::shared_ptr<const track::Track> track;

 private:
    [[nodiscard]] double heightAt(double x) const { return kTop - std::tan(slope) * x; }
};

}  // namespace

std::vector<Row> runCollision(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    const auto light = makeCuboid(Vec3(4, 8, 12) * kMillimetre, kDensity);
    const auto heavy = makeCuboid(Vec3(8, 10, 12) * kMillimetre, kDensity);
    const Vec3 middle(0.15, 0.0, 80.0 * kMillimetre);

    // Face on face, in a straight line: Newton's restitution, and momentum.
    double ratioError = 0.0;
    double momentumError = 0.0;
    for (const double speed : {0.03, 0.1, 0.5}) {
        for (const double restitution : {0.0, 0.3, 0.6}) {
            trial::TrialBatch scene = makeEmptyScene(makeFlat(), 3e-3 / speed);
            scene.gravity = 0.0;
            scene.partsContact = {0.5, 0.5, restitution};
            addPart(scene, light, {Quaternion::Identity(), middle - Vec3(3e-3, 0.0, 0.0)},
                    Vec3(speed, 0.0, 0.0));
            addPart(scene, heavy, {Quaternion::Identity(), middle + Vec3(4e-3, 0.0, 0.0)});
            const trial::Trajectory trajectory = replayScene(*engine, scene, 1e-3, control);
            const trial::TrajectorySample& end = trajectory.samples.back();
            const double apart = end.parts[1].velocity.x() - end.parts[0].velocity.x();
            ratioError = std::max(ratioError, std::abs(apart / speed - restitution));
            const Momentum before = calcMomentum(scene, trajectory.samples.front());
            momentumError = std::max(momentumError, (calcMomentum(scene, end).linear - before.linear).norm() /
                                                        before.linear.norm());
        }
    }

    // Anyhow: corners, edges and faces, turning, with friction.
    double anyMomentum = 0.0;
    double anyAngular = 0.0;
    double gain = 0.0;
    double deepest = 0.0;
    int hits = 0;
    base::Random random({1, 0, 0, 0, base::Purpose::test});
    for (int i = 0; i < 40; ++i) {
        trial::TrialBatch scene = makeEmptyScene(makeFlat(), 0.15);
        scene.gravity = 0.0;
        scene.partsContact = {0.5, 0.5, random.uniform(0.0, 0.6)};
        const auto spin = [&] {
            return Vec3(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
        };
        const Vec3 aside(0.0, random.uniform(-3e-3, 3e-3), random.uniform(-3e-3, 3e-3));
        addPart(scene, light, {random.rotation(), middle - Vec3(10e-3, 0.0, 0.0)}, Vec3(0.3, 0.0, 0.0),
                spin());
        addPart(scene, heavy, {random.rotation(), middle + Vec3(10e-3, 0.0, 0.0) + aside},
                Vec3(-0.1, 0.0, 0.0), spin());
        const trial::Trajectory trajectory = replayScene(*engine, scene, 2e-4, control);
        const Momentum before = calcMomentum(scene, trajectory.samples.front());
        const Momentum after = calcMomentum(scene, trajectory.samples.back());
        const double scale = light->massProperties.mass * 0.3;
        anyMomentum = std::max(anyMomentum, (after.linear - before.linear).norm() / scale);
        anyAngular = std::max(anyAngular, (after.angular - before.angular).norm() / (scale * 10e-3));
        gain =
            std::max(gain, findEnergyGain(scene, trajectory) / calcEnergy(scene, trajectory.samples.front()));
        deepest = std::max(deepest, findDeepest(scene, trajectory));
        hits += std::ranges::any_of(trajectory.samples,
                                    [](const auto& sample) { return sample.parts.front().contacts > 0; })
                    ? 1
                    : 0;
    }
    return {
        {"two blocks head-on, e = 0, 0.3, 0.6: rebound", "ratio within 0.03",
         fmt::format("within {:.4f}", ratioError), ratioError < 0.03},
        {"two blocks head-on: momentum", "within 1e-5", fmt::format("within {:.1e}", momentumError),
         momentumError < 1e-5},
        {"two blocks anyhow, 40 ways: momentum, turning", "within 1e-4 and 1e-2",
         fmt::format("within {:.1e} and {:.1e}, {} hit", anyMomentum, anyAngular, hits),
         anyMomentum < 1e-4 && anyAngular < 1e-2 && hits >= 30},
        {"two blocks anyhow, 40 ways: energy, overlap", "never grows, < 0.1 mm",
         fmt::format("by {:.1e} at most, {:.4f} mm", gain, deepest * 1e3), gain < 1e-3 && deepest < 1e-4}};
}

std::vector<Row> runStack(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    constexpr double kFriction = 0.3;
    constexpr int kSettled = 25;
    constexpr int kEnd = 50;
    const auto block = makeCuboid(Vec3(12, 12, 4) * kMillimetre, kDensity);
    trial::Vibration drive;
    drive.halfStroke = 0.35e-3;
    const double period = drive.period();
    trial::TrialBatch ride = makeEmptyScene(makeFlat(), (kEnd + 0.5) * period);
    ride.drive = drive;
    ride.contact = {kFriction, kFriction, 0.3};
    ride.partsContact = {0.6, 0.6, 0.3};
    for (int i = 0; i < 2; ++i)
        addPart(ride, block,
                {Quaternion::Identity(),
                 Vec3(0.08, 0.0, kLevel + (2.0 + 4.0 * i) * kMillimetre + (i + 1) * 1e-9)});
    const trial::Trajectory ridden = replayScene(*engine, ride, period, control);
    const auto at = [&](int i) { return ridden.samples[static_cast<std::size_t>(i)].parts; };
    const double speed =
        (at(kEnd)[0].room.position.x() - at(kSettled)[0].room.position.x()) / ((kEnd - kSettled) * period);
    const double expected = trial::calcStickSlipSpeed(drive, kFriction, ride.gravity);
    const double slipped = std::abs((at(kEnd)[1].room.position.x() - at(kEnd)[0].room.position.x()) -
                                    (at(0)[1].room.position.x() - at(0)[0].room.position.x()));

    // Five on each other, each turned a little, at rest.
    trial::TrialBatch tower = makeEmptyScene(makeFlat(), 2.0);
    for (int i = 0; i < 5; ++i)
        addPart(tower, block,
                {Quaternion(Eigen::AngleAxisd(0.3 * i, Vec3::UnitZ())),
                 Vec3(0.1, 0.0, kLevel + (2.0 + 4.0 * i) * kMillimetre + (i + 1) * 1e-9)});
    const trial::Trajectory stood = replayScene(*engine, tower, 0.1, control);
    double drift = 0.0;
    for (std::size_t i = 0; i < 5; ++i)
        drift = std::max(
            drift,
            (stood.samples[19].parts[i].room.position - stood.samples[2].parts[i].room.position).norm());
    return {{"a block on a block: conveyed as one",
             fmt::format("{:.2f} mm/s within 2 %, no slip", expected * 1e3),
             fmt::format("{:.2f} mm/s ({:+.2f} %), slip {:.4f} mm", speed * 1e3,
                         (speed / expected - 1.0) * 100, slipped * 1e3),
             std::abs(speed / expected - 1.0) < 0.02 && slipped < 0.1e-3},
            {"five blocks on each other: drift in 1.7 s", "< 1 micrometre",
             fmt::format("{:.4f} micrometres", drift * 1e6), drift < 1e-6}};
}

std::vector<Row> runColumn(const trial::EngineKind& kind, const base::RunControl& control) {
    // Without friction each part carries all behind it: m g sin(slope) times their number.
    const auto engine = kind.make({});
    constexpr int kParts = 10;
    constexpr double kLength = 12.0 * kMillimetre;
    const Chute chute(10.0 * kDegree);
    const auto block = makeCuboid(Vec3(12, 8, 6) * kMillimetre, kDensity);
    trial::TrialBatch scene = makeEmptyScene(chute.track, 1.0);
    scene.contact = {0.0, 0.0, 0.2};
    scene.partsContact = {0.0, 0.0, 0.2};
    for (int i = 0; i < kParts; ++i)
        addPart(scene, block, chute.place((i + 0.5) * kLength + (i + 1) * 1e-6, 3.0 * kMillimetre + 1e-7));
    const trial::Trajectory trajectory = replayScene(*engine, scene, 2e-4, control);
    const double own = block->massProperties.mass * scene.gravity * std::sin(chute.slope);
    // What is in contact rattles a little from step to step: the mean of the last fifth of a second.
    double worst = 0.0;
    double last = 0.0;
    for (int i = 0; i < kParts; ++i) {
        double push = 0.0;
        int samples = 0;
        for (const trial::TrajectorySample& sample : trajectory.samples) {
            if (sample.time < 0.8) continue;
            push += calcPush(sample, i - 1, i, -chute.down);
            ++samples;
        }
        push /= samples;
        if (i == 0) last = push;
        worst = std::max(worst, std::abs(push / (own * (kParts - i)) - 1.0));
    }
    return {{"column of ten against a stop: force in each joint",
             fmt::format("1 to 10 times {:.3f} mN within 1 %", own * 1e3),
             fmt::format("within {:.2f} %, at the stop {:.3f} mN", worst * 100, last * 1e3), worst < 0.01}};
}

std::vector<Row> runClimbing(const trial::EngineKind& kind, const base::RunControl& control) {
    // A block on a smooth slope s is driven by its weight W onto the chamfer a of a part that is held. It
    // stands on its rear edge and, `lift` higher, on the chamfer, so tilted by b = asin(lift / l). Moments
    // about the rear edge tell the force N on the chamfer, and it climbs if W sin s > N (sin a + mu cos a):
    // if tan(a + atan mu) < l cos b sin s / (x cos s + (z - l sin b) sin s), (x, z) the centre of mass.
    const auto engine = kind.make({});
    constexpr double kFriction = 0.2;
    constexpr double kLength = 12.0 * kMillimetre;
    constexpr double kHeight = 4.0 * kMillimetre;
    constexpr double kLift = 0.3 * kMillimetre;
    const Chute chute(20.0 * kDegree);
    const double tilt = std::asin(kLift / kLength);
    const base::Mat3 tilted(Eigen::AngleAxisd(-tilt, Vec3::UnitY()));
    const Vec3 centre = tilted * Vec3(0.5 * kLength, 0.0, 0.5 * kHeight);  // from the rear edge
    const double critical =
        std::atan(kLength * std::cos(tilt) * std::sin(chute.slope) /
                  (centre.x() * std::cos(chute.slope) + (centre.z() - kLift) * std::sin(chute.slope))) -
        std::atan(kFriction);
    const auto block = makeCuboid(Vec3(kLength, 8.0 * kMillimetre, kHeight), kDensity);
    const auto climbs = [&](double chamfer) {
        // Profile of the held part, up the slope from the wall: flat foot, chamfer, back.
        const double rise = 6.0 * kMillimetre;
        const double foot = 5.0 * kMillimetre + rise / std::tan(chamfer);
        const std::vector<Vec2> profile = {{-foot, 0.0}, {0.0, 0.0}, {0.0, rise}, {-5.0 * kMillimetre, rise}};
        const auto wedge = makePrism(profile, 10.0 * kMillimetre, kDensity);
        double lowest = 0.0;
        double front = 0.0;
        for (const Vec3& vertex : wedge->hull.vertices) {
            lowest = std::min(lowest, vertex.z());
            front = std::max(front, vertex.x());
        }
        trial::TrialBatch scene = makeEmptyScene(chute.track, 0.6);
        scene.contact = {0.0, 0.0, 0.0};
        scene.partsContact = {kFriction, kFriction, 0.0};
        addPart(scene, wedge, chute.place(front + 1e-7, -lowest + 1e-7));
        // Its front edge is on the chamfer, its rear edge on the slope.
        const double rear = foot - kLift / std::tan(chamfer) + kLength * std::cos(tilt);
        Pose start = chute.place(rear - centre.x(), centre.z() + 1e-7);
        start.rotation = start.rotation * Quaternion(tilted);
        addPart(scene, block, start);
        const trial::Trajectory trajectory = replayScene(*engine, scene, 0.01, control);
        const auto along = [&](const trial::TrajectorySample& sample) {
            return chute.down.dot(sample.parts.back().room.position);
        };
        return along(trajectory.samples.back()) - along(trajectory.samples.front()) > 0.5 * kMillimetre;
    };
    const bool below = climbs(critical - 1.0 * kDegree);
    const bool above = climbs(critical + 1.0 * kDegree);
    const auto say = [](bool is) { return is ? "climbs" : "stays"; };
    return {{"block driven onto a chamfer, friction 0.2",
             fmt::format("climbs below {:.1f} deg, within 1 deg", critical / kDegree),
             fmt::format("{:.1f} deg: {}, {:.1f} deg: {}", critical / kDegree - 1.0, say(below),
                         critical / kDegree + 1.0, say(above)),
             below && !above}};
}

std::vector<Row> runHeap(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double gain = 0.0;
    double deepest = 0.0;
    double farthest = 0.0;
    base::Random random({1, 0, 0, 1, base::Purpose::test});
    for (int i = 0; i < 5; ++i) {
        trial::TrialBatch scene = makeEmptyScene(makeFlat(), 1.0);
        scene.contact = {0.5, 0.5, 0.3};
        scene.partsContact = {0.4, 0.4, 0.3};
        const auto part = makePaperCuboid();
        // A column of layers of two, dropped at once.
        for (int k = 0; k < 8; ++k) {
            const int layer = k / 2;
            const double side = k % 2 == 0 ? -4.0 : 4.0;
            addPart(scene, part,
                    {random.rotation(),
                     Vec3(0.12 + (side + 4.0 * (k % 2)) * kMillimetre, side * 2.0 * kMillimetre,
                          kLevel + (8.0 + 16.0 * layer) * kMillimetre)});
        }
        const trial::Trajectory trajectory = replayScene(*engine, scene, 1e-3, control);
        const double rest = static_cast<double>(scene.trials[0].parts.size()) * part->massProperties.mass *
                            scene.gravity * kLevel;
        gain = std::max(
            gain, findEnergyGain(scene, trajectory) / (calcEnergy(scene, trajectory.samples.front()) - rest));
        deepest = std::max(deepest, findDeepest(scene, trajectory));
        const trial::TrajectorySample& end = trajectory.samples.back();
        const trial::TrajectorySample& before = trajectory.samples[trajectory.samples.size() - 101];
        for (std::size_t k = 0; k < end.parts.size(); ++k)
            farthest =
                std::max(farthest, (end.parts[k].room.position - before.parts[k].room.position).norm());
    }
    return {
        {"eight parts dropped on each other, 5 times: energy", "never grows",
         fmt::format("by {:.1e} at most", gain), gain < 2e-3},
        {"eight parts dropped on each other: overlap, rest", "< 0.1 mm, moves < 0.01 mm in the last 0.1 s",
         fmt::format("{:.4f} mm, {:.5f} mm", deepest * 1e3, farthest * 1e3),
         deepest < 1e-4 && farthest < 1e-5}};
}

}  // namespace trapwright::verify
