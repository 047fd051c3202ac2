/* The primitive shader (Raskar 2001, Figure 2) on the device: from half-edges to lists of added polygons.
 *
 * Data structure: `records` holds what one portion of half-edges adds, a list after the other, and `commands`
 * how many of each list are to be drawn. A list has room for the most that a portion can add, so that nothing is read
 * back and nothing can be full; models of any size take the same memory. Invariant: a portion's lists are drawn
 * before the next portion is shaded. */
#include "gl/quads.h"

#include "base/elementary.h"

#include <math.h>

enum {
    RECORD = 80,           /* bytes: Added in quads_records.glsl */
    BYTES_MOST = 24 << 20, /* of records */
    SPANS = 7,             /* triangles of a joint, at most: quads_exact.glsl */
    PAPER = 6 /* records of a quad as printed: 4 corners, 6 planes, 4 sides, as a fan */
};

typedef struct command {
    uint32_t count, instances, first, base;
} command;

static const double SAGITTA = 0.3; /* px: as in quads_exact.glsl */

/* How many triangles a joint of this reach has at most: it turns by 180 degrees. */
static uint32_t spans_of(double reach) {
    const double half = 1 - fmin(SAGITTA / reach, 1), span = dp_acos(fmax(2 * half * half - 1, -1)),
                 most = floor(3.14159265358979323846 / span) + 1;
    return most < SPANS ? (uint32_t)most : SPANS;
}

static uint32_t ridge_line(const dp_style *s) {
    return s->lines & DP_RIDGE ? DP_LINE_RIDGE : s->lines & DP_BORDER ? DP_LINE_BORDER : UINT32_MAX;
}

/* px: how far lines of silhouettes, ridges or borders, and valleys are drawn from their edge. */
static void reaches(const dp_style *s, float out[3]) {
    const uint32_t ridge = ridge_line(s);
    out[0] = s->line[DP_LINE_SILHOUETTE].width;
    out[1] = ridge != UINT32_MAX ? s->line[ridge].width / 2 : 1;
    out[2] = s->line[DP_LINE_VALLEY].width * (dp_gl_is_once(s) ? 1 : 0.5f);
}

/* Are joints of ridges asked about the surface (printed/quads.c, joint_fill)? */
static bool asks_joints(const dp_style *s) {
    return s->method == DP_METHOD_EXACT && s->between != DP_BETWEEN_INTERVAL;
}

static void count_rooms(const dp_style *s, bool once, dp_gl_portions *out) {
    const bool paper = s->method == DP_METHOD_PAPER, ridge = ridge_line(s) != UINT32_MAX;
    float reach[3];
    reaches(s, reach);
    const uint32_t outline = paper ? 2 * PAPER : 1 + spans_of((double)reach[0]),
                   fold = paper ? PAPER : 1, joint = paper ? 0 : spans_of((double)reach[1]),
                   valley = paper ? PAPER : 1 + spans_of((double)reach[2]);
    const bool apart = asks_joints(s);
    uint32_t lines = s->lines & DP_SILHOUETTE ? outline : 0;
    if (ridge && fold + (apart ? 0 : joint) > lines) lines = fold + (apart ? 0 : joint);
    out->room[DP_GL_ADDED_LINES] = lines;
    out->room[DP_GL_ADDED_JOINTS] = ridge && apart ? joint : 0;
    out->room[DP_GL_ADDED_VALLEYS] = s->lines & DP_VALLEY ? valley : 0;
    out->places = (uint32_t)once;
    for (int i = 0; i < DP_GL_ADDED_LISTS; i++) out->places += out->room[i];
    if (!out->places) out->places = 1;
}

static dp_result write_commands(dp_gl *gl, const dp_gl_portions *p, dp_diag *diag) {
    const size_t count = (size_t)p->count * DP_GL_ADDED_LISTS;
    command *const commands = dp_alloc_array(&gl->memory, count + 1, sizeof *commands);
    if (!commands) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for added polygons");
    for (size_t i = 0; i < count; i++) {
        const size_t list = i % DP_GL_ADDED_LISTS;
        commands[i] = (command){0, 1, list ? 6 * p->ends[list - 1] : 0, 0};
    }
    const dp_result result =
        dp_gl_buffer_fill(gl, &gl->quads->commands, commands, count * sizeof *commands,
                          "commands to draw added polygons", diag);
    dp_free(&gl->memory, commands);
    return result;
}

static uint32_t blocks_of(double px) { return ((uint32_t)px + 7) / 8; }

/* What hides: the farthest depth in blocks of the picture. */
static dp_result find_blocks(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "quads_blocks.comp"};
    dp_gl_quads *const q = gl->quads;
    const uint32_t x = blocks_of(gl->view.width), y = blocks_of(gl->view.height);
    uint32_t program;
    dp_result result =
        dp_gl_buffer_reserve(gl, &q->blocks, 4 * (size_t)x * y, "depths of blocks", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_uniform_2f(gl, program, "depth_range", q->range);
    dp_gl_uniform_u(gl, program, "blocks_x", x);
    dp_gl_uniform_u(gl, program, "blocks_y", y);
    dp_gl_buffer_bind(gl, &q->blocks, DP_GL_BIND_OWN + 1);
    dp_gl_dispatch(gl, x * y);
    return DP_OK;
}

/* How near that may be drawn which grows from depth d: d * out[0] + out[1]. Not known, and out[2] is 0, where a step in depth
 * is too large for perspective (printed/quads.c, set_reach). */
static void set_hide(const dp_gl *gl, float out[3]) {
    const dp_style *const s = &gl->style;
    double width = 0;
    for (int i = 0; i < DP_LINE_COUNT; i++) width = fmax(width, (double)s->line[i].width);
    const double nearer = s->method == DP_METHOD_PAPER ? 32 : 4,
                 trap = s->between == DP_BETWEEN_PLANE ? 4 * width : (double)s->between_offset,
                 share = (nearer * width + trap + 1) / gl->view.focal;
    const bool perspective = gl->view.perspective;
    out[0] = perspective ? (float)(1 / (1 - share)) : 1;
    out[1] = perspective ? 0 : (float)share;
    out[2] = !perspective || share <= 0.5;
}

dp_result dp_gl_quads_portion(dp_gl *gl, bool once, dp_gl_portions *out, dp_diag *diag) {
    dp_gl_quads *const q = gl->quads;
    const uint32_t all = 3 * gl->scene.triangle_count;
    *out = (dp_gl_portions){0};
    count_rooms(&gl->style, once, out);
    const size_t memory = gl->desc.memory,
                 bytes = memory && memory < BYTES_MOST ? memory : BYTES_MOST;
    out->edges = (uint32_t)(bytes / RECORD / out->places / 192 * 192);
    if (!out->edges) out->edges = 192;
    if (out->edges > all) out->edges = all;
    out->count = (all + out->edges - 1) / out->edges;
    uint32_t end = 0;
    for (int i = 0; i < DP_GL_ADDED_LISTS; i++) out->ends[i] = end += out->edges * out->room[i];
    const size_t most = (size_t)out->edges * out->places;
    dp_result result = dp_gl_buffer_reserve(gl, &q->records, most * RECORD, "added polygons", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &q->counts, once ? 4 * (size_t)out->edges : 64,
                                      "numbers of added polygons", diag);
    if (!result && once)
        result = dp_gl_buffer_reserve(gl, &q->order, 4 * most, "the order of polygons", diag);
    if (!result) result = find_blocks(gl, diag);
    return result ? result : write_commands(gl, out, diag);
}

static void set_pens(dp_gl *gl, uint32_t program) {
    const dp_style *const s = &gl->style;
    const bool paper = s->method == DP_METHOD_PAPER;
    float reach[3], hide[3], most = 0;
    reaches(s, reach);
    set_hide(gl, hide);
    gl->api.Uniform3f(gl->api.GetUniformLocation(program, "hide"), hide[0], hide[1], hide[2]);
    dp_gl_uniform_u(gl, program, "blocks_x", blocks_of(gl->view.width));
    for (int i = 0; i < 3; i++) most = fmaxf(most, reach[i]);
    const float pens[4] = {reach[0], reach[1], reach[2], most * (paper ? 2.2f : 1) + 2};
    dp_gl_uniform_4f(gl, program, "reach", pens);
    dp_gl_uniform_u(gl, program, "ridge_line", ridge_line(s));
    dp_gl_uniform_u(gl, program, "joint_list",
                    asks_joints(s) ? DP_GL_ADDED_JOINTS : DP_GL_ADDED_LINES);
    gl->api.Uniform2ui(gl->api.GetUniformLocation(program, "reflex"), s->ridge_angle > 180,
                       s->valley_angle >= 180);
}

dp_result dp_gl_quads_shade(dp_gl *gl, const dp_gl_portions *p, uint32_t i, bool once,
                            dp_diag *diag) {
    const dp_gl_program_desc desc = {
        .compute = "quads_shade.comp",
        .defines = gl->style.method == DP_METHOD_PAPER ? "#define PAPER\n" : NULL,
        .any_samples = true};
    dp_gl_quads *const q = gl->quads;
    const uint32_t all = 3 * gl->scene.triangle_count, first = i * p->edges,
                   count = all - first < p->edges ? all - first : p->edges;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &q->records, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &q->blocks, DP_GL_BIND_OWN + 1);
    dp_gl_buffer_bind(gl, &q->counts, DP_GL_BIND_OWN + 3);
    dp_gl_buffer_bind(gl, &q->commands, DP_GL_BIND_OWN + 4);
    set_pens(gl, program);
    dp_gl_uniform_u(gl, program, "first_edge", first);
    dp_gl_uniform_u(gl, program, "edge_count", count);
    dp_gl_uniform_u(gl, program, "ordered", once);
    dp_gl_uniform_u(gl, program, "places", p->places);
    dp_gl_uniform_u(gl, program, "first_command", i * DP_GL_ADDED_LISTS);
    gl->api.Uniform4ui(gl->api.GetUniformLocation(program, "list_ends"), p->ends[0], p->ends[1],
                       p->ends[2], 0);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT); /* the last portion has been drawn */
    dp_gl_dispatch(gl, count);
    return DP_OK;
}
