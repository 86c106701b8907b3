#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/part/part.h"
#include "core/trial/batch.h"
#include "core/trial/contact.h"
#include "core/trial/costs.h"
#include "core/trial/outcome.h"
#include "core/trial/termination_monitor.h"
#include "sim/contact/impulse_solver.h"
#include "sim/native/aligned.h"
#include "sim/native/near_pairs.h"
#include "sim/native/packed_body.h"
#include "sim/native/packed_track.h"

namespace trapwright::native {

/// What all trials of one batch share.
struct Scene {
    explicit Scene(const trial::TrialBatch& b) : batch(&b), track(contact::prepareTrack(b.track->solid)) {}

    const trial::TrialBatch* batch;
    PackedTrack track;
};

/// What is the same for all trials of a group. Inertias per mass, in part axes.
struct LaneModel {
    LaneModel(const part::Part& part, const PackedBody& packedBody, const base::Vec3& gravityInRoom,
              double stepTime, bool bowl);

    const PackedBody* body;
    double step;                 // of time [s]
    float dt;                    // the same
    float gravityX, gravityZ;    // against the room's axes; there is none across a track [m/s^2]
    bool anyBowl;                // else all tracks only translate
    float inertia[3][3];         // [m^2]
    float inverseInertia[3][3];  // [1/m^2]
    float scale[3][3];           // lower triangular S with S S^T = inverseInertia [1/m]
    float unscale[3][3];         // its inverse [m]
};

// clang-format off
/// One float of every lane. Room axes unless said otherwise.
enum Field : int {
    kRotationW, kRotationX, kRotationY, kRotationZ,
    kVelocityX, kVelocityY, kVelocityZ,              // mean of the last step [m/s]
    kSpinX, kSpinY, kSpinZ,                          // angular velocity, mean of the last step [rad/s]
    kTurnX, kTurnY, kTurnZ,                          // angular acceleration at the step's begin [rad/s^2]
    kTurnBeforeX, kTurnBeforeY, kTurnBeforeZ,        // at the begin of the step before
    kAfterX, kAfterY, kAfterZ,                       // velocity: free, then with the step's impulses
    kAfterSpinX, kAfterSpinY, kAfterSpinZ,           // angular velocity: the same
    kAdvanceX, kAdvanceY, kAdvanceZ,                 // what moves the pose
    kAdvanceSpinX, kAdvanceSpinY, kAdvanceSpinZ,
    kAxes, kAxesLast = kAxes + 8,                    // rotation matrix part -> room, row by row
    kPositionX, kPositionY,                          // copies of the doubles

    // The drive: its sine at the step before, now, at the next, at the one after.
    kDriveBefore, kDriveNow, kDriveNext,
    kDriveAlong, kDriveUp, kDriveTurn,               // amplitudes [m], [m], [rad]
    kShiftX, kShiftZ, kSine, kCosineLess,            // placement of the track now; CosineLess: cosine - 1
    kSineNext, kCosineLessNext,
    // Velocity of the track at (x, y):
    // (rateX + cosineLessRate x - sineRate y, sineRate x + cosineLessRate y, rateZ)
    kRateX, kRateZ, kSineRate, kCosineLessRate,      // mean over the coming step
    kRateBeforeX, kRateBeforeZ, kSineRateBefore, kCosineLessRateBefore,
    kTrackStepX, kTrackStepY, kTrackStepZ,           // of the track at the part's centre in the coming step [m]

    // Detection [m]: what the coming step is if nothing touches, in the track's axes
    kStepX, kStepY, kStepZ,                          // way of the centre
    kStepPath, kStepTurned,                          // its length; the farthest that any point comes by turning
    kGone,                                           // sum of both since the pairs were collected
    kNextLook,                                       // of it, before which nothing can touch
    // Since the pairs were collected
    kAwayX, kAwayY, kAwayZ,                          // way of the centre, track axes
    kThenW, kThenX, kThenY, kThenZ,                  // rotation of that moment
    kThenSine,                                       // of the track's rotation
    kReach,                                          // a pair that was not collected was farther apart
    kSkinThickness,                                  // what is collected next is nearer; 0: not yet

    kPushed,                                         // how far others may push the part in the coming step [m]

    kStaticFriction, kKineticFriction, kRestitution,
    kFieldCount
};
// clang-format on

/// Of one part, after thinning out.
inline constexpr int kMostContacts = contact::ImpulseSolver::kMaxContacts;

/// What a contact is made of, in its track's axes, arms from the centre of mass.
enum ContactField : int {
    kArmX,
    kArmY,
    kArmZ,     // [m]
    kNormalX,  // unit, track -> part
    kNormalY,
    kNormalZ,
    kGap,  // [m]; the last field that detection gives
    kNormalImpulse,
    kAlongImpulse,
    kAcrossImpulse,  // per mass, to begin with [m/s]
    kState,          // ContactState
    // How friction turns within the step, as far as the rounds before told (FrictionShape).
    kOnTheWay,
    kDirectionAlong,
    kDirectionAcross,
    kContactFields
};

/// Rows of TrialLanes::piecesInTrack. [m]
enum PieceRow : int { kPieceX, kPieceY, kPieceZ, kPieceNear, kPieceRows };

/// Contacts of a vector of lanes on their way into the lanes' lists.
struct StagedContacts {
    static constexpr int kBlock = (kGap + 1) * kWidestVector;  // values of a row

    std::vector<int> rows;                // of the pairs, one after the other, or what else tells them
    std::vector<std::uint32_t> overlaps;  // bits of the lanes in which they overlap at the step's end
    AlignedVector<float> values;          // ContactField of each row, of kWidestVector lanes
    std::vector<std::int32_t> codes;      // place among `rows` times kWidestVector, plus lane: the contacts
    int count = 0;

    /// Room for the values of one more.
    [[nodiscard]] float* valuesOf(int place) {
        const auto needed = static_cast<std::size_t>(place + 1) * kBlock;
        if (values.size() < needed) values.resize(2 * needed);
        return values.data() + static_cast<std::ptrdiff_t>(place) * kBlock;
    }
    /// Where the next ones go, a whole vector of them.
    [[nodiscard]] std::int32_t* reserveCodes() {
        const std::size_t needed = static_cast<std::size_t>(count) + kWidestVector;
        if (codes.size() < needed) codes.resize(2 * needed);
        return codes.data() + count;
    }
    void clear() {
        rows.clear();
        overlaps.clear();
        count = 0;
    }
};

/// Impulses that the last step left at the contacts of one part.
struct WarmStartCache {
    static constexpr int kMost = kMostContacts;
    int count = 0;
    int carrying = 0;  // with an impulse
    std::uint64_t feature[kMost];
    float normal[kMost];
    float along[kMost], across[kMost];
    bool slid[kMost];
};

/// What the last step left of a contact.
enum ContactState : int { kNewContact, kStuckContact, kSlidContact };

/// A contact of one part.
struct Contact {
    std::array<float, kContactFields> values;
    std::uint64_t feature;
};

/// What a contact of the last step gave the part in a lane, per mass.
struct RecordedImpulse {
    int lane;
    base::Vec3 arm;      // from the centre of mass, in the track's axes [m]
    base::Vec3 impulse;  // room axes [m/s]
};

/// The contacts of one part: writing comes first, counting after.
class ContactList {
 public:
    void clear() { size_ = 0; }
    /// Makes room for so many more.
    void reserve(std::size_t more) {
        if (contacts_.size() < size_ + more) contacts_.resize(2 * (size_ + more));
    }
    /// The place of the next one, for which there is room.
    Contact& next() { return contacts_[size_]; }
    void keepIf(bool counts) { size_ += counts ? 1 : 0; }
    /// By their features: where several contacts share a load, what each gets hangs on their order.
    void sort() {
        for (std::size_t i = 1; i < size_; ++i) {
            for (std::size_t k = i; k > 0 && contacts_[k].feature < contacts_[k - 1].feature; --k)
                std::swap(contacts_[k], contacts_[k - 1]);
        }
    }
    void shrink(std::size_t size) { size_ = size; }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    Contact& operator[](std::size_t i) { return contacts_[i]; }
    const Contact& operator[](std::size_t i) const { return contacts_[i]; }

 private:
    std::vector<Contact> contacts_;
    std::size_t size_ = 0;
};

/// Lanes by how many contacts they have.
using LanesByContacts = std::array<std::vector<std::int32_t>, kMostContacts + 1>;

/// Lanes with about equally many contacts that are solved together.
struct SolveBatch {
    int rows = 0;  // contacts of the lane that has most
    int filled = 0;
    bool shaped = false;  // it is the second round: kOnTheWay and so on are known
    std::array<std::int32_t, kWidestVector> lanes{};
    AlignedVector<float> touches;  // [row][ContactField][slot]

    [[nodiscard]] float* touch(int row, int field) {
        return touches.data() + static_cast<std::ptrdiff_t>(row * kContactFields + field) * kWidestVector;
    }
};

/// Parts that run side by side, one in each lane: a structure of arrays. Lanes know nothing of each other;
/// whoever steps parts that touch each other tells which they are (touched) and solves for those himself.
class TrialLanes {
 public:
    TrialLanes(const LaneModel& model, int capacity);

    /// Begins with a part of a trial in the next free lane, in step `step` of the trial.
    void add(const PackedTrack& track, const trial::TrialBatch& batch, const trial::TrialSpec& spec,
             std::size_t part = 0, long step = 0);
    /// Ends with the part of a lane; the last lane moves there.
    void remove(int lane);
    /// Makes room for so many lanes.
    void grow(int capacity);
    [[nodiscard]] int capacity() const { return static_cast<int>(track.size()); }

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] const LaneModel& model() const { return *model_; }
    [[nodiscard]] float* field(int f) { return floats_.data() + static_cast<std::ptrdiff_t>(f) * stride_; }
    [[nodiscard]] const float* field(int f) const {
        return floats_.data() + static_cast<std::ptrdiff_t>(f) * stride_;
    }
    /// Position of the centre of mass, axis 0-2. [m]
    [[nodiscard]] double* position(int axis) {
        return positions_.data() + static_cast<std::ptrdiff_t>(axis) * stride_;
    }
    [[nodiscard]] const double* position(int axis) const {
        return positions_.data() + static_cast<std::ptrdiff_t>(axis) * stride_;
    }

    /// In the track's frame, where the centre of mass was when its pairs were collected. [m]
    [[nodiscard]] double* origin(int axis) {
        return origins_.data() + static_cast<std::ptrdiff_t>(axis) * stride_;
    }

    /// The pairs of kWidestVector lanes, among them this one.
    [[nodiscard]] NearPairs& pairsOf(int lane) { return pairs_[lane / kWidestVector]; }

    [[nodiscard]] base::Pose poseInRoom(int lane) const;
    [[nodiscard]] base::Pose poseInTrack(int lane) const;

    // The kernel's own.
    AlignedVector<std::uint32_t> phase,
        cycle;  // of the drive at the step after the next, per step: [turn / 2^32]
    std::vector<const PackedTrack*> track;
    std::vector<trial::ContactParameters> law;  // of the part with its track
    std::vector<NearPair> collected;
    FloatRows piecesInTrack;  // PieceRow, of the part whose pairs are being collected
    StagedContacts staged;
    /// Room for the numbers of so many rows.
    [[nodiscard]] int* rowsToLookAt(int rows) {
        if (static_cast<int>(rows_.size()) <= rows) rows_.resize(2 * rows + 1);
        return rows_.data();
    }
    std::vector<WarmStartCache> warmStarts;
    std::vector<ContactList> found;     // of each lane
    LanesByContacts carrying;           // that wait to be solved
    LanesByContacts unfinished;         // that wait for the second round
    std::vector<std::int32_t> waiting;  // the same, one after the other
    std::vector<std::uint8_t> plastic;  // whether the impacts of the lane create energy
    std::vector<std::uint8_t> smooth;   // whether its friction bursts
    std::vector<std::uint8_t> touched;  // whether other parts touch it: its contacts are found, all within
                                        // reach, but not solved for
    SolveBatch solveBatch;
    int moment = 0;                                    // of impacts in the present step
    trial::CostLaps* laps = nullptr;                   // if the costs are to be told apart
    std::vector<RecordedImpulse>* recorded = nullptr;  // if they are wanted

 private:
    const LaneModel* model_;
    int stride_;
    int count_ = 0;
    AlignedVector<float> floats_;
    AlignedVector<double> positions_;
    AlignedVector<double> origins_;
    std::vector<NearPairs> pairs_;
    std::vector<int> rows_;
};

/// Where the part of a lane is at the begin of a step whose first half is made.
trial::PartState describeState(const TrialLanes& group, int lane, const trial::TerminationMonitor& progress,
                               std::size_t part);

/// Presses the contacts of a lane on a rough track each its grain's way.
void roughen(TrialLanes& group, int lane);

/// More contacts than this are looked through for those that say the same.
inline constexpr std::size_t kFew = 3;
/// Leaves at most WarmStartCache::kMost contacts that stand for all (contact::reduceManifold).
void reduceContacts(ContactList& found);

}  // namespace trapwright::native
