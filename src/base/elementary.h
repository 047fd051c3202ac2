/* Elementary functions with every bit specified here, not by the C library, as pictures depend on
 * them. Errors are below three units in the last place. */
#ifndef DP_BASE_ELEMENTARY_H
#define DP_BASE_ELEMENTARY_H

/* Angles in radians; beyond a million, sine and cosine are only known to lie in [-1, 1]. */
double dp_sin(double angle);
double dp_cos(double angle);
double dp_tan(double angle);
/* In [-pi, pi], for any lengths; (0, 0) as in C. */
double dp_atan2(double y, double x);
double dp_atan(double tangent);
/* In [0, pi]; NaN outside [-1, 1]. */
double dp_acos(double cosine);

/* Natural logarithm of a finite number; -infinity if it is not positive. */
double dp_log(double x);
double dp_exp(double x);

#endif
