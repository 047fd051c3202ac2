/* mesh/groups, arrange, explode: a model's groups measured, left out, moved and pulled apart. */
#include "mesh/source.h"
#include "scene.h"
#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A strip of four triangles; the second and third are of group 1, and share vertices with the others. */
static const float strip[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0};
static const uint32_t indices[] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5};
static const uint16_t groups[] = {0, 1, 1, 4};
static const uint8_t flags[] = {1, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 0};
static const uint32_t colors[] = {1, 2, 3, 4, 5, 6};
static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
static const float texcoords[] = {0, 0, 1, 0};
static const uint32_t texcoord_numbers[] = {0, 1, 0, 1, 0, 1, 1, 1, 1, 0, 0, 0};

static dp_batch strip_batch(void) {
    return (dp_batch){.positions = strip,
                      .vertex_count = 6,
                      .indices = indices,
                      .corner_count = 12,
                      .polygon_count = 4,
                      .groups = groups};
}

static dp_batch full_batch(void) {
    dp_batch batch = strip_batch();
    batch.edge_flags = flags;
    batch.colors = colors;
    batch.normals = (dp_attribute){.values = normals, .count = 6};
    batch.texcoords = (dp_attribute){.values = texcoords, .count = 2, .indices = texcoord_numbers};
    batch.origin[1] = 500000;
    return batch;
}

static dp_source *source_of(const dp_batch *batch) {
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_source *file_of(const char *text) {
    const dp_memory_file file = {.data = text, .size = strlen(text), .name = "a.obj"};
    dp_source *source;
    dp_diag diag = {0};
    if (dp_source_open_memory(&file, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

static dp_source *arranged(dp_source *inner, const dp_placement *placements, uint32_t count) {
    dp_source *source;
    dp_diag diag = {0};
    if (dp_source_arrange(inner, placements, count, NULL, &source, &diag))
        fail_msg("%s", diag.message);
    return source;
}

static dp_batch next(dp_source *source) {
    dp_batch batch;
    dp_diag diag = {0};
    if (dp_source_next(source, &batch, &diag)) fail_msg("%s", diag.message);
    return batch;
}

static const float *position(const dp_batch *batch, size_t corner) {
    const size_t v = batch->indices ? batch->indices[corner] : corner;
    assert_true(v < batch->vertex_count);
    return (const float *)(const void *)((const char *)batch->positions +
                                         v * batch->position_stride);
}

/* ------- groups ------- */

static void groups_are_counted_and_measured(void **state) {
    (void)state;
    dp_batch batch = strip_batch();
    batch.origin[0] = 1e6;
    dp_source *const source = source_of(&batch);
    dp_group found[5];
    uint32_t count = 9;
    for (int round = 0; round < 2; round++) {
        assert_int_equal(dp_source_groups(source, found, 5, &count, NULL), DP_OK);
        assert_int_equal(count, 5);
        assert_true(found[0].polygons == 1 && found[1].polygons == 2 && found[4].polygons == 1);
        assert_true(!found[2].polygons && found[2].min[0] == INFINITY &&
                    found[2].max[2] == -INFINITY);
        assert_true(found[1].min[0] == 1e6 && found[1].max[0] == 1e6 + 1);
        assert_true(found[1].min[1] == 0 && found[1].max[1] == 2 && found[4].min[1] == 1);
    }
    assert_int_equal(next(source).polygon_count, 4); /* from the start */
    assert_int_equal(dp_source_groups(source, found, 2, &count, NULL), DP_OK);
    assert_int_equal(count, 5); /* more than there is room for */
    assert_int_equal(dp_source_groups(source, NULL, 0, &count, NULL), DP_OK);
    assert_int_equal(dp_source_groups(source, NULL, 1, &count, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_groups(NULL, found, 1, &count, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
}

static void bad_corners_do_not_count(void **state) {
    (void)state;
    static const float bad[] = {0, 0, 0, NAN, 5, 0, 2, 3, 0};
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 7};
    const dp_batch batch = {.positions = bad,
                            .vertex_count = 3,
                            .indices = corners,
                            .corner_count = 6,
                            .polygon_count = 2};
    dp_source *const source = source_of(&batch);
    dp_group found;
    uint32_t count;
    assert_int_equal(dp_source_groups(source, &found, 1, &count, NULL), DP_OK);
    assert_true(count == 1 && found.polygons == 2 && found.max[0] == 2 && found.max[1] == 3);
    dp_source_destroy(source);
}

/* ------- arranging ------- */

static void what_does_not_change_is_handed_on(void **state) {
    (void)state;
    const dp_batch batch = full_batch();
    const dp_placement far_away[8] = {[7] = {.hidden = true, .offset = {1, 2, 3}}};
    dp_source *const source = arranged(source_of(&batch), far_away, 8);
    for (int round = 0; round < 2; round++) {
        const dp_batch same = next(source);
        assert_true(same.stable && same.positions == strip && same.indices == indices);
        assert_true(same.groups == groups && same.colors == colors && same.origin[1] == 500000);
        assert_int_equal(next(source).polygon_count, 0);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
}

static void hidden_groups_are_left_out(void **state) {
    (void)state;
    const dp_batch batch = full_batch();
    const dp_placement places[2] = {[1] = {.hidden = true}};
    dp_source *const source = arranged(source_of(&batch), places, 2);
    for (int round = 0; round < 2; round++) {
        const dp_batch left = next(source);
        assert_true(left.polygon_count == 2 && left.corner_count == 6 && !left.stable);
        assert_true(left.positions == strip && left.colors == colors && left.vertex_count == 6);
        assert_true(left.groups[0] == 0 && left.groups[1] == 4);
        assert_memory_equal(left.indices, ((const uint32_t[]){0, 1, 2, 4, 3, 5}), 24);
        assert_memory_equal(left.edge_flags, ((const uint8_t[]){1, 0, 1, 1, 1, 0}), 6);
        assert_memory_equal(left.texcoords.indices, ((const uint32_t[]){0, 1, 0, 0, 0, 0}), 24);
        assert_true(!left.normals.indices && left.normals.values == normals);
        assert_int_equal(next(source).polygon_count, 0);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
}

static void polygons_of_many_corners_are_left_out(void **state) {
    (void)state;
    dp_source *const inner = file_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\no a\nf 1 2 3 4\n"
                                     "o b\nf 1 2 3\no c\nf 1 2 5 3 4\n");
    const dp_placement places[2] = {{.hidden = true}};
    dp_source *const source = arranged(inner, places, 2);
    const dp_batch left = next(source);
    assert_int_equal(left.polygon_count, 2);
    assert_memory_equal(left.firsts, ((const uint32_t[]){0, 3, 8}), 12);
    assert_true(left.indices[3] == 0 && left.indices[7] == 3);
    assert_string_equal(dp_source_group_name(source, left.groups[1]), "c");
    dp_source_destroy(source);
}

static void moved_groups_take_their_corners_along(void **state) {
    (void)state;
    const dp_batch batch = full_batch();
    const dp_placement places[5] = {[1] = {.offset = {0, 0, 8}}, [4] = {.offset = {0.5, 0, 0}}};
    dp_source *const source = arranged(source_of(&batch), places, 5);
    for (int round = 0; round < 2; round++) {
        const dp_batch moved = next(source);
        assert_true(moved.polygon_count == 4 && moved.origin[1] == 500000);
        for (size_t c = 0; c < 12; c++) {
            const double *const offset = places[groups[c / 3]].offset;
            for (int k = 0; k < 3; k++)
                assert_true((double)position(&moved, c)[k] ==
                            (double)strip[3 * indices[c] + (size_t)k] + offset[k]);
            assert_int_equal(moved.colors[moved.indices[c]], colors[indices[c]]);
            assert_int_equal(moved.normals.indices[c], indices[c]);
            assert_int_equal(moved.texcoords.indices[c], texcoord_numbers[c]);
        }
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
}

/* Without indices, with strides, and with corners that name no vertex. */
static void moved_batches_of_any_layout(void **state) {
    (void)state;
    static const float wide[] = {0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9};
    static const uint32_t bad[] = {0, 1, 5};
    dp_batch batch = {.positions = wide,
                      .position_stride = 16,
                      .vertex_count = 3,
                      .corner_count = 3,
                      .polygon_count = 1};
    const dp_placement place = {.offset = {1, 2, 3}};
    dp_source *source = arranged(source_of(&batch), &place, 1);
    dp_batch moved = next(source);
    assert_true(position(&moved, 1)[0] == 2 && position(&moved, 2)[1] == 3 && !moved.groups);
    dp_source_destroy(source);
    batch.indices = bad;
    source = arranged(source_of(&batch), &place, 1);
    moved = next(source);
    assert_true(moved.indices[2] >= moved.vertex_count && position(&moved, 0)[2] == 3);
    dp_source_destroy(source);
}

/* A batch of which nothing is left is not the end. */
static void empty_batches_are_passed_over(void **state) {
    (void)state;
    const dp_batch batch = strip_batch();
    static const char *const names[] = {"a", "b"};
    dp_source *parts[] = {source_of(&batch), source_of(&batch)};
    dp_source *joined;
    assert_int_equal(dp_source_join(parts, names, 2, NULL, &joined, NULL), DP_OK);
    dp_extent extent;
    assert_int_equal(dp_source_extent(joined, &extent, NULL), DP_OK); /* groups are numbered */
    dp_placement places[6] = {{0}};
    for (uint32_t g = 0; g < 6; g++) places[g].hidden = dp_source_group_name(joined, g)[0] == 'a';
    dp_source *const source = arranged(joined, places, 6);
    assert_int_equal(next(source).polygon_count, 4);
    assert_int_equal(next(source).polygon_count, 0);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_int_equal(extent.polygons, 4);
    dp_source_destroy(source);
}

static void wrong_arrangements_are_refused(void **state) {
    (void)state;
    const dp_batch batch = strip_batch();
    dp_source *const inner = source_of(&batch);
    dp_source *out = inner;
    dp_placement place = {.offset = {0, NAN, 0}};
    dp_diag diag;
    assert_int_equal(dp_source_arrange(inner, &place, 1, NULL, &out, &diag), DP_ERR_ARGUMENT);
    assert_null(out);
    assert_non_null(strstr(diag.message, "group 0"));
    place.offset[1] = (double)INFINITY;
    assert_int_equal(dp_source_arrange(inner, &place, 1, NULL, &out, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_arrange(inner, &place, 65537, NULL, &out, NULL), DP_ERR_LIMIT);
    assert_int_equal(dp_source_arrange(NULL, NULL, 0, NULL, &out, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_arrange(inner, NULL, 1, NULL, &out, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_arrange(inner, NULL, 0, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_arrange(inner, NULL, 0, NULL, &out, NULL), DP_OK);
    assert_int_equal(next(out).polygon_count, 4);
    dp_source_destroy(out);
}

/* ------- memory ------- */

typedef struct counting {
    size_t calls, left; /* allocations that are still granted */
} counting;

static void *count_alloc(size_t size, void *user) {
    counting *const c = user;
    c->calls++;
    return c->left && c->left-- ? malloc(size) : NULL;
}
static void *count_realloc(void *block, size_t size, void *user) {
    counting *const c = user;
    c->calls++;
    return c->left && c->left-- ? realloc(block, size) : NULL;
}
static void count_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void nothing_is_allocated_after_the_first_reading(void **state) {
    (void)state;
    const dp_batch batch = full_batch();
    counting c = {0, SIZE_MAX};
    const dp_allocator memory = {count_alloc, count_realloc, count_free, &c};
    const dp_placement places[5] = {{.hidden = true}, {.offset = {0, 0, 8}}};
    dp_source *source;
    assert_int_equal(dp_source_arrange(source_of(&batch), places, 5, &memory, &source, NULL),
                     DP_OK);
    size_t first = 0;
    for (int round = 0; round < 3; round++) {
        assert_int_equal(next(source).polygon_count, 3);
        assert_int_equal(next(source).polygon_count, 0);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
        if (!round) first = c.calls;
    }
    assert_int_equal(c.calls, first);
    dp_source_destroy(source);
}

static void running_out_of_memory_is_told(void **state) {
    (void)state;
    const dp_batch batch = full_batch();
    const dp_placement places[5] = {{.hidden = true}, {.offset = {0, 0, 8}}};
    bool done = false;
    for (size_t left = 0; left < 100 && !done; left++) {
        counting c = {0, left};
        const dp_allocator memory = {count_alloc, count_realloc, count_free, &c};
        dp_source *const inner = source_of(&batch);
        dp_source *source;
        dp_batch got;
        dp_diag diag;
        if (dp_source_arrange(inner, places, 5, &memory, &source, &diag)) {
            assert_int_equal(diag.result, DP_ERR_MEMORY);
            dp_source_destroy(inner);
            continue;
        }
        done = !dp_source_next(source, &got, &diag);
        if (!done) assert_int_equal(diag.result, DP_ERR_MEMORY);
        dp_source_destroy(source);
    }
    assert_true(done);
}

/* ------- pulling apart ------- */

static void explode(dp_source *source, dp_explosion explosion, dp_placement *places,
                    uint32_t most) {
    dp_group *const found = calloc(most, sizeof *found);
    uint32_t count;
    dp_diag diag = {0};
    assert_int_equal(dp_source_groups(source, found, most, &count, NULL), DP_OK);
    assert_true(count <= most);
    memset(places, 0, most * sizeof *places);
    if (dp_source_explode(source, found, count, &explosion, places, &diag))
        fail_msg("%s", diag.message);
    free(found);
}

static void assert_offset(const dp_placement *place, double x, double y, double z) {
    const double wanted[3] = {x, y, z};
    for (int k = 0; k < 3; k++)
        if (fabs(place->offset[k] - wanted[k]) > 1e-12)
            fail_msg("offset %g %g %g, not %g %g %g", place->offset[0], place->offset[1],
                     place->offset[2], x, y, z);
}

#define SQUARE(x) "v " #x " 0 0\nv " #x " 1 0\nv " #x " 1 1\n"
#define FACES     "f -3 -2 -1\n"

/* Centres at 0, 4 and 10; the whole box reaches from 0 to 10. */
static const char parts_text[] =
    "o a/left\n" SQUARE(0) FACES "o b\ng\n" SQUARE(4) FACES "o c\n" SQUARE(10) FACES;

static void parts_move_away_from_the_centre(void **state) {
    (void)state;
    dp_source *const source = file_of(parts_text);
    dp_placement places[3];
    explode(source, (dp_explosion){.factor = 1}, places, 3);
    assert_offset(&places[0], -5, 0, 0);
    assert_offset(&places[1], -1, 0, 0);
    assert_offset(&places[2], 5, 0, 0);
    explode(source, (dp_explosion){.factor = 0.5, .axis = {1e-200, 0, 0}}, places, 3);
    assert_offset(&places[2], 2.5, 0, 0);
    explode(source, (dp_explosion){.factor = 0.5, .axis = {0, 1e300, 0}}, places, 3);
    assert_offset(&places[2], 0, 0, 0);
    explode(source, (dp_explosion){.factor = 1, .axis = {1, 1, 0}}, places, 3);
    assert_offset(&places[2], 2.5, 2.5, 0);
    explode(source, (dp_explosion){.factor = 0}, places, 3);
    assert_offset(&places[0], 0, 0, 0);
    explode(source, (dp_explosion){.factor = -1}, places, 3);
    assert_offset(&places[0], 5, 0, 0);
    dp_source_destroy(source);
}

/* Hidden groups count, and offsets are added. */
static void hidden_parts_hold_their_place(void **state) {
    (void)state;
    dp_source *const source = file_of(parts_text);
    dp_group found[3];
    uint32_t count;
    dp_placement places[3] = {{.hidden = true, .offset = {0, 7, 0}}};
    assert_int_equal(dp_source_groups(source, found, 3, &count, NULL), DP_OK);
    assert_int_equal(
        dp_source_explode(source, found, count, &(dp_explosion){.factor = 1}, places, NULL), DP_OK);
    assert_true(places[0].hidden);
    assert_offset(&places[0], -5, 7, 0);
    assert_offset(&places[2], 5, 0, 0);
    dp_source_destroy(source);
}

static void names_tell_what_is_one_part(void **state) {
    (void)state;
    dp_source *source = file_of("o car/wheel/rim\n" SQUARE(0) FACES "o car/door\n" SQUARE(8) FACES
                                "o car/wheel/tyre\n" SQUARE(2) FACES);
    dp_placement places[3];
    explode(source, (dp_explosion){.factor = 1}, places, 3);
    assert_offset(&places[0], -3, 0, 0);
    assert_offset(&places[1], 4, 0, 0);
    assert_offset(&places[2], -3, 0, 0);
    dp_source_destroy(source);
    source = file_of("o bolt\n" SQUARE(0) FACES "o bolt/head\n" SQUARE(2) FACES
                     "o bolts\n" SQUARE(8) FACES);
    explode(source, (dp_explosion){.factor = 1}, places, 3);
    assert_offset(&places[0], -3, 0, 0);
    assert_offset(&places[1], -3, 0, 0);
    assert_offset(&places[2], 4, 0, 0);
    dp_source_destroy(source);
}

/* Of a scene, its sources are; without names, each group. */
static void sources_and_unnamed_groups_are_parts(void **state) {
    (void)state;
    static const char *const names[] = {"x/1", "x/2"};
    dp_source *parts[] = {file_of("o p\n" SQUARE(0) FACES "o q\n" SQUARE(2) FACES),
                          file_of("o p\n" SQUARE(8) FACES)};
    dp_source *joined;
    assert_int_equal(dp_source_join(parts, names, 2, NULL, &joined, NULL), DP_OK);
    dp_placement places[5];
    explode(joined, (dp_explosion){.factor = 1}, places, 5);
    assert_string_equal(dp_source_group_name(joined, 2), "x/1/q");
    assert_offset(&places[0], -3, 0, 0);
    assert_offset(&places[2], -3, 0, 0);
    assert_offset(&places[1], 4, 0, 0);
    dp_source_destroy(joined);
    const dp_batch batch = strip_batch();
    dp_source *const source = source_of(&batch);
    explode(source, (dp_explosion){.factor = 1}, places, 5);
    assert_offset(&places[0], 0, -0.5, 0);
    assert_offset(&places[1], 0, 0, 0);
    assert_offset(&places[4], 0, 0.5, 0);
    dp_source_destroy(source);
}

static void wrong_explosions_are_refused(void **state) {
    (void)state;
    dp_source *const source = file_of(parts_text);
    const dp_group group = {.polygons = 1};
    dp_placement place = {0};
    const double bad[] = {NAN, (double)INFINITY};
    for (int i = 0; i < 2; i++) {
        const dp_explosion factor = {.factor = bad[i]}, axis = {.axis = {0, bad[i], 0}};
        assert_int_equal(dp_source_explode(source, &group, 1, &factor, &place, NULL),
                         DP_ERR_ARGUMENT);
        assert_int_equal(dp_source_explode(source, &group, 1, &axis, &place, NULL),
                         DP_ERR_ARGUMENT);
    }
    const dp_explosion sound = {.factor = 1};
    assert_int_equal(dp_source_explode(NULL, &group, 1, &sound, &place, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_explode(source, NULL, 1, &sound, &place, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_explode(source, &group, 1, NULL, &place, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_explode(source, &group, 1, &sound, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_explode(source, NULL, 0, &sound, NULL, NULL), DP_OK);
    dp_source_destroy(source);
}

/* ------- pictures ------- */

static void picture_of(const char *text, const dp_placement *places, uint32_t count,
                       picture *into) {
    dp_context *context;
    const dp_context_desc desc = {.threads = 2};
    const dp_camera camera = scene_camera(9, 7, 12, 3, 1, 0);
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = into->rgba,
                              .line_class = into->line_class};
    dp_source *const source = arranged(file_of(text), places, count);
    dp_diag diag = {0};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    if (dp_draw(context, source, &camera, NULL, &target, &diag)) fail_msg("%s", diag.message);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

#define CORNERS                                                                                    \
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nv 4 0 0\nv 4 2 0\n"   \
    "v 4 0 2\nv 4 2 2\n"
#define LEFT  "o left\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\n"
#define RIGHT "o right\nf 2 3 10 9\nf 6 11 12 7\nf 2 9 11 6\nf 3 7 12 10\nf 9 10 12 11\n"

/* As if the file had them so: two halves of a box that share vertices. */
static void arranged_models_are_drawn_as_written_ones(void **state) {
    (void)state;
    static picture arranged_one, written;
    const dp_placement hidden[2] = {{.hidden = true}}, moved[2] = {[1] = {.offset = {1.5, 1, 0}}},
                       none = {0};
    picture_of(CORNERS LEFT RIGHT, hidden, 2, &arranged_one);
    picture_of(CORNERS RIGHT, &none, 1, &written);
    assert_memory_equal(&arranged_one, &written, sizeof written);
    picture_of(CORNERS LEFT RIGHT, moved, 2, &arranged_one);
    picture_of(CORNERS LEFT "v 3.5 1 0\nv 3.5 3 0\nv 3.5 1 2\nv 3.5 3 2\nv 5.5 1 0\nv 5.5 3 0\n"
                            "v 5.5 1 2\nv 5.5 3 2\no right\nf 13 14 18 17\nf 15 19 20 16\n"
                            "f 13 17 19 15\nf 14 16 20 18\nf 17 18 20 19\n",
               &none, 1, &written);
    assert_memory_equal(&arranged_one, &written, sizeof written);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_are_counted_and_measured),
        cmocka_unit_test(bad_corners_do_not_count),
        cmocka_unit_test(what_does_not_change_is_handed_on),
        cmocka_unit_test(hidden_groups_are_left_out),
        cmocka_unit_test(polygons_of_many_corners_are_left_out),
        cmocka_unit_test(moved_groups_take_their_corners_along),
        cmocka_unit_test(moved_batches_of_any_layout),
        cmocka_unit_test(empty_batches_are_passed_over),
        cmocka_unit_test(wrong_arrangements_are_refused),
        cmocka_unit_test(nothing_is_allocated_after_the_first_reading),
        cmocka_unit_test(running_out_of_memory_is_told),
        cmocka_unit_test(parts_move_away_from_the_centre),
        cmocka_unit_test(hidden_parts_hold_their_place),
        cmocka_unit_test(names_tell_what_is_one_part),
        cmocka_unit_test(sources_and_unnamed_groups_are_parts),
        cmocka_unit_test(wrong_explosions_are_refused),
        cmocka_unit_test(arranged_models_are_drawn_as_written_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
