/* mesh/clip: models cut open. Faces are compared with what is known of the solid: areas, and random
 * points that must be covered once where they lie inside and never elsewhere.
 *
 * Above 600 lines: all tests read sections by the same reader and measures, which are a quarter of it. How
 * sections are drawn is in test_section_draw.c. */
#include "base/hostile.h"
#include "base/vec.h"
#include "mesh/source.h"
#include "scene.h"
#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = DP_TUNED(60000, 60000) };

/* What a clipped source has handed out, in world space. */
typedef struct read_polygon {
    dp_vec3 at[3];
    uint8_t flag[3];
    uint16_t group;
} read_polygon;

typedef struct reading {
    read_polygon of[MOST];
    size_t count;
} reading;

static reading first, again;

static dp_vec3 corner_at(const dp_batch *b, size_t corner) {
    const uint32_t v = b->indices ? b->indices[corner] : (uint32_t)corner;
    assert_true(v < b->vertex_count);
    const float *const p =
        (const float *)(const void *)((const char *)b->positions + v * b->position_stride);
    return dp_v3(b->origin[0] + (double)p[0], b->origin[1] + (double)p[1],
                 b->origin[2] + (double)p[2]);
}

/* Polygons of more corners are read as fans. */
static void read_polygons(const dp_batch *b, reading *to) {
    for (size_t i = 0; i < b->polygon_count; i++) {
        const size_t from = b->firsts ? b->firsts[i] : 3 * i,
                     n = b->firsts ? b->firsts[i + 1] - from : 3;
        for (size_t k = 1; k + 1 < n; k++) {
            const size_t c[3] = {from, from + k, from + k + 1};
            assert_true(to->count < MOST);
            read_polygon *const p = &to->of[to->count++];
            p->group = b->groups ? b->groups[i] : 0;
            for (int j = 0; j < 3; j++) {
                p->at[j] = corner_at(b, c[j]);
                p->flag[j] = b->edge_flags ? b->edge_flags[c[j]] : 1;
            }
        }
    }
}

static dp_result read_source(dp_source *source, reading *to, dp_diag *diag) {
    dp_batch batch;
    to->count = 0;
    for (;;) {
        const dp_result result = dp_source_next(source, &batch, diag);
        if (result || !batch.polygon_count) return result;
        read_polygons(&batch, to);
    }
}

static dp_source *clipped(dp_source *inner, const dp_clip *clip) {
    dp_source *out;
    dp_diag diag = {0};
    if (dp_source_clip(inner, clip, NULL, &out, &diag)) fail_msg("%s", diag.message);
    return out;
}

/* Reads what a plane leaves of a source twice, which must be the same; destroys the source. */
static void read_clipped(dp_source *inner, const dp_clip *clip) {
    dp_source *const source = clipped(inner, clip);
    dp_diag diag = {0};
    if (read_source(source, &first, &diag)) fail_msg("%s", diag.message);
    assert_int_equal(dp_source_rewind(source, &diag), DP_OK);
    assert_int_equal(read_source(source, &again, &diag), DP_OK);
    assert_int_equal(first.count, again.count);
    for (size_t i = 0; i < first.count; i++) {
        assert_memory_equal(first.of[i].at, again.of[i].at, sizeof first.of[i].at);
        assert_memory_equal(first.of[i].flag, again.of[i].flag, 3);
        assert_int_equal(first.of[i].group, again.of[i].group);
    }
    dp_source_destroy(source);
}

/* ------- what was read ------- */

static double area_of(const read_polygon *p) {
    return dp_length(dp_cross(dp_sub(p->at[1], p->at[0]), dp_sub(p->at[2], p->at[0]))) / 2;
}

enum { ANY_GROUP = -1 };

static bool lies_on(const read_polygon *p, dp_vec3 normal, double offset) {
    bool on = true;
    for (int k = 0; k < 3; k++) on &= fabs(dp_dot(p->at[k], normal) - offset) < 1e-5;
    return on;
}

/* The area of a plane's section faces, all of which must look along its normal. */
static double face_area(int group, dp_vec3 normal, double offset) {
    double sum = 0;
    for (size_t i = 0; i < first.count; i++) {
        const read_polygon *const p = &first.of[i];
        if (p->flag[0] != DP_EDGE_FACE || (group >= 0 && p->group != group)) continue;
        if (!lies_on(p, normal, offset)) continue;
        const dp_vec3 n = dp_cross(dp_sub(p->at[1], p->at[0]), dp_sub(p->at[2], p->at[0]));
        assert_true(dp_dot(n, normal) >= -1e-9);
        sum += area_of(p);
    }
    return sum;
}

static double line_length(int group, dp_edge_kind flag) {
    double sum = 0;
    for (size_t i = 0; i < first.count; i++)
        if (first.of[i].flag[0] == flag && (group < 0 || first.of[i].group == group))
            sum += dp_length(dp_sub(first.of[i].at[1], first.of[i].at[0]));
    return sum;
}

static void near(double value, double expected, double share) {
    if (!(fabs(value - expected) <= share * fabs(expected)))
        fail_msg("%.9g, expected %.9g", value, expected);
}

/* How many section faces cover a point of a plane at right angles to z. */
static int faces_over(double x, double y, int group) {
    int count = 0;
    for (size_t i = 0; i < first.count; i++) {
        const read_polygon *const p = &first.of[i];
        bool inside = p->flag[0] == DP_EDGE_FACE && (group < 0 || p->group == group);
        for (int k = 0; k < 3 && inside; k++) {
            const dp_vec3 a = p->at[k], b = p->at[(k + 1) % 3];
            inside = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0;
        }
        count += inside;
    }
    return count;
}

static uint32_t seed;
static double chance(void) {
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) / (double)(1 << 24);
}

/* ------- models ------- */

static const dp_clip half_z = {.planes = {{{0, 0, 1}, 0}}, .plane_count = 1};

static dp_source *source_of(const scene *s) {
    dp_source *source;
    const dp_batch batch = scene_batch(s);
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

static scene shown;
static scene *new_scene(void) {
    memset(&shown, 0, sizeof shown);
    return &shown;
}

static void box(scene *s, double x0, double y0, double z0, double x1, double y1, double z1) {
    const float min[3] = {(float)x0, (float)y0, (float)z0},
                max[3] = {(float)x1, (float)y1, (float)z1};
    scene_box(s, min, max);
}

/* Turns the corners of polygons from number `from` on round. */
static void turn(scene *s, size_t from, size_t to) {
    for (size_t i = from; i < to; i++)
        for (uint32_t a = s->firsts[i], b = s->firsts[i + 1] - 1; a < b; a++, b--) {
            float swap[3];
            memcpy(swap, s->positions[a], sizeof swap);
            memcpy(s->positions[a], s->positions[b], sizeof swap);
            memcpy(s->positions[b], swap, sizeof swap);
        }
}

static dp_source *shape(const char *name, uint64_t triangles) {
    dp_source *source;
    const dp_shape desc = {.name = name, .triangles = triangles};
    assert_int_equal(dp_source_from_shape(&desc, &source, NULL), DP_OK);
    return source;
}

/* ------- tests ------- */

static void a_cube_is_closed(void **state) {
    (void)state;
    const dp_vec3 z = {0, 0, 1};
    box(new_scene(), -1, -2, -3, 1, 2, 3);
    read_clipped(source_of(&shown), &half_z);
    near(face_area(ANY_GROUP, z, 0), 8, 1e-6);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 12, 1e-6);
    for (size_t i = 0; i < first.count; i++)
        for (int k = 0; k < 3; k++) assert_true(first.of[i].at[k].z <= 0);
    /* a corner: a triangle with sides of sqrt 2 */
    const double r = 1 / sqrt(3);
    const dp_clip corner = {.planes = {{{2, 2, 2}, 2 * r}}, .plane_count = 1};
    box(new_scene(), -3, -3, -3, 1, 1, 1);
    read_clipped(source_of(&shown), &corner);
    near(face_area(ANY_GROUP, dp_v3(r, r, r), 2 * r), sqrt(3) / 2, 1e-5);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 3 * sqrt(2), 1e-5);
}

static void several_planes_meet(void **state) {
    (void)state;
    const dp_clip clip = {.planes = {{{0, 0, 1}, 0}, {{1, 0, 0}, 0.5}, {{0, -3, 0}, 1}},
                          .plane_count = 3};
    box(new_scene(), -1, -2, -3, 1, 2, 3);
    read_clipped(source_of(&shown), &clip);
    near(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0), 1.5 * 3, 1e-6);
    near(face_area(ANY_GROUP, dp_v3(1, 0, 0), 0.5), 3 * 3, 1e-6);
    near(face_area(ANY_GROUP, dp_v3(0, -1, 0), 1), 1.5 * 3, 1e-6);
    /* the outlines of three rectangles, of which three edges are shared by two */
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), (9 + 12 + 9) - (3 + 3 + 1.5), 1e-6);
}

static void a_torus_has_two_discs(void **state) {
    (void)state;
    const dp_clip clip = {.planes = {{{1, 0, 0}, 0.0123}}, .plane_count = 1};
    read_clipped(shape("torus", 20000), &clip);
    dp_extent e;
    dp_source *const whole = shape("torus", 20000);
    assert_int_equal(dp_source_extent(whole, &e, NULL), DP_OK);
    dp_source_destroy(whole);
    const double r = (e.exact_max[1] - e.exact_min[1]) / 2; /* of the tube */
    near(face_area(ANY_GROUP, dp_v3(1, 0, 0), 0.0123), 2 * 3.14159265 * r * r, 0.01);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 4 * 3.14159265 * r, 0.005);
}

/* A cavity is wound the other way; where boxes overlap they are one; one that is turned inside out is
 * filled as well. */
static void windings_are_counted(void **state) {
    (void)state;
    const dp_vec3 z = {0, 0, 1};
    scene *const s = new_scene();
    box(s, -3, -3, -1, 3, 3, 1);
    const size_t cavity = s->polygons;
    box(s, -1, -1, -0.5, 1, 1, 0.5);
    turn(s, cavity, s->polygons);
    read_clipped(source_of(s), &half_z);
    near(face_area(ANY_GROUP, z, 0), 36 - 4, 1e-6);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 24 + 8, 1e-6);
    assert_int_equal(faces_over(0.1, 0.2, ANY_GROUP), 0);
    box(new_scene(), 0, 0, -1, 2, 2, 1);
    box(s, 1, 1, -1, 3, 3, 1);
    read_clipped(source_of(s), &half_z);
    near(face_area(ANY_GROUP, z, 0), 7, 1e-6);
    box(new_scene(), 0, 0, -1, 2, 2, 1);
    turn(s, 0, s->polygons);
    read_clipped(source_of(s), &half_z);
    near(face_area(ANY_GROUP, z, 0), 4, 1e-6);
}

/* Polygons that are turned one by one. */
static void a_turned_polygon_does_no_harm(void **state) {
    (void)state;
    for (size_t k = 0; k < 6; k++) {
        box(new_scene(), -1, -1, -1, 1, 1, 1);
        turn(&shown, k, k + 1);
        read_clipped(source_of(&shown), &half_z);
        near(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0), 4, 1e-6);
    }
}

/* Neighbours of two groups: each has its own face and outline, also where they touch. */
static void parts_keep_their_outlines(void **state) {
    (void)state;
    static const uint16_t groups[] = {3, 3, 3, 3, 3, 3, 7, 7, 7, 7, 7, 7};
    const dp_vec3 z = {0, 0, 1};
    box(new_scene(), 0, 0, -1, 2, 2, 1);
    box(&shown, 2, 0, -1, 3, 2, 1);
    dp_batch batch = scene_batch(&shown);
    batch.groups = groups;
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    read_clipped(source, &half_z);
    near(face_area(3, z, 0), 4, 1e-6);
    near(face_area(7, z, 0), 2, 1e-6);
    near(line_length(3, DP_EDGE_SECTION), 8, 1e-6);
    near(line_length(7, DP_EDGE_SECTION), 6, 1e-6);
    /* hatched at right angles */
    dp_vec3 along[2] = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < first.count; i++)
        if (first.of[i].flag[0] == DP_EDGE_HATCHING)
            along[first.of[i].group == 7] = dp_unit(dp_sub(first.of[i].at[1], first.of[i].at[0]));
    assert_true(fabs(dp_dot(along[0], along[1])) < 1e-4);
    near(dp_length(along[0]), 1, 1e-6);
    near(dp_length(along[1]), 1, 1e-6);
}

static void a_sheet_is_a_line(void **state) {
    (void)state;
    const float sheet[4][3] = {{-2, 0, -1}, {2, 0, -1}, {2, 0, 1}, {-2, 0, 1}};
    scene_polygon(new_scene(), 4, sheet);
    read_clipped(source_of(&shown), &half_z);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 4, 1e-6);
    assert_true(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0) == 0);
    assert_true(line_length(ANY_GROUP, DP_EDGE_HATCHING) == 0);
    /* half a pipe is open too */
    scene *const s = new_scene();
    for (int k = 0; k < 20; k++) {
        const float a = (float)cos(k * 0.15), b = (float)sin(k * 0.15),
                    c = (float)cos((k + 1) * 0.15), d = (float)sin((k + 1) * 0.15);
        const float part[4][3] = {{a, b, -1}, {c, d, -1}, {c, d, 1}, {a, b, 1}};
        scene_polygon(s, 4, part);
    }
    read_clipped(source_of(s), &half_z);
    assert_true(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0) == 0);
}

/* A box with a slit along it, as meshes have that are not watertight. */
static void small_gaps_are_closed(void **state) {
    (void)state;
    const float walls[4][4][3] = {{{0, 0, -1}, {4, 0, -1}, {4, 0, 1}, {0, 0, 1}},
                                  {{4, 0, -1}, {4, 4, -1}, {4, 4, 1}, {4, 0, 1}},
                                  {{4, 4, -1}, {0, 4, -1}, {0, 4, 1}, {4, 4, 1}},
                                  {{0, 4, -1}, {0, 0.3f, -1}, {0, 0.3f, 1}, {0, 4, 1}}};
    new_scene();
    for (int k = 0; k < 4; k++) scene_polygon(&shown, 4, walls[k]);
    read_clipped(source_of(&shown), &half_z);
    near(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0), 16, 1e-5);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 16, 1e-5);
}

/* The plane lies in faces, on edges and vertices; what lies on it is kept. */
static void touching_is_keeping(void **state) {
    (void)state;
    const dp_vec3 z = {0, 0, 1};
    /* a stepped shaft: its shoulder lies on the plane */
    scene *const s = new_scene();
    box(s, -2, -2, -2, 2, 2, 0);
    box(s, -1, -1, 0, 1, 1, 2);
    read_clipped(source_of(s), &half_z);
    near(face_area(ANY_GROUP, z, 0), 4, 1e-6);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 8, 1e-6);
    /* an octahedron cut along its edges */
    static const float tips[6][3] = {{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                     {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    new_scene();
    for (int k = 0; k < 8; k++) {
        const int a = k % 4, b = (a + 1) % 4;
        float t[3][3];
        memcpy(t[0], tips[k < 4 ? a : b], sizeof t[0]);
        memcpy(t[1], tips[k < 4 ? b : a], sizeof t[1]);
        memcpy(t[2], tips[k < 4 ? 4 : 5], sizeof t[2]);
        scene_polygon(&shown, 3, t);
    }
    read_clipped(source_of(&shown), &half_z);
    near(face_area(ANY_GROUP, z, 0), 2, 1e-6);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 4 * sqrt(2), 1e-6);
    for (size_t i = 0; i < first.count; i++) { /* edges on the plane are the section's */
        const read_polygon *const p = &first.of[i];
        for (int k = 0; k < 3; k++)
            if (p->at[k].z == 0 && p->at[(k + 1) % 3].z == 0)
                assert_true(p->flag[k] != DP_EDGE_NORMAL);
    }
}

static void a_plane_that_misses_changes_nothing(void **state) {
    (void)state;
    box(new_scene(), -1, -1, -1, 1, 1, 1);
    const dp_clip far = {.planes = {{{0, 0, 1}, 7}, {{1, 1, 0}, 3}}, .plane_count = 2};
    dp_source *const source = clipped(source_of(&shown), &far);
    dp_batch batch;
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_ptr_equal(batch.positions, shown.positions);
    assert_true(batch.stable);
    assert_int_equal(batch.polygon_count, 6);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_int_equal(batch.polygon_count, 0);
    dp_source_destroy(source);
}

static void planes_that_take_everything_say_so(void **state) {
    (void)state;
    box(new_scene(), -1, -1, -1, 1, 1, 1);
    const dp_clip all = {.planes = {{{0, 0, 1}, -7}}, .plane_count = 1};
    dp_source *const source = clipped(source_of(&shown), &all);
    dp_diag diag = {0};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(read_source(source, &first, &diag), DP_ERR_ARGUMENT);
        assert_non_null(strstr(diag.message, "the clip planes leave nothing of the model"));
        assert_int_equal(dp_source_rewind(source, &diag), DP_OK);
    }
    dp_source_destroy(source);
}

static void wrong_clips_are_refused(void **state) {
    (void)state;
    box(new_scene(), -1, -1, -1, 1, 1, 1);
    dp_source *const inner = source_of(&shown);
    const dp_clip wrong[] = {
        {.planes = {{{0, 0, 0}, 1}}, .plane_count = 1},
        {.planes = {{{0, (double)NAN, 1}, 1}}, .plane_count = 1},
        {.planes = {{{0, (double)INFINITY, 1}, 1}}, .plane_count = 1},
        {.planes = {{{0, 0, 1}, (double)NAN}}, .plane_count = 1},
        {.plane_count = DP_CLIP_PLANES + 1},
        {.look = (dp_section_look)9},
        {.hatch_spacing = -1},
        {.hatch_share = 2},
        {.hatch_angle = (double)NAN},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        dp_diag diag = {0};
        dp_source *out = inner;
        assert_int_equal(dp_source_clip(inner, &wrong[i], NULL, &out, &diag), DP_ERR_ARGUMENT);
        assert_null(out);
        assert_true(diag.message[0]);
    }
    dp_source *out;
    assert_int_equal(dp_source_clip(NULL, &half_z, NULL, &out, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_clip(inner, NULL, NULL, &out, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_clip(inner, &half_z, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(inner);
}

/* Closed tetrahedra through each other, in two groups. */
enum { NEEDLES = 40 };
typedef struct tetrahedron {
    double at[4][3];
} tetrahedron;

static bool is_inside(const tetrahedron *t, double x, double y) {
    static const int face[4][4] = {{0, 1, 2, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}, {3, 1, 0, 2}};
    const dp_vec3 p = {x, y, 0};
    for (int k = 0; k < 4; k++) {
        dp_vec3 v[4];
        for (int i = 0; i < 4; i++)
            v[i] = dp_v3(t->at[face[k][i]][0], t->at[face[k][i]][1], t->at[face[k][i]][2]);
        const dp_vec3 n = dp_cross(dp_sub(v[1], v[0]), dp_sub(v[2], v[0]));
        if (dp_dot(n, dp_sub(p, v[0])) * dp_dot(n, dp_sub(v[3], v[0])) < 0) return false;
    }
    return true;
}

static void put_tetrahedron(scene *s, tetrahedron *t) {
    static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) t->at[i][k] = (double)(float)(4 * chance() - 2);
    dp_vec3 v[4];
    for (int i = 0; i < 4; i++) v[i] = dp_v3(t->at[i][0], t->at[i][1], t->at[i][2]);
    const bool turned =
        dp_dot(dp_cross(dp_sub(v[1], v[0]), dp_sub(v[2], v[0])), dp_sub(v[3], v[0])) < 0;
    for (int k = 0; k < 4; k++) {
        float corners[3][3];
        for (int i = 0; i < 3; i++)
            for (int c = 0; c < 3; c++)
                corners[turned ? 2 - i : i][c] = (float)t->at[face[k][i]][c];
        scene_polygon(s, 3, corners);
    }
}

static void needles_are_filled_once(void **state) {
    (void)state;
    static tetrahedron t[NEEDLES];
    static uint16_t groups[4 * NEEDLES];
    const dp_clip clip = {.planes = {{{0, 0, 1}, 0}, {{1, 2, 0.5}, 1.5}}, .plane_count = 2};
    for (uint32_t round = 1; round <= 40; round++) {
        seed = round;
        new_scene();
        for (int k = 0; k < NEEDLES; k++) {
            put_tetrahedron(&shown, &t[k]);
            for (int i = 0; i < 4; i++) groups[4 * k + i] = k % 2;
        }
        dp_batch batch = scene_batch(&shown);
        batch.groups = groups;
        dp_source *source;
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        read_clipped(source, round % 2 ? &half_z : &clip);
        size_t kept = 0; /* faces of the first plane alone */
        for (size_t i = 0; i < first.count; i++)
            if (lies_on(&first.of[i], dp_v3(0, 0, 1), 0)) first.of[kept++] = first.of[i];
        first.count = kept;
        int wrong = 0;
        for (int k = 0; k < 2000; k++) {
            const double x = 4 * chance() - 2, y = 4 * chance() - 2;
            const bool left = round % 2 || (x + 2 * y) / sqrt(5.25) <= 1.5;
            for (int group = 0; group < 2; group++) {
                bool inside = false;
                for (int i = group; i < NEEDLES; i += 2) inside |= is_inside(&t[i], x, y);
                wrong += faces_over(x, y, group) != (inside && left);
            }
        }
        if (wrong > 2) fail_msg("round %u: %d points", round, wrong); /* else on an edge */
    }
}

/* Their total length is the area over the distance, and none leaves the section. */
static void hatching_fills_the_face(void **state) {
    (void)state;
    const dp_clip clip = {
        .planes = {{{0, 0, 1}, 0}}, .plane_count = 1, .hatch_spacing = 0.01, .hatch_angle = 30};
    scene *const s = new_scene();
    box(s, -3, -3, -1, 3, 3, 1);
    const size_t cavity = s->polygons;
    box(s, -1, -1, -0.5, 1, 1, 0.5);
    turn(s, cavity, s->polygons);
    read_clipped(source_of(s), &clip);
    near(line_length(ANY_GROUP, DP_EDGE_HATCHING), 32 / 0.01, 2e-3);
    for (size_t i = 0; i < first.count; i++) {
        const read_polygon *const p = &first.of[i];
        if (p->flag[0] != DP_EDGE_HATCHING) continue;
        const dp_vec3 m = dp_mix(p->at[0], p->at[1], 0.5), d = dp_sub(p->at[1], p->at[0]);
        assert_true(fabs(m.x) < 3.001 && fabs(m.y) < 3.001);
        assert_false(fabs(m.x) < 0.999 && fabs(m.y) < 0.999);
        if (dp_length(d) > 0.1) near(fabs(d.y / d.x), tan(30 * 3.14159265358979 / 180), 1e-3);
    }
}

/* A slice in which no vertex lies. */
static void a_slice_has_two_faces(void **state) {
    (void)state;
    const dp_clip clip = {.planes = {{{0, 0, 1}, 0.5}, {{0, 0, -1}, -0.25}}, .plane_count = 2};
    box(new_scene(), -3, -2, -4, 3, 2, 4);
    read_clipped(source_of(&shown), &clip);
    near(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0.5), 24, 1e-6);
    near(face_area(ANY_GROUP, dp_v3(0, 0, -1), -0.25), 24, 1e-6);
    near(line_length(ANY_GROUP, DP_EDGE_SECTION), 40, 1e-6);
    const double spacing = sqrt(36 + 16 + 0.0625) / 60;
    near(line_length(ANY_GROUP, DP_EDGE_HATCHING), 48 / spacing, 0.02);
}

static void attributes_are_interpolated(void **state) {
    (void)state;
    static const float positions[] = {0, 0, -1, 4, 0, -1, 0, 0, 3},
                       normals[] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, texcoords[] = {0, 0, 1, 0, 0, 1};
    static const uint32_t colors[] = {0x000000FF, 0x000000FF, 0x808080FF};
    const dp_batch batch = {.positions = positions,
                            .vertex_count = 3,
                            .corner_count = 3,
                            .polygon_count = 1,
                            .normals = {.values = normals, .count = 3},
                            .texcoords = {.values = texcoords, .count = 3},
                            .colors = colors};
    dp_source *inner;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &inner, NULL), DP_OK);
    dp_source *const source = clipped(inner, &half_z);
    dp_batch b;
    assert_int_equal(dp_source_next(source, &b, NULL), DP_OK);
    assert_true(b.polygon_count >= 3);
    int cut = 0;
    for (uint32_t c = 0; c < 6; c++) {
        const float *const p = b.positions + 3 * c, *const n = b.normals.values + 3 * c,
                           *const t = b.texcoords.values + 2 * c;
        const double up = ((double)p[2] + 1) / 4;
        near((double)n[2] + 1, up + 1, 1e-6);
        near((double)t[1] + 1, up + 1, 1e-6);
        near((double)(b.colors[c] >> 24) + 1, 128 * up + 1, 1e-6);
        cut += p[2] == 0;
    }
    assert_int_equal(cut, 3);
    dp_source_destroy(source);
}

/* Far from zero with an origin: as near to it. */
static void origins_are_kept(void **state) {
    (void)state;
    box(new_scene(), -1, -2, -3, 1, 2, 3);
    dp_batch batch = scene_batch(&shown);
    batch.origin[0] = 5e6, batch.origin[2] = -3e6;
    const dp_clip clip = {.planes = {{{0, 0, 1}, -3e6 + 0.25}}, .plane_count = 1};
    dp_source *inner;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &inner, NULL), DP_OK);
    read_clipped(inner, &clip);
    near(face_area(ANY_GROUP, dp_v3(0, 0, 1), -3e6 + 0.25), 8, 1e-6);
}

/* ------- memory ------- */

typedef struct meter {
    long alive, calls, fail_at;
} meter;

static bool fails(meter *m) { return ++m->calls == m->fail_at; }
static void *meter_alloc(size_t size, void *user) {
    meter *const m = user;
    void *const block = fails(m) ? NULL : malloc(size ? size : 1);
    m->alive += block != NULL;
    return block;
}
static void *meter_realloc(void *block, size_t size, void *user) {
    meter *const m = user;
    void *const moved = fails(m) ? NULL : realloc(block, size ? size : 1);
    m->alive += moved && !block;
    return moved;
}
static void meter_free(void *block, void *user) {
    ((meter *)user)->alive -= block != NULL;
    free(block);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    const dp_clip clip = {.planes = {{{0, 0, 1}, 0}, {{1, 0, 0.1}, 0.5}},
                          .plane_count = 2,
                          .look = DP_SECTION_CROSSED};
    bool met = true;
    for (long at = 1; met; at++) {
        meter m = {.fail_at = at};
        const dp_allocator memory = {meter_alloc, meter_realloc, meter_free, &m};
        dp_source *source = NULL;
        dp_diag diag = {0};
        box(new_scene(), -1, -2, -3, 1, 2, 3);
        const float sheet[5][3] = {{-2, 0, -1}, {2, 0, -1}, {0, 0, 0}, {2, 0, 1}, {-2, 0, 1}};
        scene_polygon(&shown, 5, sheet);
        dp_source *const inner = source_of(&shown);
        dp_result result = dp_source_clip(inner, &clip, &memory, &source, &diag);
        if (!result) result = read_source(source, &first, &diag);
        met = m.calls >= at;
        if (result) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_true(diag.message[0]);
        }
        if (source) { /* there is memory again */
            m.fail_at = 0;
            assert_int_equal(dp_source_rewind(source, &diag), DP_OK);
            assert_int_equal(read_source(source, &first, &diag), DP_OK);
            near(face_area(ANY_GROUP, dp_v3(0, 0, 1), 0), 4 + 2 * sqrt(1.01), 1e-6);
        }
        dp_source_destroy(source ? source : inner);
        assert_int_equal(m.alive, 0);
    }
}

static void later_readings_allocate_nothing(void **state) {
    (void)state;
    meter m = {0};
    const dp_allocator memory = {meter_alloc, meter_realloc, meter_free, &m};
    const dp_clip clip = {.planes = {{{0, 1, 1}, 0.1}, {{1, 0, 0}, 0.2}}, .plane_count = 2};
    dp_source *source;
    assert_int_equal(dp_source_clip(shape("torus", 4000), &clip, &memory, &source, NULL), DP_OK);
    assert_int_equal(read_source(source, &first, NULL), DP_OK);
    const long before = m.calls;
    for (int k = 0; k < 3; k++) {
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
        assert_int_equal(read_source(source, &first, NULL), DP_OK);
    }
    assert_int_equal(m.calls, before);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_closed),
        cmocka_unit_test(several_planes_meet),
        cmocka_unit_test(a_torus_has_two_discs),
        cmocka_unit_test(windings_are_counted),
        cmocka_unit_test(a_turned_polygon_does_no_harm),
        cmocka_unit_test(parts_keep_their_outlines),
        cmocka_unit_test(a_sheet_is_a_line),
        cmocka_unit_test(small_gaps_are_closed),
        cmocka_unit_test(touching_is_keeping),
        cmocka_unit_test(a_plane_that_misses_changes_nothing),
        cmocka_unit_test(planes_that_take_everything_say_so),
        cmocka_unit_test(wrong_clips_are_refused),
        cmocka_unit_test(needles_are_filled_once),
        cmocka_unit_test(hatching_fills_the_face),
        cmocka_unit_test(a_slice_has_two_faces),
        cmocka_unit_test(attributes_are_interpolated),
        cmocka_unit_test(origins_are_kept),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(later_readings_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
