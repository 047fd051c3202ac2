/* The scratch of the edge table: listed edges, one-rings of vertices, pairs that met. */
#ifndef DP_FIND_EDGE_LIST_H
#define DP_FIND_EDGE_LIST_H

#include "base/hostile.h"
#include "base/memory.h"

/* Edges of seen polygons, each member for itself, with room for one vector beyond the last. */
typedef struct dp_edge_list {
    uint32_t *polygon, *edge; /* tile polygon; number of the corner that the edge starts from */
    uint32_t *from;           /* that corner's key */
    uint32_t *key;            /* exclusive or of the keys of both ends */
    size_t polygon_cap, edge_cap, from_cap, key_cap;
    uint32_t count;
} dp_edge_list;

enum { DP_EDGES_ROOM = 16 };

/* A slot of the tile's table of edges (edge_table.c): an edge's key, and above it which of the
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

/* The triangles around a vertex (find/one-rings.inc): of their normals' components, times
 * DP_RING_ONE, and of what these are less, the least; and a sum that tells whether they
 * surround it. */
typedef struct dp_one_ring {
    int16_t least[6]; /* x, -x, y, -y, z, -z */
    uint32_t open;
} dp_one_ring;

_Static_assert(sizeof(dp_one_ring) == 16, "find/one_rings.inc takes it for a vector");

/* So many bytes of them, or more, are too much for the second-level cache. */
enum { DP_RINGS_FAR = DP_TUNED(1 << 19, 1 << 10) };

#define DP_RING_BYTE   0x7f       /* all bytes of an empty one */
#define DP_RING_CLOSED 0x7f7f7f7f /* its `open` */
#define DP_RING_ONE    8192
enum { DP_RING_NONE = INT16_MAX };
enum { DP_RING_BACKS = 15 /* so many back faces, or fewer, are counted */ };
#define DP_RING_BACK         0x9e3779b1u /* each adds this to `open` */
#define DP_RING_BACK_INVERSE 0xe8b2f51u  /* times that: 1 */

/* One-rings by the keys of vertices, shifted right. */
typedef struct dp_one_rings {
    dp_one_ring *of;
    size_t cap;
    uint32_t shift;
    float spread; /* squared, times DP_RING_ONE squared: normals that lie together in a box with
                     a diagonal less than this make no fold, although they are rough; 0: none is so
                     small */
} dp_one_rings;

/* A tile's listed edges and the table in which they meet (edge_table.c). */
typedef struct dp_edge_store {
    dp_edge_list edges;
    dp_edge_slot *slots;
    uint8_t *marks; /* by number in the list: DP_MARK_… of one that may be a line, 0 */
    uint32_t *pair_first,
        *pair_second; /* edges of the list: one as either of two polygons has it */
    dp_meeting *meetings;
    uint32_t *slot_meetings; /* by slot: 1 + first meeting, where it has DP_SLOT_MORE */
    size_t slots_cap, marks_cap, pair_first_cap, pair_second_cap, meetings_cap, slot_meetings_cap;
    uint32_t slot_count, pairs, meeting_count;
    uint32_t flat_edges; /* not listed, as both polygons have them */
} dp_edge_store;

void dp_one_rings_init(dp_one_rings *rings, float flat_cosine);
void dp_one_rings_free(dp_one_rings *rings, const dp_allocator *memory);
uint64_t dp_one_rings_bytes(const dp_one_rings *rings);
void dp_edge_store_free(dp_edge_store *store, const dp_allocator *memory);
uint64_t dp_edge_store_bytes(const dp_edge_store *store);

#endif
