/* drypoint/gl.h: the same drawings by OpenGL 4.3 or later, in the component libdrypoint_gl.
 *
 *     dp_gl *gl = NULL;
 *     dp_gl_mesh *mesh = NULL;
 *     const dp_gl_desc desc = {.get_proc_address = eglGetProcAddress_or_the_like};
 *     dp_gl_create(&desc, &gl, &diag);                       a context is current
 *     dp_gl_mesh_from_source(gl, source, &mesh, &diag);
 *     const dp_gl_target target = {.framebuffer = 0, .width = 1600, .height = 1200};
 *     dp_gl_draw(gl, &mesh, 1, &camera, NULL, &target, &diag);
 *     ... swap buffers, next frame ...
 *     dp_gl_mesh_destroy(mesh);
 *     dp_gl_destroy(gl);                                     the context is still current
 *
 * The application brings the context: a window's (GLFW, SDL, EGL, GLX, WGL) or one without a window.
 * It is current in the calling thread during every call that takes a dp_gl or dp_gl_mesh. Camera and
 * style are those of dp_draw, and the lines are the same (docs/opengl.md has a table of what is
 * drawn here, and how near it comes). What is not fails with DP_ERR_UNSUPPORTED, and the message
 * names it. Names of OpenGL's objects are uint32_t here: no OpenGL header is needed.
 *
 * Not here: windows, contexts, files. */
#ifndef DRYPOINT_GL_H
#define DRYPOINT_GL_H

#include <drypoint/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What belongs to one context: programs, and buffers that grow with the pictures drawn. */
typedef struct dp_gl dp_gl;

typedef struct dp_gl_desc {
    /* Addresses of OpenGL's functions in the current context; required. `user` is passed on. */
    void *(*get_proc_address)(void *user, const char *name);
    void *user;
    const dp_allocator *allocator; /* NULL: malloc; copied */
    /* By default each call leaves the context's state as it found it: bindings, tests, masks, all that
     * it touches. Not so an error that the context remembers, which is forgotten, and queries that
     * run, which count what is drawn; conditional rendering must be off. True: the application sets its own state after each call anyhow, and saves the time
     * (some 0.1 ms) of asking for it. */
    bool leaves_state_changed;
    /* Hears remarks of the driver (KHR_debug, where the context is a debug one) and of compilers of
     * shaders, a line or several each. NULL allowed. */
    void (*message)(void *user, const char *text);
    /* The most memory of the device that buffers of one kind may take, bytes; 0 means 1 GB. What
     * would need more fails with DP_ERR_LIMIT. */
    size_t memory;
} dp_gl_desc;

/* DP_ERR_ARGUMENT (no get_proc_address), DP_ERR_UNSUPPORTED (no current context, one older than 4.3
 * or without what is named), DP_ERR_MEMORY. */
DP_API dp_result dp_gl_create(const dp_gl_desc *desc, dp_gl **out, dp_diag *diag);
/* NULL allowed. Meshes must be gone. If the context was lost, or is not current, call
 * dp_gl_abandon instead, which frees memory alone and calls nothing of OpenGL. */
DP_API void dp_gl_destroy(dp_gl *gl);
DP_API void dp_gl_abandon(dp_gl *gl);

/* Meshes --------------------------------------------------------------------------------------- */

/* Polygons on the device. What is made of their topology, which half-edges are each other's mates
 * (12 bytes a triangle), is kept as long as that stays; nothing is made anew for positions that
 * change. Where vertices begin or cease to lie at one place as they move, say so by
 * dp_gl_mesh_topology_changed. */
typedef struct dp_gl_mesh dp_gl_mesh;

/* Reads a source whole, and holds no reference to it. DP_ERR_MEMORY, DP_ERR_LIMIT (beyond 2^29
 * triangles, or what desc.memory says), DP_ERR_FORMAT, whatever the source fails with. */
DP_API dp_result dp_gl_mesh_from_source(dp_gl *gl, dp_source *source, dp_gl_mesh **out,
                                        dp_diag *diag);
/* The source again, at another time or with other vertices: positions are uploaded. If the topology
 * is another one, all is. */
DP_API dp_result dp_gl_mesh_update(dp_gl_mesh *mesh, dp_source *source, dp_diag *diag);

/* Triangles in buffers of the application's own, which may be written by its shaders. They are
 * neither copied nor changed, and must exist while the mesh is drawn. */
typedef struct dp_gl_buffers {
    uint32_t positions;        /* buffer: float32 x, y, z of each vertex */
    size_t positions_offset;   /* bytes, a multiple of 4 */
    uint32_t positions_stride; /* bytes, a multiple of 4; 0 means 12 */
    uint32_t vertex_count;
    uint32_t indices;      /* buffer: uint32; 0: three vertices after the other are a triangle */
    size_t indices_offset; /* bytes, a multiple of 4 */
    uint32_t triangle_count;
    uint32_t normals; /* buffer: float32 x, y, z of each vertex, for shading; 0: none */
    size_t normals_offset;
    uint32_t normals_stride;
} dp_gl_buffers;

/* Indices beyond vertex_count draw nothing. DP_ERR_ARGUMENT, DP_ERR_LIMIT. */
DP_API dp_result dp_gl_mesh_from_buffers(dp_gl *gl, const dp_gl_buffers *buffers, dp_gl_mesh **out,
                                         dp_diag *diag);
/* The indices in the buffer have changed: mates are looked for again. Positions need no call; where
 * shaders write them, a barrier (GL_SHADER_STORAGE_BARRIER_BIT) does. */
DP_API void dp_gl_mesh_topology_changed(dp_gl_mesh *mesh);

/* Where the mesh stands: world space from its own, column-major, rotation, translation and uniform
 * scale, or any affine map that does not mirror; NULL: as it is. DP_ERR_ARGUMENT. */
DP_API dp_result dp_gl_mesh_place(dp_gl_mesh *mesh, const double *matrix, dp_diag *diag);
DP_API void dp_gl_mesh_destroy(dp_gl_mesh *mesh); /* NULL allowed */

/* Drawing -------------------------------------------------------------------------------------- */

typedef struct dp_gl_target {
    uint32_t framebuffer;   /* its first draw buffer gets the picture; 0: the window's */
    int32_t x, y;           /* px: lower left corner of the picture in it */
    uint32_t width, height; /* px; 1 to what the device allows */
    uint32_t samples;       /* of each pixel: 1, 4, 8 or 16, or fewer if the device allows no more
                         (dp_gl_stats.samples); 0 means 4 */
    /* A texture (GL_TEXTURE_2D, or _MULTISAMPLE whose first sample counts) of the picture's size, as the application
     * has drawn its own things with the same camera: what is nearer there hides surfaces and lines,
     * and pixels that it covers are not painted. Depth as OpenGL's default has it: 0 near, 1 far,
     * the camera's own projection. 0: none. */
    uint32_t depth_texture;
    bool transparent; /* leaves what the framebuffer holds where no surface and no line is */
} dp_gl_target;

/* Draws meshes into the framebuffer. style NULL: all defaults.
 *
 * DP_ERR_ARGUMENT; DP_ERR_UNSUPPORTED: what this back end does not draw, by name; DP_ERR_MEMORY: the
 * device's is out; DP_ERR_LIMIT. If the context was lost: DP_ERR_IO. After an error the framebuffer
 * may hold part of the picture; the dp_gl can draw again. */
DP_API dp_result dp_gl_draw(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                            const dp_camera *camera, const dp_style *style,
                            const dp_gl_target *target, dp_diag *diag);

/* Lines ---------------------------------------------------------------------------------------- */

/* A visible piece of a line, as it lies in the buffer: 64 bytes, std430. */
typedef struct dp_gl_segment {
    float a[3];    /* end on the screen: px from the left, px from the top, depth: 1 / distance in
                          perspective, -distance in orthographic views */
    uint32_t line; /* dp_line */
    float b[3];    /* the other end */
    uint32_t triangle; /* of the picture: meshes' triangles one after the other */
    uint32_t other;    /* the triangle across; UINT32_MAX: none */
    uint32_t edge; /* 0 to 2: from that corner of `triangle` to the next; UINT32_MAX: crossing */
    uint32_t k0, k1, n; /* it is the part from k0 / n to k1 / n of the whole edge */
    uint32_t hider[2];  /* triangle that hides what comes before a, after b; UINT32_MAX: none
                           is known, UINT32_MAX - 1: nothing does, the edge ends or leaves the picture */
    uint32_t seen; /* bit 0: `triangle` is seen beside the line, bit 1: `other` is; bits 16 to 31:
                      the group of `triangle` */
} dp_gl_segment;

/* The last picture's segments on the device, for the application's own use, valid until the next call
 * that takes the dp_gl: in no order. The number of them is a uint32 in `count_buffer`, which may be
 * used as the instance count of a DrawArraysIndirectCommand that begins 4 bytes before it. */
typedef struct dp_gl_lines {
    uint32_t buffer;
    uint32_t count_buffer;
    size_t count_offset; /* bytes */
} dp_gl_lines;
DP_API dp_result dp_gl_lines_of(dp_gl *gl, dp_gl_lines *out, dp_diag *diag);

/* Reads the last picture's lines back: *segments is borrowed until the next call that takes the
 * dp_gl. In an order that does not depend on the device. dp_segment.polygon counts the polygons of all
 * meshes, as dp_source_join would. */
DP_API dp_result dp_gl_segments(dp_gl *gl, const dp_segment **segments, size_t *count,
                                dp_diag *diag);

/* Makes the last picture's lines the context's, as if dp_draw had drawn them: dp_segments, dp_send,
 * dp_trace, dp_drawing_create and the writers of pages then have them (SVG from the device). */
DP_API dp_result dp_gl_hand_over(dp_gl *gl, dp_context *context, dp_diag *diag);

/* Reads the framebuffer of a target: [height][width][4], rows from top to bottom. */
DP_API dp_result dp_gl_read(dp_gl *gl, const dp_gl_target *target, uint8_t *rgba, size_t stride,
                            dp_diag *diag);

/* Stages of a frame, in order. */
typedef enum dp_gl_stage {
    DP_GL_STAGE_VERTICES = 0, /* to the screen */
    DP_GL_STAGE_FACES,        /* the nearest polygon of each sample */
    DP_GL_STAGE_MATES,        /* half-edges meet; nothing where they are kept */
    DP_GL_STAGE_EDGES,        /* which edges are lines; where the eye must decide; crossings */
    DP_GL_STAGE_VISIBILITY,   /* what of them is seen */
    DP_GL_STAGE_SHADE,        /* G-buffer, shading, edge map */
    DP_GL_STAGE_INK,          /* strokes, or added polygons; the picture is put together */
    DP_GL_STAGE_COUNT
} dp_gl_stage;
DP_API const char *dp_gl_stage_name(dp_gl_stage stage);

typedef struct dp_gl_stats {
    uint64_t triangles, vertices;
    uint32_t samples;    /* of each pixel, that were used */
    uint64_t candidates; /* edges that may be lines */
    uint64_t segments;
    uint64_t regrown;                   /* times that a buffer was full and the stage ran again */
    uint64_t bytes;                     /* of the device, in buffers and textures */
    double stage_ms[DP_GL_STAGE_COUNT]; /* of the device, by timer queries, if `timed` */
} dp_gl_stats;

/* Of the last picture; waits for the device. */
DP_API dp_result dp_gl_stats_of(dp_gl *gl, dp_gl_stats *stats, dp_diag *diag);
/* Times the stages of the pictures from now on. Off by default. */
DP_API void dp_gl_time_stages(dp_gl *gl, bool timed);

/* The device, "llvmpipe (LLVM 15.0.6, 256 bits)" say, and the version. Borrowed. */
DP_API const char *dp_gl_device(const dp_gl *gl);

#ifdef __cplusplus
}
#endif
#endif
