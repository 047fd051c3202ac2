/* Pictures written as PNG: the same pixels when read, the fewest channels, and files that are
 * complete or untouched. */
#define _XOPEN_SOURCE 700 /* symlink, mkdtemp */
#include "temporary.h"

#include <drypoint/io.h>

#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 7, HEIGHT = 5, BYTES = 4 * WIDTH * HEIGHT };

static char directory[300];
static char path[340];

static int enter_directory(void **state) {
    (void)state;
    temporary_name(directory, sizeof directory, "png");
    if (!mkdtemp(directory)) return -1;
    snprintf(path, sizeof path, "%s/picture.png", directory);
    return 0;
}

static int leave_directory(void **state) {
    (void)state;
    unlink(path);
    return rmdir(directory); /* fails when anything was left behind */
}

static void paint(uint8_t rgba[BYTES], bool colour, bool alpha) {
    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        const uint8_t value = (uint8_t)(7 * k);
        rgba[4 * k] = rgba[4 * k + 1] = rgba[4 * k + 2] = value;
        if (colour) rgba[4 * k + 2] = (uint8_t)(255 - value);
        rgba[4 * k + 3] = alpha ? (uint8_t)(3 * k) : 255;
    }
}

/* The picture as libpng's own reader sees it, and the file's number of channels. */
static int read_back(uint8_t rgba[BYTES]) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, path));
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    const int channels = (int)PNG_IMAGE_SAMPLE_CHANNELS(image.format);
    image.format = PNG_FORMAT_RGBA;
    assert_true(png_image_finish_read(&image, NULL, rgba, 0, NULL));
    return channels;
}

/* A picture says how large it is on paper, where that is known: px per metre. */
static void resolutions_are_told(void **state) {
    (void)state;
    static const struct {
        uint32_t dpi, per_metre;
    } cases[] = {{0, 0}, {72, 2835}, {96, 3780}, {150, 5906}, {300, 11811}, {1000000, 39370079}};
    uint8_t rgba[BYTES], bytes[64];
    dp_diag diag;
    paint(rgba, true, true);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dp_io_picture picture = {
            .rgba = rgba, .width = WIDTH, .height = HEIGHT, .dpi = cases[k].dpi};
        assert_int_equal(dp_io_write_picture(path, &picture, &diag), DP_OK);
        FILE *const file = fopen(path, "rb");
        assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
        fclose(file);
        const bool told = !memcmp(bytes + 37, "pHYs", 4);
        assert_int_equal(told, cases[k].dpi > 0);
        for (int axis = 0; told && axis < 2; axis++) {
            const uint8_t *const at = bytes + 41 + 4 * axis;
            assert_int_equal((uint32_t)at[0] << 24 | at[1] << 16 | at[2] << 8 | at[3],
                             cases[k].per_metre);
        }
    }
    const dp_io_picture dense = {.rgba = rgba, .width = WIDTH, .height = HEIGHT, .dpi = 1000001};
    assert_int_equal(dp_io_write_picture(path, &dense, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "1000000 are the most"));
}

static void pixels_come_back(void **state) {
    (void)state;
    static const struct {
        bool colour, alpha;
        int channels;
    } cases[] = {{false, false, 1}, {false, true, 2}, {true, false, 3}, {true, true, 4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        uint8_t painted[BYTES], read[BYTES];
        paint(painted, cases[k].colour, cases[k].alpha);
        assert_int_equal(dp_io_write_png(path, painted, WIDTH, HEIGHT, 0, NULL), DP_OK);
        assert_int_equal(read_back(read), cases[k].channels);
        assert_memory_equal(painted, read, BYTES);
    }
}

static void rows_may_be_padded(void **state) {
    (void)state;
    enum { STRIDE = 4 * WIDTH + 12 };
    uint8_t painted[BYTES], padded[STRIDE * HEIGHT], read[BYTES];
    paint(painted, true, true);
    memset(padded, 0x5A, sizeof padded);
    for (int y = 0; y < HEIGHT; y++)
        memcpy(padded + y * STRIDE, painted + 4 * WIDTH * y, 4 * WIDTH);
    assert_int_equal(dp_io_write_png(path, padded, WIDTH, HEIGHT, STRIDE, NULL), DP_OK);
    read_back(read);
    assert_memory_equal(painted, read, BYTES);
}

/* ---- whole or untouched ---- */

static void write_text(const char *name, const char *text) {
    FILE *const file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void assert_text(const char *name, const char *text) {
    char read[64] = "";
    FILE *const file = fopen(name, "r");
    assert_non_null(file);
    assert_non_null(fgets(read, sizeof read, file));
    assert_int_equal(fclose(file), 0);
    assert_string_equal(read, text);
}

static int stop_at_once(void *user, double fraction) {
    (void)user;
    (void)fraction;
    return 1;
}

static void cancelling_keeps_the_old_file(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    paint(painted, true, true);
    write_text(path, "old");
    const dp_io_picture picture = {
        .rgba = painted, .width = WIDTH, .height = HEIGHT, .progress = stop_at_once};
    dp_diag diag = {0};
    assert_int_equal(dp_io_write_picture(path, &picture, &diag), DP_ERR_CANCELLED);
    assert_int_equal(diag.result, DP_ERR_CANCELLED);
    assert_text(path, "old");
}

static void permissions_stay(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    struct stat status;
    paint(painted, false, false);
    write_text(path, "old");
    assert_int_equal(chmod(path, 0640), 0);
    assert_int_equal(dp_io_write_png(path, painted, WIDTH, HEIGHT, 0, NULL), DP_OK);
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 07777, 0640);
}

static void links_stay_links(void **state) {
    (void)state;
    uint8_t painted[BYTES], read[BYTES];
    char link[340];
    struct stat status;
    paint(painted, true, false);
    write_text(path, "old");
    snprintf(link, sizeof link, "%s/link.png", directory);
    assert_int_equal(symlink("picture.png", link), 0);
    assert_int_equal(dp_io_write_png(link, painted, WIDTH, HEIGHT, 0, NULL), DP_OK);
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    read_back(read);
    assert_memory_equal(painted, read, BYTES);
    unlink(link);
}

/* ---- errors ---- */

static void a_full_disk_is_an_error(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    dp_diag diag = {0};
    paint(painted, true, true);
    if (access("/dev/full", W_OK)) skip();
    assert_int_equal(dp_io_write_png("/dev/full", painted, WIDTH, HEIGHT, 0, &diag), DP_ERR_IO);
    assert_non_null(strstr(diag.message, "No space left"));
    assert_non_null(strstr(diag.message, "/dev/full"));
}

static void devices_are_written_in_place(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    struct stat status;
    paint(painted, true, true);
    assert_int_equal(dp_io_write_png("/dev/null", painted, WIDTH, HEIGHT, 0, NULL), DP_OK);
    assert_int_equal(stat("/dev/null", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
}

static void bad_places_are_errors(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    char missing[340];
    dp_diag diag = {0};
    paint(painted, true, true);
    snprintf(missing, sizeof missing, "%s/none/picture.png", directory);
    assert_int_equal(dp_io_write_png(missing, painted, WIDTH, HEIGHT, 0, &diag), DP_ERR_IO);
    assert_non_null(strstr(diag.message, missing));
    assert_int_equal(dp_io_write_png(directory, painted, WIDTH, HEIGHT, 0, &diag), DP_ERR_IO);
    assert_int_equal(dp_io_write_png("", painted, WIDTH, HEIGHT, 0, &diag), DP_ERR_IO);
}

static void wrong_calls_are_refused(void **state) {
    (void)state;
    uint8_t painted[BYTES];
    paint(painted, true, true);
    dp_diag diag = {0};
    assert_int_equal(dp_io_write_png(NULL, painted, 1, 1, 0, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_png(path, NULL, 1, 1, 0, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_png(path, painted, 0, 1, 0, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_png(path, painted, 1, 0, 0, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_png(path, painted, UINT32_MAX, 1, 0, &diag), DP_ERR_LIMIT);
    assert_int_equal(dp_io_write_png(path, painted, WIDTH, HEIGHT, 4 * WIDTH - 1, &diag),
                     DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "bytes apart"));
    assert_true(access(path, F_OK) != 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_directory, leave_directory)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(resolutions_are_told),    TEST(pixels_come_back),
        TEST(rows_may_be_padded),      TEST(cancelling_keeps_the_old_file),
        TEST(permissions_stay),        TEST(links_stay_links),
        TEST(a_full_disk_is_an_error), TEST(devices_are_written_in_place),
        TEST(bad_places_are_errors),   TEST(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
