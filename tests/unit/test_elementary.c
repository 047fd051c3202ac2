/* Elementary functions: close to the C library's, the same bits everywhere, defined for every
 * input. */
#include "base/elementary.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static uint64_t bits_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* In [-1, 1), the same on every machine. */
static double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(*state >> 11) * 0x1p-52 - 1;
}

/* Units in the last place of the C library's value, which is within one of the exact one. */
static double error_of(double value, double library) {
    const double size = fabs(library);
    return fabs(value - library) / (nextafter(size, INFINITY) - size);
}

/* The functions over numbers of several sizes, `see` called with each value and the library's. */
typedef void see_value(void *user, double value, double library, double most);

static void for_many_numbers(see_value *see, void *user) {
    static const double sizes[] = {1e-12, 0.01, 1, 7, 3000};
    uint64_t state = 1;
    for (int i = 0; i < 20000; i++) {
        const double size = sizes[i % 5], x = next_number(&state) * size, c = next_number(&state),
                     y = next_number(&state) * sizes[i / 5 % 5];
        see(user, dp_sin(x), sin(x), 2);
        see(user, dp_cos(x), cos(x), 2);
        see(user, dp_tan(x), tan(x), 4);
        see(user, dp_atan(x), atan(x), 4);
        see(user, dp_atan2(y, x), atan2(y, x), 4);
        see(user, dp_acos(c), acos(c), 4);
        see(user, dp_log(fabs(y)), log(fabs(y)), 4);
        see(user, dp_exp(x), exp(x), 4);
    }
}

static void see_error(void *user, double value, double library, double most) {
    (void)user;
    if (value == library) return; /* infinity, too */
    if (!(error_of(value, library) <= most)) fail_msg("%a instead of %a", value, library);
}

static void values_are_near_the_library_s(void **state) {
    (void)state;
    for_many_numbers(see_error, NULL);
}

static void see_bits(void *user, double value, double library, double most) {
    uint64_t *const sum = user;
    (void)library, (void)most;
    *sum = (*sum ^ bits_of(value)) * 0x100000001b3u;
}

/* The sum is what every compiler, processor and C library must come to. */
static void every_bit_is_the_same_everywhere(void **state) {
    uint64_t sum = 0;
    (void)state;
    for_many_numbers(see_bits, &sum);
    assert_true(sum == UINT64_C(0xf9c488b5de4c9d02));
}

static void known_values(void **state) {
    (void)state;
    assert_true(dp_sin(0) == 0 && dp_cos(0) == 1 && dp_tan(0) == 0 && dp_exp(0) == 1);
    assert_true(dp_log(1) == 0 && dp_acos(1) == 0 && dp_atan(1) == 0x1.921fb54442d18p-1);
    assert_true(dp_acos(-1) == 0x1.921fb54442d18p+1 && dp_acos(0) == 0x1.921fb54442d18p+0);
}

static void special_values_are_as_c_has_them(void **state) {
    static const double values[] = {0, -0.0, 1, -1, INFINITY, -INFINITY, NAN, 1e300, 5e-324};
    enum { COUNT = sizeof values / sizeof *values };
    (void)state;
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < COUNT; j++) {
            const double value = dp_atan2(values[i], values[j]);
            const double library = atan2(values[i], values[j]);
            assert_int_equal(isnan(value), isnan(library));
            if (isnan(library)) continue;
            assert_int_equal(signbit(value) != 0, signbit(library) != 0);
            assert_true(value == library || error_of(value, library) <= 4);
        }
    assert_true(isnan(dp_sin(INFINITY)) && isnan(dp_cos(NAN)) && isnan(dp_tan(-INFINITY)));
    assert_true(isnan(dp_acos(1.5)) && isnan(dp_acos(NAN)) && isnan(dp_exp(NAN)));
    assert_true(dp_log(0) == -INFINITY && dp_log(-1) == -INFINITY);
    assert_true(dp_exp(1000) == INFINITY && dp_exp(-1000) == 0 && dp_exp(-INFINITY) == 0);
    assert_true(fabs(dp_sin(1e300)) <= 1 && fabs(dp_cos(-1e22)) <= 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_near_the_library_s),
        cmocka_unit_test(every_bit_is_the_same_everywhere),
        cmocka_unit_test(known_values),
        cmocka_unit_test(special_values_are_as_c_has_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
