// Whether one feature of a track touches one part: whole vectors of the part's features. Included once per
// instruction set, inside HWY_NAMESPACE. The tests themselves are sim/contact/formulas/features.inl.

/// Added to what a part can travel in a step, so that contacts are there before they carry. [m]
constexpr float kMargin = 5e-6F;
/// Of a candidate that is not there. [m]
constexpr float kNever = 1e6F;

enum Kind : std::uint32_t { kVertexOnTriangle, kEdgeAcrossEdge, kFaceOnVertex };

constexpr unsigned kPieceShift = 20;
constexpr unsigned kKindShift = 30;

constexpr std::uint64_t nameContact(std::uint32_t candidate, int bodyFeature) {
    return (std::uint64_t{candidate} << 32U) | static_cast<std::uint64_t>(bodyFeature);
}

/// One part in its track's frame.
struct Placed {
    const PackedTrack* track;
    alignas(16) float axes[3][4];  // rows of the rotation part -> track
    double position[3];            // [m]
    float margin;
    ContactList* found;
};

inline Placed place(TrialLanes& group, int lane) {
    Placed placed;
    placed.track = group.track[lane];
    placed.margin = 1.1F * (group.field(kStepPath)[lane] + group.field(kStepTurned)[lane]) + kMargin;
    placed.found = &group.found;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
            placed.axes[i][k] = group.field(kAxes + 3 * i + k)[lane];
        placed.axes[i][3] = 0.0F;
        placed.position[i] = group.position(i)[lane];
    }
    placed.position[0] -= group.field(kShiftX)[lane];
    placed.position[2] -= group.field(kShiftZ)[lane];
    if (group.model().anyBowl) {
        // Back by the track's rotation.
        const float sine = group.field(kSine)[lane];
        const float less = group.field(kCosineLess)[lane];
        const double x = placed.position[0];
        const double y = placed.position[1];
        placed.position[0] += less * x + sine * y;
        placed.position[1] += less * y - sine * x;
        for (int k = 0; k < 3; ++k) {
            const float ax = placed.axes[0][k];
            const float ay = placed.axes[1][k];
            placed.axes[0][k] += less * ax + sine * ay;
            placed.axes[1][k] += less * ay - sine * ax;
        }
    }
    return placed;
}

inline float dotThree(const float* a, const float* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A vector of the track's frame in the part's, into four floats.
inline void toPart(const Placed& placed, const float* v, float* result) {
    Four sum = fourTimes(0.0F);
    for (int k = 0; k < 3; ++k)
        sum = mulAdd(fourTimes(v[k]), loadFour(placed.axes[k]), sum);
    store(sum, result);
}

inline Triple broadcast(const float* v) {
    return {v[0], v[1], v[2]};
}

inline void toTrack(const Placed& placed, const float* v, float* result) {
    for (int i = 0; i < 3; ++i)
        result[i] = dotThree(placed.axes[i], v);
}

inline Triple loadThree(const FloatRows& rows, int row, int column) {
    return {load(rows.row(row) + column), load(rows.row(row + 1) + column), load(rows.row(row + 2) + column)};
}

/// Adds a contact if it `counts`: written in any case, for a processor cannot guess which do.
inline void addContact(const Placed& placed, const float* pointInPart, const float* normalInTrack, float gap,
                       std::uint64_t name, bool counts) {
    Contact& contact = placed.found->next();
    toTrack(placed, pointInPart, contact.arm);
    for (int k = 0; k < 3; ++k)
        contact.normal[k] = normalInTrack[k];
    contact.gap = gap;
    contact.feature = name;
    placed.found->keepIf(counts);
}

/// A lower bound of the distance of a pair of features, and the direction in which the part moves away, in
/// the track's axes; blind: none is known.
struct Bound {
    float distance;
    float direction[3];
    bool blind;
};

inline Bound boundAlong(float distance, const float* direction) {
    return {distance, {direction[0], direction[1], direction[2]}, false};
}
inline Bound boundBlindly(float distance) {
    return {distance, {0.0F, 0.0F, 0.0F}, true};
}

/// Each test adds the contact if there is one.
inline Bound testTriangle(const Placed& placed, const PackedPiece& piece, std::uint32_t name, int index) {
    const PackedTriangle& triangle = placed.track->triangles[index];
    // Four planes at once into the part's frame.
    const Four inTrack[3] = {loadFour(triangle.nx), loadFour(triangle.ny), loadFour(triangle.nz)};
    alignas(16) float normals[3][4];
    alignas(16) float offsets[4];
    Four offset = loadFour(triangle.offset);
    for (int k = 0; k < 3; ++k) {
        const auto away = static_cast<float>(placed.position[k] - triangle.corner[k]);
        offset = mulAdd(inTrack[k], fourTimes(away), offset);
        Four turned = fourTimes(0.0F);
        for (int i = 0; i < 3; ++i)
            turned = mulAdd(inTrack[i], fourTimes(placed.axes[i][k]), turned);
        store(turned, normals[k]);
    }
    store(offset, offsets);

    const auto boundBy = [&](float distance, int plane) {
        const float direction[3] = {triangle.nx[plane], triangle.ny[plane], triangle.nz[plane]};
        return boundAlong(distance, direction);
    };
    if (piece.vertices.stride() > kWidestVector) {
        // The piece's ball first.
        alignas(16) float centre[4];
        for (int k = 0; k < 3; ++k)
            offset = mulAdd(loadFour(normals[k]), fourTimes(piece.centre[k]), offset);
        store(offset, centre);
        for (int c = 0; c < 4; ++c) {
            if (centre[c] - piece.radius >= placed.margin) return boundBy(centre[c] - piece.radius, c);
        }
    }

    Plane planes[4];
    for (int c = 0; c < 4; ++c)
        planes[c] = {{normals[0][c], normals[1][c], normals[2][c]}, offsets[c]};
    const Plane sides[3] = {planes[1], planes[2], planes[3]};
    const float inPart[3] = {normals[0][0], normals[1][0], normals[2][0]};
    const float normal[3] = {triangle.nx[0], triangle.ny[0], triangle.nz[0]};
    Real nearest = kNever;
    Real lowest[4] = {kNever, kNever, kNever, kNever};
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int first = 0; first < piece.vertexCount; first += width) {
        const VertexTest test =
            testVertex(loadThree(piece.vertices, 0, first), planes[0], sides, placed.margin);
        nearest = min(nearest, test.clear);
        lowest[0] = min(lowest[0], test.gap);
        for (int c = 0; c < 3; ++c)
            lowest[1 + c] = min(lowest[1 + c], test.beside[c]);
        std::uint32_t bits = bitsOf(test.over);
        if (bits == 0) continue;
        placed.found->reserve(kWidestVector);
        alignas(64) float gaps[kWidestVector];
        store(test.gap, gaps);
        for (; bits != 0; bits &= bits - 1) {
            const int i = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
            const int vertex = first + i;
            if (vertex >= piece.vertexCount) break;
            // The part must lie above the plane: otherwise the vertex passes by (along the border of the face
            // that the part lies on) or touches the other flank of a thin wall.
            float least = kNever;
            for (int e = piece.firstEdge[vertex]; e < piece.firstEdge[vertex + 1]; ++e)
                least = std::min(least, dotThree(inPart, piece.vertexEdges.data() + 3 * e));
            const float point[3] = {piece.vertices.row(0)[vertex], piece.vertices.row(1)[vertex],
                                    piece.vertices.row(2)[vertex]};
            addContact(placed, point, normal, gaps[i], nameContact(name, vertex),
                       least >= static_cast<float>(-kConeSlack));
        }
    }
    const float low = leastOf(lowest[0]);
    if (low >= placed.margin) return boundBy(low, 0);
    for (int c = 1; c < 4; ++c) {
        const float beside = leastOf(lowest[c]);
        if (beside >= placed.margin) return boundBy(beside, c);
    }
    const float clear = leastOf(nearest);
    return clear >= placed.margin ? boundBlindly(clear) : boundBy(low, 0);
}

/// The largest separation over all faces, and the face.
inline float findSeparation(const PackedPiece& piece, const Triple& a, const Triple& b, int* face) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    float best = -kNever;
    for (int first = 0; first < piece.faces.stride(); first += width) {
        const Plane plane = {loadThree(piece.faces, 0, first), load(piece.faces.row(3) + first)};
        const Real separation = calcSeparation(plane, a, b);
        const float greatest = greatestOf(separation);
        if (greatest <= best) continue;
        best = greatest;
        if (face != nullptr)
            *face = first + static_cast<int>(
                                hwy::Num0BitsBelowLS1Bit_Nonzero32(bitsOf(separation >= Real(greatest))));
    }
    return best;
}

/// Against a face's normal, in the track's axes.
inline void awayFromFace(const Placed& placed, const PackedPiece& piece, int face, float* result) {
    const float inPart[3] = {-piece.faces.row(0)[face], -piece.faces.row(1)[face], -piece.faces.row(2)[face]};
    toTrack(placed, inPart, result);
}

inline float calcDistanceToSegment(const float* point, const float* from, const float* direction,
                                   float length) {
    const float between[3] = {point[0] - from[0], point[1] - from[1], point[2] - from[2]};
    const float along = std::min(std::max(dotThree(direction, between), 0.0F), length);
    float square = 0.0F;
    for (int k = 0; k < 3; ++k) {
        const float d = between[k] - along * direction[k];
        square += d * d;
    }
    return std::sqrt(square);
}

/// A bound for an edge that is near but does not touch: whether the part lies on one side of one of three
/// planes through it. `fallback` if not.
inline Bound separateFromEdge(const Placed& placed, const PackedPiece& piece, const PackedEdge& edge,
                              const Edge& own, const Triple& outside, const Bound& fallback) {
    const Triple axes[3] = {outside, own.into[0], own.into[1]};
    const float* inTrack[3] = {edge.outward, edge.into[0], edge.into[1]};
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int a = 0; a < 3; ++a) {
        Real least = kNever;
        Real greatest = -kNever;
        for (int first = 0; first < piece.vertexCount; first += width) {
            const Real distance = dot(axes[a], loadThree(piece.vertices, 0, first) - own.from);
            least = min(least, distance);
            greatest = max(greatest, distance);
        }
        const float above = leastOf(least);
        if (above >= placed.margin) return boundAlong(above, inTrack[a]);
        const float below = -greatestOf(greatest);
        if (below >= placed.margin) {
            const float away[3] = {-inTrack[a][0], -inTrack[a][1], -inTrack[a][2]};
            return boundAlong(below, away);
        }
    }
    return fallback;
}

inline Bound testEdge(const Placed& placed, const PackedPiece& piece, std::uint32_t name, int index) {
    const PackedEdge& edge = placed.track->edges[index];
    float relative[3];
    for (int k = 0; k < 3; ++k)
        relative[k] = static_cast<float>(edge.from[k] - placed.position[k]);
    alignas(16) float from[4];
    alignas(16) float direction[4];
    toPart(placed, relative, from);
    toPart(placed, edge.direction, direction);
    const float ball = calcDistanceToSegment(piece.centre, from, direction, edge.length) - piece.radius;
    if (ball >= placed.margin) return boundBlindly(ball);
    const Triple begin = broadcast(from);
    const Triple along = broadcast(direction);
    int face = 0;
    const float apart = findSeparation(piece, begin, mulAdd(edge.length, along, begin), &face);
    float away[3];
    awayFromFace(placed, piece, face, away);
    const Bound bound = boundAlong(apart, away);
    if (apart >= placed.margin) return bound;

    alignas(16) float outward[4];
    alignas(16) float into[2][4];
    toPart(placed, edge.outward, outward);
    toPart(placed, edge.into[0], into[0]);
    toPart(placed, edge.into[1], into[1]);
    const Edge own = {begin, along, edge.length, {broadcast(into[0]), broadcast(into[1])}};
    const Triple outside = broadcast(outward);
    const std::size_t before = placed.found->size();
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int first = 0; first < piece.edges.stride(); first += width) {
        const Edge part = {loadThree(piece.edges, kFromX, first),
                           loadThree(piece.edges, kDirectionX, first),
                           load(piece.edges.row(kLength) + first),
                           {loadThree(piece.edges, kInto0X, first), loadThree(piece.edges, kInto1X, first)}};
        const EdgeTest test = testEdges(part, own, outside, placed.margin);
        std::uint32_t bits = bitsOf(test.touching);
        if (bits == 0) continue;
        placed.found->reserve(kWidestVector);
        alignas(64) float values[5][kWidestVector];
        store(test.gap, values[0]);
        store(test.alongPart, values[1]);
        store(test.normal.x, values[2]);
        store(test.normal.y, values[3]);
        store(test.normal.z, values[4]);
        for (; bits != 0; bits &= bits - 1) {
            const int i = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
            float point[3];
            float normal[3];
            const float inPart[3] = {values[2][i], values[3][i], values[4][i]};
            for (int k = 0; k < 3; ++k)
                point[k] = piece.edges.row(kFromX + k)[first + i] +
                           values[1][i] * piece.edges.row(kDirectionX + k)[first + i];
            toTrack(placed, inPart, normal);
            addContact(placed, point, normal, values[0][i], nameContact(name, first + i), true);
        }
    }
    if (placed.found->size() > before) return bound;
    return separateFromEdge(placed, piece, edge, own, outside, bound);
}

inline Bound testTrackVertex(const Placed& placed, const PackedPiece& piece, std::uint32_t name, int index) {
    const PackedVertex& vertex = placed.track->vertices[index];
    float away[3];
    for (int k = 0; k < 3; ++k)
        away[k] = static_cast<float>(vertex.position[k] - placed.position[k]);
    alignas(16) float point[4];
    toPart(placed, away, point);
    int face = 0;
    const Triple p = broadcast(point);
    const float gap = findSeparation(piece, p, p, &face);
    const float deepest = static_cast<float>(kDeepest);
    if (gap <= -deepest) return boundBlindly(-gap - deepest);
    float normal[3];
    awayFromFace(placed, piece, face, normal);
    if (gap >= placed.margin) return boundAlong(gap, normal);
    // The track must lie below the face: a part that slides level over a border is not stopped by it.
    placed.found->reserve(1);
    float highest = -kNever;
    for (int e = 0; e < vertex.edgeCount; ++e)
        highest = std::max(highest,
                           dotThree(normal, placed.track->vertexEdges.data() + 3 * (vertex.firstEdge + e)));
    addContact(placed, point, normal, gap, nameContact(name, face),
               highest <= static_cast<float>(kConeSlack));
    return boundAlong(gap, normal);
}
