/* Pieces: parts of lines, visible or hidden, tile by tile, before they are joined to segments. */
#ifndef DP_CORE_PIECE_H
#define DP_CORE_PIECE_H

#include "core/view.h"

/* A piece of one edge or crossing: of its n sample points, [k0, k1) are visible, or hidden by the
 * same number of surfaces. */
typedef struct dp_piece {
    uint32_t a, b;      /* frame polygons: a owns the edge; b is across it, or UINT32_MAX */
    uint32_t edge;      /* corner of a where the edge starts; DP_CROSSING: a and b cross */
    uint32_t k0, k1, n; /* numbers of sample points */
    uint32_t hider[2];  /* what hides the sample point before k0, and that at k1: a polygon, or
                           DP_HIDER_… */
    float end[2];       /* where it begins and ends, in sample points from the middle between two of
                           them: at k0 + end[0], k1 + end[1]; 0 where that is not solved */
    uint32_t geometry;  /* as in its candidate: dp_segment_geometry … */
    uint32_t worker;    /* … of this worker; set when pieces are joined */
    uint8_t line;       /* dp_line */
    uint8_t seen;       /* bit 0: polygon a is seen beside the line, bit 1: b is */
    uint8_t level;      /* 0: visible; as in dp_segment */
    float through; /* of an x-ray's: share of it that the surfaces before it let through, 0 to 1 */
    bool open;     /* touches the tile's border: it may continue in a neighbour */
} dp_piece;

#define DP_CROSSING UINT32_MAX

/* At the end of a piece there is no hidden sample point: the spine ends, or leaves the picture; or
 * it is not known which polygon hides it. */
enum { DP_HIDER_NONE = -1, DP_HIDER_PICTURE = -2, DP_HIDER_UNKNOWN = -3 };

typedef struct dp_tile_pieces {
    uint32_t worker; /* whose list holds them */
    bool empty;      /* no polygon touches the tile, and its depth samples are not set */
    size_t first, count;
} dp_tile_pieces;

/* What segments along a candidate's spine are made from (strokes/segments.c). */
typedef struct dp_segment_geometry {
    dp_pointd a, b;    /* the spine's ends */
    dp_vec3 normal[2]; /* of the candidate's polygons, unit */
} dp_segment_geometry;

/* What one worker found in all its tiles; valid until the next picture. */
typedef struct dp_found {
    dp_piece *pieces;
    dp_segment_geometry *geometry;
    size_t pieces_cap, geometry_cap, piece_count;
    uint32_t geometry_count;
} dp_found;

void dp_found_free(dp_found *found, const dp_allocator *memory);
uint64_t dp_found_bytes(const dp_found *found);

#endif
