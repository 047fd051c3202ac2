/* The scratch of the edge table: listed half-edges, one-rings of vertices, pairs that met. */
#ifndef DP_FIND_EDGE_LIST_H
#define DP_FIND_EDGE_LIST_H

#include "base/hostile.h"
#include "base/memory.h"

/* Half-edges of seen polygons, as arrays; each has room for one vector beyond the last. */
typedef struct dp_edge_list {
    uint32_t *polygon, *edge; /* tile polygon; number of the corner that the edge starts from */
    uint32_t *from;           /* that corner's key */
    uint32_t *key;            /* xor of the keys of both ends */
    size_t polygon_cap, edge_cap, from_cap, key_cap;
    uint32_t count;
} dp_edge_list;

enum { DP_EDGES_ROOM = 16 };

/* A slot of the tile's edge table (edge_table.c). The low 32 bits hold the edge's key; the high 32
 * bits tell which half-edges of the list met there:
 *
 *   0                        the slot is free
 *   1 + number               one half-edge, so far alone
 *   DP_SLOT_PAIR + number    a pair; with DP_SLOT_MORE there are meetings beyond it */
typedef uint64_t dp_edge_slot;

#define DP_SLOT_PAIR   (1u << 31)
#define DP_SLOT_MORE   (1u << 30) /* more than two polygons met */
#define DP_SLOT_NUMBER (DP_SLOT_MORE - 1)

/* Marks of half-edges that may be lines: no second polygon met it; at least one did. */
enum { DP_MARK_ALONE = 1, DP_MARK_PAIR };

/* A third or later polygon at an edge. */
typedef struct dp_meeting {
    uint32_t first, number; /* in the list: the first polygon's half-edge, and this one's */
    uint32_t next;          /* 1 + next meeting; 0: none */
} dp_meeting;

/* What is known of the triangles around a vertex (find/one_rings.inc): the least of the components
 * of their normals, and of these negated, times DP_RING_ONE; and a sum that tells whether the
 * triangles close around the vertex. */
typedef struct dp_one_ring {
    int16_t least[6]; /* x, -x, y, -y, z, -z */
    uint32_t open;
} dp_one_ring;

_Static_assert(sizeof(dp_one_ring) == 16, "find/one_rings.inc takes it for a vector");

/* One-rings of this many bytes or more do not fit the second-level cache. */
enum { DP_RINGS_FAR = DP_TUNED(1 << 19, 1 << 10) };

#define DP_RING_BYTE   0x7f       /* every byte of an empty one-ring */
#define DP_RING_CLOSED 0x7f7f7f7f /* `open` of a closed one-ring of front faces */
#define DP_RING_ONE    8192
enum { DP_RING_NONE = INT16_MAX };
enum { DP_RING_BACKS = 15 /* up to this many back faces are counted */ };
#define DP_RING_BACK         0x9e3779b1u /* each back face adds this to `open` */
#define DP_RING_BACK_INVERSE 0xe8b2f51u  /* its inverse modulo 2^32 */

/* One-rings, found by the upper bits of the vertices' keys. */
typedef struct dp_one_rings {
    dp_one_ring *of;
    size_t cap;
    uint32_t shift;
    /* Normals in a box whose squared diagonal is less than this make no fold, even though they are
     * rough; in units of DP_RING_ONE squared. 0: no box is small enough. */
    float spread;
} dp_one_rings;

/* A tile's listed half-edges, and the table in which they meet (edge_table.c). */
typedef struct dp_edge_store {
    dp_edge_list edges;
    dp_edge_slot *slots;
    uint8_t *marks;                     /* by number in the list: DP_MARK_…; 0: not a line */
    uint32_t *pair_first, *pair_second; /* the two half-edges of a pair, numbers in the list */
    dp_meeting *meetings;
    uint32_t *slot_meetings; /* by slot: 1 + first meeting; only valid with DP_SLOT_MORE */
    size_t slots_cap, marks_cap, pair_first_cap, pair_second_cap, meetings_cap, slot_meetings_cap;
    uint32_t slot_count, pairs, meeting_count;
    uint32_t flat_edges; /* not listed because flat; counted once for each half-edge */
} dp_edge_store;

void dp_one_rings_init(dp_one_rings *rings, float flat_cosine);
void dp_one_rings_free(dp_one_rings *rings, const dp_allocator *memory);
uint64_t dp_one_rings_bytes(const dp_one_rings *rings);
void dp_edge_store_free(dp_edge_store *store, const dp_allocator *memory);
uint64_t dp_edge_store_bytes(const dp_edge_store *store);

#endif
