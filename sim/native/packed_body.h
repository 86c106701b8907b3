#pragma once

#include <vector>

#include "sim/contact/contact_body.h"
#include "sim/native/aligned.h"

namespace trapwright::native {

/// Rows of floats, all equally long and padded to whole vectors.
class FloatRows {
 public:
    FloatRows() = default;
    FloatRows(int rows, int count)
        : stride_(padToVectors(count)), values_(static_cast<std::size_t>(rows * stride_)) {}

    [[nodiscard]] float* row(int r) { return values_.data() + static_cast<std::ptrdiff_t>(r) * stride_; }
    [[nodiscard]] const float* row(int r) const {
        return values_.data() + static_cast<std::ptrdiff_t>(r) * stride_;
    }
    [[nodiscard]] int stride() const { return stride_; }

 private:
    int stride_ = 0;
    AlignedVector<float> values_;
};

/// Rows of PackedPiece::edges.
enum EdgeRow : int {
    kFromX,
    kFromY,
    kFromZ,
    kDirectionX,
    kDirectionY,
    kDirectionZ,
    kLength,
    kInto0X,
    kInto0Y,
    kInto0Z,
    kInto1X,
    kInto1Y,
    kInto1Z,
    kEdgeRows
};

/// One convex piece of a part, features side by side. Padding is such that it never touches anything. [m]
struct PackedPiece {
    float centre[3];
    float radius;
    int vertexCount;
    FloatRows vertices;              // x, y, z
    FloatRows edges;                 // EdgeRow
    FloatRows faces;                 // normal x, y, z, offset: normal . p + offset is how far p is beyond
    std::vector<int> firstEdge;      // of each vertex, in vertexEdges; one more than there are vertices
    std::vector<float> vertexEdges;  // directions away from the vertex, three each
};

/// contact::ContactBody as the kernel reads it.
struct PackedBody {
    explicit PackedBody(const contact::ContactBody& body);

    std::vector<PackedPiece> pieces;
    float radius;  // of a ball around the origin [m]
};

}  // namespace trapwright::native
