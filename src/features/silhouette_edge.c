/* Silhouette edges on the screen, normals of their vertices, and polar texture coordinates
 * (Hermosilla and Vázquez 2010, 2.3.2 and 2.3.3).
 *
 * Normals are made only for vertices of silhouette edges, a few thousand of a million, when they
 * are needed. So they are right for meshes that deform, and nothing is kept per vertex. */
#include "features/silhouette_edge.h"

#include "mesh/adjacency.h"
#include "core/facing.h"
#include "core/outline.h"
#include "texture/texture.h"

enum { MOST_AROUND = 256 };

static uint32_t turned(const dp_polygons *polygons, uint32_t polygon, uint32_t corner,
                       uint32_t by) {
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    return first + (corner - first + by) % n;
}

static dp_vec3 corner_position(const dp_polygons *polygons, uint32_t corner) {
    return dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, corner)));
}

/* The corner's share of the vertex normal: its cross product over the squares of its edges' lengths
 * (Max 1999), which is exact on a sphere. */
static dp_vec3 share_of(const dp_frame *frame, uint32_t polygon, uint32_t corner) {
    const dp_polygons *const p = &frame->polygons;
    const uint32_t n = dp_corner_count(p, polygon);
    const dp_vec3 at = corner_position(p, corner);
    const dp_vec3 u = dp_sub(corner_position(p, turned(p, polygon, corner, 1)), at);
    const dp_vec3 v = dp_sub(corner_position(p, turned(p, polygon, corner, n - 1)), at);
    const double weight = dp_dot(u, u) * dp_dot(v, v);
    return weight > 0 ? dp_scale(dp_cross(u, v), 1 / weight) : dp_v3(0, 0, 0);
}

/* Steps around the vertex, across the edge that starts at the corner, to the next polygon's corner;
 * UINT32_MAX: there is none. */
static uint32_t over_next(const dp_frame *frame, uint32_t corner) {
    const uint32_t across = frame->adjacency->across[corner];
    if (!dp_is_across(across) || across & DP_ACROSS_FLIPPED) return UINT32_MAX;
    return turned(&frame->polygons, dp_polygon_of_corner(frame->adjacency, across), across, 1);
}

/* The same the other way round, across the edge that ends at the corner. */
static uint32_t over_last(const dp_frame *frame, uint32_t corner) {
    const uint32_t polygon = dp_polygon_of_corner(frame->adjacency, corner);
    const uint32_t last =
        turned(&frame->polygons, polygon, corner, dp_corner_count(&frame->polygons, polygon) - 1);
    const uint32_t across = frame->adjacency->across[last];
    return dp_is_across(across) && !(across & DP_ACROSS_FLIPPED) ? across : UINT32_MAX;
}

dp_vec3 dp_vertex_normal(const dp_frame *frame, uint32_t corner) {
    dp_vec3 sum = dp_v3(0, 0, 0);
    uint32_t c = corner;
    int steps = 0;
    do {
        sum = dp_add(sum, share_of(frame, dp_polygon_of_corner(frame->adjacency, c), c));
        c = over_next(frame, c);
    } while (c != UINT32_MAX && c != corner && ++steps < MOST_AROUND);
    if (c == UINT32_MAX)
        for (c = over_last(frame, corner); c != UINT32_MAX && c != corner && ++steps < MOST_AROUND;
             c = over_last(frame, c))
            sum = dp_add(sum, share_of(frame, dp_polygon_of_corner(frame->adjacency, c), c));
    return dp_unit(sum);
}

/* A front-facing polygon runs counter-clockwise, so it lies to the left of its edges; y points
 * down. */
void dp_find_outside(const dp_frame *frame, uint32_t polygon, dp_pointd a, dp_pointd b,
                     double out[2]) {
    const double x = b.x - a.x, y = b.y - a.y, length = dp_hypot(x, y);
    const bool front =
        frame->adjacency ? dp_faces_front(frame, polygon) : dp_polygon_faces_eye(frame, polygon);
    const double sign = length > 0 ? (front ? 1 : -1) / length : 0;
    out[0] = -y * sign, out[1] = x * sign;
}

bool dp_find_silhouette_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner,
                             dp_silhouette_edge *out) {
    const dp_polygons *const p = &frame->polygons;
    const dp_view *const view = &frame->view;
    const uint32_t next = turned(p, polygon, corner, 1);
    const dp_vec3 a = corner_position(p, corner), b = corner_position(p, next);
    const dp_clip_point ca = dp_to_clip(view, a), cb = dp_to_clip(view, b);
    double t0 = 0, t1 = 1;
    if ((dp_outcode(view, ca) | dp_outcode(view, cb)) && !dp_clip_segment(view, ca, cb, &t0, &t1))
        return false;
    *out = (dp_silhouette_edge){.a = dp_to_screen(view, dp_clip_mix(ca, cb, t0)),
                                .b = dp_to_screen(view, dp_clip_mix(ca, cb, t1))};
    dp_find_outside(frame, polygon, out->a, out->b, out->outward);
    if (t0 == 0) dp_project_direction(view, a, dp_vertex_normal(frame, corner), out->normal_a);
    if (t1 == 1) dp_project_direction(view, b, dp_vertex_normal(frame, next), out->normal_b);
    return true;
}

/* ------- polar coordinates ------- */

enum { BOX_BLOCKS = 16 };

typedef struct box {
    const dp_polygons *polygons;
    float min[BOX_BLOCKS][4], max[BOX_BLOCKS][4];
} box;

static void find_box_block(void *arg, uint32_t index, uint32_t worker) {
    box *const b = arg;
    const dp_polygons *const p = b->polygons;
    (void)worker;
    float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    const uint32_t first = (uint32_t)((uint64_t)p->vertex_count * index / BOX_BLOCKS);
    const uint32_t last = (uint32_t)((uint64_t)p->vertex_count * (index + 1) / BOX_BLOCKS);
    for (uint32_t v = first; v < last; v++) {
        const float *const at = dp_vertex_position(p, v);
        if (!isfinite(at[0] + at[1] + at[2])) continue;
        for (int k = 0; k < 3; k++)
            min[k] = dp_minf(at[k], min[k]), max[k] = dp_maxf(at[k], max[k]);
    }
    for (int k = 0; k < 3; k++) b->min[index][k] = min[k], b->max[index][k] = max[k];
}

static void find_box(const dp_frame *frame, float min[3], float max[3]) {
    box b = {.polygons = &frame->polygons};
    dp_parallel(frame->threads, BOX_BLOCKS, find_box_block, &b);
    for (int k = 0; k < 3; k++) {
        min[k] = INFINITY, max[k] = -INFINITY;
        for (int i = 0; i < BOX_BLOCKS; i++)
            min[k] = dp_minf(b.min[i][k], min[k]), max[k] = dp_maxf(b.max[i][k], max[k]);
    }
}

/* Points behind the eye are left out. */
void dp_find_centre(dp_frame *frame) {
    float min[3], max[3];
    find_box(frame, min, max);
    frame->centre[0] = frame->view.width / 2, frame->centre[1] = frame->view.height / 2;
    frame->radius = frame->view.height / 2;
    frame->middle_pixel = 1 / frame->view.focal;
    if (!(min[0] <= max[0])) return;
    const dp_vec3 middle = dp_mix(dp_v3f(min), dp_v3f(max), 0.5);
    const dp_clip_point c = dp_to_clip(&frame->view, middle);
    if (!(c.w > 0)) return;
    const dp_pointd centre = dp_to_screen(&frame->view, c);
    frame->centre[0] = centre.x, frame->centre[1] = centre.y;
    frame->middle_pixel = dp_pixel_size(&frame->view, centre.d);
    double reach = 0;
    for (int i = 0; i < 8; i++) {
        const dp_vec3 corner = dp_v3((double)(i & 1 ? max : min)[0], (double)(i & 2 ? max : min)[1],
                                     (double)(i & 4 ? max : min)[2]);
        const dp_clip_point p = dp_to_clip(&frame->view, corner);
        if (!(p.w > 0)) continue;
        const dp_pointd s = dp_to_screen(&frame->view, p);
        reach = dp_max(reach, dp_hypot(s.x - centre.x, s.y - centre.y));
    }
    if (reach > 0) frame->radius = reach;
}

float dp_polar_repeats(const dp_frame *frame, const dp_stroke_style *stroke, float width) {
    const double around = 2 * 3.14159265358979323846 * frame->radius * 0.6;
    const double period = (double)(dp_texture_period(stroke->texture, width) * stroke->scale);
    return (float)dp_max(1, floor(around / period + 0.5));
}
