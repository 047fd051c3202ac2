/* Positions that come in double precision and go into float32 about an origin (dp_batch.origin). */
#ifndef DP_MESH_WIDE_H
#define DP_MESH_WIDE_H

#include "base/memory.h"

/* Zero is empty. The float32 positions themselves are the caller's. */
typedef struct dp_wide {
    bool any;              /* there is a box */
    bool is_near;          /* surely no origin is needed: rests are not kept any more */
    bool is_cut;           /* some rest is not 0 */
    double min[3], max[3]; /* of the vertices so far */
    float (*rests)[3];     /* [rest_count] by vertex: what float32 cuts off */
    size_t rest_count, rests_cap;
} dp_wide;

/* What is left of a position when its float32 is taken away; 0 of what is not finite. */
static inline float dp_wide_rest(double position, float rounded) {
    const double rest = position - (double)rounded;
    return rest - rest == 0 ? (float)rest : 0;
}

/* A position about an origin, from its float32 and its rest. */
static inline float dp_wide_place(float rounded, float rest, double origin) {
    return (float)((double)rounded - origin + (double)rest);
}

/* How far neighbouring float32 values lie apart at a magnitude; 0 at 0. */
double dp_float_spacing(double magnitude);

/* Notes vertex number `vertex`, whose float32 is `rounded`. Numbers ascend. False: memory is out. */
bool dp_wide_note(dp_wide *wide, size_t vertex, const double position[3], const float rounded[3],
                  const dp_allocator *memory);

/* Chooses the origin, and moves positions[count][3] to it unless it is 0; then frees the rests. */
void dp_wide_settle(dp_wide *wide, float *positions, size_t count, double origin[3],
                    const dp_allocator *memory);

void dp_wide_free(dp_wide *wide, const dp_allocator *memory);

#endif
