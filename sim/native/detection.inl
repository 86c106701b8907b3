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
    const Real pushed = get(group, kPushed, lane);
    placed.margin = Real(1.1) * reach + Real(kMargin) + pushed;
    // An impulse at one contact may turn the part toward another: what comes within half of the step's reach
    // counts; of a part that others push what they can push it against, too.
    placed.near = Real(0.5) * reach + Real(kMargin) + pushed;
    return placed;
}

inline Triple pairThree(const PairTable& table, int row, int field, int slot) {
    return {load(table.field(row, field) + slot), load(table.field(row, field + 1) + slot),
            load(table.field(row, field + 2) + slot)};
}

constexpr std::uint64_t nameContact(std::uint32_t trackFeature, std::uint32_t partFeature) {
    return (std::uint64_t{trackFeature} << 32U) | partFeature;
}

/// What looking at pairs gives: lanes in which a contact carries, and when the next pair is due.
struct Looked {
    std::uint32_t carries;
    Real due;
};

// Which rows, lanes and contacts there is something to do for cannot be guessed by a processor: each pass
// does one thing for all of them without branching and lists what is left for the next.

/// The rows of which a pair is due, into `rows`; returns how many.
inline int listDue(const PlacedLanes& placed, const PairTable& pairs, int* rows) {
    int count = 0;
    for (int row = 0; row < pairs.rows(); ++row) {
        rows[count] = row;
        count += any(placed.gone + placed.margin >= load(pairs.due(row) + placed.slot)) ? 1 : 0;
    }
    return count;
}

/// Notes how far the pairs of a row are apart.
inline void setDue(const PlacedLanes& placed, PairTable& pairs, int row, Real distance) {
    store(placed.gone + distance - Real(kReserve), pairs.due(row) + placed.slot);
}

/// When the first pair of a table is due.
inline Real findNextDue(const PlacedLanes& placed, const PairTable& pairs) {
    Real due = kUntouchable;
    for (int row = 0; row < pairs.rows(); ++row)
        due = min(due, load(pairs.due(row) + placed.slot));
    return due;
}

/// What contacts of a vector of lanes are made of.
struct FoundContacts {
    Mask touching;
    Triple arm, normal;
    Real gap;
};

/// Puts aside those contacts of a row that can matter.
inline void stage(TrialLanes& group, const PlacedLanes& placed, int row, const FoundContacts& found) {
    const Real after =
        max(found.gap, Real(0.0)) + dot(found.normal, placed.step + cross(placed.turn, found.arm));
    StagedContacts& staged = group.staged;
    const auto place = static_cast<int>(staged.rows.size());
    staged.rows.push_back(row);
    staged.overlaps.push_back(bitsOf(after < Real(0.0)));
    const Real values[] = {found.arm.x,    found.arm.y,    found.arm.z, found.normal.x,
                           found.normal.y, found.normal.z, found.gap};
    float* to = staged.valuesOf(place);
    for (const Real& value : values) {
        store(value, to);
        to += kWidestVector;
    }
    const hn::RebindToSigned<Tag> whole;
    const Mask counts = found.touching && after < placed.near;
    const auto codes = hn::Iota(whole, place * kWidestVector);
    hn::StoreU(hn::Compress(codes, hn::RebindMask(whole, counts.bits)), whole, staged.reserveCodes());
    staged.count += static_cast<int>(hn::CountTrue(Tag(), counts.bits));
}

/// Adds the contacts that were put aside to their lanes' lists, if `holds` (row, lane, normal) confirms them.
/// Returns the bits of lanes in which one overlaps more at the step's end if nothing holds it.
template <class Name, class Holds>
inline std::uint32_t addStaged(TrialLanes& group, const PlacedLanes& placed, const Name& nameOf,
                               const Holds& holds) {
    StagedContacts& staged = group.staged;
    std::uint32_t carries = 0;
    for (int c = 0; c < staged.count; ++c) {
        const int place = staged.codes[static_cast<std::size_t>(c)] / kWidestVector;
        const int i = staged.codes[static_cast<std::size_t>(c)] % kWidestVector;
        const auto at = static_cast<std::size_t>(place);
        const float* values = staged.valuesOf(place) + i;
        if (!holds(staged.rows[at], i, values)) continue;
        ContactList& list = group.found[placed.lane + i];
        list.reserve(1);
        Contact& contact = list.next();
        for (int f = 0; f <= kGap; ++f)
            contact.values[static_cast<std::size_t>(f)] = values[f * kWidestVector];
        contact.feature = nameOf(staged.rows[at], i);
        list.keepIf(true);
        carries |= staged.overlaps[at] & (1U << static_cast<unsigned>(i));
    }
    staged.clear();
    return carries;
}

/// Whether all edges of a vertex lead away from the plane that has this normal. [track's axes]
inline bool liesAbove(const TrialLanes& group, const PlacedLanes& placed, std::uint32_t trackFeature,
                      std::uint32_t vertex, int i, const float* normal) {
    const PackedPiece& piece = group.model().body->pieces[pieceOf(trackFeature)];
    float inPart[3] = {};
    alignas(64) float axes[3][kWidestVector];
    for (int k = 0; k < 3; ++k) {
        store(placed.axes.row[k].x, axes[0]);
        store(placed.axes.row[k].y, axes[1]);
        store(placed.axes.row[k].z, axes[2]);
        for (int f = 0; f < 3; ++f)
            inPart[f] += axes[f][i] * normal[k];
    }
    bool above = true;
    for (int e = piece.firstEdge[vertex]; e < piece.firstEdge[vertex + 1]; ++e)
        above &= dotThree(inPart, piece.vertexEdges.data() + 3 * static_cast<std::ptrdiff_t>(e)) >=
                 static_cast<float>(-kConeSlack);
    return above;
}

inline Plane planeOf(const PlacedLanes& placed, const PairTable& pairs, int row, int c) {
    return {pairThree(pairs, row, kPlanes + 4 * c, placed.slot),
            load(pairs.field(row, kPlanes + 4 * c + 3) + placed.slot)};
}

inline void lookAtVertices(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    int* rows = group.rowsToLookAt(pairs.rows());
    const int due = listDue(placed, pairs, rows);
    int count = 0;
    for (int i = 0; i < due; ++i) {
        const int row = rows[i];
        const Triple point = placed.away + placed.axes * pairThree(pairs, row, kVertexX, placed.slot);
        const Plane sides[3] = {planeOf(placed, pairs, row, 1), planeOf(placed, pairs, row, 2),
                                planeOf(placed, pairs, row, 3)};
        const VertexTest test = testVertex(point, planeOf(placed, pairs, row, 0), sides);
        setDue(placed, pairs, row, test.clear);
        rows[count] = row;
        count += any(test.clear < placed.margin) ? 1 : 0;
    }
    looked.due = min(looked.due, findNextDue(placed, pairs));

    for (int i = 0; i < count; ++i) {
        const int row = rows[i];
        const Triple arm = placed.axes * pairThree(pairs, row, kVertexX, placed.slot);
        const Plane plane = planeOf(placed, pairs, row, 0);
        const Plane sides[3] = {planeOf(placed, pairs, row, 1), planeOf(placed, pairs, row, 2),
                                planeOf(placed, pairs, row, 3)};
        const Real ridges[3] = {load(pairs.field(row, kRidge0) + placed.slot),
                                load(pairs.field(row, kRidge1) + placed.slot),
                                load(pairs.field(row, kRidge2) + placed.slot)};
        const VertexTest test = testVertex(placed.away + arm, plane, sides);
        // The part must lie above the plane: otherwise the vertex passes by (along the border of the face
        // that the part lies on) or touches the other flank of a thin wall.
        const Triple up = multiplyTransposed(placed.axes, plane.normal);
        const Triple way = placed.step + cross(placed.turn, arm);
        Mask touching = test.clear < placed.margin && meetsTriangle(test, way, plane, sides, ridges);
        for (int e = 0; e < kConeEdges; ++e)
            touching =
                touching && dot(up, pairThree(pairs, row, kCone + 3 * e, placed.slot)) >= Real(-kConeSlack);
        stage(group, placed, row, {touching, arm, plane.normal, test.gap});
    }
    looked.carries |= addStaged(
        group, placed,
        [&](int row, int i) {
            return nameContact(pairs.trackFeature(row)[placed.slot + i],
                               pairs.partFeature(row)[placed.slot + i] & ~kManyEdges);
        },
        [&](int row, int i, const float* values) {
            const std::uint32_t vertex = pairs.partFeature(row)[placed.slot + i];
            if ((vertex & kManyEdges) == 0) return true;
            const float normal[3] = {values[kNormalX * kWidestVector], values[kNormalY * kWidestVector],
                                     values[kNormalZ * kWidestVector]};
            return liesAbove(group, placed, pairs.trackFeature(row)[placed.slot + i], vertex & ~kManyEdges, i,
                             normal);
        });
}

inline void lookAtEdges(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    const auto three = [&](int row, int field) { return pairThree(pairs, row, field, placed.slot); };
    const auto one = [&](int row, int field) { return load(pairs.field(row, field) + placed.slot); };
    int* rows = group.rowsToLookAt(pairs.rows());
    const int due = listDue(placed, pairs, rows);
    int count = 0;
    for (int i = 0; i < due; ++i) {
        const int row = rows[i];
        const Triple apart = three(row, kApartX);
        const Real ahead = one(row, kOwnLength) * dot(apart, placed.axes * three(row, kOwnDirectionX));
        const Triple from = placed.away + placed.axes * three(row, kOwnFromX);
        const Real distance = dot(apart, from) + min(ahead, Real(0.0)) + one(row, kApartOffset);
        setDue(placed, pairs, row, distance);
        rows[count] = row;
        count += any(distance < placed.margin) ? 1 : 0;
    }
    looked.due = min(looked.due, findNextDue(placed, pairs));

    for (int i = 0; i < count; ++i) {
        const int row = rows[i];
        const Triple arm = placed.axes * three(row, kOwnFromX);
        const Edge part = {placed.away + arm,
                           placed.axes * three(row, kOwnDirectionX),
                           one(row, kOwnLength),
                           {placed.axes * three(row, kOwnInto0X), placed.axes * three(row, kOwnInto1X)}};
        const Edge track = {three(row, kTrackFromX),
                            three(row, kTrackDirectionX),
                            one(row, kTrackLength),
                            {three(row, kTrackInto0X), three(row, kTrackInto1X)}};
        const EdgeTest test = testEdges(part, track, three(row, kOutwardX), placed.margin);
        const Mask near = load(pairs.due(row) + placed.slot) < placed.gone + placed.margin - Real(kReserve);
        stage(group, placed, row,
              {test.touching && near, mulAdd(test.alongPart, part.direction, arm), test.normal, test.gap});
    }
    looked.carries |= addStaged(
        group, placed,
        [&](int row, int i) {
            return nameContact(pairs.trackFeature(row)[placed.slot + i],
                               pairs.partFeature(row)[placed.slot + i]);
        },
        [](int /*row*/, int /*lane*/, const float* /*values*/) { return true; });
}

/// A face of its piece, and how far a point of each lane is beyond it.
struct FaceDistance {
    Real gap;
    Triple normal;
    Real face;
};

inline FaceDistance select(const Mask& mask, const FaceDistance& yes, const FaceDistance& no) {
    return {select(mask, yes.gap, no.gap), select(mask, yes.normal, no.normal),
            select(mask, yes.face, no.face)};
}

/// The two that it is farthest beyond.
struct FarthestFaces {
    FaceDistance first, second;
};

inline FarthestFaces findFarthestFaces(const PackedBody& body, const std::uint32_t* trackFeature,
                                       std::uint32_t bits, const Triple& point) {
    const FaceDistance none = {-kUntouchable, {0.0, 0.0, 0.0}, 0.0};
    FarthestFaces farthest = {none, none};
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
            const Plane plane = {
                {faces.row(kFaceNormalX)[f], faces.row(kFaceNormalY)[f], faces.row(kFaceNormalZ)[f]},
                faces.row(kPlaneOffset)[f]};
            const FaceDistance own = {distanceBeyond(plane, point), plane.normal, Real(f)};
            const Mask counts = asked && own.gap > Real(faces.row(kCountsFrom)[f]);
            const Mask farther = counts && own.gap > farthest.first.gap;
            farthest.second = select(counts && own.gap > farthest.second.gap, own, farthest.second);
            farthest.second = select(farther, farthest.first, farthest.second);
            farthest.first = select(farther, own, farthest.first);
        }
    }
    return farthest;
}

inline void lookAtFaces(TrialLanes& group, const PlacedLanes& placed, PairTable& pairs, Looked& looked) {
    int* rows = group.rowsToLookAt(pairs.rows());
    const int due = listDue(placed, pairs, rows);
    for (int i = 0; i < due; ++i) {
        const int row = rows[i];
        const Triple arm = pairThree(pairs, row, kPointX, placed.slot) - placed.away;
        const Triple point = multiplyTransposed(placed.axes, arm);
        const Real distance = distanceBeyond(
            {pairThree(pairs, row, kFaceX, placed.slot), load(pairs.field(row, kFaceOffset) + placed.slot)},
            point);
        setDue(placed, pairs, row, distance);
        const Mask near = distance < placed.margin;
        if (!any(near)) continue;

        const FarthestFaces farthest = findFarthestFaces(
            *group.model().body, pairs.trackFeature(row) + placed.slot, bitsOf(near), point);
        const FaceDistance& first = farthest.first;
        const FaceDistance& second = farthest.second;
        const Mask within = near && second.gap <= Real(-kBorder);
        // Which faces they are belongs to the contacts' names.
        store(first.face, pairs.faces(row, kFaceFound) + placed.slot);
        store(second.face, pairs.faces(row, kOtherFaceFound) + placed.slot);
        const auto put = [&](int coded, const Mask& touching, const FaceDistance& face) {
            stage(group, placed, coded, {touching, arm, Real(-1.0) * (placed.axes * face.normal), face.gap});
        };
        put(row, within && first.gap < placed.margin && first.gap > Real(-kDeepest), first);
        // Near to a border of the face that it lies below a vertex is less deep from beside.
        put(~row, within && first.gap <= Real(0.0) && second.gap > Real(-kDeepest), second);
    }
    looked.due = min(looked.due, findNextDue(placed, pairs));
    const auto rowOf = [](int coded) { return coded < 0 ? ~coded : coded; };
    looked.carries |= addStaged(
        group, placed,
        [&](int coded, int i) {
            const int row = rowOf(coded);
            const float* faces = pairs.faces(row, coded < 0 ? kOtherFaceFound : kFaceFound);
            return nameContact(pairs.trackFeature(row)[placed.slot + i],
                               static_cast<std::uint32_t>(faces[placed.slot + i]));
        },
        [&](int coded, int i, const float* values) {
            // The track must lie below the face: a part that slides level over a border is not stopped by it.
            const PackedTrack& track = *group.track[placed.lane + i];
            const std::uint32_t feature = pairs.trackFeature(rowOf(coded))[placed.slot + i];
            const PackedVertex& vertex = track.vertices[indexOf(feature)];
            const auto leads = [&](int e, const float* normals, float way) {
                const float normal[3] = {normals[kNormalX * kWidestVector], normals[kNormalY * kWidestVector],
                                         normals[kNormalZ * kWidestVector]};
                return way * dotThree(normal, track.vertexEdges.data() + 3 * static_cast<std::ptrdiff_t>(e)) >
                       static_cast<float>(kConeSlack);
            };
            const auto noEdge = [&](const auto& isSo) {
                bool none = true;
                for (int e = vertex.firstEdge; e < vertex.firstEdge + vertex.edgeCount; ++e)
                    none &= !isSo(e);
                return none;
            };
            const float* first = coded < 0 ? values - StagedContacts::kBlock : values;
            const float* second = first + StagedContacts::kBlock;
            const auto carries = [&](const float* normals, const float* beside) {
                return noEdge([&](int e) { return leads(e, normals, 1.0F) && !leads(e, beside, -1.0F); });
            };
            if (noEdge([&](int e) { return leads(e, first, 1.0F); })) return coded >= 0;
            const float gap = first[kGap * kWidestVector];
            if (gap > 0.0F || second[kGap * kWidestVector] <= static_cast<float>(-kDeepest)) return false;
            // What of the track rises beyond the border between the faces is beside the part, not above it.
            if (carries(second, first)) return coded < 0;
            return coded >= 0 && gap <= static_cast<float>(-kBorder) && carries(first, second);
        });
}

/// Fills the lists of contacts of a vector of lanes; returns the bits of those that an impulse acts on.
inline std::uint32_t findContactsOf(TrialLanes& group, int lane) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    const int end = std::min(lane + width, group.count());
    for (int i = lane; i < end; ++i)
        group.found[static_cast<std::size_t>(i)].clear();
    const std::uint32_t there = (1U << static_cast<unsigned>(end - lane)) - 1U;
    const Real reach = get(group, kStepPath, lane) + get(group, kStepTurned, lane);
    const Real margin = Real(1.1) * reach + Real(kMargin) + get(group, kPushed, lane);
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
