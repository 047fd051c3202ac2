/* Shading: from the G-buffer to colours, one operator per style, and the passes around it
 * (Nienhaus and Döllner 2003, 5; the passes are listed in passes.c). */
#ifndef DP_SHADE_SHADE_H
#define DP_SHADE_SHADE_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"
#include "mesh/curvature.h"

/* What an operator works on: a run of pixels of one row. Colours in [0, 1], in planes. */
typedef struct dp_shade_run {
    const float *nx, *ny, *nz, *distance; /* camera space; world units */
    const float *u, *v;                   /* texture coordinates, NaN where none; or NULL */
    const uint16_t *id;
    size_t stride;           /* from row to row of these; rows and columns around may be read */
    uint32_t x, y, n;        /* first pixel, px; number of pixels */
    float color[3][DP_TILE]; /* in: the surface's colour; out: as shaded */
    float alpha[DP_TILE];
} dp_shade_run;

/* A texture of one channel, tiled in both directions. */
typedef struct dp_strokes_texture {
    const uint8_t *values;
    uint32_t width, height;
} dp_strokes_texture;

/* By how many texels strokes are moved, along u and v, so that they stick to world space and not to
 * the origin of positions: by axis of the surface, u or v, and exponent of the scale, as a float has
 * it. */
typedef float dp_hatch_anchor[3][2][256];
/* Strokes on surfaces are turned, so that no axis lies along them. */
#define DP_HATCH_COSINE 0.8f
#define DP_HATCH_SINE   0.6f

/* Steps of half a turn. */
enum { DP_TURNS = 18 };
/* A direction on the screen, without sign: the step below it (high byte), and how much of the next
 * step (low byte). With pencil_printed: half a turn in 65536 parts. */
typedef uint16_t dp_turn;

/* Cosines and sines of the steps; weight[i]: i / 255 of one of three corners. */
typedef struct dp_pencil_table {
    float c[DP_TURNS], s[DP_TURNS], weight[256];
} dp_pencil_table;

/* What an operator reads besides; all borrowed. */
typedef struct dp_shading_setup {
    dp_shade shade; /* resolved; light of length 1 */
    const dp_gbuffer *g;
    dp_strokes_texture strokes;
    const dp_hatch_anchor *anchor; /* hatch, halftone; NULL: world space is that of positions */
    const uint8_t *shades;         /* toon: [shade_count][4] */
    uint32_t shade_count;
    float ink[3], ink_alpha;

    /* pencil */
    const dp_frame *frame; /* its polygons */
    const dp_turn *turns;  /* [vertex] */
    const dp_pencil_table *pencil;
    const uint8_t *powers; /* [256][256]: dp_make_powers */
    dp_strokes_texture tones[8];
    uint32_t tone_count;
    const int8_t *tooth; /* the paper's: texture/graphite.h */
} dp_shading_setup;

typedef void dp_shade_operator(const dp_shading_setup *setup, dp_shade_run *run);

/* What the cartoon map works on: DP_TILE pixels of a row. Rows and columns beside may be read. */
typedef struct dp_smooth_run {
    const uint8_t *color; /* [4]; `width` pixels from row to row */
    uint8_t *out;         /* [DP_TILE][4] */
    const uint16_t *id;   /* `stride` from row to row */
    const float *distance;
    size_t width, stride;
    float step; /* pixel sizes: neighbours of one surface differ by no more in distance */
    float fy;   /* pixel sizes per world unit at distance 1 */
    bool perspective;
} dp_smooth_run;

/* The operators, compiled for each width of vectors (kernels.c); all give the same bits. They read
 * a run's rows and arrays in whole strips (DP_GBUFFER_STRIP). */
typedef struct dp_shaders {
    uint32_t lanes;                              /* floats per vector */
    dp_shade_operator *styles[DP_SHADING_COUNT]; /* NULL: none (flat, paper), or pencil */

    /* Phong's highlight, strength (r·v)^50 towards white; the styles call it. */
    dp_shade_operator *highlight;
    /* All pixels in one colour. */
    void (*paint)(const float rgba[4], dp_shade_run *run);
    /* To pixels of four bytes, words[DP_TILE]. */
    void (*pack)(const dp_shade_run *run, uint32_t *words);
    /* Cartoon map. Where `pixels` has no bit, the output is arbitrary. */
    void (*smooth)(const dp_smooth_run *run, uint64_t pixels);
} dp_shaders;

DP_KERNEL_TABLES(dp_shaders);

/* The built-in stroke textures: priorities, [256][256], always the same (strokes.c). */
enum { DP_STROKES_SIZE = 256 };
void dp_make_hatching(uint8_t *values);
void dp_make_halftone(uint8_t *values);

/* The built-in shades of toon, from N·L = -1 to 1 (passes.c). */
enum { DP_TOON_SHADES = 8 };
extern const uint8_t dp_toon_shades[DP_TOON_SHADES][4];

/* Where world space begins elsewhere than positions do, at `origin`, not 0: what that moves a texture of
 * this size by (passes.c). */
void dp_anchor_strokes(const double origin[3], uint32_t width, uint32_t height,
                       dp_hatch_anchor *out);

/* ------- passes ------- */

/* What pencil rendering keeps (pencil.c). Zero is empty. */
typedef struct dp_pencil_store {
    dp_curvature_store curvature; /* directions of least curvature */
    dp_turn *turns;               /* the same on the screen, by vertex */
    uint32_t *polygon;            /* the G-buffer's plane */
    uint8_t *powers;              /* of powers_of: S and O */
    uint8_t *graphite;            /* [tones] textures */
    int8_t *tooth;
    size_t turns_cap, polygon_cap, powers_cap, graphite_cap, tooth_cap;
    float powers_of[2];
    uint32_t tones; /* 0: none are made */
    dp_pencil_table table;
} dp_pencil_store;

/* What shading keeps from frame to frame. Zero is empty. */
typedef struct dp_shade_store {
    dp_gbuffer gbuffer;
    uint8_t *color;  /* [height][width][4], not premultiplied; set where there is a surface */
    uint8_t *smooth; /* the same, of the cartoon map */
    uint8_t *shown;  /* smooth with a cartoon map, else color */
    uint8_t *
        edges; /* [height][width][4] takes the edge map's edges, as ink; borrowed; NULL: they go over
                        `shown` */
    uint8_t *inked; /* [height][width][4] ink of the tiles that ink before shading */
    size_t color_cap, smooth_cap, inked_cap;
    uint8_t *hatching, *halftone; /* built-in textures, made when first used */
    size_t hatching_cap, halftone_cap;
    dp_hatch_anchor anchor;
    dp_pencil_store pencil;
    const dp_shaders *shaders; /* for this processor */
    bool active;               /* this frame has a G-buffer */
    bool colored;              /* this frame is shaded or has edges */
    bool model_colors;         /* some group has the model's */
    dp_shading_setup setup;
    const dp_frame *frame;
    const dp_source *source; /* of the groups' colours; NULL: none */
    const uint8_t *mirrored; /* [height][width][4] picture in the mirror, shown by pixels of
                                DP_MIRROR_GROUP; borrowed; NULL: no mirror */
} dp_shade_store;

void dp_shade_store_free(dp_shade_store *store, const dp_allocator *memory);
uint64_t dp_shade_store_bytes(const dp_shade_store *store);

/* Begins a frame, before the tiles. False when memory is out. */
bool dp_shade_begin(dp_shade_store *store, const dp_frame *frame);

/* Must this frame's normals be computed? Are the model's wanted, which some batches may lack? */
bool dp_shade_needs_normals(const dp_shade_store *store);
bool dp_shade_uses_model_normals(const dp_shade_store *store);

/* After polygons are gathered: allocates the G-buffer, runs the pencil's vertex stage. False when
 * memory is out. */
bool dp_shade_gathered(dp_shade_store *store);

/* Shades a tile right after it is filled; false if the style needs other tiles, and the passes
 * shade it later. */
bool dp_shade_at_once(dp_shade_store *store, uint32_t tile);

/* The passes over tiles, in order, after all tiles are filled. Each ends before the next begins. */
enum { DP_SHADE_PASSES = 5 };
bool dp_shade_pass_runs(const dp_shade_store *store, int pass);
void dp_shade_pass(dp_shade_store *store, int pass, uint32_t tile);
/* After each pass, once: what reaches over all tiles. */
void dp_shade_pass_ends(dp_shade_store *store, int pass);
/* Before the first pass, once: what reaches over all tiles. */
void dp_shade_prepare(dp_shade_store *store);

#endif
