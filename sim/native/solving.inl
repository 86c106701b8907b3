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
    touch.known = state > Real(0.5);
    touch.slid = state > Real(1.5);
    touch.normalImpulse = loadTouch(batch, row, kNormalImpulse);
    touch.tangentialImpulse = {loadTouch(batch, row, kAlongImpulse), loadTouch(batch, row, kAcrossImpulse)};
    return touch;
}

inline void scatterThree(TrialLanes& group, const SolveBatch& batch, int field, const Triple& value) {
    alignas(64) float values[3][kWidestVector];
    store(value.x, values[0]);
    store(value.y, values[1]);
    store(value.z, values[2]);
    for (int k = 0; k < 3; ++k) {
        float* to = group.field(field + k);
        for (int slot = 0; slot < batch.filled; ++slot)
            to[batch.lanes[slot]] = values[k][slot];
    }
}

inline void remember(TrialLanes& group, const SolveBatch& batch, const ContactConstraint* rows) {
    for (int slot = 0; slot < batch.filled; ++slot)
        group.warmStarts[batch.lanes[slot]].carrying = 0;
    for (int r = 0; r < batch.rows; ++r) {
        const ContactConstraint& row = rows[r];
        alignas(64) float normal[kWidestVector];
        alignas(64) float along[kWidestVector];
        alignas(64) float across[kWidestVector];
        // The impulse of an impact says nothing about the next step's.
        const Mask impact = row.target > Real(0.0);
        store(select(impact, Real(0.0), row.normal), normal);
        store(select(impact, Real(0.0), row.tangential.x), along);
        store(select(impact, Real(0.0), row.tangential.y), across);
        const std::uint32_t sliding = bitsOf(row.sliding);
        const std::uint32_t carrying = bitsOf(row.normal > Real(0.0));
        for (int slot = 0; slot < batch.filled; ++slot) {
            WarmStartCache& memory = group.warmStarts[batch.lanes[slot]];
            if (r >= memory.count) continue;
            memory.normal[r] = normal[slot];
            memory.along[r] = along[slot];
            memory.across[r] = across[slot];
            memory.slid[r] = ((sliding >> static_cast<unsigned>(slot)) & 1U) != 0;
            memory.carrying += static_cast<int>((carrying >> static_cast<unsigned>(slot)) & 1U);
        }
    }
}

/// Keeps what the contacts of the batch's first lane gave.
inline void record(std::vector<RecordedImpulse>& recorded, SolveBatch& batch, const ContactConstraint* rows) {
    for (int r = 0; r < batch.rows; ++r) {
        const ContactConstraint& row = rows[r];
        const Triple impulse =
            row.normal * row.axis[0] + row.tangential.x * row.axis[1] + row.tangential.y * row.axis[2];
        alignas(64) float values[4][kWidestVector];
        store(row.normal, values[0]);
        store(impulse.x, values[1]);
        store(impulse.y, values[2]);
        store(impulse.z, values[3]);
        if (values[0][0] <= 0.0F) continue;
        recorded.push_back({{batch.touch(r, kArmX)[0], batch.touch(r, kArmY)[0], batch.touch(r, kArmZ)[0]},
                            {values[1][0], values[2][0], values[3][0]}});
    }
}

/// Solves all lanes of a batch and empties it.
inline void solveBatch(TrialLanes& group, SolveBatch& batch) {
    // Slots that are left over do what the first one does, without its contacts.
    for (int slot = batch.filled; slot < static_cast<int>(hn::Lanes(Tag())); ++slot) {
        batch.lanes[slot] = batch.lanes[0];
        for (int row = 0; row < batch.rows; ++row) {
            for (int f = 0; f < kContactFields; ++f)
                batch.touch(row, f)[slot] = f == kGap ? 1.0F : 0.0F;
        }
    }
    const Index lanes = hn::LoadU(hn::RebindToSigned<Tag>(), batch.lanes.data());
    const Scaling scaling{{{gatherThree(group, kAxes, lanes), gatherThree(group, kAxes + 3, lanes),
                            gatherThree(group, kAxes + 6, lanes)}},
                          &group.model()};
    const Motion before = {gatherThree(group, kVelocityX, lanes),
                           scaling.scale(gatherThree(group, kSpinX, lanes))};
    const Motion free = {gatherThree(group, kAfterX, lanes),
                         scaling.scale(gatherThree(group, kAfterSpinX, lanes))};
    const Law law = {gather(group, kStaticFriction, lanes), gather(group, kKineticFriction, lanes),
                     gather(group, kRestitution, lanes)};
    const TrackMotion track = gatherTrackMotion(group, lanes);
    const Matrix turns = scaling.turns();
    const Real dt = group.model().dt;
    ContactConstraint rows[WarmStartCache::kMost];
    for (int row = 0; row < batch.rows; ++row)
        prepareConstraint(rows[row], loadContact(group, batch, row, track), turns, before, free, law, dt);
    const Motion after = solve(rows, batch.rows, free);
    const Motion advance = advancePose(rows, batch.rows, free, after, dt);

    scatterThree(group, batch, kAfterX, after.velocity);
    scatterThree(group, batch, kAfterSpinX, scaling.unscale(after.spin));
    scatterThree(group, batch, kAdvanceX, advance.velocity);
    scatterThree(group, batch, kAdvanceSpinX, scaling.unscale(advance.spin));
    remember(group, batch, rows);
    if (group.recorded != nullptr) record(*group.recorded, batch, rows);
    batch.filled = 0;
}

/// Puts the contacts of one lane, group.found, into the batch that they fit into.
inline void enqueue(TrialLanes& group, int lane) {
    const int count = static_cast<int>(group.found.size());
    std::size_t size = 0;
    while (kSolveRows[size] < count)
        ++size;
    SolveBatch& batch = group.solveBatches[size];
    const int slot = batch.filled++;
    batch.lanes[slot] = lane;

    WarmStartCache& memory = group.warmStarts[lane];
    const WarmStartCache old = memory;
    memory.count = count;
    for (int row = 0; row < batch.rows; ++row) {
        float* touch = batch.touch(row, 0) + slot;
        const auto set = [touch](int field, float value) { touch[field * kWidestVector] = value; };
        if (row >= count) {
            for (int f = 0; f < kContactFields; ++f)
                set(f, f == kGap ? 1.0F : 0.0F);
            continue;
        }
        const Contact& contact = group.found[static_cast<std::size_t>(row)];
        for (int k = 0; k < 3; ++k) {
            set(kArmX + k, contact.arm[k]);
            set(kNormalX + k, contact.normal[k]);
        }
        set(kGap, contact.gap);
        int known = 0;
        while (known < old.count && old.feature[known] != contact.feature)
            ++known;
        const bool found = known < old.count;
        set(kNormalImpulse, found ? old.normal[known] : 0.0F);
        set(kAlongImpulse, found ? old.along[known] : 0.0F);
        set(kAcrossImpulse, found ? old.across[known] : 0.0F);
        set(kState, found ? (old.slid[known] ? 2.0F : 1.0F) : 0.0F);
        memory.feature[row] = contact.feature;
    }
    if (batch.filled == static_cast<int>(hn::Lanes(Tag()))) solveBatch(group, batch);
}

/// Remembers contacts that touch but carry nothing.
inline void rememberIdle(TrialLanes& group, int lane) {
    WarmStartCache& memory = group.warmStarts[lane];
    memory.count = std::min(static_cast<int>(group.found.size()), WarmStartCache::kMost);
    memory.carrying = 0;
    for (int i = 0; i < memory.count; ++i) {
        memory.feature[i] = group.found[static_cast<std::size_t>(i)].feature;
        memory.normal[i] = 0.0F;
        memory.along[i] = 0.0F;
        memory.across[i] = 0.0F;
        memory.slid[i] = true;
    }
}
