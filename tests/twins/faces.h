/* Triangles as seen from an eye: which one does a ray through a point of the picture meet first?
 *
 * Lengths are in camera space, in units of the model's diagonal. On the picture a triangle is three
 * functions that are affine in x and y and not negative inside, and its plane a fourth: nearness,
 * which is 1 / depth in perspective and -depth without. */
#ifndef DP_TEST_FACES_H
#define DP_TEST_FACES_H

#include "accuracy/vec.h"

#include <drypoint/drypoint.h>

typedef struct affine {
    double at, dx, dy; /* at + dx * x + dy * y */
} affine;

typedef struct face {
    v3 corner[3];
    v3 normal; /* turned to the eye, unit */
    affine side[3], nearness;
    double low[2], high[2]; /* px, what holds it */
    uint32_t polygon;
} face;

enum { FACES_TILE = 8 /* px */, FACES_MARGIN = 5 /* px, around the picture */ };

typedef struct faces {
    face *all;
    size_t count, room;
    uint32_t *firsts; /* [columns * rows + 1] of `members`, by tile */
    uint32_t *members;
    uint32_t columns, rows, width, height;
    double scale[2]; /* px: x = width / 2 + scale[0] * cx / depth, or * cx; y so, upside down */
    bool orthographic;
} faces;

void faces_make(faces *f, const dp_batch *arrays, const dp_camera *camera, uint32_t width,
                uint32_t height);
void faces_free(faces *f);

/* What a ray meets. */
typedef struct hit {
    double x, y; /* px */
    int face;    /* -1: nothing */
    v3 at, normal;
} hit;

int faces_first(const faces *f, double x, double y);
hit faces_hit(const faces *f, double x, double y, int which);
static inline hit faces_look(const faces *f, double x, double y) {
    return faces_hit(f, x, y, faces_first(f, x, y));
}
static inline double affine_at(const affine *f, double x, double y) {
    return f->at + f->dx * x + f->dy * y;
}
/* Does the ray through (x, y) pass through the triangle's inside? */
bool face_pierced(const face *t, double x, double y);

#endif
