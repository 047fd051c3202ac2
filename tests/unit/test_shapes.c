/* Generated models: closed, oriented, without triangles of no area, about the number of triangles
 * asked for, the same after a rewind. Edges are matched by the bits of their ends' positions. */
#include <drypoint/shapes.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A whole model as triangles of positions. */
typedef struct soup {
    float (*corners)[3][3];
    size_t count, capacity;
} soup;

static dp_source *open_shape(const char *name, uint64_t triangles) {
    const dp_shape shape = {.name = name, .triangles = triangles};
    dp_source *source = NULL;
    dp_diag diag;
    assert_int_equal(dp_source_from_shape(&shape, &source, &diag), DP_OK);
    return source;
}

static soup read_all(dp_source *source) {
    soup s = {0};
    dp_batch batch;
    for (;;) {
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        if (!batch.polygon_count) return s;
        assert_null(batch.firsts);
        if (s.count + batch.polygon_count > s.capacity) {
            s.capacity = 2 * s.capacity + batch.polygon_count;
            s.corners = realloc(s.corners, s.capacity * sizeof *s.corners);
            assert_non_null(s.corners);
        }
        for (size_t i = 0; i < batch.polygon_count; i++, s.count++)
            for (size_t c = 0; c < 3; c++) {
                assert_true(batch.indices[3 * i + c] < batch.vertex_count);
                memcpy(s.corners[s.count][c], batch.positions + 3 * batch.indices[3 * i + c], 12);
            }
    }
}

static soup read_shape(const char *name, uint64_t triangles) {
    dp_source *const source = open_shape(name, triangles);
    const soup s = read_all(source);
    dp_source_destroy(source);
    return s;
}

/* A directed edge; equal ones sort together, opposite ones after ordering their ends. */
typedef struct edge {
    float low[3], high[3];
    int direction; /* +1 from low to high */
} edge;

static int by_ends(const void *a, const void *b) { return memcmp(a, b, 6 * sizeof(float)); }

static edge edge_of(const float a[3], const float b[3]) {
    edge e;
    const bool ordered = memcmp(a, b, 12) < 0;
    memcpy(e.low, ordered ? a : b, 12);
    memcpy(e.high, ordered ? b : a, 12);
    e.direction = ordered ? 1 : -1;
    return e;
}

typedef struct edge_tally {
    size_t open, paired, wrong; /* wrong: same direction twice, or more than two */
} edge_tally;

static edge_tally tally(const soup *s) {
    edge_tally t = {0};
    edge *const edges = malloc(3 * s->count * sizeof *edges);
    assert_non_null(edges);
    for (size_t i = 0; i < s->count; i++)
        for (size_t c = 0; c < 3; c++)
            edges[3 * i + c] = edge_of(s->corners[i][c], s->corners[i][(c + 1) % 3]);
    qsort(edges, 3 * s->count, sizeof *edges, by_ends);
    for (size_t first = 0, last; first < 3 * s->count; first = last) {
        int sum = 0;
        for (last = first; last < 3 * s->count && !by_ends(&edges[first], &edges[last]); last++)
            sum += edges[last].direction;
        if (last - first == 1)
            t.open++;
        else if (last - first == 2 && sum == 0)
            t.paired++;
        else
            t.wrong++;
    }
    free(edges);
    return t;
}

static void cross(const float corner[3][3], double n[3]) {
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)corner[1][k] - corner[0][k];
        v[k] = (double)corner[2][k] - corner[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

/* Of triangles without area there must be none. */
static double volume(const soup *s) {
    double sum = 0;
    for (size_t i = 0; i < s->count; i++) {
        double n[3];
        cross((const float(*)[3])s->corners[i], n);
        assert_true(n[0] != 0 || n[1] != 0 || n[2] != 0);
        for (int k = 0; k < 3; k++) sum += n[k] * s->corners[i][0][k] / 6;
    }
    return sum;
}

static void extent_of(const soup *s, float min[3], float max[3]) {
    for (int k = 0; k < 3; k++) min[k] = INFINITY, max[k] = -INFINITY;
    for (size_t i = 0; i < s->count; i++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) {
                min[k] = fminf(min[k], s->corners[i][c][k]);
                max[k] = fmaxf(max[k], s->corners[i][c][k]);
            }
}

/* ---- every shape ---- */

static const uint64_t requests[] = {0, 1, 700, 20000, 250000};

static void check_closed(const char *name, uint64_t request) {
    soup s = read_shape(name, request);
    const edge_tally t = tally(&s);
    assert_int_equal(t.wrong, 0);
    if (!strcmp(name, "flag")) { /* the cloth has a border */
        assert_true(t.open >= 10 && t.open % 10 == 0);
        volume(&s);
    } else if (strcmp(name, "terrain")) {
        assert_int_equal(t.open, 0);
        assert_true(volume(&s) > 0.05);
    } else { /* a square of n * n cells has 4 n edges at its border */
        const double n = sqrt((double)s.count / 2);
        assert_int_equal(t.open, (size_t)(4 * n + 0.5));
        volume(&s);
    }
    free(s.corners);
}

static void shapes_are_closed(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++)
        for (size_t r = 0; r < sizeof requests / sizeof *requests; r++)
            check_closed(dp_shape_name(k), requests[r]);
}

/* A request well above the smallest is met within a fifth. */
static void counts_are_near(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        soup s = read_shape(dp_shape_name(k), 250000);
        assert_true(s.count > 250000 * 0.8 && s.count < 250000 * 1.2);
        free(s.corners);
    }
}

/* The box is centred and as large as asked for, up to what tessellation cuts off. */
static void boxes_fit(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        const dp_shape shape = {.name = dp_shape_name(k), .size = 10, .triangles = 20000};
        dp_source *source = NULL;
        assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
        soup s = read_all(source);
        float min[3], max[3], largest = 0;
        extent_of(&s, min, max);
        for (int c = 0; c < 3; c++) {
            largest = fmaxf(largest, max[c] - min[c]);
            assert_true(fabsf(max[c] + min[c]) < 2.0F);
        }
        assert_true(largest > 9.9F && largest < 10.001F);
        free(s.corners);
        dp_source_destroy(source);
    }
}

static void rewinding_repeats(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        dp_source *const source = open_shape(dp_shape_name(k), 100000);
        soup a = read_all(source);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
        soup b = read_all(source);
        assert_int_equal(a.count, b.count);
        assert_memory_equal(a.corners, b.corners, a.count * sizeof *a.corners);
        free(a.corners);
        free(b.corners);
        dp_source_destroy(source);
    }
}

static void minus_zero_is_zero(void **state) {
    (void)state;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        soup s = read_shape(dp_shape_name(k), 20000);
        const float *const numbers = &s.corners[0][0][0];
        for (size_t n = 0; n < 9 * s.count; n++)
            assert_true(isfinite(numbers[n]) && !(numbers[n] == 0 && signbit(numbers[n])));
        free(s.corners);
    }
}

/* ---- known features ---- */

static bool near(double value, double wanted, double within) {
    return fabs(value - wanted) < within;
}

static void volumes_are_known(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double volume, within;
    } known[] = {{"cube", 8, 1e-6},
                 {"tetrahedron", 8.0 / 3, 1e-6},
                 {"sphere", 4.1888, 0.01},
                 {"stairs", 1.4815 * 0.55 * 1.2593 * 2, 1e-3}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        soup s = read_shape(known[k].name, k == 2 ? 100000 : 0);
        assert_true(near(volume(&s), known[k].volume, known[k].within));
        free(s.corners);
    }
}

static int by_position(const void *a, const void *b) { return memcmp(a, b, 3 * sizeof(float)); }

static long different_positions(soup *s) {
    float(*const points)[3] = s->corners[0];
    long count = 0;
    qsort(points, 3 * s->count, sizeof *points, by_position);
    for (size_t k = 0; k < 3 * s->count; k++) count += !k || by_position(points[k - 1], points[k]);
    return count;
}

/* Vertices - edges + faces = 2 - 2 * holes. */
static void holes_are_known(void **state) {
    (void)state;
    static const struct {
        const char *name;
        long holes;
    } known[] = {{"bolt", 0}, {"torso", 0}, {"torus", 1}, {"bracket", 3}, {"gear", 7}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        soup s = read_shape(known[k].name, 0);
        const long faces = (long)s.count, edges = (long)tally(&s).paired;
        assert_int_equal(different_positions(&s) - edges + faces, 2 - 2 * known[k].holes);
        free(s.corners);
    }
}

static void seeds_differ(void **state) {
    (void)state;
    soup made[2];
    for (uint32_t seed = 0; seed < 2; seed++) {
        const dp_shape shape = {.name = "terrain", .triangles = 5000, .seed = seed};
        dp_source *source = NULL;
        assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
        made[seed] = read_all(source);
        dp_source_destroy(source);
    }
    assert_int_equal(made[0].count, made[1].count);
    assert_memory_not_equal(made[0].corners, made[1].corners,
                            made[0].count * sizeof *made[0].corners);
    free(made[0].corners);
    free(made[1].corners);
}

/* ---- wrong calls ---- */

static void wrong_shapes_are_refused(void **state) {
    (void)state;
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_shape(NULL, &source, &diag), DP_ERR_ARGUMENT);
    dp_shape shape = {.name = "bold"};
    assert_int_equal(dp_source_from_shape(&shape, &source, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "bolt"));
    shape = (dp_shape){.name = "cube", .size = -1};
    assert_int_equal(dp_source_from_shape(&shape, &source, &diag), DP_ERR_ARGUMENT);
    shape.size = NAN;
    assert_int_equal(dp_source_from_shape(&shape, &source, &diag), DP_ERR_ARGUMENT);
    shape = (dp_shape){.name = "cube", .triangles = UINT64_MAX};
    assert_int_equal(dp_source_from_shape(&shape, &source, &diag), DP_ERR_LIMIT);
    assert_null(source);
    assert_null(dp_shape_name(dp_shape_count()));
    assert_null(dp_shape_about(dp_shape_count()));
}

typedef struct allowance {
    long left;
} allowance;

static void *failing_alloc(size_t size, void *user) {
    return ((allowance *)user)->left-- > 0 ? malloc(size) : NULL;
}
static void *failing_realloc(void *block, size_t size, void *user) {
    return ((allowance *)user)->left-- > 0 ? realloc(block, size) : NULL;
}
static void plain_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void memory_may_run_out(void **state) {
    (void)state;
    dp_result result = DP_ERR_MEMORY;
    for (long allowed = 0; result && allowed < 20; allowed++) {
        allowance a = {allowed};
        const dp_allocator allocator = {failing_alloc, failing_realloc, plain_free, &a};
        const dp_shape shape = {.name = "gear", .allocator = &allocator};
        dp_source *source = NULL;
        dp_diag diag = {0};
        result = dp_source_from_shape(&shape, &source, &diag);
        assert_true(result == DP_OK || (result == DP_ERR_MEMORY && !source && *diag.message));
        dp_source_destroy(source);
    }
    assert_int_equal(result, DP_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_are_closed),
        cmocka_unit_test(counts_are_near),
        cmocka_unit_test(boxes_fit),
        cmocka_unit_test(rewinding_repeats),
        cmocka_unit_test(minus_zero_is_zero),
        cmocka_unit_test(volumes_are_known),
        cmocka_unit_test(holes_are_known),
        cmocka_unit_test(seeds_differ),
        cmocka_unit_test(wrong_shapes_are_refused),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
