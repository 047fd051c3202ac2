/* Patterns and light on lines: texture coordinates of added polygons against rays through their planes,
 * how many repeats perspective leaves where, colours in light, and what is refused. */
#include "features/lit.h"
#include "features/mapping.h"
#include "scene.h"
#include "texture/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_close(double a, double b, double tolerance, const char *what) {
    if (!(fabs(a - b) <= tolerance)) fail_msg("%s: %.12g is not %.12g", what, a, b);
}

/* ------- texture coordinates ------- */

enum { SIZE = 400 /* px */ };

typedef struct polygon {
    dp_view view;
    dp_vec3 world[4];
    dp_clip_point clip[4];
    dp_primitive primitive;
} polygon;

static void set_view(dp_view *view, bool perspective) {
    dp_camera camera;
    const double eye[3] = {1, 2, 6}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    assert_int_equal(perspective ? dp_camera_perspective(&camera, 50, 1, 0.1, 100)
                                 : dp_camera_orthographic(&camera, 6, 1, 0.1, 100),
                     DP_OK);
    assert_int_equal(dp_view_init(view, &camera, SIZE, SIZE, NULL), DP_OK);
}

/* A quadrilateral whose first edge leads away from the eye; `front`: or its back. */
static void set_polygon(polygon *p, bool perspective, bool front) {
    static const double corners[4][3] = {
        {-0.4, 0, 3}, {0.9, 0.2, -5}, {1.6, 0.1, -4}, {0.9, -0.1, 3}};
    static const uint32_t turned[4] = {1, 0, 3, 2}; /* the same edge first, run the other way */
    set_view(&p->view, perspective);
    dp_vec3 normal = {0, 0, 0};
    for (int turn = 0; turn < 2; turn++) {
        for (uint32_t i = 0; i < 4; i++) {
            const double *const c = corners[turn ? turned[i] : i];
            p->world[i] = dp_v3(c[0], c[1], c[2]);
        }
        normal =
            dp_unit(dp_cross(dp_sub(p->world[1], p->world[0]), dp_sub(p->world[3], p->world[0])));
        if ((dp_dot(normal, dp_view_vector(&p->view, p->world[0])) < 0) == front) break;
    }
    for (uint32_t i = 0; i < 4; i++) p->clip[i] = dp_to_clip(&p->view, p->world[i]);
    p->primitive = (dp_primitive){.view = &p->view,
                                  .n = 4,
                                  .world = p->world,
                                  .clip = p->clip,
                                  .normal = normal,
                                  .front = front};
}

/* The plane through three points, as normal and offset. */
static dp_vec3 plane_through(const dp_vec3 p[3], double *offset) {
    const dp_vec3 n = dp_unit(dp_cross(dp_sub(p[1], p[0]), dp_sub(p[2], p[0])));
    *offset = dp_dot(n, p[0]);
    return n;
}

/* Where the ray through (x, y) meets the plane. */
static dp_vec3 meet(const dp_view *view, double x, double y, dp_vec3 n, double offset) {
    const dp_vec3 a = dp_unproject(view, (dp_pointd){x, y, view->perspective ? 1 : -1}),
                  b = dp_unproject(view, (dp_pointd){x, y, view->perspective ? 0.5 : -2});
    const dp_vec3 ray = dp_sub(b, a);
    return dp_mad(a, ray, (offset - dp_dot(n, a)) / dp_dot(n, ray));
}

static double to_edge(dp_vec3 p, dp_vec3 a, dp_vec3 e) {
    const dp_vec3 d = dp_sub(p, a);
    return dp_length(dp_mad(d, e, -dp_dot(d, e)));
}

/* Distance of the border beside a point of the edge, s from its start: the border is a line through
 * two points. */
static double border_at(const dp_vec3 border[2], dp_vec3 a, dp_vec3 e, double s) {
    const double s0 = dp_dot(dp_sub(border[0], a), e), s1 = dp_dot(dp_sub(border[1], a), e);
    const double t0 = to_edge(border[0], a, e), t1 = to_edge(border[1], a, e);
    return t0 + (t1 - t0) * (s - s0) / (s1 - s0);
}

/* The outer corners: as printed by the formula, else those of the polygon on the screen. */
static void find_border(const dp_mapped *m, const dp_added *added, dp_vec3 border[2]) {
    const dp_primitive *const p = m->primitive;
    const dp_vec3 e = dp_edge_direction(p, 0), n = p->normal, o = dp_cross(e, n);
    const double c = m->pen.cosine, s = m->pen.sine;
    const bool outline = m->line == DP_LINE_SILHOUETTE;
    const dp_vec3 q = outline ? o : dp_add(dp_scale(n, -s), dp_scale(o, -c));
    const dp_vec3 r = outline ? n : dp_add(dp_scale(n, -c), dp_scale(o, s));
    for (int i = 0; i < 2; i++) {
        if (m->pen.method == DP_METHOD_EXACT)
            border[i] = dp_unproject(p->view, added->points[3 - i]);
        else
            border[i] = dp_paper_offset(p->view, p->world[i], e, q, r, m->pen.reach);
    }
}

static double apart(double a, double b) {
    const double d = fabs(a - b - floor(a - b + 0.5));
    return d;
}

/* Compares the mapping of one added polygon with rays, on a grid of points beside the edge. */
static void check_mapping(const dp_mapped *m, const dp_added *added) {
    const dp_primitive *const p = m->primitive;
    const dp_vec3 a = p->world[0], b = p->world[1], e = dp_edge_direction(p, 0);
    const double length = dp_length(dp_sub(b, a)), repeats = floor(length / m->length + 0.5);
    dp_vec3 corners[3], border[2];
    double offset;
    find_border(m, added, border);
    corners[0] = a, corners[1] = b, corners[2] = border[0];
    const dp_vec3 n = plane_through(corners, &offset);
    dp_mapping mapping;
    dp_mapping_make(m, &mapping);
    for (int i = 1; i < 10; i++)
        for (int k = 1; k < 5; k++) {
            const double t = i / 10.0, v = k / 5.0;
            const dp_vec3 inner = dp_mix(a, b, t), outer = dp_mix(border[0], border[1], t);
            const dp_clip_point c = dp_to_clip(p->view, dp_mix(inner, outer, v));
            const dp_pointd screen = dp_to_screen(p->view, c);
            const double x = screen.x, y = screen.y;
            const dp_vec3 at = meet(p->view, x, y, n, offset);
            const double s = dp_dot(dp_sub(at, a), e),
                         across = to_edge(at, a, e) / border_at(border, a, e, s);
            const double u = a.x < b.x ? s / length * repeats : (1 - s / length) * repeats;
            const double half = m->whole ? across : a.x < b.x ? 0.5 + across / 2 : 0.5 - across / 2;
            const dp_mapped_point found = dp_mapping_at(&mapping, x, y);
            if (apart(found.u, u) > 1e-6)
                fail_msg("line %d, method %d: u %g, not %g", (int)m->line, (int)m->pen.method,
                         found.u, u);
            assert_close(found.v, half, 1e-6, "v");
            const double h = 1e-4;
            const dp_mapped_point right = dp_mapping_at(&mapping, x + h, y),
                                  below = dp_mapping_at(&mapping, x, y + h);
            assert_close(found.du, dp_hypot(apart(right.u, found.u), apart(below.u, found.u)) / h,
                         1e-3 * found.du, "du");
            assert_close(found.dv, dp_hypot(right.v - found.v, below.v - found.v) / h,
                         1e-3 * found.dv, "dv");
        }
}

static void texture_coordinates_are_those_of_rays(void **state) {
    (void)state;
    for (int perspective = 0; perspective < 2; perspective++)
        for (int line = DP_LINE_SILHOUETTE; line <= DP_LINE_VALLEY; line++)
            for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
                polygon p;
                dp_added added[DP_ADDED_MOST];
                dp_primitive_shader *const shade = line == DP_LINE_SILHOUETTE ? dp_shade_silhouette
                                                   : line == DP_LINE_RIDGE    ? dp_shade_ridge
                                                                              : dp_shade_valley;
                set_polygon(&p, perspective, line != DP_LINE_SILHOUETTE);
                const dp_mapped m = {
                    .primitive = &p.primitive,
                    .line = (dp_line)line,
                    .pen = dp_pen_make((dp_method)method, 9, line == DP_LINE_VALLEY ? 200 : 150),
                    .whole = line == DP_LINE_SILHOUETTE,
                    .length = 0.7};
                assert_true(shade(&p.primitive, 0, &m.pen, added) > 0);
                dp_mapped own = m;
                own.d0 = added[0].d0, own.dx = added[0].dx, own.dy = added[0].dy;
                check_mapping(&own, &added[0]);
            }
}

/* Both polygons of an edge run along it in opposite ways, and agree. */
static void both_sides_of_an_edge_agree(void **state) {
    (void)state;
    for (double length = 0.5; length < 40; length *= 2) {
        polygon a, b;
        dp_mapping of[2];
        set_polygon(&a, true, true);
        b = a;
        const int order[4] = {1, 0, 3, 2};
        for (int i = 0; i < 4; i++) b.world[i] = a.world[order[i]], b.clip[i] = a.clip[order[i]];
        b.primitive.view = &b.view, b.primitive.world = b.world, b.primitive.clip = b.clip;
        b.primitive.normal = dp_scale(a.primitive.normal, -1);
        polygon *const both[2] = {&a, &b};
        dp_screen_edge e;
        for (int i = 0; i < 2; i++) {
            dp_added added[DP_ADDED_MOST];
            both[i]->primitive.front = true;
            dp_mapped m = {.primitive = &both[i]->primitive,
                           .line = DP_LINE_RIDGE,
                           .pen = dp_pen_make(DP_METHOD_EXACT, 9, 150),
                           .length = length};
            assert_true(dp_screen_edge_make(m.primitive, 0, &e));
            dp_screen_quad(&e, 9, 0, &added[0]);
            m.d0 = added[0].d0, m.dx = added[0].dx, m.dy = added[0].dy;
            dp_mapping_make(&m, &of[i]);
        }
        for (int i = 0; i <= 10; i++) {
            const double x = e.a.x + (e.b.x - e.a.x) * i / 10, y = e.a.y + (e.b.y - e.a.y) * i / 10;
            const dp_mapped_point p = dp_mapping_at(&of[0], x, y), q = dp_mapping_at(&of[1], x, y);
            assert_close(apart(p.u, q.u), 0, 1e-9, "u on the edge");
            assert_close(p.v, 0.5, 1e-9, "v on the edge");
            assert_close(q.v, 0.5, 1e-9, "v on the edge");
        }
    }
}

/* ------- perspective ------- */

enum { W = 640, H = 480 };
static uint8_t rgba[W * H * 4];

/* A long beam that leads away from the eye; its upper right edge is in sight. */
static dp_camera set_beam(scene *s) {
    dp_camera camera;
    scene_box(s, (const float[3]){-4, -1, -40}, (const float[3]){0, 0, -2});
    dp_camera_look_at(&camera, (const double[3]){1.5, 1.5, 1}, (const double[3]){0, 0, -6},
                      (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 50, (double)W / H, 0.1, 200);
    return camera;
}

static void draw_beam(const dp_style *style, dp_camera *camera, uint32_t threads) {
    static scene s;
    dp_context *context;
    dp_source *source;
    dp_diag diag = {0};
    memset(&s, 0, sizeof s);
    *camera = set_beam(&s);
    const dp_batch batch = scene_batch(&s);
    const dp_target target = {.width = W, .height = H, .samples = 16, .rgba = rgba};
    assert_int_equal(dp_context_create(&(dp_context_desc){.threads = threads}, &context, NULL),
                     DP_OK);
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    if (dp_draw(context, source, camera, style, &target, &diag)) fail_msg("%s", diag.message);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

/* Ink beside the edge at z, 2 px from it, in a square of 3 px. */
static double ink_beside(const dp_camera *camera, double z) {
    dp_view view;
    dp_view_init(&view, camera, W, H, NULL);
    const dp_pointd p = dp_to_screen(&view, dp_to_clip(&view, dp_v3(0, 0, z))),
                    far = dp_to_screen(&view, dp_to_clip(&view, dp_v3(0, 0, z - 0.01)));
    const double x = far.x - p.x, y = far.y - p.y, length = dp_hypot(x, y);
    const int px = (int)(p.x - y / length * 2), py = (int)(p.y + x / length * 2);
    double sum = 0;
    assert_true(px >= 1 && py >= 1 && px + 1 < W && py + 1 < H);
    for (int i = -1; i <= 1; i++)
        for (int k = -1; k <= 1; k++) sum += 1 - rgba[4 * ((py + i) * W + px + k)] / 255.0;
    return sum / 9;
}

static dp_texture *checker(uint32_t width, uint32_t height) {
    uint8_t *const pixels = malloc((size_t)width * height);
    dp_texture *texture = NULL;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) pixels[y * width + x] = x < width / 2 ? 0 : 255;
    assert_int_equal(
        dp_texture_create(
            &(dp_texture_desc){.pixels = pixels, .width = width, .height = height, .channels = 1},
            &texture, NULL),
        DP_OK);
    free(pixels);
    return texture;
}

static double px_between(const dp_camera *camera, double z0, double z1) {
    dp_view view;
    dp_view_init(&view, camera, W, H, NULL);
    const dp_pointd p = dp_to_screen(&view, dp_to_clip(&view, dp_v3(0, 0, z0))),
                    q = dp_to_screen(&view, dp_to_clip(&view, dp_v3(0, 0, z1)));
    return dp_hypot(p.x - q.x, p.y - q.y);
}

/* Counts changes between ink and paper; greys between them are neither. */
typedef struct changes {
    int count, last; /* 1: paper, 2: ink */
} changes;

static bool add_change(changes *c, double ink) {
    const int now = ink > 0.7 ? 2 : ink < 0.3 ? 1 : c->last;
    const bool changed = c->last && now != c->last;
    c->last = now;
    c->count += changed;
    return changed;
}

/* From z = -2 to -40 there are 19 repeats of 2 units: as many changes lie where they must. */
static void repeats_stick_to_the_model(void **state) {
    (void)state;
    dp_texture *const texture = checker(64, 16);
    for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++) {
        const dp_style style = {.ink = (dp_ink)ink,
                                .lines = DP_RIDGE,
                                .line = {[DP_LINE_RIDGE] = {.width = 9}},
                                .pattern = {.texture = texture, .world_length = 2}};
        dp_camera camera;
        draw_beam(&style, &camera, 1);
        changes found = {0};
        double from = 0;
        for (double z = -3; z > -14; z -= 0.004) {
            if (!add_change(&found, ink_beside(&camera, z))) continue;
            /* as quads its edge has its own 19 repeats; as strokes it is part of a chain */
            if (ink == DP_INK_QUADS)
                assert_close(px_between(&camera, z, floor(z + 0.5)), 0, 1.6, "a change");
            if (from < 0) assert_close(px_between(&camera, from - 1, z), 0, 2.5, "half a repeat");
            from = z;
        }
        assert_true(found.count >= 10);
    }
    dp_texture_destroy(texture);
}

/* Where a repeat is far smaller than a pixel, the pattern is an even grey. */
static void far_repeats_are_an_even_tone(void **state) {
    (void)state;
    dp_texture *const texture = checker(64, 16);
    for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++) {
        const dp_style style = {.ink = (dp_ink)ink,
                                .lines = DP_RIDGE,
                                .line = {[DP_LINE_RIDGE] = {.width = 9}},
                                .pattern = {.texture = texture, .world_length = 0.02f}};
        dp_camera camera;
        draw_beam(&style, &camera, 1);
        for (double z = -8; z > -36; z -= 0.31)
            assert_close(ink_beside(&camera, z), 0.5, 0.04, "far ink");
    }
    dp_texture_destroy(texture);
}

/* On the screen all repeats are alike: as many changes in its near half as in its far one. */
static void repeats_may_be_even_on_the_screen(void **state) {
    (void)state;
    dp_texture *const texture = checker(64, 16);
    for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++) {
        const dp_style style = {.ink = (dp_ink)ink,
                                .lines = DP_RIDGE,
                                .line = {[DP_LINE_RIDGE] = {.width = 9}},
                                .pattern = {.texture = texture, .length = 24, .screen = true}};
        dp_camera camera;
        dp_view view;
        draw_beam(&style, &camera, 1);
        dp_view_init(&view, &camera, W, H, NULL);
        changes found = {0};
        dp_pointd from = {0, 0, 0};
        double least = 1e9, most = 0;
        for (double z = -3; z > -30; z -= 0.004) {
            const dp_pointd p = dp_to_screen(&view, dp_to_clip(&view, dp_v3(0, 0, z)));
            if (!add_change(&found, ink_beside(&camera, z))) continue;
            const double apart_px = dp_hypot(p.x - from.x, p.y - from.y);
            if (found.count > 1) least = fmin(least, apart_px), most = fmax(most, apart_px);
            from = p;
        }
        assert_true(found.count > 6);
        if (!(least > 10 && most < 14)) fail_msg("half repeats of %g to %g px", least, most);
    }
    dp_texture_destroy(texture);
}

static void threads_change_nothing(void **state) {
    (void)state;
    static uint8_t first[sizeof rgba];
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("rope", 0, NULL, &texture, NULL), DP_OK);
    for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++)
        for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++)
            for (uint32_t threads = 1; threads <= 7; threads += 3) {
                const dp_style style = {.ink = (dp_ink)ink,
                                        .between = (dp_between)between,
                                        .line = {{.width = 14}, {.width = 14}, {.width = 14}},
                                        .pattern = {.texture = texture},
                                        .line_light = {.lighting = DP_LINE_LIGHT_LAMBERT}};
                dp_camera camera;
                draw_beam(&style, &camera, threads);
                if (threads == 1) memcpy(first, rgba, sizeof rgba);
                assert_memory_equal(first, rgba, sizeof rgba);
            }
    dp_texture_destroy(texture);
}

/* ------- filtering ------- */

static void a_wide_box_is_the_mean(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{64, 16}, {64, 1}, {16, 64}, {2, 2}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        dp_texture *const t = checker(sizes[i][0], sizes[i][1]);
        for (float u = -3; u < 3; u += 0.37f) {
            assert_close((double)dp_texture_filtered(t, u, 0.5f, 40, 0.2f).ink, 0.5, 0.01, "wide");
            assert_close((double)dp_texture_filtered(t, u, 0.3f, 1e30f, 1e30f).ink, 0.5, 0.01,
                         "endless");
        }
        assert_true(dp_texture_filtered(t, 0.25f, 0.5f, 0.001f, 0.001f).ink > 0.99f);
        assert_true(dp_texture_filtered(t, 0.75f, 0.5f, 0, 0).ink < 0.01f);
        dp_texture_destroy(t);
    }
    const uint8_t one = 0;
    dp_texture *dot = NULL;
    assert_int_equal(
        dp_texture_create(
            &(dp_texture_desc){.pixels = &one, .width = 1, .height = 1, .channels = 1}, &dot, NULL),
        DP_OK);
    assert_true(dp_texture_filtered(dot, 7.3f, 0.4f, 2, 3).ink > 0.999f);
    dp_texture_destroy(dot);
}

/* ------- light ------- */

static dp_style lit_style(dp_line_lighting lighting) {
    dp_style style;
    const dp_style wanted = {.line_light = {.lighting = lighting, .lit = DP_RGB(255, 0, 128)}};
    assert_int_equal(dp_style_resolve(&wanted, &style, NULL), DP_OK);
    return style;
}

static void known_normals_have_known_tones(void **state) {
    (void)state;
    const dp_color black = DP_RGB(0, 0, 0);
    const dp_style lambert = lit_style(DP_LINE_LIGHT_LAMBERT), toon = lit_style(DP_LINE_LIGHT_TOON),
                   gooch = lit_style(DP_LINE_LIGHT_GOOCH);
    assert_int_equal(dp_lit_color(&lambert, black, 1), DP_RGB(255, 0, 128));
    assert_int_equal(dp_lit_color(&lambert, black, 0.5), DP_RGB(128, 0, 64));
    assert_int_equal(dp_lit_color(&lambert, black, 0), black);
    assert_int_equal(dp_lit_color(&lambert, black, -1), black);
    assert_int_equal(dp_lit_color(&lambert, 0x00000040u, 1), 0xff008040u);
    assert_int_equal(dp_lit_color(&toon, black, 0.9), DP_RGB(255, 0, 128));
    assert_int_equal(dp_lit_color(&toon, black, 0.1), DP_RGB(128, 0, 64));
    assert_int_equal(dp_lit_color(&toon, black, -0.9), black);
    assert_int_equal(dp_lit_color(&gooch, black, 1), DP_RGB(102, 102, 0));
    assert_int_equal(dp_lit_color(&gooch, black, -1), DP_RGB(0, 0, 102));
    assert_int_equal(dp_lit_color(&gooch, DP_RGB(255, 255, 255), 1), DP_RGB(255, 255, 153));
    dp_style usual;
    assert_int_equal(
        dp_style_resolve(&(dp_style){.line_light = {.lighting = DP_LINE_LIGHT_LAMBERT}}, &usual,
                         NULL),
        DP_OK);
    assert_int_equal(dp_lit_color(&usual, black, 1), DP_RGB(204, 204, 204));
}

/* Two halves of a roof's ridge: the light comes from the left, so the left half, whose quad's normal
 * points left, is pale and the right one is not. */
static void a_ridge_has_a_lit_side(void **state) {
    (void)state;
    static scene s;
    static picture p;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 90, 40);
    dp_context *context;
    assert_int_equal(dp_context_create(&(dp_context_desc){.threads = 1}, &context, NULL), DP_OK);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.ink = DP_INK_QUADS,
                            .lines = DP_RIDGE,
                            .line = {[DP_LINE_RIDGE] = {.width = 12}},
                            .shade = {.light = {-1, 0, 0.2f}},
                            .line_light = {.lighting = DP_LINE_LIGHT_LAMBERT}};
    assert_int_equal(scene_draw(context, &s, &camera, &style, &p, NULL), DP_OK);
    const double left = scene_ink(&p, -5, -3, -1, 3) / 24, right = scene_ink(&p, 1, -3, 5, 3) / 24;
    if (!(left < 0.8 && left > 0.1 && right > 0.95)) fail_msg("left %g, right %g", left, right);
    dp_context_destroy(context);
}

static void light_turns_with_the_camera(void **state) {
    (void)state;
    dp_view view;
    set_view(&view, true);
    dp_style style = lit_style(DP_LINE_LIGHT_LAMBERT);
    memcpy(style.shade.light, (const float[3]){0, 0, 1}, sizeof style.shade.light);
    assert_close(dp_dot(dp_light_direction(&view, &style), view.forward), -1, 1e-9, "from the eye");
    memcpy(style.shade.light, (const float[3]){1, 0, 0}, sizeof style.shade.light);
    const dp_vec3 right = dp_light_direction(&view, &style);
    assert_close(dp_dot(right, dp_unit(dp_cross(view.forward, dp_v3(0, 1, 0)))), 1, 1e-9,
                 "from the right");
    memcpy(style.shade.light, (const float[3]){0, 1, 0}, sizeof style.shade.light);
    assert_true(dp_light_direction(&view, &style).y > 0.8);
}

/* ------- what is refused, and memory ------- */

static void what_makes_no_sense_is_refused(void **state) {
    (void)state;
    dp_texture *const texture = checker(8, 8), *const other = checker(4, 4);
    const dp_style bad[] = {
        {.pattern = {.length = -1}},
        {.pattern = {.length = 0.5f}},
        {.pattern = {.length = NAN}},
        {.pattern = {.world_length = -2}},
        {.pattern = {.world_length = INFINITY}},
        {.pattern = {.texture = texture}, .edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS},
        {.pattern = {.texture = texture}, .stroke = {.texture = other}},
        {.stroke = {.texture = texture, .u = DP_STROKE_WORLD}, .ink = DP_INK_QUADS},
        {.line_light = {.lighting = (dp_line_lighting)4}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_style out;
        dp_diag diag = {0};
        assert_int_equal(dp_style_resolve(&bad[i], &out, &diag), DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
    }
    dp_style once, twice;
    const dp_style good = {.pattern = {.texture = texture}, .edges = DP_EDGES_ADJACENCY};
    assert_int_equal(dp_style_resolve(&good, &once, NULL), DP_OK);
    assert_int_equal(dp_style_resolve(&once, &twice, NULL), DP_OK);
    assert_true(twice.stroke.texture == texture && twice.stroke.u == DP_STROKE_WORLD);
    const dp_style all = {.pattern = {.texture = texture, .length = 30, .screen = true},
                          .line_light = {.lighting = DP_LINE_LIGHT_TOON},
                          .section = DP_RGB(1, 2, 3),
                          .xray = 0.4f};
    assert_int_equal(dp_style_resolve(&all, &once, NULL), DP_OK);
    assert_int_equal(dp_style_resolve(&once, &twice, NULL), DP_OK);
    assert_memory_equal(&once.pattern, &twice.pattern, sizeof once.pattern);
    assert_memory_equal(&once.line_light, &twice.line_light, sizeof once.line_light);
    assert_memory_equal(&once.stroke, &twice.stroke, sizeof once.stroke);
    assert_true(twice.xray == 0.4f && twice.xray_layers == DP_LEVELS &&
                twice.section == all.section);
    dp_texture_destroy(texture);
    dp_texture_destroy(other);
}

typedef struct ration {
    int left;
} ration;
static void *give(size_t size, void *user) {
    return ((ration *)user)->left-- > 0 ? malloc(size) : NULL;
}
static void *give_again(void *block, size_t size, void *user) {
    return ((ration *)user)->left-- > 0 ? realloc(block, size) : NULL;
}
static void take(void *block, void *user) {
    (void)user;
    free(block);
}

static dp_result draw_rationed(const dp_style *style, int n) {
    static scene s;
    static picture p;
    ration r = {n};
    const dp_allocator allocator = {give, give_again, take, &r};
    const dp_camera camera = scene_flat_camera();
    dp_context *context = NULL;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 90, 40);
    dp_result result = dp_context_create(&(dp_context_desc){.allocator = &allocator, .threads = 1},
                                         &context, NULL);
    if (!result) result = scene_draw(context, &s, &camera, style, &p, NULL);
    dp_context_destroy(context);
    return result;
}

static void memory_may_run_out(void **state) {
    (void)state;
    dp_texture *const texture = checker(64, 16);
    for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++)
        for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++) {
            const dp_style style = {.ink = (dp_ink)ink,
                                    .between = (dp_between)between,
                                    .pattern = {.texture = texture},
                                    .line_light = {.lighting = DP_LINE_LIGHT_TOON}};
            dp_result result = DP_ERR_MEMORY;
            for (int n = 0; result; n += n < 60 ? 1 : 1 + n / 16) {
                result = draw_rationed(&style, n);
                assert_true(result == DP_OK || result == DP_ERR_MEMORY);
                assert_true(n < 100000);
            }
        }
    dp_texture_destroy(texture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texture_coordinates_are_those_of_rays),
        cmocka_unit_test(both_sides_of_an_edge_agree),
        cmocka_unit_test(repeats_stick_to_the_model),
        cmocka_unit_test(far_repeats_are_an_even_tone),
        cmocka_unit_test(repeats_may_be_even_on_the_screen),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_wide_box_is_the_mean),
        cmocka_unit_test(known_normals_have_known_tones),
        cmocka_unit_test(a_ridge_has_a_lit_side),
        cmocka_unit_test(light_turns_with_the_camera),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
