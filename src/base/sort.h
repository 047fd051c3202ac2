/* Sorting in place, for code that must not allocate. */
#ifndef DP_BASE_SORT_H
#define DP_BASE_SORT_H

#include <stddef.h>

enum { DP_SORT_ITEM_MOST = 64 /* bytes */ };

/* Like qsort, which in glibc allocates up to the array's size with malloc, not the caller's
 * allocator. Not stable: `compare` should order any two items whose order matters. The result
 * depends only on the items and their order. `items` may be NULL if count is 0. */
void dp_sort(void *items, size_t count, size_t size,
             int (*compare)(const void *left, const void *right));

#endif
