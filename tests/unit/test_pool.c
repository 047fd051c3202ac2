/* The allocator that keeps what is given back. */
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include "base/pool.h"

#include <cmocka.h>

static dp_allocator plain;

static void blocks_are_taken_again(void **state) {
    (void)state;
    dp_pool pool = {0};
    const dp_allocator memory = dp_pool_allocator(&pool, &plain);
    void *const small = dp_alloc(&memory, 10), *const large = dp_alloc(&memory, 1000);
    const uint64_t bytes = pool.bytes;
    dp_free(&memory, large);
    dp_free(&memory, small);
    assert_ptr_equal(dp_alloc(&memory, 9), small); /* the smallest that is large enough */
    assert_ptr_equal(dp_alloc(&memory, 11), large);
    assert_true(pool.bytes == bytes);
    dp_free(&memory, small);
    dp_free(&memory, large);
    dp_pool_free(&pool, &plain);
    assert_true(pool.bytes == 0);
}

static void growing_keeps_what_is_there(void **state) {
    (void)state;
    dp_pool pool = {0};
    const dp_allocator memory = dp_pool_allocator(&pool, &plain);
    for (int frame = 0; frame < 2; frame++) {
        uint32_t *items = NULL;
        size_t cap = 0;
        for (uint32_t i = 0; i < 1000; i++) {
            assert_true(dp_reserve(&memory, &items, &cap, i + (size_t)1, sizeof *items));
            items[i] = i;
        }
        for (uint32_t i = 0; i < 1000; i++) assert_int_equal(items[i], i);
        assert_true((uintptr_t)items % 16 == 0);
        dp_free(&memory, items);
    }
    const uint64_t bytes = pool.bytes;
    dp_free(&memory, dp_alloc(&memory, 2000));
    assert_true(pool.bytes == bytes);
    assert_null(dp_alloc(&memory, SIZE_MAX));
    dp_pool_free(&pool, &plain);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_are_taken_again),
                                       cmocka_unit_test(growing_keeps_what_is_there)};
    plain = dp_allocator_resolve(NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
