/* dp_style.detail: what is left out of a drawing, and what never is. */
#include "base/hostile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#include "rough.h"

/* Pictures up to LARGE; smaller ones where tiny tiles make all of them dear. */
enum { SIDE_MAX = 1200, LARGE = DP_TUNED(SIDE_MAX, 300), CLASSES = DP_LINE_COUNT };

static const uint32_t creases = DP_RIDGE | DP_VALLEY;
static const double oblique[3] = {1, 0.7, 1.4}, askew[3] = {0.31, 0.23, 0.92};

static dp_context *context;
static uint8_t rgba[4 * SIDE_MAX * SIDE_MAX];

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

static found_lines draw_style(dp_source *source, const dp_camera *camera, uint32_t width,
                              uint32_t height, const dp_style *style) {
    const dp_target target = {.width = width, .height = height, .rgba = rgba};
    dp_diag diag = {0};
    if (dp_draw(context, source, camera, style, &target, &diag)) fail_msg("%s", diag.message);
    return lines_of(context);
}

static found_lines draw(dp_source *source, const dp_camera *camera, uint32_t side, double detail) {
    return draw_style(source, camera, side, side, &(dp_style){.detail = (float)detail});
}

/* ------- what may be asked for ------- */

static void values_out_of_range_are_refused(void **state) {
    static const float wrong[] = {-1,   -0.5f,    0.001f,    0.00999f, 100.5f,
                                  1000, INFINITY, -INFINITY, NAN},
                       right[] = {0, 0.01f, 0.5f, 1, 2, 100};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        dp_style resolved;
        dp_diag diag = {0};
        const dp_style style = {.detail = wrong[i]};
        assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
        assert_non_null(strstr(diag.message, "detail"));
        assert_non_null(strstr(diag.message, "0.01 to 100"));
    }
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        dp_style resolved;
        const dp_style style = {.detail = right[i]};
        assert_int_equal(dp_style_resolve(&style, &resolved, NULL), DP_OK);
        assert_true(resolved.detail == right[i]);
    }
}

/* Also in a context that has left out lines before. */
static void nothing_is_left_out_unasked(void **state) {
    static uint8_t first[sizeof rgba];
    rough_model m = make_rough("sphere", 20000, 0.01f, false);
    const dp_camera camera = view_of(m.source, oblique, false, 1);
    (void)state;
    found_lines a = draw_style(m.source, &camera, 400, 400, NULL);
    memcpy(first, rgba, sizeof first);
    found_lines less = draw(m.source, &camera, 400, 1);
    assert_true(length_at(&less, creases, 0) < 0.1 * length_at(&a, creases, 0));
    assert_true(memcmp(first, rgba, sizeof first) != 0);
    found_lines b = draw(m.source, &camera, 400, 0);
    expect_same_lines(&a, &b, "exact after less");
    assert_memory_equal(first, rgba, sizeof first);
    free_lines(&a), free_lines(&b), free_lines(&less);
    free_rough(&m);
}

/* ------- what noise makes ------- */

/* How many of 360 degrees of the largest circle in the picture have a line within px of it. */
static int degrees_with_lines(const found_lines *f, double side, double radius, double px) {
    bool has[360] = {false};
    for (size_t i = 0; i < f->count; i++)
        for (int k = 0; k <= 8; k++) {
            const dp_segment *const s = &f->segments[i];
            const double t = k / 8.0,
                         x = (double)s->a[0] + t * ((double)s->b[0] - (double)s->a[0]) - side / 2,
                         y = (double)s->a[1] + t * ((double)s->b[1] - (double)s->a[1]) - side / 2;
            if (fabs(hypot(x, y) - radius) > px) continue;
            const int degree = (int)(atan2(y, x) * 180 / 3.14159265358979323846 + 360) % 360;
            has[degree] = true;
        }
    int count = 0;
    for (int i = 0; i < 360; i++) count += has[i];
    return count;
}

/* px of visible outlines nearer to the middle. */
static double outlines_within(const found_lines *f, double side, double radius) {
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        const dp_segment *const s = &f->segments[i];
        if (s->line == DP_LINE_SILHOUETTE && !s->level &&
            hypot((double)s->a[0] - side / 2, (double)s->a[1] - side / 2) < radius)
            sum += length_of(s);
    }
    return sum;
}

static void a_rough_ball_keeps_its_outline_alone(void **state) {
    rough_model m = make_rough("sphere", 80000, 0.006f, false);
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (int side = 300; side <= LARGE; side += 450) {
            const dp_camera camera = view_of(m.source, askew, orthographic, 1);
            found_lines all = draw(m.source, &camera, (uint32_t)side, 0),
                        few = draw(m.source, &camera, (uint32_t)side, 1);
            const double radius = 0.96 * side / 2, rim = 2 * 3.14159265358979323846 * radius;
            const double rough = length_at(&all, creases, 0);
            assert_true(rough > 10 * rim);
            assert_true(length_at(&few, creases, 0) < 0.02 * rough);
            assert_true(outlines_within(&all, side, 0.9 * radius) > 0.1 * rim);
            assert_true(outlines_within(&few, side, 0.9 * radius) < 0.01 * rim);
            assert_true(length_at(&few, DP_SILHOUETTE, 0) < length_at(&all, DP_SILHOUETTE, 0));
            assert_true(degrees_with_lines(&few, side, radius, 0.03 * radius) == 360);
            free_lines(&all), free_lines(&few);
        }
    free_rough(&m);
}

static void a_rough_terrain_keeps_crests_and_borders(void **state) {
    if (DP_TUNED(false, true)) skip(); /* large, and of whole chains */
    rough_model m = make_rough("terrain", 20000, 0.006f, true),
                smooth = make_rough("terrain", 20000, 0, true);
    const dp_camera camera = view_of(smooth.source, oblique, false, 1);
    (void)state;
    found_lines all = draw(m.source, &camera, 900, 0), few = draw(m.source, &camera, 900, 1),
                clean = draw(smooth.source, &camera, 900, 0);
    const double rough = length_at(&all, creases, 0);
    assert_true(rough > 5000);
    assert_true(length_at(&few, creases, 0) < 0.02 * rough);
    assert_true(length_at(&few, DP_SILHOUETTE, 0) < length_at(&all, DP_SILHOUETTE, 0));
    assert_true(length_at(&few, DP_SILHOUETTE, 0) > 0.7 * length_at(&clean, DP_SILHOUETTE, 0));
    assert_true(length_at(&few, DP_BORDER, 0) == length_at(&all, DP_BORDER, 0));
    free_lines(&all), free_lines(&few), free_lines(&clean);
    free_rough(&m), free_rough(&smooth);
}

/* ------- what parts are made of ------- */

/* Folds, borders and intersections of machine parts, by length and class. */
static void parts_lose_nothing(void **state) {
    static const char *const names[] = {"cube",    "tetrahedron", "cylinder",
                                        "bracket", "stairs",      "boxes"};
    (void)state;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        for (int side = 200; side <= LARGE; side += 250)
            for (int flat = 0; flat < 2; flat++) {
                rough_model m = make_rough(names[n], 0, 0, false);
                const dp_camera camera = view_of(m.source, askew, flat, 1);
                found_lines all = draw(m.source, &camera, (uint32_t)side, 0),
                            few = draw(m.source, &camera, (uint32_t)side, 1);
                for (int line = 0; line < CLASSES; line++) {
                    const double was = length_at(&all, 1u << line, 0),
                                 is = length_at(&few, 1u << line, 0);
                    if (is < 0.99 * was)
                        fail_msg("%s, %d px, %s: %.1f px of %.1f", names[n], side,
                                 dp_line_name((dp_line)line), is, was);
                }
                free_lines(&all), free_lines(&few);
                free_rough(&m);
            }
}

/* ------- what is drawn is part of the exact drawing ------- */

/* Where between the ends of `all` a point lies, by the screen; NaN where it is off by more than a tenth of
 * a pixel. */
static double share_on(const dp_segment *all, const float point[3]) {
    const double x = (double)all->b[0] - (double)all->a[0],
                 y = (double)all->b[1] - (double)all->a[1],
                 dx = (double)point[0] - (double)all->a[0],
                 dy = (double)point[1] - (double)all->a[1], square = x * x + y * y;
    if (square <= 0) return hypot(dx, dy) < 0.1 ? 0 : NAN;
    const double t = (x * dx + y * dy) / square;
    return fabs(x * dy - y * dx) / sqrt(square) < 0.1 ? t : NAN;
}

static bool same_edge(const dp_segment *a, const dp_segment *b) {
    return a->line == b->line && a->polygon == b->polygon && a->other == b->other &&
           a->edge == b->edge && a->group == b->group && !a->level == !b->level;
}

static bool is_part(const dp_segment *part, const dp_segment *all) {
    if (!same_edge(part, all)) return false;
    const double from = share_on(all, part->a), to = share_on(all, part->b);
    return from > -1e-4 && to < 1 + 1e-4 && from <= to;
}

/* An end is the exact segment's own or, of a cut, says so and lies where it should in space. */
static void check_end(const dp_segment *part, const dp_segment *all, int end) {
    const float *const p = end ? part->b : part->a, *const q = end ? all->b : all->a;
    const double *const w = end ? part->world_b : part->world_a;
    if (!memcmp(p, q, 3 * sizeof *p)) {
        assert_memory_equal(w, end ? all->world_b : all->world_a, 3 * sizeof *w);
        if (part->end[end] == DP_END_DETAIL) return;
        assert_int_equal(part->end[end], all->end[end]);
        assert_int_equal(part->hider[end], all->hider[end]);
        return;
    }
    assert_int_equal(part->end[end], DP_END_DETAIL);
    assert_true(part->hider[end] == UINT64_MAX);
    double away = 0, size = 0;
    const double far = (double)all->b[2] - (double)all->a[2];
    for (int k = 0; k < 3; k++) size = fmax(size, fabs(all->world_b[k] - all->world_a[k]));
    if (fabs(far) < 0.2 * size) return; /* nothing to be told by distances */
    const double t = ((double)p[2] - (double)all->a[2]) / far;
    for (int k = 0; k < 3; k++)
        away = fmax(away, fabs(all->world_a[k] + t * (all->world_b[k] - all->world_a[k]) - w[k]));
    assert_true(away < 1e-3 * size + 1e-5);
}

/* Of hidden lines short runs take their neighbours' level, and are joined: both ends lie on hidden parts of the
 * edge. */
static bool lies_on_hidden(const dp_segment *part, const found_lines *all) {
    bool found[2] = {false};
    for (size_t i = 0; i < all->count && !(found[0] && found[1]); i++)
        for (int end = 0; end < 2; end++) {
            if (!same_edge(part, &all->segments[i])) continue;
            const double t = share_on(&all->segments[i], end ? part->b : part->a);
            found[end] |= t > -1e-4 && t < 1 + 1e-4;
        }
    return found[0] && found[1];
}

static double hidden_length(const found_lines *f) {
    double sum = 0;
    for (uint32_t level = 1; level <= DP_LEVELS; level++) sum += length_at(f, DP_ALL_LINES, level);
    return sum;
}

static void check_parts(const found_lines *all, const found_lines *few, const char *what) {
    size_t at = 0;
    double other = 0;
    for (size_t i = 0; i < few->count; i++) {
        const dp_segment *const part = &few->segments[i];
        size_t tries = 0;
        if (part->level) {
            if (!lies_on_hidden(part, all)) other += length_of(part);
            continue;
        }
        for (; tries < all->count && !is_part(part, &all->segments[(at + tries) % all->count]);)
            tries++;
        if (tries == all->count)
            fail_msg("%s: segment %zu, %s of polygon %llu, lies on no exact one", what, i,
                     dp_line_name(part->line), (unsigned long long)part->polygon);
        at = (at + tries) % all->count;
        for (int end = 0; end < 2; end++) check_end(part, &all->segments[at], end);
    }
    /* what is a crumb of a hidden line depends on the chain that it is part of */
    assert_true(other <= 0.005 * hidden_length(all));
}

static void lines_are_parts_of_exact_ones(void **state) {
    static const struct {
        const char *name;
        uint64_t triangles;
        float noise;
    } models[] = {{"sphere", 2000, 0.05f}, {"terrain", 3000, 0}, {"terrain", 3000, 0.01f},
                  {"gear", 0, 0},          {"boxes", 0, 0},      {"bolt", 0, 0.002f},
                  {"torus", 500, 0.02f},   {"stairs", 0, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++)
        for (int way = 0; way < 4; way++) {
            char what[100];
            if (((int)i + way) % DP_TUNED(1, 2)) continue;
            rough_model m = make_rough(models[i].name, models[i].triangles, models[i].noise, false);
            const dp_camera camera = view_of(m.source, way % 2 ? oblique : askew, way % 2, 1.5);
            const dp_hidden hidden = {.look = way > 1 ? DP_HIDDEN_THIN : DP_HIDDEN_NONE,
                                      .levels = 3};
            dp_style style = {.hidden = hidden, .exact_ends = way > 1};
            found_lines all = draw_style(m.source, &camera, 600, 400, &style);
            for (int finer = 0; finer < 3; finer++) {
                style.detail = finer == 0 ? 0.3f : finer == 1 ? 1 : 3;
                found_lines few = draw_style(m.source, &camera, 600, 400, &style);
                snprintf(what, sizeof what, "%s, noise %g, way %d, detail %g", models[i].name,
                         (double)models[i].noise, way, (double)style.detail);
                check_parts(&all, &few, what);
                free_lines(&few);
            }
            free_lines(&all);
            free_rough(&m);
        }
}

/* Of borders and intersections nothing is left out, however short they are. */
static void borders_and_intersections_are_all_drawn(void **state) {
    static const char *const names[] = {"boxes", "terrain"};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        rough_model m = make_rough(names[i], 3000, 0.01f, false);
        const dp_camera camera = view_of(m.source, askew, false, 1);
        dp_style style = {.lines = DP_INTERSECTION | DP_BORDER};
        found_lines all = draw_style(m.source, &camera, 300, 300, &style);
        style.detail = 0.01f;
        found_lines few = draw_style(m.source, &camera, 300, 300, &style);
        assert_true(all.count > 3);
        expect_same_lines(&all, &few, names[i]);
        free_lines(&all), free_lines(&few);
        free_rough(&m);
    }
}

/* ------- how much ------- */

static void finer_is_more(void **state) {
    if (DP_TUNED(false, true)) skip(); /* large, and of whole chains */
    static const double details[] = {0.2, 0.4, 1, 3, 10, 100};
    rough_model m = make_rough("terrain", 20000, 0.004f, true);
    const dp_camera camera = view_of(m.source, oblique, false, 1);
    (void)state;
    found_lines all = draw(m.source, &camera, 600, 0);
    double before = 0;
    for (size_t i = 0; i < sizeof details / sizeof *details; i++) {
        found_lines f = draw(m.source, &camera, 600, details[i]);
        const double length = length_at(&f, DP_SILHOUETTE | creases, 0);
        assert_true(length >= 0.98 * before);
        before = length;
        free_lines(&f);
    }
    assert_true(before <= length_at(&all, DP_SILHOUETTE | creases, 0) * 1.0001);
    assert_true(before > 0);
    free_lines(&all);
    free_rough(&m);
}

/* Twice as large a picture has the same lines, twice as long. */
static void sizes_of_a_picture_look_alike(void **state) {
    if (DP_TUNED(false, true)) skip(); /* large, and of whole chains */
    rough_model m = make_rough("terrain", 20000, 0.004f, true);
    const dp_camera camera = view_of(m.source, oblique, false, 1);
    (void)state;
    found_lines small = draw(m.source, &camera, 600, 1), large = draw(m.source, &camera, 1200, 1);
    const double a = 2 * length_at(&small, DP_SILHOUETTE, 0),
                 b = length_at(&large, DP_SILHOUETTE, 0);
    assert_true(fabs(a - b) < 0.1 * b);
    free_lines(&small), free_lines(&large);
    free_rough(&m);
}

/* ------- what is hardly a picture ------- */

static void check_finite(const found_lines *f) {
    for (size_t i = 0; i < f->count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(isfinite(f->segments[i].a[k]) && isfinite(f->segments[i].b[k]) &&
                        isfinite(f->segments[i].world_a[k]) && isfinite(f->segments[i].world_b[k]));
}

static void small_and_odd_pictures(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 300}, {300, 1}, {2, 2}, {7, 1100}, {65, 63}};
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const char *const names[] = {"cube", "sphere", "terrain", "boxes"};
    (void)state;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        rough_model m = make_rough(names[n], 500, 0.01f * (float)(n % 2), false);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
            for (int way = 0; way < 6; way++) {
                const dp_camera camera =
                    view_of(m.source, axes[way % 3], way < 3, (double)sizes[i][0] / sizes[i][1]);
                const dp_style style = {.detail = way % 2 ? 1 : 100};
                found_lines f = draw_style(m.source, &camera, sizes[i][0], sizes[i][1], &style);
                check_finite(&f);
                free_lines(&f);
            }
        free_rough(&m);
    }
}

/* Much smaller than a pixel, or around the eye. */
static void far_and_near_models(void **state) {
    static const double heights[] = {0.001, 0.1, 30, 1e5};
    rough_model m = make_rough("sphere", 3000, 0.02f, false);
    (void)state;
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++)
        for (int perspective = 0; perspective < 2; perspective++) {
            const double eye[3] = {0, 0, heights[i] / 2 + 0.001}, target[3] = {0, 0, -1},
                         up[3] = {0, 1, 0};
            dp_camera camera;
            assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
            if (perspective)
                assert_int_equal(dp_camera_perspective(&camera, 60, 1, 1e-4, 2e5), DP_OK);
            else
                assert_int_equal(dp_camera_orthographic(&camera, heights[i], 1, 0, 2e5), DP_OK);
            for (int k = 0; k < 3; k++) {
                found_lines f = draw(m.source, &camera, 1100, k == 0 ? 0.01 : k == 1 ? 1 : 100);
                check_finite(&f);
                free_lines(&f);
            }
        }
    free_rough(&m);
}

/* Edges that are seen end-on are points. */
static void edges_that_are_points(void **state) {
    static const float prism[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const uint32_t faces[] = {3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4,
                                     1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7},
                          firsts[] = {0, 4, 8, 12, 16, 20, 24};
    const dp_batch batch = {.positions = &prism[0][0],
                            .vertex_count = 8,
                            .indices = faces,
                            .corner_count = 24,
                            .firsts = firsts,
                            .polygon_count = 6};
    dp_source *source = NULL;
    (void)state;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    const dp_camera camera = view_of(source, (const double[3]){0, 0, 1}, true, 1);
    dp_style style = {.hidden = {.look = DP_HIDDEN_SOLID, .levels = 2}};
    found_lines all = draw_style(source, &camera, 200, 200, &style);
    style.detail = 1;
    found_lines few = draw_style(source, &camera, 200, 200, &style);
    assert_true(fabs(length_at(&few, DP_SILHOUETTE, 0) - length_at(&all, DP_SILHOUETTE, 0)) < 0.01);
    check_parts(&all, &few, "points");
    free_lines(&all), free_lines(&few);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_out_of_range_are_refused),
        cmocka_unit_test(nothing_is_left_out_unasked),
        cmocka_unit_test(a_rough_ball_keeps_its_outline_alone),
        cmocka_unit_test(a_rough_terrain_keeps_crests_and_borders),
        cmocka_unit_test(parts_lose_nothing),
        cmocka_unit_test(lines_are_parts_of_exact_ones),
        cmocka_unit_test(borders_and_intersections_are_all_drawn),
        cmocka_unit_test(finer_is_more),
        cmocka_unit_test(sizes_of_a_picture_look_alike),
        cmocka_unit_test(small_and_odd_pictures),
        cmocka_unit_test(far_and_near_models),
        cmocka_unit_test(edges_that_are_points),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
