// Which features of one part and its track are near each other: lane by lane, now and then. Included once per
// instruction set, inside HWY_NAMESPACE.

/// Features that are nearer than this are collected: to begin with, at least, at most. [m]
constexpr float kSkin = 2e-3F;
constexpr float kThinnest = 0.7e-3F;
constexpr float kThickest = 4e-3F;
/// A skin with more or fewer pairs becomes thinner or thicker: many cost much in each step, few are collected
/// often.
constexpr std::size_t kManyPairs = 60;
constexpr std::size_t kFewPairs = 12;

enum Kind : std::uint32_t { kVertexOnTriangle, kEdgeAcrossEdge, kFaceOnVertex };

// In the order in which contacts of one part are solved.
constexpr unsigned kPieceShift = 22;
constexpr unsigned kKindShift = 20;

/// Edges of a vertex that a pair has at hand.
constexpr int kConeEdges = 3;

constexpr std::uint32_t pieceOf(std::uint32_t trackFeature) {
    return trackFeature >> kPieceShift;
}
constexpr std::uint32_t indexOf(std::uint32_t trackFeature) {
    return trackFeature & 0xFFFFFU;
}

/// One part in its track's frame.
struct Placed {
    const PackedTrack* track;
    alignas(16) float axes[3][4];  // rows of the rotation part -> track
    double position[3];            // [m]
    float reach;                   // what is nearer than this is collected [m]
    std::vector<NearPair>* pairs;
};

inline Placed place(TrialLanes& group, int lane) {
    Placed placed;
    placed.track = group.track[static_cast<std::size_t>(lane)];
    placed.reach = group.field(kReach)[lane];
    placed.pairs = &group.collected;
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

inline void toTrack(const Placed& placed, const float* v, float* result) {
    for (int i = 0; i < 3; ++i)
        result[i] = dotThree(placed.axes[i], v);
}

inline Triple broadcast(const float* v) {
    return {v[0], v[1], v[2]};
}

inline Triple loadThree(const FloatRows& rows, int row, int column) {
    return {load(rows.row(row) + column), load(rows.row(row + 1) + column), load(rows.row(row + 2) + column)};
}

/// Calls `use` with the place of each bit that is set.
template <class Use>
inline void forEachBit(std::uint32_t bits, const Use& use) {
    for (; bits != 0; bits &= bits - 1)
        use(static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
}

inline void collectVertices(const Placed& placed, const PackedPiece& piece, std::uint32_t name) {
    const PackedTriangle& triangle = placed.track->triangles[indexOf(name)];
    // Four planes at once into the part's frame.
    const Four inTrack[3] = {loadFour(triangle.nx), loadFour(triangle.ny), loadFour(triangle.nz)};
    alignas(16) float normals[3][4];
    alignas(16) float offsets[4];  // of the centre of mass
    alignas(16) float centre[4];
    Four offset = loadFour(triangle.offset);
    for (int k = 0; k < 3; ++k)
        offset = mulAdd(inTrack[k], fourTimes(static_cast<float>(placed.position[k] - triangle.corner[k])),
                        offset);
    store(offset, offsets);
    for (int k = 0; k < 3; ++k) {
        Four turned = fourTimes(0.0F);
        for (int i = 0; i < 3; ++i)
            turned = mulAdd(inTrack[i], fourTimes(placed.axes[i][k]), turned);
        store(turned, normals[k]);
        offset = mulAdd(turned, fourTimes(piece.centre[k]), offset);
    }
    store(offset, centre);
    for (const float beyond : centre) {
        if (beyond - piece.radius >= placed.reach) return;
    }

    Plane planes[4];
    for (int c = 0; c < 4; ++c)
        planes[c] = {{normals[0][c], normals[1][c], normals[2][c]}, offsets[c]};
    const Plane sides[3] = {planes[1], planes[2], planes[3]};
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int first = 0; first < piece.vertexCount; first += width) {
        const VertexTest test =
            testVertex(loadThree(piece.vertices, 0, first), planes[0], sides, placed.reach);
        const std::uint32_t bits = bitsOf(test.clear < Real(placed.reach));
        if (bits == 0) continue;
        alignas(64) float clear[kWidestVector];
        store(test.clear, clear);
        forEachBit(bits, [&](int i) {
            const int vertex = first + i;
            if (vertex >= piece.vertexCount) return;
            const int edges = piece.firstEdge[vertex + 1] - piece.firstEdge[vertex];
            placed.pairs->push_back(
                {clear[i],
                 name,
                 static_cast<std::uint32_t>(vertex) | (edges > kConeEdges ? kManyEdges : 0U),
                 {offsets[0], offsets[1], offsets[2], offsets[3]}});
        });
    }
}

/// The largest separation over all faces, and the face.
inline float findSeparation(const PackedPiece& piece, const Triple& a, const Triple& b, int* face) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    float best = -kUntouchable;
    for (int first = 0; first < piece.faces.stride(); first += width) {
        const Plane plane = {loadThree(piece.faces, 0, first), load(piece.faces.row(3) + first)};
        const Real separation = calcSeparation(plane, a, b);
        const float greatest = greatestOf(separation);
        if (greatest <= best) continue;
        best = greatest;
        *face = first +
                static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bitsOf(separation >= Real(greatest))));
    }
    return best;
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

inline void collectEdges(const Placed& placed, const PackedPiece& piece, std::uint32_t name) {
    const PackedEdge& edge = placed.track->edges[indexOf(name)];
    float relative[3];
    for (int k = 0; k < 3; ++k)
        relative[k] = static_cast<float>(edge.from[k] - placed.position[k]);
    alignas(16) float from[4];
    alignas(16) float direction[4];
    toPart(placed, relative, from);
    toPart(placed, edge.direction, direction);
    if (calcDistanceToSegment(piece.centre, from, direction, edge.length) - piece.radius >= placed.reach)
        return;
    const Segment own = {broadcast(from), broadcast(direction), edge.length};
    int face = 0;
    if (findSeparation(piece, own.from, mulAdd(own.length, own.direction, own.from), &face) >= placed.reach)
        return;

    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int first = 0; first < piece.edges.stride(); first += width) {
        const Segment part = {loadThree(piece.edges, kFromX, first),
                              loadThree(piece.edges, kDirectionX, first),
                              load(piece.edges.row(kLength) + first)};
        const Triple between = findBetween(part, own);
        const Real distance = sqrt(dot(between, between));
        const std::uint32_t bits = bitsOf(distance < Real(placed.reach) && part.length > Real(0.0));
        if (bits == 0) continue;
        alignas(64) float distances[kWidestVector];
        alignas(64) float away[3][kWidestVector];
        store(distance, distances);
        store(between.x, away[0]);
        store(between.y, away[1]);
        store(between.z, away[2]);
        forEachBit(bits, [&](int i) {
            // Across the nearest points, the two lie on either side of a plane; not where they went through
            // each other.
            const float inPart[3] = {away[0][i], away[1][i], away[2][i]};
            float apart[3];
            toTrack(placed, inPart, apart);
            const float size = std::sqrt(dotThree(apart, apart));
            const bool through = dotThree(apart, edge.outward) < 0.0F && size < static_cast<float>(kDeepest);
            const float scale = through || size < 1e-9F ? 0.0F : 1.0F / size;
            for (float& component : apart)
                component *= scale;
            const float begin = dotThree(apart, relative);
            const float end = begin + edge.length * dotThree(apart, edge.direction);
            const float offset = scale > 0.0F ? -std::max(begin, end) : -kUntouchable;
            placed.pairs->push_back(
                {scale > 0.0F ? distances[i] : -kUntouchable,
                 name,
                 static_cast<std::uint32_t>(first + i),
                 {apart[0], apart[1], apart[2], offset, relative[0], relative[1], relative[2]}});
        });
    }
}

inline void collectFaces(const Placed& placed, const PackedPiece& piece, std::uint32_t name) {
    const PackedVertex& vertex = placed.track->vertices[indexOf(name)];
    float relative[3];
    for (int k = 0; k < 3; ++k)
        relative[k] = static_cast<float>(vertex.position[k] - placed.position[k]);
    alignas(16) float point[4];
    toPart(placed, relative, point);
    int face = 0;
    const Triple p = broadcast(point);
    const float gap = findSeparation(piece, p, p, &face);
    if (gap >= placed.reach || gap <= -placed.reach - static_cast<float>(kDeepest)) return;
    const auto row = [&](int r) { return piece.faces.row(r)[face]; };
    placed.pairs->push_back(
        {gap, name, 0, {relative[0], relative[1], relative[2], row(0), row(1), row(2), row(3)}});
}

/// Whether a piece has anything to touch these features of the track with.
inline bool hasFeatures(const PackedPiece& piece, Kind kind) {
    return kind == kVertexOnTriangle ? piece.vertexCount > 0
                                     : kind == kFaceOnVertex || piece.edges.stride() > 0;
}

/// Calls `collect` with the names of the features among `balls` that are near one piece.
template <class Collect>
inline void collectAmong(const Placed& placed, const BallArrays& balls, Kind kind, const Collect& collect,
                         const std::vector<PackedPiece>& pieces) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (!hasFeatures(pieces[p], kind)) continue;
        float centre[3];
        toTrack(placed, pieces[p].centre, centre);
        for (int k = 0; k < 3; ++k)
            centre[k] = static_cast<float>(placed.position[k] + centre[k]);
        const Real near = pieces[p].radius + placed.reach;
        const std::uint32_t name = (kind << kKindShift) | (static_cast<std::uint32_t>(p) << kPieceShift);
        for (int first = 0; first < balls.count; first += width) {
            const Triple away = Triple{load(balls.x.data() + first), load(balls.y.data() + first),
                                       load(balls.z.data() + first)} -
                                broadcast(centre);
            const Real far = load(balls.radius.data() + first) + near;
            forEachBit(bitsOf(dot(away, away) < far * far), [&](int i) {
                collect(placed, pieces[p], name | static_cast<std::uint32_t>(first + i));
            });
        }
    }
}

/// Writes one of these pairs into a table's row.
inline void writeVertexPair(const PackedPiece& piece, const PackedTrack& track, const NearPair& pair,
                            PairTable& table, int row, int slot) {
    const PackedTriangle& triangle = track.triangles[indexOf(pair.trackFeature)];
    const auto vertex = static_cast<int>(pair.partFeature & ~kManyEdges);
    for (int k = 0; k < 3; ++k)
        table.at(row, kVertexX + k, slot) = piece.vertices.row(k)[vertex];
    const int first = piece.firstEdge[vertex];
    const int edges = piece.firstEdge[vertex + 1] - first;
    for (int e = 0; e < kConeEdges; ++e) {
        for (int k = 0; k < 3; ++k)
            table.at(row, kCone + 3 * e + k, slot) =
                edges > kConeEdges ? 0.0F : piece.vertexEdges[3 * (first + std::min(e, edges - 1)) + k];
    }
    for (int c = 0; c < 4; ++c) {
        table.at(row, kPlanes + 4 * c, slot) = triangle.nx[c];
        table.at(row, kPlanes + 4 * c + 1, slot) = triangle.ny[c];
        table.at(row, kPlanes + 4 * c + 2, slot) = triangle.nz[c];
        table.at(row, kPlanes + 4 * c + 3, slot) = pair.own[static_cast<std::size_t>(c)];
    }
}
inline void writeEdgePair(const PackedPiece& piece, const PackedTrack& track, const NearPair& pair,
                          PairTable& table, int row, int slot) {
    const PackedEdge& edge = track.edges[indexOf(pair.trackFeature)];
    const auto set = [&](int f, float value) { table.at(row, f, slot) = value; };
    for (int k = 0; k < 4; ++k)
        set(kApartX + k, pair.own[static_cast<std::size_t>(k)]);
    for (int k = 0; k < 3; ++k) {
        set(kOwnFromX + k, piece.edges.row(kFromX + k)[pair.partFeature]);
        set(kOwnDirectionX + k, piece.edges.row(kDirectionX + k)[pair.partFeature]);
        set(kOwnInto0X + k, piece.edges.row(kInto0X + k)[pair.partFeature]);
        set(kOwnInto1X + k, piece.edges.row(kInto1X + k)[pair.partFeature]);
        set(kTrackFromX + k, pair.own[4 + k]);
        set(kTrackDirectionX + k, edge.direction[k]);
        set(kTrackInto0X + k, edge.into[0][k]);
        set(kTrackInto1X + k, edge.into[1][k]);
        set(kOutwardX + k, edge.outward[k]);
    }
    set(kOwnLength, piece.edges.row(kLength)[pair.partFeature]);
    set(kTrackLength, edge.length);
}
inline void writeFacePair(const PackedPiece& /*piece*/, const PackedTrack& /*track*/, const NearPair& pair,
                          PairTable& table, int row, int slot) {
    for (int f = 0; f < kFaceFound; ++f)
        table.at(row, f, slot) = pair.own[static_cast<std::size_t>(f)];
}

/// Moves the pairs that were collected into a lane's place of a table, about the nearest first: rows of pairs
/// that are far in all lanes are soon done with.
template <class Write>
inline void keepPairs(TrialLanes& group, int lane, PairTable& table, const Write& write) {
    constexpr std::size_t kBins = 8;
    const float scale = static_cast<float>(kBins) / group.field(kReach)[lane];
    const auto binOf = [&](const NearPair& pair) {
        return static_cast<std::size_t>(
            std::clamp(scale * pair.distance, 0.0F, static_cast<float>(kBins - 1)));
    };
    std::array<std::size_t, kBins + 1> begins{};
    for (const NearPair& pair : group.collected)
        ++begins[binOf(pair) + 1];
    for (std::size_t bin = 1; bin <= kBins; ++bin)
        begins[bin] += begins[bin - 1];
    const int slot = lane % kWidestVector;
    const PackedTrack& track = *group.track[static_cast<std::size_t>(lane)];
    table.resize(slot, static_cast<int>(group.collected.size()));
    for (const NearPair& pair : group.collected) {
        const int row = static_cast<int>(begins[binOf(pair)]++);
        table.begin(row, slot, pair);
        write(group.model().body->pieces[pieceOf(pair.trackFeature)], track, pair, table, row, slot);
    }
    group.collected.clear();
}

/// Collects the pairs of one lane anew: all that are nearer than its skin and `margin`.
inline void collectPairs(TrialLanes& group, int lane, float margin) {
    float& skin = group.field(kSkinThickness)[lane];
    if (skin == 0.0F) skin = kSkin;
    group.field(kReach)[lane] = skin + margin;
    const Placed placed = place(group, lane);
    group.field(kGone)[lane] = 0.0F;
    group.field(kNextLook)[lane] = 0.0F;
    group.field(kThenSine)[lane] = group.field(kSine)[lane];
    for (int k = 0; k < 4; ++k)
        group.field(kThenW + k)[lane] = group.field(kRotationW + k)[lane];
    for (int k = 0; k < 3; ++k) {
        group.origin(k)[lane] = placed.position[k];
        group.field(kAwayX + k)[lane] = 0.0F;
    }

    const std::vector<PackedPiece>& pieces = group.model().body->pieces;
    NearPairs& near = group.pairsOf(lane);
    std::size_t count = 0;
    const auto collect = [&](const BallArrays& balls, Kind kind, const auto& collectNear, PairTable& table,
                             const auto& write) {
        collectAmong(placed, balls, kind, collectNear, pieces);
        count += group.collected.size();
        keepPairs(group, lane, table, write);
    };
    collect(placed.track->triangleBalls, kVertexOnTriangle, collectVertices, near.vertices, writeVertexPair);
    collect(placed.track->edgeBalls, kEdgeAcrossEdge, collectEdges, near.edges, writeEdgePair);
    collect(placed.track->vertexBalls, kFaceOnVertex, collectFaces, near.faces, writeFacePair);
    if (count > kManyPairs) skin = std::max(0.7F * skin, kThinnest);
    if (count < kFewPairs) skin = std::min(1.3F * skin, kThickest);
}
