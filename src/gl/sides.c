/* Sides: how each triangle's polygon lies to the eye, and its normal, for all stages that ask.
 *
 *    for each triangle   in float32, where that is sure                        sides.comp
 *    for what is not     nearly edge-on, clipped, tiny, or of more corners:
 *                        in double precision                                   sides_exact.comp
 *
 * Facing is that of core/outline.c. Data structure: 16 bytes a triangle, so that an edge's neighbour costs one read; the
 * list of what is not sure lies where half-edges meet later (mates.c), which has room for all. Invariant: all triangles
 * of a polygon have one side. */
#include "gl/lines.h"
#include "gl/passes.h"

dp_result dp_gl_find_sides(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_counters none = {.corners_of_capsule = 4};
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const own[DP_GL_OWN] = {&l->sides, &l->counters, &l->slots};
    const size_t triangles = gl->scene.triangle_count;
    dp_result result =
        dp_gl_buffer_fill(gl, &l->counters, &none, sizeof none, "counters of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->sides, 16 * triangles, "normals of triangles", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->slots, 4 * triangles,
                                      "triangles that are nearly edge-on", diag);
    if (!result) result = dp_gl_pass_triangles(gl, "sides.comp", own, diag);
    if (!result) result = dp_gl_pass_list(gl, "sides_exact.comp", own, DP_GL_LIST_UNSURE, 1, diag);
    return result;
}
