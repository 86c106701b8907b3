// Free motion, the drive, and new poses: every lane, whole vectors. Included once per instruction set, inside
// HWY_NAMESPACE. The same scheme as sim/simbody/free_bodies: velocities live at the middles of steps.

/// A vector of lanes beginning with `lane`.
inline Real get(const TrialLanes& group, int field, int lane) {
    return load(group.field(field) + lane);
}
inline void set(TrialLanes& group, int field, int lane, Real value) {
    store(value, group.field(field) + lane);
}
inline Triple getThree(const TrialLanes& group, int field, int lane) {
    return {get(group, field, lane), get(group, field + 1, lane), get(group, field + 2, lane)};
}
inline void setThree(TrialLanes& group, int field, int lane, const Triple& value) {
    set(group, field, lane, value.x);
    set(group, field + 1, lane, value.y);
    set(group, field + 2, lane, value.z);
}
inline Real norm(const Triple& v) {
    return sqrt(dot(v, v));
}
inline Triple multiply(const float (&m)[3][3], const Triple& v) {
    return Matrix{{{m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}}} *
           v;
}
inline Triple multiplyTransposed(const Matrix& m, const Triple& v) {
    return mulAdd(v.x, m.row[0], mulAdd(v.y, m.row[1], v.z * m.row[2]));
}

inline Matrix toMatrix(Real w, Real x, Real y, Real z) {
    const Real one = 1.0;
    const Real two = 2.0;
    return {{{one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)},
             {two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)},
             {two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)}}};
}

/// Gravity and gyroscopic torque over the coming step.
inline void moveFreely(TrialLanes& group, int lane) {
    const LaneModel& model = group.model();
    const Real dt = model.dt;
    const Matrix axes = toMatrix(get(group, kRotationW, lane), get(group, kRotationX, lane),
                                 get(group, kRotationY, lane), get(group, kRotationZ, lane));
    for (int k = 0; k < 3; ++k)
        setThree(group, kAxes + 3 * k, lane, axes.row[k]);

    // The gyroscopic torque wants the angular velocity at the pose's time: half a step on.
    const Triple spin = getThree(group, kSpinX, lane);
    const Triple turnBefore = getThree(group, kTurnX, lane);
    const Triple now =
        spin + dt * (Real(0.875) * turnBefore - Real(0.375) * getThree(group, kTurnBeforeX, lane));
    const Triple inPart = multiplyTransposed(axes, now);
    const Triple torque = cross(multiply(model.inertia, inPart), inPart);
    const Triple turn = axes * multiply(model.inverseInertia, torque);
    setThree(group, kTurnBeforeX, lane, turnBefore);
    setThree(group, kTurnX, lane, turn);

    const Triple afterSpin = mulAdd(dt, turn, spin);
    Triple after = getThree(group, kVelocityX, lane);
    after.x = after.x - Real(model.gravityX) * dt;
    after.z = after.z - Real(model.gravityZ) * dt;
    setThree(group, kAfterSpinX, lane, afterSpin);
    setThree(group, kAdvanceSpinX, lane, afterSpin);
    setThree(group, kAfterX, lane, after);
    setThree(group, kAdvanceX, lane, after);
}

struct Turn {
    Real sine, cosineLess;  // of an angle, and its cosine - 1
};

/// Of an angle of at most some degrees.
inline Turn calcTurn(Real angle) {
    const Real square = angle * angle;
    return {angle * (Real(1.0) - square * Real(1.0 / 6.0) * (Real(1.0) - square * Real(1.0 / 20.0))),
            Real(-0.5) * square * (Real(1.0) - square * Real(1.0 / 12.0))};
}

/// Where the track is and how it moves.
inline void moveTrack(TrialLanes& group, int lane) {
    const Real rate = 1.0 / group.model().step;
    const Real along = get(group, kDriveAlong, lane);
    const Real up = get(group, kDriveUp, lane);
    const Real now = get(group, kDriveNow, lane);
    const Real onward = get(group, kDriveNext, lane) - now;
    const Real before = now - get(group, kDriveBefore, lane);
    set(group, kShiftX, lane, along * now);
    set(group, kShiftZ, lane, up * now);
    set(group, kRateX, lane, along * onward * rate);
    set(group, kRateZ, lane, up * onward * rate);
    set(group, kRateBeforeX, lane, along * before * rate);
    set(group, kRateBeforeZ, lane, up * before * rate);
    Triple trackStep = {along * onward, Real(0.0), up * onward};
    if (group.model().anyBowl) {
        const Real amplitude = get(group, kDriveTurn, lane);
        const Turn place = calcTurn(amplitude * now);
        const Turn next = calcTurn(amplitude * onward);
        const Turn last = calcTurn(amplitude * before);
        const Turn placeNext = calcTurn(amplitude * get(group, kDriveNext, lane));
        set(group, kSineNext, lane, placeNext.sine);
        set(group, kCosineLessNext, lane, placeNext.cosineLess);
        set(group, kSine, lane, place.sine);
        set(group, kCosineLess, lane, place.cosineLess);
        set(group, kSineRate, lane, next.sine * rate);
        set(group, kCosineLessRate, lane, next.cosineLess * rate);
        set(group, kSineRateBefore, lane, last.sine * rate);
        // Looking back: the rotation by the opposite angle.
        set(group, kCosineLessRateBefore, lane, -last.cosineLess * rate);
        const Real x = get(group, kPositionX, lane);
        const Real y = get(group, kPositionY, lane);
        trackStep.x = trackStep.x + next.cosineLess * x - next.sine * y;
        trackStep.y = next.sine * x + next.cosineLess * y;
    }
    setThree(group, kTrackStepX, lane, trackStep);
}

/// What moves detection on: way of the part's centre relative to the track in the track's axes, its length,
/// and how far any point of the part can come by turning.
struct Progress {
    Triple way;
    Real path, turned;
};

inline Progress calcProgress(const TrialLanes& group, int lane, int velocityField, int spinField) {
    const Real dt = group.model().dt;
    const Real radius = group.model().body->radius;
    Progress progress;
    progress.way = dt * getThree(group, velocityField, lane) - getThree(group, kTrackStepX, lane);
    progress.path = norm(progress.way);
    progress.turned = norm(getThree(group, spinField, lane)) * dt * radius;
    if (group.model().anyBowl) {
        progress.turned = progress.turned + abs(get(group, kSineRate, lane)) * dt * radius;
        const Real sine = get(group, kSineNext, lane);
        const Real less = get(group, kCosineLessNext, lane);
        progress.way = {progress.way.x + less * progress.way.x + sine * progress.way.y,
                        progress.way.y + less * progress.way.y - sine * progress.way.x, progress.way.z};
    }
    return progress;
}

inline void lookAhead(TrialLanes& group, int lane) {
    const Progress step = calcProgress(group, lane, kAfterX, kAfterSpinX);
    setThree(group, kStepX, lane, step.way);
    set(group, kStepPath, lane, step.path);
    set(group, kStepTurned, lane, step.turned);
}

/// The pose at the step's end.
inline void movePose(TrialLanes& group, int lane) {
    const Real dt = group.model().dt;
    const Progress step = calcProgress(group, lane, kAdvanceX, kAdvanceSpinX);
    set(group, kGone, lane, get(group, kGone, lane) + step.path + step.turned);

    // A rotation whose axis wanders is not the mean angular velocity times the step: the next terms of
    // Magnus' series (Iserles et al. 2000, section 4).
    const Triple turn = getThree(group, kTurnX, lane);
    Triple spin = getThree(group, kAdvanceSpinX, lane);
    spin = spin + (dt * dt * Real(1.0 / 12.0)) * cross(turn, spin) +
           (dt * Real(1.0 / 24.0)) * (turn - getThree(group, kTurnBeforeX, lane));

    // The rate is tangent to the unit sphere: go along it by the tangent of the angle, then back onto the
    // sphere.
    const Real halfSquare = Real(0.25) * dt * dt * dot(spin, spin);
    const Real half = Real(0.5) * dt * (Real(1.0) + halfSquare * Real(1.0 / 3.0));
    const Real w = get(group, kRotationW, lane);
    const Triple q = getThree(group, kRotationX, lane);
    const Real newW = w - half * dot(spin, q);
    const Triple newQ = mulAdd(half, mulAdd(w, spin, cross(spin, q)), q);
    const Real scale = Real(1.0) / sqrt(newW * newW + dot(newQ, newQ));
    set(group, kRotationW, lane, newW * scale);
    setThree(group, kRotationX, lane, scale * newQ);

    setThree(group, kVelocityX, lane, getThree(group, kAfterX, lane));
    setThree(group, kSpinX, lane, getThree(group, kAfterSpinX, lane));

    // The drive one step on. A whole turn is all the values of 32 bits.
    const hn::RebindToSigned<Tag> whole;
    const hn::RebindToUnsigned<Tag> bits;
    const auto phase = hn::Load(bits, group.phase.data() + lane);
    set(group, kDriveBefore, lane, get(group, kDriveNow, lane));
    set(group, kDriveNow, lane, get(group, kDriveNext, lane));
    const Real angle =
        Real(hn::ConvertTo(Tag(), hn::BitCast(whole, phase))) * Real(2.0 * base::kPi / 4294967296.0);
    set(group, kDriveNext, lane, sin(angle));
    hn::Store(hn::Add(phase, hn::Load(bits, group.cycle.data() + lane)), bits, group.phase.data() + lane);
}

inline void movePositions(TrialLanes& group) {
    const hn::ScalableTag<double> doubles;
    const hn::Rebind<float, decltype(doubles)> floats;
    const auto dt = hn::Set(doubles, group.model().step);
    const int lanes = static_cast<int>(hn::Lanes(doubles));
    for (int lane = 0; lane < group.count(); lane += lanes) {
        for (int k = 0; k < 3; ++k) {
            double* position = group.position(k) + lane;
            const auto speed = hn::PromoteTo(doubles, hn::Load(floats, group.field(kAdvanceX + k) + lane));
            const auto moved = hn::MulAdd(dt, speed, hn::Load(doubles, position));
            hn::Store(moved, doubles, position);
            if (k < 2) hn::Store(hn::DemoteTo(floats, moved), floats, group.field(kPositionX + k) + lane);
        }
    }
}
