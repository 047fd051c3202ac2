/* Intersections: where the interiors of two polygons cross in sight (find/intersect.c).
 *
 *    pixels  in or beside which neighbouring samples show two polygons
 *    near    of these, pairs whose planes cross between the samples
 *    seed    cross them exactly, each pair once; from there on along the crossing, over the edges that it leaves
 *            them by
 *    link    crossings → lists of the cells of the screen that they run through
 *    add     what no earlier crossing covers → candidates
 *
 * Where a crossing is in sight the nearer of the two surfaces changes there, so samples on both sides of it show
 * both. Fine meshes, of which not every triangle shows in a sample, are followed by their mates. Data structure: a table of
 * pairs that have been asked for, open addressing. Invariant: each pair is asked once. Where triangles are far
 * smaller than a pixel a walk may end beside another one's, so that parts of a pixel are found in one picture and not in
 * the next. Not handled: crossings less than a pixel long of polygons without neighbours. */
#include "gl/lines.h"

/* The same in shaders/crossings.glsl. */
typedef struct crossing_head {
    uint32_t pairs, nodes, pairs_room, nodes_room;
    uint32_t slots, cells_x, cells_y, candidates_room;
    uint32_t pixels, hits, hits_room, free;
    uint32_t groups[3][4];
} crossing_head;

enum { CELL = 16 /* px */, PAIR_SIZE = 48, NODE_SIZE = 8, HIT_SIZE = 8, FIRST_ROOM = 1 << 12 };

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
    if (!result)
        result = dp_gl_buffer_reserve(gl, &e->hits, FIRST_ROOM * (size_t)HIT_SIZE,
                                      "triangles whose planes cross", diag);
    if (!result)
        result =
            dp_gl_buffer_reserve(gl, &e->pixels, 4 * (size_t)gl->target.width * gl->target.height,
                                 "pixels of several polygons", diag);
    if (result) return result;
    crossing_head h = {.pairs_room = (uint32_t)(e->crossed.size / PAIR_SIZE),
                       .nodes_room = (uint32_t)(e->along.size / NODE_SIZE),
                       .hits_room = (uint32_t)(e->hits.size / HIT_SIZE),
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

/* A pass over what `groups` counts, -1: over all pixels; bound to what it reads and writes beside the table and the pairs. */
typedef struct pass {
    const char *file;
    const dp_gl_buffer *own[3]; /* bindings 4, 6, 7 */
    int groups;
} pass;

static dp_result run_pass(dp_gl *gl, const pass *p, dp_diag *diag) {
    static const uint32_t at[3] = {DP_GL_BIND_OWN + 1, DP_GL_BIND_OWN + 3, DP_GL_BIND_OWN + 4};
    const dp_gl_program_desc desc = {.compute = p->file};
    const size_t arguments =
        offsetof(crossing_head, groups) + 16 * (size_t)(p->groups < 0 ? 0 : p->groups);
    uint32_t program;
    if (p->groups >= 0 && dp_gl_program_is_spared(gl, &desc, &gl->eye.pairs, arguments))
        return DP_OK;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_buffer_bind(gl, &gl->eye.pairs, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &gl->eye.crossed, DP_GL_BIND_OWN + 2);
    for (int i = 0; i < 3; i++)
        if (p->own[i]) dp_gl_buffer_bind(gl, p->own[i], at[i]);
    if (p->groups < 0) {
        dp_gl_dispatch_pixels(gl);
        return DP_OK;
    }
    gl->api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, gl->eye.pairs.name);
    gl->api.DispatchComputeIndirect((GLintptr)arguments);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

/* How many groups the passes after this have. */
static dp_result prepare(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "crossings_prepare.comp"};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_buffer_bind(gl, &gl->eye.pairs, DP_GL_BIND_OWN);
    gl->api.DispatchCompute(1, 1, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

enum { GROUPS_PIXELS = -1, GROUPS_LISTED, GROUPS_HITS, GROUPS_PAIRS };

dp_result dp_gl_find_crossings(dp_gl *gl, dp_diag *diag) {
    const dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_eye *const e = &gl->eye;
    const pass passes[] = {
        {"crossings_pixels.comp", {NULL, &e->pixels}, GROUPS_PIXELS},
        {"crossings_near.comp", {NULL, &e->pixels, &e->hits}, GROUPS_LISTED},
        {"crossings_seed.comp", {&l->mates, NULL, &e->hits}, GROUPS_HITS},
        {"crossings_link.comp", {NULL, &e->along, NULL}, GROUPS_PAIRS},
        {"crossings_add.comp", {&l->counters, &e->along, &l->candidates}, GROUPS_PAIRS}};
    if (!(gl->style.lines & DP_INTERSECTION)) return DP_OK;
    dp_result result = begin(gl, diag);
    if (result) return result;
    dp_gl_scene_bind(gl);
    for (size_t i = 0; i < sizeof passes / sizeof *passes && !result; i++) {
        if (i > 0 && i < 4) result = prepare(gl, diag);
        if (!result) result = run_pass(gl, &passes[i], diag);
    }
    return result;
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
    if (!result && h.hits > h.hits_room) {
        *again = true;
        result = dp_gl_buffer_reserve(gl, &e->hits, h.hits * (size_t)HIT_SIZE,
                                      "triangles whose planes cross", diag);
    }
    if (!result && h.nodes > h.nodes_room) {
        *again = true;
        result = dp_gl_buffer_reserve(gl, &e->along, h.nodes * (size_t)NODE_SIZE,
                                      "crossings by cells", diag);
    }
    return result;
}
