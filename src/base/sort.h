/* Sorting in place, for loops that must not ask for memory. */
#ifndef DP_BASE_SORT_H
#define DP_BASE_SORT_H

#include <stddef.h>

enum { DP_SORT_ITEM_MOST = 64 /* bytes */ };

/* As qsort, which glibc gives up to the array's size again from malloc, past the caller's
 * allocator. Not stable: `compare` should tell any two items apart whose order matters. The result
 * depends on the items and their order alone. `items` may be NULL where count is 0. */
void dp_sort(void *items, size_t count, size_t size,
             int (*compare)(const void *left, const void *right));

#endif
