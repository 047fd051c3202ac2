/* Shading: from the G-buffer to colours, one operator per style; and the passes that put all
 * together. */
#ifndef DP_SHADE_SHADE_H
#define DP_SHADE_SHADE_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"
#include "mesh/curvature.h"

/* One run of pixels of a row on its way through an operator; colours in [0, 1], planes of
 * floats. */
typedef struct dp_shade_run {
    const float *nx, *ny, *nz, *distance; /* camera space; world units */
    const float *u, *v;                   /* texture coordinates, NaN where none; or NULL */
    const uint16_t *id;
    size_t stride;           /* from row to row of the six above, below and beside may be read */
    uint32_t x, y, n;        /* px of the first pixel; how many */
    float color[3][DP_TILE]; /* in: the surface's own; out: as shaded */
    float alpha[DP_TILE];
} dp_shade_run;

/* A texture of one channel, which repeats itself in both directions. */
typedef struct dp_strokes_texture {
    const uint8_t *values;
    uint32_t width, height;
} dp_strokes_texture;

/* Half a turn is divided into so many steps. */
enum { DP_TURNS = 18 };
/* A direction on the screen, which has no sign: the step below it, and in the low byte how much of
 * the next. With pencil_printed: half a turn in 65536 parts. */
typedef uint16_t dp_turn;

/* Cosines and sines of the steps; what each of 255 parts of one of three corners weighs. */
typedef struct dp_pencil_table {
    float c[DP_TURNS], s[DP_TURNS], weight[256];
} dp_pencil_table;

/* What an operator needs to know besides. */
typedef struct dp_shading_setup {
    dp_shade shade; /* resolved; light of length 1 */
    const dp_gbuffer *g;
    dp_strokes_texture strokes;
    const uint8_t *shades; /* toon: [shade_count][4] */
    uint32_t shade_count;
    float ink[3];

    const dp_frame *frame; /* pencil: whose polygons */
    const dp_turn *turns;  /* by vertex */
    const dp_pencil_table *pencil;
    const uint8_t *powers; /* [256][256] */
    dp_strokes_texture tones[8];
    uint32_t tone_count;
    const int8_t *tooth; /* of the paper: texture/graphite.h */
} dp_shading_setup;

typedef void dp_shade_operator(const dp_shading_setup *setup, dp_shade_run *run);

/* DP_TILE pixels of a row on their way through the cartoon map; what lies one row or column beside
 * may be read. */
typedef struct dp_smooth_run {
    const uint8_t *color; /* [4]; `width` pixels from row to row */
    uint8_t *out;         /* [DP_TILE][4] */
    const uint16_t *id;   /* `stride` from row to row */
    const float *distance;
    size_t width, stride;
    float step, fy; /* neighbours of one surface are so far apart at most: pixel sizes; of which fy
                       are 1 at distance 1 */
    bool perspective;
} dp_smooth_run;

/* The operators, compiled for several kinds of processors (rows_….c); all give the same bits. They
 * work in whole strips (DP_GBUFFER_STRIP): so far rows and arrays of a run are read. */
typedef struct dp_shaders {
    uint32_t lanes;                              /* floats per vector */
    dp_shade_operator *styles[DP_SHADING_COUNT]; /* NULL: stays as it is, or is not one of these */
    dp_shade_operator
        *highlight; /* Phong's, (r·v)^50 times strength, added towards white; part of the styles */
    void (*paint)(const float rgba[4], dp_shade_run *run);  /* all in one colour */
    void (*pack)(const dp_shade_run *run, uint32_t *words); /* as pixels of four bytes; [DP_TILE] */
    void (*smooth)(const dp_smooth_run *run,
                   uint64_t pixels); /* cartoon map; where `pixels` has no bit nothing sensible */
} dp_shaders;

DP_KERNEL_TABLES(dp_shaders);

/* The built-in stroke textures: priorities (strokes.c). 256 x 256, the same every time. */
enum { DP_STROKES_SIZE = 256 };
void dp_make_hatching(uint8_t *values);
void dp_make_halftone(uint8_t *values);

/* ------- passes ------- */

/* What shading keeps from frame to frame. Zero is empty. */
typedef struct dp_shade_store {
    dp_gbuffer gbuffer;
    uint8_t *color,
        *smooth;    /* [height][width][4], not premultiplied, where the G-buffer holds a surface */
    uint8_t *shown; /* the one of the two that is shown: smooth with a cartoon map */
    uint8_t *inked; /* [height][width][4] ink of the tiles, where they ink before they are shaded */
    size_t color_cap, smooth_cap, inked_cap;
    uint8_t *hatching, *halftone;

    dp_curvature_store curvature; /* pencil: directions of least curvature */
    dp_turn *turns;               /* the same on the screen */
    uint8_t *powers;              /* of powers_of: S and O */
    float powers_of[2];
    dp_pencil_table pencil;
    uint32_t *polygon; /* the G-buffer's plane */
    uint8_t *graphite; /* [graphite_tones] textures */
    int8_t *tooth;
    size_t turns_cap, polygon_cap;
    uint32_t graphite_tones;
    const dp_shaders *shaders; /* for this processor */
    bool active;               /* this frame has a G-buffer */
    bool colored;              /* … and colours */
    dp_shading_setup setup;
    const dp_frame *frame;
    const dp_source *source; /* whose groups' colours are shown; NULL: none */
    const uint8_t *mirrored; /* [height][width][4] what pixels of DP_MIRROR_GROUP show, borrowed;
                                NULL: no mirror */
} dp_shade_store;

void dp_shade_store_free(dp_shade_store *store, const dp_allocator *memory);

/* Before the tiles. False when memory is out. */
bool dp_shade_begin(dp_shade_store *store, const dp_frame *frame);

/* Do this frame's normals have to be made? */
bool dp_shade_needs_normals(const dp_shade_store *store);

/* Once polygons are gathered: the G-buffer's memory, the pencil's vertex stage. False when memory
 * is out. */
bool dp_shade_gathered(dp_shade_store *store);

/* The shading pass over a tile, as soon as that is filled; false where it needs its neighbours and
 * so is left to the passes. */
bool dp_shade_at_once(dp_shade_store *store, uint32_t tile);

/* The passes over tiles, in order, once all tiles are filled; each is over before the next
 * begins. */
enum { DP_SHADE_PASSES = 5 };
bool dp_shade_pass_runs(const dp_shade_store *store, int pass);
void dp_shade_pass(dp_shade_store *store, int pass, uint32_t tile);
/* After a pass: what no tile can do alone. */
void dp_shade_pass_ends(dp_shade_store *store, int pass);
/* Between filling and the first pass: what no tile can do alone. */
void dp_shade_prepare(dp_shade_store *store);

#endif
