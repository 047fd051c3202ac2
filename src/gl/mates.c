/* Mates: which half-edge runs each edge the other way.
 *
 *    for each triangle with an area, for each of its half-edges      mates_meet.comp
 *        take the edge's slot of a hash table, or join who has it
 *    tell all members of an edge of more than two                     mates_settle.comp
 *
 * Ends are compared by position: an index buffer and a soup are the same. Data structure: a table of half-edges, open
 * addressing with linear probing, at most three quarters full, so that a search is short; it is bounded in any case.
 * Invariant: the result depends on the set of triangles alone, not on the order in which the device takes them. It is
 * kept while the scene's topology stays: positions that move take their mates with them, and triangles that had no area
 * when mates were made have none until the topology changes. Not handled: edges whose ends are equal but for rounding;
 * what lies there decides (emerge.c). */
#include "gl/lines.h"
#include "gl/passes.h"

static uint32_t slots_for(uint32_t triangles) {
    uint32_t slots = 1024;
    while (slots < UINT32_MAX / 2 && slots < 4 * (uint64_t)triangles) slots *= 2;
    return slots;
}

static dp_result reserve(dp_gl *gl, uint32_t slots, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_result result = dp_gl_buffer_reserve(gl, &l->mates, 12 * (size_t)gl->scene.triangle_count,
                                            "mates of half-edges", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->slots, 4 * (size_t)slots,
                                      "the table in which half-edges meet", diag);
    return result;
}

dp_result dp_gl_find_mates(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const own[DP_GL_OWN] = {&l->mates, &l->slots, &l->sides};
    const uint32_t slots = slots_for(gl->scene.triangle_count);
    if (l->topology == gl->scene.topology) return DP_OK;
    dp_result result = reserve(gl, slots, diag);
    if (result) return result;
    dp_gl_buffer_clear(gl, &l->mates, 12 * (size_t)gl->scene.triangle_count, DP_GL_MATE_NONE);
    dp_gl_buffer_clear(gl, &l->slots, 4 * (size_t)slots, UINT32_MAX);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    result = dp_gl_pass_triangles(gl, "mates_meet.comp", own, diag);
    if (!result) result = dp_gl_pass_triangles(gl, "mates_settle.comp", own, diag);
    if (!result) l->topology = gl->scene.topology;
    return result;
}
