/* Splits polygons that are not convex or not planar into triangles, by clipping ears.
 *
 * Works on the projection along the polygon's mean normal (Newell). Data structure: `links`, a list
 * of the corners that are left, in order. Invariant: each cut removes one corner. If there is no
 * ear, as in a polygon that crosses itself, the next corner is cut, so that n - 2 cuts always end
 * it. Quadratic in the corners; beyond MANY_CORNERS no ear is sought. */
#include "base/elementary.h"
#include "base/vec.h"
#include "mesh/polygons.h"

enum { MANY_CORNERS = 4096 };

/* A polygon is not planar if a corner lies more than this share of its size out of the mean plane:
 * far less than depth shows, far more than float32 rounding. */
static const double PLANAR = 1e-4;

static const dp_array arrays[] = {DP_ARRAY(dp_split_scratch, at, at_cap),
                                  DP_ARRAY(dp_split_scratch, links, links_cap),
                                  DP_ARRAY(dp_split_scratch, triangles, triangles_cap)};

bool dp_split_scratch_reserve(dp_split_scratch *s, size_t n, const dp_allocator *memory) {
    return dp_reserve(memory, &s->at, &s->at_cap, n, sizeof *s->at) &&
           dp_reserve(memory, &s->links, &s->links_cap, n, sizeof *s->links) &&
           dp_reserve(memory, &s->triangles, &s->triangles_cap, n, sizeof *s->triangles);
}

void dp_split_scratch_free(dp_split_scratch *scratch, const dp_allocator *memory) {
    dp_arrays_free(memory, scratch, DP_ARRAYS(arrays));
}

uint64_t dp_split_scratch_bytes(const dp_split_scratch *scratch) {
    return dp_arrays_bytes(scratch, DP_ARRAYS(arrays));
}

static dp_vec3 newell(const float *const *at, uint32_t n, double *size) {
    dp_vec3 sum = {0, 0, 0};
    const dp_vec3 origin = dp_v3f(at[0]);
    *size = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 a = dp_sub(dp_v3f(at[i]), origin);
        const dp_vec3 b = dp_sub(dp_v3f(at[(i + 1) % n]), origin);
        sum = dp_add(sum, dp_cross(a, b));
        *size = fmax(*size, dp_length(a));
    }
    return dp_unit(sum);
}

bool dp_is_convex_planar(const float *const *at, uint32_t n) {
    double size, turned = 0;
    const dp_vec3 normal = newell(at, n, &size);
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 b = dp_v3f(at[(i + 1) % n]);
        const dp_vec3 in = dp_sub(b, dp_v3f(at[i])), out = dp_sub(dp_v3f(at[(i + 2) % n]), b);
        const double turn = dp_dot(dp_cross(in, out), normal);
        if (turn < -PLANAR * dp_length(in) * dp_length(out)) return false;
        if (fabs(dp_dot(dp_sub(b, dp_v3f(at[0])), normal)) > PLANAR * size) return false;
        turned += dp_atan2(turn, dp_dot(in, out));
    }
    return turned <
           7; /* once around is 2 pi; a pentagram also turns left everywhere, but twice around */
}

typedef struct flat {
    const float *const *at;
    dp_vec3 u, v;
} flat;

static double side(const flat *f, uint32_t a, uint32_t b, uint32_t c) {
    const dp_vec3 ab = dp_sub(dp_v3f(f->at[b]), dp_v3f(f->at[a]));
    const dp_vec3 ac = dp_sub(dp_v3f(f->at[c]), dp_v3f(f->at[a]));
    return dp_dot(ab, f->u) * dp_dot(ac, f->v) - dp_dot(ab, f->v) * dp_dot(ac, f->u);
}

/* Corners of a bridge from a hole to the outline come twice. */
static bool coincide(const flat *f, uint32_t a, uint32_t b) {
    return f->at[a][0] == f->at[b][0] && f->at[a][1] == f->at[b][1] && f->at[a][2] == f->at[b][2];
}

/* Does the triangle (a, b, c) turn left, with no other remaining corner in it? */
static bool is_ear(const flat *f, const uint32_t *next, uint32_t a, uint32_t b, uint32_t c) {
    if (!(side(f, a, b, c) > 0)) return false;
    for (uint32_t p = next[c]; p != a; p = next[p])
        if (!coincide(f, p, a) && !coincide(f, p, b) && !coincide(f, p, c) &&
            side(f, a, b, p) >= 0 && side(f, b, c, p) >= 0 && side(f, c, a, p) >= 0)
            return false;
    return true;
}

uint32_t dp_split_polygon(const float *const *at, uint32_t n, uint32_t *links,
                          uint32_t (*triangles)[3]) {
    double size;
    const dp_vec3 normal = newell(at, n, &size);
    const dp_vec3 axis = fabs(normal.x) < 0.6 ? dp_v3(1, 0, 0) : dp_v3(0, 1, 0);
    flat f = {.at = at, .u = dp_unit(dp_cross(axis, normal))};
    f.v = dp_cross(normal, f.u);
    for (uint32_t i = 0; i < n; i++) links[i] = (i + 1) % n;

    uint32_t count = 0, left = n, a = 0, tries = 0;
    while (left > 3) {
        const uint32_t b = links[a], c = links[b];
        const bool give_up = n > MANY_CORNERS || tries > left;
        if (!give_up && !is_ear(&f, links, a, b, c)) {
            a = b;
            tries++;
            continue;
        }
        triangles[count][0] = a, triangles[count][1] = b, triangles[count][2] = c;
        count++;
        links[a] = c;
        left--;
        tries = 0;
    }
    triangles[count][0] = a, triangles[count][1] = links[a], triangles[count][2] = links[links[a]];
    return count + 1;
}
