/* Exact ends (dp_style.exact_ends) against the ends that a solver finds (solver.h), on generated models
 * and, where they are there, those in ../shared/models.
 *
 *     each segment that runs along an edge    its part of the edge; its hidden ends
 *     each of these ends                      distance to the nearest end of a visible stretch
 *     each edge that is a line                visible length that is missing, length that is extra */
#include "solver.h"
#include "suite.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 1680, HEIGHT = 1050 };

/* What must be reached. px; shares of the visible length. */
static const double median_most = 0.002, p99_most = 0.01, worst_most = 0.05, length_most = 2e-4;

/* What is known not to be reached, in a view: the worst end, px; the missing share; how many hidden ends
 * have no hider, as a tile's border cuts the line there. Each bound lies close above what is
 * measured. */
typedef struct known {
    const char *model, *view;
    double worst, missing;
    size_t unknown;
} known;
static const known known_misses[] = {
    /* a polygon of the rounding beyond, of which the edge's two know nothing, seems to lie beyond a
     * crack of 0.05 px: two sample points */
    {"bracket", "beside", 0.5, 2e-4, 1},
    /* an edge beside which, in a tile that sees back faces, no face is seen: one or two sample
     * points in the corner of a tile */
    {"rocker-arm.obj", "front", 0.26, 2e-4, 1},
    {"stanford-bunny.obj", "default", 0.48, 2e-4, 1},
    {"stanford-bunny.obj", "ortho", 0.75, 5e-4, 2},
    /* edges that end at the border of a hole, where the surface is not closed and no pair trusted */
    {"stanford-bunny.obj", "front", 0.05, 9e-4, 0},
    {"stanford-bunny.obj", "beside", 0.05, 11e-4, 0},
};

/* What is not counted: degrees around a threshold, and sine under which a polygon is seen edge-on. */
static const double doubt = 0.01, edge_on = 1e-4;

static const double pi = 3.14159265358979323846;

static dp_context *context;
static uint8_t picture[4 * WIDTH * HEIGHT];

static const suite_view views[] = {
    {"default", {1, 0.6, 1}, 35, false, 0},
    {"front", {0, 0, 1}, 35, false, 0},
    {"beside", {-0.7, 0.3, 0.9}, 35, false, 0},
    {"ortho", {0.2, 0.5, 1.2}, 0, true, 0},
};
enum { VIEWS = sizeof views / sizeof *views };

/* Thresholds of ridges and valleys, degrees. */
static const double angles[][2] = {{150, 210}, {120, 240}};
enum { ANGLES = sizeof angles / sizeof *angles };

/* A part of an edge, from 0 at its a to 1 at its b. */
typedef struct part {
    double from, to;
    uint32_t edge;
} part;

typedef struct figures {
    double *errors; /* px, of hidden ends */
    size_t ends, room;
    size_t unknown;                 /* hidden ends whose hider is not known */
    double visible, missing, extra; /* px */
    double hider; /* px: the furthest of a hider's own ends from the end that it makes */
} figures;

typedef struct comparison {
    const suite_model *model;
    const ref_model *mesh;
    solver *solver;
    double ridge, valley; /* degrees */
    uint32_t *polygon_of; /* by number in the source */
    part *parts;          /* of segments, sorted by edge */
    size_t count, room;
} comparison;

/* ------- edges ------- */

/* Index of the edge between two vertices: edges are sorted by their vertices. */
static uint32_t find_edge(const ref_model *m, uint32_t u, uint32_t v) {
    const uint32_t low = u < v ? u : v, high = u < v ? v : u;
    size_t from = 0, to = m->edge_count;
    while (from < to) {
        const size_t middle = (from + to) / 2;
        const mesh_edge *const e = &m->edges[middle];
        const uint32_t l = e->a < e->b ? e->a : e->b, h = e->a < e->b ? e->b : e->a;
        if (l < low || (l == low && h < high))
            from = middle + 1;
        else
            to = middle;
    }
    return (uint32_t)from;
}

/* Degrees. */
static double dihedral_of(const ref_model *m, const mesh_edge *e) {
    const mesh_polygon *const p = &m->polygons[e->polygon[0]], *const q =
                                                                   &m->polygons[e->polygon[1]];
    const double angle =
        atan2(v3_len(v3_cross(p->normal, q->normal)), v3_dot(p->normal, q->normal));
    const double side = v3_dot(p->normal, v3_sub(q->centre, m->positions[e->a]));
    return 180 + (side > 0 ? angle : -angle) * 180 / pi;
}

typedef enum answer { NO, YES, EITHER } answer;

/* Is the edge a line where it is visible? */
static answer is_line(const comparison *c, const mesh_edge *e) {
    if (e->polygons > 2 || e->flags != 1 || (e->polygons == 2 && !e->opposed)) return EITHER;
    for (uint32_t i = 0; i < e->polygons; i++)
        if (fabs(solver_sine(c->solver, e->polygon[i])) < edge_on) return EITHER;
    if (e->polygons == 1) return YES;
    const bool first = solver_sine(c->solver, e->polygon[0]) < 0,
               second = solver_sine(c->solver, e->polygon[1]) < 0;
    if (first != second) return YES;
    if (!first) return EITHER; /* hidden, unless the model is open */
    const double dihedral = dihedral_of(c->mesh, e);
    if (fabs(dihedral - c->ridge) < doubt || fabs(dihedral - c->valley) < doubt) return EITHER;
    return dihedral <= c->ridge || dihedral > c->valley ? YES : NO;
}

static double length_of(const comparison *c, uint32_t edge) {
    double a[2], b[2];
    solver_ends(c->solver, edge, a, b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Where a point of the screen lies along the edge. */
static double place_of(const comparison *c, uint32_t edge, const float p[3]) {
    double a[2], b[2];
    solver_ends(c->solver, edge, a, b);
    const double x = b[0] - a[0], y = b[1] - a[1];
    return (((double)p[0] - a[0]) * x + ((double)p[1] - a[1]) * y) / (x * x + y * y);
}

/* ------- ends ------- */

static uint32_t edge_of(const comparison *c, const dp_segment *s) {
    const mesh_polygon *const p = &c->mesh->polygons[c->polygon_of[s->polygon]];
    return find_edge(c->mesh, c->mesh->corners[p->first + s->edge],
                     c->mesh->corners[p->first + (s->edge + 1) % p->count]);
}

/* px from the nearest end of a visible stretch. */
static double error_of(const comparison *c, uint32_t edge, double at) {
    const solver_stretch *list;
    const size_t count = solver_edge(c->solver, edge, &list);
    double least = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (list[i].surfaces == 0)
            least = fmin(least, fmin(fabs(list[i].from - at), fabs(list[i].to - at)));
    return least * length_of(c, edge);
}

/* px from where what is said to hide the edge there begins to. */
static double hider_error_of(const comparison *c, uint32_t edge, double at, uint64_t hider) {
    double from, to;
    if (!solver_hidden_by(c->solver, edge, c->polygon_of[hider], &from, &to)) return INFINITY;
    return fmin(fabs(from - at), fabs(to - at)) * length_of(c, edge);
}

static void take_ends(const comparison *c, const dp_segment *s, uint32_t edge, figures *f) {
    for (int k = 0; k < 2; k++) {
        const double at = place_of(c, edge, k ? s->b : s->a);
        if (s->end[k] != DP_END_HIDDEN) continue;
        mesh_reserve(&f->errors, &f->room, f->ends + 1, sizeof *f->errors);
        f->errors[f->ends++] = error_of(c, edge, at);
        if (s->hider[k] == UINT64_MAX)
            f->unknown++;
        else
            f->hider = fmax(f->hider, hider_error_of(c, edge, at, s->hider[k]));
    }
}

static void take_segments(comparison *c, figures *f) {
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        const dp_segment *const s = &segments[i];
        if (s->edge == UINT32_MAX) continue;
        const uint32_t edge = edge_of(c, s);
        if (is_line(c, &c->mesh->edges[edge]) != YES || !(length_of(c, edge) > 1e-6)) continue;
        const double a = place_of(c, edge, s->a), b = place_of(c, edge, s->b);
        mesh_reserve(&c->parts, &c->room, c->count + 1, sizeof *c->parts);
        c->parts[c->count++] = (part){fmin(a, b), fmax(a, b), edge};
        take_ends(c, s, edge, f);
    }
}

/* ------- lengths ------- */

static int by_edge(const void *left, const void *right) {
    const part *const a = left, *const b = right;
    if (a->edge != b->edge) return a->edge < b->edge ? -1 : 1;
    return a->from < b->from ? -1 : a->from > b->from;
}

/* Length that both a part and a visible stretch cover, as a share of the edge. */
static double shared_length(const part *p, const solver_stretch *list, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        if (list[i].surfaces == 0)
            sum += fmax(0, fmin(p->to, list[i].to) - fmax(p->from, list[i].from));
    return sum;
}

static void take_lengths(comparison *c, figures *f) {
    size_t at = 0;
    qsort(c->parts, c->count, sizeof *c->parts, by_edge);
    for (uint32_t edge = 0; edge < c->mesh->edge_count; edge++) {
        const double length = length_of(c, edge);
        const size_t first = at;
        while (at < c->count && c->parts[at].edge == edge) at++;
        if (is_line(c, &c->mesh->edges[edge]) != YES || !(length > 1e-6)) continue;
        const solver_stretch *list;
        const size_t count = solver_edge(c->solver, edge, &list);
        double visible = 0, drawn = 0, both = 0;
        for (size_t i = 0; i < count; i++)
            visible += list[i].surfaces == 0 ? list[i].to - list[i].from : 0;
        for (size_t i = first; i < at; i++) {
            drawn += c->parts[i].to - c->parts[i].from;
            both += shared_length(&c->parts[i], list, count);
        }
        f->visible += visible * length;
        f->missing += (visible - both) * length;
        f->extra += (drawn - both) * length;
    }
}

/* ------- models ------- */

static int ascending(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static double quantile(const figures *f, double q) {
    return f->ends ? f->errors[(size_t)(q * (double)(f->ends - 1))] : 0;
}

static void compare(const suite_model *model, const dp_camera *camera, const double angle[2],
                    bool exact, figures *f) {
    const dp_style style = {.lines = DP_SIL_RIDGE_VALLEY | DP_BORDER,
                            .ridge_angle = (float)angle[0],
                            .valley_angle = (float)angle[1],
                            .exact_ends = exact};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = picture};
    comparison c = {.model = model,
                    .mesh = model->reference,
                    .ridge = angle[0],
                    .valley = angle[1],
                    .solver = solver_create(model->reference, camera, WIDTH, HEIGHT)};
    dp_diag diag = {0};
    c.polygon_of = calloc(model->arrays.polygon_count + 1, sizeof *c.polygon_of);
    assert_non_null(c.polygon_of);
    for (uint32_t i = 0; i < c.mesh->polygon_count; i++)
        c.polygon_of[c.mesh->polygons[i].source] = i;
    if (dp_draw(context, model->source, camera, &style, &target, &diag) != DP_OK)
        fail_msg("%s: %s", model->name, diag.message);
    take_segments(&c, f);
    take_lengths(&c, f);
    solver_destroy(c.solver);
    free(c.polygon_of);
    free(c.parts);
}

/* What must be reached in a view. */
static known bounds_of(const char *model, const char *view) {
    known out = {model, view, worst_most, length_most, 0};
    for (size_t i = 0; i < sizeof known_misses / sizeof *known_misses; i++)
        if (!strcmp(known_misses[i].model, model) && !strcmp(known_misses[i].view, view))
            out = known_misses[i];
    return out;
}

static void check(const suite_model *model, uint32_t most_views) {
    for (uint32_t v = 0; v < most_views; v++)
        for (uint32_t a = 0; a < ANGLES; a++) {
            const dp_camera camera = suite_camera(model, &views[v], WIDTH, HEIGHT);
            figures f = {0};
            compare(model, &camera, angles[a], true, &f);
            qsort(f.errors, f.ends, sizeof *f.errors, ascending);
            const double worst = quantile(&f, 1), missing = f.missing / f.visible,
                         extra = f.extra / f.visible;
            print_message("%s, %s, %g/%g: %zu ends, median %.5f, p99 %.5f, worst %.4f px; of %.0f "
                          "px missing %.4f %%, extra %.4f %%; hiders to %.4f px, unknown %zu\n",
                          model->name, views[v].name, angles[a][0], angles[a][1], f.ends,
                          quantile(&f, 0.5), quantile(&f, 0.99), worst, f.visible, 100 * missing,
                          100 * extra, f.hider, f.unknown);
            assert_true(quantile(&f, 0.5) <= median_most && quantile(&f, 0.99) <= p99_most);
            const known most = bounds_of(model->name, views[v].name);
            assert_true(worst <= most.worst && f.hider <= worst_most && f.unknown <= most.unknown);
            assert_true(missing <= most.missing && extra <= length_most);
            free(f.errors);
        }
}

static suite_model *shape_model(const char *name) {
    const dp_shape shape = {.name = name};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_from_shape(&shape, &source, &diag) != DP_OK) fail_msg("%s", diag.message);
    suite_model *const model = suite_model_create(name, source, 0, 0, &diag);
    dp_source_destroy(source);
    if (model == NULL) fail_msg("%s: %s", name, diag.message);
    return model;
}

static void check_shape(const char *name) {
    suite_model *const model = shape_model(name);
    check(model, VIEWS);
    suite_model_destroy(model);
}

static void gear(void **state) { (void)state, check_shape("gear"); }
static void bolt(void **state) { (void)state, check_shape("bolt"); }
static void bracket(void **state) { (void)state, check_shape("bracket"); }
static void torus(void **state) { (void)state, check_shape("torus"); }
static void stairs(void **state) { (void)state, check_shape("stairs"); }

static void check_file(const char *name, uint32_t most_views) {
    char path[512];
    dp_source *source = NULL;
    dp_diag diag = {0};
    snprintf(path, sizeof path, "%s/../../shared/models/%s", DP_TESTS_DIR, name);
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        print_message("%s is not there\n", path);
        skip();
    }
    fclose(file);
    if (dp_source_open(path, NULL, &source, &diag) != DP_OK) fail_msg("%s", diag.message);
    suite_model *const model = suite_model_create(name, source, 0, 0, &diag);
    dp_source_destroy(source);
    if (model == NULL) fail_msg("%s: %s", name, diag.message);
    check(model, most_views);
    suite_model_destroy(model);
}

static void fandisk(void **state) { (void)state, check_file("fandisk.obj", VIEWS); }
static void rocker_arm(void **state) { (void)state, check_file("rocker-arm.obj", VIEWS); }
static void bunny(void **state) { (void)state, check_file("stanford-bunny.obj", VIEWS); }

/* Sampled ends miss the figures: the check can fail. */
static void sampled_ends_are_noticed(void **state) {
    suite_model *const model = shape_model("gear");
    const dp_camera camera = suite_camera(model, &views[0], WIDTH, HEIGHT);
    figures f = {0};
    (void)state;
    compare(model, &camera, angles[0], false, &f);
    qsort(f.errors, f.ends, sizeof *f.errors, ascending);
    assert_true(f.ends > 40);
    assert_true(quantile(&f, 0.5) > 5 * median_most && quantile(&f, 0.99) > 5 * p99_most);
    free(f.errors);
    suite_model_destroy(model);
}

/* A square before the edge of another one: where they meet on the screen, and how many hide it. */
static void solver_knows_a_square(void **state) {
    static const float corners[8][3] = {{-4, -2, 0}, {4, -2, 0}, {4, 2, 0}, {-4, 2, 0},
                                        {-1, -3, 1}, {1, -3, 1}, {1, 3, 1}, {-1, 3, 1}};
    static const uint32_t firsts[3] = {0, 4, 8};
    const dp_batch batch = {.positions = corners[0],
                            .vertex_count = 8,
                            .corner_count = 8,
                            .firsts = firsts,
                            .polygon_count = 2,
                            .stable = true};
    dp_source *source = NULL;
    dp_camera camera = {{0}, {0}};
    (void)state;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    dp_camera_look_at(&camera, (const double[3]){0, 0, 20}, (const double[3]){0, 0, 0},
                      (const double[3]){0, 1, 0});
    dp_camera_orthographic(&camera, 10, 1.6, 1, 100);
    ref_model *const model = ref_model_create(source, false);
    solver *const made = solver_create(model, &camera, 160, 100);
    const solver_stretch *list;
    double from, to;
    const uint32_t edge = find_edge(model, 0, 1);
    assert_int_equal(solver_edge(made, edge, &list), 3);
    assert_true(fabs(list[1].from - 0.375) < 1e-9 && fabs(list[1].to - 0.625) < 1e-9);
    assert_int_equal(list[0].surfaces, 0);
    assert_int_equal(list[1].surfaces, 1);
    assert_int_equal(list[1].fronts, 1);
    assert_true(solver_hidden_by(made, edge, 1, &from, &to) && fabs(from - 0.375) < 1e-9);
    assert_int_equal(solver_edge(made, find_edge(model, 4, 5), &list), 1);
    solver_destroy(made);
    ref_model_destroy(model);
    dp_source_destroy(source);
}

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solver_knows_a_square),
        cmocka_unit_test(sampled_ends_are_noticed),
        cmocka_unit_test(gear),
        cmocka_unit_test(bolt),
        cmocka_unit_test(bracket),
        cmocka_unit_test(torus),
        cmocka_unit_test(stairs),
        cmocka_unit_test(fandisk),
        cmocka_unit_test(rocker_arm),
        cmocka_unit_test(bunny),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
