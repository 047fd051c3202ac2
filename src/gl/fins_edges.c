/* Edges for silhouettes by adjacency: the index buffer with adjacency (Hermosilla and Vázquez 2010, Figure 2.2), edges that more than
 * two triangles have, and, without a geometry shader, which edges are outlines.
 *
 *     six      mates → six indices a triangle                                     fins_six.comp
 *     rings    half-edges of edges of more than two → sorted by edge              fins_many.comp, and here
 *     list     facing of triangles → outlines in order                            fins_facing.comp, fins_list.comp
 *
 * Six and rings are kept while the topology stays. Rings are few, or none, and come back to the host once to be
 * sorted. Invariant: rings are sorted by the first half-edge of their edge. */
#include "gl/fins.h"

#include "base/sort.h"

#include <string.h>

typedef struct many {
    uint32_t half_edge, ends[6], free;
} many;

typedef struct ring {
    uint32_t half_edge, first;
} ring;

enum { ROOM = 4096, HEAD = 16 /* bytes before the list */ };

static int by_edge(const void *left, const void *right) {
    const many *const l = left, *const r = right;
    for (int i = 0; i < 6; i++)
        if (l->ends[i] != r->ends[i]) return l->ends[i] < r->ends[i] ? -1 : 1;
    return (l->half_edge > r->half_edge) - (l->half_edge < r->half_edge);
}

static int by_first(const void *left, const void *right) {
    const ring *const l = left, *const r = right;
    if (l->first != r->first) return l->first < r->first ? -1 : 1;
    return (l->half_edge > r->half_edge) - (l->half_edge < r->half_edge);
}

/* Lists half-edges of edges of more than two; *count may be more than there was room for. */
static dp_result list_many(dp_gl *gl, uint32_t room, uint32_t *count, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "fins_many.comp"};
    dp_gl_fins *const f = gl->fins;
    uint32_t program;
    dp_result result = dp_gl_buffer_reserve(gl, &f->many, HEAD + (size_t)room * sizeof(many),
                                            "half-edges where several triangles meet", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_buffer_clear(gl, &f->many, HEAD, 0);
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->lines.mates, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &f->many, DP_GL_BIND_RINGS);
    dp_gl_uniform_u(gl, program, "room", room);
    dp_gl_dispatch(gl, 3 * gl->scene.triangle_count);
    dp_gl_buffer_read(gl, &f->many, 0, 4, count);
    return DP_OK;
}

/* Fills rings[0 to count) and the words before them. */
static void sort_rings(many *list, uint32_t count, uint32_t *words) {
    ring *const rings = (ring *)(words + 2);
    dp_sort(list, count, sizeof *list, by_edge);
    for (uint32_t i = 0, first = 0; i < count; i++) {
        if (memcmp(list[i].ends, list[first].ends, sizeof list->ends) != 0) first = i;
        rings[i] = (ring){list[i].half_edge, list[first].half_edge};
    }
    dp_sort(rings, count, sizeof *rings, by_first);
    words[0] = count, words[1] = 0;
}

static dp_result find_rings(dp_gl *gl, dp_diag *diag) {
    uint32_t count = 0;
    dp_result result = list_many(gl, ROOM, &count, diag);
    if (!result && count > ROOM) result = list_many(gl, count, &count, diag);
    if (result) return result;
    many *const list = dp_alloc_array(&gl->memory, (size_t)count + 1, sizeof *list);
    uint32_t *const words = dp_alloc_array(&gl->memory, 2 * (size_t)count + 4, sizeof *words);
    if (list && words) {
        if (count) dp_gl_buffer_read(gl, &gl->fins->many, HEAD, count * sizeof *list, list);
        memset(words, 0, 16);
        sort_rings(list, count, words);
        result = dp_gl_buffer_fill(gl, &gl->fins->rings, words, 8 * (size_t)count + 16,
                                   "edges where several triangles meet", diag);
    } else {
        result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for edges of several triangles");
    }
    dp_free(&gl->memory, list), dp_free(&gl->memory, words);
    return result;
}

static dp_result make_six(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "fins_six.comp"};
    dp_gl_fins *const f = gl->fins;
    uint32_t program;
    dp_result result = dp_gl_buffer_reserve(gl, &f->six, 24 * (size_t)gl->scene.triangle_count,
                                            "indices with adjacency", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->lines.mates, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &f->six, DP_GL_BIND_RINGS);
    dp_gl_dispatch(gl, gl->scene.triangle_count);
    gl->api.MemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_fins_adjacency(dp_gl *gl, dp_diag *diag) {
    dp_gl_fins *const f = gl->fins;
    if (f->topology == gl->lines.topology) return DP_OK;
    dp_result result = find_rings(gl, diag);
    if (!result) result = make_six(gl, diag);
    if (!result) f->topology = gl->lines.topology;
    return result;
}

/* ------- without a geometry shader ------- */

static dp_result list_pass(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t items,
                           dp_diag *diag) {
    dp_gl_fins *const f = gl->fins;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->lines.mates, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &f->rings, DP_GL_BIND_RINGS);
    dp_gl_buffer_bind(gl, &f->facing, DP_GL_BIND_FACING);
    dp_gl_buffer_bind(gl, &f->listed, DP_GL_BIND_LISTED);
    dp_gl_buffer_bind(gl, &f->sums, DP_GL_BIND_SUMS);
    dp_gl_uniform_u(gl, program, "lines", gl->style.lines & (DP_SILHOUETTE | DP_BORDER));
    dp_gl_dispatch(gl, items);
    return DP_OK;
}

dp_result dp_gl_fins_list(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc facing = {.compute = "fins_facing.comp"},
                                    count = {.compute = "fins_list.comp",
                                             .defines = "#define COUNT\n"},
                                    sums = {.compute = "fins_sums.comp"},
                                    put = {.compute = "fins_list.comp"};
    const uint32_t n = gl->scene.triangle_count;
    dp_gl_fins *const f = gl->fins;
    dp_result result =
        dp_gl_buffer_reserve(gl, &f->facing, 8 * (size_t)n, "facing of triangles", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &f->listed, 12 * (size_t)n, "a list of outlines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &f->sums, 16 + 4 * ((size_t)n / 64 + 1),
                                      "counts of outlines", diag);
    if (!result) result = list_pass(gl, &facing, n, diag);
    if (!result) result = list_pass(gl, &count, n, diag);
    if (!result) result = list_pass(gl, &sums, 1, diag);
    if (!result) result = list_pass(gl, &put, n, diag);
    return result;
}
