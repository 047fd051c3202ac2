/* Stretches of edges that polygons hide (solver.h).
 *
 *     once            project every vertex; sort polygons into cells of the picture
 *     for each edge   lift it; for each polygon in the cells that it crosses, the interval that it
 *                     hides; sort their ends; count how many hide each stretch
 *
 * Beyond the picture, cells at its border hold what lies there. */
#include "solver.h"

#include <stdlib.h>
#include <string.h>

#define LIFT    0.1  /* px */
#define NEARER  0.05 /* px */
#define NO_MEAN 1e-3 /* length of the sum of two unit normals that cancel */

enum { CELL = 16 /* px */ };

/* On the screen: px; depth, affine in x and y on any plane, larger when nearer. */
typedef struct spot {
    double x, y, d;
} spot;

/* Where a polygon's interval begins or ends. */
typedef struct event {
    double at;
    int surfaces, fronts; /* by how much the numbers change there */
} event;

struct solver {
    const ref_model *model;
    double view[16], projection[16]; /* column-major */
    bool orthographic;
    v3 eye, forward;
    double width, height, focal; /* px; px per unit at distance 1, or everywhere */
    spot *spots;                 /* by vertex */
    double *sines;               /* by polygon */
    uint32_t across, down;       /* cells */
    uint32_t *first, *listed;    /* by cell: its first in `listed`, of polygons */
    uint32_t *stamps, stamp;     /* by polygon: the edge it was last looked at for */
    event *events;
    solver_stretch *stretches;
    size_t event_count, event_room, stretch_count, stretch_room;
};

/* ------- projection ------- */

static void transform(const double m[16], const double v[4], double out[4]) {
    for (int r = 0; r < 4; r++)
        out[r] = m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r] * v[3];
}

static spot project(const solver *s, v3 p) {
    double seen[4], clip[4];
    transform(s->view, (const double[4]){p.x, p.y, p.z, 1}, seen);
    transform(s->projection, seen, clip);
    return (spot){(clip[0] / clip[3] + 1) / 2 * s->width, (1 - clip[1] / clip[3]) / 2 * s->height,
                  s->orthographic ? seen[2] : -1 / seen[2]};
}

/* World units per px at this depth. */
static double pixel_at(const solver *s, double d) {
    return 1 / (s->orthographic ? s->focal : d * s->focal);
}

/* How much nearer than depth d a surface must be to hide it. */
static double slack_at(const solver *s, double d) {
    return NEARER / s->focal * (s->orthographic ? 1 : d);
}

static void take_camera(solver *s, const dp_camera *camera) {
    const double *const v = camera->view;
    memcpy(s->view, camera->view, sizeof s->view);
    memcpy(s->projection, camera->projection, sizeof s->projection);
    s->orthographic = camera->projection[15] != 0;
    s->focal = camera->projection[5] * s->height / 2;
    s->forward = v3_unit((v3){-v[2], -v[6], -v[10]});
    s->eye = (v3){-(v[0] * v[12] + v[1] * v[13] + v[2] * v[14]),
                  -(v[4] * v[12] + v[5] * v[13] + v[6] * v[14]),
                  -(v[8] * v[12] + v[9] * v[13] + v[10] * v[14])};
}

static v3 corner_of(const solver *s, uint32_t polygon, uint32_t i) {
    const mesh_polygon *const p = &s->model->polygons[polygon];
    return s->model->positions[s->model->corners[p->first + i % p->count]];
}
static spot spot_of(const solver *s, uint32_t polygon, uint32_t i) {
    const mesh_polygon *const p = &s->model->polygons[polygon];
    return s->spots[s->model->corners[p->first + i % p->count]];
}

static double sine_of(const solver *s, uint32_t polygon) {
    const v3 sight =
        s->orthographic ? s->forward : v3_unit(v3_sub(corner_of(s, polygon, 0), s->eye));
    return v3_dot(s->model->polygons[polygon].normal, sight);
}

double solver_sine(const solver *s, uint32_t polygon) { return s->sines[polygon]; }

/* ------- cells ------- */

typedef struct cells {
    uint32_t x0, y0, x1, y1; /* inclusive */
} cells;

static uint32_t cell_of(double px, uint32_t count) {
    return px < CELL ? 0 : px >= (double)CELL * count ? count - 1 : (uint32_t)(px / CELL);
}

static cells cells_of(const solver *s, double x0, double y0, double x1, double y1) {
    return (cells){cell_of(x0, s->across), cell_of(y0, s->down), cell_of(x1, s->across),
                   cell_of(y1, s->down)};
}

static cells cells_of_polygon(const solver *s, uint32_t polygon) {
    spot p = spot_of(s, polygon, 0), least = p, most = p;
    for (uint32_t i = 1; i < s->model->polygons[polygon].count; i++) {
        p = spot_of(s, polygon, i);
        least = (spot){fmin(least.x, p.x), fmin(least.y, p.y), 0};
        most = (spot){fmax(most.x, p.x), fmax(most.y, p.y), 0};
    }
    return cells_of(s, least.x, least.y, most.x, most.y);
}

/* Counts the polygons of each cell, or lists them from the end of its run towards its start. */
static void visit_polygons(solver *s, bool counting) {
    for (uint32_t p = 0; p < s->model->polygon_count; p++) {
        const cells c = cells_of_polygon(s, p);
        for (uint32_t y = c.y0; y <= c.y1; y++)
            for (uint32_t x = c.x0; x <= c.x1; x++) {
                uint32_t *const first = &s->first[y * s->across + x];
                if (counting)
                    ++*first;
                else
                    s->listed[--*first] = p;
            }
    }
}

static void *allocated(size_t count, size_t size) {
    void *const block = calloc(count + 1, size);
    if (block == NULL) abort();
    return block;
}

static void sort_polygons(solver *s) {
    const uint32_t count = s->across * s->down;
    uint32_t sum = 0;
    s->first = allocated((size_t)count + 1, sizeof *s->first);
    visit_polygons(s, true);
    for (uint32_t i = 0; i < count; i++) s->first[i] = sum += s->first[i];
    s->first[count] = sum;
    s->listed = allocated(sum, sizeof *s->listed);
    visit_polygons(s, false);
}

solver *solver_create(const ref_model *model, const dp_camera *camera, uint32_t width,
                      uint32_t height) {
    solver *const s = allocated(1, sizeof *s);
    s->model = model;
    s->width = width, s->height = height;
    take_camera(s, camera);
    s->across = width / CELL + 1, s->down = height / CELL + 1;
    s->spots = allocated(model->vertex_count, sizeof *s->spots);
    s->sines = allocated(model->polygon_count, sizeof *s->sines);
    s->stamps = allocated(model->polygon_count, sizeof *s->stamps);
    for (size_t v = 0; v < model->vertex_count; v++) s->spots[v] = project(s, model->positions[v]);
    for (uint32_t p = 0; p < model->polygon_count; p++) s->sines[p] = sine_of(s, p);
    sort_polygons(s);
    return s;
}

void solver_destroy(solver *s) {
    if (s == NULL) return;
    free(s->spots);
    free(s->sines);
    free(s->first);
    free(s->listed);
    free(s->stamps);
    free(s->events);
    free(s->stretches);
    free(s);
}

/* ------- intervals ------- */

typedef struct line {
    spot a, b; /* lifted */
} line;

static line lifted_line(const solver *s, uint32_t edge) {
    const mesh_edge *const e = &s->model->edges[edge];
    v3 normal = s->model->polygons[e->polygon[0]].normal;
    if (e->polygons == 1 && s->sines[e->polygon[0]] > 0) normal = v3_mul(normal, -1);
    if (e->polygons > 1) normal = v3_add(normal, s->model->polygons[e->polygon[1]].normal);
    normal = v3_len(normal) > NO_MEAN ? v3_unit(normal) : (v3){0, 0, 0};
    spot ends[2];
    for (int k = 0; k < 2; k++) {
        const uint32_t v = k ? e->b : e->a;
        ends[k] = project(
            s, v3_add(s->model->positions[v], v3_mul(normal, LIFT * pixel_at(s, s->spots[v].d))));
    }
    return (line){ends[0], ends[1]};
}

void solver_ends(const solver *s, uint32_t edge, double a[2], double b[2]) {
    const spot p = s->spots[s->model->edges[edge].a], q = s->spots[s->model->edges[edge].b];
    a[0] = p.x, a[1] = p.y, b[0] = q.x, b[1] = q.y;
}

/* Keeps the part of [*from, *to] where what is `a` at 0 and `b` at 1 is above zero. */
static void keep(double *from, double *to, double a, double b) {
    if (a <= 0 && b <= 0) *to = *from;
    if (a < 0 && b > 0) *from = fmax(*from, a / (a - b));
    if (a > 0 && b < 0) *to = fmin(*to, a / (a - b));
}

static double left_of(spot p, spot q, spot at) {
    return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
}

/* How much nearer the plane through the polygon's corners is than what it must be to hide `at`. */
static double before(const solver *s, const double plane[2], spot o, spot at) {
    return o.d + plane[0] * (at.x - o.x) + plane[1] * (at.y - o.y) - at.d - slack_at(s, at.d);
}

static bool interval_of(const solver *s, const line *l, uint32_t polygon, double *from,
                        double *to) {
    const uint32_t count = s->model->polygons[polygon].count;
    const spot o = spot_of(s, polygon, 0);
    double area = 0, nx = 0, ny = 0;
    for (uint32_t i = 1; i + 1 < count; i++) { /* Newell */
        const spot p = spot_of(s, polygon, i), q = spot_of(s, polygon, i + 1);
        area += left_of(o, p, q);
        nx += (p.d - o.d) * (q.y - o.y) - (q.d - o.d) * (p.y - o.y);
        ny += (q.d - o.d) * (p.x - o.x) - (p.d - o.d) * (q.x - o.x);
    }
    *from = 0, *to = 1;
    if (area == 0) return false;
    for (uint32_t i = 0; i < count && *from < *to; i++) {
        const spot p = spot_of(s, polygon, i), q = spot_of(s, polygon, i + 1);
        const double sign = area > 0 ? 1 : -1;
        keep(from, to, sign * left_of(p, q, l->a), sign * left_of(p, q, l->b));
    }
    const double plane[2] = {nx / area, ny / area};
    keep(from, to, before(s, plane, o, l->a), before(s, plane, o, l->b));
    return *from < *to;
}

bool solver_hidden_by(const solver *s, uint32_t edge, uint32_t polygon, double *from, double *to) {
    const line l = lifted_line(s, edge);
    return interval_of(s, &l, polygon, from, to);
}

static void add_event(solver *s, double at, int surfaces, int fronts) {
    mesh_reserve(&s->events, &s->event_room, s->event_count + 1, sizeof *s->events);
    s->events[s->event_count++] = (event){at, surfaces, fronts};
}

static void add_interval(solver *s, const line *l, const mesh_edge *e, uint32_t polygon) {
    double from, to;
    const bool own = polygon == e->polygon[0] || (e->polygons > 1 && polygon == e->polygon[1]);
    if (s->stamps[polygon] == s->stamp) return;
    s->stamps[polygon] = s->stamp;
    if (own || !interval_of(s, l, polygon, &from, &to)) return;
    const int front = s->sines[polygon] < 0;
    add_event(s, from, 1, front);
    add_event(s, to, -1, -front);
}

/* All intervals of polygons in the cells that the line crosses, a cell's length at a time. */
static void find_intervals(solver *s, uint32_t edge) {
    const line l = lifted_line(s, edge);
    const double dx = l.b.x - l.a.x, dy = l.b.y - l.a.y;
    const int parts = (int)(hypot(dx, dy) / CELL) + 1;
    s->stamp++;
    s->event_count = 0;
    for (int i = 0; i < parts; i++) {
        const double x0 = l.a.x + dx * i / parts, x1 = l.a.x + dx * (i + 1) / parts,
                     y0 = l.a.y + dy * i / parts, y1 = l.a.y + dy * (i + 1) / parts;
        const cells c = cells_of(s, fmin(x0, x1), fmin(y0, y1), fmax(x0, x1), fmax(y0, y1));
        for (uint32_t y = c.y0; y <= c.y1; y++)
            for (uint32_t x = c.x0; x <= c.x1; x++)
                for (uint32_t k = s->first[y * s->across + x]; k < s->first[y * s->across + x + 1];
                     k++)
                    add_interval(s, &l, &s->model->edges[edge], s->listed[k]);
    }
}

/* ------- stretches ------- */

static int by_place(const void *left, const void *right) {
    const event *const a = left, *const b = right;
    return a->at < b->at ? -1 : a->at > b->at;
}

/* Appends a stretch, if it is not too short; it then begins where the one before ends. */
static void add_stretch(solver *s, double from, double to, int surfaces, int fronts,
                        double sliver) {
    solver_stretch *const last = s->stretch_count ? &s->stretches[s->stretch_count - 1] : NULL;
    if (to - from <= sliver) return;
    if (last && last->surfaces == (uint32_t)surfaces && last->fronts == (uint32_t)fronts) {
        last->to = to;
        return;
    }
    mesh_reserve(&s->stretches, &s->stretch_room, s->stretch_count + 1, sizeof *s->stretches);
    s->stretches[s->stretch_count++] =
        (solver_stretch){from, to, (uint32_t)surfaces, (uint32_t)fronts};
}

/* Those that are left out go to the stretch before them, or the first. */
static void close_gaps(solver *s) {
    for (size_t i = 0; i < s->stretch_count; i++) {
        s->stretches[i].from = i ? s->stretches[i].from : 0;
        s->stretches[i].to = i + 1 < s->stretch_count ? s->stretches[i + 1].from : 1;
    }
}

size_t solver_edge(solver *s, uint32_t edge, const solver_stretch **out) {
    double a[2], b[2], last = 0;
    int surfaces = 0, fronts = 0;
    solver_ends(s, edge, a, b);
    const double length = hypot(b[0] - a[0], b[1] - a[1]), sliver = SOLVER_SLIVER / length;
    find_intervals(s, edge);
    qsort(s->events, s->event_count, sizeof *s->events, by_place);
    s->stretch_count = 0;
    for (size_t i = 0; i < s->event_count; i++) {
        const event *const e = &s->events[i];
        add_stretch(s, last, e->at, surfaces, fronts, sliver);
        surfaces += e->surfaces, fronts += e->fronts;
        last = e->at;
    }
    add_stretch(s, last, 1, surfaces, fronts, sliver);
    close_gaps(s);
    *out = s->stretches;
    return s->stretch_count;
}
