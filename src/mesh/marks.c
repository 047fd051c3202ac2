/* Lists the edges that are lines by themselves (dp_edge_kind), in the order of polygons.
 *
 * Most models have none, and of those that do most polygons: flags are looked at block by block. */
#include "base/hostile.h"
#include "mesh/polygons.h"

enum { BLOCK = DP_TUNED(1024, 3) /* polygons */ };

static bool is_mark(uint8_t flag) { return flag == DP_EDGE_SECTION || flag == DP_EDGE_HATCHING; }

static bool any_mark(const uint8_t *flags, uint32_t count) {
    uint32_t marks = 0;
    for (uint32_t i = 0; i < count; i++)
        marks |= (uint32_t)(flags[i] == DP_EDGE_SECTION) | (flags[i] == DP_EDGE_HATCHING);
    return marks;
}

static bool list_polygon(dp_polygon_store *store, const dp_allocator *memory, dp_polygons *p,
                         uint32_t polygon) {
    const uint32_t first = dp_first_corner(p, polygon), n = dp_corner_count(p, polygon);
    for (uint32_t i = 0; i < n; i++) {
        if (!is_mark(p->edge_flags[first + i])) continue;
        if (!dp_reserve(memory, &store->marks, &store->marks_cap, p->mark_count + (size_t)1,
                        sizeof *store->marks))
            return false;
        store->marks[p->mark_count++] = (dp_marked_edge){polygon, i};
    }
    return true;
}

bool dp_list_marks(dp_polygon_store *store, const dp_allocator *memory, dp_polygons *p) {
    p->mark_count = 0;
    for (uint32_t from = 0; p->has_diagonals && from < p->count; from += BLOCK) {
        const uint32_t to = p->count - from < BLOCK ? p->count : from + BLOCK,
                       first = dp_first_corner(p, from), end = dp_first_corner(p, to);
        if (!any_mark(p->edge_flags + first, end - first)) continue;
        for (uint32_t i = from; i < to; i++)
            if (!list_polygon(store, memory, p, i)) return false;
    }
    p->marks = store->marks;
    return true;
}
