/* Edges: what two polygons make of the edge that they share.
 *
 *    for each triangle   how its polygon lies to the eye, and its normal      edge_faces.comp
 *    for each triangle   its edges → candidates, or half-edges where the eye
 *                        must decide → disputed                               edges.comp
 *
 * Lines are those of find/edges.c. Data structure: 16 bytes a triangle, so that a neighbour costs one read; two lists that
 * grow (visibility.c), with their numbers in dp_gl_counters. Invariant: an edge of two triangles is classified once, by
 * the one that comes first. Not handled: what else lies at the edge; emerge.c asks the samples. */
#include "gl/lines.h"
#include "gl/scene.h"

enum { FIRST_ROOM = 1 << 14 /* members, of lists that grow */ };

/* Counters as a picture's lines begin, and room for them. */
static dp_result begin(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_counters none = {.corners_of_capsule = 4};
    dp_gl_lines_store *const l = &gl->lines;
    dp_result result =
        dp_gl_buffer_fill(gl, &l->counters, &none, sizeof none, "counters of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->sides, 16 * (size_t)gl->scene.triangle_count,
                                      "normals of triangles", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->candidates, FIRST_ROOM * sizeof(dp_gl_candidate),
                                      "edges that may be lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->disputed, FIRST_ROOM * sizeof(uint32_t),
                                      "edges of which the eye decides", diag);
    return result;
}

static dp_result use(dp_gl *gl, const char *compute, uint32_t *program, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = compute};
    const dp_result result = dp_gl_program(gl, &desc, program, diag);
    if (result) return result;
    dp_gl_use(gl, *program);
    dp_gl_scene_bind(gl);
    dp_gl_uniform_u(gl, *program, "has_fans", gl->scene.has_fans);
    return DP_OK;
}

static dp_result find_sides(dp_gl *gl, dp_diag *diag) {
    uint32_t program;
    const dp_result result = use(gl, "edge_faces.comp", &program, diag);
    if (result) return result;
    dp_gl_buffer_bind(gl, &gl->lines.sides, DP_GL_BIND_OWN);
    dp_gl_dispatch(gl, gl->scene.triangle_count);
    return DP_OK;
}

dp_result dp_gl_find_edges(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    uint32_t program;
    dp_result result = begin(gl, diag);
    if (!result) result = find_sides(gl, diag);
    if (!result) result = use(gl, "edges.comp", &program, diag);
    if (result) return result;
    const dp_gl_buffer *const own[] = {&l->mates, &l->sides, &l->counters, &l->candidates,
                                       &l->disputed};
    for (uint32_t i = 0; i < 5; i++) dp_gl_buffer_bind(gl, own[i], DP_GL_BIND_OWN + i);
    dp_gl_faces_bind(gl, program);
    dp_gl_uniform_u(gl, program, "candidates_room",
                    (uint32_t)(l->candidates.size / sizeof(dp_gl_candidate)));
    dp_gl_uniform_u(gl, program, "disputed_room", (uint32_t)(l->disputed.size / sizeof(uint32_t)));
    dp_gl_dispatch(gl, gl->scene.triangle_count);
    return DP_OK;
}
