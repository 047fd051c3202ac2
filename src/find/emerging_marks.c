/* Which edges of a tile's polygons the table has made lines of, and which are left to emerge: of two that
 * run along each other only one draws the line, and it must be one that is looked at (emerge.c).
 *
 * Data structure: a bit for each of a polygon's first 32 edges. The table leaves one half-edge over of a
 * pair; the partner's is marked with it, by the keys of its ends. */
#include "find/finder.h"

#include <string.h>

enum { BITS = 32 };

bool dp_note_drawn(dp_finder *w, uint32_t polygon, uint32_t edge) {
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.drawn, emergence.drawn_cap,
                         w->emergence.drawn_count + 1u))
        return false;
    w->emergence.drawn[w->emergence.drawn_count++] = (dp_unpaired_edge){polygon, edge, 0, false};
    return true;
}

bool dp_note_served(dp_finder *w, uint32_t polygon, uint32_t edge) {
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.served, emergence.served_cap,
                         w->emergence.served_count + 1u))
        return false;
    w->emergence.served[w->emergence.served_count++] = (dp_unpaired_edge){polygon, edge, 0, false};
    return true;
}

static void mark(uint32_t *of, uint32_t polygon, uint32_t edge) {
    if (edge < BITS) of[polygon] |= (uint32_t)1 << edge;
}

bool dp_mark_drawn(dp_finder *w) {
    dp_emergence *const own = &w->emergence;
    const size_t count = w->tile.polygon_count;
    if (!DP_TILE_RESERVE(&w->tile, own, drawn_of, drawn_of_cap, count) ||
        !DP_TILE_RESERVE(&w->tile, own, emerging_of, emerging_of_cap, count))
        return false;
    memset(own->drawn_of, 0, count * sizeof *own->drawn_of);
    memset(own->emerging_of, 0, count * sizeof *own->emerging_of);
    for (uint32_t i = 0; i < own->drawn_count; i++)
        mark(own->drawn_of, own->drawn[i].polygon, own->drawn[i].edge);
    for (uint32_t i = 0; i < own->served_count; i++)
        mark(own->emerging_of, own->served[i].polygon, own->served[i].edge);
    return true;
}

/* Marks an edge as the partner has it, if it has. */
static void mark_partner(dp_finder *w, dp_unpaired_edge e) {
    const dp_tile_polygon *const p = &w->tile.polygons[e.polygon],
                                 *const q = &w->tile.polygons[e.partner - 1];
    const dp_vertex *const u = w->tile.points + p->point, *const v = w->tile.points + q->point;
    if ((p->flags | q->flags) & DP_POLYGON_CLIPPED) return;
    const uint32_t a = u[e.edge].key, b = u[(e.edge + 1) % p->points].key;
    for (uint32_t i = 0; i < q->points; i++) {
        const uint32_t from = v[i].key, to = v[(i + 1) % q->points].key;
        if ((from == a && to == b) || (from == b && to == a))
            mark(w->emergence.emerging_of, e.partner - 1, i);
    }
}

void dp_mark_emerging(dp_finder *w, dp_unpaired_edge e) {
    mark(w->emergence.emerging_of, e.polygon, e.edge);
    if (e.partner) mark_partner(w, e);
}

bool dp_is_drawn(const dp_finder *w, dp_unpaired_edge e) {
    return e.edge < BITS && w->emergence.drawn_of[e.polygon] >> e.edge & 1;
}

bool dp_emerges(const dp_finder *w, dp_unpaired_edge e) {
    return e.edge >= BITS || w->emergence.emerging_of[e.polygon] >> e.edge & 1;
}
