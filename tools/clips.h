/* The animations of models, which the library calls clips: which one plays, and a list of them. */
#ifndef TOOL_CLIPS_H
#define TOOL_CLIPS_H

#include "options.h"

#include <drypoint/scene.h>

/* What is known of the models of one picture so far; zero at first. */
typedef struct clips_tally {
    uint32_t clips;   /* of all models */
    uint32_t playing; /* models that play one */
    char nearest[80]; /* the name most like that of --animation; "": none */
    unsigned distance;
} clips_tally;

/* Plays, on a model just opened, the animation of --animation, or with --time alone its first one. A
 * model that has no such animation stays at rest. 0, or the exit code after a message. */
int clips_play(const tool_settings *s, dp_source *source, clips_tally *tally);
/* When all are opened: an error where no model has the animation, a warning where --time changes
 * nothing. 0, or the exit code. */
int clips_check(const tool_settings *s, const clips_tally *tally);

/* For drypoint info: what a scene consists of, as rows, or as members of a JSON object, ", " first. */
void clips_print_table(const dp_source *source);
void clips_print_json(const dp_source *source);

#endif
