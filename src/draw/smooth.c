/* Smoothing in a drawing: which normals the curved triangles are made of. Those of the model, or, where
 * it has none or shading is to use others, those that shading makes. */
#include "draw/context.h"

#include "base/diag.h"

/* Does a corner lack a normal? */
static bool lacks_any(const dp_polygons *p) {
    if (!p->normals.values) return true;
    if (!p->normals.indices) return false;
    const uint32_t corners = p->firsts ? p->firsts[p->count] : 3 * p->count;
    for (uint32_t c = 0; c < corners; c++)
        if (p->normals.indices[c] >= p->normals.count) return true;
    return false;
}

static bool find_normals(dp_context *c, dp_source *source, dp_smooth_setup *setup) {
    const dp_shade *const shade = &c->frame.styles[0].shade;
    const dp_polygons *const p = &c->frame.polygons;
    const bool made = shade->normals == DP_NORMALS_SMOOTH;
    if (!made) setup->normals.given = p->normals;
    if (!made && !lacks_any(p)) return true;
    return dp_compute_normals(c, source, &setup->normals.made);
}

dp_result dp_smooth_frame(dp_context *c, dp_source *source, dp_diag *diag) {
    const dp_style *const style = &c->frame.styles[0];
    dp_smooth_setup setup = {
        .what = style->smooth,
        .level = style->smooth_level,
        .wants_normals = c->shade.active && style->shade.normals != DP_NORMALS_FACET,
        .wants_flags = style->ink == DP_INK_QUADS || style->edges == DP_EDGES_ADJACENCY ||
                       style->edge_table_off};
    if (!find_normals(c, source, &setup))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the normals of curved triangles");
    return dp_smooth_polygons(&c->smooth, &setup, &c->frame, diag);
}
