// The discrete contact law over one time step: impulses at the contacts of parts by projected Gauss-Seidel
// with warm starting. See README.md of this folder: included inside a namespace that defines Real.
//
// Written for one part on the track, a Motion and its ContactConstraints. Functions that are templates work
// on any other State and Row as well (several parts that touch each other, sim/contact/impulse_solver.cpp)
// for which there are velocityAlong, applyImpulse, squaredSpeed, workOf, blend and select.
//
// Scaled quantities, in which the part has mass 1 and inertia 1: impulses are per mass [m/s], `spin` is S^-1
// times the angular velocity, where S S^T is the inverse inertia times the mass, and `turn` is S^T times the
// torque's arm. [m/s], [1]

constexpr int kMaxIterations = 30;
/// After the first, the one that looks again at how friction turns within the step.
constexpr int kShapingIteration = 2;
/// Iterations end when no contact's velocity changes by more: this, and this share of the part's speed, so
/// that what rests stays where it is. [m/s], [1]
constexpr double kVelocityTolerance = 2e-6;
constexpr double kRelativeTolerance = 5e-5;
/// Share of an overlap that is taken back in one step, without giving the part speed.
constexpr double kRecovery = 0.2;
/// Overlaps that are left alone. [m]
constexpr double kOverlapTolerance = 1e-9;
/// Slower than this a new contact sticks if it can. [m/s]
constexpr double kStickSpeed = 1e-3;
/// The impact time of what does not collide in this step: no share of a step.
constexpr double kNoImpact = 2.0;

/// Velocity of the centre of mass and scaled angular velocity, or the impulses that change them.
struct Motion {
    Triple velocity, spin;
};

inline Motion select(Mask mask, const Motion& yes, const Motion& no) {
    return {select(mask, yes.velocity, no.velocity), select(mask, yes.spin, no.spin)};
}

/// A contact at the begin of a step. Zeros with a positive gap are a contact that does nothing.
struct MovingContact {
    Triple arm;                  // from the centre of mass to the point [m]
    Triple normal;               // unit, track -> part
    Real gap;                    // [m]
    Triple trackVelocity;        // of the track at the point, mean over this step [m/s]
    Triple trackVelocityBefore;  // the same over the step before [m/s]
    // What the last step left, if the same features touched then.
    Mask known;
    Real normalImpulse;
    Pair tangentialImpulse;
    Mask slid;
};

/// A contact's constraint: Jacobian rows and what is to be solved for.
struct ContactConstraint {
    Triple axis[3];  // normal and two tangents
    Triple turn[3];  // scaled arm x axis
    Real track[3];   // velocity of the track along the axes, mean over the step
    Real gap;
    Real normalInverse, normalMass;    // change of normal velocity by a unit normal impulse, and 1 / that
    Real tangentInverse, tangentMass;  // largest eigenvalue of the tangential inverse mass, and 1 / that
    Pair coupling;                     // change of tangential velocity by a unit normal impulse
    Real target;                       // least normal velocity after the step
    Real impactTime;                   // share of the step before an impact; kNoImpact: none
    Real friction;                     // coefficient
    Real normal;                       // impulse
    Pair tangential;
    Real speed[3];    // before any impulse, to tell the work done
    Pair slipBefore;  // tangential velocity in the step before
    Pair slipTarget;  // tangential velocity of what sticks
    FrictionShape shape;
    Mask sliding;
};

inline Real velocityAlong(const ContactConstraint& row, const Motion& motion, int k) {
    // Two short chains rather than a long one.
    return mulAdd(row.axis[k].x, motion.velocity.x,
                  mulAdd(row.axis[k].y, motion.velocity.y,
                         mulAdd(row.axis[k].z, motion.velocity.z, -row.track[k]))) +
           dot(row.turn[k], motion.spin);
}

inline void applyImpulse(const ContactConstraint& row, Motion& motion, int k, Real impulse) {
    motion.velocity = mulAdd(impulse, row.axis[k], motion.velocity);
    motion.spin = mulAdd(impulse, row.turn[k], motion.spin);
}

inline Real squaredSpeed(const Motion& motion) {
    return dot(motion.velocity, motion.velocity);
}

/// The work [m^2/s^2] of impulses per mass at a contact, as others of its State are measured.
inline Real workOf(const ContactConstraint& /*row*/, Real work) {
    return work;
}

/// The share `early` of one motion, and the rest of the other.
inline Motion blend(Real early, const Motion& first, const Motion& second) {
    return {early * first.velocity + (Real(1.0) - early) * second.velocity,
            early * first.spin + (Real(1.0) - early) * second.spin};
}

inline void setAxes(ContactConstraint& row, const MovingContact& touch) {
    row.gap = touch.gap;
    row.axis[0] = touch.normal;
    // Any tangents will do, as long as the same normal always gives the same ones.
    const Mask steep = abs(touch.normal.x) < Real(0.7);
    const Triple aside = {select(steep, Real(1.0), Real(0.0)), select(steep, Real(0.0), Real(1.0)),
                          Real(0.0)};
    const Triple tangent = aside - dot(touch.normal, aside) * touch.normal;
    row.axis[1] = (Real(1.0) / sqrt(dot(tangent, tangent))) * tangent;
    row.axis[2] = cross(touch.normal, row.axis[1]);
}

/// How the velocities along a contact's axes change by a unit impulse along each: what its two bodies have
/// together.
struct InverseMass {
    Real along[3];        // by the impulse along the same axis
    Real coupling;        // of the two tangents
    Pair normalCoupling;  // along the tangents by the normal impulse
};

/// What is to be solved for at a contact whose axes and `speed` are set. `speedBefore`: along the axes, in
/// the step before.
inline void applyLaw(ContactConstraint& row, const MovingContact& touch, const InverseMass& inverse,
                     const Real (&speedBefore)[3], const Law& law, Real dt) {
    row.normalInverse = inverse.along[0];
    row.normalMass = Real(1.0) / row.normalInverse;
    const Real half = Real(0.5) * (inverse.along[1] - inverse.along[2]);
    row.tangentInverse = Real(0.5) * (inverse.along[1] + inverse.along[2]) +
                         sqrt(half * half + inverse.coupling * inverse.coupling);
    row.tangentMass = Real(1.0) / row.tangentInverse;
    row.coupling = inverse.normalCoupling;

    // Not deeper than touching at the step's end; an impact inside the step rebounds.
    const Real open = max(touch.gap, Real(0.0));
    const Real approach = -speedBefore[0];
    const Pair slipBefore = {speedBefore[1], speedBefore[2]};
    const Pair slip = {row.speed[1], row.speed[2]};
    const Mask reaches = approach > Real(kRestSpeed) && touch.gap + dt * row.speed[0] < Real(0.0);
    const Real share = min(open / max(-dt * row.speed[0], Real(kNoSpeed) * dt), Real(1.0));
    // Velocities belong to the middles of steps; the impact lies between two of them.
    const Real speed = approach + (Real(0.5) + share) * (-row.speed[0] - approach);
    // From the impact to the middle of this step the part goes on being pulled.
    const Real rebound =
        speed * calcRestitution(speed, law.restitution) + (Real(0.5) - share) * (row.speed[0] + approach);
    const Mask impact = reaches && rebound > Real(0.0);
    row.target = select(impact, rebound, -open / dt);
    row.impactTime = select(impact, share, Real(kNoImpact));
    // An impact is over in no time: what sticks has the track's velocity of that moment, and no slip has time
    // to turn round.
    const Pair none = {Real(0.0), Real(0.0)};
    row.slipTarget = select(impact, (Real(0.5) - share) * (slip - slipBefore), none);
    row.slipBefore = select(impact, slip - row.slipTarget, slipBefore);

    row.normal = select(touch.known, touch.normalImpulse, Real(0.0));
    row.tangential = select(touch.known, touch.tangentialImpulse, none);
    row.sliding =
        (touch.known && touch.slid) || (!touch.known && dot(slip, slip) > Real(kStickSpeed * kStickSpeed));
    row.friction = select(row.sliding, law.kineticFriction, law.staticFriction);
}

/// `scale`: S^T in the axes of the contacts. before: motion in the step before. free: before plus what
/// gravity and gyroscopic torque add in this step. dt [s].
inline void prepareConstraint(ContactConstraint& row, const MovingContact& touch, const Matrix& scale,
                              const Motion& before, const Motion& free, const Law& law, Real dt) {
    setAxes(row, touch);
    Real speedBefore[3];
    InverseMass inverse;
    for (int k = 0; k < 3; ++k) {
        row.turn[k] = scale * cross(touch.arm, row.axis[k]);
        row.track[k] = dot(row.axis[k], touch.trackVelocity);
        row.speed[k] = velocityAlong(row, free, k);
        speedBefore[k] =
            dot(row.axis[k], before.velocity - touch.trackVelocityBefore) + dot(row.turn[k], before.spin);
        inverse.along[k] = Real(1.0) + dot(row.turn[k], row.turn[k]);
    }
    inverse.coupling = dot(row.turn[1], row.turn[2]);
    inverse.normalCoupling = {dot(row.turn[0], row.turn[1]), dot(row.turn[0], row.turn[2])};
    applyLaw(row, touch, inverse, speedBefore, law, dt);
}

/// What iterating led to.
template <class State>
struct Iterated {
    State motion;
    Mask converged;
};

/// Changes the rows' impulses until all targets are met, at most so often; `motion` is the one that they lead
/// to from `freeMotion`. Lanes of `frozen` keep their impulses. shaped: how friction turns within the step is
/// known in all lanes.
template <class Row, class State>
Iterated<State> iterate(Row* rows, int count, const State& freeMotion, Mask frozen, int iterations,
                        bool shaped = false) {
    State motion = freeMotion;
    for (int i = 0; i < count; ++i) {
        applyImpulse(rows[i], motion, 0, rows[i].normal);
        applyImpulse(rows[i], motion, 1, rows[i].tangential.x);
        applyImpulse(rows[i], motion, 2, rows[i].tangential.y);
    }
    const Real tolerance = Real(kVelocityTolerance * kVelocityTolerance) +
                           Real(kRelativeTolerance * kRelativeTolerance) * squaredSpeed(motion);
    Mask done = frozen;
    for (int iteration = 0; iteration < iterations && !all(done); ++iteration) {
        Real change = Real(0.0);  // of velocity, squared
        for (int i = 0; i < count; ++i) {
            Row& row = rows[iteration % 2 == 0 ? i : count - 1 - i];
            // All that can be told before the normal impulse is known: each step of this waits for the last
            // one.
            const Real speed = velocityAlong(row, motion, 0);
            const Pair before = Pair{velocityAlong(row, motion, 1), velocityAlong(row, motion, 2)} -
                                row.slipTarget - row.tangentInverse * row.tangential;

            const Real normal = max(Real(0.0), row.normal + (row.target - speed) * row.normalMass);
            const Real step = select(done, Real(0.0), normal - row.normal);
            row.normal = row.normal + step;
            applyImpulse(row, motion, 0, step);
            const Real normalChange = step * row.normalInverse;
            change = max(change, normalChange * normalChange);

            const Pair free = before + step * row.coupling;
            const Real bound = row.friction * row.normal * row.tangentInverse;
            // How friction turns on the way hardly changes from one iteration to the next; once it stays,
            // they converge.
            if (!shaped && (iteration == 0 || iteration == kShapingIteration))
                row.shape = calcFrictionShape(free, row.slipBefore, bound);
            const Friction friction = calcFriction(row.shape, free, bound);
            const Pair tangentialStep =
                select(done, Pair{Real(0.0), Real(0.0)}, row.tangentMass * friction.change - row.tangential);
            row.sliding = (done && row.sliding) || (!done && friction.sliding);
            row.tangential = row.tangential + tangentialStep;
            applyImpulse(row, motion, 1, tangentialStep.x);
            applyImpulse(row, motion, 2, tangentialStep.y);
            const Pair slipChange = row.tangentInverse * tangentialStep;
            change = max(change, dot(slipChange, slipChange));
        }
        done = done || change < tolerance;
    }
    return {motion, done};
}

/// Newton's restitution at several places at once may create energy: whether it did.
template <class Row, class State>
Mask createsEnergy(const Row* rows, int count, const State& motion) {
    Mask impact = Real(0.0) > Real(1.0);
    Real work = Real(0.0);
    for (int i = 0; i < count; ++i) {
        const Row& row = rows[i];
        impact = impact || row.target > Real(0.0);
        const Real impulse[3] = {row.normal, row.tangential.x, row.tangential.y};
        for (int k = 0; k < 3; ++k)
            work =
                work + workOf(row, Real(0.5) * impulse[k] * (row.speed[k] + velocityAlong(row, motion, k)));
    }
    return impact && work > Real(0.0);
}

/// Makes the impacts of these lanes plastic and begins anew.
template <class Row>
void makePlastic(Row* rows, int count, Mask lanes) {
    for (int i = 0; i < count; ++i) {
        Row& row = rows[i];
        row.target = select(lanes, min(row.target, Real(0.0)), row.target);
        row.normal = select(lanes, Real(0.0), row.normal);
        row.tangential = select(lanes, Pair{Real(0.0), Real(0.0)}, row.tangential);
    }
}

/// Solves for the impulses of all rows; an impact that would create energy is taken as plastic.
template <class Row, class State>
State solve(Row* rows, int count, const State& free) {
    const Mask none = Real(0.0) > Real(1.0);
    State motion = iterate(rows, count, free, none, kMaxIterations).motion;
    const Mask again = createsEnergy(rows, count, motion);
    if (any(again)) {
        makePlastic(rows, count, again);
        motion = select(again, iterate(rows, count, free, !again, kMaxIterations).motion, motion);
    }
    return motion;
}

/// What moves the pose over the step: the free motion up to the earliest impact, the solved one from there
/// on, and whatever keeps the pose that this leads to from overlapping more than before, without giving the
/// part speed.
template <class Row, class State>
State advancePose(const Row* rows, int count, const State& free, const State& after, Real dt) {
    Real impactTime = Real(kNoImpact);
    for (int i = 0; i < count; ++i)
        impactTime = select(rows[i].target > Real(0.0), min(impactTime, rows[i].impactTime), impactTime);
    const Real early = select(impactTime <= Real(1.0), impactTime, Real(0.0));
    State advance = blend(early, free, after);
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        Mask overlapping = Real(0.0) > Real(1.0);
        for (int i = 0; i < count; ++i) {
            const Row& row = rows[i];
            const Real allowed = min(row.gap, Real(0.0)) * Real(1.0 - kRecovery);
            const Real overlap = allowed - (row.gap + dt * velocityAlong(row, advance, 0));
            const Mask deep = overlap > Real(kOverlapTolerance);
            applyImpulse(row, advance, 0, select(deep, overlap / dt * row.normalMass, Real(0.0)));
            overlapping = overlapping || deep;
        }
        if (!any(overlapping)) break;
    }
    return advance;
}
