/* The camera of a picture that is looked at: as the command line's words have it until it is moved, and an orbit from then
 * on, which is written as such words. */
#ifndef VIEWER_FREE_CAMERA_H
#define VIEWER_FREE_CAMERA_H

#include "orbit.h"
#include "picture.h"

/* Zero: the command line's own words say it. */
typedef struct free_camera {
    orbit orbit; /* if `is_free` */
    bool is_free;
} free_camera;

/* Makes it one that can be moved; what is seen stays. False: there is no picture yet. */
bool free_camera_begin(free_camera *c, const cmdline *line, const picture *p, const loaded *model);
/* Fits it to the model again, from the same side. False: it is fitted. */
bool free_camera_fit(free_camera *c, cmdline *line);
/* A view by its name; NULL: the usual one. */
void free_camera_view(free_camera *c, cmdline *line, const char *name);
bool free_camera_is_orthographic(const free_camera *c, const cmdline *line);
/* False: there is no picture yet. */
bool free_camera_project(free_camera *c, cmdline *line, const picture *p, const loaded *model,
                         bool orthographic);

#endif
