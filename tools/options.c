/* Parses the command line by the table of options.
 *
 * The first word may be a command; without one the program draws. Options may come anywhere, as
 * --name value, --name=value or -o value; -- ends them; - is a model or output. */
#include "film.h"
#include "models.h"
#include "options.h"
#include "presets.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

typedef struct walk {
    int argc, at;
    char **argv;
    tool_settings *settings;
    bool only_words; /* after -- */
    bool of_preset;  /* options of other commands are passed over: bench has no pages */
} walk;

static const char *const command_words = "info|make|bench|view";

static const option *find_name(const char *name, size_t length, unsigned commands) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (strlen(o->name) == length && !strncmp(o->name, name, length) && o->commands & commands)
            return o;
    return NULL;
}

static const option *find_letter(char letter, unsigned commands) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (letter && o->letter == letter && o->commands & commands) return o;
    return NULL;
}

static const char *spoken_name(unsigned command) {
    return command == COMMAND_DRAW ? "MODEL" : command_table[command].name;
}

/* The viewer's word for OpenGL is another than the program's. */
static bool other_word(const option *o, tool_command command) {
    if (command == COMMAND_VIEW && !strcmp(o->name, "gl"))
        return wrong_usage("option --gl does not belong to \"drypoint view\"; give --backend gl");
    if (command == COMMAND_DRAW && !strcmp(o->name, "backend"))
        return wrong_usage("option --backend does not belong to \"drypoint MODEL\"; give --gl");
    return true;
}

static bool misplaced_option(const option *o, tool_command command) {
    unsigned owner = 0;
    if (!other_word(o, command)) return false;
    while (!(o->commands >> owner & 1)) owner++;
    return wrong_usage("option --%s does not belong to \"drypoint %s\" but to \"drypoint %s\"",
                       o->name, spoken_name(command), spoken_name(owner));
}

static bool unknown_option(const char *name, tool_command command) {
    const unsigned here = 1u << command;
    const option *best = NULL;
    const option *const elsewhere = find_name(name, strlen(name), ~here);
    if (elsewhere) return misplaced_option(elsewhere, command);
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands & here && o->group != GROUP_HIDDEN &&
            (!best || spelling_distance(name, o->name) < spelling_distance(name, best->name)))
            best = o;
    return wrong_usage("unknown option --%s; did you mean --%s?", name, best->name);
}

static bool takes_value(const option *o) {
    return o->kind != OPTION_FLAG && o->kind != OPTION_QUESTION;
}

/* Finds the value of an option: after "=", or the next word. */
static bool find_value(walk *w, const option *o, const char **value) {
    if (*value || !takes_value(o)) return true;
    const char *const next = w->at < w->argc ? w->argv[w->at] : NULL;
    if (o->kind == OPTION_STATS) {
        if (next && !strcmp(next, "json")) *value = w->argv[w->at++];
        return true;
    }
    if (!next || !strncmp(next, "--", 2))
        return wrong_usage("option --%s needs a value: --%s %s", o->name, o->name, o->argument);
    *value = w->argv[w->at++];
    return true;
}

static bool take_option(walk *w, const option *o, const char *value) {
    if (value && !takes_value(o))
        return wrong_usage("option --%s takes no value; leave out \"=%s\"", o->name, value);
    if (!find_value(w, o, &value)) return false;
    if (o->given) *((bool *)((char *)w->settings + o->given)) = true;
    w->settings->given[o - option_table] |= !w->of_preset;
    return option_store(o, value, w->settings);
}

static bool take_long(walk *w, const char *text) {
    const char *const equals = text + strcspn(text, "=");
    const size_t length = (size_t)(equals - text);
    const tool_command command = w->settings->command;
    const option *const o = find_name(text, length, 1u << command);
    if (o) return take_option(w, o, *equals ? equals + 1 : NULL);
    const option *const elsewhere =
        w->of_preset ? find_name(text, length, 1u << COMMAND_DRAW) : NULL;
    if (elsewhere) {
        w->at += takes_value(elsewhere);
        return true;
    }
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    return unknown_option(name, command);
}

static bool take_short(walk *w, const char *text) {
    const unsigned here = 1u << w->settings->command;
    const option *const o = find_letter(*text, here);
    if (o) return take_option(w, o, text[1] ? text + 1 : NULL);
    const option *const whole = find_name(text, strcspn(text, "="), here);
    const option *const elsewhere = find_letter(*text, ~here);
    if (elsewhere && !text[1]) return misplaced_option(elsewhere, w->settings->command);
    if (whole) return wrong_usage("unknown option -%s; did you mean --%s?", text, whole->name);
    return wrong_usage("unknown option -%c; did you mean -o, -q or -h?", *text);
}

static bool take_word(walk *w, const char *word) {
    tool_settings *const s = w->settings;
    if (s->command != COMMAND_MAKE) return models_add(s, word);
    if (s->model)
        return wrong_usage(
            "there is one shape at a time: \"%s\" comes after \"%s\"; options begin with --", word,
            s->model);
    s->model = word;
    return true;
}

static bool take(walk *w) {
    const char *const word = w->argv[w->at++];
    if (w->only_words || *word != '-' || !word[1]) return take_word(w, word);
    if (word[1] != '-') return take_short(w, word + 1);
    if (word[2]) return take_long(w, word + 2);
    w->only_words = true;
    return true;
}

static void begin(walk *w) {
    const char *const first = w->argc > 1 ? w->argv[1] : "";
    w->at = 1;
    const int word = word_index(command_words, first);
    if (word) {
        w->settings->command = (tool_command)word;
        w->at = 2;
    } else if (!strcmp(first, "help")) {
        w->settings->question = QUESTION_HELP;
        w->at = 2;
    }
}

enum { PRESETS_MOST = 8, PRESET_WORDS = 1024 /* bytes */ };

/* Applies a preset's options, before all others. Settings point into `words`, which stay. */
static bool apply_preset(tool_settings *settings, const char *name, char words[PRESET_WORDS]) {
    char *argv[64] = {NULL};
    walk w = {.argc = 1, .at = 1, .argv = argv, .settings = settings, .of_preset = true};
    const preset *const p = preset_find(name);
    if (!p) return true; /* the option's own check reports it */
    snprintf(words, PRESET_WORDS, "%s", p->options);
    for (char *word = strtok(words, " "); word && w.argc < 63; word = strtok(NULL, " "))
        argv[w.argc++] = word;
    while (w.at < w.argc)
        if (!take(&w)) return false;
    return true;
}

/* Presets in their order: a later one changes what an earlier one said. */
static bool apply_presets(walk *w) {
    static char words[PRESETS_MOST][PRESET_WORDS];
    int count = 0;
    for (int k = w->at; k < w->argc && strcmp(w->argv[k], "--"); k++) {
        const char *const value = !strcmp(w->argv[k], "--preset") && k + 1 < w->argc
                                      ? w->argv[k + 1]
                                  : !strncmp(w->argv[k], "--preset=", 9) ? w->argv[k] + 9
                                                                         : NULL;
        if (!value || w->settings->command == COMMAND_INFO || w->settings->command == COMMAND_MAKE)
            continue;
        if (count == PRESETS_MOST)
            return wrong_usage("--preset is given more than %d times", PRESETS_MOST);
        if (!apply_preset(w->settings, value, words[count++])) return false;
    }
    return true;
}

bool options_parse(int argc, char **argv, tool_settings *settings) {
    walk w = {.argc = argc, .argv = argv, .settings = settings};
    memset(settings, 0, sizeof *settings);
    begin(&w);
    if (!apply_presets(&w)) return false;
    while (w.at < w.argc && !settings->question)
        if (!take(&w)) return false;
    if (settings->question && w.at < w.argc) settings->topic = w.argv[w.at]; /* --help camera */
    if (settings->completions) settings->question = QUESTION_COMPLETIONS;
    if (settings->question) return true;
    if (!models_settle(settings)) return false;
    film_settle(settings);
    if (!options_check(settings)) return false;
    options_warn(settings);
    return true;
}
