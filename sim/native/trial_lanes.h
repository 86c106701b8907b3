#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/part/part.h"
#include "core/trial/batch.h"
#include "core/trial/costs.h"
#include "sim/contact/impulse_solver.h"
#include "sim/native/aligned.h"
#include "sim/native/packed_body.h"
#include "sim/native/packed_track.h"

namespace trapwright::native {

/// What is the same for all trials of a group. Inertias per mass, in part axes.
struct LaneModel {
    LaneModel(const part::Part& part, const PackedBody& packedBody, double gravityValue, double stepTime,
              bool bowl);

    const PackedBody* body;
    double step;                 // of time [s]
    float dt;                    // the same
    float gravity;               // [m/s^2]
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

    // Detection [m]: since the candidates were collected ...
    kWayX, kWayY, kWayZ,                             // way of the centre in the track's axes
    kPath,                                           // length of the centre's path
    kTurned,                                         // the farthest that any point can have come by turning
    // ... and what the coming step adds if nothing touches
    kStepX, kStepY, kStepZ, kStepPath, kStepTurned,
    kNextLook,                                       // path + turned before which nothing can touch

    kStaticFriction, kKineticFriction, kRestitution,
    kFieldCount
};
// clang-format on

/// The features of one track that are near one part. A lower bound of the distance between part and feature
/// is start + normal . way - turned - (path if `blind`): tells without looking at them which can touch.
struct Candidates {
    AlignedVector<float> start, normalX, normalY, normalZ, blind;  // padded with a huge start
    std::vector<std::uint32_t> names;                              // kind, piece, feature of the track
    int count = 0;
    float collectAt = 0.0F;  // path + turned at which they must be collected anew
};

/// Impulses that the last step left at the contacts of one part.
struct WarmStartCache {
    static constexpr int kMost = contact::ImpulseSolver::kMaxContacts;
    int count = 0;
    int carrying = 0;  // with an impulse
    std::uint64_t feature[kMost];
    float normal[kMost];
    float along[kMost], across[kMost];
    bool slid[kMost];
};

/// A contact of one part in its track's axes.
struct Contact {
    float arm[3];     // from the centre of mass [m]
    float normal[3];  // unit, track -> part
    float gap;        // [m]
    std::uint64_t feature;
};

/// What a contact of the last step gave the part in lane 0, per mass.
struct RecordedImpulse {
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
    void shrink(std::size_t size) { size_ = size; }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    Contact& operator[](std::size_t i) { return contacts_[i]; }
    const Contact& operator[](std::size_t i) const { return contacts_[i]; }

 private:
    std::vector<Contact> contacts_;
    std::size_t size_ = 0;
};

/// What a row of contacts is made of, one float per slot of a SolveBatch.
enum ContactField : int {
    kArmX,
    kArmY,
    kArmZ,
    kNormalX,
    kNormalY,
    kNormalZ,
    kGap,
    kNormalImpulse,
    kAlongImpulse,
    kAcrossImpulse,
    kState,  // 0: new, 1: known and stuck, 2: known and slid
    kContactFields
};

/// Lanes with about equally many contacts, waiting to be solved together.
struct SolveBatch {
    int rows = 0;  // at most as many contacts
    int filled = 0;
    std::array<std::int32_t, kWidestVector> lanes{};
    AlignedVector<float> touches;  // [row][ContactField][slot]

    [[nodiscard]] float* touch(int row, int field) {
        return touches.data() + static_cast<std::ptrdiff_t>(row * kContactFields + field) * kWidestVector;
    }
};

/// Trials that run side by side, one in each lane: a structure of arrays. Lanes know nothing of each other.
class TrialLanes {
 public:
    TrialLanes(const LaneModel& model, int capacity);

    /// Begins a trial in the next free lane.
    void add(const PackedTrack& track, const trial::TrialBatch& batch, const trial::TrialSpec& spec);
    /// Ends the trial of a lane; the last lane moves there.
    void remove(int lane);

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

    [[nodiscard]] base::Pose poseInRoom(int lane) const;
    [[nodiscard]] base::Pose poseInTrack(int lane) const;

    // The kernel's own.
    AlignedVector<std::uint32_t> phase,
        cycle;  // of the drive at the step after the next, per step: [turn / 2^32]
    std::vector<const PackedTrack*> track;
    std::vector<Candidates> candidates;
    std::vector<WarmStartCache> warmStarts;
    std::vector<SolveBatch> solveBatches;
    ContactList found;
    trial::CostLaps* laps = nullptr;                   // if the costs are to be told apart
    std::vector<RecordedImpulse>* recorded = nullptr;  // if they are wanted, of a group of one
    std::vector<std::int32_t> looking;                 // lanes that may have contacts in this step

 private:
    const LaneModel* model_;
    int stride_;
    int count_ = 0;
    AlignedVector<float> floats_;
    AlignedVector<double> positions_;
};

/// More contacts than this are looked through for those that say the same.
inline constexpr std::size_t kFew = 3;
/// Leaves at most WarmStartCache::kMost contacts that stand for all (contact::reduceManifold).
void reduceContacts(ContactList& found);

/// How many contacts each SolveBatch is for.
inline constexpr std::array<int, 7> kSolveRows = {1, 2, 3, 4, 6, 8, contact::ImpulseSolver::kMaxContacts};

}  // namespace trapwright::native
