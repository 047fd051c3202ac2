/* Small hand-made scenes. */
#include "scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void scene_polygon(scene *s, size_t count, const float (*corners)[3]) {
    if (s->corners + count > SCENE_CORNERS || s->polygons + 1 > SCENE_POLYGONS) abort();
    memcpy(s->positions[s->corners], corners, count * sizeof *corners);
    memset(s->flags + s->corners, 1, count);
    s->firsts[s->polygons++] = (uint32_t)s->corners;
    s->corners += count;
    s->firsts[s->polygons] = (uint32_t)s->corners;
}

void scene_wall(scene *s, double x0, double z0, double x1, double z1, double h) {
    const float a = (float)x0, b = (float)x1, za = (float)z0, zb = (float)z1, y = (float)h;
    const float corners[4][3] = {{a, -y, za}, {b, -y, zb}, {b, y, zb}, {a, y, za}};
    scene_polygon(s, 4, corners);
}

void scene_roof(scene *s, double dihedral, double reach) {
    const double half = dihedral * pi / 360;
    const double x = reach * sin(half), z = -reach * cos(half);
    scene_wall(s, -x, z, 0, 0, 45);
    scene_wall(s, 0, 0, x, z, 45);
}

void scene_box(scene *s, const float min[3], const float max[3]) {
    static const int corner[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; f++) {
        float corners[4][3];
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 3; k++) corners[c][k] = corner[f][c] >> k & 1 ? max[k] : min[k];
        scene_polygon(s, 4, (const float(*)[3])corners);
    }
}

dp_batch scene_batch(const scene *s) {
    return (dp_batch){.positions = s->positions[0],
                      .vertex_count = s->corners,
                      .corner_count = s->corners,
                      .firsts = s->firsts,
                      .polygon_count = s->polygons,
                      .edge_flags = s->flags,
                      .stable = true};
}

dp_camera scene_flat_camera(void) {
    dp_camera camera = {{0}, {0}};
    dp_camera_look_at(&camera, (const double[3]){0, 0, 500}, (const double[3]){0, 0, 0},
                      (const double[3]){0, 1, 0});
    dp_camera_orthographic(&camera, SCENE_HEIGHT, (double)SCENE_WIDTH / SCENE_HEIGHT, 1, 1000);
    return camera;
}

dp_camera scene_camera(double ex, double ey, double ez, double tx, double ty, double tz) {
    dp_camera camera = {{0}, {0}};
    dp_camera_look_at(&camera, (const double[3]){ex, ey, ez}, (const double[3]){tx, ty, tz},
                      (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 50, (double)SCENE_WIDTH / SCENE_HEIGHT, 0.1, 1000);
    return camera;
}

dp_result scene_draw(dp_context *context, const scene *s, const dp_camera *camera,
                     const dp_style *style, picture *p, dp_diag *diag) {
    const dp_batch batch = scene_batch(s);
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = p->rgba,
                              .line_class = p->line_class,
                              .depth = p->depth};
    dp_source *source = NULL;
    memset(p, 0x55, sizeof *p);
    dp_result result = dp_source_from_arrays(&batch, NULL, &source, diag);
    if (result == DP_OK) result = dp_draw(context, source, camera, style, &target, diag);
    dp_source_destroy(source);
    return result;
}

static double ink_of(const uint8_t *rgba) {
    return rgba[3] / 255.0 * (1 - (rgba[0] + rgba[1] + rgba[2]) / 765.0);
}

double scene_ink(const picture *p, double x0, double y0, double x1, double y1) {
    double sum = 0;
    for (int y = 0; y < SCENE_HEIGHT; y++) {
        for (int x = 0; x < SCENE_WIDTH; x++) {
            const double wx = x + 0.5 - SCENE_WIDTH / 2.0, wy = SCENE_HEIGHT / 2.0 - y - 0.5;
            if (wx > x0 && wx < x1 && wy > y0 && wy < y1)
                sum += ink_of(p->rgba + 4 * (y * SCENE_WIDTH + x));
        }
    }
    return sum;
}

/* Homogeneous clip space. */
static void to_clip(const dp_camera *camera, const float p[3], double out[4]) {
    double v[4];
    for (int r = 0; r < 4; r++)
        v[r] = camera->view[r] * (double)p[0] + camera->view[4 + r] * (double)p[1] +
               camera->view[8 + r] * (double)p[2] + camera->view[12 + r];
    for (int r = 0; r < 4; r++) {
        const double *m = camera->projection;
        out[r] = m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r] * v[3];
    }
}

/* An edge on the screen, its part before the near plane cut off. */
typedef struct screen_edge {
    double ax, ay, bx, by;
    bool there;
} screen_edge;

static screen_edge project_edge(const dp_camera *camera, const float p[3], const float q[3]) {
    double a[4], b[4], ends[2][4];
    screen_edge edge = {0, 0, 0, 0, false};
    for (int k = 0; k < 3; k++)
        if (!isfinite(p[k]) || !isfinite(q[k])) return edge;
    to_clip(camera, p, a);
    to_clip(camera, q, b);
    const double da = a[2] + a[3], db = b[2] + b[3];
    if (da < 0 && db < 0) return edge;
    const double from = da < 0 ? da / (da - db) : 0, to = db < 0 ? da / (da - db) : 1;
    for (int r = 0; r < 4; r++) {
        ends[0][r] = a[r] + (b[r] - a[r]) * from;
        ends[1][r] = a[r] + (b[r] - a[r]) * to;
    }
    if (!(ends[0][3] > 0) || !(ends[1][3] > 0)) return edge;
    edge.ax = (ends[0][0] / ends[0][3] + 1) / 2 * SCENE_WIDTH;
    edge.ay = (1 - ends[0][1] / ends[0][3]) / 2 * SCENE_HEIGHT;
    edge.bx = (ends[1][0] / ends[1][3] + 1) / 2 * SCENE_WIDTH;
    edge.by = (1 - ends[1][1] / ends[1][3]) / 2 * SCENE_HEIGHT;
    edge.there = true;
    return edge;
}

static bool near_edge(const screen_edge *e, double x, double y, double reach) {
    const double dx = e->bx - e->ax, dy = e->by - e->ay, length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? ((x - e->ax) * dx + (y - e->ay) * dy) / length2 : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(x - e->ax - t * dx, y - e->ay - t * dy) <= reach;
}

double scene_stray(const picture *p, const scene *s, const dp_camera *camera, double reach) {
    static bool allowed[SCENE_WIDTH * SCENE_HEIGHT];
    double sum = 0;
    memset(allowed, 0, sizeof allowed);
    for (size_t f = 0; f < s->polygons; f++) {
        for (uint32_t c = s->firsts[f]; c < s->firsts[f + 1]; c++) {
            const uint32_t next = c + 1 < s->firsts[f + 1] ? c + 1 : s->firsts[f];
            const screen_edge edge = project_edge(camera, s->positions[c], s->positions[next]);
            for (int i = 0; edge.there && i < SCENE_WIDTH * SCENE_HEIGHT; i++)
                if (near_edge(&edge, i % SCENE_WIDTH + 0.5, i / SCENE_WIDTH + 0.5, reach))
                    allowed[i] = true;
        }
    }
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++)
        if (!allowed[i]) sum += ink_of(p->rgba + 4 * i);
    return sum;
}
