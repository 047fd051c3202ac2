/* A camera that goes round a model which stands: by azimuth and elevation, as --azimuth and --elevation have them. */
#ifndef VIEWER_ORBIT_H
#define VIEWER_ORBIT_H

#include "cmdline.h"
#include "sides.h"

typedef struct orbit {
    double azimuth, elevation; /* degrees */
    double target[3];          /* world space: in the middle of the picture */
    double distance;           /* of the eye from it */
    double fov, height;        /* degrees; world units, of an orthographic view */
    bool orthographic;
    model_sides sides;
    double centre[3], radius; /* of the model's box */
} orbit;

/* The orbit of a camera, whose target is as deep as the middle of the model. */
orbit orbit_of(const dp_camera *camera, const model_sides *sides, const dp_extent *extent);
/* Steps of the pointer, as shares of the picture's height; right and down. */
void orbit_turn(orbit *o, double right, double down);
void orbit_pan(orbit *o, double right, double down);
/* Makes everything `factor` times as large about a point that many heights right of and below the middle. */
void orbit_zoom(orbit *o, double factor, double right, double down);
/* Turns and zooms about what is that far from the eye from now on; what is seen stays. */
void orbit_focus(orbit *o, double depth);
/* Changes between perspective and orthographic views; what is in the middle keeps its size. */
void orbit_project(orbit *o, bool orthographic);
/* Writes it as options of a camera. */
void orbit_write(const orbit *o, cmd_options *camera);

#endif
