/* dp_stats.bytes is what the allocator has given to the context and not got back, to the byte:
 * after every kind of picture, with any number of threads, in later frames, and whatever a drawing
 * ended with. While one is drawn, what streaming takes counts too. */
#include "draw/context.h"

#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 200, HEIGHT = 150, PIXELS = WIDTH * HEIGHT, TRIANGLES = 800 };

/* ------- an allocator that counts bytes ------- */

typedef struct meter {
    atomic_size_t held;
    atomic_long calls, fail_at; /* of those that ask for memory; 0: none fails */
} meter;

typedef union block {
    size_t size;
    max_align_t unused;
} block;

static void *meter_realloc(void *at, size_t size, void *user) {
    meter *const m = user;
    block *const old = at ? (block *)at - 1 : NULL;
    const size_t had = old ? old->size : 0;
    if (atomic_fetch_add(&m->calls, 1) + 1 == atomic_load(&m->fail_at)) return NULL;
    block *const made = realloc(old, sizeof *made + size);
    if (!made) return NULL;
    made->size = size;
    atomic_fetch_add(&m->held, size - had);
    return made + 1;
}

static void *meter_alloc(size_t size, void *user) { return meter_realloc(NULL, size, user); }

static void meter_free(void *at, void *user) {
    meter *const m = user;
    if (!at) return;
    atomic_fetch_sub(&m->held, ((block *)at - 1)->size);
    free((block *)at - 1);
}

/* ------- contexts and pictures ------- */

static uint8_t rgba[4 * PIXELS], edge_map[4 * PIXELS], line_class[PIXELS];
static float depth[PIXELS], normal[3 * PIXELS], eye_normal[3 * PIXELS], distance[PIXELS];
static uint16_t id[PIXELS];

static const dp_target every_plane = {.width = WIDTH,
                                      .height = HEIGHT,
                                      .rgba = rgba,
                                      .depth = depth,
                                      .line_class = line_class,
                                      .normal = normal,
                                      .eye_normal = eye_normal,
                                      .distance = distance,
                                      .id = id,
                                      .edge_map = edge_map};
static const dp_target colours = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};

typedef struct bench {
    meter memory;
    dp_allocator allocator;
    dp_context *context;
    const char *what;
    long tells, stop_at; /* progress: calls so far; the one that stops the drawing, 0: none */
    bool is_alone;       /* nothing but the context takes memory while it draws */
    bool streams;        /* it was seen to */
} bench;

static void check_now(const bench *b) {
    const size_t held = atomic_load(&b->memory.held);
    const uint64_t told = dp_context_bytes(b->context);
    if (told != held)
        fail_msg("%s: while it draws %zu bytes are held, %llu are told", b->what, held,
                 (unsigned long long)told);
}

static int progress(void *user, double fraction) {
    bench *const b = user;
    (void)fraction;
    if (b->context->stream) b->streams = true;
    if (b->is_alone) check_now(b);
    return ++b->tells == b->stop_at;
}

static void check(const bench *b, const char *when) {
    dp_stats stats;
    const size_t held = atomic_load(&b->memory.held);
    dp_stats_of(b->context, &stats);
    if (stats.bytes != held)
        fail_msg("%s, %s: %zu bytes are held, %llu are told", b->what, when, held,
                 (unsigned long long)stats.bytes);
    assert_true(stats.bytes > stats.adjacency_bytes);
}

static void begin(bench *b, const char *what, uint32_t threads) {
    *b = (bench){.what = what, .is_alone = true};
    b->allocator = (dp_allocator){meter_alloc, meter_realloc, meter_free, &b->memory};
    const dp_context_desc desc = {
        .allocator = &b->allocator, .threads = threads, .progress = progress, .user = b};
    assert_int_equal(dp_context_create(&desc, &b->context, NULL), DP_OK);
}

static void end(bench *b) {
    dp_context_destroy(b->context);
    assert_int_equal(atomic_load(&b->memory.held), 0);
}

/* Its memory is not the context's. */
static dp_source *new_shape(const char *name, dp_camera *camera) {
    dp_source *source = NULL;
    dp_extent extent;
    const dp_shape shape = {.name = name, .triangles = TRIANGLES};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    dp_fit fit = {0};
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(camera, &fit), DP_OK);
    return source;
}

/* Two frames, of a context that then draws another picture. `limit`: bytes beyond which a source is
 * streamed; 0: the default. */
static void draw_source(const char *what, dp_source *source, const dp_camera *camera,
                        const dp_style *style, const dp_target *to, size_t limit) {
    static const uint32_t threads[] = {1, 3};
    static const char *const when[] = {"first frame", "second frame", "another picture"};
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
        bench b;
        dp_diag diag = {0};
        begin(&b, what, threads[k]);
        if (limit) b.context->limit = limit;
        for (int frame = 0; frame < 3; frame++) {
            const dp_style *const now = frame == 2 ? NULL : style;
            b.is_alone = true;
            const dp_result result = dp_draw(b.context, source, camera, now, to, &diag);
            if (result) fail_msg("%s: %s", what, diag.message);
            check(&b, when[frame]);
        }
        assert_true(b.tells > 0);
        if (b.streams != (limit > 0)) fail_msg("%s: is it streamed? %d", what, b.streams);
        end(&b);
    }
}

static void draw_with(const char *what, const char *shape, const dp_style *style,
                      const dp_target *to, size_t limit) {
    dp_camera camera;
    dp_source *const source = new_shape(shape, &camera);
    draw_source(what, source, &camera, style, to, limit);
    dp_source_destroy(source);
}

static void draw(const char *what, const dp_style *style) {
    draw_with(what, "gear", style, &every_plane, 0);
    draw_with(what, "terrain", style, &colours, 0);
}

static void lines_and_quads(void **state) {
    (void)state;
    draw("strokes", NULL);
    draw("no lines", &(dp_style){.lines = DP_NO_LINES});
    draw("cleaned", &(dp_style){.detail = 1});
    draw("cleaned, finely", &(dp_style){.detail = 100, .hidden = {.look = DP_HIDDEN_DASHED}});
    draw("without the edge table", &(dp_style){.edge_table_off = true});
    for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++)
        for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++)
            draw("quads", &(dp_style){.ink = DP_INK_QUADS,
                                      .between = (dp_between)between,
                                      .method = (dp_method)method});
}

static void stylized_strokes(void **state) {
    (void)state;
    for (int edges = DP_EDGES_EMERGENT; edges <= DP_EDGES_ADJACENCY; edges++)
        for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++)
            for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
                dp_texture *texture = NULL;
                dp_style style = {
                    .edges = (dp_edges)edges, .ink = (dp_ink)ink, .method = (dp_method)method};
                assert_int_equal(dp_texture_named("charcoal", 0, NULL, &texture, NULL), DP_OK);
                assert_int_equal(dp_stroke_look("pencil", &style.stroke, NULL), DP_OK);
                draw("jitter and taper", &style);
                style.stroke.texture = texture;
                draw("texture", &style);
                style.stroke.u = DP_STROKE_POLAR;
                style.stroke.repeats = 2;
                draw("polar texture", &style);
                dp_texture_destroy(texture);
            }
    draw("lines thin out in the light", &(dp_style){.stroke = {.light = 0.5f}});
}

static void every_shading(void **state) {
    (void)state;
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++)
        for (int normals = DP_NORMALS_MODEL; normals <= DP_NORMALS_FACET; normals++)
            draw(dp_shading_name((dp_shading)shading),
                 &(dp_style){.shade = {.shading = (dp_shading)shading,
                                       .normals = (dp_normals)normals,
                                       .object_space = normals == DP_NORMALS_SMOOTH}});
    draw("tones", &(dp_style){.shade = {.shading = DP_SHADING_PENCIL, .pencil_tones = 4}});
    draw("hatched quads", &(dp_style){.ink = DP_INK_QUADS, .shade = {.shading = DP_SHADING_HATCH}});
}

static void adjacency_edge_maps_and_a_mirror(void **state) {
    (void)state;
    const dp_mirror mirror = {.normal = {0, 1, 0}, .offset = -1.1f, .size = 4, .fade = 2};
    const dp_edge_map diagonal = {.detector = DP_EDGE_MAP_DIAGONAL};
    draw("adjacency", &(dp_style){.edges = DP_EDGES_ADJACENCY});
    draw("adjacency, quads", &(dp_style){.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS});
    draw("adjacency, as printed",
         &(dp_style){.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS, .method = DP_METHOD_PAPER});
    draw("edge map", &(dp_style){.edge_map = diagonal});
    draw("edge map, C1", &(dp_style){.edge_map = {.detector = DP_EDGE_MAP_C1, .eight_bits = true}});
    draw("edge map, Gooch",
         &(dp_style){.edge_map = diagonal, .shade = {.shading = DP_SHADING_GOOCH}});
    draw("mirror", &(dp_style){.mirror = mirror});
    draw("mirror, quads", &(dp_style){.mirror = mirror, .ink = DP_INK_QUADS});
    draw("mirror, Gooch", &(dp_style){.mirror = mirror, .shade = {.shading = DP_SHADING_GOOCH}});
}

/* Samples in number, and a picture that grows and shrinks again. */
static void other_pictures(void **state) {
    static const uint32_t samples[] = {1, 8, 16};
    (void)state;
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        dp_target to = colours;
        to.samples = samples[i];
        draw_with("samples", "gear", NULL, &to, 0);
    }
    bench b;
    dp_camera camera;
    dp_source *const source = new_shape("gear", &camera);
    begin(&b, "sizes", 2);
    for (uint32_t side = 20; side <= HEIGHT; side += 65)
        for (int shading = 0; shading < DP_SHADING_COUNT; shading++) {
            const uint32_t size = shading % 2 ? side : HEIGHT + 20 - side;
            const dp_target to = {.width = size, .height = size, .rgba = rgba};
            const dp_style style = {.shade = {.shading = (dp_shading)shading}};
            assert_int_equal(dp_draw(b.context, source, &camera, &style, &to, NULL), DP_OK);
            check(&b, dp_shading_name((dp_shading)shading));
        }
    end(&b);
    dp_source_destroy(source);
}

/* Polygons that are not the source's own arrays: several batches, concave ones, attributes. */
static void gathered(void **state) {
    static const char obj[] = "v -1 -1 0\nv 1 -1 0\nv 0 0 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\n"
                              "vn 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                              "g one\nf 1/1/1 2/2/1 3/3/1 4/2/1 5/1/1\n"
                              "g two\nf 1 2 6\nf 4 5 6\nf 1//1 6//1 5//1\n";
    const dp_memory_file file = {.data = obj, .size = sizeof obj - 1, .name = "a.obj"};
    const float min[3] = {-1, -1, 0}, max[3] = {1, 1, 1};
    dp_fit fit = {0};
    dp_camera camera;
    (void)state;
    memcpy(fit.min, min, sizeof min), memcpy(fit.max, max, sizeof max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++) {
        bench b;
        dp_source *source = NULL;
        const dp_style style = {.shade = {.shading = (dp_shading)shading, .object_space = true}};
        assert_int_equal(dp_source_open_memory(&file, NULL, &source, NULL), DP_OK);
        begin(&b, "gathered", 2);
        for (int frame = 0; frame < 2; frame++) {
            assert_int_equal(dp_draw(b.context, source, &camera, &style, &colours, NULL), DP_OK);
            check(&b, dp_shading_name((dp_shading)shading));
        }
        end(&b);
        dp_source_destroy(source);
    }
}

/* A binary STL of triangles that cross each other: records, which are read by their numbers. */
static void streamed_records(const dp_camera *camera) {
    enum { COUNT = 3000, HEAD = 84, RECORD = 50 };
    static uint8_t stl[HEAD + RECORD * COUNT];
    const uint32_t count = COUNT;
    const dp_memory_file file = {.data = stl, .size = sizeof stl};
    memcpy(stl + 80, &count, sizeof count); /* on a little-endian machine */
    for (uint32_t i = 0; i < COUNT; i++) {
        const float x = (float)(i % 50) / 25 - 1, y = (float)(i / 50) / 30 - 1,
                    z = (float)(i * 7 % 11) / 30;
        const float corners[9] = {x, y, z, x + 0.1f, y, 0.3f - z, x, y + 0.1f, z / 2};
        memcpy(stl + HEAD + RECORD * i + 12, corners, sizeof corners);
    }
    for (int passes = 0; passes < 2; passes++) {
        dp_source *source = NULL;
        assert_int_equal(dp_source_open_memory(&file, NULL, &source, NULL), DP_OK);
        draw_source("streamed STL", source, camera, &(dp_style){.passes = passes}, &colours, 1);
        dp_source_destroy(source);
    }
}

/* `progress` counts the stream's own memory between its parts. */
static void streamed(void **state) {
    dp_camera camera;
    static const char *const shapes[] = {"gear", "terrain", "boxes"};
    (void)state;
    for (int passes = 0; passes < 2; passes++)
        for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
            draw_with("streamed", shapes[k], &(dp_style){.passes = passes}, &colours, 1);
    const dp_target planes = {.width = WIDTH,
                              .height = HEIGHT,
                              .rgba = rgba,
                              .depth = depth,
                              .line_class = line_class,
                              .normal = normal};
    draw_with("streamed, stylized", "gear", &(dp_style){.stroke = {.taper = 8}}, &planes, 1);
    dp_source_destroy(new_shape("terrain", &camera));
    streamed_records(&camera);
}

static void immediate_mode(void **state) {
    bench b;
    dp_camera camera;
    (void)state;
    dp_source_destroy(new_shape("gear", &camera));
    begin(&b, "immediate mode", 2);
    for (int frame = 0; frame < 3; frame++) {
        b.is_alone = false; /* the arrays' source */
        dp_set_camera(b.context, &camera);
        dp_enable(b.context, DP_ALL_LINES);
        for (int k = 0; k < 40 + 100 * frame; k++) {
            dp_line_width(b.context, DP_RIDGE, 1 + (float)(k % 7)); /* a group each */
            dp_begin(b.context, k % 2 ? DP_TRIANGLE_STRIP : DP_POLYGON);
            for (int i = 0; i < 30; i++)
                dp_vertex3f(b.context, (float)i / 15 - 1, (float)(k + i % 2) / 150 - 1,
                            (float)(i * k % 13) / 50);
            dp_end(b.context);
        }
        assert_int_equal(dp_finish(b.context, frame == 1 ? NULL : &colours, NULL),
                         frame == 1 ? DP_ERR_ARGUMENT : DP_OK);
        check(&b, "dp_finish");
    }
    end(&b);
}

/* A drawing that is stopped at any call of progress. */
static void stopped(const char *what, const dp_style *style, size_t limit) {
    bench b;
    dp_camera camera;
    dp_source *const source = new_shape("boxes", &camera);
    begin(&b, what, 2);
    if (limit) b.context->limit = limit;
    b.is_alone = true;
    dp_result result = DP_ERR_CANCELLED;
    for (long at = 1; result == DP_ERR_CANCELLED; at += at < 4 ? 1 : 5) {
        b.tells = 0, b.stop_at = at;
        result = dp_draw(b.context, source, &camera, style, &colours, NULL);
        check(&b, "stopped");
    }
    assert_int_equal(result, DP_OK);
    end(&b);
    dp_source_destroy(source);
}

/* A drawing whose memory runs out at some allocation. */
static void starved(const char *what, const dp_style *style, size_t limit) {
    dp_result result = DP_ERR_MEMORY;
    for (long at = 1; result == DP_ERR_MEMORY; at += 1 + at / 8) {
        bench b;
        dp_camera camera;
        dp_source *const source = new_shape("boxes", &camera);
        begin(&b, what, 2);
        if (limit) b.context->limit = limit;
        b.is_alone = false;
        atomic_store(&b.memory.calls, 0);
        atomic_store(&b.memory.fail_at, at);
        dp_diag diag = {0};
        result = dp_draw(b.context, source, &camera, style, &colours, &diag);
        check(&b, "out of memory");
        if (result == DP_ERR_MEMORY && !strstr(diag.message, " bytes were asked for in vain"))
            fail_msg("%s: \"%s\"", what, diag.message);
        atomic_store(&b.memory.fail_at, 0);
        assert_int_equal(dp_draw(b.context, source, &camera, style, &colours, NULL), DP_OK);
        check(&b, "there is memory again");
        end(&b);
        dp_source_destroy(source);
    }
    assert_int_equal(result, DP_OK);
}

static void drawings_that_fail(void **state) {
    const dp_mirror mirror = {.normal = {0, 1, 0}, .offset = -1.1f, .size = 4, .fade = 2};
    const struct {
        const char *what;
        dp_style style;
        size_t limit;
    } list[] = {{"strokes", {.passes = 0}, 0},
                {"streamed", {.passes = 0}, 1},
                {"cleaned", {.detail = 1}, 0},
                {"cleaned, streamed", {.detail = 1}, 1},
                {"adjacency", {.edges = DP_EDGES_ADJACENCY}, 0},
                {"pencil", {.shade = {.shading = DP_SHADING_PENCIL}}, 0},
                {"mirror, Gooch", {.mirror = mirror, .shade = {.shading = DP_SHADING_GOOCH}}, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        stopped(list[i].what, &list[i].style, list[i].limit);
        starved(list[i].what, &list[i].style, list[i].limit);
    }
}

/* Refused before anything is drawn, by a new context. */
static void drawings_that_are_refused(void **state) {
    bench b;
    dp_camera camera;
    dp_source *const source = new_shape("cube", &camera);
    const dp_target too_wide = {.width = 40000, .height = 1, .rgba = rgba};
    (void)state;
    begin(&b, "refused", 2);
    assert_int_equal(dp_draw(b.context, source, &camera, &(dp_style){.passes = 9}, &colours, NULL),
                     DP_ERR_ARGUMENT);
    check(&b, "style");
    assert_int_equal(dp_draw(b.context, source, &camera, NULL, &too_wide, NULL), DP_ERR_ARGUMENT);
    check(&b, "target");
    end(&b);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_and_quads),    cmocka_unit_test(stylized_strokes),
        cmocka_unit_test(every_shading),      cmocka_unit_test(adjacency_edge_maps_and_a_mirror),
        cmocka_unit_test(other_pictures),     cmocka_unit_test(gathered),
        cmocka_unit_test(streamed),           cmocka_unit_test(immediate_mode),
        cmocka_unit_test(drawings_that_fail), cmocka_unit_test(drawings_that_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
