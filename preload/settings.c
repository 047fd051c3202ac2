/* settings.c: the environment variables DRYPOINT_..., each a row of a table, and messages on stderr.
 *
 * They are read when the program first uses GL, once, and never change afterwards. A value that cannot be
 * read is reported and its default taken. Programs that are started by the program and use no GL
 * inherit LD_PRELOAD, too, and must not be bothered: nothing happens before the first GL call. */
#include "settings.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The defaults are those of drypoint/style.h. */
static struct settings chosen = {
    .lines = LINES_ALL,
    .width = 2.0f,
    .ridge_angle = 150.0f,
    .valley_angle = 210.0f,
    .paper = {1.0f, 1.0f, 1.0f},
};

void say_once(enum message message, const char *format, ...) {
    static atomic_bool said[SAY_COUNT];
    if (atomic_exchange(&said[message], true)) return;
    va_list list;
    va_start(list, format);
    char text[512];
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fprintf(stderr, "drypoint: %s\n", text);
}

static void bad_value(const char *name, const char *value, const char *wanted) {
    fprintf(stderr, "drypoint: %s=%.40s: want %s; ignored\n", name, value, wanted);
}

/* Numbers with a point in every locale: the program may have set one with a comma. */
static bool read_decimal(const char *text, double *value) {
    double number = 0, unit = 1;
    bool digits = false, point = false;
    for (; *text; text++) {
        if (*text == '.' && !point) {
            point = true;
        } else if (*text >= '0' && *text <= '9') {
            digits = true;
            number = number * 10 + (*text - '0');
            if (point) unit *= 10;
        } else {
            return false;
        }
        if (number > 1e12) return false;
    }
    *value = number / unit;
    return digits;
}

static void read_number(const char *name, float from, float to, float *result) {
    const char *const value = getenv(name);
    if (!value || !*value) return;
    double number;
    if (read_decimal(value, &number) && number >= from && number <= to) {
        *result = (float)number;
        return;
    }
    char wanted[64];
    snprintf(wanted, sizeof wanted, "a number from %g to %g", (double)from, (double)to);
    bad_value(name, value, wanted);
}

/* "#rrggbb" or "rrggbb" */
static bool read_color(const char *name, float color[3]) {
    const char *const value = getenv(name);
    if (!value || !*value) return false;
    const char *const digits = *value == '#' ? value + 1 : value;
    if (strlen(digits) != 6 || strspn(digits, "0123456789abcdefABCDEF") != 6) {
        bad_value(name, value, "a colour, #rrggbb");
        return false;
    }
    const unsigned long rgb = strtoul(digits, NULL, 16);
    for (int i = 0; i < 3; i++) color[i] = (float)(rgb >> (16 - 8 * i) & 255) / 255.0f;
    return true;
}

/* 1, 0, yes, no, on, off. */
static bool read_switch(const char *value, bool *on) {
    static const char *const words[2][4] = {{"0", "no", "off", "false"},
                                            {"1", "yes", "on", "true"}};
    for (int i = 0; i < 8; i++) {
        if (strcasecmp(value, words[i / 4][i % 4]) != 0) continue;
        *on = i / 4 != 0;
        return true;
    }
    return false;
}

struct word {
    const char *name;
    unsigned bits;
};

/* A list of words between commas or spaces; false at an unknown one. */
static bool read_words(const char *value, const struct word *words, int count, unsigned *bits) {
    *bits = 0;
    for (const char *at = value + strspn(value, ", "); *at; at += strspn(at, ", ")) {
        const size_t length = strcspn(at, ", ");
        int i = 0;
        while (i < count &&
               (strlen(words[i].name) != length || strncasecmp(words[i].name, at, length) != 0))
            i++;
        if (i == count) return false;
        *bits |= words[i].bits;
        at += length;
    }
    return true;
}

static void read_lines(void) {
    static const struct word kinds[] = {
        {"silhouette", LINES_SILHOUETTE},
        {"silhouettes", LINES_SILHOUETTE},
        {"ridge", LINES_RIDGE},
        {"ridges", LINES_RIDGE},
        {"valley", LINES_VALLEY},
        {"valleys", LINES_VALLEY},
        {"all", LINES_ALL},
    };
    const char *const value = getenv("DRYPOINT_LINES");
    unsigned bits;
    if (!value || !*value) return;
    if (read_switch(value, &chosen.forced)) return;
    if (!read_words(value, kinds, sizeof kinds / sizeof kinds[0], &bits) || !bits) {
        bad_value("DRYPOINT_LINES", value, "1, 0, or some of silhouette,ridge,valley");
        return;
    }
    chosen.lines = bits;
    chosen.forced = true;
}

static void read_also(void) {
    static const struct word draws[] = {{"textured", 1}, {"blended", 2}};
    const char *const value = getenv("DRYPOINT_ALSO");
    unsigned bits;
    if (!value) return;
    if (!read_words(value, draws, 2, &bits)) {
        bad_value("DRYPOINT_ALSO", value, "some of textured,blended");
        return;
    }
    chosen.textured = bits & 1;
    chosen.blended = bits & 2;
}

/* Who asks by glEnable wants lines on the picture it has; who is drawn unasked becomes a line drawing. */
static void read_shaded(void) {
    bool shaded = !chosen.forced;
    const char *const value = getenv("DRYPOINT_SHADED");
    if (value && *value && !read_switch(value, &shaded))
        bad_value("DRYPOINT_SHADED", value, "1 or 0");
    chosen.paper_white = !shaded;
}

static void read_inks(void) {
    static const char *const names[] = {"DRYPOINT_SILHOUETTE_INK", "DRYPOINT_RIDGE_INK",
                                        "DRYPOINT_VALLEY_INK"};
    float all[3];
    const bool same = read_color("DRYPOINT_INK", all);
    for (int i = 0; i < 3; i++) {
        if (same) memcpy(chosen.ink[i], all, sizeof all);
        read_color(names[i], chosen.ink[i]);
    }
}

static void read_environment(void) {
    read_lines();
    read_also();
    read_shaded();
    read_number("DRYPOINT_WIDTH", 0.5f, 64.0f, &chosen.width);
    read_number("DRYPOINT_RIDGE_ANGLE", 1.0f, 180.0f, &chosen.ridge_angle);
    read_number("DRYPOINT_VALLEY_ANGLE", 180.0f, 359.0f, &chosen.valley_angle);
    read_color("DRYPOINT_PAPER", chosen.paper);
    read_inks();
}

const struct settings *settings(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, read_environment);
    return &chosen;
}
