/* io/number: floats are those of strtof, bit for bit, whatever the locale; integers saturate. */
#include "io/number.h"
#include "reading.h"

#include <locale.h>
#include <math.h>

static uint64_t state_of_random = 12345;
static uint64_t random_bits(void) {
    state_of_random = state_of_random * 6364136223846793005u + 1442695040888963407u;
    return state_of_random >> 20;
}

static float parse(const char *text) {
    float value = -12345;
    const uint8_t *const stop = dp_number_float((const uint8_t *)text, &value);
    if (!stop || *stop) fail_msg("`%s` is not taken whole", text);
    return value;
}

/* The same float, and the number to two units of a double, or nothing better than the float. */
static void assert_wide(const char *text, float expected) {
    float value = -12345;
    double wide = -12345;
    assert_non_null(dp_number_wide((const uint8_t *)text, &value, &wide));
    assert_memory_equal(&value, &expected, sizeof value);
    const double exact = strtod(text, NULL);
    if (wide == (double)value && (wide == 0 || fabs(wide) < 1e-40 || fabs(wide) > 1e38)) return;
    if (!(fabs(wide - exact) <= fabs(exact) * 0x1p-51))
        fail_msg("%s: %a instead of %a", text, wide, exact);
}

static void assert_as_strtof(const char *text) {
    const float value = parse(text), expected = strtof(text, NULL);
    if (memcmp(&value, &expected, sizeof value) != 0)
        fail_msg("%s: %a instead of %a", text, (double)value, (double)expected);
    assert_wide(text, expected);
}

static void chosen_floats_are_exact(void **state) {
    static const char *const texts[] = {"0",
                                        "-0",
                                        "0.0",
                                        "1",
                                        "-1.5",
                                        ".5",
                                        "5.",
                                        "+2",
                                        "1e0",
                                        "1E+2",
                                        "1e-2",
                                        "0e99999999",
                                        "3.4028235e38",
                                        "3.4028236e38",
                                        "3.5e38",
                                        "1e39",
                                        "-1e400",
                                        "1e99999999999",
                                        "1.17549435e-38",
                                        "1.17549421e-38",
                                        "1e-45",
                                        "0.7e-45",
                                        "1e-46",
                                        "1e-400",
                                        "16777217",
                                        "16777217.0000000000000000000000000001",
                                        "16777219",
                                        "0.1",
                                        "0.3",
                                        "123456789012345678901234567890",
                                        "0.000000000000000000000000000000000000012345",
                                        "000000000000000000000000000000000001.5",
                                        "9007199254740993",
                                        "8388609.5",
                                        "8388608.5",
                                        "0.50000002980232238769531250",
                                        "0.50000002980232238769531251",
                                        "0.50000002980232238769531249",
                                        "340282356779733661637539395458142568447",
                                        "340282356779733661637539395458142568448",
                                        "7.0064923216240853546186479164495e-46",
                                        "7.0064923216240853546186479164496e-46",
                                        "1.00000017881393432617187499",
                                        "1.000000178813934326171875",
                                        "1.00000017881393432617187501"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) assert_as_strtof(texts[i]);
}

static void random_floats_are_exact(void **state) {
    (void)state;
    for (int i = 0; i < 300000; i++) {
        char text[64];
        uint32_t bits = (uint32_t)random_bits();
        float value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        snprintf(text, sizeof text, "%.*g", 1 + (int)(random_bits() % 24), (double)value);
        assert_as_strtof(text);
        snprintf(text, sizeof text, "%.*f", (int)(random_bits() % 12),
                 (double)value / (1 + fabs((double)value)) * (double)(random_bits() % 2000));
        assert_as_strtof(text);
    }
}

/* The middle between two floats, and its neighbours many digits behind. */
static void middles_round_to_even(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        char text[400];
        const uint32_t bits = (uint32_t)(random_bits() % 0x7f000000);
        float value, above;
        memcpy(&value, &bits, sizeof value);
        above = nextafterf(value, INFINITY);
        const double middle = ((double)value + (double)above) / 2;
        snprintf(text, sizeof text, "%.120e", middle);
        char *const exponent = strchr(text, 'e');
        assert_as_strtof(text);
        exponent[-1] = '1';
        assert_as_strtof(text);
        snprintf(text, sizeof text, "%.*f", 200, middle);
        assert_as_strtof(text);
    }
}

static void very_long_numbers_are_exact(void **state) {
    char text[900] = "0.";
    (void)state;
    memset(text + 2, '0', 30);
    for (int i = 32; i < 899; i++) text[i] = (char)('0' + random_bits() % 10);
    assert_as_strtof(text);
    memset(text, '9', 38);
    assert_as_strtof(text);
    memcpy(text, "16777217.", 9);
    memset(text + 9, '0', 889);
    assert_as_strtof(text);
    text[897] = '1';
    assert_true(parse(text) == 16777218.0f);
}

static void what_is_not_finite_is_read(void **state) {
    (void)state;
    assert_true(parse("inf") == INFINITY && parse("-Infinity") == -INFINITY);
    assert_true(isnan(parse("nan")) && isnan(parse("-NaN")) && isnan(parse("nan(ind)")));
    assert_true(parse("1.#INF00") == INFINITY && parse("-1.#INF") == -INFINITY);
    assert_true(isnan(parse("-1.#IND")) && isnan(parse("1.#QNAN0")));
}

static void what_is_no_number_is_refused(void **state) {
    static const char *const texts[] = {"",  "-",   "+",  ".",   "-.", "e5",
                                        "x", "--1", "1e", "1e+", "in"};
    float value;
    int64_t integer;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const uint8_t *const stop = dp_number_float((const uint8_t *)texts[i], &value);
        if (stop) fail_msg("`%s` is taken for a number", texts[i]);
    }
    assert_null(dp_number_int((const uint8_t *)"", &integer));
    assert_null(dp_number_int((const uint8_t *)"-x", &integer));
    assert_null(dp_number_int((const uint8_t *)".5", &integer));
}

static int64_t parse_int(const char *text) {
    int64_t value = 0;
    const uint8_t *const stop = dp_number_int((const uint8_t *)text, &value);
    assert_non_null(stop);
    assert_int_equal(*stop, 0);
    return value;
}

static void integers_saturate(void **state) {
    (void)state;
    assert_int_equal(parse_int("0"), 0);
    assert_int_equal(parse_int("-17"), -17);
    assert_int_equal(parse_int("+4294967296"), 4294967296);
    assert_int_equal(parse_int("0000000000000000000000000012"), 12);
    assert_true(parse_int("999999999999999999999999999") > INT64_MAX / 20);
    assert_true(parse_int("-999999999999999999999999999") < -INT64_MAX / 20);
    assert_int_equal(parse_int("999999999999999999"), 999999999999999999);
}

static void the_locale_does_not_matter(void **state) {
    (void)state;
    const bool comma = setlocale(LC_NUMERIC, "de_DE.UTF-8") || setlocale(LC_NUMERIC, "fr_FR.UTF-8");
    if (!comma) print_message("no locale with a decimal comma: its test is left out\n");
    const float slow = parse("0.50000002980232238769531251"), quick = parse("1.25");
    setlocale(LC_NUMERIC, "C");
    assert_true(slow == strtof("0.50000002980232238769531251", NULL) && quick == 1.25f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chosen_floats_are_exact),
        cmocka_unit_test(random_floats_are_exact),
        cmocka_unit_test(middles_round_to_even),
        cmocka_unit_test(very_long_numbers_are_exact),
        cmocka_unit_test(what_is_not_finite_is_read),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(integers_saturate),
        cmocka_unit_test(the_locale_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
