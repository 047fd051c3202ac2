/* Names of groups, numbered in order of appearance. */
#ifndef DP_IO_GROUPS_H
#define DP_IO_GROUPS_H

#include "base/memory.h"

#define DP_GROUPS_MOST 65536 /* dp_batch numbers groups in 16 bits */

typedef struct dp_groups {
    dp_allocator allocator;
    char *text; /* the names, a 0 behind each */
    size_t text_size, text_capacity;
    size_t *starts; /* [count] in text */
    size_t count, start_capacity;
    uint32_t *slots;   /* [slot_count] hash table: 1 + group, 0 where free */
    size_t slot_count; /* a power of two, more than twice count */
} dp_groups;

/* The number of a name, a new one if it is new. When all numbers are taken, new names share the
 * last one. False when memory is out. */
bool dp_groups_find(dp_groups *groups, const char *name, uint16_t *group);
/* A group's name, borrowed; NULL if there is no such group or its name is empty. */
const char *dp_groups_name(const dp_groups *groups, uint32_t group);
void dp_groups_destroy(dp_groups *groups);

#endif
