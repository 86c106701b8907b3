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

/// What is nearer at the moment of an impact touches: a part that falls flat hits with all corners at once.
/// [m]
constexpr double kTouchingGap = 1e-6;
/// Of what is left for later: a velocity that is never fallen short of. [m/s]
constexpr double kNoTarget = -1e6;
/// How many moments of impact one step can have; what comes after them waits for the next.
constexpr int kMostMoments = 4;

/// Velocity of the centre of mass and scaled angular velocity, or the impulses that change them.
struct Motion {
    Triple velocity, spin;
};

inline Motion operator+(const Motion& a, const Motion& b) {
    return {a.velocity + b.velocity, a.spin + b.spin};
}
inline Motion operator-(const Motion& a, const Motion& b) {
    return {a.velocity - b.velocity, a.spin - b.spin};
}
inline Motion select(Mask mask, const Motion& yes, const Motion& no) {
    return {select(mask, yes.velocity, no.velocity), select(mask, yes.spin, no.spin)};
}

/// A part on its way through a step. In both motions velocities belong to the middles of steps, as if nothing
/// had been hit between: so they stay when a step is gone through impact by impact.
struct StepMotion {
    Motion before;  // in the step before
    Motion free;    // in this one, if nothing is hit (any more)
    /// What the way of the whole step is more than `free`, by what was hit already. Zero to begin with.
    Motion offset;
};

/// What is left of the step after impacts that make `free` become `after`, and the step's way `advance`.
inline StepMotion goOnAfter(const StepMotion& motion, const Motion& after, const Motion& advance) {
    return {motion.before + (after - motion.free), after, advance - after};
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
    Real gap;  // at the step's begin, as if the part had always moved as it does now (StepMotion::offset)
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
    Mask later;  // not before the step's first impact
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

/// What is to be solved for at a contact whose axes, `gap` and `speed` are set. `speedBefore`: along the
/// axes, in the step before.
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
    const Real open = max(row.gap, Real(0.0));
    const Real approach = -speedBefore[0];
    const Pair slipBefore = {speedBefore[1], speedBefore[2]};
    const Pair slip = {row.speed[1], row.speed[2]};
    const Mask impact = approach > Real(kRestSpeed) && row.gap + dt * row.speed[0] < Real(0.0);
    const Real share = min(open / max(-dt * row.speed[0], Real(kNoSpeed) * dt), Real(1.0));
    // Velocities belong to the middles of steps; the impact lies between two of them.
    const Real speed = approach + (Real(0.5) + share) * (-row.speed[0] - approach);
    // From the impact to the middle of this step the part goes on being pulled.
    const Real rebound =
        speed * calcRestitution(speed, law.restitution) + (Real(0.5) - share) * (row.speed[0] + approach);
    row.target = select(impact, max(rebound, Real(0.0)), -open / dt);
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

/// `scale`: S^T in the axes of the contacts. motion.free to begin with: motion.before and what gravity and
/// gyroscopic torque add in this step. dt [s].
inline void prepareConstraint(ContactConstraint& row, const MovingContact& touch, const Matrix& scale,
                              const StepMotion& motion, const Law& law, Real dt) {
    setAxes(row, touch);
    Real speedBefore[3];
    InverseMass inverse;
    for (int k = 0; k < 3; ++k) {
        row.turn[k] = scale * cross(touch.arm, row.axis[k]);
        row.track[k] = dot(row.axis[k], touch.trackVelocity);
        row.speed[k] = velocityAlong(row, motion.free, k);
        speedBefore[k] = dot(row.axis[k], motion.before.velocity - touch.trackVelocityBefore) +
                         dot(row.turn[k], motion.before.spin);
        inverse.along[k] = Real(1.0) + dot(row.turn[k], row.turn[k]);
    }
    row.gap =
        touch.gap + dt * (dot(row.axis[0], motion.offset.velocity) + dot(row.turn[0], motion.offset.spin));
    inverse.coupling = dot(row.turn[1], row.turn[2]);
    inverse.normalCoupling = {dot(row.turn[0], row.turn[1]), dot(row.turn[0], row.turn[2])};
    applyLaw(row, touch, inverse, speedBefore, law, dt);
}

/// Of a step with impacts, only the first count, and what touches at that moment: they change how fast the
/// rest is hit, and whether at all. A part that lands a little aslant hits with one corner, turns, and hits
/// with the next: with all corners at once its turning would be lost, the more the larger the step.
template <class Row>
void takeFirstImpacts(Row* rows, int count, Real dt) {
    Real first = Real(kNoImpact);
    for (int i = 0; i < count; ++i)
        first = min(first, rows[i].impactTime);
    const Mask impact = first <= Real(1.0);
    for (int i = 0; i < count; ++i) {
        Row& row = rows[i];
        const Real then = row.gap + first * dt * row.speed[0];
        row.later = impact && then > Real(kTouchingGap);
        row.target = select(row.later, Real(kNoTarget), row.target);
        row.impactTime = select(row.later, Real(kNoImpact), row.impactTime);
        row.normal = select(row.later, Real(0.0), row.normal);
        row.tangential = select(row.later, Pair{Real(0.0), Real(0.0)}, row.tangential);
    }
}

/// Whether what was left for later is hit on this way.
template <class Row, class State>
Mask reachesLater(const Row* rows, int count, const State& advance, Real dt) {
    Mask reaches = Real(0.0) > Real(1.0);
    for (int i = 0; i < count; ++i) {
        const Row& row = rows[i];
        reaches = reaches || (row.later && row.gap + dt * velocityAlong(row, advance, 0) < Real(0.0));
    }
    return reaches;
}

/// Whether anything collides in this step.
template <class Row>
Mask anyImpact(const Row* rows, int count) {
    Mask impact = Real(0.0) > Real(1.0);
    for (int i = 0; i < count; ++i)
        impact = impact || rows[i].impactTime <= Real(1.0);
    return impact;
}

/// Impulses are noted after iterations 3 and 5 and carried on after 7, then the same six later, and so on.
constexpr int kTrendPeriod = 6;
/// Contacts of which impulses are carried on; no more than that of one part.
constexpr int kMostInTrend = 12;
/// Changes that shrink by a factor out of this range from one time to the next tell nothing.
constexpr double kLeastRate = 0.1;
constexpr double kGreatestRate = 0.97;

/// Impacts of several corners begin from nothing and converge slowly. Once it is clear which contacts slide,
/// what two sweeps there and back change shrinks by about the same factor each time: the impulses can be
/// carried on to where that leads (Aitken's extrapolation, with one factor for all).
struct ImpulseTrend {
    Real before[kMostInTrend][3], last[kMostInTrend][3];
    int noted = 0;

    template <class Row>
    void note(const Row* rows, int count) {
        auto& to = noted == 0 ? before : last;
        for (int i = 0; i < count; ++i) {
            to[i][0] = rows[i].normal;
            to[i][1] = rows[i].tangential.x;
            to[i][2] = rows[i].tangential.y;
        }
        ++noted;
    }

    /// Carries on the impulses of these lanes, and begins anew.
    template <class Row, class State>
    void follow(Row* rows, int count, State& motion, Mask lanes) {
        Real along = Real(0.0);
        Real square = Real(0.0);
        for (int i = 0; i < count; ++i) {
            const Real now[3] = {rows[i].normal, rows[i].tangential.x, rows[i].tangential.y};
            for (int k = 0; k < 3; ++k) {
                const Real change = last[i][k] - before[i][k];
                along = mulAdd(now[k] - last[i][k], change, along);
                square = mulAdd(change, change, square);
            }
        }
        const Real rate = along / max(square, Real(kNoSpeed * kNoSpeed));
        const Mask tells = lanes && rate > Real(kLeastRate) && rate < Real(kGreatestRate);
        const Real share = select(tells, rate / max(Real(1.0) - rate, Real(1.0 - kGreatestRate)), Real(0.0));
        for (int i = 0; i < count; ++i) {
            Row& row = rows[i];
            const Real normal = max(Real(0.0), row.normal + share * (row.normal - last[i][0]));
            const Pair tangential = {share * (row.tangential.x - last[i][1]),
                                     share * (row.tangential.y - last[i][2])};
            applyImpulse(row, motion, 0, normal - row.normal);
            applyImpulse(row, motion, 1, tangential.x);
            applyImpulse(row, motion, 2, tangential.y);
            row.normal = normal;
            row.tangential = row.tangential + tangential;
        }
        noted = 0;
    }
};

/// What iterating led to.
template <class State>
struct Iterated {
    State motion;
    Mask converged;
};

/// Whether a contact has no impulse and gets none, `normal` being its next one.
template <class Row>
Mask isIdle(const Row& row, Real normal) {
    return row.normal <= Real(0.0) && normal <= Real(0.0) && dot(row.tangential, row.tangential) <= Real(0.0);
}

/// Changes the rows' impulses until all targets are met, at most so often; `motion` is the one that they lead
/// to from `freeMotion`. Lanes of `frozen` keep their impulses. first: how many iterations there were before;
/// they told how friction turns within the step.
template <class Row, class State>
Iterated<State> iterate(Row* rows, int count, const State& freeMotion, Mask frozen, int iterations,
                        int first = 0) {
    const bool shaped = first > 0;
    ImpulseTrend trend;
    const Mask impact = anyImpact(rows, count);
    const bool followsTrend = count <= kMostInTrend && any(impact);
    State motion = freeMotion;
    for (int i = 0; i < count; ++i) {
        if (leavesOut(isIdle(rows[i], Real(0.0)))) continue;
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
            const bool shapes = !shaped && (iteration == 0 || iteration == kShapingIteration);
            if (!shapes && leavesOut(isIdle(row, normal) && row.shape.onTheWay)) {
                row.sliding = row.shape.onTheWay;
                continue;
            }
            const Real step = select(done, Real(0.0), normal - row.normal);
            row.normal = row.normal + step;
            applyImpulse(row, motion, 0, step);
            const Real normalChange = step * row.normalInverse;
            change = max(change, normalChange * normalChange);

            const Pair free = before + step * row.coupling;
            const Real bound = row.friction * row.normal * row.tangentInverse;
            // How friction turns on the way hardly changes from one iteration to the next; once it stays,
            // they converge.
            if (shapes) row.shape = calcFrictionShape(free, row.slipBefore, bound);
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
        if (!followsTrend) continue;
        const int turn = (first + iteration) % kTrendPeriod;
        if (turn == 1 && trend.noted == 2)
            trend.follow(rows, count, motion, impact && !done);
        else if (turn == 3 || turn == 5)
            trend.note(rows, count);
    }
    return {motion, done};
}

/// The work that the impulses of all rows do, from the motion before them to this one, relative to the track.
/// [m^2/s^2]
template <class Row, class State>
Real calcWork(const Row* rows, int count, const State& motion) {
    Real work = Real(0.0);
    for (int i = 0; i < count; ++i) {
        const Row& row = rows[i];
        if (leavesOut(isIdle(row, Real(0.0)))) continue;
        const Real impulse[3] = {row.normal, row.tangential.x, row.tangential.y};
        for (int k = 0; k < 3; ++k)
            work =
                work + workOf(row, Real(0.5) * impulse[k] * (row.speed[k] + velocityAlong(row, motion, k)));
    }
    return work;
}

/// Where a part is wedged between contacts, normal impulses and friction may call forth each other without
/// end: every iteration makes them larger, and the step would throw the part. What has not converged and has
/// gained the energy of an impact at kFullSpeed is such a burst; so is what is no number any more.
inline Mask hasBurst(Mask converged, Real work) {
    return !converged && !(work <= Real(0.5 * kFullSpeed * kFullSpeed));
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

/// Takes the friction of these lanes away and begins anew: without it each sweep lessens a convex function,
/// which is 0 to begin with and more than the energy gained, so there is no burst.
template <class Row>
void makeSmooth(Row* rows, int count, Mask lanes) {
    makePlastic(rows, count, lanes);
    for (int i = 0; i < count; ++i)
        rows[i].friction = select(lanes, Real(0.0), rows[i].friction);
}

/// Solves for the impulses of all rows; an impact that would create energy is taken as plastic, and friction
/// that bursts as none.
template <class Row, class State>
State solve(Row* rows, int count, const State& free) {
    const Mask none = Real(0.0) > Real(1.0);
    Iterated<State> solved = iterate(rows, count, free, none, kMaxIterations);
    Real work = calcWork(rows, count, solved.motion);
    // Newton's restitution at several places at once may create energy.
    const Mask again = anyImpact(rows, count) && work > Real(0.0);
    if (any(again)) {
        makePlastic(rows, count, again);
        const Iterated<State> plastic = iterate(rows, count, free, !again, kMaxIterations);
        solved.motion = select(again, plastic.motion, solved.motion);
        solved.converged = select(again, plastic.converged, solved.converged);
        work = calcWork(rows, count, solved.motion);
    }
    const Mask burst = hasBurst(solved.converged, work);
    if (any(burst)) {
        makeSmooth(rows, count, burst);
        solved.motion =
            select(burst, iterate(rows, count, free, !burst, kMaxIterations).motion, solved.motion);
    }
    return solved.motion;
}

/// What moves the pose over the step: the free motion up to the earliest impact, the solved one from there
/// on, and whatever keeps the pose that this leads to from overlapping more than before, without giving the
/// part speed. last: what was left for later is not looked at any more in this step, and kept from
/// overlapping, too.
template <class Row, class State>
State advancePose(const Row* rows, int count, const State& free, const State& after, Real dt, bool last) {
    Real impactTime = Real(kNoImpact);
    for (int i = 0; i < count; ++i)
        impactTime = min(impactTime, rows[i].impactTime);
    const Real early = select(impactTime <= Real(1.0), impactTime, Real(0.0));
    State advance = blend(early, free, after);
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        Mask overlapping = Real(0.0) > Real(1.0);
        for (int i = 0; i < count; ++i) {
            const Row& row = rows[i];
            const Real allowed = min(row.gap, Real(0.0)) * Real(1.0 - kRecovery);
            const Real overlap = allowed - (row.gap + dt * velocityAlong(row, advance, 0));
            Mask deep = overlap > Real(kOverlapTolerance);
            if (!last) deep = deep && !row.later;
            if (leavesOut(!deep)) continue;
            applyImpulse(row, advance, 0, select(deep, overlap / dt * row.normalMass, Real(0.0)));
            overlapping = overlapping || deep;
        }
        if (!any(overlapping)) break;
    }
    return advance;
}
