#pragma once

#include <algorithm>
#include <cmath>

/// The formulas of this folder over doubles: one part at a time.
namespace trapwright::contact::scalar {

using Real = double;
using Mask = bool;

inline Real select(Mask mask, Real yes, Real no) {
    return mask ? yes : no;
}
inline Mask select(Mask mask, Mask yes, Mask no) {
    return mask ? yes : no;
}
inline bool any(Mask mask) {
    return mask;
}
inline bool all(Mask mask) {
    return mask;
}
inline bool leavesOut(Mask mask) {
    return mask;
}
inline Real mulAdd(Real a, Real b, Real c) {
    return a * b + c;
}
inline Real min(Real a, Real b) {
    return std::min(a, b);
}
inline Real max(Real a, Real b) {
    return std::max(a, b);
}
inline Real abs(Real a) {
    return std::abs(a);
}
inline Real sqrt(Real a) {
    return std::sqrt(a);
}
inline Real inverseSqrt(Real a) {
    return 1.0 / std::sqrt(a);
}
inline Real log1p(Real a) {
    return std::log1p(a);
}

#include "sim/contact/formulas/vectors.inl"
// Its vectors are what all others work with.
#include "sim/contact/formulas/features.inl"
#include "sim/contact/formulas/law.inl"
#include "sim/contact/formulas/step.inl"

}  // namespace trapwright::contact::scalar
