/* Curvature: S. Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes",
 * 3DPVT 2004.
 *
 *     find_forms      vertex normals, weighed as on a sphere (Max 1999): exact there
 *                     each triangle: its second fundamental form, by least squares from how its
 *                       corners' normals differ along its three edges
 *                     each vertex:   the mean of its triangles' forms, turned into its tangent
 *                       plane, weighed by Voronoi areas (Meyer et al. 2003)
 *     curvature_at    eigenvectors: the principal directions; "least" is by absolute value, so
 *                       that a pencil goes along a cylinder, seen from inside or outside
 *     begin_vertex    Q = confidence (d d' - e e') + STEADY (f f' - g g')
 *                       d: direction of least curvature, e across it; f: fixed, g across it
 *     spread_vertex   Q = (Q + mean of neighbours' Q) / 2, in the tangent plane, n times
 *     end_vertex      the direction of Q
 *
 * Where the curvatures are equal, opposite or nearly 0, the direction is noise and its confidence
 * is 0. Spreading carries certain directions into uncertain regions. Q does not depend on the sign
 * of d. The fixed direction (level lines, or what is nearest to them) decides where nothing is
 * certain. All this is on the mesh, not on the screen: nothing flickers as the camera moves. */
#include "mesh/curvature.h"

#include "base/elementary.h"
#include "base/hostile.h"
#include "base/vec.h"
#include "mesh/fingerprint.h"
#include "mesh/places.h"

#include <string.h>
#include <time.h>

enum { LEAST_SPREADS = 8, MOST_SPREADS = 48 };
static const double UNBENT = 0.15; /* curvature times model size: below, a direction is uncertain */
static const double STEADY = 0.02; /* weight of the fixed direction */

typedef struct curvature_job {
    const dp_polygons *polygons;
    const uint32_t *first; /* [vertices] the first vertex at the same position */
    float (*normal)[3];    /* [vertices] unit */
    float *area;           /* [vertices] sum of weights */
    float (*form)[3];      /* [vertices] second fundamental form a, b, c in the vertex's frame */
} curvature_job;

static dp_vec3 at(const curvature_job *b, uint32_t vertex) {
    return dp_v3f(dp_vertex_position(b->polygons, vertex));
}
static dp_vec3 normal_at(const curvature_job *b, uint32_t vertex) {
    return dp_v3f(b->normal[vertex]);
}

static void add_to(float out[3], dp_vec3 v) {
    out[0] += (float)v.x, out[1] += (float)v.y, out[2] += (float)v.z;
}

/* A tangent frame of a normal, always the same one. */
static void frame_of(dp_vec3 n, dp_vec3 *u, dp_vec3 *v) {
    const dp_vec3 axis = fabs(n.x) < 0.6 ? dp_v3(1, 0, 0) : dp_v3(0, 1, 0);
    *u = dp_unit(dp_cross(axis, n));
    *v = dp_cross(n, *u);
}

/* A triangle of a polygon's fan. */
typedef struct triangle {
    uint32_t v[3];      /* first vertices at their positions */
    dp_vec3 p[3], e[3]; /* e[i] is opposite to corner i, from i + 1 to i + 2 */
    dp_vec3 normal;     /* length: twice the area */
} triangle;

/* Fetches triangle (0, i - 1, i) of a polygon; false where it has no area or an index is bad. */
static bool fetch(const curvature_job *b, uint32_t first, uint32_t i, triangle *t) {
    const uint32_t corners[3] = {first, first + i - 1, first + i};
    for (int k = 0; k < 3; k++) {
        const uint32_t v = dp_corner_vertex(b->polygons, corners[k]);
        if (v >= b->polygons->vertex_count) return false;
        t->v[k] = b->first[v];
        t->p[k] = at(b, v);
    }
    for (int k = 0; k < 3; k++) t->e[k] = dp_sub(t->p[(k + 2) % 3], t->p[(k + 1) % 3]);
    t->normal = dp_cross(t->e[0], t->e[1]);
    const double size = dp_length(t->normal);
    return size > 0 && isfinite(size);
}

typedef void visit(curvature_job *b, const triangle *t);

static void for_triangles(curvature_job *b, visit *with) {
    const dp_polygons *const p = b->polygons;
    triangle t;
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
        for (uint32_t k = 2; k < n; k++)
            if (fetch(b, first, k, &t)) with(b, &t);
    }
}

/* Max 1999: the cross product over the squares of the two edges' lengths. */
static void add_normals(curvature_job *b, const triangle *t) {
    for (int k = 0; k < 3; k++) {
        const dp_vec3 p = t->e[(k + 1) % 3], q = t->e[(k + 2) % 3];
        const double weight = dp_dot(p, p) * dp_dot(q, q);
        if (weight > 0) add_to(b->normal[t->v[k]], dp_scale(t->normal, 1 / weight));
    }
}

/* Voronoi areas of the corners; of an obtuse triangle, cut off at its sides. */
static void corner_areas(const triangle *t, double out[3]) {
    const double area = dp_length(t->normal) / 2;
    for (int k = 0; k < 3; k++) {
        const dp_vec3 p = t->e[(k + 1) % 3],
                      q = t->e[(k + 2) % 3]; /* q: k to k + 1; p: k + 2 to k */
        if (dp_dot(p, q) < 0) continue;      /* the angle at k is acute */
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        out[l] = -0.25 * dp_dot(q, q) * area / dp_dot(t->e[k], q);
        out[m] = -0.25 * dp_dot(p, p) * area / dp_dot(t->e[k], p);
        out[k] = area - out[l] - out[m];
        return;
    }
    double sum = 0, weight[3];
    for (int k = 0; k < 3; k++) {
        const double a = dp_dot(t->e[k], t->e[k]), c = dp_dot(t->e[(k + 1) % 3], t->e[(k + 1) % 3]);
        const double d = dp_dot(t->e[(k + 2) % 3], t->e[(k + 2) % 3]);
        weight[k] = a * (c + d - a); /* barycentric, of the circumcentre */
        sum += weight[k];
    }
    for (int k = 0; k < 3; k++)
        out[k] = area * 0.5 * (weight[(k + 1) % 3] + weight[(k + 2) % 3]) / sum;
}

/* The second fundamental form a, b, c in the triangle's plane, by least squares over its edges. */
static bool triangle_form(const curvature_job *b, const triangle *t, dp_vec3 u, dp_vec3 v,
                          double out[3]) {
    double uu = 0, uv = 0, vv = 0, r[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const dp_vec3 dn = dp_sub(normal_at(b, t->v[(k + 2) % 3]), normal_at(b, t->v[(k + 1) % 3]));
        const double x = dp_dot(t->e[k], u), y = dp_dot(t->e[k], v), nx = dp_dot(dn, u),
                     ny = dp_dot(dn, v);
        uu += x * x, uv += x * y, vv += y * y;
        r[0] += nx * x, r[1] += nx * y + ny * x, r[2] += ny * y;
    }
    /* By Cramer's rule:
     *     | uu  uv     0  |   | a |   | r0 |
     *     | uv  uu+vv  uv | * | b | = | r1 |
     *     | 0   uv     vv |   | c |   | r2 | */
    const double mid = uu + vv, det = uu * (mid * vv - uv * uv) - uv * uv * vv;
    if (!(fabs(det) > 1e-300)) return false;
    out[0] = (r[0] * (mid * vv - uv * uv) - uv * (r[1] * vv - uv * r[2])) / det;
    out[1] = (uu * (r[1] * vv - uv * r[2]) - r[0] * uv * vv) / det;
    out[2] = (uu * (mid * r[2] - uv * r[1]) - uv * (uv * r[2]) + r[0] * uv * uv) / det;
    return true;
}

/* Turns a vector of the plane with normal `from` into that with normal `to`. */
static dp_vec3 turn(dp_vec3 x, dp_vec3 from, dp_vec3 to) {
    const double c = 1 + dp_dot(from, to);
    if (c < 1e-6) return x;
    return dp_sub(x, dp_scale(dp_add(from, to), dp_dot(to, x) / c));
}

static void add_forms(curvature_job *b, const triangle *t) {
    const dp_vec3 n = dp_unit(t->normal), u = dp_unit(t->e[0]), v = dp_cross(n, u);
    double form[3], areas[3];
    if (!triangle_form(b, t, u, v, form)) return;
    corner_areas(t, areas);
    for (int k = 0; k < 3; k++) {
        const uint32_t vertex = t->v[k];
        const dp_vec3 m = normal_at(b, vertex), tu = turn(u, n, m), tv = turn(v, n, m);
        dp_vec3 x, y;
        frame_of(m, &x, &y);
        const double ux = dp_dot(x, tu), uy = dp_dot(x, tv), vx = dp_dot(y, tu), vy = dp_dot(y, tv);
        const double w = areas[k];
        b->area[vertex] += (float)w;
        b->form[vertex][0] +=
            (float)(w * (form[0] * ux * ux + 2 * form[1] * ux * uy + form[2] * uy * uy));
        b->form[vertex][1] +=
            (float)(w * (form[0] * ux * vx + form[1] * (ux * vy + uy * vx) + form[2] * uy * vy));
        b->form[vertex][2] +=
            (float)(w * (form[0] * vx * vx + 2 * form[1] * vx * vy + form[2] * vy * vy));
    }
}

static bool begin(curvature_job *b, const dp_allocator *memory, uint32_t **first) {
    const size_t n = (size_t)b->polygons->vertex_count + 1;
    *first = dp_alloc_array(memory, n, sizeof **first);
    b->first = *first;
    b->normal = dp_alloc_zeroed(memory, dp_times(n, sizeof *b->normal));
    b->area = dp_alloc_zeroed(memory, dp_times(n, sizeof *b->area));
    b->form = dp_alloc_zeroed(memory, dp_times(n, sizeof *b->form));
    return *first && b->normal && b->area && b->form && dp_find_places(b->polygons, *first, memory);
}

static void end(curvature_job *b, const dp_allocator *memory, uint32_t *first) {
    dp_free(memory, first);
    dp_free(memory, b->normal);
    dp_free(memory, b->area);
    dp_free(memory, b->form);
}

static void find_forms(curvature_job *b) {
    for_triangles(b, add_normals);
    for (uint32_t v = 0; v < b->polygons->vertex_count; v++) {
        dp_vec3 n = dp_unit(normal_at(b, v));
        if (!isfinite(dp_length(n))) n = dp_v3(0, 0, 0); /* of triangles next to nothing */
        b->normal[v][0] = (float)n.x, b->normal[v][1] = (float)n.y, b->normal[v][2] = (float)n.z;
    }
    for_triangles(b, add_forms);
}

/* Principal curvatures, and the direction of the one least by absolute value. */
static dp_curvature curvature_at(const curvature_job *b, uint32_t vertex) {
    dp_curvature out = {0, 0, {0, 0, 0}};
    if (!(b->area[vertex] > 0)) return out;
    const double inverse = 1 / (double)b->area[vertex];
    const double a = (double)b->form[vertex][0] * inverse, m = (double)b->form[vertex][1] * inverse,
                 c = (double)b->form[vertex][2] * inverse;
    const double mean = (a + c) / 2, half = dp_hypot((a - c) / 2, m);
    const double angle = 0.5 * dp_atan2(2 * m, a - c); /* of the greater eigenvalue */
    const bool greatest = fabs(mean + half) <= fabs(mean - half);
    const double turned = greatest ? angle : angle + 1.5707963267948966;
    dp_vec3 u, v;
    frame_of(normal_at(b, vertex), &u, &v);
    const dp_vec3 d = dp_add(dp_scale(u, dp_cos(turned)), dp_scale(v, dp_sin(turned)));
    out.least = (float)(greatest ? mean + half : mean - half),
    out.most = (float)(greatest ? mean - half : mean + half);
    out.along[0] = (float)d.x, out.along[1] = (float)d.y, out.along[2] = (float)d.z;
    return out;
}

bool dp_curvatures(const dp_polygons *polygons, const dp_allocator *memory, dp_curvature *out) {
    curvature_job b = {.polygons = polygons};
    uint32_t *first;
    const bool enough = begin(&b, memory, &first);
    if (enough) {
        find_forms(&b);
        for (uint32_t v = 0; v < polygons->vertex_count; v++) out[v] = curvature_at(&b, first[v]);
    }
    end(&b, memory, first);
    return enough;
}

/* ------- directions that can be drawn along ------- */

/* Symmetric 3 x 3: xx, xy, xz, yy, yz, zz; two zeros make whole vectors of four. */
typedef float tensor[8];

static void add_tensor(tensor out, dp_vec3 d, double weight) {
    out[0] += (float)(weight * d.x * d.x), out[1] += (float)(weight * d.x * d.y),
        out[2] += (float)(weight * d.x * d.z);
    out[3] += (float)(weight * d.y * d.y), out[4] += (float)(weight * d.y * d.z),
        out[5] += (float)(weight * d.z * d.z);
}

static void add_cross(tensor out, dp_vec3 d, dp_vec3 e, double weight) {
    add_tensor(out, d, weight);
    add_tensor(out, e, -weight);
}

/* The tensor's part in a tangent plane: c = (uu - vv) / 2 and s = uv, which lie at twice the
 * direction's angle. */
static void in_plane(const tensor q, const float u[3], const float v[3], float *c, float *s) {
    const float ux = q[0] * u[0] + q[1] * u[1] + q[2] * u[2],
                uy = q[1] * u[0] + q[3] * u[1] + q[4] * u[2];
    const float uz = q[2] * u[0] + q[4] * u[1] + q[5] * u[2];
    const float vx = q[0] * v[0] + q[1] * v[1] + q[2] * v[2],
                vy = q[1] * v[0] + q[3] * v[1] + q[4] * v[2];
    const float vz = q[2] * v[0] + q[4] * v[1] + q[5] * v[2];
    *c = 0.5f * (u[0] * ux + u[1] * uy + u[2] * uz - (v[0] * vx + v[1] * vy + v[2] * vz));
    *s = v[0] * ux + v[1] * uy + v[2] * uz;
}

/* Along level lines (y is height); along x where the surface is level. */
static dp_vec3 steady_direction(dp_vec3 n) {
    const dp_vec3 level = dp_cross(dp_v3(0, 1, 0), n),
                  other = dp_sub(dp_v3(1, 0, 0), dp_scale(n, n.x));
    return dp_unit(dp_add(level, dp_scale(other, 0.05)));
}

static void make_tensor(const curvature_job *b, uint32_t v, double size, tensor q) {
    const dp_vec3 n = normal_at(b, v);
    const dp_curvature k = curvature_at(b, v);
    const dp_vec3 d = dp_v3f(k.along), e = dp_cross(n, d), f = steady_direction(n);
    const double least = fabs((double)k.least), most = fabs((double)k.most);
    memset(q, 0, sizeof(tensor));
    if (!(dp_length(n) > 0)) return;
    /* 0 where both curvatures are equal or opposite; 0 where there is hardly any */
    if (most > 0 && most < (double)INFINITY) { /* finite: not of triangles next to nothing */
        const double contrast = (most - least) / most, bent = most * size / (most * size + UNBENT);
        add_cross(q, d, e, contrast * bent);
    }
    add_cross(q, f, dp_cross(n, f), STEADY);
}

/* Spreading: neighbours as lists by vertex, and two sets of tensors that take turns. */
typedef struct spreading {
    curvature_job *b;
    /* Neighbours of v: beside[start[v], start[v + 1]), each as often as it shares a triangle. */
    uint32_t *start, *beside;
    tensor *from, *to;     /* [vertices] */
    float (*across)[3];    /* [vertices] first axis of the frame; the second: second_axis */
    const uint32_t *first; /* as in curvature_job */
    double size;
    float (*out)[3];
} spreading;

static uint64_t triangle_count(const dp_polygons *p) {
    const uint64_t corners =
        p->firsts ? p->firsts[p->count] - p->firsts[0] : 3 * (uint64_t)p->count;
    return corners > 2 * (uint64_t)p->count ? corners - 2 * (uint64_t)p->count : 0;
}

/* Fills the lists of neighbours: a counting sort by vertex. */
static void find_neighbours(const spreading *s) {
    const dp_polygons *const p = s->b->polygons;
    triangle t;
    memset(s->start, 0, ((size_t)p->vertex_count + 2) * sizeof *s->start);
    uint32_t *const at = s->start + 1; /* shifted by one: placing moves it to the starts */
    for (int placing = 0; placing < 2; placing++) {
        for (uint32_t i = 0; i < p->count; i++) {
            const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
            for (uint32_t k = 2; k < n; k++) {
                if (!fetch(s->b, first, k, &t)) continue;
                for (int c = 0; c < 3; c++) {
                    if (placing)
                        s->beside[at[t.v[c]]++] = t.v[(c + 1) % 3],
                        s->beside[at[t.v[c]]++] = t.v[(c + 2) % 3];
                    else
                        at[t.v[c]] += 2;
                }
            }
        }
        uint32_t sum = 0;
        for (uint32_t v = 0; !placing && v < p->vertex_count; v++) {
            const uint32_t count = at[v];
            at[v] = sum, sum += count;
        }
    }
}

/* The tensor c (u u' - v v') + s (u v' + v u'). */
static void put_in_plane(tensor q, const float u[3], const float v[3], float c, float s) {
    q[0] = c * (u[0] * u[0] - v[0] * v[0]) + 2 * s * u[0] * v[0];
    q[1] = c * (u[0] * u[1] - v[0] * v[1]) + s * (u[0] * v[1] + v[0] * u[1]);
    q[2] = c * (u[0] * u[2] - v[0] * v[2]) + s * (u[0] * v[2] + v[0] * u[2]);
    q[3] = c * (u[1] * u[1] - v[1] * v[1]) + 2 * s * u[1] * v[1];
    q[4] = c * (u[1] * u[2] - v[1] * v[2]) + s * (u[1] * v[2] + v[1] * u[2]);
    q[5] = c * (u[2] * u[2] - v[2] * v[2]) + 2 * s * u[2] * v[2];
    q[6] = q[7] = 0;
}

static void second_axis(const spreading *s, uint32_t v, float out[3]) {
    const float *const n = s->b->normal[v], *const u = s->across[v];
    out[0] = n[1] * u[2] - n[2] * u[1], out[1] = n[2] * u[0] - n[0] * u[2],
    out[2] = n[0] * u[1] - n[1] * u[0];
}

/* The mean of a vertex's tensor and that of its neighbours, in its tangent plane. */
static void spread_vertex(const spreading *s, uint32_t v) {
    const uint32_t first = s->start[v], last = s->start[v + 1];
    if (first == last) {
        memcpy(s->to[v], s->from[v], sizeof(tensor));
        return;
    }
    tensor mean = {0};
    for (uint32_t n = first; n < last; n++)
        for (int i = 0; i < 8; i++) mean[i] += s->from[s->beside[n]][i];
    const float share = 0.5f / (float)(last - first);
    for (int i = 0; i < 8; i++) mean[i] = 0.5f * s->from[v][i] + share * mean[i];
    float second[3], c, d;
    second_axis(s, v, second);
    in_plane(mean, s->across[v], second, &c, &d);
    put_in_plane(s->to[v], s->across[v], second, c, d);
}

static void begin_vertex(const spreading *s, uint32_t v) {
    dp_vec3 x, y;
    frame_of(normal_at(s->b, v), &x, &y);
    s->across[v][0] = (float)x.x, s->across[v][1] = (float)x.y, s->across[v][2] = (float)x.z;
    make_tensor(s->b, v, s->size, s->from[v]);
}

static void end_vertex(const spreading *s, uint32_t v) {
    const uint32_t w = s->first[v];
    float second[3], c, d;
    second_axis(s, w, second);
    in_plane(s->from[w], s->across[w], second, &c, &d);
    const float angle = 0.5f * (float)dp_atan2((double)d, (double)c),
                cosine = (float)dp_cos((double)angle), sine = (float)dp_sin((double)angle);
    for (int k = 0; k < 3; k++) s->out[v][k] = cosine * s->across[w][k] + sine * second[k];
}

enum { BLOCK = DP_TUNED(16384, 7) };

typedef void visit_vertex(const spreading *s, uint32_t vertex);

typedef struct walk {
    const spreading *s;
    visit_vertex *with;
} walk;

static void walk_block(void *arg, uint32_t index, uint32_t worker) {
    const walk *const w = arg;
    const uint32_t count = w->s->b->polygons->vertex_count, first = index * BLOCK;
    (void)worker;
    for (uint32_t v = first; v < count && v < first + BLOCK; v++) w->with(w->s, v);
}

static void for_vertices(const spreading *s, dp_threads *threads, visit_vertex *with) {
    walk w = {s, with};
    dp_parallel(threads, s->b->polygons->vertex_count / BLOCK + 1, walk_block, &w);
}

static void spread_once(spreading *s, dp_threads *threads) {
    for_vertices(s, threads, spread_vertex);
    tensor *const swap = s->from;
    s->from = s->to, s->to = swap;
}

/* The same distance takes more steps on a finer mesh. */
static int spreads_for(uint32_t vertices) {
    const int n = LEAST_SPREADS + (int)(sqrt((double)vertices) / 12);
    return n < MOST_SPREADS ? n : MOST_SPREADS;
}

static double size_of(const dp_polygons *p) {
    dp_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const dp_vec3 q = dp_v3f(dp_vertex_position(p, v));
        if (!isfinite(q.x + q.y + q.z)) continue;
        low = dp_v3(dp_min(low.x, q.x), dp_min(low.y, q.y), dp_min(low.z, q.z));
        high = dp_v3(dp_max(high.x, q.x), dp_max(high.y, q.y), dp_max(high.z, q.z));
    }
    const double size = dp_length(dp_sub(high, low));
    return isfinite(size) ? size : 1;
}

static bool make(const dp_polygons *p, dp_threads *threads, const dp_allocator *memory,
                 float (*out)[3]) {
    curvature_job b = {.polygons = p};
    uint32_t *first;
    const size_t n = (size_t)p->vertex_count + 2;
    if (6 * triangle_count(p) >= UINT32_MAX)
        return false; /* 700 million triangles: as good as no memory */
    spreading s = {.b = &b,
                   .start = dp_alloc_array(memory, n, sizeof *s.start),
                   .beside = dp_alloc_array(memory, 6 * triangle_count(p) + 1, sizeof *s.beside),
                   .from = dp_alloc_array(memory, n, sizeof *s.from),
                   .to = dp_alloc_array(memory, n, sizeof *s.to),
                   .across = dp_alloc_array(memory, n, sizeof *s.across),
                   .size = size_of(p),
                   .out = out};
    const bool enough =
        begin(&b, memory, &first) && s.start && s.beside && s.from && s.to && s.across;
    if (enough) {
        s.first = first;
        const int spreads = spreads_for(p->vertex_count);
        find_forms(&b);
        find_neighbours(&s);
        for_vertices(&s, threads, begin_vertex);
        for (int i = 0; i < spreads; i++) spread_once(&s, threads);
        for_vertices(&s, threads, end_vertex);
    }
    end(&b, memory, first);
    dp_free(memory, s.start);
    dp_free(memory, s.beside);
    dp_free(memory, s.from);
    dp_free(memory, s.to);
    dp_free(memory, s.across);
    return enough;
}

static const dp_array arrays[] = {DP_ARRAY(dp_curvature_store, along, along_cap)};

void dp_curvature_store_free(dp_curvature_store *store, const dp_allocator *memory) {
    dp_pool_free(&store->scratch, memory);
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    *store = (dp_curvature_store){0};
}

uint64_t dp_curvature_store_bytes(const dp_curvature_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays)) + store->scratch.bytes;
}

/* ------- computed once ------- */

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

bool dp_curvature_directions(dp_curvature_store *store, const dp_polygons *polygons,
                             dp_threads *threads, const dp_allocator *memory) {
    const double start = now_ms();
    const uint64_t key = dp_shape_fingerprint(polygons, threads);
    store->ms = 0;
    if (store->key == key) return true;
    const bool keeps = store->key || store->moves;
    const dp_allocator scratch = dp_pool_allocator(&store->scratch, memory);
    store->key = 0;
    const bool made = dp_reserve(memory, &store->along, &store->along_cap,
                                 (size_t)polygons->vertex_count + 1, sizeof *store->along) &&
                      make(polygons, threads, &scratch, store->along);
    if (!made || !keeps) dp_pool_free(&store->scratch, memory);
    if (!made) return false;
    store->key = key;
    store->ms = now_ms() - start;
    return true;
}
