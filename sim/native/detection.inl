// Which contacts parts have with their tracks: a vector of lanes at a time, one pair of features of each.
// Included once per instruction set, inside HWY_NAMESPACE. The tests themselves are
// sim/contact/formulas/features.inl.

/// Added to what a part can travel in a step, so that contacts are there before they carry. [m]
constexpr float kMargin = 5e-6F;
/// What bounds may be wrong by in floats: taken off them. [m]
constexpr float kReserve = 1e-6F;
/// After this way pairs are collected anew, so that it stays small and so exact. [m]
constexpr float kLongestWay = 0.1F;

/// The parts of a vector of lanes in their tracks' axes, where their pairs are looked at.
struct PlacedLanes {
    int lane;     // the first
    int slot;     // of it, among its kWidestVector lanes
    Matrix axes;  // part -> track
    Triple away;  // of the centre from where it was when the pairs were collected
    Triple step;  // way of the centre in the coming step if nothing touches
    Triple turn;  // the rotation of that step [rad]
    Real margin;  // contacts are looked for this near
    Real near;    // and count if they are at most so far apart at the step's end
    Real gone;    // since the pairs were collected
};

/// Places of the lanes' parts since their pairs were collected.
inline void placeCentres(TrialLanes& group) {
    const hn::ScalableTag<double> doubles;
    const hn::Rebind<float, decltype(doubles)> floats;
    const int lanes = static_cast<int>(hn::Lanes(doubles));
    const auto promoted = [&](int field, int lane) {
        return hn::PromoteTo(doubles, hn::Load(floats, group.field(field) + lane));
    };
    for (int lane = 0; lane < group.count(); lane += lanes) {
        auto x = hn::Sub(hn::Load(doubles, group.position(0) + lane), promoted(kShiftX, lane));
        auto y = hn::Load(doubles, group.position(1) + lane);
        const auto z = hn::Sub(hn::Load(doubles, group.position(2) + lane), promoted(kShiftZ, lane));
        if (group.model().anyBowl) {
            const auto sine = promoted(kSine, lane);
            const auto less = promoted(kCosineLess, lane);
            const auto turned = hn::Add(x, hn::MulAdd(less, x, hn::Mul(sine, y)));
            y = hn::Add(y, hn::NegMulAdd(sine, x, hn::Mul(less, y)));
            x = turned;
        }
        const auto put = [&](int k, auto value) {
            hn::Store(hn::DemoteTo(floats, hn::Sub(value, hn::Load(doubles, group.origin(k) + lane))), floats,
                      group.field(kAwayX + k) + lane);
        };
        put(0, x);
        put(1, y);
        put(2, z);
    }
}

/// The farthest that any point of a part has come relative to its track since its pairs were collected.
inline Real calcNetWay(const TrialLanes& group, int lane) {
    const Real radius = group.model().body->radius;
    const Triple away = getThree(group, kAwayX, lane);
    const Real w = get(group, kRotationW, lane);
    const Triple q = getThree(group, kRotationX, lane);
    const Real thenW = get(group, kThenW, lane);
    const Triple then = getThree(group, kThenX, lane);
    // Sine of half the angle between the two rotations: half the chord of a point at radius 1.
    Real half = norm(thenW * q - w * then - cross(q, then));
    if (group.model().anyBowl) half = half + abs(get(group, kSine, lane) - get(group, kThenSine, lane));
    return norm(away) + Real(2.0) * radius * half;
}

inline PlacedLanes placeLanes(TrialLanes& group, int lane) {
    PlacedLanes placed;
    placed.lane = lane;
    placed.slot = lane % kWidestVector;
    placed.axes = {
        {getThree(group, kAxes, lane), getThree(group, kAxes + 3, lane), getThree(group, kAxes + 6, lane)}};
    placed.away = getThree(group, kAwayX, lane);
    placed.step = getThree(group, kStepX, lane);
    Triple spin = getThree(group, kAfterSpinX, lane);
    if (group.model().anyBowl) {
        // Relative to the track, in its axes.
        const Real sine = get(group, kSine, lane);
        const Real less = get(group, kCosineLess, lane);
        const auto turnBack = [&](const Triple& v) {
            return Triple{v.x + less * v.x + sine * v.y, v.y + less * v.y - sine * v.x, v.z};
        };
        spin = turnBack(spin);
        spin.z = spin.z - get(group, kSineRate, lane);
        Triple* rows = placed.axes.row;
        const Triple x = rows[0];
        const Triple y = rows[1];
        rows[0] = x + less * x + sine * y;
        rows[1] = y + less * y - sine * x;
    }
    placed.turn = Real(group.model().dt) * spin;
    const Real reach = get(group, kStepPath, lane) + get(group, kStepTurned, lane);
    placed.gone = get(group, kGone, lane);
    placed.margin = Real(1.1) * reach + Real(kMargin);
    // An impulse at one contact may turn the part toward another: what comes within half of the step's reach
    // counts.
    placed.near = Real(0.5) * reach + Real(kMargin);
    return placed;
}

inline Triple pairThree(const PairTable& table, int row, int field, int slot) {
    return {load(table.field(row, field) + slot), load(table.field(row, field + 1) + slot),
            load(table.field(row, field + 2) + slot)};
}

constexpr std::uint64_t nameContact(std::uint32_t trackFeature, std::uint32_t partFeature) {
    return (std::uint64_t{trackFeature} << 32U) | partFeature;
}

/// What contacts of a vector of lanes are made of.
struct FoundContacts {
    Mask touching;
    Triple arm, normal;
    Real gap;
};

/// Adds to the lanes' lists those contacts that can matter and that `holds` (bit, arm, normal) confirms.
/// Returns the bits of lanes in which one overlaps more at the step's end if nothing holds it.
template <class Name, class Holds>
inline std::uint32_t addContacts(TrialLanes& group, const PlacedLanes& placed, const FoundContacts& found,
                                 const Name& nameOf, const Holds& holds) {
    const Real after =
        max(found.gap, Real(0.0)) + dot(found.normal, placed.step + cross(placed.turn, found.arm));
    const std::uint32_t bits = bitsOf(found.touching && after < placed.near);
    if (bits == 0) return 0;
    const std::uint32_t overlaps = bitsOf(after < Real(0.0));
    alignas(64) float values[kGap + 1][kWidestVector];
    store(found.arm.x, values[kArmX]);
    store(found.arm.y, values[kArmY]);
    store(found.arm.z, values[kArmZ]);
    store(found.normal.x, values[kNormalX]);
    store(found.normal.y, values[kNormalY]);
    store(found.normal.z, values[kNormalZ]);
    store(found.gap, values[kGap]);
    std::uint32_t carries = 0;
    forEachBit(bits, [&](int i) {
        const float normal[3] = {values[kNormalX][i], values[kNormalY][i], values[kNormalZ][i]};
        if (!holds(i, normal)) return;
        ContactList& list = group.found[placed.lane + i];
        list.reserve(1);
        Contact& contact = list.next();
        for (int f = 0; f <= kGap; ++f)
            contact.values[static_cast<std::size_t>(f)] = values[f][i];
        contact.feature = nameOf(i);
        list.keepIf(true);
        carries |= overlaps & (1U << static_cast<unsigned>(i));
    });
    return carries;
}

/// What looking at pairs gives: lanes in which a contact carries, and when the next pair is due.
struct Looked {
    std::uint32_t carries;
    Real due;
};

/// Whether no pair of the row can touch in the coming step.
inline bool isFar(const PlacedLanes& placed, const PairTable& pairs, int row, Looked& looked) {
    const Real due = load(pairs.due(row) + placed.slot);
    if (any(placed.gone + placed.margin >= due)) return false;
    looked.due = min(looked.due, due);
    return true;
}

/// Notes how far the pairs of a row are apart.
inline void setDue(const PlacedLanes& placed, PairTable& pairs, int row, Real distance, Looked& looked) {
    const Real due = placed.gone + distance - Real(kReserve);
    store(due, pairs.due(row) + placed.slot);
    looked.due = min(looked.due, due);
}

inline void lookAtVertices(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    for (int row = 0; row < pairs.rows(); ++row) {
        if (isFar(placed, pairs, row, looked)) continue;
        const auto planeOf = [&](int c) {
            return Plane{pairThree(pairs, row, kPlanes + 4 * c, placed.slot),
                         load(pairs.field(row, kPlanes + 4 * c + 3) + placed.slot)};
        };
        const Triple arm = placed.axes * pairThree(pairs, row, kVertexX, placed.slot);
        const Triple point = placed.away + arm;
        const Plane plane = planeOf(0);
        const Plane sides[3] = {planeOf(1), planeOf(2), planeOf(3)};
        const VertexTest test = testVertex(point, plane, sides, placed.margin);
        setDue(placed, pairs, row, test.clear, looked);
        if (!any(test.over)) continue;

        // The part must lie above the plane: otherwise the vertex passes by (along the border of the face
        // that the part lies on) or touches the other flank of a thin wall.
        alignas(64) float inPart[3][kWidestVector];
        const Triple up = multiplyTransposed(placed.axes, plane.normal);
        store(up.x, inPart[0]);
        store(up.y, inPart[1]);
        store(up.z, inPart[2]);
        const std::uint32_t* trackFeature = pairs.trackFeature(row) + placed.slot;
        const std::uint32_t* partFeature = pairs.partFeature(row) + placed.slot;
        looked.carries |= addContacts(
            group, placed, {test.over, arm, plane.normal, test.gap},
            [&](int i) { return nameContact(trackFeature[i], partFeature[i]); },
            [&](int i, const float* /*normal*/) {
                const PackedPiece& piece = group.model().body->pieces[pieceOf(trackFeature[i])];
                const float direction[3] = {inPart[0][i], inPart[1][i], inPart[2][i]};
                const std::uint32_t vertex = partFeature[i];
                bool above = true;
                for (int e = piece.firstEdge[vertex]; e < piece.firstEdge[vertex + 1]; ++e)
                    above &=
                        dotThree(direction, piece.vertexEdges.data() + 3 * static_cast<std::ptrdiff_t>(e)) >=
                        static_cast<float>(-kConeSlack);
                return above;
            });
    }
}

inline void lookAtEdges(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    for (int row = 0; row < pairs.rows(); ++row) {
        if (isFar(placed, pairs, row, looked)) continue;
        const auto three = [&](int field) { return pairThree(pairs, row, field, placed.slot); };
        const auto one = [&](int field) { return load(pairs.field(row, field) + placed.slot); };
        Edge part;
        part.direction = placed.axes * three(kOwnDirectionX);
        part.length = one(kOwnLength);
        const Triple arm = placed.axes * three(kOwnFromX);
        part.from = placed.away + arm;
        const Triple apart = three(kApartX);
        const Real ahead = part.length * dot(apart, part.direction);
        const Real distance = dot(apart, part.from) + min(ahead, Real(0.0)) + one(kApartOffset);
        setDue(placed, pairs, row, distance, looked);
        const Mask near = distance < placed.margin;
        if (!any(near)) continue;

        part.into[0] = placed.axes * three(kOwnInto0X);
        part.into[1] = placed.axes * three(kOwnInto1X);
        const Edge track = {three(kTrackFromX),
                            three(kTrackDirectionX),
                            one(kTrackLength),
                            {three(kTrackInto0X), three(kTrackInto1X)}};
        const EdgeTest test = testEdges(part, track, three(kOutwardX), placed.margin);
        const Mask touching = test.touching && near;
        if (!any(touching)) continue;
        const std::uint32_t* trackFeature = pairs.trackFeature(row) + placed.slot;
        const std::uint32_t* partFeature = pairs.partFeature(row) + placed.slot;
        looked.carries |= addContacts(
            group, placed, {touching, mulAdd(test.alongPart, part.direction, arm), test.normal, test.gap},
            [&](int i) { return nameContact(trackFeature[i], partFeature[i]); },
            [](int /*lane*/, const float* /*normal*/) { return true; });
    }
}

/// The face of its piece that a point of each lane is farthest beyond, and how far.
struct FarthestFace {
    Real gap;
    Triple normal;
    Real face;
};

inline FarthestFace findFarthestFace(const PackedBody& body, const std::uint32_t* trackFeature,
                                     std::uint32_t bits, const Triple& point) {
    FarthestFace farthest = {-kUntouchable, {0.0, 0.0, 0.0}, 0.0};
    while (bits != 0) {
        // Lanes with the same piece together.
        const std::uint32_t p = pieceOf(trackFeature[hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)]);
        alignas(64) float same[kWidestVector] = {};
        forEachBit(bits, [&](int i) {
            if (pieceOf(trackFeature[i]) != p) return;
            same[i] = 1.0F;
            bits &= ~(1U << static_cast<unsigned>(i));
        });
        const Mask asked = load(same) > Real(0.0);
        const FloatRows& faces = body.pieces[p].faces;
        for (int f = 0; f < faces.stride(); ++f) {
            const Plane plane = {{faces.row(0)[f], faces.row(1)[f], faces.row(2)[f]}, faces.row(3)[f]};
            const Real gap = distanceBeyond(plane, point);
            const Mask farther = asked && gap > farthest.gap;
            farthest.gap = select(farther, gap, farthest.gap);
            farthest.normal = select(farther, plane.normal, farthest.normal);
            farthest.face = select(farther, Real(f), farthest.face);
        }
    }
    return farthest;
}

inline void lookAtFaces(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    for (int row = 0; row < pairs.rows(); ++row) {
        if (isFar(placed, pairs, row, looked)) continue;
        const Triple arm = pairThree(pairs, row, kPointX, placed.slot) - placed.away;
        const Triple point = multiplyTransposed(placed.axes, arm);
        const Real distance = distanceBeyond(
            {pairThree(pairs, row, kFaceX, placed.slot), load(pairs.field(row, kFaceOffset) + placed.slot)},
            point);
        setDue(placed, pairs, row, distance, looked);
        const Mask near = distance < placed.margin;
        if (!any(near)) continue;

        const std::uint32_t* trackFeature = pairs.trackFeature(row) + placed.slot;
        const FarthestFace farthest =
            findFarthestFace(*group.model().body, trackFeature, bitsOf(near), point);
        const Mask touching = near && farthest.gap < placed.margin && farthest.gap > Real(-kDeepest);
        if (!any(touching)) continue;
        alignas(64) float faces[kWidestVector];
        store(farthest.face, faces);
        looked.carries |= addContacts(
            group, placed, {touching, arm, Real(-1.0) * (placed.axes * farthest.normal), farthest.gap},
            [&](int i) { return nameContact(trackFeature[i], static_cast<std::uint32_t>(faces[i])); },
            [&](int i, const float* normal) {
                // The track must lie below the face: a part that slides level over a border is not stopped by
                // it.
                const PackedTrack& track = *group.track[placed.lane + i];
                const PackedVertex& vertex = track.vertices[indexOf(trackFeature[i])];
                bool below = true;
                for (int e = vertex.firstEdge; e < vertex.firstEdge + vertex.edgeCount; ++e)
                    below &=
                        dotThree(normal, track.vertexEdges.data() + 3 * static_cast<std::ptrdiff_t>(e)) <=
                        static_cast<float>(kConeSlack);
                return below;
            });
    }
}

/// Fills the lists of contacts of a vector of lanes; returns the bits of those that an impulse acts on.
inline std::uint32_t findContacts(TrialLanes& group, int lane) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    const int end = std::min(lane + width, group.count());
    for (int i = lane; i < end; ++i)
        group.found[static_cast<std::size_t>(i)].clear();
    const std::uint32_t there = (1U << static_cast<unsigned>(end - lane)) - 1U;
    const Real reach = get(group, kStepPath, lane) + get(group, kStepTurned, lane);
    const Real margin = Real(1.1) * reach + Real(kMargin);
    // When a lane's pairs are collected must not hang on its company: it tells their order.
    const Real gone = get(group, kGone, lane);
    const Mask leaves = calcNetWay(group, lane) + margin + Real(kReserve) >= get(group, kReach, lane) ||
                        gone > Real(kLongestWay);
    const std::uint32_t leaving = bitsOf(leaves) & there;
    if (leaving != 0) {
        alignas(64) float margins[kWidestVector];
        store(margin, margins);
        forEachBit(leaving, [&](int i) { collectPairs(group, lane + i, margins[i]); });
    }
    if ((bitsOf(get(group, kGone, lane) + margin >= get(group, kNextLook, lane)) & there) == 0) return 0;

    const PlacedLanes placed = placeLanes(group, lane);
    NearPairs& pairs = group.pairsOf(lane);
    Looked looked = {0, kUntouchable};
    lookAtVertices(group, placed, pairs.vertices, looked);
    lookAtEdges(group, placed, pairs.edges, looked);
    lookAtFaces(group, placed, pairs.faces, looked);
    set(group, kNextLook, lane, looked.due);
    return looked.carries & there;
}
