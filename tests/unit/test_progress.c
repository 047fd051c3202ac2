/* Progress: in every mode it never falls and ends at exactly 1; after a cancel it is not called
 * again, and the next drawing is undisturbed. */
#include "base/hostile.h"
#include "draw/context.h"
#include "temporary.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Tiles in an odd number above 64, so that parts of loops do not come out even. */
enum { WIDTH = DP_TUNED(700, 175), HEIGHT = DP_TUNED(560, 140), PIXELS = WIDTH * HEIGHT };

static uint8_t rgba[4 * PIXELS], expected[4 * PIXELS], edge_map[4 * PIXELS];
static float eye_normal[3 * PIXELS];

typedef struct told {
    double last;     /* -1: not known */
    double known;    /* the last one that was */
    int calls, rest; /* rest: calls where it stood still */
    int stop_at;     /* 0: never */
    bool fell, outside;
} told;

static int listen(void *user, double fraction) {
    told *const t = user;
    t->fell |= fraction >= 0 && fraction < t->known;
    if (fraction >= 0) t->known = fraction;
    t->outside |= fraction > 1 || fraction != fraction;
    t->rest += fraction >= 0 && fraction == t->last;
    t->last = fraction < 0 ? -1 : fraction;
    return ++t->calls == t->stop_at;
}

/* How a test draws. */
typedef struct mode {
    const char *name, *shape;
    dp_style style;
    uint32_t triangles;
    size_t limit; /* bytes before it is streamed; 0: many */
    bool planes;  /* asks for edge map and normals as well */
    bool file;    /* a binary STL, whose length is known and which is read by several threads */
} mode;

static char path[256];

static dp_source *as_file(dp_source *shape) {
    dp_source *source = NULL;
    assert_int_equal(dp_io_write_mesh(path, DP_MESH_FILE_STL, shape, NULL, NULL, NULL), DP_OK);
    dp_source_destroy(shape);
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    return source;
}

/* A source that does not say how long it is. */
static dp_result next_of(void *user, dp_batch *batch, dp_diag *diag) {
    return dp_source_next(user, batch, diag);
}
static dp_result rewind_of(void *user, dp_diag *diag) { return dp_source_rewind(user, diag); }
static void destroy_of(void *user) { dp_source_destroy(user); }

static dp_source *new_source(const mode *m, dp_camera *camera) {
    dp_source *shape = NULL, *source = NULL;
    dp_extent extent;
    const dp_shape desc = {.name = m->shape ? m->shape : "gear",
                           .triangles = m->triangles ? m->triangles : 2000};
    assert_int_equal(dp_source_from_shape(&desc, &shape, NULL), DP_OK);
    assert_int_equal(dp_source_extent(shape, &extent, NULL), DP_OK);
    dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(camera, &fit), DP_OK);
    if (m->file) return as_file(shape);
    const dp_source_callbacks callbacks = {
        .user = shape, .next = next_of, .rewind = rewind_of, .destroy = destroy_of};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_result draw(dp_context *context, dp_source *source, const dp_camera *camera,
                      const mode *m) {
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .samples = 1,
                              .rgba = rgba,
                              .edge_map = m->planes ? edge_map : NULL,
                              .eye_normal = m->planes ? eye_normal : NULL};
    memset(rgba, 0, sizeof rgba);
    return dp_draw(context, source, camera, &m->style, &target, NULL);
}

static void expect_forward(const mode *m, const told *t) {
    if (t->fell) fail_msg("%s: progress falls", m->name);
    if (t->outside) fail_msg("%s: progress is outside of 0 to 1", m->name);
    if (t->last != 1) fail_msg("%s: progress ends at %.17g", m->name, t->last);
    if (t->rest) fail_msg("%s: progress stands still %d times", m->name, t->rest);
    if (t->calls < 5) fail_msg("%s: progress is told %d times only", m->name, t->calls);
}

/* Draws through, then stops at some of the calls, and draws through again. */
static void check(const mode *m) {
    told t = {.last = -1};
    const dp_context_desc desc = {.threads = 2, .progress = listen, .user = &t};
    dp_context *context = NULL;
    dp_camera camera;
    dp_source *const source = new_source(m, &camera);
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    if (m->limit) context->limit = m->limit;
    assert_int_equal(draw(context, source, &camera, m), DP_OK);
    expect_forward(m, &t);
    memcpy(expected, rgba, sizeof rgba);
    const int calls = t.calls;
    for (int stop = 1; stop <= calls; stop += 1 + calls / 5) {
        t = (told){.last = -1, .stop_at = stop};
        if (draw(context, source, &camera, m) != DP_ERR_CANCELLED)
            fail_msg("%s: was not stopped at call %d", m->name, stop);
        assert_int_equal(t.calls, stop);
        assert_false(t.fell);
    }
    t = (told){.last = -1};
    assert_int_equal(draw(context, source, &camera, m), DP_OK);
    expect_forward(m, &t);
    assert_int_equal(t.calls, calls);
    assert_memory_equal(rgba, expected, sizeof rgba);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

static const dp_mirror floor_mirror = {.normal = {0, 1, 0}, .offset = -1, .size = 4, .fade = 2};

static void lines_and_quads(void **state) {
    (void)state;
    check(&(mode){.name = "strokes", .style = {0}});
    check(&(mode){.name = "quads", .style = {.ink = DP_INK_QUADS}});
    check(
        &(mode){.name = "stencil", .style = {.ink = DP_INK_QUADS, .between = DP_BETWEEN_STENCIL}});
    check(&(mode){.name = "adjacency", .style = {.edges = DP_EDGES_ADJACENCY}});
    check(&(mode){.name = "adjacency, quads",
                  .style = {.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS}});
    check(
        &(mode){.name = "stylized", .style = {.stroke = {.jitter = 1, .taper = 20, .repeats = 3}}});
    check(&(mode){.name = "no lines", .style = {.lines = DP_NO_LINES}});
}

static void every_shading(void **state) {
    (void)state;
    for (int k = 0; k < DP_SHADING_COUNT; k++) {
        const char *const name = dp_shading_name((dp_shading)k);
        check(&(mode){.name = name, .style = {.shade = {.shading = (dp_shading)k}}});
        check(&(mode){.name = name,
                      .style = {.shade = {.shading = (dp_shading)k, .object_space = true}}});
        check(&(mode){.name = name,
                      .style = {.shade = {.shading = (dp_shading)k},
                                .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL, .eight_bits = true}},
                      .planes = true});
    }
}

static void edge_maps(void **state) {
    (void)state;
    check(&(mode){.name = "diagonal", .style = {.edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}}});
    check(
        &(mode){.name = "C1", .style = {.edge_map = {.detector = DP_EDGE_MAP_C1}}, .planes = true});
    check(&(mode){.name = "hidden",
                  .style = {.edge_map = {.detector = DP_EDGE_MAP_C1, .hidden = true}},
                  .planes = true});
    check(&(mode){.name = "8 bits",
                  .style = {.edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                                         .eight_bits = true,
                                         .as_printed = true}}});
    check(&(mode){.name = "planes", .style = {0}, .planes = true});
}

static void mirrors(void **state) {
    (void)state;
    check(&(mode){.name = "mirror", .style = {.mirror = floor_mirror}});
    check(&(mode){.name = "mirror, quads", .style = {.mirror = floor_mirror, .ink = DP_INK_QUADS}});
    check(&(mode){.name = "mirror, toon",
                  .style = {.mirror = floor_mirror, .shade = {.shading = DP_SHADING_TOON}}});
    check(&(mode){.name = "mirror, edge map",
                  .style = {.mirror = floor_mirror, .edge_map = {.detector = DP_EDGE_MAP_C1}},
                  .planes = true});
}

static void streamed(void **state) {
    (void)state;
    const uint32_t many = DP_TUNED(60000, 3000);
    for (int k = 0; k < 4; k++) {
        const int passes = k % 2;
        const bool file = k / 2;
        check(&(mode){.name = "streamed",
                      .shape = "torus",
                      .style = {.passes = passes},
                      .triangles = many,
                      .limit = 1,
                      .file = file});
        check(&(mode){.name = "streamed, no lines",
                      .shape = "terrain",
                      .style = {.passes = passes, .lines = DP_NO_LINES},
                      .triangles = many,
                      .limit = 1,
                      .file = file});
    }
}

/* Many batches, all of one triangle again and again. */
enum { BATCH = DP_TUNED(5000, 50), BATCHES = 100 };
typedef struct long_source {
    float at[9 * BATCH];
    int given;
} long_source;

static dp_result next_long(void *user, dp_batch *batch, dp_diag *diag) {
    long_source *const s = user;
    (void)diag;
    if (s->given < BATCHES)
        *batch = (dp_batch){.positions = s->at,
                            .vertex_count = 3 * BATCH,
                            .corner_count = 3 * BATCH,
                            .polygon_count = BATCH};
    s->given++;
    return DP_OK;
}
static dp_result rewind_long(void *user, dp_diag *diag) {
    (void)diag;
    ((long_source *)user)->given = 0;
    return DP_OK;
}

/* Reading is stopped, too, and nothing is drawn then. */
static void reading_tells_progress(void **state) {
    static long_source self;
    static const float triangle[9] = {0, 0, 0, 1e-3f, 0, 0, 0, 1e-3f, 0}; /* covers little */
    const dp_source_callbacks callbacks = {.user = &self, .next = next_long, .rewind = rewind_long};
    told t = {.last = -1};
    const dp_context_desc desc = {.threads = 1, .progress = listen, .user = &t};
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    (void)state;
    for (int i = 0; i < 9 * BATCH; i++) self.at[i] = triangle[i % 9];
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    assert_int_equal(dp_camera_fit(&camera, &(dp_fit){.max = {1, 1, 0}}), DP_OK);
    const mode m = {.name = "many batches"};
    assert_int_equal(draw(context, source, &camera, &m), DP_OK);
    expect_forward(&m, &t);
    for (int stop = 1; stop <= 2; stop++) {
        t = (told){.last = -1, .stop_at = stop};
        assert_int_equal(draw(context, source, &camera, &m), DP_ERR_CANCELLED);
        assert_true(self.given < BATCHES / 2);
        for (size_t i = 0; i < sizeof rgba; i++) assert_int_equal(rgba[i], 0);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* Of a target only pixels are written, also when the drawing is stopped. */
static void between_rows_nothing_is_written(void **state) {
    enum { W = 130, H = 70, STRIDE = 4 * W + 9 };
    static uint8_t padded[STRIDE * H];
    const dp_target target = {.width = W, .height = H, .rgba = padded, .rgba_stride = STRIDE};
    told t = {.last = -1};
    const dp_context_desc desc = {.threads = 2, .progress = listen, .user = &t};
    dp_context *context = NULL;
    dp_camera camera;
    const mode m = {.name = "padded"};
    dp_source *const source = new_source(&m, &camera);
    (void)state;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    for (int stop = 1;; stop++) {
        t = (told){.last = -1, .stop_at = stop};
        memset(padded, 0xa5, sizeof padded);
        const dp_result result = dp_draw(context, source, &camera, &m.style, &target, NULL);
        for (size_t i = 0; i < sizeof padded; i++)
            if (i % STRIDE >= (size_t)4 * W) assert_int_equal(padded[i], 0xa5);
        if (!result) break;
        assert_int_equal(result, DP_ERR_CANCELLED);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_tells_progress),
        cmocka_unit_test(between_rows_nothing_is_written),
        cmocka_unit_test(lines_and_quads),
        cmocka_unit_test(every_shading),
        cmocka_unit_test(edge_maps),
        cmocka_unit_test(mirrors),
        cmocka_unit_test(streamed),
    };
    temporary_name(path, sizeof path, "progress");
    const int file = mkstemp(path);
    if (file < 0 || close(file)) return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
