/* Introsort (Musser 1997), in place.
 *
 *    while more than SHORT items are left
 *        too many bad pivots: heapsort, and be done
 *        partition by the median of three
 *        sort the smaller part by a call, go on with the larger
 *    insertion sort
 *
 * So there are at most O(n log n) comparisons and log n calls on the stack. Invariant of a
 * partition: items left of `i` are not above the pivot, items right of `k` are not below it. The
 * pivot is a copy, so that no swap moves it. */
#include "base/sort.h"

#include "base/hostile.h"

#include <assert.h>
#include <string.h>

enum { SHORT = DP_TUNED(12, 3) };

typedef struct order {
    size_t size;
    int (*compare)(const void *left, const void *right);
} order;

static void swap(char *a, char *b, size_t size) {
    char kept[DP_SORT_ITEM_MOST];
    memcpy(kept, a, size);
    memcpy(a, b, size);
    memcpy(b, kept, size);
}

static void sort_by_insertion(const order *o, char *items, size_t count) {
    char kept[DP_SORT_ITEM_MOST];
    for (size_t i = 1; i < count; i++) {
        char *to = items + i * o->size;
        if (o->compare(to - o->size, to) <= 0) continue;
        memcpy(kept, to, o->size);
        do {
            memcpy(to, to - o->size, o->size);
            to -= o->size;
        } while (to > items && o->compare(to - o->size, kept) > 0);
        memcpy(to, kept, o->size);
    }
}

/* Lets item `at` of a heap of `count` sink until it is not below its children. */
static void sink(const order *o, char *items, size_t at, size_t count) {
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count &&
            o->compare(items + child * o->size, items + (child + 1) * o->size) < 0)
            child++;
        if (o->compare(items + at * o->size, items + child * o->size) >= 0) return;
        swap(items + at * o->size, items + child * o->size, o->size);
    }
}

static void sort_by_heap(const order *o, char *items, size_t count) {
    for (size_t i = count / 2; i-- > 0;) sink(o, items, i, count);
    for (size_t i = count; --i > 0;) {
        swap(items, items + i * o->size, o->size);
        sink(o, items, 0, i);
    }
}

static const char *median(const order *o, const char *a, const char *b, const char *c) {
    if (o->compare(a, b) > 0) {
        const char *const lower = b;
        b = a, a = lower;
    }
    return o->compare(b, c) <= 0 ? b : o->compare(a, c) > 0 ? a : c;
}

/* Partitions the items and returns how many are in the first part: at least one, but not all. It
 * checks bounds, which a proper order would not need; but values from a file may be NaN. */
static size_t partition(const order *o, char *items, size_t count) {
    char pivot[DP_SORT_ITEM_MOST];
    char *const last = items + (count - 1) * o->size;
    char *i = items, *k = last;
    memcpy(pivot, median(o, i, items + count / 2 * o->size, k), o->size);
    for (;; i += o->size, k -= o->size) {
        while (i < last && o->compare(i, pivot) < 0) i += o->size;
        while (k > items && o->compare(k, pivot) > 0) k -= o->size;
        if (i >= k) break;
        swap(i, k, o->size);
    }
    return (size_t)(i - items) / o->size + (i == k && i == items);
}

/* After `turns` more partitions heapsort takes over. */
static void sort(const order *o, char *items, size_t count, unsigned turns) {
    while (count > SHORT) {
        if (!turns--) {
            sort_by_heap(o, items, count);
            return;
        }
        const size_t first = partition(o, items, count), second = count - first;
        char *const rest = items + first * o->size;
        if (first < second) {
            sort(o, items, first, turns);
            items = rest, count = second;
        } else {
            sort(o, rest, second, turns);
            count = first;
        }
    }
    sort_by_insertion(o, items, count);
}

void dp_sort(void *items, size_t count, size_t size,
             int (*compare)(const void *left, const void *right)) {
    const order o = {size, compare};
    unsigned turns = 0;
    assert(size <= DP_SORT_ITEM_MOST);
    for (size_t n = count; n > 1; n /= 2) turns += 2;
    if (count > 1) sort(&o, items, count, turns);
}
