/* Marks: what the hand leaves. A chain of segments becomes a run of marks, short straight parts of
 * a stroke with everything that varies along it; between segments (finding) and ink (drawing). */
#ifndef DP_STROKES_MARK_H
#define DP_STROKES_MARK_H

#include "strokes/chain.h"

typedef struct dp_mark {
    dp_stroke stroke; /* ends on the screen; half_width is the wider one's; planes hide it as they
                         do strokes */
    float half[2];    /* half widths at a and b, px; lying outside: whole widths */
    float arc[2];     /* texture u at a and b, in repeats */
    float before[2];  /* direction of the mark before, unit; 0, 0 where the chain begins */
    float outward[2]; /* unit; lying outside only: the side that is drawn */
    float middle[2];  /* at the joint with the mark before: between both outward directions */
    float length;     /* px */
    uint32_t chain;   /* marks of one chain and repeat lie together */
    bool ends;        /* the chain ends at b */
    bool outside;     /* it lies beside its spine */
    bool core;        /* … the edge itself, thin, on both sides of the spine */
} dp_mark;

typedef struct dp_mark_store {
    dp_chain_store chains;
    dp_mark *marks;
    struct dp_hand_point *points; /* hand.c: of one chain */
    int8_t *sides;
    float *lights;
    size_t marks_cap, points_cap, sides_cap, lights_cap, count;
} dp_mark_store;

/* Are lines drawn as marks rather than as plain strokes? */
bool dp_is_by_hand(const dp_frame *frame);
/* Do outlines lie beside their spines, on the outside, as extruded silhouettes do? */
bool dp_lies_outside(const dp_frame *frame);

/* Fills frame->marks from frame->strokes and the pieces they were made of. False when memory is
 * out. */
bool dp_make_marks(dp_frame *frame, const dp_piece *pieces, dp_mark_store *store);
void dp_mark_store_free(dp_mark_store *store, const dp_allocator *memory);

/* Marks to tiles (brush.c); a tile's marks over what the target holds. */
bool dp_bin_marks(dp_frame *frame);
void dp_brush_tile(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile);

#endif
