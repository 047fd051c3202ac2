/* Edges where the eye decides: find/dispute.c and find/emerge.c, in passes of the device.
 *
 *    suspect   what samples show beside candidates that is not expected there
 *    dispute   candidates of which that changes what is seen are taken out, and disputed
 *    collect   the disputed half-edges and their mates, each once: `looked`; their sample points in chunks
 *    drawn     marks half-edges that have made lines
 *    cells     marks the cells of 8 x 8 px in which there are sample points
 *    bin       polygons → lists of the marked cells that they touch
 *    backs     marks the tiles in which back faces are seen
 *    look      for each sample point: what is seen to the left and to the right of the edge, of its cell's polygons
 *    runs      of sample points with one answer → candidates
 *
 * Where nothing is disputed all but the first and two of one invocation are dispatches of no group: counts stay on the
 * device. Data structure: one buffer of words (eye.glsl) with counts and rooms first. Invariant: what is found
 * does not depend on the order in which lists were made, as polygons at a point are sorted. Not handled: more than 16
 * polygons at one point (those that come first in the source count); exact ends, hidden lines. */
#include "gl/lines.h"

/* The same in shaders/eye.glsl. */
typedef struct eye_head {
    uint32_t looked, chunks, places, nodes;
    uint32_t looked_room, chunks_room, places_room, nodes_room;
    uint32_t cells_x, cells_y, emerging_at, cells_at, lists_at, candidates_room, disputed_room,
        all_edges;
    float touching, crack, precision;
    uint32_t tiles_at;
    uint32_t suspects, suspects_room, free[2];
    uint32_t groups[8][4];
} eye_head;

enum {
    CELL = 8 /* px */,
    LOOKED_SIZE = 32,
    NODE_SIZE = 32,
    SUSPECT_SIZE = 16,
    FINDING_SIZE = 16,
    CANDIDATE_SIZE = 32
};
enum { LEAST = 1024 /* entries */ };

enum {
    GROUPS_CANDIDATES,
    GROUPS_DISPUTED,
    GROUPS_LOOKED,
    GROUPS_CHUNKS,
    GROUPS_TRIANGLES,
    GROUPS_DRAWN,
    GROUPS_CELLS,
    GROUPS_SUSPECTS
};

static size_t words_of(size_t bits) { return (bits + 31) / 32; }

static uint32_t room(const dp_gl_buffer *buffer, size_t entry) {
    return (uint32_t)(buffer->size / entry);
}

/* Offsets in the words, and how many there are. */
static size_t lay_out(const dp_gl *gl, eye_head *h) {
    const size_t bits = words_of(3 * (size_t)gl->scene.triangle_count);
    h->cells_x = (gl->target.width + CELL - 1) / CELL;
    h->cells_y = (gl->target.height + CELL - 1) / CELL;
    const size_t cells = (size_t)h->cells_x * h->cells_y;
    h->emerging_at = (uint32_t)bits;
    h->cells_at = (uint32_t)(2 * bits);
    h->tiles_at = (uint32_t)(2 * bits + words_of(cells));
    h->lists_at = h->tiles_at + (uint32_t)words_of(cells); /* there are fewer tiles */
    return h->lists_at + cells;
}

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_gl_eye *const e = &gl->eye;
    const struct {
        dp_gl_buffer *buffer;
        size_t entry;
        const char *what;
    } buffers[] = {{&e->looked, LOOKED_SIZE, "edges where the eye decides"},
                   {&e->chunks, 4, "parts of edges where the eye decides"},
                   {&e->nodes, NODE_SIZE, "polygons beside edges"},
                   {&e->findings, FINDING_SIZE, "sample points of edges"},
                   {&e->listed, SUSPECT_SIZE, "what may dispute lines"},
                   {&l->candidates, CANDIDATE_SIZE, "lines that may be visible"},
                   {&l->disputed, 4, "disputed edges"},
                   {&l->mates, 4, "mates"},
                   {&l->counters, sizeof(dp_gl_counters) / LEAST + 1, "counters"}};
    dp_result result = DP_OK;
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers && !result; i++)
        if (!buffers[i].buffer->name)
            result = dp_gl_buffer_reserve(gl, buffers[i].buffer, LEAST * buffers[i].entry,
                                          buffers[i].what, diag);
    return result;
}

/* What the model's own rounding allows: as the CPU has it of all polygons together (core/precision.c). */
static dp_tolerances tolerances_of(const dp_gl *gl) {
    static const dp_written unknown = {0};
    dp_written all = {0};
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        if (!(m->written.precision > 0) || m->placed) return dp_tolerances_of(&unknown, &gl->view);
        dp_vec3 by;
        by.x = m->origin[0] - gl->scene.origin[0], by.y = m->origin[1] - gl->scene.origin[1];
        by.z = m->origin[2] - gl->scene.origin[2];
        const dp_vec3 least = dp_add(m->written.least, by), most = dp_add(m->written.most, by);
        if (i == 0) all = (dp_written){m->written.precision, least, most};
        all.precision = dp_min(all.precision, m->written.precision);
        all.least = dp_v3(dp_min(all.least.x, least.x), dp_min(all.least.y, least.y),
                          dp_min(all.least.z, least.z));
        all.most = dp_v3(dp_max(all.most.x, most.x), dp_max(all.most.y, most.y),
                         dp_max(all.most.z, most.z));
    }
    return dp_tolerances_of(&all, &gl->view);
}

/* Clears the words, and writes what they begin with. */
static dp_result begin(dp_gl *gl, dp_diag *diag) {
    const dp_tolerances t = tolerances_of(gl);
    eye_head h = {.touching = t.touching, .crack = t.crack, .precision = (float)t.precision};
    const size_t size = sizeof h + 4 * lay_out(gl, &h);
    dp_result result = reserve(gl, diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &gl->eye.words, size, "marks of edges and cells", diag);
    if (result) return result;
    h.looked_room = room(&gl->eye.looked, LOOKED_SIZE);
    h.chunks_room = room(&gl->eye.chunks, 4);
    h.places_room = room(&gl->eye.findings, FINDING_SIZE);
    h.nodes_room = room(&gl->eye.nodes, NODE_SIZE);
    h.suspects_room = room(&gl->eye.listed, SUSPECT_SIZE);
    h.candidates_room = room(&gl->lines.candidates, CANDIDATE_SIZE);
    h.disputed_room = room(&gl->lines.disputed, 4);
    h.all_edges = gl->style.edge_table_off;
    dp_gl_buffer_clear(gl, &gl->eye.words, size, 0);
    gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, 0, sizeof h, &h);
    return DP_OK;
}

/* A pass: its shader, what it is bound to from DP_GL_BIND_OWN + 1 on, and which groups it has. */
typedef struct pass {
    const char *file;
    const dp_gl_buffer *own[4];
    int groups; /* GROUPS_…, -1: one of every 64 triangles */
} pass;

static dp_result use(dp_gl *gl, const char *file, const dp_gl_buffer *const own[4],
                     uint32_t *program, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = file};
    const dp_result result = dp_gl_program(gl, &desc, program, diag);
    if (result) return result;
    dp_gl_use(gl, *program);
    dp_gl_buffer_bind(gl, &gl->eye.words, DP_GL_BIND_OWN);
    for (uint32_t i = 0; i < 4; i++)
        if (own[i]) dp_gl_buffer_bind(gl, own[i], DP_GL_BIND_OWN + 1 + i);
    return DP_OK;
}

static void barrier(dp_gl *gl) {
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

static dp_result run_pass(dp_gl *gl, const pass *p, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = p->file};
    const size_t arguments =
        offsetof(eye_head, groups) + 16 * (size_t)(p->groups < 0 ? 0 : p->groups);
    uint32_t program;
    if (p->groups >= 0 && dp_gl_program_is_spared(gl, &desc, &gl->eye.words, arguments))
        return DP_OK;
    const dp_result result = use(gl, p->file, p->own, &program, diag);
    if (result) return result;
    dp_gl_faces_bind(gl, program);
    if (p->groups < 0) {
        dp_gl_dispatch(gl, gl->scene.triangle_count);
        return DP_OK;
    }
    gl->api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, gl->eye.words.name);
    gl->api.DispatchComputeIndirect((GLintptr)arguments);
    barrier(gl);
    return DP_OK;
}

/* How many groups the passes after this have: shaders/eye_prepare.comp. */
static dp_result prepare(dp_gl *gl, uint32_t step, dp_diag *diag) {
    uint32_t program;
    const dp_gl_buffer *const own[4] = {&gl->lines.counters};
    const dp_result result = use(gl, "eye_prepare.comp", own, &program, diag);
    if (result) return result;
    dp_gl_uniform_u(gl, program, "step_", step);
    gl->api.DispatchCompute(1, 1, 1);
    barrier(gl);
    return DP_OK;
}

static dp_result run_passes(dp_gl *gl, const pass *passes, size_t count, dp_diag *diag) {
    dp_result result = DP_OK;
    for (size_t i = 0; i < count && !result; i++) result = run_pass(gl, &passes[i], diag);
    return result;
}

/* Candidates and half-edges that are disputed. */
static dp_result dispute(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const listed = &gl->eye.listed;
    const pass all = {"eye_all.comp", {&l->counters, NULL, &l->disputed, NULL}, -1};
    const pass suspect = {
        "eye_suspect.comp", {&l->counters, &l->candidates, listed, &l->sides}, GROUPS_CANDIDATES};
    const pass decide = {
        "eye_dispute.comp", {&l->counters, &l->candidates, &l->disputed, listed}, GROUPS_SUSPECTS};
    if (!gl->style.edge_table_off) {
        dp_result result = prepare(gl, 0, diag);
        if (!result) result = run_pass(gl, &suspect, diag);
        if (!result) result = prepare(gl, 3, diag);
        return result ? result : run_pass(gl, &decide, diag);
    }
    static const uint32_t none[2] = {0, 0};
    gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, l->counters.name);
    gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, offsetof(dp_gl_counters, candidates), sizeof none,
                          none);
    return run_pass(gl, &all, diag);
}

dp_result dp_gl_find_emerging(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_gl_eye *const e = &gl->eye;
    const pass collect = {
        "eye_collect.comp", {&l->counters, &e->looked, &l->disputed, &l->mates}, GROUPS_DISPUTED};
    const pass passes[] = {
        {"eye_chunks.comp", {&e->looked, &e->chunks}, GROUPS_LOOKED},
        {"eye_drawn.comp", {&l->counters, &l->candidates, NULL, &l->mates}, GROUPS_DRAWN},
        {"eye_cells.comp", {&e->looked, &e->chunks}, GROUPS_CHUNKS},
        {"eye_bin.comp", {&e->nodes}, GROUPS_TRIANGLES},
        {"eye_backs.comp", {&l->sides}, GROUPS_CELLS},
        {"eye_look.comp", {&e->looked, &e->chunks, &e->nodes, &e->findings}, GROUPS_CHUNKS},
        {"eye_runs.comp", {&e->looked, &l->counters, &e->findings, &l->candidates}, GROUPS_LOOKED}};
    dp_result result = begin(gl, diag);
    if (result) return result;
    dp_gl_scene_bind(gl);
    result = dispute(gl, diag);
    if (!result) result = prepare(gl, 1, diag);
    if (!result) result = run_pass(gl, &collect, diag);
    if (!result) result = prepare(gl, 2, diag);
    if (!result) result = run_passes(gl, passes, sizeof passes / sizeof *passes, diag);
    return result;
}

dp_result dp_gl_grow_emerging(dp_gl *gl, bool *again, dp_diag *diag) {
    dp_gl_eye *const e = &gl->eye;
    eye_head h;
    if (!e->words.name) return DP_OK;
    dp_gl_buffer_read(gl, &e->words, 0, sizeof h, &h);
    const struct {
        dp_gl_buffer *buffer;
        size_t entry;
        uint32_t wanted;
        const char *what;
    } buffers[] = {{&e->looked, LOOKED_SIZE, h.looked, "edges where the eye decides"},
                   {&e->chunks, 4, h.chunks, "parts of edges where the eye decides"},
                   {&e->nodes, NODE_SIZE, h.nodes, "polygons beside edges"},
                   {&e->listed, SUSPECT_SIZE, h.suspects, "what may dispute lines"},
                   {&e->findings, FINDING_SIZE, h.places, "sample points of edges"}};
    dp_result result = DP_OK;
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers && !result; i++) {
        if (buffers[i].wanted <= room(buffers[i].buffer, buffers[i].entry)) continue;
        *again = true;
        result = dp_gl_buffer_reserve(gl, buffers[i].buffer, buffers[i].wanted * buffers[i].entry,
                                      buffers[i].what, diag);
    }
    return result ? result : dp_gl_grow_crossings(gl, again, diag);
}

void dp_gl_eye_free(dp_gl *gl) {
    dp_gl_eye *const e = &gl->eye;
    dp_gl_buffer *const buffers[] = {&e->words,    &e->looked, &e->chunks,  &e->nodes,
                                     &e->findings, &e->pairs,  &e->crossed, &e->along,
                                     &e->pixels,   &e->hits,   &e->listed};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) dp_gl_buffer_free(gl, buffers[i]);
}
