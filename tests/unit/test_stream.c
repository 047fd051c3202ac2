/* Streaming: a drawing in parts is the drawing from memory, in bounded memory, for any source.
 *
 * Above 600 lines: each kind of source and style is drawn both ways by the same few helpers. */
#include "temporary.h"

#include "base/hostile.h"
#include "io/readers.h"
#include "draw/context.h"
#include "mesh/source.h"
#include "stream/pending.h"
#include "stream/stream.h"

#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 400, HEIGHT = 300, PIXELS = WIDTH * HEIGHT };

typedef struct picture {
    uint8_t rgba[4 * PIXELS], line_class[PIXELS];
    float depth[PIXELS], normal[3 * PIXELS];
    size_t segments;
    dp_stats stats;
} picture;

static picture memory_picture, stream_picture;

/* How a test draws; zero: all lines, default camera, two threads. */
typedef struct how {
    dp_style style;
    uint32_t samples, threads;
    double direction[3], zoom;
    bool orthographic;
    size_t limit; /* bytes; 0: any number */
} how;

static void draw(dp_source *source, const how *h, picture *out) {
    dp_context *context;
    dp_diag diag = {0};
    dp_extent extent;
    dp_camera camera;
    const dp_context_desc desc = {.threads = h->threads ? h->threads : 2};
    assert_int_equal(dp_source_rewind(source, &diag), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, &diag), DP_OK);
    dp_fit fit = {
        .aspect = (double)WIDTH / HEIGHT, .orthographic = h->orthographic, .zoom = h->zoom};
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    memcpy(fit.direction, h->direction, sizeof fit.direction);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(&desc, &context, &diag), DP_OK);
    context->limit = h->limit ? h->limit : SIZE_MAX;
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .samples = h->samples,
                              .rgba = out->rgba,
                              .line_class = out->line_class,
                              .depth = out->depth,
                              .normal = out->normal};
    if (dp_draw(context, source, &camera, &h->style, &target, &diag)) fail_msg("%s", diag.message);
    dp_segments(context, &out->segments);
    dp_stats_of(context, &out->stats);
    dp_context_destroy(context);
}

static long different_pixels(const picture *a, const picture *b) {
    long count = 0;
    for (size_t i = 0; i < PIXELS; i++) count += memcmp(a->rgba + 4 * i, b->rgba + 4 * i, 4) != 0;
    return count;
}

/* How many pixels differ by more than 30 %. */
static long unlike_pixels(const picture *a, const picture *b) {
    long count = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        int most = 0;
        for (size_t k = 4 * i; k < 4 * i + 4; k++) {
            const int difference = abs(a->rgba[k] - b->rgba[k]);
            most = difference > most ? difference : most;
        }
        count += most > 76;
    }
    return count;
}

static long other_classes(const picture *a, const picture *b) {
    long count = 0;
    for (size_t i = 0; i < PIXELS; i++) count += a->line_class[i] != b->line_class[i];
    return count;
}

/* From memory and streamed: the same surface to the last bit, and the same lines but for a few
 * points. What lies beside an edge is looked up among the triangles that were kept; of a fine mesh
 * most were not. */
static void expect_same_as_memory(dp_source *source, how h, const char *what) {
    h.limit = 0;
    draw(source, &h, &memory_picture);
    h.limit = 1;
    draw(source, &h, &stream_picture);
    const long different = unlike_pixels(&memory_picture, &stream_picture),
               classes = other_classes(&memory_picture, &stream_picture);
    if (different > PIXELS / 2000) fail_msg("%s: %ld pixels differ", what, different);
    if (classes > PIXELS / 500) fail_msg("%s: %ld other classes", what, classes);
    if (memcmp(memory_picture.depth, stream_picture.depth, sizeof memory_picture.depth))
        fail_msg("%s: other depth", what);
    if (memcmp(memory_picture.normal, stream_picture.normal, sizeof memory_picture.normal))
        fail_msg("%s: other normals", what);
    const long more = (long)stream_picture.segments - (long)memory_picture.segments;
    if (labs(more) > 2 + (long)memory_picture.segments / 10)
        fail_msg("%s: %zu segments, %zu streamed", what, memory_picture.segments,
                 stream_picture.segments);
    assert_int_equal(memory_picture.stats.polygons, stream_picture.stats.polygons);
    assert_int_equal(memory_picture.stats.triangles, stream_picture.stats.triangles);
    assert_int_equal(stream_picture.stats.edges_lost, 0);
}

static dp_source *shape(const char *name, uint64_t triangles) {
    dp_source *source;
    dp_diag diag = {0};
    const dp_shape s = {.name = name, .triangles = triangles, .seed = 3};
    if (dp_source_from_shape(&s, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

static const uint32_t NO_CROSSINGS = DP_ALL_LINES & ~DP_INTERSECTION;

static void all_shapes(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        dp_source *const source = shape(dp_shape_name(k), DP_TUNED(30000, 1500));
        expect_same_as_memory(source, (how){.samples = 4}, dp_shape_name(k));
        dp_source_destroy(source);
    }
}

static void any_samples_and_cameras(void **state) {
    (void)state;
    dp_source *const source = shape("bracket", 3000);
    const uint32_t samples[] = {1, 4, 8, 16};
    for (int k = 0; k < 4; k++) {
        const how h = {.style.lines = NO_CROSSINGS,
                       .samples = samples[k],
                       .orthographic = k % 2,
                       .zoom = k == 3 ? 9 : 1,
                       .direction = {1, k - 1.5, 1}};
        expect_same_as_memory(source, h, "bracket");
    }
    dp_source_destroy(source);
}

static void any_threads(void **state) {
    (void)state;
    dp_source *const source = shape("terrain", DP_TUNED(40000, 1500));
    static picture first;
    for (uint32_t threads = 1; threads <= 7; threads += 3) {
        draw(source, &(how){.limit = 1, .threads = threads},
             threads == 1 ? &first : &stream_picture);
        if (threads > 1) assert_memory_equal(first.rgba, stream_picture.rgba, sizeof first.rgba);
        if (threads > 1) assert_memory_equal(first.depth, stream_picture.depth, sizeof first.depth);
    }
    dp_source_destroy(source);
}

/* ------- a soup of our own ------- */

typedef struct soup {
    float (*corners)[9];
    size_t count, at;
    bool once;
} soup;

static dp_result soup_next(void *user, dp_batch *batch, dp_diag *diag) {
    soup *const s = user;
    (void)diag;
    const size_t count = s->count - s->at < 700 ? s->count - s->at : 700;
    *batch = (dp_batch){.positions = s->corners[s->at],
                        .vertex_count = 3 * count,
                        .corner_count = 3 * count,
                        .polygon_count = count};
    s->at += count;
    return DP_OK;
}

static dp_result soup_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((soup *)user)->at = 0;
    return DP_OK;
}

static dp_source *soup_source(soup *s) {
    dp_source *source;
    dp_diag diag = {0};
    const dp_source_callbacks callbacks = {
        .user = s, .next = soup_next, .rewind = s->once ? NULL : soup_rewind};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, &diag), DP_OK);
    return source;
}

/* All triangles of a shape. */
static void make_soup(soup *s, const char *name, uint64_t triangles) {
    dp_source *const source = shape(name, triangles);
    dp_batch batch;
    dp_diag diag;
    *s = (soup){NULL, 0, 0, false};
    while (!dp_source_next(source, &batch, &diag) && batch.polygon_count) {
        s->corners = realloc(s->corners, (s->count + batch.polygon_count) * sizeof *s->corners);
        for (size_t c = 0; c < 3 * batch.polygon_count; c++)
            memcpy(s->corners[s->count + c / 3] + 3 * (c % 3),
                   batch.positions + 3 * (size_t)batch.indices[c], 3 * sizeof(float));
        s->count += batch.polygon_count;
    }
    dp_source_destroy(source);
}

static void shuffle(soup *s) {
    uint64_t random = 12345;
    for (size_t i = s->count; i-- > 1;) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const size_t j = (size_t)(random >> 33) % (i + 1);
        float swap[9];
        memcpy(swap, s->corners[i], sizeof swap);
        memcpy(s->corners[i], s->corners[j], sizeof swap);
        memcpy(s->corners[j], swap, sizeof swap);
    }
}

/* Where faces cross: large ones, ones below a sample, and in any order. Where a crossing leaves the
 * pixels in which faces were seen to come close, samples hide it, so that a pixel or two may
 * differ. */
static void crossing_faces(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        soup s;
        make_soup(&s, "boxes", k ? DP_TUNED(200000, 3000) : 500);
        if (k == 2) shuffle(&s);
        dp_source *const source = soup_source(&s);
        how h = {.samples = k == 1 ? 1 : 4};
        draw(source, &h, &memory_picture);
        h.limit = 1;
        draw(source, &h, &stream_picture);
        const long different = different_pixels(&memory_picture, &stream_picture);
        if (different > 6) fail_msg("%d: %ld pixels differ", k, different);
        dp_source_destroy(source);
        free(s.corners);
    }
}

static void shuffled_soups(void **state) {
    (void)state;
    static const char *const names[] = {"gear", "torus"};
    for (int k = 0; k < 2; k++) {
        soup s;
        make_soup(&s, names[k], k ? DP_TUNED(20000, 2000) : 1000);
        shuffle(&s);
        dp_source *const source = soup_source(&s);
        expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, names[k]);
        dp_source_destroy(source);
        free(s.corners);
    }
}

/* A model that is there twice: of an edge's four triangles two run one way and two the other, and
 * any two may meet first, in different chunks. */
static void doubled_soups(void **state) {
    (void)state;
    soup s;
    make_soup(&s, "gear", DP_TUNED(5000, 800));
    s.corners = realloc(s.corners, 2 * s.count * sizeof *s.corners);
    assert_non_null(s.corners);
    memcpy(s.corners + s.count, s.corners, s.count * sizeof *s.corners);
    s.count *= 2;
    shuffle(&s);
    dp_source *const source = soup_source(&s);
    expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, "a doubled gear");
    dp_source_destroy(source);
    free(s.corners);
}

/* More intersection candidates than the limit: that some were given up is reported. */
static void too_many_crossings(void **state) {
    (void)state;
    if (DP_TUNED(false, true)) skip(); /* as many in small steps take too long */
#ifdef __SANITIZE_THREAD__
    skip(); /* and threads work as on those of other tests */
#endif
    uint64_t random = 12345;
    soup s = {.count = 60000};
    s.corners = malloc(s.count * sizeof *s.corners);
    assert_non_null(s.corners);
    for (size_t i = 0; i < s.count; i++) { /* small, all over a plane, each tilted its own way */
        float at[2];
        for (int k = 0; k < 11; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            const float r = (float)(random >> 40) / (float)(1 << 24) - 0.5f;
            if (k < 2)
                at[k] = 2 * r;
            else
                s.corners[i][k - 2] = (k - 2) % 3 == 2 ? 0.02f * r : at[(k - 2) % 3] + 0.05f * r;
        }
    }
    dp_source *const source = soup_source(&s);
    draw(source, &(how){.limit = 1, .samples = 1, .direction = {0, 0, 1}}, &stream_picture);
    assert_true(stream_picture.stats.edges_lost > 100);
    dp_source_destroy(source);
    free(s.corners);
}

/* Two triangles in one plane, and far behind in the file a third at their edge: behind them, or
 * standing up. */
static void fans_far_apart(void **state) {
    (void)state;
    for (int k = 0; k < 4; k++) {
        soup s;
        make_soup(&s, "sphere", DP_TUNED(20000, 300));
        for (size_t i = 0; i < s.count; i++)
            for (int c = 0; c < 9; c++)
                s.corners[i][c] = 0.2f * s.corners[i][c] + (c % 3 == 0 ? -3 : 0);
        const float up = k % 2 ? 1 : -1, x = k < 2 ? 0.5f : -0.7f;
        const float first[2][9] = {{0, 0, 1, 1, 0, 0, 0, 0, -1}, {0, 0, 1, 0, 0, -1, -1, 0, 0}},
                    third[9] = {0, 0, 1, x, up, 0, 0, 0, -1};
        memcpy(s.corners[0], first[0], sizeof first[0]);
        memcpy(s.corners[1], first[1], sizeof first[1]);
        memcpy(s.corners[s.count - 1], third, sizeof third);
        dp_source *const source = soup_source(&s);
        expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, "a fan far apart");
        dp_source_destroy(source);
        free(s.corners);
    }
}

/* Joins the edges of a soup, in as many readings as `limit` triangles take. */
static void join_all(const soup *s, const dp_chunk_view *view, size_t limit, dp_pending *pending) {
    static dp_allocator memory; /* outlives *pending */
    bool enough = true;
    memory = dp_allocator_resolve(NULL);
    *pending = (dp_pending){.memory = &memory, .view = view, .limit = limit, .shares = 1};
    do {
        for (size_t i = 0; i < s->count; i++) {
            const size_t first = pending->count;
            assert_true(dp_reserve(&memory, &pending->triangles, &pending->cap, first + 1,
                                   sizeof *pending->triangles));
            dp_pending_triangle *const t = &pending->triangles[pending->count++];
            *t = (dp_pending_triangle){.number = (uint32_t)i, .polygon = (uint32_t)i};
            memcpy(t->corners, s->corners[i], sizeof t->corners);
            for (uint32_t e = 0; e < 3; e++)
                t->edges[e] =
                    dp_pending_follows(pending->share, t, e) ? DP_EDGE_ALONE : DP_EDGE_PLAIN;
            assert_true(dp_pending_join(pending, first));
        }
    } while (dp_pending_next_share(pending, &enough));
    assert_true(enough);
}

/* Where more edges wait than the limit, several readings follow them, and find the same lines. */
static void kept_in_shares(void **state) {
    (void)state;
    dp_camera camera;
    dp_view view;
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {1, 1, 1}};
    static float farthest[DP_BLOCKS * DP_BLOCKS * 1024];
    dp_chunk_view chunk_view = {.view = &view, .farthest = farthest, .flat_cosine = 0.9f};
    soup s;
    dp_pending all, shares, few;
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_view_init(&view, &camera, WIDTH, HEIGHT, NULL), DP_OK);
    chunk_view.tiles_x = (WIDTH + DP_TILE - 1) / DP_TILE,
    chunk_view.tiles_y = (HEIGHT + DP_TILE - 1) / DP_TILE;
    for (size_t i = 0; i < sizeof farthest / sizeof *farthest; i++) farthest[i] = DP_DEPTH_EMPTY;
    make_soup(&s, "torus", 40000);
    shuffle(&s);
    join_all(&s, &chunk_view, SIZE_MAX / 2, &all);
    join_all(&s, &chunk_view, 8000, &shares);
    assert_int_equal(all.shares, 1);
    assert_true(shares.shares > 2);
    assert_int_equal(shares.lost, 0);
    assert_true(all.earlier_count > 100);
    assert_int_equal(all.earlier_count, shares.earlier_count);
    for (size_t i = 0; i < all.earlier_count; i++) {
        assert_int_equal(all.earlier[i].number, shares.earlier[i].number);
        assert_memory_equal(all.earlier[i].edges, shares.earlier[i].edges, 3);
    }
    join_all(&s, &chunk_view, 20,
             &few); /* but for the hostile build there is room for some thousand at any rate */
    assert_true(few.lost > 0 || DP_TUNED(true, false));
    dp_pending_free(&all);
    dp_pending_free(&shares);
    dp_pending_free(&few);
    free(s.corners);
}

/* Triangles that cannot be drawn are counted as ever. */
static void bad_triangles(void **state) {
    (void)state;
    soup s;
    make_soup(&s, "gear", 1000);
    s.corners[10][4] = NAN;
    s.corners[20][0] = INFINITY;
    memcpy(s.corners[30] + 3, s.corners[30], 3 * sizeof(float));
    memcpy(s.corners[40] + 6, s.corners[40] + 3, 3 * sizeof(float));
    dp_source *const source = soup_source(&s);
    expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, "bad triangles");
    assert_int_equal(stream_picture.stats.dropped_finite, 2);
    assert_int_equal(stream_picture.stats.dropped_area, 2);
    dp_source_destroy(source);
    free(s.corners);
}

/* One reading: sample points are hidden by samples. */
static void one_pass(void **state) {
    (void)state;
    soup s;
    make_soup(&s, "gear", DP_TUNED(5000, 1000));
    dp_source *source = soup_source(&s);
    how h = {.style = {.lines = NO_CROSSINGS, .passes = 1}};
    draw(source, &h, &memory_picture);
    h.limit = 1;
    draw(source, &h, &stream_picture);
    const long different = different_pixels(&memory_picture, &stream_picture);
    if (different > PIXELS / 300) fail_msg("%ld pixels differ", different);
    dp_source_destroy(source);
    free(s.corners);
}

/* A source that can be read only once needs one pass, or memory. */
static void read_once(void **state) {
    (void)state;
    soup s;
    make_soup(&s, "cube", 500);
    s.once = true;
    dp_context *context;
    dp_camera camera;
    dp_diag diag = {0};
    const float box[2][3] = {{-1, -1, -1}, {1, 1, 1}};
    dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    memcpy(fit.min, box[0], sizeof fit.min), memcpy(fit.max, box[1], sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(NULL, &context, &diag), DP_OK);
    context->limit = 1;
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = stream_picture.rgba};
    dp_source *source = soup_source(&s);
    assert_int_equal(dp_draw(context, source, &camera, NULL, &target, &diag), DP_ERR_LIMIT);
    assert_non_null(strstr(diag.message, "one pass"));
    s.at = 0;
    const dp_style style = {.passes = 1};
    assert_int_equal(dp_draw(context, source, &camera, &style, &target, &diag), DP_OK);
    size_t segments;
    dp_segments(context, &segments);
    assert_true(segments >= 9);
    dp_source_destroy(source);
    dp_context_destroy(context);
    free(s.corners);
}

/* ------- binary STL: records ------- */

static char stl_path[300];

static void write_stl(const soup *s, uint32_t announced) {
    FILE *const file = fopen(stl_path, "wb");
    assert_non_null(file);
    char head[84] = {0};
    memcpy(head + 80, &announced, 4);
    assert_int_equal(fwrite(head, 1, sizeof head, file), sizeof head);
    for (size_t i = 0; i < s->count; i++) {
        char record[50] = {0};
        memcpy(record + 12, s->corners[i], sizeof s->corners[i]);
        assert_int_equal(fwrite(record, 1, sizeof record, file), sizeof record);
    }
    assert_int_equal(fclose(file), 0);
}

/* The same bytes in memory: records again, read in any order and from any thread. */
static void expect_same_from_memory(const soup *s) {
    const size_t size = 84 + 50 * s->count;
    uint8_t *const bytes = malloc(size);
    FILE *const file = fopen(stl_path, "rb");
    dp_source *source = NULL;
    assert_true(bytes && file && fread(bytes, 1, size, file) == size);
    fclose(file);
    const dp_memory_file in_memory = {.data = bytes, .size = size};
    assert_int_equal(dp_source_open_memory(&in_memory, NULL, &source, NULL), DP_OK);
    assert_true(source->records.read && source->records.count == s->count);
    expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, "torus.stl in memory");
    dp_source_destroy(source);
    free(bytes);
}

static void records(void **state) {
    (void)state;
    soup s;
    dp_source *source;
    dp_diag diag = {0};
    dp_extent records_extent, batches_extent;
    make_soup(&s, "torus", DP_TUNED(20000, 1000));
    temporary_name(stl_path, sizeof stl_path, "stream");
    const int descriptor = mkstemp(stl_path);
    assert_true(descriptor >= 0);
    close(descriptor);
    write_stl(&s, (uint32_t)s.count);
    assert_int_equal(dp_source_open(stl_path, NULL, &source, &diag), DP_OK);
    expect_same_as_memory(source, (how){.style.lines = NO_CROSSINGS}, "torus.stl");
    assert_int_equal(dp_source_extent(source, &records_extent, &diag), DP_OK);
    dp_source *const batches = soup_source(&s);
    s.at = 0;
    assert_int_equal(dp_source_extent(batches, &batches_extent, &diag), DP_OK);
    assert_memory_equal(records_extent.min, batches_extent.min, sizeof batches_extent.min);
    assert_memory_equal(records_extent.max, batches_extent.max, sizeof batches_extent.max);
    assert_int_equal(records_extent.corners, batches_extent.corners);
    dp_source_destroy(batches);
    expect_same_from_memory(&s);

    /* a file that becomes shorter while it is open */
    dp_context *context;
    dp_camera camera;
    dp_fit fit = {0};
    memcpy(fit.min, records_extent.min, sizeof fit.min),
        memcpy(fit.max, records_extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(NULL, &context, &diag), DP_OK);
    context->limit = 1;
    assert_int_equal(truncate(stl_path, 84 + 50 * 500 + 7), 0);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = stream_picture.rgba};
    assert_int_equal(dp_draw(context, source, &camera, NULL, &target, &diag), DP_ERR_FORMAT);
    assert_non_null(strstr(diag.message, "cut short"));
    assert_int_equal(diag.offset, 84 + 50 * 500 + 7);
    assert_int_equal(dp_source_extent(source, &records_extent, &diag), DP_ERR_FORMAT);
    dp_source_destroy(source);
    dp_context_destroy(context);
    unlink(stl_path);
    free(s.corners);
}

/* ------- stopping, memory ------- */

static int stop_half_way(void *user, double fraction) {
    int *const calls = user;
    (void)fraction;
    return ++*calls > 3;
}

static void can_be_stopped(void **state) {
    (void)state;
    dp_source *const source = shape("sphere", DP_TUNED(4000000, 5000));
    dp_context *context;
    dp_diag diag = {0};
    dp_camera camera;
    int calls = 0;
    const dp_context_desc desc = {.progress = stop_half_way, .user = &calls};
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {1, 1, 1}};
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(&desc, &context, &diag), DP_OK);
    context->limit = 1;
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = stream_picture.rgba};
    assert_int_equal(dp_draw(context, source, &camera, NULL, &target, &diag), DP_ERR_CANCELLED);
    assert_int_equal(calls, 4);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

static void too_little_memory(void **state) {
    (void)state;
    dp_context *context;
    dp_diag diag = {0};
    const dp_context_desc desc = {.memory = 1 << 20};
    assert_int_equal(dp_context_create(&desc, &context, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "48 MB"));
}

/* An allocator that fails from the n-th call on. */
static atomic_long calls_left;
static void *meagre_alloc(size_t size, void *user) {
    (void)user;
    return atomic_fetch_sub(&calls_left, 1) > 0 ? malloc(size) : NULL;
}
static void *meagre_realloc(void *block, size_t size, void *user) {
    (void)user;
    return atomic_fetch_sub(&calls_left, 1) > 0 ? realloc(block, size) : NULL;
}
static void meagre_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void out_of_memory(void **state) {
    (void)state;
    const dp_allocator meagre = {meagre_alloc, meagre_realloc, meagre_free, NULL};
    soup s;
    make_soup(&s, "boxes", 100);
    dp_source *const source = soup_source(&s);
    dp_camera camera;
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {1, 1, 1}};
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    bool done = false;
    for (long n = 0; !done; n += 1 + n / 8) {
        atomic_store(&calls_left, n);
        dp_context *context;
        dp_diag diag = {0};
        const dp_context_desc desc = {.allocator = &meagre, .threads = 2};
        const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = stream_picture.rgba};
        if (dp_context_create(&desc, &context, &diag)) continue;
        context->limit = 1;
        const dp_result result = dp_draw(context, source, &camera, NULL, &target, &diag);
        if (result && result != DP_ERR_MEMORY) fail_msg("%ld: %s", n, diag.message);
        done = !result;
        dp_context_destroy(context);
    }
    dp_source_destroy(source);
    free(s.corners);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_shapes),        cmocka_unit_test(any_samples_and_cameras),
        cmocka_unit_test(any_threads),       cmocka_unit_test(crossing_faces),
        cmocka_unit_test(shuffled_soups),    cmocka_unit_test(bad_triangles),
        cmocka_unit_test(doubled_soups),     cmocka_unit_test(too_many_crossings),
        cmocka_unit_test(fans_far_apart),    cmocka_unit_test(kept_in_shares),
        cmocka_unit_test(one_pass),          cmocka_unit_test(read_once),
        cmocka_unit_test(records),           cmocka_unit_test(can_be_stopped),
        cmocka_unit_test(too_little_memory), cmocka_unit_test(out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
