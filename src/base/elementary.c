/* Sine, cosine, tangent, their inverses, logarithm and exponential from +, -, *, / and roots alone.
 *
 * IEEE 754 specifies every bit of those operations but not these functions: C libraries differ in
 * their last bits, and a last bit moves a pixel now and then. Each function reduces its argument
 * until a Taylor series of a few terms is exact to the 53 bits of a double; coefficients are plain
 * fractions. Invariant: no fitted tables, and nothing is fused (-ffp-contract=off).
 *
 * Constants that are not doubles are sums of two or three: each is the error of those before. Parts
 * with 33 bits stay exact when multiplied by a count of up to 2^20.
 *
 * Not handled: errno and floating-point exceptions. */
#include "base/elementary.h"

#include <math.h>
#include <stdint.h>

#define HALF_PI_0 0x1.921fb544p+0 /* 33 bits */
#define HALF_PI_1 0x1.0b4611a6p-34
#define HALF_PI_2 0x1.3198a2e037073p-69
#define HALF_PI   0x1.921fb54442d18p+0  /* rounded, … */
#define HALF_PI_E 0x1.1a62633145c07p-54 /* … and its error */
#define LN2_0     0x1.62e42fefp-1       /* 33 bits */
#define LN2_1     0x1.473de6af278edp-34

/* An angle as quarter turns and a remainder in [-pi/4, pi/4], which is rest + tail. */
typedef struct reduced {
    double rest, tail;
    unsigned quarters; /* modulo 4 */
} reduced;

static reduced reduce(double angle) {
    if (!(fabs(angle) < 0x1p20)) angle = fmod(angle, 4 * HALF_PI); /* exact; infinity gives NaN */
    if (isnan(angle)) return (reduced){angle, 0, 0};
    const int32_t count = (int32_t)(angle / HALF_PI + (angle < 0 ? -0.5 : 0.5));
    const double n = count, from = angle - n * HALF_PI_0, less = n * HALF_PI_1;
    const double high = from - less, low = (from - high) - less - n * HALF_PI_2;
    const double rest = high + low;
    return (reduced){rest, (high - rest) + low, (unsigned)count & 3};
}

/* x - x^3/3! + … - x^19/19!; the next term is below 2^-66 of the sum. */
static double sine_of_rest(double x, double tail) {
    const double z = x * x;
    const double series =
        -1. / 6 +
        z * (1. / 120 +
             z * (-1. / 5040 + z * (1. / 362880 + z * (-1. / 39916800 +
                                                       z * (1. / 6227020800 +
                                                            z * (-1. / 1307674368000 +
                                                                 z * (1. / 355687428096000 -
                                                                      z / 121645100408832000)))))));
    return x + (x * z * series + tail * (1 - z / 2));
}

/* 1 - x^2/2! + … + x^20/20!; `lost` is the rounding error of 1 - x^2/2. */
static double cosine_of_rest(double x, double tail) {
    const double z = x * x, half = z / 2, first = 1 - half, lost = (1 - first) - half;
    const double series =
        1. / 24 +
        z * (-1. / 720 +
             z * (1. / 40320 +
                  z * (-1. / 3628800 +
                       z * (1. / 479001600 +
                            z * (-1. / 87178291200 +
                                 z * (1. / 20922789888000 +
                                      z * (-1. / 6402373705728000 + z / 2432902008176640000)))))));
    return first + (lost + (z * z * series - x * tail));
}

double dp_sin(double angle) {
    const reduced r = reduce(angle);
    const double value =
        r.quarters & 1 ? cosine_of_rest(r.rest, r.tail) : sine_of_rest(r.rest, r.tail);
    return r.quarters & 2 ? -value : value;
}

double dp_cos(double angle) {
    const reduced r = reduce(angle);
    const double value =
        r.quarters & 1 ? sine_of_rest(r.rest, r.tail) : cosine_of_rest(r.rest, r.tail);
    return (r.quarters + 1) & 2 ? -value : value;
}

double dp_tan(double angle) {
    const reduced r = reduce(angle);
    const double s = sine_of_rest(r.rest, r.tail), c = cosine_of_rest(r.rest, r.tail);
    return r.quarters & 1 ? -c / s : s / c;
}

/* atan(k / 16) */
static const double arcs[17][2 /* value, error */] = {
    {0, 0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

/* atan(t) for t in [0, 1]: the nearest of these, plus u - u^3/3 + … for the rest, |u| <= 1/32. */
static double arc_of(double t, double *tail) {
    const int k = (int)(16 * t + 0.5);
    const double c = k / 16., u = (t - c) / (1 + t * c), z = u * u;
    const double series =
        z * (-1. / 3 + z * (1. / 5 + z * (-1. / 7 + z * (1. / 9 + z * (-1. / 11 + z / 13)))));
    const double behind = u + (arcs[k][1] + u * series), arc = arcs[k][0] + behind;
    *tail = (arcs[k][0] - arc) + behind;
    return arc;
}

double dp_atan2(double y, double x) {
    const double a = fabs(y), b = fabs(x);
    if (isnan(a) || isnan(b)) return a + b;
    const double t = a == b ? (a > 0 ? 1 : 0) : a < b ? a / b : b / a;
    double tail, arc = arc_of(t, &tail);
    if (a > b) { /* counted from the y axis */
        const double sign = signbit(x) ? 1 : -1;
        arc = HALF_PI + sign * arc + (HALF_PI_E + sign * tail);
    } else if (signbit(x)) {
        arc = 2 * HALF_PI - arc + (2 * HALF_PI_E - tail);
    }
    return signbit(y) ? -arc : arc;
}

double dp_atan(double tangent) { return dp_atan2(tangent, 1); }

double dp_acos(double cosine) { return dp_atan2(sqrt((1 - cosine) * (1 + cosine)), cosine); }

/* x = m 2^e with m in [sqrt(1/2), sqrt(2)]; ln x = e ln 2 + 2 (s + s^3/3 + …) with s = (m - 1)/(m +
 * 1), |s| <= 0.172. The first term left out, s^23/23, is below 2^-62. */
double dp_log(double x) {
    if (!(x > 0)) return -INFINITY;
    int e;
    double m = frexp(x, &e);
    if (m < 0x1.6a09e667f3bcdp-1) m *= 2, e--;
    const double s = (m - 1) / (m + 1), z = s * s;
    double series = 1. / 21;
    for (int k = 19; k >= 3; k -= 2) series = 1. / k + z * series;
    return e * LN2_0 + (2 * s + (2 * s * z * series + e * LN2_1));
}

static const double inverse_factorial[15] = {1,
                                             1,
                                             1. / 2,
                                             1. / 6,
                                             1. / 24,
                                             1. / 120,
                                             1. / 720,
                                             1. / 5040,
                                             1. / 40320,
                                             1. / 362880,
                                             1. / 3628800,
                                             1. / 39916800,
                                             1. / 479001600,
                                             1. / 6227020800,
                                             1. / 87178291200};

/* exp(x) = 2^n exp(r), |r| <= ln(2)/2. The first term left out, r^15/15!, is below 2^-62. */
double dp_exp(double x) {
    if (!(x <= 709)) return isnan(x) ? x : INFINITY;
    if (x < -745) return 0;
    const int n = (int)(x / (LN2_0 + LN2_1) + (x < 0 ? -0.5 : 0.5));
    const double r = (x - n * LN2_0) - n * LN2_1;
    double series = inverse_factorial[14];
    for (int k = 13; k >= 0; k--) series = inverse_factorial[k] + r * series;
    return ldexp(series, n);
}
