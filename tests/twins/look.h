/* A picture with its lines, and how two of them differ. */
#ifndef DP_TEST_LOOK_H
#define DP_TEST_LOOK_H

#include <drypoint/drypoint.h>

typedef struct look_how {
    uint32_t width, height; /* px */
    uint32_t samples;
    bool streamed, table_off, adjacency;
} look_how;

/* Lines that are one to the eye are one kind: the rim of a sheet is a border, that of a doubled
 * sheet a silhouette; two parts that cross by a rounding have an intersection where they touch. */
enum { LOOK_OUTLINE, LOOK_RIDGE, LOOK_VALLEY, LOOK_KINDS };
extern const char *const look_kind_names[LOOK_KINDS];

typedef struct look {
    uint8_t *rgba; /* [height][width][4], owned */
    uint32_t width, height;
    double length[DP_LINE_COUNT];       /* px, of all segments */
    double world_length[DP_LINE_COUNT]; /* world units */
    dp_stats stats;
    dp_diag diag; /* result DP_OK: it was drawn */
} look;

/* Draws with lines of 2 px in black, ridges below 150, valleys above 210 degrees. *out is zero or
 * an earlier look, whose memory is used again. */
void look_draw(dp_context *context, const dp_batch *arrays, const dp_camera *camera,
               const look_how *how, look *out);
void look_draw_source(dp_context *context, dp_source *source, const dp_camera *camera,
                      const look_how *how, look *out);
void look_free(look *l);
double look_length(const look *l, int kind);

/* Pixels whose colours are more than 30 % of the way from black to white apart. */
uint32_t look_pixels(const look *a, const look *b);
/* By how many px the length of some kind of line differs beyond 0.5 % and 4 px; 0: by nothing.
 * *kind: of which. */
double look_lengths(const look *a, const look *b, int *kind);
/* Grey where both have ink, red where only the first has, blue where only the second has. */
void look_difference(const look *a, const look *b, uint8_t *rgba);

#endif
