/* All memory of a drawing is the application's: while dp_draw runs, in any mode, nothing calls
 * malloc, the C library included. This program's own malloc counts; the application's allocator
 * does not use it. Skipped where a sanitizer has replaced malloc. */
#include "base/sort.h"
#include "draw/context.h"

#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define COUNTS 1
#else
#define COUNTS 0
#endif

/* ------- a malloc that counts ------- */

#if COUNTS
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void __libc_free(void *block);
#else
#define __libc_malloc  malloc
#define __libc_realloc realloc
#define __libc_free    free
#endif

static atomic_bool drawing;
static atomic_size_t strays, stray_bytes;

#if COUNTS
static void note(size_t size) {
    if (!atomic_load(&drawing)) return;
    atomic_fetch_add(&strays, 1);
    atomic_fetch_add(&stray_bytes, size);
}

void *malloc(size_t size) {
    note(size);
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    note(count * size);
    return __libc_calloc(count, size);
}

void *realloc(void *block, size_t size) {
    note(size);
    return __libc_realloc(block, size);
}

void free(void *block) { __libc_free(block); }
#endif

/* The application's. */
static void *own_alloc(size_t size, void *user) {
    (void)user;
    return __libc_malloc(size);
}
static void *own_realloc(void *block, size_t size, void *user) {
    (void)user;
    return __libc_realloc(block, size);
}
static void own_free(void *block, void *user) {
    (void)user;
    __libc_free(block);
}
static const dp_allocator own = {own_alloc, own_realloc, own_free, NULL};

static void begin_counting(void) {
    atomic_store(&strays, 0);
    atomic_store(&stray_bytes, 0);
    atomic_store(&drawing, true);
}

static void end_counting(const char *what) {
    atomic_store(&drawing, false);
    if (atomic_load(&strays))
        fail_msg("%s: %zu bytes in %zu pieces past the application's allocator", what,
                 atomic_load(&stray_bytes), atomic_load(&strays));
}

/* ------- drawings ------- */

enum { WIDTH = 200, HEIGHT = 150, PIXELS = WIDTH * HEIGHT, TRIANGLES = 1500 };

static uint8_t rgba[4 * PIXELS], edge_map[4 * PIXELS], line_class[PIXELS];
static float depth[PIXELS], normal[3 * PIXELS], eye_normal[3 * PIXELS], distance[PIXELS];
static uint16_t id[PIXELS];

static const dp_target target = {.width = WIDTH,
                                 .height = HEIGHT,
                                 .rgba = rgba,
                                 .depth = depth,
                                 .line_class = line_class,
                                 .normal = normal,
                                 .eye_normal = eye_normal,
                                 .distance = distance,
                                 .id = id,
                                 .edge_map = edge_map};
static const dp_target plain_target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};

static dp_context *new_context(uint32_t threads) {
    dp_context *context = NULL;
    const dp_context_desc desc = {.allocator = &own, .threads = threads};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

static dp_source *new_shape(const char *name, dp_camera *camera) {
    dp_source *source = NULL;
    dp_extent extent;
    const dp_shape shape = {.name = name, .triangles = TRIANGLES, .allocator = &own};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    dp_fit fit = {0};
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(camera, &fit), DP_OK);
    return source;
}

/* Two frames, of one thread and of three: the first makes what later ones keep. */
static void draw_within(const char *what, const char *shape, const dp_style *style,
                        const dp_target *to, size_t limit) {
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        dp_camera camera;
        dp_diag diag = {0};
        dp_source *const source = new_shape(shape, &camera);
        dp_context *const context = new_context(threads);
        if (limit) context->limit = limit;
        for (int frame = 0; frame < 2; frame++) {
            begin_counting();
            const dp_result result = dp_draw(context, source, &camera, style, to, &diag);
            end_counting(what);
            if (result) fail_msg("%s: %s", what, diag.message);
        }
        dp_context_destroy(context);
        dp_source_destroy(source);
    }
}

static void draw(const char *what, const dp_style *style) {
    draw_within(what, "gear", style, &target, 0);
    draw_within(what, "terrain", style, &plain_target, 0);
}

static void lines_and_quads(void **state) {
    (void)state;
    if (!COUNTS) skip();
    draw("strokes", NULL);
    draw("without the edge table", &(dp_style){.edge_table_off = true});
    for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++)
        for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++)
            draw("quads", &(dp_style){.ink = DP_INK_QUADS,
                                      .between = (dp_between)between,
                                      .method = (dp_method)method});
}

static void every_look(void **state) {
    (void)state;
    if (!COUNTS) skip();
    for (uint32_t k = 0; k < dp_texture_count(); k++)
        for (int edges = DP_EDGES_EMERGENT; edges <= DP_EDGES_ADJACENCY; edges++)
            for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++) {
                dp_texture *texture = NULL;
                dp_style style = {.edges = (dp_edges)edges, .ink = (dp_ink)ink};
                assert_int_equal(dp_texture_named(dp_texture_name(k), 0, &own, &texture, NULL),
                                 DP_OK);
                assert_int_equal(dp_stroke_look(dp_texture_name(k), &style.stroke, NULL), DP_OK);
                style.stroke.texture = texture;
                draw(dp_texture_name(k), &style);
                style.stroke.u = DP_STROKE_POLAR;
                style.stroke.repeats = 2;
                draw(dp_texture_name(k), &style);
                dp_texture_destroy(texture);
            }
}

static void every_pattern(void **state) {
    (void)state;
    if (!COUNTS) skip();
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("rope", 0, &own, &texture, NULL), DP_OK);
    for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++)
        for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++)
            draw("patterns", &(dp_style){.ink = (dp_ink)ink,
                                         .between = (dp_between)between,
                                         .pattern = {.texture = texture},
                                         .line_light = {.lighting = DP_LINE_LIGHT_TOON}});
    dp_texture_destroy(texture);
}

static void every_shading(void **state) {
    (void)state;
    if (!COUNTS) skip();
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++)
        for (int normals = DP_NORMALS_MODEL; normals <= DP_NORMALS_FACET; normals++)
            draw(dp_shading_name((dp_shading)shading),
                 &(dp_style){.shade = {.shading = (dp_shading)shading,
                                       .normals = (dp_normals)normals,
                                       .object_space = normals == DP_NORMALS_SMOOTH}});
    draw("tones", &(dp_style){.shade = {.shading = DP_SHADING_PENCIL, .pencil_tones = 4}});
}

static void adjacency_edge_maps_and_a_mirror(void **state) {
    (void)state;
    if (!COUNTS) skip();
    const dp_mirror mirror = {.normal = {0, 1, 0}, .offset = -1.1f, .size = 4, .fade = 2};
    draw("adjacency", &(dp_style){.edges = DP_EDGES_ADJACENCY});
    draw("adjacency, quads", &(dp_style){.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS});
    draw("edge map", &(dp_style){.edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}});
    draw("edge map", &(dp_style){.edge_map = {.detector = DP_EDGE_MAP_C1, .eight_bits = true}});
    draw("mirror", &(dp_style){.mirror = mirror});
    draw("mirror, quads", &(dp_style){.mirror = mirror, .ink = DP_INK_QUADS});
}

static void streamed(void **state) {
    (void)state;
    if (!COUNTS) skip();
    static const char *const shapes[] = {"gear", "terrain", "boxes"};
    for (int passes = 0; passes < 2; passes++)
        for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
            draw_within("streamed", shapes[k], &(dp_style){.passes = passes}, &plain_target, 1);
}

/* A vertex where very many triangles meet, edges of more than two. */
static void a_star_and_a_book(void **state) {
    enum { RAYS = 3000, PAGES = 200, POLYGONS = RAYS + PAGES };
    static float positions[3 * POLYGONS][3];
    (void)state;
    if (!COUNTS) skip();
    for (int i = 0; i < POLYGONS; i++) {
        float(*const p)[3] = positions + (ptrdiff_t)3 * i;
        const float x = (float)(i % 60) / 60 - 0.5f, y = (float)(i / 60 % 60) / 60 - 0.5f;
        p[1][0] = x, p[1][1] = y, p[2][0] = x + 0.01f, p[2][1] = y;
        if (i >= RAYS) p[1][0] = p[1][1] = 0, p[1][2] = 0.7f;
    }
    const dp_batch batch = {.positions = positions[0],
                            .vertex_count = (size_t)3 * POLYGONS,
                            .corner_count = (size_t)3 * POLYGONS,
                            .polygon_count = POLYGONS};
    static uint32_t six[6 * POLYGONS];
    begin_counting();
    const dp_result result = dp_adjacency_indices(&batch, &own, six, NULL);
    end_counting("a star");
    assert_int_equal(result, DP_OK);
}

static void immediate_mode(void **state) {
    (void)state;
    if (!COUNTS) skip();
    dp_camera camera;
    dp_source_destroy(new_shape("gear", &camera));
    dp_context *const context = new_context(2);
    begin_counting();
    dp_set_camera(context, &camera);
    dp_enable(context, DP_ALL_LINES);
    for (int k = 0; k < 300; k++) {
        dp_line_width(context, DP_RIDGE, 1 + (float)(k % 7));
        dp_begin(context, DP_TRIANGLE_STRIP);
        for (int i = 0; i < 30; i++)
            dp_vertex3f(context, (float)i / 15 - 1, (float)(k + i % 2) / 150 - 1,
                        (float)(i * k % 13) / 50);
        dp_end(context);
    }
    const dp_result result = dp_finish(context, &plain_target, NULL);
    end_counting("immediate mode");
    assert_int_equal(result, DP_OK);
    dp_context_destroy(context);
}

/* The counting itself: qsort takes from malloc what dp_sort does not. */
static int by_value(const void *left, const void *right) {
    const uint32_t l = *(const uint32_t *)left, r = *(const uint32_t *)right;
    return (l > r) - (l < r);
}

static void the_count_sees_a_malloc(void **state) {
    enum { COUNT = 5000 };
    static uint32_t values[COUNT];
    (void)state;
    if (!COUNTS) skip();
    for (uint32_t i = 0; i < COUNT; i++) values[i] = i * 2654435761u;
    begin_counting();
    dp_sort(values, COUNT, sizeof *values, by_value);
    end_counting("dp_sort");
    begin_counting();
    void *volatile const block = malloc(100);
    atomic_store(&drawing, false);
    free(block);
    assert_int_equal(atomic_load(&strays), 1);
    assert_int_equal(atomic_load(&stray_bytes), 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_count_sees_a_malloc),
        cmocka_unit_test(lines_and_quads),
        cmocka_unit_test(every_look),
        cmocka_unit_test(every_pattern),
        cmocka_unit_test(every_shading),
        cmocka_unit_test(adjacency_edge_maps_and_a_mirror),
        cmocka_unit_test(streamed),
        cmocka_unit_test(a_star_and_a_book),
        cmocka_unit_test(immediate_mode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
