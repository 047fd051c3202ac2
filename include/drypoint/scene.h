/* drypoint/scene.h: models that move: nodes, instances, morph targets, skins and clips.
 *
 * A scene is a polygon source. It is described by plain tables, which readers fill from files
 * (glTF; FBX, COLLADA, X and more through drypoint/io.h) and applications from their own data:
 *
 *     const dp_scene_node nodes[] = {{.name = "wheel"}};
 *     const dp_scene_mesh meshes[] = {{.name = "rim", .batch = batch}};
 *     const dp_scene_instance instances[] = {{.node = 1, .mesh = 1}};
 *     const dp_scene_desc desc = {.nodes = nodes, .node_count = 1, .meshes = meshes, .mesh_count = 1,
 *                                 .instances = instances, .instance_count = 1};
 *     dp_source_from_scene(&desc, NULL, &source, &diag);
 *
 * Where something names another by its number, 1 is the first, and 0 is none.
 *
 * dp_scene_play chooses a clip and dp_source_set_time (source.h) the time; the next drawing
 * poses the scene. Nothing is kept from pose to pose but arrays of the same size: lines follow
 * any deformation, because they are found anew in each picture (Raskar 2001, 1.2). Terms are
 * those of glTF 2.0. */
#ifndef DRYPOINT_SCENE_H
#define DRYPOINT_SCENE_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A node: a transform within its parent's. Of the matrix, or of translation * rotation * scale.
 * A matrix of which a channel moves a part is split into these three while it does; its shear is
 * lost then. */
typedef struct dp_scene_node {
    const char *name;     /* NULL: none */
    uint32_t parent;      /* 1 + number of a node; 0: none. May come before or after; no circles */
    const double *matrix; /* [3][4] rows, of an affine transform; NULL: the next three */
    double translation[3];
    double rotation[4]; /* unit quaternion x, y, z, w; any length; 0: none */
    double scale[3];    /* 0 0 0 means 1 1 1 */
} dp_scene_node;

/* A morph target: what is added to each vertex, times the target's weight. */
typedef struct dp_scene_morph {
    const float *positions; /* [vertex_count][3]; NULL: nothing */
    const float *normals;   /* [normals.count][3]; NULL: nothing */
} dp_scene_morph;

/* Polygons in a space of their own, of one colour. */
typedef struct dp_scene_mesh {
    const char *name;             /* NULL: none */
    dp_batch batch;               /* its `groups` are not used */
    uint32_t color;               /* 0xRRGGBBAA; 0: none */
    const dp_scene_morph *morphs; /* [morph_count] */
    uint32_t morph_count;
    /* Skinning: which joints of an instance's skin move a vertex, and how much. Weights are made to
     * sum to one; those that are negative or not finite, and joints out of range, count as 0. Where
     * all are 0, the vertex follows the first joint. */
    const uint16_t *joints; /* [vertex_count][influences] places in the skin's list, from 0 on */
    const float *weights;   /* [vertex_count][influences] */
    uint32_t influences;    /* 0: the mesh cannot be skinned, and follows its node */
} dp_scene_mesh;

/* Joints that move a mesh. */
typedef struct dp_scene_skin {
    const uint32_t *joints; /* [joint_count] 1 + numbers of nodes */
    /* [joint_count][3][4] rows, mesh space to that of the joint; NULL: the same space */
    const double *inverse_bind;
    uint32_t joint_count;
} dp_scene_skin;

/* A mesh in its place: at a node, or, with a skin, where the joints take it, whatever its node's
 * transform is (glTF 2.0, 3.7.3.3). Where that mirrors (of a skin, where most of it follows
 * joints that do), corners are reversed. Any number of instances may share a mesh. Each is a
 * group, called "node/mesh"; those beyond 65536 share the last one. */
typedef struct dp_scene_instance {
    uint32_t node, mesh;  /* 1 + numbers; node 0: none, as if at a node that is not moved */
    uint32_t skin;        /* 1 + number; 0: none */
    const float *weights; /* [weight_count] of morph targets, at rest; missing ones are 0 */
    uint32_t weight_count;
} dp_scene_instance;

/* What a channel moves. */
typedef enum dp_scene_path {
    DP_SCENE_TRANSLATION = 0,
    DP_SCENE_ROTATION,
    DP_SCENE_SCALE,
    DP_SCENE_WEIGHTS /* of the morph targets of all the node's instances */
} dp_scene_path;

typedef enum dp_interpolation {
    DP_INTERPOLATION_LINEAR = 0, /* rotations: along the arc, the short way */
    DP_INTERPOLATION_STEP,
    DP_INTERPOLATION_CUBIC /* Hermite splines: of each key in-tangent, value, out-tangent
                              (glTF 2.0, C.5) */
} dp_interpolation;

/* One value of one node over time. Before the first key it is the first key's, after the last
 * one the last key's. Keys at times that are not finite or not after the key before them, and
 * keys whose values are not finite, are left out. */
typedef struct dp_scene_channel {
    uint32_t node; /* 1 + number */
    dp_scene_path path;
    dp_interpolation interpolation;
    const double *times; /* [key_count] s */
    /* [key_count][width], with cubic splines [key_count][3][width]; width: 3, 4 for rotations
     * (x, y, z, w), `width` for weights */
    const float *values;
    uint32_t key_count;
    uint32_t width;
} dp_scene_channel;

/* Channels that move together. */
typedef struct dp_scene_clip {
    const char *name;                 /* NULL: none */
    const dp_scene_channel *channels; /* [channel_count] */
    uint32_t channel_count;
    double duration; /* s; 0: that of the last key */
} dp_scene_clip;

typedef struct dp_scene_desc {
    const dp_scene_node *nodes;
    const dp_scene_mesh *meshes;
    const dp_scene_instance *instances;
    const dp_scene_skin *skins;
    const dp_scene_clip *clips;
    uint32_t node_count, mesh_count, instance_count, skin_count, clip_count;
    double up[3];       /* what is up; 0: not known */
    const char *remark; /* what is missing or wrong although it can be drawn; NULL: nothing */
    const char *color_remark;
} dp_scene_desc;

/* Makes a source of a scene, which is copied; the caller destroys *out. It is at rest, at time
 * 0, until a clip is chosen. DP_ERR_ARGUMENT where numbers are out of range, nodes are their own
 * ancestors or counts contradict each other (the message says which); DP_ERR_LIMIT for 2^32
 * vertices or corners in all, DP_ERR_MEMORY. */
DP_API dp_result dp_source_from_scene(const dp_scene_desc *desc, const dp_allocator *allocator,
                                      dp_source **out, dp_diag *diag);

/* The tables of a source that is a scene, borrowed, in which defaults are filled in and keys
 * that are left out are gone; NULL for any other source. */
DP_API const dp_scene_desc *dp_scene_of(const dp_source *source);

/* Chooses what moves the scene: 1 + number of a clip; 0: nothing, it is at rest.
 * dp_source_duration is then the clip's. DP_ERR_ARGUMENT where there is no such clip, or the
 * source is no scene. */
DP_API dp_result dp_scene_play(dp_source *source, uint32_t clip, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
