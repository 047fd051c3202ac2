/* Parses values of options, strictly. Errors name the option, the bad value and valid ones. */
#include "colors.h"
#include "options.h"
#include "report.h"
#include "section.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

unsigned spelling_distance(const char *a, const char *b) {
    enum { LONGEST = 64 };
    unsigned row[LONGEST + 1];
    const size_t n = strlen(b);
    if (n > LONGEST) return (unsigned)n;
    for (size_t k = 0; k <= n; k++) row[k] = (unsigned)k;
    for (unsigned i = 1; *a; a++, i++) {
        unsigned diagonal = row[0];
        row[0] = i;
        for (size_t k = 1; k <= n; k++) {
            unsigned best = diagonal + (*a != b[k - 1]);
            if (row[k] + 1 < best) best = row[k] + 1;
            if (row[k - 1] + 1 < best) best = row[k - 1] + 1;
            diagonal = row[k];
            row[k] = best;
        }
    }
    return row[n];
}

int word_index(const char *words, const char *word) {
    const size_t n = strlen(word);
    for (int index = 1;; index++) {
        const size_t length = strcspn(words, "|");
        if (length == n && !strncmp(words, word, n)) return index;
        if (!words[length]) return 0;
        words += length + 1;
    }
}

/* ---- numbers ---- */

bool read_number(const char *text, const char *end, double *number) {
    char copy[64];
    const size_t n = (size_t)(end - text);
    if (!n || n >= sizeof copy || strspn(text, "0123456789+-.eE") < n) return false;
    memcpy(copy, text, n);
    copy[n] = 0;
    char *rest;
    *number = strtod(copy, &rest);
    return !*rest && rest != copy && isfinite(*number);
}

static bool read_count(const char *text, const char *end, uint64_t *count) {
    char copy[24];
    const size_t n = (size_t)(end - text);
    if (!n || n >= sizeof copy || strspn(text, "0123456789") < n) return false;
    memcpy(copy, text, n);
    copy[n] = 0;
    errno = 0;
    *count = strtoull(copy, NULL, 10);
    return !errno;
}

static const char *end_of(const char *text) { return text + strlen(text); }

static bool store_number(const option *o, const char *value, double *to) {
    double number;
    if (!read_number(value, end_of(value), &number))
        return wrong_usage("--%s: \"%s\" is not a number; give one like 1.5", o->name, value);
    const bool inside = o->kind == OPTION_INSIDE;
    if (inside ? number <= o->least || number >= o->most : number < o->least || number > o->most)
        return wrong_usage("--%s: %s is out of range; give a number %s %g and %s%g", o->name, value,
                           inside ? "above" : "between", o->least, inside ? "below " : "", o->most);
    *to = number;
    return true;
}

static bool store_detail(const option *o, const char *value, double *to) {
    if (!strcmp(value, "exact") || !strcmp(value, "auto")) {
        *to = !strcmp(value, "auto");
        return true;
    }
    if (*value && !strchr("+-.0123456789", *value))
        return wrong_usage("--%s: \"%s\" is neither exact nor auto nor a number like 0.5", o->name,
                           value);
    return store_number(o, value, to);
}

static bool store_count(const option *o, const char *value, uint64_t *to) {
    if (!read_count(value, end_of(value), to))
        return wrong_usage("--%s: \"%s\" is not a whole number; give one like 4", o->name, value);
    if ((double)*to < o->least || (double)*to > o->most)
        return wrong_usage("--%s: %s is out of range; give %.0f to %.0f", o->name, value, o->least,
                           o->most);
    return true;
}

/* Stores a number of bytes, or of K, M or G (powers of 1024). */
static bool store_bytes(const option *o, const char *value, double *to) {
    static const char units[] = "KMG";
    const char *end = end_of(value);
    const char *const unit = end > value ? strchr(units, end[-1] & ~32) : NULL;
    uint64_t count;
    if (unit && *unit) end--;
    if (!read_count(value, end, &count))
        return wrong_usage("--%s: \"%s\" is not a size; give one like 256M", o->name, value);
    *to = (double)count;
    if (unit && *unit) *to *= (double)((uint64_t)1024 << 10 * (unit - units));
    if (*to >= o->least && *to <= o->most) return true;
    return wrong_usage("--%s: %s is out of range; the least is %.0fM", o->name, value,
                       o->least / (1 << 20));
}

static bool store_point(const option *o, const char *value, double to[3]) {
    const char *at = value;
    for (int k = 0; k < 3; k++) {
        const char *const end = at + strcspn(at, ",");
        if (!read_number(at, end, &to[k]) || (*end == ',') != (k < 2))
            return wrong_usage("--%s: \"%s\" is not a point; give three numbers like 1,2.5,-3",
                               o->name, value);
        at = end + 1;
    }
    return true;
}

/* x, -z, +y, or three numbers. */
static bool store_up(const option *o, const char *value, double to[3]) {
    const char *const letter = value + (*value == '-' || *value == '+');
    memset(to, 0, 3 * sizeof *to);
    if (*letter >= 'x' && *letter <= 'z' && !letter[1]) {
        to[*letter - 'x'] = *value == '-' ? -1 : 1;
        return true;
    }
    if (!strchr(value, ','))
        return wrong_usage(
            "--%s: \"%s\" is no direction; give x, y, z, -x, -y, -z, or three numbers "
            "like 0,0,1",
            o->name, value);
    if (!store_point(o, value, to)) return false;
    const double square = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    return (square > 0 && isfinite(square)) ||
           wrong_usage("--%s: %s has no direction; give one like 0,0,1", o->name, value);
}

static bool store_angles(const option *o, const char *value, double to[2]) {
    const char *const comma = value + strcspn(value, ",");
    if (!*comma || !read_number(value, comma, &to[0]) ||
        !read_number(comma + 1, end_of(value), &to[1]))
        return wrong_usage("--%s: \"%s\" is not two angles; give degrees like -40,42", o->name,
                           value);
    if (fabs(to[1]) > 90)
        return wrong_usage("--%s: the elevation %g is out of range; give -90 to 90", o->name,
                           to[1]);
    return true;
}

static bool store_time(const option *o, const char *value, double to[2]) {
    const char *const colon = value + strcspn(value, ":"), *const end = value + strlen(value);
    const bool range = *colon == ':';
    if (read_number(value, colon, &to[0]) && (!range || read_number(colon + 1, end, &to[1]))) {
        if (!range) to[1] = to[0];
        return true;
    }
    return wrong_usage(
        "--%s: \"%s\" is no time; give seconds, as in 1.5, or from and to, as in 0:2", o->name,
        value);
}

static bool store_plane(const option *o, const char *value, tool_settings *settings) {
    const char *at = value;
    int count = 0;
    for (; count < 4; count++) {
        const char *const end = at + strcspn(at, ",");
        if (!read_number(at, end, &settings->mirror[count])) break;
        at = end + 1;
        if (!*end) {
            count++;
            break;
        }
    }
    const double *const n = settings->mirror;
    settings->has_mirror = true;
    settings->has_mirror_offset = count == 4;
    if (count < 3 || at[-1])
        return wrong_usage(
            "--%s: \"%s\" is not a plane; give three or four numbers like 0,1,0,-0.5", o->name,
            value);
    if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0) return true;
    return wrong_usage("--%s: the normal is zero; give one like 0,1,0", o->name);
}

/* Is the word before "=" no such name? That is probably a mistake, not part of a file's name. */
static bool unknown_output(const char *value, size_t length) {
    char name[64];
    int best = 0;
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1),
             value);
    for (int k = 1; k < OUTPUT_COUNT; k++)
        if (spelling_distance(name, output_names[k]) < spelling_distance(name, output_names[best]))
            best = k;
    return wrong_usage("--output: \"%s\" is nothing that can be written; did you mean %s? A file "
                       "of that name is ./%s",
                       name, output_names[best], value);
}

/* Each NAME is written once, and one model is made. */
static bool store_file(const char *file, const char *what, const char **to) {
    if (*to)
        return wrong_usage("--output: there is one %s at a time: \"%s\" comes after \"%s\"; leave "
                           "one out, or run it twice",
                           what, file, *to);
    *to = file;
    return true;
}

/* One run draws one picture, and may write it in several ways. */
static bool add_file(const char *path, tool_settings *settings) {
    if (settings->command == COMMAND_MAKE) return store_file(path, "model", &settings->output);
    if (settings->file_count == FILES_MOST)
        return wrong_usage("--output: %s is one too many; a run writes %d drawings at most", path,
                           FILES_MOST);
    settings->files[settings->file_count++] = path;
    return true;
}

/* Stores NAME=FILE under its name, anything else as a drawing's file. */
static bool store_output(const char *value, tool_settings *settings) {
    const size_t length = strcspn(value, "=");
    for (int k = 0; value[length] && k < OUTPUT_COUNT; k++) {
        if (strlen(output_names[k]) != length || strncmp(output_names[k], value, length)) continue;
        if (!value[length + 1])
            return wrong_usage("--output %s: a file is missing; give %sFILE%s", value, value,
                               k < PLANE_COUNT        ? ".png"
                               : k == OUTPUT_SEGMENTS ? ".json"
                                                      : "");
        settings->wants_edge_map |= k == PLANE_EDGE_MAP;
        return store_file(value + length + 1, output_names[k], &settings->outputs[k]);
    }
    if (value[length] && length && strspn(value, "abcdefghijklmnopqrstuvwxyz-") == length)
        return unknown_output(value, length);
    return add_file(value, settings);
}

static bool store_size(const option *o, const char *value, uint32_t to[2]) {
    const char *const cross = value + strcspn(value, "xX");
    uint64_t side[2];
    if (!*cross || !read_count(value, cross, &side[0]) ||
        !read_count(cross + 1, end_of(value), &side[1]))
        return wrong_usage("--%s: \"%s\" is not a size; give one like 1600x1200", o->name, value);
    for (int k = 0; k < 2; k++) {
        if ((double)side[k] < o->least || (double)side[k] > o->most)
            return wrong_usage("--%s: %s is out of range; each side can be %.0f to %.0f pixels",
                               o->name, value, o->least, o->most);
        to[k] = (uint32_t)side[k];
    }
    return true;
}

/* ---- words ---- */

const char *nearest_word(const char *words, const char *word, char *best, size_t size) {
    unsigned least = UINT32_MAX;
    for (;;) {
        char candidate[32];
        const size_t length = strcspn(words, "|");
        snprintf(candidate, sizeof candidate, "%.*s", (int)length, words);
        const unsigned distance = spelling_distance(word, candidate);
        if (distance < least) snprintf(best, size, "%s", candidate);
        if (distance < least) least = distance;
        if (!words[length]) return best;
        words += length + 1;
    }
}

bool is_slip(const char *word, const char *best) {
    return 2 * spelling_distance(word, best) <= strlen(best);
}

static bool store_word(const option *o, const char *value, int *to) {
    *to = word_index(o->argument, value);
    if (*to) return true;
    char best[32];
    nearest_word(o->argument, value, best, sizeof best);
    if (!is_slip(value, best))
        return wrong_usage("--%s: \"%s\" is none of %s", o->name, value, o->argument);
    return wrong_usage("--%s: \"%s\" is none of %s; did you mean %s?", o->name, value, o->argument,
                       best);
}

static const char class_words[] = "silhouette|ridge|valley|intersection|border|section|hatching";

/* The class named in [text, end), or DP_LINE_COUNT after a message. */
static dp_line read_class(const option *o, const char *text, const char *end) {
    char name[64], best[32];
    snprintf(name, sizeof name, "%.*s", (int)(end - text), text);
    for (int line = 0; line < DP_LINE_COUNT; line++)
        if (!strcmp(name, dp_line_name((dp_line)line))) return (dp_line)line;
    wrong_usage("--%s: \"%s\" is no class of lines; did you mean %s?", o->name, name,
                nearest_word(class_words, name, best, sizeof best));
    return DP_LINE_COUNT;
}

static bool store_lines(const option *o, const char *value, dp_style *style) {
    style->lines = 0;
    if (!strcmp(value, "all")) style->lines = DP_ALL_LINES;
    if (!strcmp(value, "none")) style->lines = DP_NO_LINES;
    if (style->lines) return true;
    for (const char *at = value;;) {
        const char *const end = at + strcspn(at, ",");
        const dp_line line = read_class(o, at, end);
        if (line == DP_LINE_COUNT) return false;
        style->lines |= 1u << line;
        if (!*end) return true;
        at = end + 1;
    }
}

/* ---- colours ---- */

static bool store_color(const option *o, const char *value, dp_color *to) {
    return color_read(value, end_of(value), to) || color_wrong(o->name, value, end_of(value));
}

/* ---- CLASS=VALUE,… ---- */

enum { WIDEST = 100 /* mm */ };

/* A width for all classes is twice as large as hatching's (widths.c). */
static tool_length class_width(tool_length width, int line, unsigned set) {
    width.halved = line == DP_LINE_HATCHING && set == DP_ALL_LINES;
    return width;
}

/* One value in [text, end) for the classes of `set`. */
static bool store_one(const option *o, const char *text, const char *end, unsigned set,
                      tool_settings *settings) {
    tool_length width = {0};
    dp_color color = 0;
    const int n = (int)(end - text);
    if (o->kind == OPTION_COLORS && !color_read(text, end, &color))
        return color_wrong(o->name, text, end);
    if (o->kind == OPTION_WIDTHS && !read_length(text, end, &width))
        return wrong_usage(
            "--%s: \"%.*s\" is not a width; give pixels like 2.5, or 0.5mm or 1pt, or "
            "0.2%% of the picture",
            o->name, n, text);
    if (width.unit == LENGTH_PX && (width.value < o->least || width.value > o->most))
        return wrong_usage("--%s: %.*s is out of range; give %g to %g pixels", o->name, n, text,
                           o->least, o->most);
    if (width.unit == LENGTH_SHARE && !(width.value > 0 && width.value <= 1))
        return wrong_usage("--%s: %.*s is out of range; give above 0%% and at most 100%%", o->name,
                           n, text);
    if (width.unit == LENGTH_MM && !(width.value > 0 && width.value <= WIDEST))
        return wrong_usage("--%s: %.*s is out of range; give above 0 and at most %d mm", o->name, n,
                           text, WIDEST);
    for (int line = 0; line < DP_LINE_COUNT; line++) {
        if (!(set >> line & 1)) continue;
        if (o->kind == OPTION_WIDTHS)
            settings->width_of[line] = class_width(width, line, set);
        else
            settings->style.line[line].color = color;
    }
    return true;
}

static bool store_classes(const option *o, const char *value, tool_settings *settings) {
    for (const char *at = value;;) {
        const char *const end = at + strcspn(at, ",");
        const char *const equals = at + strcspn(at, "=,");
        unsigned set = DP_ALL_LINES;
        if (*equals == '=') {
            const dp_line line = read_class(o, at, equals);
            if (line == DP_LINE_COUNT) return false;
            set = 1u << line;
            at = equals + 1;
        } else if (at != value) { /* it would undo what comes before it */
            return wrong_usage("--%s: only the first value can be for all classes; say which class "
                               "\"%.*s\" is for, as in ridge=%.*s",
                               o->name, (int)(end - at), at, (int)(end - at), at);
        }
        if (!store_one(o, at, end, set, settings)) return false;
        if (!*end) return true;
        at = end + 1;
    }
}

/* ---- [CLASS][:LEVEL]=VALUE,… ---- */

/* Reads a level behind a colon, or stands at the end: all levels. */
static bool read_level(const option *o, const char *text, const char *end, uint32_t *from,
                       uint32_t *to) {
    uint64_t level;
    *from = 0, *to = DP_LEVELS;
    if (text == end) return true;
    if (!read_count(text + 1, end, &level) || level < 1 || level > DP_LEVELS)
        return wrong_usage("--%s: \"%.*s\" is no level; give :1 to :%d", o->name, (int)(end - text),
                           text, DP_LEVELS);
    *from = (uint32_t)level - 1, *to = (uint32_t)level;
    return true;
}

/* Takes one value as store_one does, for the classes of `set` and levels [from, to). */
static bool store_hidden_one(const option *o, const char *text, const char *end, unsigned set,
                             uint32_t from, uint32_t to, tool_settings *settings) {
    tool_settings one = {0};
    option plain = *o;
    plain.kind = o->kind == OPTION_HIDDEN_WIDTHS ? OPTION_WIDTHS : OPTION_COLORS;
    if (!store_one(&plain, text, end, set, &one)) return false;
    for (int line = 0; line < DP_LINE_COUNT; line++)
        for (uint32_t level = from; level < to && set >> line & 1; level++)
            if (plain.kind == OPTION_WIDTHS)
                settings->hidden_width[level][line] = one.width_of[line];
            else
                settings->style.hidden.line[level][line].color = one.style.line[line].color;
    return true;
}

static bool store_hidden(const option *o, const char *value, tool_settings *settings) {
    for (const char *at = value;;) {
        const char *const end = at + strcspn(at, ","), *const equals = at + strcspn(at, "=,");
        unsigned set = DP_ALL_LINES;
        uint32_t from = 0, to = DP_LEVELS;
        if (*equals == '=') {
            const char *const colon = at + strcspn(at, ":=");
            if (colon > at) {
                const dp_line line = read_class(o, at, colon);
                if (line == DP_LINE_COUNT) return false;
                set = 1u << line;
            }
            if (!read_level(o, colon, equals, &from, &to)) return false;
            at = equals + 1;
        } else if (at != value) { /* it would undo what comes before it */
            return wrong_usage(
                "--%s: only the first value can be for all lines; say which class or "
                "level \"%.*s\" is for, as in ridge=%.*s or :2=%.*s",
                o->name, (int)(end - at), at, (int)(end - at), at, (int)(end - at), at);
        }
        if (!store_hidden_one(o, at, end, set, from, to, settings)) return false;
        if (!*end) return true;
        at = end + 1;
    }
}

/* ---- any ---- */

/* A table: a case for each kind. */
bool option_store(const option *o, const char *value, tool_settings *settings) {
    void *const to = (char *)settings + o->at;
    uint64_t count = 0;
    switch (o->kind) {
    case OPTION_FLAG:
        *(bool *)to = true;
        return true;
    case OPTION_TEXT:
        *(const char **)to = value;
        return true;
    case OPTION_COUNT:
        if (!store_count(o, value, &count)) return false;
        *(uint32_t *)to = (uint32_t)count;
        return true;
    case OPTION_COUNT64:
        return store_count(o, value, to);
    case OPTION_NUMBER:
    case OPTION_INSIDE:
        return store_number(o, value, to);
    case OPTION_BYTES:
        return store_bytes(o, value, to);
    case OPTION_POINT:
        return store_point(o, value, to);
    case OPTION_UP:
        return store_up(o, value, to);
    case OPTION_ANGLES:
        return store_angles(o, value, to);
    case OPTION_TIME:
        return store_time(o, value, to);
    case OPTION_DEFORM:
        return store_deform(o, value, to);
    case OPTION_PLANE:
        return store_plane(o, value, settings);
    case OPTION_CLIP:
        return store_clip(o, value, settings);
    case OPTION_SPACING:
        return store_spacing(o, value, to);
    case OPTION_OUTPUT:
        return store_output(value, settings);
    case OPTION_WORD:
        return store_word(o, value, to);
    case OPTION_SIZE:
        return store_size(o, value, to);
    case OPTION_LINES:
        return store_lines(o, value, to);
    case OPTION_WIDTHS:
    case OPTION_COLORS:
        return store_classes(o, value, settings);
    case OPTION_HIDDEN_WIDTHS:
    case OPTION_HIDDEN_COLORS:
        return store_hidden(o, value, settings);
    case OPTION_LENGTH:
        return store_length(o, value, to);
    case OPTION_PAGE:
        return store_page(o, value, to);
    case OPTION_MARGIN:
        return store_margin(o, value, to);
    case OPTION_SCALE:
        return store_scale(o, value, to);
    case OPTION_DETAIL:
        return store_detail(o, value, to);
    case OPTION_SHEET:
        return store_sheet(o, value, to);
    case OPTION_NAMES:
    case OPTION_OBJECT:
        return store_list(o, value, to);
    case OPTION_COLOR:
        return store_color(o, value, to);
    case OPTION_STATS:
        if (value && strcmp(value, "json"))
            return wrong_usage("--stats: \"%s\" is no form; leave it out, or give json", value);
        *(stats_kind *)to = value ? STATS_JSON : STATS_TABLE;
        return true;
    case OPTION_QUESTION:
        settings->question = (question)o->at;
        return true;
    }
    return false;
}
