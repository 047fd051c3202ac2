/* A dp_gl's inside: the device, the scene and the stages' own memory.
 *
 *    api, device        functions and limits; state is kept and given back (state.c)
 *    program.c          shaders: src/gl/shaders/ *.glsl, embedded when the library is built
 *    buffer.c           buffers and textures that grow
 *    scene              all meshes of a picture in one place (scene.c)
 *    one struct a stage what it keeps on the device
 *
 * Which buffer is bound where is said once, in DP_GL_BIND_… and in shaders/picture.glsl. */
#ifndef DP_GL_GL_H
#define DP_GL_GL_H

#include "gl/api.h"
#include "gl/buffer.h"
#include "gl/program.h"

#include "base/diag.h"
#include "base/memory.h"
#include "core/precision.h"
#include "core/view.h"

/* Storage buffers, by binding: no shader uses more than eight. Those of a stage alone are its own, from
 * DP_GL_BIND_OWN on. */
enum {
    DP_GL_BIND_VERTICES = 0,
    DP_GL_BIND_CORNERS = 1,
    DP_GL_BIND_TRIANGLES = 2,
    DP_GL_BIND_OWN = 3,
    DP_GL_BINDINGS = 8
};

/* Texture units, of which a stage may use all from DP_GL_UNIT_OWN on. */
enum { DP_GL_UNIT_IDS = 0, DP_GL_UNIT_DEPTH = 1, DP_GL_UNIT_OWN = 2, DP_GL_UNITS = 12 };

/* Draw buffers that the application's framebuffer may have; OpenGL allows as many at least. */
enum { DP_GL_DRAW_BUFFERS = 8 };

enum { DP_GL_GROUP_SIZE = 64 /* invocations of a compute shader's group, along x */ };

enum { DP_GL_SAMPLES_MOST = 16, DP_GL_LINES_MOST = 8 /* DP_LINE_COUNT, rounded up */ };

/* What all shaders know of a picture: shaders/picture.glsl has the same, std140. */
typedef struct dp_gl_picture_block {
    double clip[4][4];                    /* rows: world to clip space; w is the distance, or 1 */
    double sight[4];                      /* row: world to distance */
    double eye[4];                        /* xyz; w: guard */
    double forward[4];                    /* xyz; w: focal */
    double corner[4], across[4], down[4]; /* xyz: a pixel's place at d = 1 (core/view.h) */
    double angles[4]; /* cos theta, sin theta, cos phi, sin phi: ridge and valley angle */
    float size[4];    /* width, height, 1 / width, 1 / height: px */
    float step[4];    /* step_scale, step_offset, nearly_edge_on, flat_cosine (core/frame.h) */
    float widths[DP_GL_LINES_MOST][4]; /* x: by line, px; yzw: none */
    float colors[DP_GL_LINES_MOST][4]; /* by line, not premultiplied */
    float paper[4], surface[4];
    float places[DP_GL_SAMPLES_MOST][4]; /* xy: of samples in a pixel, from its upper left corner */
    uint32_t counts[4];                  /* vertices, triangles, samples, segments' capacity */
    uint32_t style[4];                   /* lines, perspective, cull_back_faces, free */
} dp_gl_picture_block;

/* Normals of a mesh, and how up to date they are (attributes.c). */
typedef struct dp_gl_mesh_normals {
    dp_gl_buffer made;  /* computed: [3 * triangle] as dp_gl_mesh.normals */
    uint64_t made_from; /* `version` of the positions that they are of; 0: none are made */
    float crease;       /* degrees */
    uint64_t version;   /* changes with the source's positions and attributes */
    bool lacks;         /* some corners have no normal of their own, and get one that is made */
    bool is_foreign;    /* the positions are the application's: none are computed */
} dp_gl_mesh_normals;

/* A mesh on the device. */
struct dp_gl_mesh {
    dp_gl *gl;
    struct dp_gl_mesh *next; /* of the dp_gl's meshes */
    dp_gl_buffers from;      /* where its positions, indices and normals are */
    bool owned;              /* the buffers are the library's: */
    dp_gl_buffer positions, corners, triangles, normals, texcoords, colors;
    bool has_normals, has_texcoords, has_colors;
    dp_gl_mesh_normals shading; /* what normals, texcoords and colors are of */
    bool keeps_groups;          /* its groups have the same numbers in the picture */
    uint64_t topology;          /* changes with the indices: a number that no other state has had */
    uint64_t placement;         /* the same of `matrix` and the positions of owned buffers */
    double origin[3];           /* world space: what positions count from */
    double matrix[16];
    dp_written written; /* of a source's positions, in its own space (core/precision.h) */
    bool placed;        /* there is a matrix */
    uint64_t polygons;  /* of the source */
    uint32_t pieces;    /* convex ones, which triangles are numbered by */
    uint32_t vertex_count, triangle_count;
    uint32_t *
        polygon_firsts; /* [triangle]: the first triangle of its polygon; NULL: all are their own */
    uint64_t *source_polygon; /* [triangle] */
    uint32_t *group_colors;   /* [group_count] 0xRRGGBBAA, 0: none */
    uint32_t group_count;
    uint64_t fingerprint; /* of the topology of owned buffers */
};

/* Groups in a picture, as dp_source_join numbers them: k is group 0 of mesh k, then come the others of each mesh. A mesh's
 * group g is `zero` if it is 0, else `others` + g. */
typedef struct dp_gl_group_numbers {
    uint32_t zero, others;
} dp_gl_group_numbers;

/* All meshes of a picture, one after the other. */
typedef struct dp_gl_scene {
    dp_gl_mesh **meshes; /* borrowed, of the last picture */
    uint64_t *topologies, *placements;
    size_t count, meshes_cap, topologies_cap, placements_cap;
    double origin[3]; /* of all positions on the device, world space */
    uint32_t vertex_count, triangle_count;
    bool new_topology;     /* since the last picture: nothing that is kept of it holds */
    uint64_t topology;     /* a number that changes with it; 0: no scene */
    bool has_fans;         /* some polygons are of several triangles */
    dp_gl_buffer vertices; /* [vertex] screen x, y, d, key; world x, y, z, 0: vec4 each */
    dp_gl_buffer corners;  /* [3 * triangle] vertex */
    dp_gl_buffer
        triangles; /* [triangle] polygon; bits 0 to 2: edge k may be a line, 3 to 5: it is a
                               diagonal, an outline at most; 16 to 31: group */
} dp_gl_scene;

/* Each stage's own memory on the device. A stage's file has its begin, run and free. */
typedef struct dp_gl_faces {
    dp_gl_texture ids;   /* [height][width] samples: 1 + triangle, 0: none, DP_GL_ID_FOREIGN */
    dp_gl_texture depth; /* DEPTH_COMPONENT32F, larger is nearer; see picture.glsl */
    uint32_t framebuffer;
    dp_gl_texture ink,
        ink_depth; /* of silhouettes by adjacency (fins.c): RGBA in 32 bits, 0: none */
    uint32_t
        layers[2]; /* arrays of two layers, which ids and ink, depth and ink_depth are; 0: none */
    uint32_t sampler; /* for the application's depth */
    float range[2];   /* depth as it is stored: d * range[0] + range[1] */
} dp_gl_faces;
#define DP_GL_ID_FOREIGN 0xFFFFFFFFu /* something of the application's is nearer */

typedef struct dp_gl_lines_store {
    dp_gl_buffer mates;      /* [3 * triangle] half-edge, or DP_GL_MATE_… (mates.c) */
    dp_gl_buffer slots;      /* the table in which they meet */
    dp_gl_buffer counters;   /* dp_gl_counters */
    dp_gl_buffer candidates; /* dp_gl_candidate */
    dp_gl_buffer segments;   /* dp_gl_segment */
    dp_gl_buffer disputed;   /* half-edges of which the eye decides (emerge.c) */
    dp_gl_buffer sides;      /* [triangle] normal, and how it lies to the eye (sides.c) */
    dp_gl_buffer pairs;      /* half-edges that may be lines (edges.c) */
    dp_gl_buffer spines;     /* [candidate] shaders/lines.glsl (visibility.c) */
    dp_gl_buffer words;      /* their sample points, 32 each (visibility.c) */
    uint64_t topology;       /* whose mates they are */
    struct dp_lines *read;   /* the picture's lines, read back (read.c) */
    bool have_read, have_hiders;
} dp_gl_lines_store;

/* Mates: the half-edge that runs the same edge the other way; the same way, with DP_GL_MATE_ALIKE; or none, or more than
 * two half-edges have the edge. */
#define DP_GL_MATE_ALIKE 0x80000000u
#define DP_GL_MATE_MANY  0xFFFFFFFEu
#define DP_GL_MATE_NONE  0xFFFFFFFFu

/* Counters on the device: the first four are a DrawArraysIndirectCommand for the segments' capsules. */
typedef struct dp_gl_counters {
    uint32_t corners_of_capsule, segments, zero[2];
    uint32_t candidates, disputed, crossings;
    uint32_t wanted[5];    /* [0] to [2]: see passes.h */
    uint32_t groups[4][4]; /* arguments of indirect dispatches; [0]: see passes.h */
} dp_gl_counters;

/* A line that may be visible. 32 bytes. */
typedef struct dp_gl_candidate {
    uint32_t line;   /* dp_line */
    uint32_t a;      /* triangle that owns the edge */
    uint32_t edge;   /* of a; UINT32_MAX: a and b cross */
    uint32_t b;      /* triangle across; UINT32_MAX: none */
    uint32_t k0, k1; /* sample points that may be visible; 0, UINT32_MAX: all */
    uint32_t seen;   /* bit 0: a is seen beside it, bit 1: b */
    uint32_t level;  /* 0 */
} dp_gl_candidate;

/* Edges where the eye decides (emerge.c), and crossings (crossings.c). */
typedef struct dp_gl_eye {
    dp_gl_buffer words;    /* counts and rooms, bits of half-edges and cells, lists of cells */
    dp_gl_buffer looked;   /* half-edges that are looked at */
    dp_gl_buffer chunks;   /* parts of these */
    dp_gl_buffer nodes;    /* of the cells' lists: polygons */
    dp_gl_buffer findings; /* by sample point: what is seen there */
    dp_gl_buffer pairs;    /* the table of polygons that may cross */
    dp_gl_buffer crossed;  /* those, and where they do */
    dp_gl_buffer along;    /* crossings by cells */
    dp_gl_buffer pixels;   /* that show several polygons */
    dp_gl_buffer hits;     /* pairs of triangles whose planes cross there */
    dp_gl_buffer listed;   /* what a cheap pass leaves to a dear one */
} dp_gl_eye;

typedef struct dp_gl_surface {
    dp_gl_texture
        picture; /* RGBA8, the picture as it grows: surface, then ink; not premultiplied */
    uint32_t framebuffer;
} dp_gl_surface;

typedef struct dp_gl_ink {
    dp_gl_texture coverage[2]; /* RGBA8: of line k in channel k % 4 of texture k / 4 */
    uint32_t framebuffer;
} dp_gl_ink;

typedef struct dp_gl_quads dp_gl_quads;     /* quads.c */
typedef struct dp_gl_shading dp_gl_shading; /* shading.c: G-buffer, edge map, styles of surfaces */
typedef struct dp_gl_fins dp_gl_fins;       /* fins.c: textured silhouettes, pencil */
typedef struct dp_gl_mirror dp_gl_mirror;   /* mirror.c: the reflected scene, and its picture */

struct dp_gl {
    dp_allocator memory;
    dp_gl_desc desc;
    dp_gl_api api;
    dp_gl_programs programs;
    dp_gl_mesh *meshes;
    uint64_t numbers; /* the last that was given to a topology or placement */

    char device[160];
    int version; /* 430, 450, … */
    bool has_clip_control, has_reset_status, has_debug, is_lost;
    uint32_t samples_most; /* of colour, integer and depth at once */
    uint32_t texture_most, storage_most;
    uint32_t vertex_array;
    /* For tests: as if the context had no geometry shader; stroke textures by the texture unit, by four texels in float32, or by
     * these with shares in steps of 1/256 (fins_texture.c). */
    bool no_geometry_shader;
    enum { DP_GL_LOOKUPS_UNIT, DP_GL_LOOKUPS_EXACT, DP_GL_LOOKUPS_STEPS } lookups;

    /* the picture that is drawn */
    dp_view view;
    dp_style style; /* resolved; borrowed pointers are valid during dp_gl_draw only */
    dp_gl_target target;
    dp_camera camera; /* about the scene's origin */
    uint32_t samples;
    dp_gl_picture_block block;
    dp_gl_buffer block_buffer;
    bool drawn;

    dp_gl_scene scene;
    dp_gl_faces faces;
    dp_gl_lines_store lines;
    dp_gl_eye eye;
    dp_gl_surface surface;
    dp_gl_ink ink;
    dp_gl_quads *quads;     /* made when first used */
    dp_gl_shading *shading; /* the same */
    dp_gl_fins *fins;       /* the same */
    dp_gl_mirror *mirror;   /* the same */

    dp_gl_stats stats;
    bool timed;
    uint32_t queries[DP_GL_STAGE_COUNT][2]; /* timestamps: when it began and ended */
    bool queried[DP_GL_STAGE_COUNT];
};

/* The error that the device remembers, as a result: memory, a lost context; DP_OK if there is none. It
 * is asked once a picture, not after each call. `what` was being done. */
dp_result dp_gl_check(dp_gl *gl, const char *what, dp_diag *diag);
/* Forgets errors that are not ours; notices a lost context. */
void dp_gl_forget_errors(dp_gl *gl);

/* Before and after what a call does: remembers and restores the application's state (state.c). */
typedef struct dp_gl_state dp_gl_state;
dp_result dp_gl_enter(dp_gl *gl, dp_gl_state **state, dp_diag *diag);
void dp_gl_leave(dp_gl *gl, dp_gl_state *state);

/* Binds a program, and the picture's block. */
void dp_gl_use(dp_gl *gl, uint32_t program);
/* Binds the scene's vertices, corners and triangles (scene.c). */
void dp_gl_scene_bind(dp_gl *gl);
/* Binds the samples' numbers and depth to their units and tells the program (faces.c). */
void dp_gl_faces_bind(dp_gl *gl, uint32_t program);
/* Window depth = d * out[0] + out[1]: 0 at the far plane or infinitely far, and just below 1 at the near plane (faces.c). */
void dp_gl_depth_range(const dp_gl *gl, float out[2]);
/* Runs the bound compute program for `count` items, DP_GL_GROUP_SIZE a group; the shader must compare its number
 * with the count (more than 65535 groups become rows: see dp_item in picture.glsl). Then a barrier for
 * storage. */
void dp_gl_dispatch(dp_gl *gl, uint32_t count);
/* One group of 8 x 8 a block of pixels of the picture; then a barrier. */
void dp_gl_dispatch_pixels(dp_gl *gl);
/* A triangle that covers the viewport: shaders/whole.vert; nothing is tested or blended but what the caller enabled. */
void dp_gl_draw_whole(dp_gl *gl);

/* A number that no topology or placement has had. */
static inline uint64_t dp_gl_number(dp_gl *gl) { return ++gl->numbers; }

#endif
