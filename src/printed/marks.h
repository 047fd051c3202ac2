/* Ink that knows its added polygon: for patterns and light on quads. */
#ifndef DP_PRINTED_MARKS_H
#define DP_PRINTED_MARKS_H

#include "features/mapping.h"
#include "printed/quads.h"

/* An added polygon, or a class of lines (`plain`) that has none. */
typedef struct dp_mark {
    uint32_t polygon, edge; /* tile polygon; its corner */
    uint32_t shown; /* its place in the printer's list of those, + 1; 0: no sample shows it */
    uint32_t style; /* its number (dp_style_number) */
    uint8_t line;
    bool plain, joint;
    double depth[3]; /* on the screen: d0, dx, dy */
} dp_mark;

/* What a mark that is seen needs. */
typedef struct dp_shown {
    dp_mapping mapping;
    dp_vec3 normal, light; /* its own; towards the light */
} dp_shown;

/* Begins a tile. Does any style have a pattern, or light on lines? If not, ink is class and
 * style. */
void dp_marks_begin(dp_printer *printer);

/* The ink of an added polygon: its mark's number. `ink`: what it is without marks. 0: out of
 * memory. */
uint32_t dp_mark_added(dp_printer *printer, uint32_t ink, uint32_t polygon, uint32_t edge,
                       const dp_added *added);
/* The same for what is not of an added polygon. */
uint32_t dp_mark_class(dp_printer *printer, uint32_t ink);

/* Where a sample lies on the screen. */
void dp_mark_sample_at(const dp_printer *printer, size_t lane, double *x, double *y);

/* Looks up the colour of each inked sample: printer->colors. False: out of memory. */
bool dp_marks_color(dp_printer *printer);

#endif
