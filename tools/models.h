/* The models of a run: what the command line names, and what they are called. */
#ifndef TOOL_MODELS_H
#define TOOL_MODELS_H

#include "options.h"

/* Adds a model (copied). False: memory is out, after a message. */
bool models_add(tool_settings *s, const char *name);
/* Puts files in the place of patterns like parts/NAME*.stl, and gives the run a name: its model's,
 * or "a.stl and 2 more". False: after a message. */
bool models_settle(tool_settings *s);
void models_free(tool_settings *s);

/* The same settings for model number k alone; they borrow from *s. */
tool_settings models_choose(const tool_settings *s, uint32_t k);

/* A model's name for people: "standard input" instead of "-". */
const char *model_spoken(const char *model);
/* Its file's name without folder and ending, a shape's without its number. */
enum { STEM_BYTES = 256 };
void model_stem(const char *model, char stem[STEM_BYTES]);

/* Does something with each model, one after the other, also when one fails. 0, or an exit code after
 * a message on which of several failed: 2 if all did so. */
int models_each(const tool_settings *s, int (*command)(const tool_settings *one));

#endif
