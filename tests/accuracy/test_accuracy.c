/* Accuracy of pictures and segments against the exact visible lines, on generated models. */
#include "suite.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 640, HEIGHT = 480, CROSSINGS = 20000 /* polygons */, TEXT = 256 };

static uint8_t picture[4 * WIDTH * HEIGHT];
static dp_context *context;

static suite_model *shape_model(const char *name, uint64_t triangles, uint32_t shuffle) {
    /* the default terrain is finer than the pixels here */
    const uint64_t enough = strcmp(name, "terrain") != 0 ? triangles : 20000;
    const dp_shape shape = {.name = name, .triangles = triangles ? triangles : enough};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_from_shape(&shape, &source, &diag) != DP_OK) fail_msg("%s", diag.message);
    suite_model *model = suite_model_create(name, source, shuffle, CROSSINGS, &diag);
    dp_source_destroy(source);
    if (model == NULL) fail_msg("%s: %s", name, diag.message);
    return model;
}

/* The reference and the scores themselves: what must be so, and what must be noticed. */

/* A cube seen from a corner: nine edges, six of them silhouettes, all whole. */
static void reference_sees_a_cube(void **state) {
    (void)state;
    suite_model *model = shape_model("cube", 0, 0);
    ref_truth *truth = suite_truth(model, &suite_views[0], &suite_classes[0], WIDTH, HEIGHT);
    double length[REF_CLASS_COUNT] = {0};
    size_t pieces[REF_CLASS_COUNT] = {0};
    for (size_t i = 0; i < truth->piece_count; i++) {
        const ref_piece *p = &truth->pieces[i];
        length[p->kind] += hypot(p->b[0] - p->a[0], p->b[1] - p->a[1]);
        pieces[p->kind]++;
    }
    assert_int_equal(ref_model_edges(model->reference, 1), 0);
    assert_int_equal(pieces[DP_LINE_SILHOUETTE], 6);
    assert_int_equal(pieces[DP_LINE_RIDGE], 3);
    assert_int_equal(pieces[DP_LINE_VALLEY] + pieces[DP_LINE_BORDER] + pieces[REF_NEUTRAL], 0);
    /* samples are a quarter pixel apart */
    const double sampled = (double)ref_truth_count(truth, DP_LINE_RIDGE) / 4;
    assert_true(fabs(sampled / length[DP_LINE_RIDGE] - 1) < 0.01);
    ref_truth_destroy(truth);
    suite_model_destroy(model);
}

/* Closed models are closed, and only the boxes cross, and the flag's cloth its pole. */
static void reference_knows_the_models(void **state) {
    (void)state;
    for (uint32_t i = 0; i < dp_shape_count(); i++) {
        suite_model *model = shape_model(dp_shape_name(i), 0, 0);
        const bool flag = !strcmp(model->name, "flag");
        const bool open = flag || !strcmp(model->name, "terrain");
        const size_t borders = ref_model_edges(model->reference, 1);
        const size_t crossings = ref_model_crossings(model->reference);
        if ((borders > 0) != open) fail_msg("%s: %zu edges with one polygon", model->name, borders);
        if ((crossings > 0) != (flag || !strcmp(model->name, "boxes")))
            fail_msg("%s: %zu crossings", model->name, crossings);
        suite_model_destroy(model);
    }
}

static score score_ideal(const ref_truth *truth, uint32_t lines, double px, double dx) {
    score_draw_truth(truth, lines, px, dx, dx, picture);
    return score_picture(truth, picture, lines, px);
}

/* The truth drawn as capsules meets every figure; moved, thinned, cut or blank it does not. */
static void scores_notice_errors(void **state) {
    static const char *const names[] = {"cube", "bracket", "boxes", "gear"};
    char text[TEXT];
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        suite_model *model = shape_model(names[i], 0, 0);
        const suite_class *set = &suite_classes[i < 2 ? 1 : i == 2 ? 3 : 2];
        ref_truth *truth = suite_truth(model, &suite_views[0], set, WIDTH, HEIGHT);
        for (unsigned w = 0; w < SUITE_WIDTHS; w++) {
            const double px = suite_widths[w];
            const score good = score_ideal(truth, set->lines, px, 0);
            if (suite_missed(set, px, &good, text, sizeof text))
                fail_msg("%s ideal %g: %s", names[i], px, text);
            assert_true(good.samples > 400);
            const score moved = score_ideal(truth, set->lines, px, 3);
            assert_true(px > 8 || moved.recall < 0.8); /* lines along the shift stay */
            assert_true(px > 8 || moved.precision < good.precision - 0.01);
            score_draw_truth(truth, set->lines, px * 0.9, 0, 0, picture);
            const score thin = score_picture(truth, picture, set->lines, px);
            assert_true(good.width_samples < 100 ||
                        suite_missed(set, px, &thin, text, sizeof text));
            score_draw_truth(truth, set->lines, px, 0, 0, picture);
            for (size_t y = 0; y < HEIGHT; y += 20)
                memset(picture + 4 * WIDTH * y, 255, 4 * WIDTH * 4);
            const score cut = score_picture(truth, picture, set->lines, px);
            assert_true(cut.recall < 0.95);
            assert_true(px < 12 || cut.cracks > 0.1);
            memset(picture, 255, sizeof picture);
            assert_true(score_picture(truth, picture, set->lines, px).recall == 0);
        }
        ref_truth_destroy(truth);
        suite_model_destroy(model);
    }
}

/* The same of lists of segments. */
static void segment_scores_notice_errors(void **state) {
    (void)state;
    suite_model *model = shape_model("gear", 0, 0);
    ref_truth *truth = suite_truth(model, &suite_views[1], &suite_classes[2], WIDTH, HEIGHT);
    dp_segment *segments = calloc(truth->piece_count + 1, sizeof *segments);
    assert_non_null(segments);
    for (size_t i = 0; i < truth->piece_count; i++) {
        const ref_piece *p = &truth->pieces[i];
        segments[i].line = (dp_line)p->kind;
        for (int k = 0; k < 3; k++) {
            segments[i].a[k] = (float)p->a[k];
            segments[i].b[k] = (float)p->b[k];
        }
    }
    const score good = score_segments(truth, segments, truth->piece_count, DP_LINE_VALLEY);
    assert_true(good.samples > 400 && good.recall > 0.9999 && good.precision > 0.9999);
    const score half = score_segments(truth, segments, truth->piece_count / 2, DP_LINE_VALLEY);
    assert_true(half.recall < 0.9);
    for (size_t i = 0; i < truth->piece_count; i++) segments[i].a[0] += 6, segments[i].b[0] += 6;
    const score moved = score_segments(truth, segments, truth->piece_count, DP_LINE_VALLEY);
    assert_true(moved.recall < 0.7 && moved.precision < 0.9);
    free(segments);
    ref_truth_destroy(truth);
    suite_model_destroy(model);
}

/* What the library draws. */

typedef struct count {
    unsigned cases, missed;
} count;

/* Known to miss: at a tile's border two edges of a sphere's contour become borders (1 % of its outline is
 * of the wrong class), and without the edge table two short ones of a bracket. To be mended, then taken
 * off. */
static bool is_known(const suite_model *model, const suite_view *view, const char *what) {
    if (!strcmp(model->name, "sphere") && !strcmp(view->name, "left"))
        return strstr(what, "silhouette") || strstr(what, "border");
    return !strcmp(model->name, "bracket") && !strcmp(view->name, "corner") &&
           strstr(what, "segments of border");
}

static void report(count *tally, const suite_model *model, const suite_view *view, const char *what,
                   double px, const char *text) {
    const bool known = is_known(model, view, what);
    tally->missed += !known;
    print_error("%s%s, view %s, %s, %g px: %s\n", known ? "known: " : "", model->name, view->name,
                what, px, text);
}

/* Views in which back faces are seen: a terrain's underside, and a gear that the near plane cuts. Their
 * folds are lines, but the reference, made for clean meshes seen from their front, does not know them;
 * tests/twins has an eye for these. */
static bool sees_back_faces(const suite_model *model, const suite_view *view,
                            const suite_class *set) {
    const bool seen = (!strcmp(model->name, "terrain") && !strcmp(view->name, "below")) ||
                      (!strcmp(model->name, "gear") && !strcmp(view->name, "skimming"));
    return seen && set->lines & (DP_RIDGE | DP_VALLEY);
}

static void check_picture(count *tally, const suite_model *model, const suite_view *view,
                          const ref_truth *truth, const suite_class *set, double px,
                          const dp_style *base) {
    char text[TEXT];
    dp_diag diag = {0};
    if (sees_back_faces(model, view, set)) return;
    tally->cases++;
    if (suite_draw(context, model, truth, set, px, base, picture, &diag) != DP_OK) {
        report(tally, model, view, set->name, px, diag.message);
        return;
    }
    const score scored = score_picture(truth, picture, set->lines, px);
    if (suite_missed(set, px, &scored, text, sizeof text))
        report(tally, model, view, set->name, px, text);
}

/* The list of segments of the drawing just made, class by class. */
static void check_segments(count *tally, const suite_model *model, const suite_view *view,
                           const ref_truth *truth, const suite_class *set) {
    size_t found = 0;
    const dp_segment *segments = dp_segments(context, &found);
    for (int line = 0; line < DP_LINE_COUNT; line++) {
        char text[TEXT], what[TEXT];
        if (!(set->lines >> line & 1)) continue;
        suite_class figures = suite_classes[line == DP_LINE_BORDER ? DP_LINE_RIDGE : line];
        figures.lines = 0; /* no widths */
        const score scored = score_segments(truth, segments, found, (dp_line)line);
        snprintf(what, sizeof what, "segments of %s", dp_line_name((dp_line)line));
        tally->cases++;
        if (suite_missed(&figures, 1, &scored, text, sizeof text))
            report(tally, model, view, what, 0, text);
    }
}

/* Every class alone, at every width, and all together. Where a class has no line at all one width
 * will show whether it stays away. */
static void check_view(count *tally, const suite_model *model, const suite_view *view,
                       const dp_style *base, unsigned most_widths) {
    ref_truth *alone = suite_truth(model, view, &suite_classes[0], WIDTH, HEIGHT);
    for (unsigned c = 0; c < SUITE_CLASSES; c++) {
        const suite_class *set = &suite_classes[c];
        const bool together = set->lines == DP_ALL_LINES;
        ref_truth *truth = together ? suite_truth(model, view, set, WIDTH, HEIGHT) : alone;
        size_t samples = 0;
        for (unsigned line = 0; line < DP_LINE_COUNT; line++)
            if (set->lines >> line & 1) samples += ref_truth_count(truth, line);
        const unsigned widths = samples == 0                ? 1
                                : set->widths < most_widths ? set->widths
                                                            : most_widths;
        for (unsigned w = 0; w < widths; w++)
            check_picture(tally, model, view, truth, set, suite_widths[w], base);
        if (together && !sees_back_faces(model, view, set)) {
            check_segments(tally, model, view, truth, set);
        }
        if (together) ref_truth_destroy(truth);
    }
    ref_truth_destroy(alone);
}

static void finish(const count *tally) {
    assert_true(tally->cases > 0);
    if (tally->missed > 0) fail_msg("%u of %u cases miss a figure", tally->missed, tally->cases);
}

static void check_shape(const char *name) {
    const dp_style base = {0};
    suite_model *model = shape_model(name, 0, 0);
    count tally = {0};
    for (unsigned v = 0; v < SUITE_VIEWS; v++)
        check_view(&tally, model, &suite_views[v], &base, SUITE_WIDTHS);
    suite_model_destroy(model);
    finish(&tally);
}

static void draws_cube(void **state) { (void)state, check_shape("cube"); }
static void draws_tetrahedron(void **state) { (void)state, check_shape("tetrahedron"); }
static void draws_sphere(void **state) { (void)state, check_shape("sphere"); }
static void draws_torus(void **state) { (void)state, check_shape("torus"); }
static void draws_cylinder(void **state) { (void)state, check_shape("cylinder"); }
static void draws_gear(void **state) { (void)state, check_shape("gear"); }
static void draws_bolt(void **state) { (void)state, check_shape("bolt"); }
static void draws_bracket(void **state) { (void)state, check_shape("bracket"); }
static void draws_stairs(void **state) { (void)state, check_shape("stairs"); }
static void draws_boxes(void **state) { (void)state, check_shape("boxes"); }
static void draws_terrain(void **state) { (void)state, check_shape("terrain"); }

/* Triangles without indices, in random order: the same lines. */
static void draws_soups(void **state) {
    static const char *const names[] = {"torus", "gear", "bolt", "boxes", "terrain"};
    const dp_style base = {0};
    count tally = {0};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        suite_model *model = shape_model(names[i], 0, (uint32_t)i + 1);
        check_view(&tally, model, &suite_views[i % SUITE_VIEWS], &base, 2);
        suite_model_destroy(model);
    }
    finish(&tally);
}

/* With the edge table off every line emerges from the depth test. */
static void draws_without_the_edge_table(void **state) {
    static const char *const names[] = {"cube", "bracket", "boxes"};
    const dp_style base = {.edge_table_off = true};
    count tally = {0};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        suite_model *model = shape_model(names[i], 0, 0);
        check_view(&tally, model, &suite_views[0], &base, i == 1 ? 1 : SUITE_WIDTHS);
        suite_model_destroy(model);
    }
    finish(&tally);
}

/* Edges and polygons that cross the near plane. */
static void draws_what_is_partly_behind_the_eye(void **state) {
    static const char *const names[] = {"stairs", "gear", "bracket", "boxes", "terrain"};
    const dp_style base = {0};
    count tally = {0};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        suite_model *model = shape_model(names[i], 0, 0);
        for (unsigned v = 0; v < SUITE_CLOSE_VIEWS; v++)
            check_view(&tally, model, &suite_close_views[v], &base, 2);
        suite_model_destroy(model);
    }
    finish(&tally);
}

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_sees_a_cube),
        cmocka_unit_test(reference_knows_the_models),
        cmocka_unit_test(scores_notice_errors),
        cmocka_unit_test(segment_scores_notice_errors),
        cmocka_unit_test(draws_cube),
        cmocka_unit_test(draws_tetrahedron),
        cmocka_unit_test(draws_sphere),
        cmocka_unit_test(draws_torus),
        cmocka_unit_test(draws_cylinder),
        cmocka_unit_test(draws_gear),
        cmocka_unit_test(draws_bolt),
        cmocka_unit_test(draws_bracket),
        cmocka_unit_test(draws_stairs),
        cmocka_unit_test(draws_boxes),
        cmocka_unit_test(draws_terrain),
        cmocka_unit_test(draws_soups),
        cmocka_unit_test(draws_without_the_edge_table),
        cmocka_unit_test(draws_what_is_partly_behind_the_eye),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
