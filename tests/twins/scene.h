/* Random scenes of a few simple parts, and a camera that sees all of them. */
#ifndef DP_TEST_SCENES_H
#define DP_TEST_SCENES_H

#include "soup.h"

typedef struct scene {
    soup soup;
    v3 eye, target, up;
    double fov_y;    /* degrees */
    double height;   /* > 0: orthographic, what is seen, world units */
    double radius;   /* of a sphere around target that holds everything */
    char about[400]; /* what is in it: part:relation, ... and how it is turned */
} scene;

/* The same number, the same scene. All sizes are multiples of 1/16, so that parts touch exactly
 * where a scene is not turned. */
void scene_make(uint64_t seed, scene *out);
void scene_free(scene *s);
/* The camera of a scene that was placed elsewhere. */
dp_camera scene_camera(const scene *s, const soup_place *place, double aspect);

#endif
