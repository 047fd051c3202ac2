/* base/sort: sorts any keys, of any size, and survives a comparison that is no order. */
#include "base/sort.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 3000 };

typedef struct wide {
    uint32_t key, id;
    char rest[DP_SORT_ITEM_MOST - 8];
} wide;

static size_t compares;

static int by_key(const void *left, const void *right) {
    const uint32_t l = *(const uint32_t *)left, r = *(const uint32_t *)right;
    compares++;
    return (l > r) - (l < r);
}

/* Key number i of n in one of several patterns that quicksorts fear. */
static uint32_t key_of(int pattern, uint32_t i, uint32_t n) {
    switch (pattern) {
    case 0:
        return i * 2654435761u; /* as good as random */
    case 1:
        return i;
    case 2:
        return n - i;
    case 3:
        return 7;
    case 4:
        return i & 1;
    case 5:
        return i < n / 2 ? i : n - i; /* a hill */
    case 6:
        return i * 2654435761u % 5;
    default:
        return i & 1 ? i : i + n / 2;
    }
}
enum { PATTERNS = 8 };

static void sorts_every_pattern(void **state) {
    static wide items[MOST];
    static uint32_t small[MOST], expected[MOST];
    static uint8_t met[MOST];
    (void)state;
    for (int pattern = 0; pattern < PATTERNS; pattern++)
        for (uint32_t n = 0; n <= MOST; n = n < 70 ? n + 1 : n * 3 / 2) {
            memset(met, 0, sizeof met);
            for (uint32_t i = 0; i < n; i++) {
                items[i] = (wide){.key = key_of(pattern, i, n), .id = i};
                items[i].rest[sizeof items[i].rest - 1] = (char)i;
                small[i] = expected[i] = items[i].key;
            }
            compares = 0;
            dp_sort(items, n, sizeof *items, by_key);
            if (compares > 1000 && (double)compares > 4 * n * log2(n))
                fail_msg("pattern %d: %zu compares for %u items", pattern, compares, n);
            dp_sort(small, n, sizeof *small, by_key);
            qsort(expected, n, sizeof *expected, by_key);
            assert_memory_equal(small, expected, n * sizeof *small);
            for (uint32_t i = 0; i < n; i++) {
                assert_int_equal(items[i].key, expected[i]);
                assert_int_equal(items[i].rest[sizeof items[i].rest - 1], (char)items[i].id);
                assert_int_equal(met[items[i].id]++, 0);
            }
        }
}

/* McIlroy 1999, "A Killer Adversary for Quicksort": keys are chosen while they are asked for. */
static struct { uint32_t value[MOST], solid, candidate, gas; } foe;

static int by_foe(const void *left, const void *right) {
    const uint32_t l = *(const uint32_t *)left, r = *(const uint32_t *)right;
    compares++;
    if (foe.value[l] == foe.gas && foe.value[r] == foe.gas)
        foe.value[l == foe.candidate ? l : r] = foe.solid++;
    if (foe.value[l] == foe.gas) foe.candidate = l;
    if (foe.value[r] == foe.gas) foe.candidate = r;
    return (foe.value[l] > foe.value[r]) - (foe.value[l] < foe.value[r]);
}

static void no_order_takes_long(void **state) {
    static uint32_t items[MOST];
    (void)state;
    foe.solid = foe.candidate = 0, foe.gas = MOST;
    for (uint32_t i = 0; i < MOST; i++) items[i] = i, foe.value[i] = foe.gas;
    compares = 0;
    dp_sort(items, MOST, sizeof *items, by_foe);
    assert_true((double)compares < 8 * MOST * log2(MOST));
    for (uint32_t i = 1; i < MOST; i++) assert_true(foe.value[items[i - 1]] <= foe.value[items[i]]);
}

/* With NaN nothing is in order, but nothing is lost and no bound is crossed. */
static int by_number(const void *left, const void *right) {
    const float l = *(const float *)left, r = *(const float *)right;
    return l != r ? l < r ? -1 : 1 : 0;
}

static void nan_loses_nothing(void **state) {
    static float items[MOST + 2];
    (void)state;
    for (uint32_t n = 2; n < MOST; n = n * 2 + 1) {
        float sum = 0;
        uint32_t nans = 0;
        items[0] = items[n + 1] = -99;
        for (uint32_t i = 1; i <= n; i++) items[i] = i % 3 ? (float)(i * 2654435761u % 256) : NAN;
        for (uint32_t i = 1; i <= n; i++) sum += i % 3 ? items[i] : 0;
        dp_sort(items + 1, n, sizeof *items, by_number);
        for (uint32_t i = 1; i <= n; i++) {
            if (items[i] == items[i]) sum -= items[i];
            nans += items[i] != items[i];
        }
        assert_true(sum == 0 && nans == n / 3);
        assert_true(items[0] == -99 && items[n + 1] == -99);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sorts_every_pattern),
        cmocka_unit_test(no_order_takes_long),
        cmocka_unit_test(nan_loses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
