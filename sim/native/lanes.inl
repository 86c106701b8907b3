// Real and Mask of sim/contact/formulas over a whole vector of floats. Included once per instruction set,
// inside HWY_NAMESPACE.

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using Vector = hn::Vec<Tag>;

struct Mask {
    hn::Mask<Tag> bits;
};

struct Real {
    Vector lanes;

    Real() = default;
    Real(double value) : lanes(hn::Set(Tag(), static_cast<float>(value))) {}
    explicit Real(Vector vector) : lanes(vector) {}
};

// Not friends: GCC 12 compiles those for the plain instruction set.
inline Real operator+(Real a, Real b) {
    return Real(hn::Add(a.lanes, b.lanes));
}
inline Real operator-(Real a, Real b) {
    return Real(hn::Sub(a.lanes, b.lanes));
}
inline Real operator*(Real a, Real b) {
    return Real(hn::Mul(a.lanes, b.lanes));
}
inline Real operator/(Real a, Real b) {
    return Real(hn::Div(a.lanes, b.lanes));
}
inline Real operator-(Real a) {
    return Real(hn::Neg(a.lanes));
}
inline Mask operator<(Real a, Real b) {
    return {hn::Lt(a.lanes, b.lanes)};
}
inline Mask operator>(Real a, Real b) {
    return {hn::Gt(a.lanes, b.lanes)};
}
inline Mask operator<=(Real a, Real b) {
    return {hn::Le(a.lanes, b.lanes)};
}
inline Mask operator>=(Real a, Real b) {
    return {hn::Ge(a.lanes, b.lanes)};
}
inline Mask operator&&(Mask a, Mask b) {
    return {hn::And(a.bits, b.bits)};
}
inline Mask operator||(Mask a, Mask b) {
    return {hn::Or(a.bits, b.bits)};
}
inline Mask operator!(Mask a) {
    return {hn::Not(a.bits)};
}
inline Real select(Mask mask, Real yes, Real no) {
    return Real(hn::IfThenElse(mask.bits, yes.lanes, no.lanes));
}
inline Mask select(Mask mask, Mask yes, Mask no) {
    return (mask && yes) || (!mask && no);
}
inline bool any(Mask mask) {
    return !hn::AllFalse(Tag(), mask.bits);
}
inline bool all(Mask mask) {
    return hn::AllTrue(Tag(), mask.bits);
}
/// Hardly ever do all lanes need the same.
inline bool leavesOut(Mask /*mask*/) {
    return false;
}
inline Real mulAdd(Real a, Real b, Real c) {
    return Real(hn::MulAdd(a.lanes, b.lanes, c.lanes));
}
inline Real min(Real a, Real b) {
    return Real(hn::Min(a.lanes, b.lanes));
}
inline Real max(Real a, Real b) {
    return Real(hn::Max(a.lanes, b.lanes));
}
inline Real abs(Real a) {
    return Real(hn::Abs(a.lanes));
}
inline Real sqrt(Real a) {
    return Real(hn::Sqrt(a.lanes));
}
/// Rounded as every processor must: what machines guess an inverse square root to be differs between makers.
inline Real inverseSqrt(Real a) {
    return Real(1.0) / sqrt(a);
}
inline Real log1p(Real a) {
    return Real(hn::Log1p(Tag(), a.lanes));
}
inline Real sin(Real a) {
    return Real(hn::Sin(Tag(), a.lanes));
}

/// From memory, the next whole vector at `from`, which is aligned.
inline Real load(const float* from) {
    return Real(hn::Load(Tag(), from));
}
inline void store(Real value, float* to) {
    hn::Store(value.lanes, Tag(), to);
}
inline float leastOf(Real value) {
    return hn::GetLane(hn::MinOfLanes(Tag(), value.lanes));
}
inline float greatestOf(Real value) {
    return hn::GetLane(hn::MaxOfLanes(Tag(), value.lanes));
}
/// One bit per lane.
inline std::uint32_t bitsOf(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask.bits, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
}

inline Mask maskOf(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U)};
    return {hn::LoadMaskBits(Tag(), bytes)};
}

/// Four floats at once, whatever the width of Real: what belongs to one feature of the track.
#if HWY_TARGET == HWY_SCALAR
struct Four {
    float lanes[4];
};
inline Four fourTimes(float value) {
    return {{value, value, value, value}};
}
inline Four loadFour(const float* from) {
    return {{from[0], from[1], from[2], from[3]}};
}
inline void store(const Four& value, float* to) {
    std::copy_n(value.lanes, 4, to);
}
inline Four mulAdd(const Four& a, const Four& b, const Four& c) {
    Four result;
    for (int k = 0; k < 4; ++k)
        result.lanes[k] = a.lanes[k] * b.lanes[k] + c.lanes[k];
    return result;
}
#else
using Quad = hn::FixedTag<float, 4>;
struct Four {
    hn::Vec<Quad> lanes;
};
inline Four fourTimes(float value) {
    return {hn::Set(Quad(), value)};
}
inline Four loadFour(const float* from) {
    return {hn::Load(Quad(), from)};
}
inline void store(const Four& value, float* to) {
    hn::Store(value.lanes, Quad(), to);
}
inline Four mulAdd(const Four& a, const Four& b, const Four& c) {
    return {hn::MulAdd(a.lanes, b.lanes, c.lanes)};
}
#endif
