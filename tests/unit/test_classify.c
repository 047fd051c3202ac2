/* stream/classify.inc: kernels of any width decide about a chunk's triangles as stream/classify.c
 * does, and what they leave to it does not depend on the width.
 *
 * With DRYPOINT_BENCH in the environment, times are printed as well. */
#include "stream/kernels.h"
#include "stream/chunk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum {
    TRIANGLES = DP_TUNED(4001, 301),
    WIDTH = 300,
    HEIGHT = 200,
    RECORD = 50,
    CORNERS_AT = 12,
    REPEATS = DP_TUNED(50, 1)
};

static uint8_t records[TRIANGLES][RECORD];
static dp_chunk plain, wide;

static uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static float unit_random(uint32_t *seed) { return (float)next_random(seed) / (1 << 23) - 1; }

/* Small ones in strips, as they come in files; among them large, thin, degenerate, far ones, and
 * odd numbers. */
static void make_records(void) {
    static const float odd[] = {0.0f,  -0.0f,  INFINITY, -INFINITY, NAN,
                                1e30f, -1e30f, 1e-40f,   3.4e38f};
    float p[9] = {0};
    uint32_t seed = 11;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        const uint32_t kind = next_random(&seed) % 64;
        const float size = kind == 0 ? 1 : kind < 4 ? 0.1f : 0.006f;
        memmove(p, p + 3, 6 * sizeof *p);
        if (t % 50 == 0)
            for (int i = 0; i < 3; i++) p[i] = p[3 + i] = 1.3f * unit_random(&seed);
        for (int i = 0; i < 3; i++) p[6 + i] = p[3 + i] + size * unit_random(&seed);
        if (t % 3 == 0) p[6 + 2] = p[3 + 2] - 0.0f * size;
        float out[9];
        memcpy(out, p, sizeof out);
        if (kind == 5) memcpy(out + 6, out, 3 * sizeof *out);
        if (kind == 6)
            for (int i = 0; i < 3; i++) out[6 + i] = (out[i] + out[3 + i]) / 2;
        if (kind == 7) out[next_random(&seed) % 9] = odd[next_random(&seed) % 9];
        if (kind == 8)
            for (int i = 0; i < 9; i++) out[i] *= 50;
        memset(records[t], 0x7f, RECORD);
        memcpy(records[t] + CORNERS_AT, out, sizeof out);
    }
}

static dp_view make_view(bool orthographic) {
    const double eye[3] = {0.3, 0.7, 4}, target[3] = {-0.1, 0, 0}, up[3] = {0, 1, 0};
    dp_camera camera;
    dp_view view;
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    if (orthographic)
        assert_int_equal(dp_camera_orthographic(&camera, 2, 1.5, 0.1, 10), DP_OK);
    else
        assert_int_equal(dp_camera_perspective(&camera, 30, 1.5, 0.1, 10), DP_OK);
    assert_int_equal(dp_view_init(&view, &camera, WIDTH, HEIGHT, NULL), DP_OK);
    return view;
}

/* Kernels that leave everything undecided. */
static void leave_all(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view) {
    (void)view;
    for (uint32_t t = 0; t < triangles->count; t++)
        chunk->unsure[chunk->unsure_count++] = (uint16_t)t;
}

static const dp_stream_kernels general = {.classify = leave_all, .touch = leave_all};

/* A picture whose surface is known in part, with a tenth of its pixels wanted. */
typedef struct picture {
    dp_view view;
    dp_chunk_view chunk;
    float *farthest;
    uint64_t *wanted, *flagged;
} picture;

static void make_picture(picture *p, bool orthographic, uint32_t samples) {
    uint32_t seed = 5;
    p->view = make_view(orthographic);
    p->chunk = (dp_chunk_view){.view = &p->view,
                               .tiles_x = (WIDTH + DP_TILE - 1) / DP_TILE,
                               .tiles_y = (HEIGHT + DP_TILE - 1) / DP_TILE};
    dp_sampling_init(&p->chunk.sampling, samples);
    const size_t tiles = (size_t)p->chunk.tiles_x * p->chunk.tiles_y;
    p->farthest = malloc(tiles * DP_BLOCKS * DP_BLOCKS * sizeof *p->farthest);
    p->wanted = calloc(tiles * DP_TILE, sizeof *p->wanted);
    p->flagged = calloc(tiles * DP_TILE, sizeof *p->flagged);
    p->chunk.maps.row = (p->chunk.tiles_x * DP_TILE + 15) / 16;
    p->chunk.maps.map = p->chunk.tiles_y * DP_TILE * p->chunk.maps.row;
    p->chunk.maps.words = malloc(4 * (size_t)p->chunk.maps.map * sizeof *p->chunk.maps.words);
    assert_true(p->farthest && p->wanted && p->flagged && p->chunk.maps.words);
    const float nearer = orthographic ? -3.5f : 1 / 3.5f, middle = orthographic ? -4.1f : 1 / 4.1f;
    for (size_t i = 0; i < tiles * DP_BLOCKS * DP_BLOCKS; i++)
        p->farthest[i] = i / 8 % 3 == 0 ? DP_DEPTH_EMPTY : i / 8 % 3 == 1 ? middle : nearer;
    for (size_t i = 0; i < tiles * DP_TILE * 6; i++) {
        p->wanted[next_random(&seed) % (tiles * DP_TILE)] |= (uint64_t)1
                                                             << next_random(&seed) % DP_TILE;
        if (i % 2)
            p->flagged[next_random(&seed) % (tiles * DP_TILE)] |= (uint64_t)1
                                                                  << next_random(&seed) % DP_TILE;
    }
    p->chunk.farthest = p->farthest;
    p->chunk.wanted = p->wanted, p->chunk.flagged = p->flagged;
    dp_pixel_maps_fill(&p->chunk);
}

static void free_picture(picture *p) {
    free(p->farthest);
    free(p->wanted);
    free(p->flagged);
    free(p->chunk.maps.words);
}

static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

/* Classifies records [first, first + count). */
static dp_stats classify(dp_chunk *chunk, const dp_stream_kernels *kernels, dp_chunk_view view,
                         uint32_t first, uint32_t count) {
    const dp_triangles triangles = {records[first] + CORNERS_AT, RECORD, count, NULL};
    dp_stats stats = {0};
    view.kernels = kernels;
    dp_chunk_classify(chunk, &triangles, &view, &stats);
    return stats;
}

enum { FOR_GOOD = 0xff & ~DP_TRIANGLE_WITHIN };

/* Counts the triangles that the kernel has left alive itself, and those with any state. */
static void expect_general(dp_width kernels, const dp_chunk_view *view, uint32_t first,
                           uint32_t count, uint32_t counts[2]) {
    const dp_stats truth = classify(&plain, &general, *view, first, count),
                   stats =
                       classify(&wide, dp_stream_kernels_for(kernels.lanes), *view, first, count);
    assert_int_equal(truth.dropped_finite, stats.dropped_finite);
    assert_int_equal(truth.dropped_area, stats.dropped_area);
    for (uint32_t t = 0; t < count; t++) {
        if (plain.state[t] != (wide.state[t] & FOR_GOOD))
            fail_msg("%s: triangle %u has state %x, not %x", kernels.name, first + t, wide.state[t],
                     plain.state[t]);
        if (plain.state[t] & DP_TRIANGLE_LIVE)
            assert_memory_equal(plain.normal[t], wide.normal[t], sizeof *plain.normal);
        counts[1] += plain.state[t] != 0;
        counts[0] += plain.state[t] != 0;
    }
    for (uint32_t i = 0; i < wide.unsure_count; i++) counts[0] -= wide.state[wide.unsure[i]] != 0;
    const uint32_t unsure = wide.unsure_count;
    classify(&plain, &dp_stream_kernels_plain, *view, first, count);
    assert_int_equal(plain.unsure_count, unsure);
    assert_memory_equal(plain.unsure, wide.unsure, unsure * sizeof *plain.unsure);
    assert_memory_equal(plain.state, wide.state, count);
    for (uint32_t t = 0; t < count; t++)
        for (int e = 0; e < 3 && wide.state[t]; e++)
            assert_int_equal(plain.edge_key[e][t], wide.edge_key[e][t]);
}

static void check(const dp_chunk_view *view, const char *what) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t counts[2] = {0};
        for (uint32_t first = 0; first < TRIANGLES; first += DP_CHUNK)
            expect_general(list[i], view, first,
                           TRIANGLES - first < DP_CHUNK ? TRIANGLES - first : DP_CHUNK, counts);
        for (uint32_t n = 1; n < 40 && n <= DP_CHUNK; n++)
            expect_general(list[i], view, 100, n, (uint32_t[2]){0});
        assert_true(counts[1] > TRIANGLES / 40);
        assert_true(counts[0] > counts[1] / 3);
        const double start = now_ns();
        for (int r = 0; r < REPEATS; r++)
            classify(&wide, dp_stream_kernels_for(list[i].lanes), *view, 0, DP_TUNED(4000, 3));
        if (getenv("DRYPOINT_BENCH"))
            print_message("%-6s %-7s %6.2f ns each\n", what, list[i].name,
                          (now_ns() - start) / 4000 / REPEATS);
    }
}

static void kernels_agree(void **state) {
    static const uint32_t samples[] = {1, 4, 8, 16};
    (void)state;
    for (int k = 0; k < 8; k++) {
        picture p;
        make_picture(&p, k % 2, samples[k / 2]);
        p.chunk.wanted = NULL;
        check(&p.chunk, "classify");
        free_picture(&p);
    }
}

static void touches_agree(void **state) {
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        picture p;
        make_picture(&p, orthographic, 4);
        check(&p.chunk, "touch");
        free_picture(&p);
    }
}

/* Whatever the bits of 0, and from both sides. */
static void equal_edges_have_equal_keys(void **state) {
    static const float same[2][9] = {{0.0f, 0.5f, -0.0f, 0.25f, 0.0f, 0.0f, 0, 0, 0.1f},
                                     {0.25f, -0.0f, 0.0f, -0.0f, 0.5f, 0.0f, 0, 0, -0.1f}};
    const dp_triangles triangles = {(const uint8_t *)same, sizeof *same, 2, NULL};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    picture p;
    make_picture(&p, false, 4);
    p.chunk.wanted = NULL;
    for (size_t i = 0; i < (size_t)p.chunk.tiles_x * p.chunk.tiles_y * DP_BLOCKS * DP_BLOCKS; i++)
        p.farthest[i] = DP_DEPTH_EMPTY;
    for (uint32_t i = 0; i < count; i++) {
        dp_stats stats = {0};
        p.chunk.kernels = dp_stream_kernels_for(list[i].lanes);
        dp_chunk_classify(&wide, &triangles, &p.chunk, &stats);
        assert_true(wide.state[0] & DP_TRIANGLE_LIVE);
        assert_true(wide.state[1] & DP_TRIANGLE_LIVE);
        assert_int_equal(wide.edge_key[0][0], wide.edge_key[0][1]);
        assert_int_not_equal(wide.edge_key[0][0], wide.edge_key[1][0]);
        dp_chunk_edges(&wide, &triangles, &p.chunk);
        assert_int_equal(wide.edge_count, 5);
        assert_int_equal(wide.alone[0] & 1, 0);
    }
    free_picture(&p);
}

static int set_up(void **state) {
    (void)state;
    make_records();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(touches_agree),
        cmocka_unit_test(equal_edges_have_equal_keys),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
