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
/// What distances to planes far from where the track begins may be wrong by in floats. [m]
constexpr float kPlaneReserve = 1e-5F;

enum Kind : std::uint32_t { kVertexOnTriangle, kEdgeAcrossEdge, kFaceOnVertex };

// In the order in which contacts of one part are solved.
constexpr unsigned kPieceShift = 22;
constexpr unsigned kKindShift = 20;
static_assert(kMostPieces == 1U << (32U - kPieceShift));

constexpr std::uint32_t pieceOf(std::uint32_t trackFeature) {
    return trackFeature >> kPieceShift;
}
constexpr std::uint32_t indexOf(std::uint32_t trackFeature) {
    return trackFeature & 0xFFFFFU;
}

/// One part in its track's frame.
struct Placed {
    const PackedTrack* track;
    const PackedBody* body;
    alignas(16) float axes[3][4];  // rows of the rotation part -> track
    double position[3];            // [m]
    float reach;                   // what is nearer than this is collected [m]
    const FloatRows* pieces;       // PieceRow
    std::vector<NearPair>* pairs;
};

inline Placed place(TrialLanes& group, int lane) {
    Placed placed;
    placed.track = group.track[static_cast<std::size_t>(lane)];
    placed.body = group.model().body;
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

/// Calls `use` with the first of each vector of features, and the end of their group, of those groups whose
/// balls may be nearer than the part's reach, by `distanceFrom` their centres.
template <class Distance, class Use>
inline void forEachNear(const Placed& placed, const FeatureGroups& groups, const Distance& distanceFrom,
                        const Use& use) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    const FloatRows& balls = groups.balls;
    for (int ball = 0; ball < balls.stride(); ball += width) {
        const Real distance = distanceFrom(loadThree(balls, 0, ball)) - load(balls.row(3) + ball);
        forEachBit(bitsOf(distance < Real(placed.reach)), [&](int i) {
            const int begin = (ball + i) * kWidestVector;
            const int end = begin + groups.counts[ball + i];
            for (int first = begin; first < end; first += width)
                use(first, end);
        });
    }
}

/// Where the balls around the pieces are on the track, and how far what they are near is from their centres.
inline void placePieces(Placed& placed, FloatRows& pieces) {
    const PackedBody& body = *placed.body;
    for (std::size_t p = 0; p < body.pieces.size(); ++p) {
        float centre[3];
        toTrack(placed, body.pieces[p].centre, centre);
        for (int k = 0; k < 3; ++k)
            pieces.row(k)[p] = static_cast<float>(placed.position[k] + centre[k]);
        pieces.row(kPieceNear)[p] = body.pieces[p].radius + placed.reach;
    }
    placed.pieces = &pieces;
}

/// Calls `use` with the numbers of the pieces whose balls are near one of the track's.
template <class Use>
inline void forEachPieceNear(const Placed& placed, const BallArrays& balls, int index, const Use& use) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    const FloatRows& pieces = *placed.pieces;
    const float centre[3] = {balls.x[index], balls.y[index], balls.z[index]};
    for (int first = 0; first < pieces.stride(); first += width) {
        const Triple away = broadcast(centre) - loadThree(pieces, 0, first);
        const Real far = Real(balls.radius[index]) + load(pieces.row(kPieceNear) + first);
        forEachBit(bitsOf(dot(away, away) < far * far), [&](int i) { use(first + i); });
    }
}

inline std::uint32_t nameFeature(Kind kind, std::uint32_t piece, int trackFeature) {
    return (kind << kKindShift) | (piece << kPieceShift) | static_cast<std::uint32_t>(trackFeature);
}

inline void collectVertices(const Placed& placed, int index) {
    std::array<std::uint32_t, kMostPieces / 32> near{};
    bool isAnyNear = false;
    forEachPieceNear(placed, placed.track->triangleBalls.balls, index, [&](int piece) {
        near[static_cast<std::size_t>(piece) / 32] |= 1U << (static_cast<unsigned>(piece) % 32U);
        isAnyNear = true;
    });
    if (!isAnyNear) return;

    const PackedTriangle& triangle = placed.track->triangles[static_cast<std::size_t>(index)];
    // Four planes at once into the part's frame.
    const Four inTrack[3] = {loadFour(triangle.nx), loadFour(triangle.ny), loadFour(triangle.nz)};
    alignas(16) float normals[3][4];
    alignas(16) float offsets[4];  // of the centre of mass
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
    }
    Plane planes[4];
    for (int c = 0; c < 4; ++c)
        planes[c] = {{normals[0][c], normals[1][c], normals[2][c]}, offsets[c]};
    const Plane sides[3] = {planes[1], planes[2], planes[3]};
    const auto farthestBeyond = [&](const Triple& centre) {
        return max(max(distanceBeyond(planes[0], centre), distanceBeyond(planes[1], centre)),
                   max(distanceBeyond(planes[2], centre), distanceBeyond(planes[3], centre)));
    };
    const FeatureGroups& vertices = placed.body->vertices;
    forEachNear(placed, vertices, farthestBeyond, [&](int first, int end) {
        const VertexTest test = testVertex(loadThree(vertices.features, 0, first), planes[0], sides);
        const std::uint32_t bits = bitsOf(test.clear < Real(placed.reach));
        if (bits == 0) return;
        alignas(64) float clear[kWidestVector];
        store(test.clear, clear);
        forEachBit(bits, [&](int i) {
            const int place = first + i;
            if (place >= end) return;
            const std::uint32_t piece = vertices.pieces[place];
            if ((near[piece / 32] >> (piece % 32U) & 1U) == 0) return;
            placed.pairs->push_back({clear[i],
                                     nameFeature(kVertexOnTriangle, piece, index),
                                     vertices.indices[place],
                                     {offsets[0], offsets[1], offsets[2], offsets[3]}});
        });
    });
}

/// How far a point is beyond the face of a piece that it is farthest beyond, and the face.
inline float findSeparation(const PackedPiece& piece, const Triple& point, int* face) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    float best = -kUntouchable;
    for (int first = 0; first < piece.faces.stride(); first += width) {
        const Real distance = dot(loadThree(piece.faces, kFaceNormalX, first), point) +
                              load(piece.faces.row(kPlaneOffset) + first);
        const Real separation =
            select(distance > load(piece.faces.row(kCountsFrom) + first), distance, Real(-kUntouchable));
        const float greatest = greatestOf(separation);
        if (greatest <= best) continue;
        best = greatest;
        *face = first +
                static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bitsOf(separation >= Real(greatest))));
    }
    return best;
}

inline void collectEdges(const Placed& placed, int index) {
    const PackedEdge& edge = placed.track->edges[static_cast<std::size_t>(index)];
    float relative[3];
    for (int k = 0; k < 3; ++k)
        relative[k] = static_cast<float>(edge.from[k] - placed.position[k]);
    alignas(16) float from[4];
    alignas(16) float direction[4];
    toPart(placed, relative, from);
    toPart(placed, edge.direction, direction);
    const Segment own = {broadcast(from), broadcast(direction), edge.length};
    const auto distanceFrom = [&](const Triple& centre) {
        const Triple between = centre - own.from;
        const Real along = min(max(dot(own.direction, between), Real(0.0)), own.length);
        return norm(between - along * own.direction);
    };

    const FeatureGroups& edges = placed.body->edges;
    forEachNear(placed, edges, distanceFrom, [&](int first, int end) {
        const Segment part = {loadThree(edges.features, kFromX, first),
                              loadThree(edges.features, kDirectionX, first),
                              load(edges.features.row(kLength) + first)};
        const Triple between = findBetween(part, own);
        const Real distance = sqrt(dot(between, between));
        const std::uint32_t bits = bitsOf(distance < Real(placed.reach));
        if (bits == 0) return;
        alignas(64) float distances[kWidestVector];
        alignas(64) float away[3][kWidestVector];
        store(distance, distances);
        store(between.x, away[0]);
        store(between.y, away[1]);
        store(between.z, away[2]);
        forEachBit(bits, [&](int i) {
            const int place = first + i;
            if (place >= end) return;
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
            const float atFrom = dotThree(apart, relative);
            const float atTo = atFrom + edge.length * dotThree(apart, edge.direction);
            const float offset = scale > 0.0F ? -std::max(atFrom, atTo) : -kUntouchable;
            placed.pairs->push_back(
                {scale > 0.0F ? distances[i] : -kUntouchable,
                 nameFeature(kEdgeAcrossEdge, edges.pieces[place], index),
                 edges.indices[place],
                 {apart[0], apart[1], apart[2], offset, relative[0], relative[1], relative[2]}});
        });
    });
}

inline void collectFaces(const Placed& placed, int index) {
    const PackedVertex& vertex = placed.track->vertices[static_cast<std::size_t>(index)];
    float relative[3];
    for (int k = 0; k < 3; ++k)
        relative[k] = static_cast<float>(vertex.position[k] - placed.position[k]);
    alignas(16) float inPart[4];
    toPart(placed, relative, inPart);
    const Triple point = broadcast(inPart);
    forEachPieceNear(placed, placed.track->vertexBalls.balls, index, [&](int piece) {
        const PackedPiece& own = placed.body->pieces[static_cast<std::size_t>(piece)];
        int face = 0;
        const float gap = findSeparation(own, point, &face);
        if (gap >= placed.reach || gap <= -placed.reach - static_cast<float>(kDeepest)) return;
        const auto row = [&](int r) { return own.faces.row(r)[face]; };
        placed.pairs->push_back({gap,
                                 nameFeature(kFaceOnVertex, static_cast<std::uint32_t>(piece), index),
                                 0,
                                 {relative[0], relative[1], relative[2], row(kFaceNormalX), row(kFaceNormalY),
                                  row(kFaceNormalZ), row(kPlaneOffset)}});
    });
}

/// Bits of those balls, a vector from `first`, that a ball is near.
inline std::uint32_t findNear(const BallArrays& balls, int first, const Triple& centre, Real radius) {
    const Triple away =
        Triple{load(balls.x.data() + first), load(balls.y.data() + first), load(balls.z.data() + first)} -
        centre;
    const Real far = load(balls.radius.data() + first) + radius;
    return bitsOf(dot(away, away) < far * far);
}

/// Bits of those triangles, a vector from `first`, above or below which a ball is, or nearly.
inline std::uint32_t findBeside(const FloatRows& planes, int first, const Triple& centre, Real radius) {
    Real farthest = -kUntouchable;
    for (int c = 0; c < 4; ++c) {
        const Plane plane = {loadThree(planes, 4 * c, first), load(planes.row(4 * c + 3) + first)};
        farthest = max(farthest, distanceBeyond(plane, centre));
    }
    return bitsOf(farthest < radius);
}

/// Calls `collect` with the numbers of the features among `balls` that are near the part; `mayBeNear` looks
/// closer at a vector of them.
template <class May, class Collect>
inline void collectAmong(const Placed& placed, const FeatureBalls& features, const May& mayBeNear,
                         const Collect& collect) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    float middle[3];
    toTrack(placed, placed.body->centre, middle);
    for (int k = 0; k < 3; ++k)
        middle[k] = static_cast<float>(placed.position[k] + middle[k]);
    const Triple centre = broadcast(middle);
    const Real near = placed.body->reach + placed.reach;
    for (int first = 0; first < features.blocks.count; first += width) {
        forEachBit(findNear(features.blocks, first, centre, near), [&](int block) {
            const int begin = (first + block) * kWidestVector;
            for (int ball = begin; ball < begin + kWidestVector; ball += width) {
                std::uint32_t bits = findNear(features.balls, ball, centre, near);
                if (bits != 0) bits &= mayBeNear(ball, centre, near);
                forEachBit(bits, [&](int i) { collect(placed, ball + i); });
            }
        });
    }
}

/// Writes what one of these pairs is made of: its field f to to[f * kWidestVector].
inline void writeVertexPair(const PackedPiece& piece, const PackedTrack& track, const NearPair& pair,
                            float* to) {
    const PackedTriangle& triangle = track.triangles[indexOf(pair.trackFeature)];
    const float* own =
        piece.vertexFields.data() + static_cast<std::ptrdiff_t>(pair.partFeature & ~kManyEdges) * kPlanes;
    for (int f = 0; f < kPlanes; ++f)
        to[f * kWidestVector] = own[f];
    to += kPlanes * kWidestVector;
    for (int c = 0; c < 4; ++c, to += 4 * kWidestVector) {
        to[0] = triangle.nx[c];
        to[kWidestVector] = triangle.ny[c];
        to[2 * kWidestVector] = triangle.nz[c];
        to[3 * kWidestVector] = pair.own[static_cast<std::size_t>(c)];
    }
    for (int c = 0; c < 3; ++c, to += kWidestVector)
        to[0] = triangle.ridges[c];
}
inline void writeEdgePair(const PackedPiece& piece, const PackedTrack& track, const NearPair& pair,
                          float* to) {
    const PackedEdge& edge = track.edges[indexOf(pair.trackFeature)];
    const auto set = [to](int f, float value) { to[f * kWidestVector] = value; };
    for (int k = 0; k < 4; ++k)
        set(kApartX + k, pair.own[static_cast<std::size_t>(k)]);
    const float* own = piece.edges.row(0) + pair.partFeature;
    const int stride = piece.edges.stride();
    for (int r = 0; r < kEdgeRows; ++r)
        set(kOwnFromX + r, own[r * stride]);
    for (int k = 0; k < 3; ++k) {
        set(kTrackFromX + k, pair.own[4 + k]);
        set(kTrackDirectionX + k, edge.direction[k]);
        set(kTrackInto0X + k, edge.into[0][k]);
        set(kTrackInto1X + k, edge.into[1][k]);
        set(kOutwardX + k, edge.outward[k]);
    }
    set(kTrackLength, edge.length);
}
inline void writeFacePair(const PackedPiece& /*piece*/, const PackedTrack& /*track*/, const NearPair& pair,
                          float* to) {
    for (int f = 0; f < kFaceFound; ++f)
        to[f * kWidestVector] = pair.own[static_cast<std::size_t>(f)];
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
        write(group.model().body->pieces[pieceOf(pair.trackFeature)], track, pair, &table.at(row, 0, slot));
    }
    group.collected.clear();
}

/// Collects the pairs of one lane anew: all that are nearer than its skin and `margin`.
inline void collectPairs(TrialLanes& group, int lane, float margin) {
    float& skin = group.field(kSkinThickness)[lane];
    if (skin == 0.0F) skin = kSkin;
    group.field(kReach)[lane] = skin + margin;
    Placed placed = place(group, lane);
    placePieces(placed, group.piecesInTrack);
    group.field(kGone)[lane] = 0.0F;
    group.field(kNextLook)[lane] = 0.0F;
    group.field(kThenSine)[lane] = group.field(kSine)[lane];
    for (int k = 0; k < 4; ++k)
        group.field(kThenW + k)[lane] = group.field(kRotationW + k)[lane];
    for (int k = 0; k < 3; ++k) {
        group.origin(k)[lane] = placed.position[k];
        group.field(kAwayX + k)[lane] = 0.0F;
    }

    NearPairs& near = group.pairsOf(lane);
    std::size_t count = 0;
    const auto collect = [&](const FeatureBalls& balls, const auto& mayBeNear, const auto& collectNear,
                             PairTable& table, const auto& write) {
        collectAmong(placed, balls, mayBeNear, collectNear);
        count += group.collected.size();
        keepPairs(group, lane, table, write);
    };
    const auto mayBeBeside = [&](int first, const Triple& centre, Real radius) {
        return findBeside(placed.track->planes, first, centre, radius + Real(kPlaneReserve));
    };
    const auto noCloser = [](int /*first*/, const Triple& /*centre*/, Real /*radius*/) {
        return ~std::uint32_t{0};
    };
    collect(placed.track->triangleBalls, mayBeBeside, collectVertices, near.vertices, writeVertexPair);
    collect(placed.track->edgeBalls, noCloser, collectEdges, near.edges, writeEdgePair);
    collect(placed.track->vertexBalls, noCloser, collectFaces, near.faces, writeFacePair);
    if (count > kManyPairs) skin = std::max(0.7F * skin, kThinnest);
    if (count < kFewPairs) skin = std::min(1.3F * skin, kThickest);
}
