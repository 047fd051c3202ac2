/* Inside shading: what its passes keep on the device (shading.c tells the story). */
#ifndef DP_GL_SHADING_H
#define DP_GL_SHADING_H

#include "gl/gbuffer.h"

/* What all passes know: shaders/shading.glsl has the same, std140. */
typedef struct dp_gl_shading_block {
    float lens[4];        /* cx, cy, fx, fy of dp_gbuffer */
    float rotation[3][4]; /* rows xyz: world to camera space */
    float eye[4];         /* world space */
    float light[4];       /* xyz: towards it; w: highlight */
    float gooch[4];       /* blue, yellow, alpha, beta */
    float ink[4];
    float base[4];              /* the surface's colour, where nothing else has one */
    float inner[4], profile[4]; /* colours of edges */
    float strength[4];          /* inner: threshold and scale; profile: the same */
    float measure[4];   /* scale of differences of depth; sides; profile_depth; c1's slope */
    float strokes[4];   /* texture's width and height; stroke_scale; strokes on the surface: 1 */
    uint32_t counts[4]; /* shades; radius of the detector; enhanced groups; is anchored */
} dp_gl_shading_block;

/* What corners carry, of all meshes of the picture. */
typedef struct dp_gl_scene_attributes {
    dp_gl_buffer normals;   /* [3 * triangle] uvec2: x, y, z, times 32767, 16 bits each */
    dp_gl_buffer texcoords; /* [3 * triangle] vec2 */
    dp_gl_buffer colors;    /* [vertex] 0xRRGGBBAA; 0: none */
    dp_gl_buffer groups;    /* [group] 0xRRGGBBAA */
    bool has_texcoords, has_colors;
    uint64_t key[3]; /* what they were made of; 0: nothing, or of what may change any time */
} dp_gl_scene_attributes;

struct dp_gl_shading {
    dp_gl_gbuffer gbuffer;
    dp_gl_shading_block block;
    dp_gl_buffer block_buffer;
    dp_gl_scene_attributes attributes;
    dp_gl_buffer range;      /* near and far of the enhanced groups (edge_map.c) */
    dp_gl_buffer enhanced;   /* [group] 0 or 1 */
    dp_gl_buffer shades;     /* toon: RGBA8 each */
    dp_gl_buffer anchors;    /* dp_hatch_anchor */
    dp_gl_texture strokes;   /* R8: the built-in ones, or the style's */
    int strokes_of;          /* dp_shading whose built-in ones they are; -1: the style's own */
    dp_gl_texture color;     /* RGBA8: as shaded */
    dp_gl_texture smooth;    /* RGBA8: the cartoon map */
    dp_gl_texture intensity; /* RG32F: I_N; I_Z, or what C1 has added up */
    dp_gl_texture edge_map;  /* RGBA16: inner edges in RGB, profile edges in A; 1: none */
    dp_gl_texture edged;     /* RGBA8: colours with edges over them */
    uint32_t framebuffer;    /* of passes over pixels */
    uint32_t second;         /* of the second pass over the model */
    const dp_gl_texture *mirrored; /* shown by pixels of DP_MIRROR_GROUP; NULL: no mirror */
};

/* shading.c: does the picture's style need a G-buffer? */
bool dp_gl_is_shaded(const dp_gl *gl);
/* gl->shading, made when first used. */
dp_result dp_gl_need_shading(dp_gl *gl, dp_diag *diag);

/* attributes.c: gathers what this style needs of the meshes' attributes. */
dp_result dp_gl_gather_attributes(dp_gl *gl, bool textured, bool colored, dp_diag *diag);
/* Rows of the matrix that turns normals as the mesh stands: the cofactors of that which turns positions. */
void dp_gl_turn_of(const dp_gl_mesh *mesh, double rows[3][3]);
void dp_gl_attributes_free(dp_gl *gl, dp_gl_scene_attributes *attributes);

/* edge_map.c: the range of distances that maps as printed, and 8 bits, are measured in: the last pass reads it, too, also where
 * the map is hidden. */
dp_result dp_gl_fit_edge_map(dp_gl *gl, dp_diag *diag);
/* The G-buffer → edge map; its edges over `from` → s->edged, in a second pass over the model. */
dp_result dp_gl_make_edge_map(dp_gl *gl, dp_diag *diag);
dp_result dp_gl_apply_edge_map(dp_gl *gl, const dp_gl_texture *from, dp_diag *diag);

#endif
