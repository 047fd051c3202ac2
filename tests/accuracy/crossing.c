/* Where the interiors of two polygons cross.
 *
 * Every pair of triangles whose boxes meet (found in the hierarchy of rays.c) is cut: the first by
 * the plane of the second, and what results by the second's three edges. Pairs with a vertex in
 * common are neighbours and do not count. Where one only touches the other's plane (an edge that
 * rests on a face), the segment is a contact. Coplanar pairs are ignored. */
#include "mesh.h"

typedef struct search {
    ref_model *model;
    const rays_triangle *first; /* the triangle whose partners are sought */
} search;

/* Corners on either side of a plane, and on it. */
typedef struct sides {
    double distance[3];
    int above, below, on;
} sides;

static v3 normal_of(const rays_triangle *t) {
    return v3_unit(
        v3_cross(v3_sub(t->corner[1], t->corner[0]), v3_sub(t->corner[2], t->corner[0])));
}

static sides sides_of(const rays_triangle *t, const rays_triangle *plane, double slack) {
    const v3 normal = normal_of(plane);
    sides s = {{0}, 0, 0, 0};
    for (int k = 0; k < 3; k++) {
        s.distance[k] = v3_dot(normal, v3_sub(t->corner[k], plane->corner[0]));
        if (s.distance[k] > slack)
            s.above++;
        else if (s.distance[k] < -slack)
            s.below++;
        else
            s.on++, s.distance[k] = 0;
    }
    return s;
}

/* The triangle's cut with the plane its sides were taken of: up to two points. */
static int cut(const rays_triangle *t, const sides *s, v3 ends[2]) {
    int count = 0;
    for (int k = 0; k < 3 && count < 2; k++) {
        const int next = (k + 1) % 3;
        const double d0 = s->distance[k], d1 = s->distance[next];
        if (d0 == 0)
            ends[count++] = t->corner[k];
        else if (d0 * d1 < 0)
            ends[count++] = v3_mix(t->corner[k], t->corner[next], d0 / (d0 - d1));
    }
    return count;
}

/* Clips a segment in the triangle's plane to the triangle. False: nothing is left. */
static bool clip(const rays_triangle *t, v3 ends[2], double slack) {
    const v3 normal = normal_of(t), a = ends[0], b = ends[1];
    double from = 0, to = 1;
    for (int k = 0; k < 3; k++) {
        const v3 edge = v3_unit(v3_sub(t->corner[(k + 1) % 3], t->corner[k]));
        const v3 inward = v3_cross(normal, edge);
        const double fa = v3_dot(inward, v3_sub(a, t->corner[k])) + slack;
        const double fb = v3_dot(inward, v3_sub(b, t->corner[k])) + slack;
        if (fa < 0 && fb < 0) return false;
        if (fa < 0) from = fmax(from, fa / (fa - fb));
        if (fb < 0) to = fmin(to, fa / (fa - fb));
    }
    ends[0] = v3_mix(a, b, from);
    ends[1] = v3_mix(a, b, to);
    return (to - from) * v3_len(v3_sub(b, a)) > 4 * slack;
}

static bool neighbours(const rays_triangle *s, const rays_triangle *t) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const v3 a = s->corner[i], b = t->corner[j];
            if (a.x == b.x && a.y == b.y && a.z == b.z) return true;
        }
    }
    return false;
}

static bool meet(void *user, const rays_triangle *t) {
    const search *job = user;
    const rays_triangle *s = job->first;
    ref_model *model = job->model;
    const double slack = 1e-9 * model->size;
    v3 ends[2];
    if (t->owner <= s->owner || neighbours(s, t)) return true;
    const sides in_t = sides_of(s, t, slack), in_s = sides_of(t, s, slack);
    const bool crosses_t = in_t.above && in_t.below, crosses_s = in_s.above && in_s.below;
    if (in_t.on == 3 || in_s.on == 3) return true;
    if (!crosses_t && in_t.on < 2) return true;
    if (!crosses_s && in_s.on < 2) return true;
    if (cut(s, &in_t, ends) < 2 || !clip(t, ends, slack)) return true;
    mesh_reserve(&model->crossings, &model->crossing_room, model->crossing_count + 1,
                 sizeof *model->crossings);
    model->crossings[model->crossing_count++] =
        (mesh_crossing){ends[0], ends[1], {s->owner, t->owner}, !(crosses_t && crosses_s)};
    return true;
}

void mesh_find_crossings(ref_model *model, const rays_triangle *triangles, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const v3 *c = triangles[i].corner;
        search job = {model, &triangles[i]};
        rays_overlaps(model->rays, v3_min(c[0], v3_min(c[1], c[2])),
                      v3_max(c[0], v3_max(c[1], c[2])), meet, &job);
    }
}
