/* Edges: what two polygons make of the edge that they share.
 *
 *    for each triangle, for each of its edges                                     edges.comp
 *        two triangles that run it in opposite directions, not too flat: a pair
 *        one, more than two, or wound alike: disputed, the eye decides
 *    for each pair: silhouette, ridge, valley or nothing → candidates             edges_exact.comp
 *
 * Lines are those of find/edges.c. Data structure: lists that grow (dp_gl_grow_lines), with their lengths in
 * dp_gl_counters. Invariant: an edge of two triangles is classified once, by the one that comes first. Not handled: what
 * else lies at the edge; emerge.c asks the samples. */
#include "gl/lines.h"
#include "gl/passes.h"

enum { FIRST_ROOM = 1 << 14 /* members, of lists that grow */ };

/* Counters as a picture's lines begin, and room for them. */
static dp_result begin(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_counters none = {.corners_of_capsule = 4};
    dp_gl_lines_store *const l = &gl->lines;
    dp_result result =
        dp_gl_buffer_fill(gl, &l->counters, &none, sizeof none, "counters of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->candidates, FIRST_ROOM * sizeof(dp_gl_candidate),
                                      "edges that may be lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->pairs, FIRST_ROOM * sizeof(uint32_t),
                                      "edges that are not flat", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->disputed, FIRST_ROOM * sizeof(uint32_t),
                                      "edges of which the eye decides", diag);
    return result;
}

dp_result dp_gl_find_edges(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const list[DP_GL_OWN] = {&l->mates, &l->sides, &l->counters, &l->pairs,
                                                 &l->disputed},
                              *const resolve[DP_GL_OWN] = {&l->mates, &l->sides, &l->counters,
                                                           &l->candidates, &l->pairs};
    dp_result result = begin(gl, diag);
    if (!result) result = dp_gl_pass_triangles(gl, "edges.comp", list, diag);
    if (!result)
        result = dp_gl_pass_list(gl, "edges_exact.comp", resolve, DP_GL_LIST_PAIRS, 1, diag);
    return result;
}
