/* Inside the reader of glTF 2.0. Numbers in messages are those of the file, from 0 on. */
#ifndef DP_IO_GLTF_H
#define DP_IO_GLTF_H

#include "base/diag.h"
#include "base/json.h"
#include "io/stream.h"
#include <drypoint/scene.h>

typedef struct dp_gltf_bytes {
    const uint8_t *data; /* NULL: not read yet */
    size_t size;
    void *owned; /* a block to be freed; NULL: borrowed, or the arena's */
} dp_gltf_bytes;

/* Primitives of a mesh become meshes of a scene: [first, first + count) of `meshes`. */
typedef struct dp_gltf_mesh {
    uint32_t first, count;
    uint32_t morph_count; /* as its first primitive has */
} dp_gltf_mesh;

typedef struct dp_gltf {
    dp_arena arena; /* of all that is read */
    const dp_stream *stream;
    const dp_json *root;
    const dp_json *buffers, *views, *accessors, *materials, *meshes, *nodes, *skins, *animations;
    dp_gltf_bytes *buffer; /* [buffer_count] */
    uint32_t buffer_count;
    dp_gltf_bytes file;  /* the whole of it */
    dp_gltf_bytes chunk; /* a .glb file's binary chunk */
    uint64_t bytes;      /* of all that was read: bounds what counts may say */
    dp_result result;    /* the first failure */
    dp_diag *diag;
    char where[96]; /* what is being read, for messages: "mesh 3, " */
    char remark[200], color_remark[200];

    /* what becomes the scene */
    dp_gltf_mesh *mesh; /* [count of meshes] */
    dp_scene_mesh *scene_meshes;
    dp_scene_node *scene_nodes;
    dp_scene_instance *instances;
    uint32_t scene_mesh_count, scene_node_count, instance_count;
    size_t scene_meshes_cap, scene_nodes_cap, instances_cap; /* of arrays that grow */
    dp_scene_skin *scene_skins;
    dp_scene_clip *clips;
} dp_gltf;

/* ------- gltf_values.c ------- */

/* Fails, unless it has failed; false. The message begins with g->where. */
bool dp_gltf_fail(dp_gltf *g, dp_result result, const char *format, ...) DP_PRINTF(3, 4);
bool dp_gltf_out_of_memory(dp_gltf *g);
/* Sets g->where. */
void dp_gltf_at(dp_gltf *g, const char *format, ...) DP_PRINTF(2, 3);
/* Notes what is not drawn, unless there is a remark already. */
void dp_gltf_remark(dp_gltf *g, const char *format, ...) DP_PRINTF(2, 3);

/* Each finds a member of an object. False: it is not what it must be, and the reader has failed.
 * One that is absent is what `to` is set to: NULL, `fallback`, 0. */
bool dp_gltf_member(dp_gltf *g, const dp_json *object, const char *name, dp_json_kind kind,
                    const dp_json **to);
bool dp_gltf_uint(dp_gltf *g, const dp_json *object, const char *name, uint32_t fallback,
                  uint32_t *to);
/* 1 + the number of an item of `among`, a table called `what`. */
bool dp_gltf_index(dp_gltf *g, const dp_json *object, const char *name, const dp_json *among,
                   const char *what, uint32_t *to);
/* The same of a value itself. */
bool dp_gltf_index_of(dp_gltf *g, const dp_json *value, const char *name, const dp_json *among,
                      const char *what, uint32_t *to);
/* `count` numbers; *has: they are there. */
bool dp_gltf_numbers(dp_gltf *g, const dp_json *object, const char *name, uint32_t count,
                     double *to, bool *has);
/* The object's name, or "nodes[3]"; NULL: memory is out, and the reader has failed. */
const char *dp_gltf_name(dp_gltf *g, const dp_json *object, const char *table, uint32_t number);

/* ------- gltf_buffers.c ------- */

/* Reads a stream to its end, into memory that *to owns. */
bool dp_gltf_read_all(dp_gltf *g, dp_stream *stream, dp_gltf_bytes *to);
/* Reads all buffers that were not asked for yet, so that g->bytes is all that there is. */
bool dp_gltf_read_buffers(dp_gltf *g);
/* Bytes [offset, offset + size) of a view. */
bool dp_gltf_view(dp_gltf *g, uint32_t view, uint64_t offset, uint64_t size, const uint8_t **to);
/* A view's stride, 0 where it has none. */
bool dp_gltf_stride(dp_gltf *g, uint32_t view, uint32_t *to);

/* ------- gltf_accessors.c ------- */

typedef struct dp_gltf_accessor {
    uint32_t number, count;
    uint32_t components; /* of an element */
    uint32_t type;       /* of a component: 5120 … 5126 */
    bool normalized;
    const uint8_t *data; /* NULL: zeros */
    uint32_t stride;     /* bytes */
    uint32_t sparse_count, sparse_type;
    const uint8_t *sparse_indices, *sparse_values;
} dp_gltf_accessor;

bool dp_gltf_accessor_open(dp_gltf *g, uint32_t number, dp_gltf_accessor *to);
/* Elements [first, first + count) as floats, each of `width` components: others are cut off, or
 * 0. */
float *dp_gltf_floats(dp_gltf *g, const dp_gltf_accessor *a, uint32_t first, uint32_t count,
                      uint32_t width);
/* The same as whole numbers; of an accessor of floats none. */
uint32_t *dp_gltf_uints(dp_gltf *g, const dp_gltf_accessor *a, uint32_t first, uint32_t count,
                        uint32_t width);

/* ------- gltf_meshes.c, gltf_nodes.c, gltf_clips.c ------- */

bool dp_gltf_read_meshes(dp_gltf *g);
/* Nodes, and instances of the scene that is drawn. */
bool dp_gltf_read_nodes(dp_gltf *g);
bool dp_gltf_read_skins(dp_gltf *g);
bool dp_gltf_read_clips(dp_gltf *g);

#endif
