/* Scenes of Assimp's that move: bones, morph targets, animations. */
#ifndef DP_IO_ASSIMP_SCENE_H
#define DP_IO_ASSIMP_SCENE_H

#include "base/arena.h"
#include <drypoint/scene.h>

#include <assimp/scene.h>

enum { DP_ASSIMP_DEEPEST = 1000 /* depth of nodes: more is a loop, or overflows the stack */ };

/* Does anything in it move, or may it? */
bool dp_assimp_moves(const struct aiScene *scene);

/* Makes a source of it. DP_ERR_FORMAT where there is no polygon, DP_ERR_LIMIT, DP_ERR_MEMORY. */
dp_result dp_assimp_make_scene(const struct aiScene *scene, const dp_allocator *allocator,
                               dp_source **out, dp_diag *diag);

/* ------- between the files that make it ------- */

typedef struct dp_assimp_name {
    const char *text;
    uint32_t node; /* 1 + number */
} dp_assimp_name;

/* What can be said only once, however often it is met. */
typedef enum dp_assimp_flaw {
    DP_FLAW_BONES = 0,     /* bones that name no node, or have no matrix */
    DP_FLAW_INFLUENCES,    /* influences on a vertex beyond those kept */
    DP_FLAW_CHANNELS,      /* channels that name no node */
    DP_FLAW_MESH_CHANNELS, /* channels of whole meshes */
    DP_FLAWS
} dp_assimp_flaw;

/* A mesh, as far as its instances want to know. */
typedef struct dp_assimp_mesh {
    const uint32_t *joints;     /* [joint_count] 1 + numbers of the bones' nodes */
    const double *inverse_bind; /* [joint_count][3][4] */
    uint32_t joint_count;
    bool has_loose; /* some vertices follow no bone, but the joint after the last */
    bool has_areas;
} dp_assimp_mesh;

/* Tables being filled. */
typedef struct dp_assimp_tables {
    const struct aiScene *from;
    dp_arena arena; /* of all tables */
    dp_scene_node *nodes;
    const struct aiNode **sources; /* [node_count] */
    uint32_t node_count;
    dp_assimp_name *names; /* [name_count] sorted by text, then node */
    uint32_t name_count;
    dp_scene_mesh *meshes; /* [from->mNumMeshes] */
    dp_assimp_mesh *parts; /* [from->mNumMeshes] */
    dp_scene_instance *instances;
    dp_scene_skin *skins;
    dp_scene_clip *clips; /* [from->mNumAnimations] */
    uint32_t instance_count, skin_count;
    bool is_textured;
    uint64_t flaws[DP_FLAWS]; /* how many of each */
} dp_assimp_tables;

/* The node of that name, 1 + number, the first of several; 0: none. */
uint32_t dp_assimp_find_node(const dp_assimp_tables *t, const char *name);
/* Fill t->meshes and t->parts, t->clips. False: memory is out. */
bool dp_assimp_fill_meshes(dp_assimp_tables *t);
bool dp_assimp_fill_bones(dp_assimp_tables *t, const struct aiMesh *from, dp_scene_mesh *to,
                          dp_assimp_mesh *part);
bool dp_assimp_fill_clips(dp_assimp_tables *t);

#endif
