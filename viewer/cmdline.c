/* Command lines as lists of options.
 *
 * Invariant: options hold what the table of options has for pictures, each name once unless it was given several times
 * (--clip, --object); the camera's options are in a list of their own, which comes later on the command line.
 *
 * Presets for paper (--preset iso) are written as the options that they stand for, without those of pages: a window is
 * none. */
#include "cmdline.h"

#include "models.h"
#include "presets.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char camera_names[] = "eye|target|fov|ortho|view|azimuth|elevation|zoom";
static const char own_names[] = "backend|spin|dropped|size|quiet";

static const option *find_option(const char *name) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands >> COMMAND_VIEW & 1 && !strcmp(o->name, name)) return o;
    return NULL;
}

static bool takes_value(const option *o) {
    return o->kind != OPTION_FLAG && o->kind != OPTION_QUESTION;
}

/* ------- lists ------- */

static bool append(cmd_options *to, const char *name, const char *value) {
    cmd_option *const longer = realloc(to->items, (to->count + (size_t)1) * sizeof *longer);
    if (!longer) return false;
    to->items = longer;
    cmd_option *const o = &to->items[to->count];
    *o = (cmd_option){.name = strdup(name), .value = value ? strdup(value) : NULL};
    to->count++;
    return o->name && (!value || o->value);
}

static void free_option(cmd_option *o) {
    free(o->name);
    free(o->value);
}

void cmdline_set(cmd_options *options, const char *name, const char *value) {
    const option *const o = find_option(name);
    uint32_t kept = 0;
    for (uint32_t k = 0; k < options->count; k++) {
        if (strcmp(options->items[k].name, name))
            options->items[kept++] = options->items[k];
        else
            free_option(&options->items[k]);
    }
    options->count = kept;
    if (value) append(options, name, o && takes_value(o) ? value : NULL);
}

const char *cmdline_get(const cmd_options *options, const char *name) {
    for (uint32_t k = options->count; k-- > 0;)
        if (!strcmp(options->items[k].name, name))
            return options->items[k].value ? options->items[k].value : "";
    return NULL;
}

void cmdline_clear(cmd_options *options) {
    for (uint32_t k = 0; k < options->count; k++) free_option(&options->items[k]);
    free(options->items);
    *options = (cmd_options){0};
}

bool cmdline_copy(cmd_options *to, const cmd_options *from) {
    bool done = true;
    *to = (cmd_options){0};
    for (uint32_t k = 0; k < from->count; k++)
        done &= append(to, from->items[k].name, from->items[k].value);
    return done;
}

/* ------- reading ------- */

static bool add_model(cmdline *line, const char *name) {
    char **const longer = realloc(line->models, (line->model_count + (size_t)1) * sizeof *longer);
    if (!longer) return false;
    line->models = longer;
    line->models[line->model_count] = strdup(name);
    return line->models[line->model_count++] != NULL;
}

static void free_models(cmdline *line) {
    for (uint32_t k = 0; k < line->model_count; k++) free(line->models[k]);
    free(line->models);
    line->models = NULL;
    line->model_count = 0;
}

bool cmdline_models(cmdline *line, uint32_t count, const char *const *models) {
    bool done = true;
    free_models(line);
    for (uint32_t k = 0; k < count; k++) done &= add_model(line, models[k]);
    return done;
}

cmd_options *cmdline_list(cmdline *line, const char *name) {
    if (word_index(own_names, name)) return NULL;
    return word_index(camera_names, name) ? &line->camera : &line->options;
}

static bool add_option(cmdline *line, const char *name, const char *value) {
    cmd_options *const list = cmdline_list(line, name);
    return !list || append(list, name, value);
}

/* "--name=value", or "--name" and perhaps a word after it, which is taken. */
static bool read_option(cmdline *line, const char *word, char **words, int count, int *at) {
    char name[64];
    const char *const equals = strchr(word, '=');
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    const option *const o = find_option(name);
    const char *value = o && takes_value(o) && equals ? equals + 1 : NULL;
    if (o && takes_value(o) && !value && *at < count) value = words[(*at)++];
    return add_option(line, name, value);
}

bool cmdline_read(cmdline *line, int count, char **words) {
    bool done = true, only_words = false;
    for (int at = 0; at < count && done;) {
        const char *const word = words[at++];
        if (only_words || *word != '-' || !word[1])
            done = add_model(line, word);
        else if (!strcmp(word, "--"))
            only_words = true;
        else if (word[1] == '-')
            done = read_option(line, word + 2, words, count, &at);
    }
    return done;
}

void cmdline_free(cmdline *line) {
    free_models(line);
    cmdline_clear(&line->options);
    cmdline_clear(&line->camera);
}

/* ------- writing ------- */

static bool add_word(parsed *p, const char *format, ...) {
    char **const longer = realloc(p->words, (size_t)(p->count + 2) * sizeof *longer);
    if (!longer) return false;
    p->words = longer;
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    char *const word = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (word) vsnprintf(word, (size_t)length + 1, format, again);
    va_end(again);
    va_end(arguments);
    if (!word) return false;
    p->words[p->count++] = word;
    p->words[p->count] = NULL;
    return true;
}

static bool add_pair(parsed *p, const char *name, const char *value) {
    /* what begins with a dash is a value only behind = */
    if (value && *value == '-') return add_word(p, "--%s=%s", name, value);
    return add_word(p, "--%s", name) && (!value || add_word(p, "%s", value));
}

static bool is_for_paper(const preset *p) {
    return strstr(p->options, "--page ") || strstr(p->options, "--scale ");
}

/* The options of a preset for paper that are of pictures, cameras left out. */
static bool add_spelt_out(parsed *to, const preset *p) {
    char text[1024];
    bool done = true;
    snprintf(text, sizeof text, "%s", p->options);
    char *rest = text;
    for (char *word = strtok_r(rest, " ", &rest); word && done; word = strtok_r(rest, " ", &rest)) {
        const option *const o = find_option(word + 2);
        const bool has_value = o ? takes_value(o) : strcmp(word, "--optimize") != 0;
        char *const value = has_value ? strtok_r(rest, " ", &rest) : NULL;
        if (o && o->group != GROUP_CAMERA) done = add_pair(to, o->name, value);
    }
    return done;
}

static bool add_options(parsed *to, const cmd_options *options) {
    bool done = true;
    for (uint32_t k = 0; k < options->count && done; k++) {
        const cmd_option *const o = &options->items[k];
        const preset *const p = !strcmp(o->name, "preset") ? preset_find(o->value) : NULL;
        if (p && is_for_paper(p)) done = add_spelt_out(to, p);
    }
    for (uint32_t k = 0; k < options->count && done; k++) {
        const cmd_option *const o = &options->items[k];
        const preset *const p = !strcmp(o->name, "preset") ? preset_find(o->value) : NULL;
        if (!p || !is_for_paper(p)) done = add_pair(to, o->name, o->value);
    }
    return done;
}

static bool add_all(const cmdline *line, const char *output, parsed *to) {
    bool done = add_word(to, "drypoint");
    for (uint32_t k = 0; k < line->model_count && done; k++) {
        const char *const model = line->models[k];
        done = add_word(to, *model == '-' && model[1] ? "./%s" : "%s", model);
    }
    done = done && add_options(to, &line->options) && add_options(to, &line->camera) &&
           add_word(to, "--size") && add_word(to, "%ux%u", line->width, line->height);
    if (line->gl) done = done && add_word(to, "--gl");
    if (output) done = done && add_word(to, "-o") && add_word(to, "%s", output);
    return done;
}

bool cmdline_parse(const cmdline *line, const char *output, parsed *out) {
    *out = (parsed){0};
    if (!add_all(line, output ? output : "seen.png", out) || !add_word(out, "--quiet"))
        return false;
    return options_parse(out->count, out->words, &out->settings);
}

void parsed_free(parsed *p) {
    models_free(&p->settings);
    option_lists_free(&p->settings);
    for (int k = 0; k < p->count; k++) free(p->words[k]);
    free(p->words);
    *p = (parsed){0};
}

void parsed_move(parsed *to, parsed *from) {
    const bool several = from->settings.model == from->settings.models_name;
    parsed_free(to);
    *to = *from;
    if (several) to->settings.model = to->settings.models_name;
    *from = (parsed){0};
}

/* ------- for a shell ------- */

static bool is_plain(const char *word) {
    return *word && strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                 "-_./:=,%+@") == strlen(word);
}

/* Writes a word as a shell reads it; where it ends. */
static char *put_word(char *to, const char *word) {
    if (is_plain(word)) return stpcpy(to, word);
    *to++ = '\'';
    for (; *word; word++) {
        if (*word == '\'')
            to = stpcpy(to, "'\\''");
        else
            *to++ = *word;
    }
    *to++ = '\'';
    *to = 0;
    return to;
}

char *cmdline_text(const cmdline *line, const char *output) {
    parsed p = {0};
    size_t size = 1;
    char *text = NULL, *to;
    if (add_all(line, output, &p)) {
        for (int k = 0; k < p.count; k++) size += 4 * strlen(p.words[k]) + 3;
        to = text = malloc(size);
        for (int k = 0; text && k < p.count; k++) {
            if (k) *to++ = ' ';
            to = put_word(to, p.words[k]);
        }
    }
    parsed_free(&p);
    return text;
}
