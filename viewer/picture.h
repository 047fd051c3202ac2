/* The picture of a loaded model, as a command line has it: by the processor or by OpenGL. */
#ifndef VIEWER_PICTURE_H
#define VIEWER_PICTURE_H

#include "cmdline.h"
#include "draw.h"
#include "loaded.h"

/* How well it is drawn: while something moves, a picture that takes too long is drawn worse. */
typedef enum picture_quality {
    QUALITY_FULL = 0,
    QUALITY_ONE_SAMPLE, /* of each pixel */
    QUALITY_HALF,       /* the size, with one sample */
    QUALITY_COUNT
} picture_quality;

/* Zero is empty. */
typedef struct picture {
    parsed line;
    dp_context *context;
    dp_texture *texture;
    dp_style style;
    look_data look;
    object_styles objects;
    page_plan plan;
    bool styled;            /* line and style are sound */
    uint8_t *rgba;          /* [height][width][4] */
    size_t room;            /* bytes of it */
    uint32_t width, height; /* px, as drawn last */
    bool by_gl;             /* it lies on the device instead */
    double ms;              /* it took */
    /* Asked while the processor draws; anything but 0 stops it. NULL: nobody is. Set before the first picture. */
    int (*progress)(void *user, double fraction);
    bool stopped; /* the last one was */
    uint64_t segments;
} picture;

/* These return false after a message; what was drawn before stays. */

/* Takes what the command line says. `restyle`: more than the camera has changed. */
bool picture_aim(picture *p, const cmdline *line, loaded *model, bool restyle);
/* Draws; gl NULL: by the processor. */
bool picture_draw(picture *p, const loaded *model, tool_gl *gl, picture_quality quality);
/* How far off, along the line of sight, what is seen at a point of the picture is; 0: nothing is, or it cannot be told.
 * right, down: shares of its size, from 0 to 1. */
double picture_depth(picture *p, const loaded *model, double right, double down);
/* Draws it again and writes it, as the program would. */
bool picture_save(const cmdline *line, const loaded *model, tool_gl *gl, const char *file);
void picture_free(picture *p);

#endif
