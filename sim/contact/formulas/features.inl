// Which features of part and track touch. All in one frame, the part's. `Real` runs over features of the
// part, the track's are the same in all lanes. See README.md of this folder: included inside a namespace that
// defines Real.

/// Overlaps deeper than this are not contacts: the part is elsewhere. [m]
constexpr double kDeepest = 0.5e-3;
/// Slack of the normal cones: sine of the angle by which a face may lean on an edge and still be held at both
/// ends.
constexpr double kConeSlack = 0.05;
/// Edges nearer to parallel than this have no contact of their own: their ends do. (square of the sine)
constexpr double kParallel = 0.026 * 0.026;

/// How near to where it ends a triangle (at ridges), a part's edge or a face does not act: what is there
/// does. Parts slide over ridges as low as these are, but for what is rounded, and the flank of each would
/// push them on. A face as deep as this acts up to its border. [m]
constexpr double kBorder = 5e-6;
/// Less than this is no way. [m]
constexpr double kLeastApproach = 1e-9;

/// normal . p + offset is how far p is beyond a plane.
struct Plane {
    Triple normal;
    Real offset;
};

inline Real distanceBeyond(const Plane& plane, const Triple& p) {
    return mulAdd(plane.normal.z, p.z,
                  mulAdd(plane.normal.y, p.y, mulAdd(plane.normal.x, p.x, plane.offset)));
}

/// A part's vertex and a track triangle.
struct VertexTest {
    Real gap;        // above the triangle's plane
    Real beside[3];  // beyond the triangle's sides
    Real clear;      // the part may travel this far before they can touch
};

/// sides: the planes of the triangle's sides, normals out of the triangle.
inline VertexTest testVertex(const Triple& vertex, const Plane& plane, const Plane (&sides)[3]) {
    VertexTest test;
    test.gap = distanceBeyond(plane, vertex);
    for (int c = 0; c < 3; ++c)
        test.beside[c] = distanceBeyond(sides[c], vertex);
    const Real beside = max(max(test.beside[0], test.beside[1]), test.beside[2]);
    test.clear = max(max(test.gap, -test.gap - Real(kDeepest)), beside);
    return test;
}

/// Whether a vertex meets the triangle that it was tested with, which goes `way` in the coming step if
/// nothing holds it. It is enough that it is within the triangle's sides now or where it comes to the plane;
/// at ridges it must be there: what slides level over a ridge comes to the plane of the flank behind it above
/// that ridge, not on the flank. ridges: how far beyond its sides a vertex is taken to be now, 0 or, at
/// ridges, very far.
inline Mask meetsTriangle(const VertexTest& test, const Triple& way, const Plane& plane,
                          const Plane (&sides)[3], const Real (&ridges)[3]) {
    const Real approach = -dot(plane.normal, way);
    const Real share = min(max(test.gap, Real(0.0)) / max(approach, Real(kLeastApproach)), Real(1.0));
    const Triple until = select(approach > Real(0.0), share, Real(0.0)) * way;
    Real beside = -Real(kDeepest);
    for (int c = 0; c < 3; ++c)
        beside = max(beside, min(test.beside[c] + ridges[c], test.beside[c] + dot(sides[c].normal, until)));
    return beside <= Real(0.0) && test.gap > Real(-kDeepest);
}

/// An edge with the directions from it into its two faces, unit, in their planes.
struct Edge {
    Triple from, direction;
    Real length;
    Triple into[2];
};

/// A part's edge and a strictly convex one of the track.
struct EdgeTest {
    Real gap;
    Triple normal;   // unit, track -> part
    Real alongPart;  // from the part's edge's begin to the point
    Mask touching;
};

/// outward: the mean normal of the track's edge.
inline EdgeTest testEdges(const Edge& part, const Edge& track, const Triple& outward, Real margin) {
    EdgeTest test;
    const Triple axis = cross(track.direction, part.direction);
    const Real sine2 = dot(axis, axis);
    const Mask parallel = sine2 < Real(kParallel);
    const Real inverse = Real(1.0) / max(sine2, Real(kParallel));
    const Real size = sqrt(inverse);
    const Real scale = select(dot(axis, outward) < Real(0.0), -size, size);
    const Triple between = part.from - track.from;
    test.normal = scale * axis;
    test.gap = dot(test.normal, between);
    // The nearest points must lie within both edges ...
    const Real alongTrack = dot(cross(between, part.direction), axis) * inverse;
    test.alongPart = dot(cross(between, track.direction), axis) * inverse;
    const Mask within = alongTrack >= Real(0.0) && alongTrack <= track.length &&
                        test.alongPart >= Real(0.0) && test.alongPart <= part.length;
    // ... and the normal in both edges' cones: the track below it, the part above.
    const Real trackCone = max(dot(test.normal, track.into[0]), dot(test.normal, track.into[1]));
    const Real partCone = min(dot(test.normal, part.into[0]), dot(test.normal, part.into[1]));
    test.touching = !parallel && test.gap < margin && test.gap > Real(-kDeepest) && within &&
                    trackCone <= Real(kConeSlack) && partCone >= Real(-kConeSlack);
    return test;
}

/// From `from` along a unit vector. [m]
struct Segment {
    Triple from, direction;
    Real length;
};

/// From the point of `b` that is nearest to `a` to the nearest point of `a` (Ericson 2005, section 5.1.9).
inline Triple findBetween(const Segment& a, const Segment& b) {
    const Triple apart = a.from - b.from;
    const Real turn = dot(a.direction, b.direction);
    const Real onA = dot(a.direction, apart);
    const Real onB = dot(b.direction, apart);
    const Real sine2 = Real(1.0) - turn * turn;
    const auto within = [](Real along, Real length) { return min(max(along, Real(0.0)), length); };
    const Real first = select(sine2 > Real(1e-6), (turn * onB - onA) / max(sine2, Real(1e-6)), Real(0.0));
    const Real alongB = within(turn * within(first, a.length) + onB, b.length);
    const Real alongA = within(turn * alongB - onA, a.length);
    return mulAdd(alongA, a.direction, apart) - alongB * b.direction;
}

/// How far a segment is beyond a face of the part. The largest over all faces is a lower bound of its
/// distance.
inline Real calcSeparation(const Plane& face, const Triple& a, const Triple& b) {
    return min(dot(face.normal, a), dot(face.normal, b)) + face.offset;
}
