/* Small hand-made scenes: polygons, a camera whose world units are pixels, and pictures to look
 * into. */
#ifndef DP_TEST_SCENE_H
#define DP_TEST_SCENE_H

#include <drypoint/drypoint.h>

enum { SCENE_WIDTH = 200, SCENE_HEIGHT = 120, SCENE_CORNERS = 4096, SCENE_POLYGONS = 1024 };

typedef struct scene {
    float positions[SCENE_CORNERS][3];
    uint8_t flags[SCENE_CORNERS];
    uint32_t firsts[SCENE_POLYGONS + 1];
    size_t corners, polygons;
} scene;

typedef struct picture {
    uint8_t rgba[4 * SCENE_WIDTH * SCENE_HEIGHT];
    uint8_t line_class[SCENE_WIDTH * SCENE_HEIGHT];
    float depth[SCENE_WIDTH * SCENE_HEIGHT];
} picture;

/* Adds a polygon of `count` corners, x, y, z each. */
void scene_polygon(scene *scene, size_t count, const float (*corners)[3]);
/* Flatland: the segment from (x0, z0) to (x1, z1), drawn out from y = -h to h. Its front is on the
 * left when one looks from the first to the second with z up, so towards +z for x0 < x1. */
void scene_wall(scene *scene, double x0, double z0, double x1, double z1, double h);
/* Two walls that meet at x = 0, z = 0 with this dihedral angle (degrees), open towards +z: convex
 * under 180. `reach`: the length of each. */
void scene_roof(scene *scene, double dihedral, double reach);
/* A box, its front outside, from min to max. */
void scene_box(scene *scene, const float min[3], const float max[3]);

dp_batch scene_batch(const scene *scene);

/* Orthographic, from +z: (0, 0) is the picture's middle, one unit is one pixel, y up. */
dp_camera scene_flat_camera(void);
/* Perspective, of 50 degrees. */
dp_camera scene_camera(double ex, double ey, double ez, double tx, double ty, double tz);

/* Draws into the picture; NULL: all defaults. */
dp_result scene_draw(dp_context *context, const scene *scene, const dp_camera *camera,
                     const dp_style *style, picture *picture, dp_diag *diag);

/* Ink (1: a black pixel) in a rectangle of the flat camera's world units. */
double scene_ink(const picture *picture, double x0, double y0, double x1, double y1);
/* Ink farther than `reach` px from every edge of the scene that has finite ends. */
double scene_stray(const picture *picture, const scene *scene, const dp_camera *camera,
                   double reach);

#endif
