/* Three-vectors in double precision, for geometry that decides what a line is; and small
 * arithmetic. */
#ifndef DP_BASE_VEC_H
#define DP_BASE_VEC_H

#include <math.h>

/* One instruction each; fminf and fmaxf, which must respect NaN, are calls. NaN gives b. */
static inline float dp_minf(float a, float b) { return a < b ? a : b; }
static inline float dp_maxf(float a, float b) { return a > b ? a : b; }
static inline double dp_min(double a, double b) { return a < b ? a : b; }
static inline double dp_max(double a, double b) { return a > b ? a : b; }

/* Length of (x, y) with every bit specified, unlike the C library's hypot. The square of a float is
 * exact in a double; doubles here are far below 1e154, where squares overflow. */
static inline float dp_hypotf(float x, float y) {
    return (float)sqrt((double)x * (double)x + (double)y * (double)y);
}
static inline double dp_hypot(double x, double y) { return sqrt(x * x + y * y); }

typedef struct dp_vec3 {
    double x, y, z;
} dp_vec3;

static inline dp_vec3 dp_v3(double x, double y, double z) { return (dp_vec3){x, y, z}; }
static inline dp_vec3 dp_v3f(const float p[3]) { return (dp_vec3){p[0], p[1], p[2]}; }
static inline dp_vec3 dp_add(dp_vec3 a, dp_vec3 b) {
    return dp_v3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline dp_vec3 dp_sub(dp_vec3 a, dp_vec3 b) {
    return dp_v3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline dp_vec3 dp_scale(dp_vec3 a, double s) { return dp_v3(a.x * s, a.y * s, a.z * s); }
static inline dp_vec3 dp_mad(dp_vec3 a, dp_vec3 b, double s) { return dp_add(a, dp_scale(b, s)); }
static inline double dp_dot(dp_vec3 a, dp_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double dp_length(dp_vec3 a) { return sqrt(dp_dot(a, a)); }
static inline dp_vec3 dp_cross(dp_vec3 a, dp_vec3 b) {
    return dp_v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
/* Zero stays zero. */
static inline dp_vec3 dp_unit(dp_vec3 a) {
    const double length = dp_length(a);
    return length > 0 ? dp_scale(a, 1 / length) : a;
}
static inline dp_vec3 dp_mix(dp_vec3 a, dp_vec3 b, double t) { return dp_mad(a, dp_sub(b, a), t); }

#endif
