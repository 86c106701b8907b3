#include "sim/native/trial_lanes.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "sim/contact/drive_motion.h"
#include "sim/contact/manifold.h"
#include "sim/contact/roughness.h"

namespace trapwright::native {

using base::Mat3;
using base::Vec3;

namespace {

void store(const Mat3& from, float (&to)[3][3]) {
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
            to[i][k] = static_cast<float>(from(i, k));
    }
}

float dotThree(const float* a, const float* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Contacts of which keepDistinct can mark some, a bit each.
constexpr std::size_t kMostMarked = 64;

/// Of contacts that say the same keeps the lowest, as contact::reduceManifold does.
void keepDistinct(ContactList& found) {
    constexpr auto kSamePlace = static_cast<float>(contact::kSamePlace);
    std::uint64_t dropped = 0;
    for (std::size_t i = 1; i < found.size(); ++i) {
        const float* a = found[i].values.data();
        for (std::size_t k = 0; k < i; ++k) {
            const float* b = found[k].values.data();
            const float apart[3] = {a[kArmX] - b[kArmX], a[kArmY] - b[kArmY], a[kArmZ] - b[kArmZ]};
            const bool same = dotThree(apart, apart) < kSamePlace * kSamePlace &&
                              dotThree(a + kNormalX, b + kNormalX) > static_cast<float>(contact::kSameNormal);
            if (same) dropped |= std::uint64_t{1} << (a[kGap] < b[kGap] ? k : i);
        }
    }
    if (dropped == 0) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if ((dropped >> i & 1U) != 0) continue;
        if (kept != i) found[kept] = found[i];
        ++kept;
    }
    found.shrink(kept);
}

/// A turn in what TrialLanes::phase counts.
constexpr double kWholeTurn = 4294967296.0;

std::uint32_t toTurns(double turns) {
    return static_cast<std::uint32_t>(std::llround((turns - std::floor(turns)) * kWholeTurn));
}

}  // namespace

LaneModel::LaneModel(const part::Part& part, const PackedBody& packedBody, const Vec3& gravityInRoom,
                     double stepTime, bool bowl)
    : body(&packedBody),
      step(stepTime),
      dt(static_cast<float>(stepTime)),
      gravityX(static_cast<float>(0.0 - gravityInRoom.x())),
      gravityZ(static_cast<float>(0.0 - gravityInRoom.z())),
      anyBowl(bowl) {
    const Mat3 perMass = part.massProperties.inertia / part.massProperties.mass;
    const Mat3 inverse = perMass.inverse();
    const Mat3 factor = inverse.llt().matrixL();
    store(perMass, inertia);
    store(inverse, inverseInertia);
    store(factor, scale);
    store(factor.inverse(), unscale);
}

TrialLanes::TrialLanes(const LaneModel& model, int capacity)
    : phase(padToVectors(capacity)),
      cycle(padToVectors(capacity)),
      track(capacity),
      law(capacity),
      piecesInTrack(kPieceRows, static_cast<int>(model.body->pieces.size())),
      warmStarts(capacity),
      found(capacity),
      plastic(capacity),
      smooth(capacity),
      touched(capacity),
      model_(&model),
      // Not a power of two: fields of one lane would fall into the same few lines of the cache.
      stride_(padToVectors(capacity) + kWidestVector),
      floats_(static_cast<std::size_t>(stride_) * kFieldCount),
      positions_(static_cast<std::size_t>(stride_) * 3),
      origins_(static_cast<std::size_t>(stride_) * 3),
      pairs_(padToVectors(capacity) / kWidestVector) {
    solveBatch.touches.resize(static_cast<std::size_t>(kMostContacts) * kContactFields * kWidestVector);
    // Padding is near nothing.
    std::fill_n(piecesInTrack.row(kPieceX), piecesInTrack.stride(), 1e6F);
    // Lanes that were never used are stepped along with the others of their vector: give them a rotation.
    for (int lane = 0; lane < stride_; ++lane)
        field(kRotationW)[lane] = 1.0F;
}

void TrialLanes::add(const PackedTrack& packedTrack, const trial::TrialBatch& batch,
                     const trial::TrialSpec& spec, std::size_t part, long step) {
    const int lane = count_++;
    for (int f = 0; f < kFieldCount; ++f)
        field(f)[lane] = 0.0F;
    const auto set = [&](int f, double value) { field(f)[lane] = static_cast<float>(value); };
    const auto setThree = [&](int f, const Vec3& value) {
        for (int k = 0; k < 3; ++k)
            set(f + k, value[k]);
    };

    const trial::PartStart& start = spec.parts[part];
    const trial::Vibration& vibration = batch.driveOf(spec);
    const contact::DriveMotion drive(vibration, batch.track->shape, spec.phase);
    const contact::DriveMotion::Amplitudes amplitudes = drive.amplitudes();
    set(kDriveAlong, amplitudes.along);
    set(kDriveUp, amplitudes.up);
    set(kDriveTurn, amplitudes.turn);

    const double dt = model_->step;
    const double turns = vibration.frequency * dt;
    const double begin = spec.phase / (2.0 * base::kPi);
    cycle[lane] = toTurns(turns);
    phase[lane] = toTurns(begin + 2.0 * turns) + static_cast<std::uint32_t>(step) * cycle[lane];
    // Later on exactly where the drive of the lanes is that were there from the begin on.
    const auto sine = [&](int ahead) {
        const std::uint32_t then = phase[lane] + static_cast<std::uint32_t>(ahead - 2) * cycle[lane];
        return std::sin(2.0 * base::kPi *
                        (step == 0 ? begin + ahead * turns : static_cast<double>(then) / kWholeTurn));
    };
    set(kDriveBefore, sine(-1));
    set(kDriveNow, sine(0));
    set(kDriveNext, sine(1));

    // At rest in the room, where the track is at the drive's phase.
    const contact::TrackPlacement placement =
        step == 0 ? drive.placement(0.0) : contact::DriveMotion::calcPlacement(amplitudes, sine(0));
    const base::Pose pose = placement.toRoom(start.pose);
    for (int k = 0; k < 3; ++k)
        position(k)[lane] = pose.position[k];
    set(kPositionX, pose.position.x());
    set(kPositionY, pose.position.y());
    set(kRotationW, pose.rotation.w());
    setThree(kRotationX, pose.rotation.vec());

    // Velocities belong to the middles of steps: go back by half of one.
    const Mat3 rotation = pose.rotation.toRotationMatrix();
    const Mat3 inertia = rotation * batch.parts[start.part]->massProperties.inertia * rotation.transpose();
    const Vec3& w = start.angularVelocity;
    const Vec3 turn = -inertia.inverse() * w.cross(inertia * w);
    setThree(kTurnX, turn);
    setThree(kTurnBeforeX, turn);
    setThree(kSpinX, w - 0.5 * dt * turn);
    setThree(kVelocityX, start.velocity - 0.5 * dt * batch.gravityVector());

    const trial::ContactParameters& contact = batch.contactOf(spec);
    set(kStaticFriction, contact.staticFriction);
    set(kKineticFriction, contact.kineticFriction);
    set(kRestitution, contact.restitution);
    law[lane] = contact;

    set(kNextLook, -1.0);
    set(kReach, -1.0);
    track[lane] = &packedTrack;
    pairsOf(lane).clear(lane % kWidestVector);
    warmStarts[lane].count = 0;
    warmStarts[lane].carrying = 0;
    touched[lane] = 0;
}

void TrialLanes::remove(int lane) {
    const int last = --count_;
    if (lane == last) {
        pairsOf(last).clear(last % kWidestVector);
        return;
    }
    for (int f = 0; f < kFieldCount; ++f)
        field(f)[lane] = field(f)[last];
    for (int k = 0; k < 3; ++k) {
        position(k)[lane] = position(k)[last];
        origin(k)[lane] = origin(k)[last];
    }
    phase[lane] = phase[last];
    cycle[lane] = cycle[last];
    track[lane] = track[last];
    law[lane] = law[last];
    NearPairs& left = pairsOf(last);
    pairsOf(lane).copy(lane % kWidestVector, left, last % kWidestVector);
    left.clear(last % kWidestVector);
    warmStarts[lane] = warmStarts[last];
    touched[lane] = touched[last];
}

void TrialLanes::grow(int capacity) {
    TrialLanes larger(*model_, capacity);
    for (int f = 0; f < kFieldCount; ++f)
        std::copy_n(field(f), count_, larger.field(f));
    for (int k = 0; k < 3; ++k) {
        std::copy_n(position(k), count_, larger.position(k));
        std::copy_n(origin(k), count_, larger.origin(k));
    }
    std::copy_n(phase.begin(), count_, larger.phase.begin());
    std::copy_n(cycle.begin(), count_, larger.cycle.begin());
    std::copy_n(track.begin(), count_, larger.track.begin());
    std::copy_n(law.begin(), count_, larger.law.begin());
    std::copy_n(warmStarts.begin(), count_, larger.warmStarts.begin());
    std::copy_n(touched.begin(), count_, larger.touched.begin());
    std::move(pairs_.begin(), pairs_.end(), larger.pairs_.begin());
    larger.count_ = count_;
    larger.laps = laps;
    larger.recorded = recorded;
    *this = std::move(larger);
}

base::Pose TrialLanes::poseInRoom(int lane) const {
    base::Pose pose;
    pose.rotation = base::Quaternion(field(kRotationW)[lane], field(kRotationX)[lane],
                                     field(kRotationY)[lane], field(kRotationZ)[lane]);
    pose.position = {position(0)[lane], position(1)[lane], position(2)[lane]};
    return pose;
}

base::Pose TrialLanes::poseInTrack(int lane) const {
    const double drive = field(kDriveNow)[lane];
    base::Pose pose = contact::DriveMotion::calcPlacement(
                          {field(kDriveAlong)[lane], field(kDriveUp)[lane], field(kDriveTurn)[lane]}, drive)
                          .toTrack(poseInRoom(lane));
    pose.rotation.normalize();
    return pose;
}

trial::PartState describeState(const TrialLanes& group, int lane, const trial::TerminationMonitor& progress,
                               std::size_t part) {
    const auto three = [&](int field) {
        return Vec3(group.field(field)[lane], group.field(field + 1)[lane], group.field(field + 2)[lane]);
    };
    trial::PartState state;
    state.room = group.poseInRoom(lane);
    state.room.rotation.normalize();
    state.track = progress.toTrackCoordinates(part, group.poseInTrack(lane));
    state.velocity = 0.5 * (three(kVelocityX) + three(kAfterX));
    state.angularVelocity =
        three(kSpinX) + group.model().step * (0.375 * three(kTurnX) + 0.125 * three(kTurnBeforeX));
    state.contacts = group.warmStarts[static_cast<std::size_t>(lane)].carrying;
    state.part = part;
    return state;
}

void roughen(TrialLanes& group, int lane) {
    const trial::ContactParameters& law = group.law[static_cast<std::size_t>(lane)];
    if (!(law.roughness > 0.0)) return;
    const Vec3 centre = group.poseInTrack(lane).position;
    ContactList& found = group.found[static_cast<std::size_t>(lane)];
    for (std::size_t i = 0; i < found.size(); ++i) {
        auto& f = found[i].values;
        const Vec3 normal = contact::tiltNormal(law, centre + Vec3(f[kArmX], f[kArmY], f[kArmZ]),
                                                Vec3(f[kNormalX], f[kNormalY], f[kNormalZ]));
        f[kNormalX] = static_cast<float>(normal.x());
        f[kNormalY] = static_cast<float>(normal.y());
        f[kNormalZ] = static_cast<float>(normal.z());
    }
}

void reduceContacts(ContactList& found) {
    if (found.size() <= kMostMarked) keepDistinct(found);
    if (found.size() <= WarmStartCache::kMost) return;
    std::vector<contact::ManifoldPoint> points;
    points.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& f = found[i].values;
        points.push_back({{f[kArmX], f[kArmY], f[kArmZ]}, {f[kNormalX], f[kNormalY], f[kNormalZ]}, f[kGap]});
    }
    std::array<int, WarmStartCache::kMost> kept{};
    const int count = contact::reduceManifold(points, kept);
    for (int i = 0; i < count; ++i)
        found[static_cast<std::size_t>(i)] =
            found[static_cast<std::size_t>(kept[i])];  // in order: kept[i] >= i
    found.shrink(static_cast<std::size_t>(count));
}

}  // namespace trapwright::native
