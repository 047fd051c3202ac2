/* A model's objects, its groups: --object, --only, --without, --explode and --list. */
#ifndef TOOL_OBJECTS_H
#define TOOL_OBJECTS_H

#include "commands.h"

struct page_plan;

/* ------- names (object_names.c) ------- */

/* Does a group's name (NULL: none) fit what stands in [text, end)? * stands for any letters, ? for
 * one, and \ takes its meaning from the next one. "file/object/material" fits as a whole, and so do
 * one or more of its parts that follow each other. */
bool object_fits(const char *name, const char *text, const char *end);
/* The end of the first of some names with commas between; \, is none. */
const char *object_name_end(const char *text);

/* The groups of a source that have polygons. Zero is empty. */
typedef struct object_list {
    dp_group *groups; /* [count] */
    uint32_t count;
} object_list;

enum { OBJECTS_MOST = 65536 /* dp_batch.groups has 16 bits */ };

/* Reads the source. 0, or the exit code after a message; call object_list_free in any case. */
int object_list_read(const tool_settings *s, dp_source *source, object_list *list);
void object_list_free(object_list *list);
/* Does each of the names with commas between, in [text, end), fit a group? A message says which does
 * not, with names that are like it. */
bool object_names_known(const tool_settings *s, dp_source *source, const object_list *list,
                        const char *option_name, const char *text, const char *end);
/* Does any of the names? */
bool object_names_fit(const char *name, const char *text, const char *end);

/* ------- settings of an object (object_settings.c) ------- */

/* Is the value of an --object sound? A message on stderr if not. */
bool object_check(const char *value);
/* Splits it: names in [value, *names_end), settings from *settings on. */
void object_split(const char *value, const char **names_end, const char **settings);
/* Lays an object's settings over *s. True: it is to be hidden. */
bool object_apply(const char *value, tool_settings *s);
/* Is any surface to be see-through, the picture's or an object's? */
bool xray_asked(const tool_settings *s);

/* ------- what is drawn (objects.c) ------- */

/* Must the groups be known to draw what the settings say? */
bool objects_asked(const tool_settings *s);
/* How groups of a model stand. Zero: as they are. */
typedef struct object_places {
    dp_placement *at; /* [count] */
    uint32_t count;
} object_places;

/* Finds, of a whole model, which of its groups are left out and where the others go. 0, or the exit code
 * after a message; call objects_places_free in any case. */
int objects_place(const tool_settings *s, dp_source *source, object_places *places);
/* Puts a source in the place of *source in which groups are left out or moved. 0, or the exit code after a
 * message. */
int objects_arrange(const object_places *places, dp_source **source);
void objects_places_free(object_places *places);

/* Styles by group, for dp_draw_grouped. Zero is none. */
typedef struct object_styles {
    dp_style *styles; /* [count] */
    uint32_t count;
} object_styles;

/* Makes them from the picture's style, which is whole but for what depends on the view. 0, or the exit code
 * after a message; call objects_free in any case. */
int objects_style(const tool_settings *s, dp_source *source, const struct page_plan *plan,
                  const dp_style *picture, object_styles *styles);
/* The same styles without lines. False: memory is out, after a message. */
bool objects_without_lines(const object_styles *styles, object_styles *bare);
void objects_free(object_styles *styles);

/* drypoint MODEL --list; the exit code (object_table.c). */
int objects_print(const tool_settings *s);

#endif
