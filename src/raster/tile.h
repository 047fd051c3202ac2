/* One screen tile while a worker holds it: its polygons, samples, edges, lines and sample points.
 *
 * Everything here is thrown away with the tile; only memory stays with the worker. Coordinates are
 * px from the tile's corner ("tile space") unless said otherwise. */
#ifndef DP_RASTER_TILE_H
#define DP_RASTER_TILE_H

#include "core/frame.h"
#include "core/outline.h"
#include "raster/samples.h"
#include "core/spine.h"

/* Edges further than this from the tile hold no sample point of it (px; the lift is far less). */
#define DP_BESIDE 0.5f

enum { DP_BLOCK = 4 /* px; culling looks at blocks of pixels */ };

enum {
    DP_POLYGON_FRONT = 1,   /* faces the eye */
    DP_POLYGON_EDGE_ON = 2, /* covers nothing; counts as back-facing */
    DP_POLYGON_CLIPPED = 4, /* its points are not its corners any more */
    DP_POLYGON_TOUCHES = 8, /* its points reach the tile itself, not only its margin */
    DP_POLYGON_HIDDEN = 16, /* lies well behind the surface everywhere (cull.c) */
    DP_POLYGON_NEAR =
        32 /* of a triangle: its first edge comes near the tile; two bits more for the others */
};

/* A polygon of the tile. */
typedef struct dp_tile_polygon {
    uint32_t id;    /* in the frame */
    uint32_t point; /* first of its points */
    union {
        struct {
            uint8_t x0, y0, x1, y1; /* pixels it may cover, inclusive, clamped to the tile */
        };
        uint8_t box[4];
    };
    uint32_t flags : 8;
    uint32_t points : 24; /* how many */
    float nearest;        /* largest d of its points */
    float d0, dx, dy;     /* its plane: d = d0 + dx * x + dy * y */
} dp_tile_polygon;

_Static_assert(sizeof(dp_tile_polygon) == 32, "raster/assemble.inc writes it as two vectors");

/* Edges of seen polygons, each member for itself, with room for one vector beyond the last. */
typedef struct dp_edge_list {
    uint32_t *polygon, *edge; /* tile polygon; number of the corner that the edge starts from */
    uint32_t *from;           /* that corner's key */
    uint32_t *name;           /* exclusive or of the keys of both ends */
    size_t polygon_cap, edge_cap, from_cap, name_cap;
    uint32_t count;
} dp_edge_list;

enum { DP_EDGES_ROOM = 16 };

/* A slot of the tile's table of edges (edge_table.c): an edge's name, and above it which of the
 * list met there. 0: the slot is free; else 1 + an edge that is alone, or DP_SLOT_PAIR + number of
 * a pair, and DP_SLOT_MORE. */
typedef uint64_t dp_edge_slot;

#define DP_SLOT_PAIR   (1u << 31)
#define DP_SLOT_MORE   (1u << 30) /* there are meetings beyond the second */
#define DP_SLOT_NUMBER (DP_SLOT_MORE - 1)

/* Of an edge that may be a line: no second polygon met it; others did. */
enum { DP_MARK_ALONE = 1, DP_MARK_PAIR };

/* A third or later polygon at an edge. */
typedef struct dp_meeting {
    uint32_t first,
        number;    /* of the edge in the list, as the first polygon and as this one has it */
    uint32_t next; /* 1 + meeting, 0: none */
} dp_meeting;

/* What stands for the normals of back faces. */
#define DP_AWAY 2
static const float dp_away[4] = {0, 0, 0, DP_AWAY};

/* In the same place of front faces: their normals are to be made again. Some are right to
 * DP_ROUGH_ANGLE, which is enough where their edges are not listed; others not at all. */
#define DP_ROUGH       3
#define DP_UNKNOWN     4
#define DP_ROUGH_ANGLE 2.5 /* degrees */

/* The triangles around a vertex (find/umbrellas.inc): of their normals' components, times
 * DP_UMBRELLA_ONE, and of what these are less, the least; and a sum that tells whether they
 * surround it. */
typedef struct dp_umbrella {
    int16_t least[6]; /* x, -x, y, -y, z, -z */
    uint32_t open;
} dp_umbrella;

_Static_assert(sizeof(dp_umbrella) == 16, "find/umbrellas.inc takes it for a vector");

/* So many bytes of them, or more, are too much for the second-level cache. */
enum { DP_UMBRELLAS_FAR = DP_TUNED(1 << 19, 1 << 10) };

#define DP_UMBRELLA_BYTE   0x7f       /* all bytes of an empty one */
#define DP_UMBRELLA_CLOSED 0x7f7f7f7f /* its `open` */
#define DP_UMBRELLA_ONE    8192
enum { DP_UMBRELLA_NONE = INT16_MAX };
enum { DP_UMBRELLA_BACKS = 15 /* so many back faces, or fewer, are counted */ };
#define DP_UMBRELLA_BACK         0x9e3779b1u /* each adds this to `open` */
#define DP_UMBRELLA_BACK_INVERSE 0xe8b2f51u  /* times that: 1 */

/* What segments along a candidate's spine are made of (strokes/segments.c). */
typedef struct dp_bones {
    dp_pointd a, b;    /* the spine's ends */
    dp_vec3 normal[2]; /* of the candidate's polygons; unit */
} dp_bones;

/* A line that may be visible: its spine's part in this tile is to be probed. */
typedef struct dp_candidate {
    uint32_t a, b;   /* frame polygons: owner, partner or UINT32_MAX */
    uint32_t edge;   /* corner of the owner, or DP_CROSSING */
    uint32_t n;      /* sample points on the whole spine */
    uint32_t k0, k1; /* those in this tile: [k0, k1) */
    uint32_t probe;  /* first of its probes */
    uint32_t line : 8;
    uint32_t bones : 24; /* 1 + number of the worker's; 0: they are to be found again */
} dp_candidate;

/* Sample points of spines (px, d), each member for itself, with room for one vector beyond the
 * last. A point is hidden when a polygon other than its candidate's own lies nearer than its limit,
 * which is infinite from then on. */
typedef struct dp_probes {
    float *x, *y, *limit;
} dp_probes;

enum { DP_PROBES_ROOM = 16 };

/* Some of a candidate's sample points, one after the other. */
typedef struct dp_probe_group {
    uint32_t first, count, candidate;
} dp_probe_group;

enum { DP_GROUP = 16 /* points, or fewer */ };

/* Of a pixel: a byte holds where in the tile a point lies. */
enum { DP_QUARTERS = 4 * DP_TILE };
_Static_assert(DP_QUARTERS <= 256, "as many as a byte has values");

/* Cells of the tile for a first look at where sample points are. */
enum {
    DP_CELL = 4 /* px */,
    DP_CELLS = DP_TILE / DP_CELL,
    DP_CELL_SPANS = 3,
    DP_CELL_SMALL = 9, /* px; boxes that are less wide and high than this span so many or fewer */
    DP_CELL_ROOM = DP_CELLS * (DP_CELLS + DP_CELL_SPANS) + 16
};

/* All groups of the tile's sample points, sorted by the cell of their boxes' upper left corner;
 * each member for itself, with room for one vector beyond the last. */
typedef struct dp_probe_groups {
    dp_probe_group *group;
    uint32_t *box; /* where its points lie: x0, y0, 255 - x1, 255 - y1 in quarters of a pixel, from
                      the lowest byte on, so that one comparison of bytes tells whether two meet */
    float *limit;  /* the least of its points' */
    size_t group_cap, box_cap, limit_cap;
    uint32_t first[DP_CELLS * DP_CELLS + 1]; /* by cell */
    uint32_t width, height; /* of the largest boxes, from the first quarter to the last */
    /* the least limit in 1 + sx times 1 + sy cells, the first of which is cx, cy; infinite where
     * there are no points */
    float least[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */
} dp_probe_groups;

/* Polygons around pixels where faces may cross (intersect.c), sorted by the first row of their
 * boxes. */
typedef struct dp_crowd {
    uint32_t *polygon;
    float *members; /* DP_CROWD_…, px (tile space) and d, `stride` floats from one to the next */
    uint32_t *keys; /* of triangles' corners, by corner, `stride` from one to the next; what belongs
                       to no other: none */
    uint32_t *met;  /* those that one of them may cross */
    uint32_t *listed; /* before they are sorted */
    size_t polygon_cap, members_cap, keys_cap, met_cap, listed_cap;
    uint32_t count, stride;
} dp_crowd;

enum {
    DP_CROWD_LEAST,       /* x, y, d of the bounds */
    DP_CROWD_MOST = 3,    /* the same */
    DP_CROWD_PLANE = 6,   /* d0, dx, dy; d0 is NaN of all but triangles as they were given,
                             seen from a side */
    DP_CROWD_CORNERS = 9, /* of such triangles: x, y, d of each */
    DP_CROWD_MEMBERS = 18
};
enum { DP_CROWD_ROOM = 16 };

/* What is around suspects in 1 + sx times 1 + sy cells, the first of which is cx, cy. */
enum { DP_NEAR_FRONT = 1 /* for front faces */, DP_NEAR_BACK = 2 };
typedef uint32_t dp_cell_bits[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */

/* Samples to whose depth a polygon came close while faces were drawn (intersect.c), each member for
 * itself, with room for one vector beyond the last. */
enum {
    DP_CLOSE_FULL = DP_TILE * 16 /* as many as a row of the tile, or a narrow box, has samples */
};
enum { DP_CLOSE_ROOM = 2 * DP_CLOSE_FULL + 16 };
typedef struct dp_close_samples {
    uint32_t polygon[DP_CLOSE_ROOM];                /* of the tile, which is drawn */
    uint32_t other[DP_CLOSE_ROOM];                  /* the sample's winner till then */
    uint32_t lane[DP_CLOSE_ROOM];                   /* the sample */
    float depth[DP_CLOSE_ROOM], gap[DP_CLOSE_ROOM]; /* of `polygon`; how far from `other`'s */
    uint32_t count;
} dp_close_samples;

/* Points in lists by the tile's pixels. */
typedef struct dp_pixel_lists {
    uint64_t row[DP_TILE];            /* pixels that hold any */
    uint32_t head[DP_TILE * DP_TILE]; /* first of a pixel; valid where `row` has its bit */
} dp_pixel_lists;

/* A polygon's edge that the table leaves to emerge. */
typedef struct dp_loose_edge {
    uint32_t polygon, edge; /* tile polygon, corner */
} dp_loose_edge;

/* Depth of the furthest sample of 1 + sx times 1 + sy blocks of pixels, the first of which is bx,
 * by (cull.c). Around the tile's blocks lies a ring, of the strip: block [1][1] is the tile's
 * first. */
enum { DP_BLOCKS = DP_TILE / DP_BLOCK, DP_RINGED = DP_BLOCKS + 2 };
enum { DP_SPANS = 3 };
typedef float dp_farthest[DP_SPANS][DP_SPANS][DP_RINGED][DP_RINGED]; /* [sy][sx][by][bx] */

/* Depth of the front faces half a pixel beyond the tile: on the left, right, above and below it, at
 * a quarter and at three quarters of each pixel. */
enum { DP_STRIP_SIDES = 4, DP_STRIP = 2 * DP_TILE };
typedef float dp_strip[DP_STRIP_SIDES][DP_STRIP];

/* What is wanted of all seen polygons one after the other: box, flags and `nearest` of the records,
 * keys of triangles. */
enum {
    DP_SEEN_BOX,
    DP_SEEN_FLAGS,
    DP_SEEN_NEAREST,
    DP_SEEN_KEYS,
    DP_SEEN_MEMBERS = DP_SEEN_KEYS + 3,
    DP_SEEN_ROOM = 16
};

struct dp_tile_worker {
    const dp_frame *frame;
    dp_sampling sampling;
    dp_allocator memory;
    bool failed; /* out of memory: the tile is abandoned */

    bool watching; /* for intersections, while faces are drawn */
    const uint64_t
        *away; /* a bit per sample that no polygon of this tile has won and that holds something all
                  the same: does that face away? NULL: there are no such samples (src/stream/) */
    dp_block block; /* of samples that the kernels draw at once */

    uint32_t tile, tile_x, tile_y;
    dp_farthest farthest;
    dp_strip strip;
    float *depth;     /* the tile's samples */
    uint32_t *winner; /* tile polygon per sample; UINT32_MAX: none */

    uint32_t *ids,
        *backs; /* of the tile's polygons, in the frame; those of triangles that face away */
    dp_tile_polygon *polygons;
    bool finds_edges;         /* by the table of edges: normals are wanted */
    float plane_normal[3][3]; /* what d0, dx, dy (perspective) or -1, dx, dy of a plane are times to
                                 give its normal */
    float (*normals)[4];      /* by polygon: unit normal and 0, DP_ROUGH or DP_UNKNOWN, or dp_away
                                 (find/edges.inc) */
    uint32_t *unsure;         /* front faces whose normals are still to be made */
    dp_umbrella *umbrellas;   /* by the keys of vertices, shifted right */
    uint32_t umbrella_shift;
    dp_vertex
        *points; /* tile space; key: of the corner's position, where the polygon is not clipped */
    uint32_t *keys; /* of the triangles' corners, by corner: `keys_stride` from one to the next */
    uint32_t *seen; /* polygons that are not hidden, ascending */
    uint32_t *seen_words; /* dp_seen_words */
    dp_edge_list edges;
    dp_edge_slot *edge_slots;
    uint8_t *edge_marks; /* by number in the list: DP_MARK_… of one that may be a line, 0 */
    uint32_t *pair_first,
        *pair_second; /* edges of the list: one as either of two polygons has it */
    dp_meeting *meetings;
    uint32_t *slot_meetings; /* by slot: 1 + first meeting, where it has DP_SLOT_MORE */
    dp_candidate *candidates;
    dp_probes probes;
    const uint32_t (*owners)[2]; /* the candidates' own polygons; NULL: as the candidates say */
    dp_piece *pieces;            /* of all the worker's tiles in this frame */
    dp_bones *bones;             /* the same */
    size_t winner_cap, ids_cap, backs_cap, normals_cap, seen_cap, slot_meetings_cap, polygons_cap,
        points_cap, meetings_cap, slots_cap;
    size_t unsure_cap, umbrellas_cap, edge_marks_cap, pair_first_cap, pair_second_cap;
    size_t candidates_cap, probe_x_cap, probe_y_cap, probe_limit_cap, pieces_cap, bones_cap;
    uint32_t
        undrawn; /* back faces among the first so many polygons are not drawn by dp_tile_assemble */
    size_t keys_cap, seen_words_cap;
    uint32_t keys_stride, seen_stride;
    uint32_t polygon_count, point_count, seen_count, unsure_count, meeting_count, slot_count;
    uint32_t edge_pairs, calm_edges; /* calm: not listed, as both polygons have them */
    uint32_t candidate_count, probe_count, bone_count;
    size_t piece_count;

    dp_close_samples close; /* to be looked at */
    uint64_t
        suspects[2][DP_TILE]; /* pixels where two front faces may cross; a front and a back face */
    dp_crowd crowd;

    dp_probe_groups groups;
    dp_pixel_lists lookup_pixels;
    dp_loose_edge *loose;
    struct dp_lookup *lookups; /* emerge.c */
    size_t loose_cap, lookups_cap;
    uint32_t loose_count;

    uint32_t *ink; /* quads.c: per sample; its depth; the stencil buffer */
    float *ink_depth;
    uint8_t *stencil;
    dp_vec3 *world; /* corners of one polygon */
    dp_clip_point *clip;
    struct dp_screen_edge *screen_edges;
    size_t ink_cap, ink_depth_cap, stencil_cap, world_cap, clip_cap, screen_edges_cap;

    dp_outline_scratch scratch; /* for one polygon */
    dp_stats stats;
};

/* Grows one of the worker's arrays; remembers a failure. */
#define DP_WORKER_RESERVE(worker, array, capacity, need)                                           \
    ((need) <= (worker)->capacity ||                                                               \
     dp_reserve(&(worker)->memory, &(worker)->array, &(worker)->capacity, (need),                  \
                sizeof *(worker)->array) ||                                                        \
     !((worker)->failed = true))

bool dp_tile_worker_init(dp_tile_worker *worker, const dp_frame *frame);
void dp_tile_worker_free(dp_tile_worker *worker);
uint64_t dp_tile_worker_bytes(const dp_tile_worker *worker);

/* Takes up a tile: nothing has won a sample, no line is known; its depth stays as it is
 * (tile.c). */
void dp_tile_open(dp_tile_worker *worker, uint32_t tile);

/* Finds the visible pieces of lines in tile `tile` and its surface (tile.c). */
void dp_tile_find(dp_tile_worker *worker, uint32_t tile);

/* The stages of dp_tile_find, each in its own file. */
void dp_tile_assemble(dp_tile_worker *worker);      /* assemble.c; draws faces, but for … */
void dp_tile_find_farthest(dp_tile_worker *worker); /* cull.c */
void dp_tile_faces(dp_tile_worker *worker);         /* cull.c; … some back faces */
bool dp_tile_see(dp_tile_worker *worker,
                 bool culling);                     /* cull.c: lists what is not hidden, or all */
void dp_tile_edges(dp_tile_worker *worker);         /* edges.c */
void dp_tile_adjacent_edges(dp_tile_worker *worker); /* adjacent.c: instead, by adjacency */
void dp_tile_emerge(dp_tile_worker *worker);        /* emerge.c */
void dp_tile_intersections(dp_tile_worker *worker); /* intersect.c */
void dp_tile_probe(dp_tile_worker *worker);         /* probes.c: the next two */
void dp_tile_hide(dp_tile_worker *worker);    /* the tile's seen polygons hide sample points */
void dp_tile_collect(dp_tile_worker *worker); /* runs of visible sample points become pieces */

void dp_tile_surface(dp_tile_worker *worker); /* surface.c */
void dp_tile_bare_surface(dp_tile_worker *worker);

/* Instead of edges, intersections and probes: the added polygons are the ink (quads.c). */
void dp_tile_quads(dp_tile_worker *worker);

/* Culling: how far behind the surface is well behind it, pixel sizes. */
#define DP_CULL_SLACK 6

/* Does the surface hide all that lies in this box of tile space, `nearest` at the nearest
 * (cull.c)? */
bool dp_tile_hides(const dp_tile_worker *worker, float x0, float y0, float x1, float y1,
                   float nearest);

/* The same of a polygon's box. */
bool dp_tile_is_hidden(const dp_tile_worker *worker, const dp_tile_polygon *polygon);

/* Does edge i of a polygon come as near to the tile as `reach` px? A polygon that is not clipped
 * has an edge from point to point of its outline. */
static inline bool dp_tile_edge_reaches(const dp_tile_worker *w, const dp_tile_polygon *p,
                                        uint32_t i, float reach) {
    if (p->flags & DP_POLYGON_CLIPPED) return true;
    const dp_vertex a = w->points[p->point + i],
                    b = w->points[p->point + (i + 1 == p->points ? 0 : i + 1)];
    return dp_maxf(a.x, b.x) >= -reach && dp_minf(a.x, b.x) <= DP_TILE + reach &&
           dp_maxf(a.y, b.y) >= -reach && dp_minf(a.y, b.y) <= DP_TILE + reach;
}

/* Does it come near the tile? Others are other tiles'. */
static inline bool dp_tile_edge_is_near(const dp_tile_worker *w, const dp_tile_polygon *p,
                                        uint32_t i) {
    if (p->points == 3 && !(p->flags & DP_POLYGON_CLIPPED))
        return p->flags & (uint32_t)DP_POLYGON_NEAR << i;
    return dp_tile_edge_reaches(w, p, i, DP_BESIDE);
}

/* Appends a polygon's edges to the list, which has room (edge_table.c). */
void dp_edge_list_polygon(dp_tile_worker *worker, uint32_t polygon);

/* Does the edge that starts at this corner bound the polygon, or split it? */
static inline bool dp_edge_is_flagged(const dp_polygons *polygons, uint32_t c) {
    return !polygons->edge_flags || polygons->edge_flags[c];
}

/* Sets the normal of a polygon that is too thin for float32, or those of all seen polygons; false
 * when memory is out (normals.c). */
void dp_tile_exact_normal(dp_tile_worker *worker, uint32_t polygon);
bool dp_tile_exact_normals(dp_tile_worker *worker);

/* Makes polygon `index`, a triangle, again by the general way, and draws it if it is a front face,
 * or, when `backs`, a back face that is not hidden (assemble.c). */
void dp_tile_reassemble(dp_tile_worker *worker, uint32_t index, bool backs);

/* Makes suspects of the pixels of close samples where the planes cross, and forgets the samples
 * (near_depth.c). Before faces are drawn in a box as narrow as a vector, or in one row of others, no
 * more than DP_CLOSE_FULL are kept. */
void dp_tile_watch(dp_tile_worker *worker);

/* How many corner positions two polygons share. Their keys are hashes: a false match costs one
 * crossing in four thousand million (near_depth.c). */
uint32_t dp_shared_corners(const dp_frame *frame, uint32_t a, uint32_t b);

/* Of suspects by rows of pixels (near_depth.c): drops those that stand alone; adds the neighbours,
 * false when there are none. */
void dp_drop_lone(uint64_t suspects[DP_TILE]);
bool dp_widen(const uint64_t pixels[DP_TILE], uint64_t out[DP_TILE]);

/* Adds a candidate and its probes in this tile, of those with numbers [k0, k1); n, probe, bones and
 * the final k0, k1 are filled here (probes.c). `normals`: of its polygons, a's and b's (a's, if
 * there is none), or NULL where they are not at hand. */
void dp_tile_add_candidate(dp_tile_worker *worker, dp_candidate candidate, const dp_spine *spine,
                           const dp_vec3 normals[2]);

/* Puts item `index` into the list of the pixel that holds (x, y), or the tile's nearest one;
 * returns what was first there, or UINT32_MAX. */
static inline uint32_t dp_pixel_push(dp_pixel_lists *lists, float x, float y, uint32_t index) {
    const uint32_t px = x <= 0 ? 0 : x >= DP_TILE ? DP_TILE - 1 : (uint32_t)x;
    const uint32_t py = y <= 0 ? 0 : y >= DP_TILE ? DP_TILE - 1 : (uint32_t)y;
    uint32_t *const head = &lists->head[py * DP_TILE + px];
    const uint32_t next = lists->row[py] >> px & 1 ? *head : UINT32_MAX;
    lists->row[py] |= (uint64_t)1 << px;
    *head = index;
    return next;
}

/* The pixels of row y that a polygon's box covers. */
static inline uint64_t dp_box_span(const dp_tile_polygon *polygon) {
    return (~(uint64_t)0 >> (63 - (polygon->x1 - polygon->x0))) << polygon->x0;
}

/* Member DP_SEEN_… of all seen polygons; room for a vector lies beyond the last. */
static inline uint32_t *dp_seen_words(const dp_tile_worker *w, uint32_t member) {
    return w->seen_words + (size_t)member * w->seen_stride;
}

/* Does a polygon cover a point of the tile? Of two polygons that share an edge exactly one does
 * (probes.c). */
bool dp_tile_covers(const dp_tile_worker *worker, const dp_tile_polygon *polygon, float x, float y);

/* Is the polygon part of the surface that is painted and hides (in this tile)? */
static inline bool dp_is_surface(const dp_tile_worker *worker, const dp_tile_polygon *p) {
    if ((p->flags & (DP_POLYGON_TOUCHES | DP_POLYGON_EDGE_ON)) != DP_POLYGON_TOUCHES) return false;
    return p->flags & DP_POLYGON_FRONT || !dp_polygon_style(worker->frame, p->id)->cull_back_faces;
}

/* Change of depth d over `px` pixel sizes along the line of sight, in float32 (dp_depth_step). */
static inline float dp_depth_steps(const dp_frame *frame, float d, float px) {
    return px * (fabsf(d) * frame->step_scale + frame->step_offset);
}

/* A crossing is looked for this far around a sample, px: beyond the next sample on the other side
 * … */
static inline float dp_watch_px(const dp_tile_worker *w) {
    return w->sampling.samples == 1 ? 1.5f : 0.75f;
}

/* … or where the gap in depth is less than this many pixel sizes: the other polygon may be the
 * steep one. */
#define DP_WATCH_GAP 8

/* A sample this close in depth to a plane may be of a polygon that crosses it. */
static inline float dp_watch_reach(const dp_tile_worker *w, float dx, float dy, float nearest) {
    return dp_watch_px(w) * (fabsf(dx) + fabsf(dy)) +
           dp_depth_steps(w->frame, nearest, DP_WATCH_GAP);
}

/* The depth of a polygon's plane at a point of the tile. */
static inline float dp_plane_at(const dp_tile_polygon *polygon, float x, float y) {
    return polygon->d0 + polygon->dx * x + polygon->dy * y;
}

#endif
