/* Parses values of pages, strictly: paper, margins, scales, sheets, and lengths with a unit. */
#include "options.h"
#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- lengths ---- */

typedef struct unit {
    const char *name;
    length_unit kind;
    double factor; /* mm, or the share */
} unit;

static const unit units[] = {{"px", LENGTH_PX, 1},         {"mm", LENGTH_MM, 1},
                             {"cm", LENGTH_MM, 10},        {"in", LENGTH_MM, 25.4},
                             {"pt", LENGTH_MM, 25.4 / 72}, {"%", LENGTH_SHARE, 0.01}};

/* The unit that [text, end) ends in, or NULL. */
static const unit *unit_at_end(const char *text, const char *end) {
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        const size_t n = strlen(units[k].name);
        if ((size_t)(end - text) >= n && !strncmp(end - n, units[k].name, n)) return &units[k];
    }
    return NULL;
}

bool read_length(const char *text, const char *end, tool_length *length) {
    static const unit pixels = {"", LENGTH_PX, 1};
    const unit *const found = unit_at_end(text, end), *const u = found ? found : &pixels;
    double number;
    if (!read_number(text, end - strlen(u->name), &number)) return false;
    *length = (tool_length){.value = number * u->factor, .unit = u->kind};
    return true;
}

bool store_length(const option *o, const char *value, tool_length *to) {
    if (!read_length(value, value + strlen(value), to))
        return wrong_usage(
            "--%s: \"%s\" is not a length; give pixels like 2.5, or 0.5mm or 1pt, or "
            "0.2%%",
            o->name, value);
    if (to->unit == LENGTH_SHARE && !(to->value >= 0 && to->value <= 1))
        return wrong_usage("--%s: %s is out of range; give 0%% to 100%%", o->name, value);
    if (to->value >= o->least && to->value <= o->most) return true;
    return wrong_usage("--%s: %s is out of range; give %g to %g", o->name, value, o->least,
                       o->most);
}

/* ---- paper ---- */

typedef struct paper {
    const char *name;
    double width, height; /* mm, portrait */
} paper;

static const paper papers[] = {
    {"A0", 841, 1189},        {"A1", 594, 841},        {"A2", 420, 594},
    {"A3", 297, 420},         {"A4", 210, 297},        {"A5", 148, 210},
    {"letter", 215.9, 279.4}, {"legal", 215.9, 355.6}, {"tabloid", 279.4, 431.8}};
static const char paper_words[] = "A0|A1|A2|A3|A4|A5|letter|legal|tabloid";

static const double smallest = 5, largest = 10000; /* mm */

/* Capital A, all else small: a4 is A4, LETTER is letter. */
static void spell(const char *value, size_t length, char *name, size_t size) {
    snprintf(name, size, "%.*s", (int)length, value);
    for (char *c = name; *c; c++)
        if (*c >= 'A' && *c <= 'Z') *c = (char)(*c + 32);
    if (*name == 'a') *name = 'A';
}

static bool unknown_paper(const option *o, const char *value) {
    char best[32];
    nearest_word(paper_words, value, best, sizeof best);
    if (2 * spelling_distance(value, best) <= strlen(best))
        return wrong_usage(
            "--%s: \"%s\" is none of A0 to A5, letter, legal, tabloid and sizes like "
            "200x100mm; did you mean %s?",
            o->name, value, best);
    return wrong_usage("--%s: \"%s\" is none of A0 to A5, letter, legal, tabloid and sizes like "
                       "200x100mm",
                       o->name, value);
}

/* WxHmm, or another unit of paper. */
static bool store_paper_size(const option *o, const char *value, tool_page *to) {
    const char *const cross = value + strcspn(value, "xX"), *const end = value + strlen(value);
    const unit *const u = unit_at_end(value, end);
    double side[2];
    if (!u || u->kind != LENGTH_MM)
        return wrong_usage("--%s: \"%s\" has no unit; give one like 200x100mm, or 8x5in", o->name,
                           value);
    if (!read_number(value, cross, &side[0]) || !read_number(cross + 1, end - 2, &side[1]))
        return wrong_usage("--%s: \"%s\" is not a size; give one like 200x100mm", o->name, value);
    for (int k = 0; k < 2; k++) {
        side[k] *= u->factor;
        if (!(side[k] >= smallest && side[k] <= largest))
            return wrong_usage("--%s: %s is out of range; each side can be %g to %g mm", o->name,
                               value, smallest, largest);
    }
    *to = (tool_page){value, side[0], side[1], TURN_AS_IS};
    return true;
}

bool store_page(const option *o, const char *value, tool_page *to) {
    static const char *const turns[] = {
        [TURN_PORTRAIT] = "-portrait", [TURN_LANDSCAPE] = "-landscape"};
    char name[16];
    page_turn turn = TURN_AUTO;
    size_t length = strlen(value);
    if (!strcmp(value, "none")) {
        *to = (tool_page){.width = -1};
        return true;
    }
    if (*value >= '0' && *value <= '9' && strpbrk(value, "xX"))
        return store_paper_size(o, value, to);
    for (int k = TURN_PORTRAIT; k <= TURN_LANDSCAPE; k++) {
        const size_t n = strlen(turns[k]);
        if (length <= n || strcmp(value + length - n, turns[k])) continue;
        turn = (page_turn)k;
        length -= n;
        break;
    }
    spell(value, length, name, sizeof name);
    for (size_t k = 0; k < sizeof papers / sizeof *papers; k++) {
        const paper *const p = &papers[k];
        if (strcmp(p->name, name)) continue;
        *to = (tool_page){p->name, p->width, p->height, turn};
        return true;
    }
    return unknown_paper(o, value);
}

/* How many numbers there are, up to four; 0: something else. */
static int read_numbers(const char *at, double to[4]) {
    for (int n = 0; n < 4; n++) {
        const char *const end = at + strcspn(at, ",");
        if (!read_number(at, end, &to[n])) return 0;
        if (!*end) return n + 1;
        at = end + 1;
    }
    return 0;
}

bool store_margin(const option *o, const char *value, double to[4]) {
    const int count = read_numbers(value, to);
    if (count != 1 && count != 4)
        return wrong_usage("--%s: \"%s\" is not one or four numbers; give millimetres like 10, or "
                           "top,right,bottom,left like 25,15,10,25",
                           o->name, value);
    for (int k = count; k < 4; k++) to[k] = to[0];
    for (int k = 0; k < 4; k++)
        if (to[k] < o->least || to[k] > o->most)
            return wrong_usage("--%s: %g is out of range; give %g to %g mm", o->name, to[k],
                               o->least, o->most);
    return true;
}

bool store_scale(const option *o, const char *value, tool_scale *to) {
    const char *const colon = value + strcspn(value, ":");
    *to = (tool_scale){0};
    if (!strcmp(value, "fit")) return true;
    if (!*colon || !read_number(value, colon, &to->paper) ||
        !read_number(colon + 1, colon + strlen(colon), &to->model))
        return wrong_usage("--%s: \"%s\" is not a scale; give one like 1:10 or 2:1, or fit",
                           o->name, value);
    if (to->paper > 0 && to->model > 0 && to->paper / to->model <= 1e6 &&
        to->model / to->paper <= 1e9)
        return true;
    return wrong_usage("--%s: %s is out of range; both sides are above 0, and 1000000:1 is the "
                       "largest",
                       o->name, value);
}

static const char view_words[] = "front|back|left|right|top|bottom|iso";

bool store_sheet(const option *o, const char *value, tool_sheet *to) {
    *to = (tool_sheet){0};
    for (const char *at = value;;) {
        char name[32], best[32];
        const char *const end = at + strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)(end - at), at);
        const int view = word_index(view_words, name);
        if (!view)
            return wrong_usage("--%s: \"%s\" is none of %s; did you mean %s?", o->name, name,
                               view_words, nearest_word(view_words, name, best, sizeof best));
        for (int k = 0; k < to->count; k++)
            if (to->views[k] == view)
                return wrong_usage("--%s: %s is there twice; leave one out", o->name, name);
        to->views[to->count++] = view;
        if (!*end) return true;
        at = end + 1;
    }
}
