// Impulses: lanes with about equally many contacts are solved together, one lane of the vector each. Included
// once per instruction set, inside HWY_NAMESPACE. The law itself is sim/contact/formulas/step.inl.

using Index = hn::Vec<hn::RebindToSigned<Tag>>;

inline Real gather(const TrialLanes& group, int field, Index lanes) {
    return Real(hn::GatherIndex(Tag(), group.field(field), lanes));
}
inline Triple gatherThree(const TrialLanes& group, int field, Index lanes) {
    return {gather(group, field, lanes), gather(group, field + 1, lanes), gather(group, field + 2, lanes)};
}

/// What turns scaled quantities (formulas/step.inl) into those of the room's axes, for each lane of a vector.
struct Scaling {
    Matrix axes;  // part -> room
    const LaneModel* model;

    /// S^T in room axes.
    [[nodiscard]] Matrix turns() const {
        Matrix result;
        for (int k = 0; k < 3; ++k) {
            // Column k of the rotation times S, which is lower triangular.
            Triple column = {Real(0.0), Real(0.0), Real(0.0)};
            for (int i = k; i < 3; ++i) {
                const Triple axis = axisOf(i);
                column = mulAdd(Real(model->scale[i][k]), axis, column);
            }
            result.row[k] = column;
        }
        return result;
    }
    [[nodiscard]] Triple scale(const Triple& spin) const {
        return multiply(model->unscale, multiplyTransposed(axes, spin));
    }
    [[nodiscard]] Triple unscale(const Triple& spin) const { return axes * multiply(model->scale, spin); }

 private:
    [[nodiscard]] Triple axisOf(int i) const {
        if (i == 0) return {axes.row[0].x, axes.row[1].x, axes.row[2].x};
        if (i == 1) return {axes.row[0].y, axes.row[1].y, axes.row[2].y};
        return {axes.row[0].z, axes.row[1].z, axes.row[2].z};
    }
};

/// How each lane's track moves.
struct TrackMotion {
    Real sine, cosineLess;                                // placement
    Real rateX, rateZ, sineRate, cosineLessRate;          // over this step
    Real beforeX, beforeZ, sineBefore, cosineLessBefore;  // over the step before
    Real x, y;                                            // of the part

    [[nodiscard]] Triple turn(const Triple& v) const {
        return {v.x + cosineLess * v.x - sine * v.y, v.y + sine * v.x + cosineLess * v.y, v.z};
    }
    [[nodiscard]] Triple velocity(const Triple& arm) const {
        const Real px = x + arm.x;
        const Real py = y + arm.y;
        return {rateX + cosineLessRate * px - sineRate * py, sineRate * px + cosineLessRate * py, rateZ};
    }
    [[nodiscard]] Triple velocityBefore(const Triple& arm) const {
        const Real px = x + arm.x;
        const Real py = y + arm.y;
        return {beforeX + cosineLessBefore * px - sineBefore * py, sineBefore * px + cosineLessBefore * py,
                beforeZ};
    }
};

inline TrackMotion gatherTrackMotion(const TrialLanes& group, Index lanes) {
    TrackMotion motion;
    motion.rateX = gather(group, kRateX, lanes);
    motion.rateZ = gather(group, kRateZ, lanes);
    motion.beforeX = gather(group, kRateBeforeX, lanes);
    motion.beforeZ = gather(group, kRateBeforeZ, lanes);
    if (group.model().anyBowl) {
        motion.sine = gather(group, kSine, lanes);
        motion.cosineLess = gather(group, kCosineLess, lanes);
        motion.sineRate = gather(group, kSineRate, lanes);
        motion.cosineLessRate = gather(group, kCosineLessRate, lanes);
        motion.sineBefore = gather(group, kSineRateBefore, lanes);
        motion.cosineLessBefore = gather(group, kCosineLessRateBefore, lanes);
        motion.x = gather(group, kPositionX, lanes);
        motion.y = gather(group, kPositionY, lanes);
    }
    return motion;
}

inline Real loadTouch(SolveBatch& batch, int row, int field) {
    return load(batch.touch(row, field));
}
inline Triple loadTouchThree(SolveBatch& batch, int row, int field) {
    return {loadTouch(batch, row, field), loadTouch(batch, row, field + 1), loadTouch(batch, row, field + 2)};
}

/// A contact that does nothing.
inline void clearTouch(SolveBatch& batch, int row, int slot) {
    for (int f = 0; f < kContactFields; ++f)
        batch.touch(row, f)[slot] = f == kGap ? 1.0F : 0.0F;
}

inline MovingContact loadContact(const TrialLanes& group, SolveBatch& batch, int row,
                                 const TrackMotion& track) {
    MovingContact touch;
    touch.arm = loadTouchThree(batch, row, kArmX);
    touch.normal = loadTouchThree(batch, row, kNormalX);
    touch.gap = loadTouch(batch, row, kGap);
    if (group.model().anyBowl) {
        touch.arm = track.turn(touch.arm);
        touch.normal = track.turn(touch.normal);
        touch.trackVelocity = track.velocity(touch.arm);
        touch.trackVelocityBefore = track.velocityBefore(touch.arm);
    } else {
        touch.trackVelocity = {track.rateX, Real(0.0), track.rateZ};
        touch.trackVelocityBefore = {track.beforeX, Real(0.0), track.beforeZ};
    }
    const Real state = loadTouch(batch, row, kState);
    touch.known = state >= Real(kStuckContact);
    touch.slid = state >= Real(kSlidContact);
    touch.normalImpulse = loadTouch(batch, row, kNormalImpulse);
    touch.tangentialImpulse = {loadTouch(batch, row, kAlongImpulse), loadTouch(batch, row, kAcrossImpulse)};
    return touch;
}

/// Into the lanes of the slots that are set in `bits`.
inline void scatterThree(TrialLanes& group, const SolveBatch& batch, std::uint32_t bits, int field,
                         const Triple& value) {
    alignas(64) float values[3][kWidestVector];
    store(value.x, values[0]);
    store(value.y, values[1]);
    store(value.z, values[2]);
    for (int k = 0; k < 3; ++k) {
        float* to = group.field(field + k);
        forEachBit(bits,
                   [&](int slot) { to[batch.lanes[static_cast<std::size_t>(slot)]] = values[k][slot]; });
    }
}

/// Lanes that have not converged after so many iterations wait for others to be solved with, so that a few
/// slow ones do not hold up the rest of a vector.
constexpr int kFirstRound = 8;

/// Has one lane wait to be solved with those that have as many contacts.
inline void await(const TrialLanes& group, LanesByContacts& waiting, int lane) {
    waiting[group.found[static_cast<std::size_t>(lane)].size()].push_back(lane);
}

/// Gives the contacts of one lane what the last step left, and has the lane wait to be solved.
inline void beginSolving(TrialLanes& group, int lane) {
    const auto place = static_cast<std::size_t>(lane);
    const WarmStartCache& memory = group.warmStarts[place];
    ContactList& found = group.found[place];
    for (std::size_t i = 0; i < found.size(); ++i) {
        Contact& contact = found[i];
        int known = 0;
        while (known < memory.count && memory.feature[known] != contact.feature)
            ++known;
        const bool remembered = known < memory.count;
        contact.values[kNormalImpulse] = remembered ? memory.normal[known] : 0.0F;
        contact.values[kAlongImpulse] = remembered ? memory.along[known] : 0.0F;
        contact.values[kAcrossImpulse] = remembered ? memory.across[known] : 0.0F;
        const ContactState state =
            remembered ? (memory.slid[known] ? kSlidContact : kStuckContact) : kNewContact;
        contact.values[kState] = static_cast<float>(state);
    }
    group.plastic[place] = 0;
    group.smooth[place] = 0;
    await(group, group.carrying, lane);
}

/// Has a lane solved for what it hits later in the step.
inline void awaitNextMoment(TrialLanes& group, int lane) {
    const auto place = static_cast<std::size_t>(lane);
    ContactList& found = group.found[place];
    for (std::size_t i = 0; i < found.size(); ++i)
        std::fill_n(found[i].values.begin() + kNormalImpulse, 3, 0.0F);
    group.plastic[place] = 0;
    group.smooth[place] = 0;
    await(group, group.carrying, lane);
}

/// Takes up from the round before; impacts of `plastic` lanes are plastic, `smooth` ones have no friction.
inline void goOn(ContactConstraint* rows, SolveBatch& batch, Mask plastic, Mask smooth) {
    for (int r = 0; r < batch.rows; ++r) {
        ContactConstraint& row = rows[r];
        row.normal = loadTouch(batch, r, kNormalImpulse);
        row.tangential = {loadTouch(batch, r, kAlongImpulse), loadTouch(batch, r, kAcrossImpulse)};
        row.shape = {loadTouch(batch, r, kOnTheWay) > Real(0.0),
                     {loadTouch(batch, r, kDirectionAlong), loadTouch(batch, r, kDirectionAcross)}};
        row.target = select(plastic, min(row.target, Real(0.0)), row.target);
        row.friction = select(smooth, Real(0.0), row.friction);
    }
}

/// Remembers what the contacts of these slots' lanes gave.
inline void remember(TrialLanes& group, const SolveBatch& batch, const ContactConstraint* rows,
                     std::uint32_t bits) {
    forEachBit(bits, [&](int slot) {
        const auto lane = static_cast<std::size_t>(batch.lanes[static_cast<std::size_t>(slot)]);
        const ContactList& found = group.found[lane];
        WarmStartCache& memory = group.warmStarts[lane];
        memory.count = static_cast<int>(found.size());
        memory.carrying = 0;
        for (int i = 0; i < memory.count; ++i)
            memory.feature[i] = found[static_cast<std::size_t>(i)].feature;
    });
    for (int r = 0; r < batch.rows; ++r) {
        const ContactConstraint& row = rows[r];
        alignas(64) float normal[kWidestVector];
        alignas(64) float along[kWidestVector];
        alignas(64) float across[kWidestVector];
        // The impulse of an impact says nothing about the next step's.
        const Mask impact = row.impactTime <= Real(1.0);
        store(select(impact, Real(0.0), row.normal), normal);
        store(select(impact, Real(0.0), row.tangential.x), along);
        store(select(impact, Real(0.0), row.tangential.y), across);
        const std::uint32_t sliding = bitsOf(row.sliding);
        const std::uint32_t carrying = bitsOf(row.normal > Real(0.0));
        forEachBit(bits, [&](int slot) {
            WarmStartCache& memory =
                group.warmStarts[static_cast<std::size_t>(batch.lanes[static_cast<std::size_t>(slot)])];
            if (r >= memory.count) return;
            memory.normal[r] = normal[slot];
            memory.along[r] = along[slot];
            memory.across[r] = across[slot];
            memory.slid[r] = ((sliding >> static_cast<unsigned>(slot)) & 1U) != 0;
            memory.carrying += static_cast<int>((carrying >> static_cast<unsigned>(slot)) & 1U);
        });
    }
}

/// Keeps what the contacts of these slots' lanes gave.
inline void record(std::vector<RecordedImpulse>& recorded, SolveBatch& batch, const ContactConstraint* rows,
                   std::uint32_t bits) {
    for (int r = 0; r < batch.rows; ++r) {
        const ContactConstraint& row = rows[r];
        const Triple impulse =
            row.normal * row.axis[0] + row.tangential.x * row.axis[1] + row.tangential.y * row.axis[2];
        alignas(64) float values[4][kWidestVector];
        store(row.normal, values[0]);
        store(impulse.x, values[1]);
        store(impulse.y, values[2]);
        store(impulse.z, values[3]);
        forEachBit(bits, [&](int slot) {
            if (values[0][slot] <= 0.0F) return;
            const int lane = batch.lanes[static_cast<std::size_t>(slot)];
            const base::Vec3 arm(batch.touch(r, kArmX)[slot], batch.touch(r, kArmY)[slot],
                                 batch.touch(r, kArmZ)[slot]);
            const base::Vec3 given(values[1][slot], values[2][slot], values[3][slot]);
            const auto known = std::find_if(
                recorded.begin(), recorded.end(),
                [&](const RecordedImpulse& other) { return other.lane == lane && other.arm == arm; });
            if (known != recorded.end())
                known->impulse += given;
            else
                recorded.push_back({lane, arm, given});
        });
    }
}

/// Has the lanes of these slots solved further, from what their contacts have now; those of `energetic`
/// from nothing with plastic impacts, those of `burst` also without friction.
inline void awaitAgain(TrialLanes& group, const SolveBatch& batch, const ContactConstraint* rows,
                       std::uint32_t bits, std::uint32_t energetic, std::uint32_t burst) {
    alignas(64) float states[kMostContacts][6][kWidestVector];
    for (int r = 0; r < batch.rows; ++r) {
        store(rows[r].normal, states[r][0]);
        store(rows[r].tangential.x, states[r][1]);
        store(rows[r].tangential.y, states[r][2]);
        store(select(rows[r].shape.onTheWay, Real(1.0), Real(0.0)), states[r][3]);
        store(rows[r].shape.direction.x, states[r][4]);
        store(rows[r].shape.direction.y, states[r][5]);
    }
    forEachBit(bits, [&](int slot) {
        const std::int32_t lane = batch.lanes[static_cast<std::size_t>(slot)];
        const auto place = static_cast<std::size_t>(lane);
        const bool isBurst = ((burst >> static_cast<unsigned>(slot)) & 1U) != 0;
        const bool fromNothing = isBurst || ((energetic >> static_cast<unsigned>(slot)) & 1U) != 0;
        if (fromNothing) group.plastic[place] = 1;
        if (isBurst) group.smooth[place] = 1;
        ContactList& found = group.found[place];
        for (std::size_t i = 0; i < found.size(); ++i) {
            auto& values = found[i].values;
            for (std::size_t k = 0; k < 3; ++k) {
                values[kNormalImpulse + k] = fromNothing ? 0.0F : states[i][k][slot];
                values[kOnTheWay + k] = isBurst ? 0.0F : states[i][3 + k][slot];
            }
        }
        await(group, group.unfinished, lane);
    });
}

/// Solves all lanes of a batch, as far as its round does, and empties it.
inline void solveBatch(TrialLanes& group, SolveBatch& batch) {
    // Slots that are left over do what the first one does, without its contacts.
    for (int slot = batch.filled; slot < static_cast<int>(hn::Lanes(Tag())); ++slot) {
        batch.lanes[static_cast<std::size_t>(slot)] = batch.lanes[0];
        for (int row = 0; row < batch.rows; ++row)
            clearTouch(batch, row, slot);
    }
    const Index lanes = hn::LoadU(hn::RebindToSigned<Tag>(), batch.lanes.data());
    const Scaling scaling{{{gatherThree(group, kAxes, lanes), gatherThree(group, kAxes + 3, lanes),
                            gatherThree(group, kAxes + 6, lanes)}},
                          &group.model()};
    const auto gatherMotion = [&](int velocity, int spin) {
        return Motion{gatherThree(group, velocity, lanes), scaling.scale(gatherThree(group, spin, lanes))};
    };
    const Motion free = gatherMotion(kAfterX, kAfterSpinX);
    const StepMotion motion = {gatherMotion(kVelocityX, kSpinX), free,
                               gatherMotion(kAdvanceX, kAdvanceSpinX) - free};
    const Law law = {gather(group, kStaticFriction, lanes), gather(group, kKineticFriction, lanes),
                     gather(group, kRestitution, lanes)};
    const TrackMotion track = gatherTrackMotion(group, lanes);
    const Matrix turns = scaling.turns();
    const Real dt = group.model().dt;
    ContactConstraint rows[kMostContacts];
    for (int row = 0; row < batch.rows; ++row)
        prepareConstraint(rows[row], loadContact(group, batch, row, track), turns, motion, law, dt);
    takeFirstImpacts(rows, batch.rows, dt);
    std::uint32_t plastic = 0;
    std::uint32_t smooth = 0;
    if (batch.shaped) {
        for (int slot = 0; slot < batch.filled; ++slot) {
            const auto lane = static_cast<std::size_t>(batch.lanes[static_cast<std::size_t>(slot)]);
            plastic |= std::uint32_t{group.plastic[lane]} << static_cast<unsigned>(slot);
            smooth |= std::uint32_t{group.smooth[lane]} << static_cast<unsigned>(slot);
        }
        goOn(rows, batch, maskOf(plastic), maskOf(smooth));
    }

    const std::uint32_t there = (1U << static_cast<unsigned>(batch.filled)) - 1U;
    const int iterations = batch.shaped ? kMaxIterations - kFirstRound : kFirstRound;
    const auto solved =
        iterate(rows, batch.rows, free, !maskOf(there), iterations, batch.shaped ? kFirstRound : 0);
    const Motion& after = solved.motion;
    const std::uint32_t iterated = batch.shaped ? there : bitsOf(solved.converged) & there;
    const Real work = calcWork(rows, batch.rows, after);
    const Mask energy = anyImpact(rows, batch.rows) && work > Real(0.0);
    const std::uint32_t energetic = bitsOf(energy) & iterated & ~plastic;
    const std::uint32_t burst = bitsOf(hasBurst(solved.converged, work)) & iterated & ~energetic & ~smooth;
    const std::uint32_t settled = iterated & ~energetic & ~burst;
    const bool last = group.moment + 1 == kMostMoments;
    const Motion own = advancePose(rows, batch.rows, free, after, dt, last);
    const Motion advance = motion.offset + own;
    const std::uint32_t more = last ? 0 : bitsOf(reachesLater(rows, batch.rows, own, dt)) & settled;

    scatterThree(group, batch, settled, kAfterX, after.velocity);
    scatterThree(group, batch, settled, kAfterSpinX, scaling.unscale(after.spin));
    scatterThree(group, batch, settled, kAdvanceX, advance.velocity);
    scatterThree(group, batch, settled, kAdvanceSpinX, scaling.unscale(advance.spin));
    // What carries over a step shows before its first impact.
    if (group.moment == 0) remember(group, batch, rows, settled);
    if (more != 0) {
        const Motion before = goOnAfter(motion, after, advance).before;
        scatterThree(group, batch, more, kVelocityX, before.velocity);
        scatterThree(group, batch, more, kSpinX, scaling.unscale(before.spin));
        forEachBit(more,
                   [&](int slot) { awaitNextMoment(group, batch.lanes[static_cast<std::size_t>(slot)]); });
    }
    if (group.recorded != nullptr) record(*group.recorded, batch, rows, settled);
    if (settled != there) awaitAgain(group, batch, rows, there & ~settled, energetic, burst);
    batch.filled = 0;
}

/// Puts the contacts of one lane into the next slot of the batch.
inline void enqueue(TrialLanes& group, int lane) {
    SolveBatch& batch = group.solveBatch;
    const int slot = batch.filled++;
    batch.lanes[static_cast<std::size_t>(slot)] = lane;
    const ContactList& found = group.found[static_cast<std::size_t>(lane)];
    const int count = static_cast<int>(found.size());
    const int fields = batch.shaped ? static_cast<int>(kContactFields) : kState + 1;
    for (int row = 0; row < count; ++row) {
        float* touch = batch.touch(row, 0) + slot;
        const auto& values = found[static_cast<std::size_t>(row)].values;
        for (int f = 0; f < fields; ++f)
            touch[f * kWidestVector] = values[static_cast<std::size_t>(f)];
    }
    for (int row = count; row < batch.rows; ++row)
        clearTouch(batch, row, slot);
}

/// Solves these lanes, those with like numbers of contacts side by side, as far as one round does.
inline void solveRound(TrialLanes& group, LanesByContacts& byContacts, bool shaped) {
    const int width = static_cast<int>(hn::Lanes(Tag()));
    SolveBatch& batch = group.solveBatch;
    batch.shaped = shaped;
    std::vector<std::int32_t>& waiting = group.waiting;
    waiting.clear();
    for (std::vector<std::int32_t>& lanes : byContacts) {
        waiting.insert(waiting.end(), lanes.begin(), lanes.end());
        lanes.clear();
    }
    const int count = static_cast<int>(waiting.size());
    for (int first = 0; first < count; first += width) {
        const int end = std::min(first + width, count);
        const auto last = static_cast<std::size_t>(waiting[static_cast<std::size_t>(end - 1)]);
        batch.rows = static_cast<int>(group.found[last].size());
        for (int i = first; i < end; ++i)
            enqueue(group, waiting[static_cast<std::size_t>(i)]);
        solveBatch(group, batch);
    }
}

inline bool anyOf(const LanesByContacts& byContacts) {
    return std::any_of(byContacts.begin(), byContacts.end(),
                       [](const std::vector<std::int32_t>& lanes) { return !lanes.empty(); });
}

/// Solves all lanes on which impulses act, impact after impact.
inline void solveCarrying(TrialLanes& group) {
    for (group.moment = 0; anyOf(group.carrying); ++group.moment) {
        solveRound(group, group.carrying, false);
        while (anyOf(group.unfinished))
            solveRound(group, group.unfinished, true);
    }
}

/// Remembers contacts that touch but carry nothing.
inline void rememberIdle(TrialLanes& group, int lane) {
    WarmStartCache& memory = group.warmStarts[static_cast<std::size_t>(lane)];
    const ContactList& found = group.found[static_cast<std::size_t>(lane)];
    memory.count = std::min(static_cast<int>(found.size()), WarmStartCache::kMost);
    memory.carrying = 0;
    for (int i = 0; i < memory.count; ++i) {
        memory.feature[i] = found[static_cast<std::size_t>(i)].feature;
        memory.normal[i] = 0.0F;
        memory.along[i] = 0.0F;
        memory.across[i] = 0.0F;
        memory.slid[i] = true;
    }
}
