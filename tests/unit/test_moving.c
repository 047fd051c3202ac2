/* Drawings of models that move: a moved model is drawn as a still one whose polygons lie there is, to the
 * byte, also where its polygons are others from frame to frame; and nothing is made anew in each frame. */
#include "draw/context.h"

#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180, PIXELS = WIDTH * HEIGHT, FRAMES = 6 };

/* ------- an allocator that counts ------- */

static atomic_long taken;

static void *counted_alloc(size_t size, void *user) {
    (void)user;
    atomic_fetch_add(&taken, 1);
    return malloc(size);
}
static void *counted_realloc(void *block, size_t size, void *user) {
    (void)user;
    atomic_fetch_add(&taken, 1);
    return realloc(block, size);
}
static void counted_free(void *block, void *user) {
    (void)user;
    free(block);
}
static const dp_allocator counted = {counted_alloc, counted_realloc, counted_free, NULL};

/* ------- models ------- */

typedef struct mesh {
    float *positions;  /* [vertices][3] */
    uint32_t *indices; /* [3 * triangles] */
    dp_batch batch;
} mesh;

/* All batches of a source as one. */
static mesh read_mesh(dp_source *source) {
    mesh m = {0};
    size_t vertices = 0, corners = 0;
    dp_batch b;
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    for (;;) {
        assert_int_equal(dp_source_next(source, &b, NULL), DP_OK);
        if (!b.polygon_count) break;
        assert_true(!b.firsts);
        m.positions = realloc(m.positions, (vertices + b.vertex_count) * 3 * sizeof(float));
        m.indices = realloc(m.indices, (corners + b.corner_count) * sizeof(uint32_t));
        for (size_t v = 0; v < b.vertex_count; v++)
            memcpy(m.positions + 3 * (vertices + v),
                   (const char *)b.positions + v * b.position_stride, 3 * sizeof(float));
        for (size_t c = 0; c < b.corner_count; c++)
            m.indices[corners + c] = (uint32_t)vertices + (b.indices ? b.indices[c] : (uint32_t)c);
        vertices += b.vertex_count, corners += b.corner_count;
    }
    m.batch = (dp_batch){.positions = m.positions,
                         .vertex_count = vertices,
                         .indices = m.indices,
                         .corner_count = corners,
                         .polygon_count = corners / 3};
    return m;
}

static void free_mesh(mesh *m) {
    free(m->positions);
    free(m->indices);
}

static dp_source *shape(const char *name, uint64_t triangles) {
    dp_source *source = NULL;
    const dp_shape wanted = {.name = name, .triangles = triangles};
    assert_int_equal(dp_source_from_shape(&wanted, &source, NULL), DP_OK);
    return source;
}

static mesh shape_mesh(const char *name, uint64_t triangles) {
    dp_source *const source = shape(name, triangles);
    const mesh m = read_mesh(source);
    dp_source_destroy(source);
    return m;
}

static dp_source *arrays_of(const mesh *m) {
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_arrays(&m->batch, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_source *deformed(dp_source *inner, const dp_deform *deform) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_deform(inner, deform, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

/* ------- pictures ------- */

typedef struct picture {
    uint8_t rgba[4 * PIXELS], edge_map[4 * PIXELS], line_class[PIXELS];
    float depth[PIXELS];
} picture;

static dp_camera camera_of(int frame) {
    dp_camera camera = {0};
    const double angle = 0.6 + 0.15 * frame;
    dp_camera_look_at(&camera, (const double[3]){4 * sin(angle), 2.2, 4 * cos(angle)},
                      (const double[3]){0, 0, 0}, (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 45, (double)WIDTH / HEIGHT, 0.1, 100);
    return camera;
}

static dp_context *new_context(uint32_t threads, const dp_allocator *allocator) {
    dp_context *context = NULL;
    const dp_context_desc desc = {.allocator = allocator, .threads = threads};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

static void draw(dp_context *context, dp_source *source, int frame, const dp_style *style,
                 picture *to) {
    static picture unwanted;
    const dp_camera camera = camera_of(frame);
    picture *const p = to ? to : &unwanted;
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .rgba = p->rgba,
                              .line_class = p->line_class,
                              .depth = p->depth,
                              .edge_map = style->edge_map.detector ? p->edge_map : NULL};
    dp_diag diag = {0};
    if (dp_draw(context, source, &camera, style, &target, &diag)) fail_msg("%s", diag.message);
}

static void draw_alone(dp_source *source, int frame, const dp_style *style, uint32_t threads,
                       picture *to) {
    dp_context *const context = new_context(threads, NULL);
    memset(to, 0, sizeof *to);
    draw(context, source, frame, style, to);
    dp_context_destroy(context);
}

static uint32_t segments_of(const dp_context *context) {
    dp_stats stats;
    dp_stats_of(context, &stats);
    return (uint32_t)stats.segments;
}

typedef struct look {
    const char *name;
    dp_style style;
} look;

static const look looks[] = {
    {"strokes", {0}},
    {"all of them emerge", {.edge_table_off = true}},
    {"hidden lines", {.hidden = {.look = DP_HIDDEN_DASHED, .levels = 3}}},
    {"quads", {.ink = DP_INK_QUADS}},
    {"adjacency", {.edges = DP_EDGES_ADJACENCY}},
    {"exact ends", {.exact_ends = true}},
    {"clean lines", {.detail = 1}},
    {"jitter", {.stroke = {.jitter = 2, .repeats = 2, .overshoot = 4}}},
    {"smooth", {.smooth = DP_SMOOTH_SURFACE}},
    {"edge map", {.edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}}},
    {"edge map of C1", {.edge_map = {.detector = DP_EDGE_MAP_C1}}},
    {"lambert", {.shade = {.shading = DP_SHADING_LAMBERT}}},
    {"gooch, flat", {.shade = {.shading = DP_SHADING_GOOCH, .normals = DP_NORMALS_FACET}}},
    {"hatch", {.shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
    {"pencil", {.shade = {.shading = DP_SHADING_PENCIL}}},
    {"mirror", {.mirror = {.normal = {0, 1, 0}, .offset = -1.1f, .size = 4, .fade = 2}}},
};
enum { LOOKS = sizeof looks / sizeof *looks };

/* ------- a moved model is drawn as one that lies there ------- */

static double time_of(int frame) { return 0.11 * frame; }

static void assert_drawn_alike(dp_source *moved, const dp_style *style, const char *what) {
    static picture one, other;
    for (int frame = 0; frame < FRAMES; frame += 3) {
        assert_int_equal(dp_source_set_time(moved, time_of(frame), NULL), DP_OK);
        mesh still = read_mesh(moved);
        dp_source *const there = arrays_of(&still);
        draw_alone(there, frame, style, 1, &other);
        static const uint32_t threads[] = {1, 2, 7};
        for (size_t k = 0; k < 3; k++) {
            draw_alone(moved, frame, style, threads[k], &one);
            if (memcmp(&one, &other, sizeof one))
                fail_msg("%s, %u threads, frame %d: it is drawn otherwise than a still one", what,
                         threads[k], frame);
        }
        dp_source_destroy(there);
        free_mesh(&still);
    }
}

static void moved_is_drawn_as_still(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        const dp_deform deform = {.kind = (dp_deform_kind)kind};
        mesh gear = shape_mesh("gear", 1500);
        dp_source *const source = deformed(arrays_of(&gear), &deform); /* one stable batch */
        for (size_t k = 0; k < LOOKS; k += kind ? 3 : 1)
            assert_drawn_alike(source, &looks[k].style, looks[k].name);
        dp_source_destroy(source);
        free_mesh(&gear);
    }
}

static void batches_are_drawn_as_one(void **state) {
    (void)state;
    static const dp_style plain = {0};
    dp_source *const source = deformed(shape("terrain", 70000), &(dp_deform){.axis = {1, 0, 0}});
    assert_drawn_alike(source, &plain, "batches");
    dp_source_destroy(source);
}

static void morphs_are_drawn_as_still(void **state) {
    (void)state;
    static const dp_style plain = {0};
    mesh torus = shape_mesh("torus", 2000);
    dp_source *const twisted = deformed(arrays_of(&torus), &(dp_deform){.kind = DP_DEFORM_TWIST});
    dp_source *source = NULL;
    assert_int_equal(
        dp_source_morph(arrays_of(&torus), twisted, &(dp_morph){.seconds = 1}, NULL, &source, NULL),
        DP_OK);
    assert_drawn_alike(source, &plain, "morph");
    dp_source_destroy(source);
    free_mesh(&torus);
}

/* The same context draws frames of a moving model in any order. */
static void frames_come_in_any_order(void **state) {
    static picture one, other;
    (void)state;
    mesh torus = shape_mesh("torus", 2000);
    dp_source *const source = deformed(arrays_of(&torus), NULL);
    for (size_t k = 0; k < LOOKS; k++) {
        dp_context *const context = new_context(2, NULL);
        static const int order[] = {3, 0, 5, 3, 1, 0};
        for (size_t i = 0; i < 6; i++) {
            assert_int_equal(dp_source_set_time(source, time_of(order[i]), NULL), DP_OK);
            memset(&one, 0, sizeof one);
            draw(context, source, order[i], &looks[k].style, &one);
            draw_alone(source, order[i], &looks[k].style, 3, &other);
            if (memcmp(&one, &other, sizeof one))
                fail_msg("%s: frame %d is another after others", looks[k].name, order[i]);
        }
        dp_context_destroy(context);
    }
    dp_source_destroy(source);
    free_mesh(&torus);
}

/* Positions of an application's arrays may change as well, without a time. */
static void arrays_may_change(void **state) {
    static picture one, other;
    (void)state;
    mesh gear = shape_mesh("gear", 2000);
    dp_source *const source = arrays_of(&gear);
    for (size_t k = 0; k < LOOKS; k++) {
        dp_context *const context = new_context(2, NULL);
        for (int frame = 0; frame < 3; frame++) {
            for (size_t v = 0; v < gear.batch.vertex_count; v++) gear.positions[3 * v] *= 0.97f;
            memset(&one, 0, sizeof one);
            draw(context, source, frame, &looks[k].style, &one);
            draw_alone(source, frame, &looks[k].style, 1, &other);
            if (memcmp(&one, &other, sizeof one))
                fail_msg("%s: changed positions are not drawn as new ones", looks[k].name);
        }
        dp_context_destroy(context);
    }
    dp_source_destroy(source);
    free_mesh(&gear);
}

/* ------- nothing is made anew ------- */

/* Draws each frame of a turn of time and camera, and counts what is taken in each. */
static void draw_turn(dp_context *context, dp_source *source, const dp_style *style,
                      long counts[FRAMES]) {
    for (int frame = 0; frame < FRAMES; frame++) {
        const long before = atomic_load(&taken);
        assert_int_equal(dp_source_set_time(source, time_of(frame), NULL), DP_OK);
        draw(context, source, frame, style, NULL);
        counts[frame] = atomic_load(&taken) - before;
    }
}

/* In the first turn arrays grow where a frame has more lines than any before. The second takes
 * nothing. */
static void assert_nothing_is_taken(const char *what, const dp_style *style, dp_source *source) {
    long first[FRAMES], second[FRAMES];
    dp_context *const context = new_context(1, &counted);
    draw_turn(context, source, style, first);
    draw_turn(context, source, style, second);
    for (int frame = 0; frame < FRAMES; frame++)
        if (second[frame])
            fail_msg("%s: frame %d takes memory %ld times though it was drawn before", what, frame,
                     second[frame]);
    assert_true(first[0] > 20); /* it counts */
    dp_context_destroy(context);
}

static dp_source *counted_deform(dp_source *inner, const dp_deform *deform) {
    dp_source *source = NULL;
    assert_int_equal(dp_source_deform(inner, deform, &counted, &source, NULL), DP_OK);
    return source;
}

static void deforming_takes_no_memory(void **state) {
    (void)state;
    static const char *const names[] = {"gear", "terrain"};
    for (size_t n = 0; n < 2; n++) {
        mesh m = shape_mesh(names[n], 2000);
        dp_source *const source = counted_deform(arrays_of(&m), NULL);
        for (size_t k = 0; k < LOOKS; k++)
            assert_nothing_is_taken(looks[k].name, &looks[k].style, source);
        dp_source_destroy(source);
        free_mesh(&m);
    }
}

static void batches_and_morphs_take_no_memory(void **state) {
    (void)state;
    dp_source *source = counted_deform(shape("terrain", 70000), NULL); /* several batches */
    assert_nothing_is_taken("batches", &looks[0].style, source);
    dp_source_destroy(source);
    mesh m = shape_mesh("gear", 3000);
    dp_source *const twisted = counted_deform(arrays_of(&m), &(dp_deform){.kind = DP_DEFORM_TWIST});
    assert_int_equal(
        dp_source_morph(arrays_of(&m), twisted, &(dp_morph){.seconds = 1}, &counted, &source, NULL),
        DP_OK);
    assert_nothing_is_taken("morph", &looks[0].style, source);
    dp_source_destroy(source);
    free_mesh(&m);
}

/* What is made per vertex or polygon has its memory in the first frame: a model that shrinks by a
 * millionth is another one, but has no more lines. */
static void shrink(void *user, const dp_vertex_run *run) {
    (void)user;
    const char *at = (const char *)run->positions;
    for (size_t i = 0; i < run->count; i++, at += run->stride)
        for (int k = 0; k < 3; k++)
            run->moved[i][k] = ((const float *)(const void *)at)[k] * (float)(1 - 1e-6 * run->time);
}

static void the_second_frame_takes_no_memory(void **state) {
    (void)state;
    mesh m = shape_mesh("torus", 4000);
    const dp_deform deform = {.vertices = shrink};
    dp_source *const source = counted_deform(arrays_of(&m), &deform);
    for (size_t k = 0; k < LOOKS; k++) {
        dp_context *const context = new_context(1, &counted);
        assert_int_equal(dp_source_set_time(source, 0, NULL), DP_OK);
        draw(context, source, 0, &looks[k].style, NULL);
        const long before = atomic_load(&taken);
        assert_int_equal(dp_source_set_time(source, 1, NULL), DP_OK);
        draw(context, source, 0, &looks[k].style, NULL);
        if (atomic_load(&taken) != before)
            fail_msg("%s: the second frame takes memory %ld times", looks[k].name,
                     atomic_load(&taken) - before);
        dp_context_destroy(context);
    }
    dp_source_destroy(source);
    free_mesh(&m);
}

/* ------- polygons that are others from frame to frame ------- */

/* An application's source whose topology follows the time: levels of detail, or subdivision; two parts
 * that come together and part again. */
typedef struct stage_play {
    mesh levels[3]; /* of one shape, finer and finer */
    mesh part;
    float *moved; /* the part's positions */
    double time;
    int at;
} stage_play;

static dp_result play_set_time(void *user, double time, dp_diag *diag) {
    stage_play *const p = user;
    (void)diag;
    p->time = time;
    p->at = 0;
    for (size_t v = 0; v < p->part.batch.vertex_count; v++) {
        memcpy(p->moved + 3 * v, p->part.positions + 3 * v, 3 * sizeof(float));
        p->moved[3 * v] += (float)(2 * time - 1); /* it moves through the other */
    }
    return DP_OK;
}

static dp_result play_next(void *user, dp_batch *batch, dp_diag *diag) {
    stage_play *const p = user;
    (void)diag;
    const int level = p->time < 0.2 ? 0 : p->time < 0.5 ? 1 : 2;
    if (p->at == 0) *batch = p->levels[level].batch;
    if (p->at == 1 && p->time < 0.4) { /* later they are one */
        *batch = p->part.batch;
        batch->positions = p->moved;
    }
    p->at++;
    return DP_OK;
}

static dp_result play_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((stage_play *)user)->at = 0;
    return DP_OK;
}

static void polygons_may_be_others_in_each_frame(void **state) {
    static picture one, other;
    (void)state;
    stage_play play = {.part = shape_mesh("cube", 300)};
    static const uint64_t finer[] = {80, 720, 5000};
    for (int k = 0; k < 3; k++) play.levels[k] = shape_mesh("sphere", finer[k]);
    play.moved = calloc(play.part.batch.vertex_count, 3 * sizeof(float));
    const dp_source_callbacks callbacks = {
        .user = &play, .next = play_next, .rewind = play_rewind, .set_time = play_set_time};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    for (size_t k = 0; k < LOOKS; k++) {
        dp_context *const context = new_context(2, NULL);
        uint32_t least = UINT32_MAX, most = 0;
        for (int frame = 0; frame < FRAMES; frame++) {
            assert_int_equal(dp_source_set_time(source, time_of(frame), NULL), DP_OK);
            memset(&one, 0, sizeof one);
            draw(context, source, frame, &looks[k].style, &one);
            const uint32_t count = segments_of(context);
            least = count < least ? count : least, most = count > most ? count : most;
            mesh now = read_mesh(source);
            dp_source *const fresh = arrays_of(&now);
            draw_alone(fresh, frame, &looks[k].style, 1, &other);
            if (memcmp(&one, &other, sizeof one))
                fail_msg("%s: frame %d is not that of a fresh source", looks[k].name, frame);
            dp_source_destroy(fresh);
            free_mesh(&now);
        }
        if (looks[k].style.ink != DP_INK_QUADS) assert_true(most > least);
        dp_context_destroy(context);
    }
    dp_source_destroy(source);
    for (int k = 0; k < 3; k++) free_mesh(&play.levels[k]);
    free_mesh(&play.part);
    free(play.moved);
}

/* ------- functions that write no numbers ------- */

static void tear(void *user, const dp_vertex_run *run) {
    const char *at = (const char *)run->positions;
    (void)user;
    for (size_t i = 0; i < run->count; i++, at += run->stride) {
        memcpy(run->moved[i], at, 3 * sizeof(float));
        if ((run->first + i) % 50 == 7) run->moved[i][1] = NAN;
        if ((run->first + i) % 50 == 9) run->moved[i][2] = -INFINITY;
    }
}

static void torn_polygons_are_dropped_and_counted(void **state) {
    static picture one, other;
    (void)state;
    mesh torus = shape_mesh("torus", 4000);
    const dp_deform deform = {.vertices = tear};
    dp_source *const source = deformed(arrays_of(&torus), &deform);
    mesh torn = read_mesh(source);
    size_t lost = 0, kept = 0;
    for (size_t i = 0; i < torn.batch.polygon_count; i++) {
        bool sound = true;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                sound &= isfinite(torn.positions[3 * torn.indices[3 * i + c] + k]);
        lost += !sound;
        if (sound) memmove(torn.indices + 3 * kept++, torn.indices + 3 * i, 3 * sizeof(uint32_t));
    }
    assert_true(lost > 100);
    torn.batch.polygon_count = kept;
    torn.batch.corner_count = 3 * kept;
    dp_source *const rest = arrays_of(&torn);
    for (size_t k = 0; k < LOOKS; k++) {
        dp_context *const context = new_context(2, NULL);
        dp_stats stats;
        memset(&one, 0, sizeof one);
        draw(context, source, 0, &looks[k].style, &one);
        dp_stats_of(context, &stats);
        if (!looks[k].style.mirror.size) assert_int_equal(stats.dropped_finite, lost);
        dp_context_destroy(context);
        draw_alone(rest, 0, &looks[k].style, 1, &other);
        if (looks[k].style.edges == DP_EDGES_ADJACENCY)
            continue;                                   /* they are neighbours there still */
        if (looks[k].style.stroke.jitter > 0) continue; /* its errors go by the polygons' numbers */
        if (memcmp(one.line_class, other.line_class, PIXELS))
            fail_msg("%s: what is left is not drawn as if it were alone", looks[k].name);
    }
    dp_source_destroy(rest);
    dp_source_destroy(source);
    free_mesh(&torn);
    free_mesh(&torus);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moved_is_drawn_as_still),
        cmocka_unit_test(batches_are_drawn_as_one),
        cmocka_unit_test(morphs_are_drawn_as_still),
        cmocka_unit_test(frames_come_in_any_order),
        cmocka_unit_test(arrays_may_change),
        cmocka_unit_test(deforming_takes_no_memory),
        cmocka_unit_test(batches_and_morphs_take_no_memory),
        cmocka_unit_test(the_second_frame_takes_no_memory),
        cmocka_unit_test(polygons_may_be_others_in_each_frame),
        cmocka_unit_test(torn_polygons_are_dropped_and_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
