/* Kernels: every width of vectors gives the bits of plain C; and what each kernel takes.
 *
 * Kernels that work on a whole tile are compared by the pictures and lines they make
 * (test_determinism.c). With DRYPOINT_BENCH in the environment, times are printed as well. */
#include "find/finder.h"
#include "find/kernels.h"
#include "raster/kernels.h"
#include "core/bin.h"
#include "core/fold.h"
#include "find/fold_batch.h"
#include "core/frame.h"
#include "core/outline.h"
#include "raster/tile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_tests.h"

enum { VERTICES = 1003, TRIANGLES = 2 * VERTICES + 1, REPEATS = 200 };

static float positions[VERTICES][3];
static uint32_t corners[3 * TRIANGLES];

static void make_model(void) {
    static const float odd[] = {0.0f,  -0.0f,  INFINITY, -INFINITY, NAN,
                                1e30f, -1e30f, 1e-40f,   3.4e38f};
    uint32_t seed = 7;
    for (int v = 0; v < VERTICES; v++)
        for (int k = 0; k < 3; k++) {
            positions[v][k] = (float)next_random(&seed) / (1 << 23) * 2 - 2;
            if (v % 37 == 5) positions[v][k] = odd[next_random(&seed) % 9];
        }
    for (uint32_t c = 0; c < 3 * TRIANGLES; c++) {
        const uint32_t v = next_random(&seed);
        corners[c] = v % 97 == 0 ? UINT32_MAX - v % 3 : v % 3 ? c / 3 / 3 + v % 5 : v % VERTICES;
    }
}

static void report(const char *what, dp_width kernels, double start, uint32_t count) {
    if (getenv("DRYPOINT_BENCH"))
        print_message("%-10s %-7s %6.2f ns each\n", what, kernels.name,
                      (now_ns() - start) / count / REPEATS);
}

/* x is NaN where a vertex must be clipped; its sign and payload mean nothing. */
static void expect_same_vertices(const dp_vertex *a, const dp_vertex *b, uint32_t count,
                                 const char *name) {
    for (uint32_t v = 0; v < count; v++) {
        const bool clipped = isnan(a[v].x);
        if (a[v].key != b[v].key) fail_msg("%s: vertex %u has another key", name, v);
        if (clipped ? !isnan(b[v].x) : memcmp(&a[v], &b[v], sizeof a[v]) != 0)
            fail_msg("%s: vertex %u differs", name, v);
    }
}

static void transforms_agree(void **state) {
    static dp_vertex truth[VERTICES], vertices[VERTICES];
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        const dp_view view = make_view(orthographic);
        dp_raster_kernels_plain.transform(&view, positions[0], sizeof *positions, VERTICES, truth,
                                          false);
        for (uint32_t i = 0; i < count; i++) {
            const double start = now_ns();
            for (int r = 0; r < REPEATS; r++)
                dp_raster_kernels_for(list[i].lanes)
                    ->transform(&view, positions[0], sizeof *positions, VERTICES, vertices, r & 1);
            report("transform", list[i], start, VERTICES);
            expect_same_vertices(truth, vertices, VERTICES, list[i].name);
            for (uint32_t n = 1; n < 20; n++) { /* any length, and not a byte beyond */
                memset(vertices, 0x55, sizeof vertices);
                dp_raster_kernels_for(list[i].lanes)
                    ->transform(&view, positions[3], sizeof *positions, n, vertices, n & 1);
                expect_same_vertices(truth + 3, vertices, n, list[i].name);
                assert_int_equal(vertices[n].key, 0x55555555);
            }
        }
    }
}

static void equal_positions_have_equal_keys(void **state) {
    const float same[2][3] = {{0.0f, 1, -0.0f}, {-0.0f, 1, 0.0f}};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    const dp_view view = make_view(false);
    (void)state;
    for (uint32_t i = 0; i < count; i++) {
        dp_vertex v[2];
        dp_raster_kernels_for(list[i].lanes)->transform(&view, same[0], sizeof *same, 2, v, false);
        assert_int_equal(v[0].key, v[1].key);
    }
}

static bool same_rect(const dp_tile_rect *a, const dp_tile_rect *b) {
    if (a->x0 == DP_UNPLACED || b->x0 == DP_UNPLACED) return a->x0 == b->x0;
    return a->x0 == b->x0 && a->y0 == b->y0 && a->x1 == b->x1 && a->y1 == b->y1 &&
           a->tag == b->tag && a->only == b->only;
}

/* A batch with an index out of range is left undecided as a whole: widths differ in what they
 * leave, never in what they place. */
static void places_agree(void **state) {
    static dp_vertex vertices[VERTICES];
    static dp_tile_rect truth[TRIANGLES], rects[TRIANGLES];
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    for (int indexed = 0; indexed < 2; indexed++) {
        dp_frame frame = {.view = make_view(false), .tiles_x = 19, .tiles_y = 13};
        frame.nearly_edge_on = dp_nearly_edge_on(&frame.view);
        frame.vertices = vertices;
        frame.polygons = (dp_polygons){.positions = positions[0],
                                       .stride = sizeof *positions,
                                       .vertex_count = VERTICES,
                                       .corners = indexed ? corners : NULL,
                                       .count = indexed ? TRIANGLES : VERTICES / 3};
        dp_raster_kernels_plain.transform(&frame.view, positions[0], sizeof *positions, VERTICES,
                                          vertices, false);
        dp_raster_kernels_plain.place(&frame, 0.75f, 0, frame.polygons.count, truth);
        for (uint32_t i = 0; i < count; i++) {
            const double start = now_ns();
            uint32_t placed = 0;
            for (int r = 0; r < REPEATS; r++)
                dp_raster_kernels_for(list[i].lanes)
                    ->place(&frame, 0.75f, 0, frame.polygons.count, rects);
            report("place", list[i], start, frame.polygons.count);
            for (uint32_t t = 0; t < frame.polygons.count; t++) {
                placed += rects[t].x0 != DP_UNPLACED;
                if (indexed && rects[t].x0 == DP_UNPLACED) continue;
                if (!same_rect(&truth[t], &rects[t]))
                    fail_msg("%s: triangle %u differs", list[i].name, t);
            }
            assert_true(placed > frame.polygons.count / 50);
        }
    }
}

static void parts_agree(void **state) {
    enum { ENTRIES = 1000, ROOM = ENTRIES + DP_BIN_ROOM };
    static uint32_t entries[ENTRIES], ids[ROOM], backs[ROOM];
    (void)state;
    uint32_t seed = 3;
    for (uint32_t i = 0; i < ENTRIES; i++)
        entries[i] = next_random(&seed) | (next_random(&seed) % 3 ? 0 : DP_BIN_TAG);
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t kinds = dp_widths_list(list);
    for (uint32_t k = 0; k < kinds; k++) {
        for (uint32_t n = 0; n < ENTRIES; n = n < 40 ? n + 1 : n + 97) {
            uint32_t count = 1, back_count = 2, front = 1, back = 2;
            dp_raster_kernels_for(list[k].lanes)->part(entries, n, ids, &count, backs, &back_count);
            for (uint32_t i = 0; i < n; i++) {
                const bool away = entries[i] & DP_BIN_TAG;
                assert_int_equal(away ? backs[back++] : ids[front++], entries[i] & ~DP_BIN_TAG);
            }
            assert_int_equal(count, front);
            assert_int_equal(back_count, back);
        }
        const double start = now_ns();
        for (int i = 0; i < REPEATS; i++) {
            uint32_t count = 0, back_count = 0;
            dp_raster_kernels_for(list[k].lanes)
                ->part(entries, ENTRIES, ids, &count, backs, &back_count);
        }
        report("part", list[k], start, ENTRIES);
    }
}

enum { CANDIDATES = 150, CANDIDATE_STRIDE = CANDIDATES + DP_INTERSECTING_ROOM };

/* Which corners of intersection candidate a coincide with one of b's, a bit each; and how many
 * pairs do. */
static uint32_t shared_corners(const dp_intersecting *intersecting, uint32_t a, uint32_t b,
                               uint32_t *pairs) {
    uint32_t shared = 0;
    *pairs = 0;
    for (uint32_t i = 0; i < 9; i++) {
        const bool same = intersecting->keys[i / 3 * CANDIDATE_STRIDE + a] ==
                          intersecting->keys[i % 3 * CANDIDATE_STRIDE + b];
        *pairs += same;
        shared |= (uint32_t)same << i / 3;
    }
    return shared;
}

static float member(const dp_intersecting *intersecting, uint32_t which, uint32_t of) {
    return intersecting->members[which * CANDIDATE_STRIDE + of];
}

/* All corners of a that are not b's as well lie on one side of b's plane. */
static bool lies_beside(const dp_intersecting *intersecting, uint32_t a, uint32_t b) {
    uint32_t pairs, nearer = 0, further = 0;
    const uint32_t shared = shared_corners(intersecting, a, b, &pairs);
    for (uint32_t c = 0; c < 3; c++) {
        const uint32_t at = DP_INTERSECTING_CORNERS + 3 * c;
        const float plane =
            member(intersecting, DP_INTERSECTING_PLANE, b) +
            member(intersecting, DP_INTERSECTING_PLANE + 1, b) * member(intersecting, at, a) +
            member(intersecting, DP_INTERSECTING_PLANE + 2, b) * member(intersecting, at + 1, a);
        const float gap = member(intersecting, at + 2, a) - plane;
        if (shared >> c & 1) continue;
        nearer += gap >= 0, further += gap <= 0;
    }
    return !nearer || !further;
}

static bool bounds_meet(const dp_intersecting *intersecting, uint32_t a, uint32_t b) {
    bool apart = false;
    for (uint32_t k = 0; k < 3; k++)
        apart |= member(intersecting, DP_INTERSECTING_MOST + k, a) <
                     member(intersecting, DP_INTERSECTING_LEAST + k, b) ||
                 member(intersecting, DP_INTERSECTING_MOST + k, b) <
                     member(intersecting, DP_INTERSECTING_LEAST + k, a);
    return !apart;
}

/* Triangles with corners in whole numbers, so that bounds touch and corners lie in planes now and
 * then; every fifth one's plane is unknown. */
static void fill_members(float *members, uint32_t *keys, uint32_t *seed) {
    for (uint32_t i = 0; i < 3 * CANDIDATE_STRIDE; i++) keys[i] = next_random(seed) % 12;
    for (uint32_t i = 0; i < CANDIDATES; i++) {
        float at[3], *const of = members + i;
        for (uint32_t k = 0; k < 3; k++) at[k] = (float)(next_random(seed) % 25);
        for (uint32_t k = 0; k < 3; k++) {
            float least = 100, most = 0;
            for (uint32_t c = 0; c < 3; c++) {
                const float v = at[k] + (float)(next_random(seed) % 10);
                of[(DP_INTERSECTING_CORNERS + 3 * c + k) * CANDIDATE_STRIDE] = v;
                least = dp_minf(least, v), most = dp_maxf(most, v);
            }
            of[(DP_INTERSECTING_LEAST + k) * CANDIDATE_STRIDE] = least;
            of[(DP_INTERSECTING_MOST + k) * CANDIDATE_STRIDE] = most;
            of[(DP_INTERSECTING_PLANE + k) * CANDIDATE_STRIDE] = (float)(next_random(seed) % 3);
        }
        of[DP_INTERSECTING_PLANE * CANDIDATE_STRIDE] = i % 5 ? at[2] - at[0] - at[1] : NAN;
    }
}

/* Which candidates meet, against a test of all pairs. */
static void meetings_agree(void **state) {
    static float members[DP_INTERSECTING_MEMBERS * CANDIDATE_STRIDE];
    static uint32_t met[CANDIDATE_STRIDE], keys[3 * CANDIDATE_STRIDE];
    (void)state;
    uint32_t seed = 9, neighbours = 0, beside = 0, crossing = 0;
    fill_members(members, keys, &seed);
    const dp_intersecting intersecting = {.members = members,
                                          .keys = keys,
                                          .met = met,
                                          .count = CANDIDATES,
                                          .stride = CANDIDATE_STRIDE};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t kinds = dp_widths_list(list);
    for (uint32_t k = 0; k < kinds; k++) {
        const double start = now_ns();
        for (uint32_t self = 0; self < CANDIDATES; self++) {
            const uint32_t end = self + 1 + next_random(&seed) % (CANDIDATES - self),
                           count =
                               dp_find_kernels_for(list[k].lanes)->meet(&intersecting, self, end);
            uint32_t expected = 0, pairs;
            for (uint32_t i = self + 1; i < end; i++) {
                if (!bounds_meet(&intersecting, self, i)) continue;
                shared_corners(&intersecting, self, i, &pairs);
                if (pairs > 1) {
                    neighbours++;
                } else if (self % 5 && i % 5 &&
                           (lies_beside(&intersecting, self, i) ||
                            lies_beside(&intersecting, i, self))) {
                    beside++;
                } else {
                    assert_int_equal(met[expected++], i);
                    crossing += self % 5 && i % 5;
                }
            }
            assert_int_equal(count, expected);
        }
        report("meet", list[k], start, CANDIDATES * CANDIDATES / 4);
    }
    assert_true(neighbours && beside && crossing);
}

enum { CLOSE_POLYGONS = 40 };

/* Polygons and samples that came close, of one tile with four samples per pixel. */
static void make_close(dp_finder *w, dp_tile_polygon *polygons, uint32_t *keys, uint32_t *winner) {
    uint32_t seed = 77;
    w->tile.polygons = polygons, w->tile.winner = winner, w->tile.keys = keys,
    w->tile.keys_stride = CLOSE_POLYGONS;
    dp_sampling_init(&w->tile.sampling, 4);
    for (uint32_t i = 0; i < 3 * CLOSE_POLYGONS; i++) keys[i] = next_random(&seed) % 90;
    for (uint32_t i = 0; i < CLOSE_POLYGONS; i++)
        polygons[i] = (dp_tile_polygon){.flags = next_random(&seed) % 2 ? DP_POLYGON_FRONT : 0,
                                        .dx = (float)(next_random(&seed) % 9),
                                        .dy = (float)(next_random(&seed) % 9)};
    for (uint32_t i = 0; i < DP_TILE * DP_TILE * 4; i++)
        winner[i] = next_random(&seed) % 9 ? UINT32_MAX : next_random(&seed) % CLOSE_POLYGONS;
    w->tile.close.count = 500;
    for (uint32_t i = 0; i < w->tile.close.count; i++) {
        w->tile.close.polygon[i] = next_random(&seed) % CLOSE_POLYGONS;
        w->tile.close.other[i] = i % 7 ? next_random(&seed) % CLOSE_POLYGONS : UINT32_MAX;
        w->tile.close.lane[i] = i;
        w->tile.close.gap[i] = (float)(next_random(&seed) % 16) * 0.75f;
    }
}

static bool is_crossed(const dp_finder *w, uint32_t a, uint32_t b, float gap) {
    const dp_tile_polygon *const p = &w->tile.polygons[a], *const q = &w->tile.polygons[b];
    for (uint32_t i = 0; i < 9; i++)
        if (w->tile.keys[i / 3 * CLOSE_POLYGONS + a] == w->tile.keys[i % 3 * CLOSE_POLYGONS + b])
            return false;
    return (p->flags | q->flags) & DP_POLYGON_FRONT &&
           gap <= dp_near_depth_px(&w->tile) * (fabsf(p->dx - q->dx) + fabsf(p->dy - q->dy));
}

/* Close samples at which planes cross, and pixels that show back faces, one by one. */
static void suspicions_agree(void **state) {
    static dp_finder w;
    static dp_tile_polygon polygons[CLOSE_POLYGONS];
    static uint32_t keys[3 * CLOSE_POLYGONS], winner[DP_TILE * DP_TILE * 4];
    static dp_close_samples all;
    static dp_frame frame;
    (void)state;
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t kinds = dp_widths_list(list);
    for (uint32_t k = 0; k < kinds; k++) {
        uint32_t kept = 0, seed = 3;
        w.tile.frame = &frame;
        make_close(&w, polygons, keys, winner);
        all = w.tile.close;
        dp_raster_kernels_for(list[k].lanes)->cross(&w.tile);
        for (uint32_t i = 0; i < all.count; i++) {
            const uint32_t a = all.polygon[i], b = all.other[i];
            if (b == UINT32_MAX || a == b || !is_crossed(&w, a, b, all.gap[i])) continue;
            assert_int_equal(w.tile.close.polygon[kept], a);
            assert_int_equal(w.tile.close.other[kept], b);
            assert_int_equal(w.tile.close.lane[kept++], i);
        }
        assert_int_equal(w.tile.close.count, kept);
        assert_in_range(kept, 1, all.count - 1);

        uint64_t asked[DP_TILE], shown[DP_TILE];
        for (uint32_t y = 0; y < DP_TILE; y++)
            asked[y] = ((uint64_t)next_random(&seed) << 40 | next_random(&seed)) &
                       ~(uint64_t)0 >> (64 - DP_TILE);
        dp_find_kernels_for(list[k].lanes)->show_backs(&w, asked, shown);
        for (uint32_t i = 0; i < DP_TILE * DP_TILE; i++) {
            bool back = false;
            for (uint32_t l = 4 * i; l < 4 * i + 4; l++)
                back |= winner[l] != UINT32_MAX && !(polygons[winner[l]].flags & DP_POLYGON_FRONT);
            const bool found = shown[i / DP_TILE] >> i % DP_TILE & 1;
            if (asked[i / DP_TILE] >> i % DP_TILE & 1)
                assert_int_equal(found, back);
            else
                assert_true(back || !found);
        }
    }
}

/* Cells from (x, y) on, as far as there are any, among which a table of spans is to look. */
static uint32_t bits_of_cells(dp_cell_bits cells, uint32_t x, uint32_t y, uint32_t sx,
                              uint32_t sy) {
    uint32_t bits = 0;
    for (uint32_t v = y; v <= y + sy && v < DP_CELLS; v++)
        for (uint32_t u = x; u <= x + sx && u < DP_CELLS; u++)
            bits |= cells[0][0][v * DP_CELLS + u];
    return bits;
}

static void put_cells(dp_cell_bits cells, uint32_t *seed) {
    for (uint32_t i = 0; i < DP_CELLS * DP_CELLS; i++)
        cells[0][0][i] = next_random(seed) % 8 ? 0 : 1 + next_random(seed) % 3;
    for (uint32_t s = 1; s < DP_CELL_SPANS * DP_CELL_SPANS; s++)
        for (uint32_t i = 0; i < DP_CELLS * DP_CELLS; i++)
            cells[s / DP_CELL_SPANS][s % DP_CELL_SPANS][i] = bits_of_cells(
                cells, i % DP_CELLS, i / DP_CELLS, s % DP_CELL_SPANS, s / DP_CELL_SPANS);
}

static bool is_near(dp_cell_bits cells, uint32_t box, uint32_t flags) {
    const uint32_t x0 = box & 255, y0 = box >> 8 & 255, x1 = box >> 16 & 255, y1 = box >> 24;
    const uint32_t cx = x0 / DP_CELL, cy = y0 / DP_CELL;
    if (!(flags & DP_POLYGON_TOUCHES)) return false;
    if (x1 - x0 >= DP_CELL_SMALL || y1 - y0 >= DP_CELL_SMALL) return true;
    return bits_of_cells(cells, cx, cy, x1 / DP_CELL - cx, y1 / DP_CELL - cy) &
           (flags & DP_POLYGON_FRONT ? DP_NEAR_FRONT : DP_NEAR_BACK);
}

/* Which polygons come near cells of pixels, against a test of each. */
static void approaches_agree(void **state) {
    enum { SEEN = 300 };
    static uint32_t words[DP_SEEN_MEMBERS * (SEEN + DP_SEEN_ROOM)], list[SEEN + DP_SEEN_ROOM];
    static dp_finder w;
    static dp_cell_bits cells;
    uint32_t seed = 5;
    (void)state;
    w.tile.seen_count = SEEN, w.tile.seen_stride = SEEN + DP_SEEN_ROOM, w.tile.seen_words = words;
    put_cells(cells, &seed);
    for (uint32_t i = 0; i < SEEN; i++) {
        const uint32_t x0 = next_random(&seed) % DP_TILE, y0 = next_random(&seed) % DP_TILE,
                       most = DP_TILE - 1;
        const uint32_t x1 = x0 + next_random(&seed) % 12, y1 = y0 + next_random(&seed) % 12;
        words[DP_SEEN_BOX * w.tile.seen_stride + i] =
            x0 | y0 << 8 | (x1 < most ? x1 : most) << 16 | (y1 < most ? y1 : most) << 24;
        words[DP_SEEN_FLAGS * w.tile.seen_stride + i] =
            (next_random(&seed) % 4 ? DP_POLYGON_TOUCHES : 0) |
            (next_random(&seed) % 2 ? DP_POLYGON_FRONT : 0);
    }
    dp_width kinds[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(kinds);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t near =
            dp_find_kernels_for(kinds[k].lanes)->come_near(&w, &cells[0][0][0], list);
        uint32_t expected = 0;
        for (uint32_t i = 0; i < SEEN; i++)
            if (is_near(cells, words[i], words[DP_SEEN_FLAGS * w.tile.seen_stride + i]))
                assert_int_equal(list[expected++], i);
        assert_int_equal(near, expected);
        assert_in_range(near, 10, SEEN - 10);
    }
}

static void put_triangle(const dp_polygons *polygons, uint32_t triangle, float out[3][3][DP_FOLDS],
                         uint32_t i) {
    for (uint32_t k = 0; k < 3; k++)
        for (uint32_t axis = 0; axis < 3; axis++)
            out[k][axis][i] = dp_vertex_position(polygons, 3 * triangle + k)[axis];
}

static void expect_vector(const double v[3][DP_FOLDS], uint32_t i, double x, double y, double z) {
    const double got[3] = {v[0][i], v[1][i], v[2][i]}, want[3] = {x, y, z};
    assert_memory_equal(got, want, sizeof got);
}

/* Pairs of triangles beside an edge, against the general way, bit for bit; some are out of sight,
 * some folded flat. */
static void folds_agree(void **state) {
    static float at[6 * DP_FOLDS][3];
    static dp_fold_batch batch;
    (void)state;
    for (uint32_t round = 0; round < 20; round++) {
        dp_frame frame = {.view = make_view(round % 2)};
        uint32_t seed = 100 + round, plain = 0;
        frame.polygons = (dp_polygons){.positions = at[0],
                                       .stride = sizeof *at,
                                       .vertex_count = 6 * DP_FOLDS,
                                       .count = 2 * DP_FOLDS};
        for (uint32_t v = 0; v < 6 * DP_FOLDS; v++)
            for (int k = 0; k < 3; k++)
                at[v][k] = (float)next_random(&seed) / (1 << 23) * 2 - 2 - (v % 16 == 0 ? 20 : 0);
        for (uint32_t i = 0; i < DP_FOLDS; i++) {
            memcpy(at[6 * i + 3], at[6 * i + 1], sizeof *at);
            memcpy(at[6 * i + 4], at[6 * i], sizeof *at);
            if (i % 8 == 7) memcpy(at[6 * i + 5], at[6 * i + 2], sizeof *at);
            put_triangle(&frame.polygons, 2 * i, batch.a, i);
            put_triangle(&frame.polygons, 2 * i + 1, batch.b, i);
            for (int k = 0; k < 3; k++)
                batch.from[k][i] = at[6 * i][k], batch.to[k][i] = at[6 * i + 1][k];
        }
        dp_width list[DP_WIDTHS_MOST];
        const uint32_t kinds = dp_widths_list(list);
        for (uint32_t kind = 0; kind < kinds; kind++) {
            const uint32_t count = 1 + next_random(&seed) % DP_FOLDS;
            dp_find_kernels_for(list[kind].lanes)->folds(&frame.view, &batch, count);
            for (uint32_t i = 0; i < count; i++) {
                if (batch.plain[i] == 0) continue;
                plain++;
                const dp_fold f = dp_fold_seen(&frame, 2 * i, true, 2 * i + 1, true, 0);
                dp_spine s;
                assert_true(dp_spine_make(&frame.view, dp_v3f(at[6 * i]), dp_v3f(at[6 * i + 1]),
                                          f.normal, &s));
                expect_vector(batch.normal_a, i, f.normal_a.x, f.normal_a.y, f.normal_a.z);
                expect_vector(batch.normal_b, i, f.normal_b.x, f.normal_b.y, f.normal_b.z);
                expect_vector(batch.normal, i, f.normal.x, f.normal.y, f.normal.z);
                expect_vector(batch.end_a, i, s.a.x, s.a.y, s.a.d);
                expect_vector(batch.end_b, i, s.b.x, s.b.y, s.b.d);
                expect_vector(batch.probe_a, i, s.probe_a.x, s.probe_a.y, s.probe_a.d);
                expect_vector(batch.probe_b, i, s.probe_b.x, s.probe_b.y, s.probe_b.d);
            }
        }
        assert_in_range(plain, 1, kinds * DP_FOLDS * 7 / 8);
    }
}

static int set_up(void **state) {
    (void)state;
    make_model();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transforms_agree), cmocka_unit_test(equal_positions_have_equal_keys),
        cmocka_unit_test(places_agree),     cmocka_unit_test(parts_agree),
        cmocka_unit_test(meetings_agree),   cmocka_unit_test(suspicions_agree),
        cmocka_unit_test(approaches_agree), cmocka_unit_test(folds_agree),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
