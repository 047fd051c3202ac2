/* Hidden lines and their levels against counting by rays: every edge of a model, every half pixel.
 *
 * The truth shares no code with the library: edges from the reference's adjacency, their class from
 * their two polygons, and at each sample a ray to the eye that counts every front-facing triangle it
 * meets, in double precision and without a hierarchy. What lies within a pixel of where the truth
 * changes is not counted, nor are folds within a degree of a threshold. `test_levels FILE...` measures
 * other models. */
#include "mesh.h"
#include "suite.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 640, HEIGHT = 480, LEVELS = 8, UNSURE = -1 };

static const double STEP = 0.5;               /* px between samples */
static const double LIFT = 0.1, BLIND = 0.05; /* px: docs/lines.md */
static const double NUDGE = 0.01;             /* px */
static const double CRUMB = 2;                /* px: shorter edges may have been dropped */
static const double RIDGE = 150, VALLEY = 210, DOUBT = 1, EDGE_ON = 1e-6;

typedef struct eye {
    double clip[16], near;
    v3 at, forward;
    bool orthographic;
    double pixel; /* at distance 1, or everywhere */
} eye;

static eye eye_of(const dp_camera *camera) {
    const double *const v = camera->view, *const p = camera->projection;
    eye e = {.orthographic = p[15] != 0};
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            for (int k = 0; k < 4; k++) e.clip[4 * c + r] += p[4 * k + r] * v[4 * c + k];
    e.at = (v3){-(v[0] * v[12] + v[1] * v[13] + v[2] * v[14]),
                -(v[4] * v[12] + v[5] * v[13] + v[6] * v[14]),
                -(v[8] * v[12] + v[9] * v[13] + v[10] * v[14])};
    e.forward = v3_unit((v3){-v[2], -v[6], -v[10]});
    e.near = e.orthographic ? (1 + p[14]) / p[10] : -p[14] / (1 - p[10]);
    e.pixel = 2 / (p[5] * HEIGHT);
    return e;
}

static double depth_of(const eye *e, v3 p) { return v3_dot(v3_sub(p, e->at), e->forward); }

static v3 towards(const eye *e, v3 p) {
    return e->orthographic ? v3_mul(e->forward, -1) : v3_unit(v3_sub(e->at, p));
}

static void project(const eye *e, v3 p, double out[3] /* x, y px; w */) {
    const double *const m = e->clip;
    const double x = m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                 y = m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                 w = m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15];
    out[0] = (x / w / 2 + 0.5) * WIDTH, out[1] = (0.5 - y / w / 2) * HEIGHT, out[2] = w;
}

/* A triangle as rays meet it. */
typedef struct wall {
    v3 corner, u, v;
    uint32_t owner;
    bool front;
    double box[4]; /* px: x0, y0, x1, y1 */
} wall;

typedef struct truth {
    const ref_model *model;
    eye eye;
    wall *walls;
    size_t count;
} truth;

static wall wall_of(const eye *e, v3 a, v3 b, v3 c, const mesh_polygon *polygon, uint32_t owner) {
    wall w = {a,
              v3_sub(b, a),
              v3_sub(c, a),
              owner,
              v3_dot(polygon->normal, towards(e, a)) > 0,
              {1e9, 1e9, -1e9, -1e9}};
    const v3 corners[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        double at[3];
        project(e, corners[i], at);
        for (int k = 0; k < 2; k++)
            w.box[k] = fmin(w.box[k], at[k] - 1), w.box[2 + k] = fmax(w.box[2 + k], at[k] + 1);
    }
    return w;
}

static truth make_truth(const ref_model *model, const dp_camera *camera) {
    truth t = {.model = model, .eye = eye_of(camera)};
    t.walls = malloc((model->corner_count + 1) * sizeof *t.walls);
    if (!t.walls) abort();
    for (size_t i = 0; i < model->polygon_count; i++) {
        const mesh_polygon *const p = &model->polygons[i];
        const uint32_t *const c = model->corners + p->first;
        for (uint32_t k = 2; k < p->count; k++)
            t.walls[t.count++] = wall_of(&t.eye, model->positions[c[0]], model->positions[c[k - 1]],
                                         model->positions[c[k]], p, (uint32_t)i);
    }
    return t;
}

/* Does the ray from p along d meet the wall in (near, far)? (Möller and Trumbore 1997) */
static bool meets(const wall *w, v3 p, v3 d, double near, double far) {
    const v3 q = v3_cross(d, w->v);
    const double det = v3_dot(w->u, q);
    if (det == 0) return false;
    const v3 from = v3_sub(p, w->corner), r = v3_cross(from, w->u);
    const double u = v3_dot(from, q) / det, v = v3_dot(d, r) / det, t = v3_dot(w->v, r) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > near && t < far;
}

/* An edge as a line. */
typedef struct edge_line {
    v3 a, b, off;
    uint32_t polygon[2];
    int kind; /* dp_line, or -1 */
} edge_line;

/* How many front faces lie before a point, and 1 where only back faces do. */
static int count_before(const truth *t, const edge_line *line, v3 from, double blind) {
    const v3 d = towards(&t->eye, from);
    const double slope = -v3_dot(d, t->eye.forward),
                 far = (depth_of(&t->eye, from) - t->eye.near) / slope;
    double at[3];
    int fronts = 0;
    bool any = false;
    project(&t->eye, from, at);
    for (size_t i = 0; i < t->count; i++) {
        const wall *const w = &t->walls[i];
        if (at[0] < w->box[0] || at[1] < w->box[1] || at[0] > w->box[2] || at[1] > w->box[3])
            continue;
        if (w->owner == line->polygon[0] || w->owner == line->polygon[1]) continue;
        if (!meets(w, from, d, blind / slope, far)) continue;
        fronts += w->front, any = true;
    }
    return fronts ? (fronts < LEVELS ? fronts : LEVELS) : any;
}

/* The level of a point of the line: what both sides of it say, NUDGE px off, as an edge may run
 * exactly before it; or UNSURE. */
static int level_at(const truth *t, const edge_line *line, v3 p) {
    const double depth = depth_of(&t->eye, p),
                 pixel = t->eye.orthographic ? t->eye.pixel : t->eye.pixel * depth;
    const v3 from = v3_add(p, v3_mul(line->off, LIFT * pixel)),
             aside = v3_unit(v3_cross(v3_sub(line->b, line->a), towards(&t->eye, p)));
    int level[2];
    for (int i = 0; i < 2; i++)
        level[i] = count_before(t, line, v3_add(from, v3_mul(aside, (i ? NUDGE : -NUDGE) * pixel)),
                                BLIND * pixel);
    return level[0] == level[1] ? level[0] : UNSURE;
}

/* The class of an edge that two polygons have. */
static int kind_of(const truth *t, const mesh_edge *e) {
    const ref_model *const m = t->model;
    const mesh_polygon *const p = &m->polygons[e->polygon[0]], *const q =
                                                                   &m->polygons[e->polygon[1]];
    const v3 at = m->positions[e->a], sight = towards(&t->eye, at);
    const double fp = v3_dot(p->normal, sight), fq = v3_dot(q->normal, sight);
    if (fabs(fp) < EDGE_ON || fabs(fq) < EDGE_ON) return -1;
    if ((fp > 0) != (fq > 0)) return DP_LINE_SILHOUETTE;
    const double angle =
        atan2(v3_len(v3_cross(p->normal, q->normal)), v3_dot(p->normal, q->normal)) * 180 /
        3.14159265358979323846;
    const bool concave = v3_dot(p->normal, v3_sub(q->centre, at)) > 0;
    const double dihedral = concave ? 180 + angle : 180 - angle;
    if (dihedral < RIDGE - DOUBT) return DP_LINE_RIDGE;
    return dihedral > VALLEY + DOUBT ? DP_LINE_VALLEY : -1;
}

/* ------- what was drawn ------- */

/* A hidden segment, by the edge that it lies on. */
typedef struct drawn {
    uint32_t a, b; /* vertices, a < b */
    const dp_segment *segment;
} drawn;

static int by_vertices(const void *left, const void *right) {
    const drawn *const l = left, *const r = right;
    if (l->a != r->a) return l->a < r->a ? -1 : 1;
    return (l->b > r->b) - (l->b < r->b);
}

typedef struct drawing {
    drawn *of;
    size_t count;
} drawing;

static drawing list_drawn(const ref_model *m, const dp_segment *segments, size_t count) {
    uint64_t sources = 0;
    for (size_t i = 0; i < m->polygon_count; i++)
        if (m->polygons[i].source >= sources) sources = m->polygons[i].source + 1;
    uint32_t *const polygon = calloc(sources + 1, sizeof *polygon);
    drawing d = {malloc((count + 1) * sizeof *d.of), 0};
    if (!polygon || !d.of) abort();
    for (size_t i = 0; i < m->polygon_count; i++) polygon[m->polygons[i].source] = (uint32_t)i;
    for (size_t i = 0; i < count; i++) {
        const dp_segment *const s = &segments[i];
        if (!s->level || s->edge == UINT32_MAX) continue;
        const mesh_polygon *const p = &m->polygons[polygon[s->polygon]];
        const uint32_t u = m->corners[p->first + s->edge],
                       v = m->corners[p->first + (s->edge + 1) % p->count];
        d.of[d.count++] = (drawn){u < v ? u : v, u < v ? v : u, s};
    }
    free(polygon);
    if (d.count) qsort(d.of, d.count, sizeof *d.of, by_vertices);
    return d;
}

/* The level drawn at (x, y) of an edge, 0 where nothing hidden is; *kind: its class. */
static int drawn_at(const drawing *d, const mesh_edge *e, double x, double y, int *kind) {
    const drawn key = {e->a < e->b ? e->a : e->b, e->a < e->b ? e->b : e->a, NULL};
    size_t lo = 0, hi = d->count;
    while (lo < hi) {
        const size_t at = (lo + hi) / 2;
        if (by_vertices(&d->of[at], &key) < 0)
            lo = at + 1;
        else
            hi = at;
    }
    for (; lo < d->count && !by_vertices(&d->of[lo], &key); lo++) {
        const float *const a = d->of[lo].segment->a, *const b = d->of[lo].segment->b;
        const double ex = (double)b[0] - (double)a[0], ey = (double)b[1] - (double)a[1];
        const double along = (x - (double)a[0]) * ex + (y - (double)a[1]) * ey;
        if (along < 0 || along > ex * ex + ey * ey) continue;
        *kind = d->of[lo].segment->line;
        return (int)d->of[lo].segment->level;
    }
    return 0;
}

/* ------- scores ------- */

typedef struct levels_score {
    double hidden, right, stray, other_class; /* samples */
    double by_level[LEVELS + 1][2];           /* those, and of them right */
} levels_score;

enum { SAMPLES = 8192 };

static void score_edge(const truth *t, const mesh_edge *e, const drawing *d, levels_score *sum) {
    static int level[SAMPLES];
    const ref_model *const m = t->model;
    const mesh_polygon *const p = &m->polygons[e->polygon[0]], *const q =
                                                                   &m->polygons[e->polygon[1]];
    const edge_line line = {m->positions[e->a],
                            m->positions[e->b],
                            v3_unit(v3_add(p->normal, q->normal)),
                            {e->polygon[0], e->polygon[1]},
                            kind_of(t, e)};
    double a[3], b[3];
    if (line.kind < 0) return;
    project(&t->eye, line.a, a);
    project(&t->eye, line.b, b);
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    const int n = (int)ceil(length / STEP);
    if (n < 1 || n > SAMPLES) return;
    for (int i = 0; i < n; i++) {
        const double s = (i + 0.5) / n, w = s * a[2] / (b[2] - s * (b[2] - a[2]));
        level[i] = level_at(t, &line, v3_mix(line.a, line.b, w));
    }
    const int beside = (int)ceil(1 / STEP);
    for (int i = 0; i < n; i++) {
        const double s = (i + 0.5) / n, x = a[0] + s * (b[0] - a[0]), y = a[1] + s * (b[1] - a[1]);
        bool settled = x > 2 && y > 2 && x < WIDTH - 2 && y < HEIGHT - 2;
        for (int k = i - beside; k <= i + beside; k++)
            settled &= k < 0 || k >= n || level[k] == level[i];
        if (!settled || level[i] == UNSURE) continue;
        int kind = line.kind;
        const int found = drawn_at(d, e, x, y, &kind);
        sum->stray += !level[i] && found;
        if (!level[i] || (!found && length < CRUMB)) continue;
        sum->hidden++;
        sum->right += found == level[i];
        sum->other_class += kind != line.kind;
        sum->by_level[level[i]][0]++;
        sum->by_level[level[i]][1] += found == level[i];
    }
}

static levels_score score_view(dp_context *context, const suite_model *model,
                               const suite_view *view) {
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    levels_score sum = {0};
    dp_diag diag;
    const dp_camera camera = suite_camera(model, view, WIDTH, HEIGHT);
    const dp_style style = {.hidden = {.look = DP_HIDDEN_SOLID, .levels = LEVELS, .smooth = true}};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    if (dp_source_rewind(model->source, &diag)) fail_msg("%s", diag.message);
    if (dp_draw(context, model->source, &camera, &style, &target, &diag))
        fail_msg("%s: %s", model->name, diag.message);
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    truth t = make_truth(model->reference, &camera);
    drawing d = list_drawn(model->reference, segments, count);
    for (size_t i = 0; i < model->reference->edge_count; i++) {
        const mesh_edge *const e = &model->reference->edges[i];
        if (e->polygons == 2 && e->opposed) score_edge(&t, e, &d, &sum);
    }
    free(t.walls);
    free(d.of);
    return sum;
}

static void print_score(const char *name, const char *view, const levels_score *s) {
    print_message("%-12s %-8s hidden %7.0f px  right %.4f  stray %.4f  class %.4f ", name, view,
                  s->hidden * STEP, s->right / s->hidden, s->stray / s->hidden,
                  1 - s->other_class / s->hidden);
    for (int k = 1; k <= LEVELS; k++)
        if (s->by_level[k][0] > 0)
            print_message(" %d: %.0f %.3f", k, s->by_level[k][0] * STEP,
                          s->by_level[k][1] / s->by_level[k][0]);
    print_message("\n");
}

static suite_model *model_of(const char *name, bool file) {
    const char *const slash = strrchr(name, '/');
    const dp_shape shape = {.name = name, .triangles = 4000};
    dp_source *source = NULL;
    dp_diag diag = {0};
    const dp_result result = file ? dp_source_open(name, NULL, &source, &diag)
                                  : dp_source_from_shape(&shape, &source, &diag);
    if (result) fail_msg("%s: %s", name, diag.message);
    suite_model *const model = suite_model_create(slash ? slash + 1 : name, source, 0, 0, &diag);
    dp_source_destroy(source);
    if (!model) fail_msg("%s: %s", name, diag.message);
    return model;
}

static const char *const shapes[] = {"cube", "gear", "bracket", "bolt", "torus"};

static void add_score(levels_score *sum, const levels_score *s) {
    sum->hidden += s->hidden, sum->right += s->right, sum->stray += s->stray;
    sum->other_class += s->other_class;
    for (int k = 0; k <= LEVELS; k++)
        for (int i = 0; i < 2; i++) sum->by_level[k][i] += s->by_level[k][i];
}

/* All views together: in some a torus hides hardly more than its own cusps. */
static levels_score score_model(dp_context *context, const suite_model *model) {
    levels_score sum = {0};
    for (int v = 0; v < SUITE_VIEWS; v++) {
        const levels_score s = score_view(context, model, &suite_views[v]);
        print_score(model->name, suite_views[v].name, &s);
        add_score(&sum, &s);
    }
    print_score(model->name, "all", &sum);
    return sum;
}

static void levels_are_what_rays_count(void **state) {
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        suite_model *const model = model_of(shapes[i], false);
        const levels_score s = score_model(*state, model);
        suite_model_destroy(model);
        if (s.right < 0.99 * s.hidden || s.stray > 0.01 * s.hidden ||
            s.other_class > 0.001 * s.hidden)
            fail_msg("%s: of %.0f hidden samples %.0f are right, %.0f are stray, %.0f of another "
                     "class",
                     shapes[i], s.hidden, s.right, s.stray, s.other_class);
    }
}

static int create_context(void **state) {
    dp_context *context;
    *state = dp_context_create(NULL, &context, NULL) ? NULL : context;
    return *state == NULL;
}

static int destroy_context(void **state) {
    dp_context_destroy(*state);
    return 0;
}

static int measure(int count, char **files) {
    void *context;
    if (create_context(&context)) return 1;
    for (int i = 0; i < count; i++) {
        suite_model *const model = model_of(files[i], true);
        score_model(context, model);
        suite_model_destroy(model);
    }
    return destroy_context(&context);
}

int main(int argc, char **argv) {
    if (argc > 1) return measure(argc - 1, argv + 1);
    const struct CMUnitTest tests[] = {cmocka_unit_test(levels_are_what_rays_count)};
    return cmocka_run_group_tests(tests, create_context, destroy_context);
}
