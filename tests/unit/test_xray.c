/* The surfaces of x-rays against a reference that knows rays only, sample by sample: soups of triangles,
 * boxes, groups of their own opacity, layers beyond the limit. */
#include "raster/samples.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "xray_scene.h"

static canvas second;

/* ------- the reference ------- */

/* A view as rays: those of orthographic ones are parallel. Lengths along `forward` are depths. */
typedef struct rays {
    double eye[3], forward[3], right[3], up[3];
    double size; /* of a pixel, at a depth of 1 or, orthographic, at any */
    bool perspective;
} rays;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
static void unit(double a[3]) {
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
}

static rays rays_of(double ex, double ey, double ez, bool perspective) {
    const double up[3] = {0, 1, 0};
    rays r = {.eye = {ex, ey, ez}, .forward = {-ex, -ey, -ez}, .perspective = perspective};
    unit(r.forward);
    cross(r.forward, up, r.right);
    unit(r.right);
    cross(r.right, r.forward, r.up);
    r.size = perspective ? tan(25 * 3.14159265358979 / 180) / (H / 2.0) : 1;
    return r;
}

/* The ray through a point of the screen: from `at` along `along`, whose depth grows by 1. */
static void ray_at(const rays *r, double x, double y, double at[3], double along[3]) {
    const double u = (x - W / 2.0) * r->size, v = (H / 2.0 - y) * r->size;
    for (int i = 0; i < 3; i++) {
        const double beside = u * r->right[i] + v * r->up[i];
        at[i] = r->eye[i] + (r->perspective ? 0 : beside);
        along[i] = r->forward[i] + (r->perspective ? beside : 0);
    }
}

typedef struct hit {
    double depth;
    bool front;
    size_t polygon;
} hit;

typedef struct hits {
    hit of[SCENE_POLYGONS];
    size_t count;
    bool unsure; /* the ray grazes an edge or a plane, or two surfaces are about as near */
} hits;

static int by_depth(const void *left, const void *right) {
    const hit *const l = left, *const r = right;
    return (l->depth > r->depth) - (l->depth < r->depth);
}

/* Meets a ray with the triangle of a fan. */
static void meet(hits *out, size_t polygon, const float *corners[3], const double at[3],
                 const double along[3]) {
    double e1[3], e2[3], n[3], s[3], q[3], p[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = (double)corners[1][i] - (double)corners[0][i];
        e2[i] = (double)corners[2][i] - (double)corners[0][i];
        s[i] = at[i] - (double)corners[0][i];
    }
    cross(e1, e2, n);
    cross(along, e2, p);
    cross(s, e1, q);
    const double det = dot(e1, p), size = sqrt(dot(n, n)) * sqrt(dot(along, along));
    if (det == 0) return;
    const double u = dot(s, p) / det, v = dot(along, q) / det, t = dot(e2, q) / det;
    const double least = fmin(u, fmin(v, 1 - u - v));
    if ((fabs(least) < 1e-4 || (fabs(det) < 1e-3 * size && least > -0.1)) && t > 0)
        out->unsure = true;
    if (least < 0 || t <= 0) return;
    out->of[out->count++] = (hit){t, dot(n, along) < 0, polygon};
}

static void find_hits(const rays *r, double x, double y, hits *out) {
    double at[3], along[3];
    ray_at(r, x, y, at, along);
    out->count = 0;
    out->unsure = false;
    for (size_t i = 0; i < made.polygons; i++)
        for (uint32_t k = made.firsts[i] + 2; k < made.firsts[i + 1]; k++) {
            const float *const corners[3] = {made.positions[made.firsts[i]], made.positions[k - 1],
                                             made.positions[k]};
            meet(out, i, (const float **)corners, at, along);
        }
    qsort(out->of, out->count, sizeof *out->of, by_depth);
}

/* The layers of a ray, nearest first, as numbers of hits. */
static size_t layers_of(const rays *r, hits *h, size_t layers[SCENE_POLYGONS]) {
    size_t count = 0;
    double bound = -INFINITY;
    for (size_t i = 0; i < h->count; i++) {
        if (!h->of[i].front && i) continue;
        const double gap = 0.05 * r->size * (r->perspective ? h->of[i].depth : 1);
        if (fabs(h->of[i].depth - bound) < 0.02 * gap + 1e-4) h->unsure = true;
        if (h->of[i].depth <= bound) continue;
        layers[count++] = i;
        bound = h->of[i].depth + gap;
    }
    for (size_t i = 1; i < h->count; i++)
        if (h->of[i].depth - h->of[i - 1].depth < 1e-3) h->unsure = true;
    return count;
}

/* What the picture should be. */
typedef struct reference {
    const rays *rays;
    const float *opacity;    /* by polygon */
    const dp_color *surface; /* by polygon */
    dp_color paper;
    size_t most;
    uint64_t lost;
    size_t compared, unsure;
} reference;

static void add_color(double sum[3], dp_color c, double weight) {
    for (int i = 0; i < 3; i++) sum[i] += weight * (c >> (24 - 8 * i) & 0xff);
}

/* One sample; false: unsure. */
static bool expect_sample(reference *e, double x, double y, double sum[3]) {
    static hits h;
    size_t layers[SCENE_POLYGONS];
    double through = 1;
    find_hits(e->rays, x, y, &h);
    size_t count = layers_of(e->rays, &h, layers);
    for (size_t k = 0; k < count; k++) /* nothing behind what is opaque */
        if (e->opacity[h.of[layers[k]].polygon] >= 1) count = k + 1;
    if (h.unsure) return false;
    e->lost += count > e->most;
    for (size_t k = 0; k < count && k < e->most; k++) {
        const size_t polygon = h.of[layers[k]].polygon;
        add_color(sum, e->surface[polygon], through * (double)e->opacity[polygon]);
        through *= 1 - (double)e->opacity[polygon];
    }
    add_color(sum, e->paper, through);
    return true;
}

static void expect_picture(reference *e, const canvas *c, uint32_t samples) {
    dp_sampling pattern;
    dp_sampling_init(&pattern, samples);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double sum[3] = {0, 0, 0};
            bool sure = true;
            for (uint32_t i = 0; i < samples; i++)
                sure &= expect_sample(e, x + (double)pattern.x[i / 4][i % 4],
                                      y + (double)pattern.y[i / 4][i % 4], sum);
            e->compared++;
            if (!sure && ++e->unsure) continue;
            for (int k = 0; k < 3; k++)
                if (fabs(sum[k] / samples - pixel_of(c, x, y)[k]) > 1)
                    fail_msg("pixel %d %d, %u samples: %d, not %.2f", x, y, samples,
                             pixel_of(c, x, y)[k], sum[k] / samples);
        }
    assert_true(e->unsure * 50 < e->compared);
}

/* ------- surfaces ------- */

static dp_style faint(float opacity, uint32_t layers) {
    return (dp_style){.lines = DP_NO_LINES,
                      .xray = opacity,
                      .xray_layers = layers,
                      .surface = surface,
                      .paper = paper};
}

static void expect_scene(const dp_camera *camera, const rays *r, float opacity, uint32_t layers,
                         uint32_t samples) {
    const dp_style style = faint(opacity, layers);
    one_look(opacity, surface);
    reference e = {.rays = r,
                   .opacity = opacities,
                   .surface = surfaces,
                   .paper = paper,
                   .most = layers ? layers : DP_LEVELS};
    const dp_stats stats = draw_on(&first, camera, &style, samples);
    expect_picture(&e, &first, samples);
    /* unsure samples may have more */
    assert_true(stats.xray_lost >= e.lost && stats.xray_lost <= e.lost + e.unsure * samples);
}

static void surfaces_are_as_rays_find_them(void **state) {
    static const uint32_t samples[] = {1, 4, 8, 16};
    static const float opacity[] = {0.1f, 0.35f, 0.7f, 0.95f};
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        const dp_camera flat = scene_flat_camera(), near = scene_camera(120, 90, 160, 0, 0, 0);
        const rays parallel = rays_of(0, 0, 500, false), meeting = rays_of(120, 90, 160, true);
        make_boxes();
        expect_scene(&near, &meeting, opacity[i], 0, samples[i]);
        make_triangles(7 + i, 40, 0.6);
        expect_scene(&flat, &parallel, opacity[i], 0, samples[i]);
        make_triangles(17 + i, 60, 0.4);
        expect_scene(&near, &meeting, opacity[i], 0, samples[i]);
    }
}

static void what_lies_deeper_is_counted(void **state) {
    const dp_camera flat = scene_flat_camera();
    const rays parallel = rays_of(0, 0, 500, false);
    (void)state;
    for (uint32_t layers = 1; layers < 5; layers++) {
        make_triangles(31, 50, 0.3);
        expect_scene(&flat, &parallel, 0.4f, layers, 4);
        dp_stats stats;
        dp_stats_of(context, &stats);
        assert_int_equal(stats.xray_layers, layers);
        assert_true(stats.xray_lost > 0);
    }
}

/* The same triangles in another order, each from another corner on. */
static void shuffle(uint32_t seed) {
    for (size_t i = made.polygons; i-- > 1;) {
        const size_t k = (size_t)(random_number(&seed) * (double)(i + 1));
        float held[3][3];
        memcpy(held, made.positions[3 * i], sizeof held);
        memcpy(made.positions[3 * i], made.positions[3 * k], sizeof held);
        memcpy(made.positions[3 * k], held, sizeof held);
    }
}

static void order_makes_no_difference(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    const dp_style style = faint(0.3f, 0);
    (void)state;
    for (uint32_t seed = 1; seed < 20; seed++) {
        make_triangles(seed, 60, 0.5);
        draw_on(&first, &near, &style, 4);
        shuffle(seed);
        draw_on(&second, &near, &style, 4);
        assert_memory_equal(first.rgba, second.rgba, sizeof first.rgba);
    }
}

static void opaque_is_as_ever(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    (void)state;
    make_boxes();
    dp_style style = {.surface = surface, .paper = paper};
    draw_on(&first, &near, &style, 4);
    style.xray = 1;
    draw_on(&second, &near, &style, 4);
    assert_memory_equal(&first, &second, sizeof first);
}

/* Depth and groups are those of the nearest surface. */
static void other_planes_are_as_ever(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    (void)state;
    for (int shaded = 0; shaded < 2; shaded++) {
        dp_style style = {.shade = {.shading = shaded ? DP_SHADING_LAMBERT : DP_SHADING_FLAT}};
        make_triangles(3, 60, 0.5);
        draw_on(&first, &near, &style, 4);
        style.xray = 0.4f;
        draw_on(&second, &near, &style, 4);
        assert_memory_equal(first.depth, second.depth, sizeof first.depth);
        assert_memory_equal(first.id, second.id, sizeof first.id);
        assert_memory_not_equal(first.rgba, second.rgba, sizeof first.rgba);
    }
}

static void surfaces_that_are_there_twice_are_one(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    const dp_style style = {.xray = 0.4f, .surface = surface, .paper = paper};
    (void)state;
    make_boxes();
    draw_on(&first, &near, &style, 4);
    const size_t all = made.polygons;
    for (size_t i = 0; i < all; i++) {
        float corners[4][3];
        const uint32_t from = made.firsts[i];
        for (uint32_t k = 0; k < 4; k++)
            memcpy(corners[k], made.positions[from + (k + 1) % 4], sizeof corners[k]);
        scene_polygon(&made, 4, (const float(*)[3])corners);
    }
    dp_style surfaces_only = style;
    surfaces_only.lines = DP_NO_LINES;
    draw_on(&second, &near, &surfaces_only, 4);
    make_boxes();
    draw_on(&first, &near, &surfaces_only, 4);
    for (size_t i = 0; i < sizeof first.rgba; i++)
        assert_true(abs(first.rgba[i] - second.rgba[i]) <= 1);
}

/* A sheet seen from behind is a surface if nothing lies before it: for lines as for samples. */
static void sheets_from_behind_count_where_they_are_seen(void **state) {
    const dp_camera flat = scene_flat_camera();
    const rays parallel = rays_of(0, 0, 500, false);
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        made.corners = made.polygons = 0;
        scene_roof(&made, 90, 30);
        scene_wall(&made, -70, 20, 70, 20, 55);
        scene_wall(&made, 70, turned ? 30 : 10, -70, turned ? 30 : 10, 50);
        expect_scene(&flat, &parallel, 0.4f, 0, 4);
        const dp_style style = {.xray = 0.4f};
        draw_on(&first, &flat, &style, 4);
        size_t count, found = 0;
        const dp_segment *const s = dp_segments(context, &count);
        for (size_t i = 0; i < count; i++) {
            if (s[i].line != DP_LINE_RIDGE) continue;
            found++;
            assert_int_equal(s[i].level, turned ? 2 : 1);
        }
        assert_true(found > 0);
    }
}

static void groups_have_opacities_of_their_own(void **state) {
    static const float own[] = {0.2f, 0.5f, 1, 0.8f};
    static const dp_color colors[] = {DP_RGB(255, 0, 0), DP_RGB(0, 200, 0), DP_RGB(0, 0, 250),
                                      DP_RGB(90, 90, 90)};
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    const rays meeting = rays_of(120, 90, 160, true);
    const dp_style style = {.paper = paper};
    (void)state;
    for (uint32_t seed = 1; seed < 5; seed++) {
        make_triangles(seed, 50, 0.5);
        for (size_t i = 0; i < made.polygons; i++)
            opacities[i] = own[i % 4], surfaces[i] = colors[i / 4 % 4];
        reference e = {.rays = &meeting,
                       .opacity = opacities,
                       .surface = surfaces,
                       .paper = paper,
                       .most = DP_LEVELS};
        dp_disable(context, DP_ALL_LINES);
        draw_groups(&first, &near, &style, 4);
        expect_picture(&e, &first, 4);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_are_as_rays_find_them),
        cmocka_unit_test(what_lies_deeper_is_counted),
        cmocka_unit_test(order_makes_no_difference),
        cmocka_unit_test(opaque_is_as_ever),
        cmocka_unit_test(other_planes_are_as_ever),
        cmocka_unit_test(surfaces_that_are_there_twice_are_one),
        cmocka_unit_test(sheets_from_behind_count_where_they_are_seen),
        cmocka_unit_test(groups_have_opacities_of_their_own)};
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
