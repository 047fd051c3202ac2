/* A model that is there. */
#ifndef VIEWER_LOADED_H
#define VIEWER_LOADED_H

#include "commands.h"

/* Zero is none. */
typedef struct loaded {
    dp_source *source; /* NULL: none */
    measured seen;     /* no camera is fitted in it */
    bool moves;        /* it is another at another time */
    double lasts;      /* s; 0: without end, or it does not move */
    double time;       /* s: where it is */
} loaded;

/* Opens the models of the settings, of which it changes those that are of a single picture. False: after a message; call
 * loaded_free in any case. */
bool loaded_open(tool_settings *s, loaded *model);
void loaded_free(loaded *model);

#endif
