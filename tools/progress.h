/* A progress bar on stderr, and Ctrl-C. */
#ifndef TOOL_PROGRESS_H
#define TOOL_PROGRESS_H

#include <stdbool.h>
#include <sys/types.h>

/* One piece of work with a name, "drawing" say. The bar appears when it has lasted over a second
 * and stderr is a terminal, unless `quiet`. */
void progress_begin(const char *what, bool quiet);
/* For the library: fraction in [0, 1], negative when the end is unknown. Non-zero after Ctrl-C. */
int progress_report(void *user, double fraction);
void progress_end(void);
/* The same for work that reports nothing: a thread keeps the bar alive meanwhile. What was begun before goes on after it. */
void progress_wait_begin(const char *what, bool quiet);
void progress_wait_end(void);
/* From now on `hear` is told instead, and decides whether the work is stopped, from whatever thread does it. NULL: the
 * bar again. */
void progress_to(int (*hear)(double fraction));
/* Removes the bar from the terminal, so that something else can be printed. */
void progress_clear(void);

/* From now on SIGINT, SIGTERM and SIGHUP end the program with 130, 143 and 129: at once, or, between hold and
 * release (an output file is being written), after progress_report has told the writer to stop. */
void interrupt_install(void);
void interrupt_hold(void);
void interrupt_release(void);
/* Has one come since interrupt_hold? */
bool interrupt_seen(void);
/* The child process that is ended with the program; 0: none. */
void interrupt_also(pid_t child);
/* Ends that child now. False: there is none. */
bool interrupt_child(void);

#endif
