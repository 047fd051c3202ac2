/* Triangles on the picture: polygons are cut by clipping ears, moved into camera space, and listed by
 * the tiles that they touch. */
#include "faces.h"

#include <stdlib.h>
#include <string.h>

enum { CORNERS = 64 /* of a polygon, at most */ };

static const double no_area = 1e-7; /* height over longest side, in diagonals: never seen */

static void add_triangle(faces *f, v3 a, v3 b, v3 c, uint32_t polygon) {
    if (f->count == f->room) {
        f->room = 2 * f->room + 64;
        f->all = realloc(f->all, f->room * sizeof *f->all);
        if (f->all == NULL) abort();
    }
    f->all[f->count++] = (face){.corner = {a, b, c}, .polygon = polygon};
}

static double turns(const v3 *p, uint32_t i, uint32_t j, uint32_t k, v3 normal) {
    return v3_dot(v3_cross(v3_sub(p[j], p[i]), v3_sub(p[k], p[i])), normal);
}

/* Is corner `left[at + 1]` an ear: convex, with no other corner in its triangle? */
static bool is_ear(const v3 *p, const uint32_t *left, uint32_t n, uint32_t at, v3 normal) {
    const uint32_t i = left[at % n], j = left[(at + 1) % n], k = left[(at + 2) % n];
    if (turns(p, i, j, k, normal) <= 0) return false;
    for (uint32_t m = 3; m < n; m++) {
        const uint32_t q = left[(at + m) % n];
        if (turns(p, i, j, q, normal) >= 0 && turns(p, j, k, q, normal) >= 0 &&
            turns(p, k, i, q, normal) >= 0)
            return false;
    }
    return true;
}

/* Cuts a polygon from its first corner on. */
static void add_polygon(faces *f, const v3 *p, uint32_t n, uint32_t polygon) {
    uint32_t left[CORNERS], at = 0, tries = 0;
    v3 normal = {0, 0, 0};
    for (uint32_t i = 0; i < n; i++) {
        left[i] = i;
        if (i > 1) normal = v3_add(normal, v3_cross(v3_sub(p[i - 1], p[0]), v3_sub(p[i], p[0])));
    }
    while (n >= 3) {
        if (n > 3 && tries <= n && !is_ear(p, left, n, at, normal)) {
            at = (at + 1) % n;
            tries++;
            continue;
        }
        const uint32_t tip = (at + 1) % n;
        add_triangle(f, p[left[at % n]], p[left[tip]], p[left[(at + 2) % n]], polygon);
        memmove(left + tip, left + tip + 1, (n - 1 - tip) * sizeof *left);
        n--, tries = 0;
        if (tip < at) at--;
        at %= n;
    }
}

static v3 to_camera(const dp_batch *b, const double *view, size_t corner) {
    const size_t stride = b->position_stride ? b->position_stride : 3 * sizeof(float);
    const size_t vertex = b->indices ? b->indices[corner] : corner;
    float q[3];
    memcpy(q, (const char *)b->positions + vertex * stride, sizeof q);
    const v3 p = {(double)q[0], (double)q[1], (double)q[2]};
    return (v3){view[0] * p.x + view[4] * p.y + view[8] * p.z + view[12],
                view[1] * p.x + view[5] * p.y + view[9] * p.z + view[13],
                view[2] * p.x + view[6] * p.y + view[10] * p.z + view[14]};
}

static void read_polygons(faces *f, const dp_batch *b, const double *view) {
    for (size_t i = 0; i < b->polygon_count; i++) {
        const size_t from = b->firsts ? b->firsts[i] : 3 * i;
        const size_t to = b->firsts ? b->firsts[i + 1] : 3 * i + 3;
        v3 p[CORNERS];
        if (to - from > CORNERS) abort();
        for (size_t c = from; c < to; c++) p[c - from] = to_camera(b, view, c);
        add_polygon(f, p, (uint32_t)(to - from), (uint32_t)i);
    }
}

/* Lengths in diagonals from here on. */
static double normalize(faces *f) {
    v3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * f->count; i++) {
        low = v3_min(low, f->all[i / 3].corner[i % 3]);
        high = v3_max(high, f->all[i / 3].corner[i % 3]);
    }
    const double diagonal = v3_len(v3_sub(high, low));
    for (size_t i = 0; i < 3 * f->count; i++) {
        v3 *const p = &f->all[i / 3].corner[i % 3];
        *p = v3_mul(*p, 1 / diagonal);
    }
    return diagonal;
}

/* A point of the ray through (x, y), and its direction, whose depth is 1. */
static void ray_of(const faces *f, double x, double y, v3 *from, v3 *along) {
    const v3 side = {(x - f->width / 2.0) / f->scale[0], -(y - f->height / 2.0) / f->scale[1], 0};
    const v3 ahead = {0, 0, -1}, eye = {0, 0, 0};
    *from = f->orthographic ? side : eye;
    *along = f->orthographic ? ahead : v3_add(side, ahead);
}

/* The triple product of the ray and a side; and the ray's nearness where it meets the plane. */
static double side_at(const faces *f, const face *t, int k, double x, double y) {
    v3 from, along;
    ray_of(f, x, y, &from, &along);
    return v3_dot(along,
                  v3_cross(v3_sub(t->corner[k], from), v3_sub(t->corner[(k + 1) % 3], from)));
}

static double nearness_at(const faces *f, const face *t, double x, double y) {
    v3 from, along;
    ray_of(f, x, y, &from, &along);
    const double d = v3_dot(t->normal, t->corner[0]);
    if (f->orthographic) return (v3_dot(t->normal, from) - d) / v3_dot(t->normal, along);
    return v3_dot(t->normal, along) / d;
}

/* What is affine follows from three places. */
static void fit_affine(const faces *f, face *t) {
    const double w = f->width, h = f->height;
    for (int k = 0; k < 4; k++) {
        double v[3];
        for (int i = 0; i < 3; i++) {
            const double x = i == 1 ? w : 0, y = i == 2 ? h : 0;
            v[i] = k < 3 ? side_at(f, t, k, x, y) : nearness_at(f, t, x, y);
        }
        *(k < 3 ? &t->side[k] : &t->nearness) =
            (affine){v[0], (v[1] - v[0]) / w, (v[2] - v[0]) / h};
    }
}

static void project(const faces *f, v3 p, double *out) {
    const double depth = f->orthographic ? 1 : -p.z;
    if (!(depth > 0)) abort(); /* behind the eye */
    out[0] = f->width / 2.0 + f->scale[0] * p.x / depth;
    out[1] = f->height / 2.0 - f->scale[1] * p.y / depth;
}

/* False: it has no area, or is seen from its edge. */
static bool prepare(const faces *f, face *t) {
    const v3 a = t->corner[0], u = v3_sub(t->corner[1], a), v = v3_sub(t->corner[2], a);
    const double longest = fmax(fmax(v3_len(u), v3_len(v)), v3_len(v3_sub(u, v)));
    const v3 normal = v3_cross(u, v), along = {0, 0, -1};
    double turned = 0;
    if (v3_len(normal) <= no_area * longest) return false;
    t->normal = v3_unit(normal);
    turned = v3_dot(t->normal, f->orthographic ? along : a);
    if (fabs(turned) < 1e-12) return false;
    if (turned > 0) t->normal = v3_mul(t->normal, -1);
    fit_affine(f, t);
    for (int k = 0; k < 3; k++) {
        double p[2];
        project(f, t->corner[k], p);
        for (int i = 0; i < 2; i++) {
            t->low[i] = k == 0 ? p[i] : fmin(t->low[i], p[i]);
            t->high[i] = k == 0 ? p[i] : fmax(t->high[i], p[i]);
        }
    }
    return true;
}

static uint32_t tile_of(double px, uint32_t count) {
    const double tile = (px + FACES_MARGIN) / FACES_TILE;
    return tile <= 0 ? 0 : tile >= count ? count - 1 : (uint32_t)tile;
}

/* Counts, or with `members` lists, the faces of each tile. */
static void fill_tiles(faces *f, bool members) {
    for (size_t i = 0; i < f->count; i++) {
        const face *const t = &f->all[i];
        const uint32_t x1 = tile_of(t->high[0] + 0.01, f->columns);
        const uint32_t y1 = tile_of(t->high[1] + 0.01, f->rows);
        for (uint32_t y = tile_of(t->low[1] - 0.01, f->rows); y <= y1; y++)
            for (uint32_t x = tile_of(t->low[0] - 0.01, f->columns); x <= x1; x++) {
                uint32_t *const first = &f->firsts[y * f->columns + x];
                if (members)
                    f->members[--*first] = (uint32_t)i;
                else
                    ++*first;
            }
    }
}

static void make_tiles(faces *f) {
    f->columns = (f->width + 2 * FACES_MARGIN) / FACES_TILE + 1;
    f->rows = (f->height + 2 * FACES_MARGIN) / FACES_TILE + 1;
    const size_t tiles = (size_t)f->columns * f->rows;
    f->firsts = calloc(tiles + 1, sizeof *f->firsts);
    if (f->firsts == NULL) abort();
    fill_tiles(f, false);
    for (size_t i = 1; i <= tiles; i++) f->firsts[i] += f->firsts[i - 1];
    f->members = calloc(f->firsts[tiles] + (size_t)1, sizeof *f->members);
    if (f->members == NULL) abort();
    fill_tiles(f, true);
}

void faces_make(faces *f, const dp_batch *arrays, const dp_camera *camera, uint32_t width,
                uint32_t height) {
    const double *const p = camera->projection;
    size_t kept = 0;
    *f = (faces){.width = width, .height = height, .orthographic = p[11] == 0};
    read_polygons(f, arrays, camera->view);
    const double unit = normalize(f);
    f->scale[0] = p[0] * width / 2 * (f->orthographic ? unit : 1);
    f->scale[1] = p[5] * height / 2 * (f->orthographic ? unit : 1);
    for (size_t i = 0; i < f->count; i++)
        if (prepare(f, &f->all[i])) f->all[kept++] = f->all[i];
    f->count = kept;
    make_tiles(f);
}

void faces_free(faces *f) {
    free(f->all);
    free(f->firsts);
    free(f->members);
    *f = (faces){0};
}

bool face_pierced(const face *t, double x, double y) {
    const double u = affine_at(&t->side[0], x, y), v = affine_at(&t->side[1], x, y),
                 w = affine_at(&t->side[2], x, y);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

int faces_first(const faces *f, double x, double y) {
    const uint32_t tile = tile_of(y, f->rows) * f->columns + tile_of(x, f->columns);
    double nearest = -INFINITY;
    int found = -1;
    for (uint32_t i = f->firsts[tile]; i < f->firsts[tile + 1]; i++) {
        const face *const t = &f->all[f->members[i]];
        if (!face_pierced(t, x, y)) continue;
        const double nearness = affine_at(&t->nearness, x, y);
        if (nearness <= nearest) continue;
        nearest = nearness;
        found = (int)f->members[i];
    }
    return found;
}

hit faces_hit(const faces *f, double x, double y, int which) {
    hit h = {.x = x, .y = y, .face = which};
    if (which < 0) return h;
    const face *const t = &f->all[which];
    const double nearness = affine_at(&t->nearness, x, y);
    v3 from, along;
    ray_of(f, x, y, &from, &along);
    h.at = v3_add(from, v3_mul(along, f->orthographic ? -nearness : 1 / nearness));
    h.normal = t->normal;
    return h;
}
