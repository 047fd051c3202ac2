/* Unit normals of polygons in float32, for a first test of edges. assemble.inc makes those of
 * triangles that are thick enough on the screen; the others are made from positions here. */
#include "raster/kernels.h"
#include "raster/tile.h"

#include <string.h>

/* Computed in double precision, rounded to float32. */
void dp_tile_exact_normal(dp_tile *w, uint32_t polygon) {
    const dp_vec3 n = dp_polygon_normal(w->frame, w->polygons[polygon].id);
    float *const out = w->normals[polygon];
    out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z, out[3] = 0;
}

bool dp_tile_exact_normals(dp_tile *w) {
    if (!DP_TILE_RESERVE(w, w, normals, normals_cap, (size_t)w->polygon_count)) return false;
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t index = w->seen[i];
        if (w->polygons[index].flags & DP_POLYGON_FRONT)
            dp_tile_exact_normal(w, index);
        else
            memcpy(w->normals[index], dp_away, sizeof dp_away);
    }
    return true;
}

void dp_tile_turn_normals(dp_tile *w) {
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t index = w->seen[i];
        if (w->polygons[index].flags & (DP_POLYGON_FRONT | DP_POLYGON_EDGE_ON)) continue;
        dp_tile_exact_normal(w, index);
        float *const n = w->normals[index];
        n[0] = -n[0], n[1] = -n[1], n[2] = -n[2], n[3] = DP_TURNED;
    }
}

/* Those of front faces are known, or are made where they are asked for. */
static bool wind_triangles(dp_tile *w) {
    if (!DP_TILE_RESERVE(w, w, unsure, unsure_cap, (size_t)w->seen_count + DP_SEEN_ROOM))
        return false;
    w->unsure_count = 0;
    for (uint32_t i = 0; i < w->seen_count; i++) {
        w->unsure[w->unsure_count] = w->seen[i];
        w->unsure_count += !(w->polygons[w->seen[i]].flags & DP_POLYGON_FRONT);
    }
    dp_raster_kernels_for(w->frame->lanes)->normals(w);
    for (uint32_t i = 0; i < w->unsure_count; i++) w->normals[w->unsure[i]][3] = DP_BACK;
    w->unsure_count = 0;
    return true;
}

bool dp_tile_wound_normals(dp_tile *w) {
    if (!w->frame->polygons.firsts) return wind_triangles(w);
    if (!DP_TILE_RESERVE(w, w, normals, normals_cap, (size_t)w->polygon_count)) return false;
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t index = w->seen[i];
        dp_tile_exact_normal(w, index);
        if (!(w->polygons[index].flags & DP_POLYGON_FRONT)) w->normals[index][3] = DP_BACK;
    }
    return true;
}
