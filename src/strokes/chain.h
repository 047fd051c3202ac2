/* Chains: segments of one class joined end to end, as a pen draws them without being lifted. */
#ifndef DP_STROKES_CHAIN_H
#define DP_STROKES_CHAIN_H

#include "strokes/stroke.h"

/* A segment's place in its chain. */
typedef struct dp_link {
    uint32_t segment;
    bool reversed; /* it is drawn from b to a */
} dp_link;

typedef struct dp_chain {
    uint32_t first, count; /* links */
    bool closed;           /* the last link's end is the first one's start */
} dp_chain;

typedef struct dp_chain_store {
    dp_link *links;
    dp_chain *chains;
    uint32_t *scratch;         /* slots, ends by node, partners */
    struct dp_bridge *bridges; /* chain.c */
    size_t links_cap, chains_cap, scratch_cap, bridges_cap;
    size_t slot_count;
    uint32_t chain_count;
} dp_chain_store;

/* What may be joined. */
typedef struct dp_chain_rule {
    float sharpest; /* cosine of the largest turn at which a chain goes on; with a side: any */
    float gap; /* px over which open ends are joined all the same: outlines of fine meshes are full
                  of holes */
    float side_gap;     /* the same for segments with a side, at most `gap` */
    float step;         /* as far in depth d as that, at most */
    float sharp;        /* degrees: only segments whose fold turns by so much go over gaps */
    bool any_class;     /* segments of all classes and colours are joined */
    bool any_color;     /* those of all colours: light gives each its own */
    const int8_t *side; /* [segments] +1 or -1: where the outside lies, seen from a to b; it must
                           stay on one side of a chain. 0: it has none. All of a class have one, or
                           none has. NULL: none at all */
} dp_chain_rule;

/* Chains strokes[count] where ends of one class, level and colour are equal, bit for bit, then over small
 * gaps. Where more than two meet, the straightest pairs go on. Chains come in the order of their
 * first segments. False when memory is out. */
bool dp_make_chains(const dp_stroke *strokes, uint32_t count, const dp_chain_rule *rule,
                    const dp_allocator *memory, dp_chain_store *store);
/* The ends at the place of an end, of the level, and the class and colour, that are joined with it: the first one
 * and the one after another, or UINT32_MAX. End 2 i is a of stroke i, 2 i + 1 is b. After dp_make_chains
 * with these strokes and this rule. */
uint32_t dp_first_end_at(const dp_chain_store *store, const dp_stroke *strokes, uint32_t count,
                         const dp_chain_rule *rule, uint32_t end);
static inline uint32_t dp_next_end_at(const dp_chain_store *store, uint32_t end) {
    return store->scratch[store->slot_count + end];
}

void dp_chain_store_free(dp_chain_store *store, const dp_allocator *memory);
uint64_t dp_chain_store_bytes(const dp_chain_store *store);

#endif
