/* Golden pictures: small pictures, each a row of a table, compared with stored ones (decoded
 * pixels), or their traces. DP_GOLDEN_WRITE=1 writes those that are missing; look at them before
 * committing. */
#ifndef DP_GOLDEN_H
#define DP_GOLDEN_H

#include "models.h"

#include <drypoint/drypoint.h>

#include <stdbool.h>
#include <stddef.h>

/* How the source is read. */
typedef enum golden_reading {
    GOLDEN_MEMORY = 0,
    GOLDEN_TWICE,    /* streamed, as it takes more than 48 MB */
    GOLDEN_ONCE,     /* streamed in one pass, from what cannot be rewound */
    GOLDEN_IMMEDIATE /* recorded, polygon by polygon; each group with a state of its own */
} golden_reading;

/* Zero is the default: the box from -1 to 1 from (1, 0.6, 1), in perspective. */
typedef struct golden_camera {
    bool flat; /* orthographic, from +z, one unit a pixel: for hand-made models */
    double direction[3], zoom;
    bool orthographic;
    double scale; /* of the view matrix; 0: 1 */
    double gain;  /* of all of the projection, which changes nothing; 0: 1 */
} golden_camera;

typedef struct golden {
    const char *name;  /* of its file */
    const char *shape; /* a generated model, or */
    model_maker *make; /* a hand-made one */
    dp_style style;
    golden_camera camera;
    dp_clip clip;
    const char *texture; /* of strokes, by name */
    uint32_t triangles;  /* of a generated model; 0: its own */
    uint32_t samples;
    golden_reading reading;
    /* The hostile build draws it otherwise: generated models come in another order there, tiles are
     * smaller, so that depths round otherwise and coincident faces show one for the other, or what
     * is streamed has more corners than are taken. */
    bool fragile;
    const char *like; /* the picture is that of another row, whose file it is compared with */
} golden;

/* Compares all of them; files lie in golden/`folder`. */
void golden_check(const char *folder, const golden *rows, size_t count, uint32_t width,
                  uint32_t height);

/* The same for traces (drypoint/sink.h): text that must be equal, with 1, 2 and 7 threads and
 * at any width of vectors. */
void golden_check_traces(const char *folder, const golden *rows, size_t count, uint32_t width,
                         uint32_t height);

#endif
