/* Inside a scene: its tables, the pose of its nodes, and the one batch of all its instances. */
#ifndef DP_SCENE_SCENE_H
#define DP_SCENE_SCENE_H

#include "base/arena.h"
#include "base/threads.h"
#include "scene/affine.h"
#include <drypoint/scene.h>

/* Where in the batch an instance lies, and its pose. */
typedef struct dp_placed {
    const dp_scene_mesh *mesh;
    const char *name;                         /* of the group */
    uint32_t vertex, corner, polygon, normal; /* its first ones in the batch */
    bool is_skinned;                          /* it follows its joints, not its node */
    bool is_turned;      /* it is mirrored: its corners lie reversed in the batch */
    bool is_known;       /* it was posed before */
    double *weights;     /* [mesh->morph_count] of morph targets */
    double *old_weights; /* the same, as it was posed last */
    float *shares;       /* [joint_count] of a skin: how much of the mesh a joint moves */
} dp_placed;

/* What one task poses: vertices [first, last) of an instance, with their normals, or, where normals
 * have numbers of their own, such normals. */
typedef struct dp_scene_block {
    uint32_t instance, first, last;
    bool is_normals;
} dp_scene_block;

typedef struct dp_scene {
    dp_arena arena; /* of all that follows; nothing is taken from it after the scene is made */
    dp_scene_desc desc;
    dp_scene_clip *clips;
    uint32_t clip; /* 1 + number of the one that plays; 0: none */
    double time;
    bool is_posed, is_read;
    dp_threads *threads; /* lent; or NULL */

    /* nodes */
    uint32_t *order;                          /* [node_count] parents before children */
    uint8_t *state;                           /* [node_count] scratch of finding that order */
    uint32_t *node_instances, *next_instance; /* 1 + number of a node's first instance, of the one
                                                 after an instance; 0: none */
    dp_trs *rest, *trs;                       /* [node_count] at rest, and now */
    bool *moves;       /* [node_count] a channel moves it: the TRS counts, not the matrix */
    dp_affine *worlds; /* [node_count] to world space */
    uint64_t *changed; /* [node_count] the pose in which that became another */
    uint64_t pose;     /* number of this pose */
    /* skins */
    dp_affine **joints;     /* [skin_count][joint_count] mesh space to world space */
    uint64_t *skin_changed; /* [skin_count] */
    /* instances */
    dp_placed *placed;              /* [instance_count] */
    const uint32_t **normal_owners; /* [mesh_count] of normals with numbers of their own, the vertex
                                       that each belongs to; NULL elsewhere */
    dp_scene_block *blocks;
    uint32_t block_count;
    bool *dirty;     /* [instance_count] to be posed anew */
    double *sampled; /* scratch of one channel's values */

    /* the batch, and its arrays that change */
    dp_batch batch;
    float *positions, *normals;
    uint32_t *indices, *normal_indices, *texcoord_indices;
    uint8_t *edge_flags;
} dp_scene;

/* Do the tables agree with each other? DP_ERR_ARGUMENT, DP_ERR_LIMIT (check.c). */
dp_result dp_scene_check(const dp_scene_desc *desc, dp_diag *diag);
/* Copies the tables into scene->desc, with defaults filled in. False: memory is out (copy.c). */
bool dp_scene_copy(dp_scene *scene, const dp_scene_desc *desc);
/* Makes the batch of the copied tables, not posed. False: memory is out (build.c). */
bool dp_scene_build(dp_scene *scene);
/* Reverses the corners of an instance's polygons (build.c). */
void dp_scene_turn(dp_scene *scene, dp_placed *placed);
/* Chooses the batch's origin by where its vertices lie in this pose (build.c). */
void dp_scene_settle(dp_scene *scene);
/* Sets the batch's spacing. farthest: scratch, [mesh_count] (build.c). */
void dp_scene_note_spacing(dp_scene *scene, double *farthest);
/* Makes what a pose takes: room for matrices and weights. *circle: 1 + number of a node that is
 * its own ancestor, which makes the scene useless; 0: none. False: memory is out (pose.c). */
bool dp_scene_ready(dp_scene *scene, uint32_t *circle);
/* Moves nodes, joints and weights to scene->time, and marks instances that change (pose.c). */
void dp_scene_move(dp_scene *scene);
/* Writes positions and normals of marked instances (vertices.c). */
void dp_scene_place(dp_scene *scene);
/* A vertex of an instance in world space, in double precision (vertices.c). */
void dp_scene_vertex(const dp_scene *scene, const dp_placed *placed, uint32_t vertex, double to[3]);

static inline uint32_t dp_scene_number(const dp_scene *scene, const dp_placed *placed) {
    return (uint32_t)(placed - scene->placed);
}

/* The skin of an instance that is skinned. */
static inline const dp_scene_skin *dp_skin_of(const dp_scene *scene, const dp_placed *placed) {
    return &scene->desc.skins[scene->desc.instances[dp_scene_number(scene, placed)].skin - 1];
}

#endif
