/* --deform KIND[:NAME=VALUE,...], --morph MODEL and --blend. */
#include "deform.h"
#include "models.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char kind_words[] = "wave|breathe|twist";

/* ---- what --deform says ---- */

/* A number of a deformation. */
typedef struct member {
    const char *name;
    size_t at; /* offset in dp_deform */
    unsigned kinds;
} member;

enum {
    WAVE = 1u << DP_DEFORM_WAVE,
    BREATHE = 1u << DP_DEFORM_BREATHE,
    TWIST = 1u << DP_DEFORM_TWIST,
    ALL = WAVE | BREATHE | TWIST
};

static const member numbers[] = {{"amplitude", offsetof(dp_deform, amplitude), WAVE | BREATHE},
                                 {"angle", offsetof(dp_deform, amplitude), TWIST},
                                 {"length", offsetof(dp_deform, length), ALL},
                                 {"speed", offsetof(dp_deform, speed), ALL},
                                 {"slant", offsetof(dp_deform, slant), WAVE},
                                 {"at", offsetof(dp_deform, at), BREATHE}};
static const member directions[] = {{"axis", offsetof(dp_deform, axis), ALL},
                                    {"across", offsetof(dp_deform, across), WAVE}};
static const char *const names_of[] = {"amplitude|length|speed|axis|across|slant",
                                       "amplitude|length|speed|axis|at", "angle|length|speed|axis"};

static const member *find(const member *members, size_t count, const char *name,
                          dp_deform_kind kind) {
    for (size_t k = 0; k < count; k++)
        if (!strcmp(members[k].name, name) && members[k].kinds >> kind & 1) return &members[k];
    return NULL;
}

static double *value_at(dp_deform *d, const member *m) {
    return (double *)(void *)((char *)d + m->at);
}

static bool store_number(const option *o, const char *name, const char *text, const char *end,
                         double *to) {
    if (read_number(text, end, to) && *to != 0) return true;
    return wrong_usage("--%s: %s=%.*s is no number other than 0", o->name, name, (int)(end - text),
                       text);
}

/* x, -x, y, ... */
static bool store_direction(const option *o, const char *name, const char *text, const char *end,
                            double to[3]) {
    const bool negative = *text == '-';
    const char *const letter = text + (*text == '-' || *text == '+');
    if (end - letter != 1 || *letter < 'x' || *letter > 'z')
        return wrong_usage("--%s: %s=%.*s is none of x, y, z, -x, -y and -z", o->name, name,
                           (int)(end - text), text);
    to[*letter - 'x'] = negative ? -1 : 1;
    return true;
}

static bool is_none_of(const option *o, const char *words, const char *word) {
    char best[32];
    nearest_word(words, word, best, sizeof best);
    if (!is_slip(word, best))
        return wrong_usage("--%s: \"%s\" is none of %s", o->name, word, words);
    return wrong_usage("--%s: \"%s\" is none of %s; did you mean %s?", o->name, word, words, best);
}

/* NAME=VALUE */
static bool store_member(const option *o, const char *at, const char *end, dp_deform *to) {
    char name[32];
    const char *const names = names_of[to->kind];
    const size_t length = strcspn(at, "=,");
    snprintf(name, sizeof name, "%.*s", (int)length, at);
    const member *const number = find(numbers, sizeof numbers / sizeof *numbers, name, to->kind);
    const member *const way =
        find(directions, sizeof directions / sizeof *directions, name, to->kind);
    if (!number && !way) return is_none_of(o, names, name);
    if (at[length] != '=')
        return wrong_usage("--%s: %s has no value; write %s=%s, say", o->name, name, name,
                           way ? "x" : "0.1");
    if (value_at(to, number ? number : way)[0] != 0)
        return wrong_usage("--%s: %s is there twice; leave one out", o->name, name);
    at += length + 1;
    return way ? store_direction(o, name, at, end, value_at(to, way))
               : store_number(o, name, at, end, value_at(to, number));
}

bool store_deform(const option *o, const char *value, dp_deform *to) {
    char kind[32];
    const char *at = value + strcspn(value, ":");
    *to = (dp_deform){0};
    snprintf(kind, sizeof kind, "%.*s", (int)(at - value), value);
    const int word = word_index(kind_words, kind);
    if (!word) return is_none_of(o, kind_words, kind);
    to->kind = (dp_deform_kind)(word - 1);
    while (*at) {
        const char *const first = at + 1, *const end = first + strcspn(first, ",");
        if (!store_member(o, first, end, to)) return false;
        at = end;
    }
    return true;
}

/* ---- the open model ---- */

/* Without --blend the first model becomes the second within a second, and is half way at first. */
static dp_morph morph_of(const tool_settings *s) {
    if (s->has_blend) return (dp_morph){.blend = s->blend};
    if (s->has_time) return (dp_morph){.seconds = 1};
    return (dp_morph){.blend = 0.5};
}

/* "a.obj and b.obj: " before a message of both. */
static void report_morph(const tool_settings *s, const dp_diag *diag) {
    const size_t size = strlen(s->model) + strlen(s->morph) + 64;
    char *const both = malloc(size);
    if (both) snprintf(both, size, "%s and %s", model_spoken(s->model), model_spoken(s->morph));
    report_failure(both, diag);
    free(both);
}

static int blend(const tool_settings *s, dp_source **source, dp_source *other) {
    dp_diag diag = {0};
    dp_source *const first = *source;
    const dp_morph morph = morph_of(s);
    if (!dp_source_morph(first, other, &morph, NULL, source, &diag)) return 0;
    report_morph(s, &diag);
    dp_source_destroy(first);
    dp_source_destroy(other);
    return EXIT_FAILED;
}

int deform_model(const tool_settings *s, dp_source **source, dp_source *other) {
    dp_diag diag = {0};
    const int code = other ? blend(s, source, other) : 0;
    dp_source *const inner = *source;
    if (code || !s->has_deform || !dp_source_deform(inner, &s->deform, NULL, source, &diag))
        return code;
    dp_source_destroy(inner);
    return report_failure(diag.result == DP_ERR_ARGUMENT ? "--deform" : NULL, &diag);
}
