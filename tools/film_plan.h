/* When and from where each frame of a film is seen. */
#ifndef TOOL_FILM_PLAN_H
#define TOOL_FILM_PLAN_H

#include "commands.h"

#include <drypoint/path.h>

typedef struct film_plan {
    uint32_t count; /* frames, numbered from 0 */
    double fps;
    double time[2];            /* s: of frame 0, and of frame `count`, which there is not */
    double turn;               /* degrees; 0: the camera does not turn */
    dp_camera_path *path;      /* or NULL */
    double centre[3], axis[3]; /* what the camera turns about */
} film_plan;

/* Plans a film of the open model. 0, or the exit code after a message; film_plan_free in any case. */
int film_plan_make(const tool_settings *s, const dp_source *source, film_plan *plan);
void film_plan_free(film_plan *plan);
/* Says what the camera turns about: the middle of a box, or --target. */
void film_plan_centre(const tool_settings *s, const dp_extent *extent, film_plan *plan);

/* s: the model's time in frame k. */
double film_time(const film_plan *plan, uint32_t k);
/* The rotation about the plan's centre that is as far back as the camera has walked in frame k: what
 * the camera sees then, frame 0's camera sees of the model that is turned so. */
void film_turn_back(const film_plan *plan, uint32_t k, double rotation[3][3]);
/* The camera of frame k, from that of frame 0. 0, or the exit code after a message. */
int film_camera(const film_plan *plan, uint32_t k, double aspect, const dp_extent *extent,
                dp_camera *camera);

#endif
