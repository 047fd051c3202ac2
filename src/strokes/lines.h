/* A drawing: the lines of one picture, from visible pieces to strokes.
 *
 *     pieces → segments, and a stroke each → chains → stylized strokes, if a style asks for them
 *                                                   → dashes of hidden lines, if it asks for those
 *
 * Sinks take it from here (src/sink/). */
#ifndef DP_STROKES_LINES_H
#define DP_STROKES_LINES_H

#include "core/piece.h"
#include "strokes/stylized.h"

/* Scratch for hidden lines (hidden.c). */
typedef struct dp_hidden_scratch {
    dp_stroke *strokes; /* the hidden segments, their numbers, whether they are dropped */
    uint32_t *segment;
    uint8_t *dropped;
    dp_chain_store chains;
    dp_point *points; /* of one chain, and their arc lengths, px */
    float *arc;
    size_t strokes_cap, segment_cap, dropped_cap, points_cap, arc_cap;
} dp_hidden_scratch;

typedef struct dp_lines {
    dp_piece *pieces;     /* joined; what each segment is made of */
    dp_segment *segments; /* the public contract (draw.h) */
    dp_stroke *strokes;   /* one per segment */
    size_t count;         /* of the three */
    size_t pieces_cap, segments_cap, strokes_cap;

    /* With hidden lines, what is inked of strokes: visible ones, unless they are stylized, then the
     * dashes of hidden ones (hidden.c); else `strokes` are. */
    bool inks_hidden;
    dp_stroke *inked;
    size_t inked_count, inked_cap;
    dp_hidden_scratch hidden;
    dp_color paper, surface; /* of the first style */
    dp_hidden_look hidden_look;

    /* Of the first style, which is no longer there when chains are asked for after the picture. */
    bool stylizes;          /* it asks for stylized strokes */
    bool patterned;         /* … with a pattern */
    bool lit;               /* light gives each segment its colour */
    bool lies_outside;      /* they lie beside their lines, as extruded ones do */
    float silhouette_width; /* px */

    dp_chain_store chains;
    bool chained;  /* `chains` are of these segments, and segments know of their chains */
    int8_t *sides; /* by segment, for stylized strokes: as in dp_chain_rule */
    size_t sides_cap;
    dp_stylized_store stylized;
} dp_lines;

void dp_lines_free(dp_lines *drawing, const dp_allocator *memory);
uint64_t dp_lines_bytes(const dp_lines *drawing);

/* Joins the tiles' pieces and makes segments and strokes of them (segments.c). `found`: by worker.
 * False when memory is out. */
bool dp_make_segments(const dp_frame *frame, const dp_found *found, dp_lines *drawing);

/* The order of pieces by polygon, edge and sample points, for sorting. */
int dp_piece_order(const dp_piece *left, const dp_piece *right);

/* Is q the next part of what p is a part of? */
bool dp_piece_goes_on(const dp_piece *p, const dp_piece *q);

/* The rule by which plain strokes are chained (lines.c). */
dp_chain_rule dp_plain_chain_rule(void);

/* Does the near or the far plane cut a spine there? (segments.c) */
bool dp_lies_on_plane(const dp_view *view, const float world[3]);

/* Puts segments into the order of polygons and edges (lines.c). */
void dp_sort_segments(dp_lines *drawing);

/* Sets a segment's and its stroke's level, width and colour by the piece's (segments.c). */
void dp_take_look(const dp_frame *frame, const dp_piece *piece, dp_segment *segment,
                  dp_stroke *stroke);

/* The strokes that plain ink takes. */
static inline const dp_stroke *dp_inked(const dp_lines *d) {
    return d->inks_hidden ? d->inked : d->strokes;
}
static inline size_t dp_inked_count(const dp_lines *d) {
    return d->inks_hidden ? d->inked_count : d->count;
}

static inline bool dp_is_hidden_inked(const dp_lines *d) {
    return d->inks_hidden && d->inked_count;
}

/* Puts segments into an order that does not depend on tiles, joins them to chains and numbers them,
 * once a picture: who asks for it pays for it, as plain ink does not need it (lines.c). False when
 * memory is out. */
bool dp_chain_lines(const dp_frame *frame, dp_lines *drawing);

/* Are strokes interrupted, by a texture or as dashes of hidden lines? Then lines that lie on each other
 * must be drawn once (vector/once.c), or each would fill the gaps of the other. */
bool dp_strokes_have_gaps(const dp_frame *frame);

/* Makes the stylized strokes of the chains (stylize.c). False when memory is out. */
bool dp_stylize(const dp_frame *frame, dp_lines *drawing);

#endif
