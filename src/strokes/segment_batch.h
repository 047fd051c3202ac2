/* Segments made many at once (strokes/segments.inc, segments.c). */
#ifndef DP_STROKES_SEGMENT_BATCH_H
#define DP_STROKES_SEGMENT_BATCH_H

enum { DP_SEGMENTS = 16 };

/* By member, axis and segment. */
typedef struct dp_segment_batch {
    double a[3][DP_SEGMENTS], b[3][DP_SEGMENTS]; /* the spine's ends: x, y, d */
    double share[2][DP_SEGMENTS];                /* of the spine, where the segment's ends lie */
    double normal[2][3][DP_SEGMENTS];            /* of the polygons that meet there; unit */
    /* what is made of these */
    float screen[2][3][DP_SEGMENTS]; /* the segment's ends: x, y, d */
    float distance[2][DP_SEGMENTS];  /* along the line of sight */
    float world[2][3][DP_SEGMENTS];
    float plane[2][3][DP_SEGMENTS]; /* d0, dx, dy of the polygons, as dp_stroke has them */
} dp_segment_batch;

#endif
