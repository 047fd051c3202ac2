/* The eye: rays in rows and columns, halved into every change between two neighbours.
 *
 *     for each pair of neighbouring rays that meet different surfaces
 *         halve their distance, into both halves as long as they differ, down to 1/64 of it
 *         at each change: do the planes meet there? at which angle?  -> a point of a line
 *     rows and columns cross a line 4 times for each px that it rises or runs; together, by
 *     Pythagoras, its length
 *
 * Lengths are in the model's diagonals where nothing else is said. */
#include "eye.h"
#include "faces.h"

#include <stdlib.h>
#include <string.h>

enum { GRID = 4 /* rays per px */, HALVINGS = 6 };

static const double one_surface = 1e-5; /* nearer to each other's plane: one. 0.01 px of 1000 */
static const double small_step = 1e-4;  /* up to here, and to 1/10 px, a step is undecided */
static const double crack = 1.0 / 64;   /* px: what is thinner is not seen */
static const double thinnest = 1.0 / 8; /* px: what is thinner is undecided */
static const double doubt = 1;          /* degree, to both sides of a threshold */
static const double flat = 0.9999939;   /* cosine of 0.2 degrees: planes that meet so are one */
static const double pi = 3.14159265358979323846;

typedef struct eye {
    faces faces;
    double theta, phi; /* degrees */
    double least;      /* degrees between normals: the least that may be a line */
    eye_truth *out;
} eye;

/* ------- two hits ------- */

static double off_plane(const hit *plane, v3 p) {
    return fabs(v3_dot(plane->normal, v3_sub(p, plane->at)));
}

/* One surface, with steps of up to `step` and turns of up to an angle with this cosine? */
static bool runs_on(const hit *a, const hit *b, double step, double cosine) {
    if (a->face == b->face) return true;
    if (a->face < 0 || b->face < 0) return false;
    return v3_dot(a->normal, b->normal) > cosine && off_plane(a, b->at) <= step &&
           off_plane(b, a->at) <= step;
}

static bool same(const hit *a, const hit *b) { return runs_on(a, b, one_surface, flat); }

/* With a step that nobody would draw, or may. */
static bool nearly_same(const eye *e, const hit *a, const hit *b) {
    if (a->face < 0) return b->face < 0;
    const double pixel = (e->faces.orthographic ? 1 : -a->at.z) / e->faces.scale[1];
    const double step = fmax(one_surface, fmin(small_step, pixel / 10));
    return runs_on(a, b, step, cos(e->least * pi / 180));
}

typedef struct meeting {
    bool contact; /* the planes meet between the rays */
    bool convex;
    bool along;   /* the rays run along the fold, not across it */
    double angle; /* degrees, between the normals */
} meeting;

/* By how much a's plane is nearer than b's. */
static double lead(const eye *e, const hit *a, const hit *b, double x, double y) {
    return affine_at(&e->faces.all[a->face].nearness, x, y) -
           affine_at(&e->faces.all[b->face].nearness, x, y);
}

/* Neither is a miss. `slack`: how much farther out the planes may meet, in distances. */
static meeting meet(const eye *e, const hit *a, const hit *b, double slack) {
    const double from = lead(e, a, b, a->x, a->y), to = lead(e, a, b, b->x, b->y);
    const double aside = lead(e, a, b, a->x - (b->y - a->y), a->y + (b->x - a->x));
    const double more = slack * (to - from);
    const double cosine = fmax(-1, fmin(1, v3_dot(a->normal, b->normal)));
    return (meeting){.contact = (from - more) * (to + more) <= 0 ||
                                fmax(off_plane(a, b->at), off_plane(b, a->at)) <= one_surface,
                     .convex = to > from,
                     .along = fabs(to - from) < 0.05 * fabs(aside - from),
                     .angle = acos(cosine) * 180 / pi};
}

/* Does each surface run on behind the other? */
static bool cross(const eye *e, const hit *a, const hit *b) {
    return face_pierced(&e->faces.all[a->face], b->x, b->y) &&
           face_pierced(&e->faces.all[b->face], a->x, a->y);
}

/* One surface that turns so little that it has no line. */
static bool quiet(const eye *e, const hit *a, const hit *b) {
    if (a->face < 0 || b->face < 0) return false;
    const meeting m = meet(e, a, b, 0);
    return m.contact && m.angle < e->least && (m.convex || m.angle < 2 || !cross(e, a, b));
}

/* ------- what is around them ------- */

/* What is seen `distance` px behind b, coming from a. */
static hit beyond(const eye *e, const hit *a, const hit *b, double distance) {
    const double dx = b->x - a->x, dy = b->y - a->y, scale = distance / hypot(dx, dy);
    return faces_look(&e->faces, b->x + dx * scale, b->y + dy * scale);
}

/* Behind b, does nothing leave a's plane before a's surface is back, or for a px? */
static bool is_sliver(const eye *e, const hit *a, const hit *b) {
    for (double distance = 4 * crack; distance <= 1; distance *= 4) {
        const hit h = beyond(e, a, b, distance);
        if (h.face < 0 || off_plane(a, h.at) > one_surface) return false;
        if (same(a, &h)) return true;
    }
    return true;
}

/* Is what b lies on thinner than can be seen, with a's surface to both sides? */
static bool is_thin(const eye *e, const hit *a, const hit *b) {
    static const double ways[4][2] = {
        {1, 0}, {0, 1}, {0.70710678, 0.70710678}, {0.70710678, -0.70710678}};
    for (int k = 0; k < 4; k++) {
        const double dx = thinnest * ways[k][0], dy = thinnest * ways[k][1];
        const hit p = faces_look(&e->faces, b->x + dx, b->y + dy);
        const hit q = faces_look(&e->faces, b->x - dx, b->y - dy);
        if (nearly_same(e, a, &p) && nearly_same(e, a, &q)) return true;
    }
    return false;
}

/* ------- what a change is ------- */

enum { NOTHING = EYE_KINDS };

static void add_point(eye *e, double x, double y, unsigned kind, bool row) {
    eye_truth *const t = e->out;
    if (t->count == t->room) {
        t->room = 2 * t->room + 1024;
        t->points = realloc(t->points, t->room * sizeof *t->points);
        if (t->points == NULL) abort();
    }
    t->points[t->count++] = (eye_point){.x = x, .y = y, .kind = (uint8_t)kind, .row = row};
}

static unsigned fold(const eye *e, const hit *a, const hit *b, const meeting *m) {
    const double dihedral = m->convex ? 180 - m->angle : 180 + m->angle;
    const bool one_polygon = e->faces.all[a->face].polygon == e->faces.all[b->face].polygon;
    unsigned kind = NOTHING;
    if (m->along) return NOTHING; /* the rays across will find it */
    if (m->angle > doubt && (fabs(dihedral - e->theta) < doubt || fabs(dihedral - e->phi) < doubt))
        kind = EYE_UNDECIDED;
    else if (dihedral <= e->theta)
        kind = EYE_RIDGE;
    else if (dihedral > e->phi)
        kind = EYE_VALLEY;
    else if (!m->convex && m->angle >= 2 && cross(e, a, b))
        kind = EYE_UNDECIDED;
    return kind != NOTHING && one_polygon ? EYE_UNDECIDED : kind;
}

static unsigned change(const eye *e, const hit *first, const hit *second) {
    hit a = *first, b = *second;
    const hit past_a = beyond(e, &b, &a, crack), past_b = beyond(e, &a, &b, crack);
    unsigned kind = EYE_OUTLINE;
    if (!same(&a, &past_a)) a = past_a; /* what was there is thinner than a crack */
    if (!same(&b, &past_b)) b = past_b;
    if (same(&a, &b)) return NOTHING;
    if (a.face >= 0 && b.face >= 0) {
        const meeting m = meet(e, &a, &b, 2);
        if (!m.contact)
            kind = nearly_same(e, &a, &b) ? EYE_UNDECIDED : EYE_OUTLINE;
        else
            kind = fold(e, &a, &b, &m);
    }
    if (kind == NOTHING) return NOTHING;
    if (kind != EYE_OUTLINE && (is_sliver(e, &a, &b) || is_sliver(e, &b, &a))) return NOTHING;
    return is_thin(e, &a, &past_b) || is_thin(e, &b, &past_a) ? EYE_UNDECIDED : kind;
}

/* Between two rays: how many points were made, and whether other planes were met on the way. */
typedef struct gap {
    unsigned points;
    bool planes;
} gap;

static void halve(eye *e, const hit *a, const hit *b, int times, gap *g) {
    if (same(a, b) || quiet(e, a, b)) return;
    if (times == 0) {
        const unsigned kind = change(e, a, b);
        if (kind == NOTHING) return;
        add_point(e, (a->x + b->x) / 2, (a->y + b->y) / 2, kind,
                  fabs(a->x - b->x) > fabs(a->y - b->y));
        g->points++;
        return;
    }
    const hit m = faces_look(&e->faces, (a->x + b->x) / 2, (a->y + b->y) / 2);
    if (!same(&m, a) && !same(&m, b)) g->planes = true;
    halve(e, a, &m, times - 1, g);
    halve(e, &m, b, times - 1, g);
}

static void between(eye *e, double x0, double y0, int f0, double x1, double y1, int f1) {
    if (f0 == f1) return;
    const hit a = faces_hit(&e->faces, x0, y0, f0), b = faces_hit(&e->faces, x1, y1, f1);
    gap g = {0};
    halve(e, &a, &b, HALVINGS, &g);
    if (g.planes && g.points == 0 && f0 >= 0 && f1 >= 0 && meet(e, &a, &b, 0).angle >= e->least)
        add_point(e, (x0 + x1) / 2, (y0 + y1) / 2, EYE_UNDECIDED, y0 == y1);
}

/* Of a ray, px; off the middle, so that few lines pass exactly through rays. */
static double place(uint32_t i) { return (i + 0.4142) / GRID - (FACES_MARGIN - 1); }

static void look_everywhere(eye *e) {
    const uint32_t n = (e->faces.width + 2 * (FACES_MARGIN - 1)) * GRID;
    const uint32_t rows = (e->faces.height + 2 * (FACES_MARGIN - 1)) * GRID;
    int *above = calloc(n, sizeof *above), *here = calloc(n, sizeof *here);
    if (above == NULL || here == NULL) abort();
    for (uint32_t j = 0; j < rows; j++) {
        for (uint32_t i = 0; i < n; i++) here[i] = faces_first(&e->faces, place(i), place(j));
        for (uint32_t i = 0; i < n; i++) {
            if (i > 0) between(e, place(i - 1), place(j), here[i - 1], place(i), place(j), here[i]);
            if (j > 0) between(e, place(i), place(j - 1), above[i], place(i), place(j), here[i]);
        }
        int *const swap = above;
        above = here;
        here = swap;
    }
    free(above);
    free(here);
}

/* ------- lengths ------- */

/* By how many rows and columns lines are crossed in each 4 x 4 px, a kind on its own. */
static void measure(eye_truth *t) {
    enum { TILE = 4 };
    const size_t columns = (t->width + 2 * FACES_MARGIN) / TILE + 1;
    const size_t rows = (t->height + 2 * FACES_MARGIN) / TILE + 1;
    uint32_t(*counts)[2] = calloc(columns * rows * EYE_KINDS, sizeof *counts);
    if (counts == NULL) abort();
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < t->count; i++) {
            eye_point *const p = &t->points[i];
            const size_t x = (size_t)(p->x + FACES_MARGIN) / TILE;
            const size_t y = (size_t)(p->y + FACES_MARGIN) / TILE;
            uint32_t *const c = counts[(y * columns + x) * EYE_KINDS + p->kind];
            if (pass == 0)
                c[p->row]++;
            else
                p->length = hypot(c[0], c[1]) / (c[0] + c[1]) / GRID;
        }
    free(counts);
}

eye_truth *eye_see(const dp_batch *arrays, const dp_camera *camera, uint32_t width, uint32_t height,
                   double theta, double phi) {
    eye e = {.theta = theta, .phi = phi, .least = fmin(180 - theta, phi - 180) - doubt};
    e.out = calloc(1, sizeof *e.out);
    if (e.out == NULL) abort();
    e.out->width = width;
    e.out->height = height;
    faces_make(&e.faces, arrays, camera, width, height);
    look_everywhere(&e);
    measure(e.out);
    faces_free(&e.faces);
    return e.out;
}

void eye_free(eye_truth *truth) {
    if (truth == NULL) return;
    free(truth->points);
    free(truth);
}
