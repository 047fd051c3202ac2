/* dp_style.detail with all else: the same bytes for any number of threads, with any kernels and in later
 * frames; with streaming, mirrors, adjacency, stylized strokes, immediate mode and drawings; and what its
 * memory does. */
#include "base/hostile.h"
#include "base/kernels.h"
#include "draw/context.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>

#include <cmocka.h>

#include "rough.h"

enum { WIDTH = 320, HEIGHT = 240, BYTES = 4 * WIDTH * HEIGHT };

static const double oblique[3] = {1, 0.7, 1.4};

static uint8_t first_rgba[BYTES], other_rgba[BYTES];

static dp_context *new_context(uint32_t threads, size_t limit) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context = NULL;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    if (limit) context->limit = limit;
    return context;
}

static found_lines draw(dp_context *context, dp_source *source, const dp_style *style,
                        uint32_t samples, uint8_t *rgba) {
    const dp_camera camera = view_of(source, oblique, samples == 16, (double)WIDTH / HEIGHT);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .samples = samples, .rgba = rgba};
    dp_diag diag = {0};
    if (dp_draw(context, source, &camera, style, &target, &diag)) fail_msg("%s", diag.message);
    return lines_of(context);
}

/* ------- every way to draw ------- */

/* A limit of 1 byte: streamed. */
static const struct {
    const char *name;
    dp_style style;
    uint32_t samples;
    size_t limit;
} ways[] = {
    {"plain", {.detail = 1}, 4, 0},
    {"one sample, fine", {.detail = 4}, 1, 0},
    {"orthographic", {.detail = 1}, 16, 0},
    {"hidden lines", {.detail = 1, .hidden = {.look = DP_HIDDEN_DASHED, .levels = 3}}, 4, 0},
    {"exact ends", {.detail = 0.5f, .exact_ends = true}, 4, 0},
    {"emergent lines", {.detail = 1, .edge_table_off = true}, 4, 0},
    {"adjacency", {.detail = 1, .edges = DP_EDGES_ADJACENCY}, 4, 0},
    {"stylized", {.detail = 1, .stroke = {.taper = 8, .jitter = 1}}, 4, 0},
    {"shaded", {.detail = 1, .shade = {.shading = DP_SHADING_GOOCH}}, 4, 0},
    {"mirror",
     {.detail = 1, .mirror = {.normal = {0, 1, 0}, .offset = -1.1f, .size = 4, .fade = 2}},
     4,
     0},
    {"smooth", {.detail = 1, .smooth = DP_SMOOTH_SURFACE, .smooth_level = 2}, 4, 0},
    {"streamed", {.detail = 1}, 4, 1},
    {"streamed once", {.detail = 1, .passes = 1}, 4, 1},
};
enum { WAYS = sizeof ways / sizeof *ways };

static const struct {
    const char *name;
    uint64_t triangles;
    float noise;
} models[] = {
    {"sphere", 4000, 0.02f}, {"terrain", 6000, 0.004f}, {"gear", 2000, 0}, {"boxes", 0, 0}};
enum { MODELS = sizeof models / sizeof *models };

/* Is a model drawn in a way? All are in all ways, but where that is slow: there each model and each way has its turns. */
static bool has_turn(size_t model, size_t way) {
    enum { EVERY = DP_TUNED(DP_TEST_PATIENCE > 1 ? 2 : 1, 4) };
    return (model + way) % EVERY == 0;
}

static void expect_same(const found_lines *a, found_lines *b, const char *what) {
    expect_same_lines(a, b, what);
    if (memcmp(first_rgba, other_rgba, BYTES)) fail_msg("%s: other pixels", what);
    free_lines(b);
}

static void threads_and_frames(void **state) {
    static const uint32_t counts[] = {1, 2, 7};
    (void)state;
    for (size_t m = 0; m < MODELS; m++) {
        rough_model model = make_rough(models[m].name, models[m].triangles, models[m].noise, false);
        for (size_t w = 0; w < WAYS; w++) {
            found_lines expected = {0};
            if (!has_turn(m, w)) continue;
            for (int t = 0; t < 3; t++) {
                dp_context *const context = new_context(counts[t], ways[w].limit);
                if (t == 0)
                    expected =
                        draw(context, model.source, &ways[w].style, ways[w].samples, first_rgba);
                for (int frame = 0; frame < 2; frame++) {
                    found_lines f =
                        draw(context, model.source, &ways[w].style, ways[w].samples, other_rgba);
                    expect_same(&expected, &f, ways[w].name);
                }
                dp_context_destroy(context);
            }
            free_lines(&expected);
        }
        free_rough(&model);
    }
}

static void every_width_of_vectors(void **state) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    for (size_t m = 0; m < MODELS; m++) {
        rough_model model = make_rough(models[m].name, models[m].triangles, models[m].noise, false);
        for (size_t w = 0; w < WAYS; w++) {
            found_lines expected = {0};
            if (!has_turn(m, w)) continue;
            for (uint32_t i = 0; i < count; i++) {
                dp_context *const context = new_context(2, ways[w].limit);
                assert_int_equal(setenv("DRYPOINT_CPU", list[i].name, 1), 0);
                found_lines f = draw(context, model.source, &ways[w].style, ways[w].samples,
                                     i ? other_rgba : first_rgba);
                if (i)
                    expect_same(&expected, &f, ways[w].name);
                else
                    expected = f;
                dp_context_destroy(context);
            }
            unsetenv("DRYPOINT_CPU");
            free_lines(&expected);
        }
        free_rough(&model);
    }
}

/* ------- each way leaves lines out ------- */

static void every_way_leaves_out_noise(void **state) {
    if (DP_TUNED(false, true)) skip(); /* large, and of whole chains */
    rough_model m = make_rough("sphere", 20000, 0.012f, false);
    (void)state;
    for (size_t w = 0; w < WAYS; w++) {
        dp_style style = ways[w].style;
        dp_context *const context = new_context(2, ways[w].limit);
        style.detail = 1;
        found_lines few = draw(context, m.source, &style, ways[w].samples, first_rgba);
        style.detail = 0;
        found_lines all = draw(context, m.source, &style, ways[w].samples, first_rgba);
        const double left = length_at(&few, DP_RIDGE | DP_VALLEY, 0),
                     rough = length_at(&all, DP_RIDGE | DP_VALLEY, 0);
        if (!(few.count && left < (style.smooth ? 0.5 : 0.15) * rough))
            fail_msg("%s: %.0f px of creases of %.0f", ways[w].name, left, rough);
        free_lines(&few), free_lines(&all);
        dp_context_destroy(context);
    }
    free_rough(&m);
}

/* Added polygons are not segments. */
static void quads_are_as_they_are(void **state) {
    rough_model m = make_rough("sphere", 4000, 0.02f, false);
    dp_context *const context = new_context(2, 0);
    dp_style style = {.ink = DP_INK_QUADS};
    (void)state;
    found_lines a = draw(context, m.source, &style, 4, first_rgba);
    style.detail = 1;
    found_lines b = draw(context, m.source, &style, 4, other_rgba);
    expect_same(&a, &b, "quads");
    free_lines(&a);
    dp_context_destroy(context);
    free_rough(&m);
}

/* A streamed model has the lines that it has in memory. */
static void streamed_is_as_held(void **state) {
    (void)state;
    for (size_t m = 0; m < MODELS; m++) {
        rough_model model = make_rough(models[m].name, models[m].triangles, models[m].noise, false);
        /* intersections are found anew where a model is streamed */
        const dp_style style = {.detail = 1, .lines = DP_SIL_RIDGE_VALLEY | DP_BORDER};
        dp_context *const held = new_context(2, 0), *const streamed = new_context(2, 1);
        found_lines a = draw(held, model.source, &style, 4, first_rgba),
                    b = draw(streamed, model.source, &style, 4, other_rgba);
        const double was = length_at(&a, DP_ALL_LINES, 0), is = length_at(&b, DP_ALL_LINES, 0);
        if (fabs(was - is) > 0.01 * was)
            fail_msg("%s: %.1f px in memory, %.1f streamed", models[m].name, was, is);
        free_lines(&a), free_lines(&b);
        dp_context_destroy(held), dp_context_destroy(streamed);
        free_rough(&model);
    }
}

/* ------- immediate mode: the first style's detail ------- */

static void record(dp_context *context, const rough_model *m) {
    const dp_camera camera = view_of(m->source, oblique, false, (double)WIDTH / HEIGHT);
    dp_set_camera(context, &camera);
    dp_enable(context, DP_ALL_LINES);
    dp_begin(context, DP_TRIANGLES);
    for (size_t v = 0; v < 3 * m->triangles; v++) dp_vertex3fv(context, m->positions + 3 * v);
    dp_end(context);
}

/* A recording is of polygons, so it is compared with triangles that are told as such. */
static dp_source *as_polygons(const rough_model *m, uint32_t **firsts) {
    dp_source *source = NULL;
    *firsts = malloc((m->triangles + 1) * sizeof **firsts);
    assert_non_null(*firsts);
    for (size_t i = 0; i <= m->triangles; i++) (*firsts)[i] = (uint32_t)(3 * i);
    const dp_batch batch = {.positions = m->positions,
                            .vertex_count = 3 * m->triangles,
                            .corner_count = 3 * m->triangles,
                            .firsts = *firsts,
                            .polygon_count = m->triangles};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

static void immediate_mode_is_the_same(void **state) {
    uint32_t *firsts;
    rough_model m = make_rough("sphere", 2000, 0.02f, false);
    dp_source *const polygons = as_polygons(&m, &firsts);
    const dp_style style = {.detail = 1}, exact = {.detail = 0};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .samples = 4, .rgba = other_rgba};
    dp_context *const context = new_context(2, 0);
    (void)state;
    found_lines all = draw(context, polygons, &exact, 4, first_rgba),
                few = draw(context, polygons, &style, 4, first_rgba);
    dp_set_style(context, &style);
    record(context, &m);
    assert_int_equal(dp_finish(context, &target, NULL), DP_OK);
    found_lines told = lines_of(context);
    assert_true(few.count < all.count);
    expect_same(&few, &told, "immediate mode");
    free_lines(&all), free_lines(&few);
    dp_context_destroy(context);
    dp_source_destroy(polygons);
    free(firsts);
    free_rough(&m);
}

/* ------- drawings ------- */

static void drawings_are_made_of_what_is_left(void **state) {
    rough_model m = make_rough("sphere", 20000, 0.012f, false);
    dp_context *const context = new_context(2, 0);
    double length[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        dp_drawing *drawing = NULL;
        dp_drawing_info info;
        found_lines f = draw(context, m.source, &(dp_style){.detail = (float)k}, 4, first_rgba);
        assert_int_equal(dp_drawing_create(context, NULL, &drawing, NULL), DP_OK);
        dp_drawing_info_of(drawing, &info);
        assert_int_equal(info.segments, f.count);
        length[k] = info.length;
        assert_true(info.length <= length_at(&f, DP_ALL_LINES, 0) + info.joined_length + 1);
        dp_drawing_destroy(drawing);
        free_lines(&f);
    }
    assert_true(length[1] < 0.5 * length[0] && length[1] > 100);
    dp_context_destroy(context);
    free_rough(&m);
}

/* ------- memory ------- */

typedef struct meter {
    atomic_long calls, fail_at, live;
} meter;

static bool fails(meter *m) {
    return atomic_fetch_add(&m->calls, 1) + 1 == atomic_load(&m->fail_at);
}

static void *meter_alloc(size_t size, void *user) {
    meter *const m = user;
    void *const made = fails(m) ? NULL : malloc(size);
    if (made) atomic_fetch_add(&m->live, 1);
    return made;
}

static void *meter_realloc(void *at, size_t size, void *user) {
    meter *const m = user;
    void *const made = fails(m) ? NULL : realloc(at, size);
    if (made && !at) atomic_fetch_add(&m->live, 1);
    return made;
}

static void meter_free(void *at, void *user) {
    if (at) atomic_fetch_sub(&((meter *)user)->live, 1);
    free(at);
}

static dp_context *metered_context(meter *m, dp_allocator *allocator, uint32_t threads) {
    *allocator = (dp_allocator){meter_alloc, meter_realloc, meter_free, m};
    const dp_context_desc desc = {.allocator = allocator, .threads = threads};
    dp_context *context = NULL;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

static void every_allocation_may_fail(void **state) {
    rough_model model = make_rough("sphere", 1500, 0.02f, false);
    const dp_camera camera = view_of(model.source, oblique, false, (double)WIDTH / HEIGHT);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = other_rgba};
    const dp_style style = {.detail = 1, .hidden = {.look = DP_HIDDEN_THIN}};
    dp_context *const whole = new_context(1, 0);
    (void)state;
    assert_int_equal(dp_draw(whole, model.source, &camera, &style, &target, NULL), DP_OK);
    found_lines expected = lines_of(whole);
    dp_context_destroy(whole);
    dp_result result = DP_ERR_MEMORY;
    /* later allocations are much alike: fewer of them where each is dear */
    for (long at = 1; result == DP_ERR_MEMORY; at += DP_TEST_PATIENCE > 1 && at > 40 ? at / 8 : 1) {
        meter m = {0};
        dp_allocator allocator;
        dp_context *const context = metered_context(&m, &allocator, 1);
        atomic_store(&m.calls, 0), atomic_store(&m.fail_at, at);
        result = dp_draw(context, model.source, &camera, &style, &target, NULL);
        if (result) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_int_equal(dp_draw(context, model.source, &camera, &style, &target, NULL), DP_OK);
        }
        found_lines f = lines_of(context);
        expect_same_lines(&expected, &f, "after memory was out");
        free_lines(&f);
        dp_context_destroy(context);
        assert_int_equal(atomic_load(&m.live), 0);
    }
    assert_int_equal(result, DP_OK);
    free_lines(&expected);
    free_rough(&model);
}

static void later_frames_allocate_nothing(void **state) {
    (void)state;
    for (size_t k = 0; k < MODELS; k++)
        for (size_t w = 0; w < WAYS; w++) {
            if (ways[w].limit || ways[w].style.mirror.size > 0 || ways[w].style.shade.shading ||
                ways[w].style.smooth)
                continue; /* whose sources or normals come and go */
            if (!has_turn(k, w)) continue;
            meter m = {0};
            dp_allocator allocator;
            rough_model model =
                make_rough(models[k].name, models[k].triangles, models[k].noise, false);
            dp_context *const context = metered_context(&m, &allocator, 1);
            long calls[3];
            for (int frame = 0; frame < 3; frame++) {
                found_lines f =
                    draw(context, model.source, &ways[w].style, ways[w].samples, first_rgba);
                free_lines(&f);
                calls[frame] = atomic_load(&m.calls);
            }
            if (calls[2] != calls[1])
                fail_msg("%s, %s: %ld allocations in the third frame", models[k].name, ways[w].name,
                         calls[2] - calls[1]);
            dp_context_destroy(context);
            free_rough(&model);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_and_frames),
        cmocka_unit_test(every_width_of_vectors),
        cmocka_unit_test(every_way_leaves_out_noise),
        cmocka_unit_test(quads_are_as_they_are),
        cmocka_unit_test(streamed_is_as_held),
        cmocka_unit_test(immediate_mode_is_the_same),
        cmocka_unit_test(drawings_are_made_of_what_is_left),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(later_frames_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
