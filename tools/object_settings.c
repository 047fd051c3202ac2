/* --object NAME,...:SETTING,...: what one object has of its own.
 *
 * Settings are options by their names and take the values that these take: color, width, lines, …, with
 * their own commas in them; a new setting begins where a setting's name stands behind a comma. `hide`
 * takes none.
 *
 * Names end at the first colon that a setting's name follows: most colons in names ("shape:bolt") need
 * no \ before them. */
#include "objects.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

/* Options that an object may have of its own. A new one is added here, and copied to the group's style
 * by make_style and dp_draw_grouped. */
static const char setting_words[] = "color|width|lines|surface|xray|section-color|hidden-color|"
                                    "hidden-width|ridge-angle|valley-angle|"
                                    "hide";
static const char hide_word[] = "hide";

enum { VALUE_MOST = 512, NAME_SHOWN = 40 };

/* Is it the name of a setting, with = behind it, or hide? Returns its length, 0: it is none. */
static size_t setting_length(const char *text) {
    char word[24];
    const size_t length = strcspn(text, "=,");
    if (length >= sizeof word) return 0;
    snprintf(word, sizeof word, "%.*s", (int)length, text);
    if (!word_index(setting_words, word)) return 0;
    return text[length] == '=' || !strcmp(word, hide_word) ? length : 0;
}

void object_split(const char *value, const char **names_end, const char **settings) {
    *names_end = *settings = NULL;
    for (const char *at = value; *at; at += *at == '\\' && at[1] ? 2 : 1) {
        if (*at != ':') continue;
        *names_end = at, *settings = at + 1;
        if (setting_length(at + 1)) return;
    }
}

/* The end of a setting: where the next one begins behind a comma. */
static const char *setting_end(const char *text) {
    for (const char *at = text + strcspn(text, ","); *at; at += strcspn(at + 1, ",") + 1)
        if (setting_length(at + 1)) return at;
    return text + strlen(text);
}

static const option *find_option(const char *name, size_t length) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (strlen(o->name) == length && !strncmp(o->name, name, length) &&
            o->commands >> COMMAND_DRAW & 1)
            return o;
    return NULL;
}

static bool no_setting(const char *value, const char *text) {
    char word[32], best[32];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(text, "=,"), text);
    nearest_word(setting_words, word, best, sizeof best);
    if (!is_slip(word, best))
        return wrong_usage("--object %s: \"%s\" is no setting of an object; those are %s", value,
                           word, setting_words);
    return wrong_usage("--object %s: \"%s\" is no setting of an object; did you mean %s%s?", value,
                       word, best, strcmp(best, hide_word) ? "=" : "");
}

/* A class of lines, or its start before a level: "ridge:2". */
static bool is_class(const char *word) {
    const size_t length = strcspn(word, ":");
    for (int line = 0; line < DP_LINE_COUNT; line++) {
        const char *const name = dp_line_name((dp_line)line);
        if (strlen(name) == length && !strncmp(name, word, length)) return true;
    }
    return !length;
}

/* Does a word that is spelt like a setting's name, and is no class, stand before a = behind a comma of a
 * setting's value? */
static const char *misspelt_within(const char *text, const char *end) {
    for (const char *at = text + strcspn(text, ","); at < end; at += strcspn(at + 1, ",") + 1) {
        char word[24], best[24];
        const size_t length = strcspn(at + 1, "=,");
        snprintf(word, sizeof word, "%.*s", (int)length, at + 1);
        if (at[1 + length] != '=' || is_class(word)) continue;
        nearest_word(setting_words, word, best, sizeof best);
        if (spelling_distance(word, best) <= 2) return at + 1;
    }
    return NULL;
}

/* Stores one setting in [text, end). False: after a message. */
static bool store(const char *value, const char *text, const char *end, tool_settings *to,
                  bool *hide) {
    char named[NAME_SHOWN + 64], copy[VALUE_MOST];
    const size_t length = setting_length(text);
    const char *names_end, *settings;
    if (!length) return no_setting(value, text);
    if (text[length] != '=') {
        *hide = true;
        return end == text + length || no_setting(value, text + length + 1);
    }
    const char *const misspelt = misspelt_within(text + length + 1, end);
    if (misspelt) return no_setting(value, misspelt);
    object_split(value, &names_end, &settings);
    snprintf(named, sizeof named, "object %.*s:%.*s",
             (int)(names_end - value < NAME_SHOWN ? names_end - value : NAME_SHOWN), value,
             (int)length, text);
    if ((size_t)(end - text) - length > VALUE_MOST)
        return wrong_usage("--%s: its value has more than %d letters", named, VALUE_MOST);
    snprintf(copy, sizeof copy, "%.*s", (int)(end - text - (ptrdiff_t)length - 1),
             text + length + 1);
    const option *const known = find_option(text, length);
    if (!known) return no_setting(value, text);
    option own = *known;
    own.name = named;
    return option_store(&own, copy, to);
}

static bool store_all(const char *value, const char *settings, tool_settings *to, bool *hide) {
    for (const char *at = settings;;) {
        const char *const end = setting_end(at);
        if (!store(value, at, end, to, hide)) return false;
        if (!*end) return true;
        at = end + 1;
    }
}

bool object_check(const char *value) {
    tool_settings scratch = {0};
    const char *end, *settings;
    bool hide = false;
    object_split(value, &end, &settings);
    if (!end)
        return wrong_usage("--object: \"%s\" says nothing of an object; give one like "
                           "\"bolt:color=red,width=3\", or \"bolt:hide\"",
                           value);
    return option_names_check("object", value, end) && store_all(value, settings, &scratch, &hide);
}

bool object_apply(const char *value, tool_settings *s) {
    const char *end, *settings;
    bool hide = false;
    object_split(value, &end, &settings);
    (void)store_all(value, settings, s, &hide);
    return hide;
}

static bool is_seen_through(const tool_settings *s) { return s->xray > 0 && s->xray < 1; }

bool xray_asked(const tool_settings *s) {
    bool any = is_seen_through(s);
    for (uint32_t k = 0; k < s->objects.count && !any; k++) {
        tool_settings own = {0};
        (void)object_apply(s->objects.items[k], &own);
        any = is_seen_through(&own);
    }
    return any;
}
