/* Stylized strokes. A chain of segments becomes a run of parts, short straight pieces of one
 * stroke with everything that varies along it; between segments (finding) and ink (drawing). */
#ifndef DP_STROKES_STYLIZED_H
#define DP_STROKES_STYLIZED_H

#include "strokes/chain.h"

typedef struct dp_stylized {
    dp_stroke stroke; /* ends on the screen; half_width is the wider one's; planes hide it as they
                         do strokes */
    float half[2];    /* half widths at a and b, px; lying outside: whole widths */
    float arc[2];     /* texture u at a and b, in repeats; between them in perspective if `world` */
    float before[2];  /* direction of the part before, unit; 0, 0 where the chain begins */
    float outward[2]; /* unit; lying outside only: the side that is drawn */
    float middle[2];  /* at the joint with the part before: between both outward directions */
    float length;     /* px */
    uint32_t chain;   /* parts of one chain and repeat lie together */
    bool ends;        /* the chain ends at b */
    bool outside;     /* it lies beside its spine */
    bool world;       /* u is a length in space */
    bool flipped; /* v runs the other way: a pattern has v = 0 on the model's side of outlines */
    bool core;    /* … the edge itself, thin, on both sides of the spine */
} dp_stylized;

typedef struct dp_stylized_store {
    dp_stylized *stylized;
    struct dp_stylized_point *points; /* stylize.c: of one chain */
    float *lights;
    double *depths; /* stylize.c: of one chain's points, smoothed */
    size_t stylized_cap, points_cap, lights_cap, depths_cap, count;
} dp_stylized_store;

/* Are lines drawn as stylized strokes rather than as plain ones? */
bool dp_is_stylized(const dp_frame *frame);
/* Do outlines lie beside their spines, on the outside, as extruded silhouettes do? */
bool dp_lies_outside(const dp_frame *frame);

void dp_stylized_store_free(dp_stylized_store *store, const dp_allocator *memory);
uint64_t dp_stylized_store_bytes(const dp_stylized_store *store);

#endif
