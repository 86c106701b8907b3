#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/native/aligned.h"

namespace trapwright::native {

// clang-format off
/// Of a part's vertex near a triangle of the track.
enum VertexPairField : int {
    kVertexX, kVertexY, kVertexZ,                                // part frame [m]
    kCone, kConeLast = kCone + 8,                                // its edges away from it, if there are at most three
    kPlanes, kPlanesLast = kPlanes + 15,                         // of the triangle, of its sides: normal, offset
    kRidge0, kRidge1, kRidge2,                                   // which sides are ridges (meetsTriangle)
    kVertexPairFields
};
/// Of a part's edge near an edge of the track.
enum EdgePairField : int {
    kApartX, kApartY, kApartZ, kApartOffset,                     // a plane that the part's edge was beyond
    kOwnFromX, kOwnFromY, kOwnFromZ,                             // the part's edge, part frame, as EdgeRow
    kOwnDirectionX, kOwnDirectionY, kOwnDirectionZ, kOwnLength,
    kOwnInto0X, kOwnInto0Y, kOwnInto0Z, kOwnInto1X, kOwnInto1Y, kOwnInto1Z,
    kTrackFromX, kTrackFromY, kTrackFromZ,                       // the track's
    kTrackDirectionX, kTrackDirectionY, kTrackDirectionZ,
    kTrackInto0X, kTrackInto0Y, kTrackInto0Z, kTrackInto1X, kTrackInto1Y, kTrackInto1Z,
    kOutwardX, kOutwardY, kOutwardZ, kTrackLength,
    kEdgePairFields
};
/// Of a vertex of the track near the faces of a piece.
enum FacePairField : int {
    kPointX, kPointY, kPointZ,                                   // of the track [m]
    kFaceX, kFaceY, kFaceZ, kFaceOffset,                         // the face that it was farthest beyond, part frame
    kFaceFound, kOtherFaceFound,                                 // which face was touched last, or would be next
    kFacePairFields
};
// clang-format on

/// Edges of a vertex that a pair has at hand, from kCone on.
inline constexpr int kConeEdges = 3;
/// In NearPair::partFeature: the vertex has more.
inline constexpr std::uint32_t kManyEdges = 1U << 31U;

/// Of a pair that is not there. [m]
inline constexpr float kUntouchable = 1e6F;

/// Two features that are near each other, as they are collected.
struct NearPair {
    float distance;              // [m]
    std::uint32_t trackFeature;  // piece of the part, kind, feature
    std::uint32_t partFeature;
    std::array<float, 7>
        own;  // what neither feature has by itself: offsets of planes, a separating plane, a place
};

/// The pairs of one kind of kWidestVector lanes side by side: row r has the r-th pair of each lane, field by
/// field, so that one instruction does the same for a pair of each. Places of lanes that have fewer hold
/// pairs that never touch. What is of the track is in its axes, from where the part's centre was when the
/// pairs were collected.
class PairTable {
 public:
    /// untouchable: the field that keeps a pair from touching if it is very large.
    PairTable(int fields, int untouchable) : fields_(fields), untouchable_(untouchable) {}

    /// As many as the lane has that has most.
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] const float* field(int row, int f) const {
        return values_.data() + static_cast<std::ptrdiff_t>(row * fields_ + f) * kWidestVector;
    }
    /// What the way of the lane's part (kGone) must come to before the pair can touch.
    [[nodiscard]] float* due(int row) {
        return due_.data() + static_cast<std::ptrdiff_t>(row) * kWidestVector;
    }
    [[nodiscard]] const float* due(int row) const {
        return due_.data() + static_cast<std::ptrdiff_t>(row) * kWidestVector;
    }
    /// Of faces: kFaceFound or kOtherFaceFound, to be written.
    [[nodiscard]] float* faces(int row, FacePairField field) { return &at(row, field, 0); }
    [[nodiscard]] const std::uint32_t* trackFeature(int row) const {
        return trackFeatures_.data() + static_cast<std::ptrdiff_t>(row) * kWidestVector;
    }
    [[nodiscard]] const std::uint32_t* partFeature(int row) const {
        return partFeatures_.data() + static_cast<std::ptrdiff_t>(row) * kWidestVector;
    }

    /// Makes a lane, 0 to kWidestVector - 1, have so many pairs, which are to be written.
    void resize(int slot, int count);
    /// Begins the row's pair of a lane: all but its fields.
    void begin(int row, int slot, const NearPair& pair) {
        const int place = row * kWidestVector + slot;
        due_[place] = pair.distance;
        trackFeatures_[place] = pair.trackFeature;
        partFeatures_[place] = pair.partFeature;
    }
    [[nodiscard]] float& at(int row, int f, int slot) {
        return values_[(row * fields_ + f) * kWidestVector + slot];
    }
    void copy(int slot, const PairTable& from, int fromSlot);

 private:
    int fields_, untouchable_;
    int rows_ = 0;
    std::array<int, kWidestVector> counts_{};
    AlignedVector<float> values_, due_;
    AlignedVector<std::uint32_t> trackFeatures_, partFeatures_;
};

/// All pairs of kWidestVector lanes.
struct NearPairs {
    PairTable vertices{kVertexPairFields, kPlanes + 3};
    PairTable edges{kEdgePairFields, kApartOffset};
    PairTable faces{kFacePairFields, kFaceOffset};

    void clear(int slot);
    void copy(int slot, const NearPairs& from, int fromSlot);
};

}  // namespace trapwright::native
