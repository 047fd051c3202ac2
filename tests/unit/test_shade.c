/* shade: operators by hand, composition in the paper's order, shared pixels, the mirror, bad input. */
#include "base/vec.h"
#include "kernel/kernels.h"
#include "scene.h"
#include "shade/shade.h"

#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ------- operators ------- */

enum { N = 3 };

typedef struct bench {
    dp_gbuffer g;
    dp_shading_setup setup;
    dp_shade_run run;
    float nx[DP_TILE], ny[DP_TILE], nz[DP_TILE], distance[DP_TILE]; /* whole vectors are read */
} bench;

static const dp_shaders *const plain = &dp_shaders_plain;

/* Three pixels: towards the light (the eye), across, away; the surface is (0.8, 0.4, 0.2). */
static void begin(bench *b) {
    memset(b, 0, sizeof *b);
    b->setup.g = &b->g;
    b->g.fx = b->g.fy = 100;
    b->setup.shade.light[2] = 1;
    b->run = (dp_shade_run){.nx = b->nx, .ny = b->ny, .nz = b->nz, .distance = b->distance, .n = N};
    b->nz[0] = 1, b->nx[1] = 1, b->nz[2] = -1;
    for (int i = 0; i < N; i++) {
        static const float surface[3] = {0.8f, 0.4f, 0.2f};
        for (int k = 0; k < 3; k++) b->run.color[k][i] = surface[k];
        b->distance[i] = 1;
    }
}

static void assert_color(const bench *b, int i, double red, double green, double blue) {
    const double expected[3] = {red, green, blue};
    for (int k = 0; k < 3; k++)
        if (fabs((double)b->run.color[k][i] - expected[k]) > 1e-6)
            fail_msg("pixel %d, channel %d: %g is not %g", i, k, (double)b->run.color[k][i], expected[k]);
}

static void lambert_is_the_cosine(void **state) {
    (void)state;
    bench b;
    begin(&b);
    plain->looks[DP_SHADING_LAMBERT](&b.setup, &b.run);
    assert_color(&b, 0, 0.8, 0.4, 0.2);
    assert_color(&b, 1, 0.8 * 0.3, 0.4 * 0.3, 0.2 * 0.3);
    assert_color(&b, 2, 0.8 * 0.3, 0.4 * 0.3, 0.2 * 0.3);
}

/* cool = (0, 0, b) + alpha k_d, warm = (y, y, 0) + beta k_d, half way where N·L is 0 */
static void gooch_is_cool_to_warm(void **state) {
    (void)state;
    bench b;
    begin(&b);
    b.setup.shade.gooch_blue = 0.4f, b.setup.shade.gooch_yellow = 0.3f;
    b.setup.shade.gooch_alpha = 0.25f, b.setup.shade.gooch_beta = 0.5f;
    plain->looks[DP_SHADING_GOOCH](&b.setup, &b.run);
    assert_color(&b, 0, 0.3 + 0.4, 0.3 + 0.2, 0.1);
    assert_color(&b, 2, 0.2, 0.1, 0.4 + 0.05);
    assert_color(&b, 1, (0.7 + 0.2) / 2, (0.5 + 0.1) / 2, (0.1 + 0.45) / 2);
    begin(&b);
    b.setup.shade.gooch_blue = 0.4f, b.setup.shade.gooch_yellow = 0.3f;
    b.setup.shade.gooch_alpha = 0.25f, b.setup.shade.gooch_beta = 0.5f;
    b.setup.shade.gooch_plain = true;
    plain->looks[DP_SHADING_GOOCH](&b.setup, &b.run);
    assert_color(&b, 0, 0.3 + 0.25, 0.3 + 0.25, 0.25);
}

static void highlights_lie_where_the_light_is_reflected(void **state) {
    (void)state;
    bench b;
    begin(&b);
    b.setup.shade.highlight = 0.5f;
    plain->highlight(&b.setup, &b.run);
    assert_color(&b, 0, 0.9, 0.7, 0.6);
    assert_color(&b, 1, 0.8, 0.4, 0.2);
    assert_color(&b, 2, 0.8, 0.4, 0.2);
}

static void toon_looks_up_the_nearest_shade(void **state) {
    (void)state;
    static const uint8_t shades[4][4] = {{0, 0, 0, 255}, {51, 51, 51, 255}, {102, 102, 102, 255}, {255, 255, 255, 255}};
    bench b;
    begin(&b);
    b.setup.shades = shades[0], b.setup.shade_count = 4;
    plain->looks[DP_SHADING_TOON](&b.setup, &b.run);
    assert_color(&b, 0, 0.8, 0.4, 0.2);
    assert_color(&b, 1, 0.8 * 0.4, 0.4 * 0.4, 0.2 * 0.4); /* a half begins the third quarter */
    assert_color(&b, 2, 0, 0, 0);
    begin(&b); /* across the light, but for the rounding of a normal */
    b.setup.shades = shades[0], b.setup.shade_count = 4;
    b.nz[0] = 1e-6f, b.nz[1] = 0, b.nz[2] = -1e-6f;
    plain->looks[DP_SHADING_TOON](&b.setup, &b.run);
    for (int i = 0; i < N; i++) assert_color(&b, i, 0.8 * 0.4, 0.4 * 0.4, 0.2 * 0.4);
}

/* ink = clamp(1/2 + 5 (priority - tone)) */
static void hatching_is_a_smooth_threshold(void **state) {
    (void)state;
    static const uint8_t levels[4] = {0, 100, 200, 255};
    for (int level = 0; level < 4; level++) {
        const uint8_t values[4] = {levels[level], levels[level], levels[level], levels[level]};
        bench b;
        begin(&b);
        b.setup.shade.stroke_scale = 1;
        b.setup.strokes = (dp_strokes_texture){values, 2, 2};
        b.setup.ink[0] = 0.1f;
        plain->looks[DP_SHADING_HATCH](&b.setup, &b.run);
        const double tones[N] = {1.1776, 0.1976, 0.08}, priority = levels[level] / 255.0;
        for (int i = 0; i < N; i++) {
            const double ink = priority > 0 ? fmin(fmax(0.5 + 5 * (priority - tones[i]), 0), 1) : 0;
            assert_color(&b, i, 0.8 + (0.1 - 0.8) * ink, 0.4 - 0.4 * ink, 0.2 - 0.2 * ink);
        }
    }
}

static float random_between(uint32_t *seed, float low, float high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (float)(*seed >> 8) / (1 << 24);
}

/* Normals of any length, none, and not finite; distances, and none; colours of texture coordinates near and far. */
typedef struct pixel_rows {
    float nx[3][DP_TILE], ny[3][DP_TILE], nz[3][DP_TILE], distance[3][DP_TILE], u[3][DP_TILE], v[3][DP_TILE], other[3][DP_TILE];
    uint16_t id[3][DP_TILE];
    uint8_t colors[3][DP_TILE][4], strokes[37 * 21], shades[5][4];
} pixel_rows;

static void make_rows(pixel_rows *p, uint32_t seed) {
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < DP_TILE; x++) {
            p->nx[y][x] = random_between(&seed, -1, 1), p->ny[y][x] = random_between(&seed, -1, 1);
            p->nz[y][x] = x % 17 == 3 ? NAN : x % 13 == 4 ? 0 : random_between(&seed, -1, 1);
            p->distance[y][x] = x % 11 == 5 ? DP_FAR : random_between(&seed, 1, x % 5 ? 1.05f : 3);
            p->other[y][x] = random_between(&seed, 1, 3);
            p->u[y][x] = x % 7 == 6 ? NAN : random_between(&seed, 0, x % 19 == 2 ? 1e30f : 2), p->v[y][x] = p->u[y][x] * 0.3f;
            p->id[y][x] = (uint16_t)(x % 23 == 1 ? 0 : 1 + x / 40);
            for (int k = 0; k < 4; k++) p->colors[y][x][k] = (uint8_t)random_between(&seed, 0, x % 9 ? 256 : 2);
        }
    for (size_t i = 0; i < sizeof p->strokes; i++) p->strokes[i] = (uint8_t)random_between(&seed, 0, 256);
    for (int i = 0; i < 20; i++) p->shades[i / 4][i % 4] = (uint8_t)(12 * i);
}

/* What a run of n pixels becomes, by one look of one table, and then in bytes. */
static void look_at(const dp_shaders *shaders, int look, bool object, bool textured, uint32_t n, pixel_rows *p, uint32_t *words) {
    static dp_gbuffer g;
    g = (dp_gbuffer){.fx = 90, .fy = 80, .cx = 31, .cy = 17, .perspective = look % 2, .stride = DP_TILE, .eye = {1, 2, 3},
                     .other = p->other[0] - 10 * DP_TILE};
    for (int i = 0; i < 3; i++) g.rotation[i][(i + 1) % 3] = 1;
    dp_shading_setup setup = {.g = &g, .strokes = {p->strokes, 37, 21}, .shades = p->shades[0], .shade_count = 5};
    setup.shade = (dp_shade){.light = {0.6f, 0, 0.8f}, .highlight = 0.3f, .gooch_blue = 0.4f, .gooch_yellow = 0.4f, .gooch_alpha = 0.2f,
                             .gooch_beta = 0.6f, .stroke_scale = 0.7f, .object_space = object};
    static dp_shade_run run;
    run = (dp_shade_run){.nx = p->nx[1], .ny = p->ny[1], .nz = p->nz[1], .distance = p->distance[1], .id = p->id[1], .stride = DP_TILE,
                         .u = textured ? p->u[1] : NULL, .v = textured ? p->v[1] : NULL, .x = 0, .y = 11, .n = n};
    shaders->paint((const float[4]){0.9f, 0.5f, 0.1f, 1}, &run);
    if (shaders->looks[look]) shaders->looks[look](&setup, &run);
    shaders->pack(&run, words);
}

/* Whatever comes in. */
static void wider_vectors_shade_the_same(void **state) {
    (void)state;
    static pixel_rows p;
    const dp_kernels *list[DP_KERNELS_MAX];
    for (uint32_t k = 0, kinds = dp_kernels_list(list); k < kinds; k++)
        for (int look = 0; look < DP_SHADING_COUNT; look++)
            for (int mode = 0; mode < 4; mode++) {
                static const uint32_t lengths[4] = {1, 15, 33, DP_TILE};
                uint32_t a[DP_TILE], b[DP_TILE];
                make_rows(&p, (uint32_t)(100 * look + mode));
                look_at(plain, look, mode & 1, mode & 2, lengths[mode] < DP_TILE ? lengths[mode] : DP_TILE, &p, a);
                look_at(dp_shaders_for(list[k]->lanes), look, mode & 1, mode & 2, lengths[mode] < DP_TILE ? lengths[mode] : DP_TILE, &p, b);
                for (uint32_t i = 0; i < lengths[mode] && i < DP_TILE; i++)
                    if (p.id[1][i] && a[i] != b[i]) fail_msg("%s, look %d, mode %d, pixel %u: %x, not %x", list[k]->name, look, mode, i, b[i], a[i]);
            }
}

/* The cartoon map, too; by hand: a mean of one surface's colours, weighed 1 2 1 both ways. */
static void wider_vectors_smooth_the_same(void **state) {
    (void)state;
    static uint8_t colors[3][3 * DP_TILE][4], out[2][DP_TILE][4];
    static float distance[3][3 * DP_TILE];
    static uint16_t id[3][3 * DP_TILE];
    const dp_kernels *list[DP_KERNELS_MAX];
    uint32_t seed = 5;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3 * DP_TILE; x++) {
            for (int k = 0; k < 4; k++) colors[y][x][k] = (uint8_t)random_between(&seed, 0, 256);
            distance[y][x] = random_between(&seed, 1, x % 5 ? 1.05f : 3);
            id[y][x] = x % 13 == 2 ? 1 + DP_MIRROR_GROUP : (uint16_t)random_between(&seed, 1, 3);
        }
    for (int k = 0; k < 3; k++) memset(colors[k][DP_TILE + 4], 77, 3 * 4), distance[k][DP_TILE + 5] = 1, id[k][DP_TILE + 5] = 1;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++) distance[y][DP_TILE + 6 + x] = 1, id[y][DP_TILE + 6 + x] = 1;
    dp_smooth_run run = {.color = colors[1][DP_TILE], .out = out[0][0], .id = id[1] + DP_TILE, .distance = distance[1] + DP_TILE,
                         .width = 3 * DP_TILE, .stride = 3 * DP_TILE, .step = 12, .fy = 80, .perspective = true};
    plain->smooth(&run, ~(uint64_t)0);
    uint32_t sum = 0;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++) sum += (uint32_t)(1 + (x == 1)) * (uint32_t)(1 + (y == 1)) * colors[y][DP_TILE + 6 + x][2];
    assert_int_equal(out[0][7][2], (sum + 8) / 16);
    assert_int_equal(out[0][5][2], 77); /* a patch */
    run.out = out[1][0];
    for (uint32_t k = 0, kinds = dp_kernels_list(list); k < kinds; k++) {
        memset(out[1], 0, sizeof out[1]);
        dp_shaders_for(list[k]->lanes)->smooth(&run, ~(uint64_t)0);
        assert_memory_equal(out[0], out[1], sizeof out[0]);
    }
}

static double mean_of(const uint8_t *values, int threshold) {
    int inked = 0;
    for (int i = 0; i < DP_STROKES_SIZE * DP_STROKES_SIZE; i++) inked += values[i] > threshold;
    return (double)inked / (DP_STROKES_SIZE * DP_STROKES_SIZE);
}

/* Built-in strokes: the same every time; the darker the tone the more ink, in small steps. */
static void built_in_strokes_grow_with_darkness(void **state) {
    (void)state;
    static uint8_t values[2][DP_STROKES_SIZE * DP_STROKES_SIZE], again[DP_STROKES_SIZE * DP_STROKES_SIZE];
    dp_make_hatching(values[0]);
    dp_make_halftone(values[1]);
    dp_make_hatching(again);
    assert_memory_equal(values[0], again, sizeof again);
    for (int t = 0; t < 2; t++) {
        double before = 0;
        for (int tone = 250; tone >= 0; tone -= 10) {
            const double ink = mean_of(values[t], tone);
            if (!(ink >= before && ink - before < 0.15)) fail_msg("texture %d, tone %d: %g after %g", t, tone, ink, before);
            before = ink;
        }
        assert_true(before > 0.6);
    }
}

/* ------- pictures ------- */

enum { W = SCENE_WIDTH, H = SCENE_HEIGHT };
typedef uint8_t pixels[H][W][4];

static dp_result draw_batch(const dp_batch *batch, const dp_camera *camera, const dp_style *style, pixels out,
                            uint16_t *ids, dp_diag *diag) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    const dp_target target = {.width = W, .height = H, .rgba = out[0][0], .id = ids};
    const dp_result result = dp_draw(context, source, camera, style, &target, diag);
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

/* Section 5: inner edges first, then profile edges over them, each in its own colour. */
static void profile_edges_lie_over_inner_ones(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 80, 30);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.lines = DP_NO_LINES, .surface = DP_RGB(10, 200, 30),
                            .shade = {.normals = DP_NORMALS_FACET},
                            .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL, .inner = DP_RGB(255, 0, 0), .profile = DP_RGB(0, 0, 255)}};
    assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
    if (p[H / 2][W / 2][0] != 255 || p[H / 2][W / 2][2]) fail_msg("%d %d %d", p[H / 2][W / 2][0], p[H / 2][W / 2][1], p[H / 2][W / 2][2]);
    int top = 0;
    while (p[top][W / 2][2] == 255 && p[top][W / 2][0] == 255) top++; /* paper */
    assert_true(p[top][W / 2][0] == 0 && p[top][W / 2][2] == 255);    /* the fold's end: profile over inner */
    assert_true(p[H / 2][W / 2 + 8][1] == 200);
}

/* A pixel that two surfaces share has a colour between theirs, whichever it is mostly of. */
static void shared_pixels_are_mixed(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    memset(&s, 0, sizeof s);
    const float wall[4][3] = {{-90, -50, -20}, {90, -50, -20}, {90, 50, -20}, {-90, 50, -20}};
    const float tilted[4][3] = {{-40, -21.3f, 10}, {40.5f, -9, 10}, {40.5f, 21, 10}, {-40, 8.7f, 10}};
    scene_polygon(&s, 4, wall);
    scene_polygon(&s, 4, tilted);
    dp_batch batch = scene_batch(&s);
    static const float normals[8][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0.2f}, {0, 1, 0.2f}, {0, 1, 0.2f}, {0, 1, 0.2f}};
    batch.normals = (dp_attribute){.values = normals[0], .count = 8};
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.lines = DP_NO_LINES, .shade = {.shading = DP_SHADING_LAMBERT, .light = {0, 0, 1}}};
    assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
    const int far = 255, near = p[H / 2][W / 2][0];
    int mixed = 0;
    assert_true(near < 130);
    for (int x = W / 2 - 30; x < W / 2 + 30; x++) {
        int between = 0;
        for (int y = 1; y < H - 1; y++) {
            const int c = p[y][x][0];
            if (p[y][x][0] == 255) continue;
            assert_true(c >= near - 1 && c <= far);
            between += c > near + 4 && c < far - 4;
        }
        mixed += between;
        assert_true(between <= 4);
    }
    assert_true(mixed > 40); /* about three of four columns, at both borders */
}

/* Added polygons ink while tiles are found, before these are shaded: their lines lie over the shades all the same. */
static void quads_lie_over_shades(void **state) {
    (void)state;
    static scene s;
    static pixels flat, shaded;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 80, 30);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    for (int look = DP_SHADING_FLAT; look < DP_SHADING_COUNT; look++) {
        const dp_style style = {.ink = DP_INK_QUADS, .line[DP_LINE_RIDGE] = {.width = 4, .color = DP_RGB(0, 90, 0)},
                                .shade = {.shading = (dp_shading)look, .light = {0, 0, 1}}};
        assert_int_equal(draw_batch(&batch, &camera, &style, look ? shaded : flat, NULL, NULL), DP_OK);
        int inked = 0;
        for (int y = 1; look && y < H - 1; y++)
            for (int x = 1; x < W - 1; x++) {
                const bool whole = flat[y][x][0] == 0 && flat[y][x][1] == 90;
                if (whole && memcmp(flat[y][x], shaded[y][x], 4) != 0) fail_msg("%s: (%d, %d)", dp_shading_name((dp_shading)look), x, y);
                inked += whole;
            }
        if (look) assert_true(inked > 100);
    }
}

/* ------- the mirror ------- */

/* A ball of triangles. */
static void add_ball(scene *s, double x, double y, double z, double radius) {
    enum { U = 18, V = 10 };
    float p[V + 1][U + 1][3];
    for (int v = 0; v <= V; v++)
        for (int u = 0; u <= U; u++) {
            const double a = 2 * 3.14159265358979 * (u % U) / U, b = 3.14159265358979 * v / V;
            p[v][u][0] = (float)(x + radius * sin(b) * cos(a)), p[v][u][1] = (float)(y + radius * cos(b));
            p[v][u][2] = (float)(z - radius * sin(b) * sin(a));
        }
    for (int v = 0; v < V; v++)
        for (int u = 0; u < U; u++) {
            float t[3][3];
            memcpy(t[0], p[v][u], sizeof *t), memcpy(t[1], p[v + 1][u], sizeof *t), memcpy(t[2], p[v + 1][u + 1], sizeof *t);
            if (v < V - 1) scene_polygon(s, 3, (const float(*)[3])t);
            memcpy(t[1], p[v + 1][u + 1], sizeof *t), memcpy(t[2], p[v][u + 1], sizeof *t);
            if (v) scene_polygon(s, 3, (const float(*)[3])t);
        }
}

/* A small scene before planes through about x = -20. */
static void make_rooms(scene *s) {
    const float box[2][3] = {{-10, -25, -10}, {25, 5, 20}};
    memset(s, 0, sizeof *s);
    scene_box(s, box[0], box[1]);
    const float sheet[4][3] = {{30, -30, 25}, {60, -30, -20}, {60, 20, -20}, {30, 20, 25}};
    scene_polygon(s, 4, sheet);
}

/* The scene's mirror image, of the same coordinates as the library's: rounded once. Fronts stay fronts. */
static void mirror_scene(scene *s, dp_vec3 n, double offset) {
    for (size_t c = 0; c < s->corners; c++) {
        float *const p = s->positions[c];
        const double twice = 2 * (n.x * p[0] + n.y * p[1] + n.z * p[2] - offset), m[3] = {n.x, n.y, n.z};
        for (int k = 0; k < 3; k++) p[k] = (float)(p[k] - twice * m[k]);
    }
    for (size_t f = 0; f < s->polygons; f++)
        for (uint32_t i = s->firsts[f], k = s->firsts[f + 1] - 1; i < k; i++, k--) {
            float swap[3];
            memcpy(swap, s->positions[i], sizeof swap);
            memcpy(s->positions[i], s->positions[k], sizeof swap);
            memcpy(s->positions[k], swap, sizeof swap);
        }
}

/* The light's image, in the camera's axes. */
static void mirror_light(float light[3], const dp_camera *camera, dp_vec3 n) {
    const double *const v = camera->view, l[3] = {(double)light[0], (double)light[1], (double)light[2]};
    dp_vec3 world = dp_v3(v[0] * l[0] + v[1] * l[1] + v[2] * l[2], v[4] * l[0] + v[5] * l[1] + v[6] * l[2],
                          v[8] * l[0] + v[9] * l[1] + v[10] * l[2]);
    world = dp_mad(world, n, -2 * dp_dot(n, world));
    for (int k = 0; k < 3; k++) light[k] = (float)(v[k] * world.x + v[4 + k] * world.y + v[8 + k] * world.z);
}

/* Inside the mirror, where lines of what stands before it do not reach. */
static void compare_image(const pixels seen, const pixels expected, uint16_t ids[H][W], const char *what, int *drawn) {
    int compared = 0;
    for (int y = 3; y < H - 3; y++)
        for (int x = 3; x < W - 3; x++) {
            bool inside = true;
            for (int i = -3; i <= 3; i++)
                for (int k = -3; k <= 3; k++) inside &= ids[y + i][x + k] == 1 + DP_MIRROR_GROUP;
            if (!inside) continue;
            compared++;
            *drawn += expected[y][x][0] != 255;
            for (int k = 0; k < 4; k++)
                if (abs(seen[y][x][k] - expected[y][x][k]) > 1)
                    fail_msg("%s, (%d, %d): %d instead of %d", what, x, y, seen[y][x][k], expected[y][x][k]);
        }
    assert_true(compared > W * H / 20);
}

/* One look, with lines or the edge map, in a mirror and as the rendering of the mirrored scene. */
static void check_mirror(dp_shading shading, bool edges, const float normal[3], const dp_camera *camera, int *drawn) {
    static scene s, image;
    static pixels seen, expected;
    static uint16_t ids[H][W];
    const double offset = -22;
    const dp_style wanted = {.surface = DP_RGB(200, 150, 90),
                             .lines = edges ? DP_NO_LINES : DP_ALL_LINES,
                             .shade = {.shading = shading, .light = {0, 0.6f, 0.8f}, .highlight = 0.4f},
                             .edge_map = {.detector = edges ? DP_EDGE_MAP_DIAGONAL : DP_EDGE_MAP_OFF},
                             .mirror = {.normal = {normal[0], normal[1], normal[2]}, .offset = (float)offset, .center = {0, -5, 0}, .size = 300}};
    dp_style style;
    assert_int_equal(dp_style_resolve(&wanted, &style, NULL), DP_OK);
    const dp_vec3 n = dp_unit(dp_v3f(style.mirror.normal));
    make_rooms(&s);
    add_ball(&s, 10, 20, -20, 18);
    add_ball(&s, 5, -20, 32, 13);
    image = s;
    mirror_scene(&image, n, offset);
    const dp_batch batch = scene_batch(&s), image_batch = scene_batch(&image);
    assert_int_equal(draw_batch(&batch, camera, &style, seen, ids[0], NULL), DP_OK);
    style.mirror = (dp_mirror){0};
    mirror_light(style.shade.light, camera, n);
    assert_int_equal(draw_batch(&image_batch, camera, &style, expected, NULL, NULL), DP_OK);
    compare_image((const uint8_t(*)[W][4])seen, (const uint8_t(*)[W][4])expected, ids, dp_shading_name(shading), drawn);
}

/* Within a grey level, in every pixel, where shades jump as well. */
static void a_mirror_shows_the_mirrored_scene(void **state) {
    static const float normals[2][3] = {{2, 0, 0}, {1, 0.2f, -0.15f}};
    (void)state;
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++)
        for (int edges = 0; edges < 2; edges++) {
            int drawn = 0;
            if (shading == DP_SHADING_PENCIL) continue; /* strokes are not mirrored: a hand draws them again */
            for (int k = 0; k < 8; k++) {
                const dp_camera camera = scene_camera(70 + 6.85 * k, 20 - 5.5 * k, 90 - 11.5 * k, -15, -5, 0);
                check_mirror((dp_shading)shading, edges, normals[k % 2], &camera, &drawn);
            }
            assert_true(drawn > 400);
        }
}

/* What stands behind the mirror is not in it, and what crosses it is cut. */
static void mirrors_cut_what_they_cross(void **state) {
    (void)state;
    static scene s;
    static pixels seen;
    static uint16_t ids[H][W];
    memset(&s, 0, sizeof s);
    const float box[2][3] = {{-10, -10, -30}, {10, 10, 30}}, behind[2][3] = {{-40, -20, -80}, {40, 20, -60}};
    scene_box(&s, box[0], box[1]);
    scene_box(&s, behind[0], behind[1]);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(60, 40, 120, 0, 0, 0);
    const dp_style style = {.surface = DP_RGB(90, 90, 90), .lines = DP_NO_LINES,
                            .mirror = {.normal = {0, 0, 1}, .size = 200, .tint = DP_RGB(0, 0, 255), .tint_share = 0.5f}};
    assert_int_equal(draw_batch(&batch, &camera, &style, seen, ids[0], NULL), DP_OK);
    int box_px = 0, image_px = 0, paper_px = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            box_px += ids[y][x] == 1;
            image_px += ids[y][x] == 1 + DP_MIRROR_GROUP && seen[y][x][0] < 80;
            paper_px += seen[y][x][0] >= 127 && seen[y][x][0] <= 128 && seen[y][x][2] == 255;
        }
    assert_true(box_px > 300 && image_px > 100 && image_px < box_px); /* the image of 30 units, seen from further away */
    assert_true(paper_px > 1000); /* half tinted */
}

static void bad_mirrors_are_refused(void **state) {
    (void)state;
    static const dp_mirror bad[] = {{.size = 1}, {.normal = {NAN, 0, 1}, .size = 1}, {.normal = {0, 1, 0}, .size = -1},
                                    {.normal = {0, 1, 0}, .size = 1, .fade = -1}, {.normal = {0, 1, 0}, .size = 1, .offset = INFINITY},
                                    {.normal = {0, 1, 0}, .size = 1, .tint_share = 2}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const dp_style style = {.mirror = bad[i]};
        dp_style resolved;
        assert_int_equal(dp_style_resolve(&style, &resolved, NULL), DP_ERR_ARGUMENT);
    }
}

/* Textures of one texel, of odd sizes; strokes on surfaces with and without texture coordinates. */
static void any_texture_will_do(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    make_rooms(&s);
    dp_batch batch = scene_batch(&s);
    static float uv[SCENE_CORNERS][2];
    static uint8_t values[7 * 3] = {255, 0, 128, 3, 77, 200, 1, 90}, shades[5][4] = {{0}, {0, 0, 0, 255}, {9, 9, 9, 9}};
    for (size_t c = 0; c < s.corners; c++) uv[c][0] = c % 7 ? (float)c * 1e3f : NAN, uv[c][1] = -(float)c;
    const dp_camera camera = scene_camera(70, 20, 90, 0, 0, 0);
    for (int with_uv = 0; with_uv < 2; with_uv++)
        for (uint32_t size = 1; size <= 7; size += 6) {
            if (with_uv) batch.texcoords = (dp_attribute){.values = uv[0], .count = s.corners};
            dp_style style = {.shade = {.shading = DP_SHADING_HATCH, .object_space = true, .strokes = {values, size, size == 1 ? 1 : 3}}};
            assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
            style = (dp_style){.shade = {.shading = DP_SHADING_TOON, .shades = {shades[0], size == 1 ? 1 : 5, 1}}};
            assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
        }
    const dp_style empty = {.shade = {.shading = DP_SHADING_HATCH, .strokes = {values, 0, 3}}};
    assert_int_equal(draw_batch(&batch, &camera, &empty, p, NULL, NULL), DP_ERR_ARGUMENT);
}

/* ------- memory ------- */

static int allocations_left;
static void *failing_realloc(void *block, size_t size, void *user) {
    (void)user;
    return allocations_left-- > 0 ? realloc(block, size) : NULL;
}
static void *failing_alloc(size_t size, void *user) { return failing_realloc(NULL, size, user); }
static void failing_free(void *block, void *user) {
    (void)user;
    free(block);
}

/* Whichever allocation fails, the call says so, nothing is lost, and the context can be used again. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    static scene s;
    static pixels p, whole;
    make_rooms(&s);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(70, 20, 90, -15, -5, 0);
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    const dp_context_desc desc = {.allocator = &memory, .threads = 1};
    for (int shading = DP_SHADING_TOON; shading <= DP_SHADING_HATCH; shading++) {
        const dp_style style = {.shade = {.shading = (dp_shading)shading, .object_space = true},
                                .edge_map = {.detector = DP_EDGE_MAP_C1, .eight_bits = true},
                                .mirror = {.normal = {1, 0, 0}, .offset = -20, .size = 300, .fade = 200}};
        const dp_target target = {.width = W, .height = H, .rgba = p[0][0]};
        int refused = 0;
        assert_int_equal(draw_batch(&batch, &camera, &style, whole, NULL, NULL), DP_OK);
        for (int left = 0; left < 400; left++) {
            dp_context *context = NULL;
            dp_source *source = NULL;
            allocations_left = 1000000;
            assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
            assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
            allocations_left = left;
            const dp_result result = dp_draw(context, source, &camera, &style, &target, NULL);
            if (result) {
                refused++;
                assert_int_equal(result, DP_ERR_MEMORY);
                allocations_left = 1000000;
                assert_int_equal(dp_draw(context, source, &camera, &style, &target, NULL), DP_OK);
            }
            assert_memory_equal(p, whole, sizeof p);
            dp_source_destroy(source);
            dp_context_destroy(context);
            if (!result) break;
        }
        assert_true(refused > 20 && refused < 399);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambert_is_the_cosine),
        cmocka_unit_test(gooch_is_cool_to_warm),
        cmocka_unit_test(highlights_lie_where_the_light_is_reflected),
        cmocka_unit_test(toon_looks_up_the_nearest_shade),
        cmocka_unit_test(hatching_is_a_smooth_threshold),
        cmocka_unit_test(wider_vectors_shade_the_same),
        cmocka_unit_test(wider_vectors_smooth_the_same),
        cmocka_unit_test(built_in_strokes_grow_with_darkness),
        cmocka_unit_test(profile_edges_lie_over_inner_ones),
        cmocka_unit_test(shared_pixels_are_mixed),
        cmocka_unit_test(quads_lie_over_shades),
        cmocka_unit_test(a_mirror_shows_the_mirrored_scene),
        cmocka_unit_test(mirrors_cut_what_they_cross),
        cmocka_unit_test(bad_mirrors_are_refused),
        cmocka_unit_test(any_texture_will_do),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
