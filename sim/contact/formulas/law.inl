// The discrete contact law at one contact. Derivations and sources: README.md of sim/contact.
// See README.md of this folder: included inside a namespace that defines Real.

/// The material pair of one trial.
struct Law {
    Real staticFriction, kineticFriction, restitution;
};

/// Below kRestSpeed an impact is plastic, above kFullSpeed the restitution is the set one; linear in between.
/// Impacts of a feeder are at 0.02-0.5 m/s. [m/s]
constexpr double kRestSpeed = 0.003;
constexpr double kFullSpeed = 0.012;
/// Keeps quotients finite where nothing moves. [m/s]
constexpr double kNoSpeed = 1e-12;

/// Rebound over impact speed for an impact at `speed` [m/s].
inline Real calcRestitution(Real speed, Real restitution) {
    const Real share = (speed - Real(kRestSpeed)) * Real(1.0 / (kFullSpeed - kRestSpeed));
    return restitution * min(max(share, Real(0.0)), Real(1.0));
}

/// Mean direction (along, across) of a slip whose component along an axis runs evenly over [from, to], both
/// >= 0, while the one across it stays. Written so that nothing cancels as `to` nears `from`.
inline Pair calcMeanDirection(Real from, Real to, Real across) {
    const Real aside = max(across, Real(1e-6) * to + Real(kNoSpeed));
    const Real sizeFrom = sqrt(from * from + aside * aside);
    const Real sizeTo = sqrt(to * to + aside * aside);
    const Real along = (from + to) / (sizeFrom + sizeTo);
    // asinh(to / aside) - asinh(from / aside) = log1p(ratio)
    const Real slope = (Real(1.0) + along) / (from + sizeFrom);
    const Real ratio = (to - from) * slope;
    const Real mean =
        select(ratio < Real(1e-4), Real(1.0) - Real(0.5) * ratio, log1p(ratio) / max(ratio, Real(1e-4)));
    return {along, aside * slope * mean};
}

/// What friction changes, over the bound, where the track carries the slip on by `carried`, more than the
/// bound: friction against the slip at each moment of the step.
inline Pair calcDirectionOnTheWay(const Pair& slipBefore, const Pair& carried, Real bound) {
    const Real way = max(sqrt(dot(carried, carried)), Real(kNoSpeed));
    const Pair axis = (Real(1.0) / way) * carried;
    const Real start = dot(slipBefore, axis);
    const Pair lateral = slipBefore - start * axis;
    const Real across = sqrt(dot(lateral, lateral));

    // Far from turning the direction half-way will do.
    const Pair middle = slipBefore + Real(0.5) * carried;
    const Pair straight = (Real(-1.0) / max(sqrt(dot(middle, middle)), Real(kNoSpeed))) * middle;
    const Mask near = !(start > Real(2.0) * way || start < Real(-3.0) * way || across > Real(4.0) * way);
    if (!any(near)) return straight;

    // Against the slip as a share of the bound: along the axis, across it.
    const Real before = max(start, Real(0.0));
    const Real back = max(-start, Real(0.0));  // slip to be lost before it turns
    const Mask turns = start < Real(0.0);
    const Real size = max(sqrt(dot(slipBefore, slipBefore)), Real(kNoSpeed));
    const Real pull = select(start > Real(0.0), bound * before / size, bound);
    const Pair first =
        calcMeanDirection(before, select(turns, back, max(start + way - pull, Real(0.0))), across);
    Pair against = {-first.x, -first.y};
    if (any(turns && near)) {
        const Real share = back / (way + bound * first.x);  // of the step until the slip turns
        const Mask late = share >= Real(1.0);
        const Real end = max(back - way - bound * first.x, Real(0.0));
        // How far it gets after turning depends on friction's direction, which depends on how far.
        const Real rest = max(Real(1.0) - share, Real(0.0));
        Pair second = calcMeanDirection(select(late, end, Real(0.0)),
                                        select(late, back, max(rest * (way - bound), Real(0.0))), across);
        const Pair stays = {second.x, -second.y};
        second = calcMeanDirection(Real(0.0), max(rest * (way - bound * second.x), Real(0.0)), across);
        const Pair turned = {share * first.x - rest * second.x, -share * first.y - rest * second.y};
        against = select(turns, select(late, stays, turned), against);
    }
    // At most to a stop across.
    const Real inward = min(-against.y, across / max(bound, Real(kNoSpeed)));
    return select(near, against.x * axis - (inward / max(across, Real(kNoSpeed))) * lateral, straight);
}

/// How friction acts at a contact in one step.
struct FrictionShape {
    Mask onTheWay;   // turns with the slip within the step
    Pair direction;  // then: change of the slip velocity over the bound
};

/// `slip`: the slip velocity at the step's end without this contact's friction; `slipBefore`: at its begin;
/// `bound`: the change that the full friction impulse makes. Where the track carries the slip on by more than
/// that, friction turns with the slip within the step: at 50 Hz and 0.2 ms the direction at the step's end
/// alone would convey up to 30 % too fast.
inline FrictionShape calcFrictionShape(const Pair& slip, const Pair& slipBefore, Real bound) {
    const Pair carried = slip - slipBefore;
    FrictionShape shape = {dot(carried, carried) > bound * bound, {Real(0.0), Real(0.0)}};
    if (any(shape.onTheWay)) shape.direction = calcDirectionOnTheWay(slipBefore, carried, bound);
    return shape;
}

/// What friction does to the slip at a contact over one step.
struct Friction {
    Pair change;  // of the slip velocity [m/s]
    Mask sliding;
};

/// Coulomb's cone over one step: a contact that can hold sticks exactly; one that slides has the full impulse
/// against its slip.
inline Friction calcFriction(const FrictionShape& shape, const Pair& slip, Real bound) {
    const Real square = dot(slip, slip);
    const Mask sliding = shape.onTheWay || square > bound * bound;
    const Pair change =
        select(sliding, -bound * inverseSqrt(max(square, Real(kNoSpeed * kNoSpeed))), Real(-1.0)) * slip;
    return {select(shape.onTheWay, bound * shape.direction, change), sliding};
}
