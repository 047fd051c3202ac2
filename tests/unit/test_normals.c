/* mesh/normals and mesh/attributes: computed normals, a model's normals, texture coordinates. */
#include "mesh/normals.h"
#include "reading.h"

#include <math.h>

static dp_polygons polygons_of(const dp_batch *b) {
    return (dp_polygons){.positions = b->positions,
                         .stride = 12,
                         .vertex_count = (uint32_t)b->vertex_count,
                         .corners = b->indices,
                         .firsts = b->firsts,
                         .count = (uint32_t)b->polygon_count};
}

static const float cube_corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                         {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const uint32_t cube_faces[24] = {3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4,
                                        2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
static const uint32_t cube_firsts[7] = {0, 4, 8, 12, 16, 20, 24};
static const float cube_normals[6][3] = {{0, 0, -1}, {0, 0, 1},  {0, -1, 0},
                                         {0, 1, 0},  {-1, 0, 0}, {1, 0, 0}};

typedef struct maker {
    dp_threads *threads;
    dp_allocator memory;
    dp_normal_store store;
    dp_attribute made;
} maker;

static maker begin(uint32_t threads) {
    maker m = {.memory = dp_allocator_resolve(NULL)};
    m.threads = dp_threads_create(threads, NULL, NULL, &m.memory);
    return m;
}

static void make(maker *m, const dp_batch *batch, float crease) {
    const dp_polygons polygons = polygons_of(batch);
    assert_true(
        dp_normals_make(&m->store, &polygons, crease, NULL, m->threads, &m->memory, &m->made));
}

static void end(maker *m) {
    dp_normal_store_free(&m->store, &m->memory);
    dp_threads_destroy(m->threads);
}

static const float *normal_of(const maker *m, size_t corner) {
    const uint32_t i = dp_attribute_number(&m->made, corner, UINT32_MAX);
    return i == UINT32_MAX ? NULL : dp_attribute_value(&m->made, i);
}

static void assert_normal(const maker *m, size_t corner, double x, double y, double z) {
    const float *const n = normal_of(m, corner);
    const double expected[3] = {x, y, z};
    assert_non_null(n);
    for (int k = 0; k < 3; k++) assert_true(fabs((double)n[k] - expected[k]) < 1e-6);
}

static const dp_batch cube = {.positions = cube_corners[0],
                              .vertex_count = 8,
                              .indices = cube_faces,
                              .corner_count = 24,
                              .firsts = cube_firsts,
                              .polygon_count = 6};

static void creases_part_a_cube(void **state) {
    (void)state;
    maker m = begin(1);
    make(&m, &cube, 40);
    for (size_t c = 0; c < 24; c++) {
        const float *const n = cube_normals[c / 4];
        assert_normal(&m, c, (double)n[0], (double)n[1], (double)n[2]);
    }
    end(&m);
}

static void angles_weigh_and_not_areas_or_counts(void **state) {
    (void)state;
    maker m = begin(2);
    make(
        &m, &cube,
        180); /* all round: the diagonals, although every corner has three polygons of 90 degrees */
    for (size_t c = 0; c < 24; c++) {
        const float *const p = cube_corners[cube_faces[c]];
        const double k = 1 / sqrt(3.0);
        assert_normal(&m, c, k * (double)p[0], k * (double)p[1], k * (double)p[2]);
    }
    /* the same with two sides split into triangles: two of 45 degrees weigh what one of 90 does */
    static const uint32_t split[] = {3, 2, 1, 3, 1, 0, 4, 5, 6, 4, 6, 7, 0, 1,
                                     5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
    static const uint32_t firsts[] = {0, 3, 6, 9, 12, 16, 20, 24, 28};
    const dp_batch parts = {.positions = cube_corners[0],
                            .vertex_count = 8,
                            .indices = split,
                            .corner_count = 28,
                            .firsts = firsts,
                            .polygon_count = 8};
    make(&m, &parts, 180);
    for (size_t c = 0; c < 28; c++) {
        const float *const p = cube_corners[split[c]];
        const double k = 1 / sqrt(3.0);
        assert_normal(&m, c, k * (double)p[0], k * (double)p[1], k * (double)p[2]);
    }
    end(&m);
}

static void sheet(float (*at)[3], uint32_t *corners, int n) {
    for (int y = 0; y <= n; y++)
        for (int x = 0; x <= n; x++) {
            float *const p = at[y * (n + 1) + x];
            p[0] = (float)x, p[1] = (float)y,
            p[2] = 0.3f * sinf((float)x) * cosf((float)y) + (x > n / 2 ? (float)x : 0);
        }
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++) {
            const uint32_t a = (uint32_t)(y * (n + 1) + x), b = a + 1, c = b + (uint32_t)n + 1,
                           d = c - 1;
            const uint32_t six[6] = {a, b, c, a, c, d};
            memcpy(corners + 6 * (y * n + x), six, sizeof six);
        }
}

enum { N = 24, CORNERS = 6 * N * N };

static void soups_and_threads_make_no_difference(void **state) {
    (void)state;
    static float at[(N + 1) * (N + 1)][3], soup[CORNERS][3];
    static uint32_t corners[CORNERS];
    sheet(at, corners, N);
    for (int c = 0; c < CORNERS; c++) memcpy(soup[c], at[corners[c]], sizeof *soup);
    const dp_batch indexed = {.positions = at[0],
                              .vertex_count = (N + 1) * (N + 1),
                              .indices = corners,
                              .corner_count = CORNERS,
                              .polygon_count = CORNERS / 3};
    const dp_batch empty = {.positions = soup[0],
                            .vertex_count = CORNERS,
                            .corner_count = CORNERS,
                            .polygon_count = CORNERS / 3};
    maker one = begin(1), many = begin(7);
    make(&one, &indexed, 30);
    make(&many, &empty, 30);
    int creases = 0;
    for (size_t c = 0; c < CORNERS; c++) {
        assert_memory_equal(normal_of(&one, c), normal_of(&many, c), 12);
        creases += dp_attribute_number(&one.made, c, 0) >= indexed.vertex_count;
    }
    assert_true(creases > 0 && creases < CORNERS);
    end(&one);
    end(&many);
}

static void what_is_broken_stays_away(void **state) {
    (void)state;
    static const float at[][3] = {{0, 0, 0},   {1, 0, 0},        {0, 1, 0},    {2, 0, 0},
                                  {NAN, 0, 0}, {INFINITY, 1, 0}, {-0.0f, 0, 0}};
    static const uint32_t corners[] = {0,
                                       1,
                                       2,
                                       /* no area */ 0,
                                       1,
                                       3,
                                       /* not finite */ 0,
                                       1,
                                       4,
                                       5,
                                       2,
                                       1,
                                       /* no vertex */ 0,
                                       1,
                                       99,
                                       /* all the same */ 6,
                                       6,
                                       6,
                                       6,
                                       1,
                                       2};
    const dp_batch batch = {.positions = at[0],
                            .vertex_count = 7,
                            .indices = corners,
                            .corner_count = 21,
                            .polygon_count = 7};
    maker m = begin(1);
    make(&m, &batch, 60);
    for (size_t c = 0; c < 21; c++) {
        if (c < 3 || c >= 18)
            assert_normal(&m, c, 0, 0, 1);
        else
            assert_null(normal_of(&m, c));
    }
    for (size_t i = 0; i < m.made.count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(isfinite(dp_attribute_value(&m.made, (uint32_t)i)[k]));
    end(&m);
}

static void nothing_is_made_twice(void **state) {
    (void)state;
    float at[8][3];
    memcpy(at, cube_corners, sizeof at);
    dp_batch batch = cube;
    batch.positions = at[0];
    maker m = begin(1);
    make(&m, &batch, 40);
    const uint64_t key = m.store.key;
    m.store.values[m.made.indices[0]][0] = 7; /* a mark that only computing again would wipe out */
    make(&m, &batch, 40);
    assert_true(m.store.key == key && m.store.values[m.made.indices[0]][0] == 7);
    at[6][0] = 1.5f;
    make(&m, &batch, 40);
    assert_true(m.store.key != key && m.store.values[m.made.indices[0]][0] != 7);
    const uint64_t moved = m.store.key;
    make(&m, &batch, 41);
    assert_true(m.store.key != moved);
    end(&m);
}

/* ------- brought along ------- */

static void read_text(const char *text, dp_file_format format, dp_source **source,
                      dp_batch *batch) {
    dp_stream *stream = NULL;
    dp_stream_open_memory(text, strlen(text), 2048, NULL, &stream, NULL);
    assert_int_equal(dp_read_stream(stream, NULL, format, source, NULL), DP_OK);
    assert_int_equal(dp_source_next(*source, batch, NULL), DP_OK);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void obj_brings_normals_and_texcoords(void **state) {
    (void)state;
    dp_source *source = NULL;
    dp_batch b;
    read_text(TRIANGLE "f 1 2 3\nvn 0 0 1\nvn 1 0\nvt .5 .25 1\nf 1//1 2/1/-1 3/-1\nf 1/7/7 2/0/0 "
                       "3/-9/99999999999999999999\nf 1 2 3\n",
              DP_FORMAT_OBJ, &source, &b);
    static const uint32_t none = UINT32_MAX;
    const uint32_t normals[12] = {none, none, none, 0, 1, none, none, none, none, none, none, none};
    const uint32_t texcoords[12] = {none, none, none, none, 0,    0,
                                    none, none, none, none, none, none};
    assert_int_equal(b.normals.count, 2);
    assert_int_equal(b.texcoords.count, 1);
    for (size_t c = 0; c < 12; c++) {
        assert_int_equal(dp_attribute_number(&b.normals, c, 0), normals[c]);
        assert_int_equal(dp_attribute_number(&b.texcoords, c, 0), texcoords[c]);
    }
    assert_true(dp_attribute_value(&b.normals, 1)[0] == 1 &&
                dp_attribute_value(&b.normals, 1)[1] == 0);
    assert_true(dp_attribute_value(&b.texcoords, 0)[1] == 0.25f);
    dp_source_destroy(source);
    read_text(TRIANGLE "f 1 2 3\n", DP_FORMAT_OBJ, &source, &b);
    assert_true(!b.normals.values && !b.texcoords.values);
    dp_source_destroy(source);
}

static void ply_brings_normals_and_texcoords(void **state) {
    (void)state;
    dp_source *source = NULL;
    dp_batch b;
    read_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float "
              "x\nproperty float y\n"
              "property float ny\nproperty float z\nproperty float nz\nproperty float u\nproperty "
              "float v\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "1 0 0 2 0 3 .5 .25\n4 1 0 5 0 6 0 1\n7 0 1 8 0 9 1 0\n3 0 1 2\n",
              DP_FORMAT_PLY, &source, &b);
    assert_true(b.normals.values && b.texcoords.values && !b.normals.indices);
    for (uint32_t v = 0; v < 3; v++)
        for (uint32_t k = 0; k < 3; k++)
            assert_true(dp_attribute_value(&b.normals, v)[k] == (float)(3 * v + k + 1));
    assert_true(b.texcoords.values[0] == 0.5f && b.texcoords.values[3] == 1);
    dp_source_destroy(source);
}

/* Two batches, the first without normals, the second with; a concave polygon is split. */
typedef struct batches {
    dp_batch batch[2];
    int at;
} batches;

static dp_result batches_next(void *user, dp_batch *batch, dp_diag *diag) {
    batches *const b = user;
    (void)diag;
    if (b->at < 2) *batch = b->batch[b->at++];
    return DP_OK;
}

static void gathering_keeps_what_corners_carry(void **state) {
    (void)state;
    static const float at[5][3] = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {9, 9, 9}};
    static const float uv[5][2] = {{0, 0}, {1, 0}, {.25f, .25f}, {0, 1}, {9, 9}};
    static const uint32_t four[4] = {0, 1, 2, 3}, three[3] = {0, 1, 3}, firsts[2] = {0, 4};
    static const float normals[2][3] = {{0, 0, 1}, {0, 1, 0}};
    static const uint32_t numbers[4] = {1, 0, UINT32_MAX, 1};
    batches b = {{{.positions = at[0],
                   .vertex_count = 5,
                   .indices = three,
                   .corner_count = 3,
                   .polygon_count = 1},
                  {.positions = at[0],
                   .vertex_count = 5,
                   .indices = four,
                   .corner_count = 4,
                   .firsts = firsts,
                   .polygon_count = 1,
                   .normals = {.values = normals[0], .count = 2, .indices = numbers},
                   .texcoords = {.values = uv[0], .count = 5}}},
                 0};
    const dp_source_callbacks callbacks = {.user = &b, .next = batches_next};
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_source *source = NULL;
    dp_polygon_store store = {0};
    dp_polygons p;
    dp_stats stats = {0};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_gather(source, &store, &memory, &p, &stats, NULL), DP_OK);
    assert_int_equal(p.count, 3);
    for (uint32_t c = 0; c < 9; c++) {
        const uint32_t vertex =
            dp_corner_vertex(&p, c) % 5; /* the second batch's vertices come behind five */
        const uint32_t normal = dp_attribute_number(&p.normals, c, 0),
                       texcoord = dp_attribute_number(&p.texcoords, c, 0);
        if (c < 3)
            assert_true(normal == UINT32_MAX && texcoord == UINT32_MAX);
        else
            assert_true(normal == numbers[vertex] && texcoord == vertex);
    }
    dp_polygon_store_free(&store, &memory);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(creases_part_a_cube),
        cmocka_unit_test(angles_weigh_and_not_areas_or_counts),
        cmocka_unit_test(soups_and_threads_make_no_difference),
        cmocka_unit_test(what_is_broken_stays_away),
        cmocka_unit_test(nothing_is_made_twice),
        cmocka_unit_test(obj_brings_normals_and_texcoords),
        cmocka_unit_test(ply_brings_normals_and_texcoords),
        cmocka_unit_test(gathering_keeps_what_corners_carry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
