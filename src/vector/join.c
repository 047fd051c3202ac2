/* Which parts are drawn in one go. */
#include "vector/join.h"

bool dp_join_ends(dp_cleaning *c) {
    const size_t ends = 2 * (size_t)c->part_count;
    if (!dp_reserve(c->memory, &c->partner, &c->partner_cap, ends, sizeof *c->partner))
        return false;
    for (size_t e = 0; e < ends; e++) c->partner[e] = DP_NOWHERE;
    return dp_join_nodes(c) && dp_join_gaps(c);
}
