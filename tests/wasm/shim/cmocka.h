/* As much of cmocka as the tests of kernels ask for: Emscripten has no cmocka. A failure is printed
 * and ends the program, so nothing here is counted. */
#ifndef DP_WASM_CMOCKA_H
#define DP_WASM_CMOCKA_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*test)(void **state);
};

#define cmocka_unit_test(function)                                                                 \
    { #function, function }

#define print_message printf
#define fail_msg(...)                                                                              \
    (fprintf(stderr, "%s:%d: ", __FILE__, __LINE__), fprintf(stderr, __VA_ARGS__),                 \
     fputc('\n', stderr), exit(1))
#define assert_true(condition)                                                                     \
    ((condition) ? (void)0 : (void)fail_msg("%s does not hold", #condition))
#define assert_int_equal(a, b) assert_true((long long)(a) == (long long)(b))
#define assert_in_range(value, least, most)                                                        \
    assert_true((unsigned long long)(value) >= (unsigned long long)(least) &&                      \
                (unsigned long long)(value) <= (unsigned long long)(most))
#define assert_memory_equal(a, b, size) assert_true(!memcmp(a, b, size))
#define assert_float_equal(a, b, epsilon)                                                          \
    assert_true((a) - (b) <= (epsilon) && (b) - (a) <= (epsilon))

#define cmocka_run_group_tests(tests, set_up, tear_down)                                           \
    cmocka_run_all(tests, sizeof(tests) / sizeof *(tests), set_up, tear_down)

typedef int cmocka_fixture(void **state);

static inline int cmocka_run_all(const struct CMUnitTest *tests, size_t count,
                                 cmocka_fixture *set_up, cmocka_fixture *tear_down) {
    void *state = NULL;
    if (set_up && set_up(&state)) return 1;
    for (size_t i = 0; i < count; i++) {
        tests[i].test(&state);
        printf("passed: %s\n", tests[i].name);
    }
    return tear_down ? tear_down(&state) : 0;
}

#endif
