/* Intersections: where the interiors of two polygons cross in sight (find/intersect.c).
 *
 *    seed    neighbouring samples show two polygons whose planes cross between them: cross these exactly, each pair
 *            once; from there on along the crossing, over the edges that it leaves them by
 *    link    crossings → lists of the cells of the screen that they run through
 *    add     what no earlier crossing covers → candidates
 *
 * Where a crossing is in sight the nearer of the two surfaces changes there, so samples on both sides of it show
 * both. Fine meshes, of which not every triangle shows in a sample, are followed by their mates. Data structure: a table of
 * pairs that have been asked for, open addressing. Invariant: what is found does not depend on the order in which pairs
 * are asked. Not handled: crossings less than a pixel long of polygons without neighbours. */
#include "gl/lines.h"
#include "gl/scene.h"

/* The same in shaders/crossings.glsl. */
typedef struct crossing_head {
    uint32_t pairs, nodes, pairs_room, nodes_room;
    uint32_t slots, cells_x, cells_y, candidates_room;
    uint32_t groups[4];
} crossing_head;

enum { CELL = 16 /* px */, PAIR_SIZE = 48, NODE_SIZE = 8, FIRST_ROOM = 1 << 12 };

/* As many slots as keep the table half empty: a power of two. */
static uint32_t slots_for(uint32_t pairs) {
    uint32_t slots = 2;
    while (slots < 2 * pairs) slots *= 2;
    return slots;
}

/* Clears the table and the lists, and writes what they begin with. */
static dp_result begin(dp_gl *gl, dp_diag *diag) {
    dp_gl_eye *const e = &gl->eye;
    dp_result result = dp_gl_buffer_reserve(gl, &e->crossed, FIRST_ROOM * (size_t)PAIR_SIZE,
                                            "polygons that may cross", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &e->along, FIRST_ROOM * (size_t)NODE_SIZE,
                                      "crossings by cells", diag);
    if (result) return result;
    crossing_head h = {.pairs_room = (uint32_t)(e->crossed.size / PAIR_SIZE),
                       .nodes_room = (uint32_t)(e->along.size / NODE_SIZE),
                       .cells_x = (gl->target.width + CELL - 1) / CELL,
                       .cells_y = (gl->target.height + CELL - 1) / CELL,
                       .candidates_room =
                           (uint32_t)(gl->lines.candidates.size / sizeof(dp_gl_candidate))};
    h.slots = slots_for(h.pairs_room);
    const size_t size = sizeof h + 4 * (h.slots + (size_t)h.cells_x * h.cells_y);
    result = dp_gl_buffer_reserve(gl, &e->pairs, size, "a table of polygons that may cross", diag);
    if (result) return result;
    dp_gl_buffer_clear(gl, &e->pairs, size, 0);
    gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, 0, sizeof h, &h);
    return DP_OK;
}

static dp_result use(dp_gl *gl, const char *file, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = file};
    const dp_gl_eye *const e = &gl->eye;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_buffer_bind(gl, &e->pairs, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &e->crossed, DP_GL_BIND_OWN + 2);
    dp_gl_buffer_bind(gl, &e->along, DP_GL_BIND_OWN + 3);
    return DP_OK;
}

static dp_result over_pairs(dp_gl *gl, const char *file, dp_diag *diag) {
    const dp_result result = use(gl, file, diag);
    if (result) return result;
    dp_gl_buffer_bind(gl, &gl->lines.counters, DP_GL_BIND_OWN + 1);
    dp_gl_buffer_bind(gl, &gl->lines.candidates, DP_GL_BIND_OWN + 4);
    gl->api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, gl->eye.pairs.name);
    gl->api.DispatchComputeIndirect((GLintptr)offsetof(crossing_head, groups));
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_find_crossings(dp_gl *gl, dp_diag *diag) {
    if (!(gl->style.lines & DP_INTERSECTION)) return DP_OK;
    dp_result result = begin(gl, diag);
    if (result) return result;
    dp_gl_scene_bind(gl);
    result = use(gl, "crossings_seed.comp", diag);
    if (result) return result;
    dp_gl_buffer_bind(gl, &gl->lines.mates, DP_GL_BIND_OWN + 1);
    dp_gl_dispatch_pixels(gl);
    result = use(gl, "crossings_prepare.comp", diag);
    if (result) return result;
    gl->api.DispatchCompute(1, 1, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    result = over_pairs(gl, "crossings_link.comp", diag);
    return result ? result : over_pairs(gl, "crossings_add.comp", diag);
}

dp_result dp_gl_grow_crossings(dp_gl *gl, bool *again, dp_diag *diag) {
    dp_gl_eye *const e = &gl->eye;
    crossing_head h;
    dp_result result = DP_OK;
    if (!(gl->style.lines & DP_INTERSECTION)) return DP_OK;
    dp_gl_buffer_read(gl, &e->pairs, 0, sizeof h, &h);
    if (h.pairs > h.pairs_room) {
        *again = true;
        result = dp_gl_buffer_reserve(gl, &e->crossed, h.pairs * (size_t)PAIR_SIZE,
                                      "polygons that may cross", diag);
    }
    if (!result && h.nodes > h.nodes_room) {
        *again = true;
        result = dp_gl_buffer_reserve(gl, &e->along, h.nodes * (size_t)NODE_SIZE,
                                      "crossings by cells", diag);
    }
    return result;
}
