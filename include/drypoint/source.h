/* drypoint/source.h: where polygons come from.
 *
 * A polygon source hands out batches of polygons and can (usually) be replayed from the start. A
 * mesh in memory, a file on disk, an application's callback and a generator are the same thing to
 * the rest of the library; nothing needs to be held in memory as a whole.
 *
 * A polygon is given by its corners, counter-clockwise seen from its front. It should be convex
 * and planar; one that is not, or has more than 4096 corners, is split when drawn; the splitting
 * diagonals are no creases, but may be outlines. Polygons with fewer than three corners, no area, indices out of range or coordinates that are
 * not finite are dropped and counted (dp_stats).
 *
 * Positions are float32, of seven digits: a house in coordinates of a survey (500000, 5400000) would
 * be torn to steps of half a unit. Batches therefore have an origin in double precision, from which
 * positions are counted; what they and cameras mean is always world space, origin + position.
 * The library's readers choose an origin where a file's coordinates are that large against the
 * model's size (8 times), by text or doubles of the file; models nearer to 0 have none. */
#ifndef DRYPOINT_SOURCE_H
#define DRYPOINT_SOURCE_H

#include <drypoint/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dp_source dp_source;

/* What corners carry besides a position. A corner has value number `indices[corner]`, or, without
 * indices, that of its vertex's number. A number out of range (UINT32_MAX, say) means no value. */
typedef struct dp_attribute {
    const float *values;     /* [count][2 or 3]; NULL: none */
    size_t stride;           /* bytes from one to the next, a multiple of 4; 0: tight */
    size_t count;            /* of values */
    const uint32_t *indices; /* [corner_count] value numbers, or NULL */
} dp_attribute;

/* What an edge is. Others than these mean DP_EDGE_NORMAL. An edge that is a line by itself is drawn
 * wherever nothing hides it, whatever its polygon is like: one without area, with corners a, b, b say,
 * is the line from a to b and nothing else. They need strokes as ink (dp_ink), and models that are
 * neither smoothed nor larger than memory. */
typedef enum dp_edge_kind {
    DP_EDGE_NEVER = 0, /* never draws */
    DP_EDGE_NORMAL,    /* a line where it is seen to be one */
    DP_EDGE_DIAGONAL,  /* splits a polygon: no crease, but may be an outline */
    DP_EDGE_SECTION,   /* a line of class DP_LINE_SECTION */
    DP_EDGE_HATCHING,  /* of DP_LINE_HATCHING */
    DP_EDGE_FACE       /* never draws; its polygon is part of a section's face (dp_style.section) */
} dp_edge_kind;

/* A run of polygons. Everything is borrowed: valid until the next call on the source, or, when
 * `stable` is set, until the source is destroyed. Pointers to floats and to uint32_t, and strides,
 * must be multiples of 4, pointers to groups of 2; copy data that is packed otherwise. Calls refuse
 * any other batch with DP_ERR_ARGUMENT, and one of too many vertices with DP_ERR_LIMIT. */
typedef struct dp_batch {
    const float *positions;  /* x, y, z of vertex v at (const char *)positions + v * stride */
    size_t position_stride;  /* bytes from one vertex to the next, a multiple of 4, not below 12;
                                  0 means 12 */
    size_t vertex_count;     /* at most UINT32_MAX */
    const uint32_t *indices; /* [corner_count] vertex numbers; NULL: corner c is vertex c */
    size_t corner_count;     /* triangles without `firsts`: 3 * polygon_count */
    const uint32_t *firsts;  /* [polygon_count + 1] ascending corner numbers; NULL: triangles */
    size_t polygon_count;    /* 0: end of the source */
    const uint8_t
        *edge_flags;        /* [corner_count] dp_edge_kind of the edge to the next corner; or NULL:
                                  every edge may draw */
    const uint16_t *groups; /* [polygon_count]: group (object, material, …); NULL: all group 0 */
    dp_attribute normals;   /* x, y, z, any length; length 0: none. For shading only: facing and
                                  lines follow from the positions */
    dp_attribute texcoords; /* u, v */
    const uint32_t *colors; /* [vertex_count] 0xRRGGBBAA of the vertices, for shading, instead of
                               the group's; 0: none. Or NULL */
    bool stable;            /* the memory does not change while the source lives and has one time */
    double origin[3]; /* world space = origin + position; 0: the same. Drawing counts all from the
                         first batch's, so that one is best near the model, and the same in every
                         reading; others are moved to it, in double precision */
    double spacing;   /* world units: how far apart neighbouring values of what positions were made
                         from lay; 0: no farther than those of positions */
} dp_batch;

/* An application's own source. */
typedef struct dp_source_callbacks {
    void *user;
    /* Fills *batch with the next polygons (polygon_count 0 at the end); batch comes zeroed.
     * May fill *diag on failure (never NULL). */
    dp_result (*next)(void *user, dp_batch *batch, dp_diag *diag);
    /* Back to the first polygon. NULL: the source can be read only once. */
    dp_result (*rewind)(void *user, dp_diag *diag);
    /* Called once by dp_source_destroy. NULL allowed. */
    void (*destroy)(void *user);
    /* The name of group `group`, or NULL. Optional. */
    const char *(*group_name)(void *user, uint32_t group);
    /* The colour of group `group`, 0xRRGGBBAA, or 0: none. Optional. May be called from several
     * threads at once. */
    uint32_t (*group_color)(void *user, uint32_t group);
    /* A sentence on what is missing or wrong although the source can be drawn; or NULL. The second
     * on colours only, which not every drawing uses. Optional. */
    const char *(*remark)(void *user);
    const char *(*color_remark)(void *user);
    double up[3];    /* what is up; 0: not known. Any length */
    bool up_assumed; /* `up` is only what is usual */
    /* For a source that moves: what is read from the next rewind on is the model at `time`, s, which
     * is finite. Vertices, and polygons too, may be others than before. May fill *diag on failure
     * (never NULL). Optional. */
    dp_result (*set_time)(void *user, double time, dp_diag *diag);
    /* How long it moves, s, from 0 on. Optional: 0. */
    double (*duration)(void *user);
} dp_source_callbacks;

/* Makes a source of one batch, whose memory the caller owns and must not change while the source is
 * drawn. Positions may change between drawings: deforming meshes need no new source. The caller
 * destroys *out. DP_ERR_ARGUMENT, DP_ERR_MEMORY. */
DP_API dp_result dp_source_from_arrays(const dp_batch *arrays, const dp_allocator *allocator,
                                       dp_source **out, dp_diag *diag);

/* Makes a source of an application's callbacks (copied). It owns `user` on success only; the caller
 * destroys *out. DP_ERR_ARGUMENT, DP_ERR_MEMORY. */
DP_API dp_result dp_source_from_callbacks(const dp_source_callbacks *callbacks,
                                          const dp_allocator *allocator, dp_source **out,
                                          dp_diag *diag);

typedef enum dp_file_format {
    DP_FORMAT_AUTO = 0, /* by content first, then by the name's ending */
    DP_FORMAT_STL,      /* ASCII or binary */
    DP_FORMAT_PLY, /* ASCII, binary little or big endian; faces or tristrips; vertices' colours */
    DP_FORMAT_OBJ, /* v with colours, vn, vt, f, g, o, usemtl; relative indices; colours of its
                           mtllib */
    DP_FORMAT_OFF, /* OFF and COFF, NOFF, … (of the extras, vertices' colours); ASCII */
    DP_FORMAT_GLTF /* glTF 2.0, .gltf with the files beside it or .glb; a scene (scene.h) */
} dp_file_format;

typedef struct dp_file_options {
    dp_file_format format;
    const dp_allocator *allocator;
    /* Called now and then while reading, also by dp_source_next: `user` must outlive the source.
     * fraction: in [0, 1], or negative when the size is unknown. A non-zero return stops with
     * DP_ERR_CANCELLED. NULL allowed. */
    int (*progress)(void *user, double fraction);
    void *user;
} dp_file_options;

/* Opens a model file ("-": standard input) with the library's own readers; drypoint/io.h opens
 * every other format too. Options may be NULL. Indexed formats are read whole by this call; STL is
 * read batch by batch by dp_source_next, each time it is drawn (only once from a pipe). The caller
 * destroys *out. DP_ERR_IO, DP_ERR_FORMAT (with line or offset), DP_ERR_MEMORY, DP_ERR_LIMIT,
 * DP_ERR_UNSUPPORTED for any other format. */
DP_API dp_result dp_source_open(const char *path, const dp_file_options *options, dp_source **out,
                                dp_diag *diag);

/* A model file that lies in memory, and the files beside it. */
typedef struct dp_memory_file {
    const void *data; /* the file's bytes; borrowed, and must not change until dp_source_destroy:
                         STL is read from them batch by batch */
    size_t size;      /* bytes */
    const char *name; /* "bolt.obj", say: its ending tells the format where the content does not.
                         NULL allowed */
    /* Finds a file that this one names (an OBJ's `mtllib`, a glTF's buffers). `name`: as written there,
     * but with `/` between folders. False: there is none (of buffers a failure, else a remark). Called only while the source
     * is opened, perhaps more than once for a name. NULL: there are no other files, and materials
     * have no colours. The library never looks into the file system instead. */
    bool (*open_beside)(void *user, const char *name, const void **data, size_t *size);
    /* Called once for each file that was found, as soon as it is read. NULL allowed. */
    void (*close_beside)(void *user, const void *data, size_t size);
    void *user;
} dp_memory_file;

/* As dp_source_open, for a file in memory. *file itself is needed only during the call:
 *
 *     const dp_memory_file file = {.data = bytes, .size = count, .name = "bolt.stl"};
 *     dp_source_open_memory(&file, NULL, &source, &diag);
 *
 * The source can always be rewound. DP_ERR_ARGUMENT where data is NULL and size is not 0; other
 * errors as for a file. Messages do not contain the file's name. */
DP_API dp_result dp_source_open_memory(const dp_memory_file *file, const dp_file_options *options,
                                       dp_source **out, dp_diag *diag);

/* Makes one source of several, a scene: the polygons of sources[0], then those of sources[1], and so
 * on. Batches keep their origins, normals, texture coordinates and colours, where they have some; the
 * first one's origin is the picture's. The scene can be rewound if all its sources can, and is
 * streamed where they are.
 *
 *     dp_source *const parts[] = {bolt, plate};
 *     const char *const names[] = {"bolt", "plate"};
 *     dp_source_join(parts, names, 2, NULL, &scene, &diag);
 *
 * names[k] (copied; NULL: none, also for `names`) is what sources[k] is called in messages, in
 * remarks, and before the names of its groups: "bolt/thread", or "bolt" for a group without one.
 * Groups get numbers of the scene, none of which two sources share: k for group 0 of source k, and
 * the next free one for each other group when it is first read; names and colours are known from then
 * on. All groups beyond 65536 share the last number.
 *
 * On success the scene owns its sources, and the caller destroys only *out; on failure they remain
 * the caller's. DP_ERR_ARGUMENT where there is no source, or one is NULL or there twice;
 * DP_ERR_LIMIT for more than 65536, DP_ERR_MEMORY. */
DP_API dp_result dp_source_join(dp_source *const *sources, const char *const *names, size_t count,
                                const dp_allocator *allocator, dp_source **out, dp_diag *diag);

/* The next batch (polygon_count 0 at the end); back to the first; whether that is possible. */
DP_API dp_result dp_source_next(dp_source *source, dp_batch *batch, dp_diag *diag);
DP_API dp_result dp_source_rewind(dp_source *source, dp_diag *diag);
DP_API bool dp_source_rewindable(const dp_source *source);

/* Moves the source to a time, s, and to its start: what is drawn from then on is how it is at that
 * time (scene.h, deform.h, dp_source_callbacks; those that do not move stay as they are). Times
 * before 0 and after the end are allowed. A new source is at time 0. Call it before the first reading
 * of a source that can be read only once. DP_ERR_ARGUMENT for a time that is not finite; whatever the
 * source fails with, also when it is rewound: set a time again, then, before it is read. */
DP_API dp_result dp_source_set_time(dp_source *source, double time, dp_diag *diag);
/* How long the source moves, s: from 0 to this; 0 where it does not, or without an end. */
DP_API double dp_source_duration(const dp_source *source);

/* The name of a group (OBJ group or object, say), borrowed; NULL where it has none. */
DP_API const char *dp_source_group_name(const dp_source *source, uint32_t group);
/* Its colour (that of its material, say), 0xRRGGBBAA; 0 where it has none. */
DP_API uint32_t dp_source_group_color(const dp_source *source, uint32_t group);
/* What is missing or wrong although the source can be drawn; known when it has been read once.
 * Borrowed; NULL: nothing. */
DP_API const char *dp_source_remark(const dp_source *source);
/* The same of its colours alone: an absent file of materials, say. */
DP_API const char *dp_source_color_remark(const dp_source *source);

/* What is up, as a unit vector in world space. True: the file, its format or the application says so
 * (glTF, COLLADA, FBX, 3MF; generated shapes stand on y). False: it is what is usual, +z for STL and
 * +y for all else. */
DP_API bool dp_source_up(const dp_source *source, double up[3]);

/* NULL allowed. */
DP_API void dp_source_destroy(dp_source *source);

/* What dp_source_extent finds. */
typedef struct dp_extent {
    float min[3], max[3]; /* world space; of the finite corners that polygons use; rounded outwards
                             where float32 cannot hold it. Where there are none, min is INFINITY and
                             max -INFINITY, which dp_camera_fit refuses */
    uint64_t polygons;    /* all of the source */
    uint64_t corners;
    uint64_t vertices;
    uint64_t not_finite;               /* polygons with a NaN or infinite coordinate */
    uint64_t bad_index;                /* polygons with an index out of range */
    double exact_min[3], exact_max[3]; /* the same box, not rounded */
    double spacing; /* world units: how far apart neighbouring float32 values lie where the source's
                       positions are largest. Beyond some 1/2000 of the box the shape is damaged:
                       give positions about an origin (dp_batch) */
} dp_extent;

/* Reads a source from its start to its end, wherever it is, and leaves it at its start. One that
 * can be read only once is read from where it is, and is at its end then. Errors are those of the
 * source. */
DP_API dp_result dp_source_extent(dp_source *source, dp_extent *extent, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
