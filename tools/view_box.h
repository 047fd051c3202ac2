/* How far a model reaches in views. */
#ifndef TOOL_VIEW_BOX_H
#define TOOL_VIEW_BOX_H

#include <drypoint/camera.h>
#include <drypoint/source.h>

typedef struct view_box {
    double min[2],
        max[2]; /* camera space, x and y: world units; in perspective, x / -z and y / -z */
} view_box;

/* Of the corners of a source that can be read again, for `count` cameras in one reading. A model
 * without any has boxes of no size. The source's errors. */
dp_result view_boxes(dp_source *source, const dp_camera *cameras, int count, view_box *boxes,
                     dp_diag *diag);
/* Of a box. */
view_box view_box_of(const dp_camera *camera, const dp_extent *extent);
/* Adds a box. */
void view_box_add(view_box *box, const dp_camera *camera, const dp_extent *extent);

double view_box_width(const view_box *box);
double view_box_height(const view_box *box);

#endif
