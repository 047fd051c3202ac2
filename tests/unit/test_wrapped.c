/* Sources made of sources made of sources, in every order: they can be moved in the middle of a reading,
 * fail and go on, run out of memory anywhere, and leave nothing. */
#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 80, HEIGHT = 60, BYTES = 4 * WIDTH * HEIGHT };

/* ------- memory that is counted, and runs out at allocation `fail_at`; 0: never ------- */

typedef struct meter {
    atomic_long alive, calls, fail_at;
} meter;

static meter m;

static bool fails(void) { return atomic_fetch_add(&m.calls, 1) + 1 == atomic_load(&m.fail_at); }
static void *meter_alloc(size_t size, void *user) {
    void *const block = fails() ? NULL : malloc(size ? size : 1);
    (void)user;
    if (block) atomic_fetch_add(&m.alive, 1);
    return block;
}
static void *meter_realloc(void *block, size_t size, void *user) {
    void *const moved = fails() ? NULL : realloc(block, size ? size : 1);
    (void)user;
    if (moved && !block) atomic_fetch_add(&m.alive, 1);
    return moved;
}
static void meter_free(void *block, void *user) {
    (void)user;
    if (block) atomic_fetch_sub(&m.alive, 1);
    free(block);
}
static const dp_allocator memory = {meter_alloc, meter_realloc, meter_free, NULL};

static void begin_counting(long fail_at) {
    atomic_store(&m.alive, 0), atomic_store(&m.calls, 0), atomic_store(&m.fail_at, fail_at);
}

/* ------- the innermost source: two boxes in two batches, which move apart ------- */

typedef struct boxes {
    float positions[8][3];
    double time;
    int at, fails_at; /* fails_at: the call of set_time that fails; 0: none */
    int calls;
} boxes;

static int failing_call; /* of sources made from now on */

static dp_result boxes_next(void *user, dp_batch *batch, dp_diag *diag) {
    static const uint32_t corners[] = {0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1,
                                       2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3},
                          firsts[] = {0, 4, 8, 12, 16, 20, 24};
    static const uint16_t groups[2][6] = {{0}, {1, 1, 1, 1, 1, 1}};
    boxes *const b = user;
    (void)diag;
    if (b->at == 2) return DP_OK;
    const float far = (float)(b->at * (1.5 + b->time));
    for (int v = 0; v < 8; v++) {
        b->positions[v][0] = far + (float)(v >> 2), b->positions[v][1] = (float)(v >> 1 & 1);
        b->positions[v][2] = (float)(v & 1);
    }
    *batch = (dp_batch){.positions = b->positions[0],
                        .vertex_count = 8,
                        .indices = corners,
                        .corner_count = 24,
                        .firsts = firsts,
                        .polygon_count = 6,
                        .groups = groups[b->at++]};
    return DP_OK;
}
static dp_result boxes_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((boxes *)user)->at = 0;
    return DP_OK;
}
static dp_result boxes_set_time(void *user, double time, dp_diag *diag) {
    boxes *const b = user;
    if (++b->calls == b->fails_at) {
        diag->result = DP_ERR_IO;
        snprintf(diag->message, sizeof diag->message, "the boxes are stuck");
        return DP_ERR_IO;
    }
    b->time = time;
    return DP_OK;
}
static void boxes_destroy(void *user) { meter_free(user, NULL); }

static dp_result make_boxes(dp_source **out, dp_diag *diag) {
    boxes *const b = meter_alloc(sizeof *b, NULL);
    if (!b) return DP_ERR_MEMORY;
    *b = (boxes){.fails_at = failing_call};
    const dp_source_callbacks callbacks = {.user = b,
                                           .next = boxes_next,
                                           .rewind = boxes_rewind,
                                           .destroy = boxes_destroy,
                                           .set_time = boxes_set_time};
    const dp_result result = dp_source_from_callbacks(&callbacks, &memory, out, diag);
    if (result) meter_free(b, NULL);
    return result;
}

/* One that does not move by itself. */
static dp_result make_torus(dp_source **out, dp_diag *diag) {
    const dp_shape shape = {.name = "torus", .triangles = 100, .allocator = &memory};
    return dp_source_from_shape(&shape, out, diag);
}

/* ------- what is made of it ------- */

enum { CLIP, ARRANGE, WAVE, OWN, MORPH, JOIN, WRAPPERS };
enum { DEPTH = 3 };

typedef struct chain {
    int wrapper[DEPTH]; /* the innermost first */
    int depth;
    bool torus;
} chain;

static void lean(void *user, const dp_vertex_run *run) {
    (void)user;
    for (size_t i = 0; i < run->count; i++) {
        const float *const p =
            (const float *)(const void *)((const char *)run->positions + i * run->stride);
        run->moved[i][0] = p[0] + p[1] * (float)run->time;
        run->moved[i][1] = p[1], run->moved[i][2] = p[2];
        for (int k = 0; k < 3; k++) run->normals[i][k] = k == 1;
    }
}

static dp_result make(const chain *c, int depth, dp_source **out, dp_diag *diag);

static dp_result morph(const chain *c, int depth, dp_source *inner, dp_source **out,
                       dp_diag *diag) {
    dp_source *other = NULL;
    dp_result result = make(c, depth, &other, diag);
    const dp_morph half = {.blend = 0.5};
    if (!result) result = dp_source_morph(inner, other, &half, &memory, out, diag);
    if (result) dp_source_destroy(other);
    return result;
}

static dp_result wrap(const chain *c, int depth, dp_source *inner, dp_source **out, dp_diag *diag) {
    static const dp_clip clip = {.planes = {{{1, 0.3, 0.1}, 0.9}, {{0, 1, 0}, 0.8}},
                                 .plane_count = 2};
    static const dp_placement places[2] = {{.offset = {0, 0.2, 0}}, {.offset = {0.1, 0, 0}}};
    static const dp_deform wave = {.amplitude = 0.05}, own = {.vertices = lean, .normals = true};
    static const char *const names[] = {"part"};
    switch (c->wrapper[depth]) {
    case CLIP:
        return dp_source_clip(inner, &clip, &memory, out, diag);
    case ARRANGE:
        return dp_source_arrange(inner, places, 2, &memory, out, diag);
    case WAVE:
        return dp_source_deform(inner, &wave, &memory, out, diag);
    case OWN:
        return dp_source_deform(inner, &own, &memory, out, diag);
    case MORPH:
        return morph(c, depth, inner, out, diag);
    default:
        return dp_source_join(&inner, names, 1, &memory, out, diag);
    }
}

/* A source of the first `depth` wrappers. */
static dp_result make(const chain *c, int depth, dp_source **out, dp_diag *diag) {
    dp_source *inner = NULL;
    *out = NULL;
    if (!depth) return c->torus ? make_torus(out, diag) : make_boxes(out, diag);
    dp_result result = make(c, depth - 1, &inner, diag);
    if (result) return result;
    result = wrap(c, depth - 1, inner, out, diag);
    if (result) dp_source_destroy(inner);
    return result;
}

static dp_source *made(const chain *c) {
    dp_source *source;
    dp_diag diag = {0};
    if (make(c, c->depth, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

typedef void visit(const chain *c);

/* All chains of a depth, of both innermost sources. */
static void for_all(int depth, visit *what) {
    int count = 1;
    for (int k = 0; k < depth; k++) count *= WRAPPERS;
    for (int i = 0; i < 2 * count; i++) {
        chain c = {.depth = depth, .torus = i >= count};
        for (int k = 0, left = i % count; k < depth; k++, left /= WRAPPERS)
            c.wrapper[k] = left % WRAPPERS;
        what(&c);
    }
}

#define fail_chain(c, ...)                                                                         \
    do {                                                                                           \
        print_error("chain %d %d %d of %d, torus %d: ", (c)->wrapper[0], (c)->wrapper[1],          \
                    (c)->wrapper[2], (c)->depth, (c)->torus);                                      \
        fail_msg(__VA_ARGS__);                                                                     \
    } while (0)

/* ------- reading ------- */

/* What is left of a source, as a number; 0 at the end. */
static uint64_t read_rest(const chain *c, dp_source *source) {
    uint64_t sum = 0;
    for (;;) {
        dp_batch b;
        dp_diag diag = {0};
        if (dp_source_next(source, &b, &diag)) fail_chain(c, "%s", diag.message);
        if (!b.polygon_count) return sum;
        const size_t corners = b.firsts ? b.firsts[b.polygon_count] : 3 * b.polygon_count;
        for (size_t i = 0; i < corners; i++) {
            uint32_t bits[3];
            const size_t v = b.indices ? b.indices[i] : i;
            memcpy(bits, (const char *)b.positions + v * b.position_stride, sizeof bits);
            for (int k = 0; k < 3; k++) sum = (sum ^ bits[k]) * 0x100000001B3u + 1;
        }
    }
}

static void check_moved(const chain *c) {
    begin_counting(0);
    dp_source *const source = made(c);
    dp_batch batch;
    dp_diag diag = {0};
    assert_int_equal(dp_source_set_time(source, 0.3, NULL), DP_OK);
    const uint64_t whole = read_rest(c, source);
    if (!whole) fail_chain(c, "nothing is read");
    for (int first = 0; first < 3; first++) {
        assert_int_equal(dp_source_set_time(source, 0.5, NULL), DP_OK);
        for (int k = 0; k < first; k++)
            if (dp_source_next(source, &batch, &diag)) fail_chain(c, "%s", diag.message);
        assert_int_equal(dp_source_set_time(source, 0.3, NULL), DP_OK);
        if (read_rest(c, source) != whole) fail_chain(c, "not whole after %d batches", first);
    }
    dp_source_destroy(source);
    if (m.alive) fail_chain(c, "%ld pieces of memory are left", (long)m.alive);
}

static void time_leads_to_the_start(void **state) {
    (void)state;
    for (int depth = 0; depth <= DEPTH; depth++) for_all(depth, check_moved);
}

/* ------- a source within that fails ------- */

static void check_failing(const chain *c) {
    if (c->torus) return;
    begin_counting(0);
    failing_call = 0;
    dp_source *const good = made(c);
    failing_call = 2;
    dp_source *const bad = made(c);
    failing_call = 0;
    dp_batch batch;
    dp_diag diag = {0};
    assert_int_equal(dp_source_set_time(bad, 0.1, &diag), DP_OK);
    assert_int_equal(dp_source_next(bad, &batch, &diag), DP_OK);
    assert_int_equal(dp_source_set_time(bad, 0.4, &diag), DP_ERR_IO);
    assert_int_equal(diag.result, DP_ERR_IO);
    if (!strstr(diag.message, "the boxes are stuck")) fail_chain(c, "says: %s", diag.message);
    (void)dp_source_next(bad, &batch, &diag); /* whatever comes: nothing that is gone */
    dp_result result = DP_ERR_IO;             /* each of a morph's sources fails once */
    for (int k = 0; k < 8 && result; k++) result = dp_source_set_time(bad, 0.4, &diag);
    assert_int_equal(result, DP_OK);
    assert_int_equal(dp_source_set_time(good, 0.4, &diag), DP_OK);
    if (read_rest(c, bad) != read_rest(c, good)) fail_chain(c, "differs after a failure");
    dp_source_destroy(bad);
    dp_source_destroy(good);
    if (m.alive) fail_chain(c, "%ld pieces of memory are left", (long)m.alive);
}

static void failures_are_passed_on(void **state) {
    (void)state;
    for (int depth = 1; depth <= DEPTH; depth++) for_all(depth, check_failing);
}

/* ------- drawing, with memory that runs out ------- */

typedef struct look {
    dp_style style;
    bool grouped;
} look;

static dp_result draw(const look *l, dp_context *context, dp_source *source, uint8_t *rgba,
                      dp_diag *diag) {
    dp_camera camera = {0};
    dp_style groups[2] = {l->style, l->style};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .samples = 4, .rgba = rgba};
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {3, 2, 1}};
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    groups[1].line[DP_LINE_RIDGE].width = 4;
    const dp_result moved = dp_source_set_time(source, 0.3, diag);
    if (moved) return moved;
    return l->grouped
               ? dp_draw_grouped(context, source, &camera, &l->style, groups, 2, &target, diag)
               : dp_draw(context, source, &camera, &l->style, &target, diag);
}

/* Everything from the first allocation on. True: none failed. */
static bool draw_failing(const chain *c, const look *l, uint32_t threads, long at,
                         uint8_t *expected) {
    static uint8_t rgba[BYTES];
    dp_source *source = NULL;
    dp_context *context = NULL;
    dp_diag diag = {0};
    const dp_context_desc desc = {.allocator = &memory, .threads = threads};
    begin_counting(at);
    dp_result result = make(c, c->depth, &source, &diag);
    if (!result) result = dp_context_create(&desc, &context, &diag);
    if (!result) result = draw(l, context, source, rgba, &diag);
    const bool met = atomic_load(&m.calls) >= at;
    if (result && result != DP_ERR_MEMORY && result != DP_ERR_LIMIT)
        fail_chain(c, "allocation %ld: %s", at, diag.message);
    if (context && result) { /* there is memory again */
        atomic_store(&m.fail_at, 0);
        if (draw(l, context, source, rgba, &diag)) fail_chain(c, "later: %s", diag.message);
    }
    if (context && at == 0) memcpy(expected, rgba, sizeof rgba);
    if (context && memcmp(rgba, expected, sizeof rgba))
        fail_chain(c, "another picture, %u threads, allocation %ld", threads, at);
    dp_context_destroy(context);
    dp_source_destroy(source);
    if (m.alive) fail_chain(c, "%ld pieces are left, allocation %ld", (long)m.alive, at);
    return !met;
}

static void fail_everywhere(const chain *c, const look *l) {
    static uint8_t expected[BYTES];
    (void)draw_failing(c, l, 1, 0, expected);
    for (uint32_t threads = 1; threads <= (c->depth == 1 ? 3 : 1); threads += 2)
        for (long at = 1; !draw_failing(c, l, threads, at, expected); at++) {
        }
}

static const look plain = {.style = {0}};

static void check_memory(const chain *c) {
    if (c->depth == 1 || !c->torus) fail_everywhere(c, &plain);
}

static void memory_may_run_out_anywhere(void **state) {
    (void)state;
    for (int depth = 1; depth < DEPTH; depth++) for_all(depth, check_memory);
}

static void memory_may_run_out_in_every_look(void **state) {
    const look looks[] = {
        {.style = {.xray = 0.4, .shade = {.shading = DP_SHADING_GOOCH}}},
        {.style = {.xray = 0.4, .edge_map = {.detector = DP_EDGE_MAP_C1}}},
        {.style = {.xray = 0.5, .hidden = {.look = DP_HIDDEN_DASHED}}},
        {.style = {.line_light = {.lighting = DP_LINE_LIGHT_LAMBERT}}},
        {.style = {.ink = DP_INK_QUADS, .line_light = {.lighting = DP_LINE_LIGHT_TOON}}},
        {.grouped = true},
    };
    const chain c = {.wrapper = {OWN, ARRANGE}, .depth = 2};
    (void)state;
    for (size_t k = 0; k < sizeof looks / sizeof *looks; k++) fail_everywhere(&c, &looks[k]);
}

/* ------- the smallest of batches ------- */

static void polygons_without_vertices_are_dropped(void **state) {
    (void)state;
    const uint32_t corners[3] = {0, 1, 2};
    const float nowhere[3] = {0};
    const dp_batch batch = {
        .positions = nowhere, .indices = corners, .corner_count = 3, .polygon_count = 1};
    const dp_deform own = {.vertices = lean, .normals = true};
    dp_source *inner, *source;
    dp_extent extent;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &inner, NULL), DP_OK);
    assert_int_equal(dp_source_deform(inner, &own, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_int_equal(extent.bad_index, 1);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(time_leads_to_the_start),
        cmocka_unit_test(failures_are_passed_on),
        cmocka_unit_test(memory_may_run_out_anywhere),
        cmocka_unit_test(memory_may_run_out_in_every_look),
        cmocka_unit_test(polygons_without_vertices_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
