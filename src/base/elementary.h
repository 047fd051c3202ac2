/* Elementary functions whose every bit is specified here, and not by the C library: pictures depend
 * on them. Within three units in the last place of the exact value. */
#ifndef DP_BASE_ELEMENTARY_H
#define DP_BASE_ELEMENTARY_H

/* Angles are in radians; beyond a million of them sine and cosine are somewhere in [-1, 1]. */
double dp_sin(double angle);
double dp_cos(double angle);
double dp_tan(double angle);
/* In [-pi, pi], of any lengths, (0, 0) too: as C's. */
double dp_atan2(double y, double x);
double dp_atan(double tangent);
/* In [0, pi]; NaN beyond [-1, 1]. */
double dp_acos(double cosine);

/* The natural logarithm of any finite number; -infinity of what is not above 0. */
double dp_log(double x);
double dp_exp(double x);

#endif
