#include "core/geometry/self_overlap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <vector>

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct Candidate {
    std::array<Point, 3> corners;
    Box box;
};

/// The corners of a and b that coincide, as pairs of corner numbers.
struct CommonCorners {
    int count = 0;
    std::array<int, 3> inA{};
    std::array<int, 3> inB{};
};

CommonCorners findCommonCorners(const Candidate& a, const Candidate& b) {
    CommonCorners common;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a.corners[i] == b.corners[j]) {
                common.inA[common.count] = i;
                common.inB[common.count] = j;
                ++common.count;
            }
    return common;
}

bool doOverlap(const Candidate& a, const Candidate& b) {
    const CommonCorners common = findCommonCorners(a, b);
    const Kernel::Triangle_3 triangleA(a.corners[0], a.corners[1], a.corners[2]);
    const Kernel::Triangle_3 triangleB(b.corners[0], b.corners[1], b.corners[2]);
    switch (common.count) {
        case 0:
            return CGAL::do_intersect(triangleA, triangleB);
        case 1: {
            // They meet beyond the common corner exactly if the opposite edge of one meets the other.
            const int i = common.inA[0];
            const int j = common.inB[0];
            return CGAL::do_intersect(Kernel::Segment_3(a.corners[(i + 1) % 3], a.corners[(i + 2) % 3]),
                                      triangleB) ||
                   CGAL::do_intersect(Kernel::Segment_3(b.corners[(j + 1) % 3], b.corners[(j + 2) % 3]),
                                      triangleA);
        }
        case 2: {
            const Point& p = a.corners[common.inA[0]];
            const Point& q = a.corners[common.inA[1]];
            const Point& apexA = a.corners[3 - common.inA[0] - common.inA[1]];
            const Point& apexB = b.corners[3 - common.inB[0] - common.inB[1]];
            return CGAL::coplanar(p, q, apexA, apexB) &&
                   CGAL::coplanar_orientation(p, q, apexA, apexB) == CGAL::POSITIVE;
        }
        default:
            return true;
    }
}

bool doOverlap(const Box& a, const Box& b) {
    return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// The triangles with area, in the order in which a sweep along x, the direction in which tracks are long,
/// meets them.
std::vector<Candidate> collectCandidates(const TriangleMesh& mesh, std::size_t triangles) {
    std::vector<Candidate> candidates;
    candidates.reserve(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        Candidate candidate;
        for (int k = 0; k < 3; ++k) {
            const base::Vec3& v = mesh.vertices[mesh.triangles[i][k]];
            candidate.corners[k] = Point(v.x(), v.y(), v.z());
            candidate.box.include(v);
        }
        if (!CGAL::collinear(candidate.corners[0], candidate.corners[1], candidate.corners[2]))
            candidates.push_back(candidate);
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.box.low.x() < b.box.low.x(); });
    return candidates;
}

}  // namespace

int countOverlappingTriangles(const TriangleMesh& mesh, std::size_t firstTriangles) {
    assert(firstTriangles <= mesh.triangles.size());
    const std::vector<Candidate> candidates = collectCandidates(mesh, firstTriangles);
    std::vector<char> overlapping(candidates.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i)
        for (std::size_t j = i + 1; j < candidates.size(); ++j) {
            if (candidates[j].box.low.x() > candidates[i].box.high.x()) break;
            if (overlapping[i] != 0 && overlapping[j] != 0) continue;
            if (!doOverlap(candidates[i].box, candidates[j].box) || !doOverlap(candidates[i], candidates[j]))
                continue;
            overlapping[i] = 1;
            overlapping[j] = 1;
        }
    return std::accumulate(overlapping.begin(), overlapping.end(), 0);
}

std::optional<base::Vec3> findOverlap(const TriangleMesh& mesh) {
    const std::vector<Candidate> candidates = collectCandidates(mesh, mesh.triangles.size());
    for (std::size_t i = 0; i < candidates.size(); ++i)
        for (std::size_t j = i + 1; j < candidates.size(); ++j) {
            if (candidates[j].box.low.x() > candidates[i].box.high.x()) break;
            if (!doOverlap(candidates[i].box, candidates[j].box) || !doOverlap(candidates[i], candidates[j]))
                continue;
            const Kernel::Point_3 middle =
                CGAL::centroid(candidates[i].corners[0], candidates[i].corners[1], candidates[i].corners[2]);
            return base::Vec3(middle.x(), middle.y(), middle.z());
        }
    return std::nullopt;
}

}  // namespace trapwright::geometry
