/* Vectors in double precision, by value. */
#ifndef DP_TEST_VEC_H
#define DP_TEST_VEC_H

#include <math.h>

typedef struct v3 {
    double x, y, z;
} v3;

static inline v3 v3_add(v3 a, v3 b) { return (v3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline v3 v3_sub(v3 a, v3 b) { return (v3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline v3 v3_mul(v3 a, double s) { return (v3){a.x * s, a.y * s, a.z * s}; }
static inline v3 v3_mix(v3 a, v3 b, double t) { return v3_add(a, v3_mul(v3_sub(b, a), t)); }
static inline double v3_dot(v3 a, v3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double v3_len(v3 a) { return sqrt(v3_dot(a, a)); }
static inline v3 v3_cross(v3 a, v3 b) {
    return (v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* The zero vector stays zero. */
static inline v3 v3_unit(v3 a) {
    const double length = v3_len(a);
    return length > 0 ? v3_mul(a, 1 / length) : a;
}
static inline double v3_axis(v3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }
static inline v3 v3_min(v3 a, v3 b) { return (v3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)}; }
static inline v3 v3_max(v3 a, v3 b) { return (v3){fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)}; }

#endif
