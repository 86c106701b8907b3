// Free motion, the drive, and new poses: every lane, whole vectors. Included once per instruction set, inside
// HWY_NAMESPACE. The same scheme as sim/simbody/free_bodies: velocities live at the middles of steps.

/// A vector of lanes beginning with `lane`.
inline Real get(const Herd& herd, int field, int lane) {
    return load(herd.field(field) + lane);
}
inline void set(Herd& herd, int field, int lane, Real value) {
    store(value, herd.field(field) + lane);
}
inline Triple getThree(const Herd& herd, int field, int lane) {
    return {get(herd, field, lane), get(herd, field + 1, lane), get(herd, field + 2, lane)};
}
inline void setThree(Herd& herd, int field, int lane, const Triple& value) {
    set(herd, field, lane, value.x);
    set(herd, field + 1, lane, value.y);
    set(herd, field + 2, lane, value.z);
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
inline void moveFreely(Herd& herd, int lane) {
    const HerdModel& model = herd.model();
    const Real dt = model.dt;
    const Matrix axes = toMatrix(get(herd, kRotationW, lane), get(herd, kRotationX, lane),
                                 get(herd, kRotationY, lane), get(herd, kRotationZ, lane));
    for (int k = 0; k < 3; ++k)
        setThree(herd, kAxes + 3 * k, lane, axes.row[k]);

    // The gyroscopic torque wants the angular velocity at the pose's time: half a step on.
    const Triple spin = getThree(herd, kSpinX, lane);
    const Triple turnBefore = getThree(herd, kTurnX, lane);
    const Triple now =
        spin + dt * (Real(0.875) * turnBefore - Real(0.375) * getThree(herd, kTurnBeforeX, lane));
    const Triple inPart = multiplyTransposed(axes, now);
    const Triple torque = cross(multiply(model.inertia, inPart), inPart);
    const Triple turn = axes * multiply(model.inverseInertia, torque);
    setThree(herd, kTurnBeforeX, lane, turnBefore);
    setThree(herd, kTurnX, lane, turn);

    const Triple afterSpin = mulAdd(dt, turn, spin);
    Triple after = getThree(herd, kVelocityX, lane);
    after.z = after.z - Real(model.gravity) * dt;
    setThree(herd, kAfterSpinX, lane, afterSpin);
    setThree(herd, kAdvanceSpinX, lane, afterSpin);
    setThree(herd, kAfterX, lane, after);
    setThree(herd, kAdvanceX, lane, after);
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
inline void moveTrack(Herd& herd, int lane) {
    const Real rate = 1.0 / herd.model().step;
    const Real along = get(herd, kDriveAlong, lane);
    const Real up = get(herd, kDriveUp, lane);
    const Real now = get(herd, kDriveNow, lane);
    const Real onward = get(herd, kDriveNext, lane) - now;
    const Real before = now - get(herd, kDriveBefore, lane);
    set(herd, kShiftX, lane, along * now);
    set(herd, kShiftZ, lane, up * now);
    set(herd, kRateX, lane, along * onward * rate);
    set(herd, kRateZ, lane, up * onward * rate);
    set(herd, kRateBeforeX, lane, along * before * rate);
    set(herd, kRateBeforeZ, lane, up * before * rate);
    Triple trackStep = {along * onward, Real(0.0), up * onward};
    if (herd.model().anyBowl) {
        const Real amplitude = get(herd, kDriveTurn, lane);
        const Turn place = calcTurn(amplitude * now);
        const Turn next = calcTurn(amplitude * onward);
        const Turn last = calcTurn(amplitude * before);
        const Turn placeNext = calcTurn(amplitude * get(herd, kDriveNext, lane));
        set(herd, kSineNext, lane, placeNext.sine);
        set(herd, kCosineLessNext, lane, placeNext.cosineLess);
        set(herd, kSine, lane, place.sine);
        set(herd, kCosineLess, lane, place.cosineLess);
        set(herd, kSineRate, lane, next.sine * rate);
        set(herd, kCosineLessRate, lane, next.cosineLess * rate);
        set(herd, kSineRateBefore, lane, last.sine * rate);
        // Looking back: the rotation by the opposite angle.
        set(herd, kCosineLessRateBefore, lane, -last.cosineLess * rate);
        const Real x = get(herd, kPositionX, lane);
        const Real y = get(herd, kPositionY, lane);
        trackStep.x = trackStep.x + next.cosineLess * x - next.sine * y;
        trackStep.y = next.sine * x + next.cosineLess * y;
    }
    setThree(herd, kTrackStepX, lane, trackStep);
}

/// What moves detection on: way of the part's centre relative to the track in the track's axes, its length,
/// and how far any point of the part can come by turning.
struct Progress {
    Triple way;
    Real path, turned;
};

inline Progress calcProgress(const Herd& herd, int lane, int velocityField, int spinField) {
    const Real dt = herd.model().dt;
    const Real radius = herd.model().body->radius;
    Progress progress;
    progress.way = dt * getThree(herd, velocityField, lane) - getThree(herd, kTrackStepX, lane);
    progress.path = norm(progress.way);
    progress.turned = norm(getThree(herd, spinField, lane)) * dt * radius;
    if (herd.model().anyBowl) {
        progress.turned = progress.turned + abs(get(herd, kSineRate, lane)) * dt * radius;
        const Real sine = get(herd, kSineNext, lane);
        const Real less = get(herd, kCosineLessNext, lane);
        progress.way = {progress.way.x + less * progress.way.x + sine * progress.way.y,
                        progress.way.y + less * progress.way.y - sine * progress.way.x, progress.way.z};
    }
    return progress;
}

/// Added to what a part can come near in a step. [m]
constexpr double kReserve = 1e-6;

inline void lookAhead(Herd& herd, int lane) {
    const Progress step = calcProgress(herd, lane, kAfterX, kAfterSpinX);
    setThree(herd, kStepX, lane, step.way);
    set(herd, kStepPath, lane, step.path);
    set(herd, kStepTurned, lane, step.turned);
    const Real reach = get(herd, kPath, lane) + get(herd, kTurned, lane) + step.path + step.turned;
    std::uint32_t bits = bitsOf(reach + Real(kReserve) >= get(herd, kNextLook, lane));
    for (; bits != 0; bits &= bits - 1) {
        const int i = lane + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
        if (i < herd.count()) herd.looking.push_back(i);
    }
}

/// The pose at the step's end.
inline void movePose(Herd& herd, int lane) {
    const Real dt = herd.model().dt;
    const Progress step = calcProgress(herd, lane, kAdvanceX, kAdvanceSpinX);
    setThree(herd, kWayX, lane, getThree(herd, kWayX, lane) + step.way);
    set(herd, kPath, lane, get(herd, kPath, lane) + step.path);
    set(herd, kTurned, lane, get(herd, kTurned, lane) + step.turned);

    // A rotation whose axis wanders is not the mean angular velocity times the step: the next terms of
    // Magnus' series (Iserles et al. 2000, section 4).
    const Triple turn = getThree(herd, kTurnX, lane);
    Triple spin = getThree(herd, kAdvanceSpinX, lane);
    spin = spin + (dt * dt * Real(1.0 / 12.0)) * cross(turn, spin) +
           (dt * Real(1.0 / 24.0)) * (turn - getThree(herd, kTurnBeforeX, lane));

    // The rate is tangent to the unit sphere: go along it by the tangent of the angle, then back onto the
    // sphere.
    const Real halfSquare = Real(0.25) * dt * dt * dot(spin, spin);
    const Real half = Real(0.5) * dt * (Real(1.0) + halfSquare * Real(1.0 / 3.0));
    const Real w = get(herd, kRotationW, lane);
    const Triple q = getThree(herd, kRotationX, lane);
    const Real newW = w - half * dot(spin, q);
    const Triple newQ = mulAdd(half, mulAdd(w, spin, cross(spin, q)), q);
    const Real scale = Real(1.0) / sqrt(newW * newW + dot(newQ, newQ));
    set(herd, kRotationW, lane, newW * scale);
    setThree(herd, kRotationX, lane, scale * newQ);

    setThree(herd, kVelocityX, lane, getThree(herd, kAfterX, lane));
    setThree(herd, kSpinX, lane, getThree(herd, kAfterSpinX, lane));

    // The drive one step on. A whole turn is all the values of 32 bits.
    const hn::RebindToSigned<Tag> whole;
    const hn::RebindToUnsigned<Tag> bits;
    const auto phase = hn::Load(bits, herd.phase.data() + lane);
    set(herd, kDriveBefore, lane, get(herd, kDriveNow, lane));
    set(herd, kDriveNow, lane, get(herd, kDriveNext, lane));
    const Real angle =
        Real(hn::ConvertTo(Tag(), hn::BitCast(whole, phase))) * Real(2.0 * base::kPi / 4294967296.0);
    set(herd, kDriveNext, lane, sin(angle));
    hn::Store(hn::Add(phase, hn::Load(bits, herd.cycle.data() + lane)), bits, herd.phase.data() + lane);
}

inline void movePositions(Herd& herd) {
    const hn::ScalableTag<double> doubles;
    const hn::Rebind<float, decltype(doubles)> floats;
    const auto dt = hn::Set(doubles, herd.model().step);
    const int lanes = static_cast<int>(hn::Lanes(doubles));
    for (int lane = 0; lane < herd.count(); lane += lanes) {
        for (int k = 0; k < 3; ++k) {
            double* position = herd.position(k) + lane;
            const auto speed = hn::PromoteTo(doubles, hn::Load(floats, herd.field(kAdvanceX + k) + lane));
            const auto moved = hn::MulAdd(dt, speed, hn::Load(doubles, position));
            hn::Store(moved, doubles, position);
            if (k < 2) hn::Store(hn::DemoteTo(floats, moved), floats, herd.field(kPositionX + k) + lane);
        }
    }
}
