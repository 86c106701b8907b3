// Pairs and triples of Real. See README.md: included inside a namespace that defines Real.

struct Pair {
    Real x, y;
};

inline Pair operator+(const Pair& a, const Pair& b) {
    return {a.x + b.x, a.y + b.y};
}
inline Pair operator-(const Pair& a, const Pair& b) {
    return {a.x - b.x, a.y - b.y};
}
inline Pair operator*(Real s, const Pair& a) {
    return {s * a.x, s * a.y};
}
inline Real dot(const Pair& a, const Pair& b) {
    return mulAdd(a.y, b.y, a.x * b.x);
}
inline Pair select(Mask mask, const Pair& yes, const Pair& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y)};
}

struct Triple {
    Real x, y, z;
};

inline Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Triple operator*(Real s, const Triple& a) {
    return {s * a.x, s * a.y, s * a.z};
}
/// s a + b
inline Triple mulAdd(Real s, const Triple& a, const Triple& b) {
    return {mulAdd(s, a.x, b.x), mulAdd(s, a.y, b.y), mulAdd(s, a.z, b.z)};
}
inline Real dot(const Triple& a, const Triple& b) {
    return mulAdd(a.z, b.z, mulAdd(a.y, b.y, a.x * b.x));
}
inline Triple cross(const Triple& a, const Triple& b) {
    return {mulAdd(a.y, b.z, -a.z * b.y), mulAdd(a.z, b.x, -a.x * b.z), mulAdd(a.x, b.y, -a.y * b.x)};
}
inline Triple select(Mask mask, const Triple& yes, const Triple& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// Rows of a 3 x 3 matrix.
struct Matrix {
    Triple row[3];
};

inline Triple operator*(const Matrix& m, const Triple& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
