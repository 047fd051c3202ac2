/* Joining the ends of parts: equal ones (nodes.c), then those over gaps (gaps.c). */
#ifndef DP_VECTOR_JOIN_H
#define DP_VECTOR_JOIN_H

#include "vector/clean.h"

#define DP_SHARPEST -0.7f /* cosine: a path does not go on at turns above 135 degrees */

/* Both: false when memory is out. Forgets how ends were joined before; at turns whose cosine is below
 * `sharpest` none are. */
bool dp_join_nodes(dp_cleaning *c, float sharpest);
bool dp_join_gaps(dp_cleaning *c);

#endif
