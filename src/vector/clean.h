/* What the phases of cleaning a drawing share; drawing.c tells their order.
 *
 * A part is a piece of a segment that is drawn: the whole of it, or what is left of one that lies
 * on others. Part i has two ends, 2 i where its segment begins and 2 i + 1 where it ends.
 *
 * Invariants: parts lie in the order of their segments, and along each; partner[partner[e]] == e. */
#ifndef DP_VECTOR_CLEAN_H
#define DP_VECTOR_CLEAN_H

#include "vector/drawing.h"

#define DP_NOWHERE UINT32_MAX

enum { DP_MOST_PARTS = 1 << 30 };

typedef struct dp_part {
    double at[2]; /* where on its segment it begins and ends: share of the length on the screen */
    uint32_t segment;
    uint8_t cut; /* bit k: end k is where another line begins to lie under the segment */
} dp_part;

/* A chain of parts, drawn from end `start` on. */
typedef struct dp_strand {
    uint32_t start, first; /* first: the part with the lowest number */
    uint32_t level, layer; /* layer: those of lower ones are drawn first */
    float length;          /* px, without gaps */
    float nearest;         /* world units: distance of its nearest end; only for nearer_first */
    dp_line line;
    bool closed;
} dp_strand;

typedef struct dp_cleaning {
    const dp_allocator *memory;
    const dp_drawn *drawn;
    dp_drawing_desc desc; /* resolved */
    bool nearer_first;    /* of two lines of one level on each other the nearer one is kept */
    dp_part *parts;
    uint32_t part_count;
    uint32_t *partner; /* [2 part_count] the end that is drawn next to this one, or DP_NOWHERE */
    dp_strand *strands;
    uint32_t strand_count;
    size_t parts_cap, partner_cap, strands_cap;
    double coincident; /* px */
    size_t joined;
    double joined_length; /* px */
} dp_cleaning;

/* Frees parts, partners and strands (strands.c). */
void dp_cleaning_free(dp_cleaning *c);

/* Each phase: false when memory is out, for which everything but its own results is unchanged. */

bool dp_find_parts(dp_cleaning *c);      /* strands.c: each segment is one */
bool dp_drop_coincident(dp_cleaning *c); /* coincide.c */
bool dp_find_strands(dp_cleaning *c);    /* strands.c: in drawing order */
/* Takes out folds, where the path goes back on itself. Returns how many points there are then, at
 * least 2 if there were; `moved`: its first point is another one now, its last point is (unfold.c). */
size_t dp_unfold(dp_path_point *points, size_t count, bool closed, bool moved[2]);
/* Leaves out points where the path stays within `tolerance` px; the first and, of an open path, the
 * last stay. Returns how many points there are then (simplify.c). */
size_t dp_simplify(dp_path_point *points, size_t count, bool closed, float tolerance);
/* Point number `first` of a closed path becomes its start. */
void dp_rotate_points(dp_path_point *points, size_t count, size_t first);
/* Measures the way between paths; with `optimize` it shortens it first (order.c). */
bool dp_order_paths(dp_drawing *d, bool optimize);

static inline const dp_segment *dp_segment_at(const dp_cleaning *c, uint32_t end) {
    return &c->drawn->segments[c->parts[end / 2].segment];
}

/* An end of a part: on the screen (d: distance, world units), and all of it (strands.c). */
dp_point dp_cut_end(const dp_cleaning *c, uint32_t end);
dp_path_point dp_part_point(const dp_cleaning *c, uint32_t end);

static inline bool dp_is_cut(const dp_cleaning *c, uint32_t end) {
    return c->parts[end / 2].cut >> (end & 1) & 1;
}

static inline dp_point dp_part_end(const dp_cleaning *c, uint32_t end) {
    const dp_segment *const s = dp_segment_at(c, end);
    const float *const at = end & 1 ? s->b : s->a;
    return dp_is_cut(c, end) ? dp_cut_end(c, end) : (dp_point){at[0], at[1], at[2]};
}

/* Where a hash table keeps a cell of a grid: cells of a block of 8 x 8 lie side by side. */
static inline uint32_t dp_cell_hash(int32_t x, int32_t y) {
    uint32_t h = ((uint32_t)x >> 3) * 0x9e3779b1u ^ ((uint32_t)y >> 3) * 0x85ebca77u;
    h ^= h >> 15, h *= 0x2c1b3c6du;
    return (h ^ h >> 13) << 6 ^ ((uint32_t)x & 7) << 3 ^ ((uint32_t)y & 7);
}

/* Pen, paper and depth of one path: what never changes on it. */
static inline bool dp_same_pen(const dp_segment *s, const dp_segment *t) {
    return s->level == t->level && s->color == t->color && s->width == t->width;
}

#endif
