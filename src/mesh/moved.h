/* A source of another one's polygons with moved vertices: what deforming and morphing share. */
#ifndef DP_MESH_MOVED_H
#define DP_MESH_MOVED_H

#include "base/memory.h"
#include <drypoint/deform.h>

/* Moves a run of vertices. other: the same run's vertices in the partner's batch, about
 * other_origin; NULL: there is no partner. */
typedef void dp_mover(void *user, const dp_vertex_run *run, const dp_batch *other,
                      size_t first_of_batch);

typedef struct dp_moved_desc {
    dp_source *inner;
    dp_source *partner; /* read batch for batch with `inner`; NULL: none */
    dp_mover *move;
    void *user;                                                    /* owned */
    dp_result (*set_time)(void *user, double time, dp_diag *diag); /* NULL allowed */
    double (*duration)(void *user);                                /* NULL allowed */
    void (*destroy)(void *user);                                   /* NULL allowed */
    bool normals;                                                  /* `move` writes them */
} dp_moved_desc;

/* On success *out owns the sources and `user`. */
dp_result dp_source_moved(const dp_moved_desc *desc, const dp_allocator *memory, dp_source **out,
                          dp_diag *diag);

/* The user pointer of a source that this mover moves; NULL of any other. */
void *dp_moved_user(const dp_source *source, dp_mover *move);

#endif
