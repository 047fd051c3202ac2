/* Opens models in a thread of its own, so that the window goes on. */
#ifndef VIEWER_LOAD_H
#define VIEWER_LOAD_H

#include "cmdline.h"
#include "loaded.h"

typedef struct load_job load_job;

/* Begins; NULL: after a message. The line is copied. `wake` is called from the thread at its end. */
load_job *load_begin(const cmdline *line, void (*wake)(void));
/* Has it ended? */
bool load_ended(const load_job *job);
/* In [0, 1]; negative: not known. */
double load_fraction(void);
/* Waits for its end, and frees it. False: it has failed, after a message, or was told to stop. */
bool load_end(load_job *job, loaded *out);
/* Tells the job to stop. */
void load_stop(void);
/* Has it heard that, so that it failed for no reason of the model's? Asked after its end. */
bool load_was_stopped(void);

#endif
