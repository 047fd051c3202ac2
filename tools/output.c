/* Checks an output's path before the work begins, so that a typing error is found before the
 * drawing. The writer checks again. */
#include "output.h"
#include "report.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

const char *output_name(const char *path) {
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool output_in_place(const char *path) {
    struct stat status;
    if (!strcmp(path, "-")) return true;
    return !stat(path, &status) && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

bool output_has_ending(const char *path, const char *ending) {
    const char *const dot = strrchr(output_name(path), '.');
    return dot && !strcasecmp(dot, ending);
}

bool output_same(const char *path, const char *other) {
    struct stat a, b;
    if (stat(path, &a) || stat(other, &b)) return !strcmp(path, other);
    return S_ISREG(a.st_mode) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

int output_stem(const char *path) {
    const char *const dot = strrchr(output_name(path), '.');
    return (int)(dot ? (size_t)(dot - path) : strlen(path));
}

bool output_is_folder(const char *path) {
    struct stat status;
    const size_t length = strlen(path);
    if (length && path[length - 1] == '/') return true;
    return !stat(path, &status) && S_ISDIR(status.st_mode);
}

bool output_is_pattern(const char *path) {
    for (const char *at = strchr(path, '%'); at; at = strchr(at + (at[1] ? 2 : 1), '%'))
        if (at[1] == 's') return true;
    return false;
}

/* The text with %% for %. */
static const char *double_signs(const char *text, char *doubled, size_t size) {
    size_t length = 0;
    for (; *text && length + 3 < size; text++) {
        doubled[length++] = *text;
        if (*text == '%') doubled[length++] = '%';
    }
    doubled[length] = 0;
    return doubled;
}

bool output_fill(const char *pattern, const char *stem, char *path, size_t size) {
    const bool sequence = output_is_sequence(pattern); /* is filled once more */
    char doubled[2 * PATH_MAX];
    size_t length = 0;
    if (sequence) stem = double_signs(stem, doubled, sizeof doubled);
    for (const char *at = pattern; *at; at++) {
        const char one[2] = {*at, 0}, *piece = one;
        if (at[0] == '%' && at[1] == 's') piece = stem;
        if (sequence && at[0] == '%' && at[1] == '%') piece = "%%";
        if (at[0] == '%' && (at[1] == 's' || at[1] == '%')) at++;
        const size_t n = strlen(piece);
        if (length + n >= size) return false;
        memcpy(path + length, piece, n);
        length += n;
    }
    path[length] = 0;
    return true;
}

/* "%d", "%4d" or "%04d" at `at`: how many digits there are at least; -1: it is something else. */
static int number_at(const char *at, size_t *length) {
    const size_t digits = strspn(at + 1, "0123456789");
    if (*at != '%' || digits > 3 || at[1 + digits] != 'd') return -1;
    *length = digits + 2;
    return atoi(at + 1);
}

bool output_is_sequence(const char *path) {
    size_t length;
    for (const char *at = strchr(path, '%'); at; at = strchr(at + (at[1] ? 2 : 1), '%'))
        if (number_at(at, &length) >= 0) return true;
    return false;
}

bool output_number(const char *pattern, uint32_t number, char *path, size_t size) {
    size_t length = 0;
    for (const char *at = pattern; *at;) {
        char piece[1024] = {*at, 0};
        size_t taken = at[0] == '%' && at[1] == '%' ? 2 : 1;
        const int digits = number_at(at, &taken);
        if (digits >= 0) snprintf(piece, sizeof piece, "%0*u", digits, number);
        const size_t n = strlen(piece);
        if (length + n >= size) return false;
        memcpy(path + length, piece, n);
        length += n;
        at += taken;
    }
    path[length] = 0;
    return true;
}

bool output_possible(const char *path) {
    char directory[PATH_MAX], first[PATH_MAX];
    struct stat status;
    if (output_is_sequence(path) && output_number(path, 0, first, sizeof first)) path = first;
    if (output_in_place(path)) return true;
    const int length = (int)(output_name(path) - path);
    snprintf(directory, sizeof directory, "%.*s", length ? length : 1, length ? path : ".");
    if (stat(directory, &status))
        return wrong_usage("cannot write %s: %s: %s; make the directory first", path, directory,
                           strerror(errno));
    if (!S_ISDIR(status.st_mode))
        return wrong_usage("cannot write %s: %s is not a directory", path, directory);
    if (access(directory, W_OK | X_OK) || (!access(path, F_OK) && access(path, W_OK)))
        return wrong_usage("cannot write %s: %s; choose a place you may write to", path,
                           strerror(errno));
    return true;
}
