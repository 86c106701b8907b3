// Which contacts one part has with its track: lane by lane, whole vectors of what is near it. Included once
// per instruction set, inside HWY_NAMESPACE.

/// How far a part may travel before the list of near-by features is made anew. [m]
constexpr float kSkin = 4e-3F;

/// Where detection of one lane stands, before or after the coming step.
struct Standing {
    Triple way;
    Real path, turned;
};

inline Real boundOf(const Candidates& candidates, int first, const Standing& standing) {
    const Triple normal = {load(candidates.normalX.data() + first), load(candidates.normalY.data() + first),
                           load(candidates.normalZ.data() + first)};
    return load(candidates.start.data() + first) + dot(normal, standing.way) - standing.turned -
           load(candidates.blind.data() + first) * standing.path;
}

inline Bound testFeature(const TrialLanes& group, const Placed& placed, std::uint32_t name) {
    const PackedPiece& piece = group.model().body->pieces[(name >> kPieceShift) & 0x3FFU];
    const int index = static_cast<int>(name & 0xFFFFFU);
    switch (name >> kKindShift) {
        case kVertexOnTriangle:
            return testTriangle(placed, piece, name, index);
        case kEdgeAcrossEdge:
            return testEdge(placed, piece, name, index);
        default:
            return testTrackVertex(placed, piece, name, index);
    }
}

inline void setBound(const TrialLanes& group, int lane, Candidates& candidates, int c, const Bound& bound) {
    const float way[3] = {group.field(kWayX)[lane], group.field(kWayY)[lane], group.field(kWayZ)[lane]};
    const float blind = bound.blind ? 1.0F : 0.0F;
    const auto place = static_cast<std::size_t>(c);
    candidates.start[place] = bound.distance - dotThree(bound.direction, way) + group.field(kTurned)[lane] +
                              blind * group.field(kPath)[lane];
    candidates.normalX[place] = bound.direction[0];
    candidates.normalY[place] = bound.direction[1];
    candidates.normalZ[place] = bound.direction[2];
    candidates.blind[place] = blind;
}

/// Adds the features among `balls` that are near one piece: first by their balls, then by their own bounds.
inline void addNear(TrialLanes& group, int lane, const Placed& placed, const BallArrays& balls,
                    const float* centre, float near, std::uint32_t name) {
    Candidates& candidates = group.candidates[lane];
    const int width = static_cast<int>(hn::Lanes(Tag()));
    for (int first = 0; first < balls.count; first += width) {
        const Triple away =
            Triple{load(balls.x.data() + first), load(balls.y.data() + first), load(balls.z.data() + first)} -
            broadcast(centre);
        const Real far = load(balls.radius.data() + first) + Real(near);
        std::uint32_t bits = bitsOf(dot(away, away) < far * far);
        for (; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::uint32_t>(first) +
                           static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
            const Bound bound = testFeature(group, placed, name | i);
            if (bound.distance >= placed.margin) continue;
            candidates.names.push_back(name | i);
            const auto padded =
                static_cast<std::size_t>(padToVectors(static_cast<int>(candidates.names.size())));
            candidates.start.resize(padded, kNever);
            for (AlignedVector<float>* array :
                 {&candidates.normalX, &candidates.normalY, &candidates.normalZ, &candidates.blind})
                array->resize(padded, 0.0F);
            setBound(group, lane, candidates, static_cast<int>(candidates.names.size()) - 1, bound);
        }
    }
}

/// The features within kSkin of the part.
inline void collectCandidates(TrialLanes& group, int lane) {
    Candidates& candidates = group.candidates[lane];
    candidates.names.clear();
    candidates.start.clear();
    // Counting anew from here keeps the numbers small and so exact.
    for (const int f : {kWayX, kWayY, kWayZ, kPath, kTurned})
        group.field(f)[lane] = 0.0F;
    Placed placed = place(group, lane);
    candidates.collectAt = kSkin + placed.margin;
    placed.margin = candidates.collectAt;
    const std::vector<PackedPiece>& pieces = group.model().body->pieces;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        float centre[3];
        toTrack(placed, pieces[p].centre, centre);
        for (int k = 0; k < 3; ++k)
            centre[k] = static_cast<float>(placed.position[k] + centre[k]);
        const float near = pieces[p].radius + placed.margin;
        const std::uint32_t piece = static_cast<std::uint32_t>(p) << kPieceShift;
        addNear(group, lane, placed, placed.track->triangleBalls, centre, near,
                (kVertexOnTriangle << kKindShift) | piece);
        addNear(group, lane, placed, placed.track->edgeBalls, centre, near,
                (kEdgeAcrossEdge << kKindShift) | piece);
        addNear(group, lane, placed, placed.track->vertexBalls, centre, near,
                (kFaceOnVertex << kKindShift) | piece);
    }
    candidates.count = static_cast<int>(candidates.names.size());
    group.found.clear();  // what lies within the skin is not within the margin
}

/// Fills group.found with the contacts of one lane, if any can carry in the coming step.
inline void findContacts(TrialLanes& group, int lane) {
    Candidates& candidates = group.candidates[lane];
    const float stepReach = group.field(kStepPath)[lane] + group.field(kStepTurned)[lane];
    const float margin = 1.1F * stepReach + kMargin;
    if (group.field(kPath)[lane] + group.field(kTurned)[lane] + margin >= candidates.collectAt)
        collectCandidates(group, lane);

    const float way[3] = {group.field(kWayX)[lane], group.field(kWayY)[lane], group.field(kWayZ)[lane]};
    const float step[3] = {group.field(kStepX)[lane], group.field(kStepY)[lane], group.field(kStepZ)[lane]};
    const float path = group.field(kPath)[lane];
    const float turned = group.field(kTurned)[lane];
    const Standing now = {broadcast(way), path, turned};
    const Standing next = {{way[0] + step[0], way[1] + step[1], way[2] + step[2]},
                           path + group.field(kStepPath)[lane],
                           turned + group.field(kStepTurned)[lane]};
    const int width = static_cast<int>(hn::Lanes(Tag()));
    Real leastNext = kNever;
    for (int first = 0; first < candidates.count; first += width)
        leastNext = min(leastNext, boundOf(candidates, first, next));
    if (!any(leastNext < Real(kReserve))) {
        Real least = kNever;
        for (int first = 0; first < candidates.count; first += width)
            least = min(least, boundOf(candidates, first, now));
        group.field(kNextLook)[lane] = std::min(path + turned + leastOf(least), candidates.collectAt);
        return;
    }

    group.field(kNextLook)[lane] = path + turned;
    const Placed placed = place(group, lane);
    // An impulse at one contact may turn the part toward another: what comes within half of the step's reach
    // counts.
    const Real near = 0.5F * stepReach + kMargin;
    for (int first = 0; first < candidates.count; first += width) {
        std::uint32_t bits = bitsOf(boundOf(candidates, first, next) < near);
        for (; bits != 0; bits &= bits - 1) {
            const int c = first + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
            setBound(group, lane, candidates, c,
                     testFeature(group, placed, candidates.names[static_cast<std::size_t>(c)]));
        }
    }
}

/// Leaves the contacts that can matter, as findContacts does with features, and tells whether any would
/// overlap more at the step's end if nothing held it: otherwise no impulse acts.
inline bool anyCarries(TrialLanes& group, int lane) {
    const float dt = group.model().dt;
    const float step[3] = {group.field(kStepX)[lane], group.field(kStepY)[lane], group.field(kStepZ)[lane]};
    float spin[3] = {group.field(kAfterSpinX)[lane], group.field(kAfterSpinY)[lane],
                     group.field(kAfterSpinZ)[lane]};
    if (group.model().anyBowl) {
        // Relative to the track, in its axes.
        const float sine = group.field(kSine)[lane];
        const float less = group.field(kCosineLess)[lane];
        const float x = spin[0];
        const float y = spin[1];
        spin[0] += less * x + sine * y;
        spin[1] += less * y - sine * x;
        spin[2] -= group.field(kSineRate)[lane];
    }
    const float near = 0.5F * (group.field(kStepPath)[lane] + group.field(kStepTurned)[lane]) + kMargin;
    bool carries = false;
    ContactList& found = group.found;
    const std::size_t count = found.size();
    found.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const Contact contact = found[i];
        const float* r = contact.arm;
        const float moved[3] = {step[0] + dt * (spin[1] * r[2] - spin[2] * r[1]),
                                step[1] + dt * (spin[2] * r[0] - spin[0] * r[2]),
                                step[2] + dt * (spin[0] * r[1] - spin[1] * r[0])};
        const float after = std::max(contact.gap, 0.0F) + dotThree(moved, contact.normal);
        carries |= after < 0.0F;
        found.next() = contact;
        found.keepIf(after < near);
    }
    return carries;
}
