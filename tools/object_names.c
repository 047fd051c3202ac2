/* Names of a model's objects: which fit what the command line says, and which are like it. */
#include "objects.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

/* ---- patterns ---- */

/* One letter of UTF-8, at least a byte. */
static size_t letter_length(const char *at, const char *end) {
    size_t n = 1;
    while (at + n < end && (at[n] & 0xC0) == 0x80) n++;
    return n;
}

/* Does [name, name_end) fit the pattern [text, end)? Where a * has been too short, the way back is to
 * the last one: what earlier ones stand for need not change. */
static bool fits(const char *name, const char *name_end, const char *text, const char *end) {
    const char *star = NULL, *from = NULL;
    while (name < name_end || text < end) {
        const bool escaped = text < end && *text == '\\' && text + 1 < end;
        if (text < end && *text == '*') {
            star = ++text, from = name;
        } else if (text < end && name < name_end && *text == '?') {
            name += letter_length(name, name_end), text++;
        } else if (text < end && name < name_end && text[escaped] == *name) {
            name++, text += 1 + escaped;
        } else if (star && from < name_end) {
            text = star, name = ++from;
        } else {
            return false;
        }
    }
    return true;
}

bool object_fits(const char *name, const char *text, const char *end) {
    const char *const whole = name ? name : "";
    for (const char *from = whole;;) {
        for (const char *to = from + strcspn(from, "/");; to += 1 + strcspn(to + 1, "/")) {
            if (fits(from, to, text, end)) return true;
            if (!*to) break;
        }
        from += strcspn(from, "/");
        if (!*from++) return false;
    }
}

const char *object_name_end(const char *text) {
    while (*text && *text != ',') text += *text == '\\' && text[1] ? 2 : 1;
    return text;
}

/* The end of the name that begins at `text`, within a list that ends at `end`. */
static const char *end_within(const char *text, const char *end) {
    const char *const own = object_name_end(text);
    return own < end ? own : end;
}

bool object_names_fit(const char *name, const char *text, const char *end) {
    for (;;) {
        const char *const own = end_within(text, end);
        if (object_fits(name, text, own)) return true;
        if (own == end) return false;
        text = own + 1;
    }
}

/* ---- groups ---- */

int object_list_read(const tool_settings *s, dp_source *source, object_list *list) {
    dp_diag diag = {0};
    list->groups = calloc(OBJECTS_MOST, sizeof *list->groups);
    if (!list->groups) {
        wrong_usage("out of memory for the objects of a model");
        return EXIT_FAILED;
    }
    if (!dp_source_groups(source, list->groups, OBJECTS_MOST, &list->count, &diag)) return 0;
    report_model(s, &diag);
    return EXIT_FAILED;
}

void object_list_free(object_list *list) {
    free(list->groups);
    *list = (object_list){0};
}

/* ---- names that are like one ---- */

enum { NEAR_MOST = 3, NAME_SHOWN = 48 };

typedef struct near_names {
    char text[NEAR_MOST][NAME_SHOWN + 1];
    unsigned distance[NEAR_MOST];
    int count;
} near_names;

/* Keeps the nearest ones, in their order. */
static void offer_name(near_names *near, const char *wanted, const char *name) {
    const unsigned distance = spelling_distance(wanted, name);
    int at = near->count;
    for (int i = 0; i < near->count; i++)
        if (!strcmp(near->text[i], name)) return;
    if (3 * distance > 2 * strlen(wanted)) return;
    while (at > 0 && near->distance[at - 1] > distance) at--;
    if (at == NEAR_MOST) return;
    if (near->count < NEAR_MOST) near->count++;
    for (int i = near->count - 1; i > at; i--) {
        memcpy(near->text[i], near->text[i - 1], sizeof near->text[i]);
        near->distance[i] = near->distance[i - 1];
    }
    snprintf(near->text[at], sizeof near->text[at], "%s", name);
    near->distance[at] = distance;
}

/* A name as a whole, and each of its parts. */
static void offer_parts(near_names *near, const char *wanted, const char *name) {
    for (const char *part = name; part; part = strchr(part, '/')) {
        char copy[NAME_SHOWN + 1];
        part += *part == '/';
        snprintf(copy, sizeof copy, "%.*s", (int)strcspn(part, "/"), part);
        if (*copy) offer_name(near, wanted, copy);
    }
    if (strlen(name) <= NAME_SHOWN) offer_name(near, wanted, name);
}

/* The first names of a model, as many as there is room for. */
static void known_names(const dp_source *source, const object_list *list, char *text, size_t size) {
    size_t length = 0;
    *text = 0;
    for (uint32_t g = 0; g < list->count; g++) {
        const char *const name = dp_source_group_name(source, g);
        if (!name || !list->groups[g].polygons) continue;
        if (length + NAME_SHOWN + 8 > size) {
            snprintf(text + length, size - length, ", ...");
            return;
        }
        length += (size_t)snprintf(text + length, size - length, "%s%.*s", length ? ", " : "",
                                   NAME_SHOWN, name);
    }
}

static bool tell_unknown(const tool_settings *s, const dp_source *source, const object_list *list,
                         const char *option_name, const char *wanted) {
    near_names near = {.count = 0};
    char names[240];
    for (uint32_t g = 0; g < list->count && !strpbrk(wanted, "*?"); g++) {
        const char *const name = dp_source_group_name(source, g);
        if (name && list->groups[g].polygons) offer_parts(&near, wanted, name);
    }
    known_names(source, list, names, sizeof names);
    if (!*names)
        return wrong_usage("--%s: the objects of %s have no names: it is one whole", option_name,
                           s->model);
    if (!near.count)
        return wrong_usage("--%s: the model has no object called \"%s\"; it has %s; --list prints "
                           "all",
                           option_name, wanted, names);
    for (int i = 0, length = 0; i < near.count; i++)
        length += snprintf(names + length, sizeof names - (size_t)length, "%s%s",
                           !i                    ? ""
                           : i + 1 == near.count ? " or "
                                                 : ", ",
                           near.text[i]);
    return wrong_usage("--%s: the model has no object called \"%s\"; did you mean %s? --list "
                       "prints all",
                       option_name, wanted, names);
}

static bool is_known(const dp_source *source, const object_list *list, const char *text,
                     const char *end) {
    for (uint32_t g = 0; g < list->count; g++)
        if (list->groups[g].polygons && object_fits(dp_source_group_name(source, g), text, end))
            return true;
    return false;
}

bool object_names_known(const tool_settings *s, dp_source *source, const object_list *list,
                        const char *option_name, const char *text, const char *end) {
    for (;;) {
        const char *const own = end_within(text, end);
        char wanted[NAME_SHOWN + 1];
        snprintf(wanted, sizeof wanted, "%.*s", (int)(own - text), text);
        if (!is_known(source, list, text, own))
            return tell_unknown(s, source, list, option_name, wanted);
        if (own == end) return true;
        text = own + 1;
    }
}
