/* Immediate mode (Raskar 2001, Figure 3): calls are recorded, and dp_finish draws.
 *
 * Data structure: one vertex per dp_vertex call, and polygons as lists of corners over them, so
 * that strips and fans share vertices. Every distinct state is a group with a style of its own;
 * groups are found by hash. Invariant: the recording holds whole polygons only; the vertices of an
 * unfinished one lie at the end, after `start`. An edge has the flag of its first vertex: an edge
 * that two polygons of a strip share has one flag. Incomplete primitives at dp_end are ignored, as
 * in OpenGL. */
#include "draw/context.h"

#include "base/diag.h"
#include "mesh/wide.h"

#include <drypoint/immediate.h>

#include <string.h>

/* What may change from polygon to polygon; compared byte by byte, so it holds no padding. */
typedef struct state {
    uint32_t lines;
    dp_line_style line[DP_LINE_COUNT];
    float ridge_angle, valley_angle;
    dp_color surface;
} state;

enum { MAX_GROUPS = 65536 /* dp_batch.groups has 16 bits */ };

struct dp_recording {
    state now;
    dp_style picture; /* what holds for all groups is taken from here */
    dp_camera camera;
    bool has_camera, flag;

    bool open; /* between dp_begin and dp_end */
    dp_primitive_kind kind;
    size_t start; /* first vertex of the primitive */
    uint16_t group;

    float *positions;
    dp_wide wide;      /* chooses their origin */
    uint8_t *flags;    /* per vertex */
    uint32_t *corners; /* vertex */
    uint8_t *corner_flags;
    uint32_t *firsts; /* polygons + 1 */
    uint16_t *groups; /* per polygon */
    state *states;    /* per group */
    dp_style *styles; /* the picture's, then those of the groups, resolved */
    uint32_t *slots;  /* 1 + group; open addressing, at most half full */
    size_t positions_cap, flags_cap, corners_cap, corner_flags_cap, firsts_cap, groups_cap,
        states_cap, styles_cap, slots_cap;
    size_t vertices, corner_count, polygons, group_count, slot_count;

    dp_result wrong; /* the first thing that went wrong since the last dp_finish */
    dp_diag why;
};

static const dp_array arrays[] = {DP_ARRAY(dp_recording, positions, positions_cap),
                                  DP_ARRAY(dp_recording, flags, flags_cap),
                                  DP_ARRAY(dp_recording, corners, corners_cap),
                                  DP_ARRAY(dp_recording, corner_flags, corner_flags_cap),
                                  DP_ARRAY(dp_recording, firsts, firsts_cap),
                                  DP_ARRAY(dp_recording, groups, groups_cap),
                                  DP_ARRAY(dp_recording, states, states_cap),
                                  DP_ARRAY(dp_recording, styles, styles_cap),
                                  DP_ARRAY(dp_recording, slots, slots_cap)};

void dp_recording_free(dp_recording *recording, const dp_allocator *memory) {
    if (recording) dp_wide_free(&recording->wide, memory);
    if (recording) dp_arrays_free(memory, recording, DP_ARRAYS(arrays));
    dp_free(memory, recording);
}

uint64_t dp_recording_bytes(const dp_recording *recording) {
    return recording ? sizeof *recording + dp_arrays_bytes(recording, DP_ARRAYS(arrays)) +
                           recording->wide.rests_cap * sizeof *recording->wide.rests
                     : 0;
}

static void remember(dp_recording *r, dp_result result, const char *message) {
    if (!r->wrong) r->wrong = dp_fail(&r->why, result, "%s", message);
}

static void remember_memory(dp_recording *r) {
    remember(r, DP_ERR_MEMORY, "out of memory for a recording");
}

/* The context's recording, made at the first call. NULL: no context or no memory, which dp_finish
 * tells. */
static dp_recording *recording_of(dp_context *context) {
    if (!context) return NULL;
    if (context->recording) return context->recording;
    dp_recording *const r = dp_alloc_zeroed(&context->memory, sizeof *r);
    if (!r) {
        context->recording_lost = true;
        return NULL;
    }
    r->now.lines = DP_NO_LINES;
    r->flag = true;
    context->recording = r;
    return r;
}

/* ------- state ------- */

static dp_style style_of(const dp_style *picture, const state *s) {
    dp_style style = *picture;
    style.lines = s->lines;
    memcpy(style.line, s->line, sizeof style.line);
    style.ridge_angle = s->ridge_angle;
    style.valley_angle = s->valley_angle;
    style.surface = s->surface;
    return style;
}

/* Takes the state over when it is a sound one; what is wrong is told by the one place that
 * knows. */
static void set_state(dp_recording *r, const state *s) {
    const dp_style style = style_of(&r->picture, s);
    dp_style resolved;
    dp_diag why;
    const dp_result result = dp_style_resolve(&style, &resolved, &why);
    if (result)
        remember(r, result, why.message);
    else
        r->now = *s;
}

static bool known_lines(dp_recording *r, uint32_t lines) {
    if (!(lines & ~DP_ALL_LINES)) return true;
    remember(r, DP_ERR_ARGUMENT, "a set of line classes holds bits that are none");
    return false;
}

void dp_enable(dp_context *context, uint32_t lines) {
    dp_recording *const r = recording_of(context);
    if (!r || !known_lines(r, lines) || !lines) return;
    r->now.lines = (r->now.lines | lines) & DP_ALL_LINES;
}

void dp_disable(dp_context *context, uint32_t lines) {
    dp_recording *const r = recording_of(context);
    if (!r || !known_lines(r, lines)) return;
    r->now.lines &= ~lines;
    if (!r->now.lines) r->now.lines = DP_NO_LINES;
}

void dp_line_width(dp_context *context, uint32_t lines, float px) {
    dp_recording *const r = recording_of(context);
    if (!r || !known_lines(r, lines)) return;
    state s = r->now;
    for (int i = 0; i < DP_LINE_COUNT; i++)
        if (lines >> i & 1) s.line[i].width = px;
    set_state(r, &s);
}

void dp_line_color(dp_context *context, uint32_t lines, dp_color color) {
    dp_recording *const r = recording_of(context);
    if (!r || !known_lines(r, lines)) return;
    for (int i = 0; i < DP_LINE_COUNT; i++)
        if (lines >> i & 1) r->now.line[i].color = color;
}

void dp_ridge_angle(dp_context *context, float degrees) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    state s = r->now;
    s.ridge_angle = degrees;
    set_state(r, &s);
}

void dp_valley_angle(dp_context *context, float degrees) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    state s = r->now;
    s.valley_angle = degrees;
    set_state(r, &s);
}

void dp_surface_color(dp_context *context, dp_color color) {
    dp_recording *const r = recording_of(context);
    if (r) r->now.surface = color;
}

void dp_set_style(dp_context *context, const dp_style *style) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    const dp_style picture = style ? *style : (dp_style){0}, whole = style_of(&picture, &r->now);
    dp_style resolved;
    dp_diag why;
    const dp_result result = dp_style_resolve(&whole, &resolved, &why);
    if (result)
        remember(r, result, why.message);
    else
        r->picture = picture;
}

void dp_set_camera(dp_context *context, const dp_camera *camera) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (!camera) {
        remember(r, DP_ERR_ARGUMENT, "dp_set_camera: camera is NULL");
        return;
    }
    r->camera = *camera;
    r->has_camera = true;
}

/* ------- groups ------- */

static uint32_t hash_state(const state *s) {
    uint32_t words[sizeof *s / sizeof(uint32_t)], hash = 0;
    memcpy(words, s, sizeof words);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        hash = (hash ^ words[i]) * 0x9e3779b1u;
    return hash ^ hash >> 15;
}

/* The slot that holds the state, or the free one where it belongs. */
static uint32_t *find_slot(const dp_recording *r, const state *s) {
    const size_t mask = r->slot_count - 1;
    size_t i = hash_state(s) & mask;
    while (r->slots[i] && memcmp(&r->states[r->slots[i] - 1], s, sizeof *s) != 0)
        i = (i + 1) & mask;
    return &r->slots[i];
}

static bool grow_slots(dp_recording *r, const dp_allocator *memory) {
    if (2 * (r->group_count + 1) <= r->slot_count) return true;
    const size_t count = r->slot_count ? 2 * r->slot_count : 16;
    if (!dp_reserve(memory, &r->slots, &r->slots_cap, count, sizeof *r->slots)) return false;
    r->slot_count = count;
    memset(r->slots, 0, count * sizeof *r->slots);
    for (size_t i = 0; i < r->group_count; i++) *find_slot(r, &r->states[i]) = (uint32_t)i + 1;
    return true;
}

/* Sets the group of the polygons to come. */
static void choose_group(dp_recording *r, const dp_allocator *memory) {
    if (!grow_slots(r, memory) ||
        !dp_reserve(memory, &r->states, &r->states_cap, r->group_count + 1, sizeof *r->states)) {
        remember_memory(r);
        return;
    }
    uint32_t *const slot = find_slot(r, &r->now);
    if (!*slot) {
        if (r->group_count == MAX_GROUPS) {
            remember(r, DP_ERR_LIMIT, "more than 65536 different states between two dp_finish");
            return;
        }
        r->states[r->group_count++] = r->now;
        *slot = (uint32_t)r->group_count;
    }
    r->group = (uint16_t)(*slot - 1);
}

/* ------- polygons ------- */

/* The edge between two corners of a strip or fan has the flag of the earlier vertex; the edges of a
 * polygon by itself have that of the corner they start from. */
static uint8_t edge_flag(const dp_recording *r, uint32_t from, uint32_t to) {
    const bool shared =
        r->kind == DP_TRIANGLE_STRIP || r->kind == DP_TRIANGLE_FAN || r->kind == DP_QUAD_STRIP;
    return r->flags[shared && to < from ? to : from];
}

static void add_polygon(dp_context *context, const uint32_t *vertices, size_t n) {
    dp_recording *const r = context->recording;
    const dp_allocator *const memory = &context->memory;
    const size_t corners = r->corner_count + n, polygons = r->polygons + 1;
    if (corners >= UINT32_MAX) {
        remember(r, DP_ERR_LIMIT, "more corners between two dp_finish than 32 bits count");
        return;
    }
    if (!dp_reserve(memory, &r->corners, &r->corners_cap, corners, sizeof *r->corners) ||
        !dp_reserve(memory, &r->corner_flags, &r->corner_flags_cap, corners, 1) ||
        !dp_reserve(memory, &r->firsts, &r->firsts_cap, polygons + 1, sizeof *r->firsts) ||
        !dp_reserve(memory, &r->groups, &r->groups_cap, polygons, sizeof *r->groups)) {
        remember_memory(r);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        r->corners[r->corner_count + i] = vertices[i];
        r->corner_flags[r->corner_count + i] =
            edge_flag(r, vertices[i], vertices[i + 1 == n ? 0 : i + 1]);
    }
    r->groups[r->polygons] = r->group;
    r->firsts[r->polygons] = (uint32_t)r->corner_count;
    r->firsts[polygons] = (uint32_t)corners;
    r->corner_count = corners;
    r->polygons = polygons;
}

/* The polygon that the k-th vertex of a primitive (0-based) completes; every second triangle of a
 * strip runs the other way round, and so does the far side of each quad. Returns its corners, 0:
 * none. */
static size_t completed(const dp_recording *r, size_t k, uint32_t v[4]) {
    const uint32_t s = (uint32_t)r->start, i = s + (uint32_t)k;
    switch (r->kind) {
    case DP_TRIANGLES:
        v[0] = i - 2, v[1] = i - 1, v[2] = i;
        return k % 3 == 2 ? 3 : 0;
    case DP_TRIANGLE_STRIP:
        v[0] = i - 2 + (k & 1), v[1] = i - 1 - (k & 1), v[2] = i;
        return k >= 2 ? 3 : 0;
    case DP_TRIANGLE_FAN:
        v[0] = s, v[1] = i - 1, v[2] = i;
        return k >= 2 ? 3 : 0;
    case DP_QUADS:
        v[0] = i - 3, v[1] = i - 2, v[2] = i - 1, v[3] = i;
        return k % 4 == 3 ? 4 : 0;
    case DP_QUAD_STRIP:
        v[0] = i - 3, v[1] = i - 2, v[2] = i, v[3] = i - 1;
        return k >= 3 && k % 2 == 1 ? 4 : 0;
    default:
        return 0; /* DP_POLYGON is complete at dp_end */
    }
}

void dp_begin(dp_context *context, dp_primitive_kind kind) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (r->open) {
        remember(r, DP_ERR_ARGUMENT, "dp_begin: called again before dp_end");
        return;
    }
    if ((unsigned)kind > DP_POLYGON) {
        remember(r, DP_ERR_ARGUMENT, "dp_begin: kind is not one of its values");
        return;
    }
    r->open = true;
    r->kind = kind;
    r->start = r->vertices;
    choose_group(r, &context->memory);
}

void dp_edge_flag(dp_context *context, bool flag) {
    dp_recording *const r = recording_of(context);
    if (r) r->flag = flag;
}

/* A vertex, and the same as float32. */
static void add_vertex(dp_context *context, const double wide[3], const float rounded[3]) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (!r->open) remember(r, DP_ERR_ARGUMENT, "dp_vertex: called outside dp_begin and dp_end");
    if (r->vertices >= UINT32_MAX - 1)
        remember(r, DP_ERR_LIMIT, "more vertices between two dp_finish than 32 bits count");
    if (r->wrong) return; /* nothing will be drawn */
    if (!dp_reserve(&context->memory, &r->positions, &r->positions_cap, 3 * (r->vertices + 1),
                    sizeof *r->positions) ||
        !dp_reserve(&context->memory, &r->flags, &r->flags_cap, r->vertices + 1, 1) ||
        !dp_wide_note(&r->wide, r->vertices, wide, rounded, &context->memory)) {
        remember_memory(r);
        return;
    }
    memcpy(r->positions + 3 * r->vertices, rounded, 3 * sizeof *rounded);
    r->flags[r->vertices] = r->flag;
    uint32_t v[4];
    const size_t n = completed(r, r->vertices++ - r->start, v);
    if (n) add_polygon(context, v, n);
}

void dp_vertex3f(dp_context *context, float x, float y, float z) {
    add_vertex(context, (const double[3]){(double)x, (double)y, (double)z},
               (const float[3]){x, y, z});
}

void dp_vertex3d(dp_context *context, double x, double y, double z) {
    add_vertex(context, (const double[3]){x, y, z}, (const float[3]){(float)x, (float)y, (float)z});
}

void dp_vertex3fv(dp_context *context, const float xyz[3]) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (xyz)
        dp_vertex3f(context, xyz[0], xyz[1], xyz[2]);
    else
        remember(r, DP_ERR_ARGUMENT, "dp_vertex3fv: xyz is NULL");
}

void dp_vertex3dv(dp_context *context, const double xyz[3]) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (xyz)
        dp_vertex3d(context, xyz[0], xyz[1], xyz[2]);
    else
        remember(r, DP_ERR_ARGUMENT, "dp_vertex3dv: xyz is NULL");
}

/* A polygon of any number of corners: its vertices are the last ones. */
static void add_open_polygon(dp_context *context) {
    dp_recording *const r = context->recording;
    const size_t n = r->vertices - r->start;
    uint32_t few[16], *vertices = few;
    if (n < 3) return;
    if (n > sizeof few / sizeof *few)
        vertices = dp_alloc_array(&context->memory, n, sizeof *vertices);
    if (!vertices) {
        remember_memory(r);
        return;
    }
    for (size_t i = 0; i < n; i++) vertices[i] = (uint32_t)(r->start + i);
    add_polygon(context, vertices, n);
    if (vertices != few) dp_free(&context->memory, vertices);
}

void dp_end(dp_context *context) {
    dp_recording *const r = recording_of(context);
    if (!r) return;
    if (!r->open) remember(r, DP_ERR_ARGUMENT, "dp_end: called without dp_begin");
    r->open = false;
    if (!r->wrong && r->kind == DP_POLYGON) add_open_polygon(context);
}

/* ------- drawing ------- */

/* The picture's style is that of its first group, which it alone stands for where there are no
 * others; without polygons, the state that holds now, for the paper's sake. */
static dp_result resolve_styles(dp_context *context, uint32_t *count, dp_diag *diag) {
    dp_recording *const r = context->recording;
    *count = r->group_count > 1 ? (uint32_t)r->group_count + 1 : 1;
    if (!dp_reserve(&context->memory, &r->styles, &r->styles_cap, *count, sizeof *r->styles))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for %u styles", *count);
    for (uint32_t i = 0; i < *count; i++) {
        const dp_style style =
            style_of(&r->picture, r->group_count ? &r->states[i ? i - 1 : 0] : &r->now);
        const dp_result result = dp_style_resolve(&style, &r->styles[i], diag);
        if (result) return result;
    }
    return DP_OK;
}

static dp_result draw_recorded(dp_context *context, const dp_target *target, dp_diag *diag) {
    dp_recording *const r = context->recording;
    uint32_t styles;
    dp_result result = resolve_styles(context, &styles, diag);
    if (result) return result;
    double origin[3];
    dp_wide_settle(&r->wide, r->positions, r->vertices, origin, &context->memory);
    const dp_batch batch = {.positions = r->positions,
                            .vertex_count = r->vertices,
                            .indices = r->corners,
                            .corner_count = r->corner_count,
                            .firsts = r->firsts,
                            .polygon_count = r->polygons,
                            .edge_flags = r->corner_flags,
                            .groups = r->groups,
                            .origin = {origin[0], origin[1], origin[2]}};
    dp_source *source;
    if ((result = dp_source_from_arrays(&batch, &context->memory, &source, diag))) return result;
    result = dp_draw_groups(context, source, &r->camera, r->styles, styles, target, diag);
    dp_source_destroy(source);
    return result;
}

static dp_result check_finish(dp_context *context, const dp_target *target, dp_diag *diag) {
    dp_recording *const r = context->recording;
    if (context->recording_lost)
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a recording");
    if (r && r->open) remember(r, DP_ERR_ARGUMENT, "dp_finish: called before dp_end");
    if (r && r->wrong) return dp_fail(diag, r->wrong, "%s", r->why.message);
    if (!target) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_finish: target is NULL");
    if (!r || !r->has_camera)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_finish: dp_set_camera was not called");
    return DP_OK;
}

dp_result dp_finish(dp_context *context, const dp_target *target, dp_diag *diag) {
    if (!context) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_finish: context is NULL");
    dp_forget_drawing(context);
    dp_result result = check_finish(context, target, diag);
    if (!result) result = draw_recorded(context, target, diag);
    dp_context_settle(context, result, diag);
    context->recording_lost = false;
    dp_recording *const r = context->recording;
    if (!r) return result;
    r->open = false;
    r->wrong = DP_OK;
    r->vertices = r->corner_count = r->polygons = r->group_count = r->slot_count = 0;
    dp_wide_free(&r->wide, &context->memory);
    r->wide = (dp_wide){0};
    return result;
}
