/* dp_style.detail by what is seen: parts keep their ink, and scans agree with each other, finer and coarser,
 * with noise and without. Scans: the dragon where scripts/agreement.sh has fetched it, and the bunny in
 * ../shared/models or $DRYPOINT_MODELS; without them that is said. */
#include "base/hostile.h"
#include "ink.h"
#include "mesh_noise.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_context *context;

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

/* `width`: of outlines, px; creases are half as wide. */
static ink drawn(dp_source *source, const dp_camera *camera, uint32_t height, float width,
                 float detail) {
    const uint32_t across = height * 4 / 3;
    uint8_t *const rgba = malloc((size_t)across * height * 4);
    const dp_target target = {.width = across, .height = height, .samples = 4, .rgba = rgba};
    dp_style style = {.detail = detail};
    dp_diag diag = {0};
    ink made;
    for (int line = 0; line < DP_LINE_COUNT; line++)
        style.line[line].width =
            line == DP_LINE_SILHOUETTE || line == DP_LINE_BORDER ? width : width / 2;
    assert_non_null(rgba);
    if (dp_draw(context, source, camera, &style, &target, &diag)) fail_msg("%s", diag.message);
    assert_true(ink_make(rgba, across, height, &made));
    free(rgba);
    return made;
}

static double share_near(const ink *a, const ink *b, double px) {
    return a->count ? (double)ink_near(a, b, px) / (double)a->count : 1;
}

/* ------- parts ------- */

/* Fewer pictures, and no scans, where tiny tiles make all of them dear. */
enum { HEIGHTS = DP_TUNED(4, 2), DIRECTIONS = DP_TUNED(10, 3), SCANS = DP_TUNED(1, 0) };

static void check_part(const char *name, double least) {
    static const double from[10][3] = {
        {1, 0.6, 1},  {0, 0, 1},      {1, 0, 0},      {0, 1, 0},      {1, 0.3, 0.2},
        {-1, 0.6, 2}, {0.2, 2, -0.7}, {0.3, -1, 0.5}, {0.1, 0.05, 1}, {-0.7, -0.4, 0.6}};
    static const uint32_t heights[4] = {100, 200, 450, 900};
    dp_source *source = NULL;
    double worst = 1;
    assert_int_equal(dp_source_from_shape(&(dp_shape){.name = name}, &source, NULL), DP_OK);
    for (size_t d = 0; d < DIRECTIONS; d++)
        for (size_t h = 0; h < HEIGHTS; h++) {
            dp_fit fit = {.orthographic = (d + h) % 2};
            dp_camera camera;
            memcpy(fit.direction, from[d], sizeof fit.direction);
            assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
            ink all = drawn(source, &camera, heights[h], 2, 0),
                few = drawn(source, &camera, heights[h], 2, 1);
            const double kept = share_near(&all, &few, 2), own = share_near(&few, &all, 1);
            if (kept < least || own < 1)
                fail_msg("%s from %g, %g, %g, %u px: %.4f of the ink is kept, %.4f was there", name,
                         from[d][0], from[d][1], from[d][2], heights[h], kept, own);
            worst = kept < worst ? kept : worst;
            ink_free(&all), ink_free(&few);
        }
    dp_source_destroy(source);
    print_message("%s: at least %.4f of the ink is kept\n", name, worst);
}

static void parts_keep_their_ink(void **state) {
    (void)state;
    check_part("cube", 1);
    check_part("tetrahedron", 1);
    check_part("cylinder", 1);
    check_part("boxes", 0.998);
    check_part("bracket", 0.998);
    check_part("stairs", 0.998);
    check_part("gear", 0.997);
    check_part("bolt", 0.996);
}

/* ------- scans ------- */

/* Opens folder/name; NULL where it is not there, or not wanted. */
static dp_source *open_scan(const char *folder, const char *beside, const char *name) {
    char path[600];
    dp_source *source = NULL;
    if (!folder || !SCANS) return NULL;
    snprintf(path, sizeof path, "%s%s/%s", folder, beside, name);
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    fclose(file);
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    return source;
}

/* Harmonic mean of the shares of either picture's ink that have the other's within 3 px. */
static double agreement(dp_source *a, dp_source *b, const dp_camera *camera, float detail) {
    ink one = drawn(a, camera, 900, 2, detail), other = drawn(b, camera, 900, 2, detail);
    const double there = share_near(&one, &other, 3), back = share_near(&other, &one, 3);
    ink_free(&one), ink_free(&other);
    return 2 * there * back / (there + back);
}

static dp_source *open_dragon(const char *size) {
    char name[40];
    const char *const cache = getenv("XDG_CACHE_HOME");
    snprintf(name, sizeof name, "dragon-%s.ply", size);
    return open_scan(cache ? cache : getenv("HOME"), cache ? "/drypoint" : "/.cache/drypoint",
                     name);
}

/* Seen from near its head. */
static dp_camera dragon_camera(void) {
    dp_camera camera;
    assert_int_equal(dp_camera_look_at(&camera, (const double[3]){0.15, 0.25, 0.35},
                                       (const double[3]){-0.01, 0.12, 0},
                                       (const double[3]){0, 1, 0}),
                     DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 35, 4.0 / 3, 0.01, 2), DP_OK);
    return camera;
}

static void resolutions_agree(void **state) {
    static const struct {
        const char *size;
        double least;
    } coarser[] = {{"48k", 0.95}, {"11k", 0.82}};
    dp_source *const fine = open_dragon("202k");
    const dp_camera camera = dragon_camera();
    (void)state;
    if (!fine) {
        print_message("no dragons in the cache: scripts/agreement.sh fetches them\n");
        skip();
    }
    for (size_t i = 0; i < sizeof coarser / sizeof *coarser; i++) {
        dp_source *const coarse = open_dragon(coarser[i].size);
        if (!coarse) continue;
        const double exact = agreement(coarse, fine, &camera, 0),
                     clean = agreement(coarse, fine, &camera, 1);
        if (clean < coarser[i].least || clean < exact + 0.03)
            fail_msg("%s triangles and 202k agree by %.3f, exact by %.3f", coarser[i].size, clean,
                     exact);
        dp_source_destroy(coarse);
    }
    dp_source_destroy(fine);
}

static dp_source *with_noise(const char *name, mesh *m) {
    char path[600];
    dp_source *source = NULL;
    const char *const models = getenv("DRYPOINT_MODELS");
    if (models)
        snprintf(path, sizeof path, "%s/%s", models, name);
    else
        snprintf(path, sizeof path, "%s/../../shared/models/%s", DP_TESTS_DIR, name);
    assert_true(mesh_read(path, m) && mesh_add_noise(m, 0.001, 1));
    const dp_batch batch = {.positions = m->positions,
                            .vertex_count = m->vertex_count,
                            .indices = m->indices,
                            .corner_count = 3 * m->triangle_count,
                            .polygon_count = m->triangle_count};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

/* Noise of a thousandth of the model's size, seen by the camera of the model without it. */
static void noise_changes_little(void **state) {
    static const char name[] = "stanford-bunny.obj";
    const char *const models = getenv("DRYPOINT_MODELS");
    dp_source *const smooth =
        open_scan(models ? models : DP_TESTS_DIR, models ? "" : "/../../shared/models", name);
    mesh m;
    dp_camera camera;
    (void)state;
    if (!smooth) {
        print_message("no %s in ../shared/models or $DRYPOINT_MODELS\n", name);
        skip();
    }
    dp_source *const rough = with_noise(name, &m);
    assert_int_equal(dp_camera_fit_source(&camera, NULL, smooth, NULL, NULL), DP_OK);
    const double exact = agreement(rough, smooth, &camera, 0),
                 clean = agreement(rough, smooth, &camera, 1);
    if (clean < 0.93 || clean < exact + 0.3)
        fail_msg("with noise and without agree by %.3f, exact by %.3f", clean, exact);
    dp_source_destroy(rough);
    dp_source_destroy(smooth);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_keep_their_ink),
        cmocka_unit_test(resolutions_agree),
        cmocka_unit_test(noise_changes_little),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
