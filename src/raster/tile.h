/* One tile of the screen while a worker holds it: its polygons and its samples.
 *
 * Everything here is thrown away with the tile; only memory stays with the worker. Coordinates are
 * px from the tile's corner ("tile space") unless said otherwise. Depth d is larger when nearer. */
#ifndef DP_RASTER_TILE_H
#define DP_RASTER_TILE_H

#include "core/frame.h"
#include "core/outline.h"
#include "raster/samples.h"

/* px: an edge further away from the tile has no sample point in it (the lift is far less). */
#define DP_BESIDE 0.5f

enum { DP_BLOCK = 4 /* px; culling compares blocks of pixels */ };

enum {
    DP_POLYGON_FRONT = 1,   /* faces the eye */
    DP_POLYGON_EDGE_ON = 2, /* covers nothing; counts as back-facing */
    DP_POLYGON_CLIPPED = 4, /* its points are not its corners any more */
    DP_POLYGON_TOUCHES = 8, /* reaches the tile itself, not only its margin */
    DP_POLYGON_HIDDEN = 16, /* well behind the surface everywhere (cull.c) */
    DP_POLYGON_NEAR =
        32 /* of a triangle: edge 0 comes near the tile; the next two bits: edges 1 and 2 */
};

/* A polygon of the tile. */
typedef struct dp_tile_polygon {
    uint32_t id;    /* in the frame */
    uint32_t point; /* first of its points */
    union {
        struct {
            uint8_t x0, y0, x1, y1; /* pixels it may cover: inclusive, clamped to the tile */
        };
        uint8_t box[4];
    };
    uint32_t flags : 8;
    uint32_t points : 24; /* number of points */
    float nearest;        /* largest d of its points */
    float d0, dx, dy;     /* plane: d = d0 + dx * x + dy * y */
} dp_tile_polygon;

_Static_assert(sizeof(dp_tile_polygon) == 32, "raster/assemble.inc writes it as two vectors");

/* normals[i][3] of a back face, and its whole normal, where no back face is seen. */
#define DP_AWAY 2
static const float dp_away[4] = {0, 0, 0, DP_AWAY};

/* normals[i][3] of a back face in a tile where some are seen: its normal is turned to the eye. */
#define DP_TURNED 1

/* normals[i][3] of a back face where hidden lines are looked for (dp_tile_complete): its normal is
 * as it is wound. */
#define DP_BACK (-1)

/* normals[i][3] of a front face whose normal is unsure. Rough: right to DP_ROUGH_ANGLE, enough to
 * tell that a vertex is flat; to be made again if one of its edges is listed. Unknown: not made
 * yet. */
#define DP_ROUGH       3
#define DP_UNKNOWN     4
#define DP_ROUGH_ANGLE 2.5 /* degrees */

/* Samples to whose depth a polygon came close while faces were drawn (near_depth.c), as arrays with
 * room for one vector beyond the last. */
enum { DP_CLOSE_FULL = DP_TILE * 16 }; /* samples in a row of the tile, or in a narrow box */
enum { DP_CLOSE_ROOM = 2 * DP_CLOSE_FULL + 16 };
typedef struct dp_close_samples {
    uint32_t polygon[DP_CLOSE_ROOM];                /* tile polygon that was drawn */
    uint32_t other[DP_CLOSE_ROOM];                  /* tile polygon that held the sample then */
    uint32_t lane[DP_CLOSE_ROOM];                   /* the sample */
    float depth[DP_CLOSE_ROOM], gap[DP_CLOSE_ROOM]; /* of `polygon`; to the depth of `other` */
    uint32_t count;
} dp_close_samples;

/* Depth of the furthest sample in ranges of (1 + sx) × (1 + sy) blocks of pixels with first block
 * (bx, by) (cull.c). A ring of blocks around the tile stands for the strip; block [1][1] is the
 * first in the tile. */
enum { DP_BLOCKS = DP_TILE / DP_BLOCK, DP_RINGED = DP_BLOCKS + 2 };
enum { DP_SPANS = 3 };
typedef float dp_farthest[DP_SPANS][DP_SPANS][DP_RINGED][DP_RINGED]; /* [sy][sx][by][bx] */

/* Depth of front faces half a pixel outside the tile: left, right, above and below it, at one and
 * at three quarters of each pixel. */
enum { DP_STRIP_SIDES = 4, DP_STRIP = 2 * DP_TILE };
typedef float dp_strip[DP_STRIP_SIDES][DP_STRIP];

/* Words stored consecutively for all seen polygons: box, flags and `nearest` of the records, and
 * the keys of triangles. */
enum {
    DP_SEEN_BOX,
    DP_SEEN_FLAGS,
    DP_SEEN_NEAREST,
    DP_SEEN_KEYS,
    DP_SEEN_MEMBERS = DP_SEEN_KEYS + 3,
    DP_SEEN_ROOM = 16
};

/* A worker's tile. Its memory is kept from tile to tile and from frame to frame. */
typedef struct dp_tile {
    const dp_frame *frame;
    dp_sampling sampling;
    dp_allocator memory;
    bool failed; /* out of memory: the tile is abandoned */

    bool tests_near_depth; /* note close samples while faces are drawn, for intersections */
    const uint64_t *away;  /* a bit per sample that holds something which is no polygon of this
                              tile: does that face away? NULL: there are no such samples (only
                              src/stream has them) */
    dp_block block;        /* where the samples of a block lie */

    uint32_t index;          /* of the tile in the frame */
    uint32_t tile_x, tile_y; /* px: the tile's corner on the screen */
    dp_farthest farthest;
    dp_strip strip;
    float *depth;     /* by sample */
    uint32_t *winner; /* by sample: tile polygon; UINT32_MAX: none */

    uint32_t *ids, *backs; /* frame polygons of the tile; backs: triangles that face away */
    uint32_t *culled;      /* for hidden lines: those of the latter that lie hidden */
    dp_tile_polygon *polygons;
    bool finds_edges;         /* by the edge table: normals are wanted */
    float plane_normal[3][3]; /* turns a plane's d0 (orthographic: -1), dx, dy into its normal */
    float (*normals)[4];      /* by polygon: x, y, z; and 0, DP_TURNED, DP_BACK, DP_AWAY, DP_ROUGH
                                 or DP_UNKNOWN */
    uint32_t *unsure;         /* front faces whose normals are to be made */
    dp_vertex *points;        /* tile space; key: of the corner's position, unless the polygon is
                            clipped */
    uint32_t *keys;           /* key of corner k of triangle i at k * keys_stride + i */
    uint32_t *seen;           /* numbers of polygons that are not hidden, ascending */
    uint32_t *seen_words;     /* see dp_seen_words */
    dp_color *colors;         /* of surfaces, where groups have their own (surface.c) */
    size_t colors_cap;
    size_t winner_cap, ids_cap, backs_cap, culled_cap, polygons_cap, normals_cap, unsure_cap,
        points_cap, keys_cap, seen_cap, seen_words_cap;
    uint32_t won;     /* not 0: a sample was won since it was last set to 0 */
    bool sees_backs;  /* some back face is seen, in the tile or in the strip around it */
    uint32_t undrawn; /* back faces among this many first polygons are not drawn yet */
    uint32_t keys_stride, seen_stride;
    uint32_t polygon_count, point_count, seen_count, unsure_count, culled_count;

    dp_close_samples close; /* to be tested */
    /* pixels where two front faces may cross; where a front and a back face may */
    uint64_t candidate_pixels[2][DP_TILE];
    dp_outline_scratch scratch; /* for one polygon */
    dp_stats stats;
} dp_tile;

/* Grows an array of `object` with the tile's memory. The tile remembers a failure. */
#define DP_TILE_RESERVE(tile, object, array, capacity, need)                                       \
    ((need) <= (object)->capacity ||                                                               \
     dp_reserve(&(tile)->memory, &(object)->array, &(object)->capacity, (need),                    \
                sizeof *(object)->array) ||                                                        \
     !((tile)->failed = true))

/* `init`: before a frame's first tile; false: out of memory. `free` frees all memory, `bytes`
 * counts it (tile.c). */
bool dp_tile_begin(dp_tile *tile, const dp_frame *frame);
void dp_tile_free(dp_tile *tile);
uint64_t dp_tile_bytes(const dp_tile *tile);

/* Says which tile it is, and where. */
void dp_tile_place(dp_tile *tile, uint32_t index);

/* Starts with tile number `index`: no sample has a winner; depth stays as it is (tile.c). */
void dp_tile_open(dp_tile *tile, uint32_t index);

/* The stages, each in its own file. */
void dp_tile_assemble(dp_tile *tile);          /* assemble.c: draws faces except … */
void dp_tile_find_farthest(dp_tile *tile);     /* cull.c */
void dp_tile_faces(dp_tile *tile);             /* cull.c: … some back faces, which this draws */
bool dp_tile_see(dp_tile *tile, bool culling); /* cull.c: lists what is not hidden, or all */
/* assemble.c: makes the polygons that were culled as well, and lists all as seen, when the tile's
 * surface is done. No sample changes. False: out of memory. */
bool dp_tile_complete(dp_tile *tile);
void dp_tile_surface(dp_tile *tile); /* surface.c */
void dp_tile_empty_surface(dp_tile *tile);

/* Pixel sizes: what is further behind the surface than this is well behind it (cull.c). */
#define DP_CULL_SLACK 6

/* Does the surface hide everything in this box of tile space? `nearest`: its largest d (cull.c). */
bool dp_tile_hides(const dp_tile *tile, float x0, float y0, float x1, float y1, float nearest);

/* The same for a polygon's box. */
bool dp_tile_is_hidden(const dp_tile *tile, const dp_tile_polygon *polygon);

/* Does edge i of a polygon come within `reach` px of the tile? A polygon that is not clipped has an
 * edge between any two consecutive points. */
static inline bool dp_tile_edge_reaches(const dp_tile *w, const dp_tile_polygon *p, uint32_t i,
                                        float reach) {
    if (p->flags & DP_POLYGON_CLIPPED) return true;
    const dp_vertex a = w->points[p->point + i],
                    b = w->points[p->point + (i + 1 == p->points ? 0 : i + 1)];
    return dp_maxf(a.x, b.x) >= -reach && dp_minf(a.x, b.x) <= DP_TILE + reach &&
           dp_maxf(a.y, b.y) >= -reach && dp_minf(a.y, b.y) <= DP_TILE + reach;
}

/* Does edge i come near the tile? If not, its sample points are other tiles'. */
static inline bool dp_tile_edge_is_near(const dp_tile *w, const dp_tile_polygon *p, uint32_t i) {
    if (p->points == 3 && !(p->flags & DP_POLYGON_CLIPPED))
        return p->flags & (uint32_t)DP_POLYGON_NEAR << i;
    return dp_tile_edge_reaches(w, p, i, DP_BESIDE);
}

/* Make the normal of one polygon in float64, or of all seen polygons; false: out of memory
 * (normals.c). */
void dp_tile_exact_normal(dp_tile *tile, uint32_t polygon);
bool dp_tile_exact_normals(dp_tile *tile);

/* Make the normals of seen back faces, turned to the eye (normals.c). */
void dp_tile_turn_normals(dp_tile *tile);

/* Make those of all seen polygons as they are wound (normals.c). */
bool dp_tile_wound_normals(dp_tile *tile);

/* Makes triangle `index` again in the general way. Draws it if it is a front face or, when `backs`,
 * a back face that is not hidden (assemble.c). */
void dp_tile_reassemble(dp_tile *tile, uint32_t index, bool backs);

/* Marks the pixels of close samples where planes cross as candidate pixels, and empties the list
 * (near_depth.c). At most DP_CLOSE_FULL samples may be listed before a narrow box, or a row of
 * another, is drawn. */
void dp_tile_test_near_depth(dp_tile *tile);

/* How many corner positions two polygons share. Positions are compared by their keys, which are
 * hashes: a false match loses one crossing in four thousand million (near_depth.c). */
uint32_t dp_shared_corners(const dp_frame *frame, uint32_t a, uint32_t b);

/* On candidate pixels, by rows: drop those without a neighbour; add neighbours, false if there are
 * no pixels (near_depth.c). */
void dp_drop_lone(uint64_t candidate_pixels[DP_TILE]);
bool dp_widen(const uint64_t pixels[DP_TILE], uint64_t out[DP_TILE]);

/* A bit for each pixel column that a polygon's box covers. */
static inline uint64_t dp_box_span(const dp_tile_polygon *polygon) {
    return (~(uint64_t)0 >> (63 - (polygon->x1 - polygon->x0))) << polygon->x0;
}

/* Member DP_SEEN_… of all seen polygons, with room for a vector beyond the last. */
static inline uint32_t *dp_seen_words(const dp_tile *w, uint32_t member) {
    return w->seen_words + (size_t)member * w->seen_stride;
}

/* Does a polygon cover a point of the tile? Of two polygons that share an edge, exactly one does
 * (tile.c). */
bool dp_tile_covers(const dp_tile *tile, const dp_tile_polygon *polygon, float x, float y);

/* Is the polygon part of the surface that is painted and hides? `reach`: DP_POLYGON_TOUCHES, or 0
 * for those beside the tile too. */
static inline bool dp_is_painted(const dp_tile *tile, const dp_tile_polygon *p, uint32_t reach) {
    if ((p->flags & (reach | DP_POLYGON_EDGE_ON)) != reach) return false;
    return p->flags & DP_POLYGON_FRONT || !dp_polygon_style(tile->frame, p->id)->cull_back_faces;
}

/* Does the polygon belong to the surface that is painted and hides, in this tile? */
static inline bool dp_is_surface(const dp_tile *tile, const dp_tile_polygon *p) {
    return dp_is_painted(tile, p, DP_POLYGON_TOUCHES);
}

/* Change of depth d over `px` pixel sizes along the line of sight, in float32 (dp_depth_step). */
static inline float dp_depth_steps(const dp_frame *frame, float d, float px) {
    return px * (fabsf(d) * frame->step_scale + frame->step_offset);
}

/* A crossing is looked for within this many px of a sample, which reaches beyond the next
 * sample; … */
static inline float dp_near_depth_px(const dp_tile *w) {
    return w->sampling.samples == 1 ? 1.5f : 0.75f;
}

/* … or where the gap in depth is less than this many pixel sizes, as the other polygon may be the
 * steep one. */
#define DP_NEAR_DEPTH_GAP 8

/* A sample this close in depth to a plane may belong to a polygon that crosses it. */
static inline float dp_near_depth_reach(const dp_tile *w, float dx, float dy, float nearest) {
    return dp_near_depth_px(w) * (fabsf(dx) + fabsf(dy)) +
           dp_depth_steps(w->frame, nearest, DP_NEAR_DEPTH_GAP);
}

/* The depth of a polygon's plane at a point of tile space. */
static inline float dp_plane_at(const dp_tile_polygon *polygon, float x, float y) {
    return polygon->d0 + polygon->dx * x + polygon->dy * y;
}

#endif
