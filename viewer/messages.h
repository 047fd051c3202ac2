/* What was said lately, from any thread, to be shown in the window. */
#ifndef VIEWER_MESSAGES_H
#define VIEWER_MESSAGES_H

#include <stdbool.h>

enum { MESSAGES_KEPT = 32, MESSAGE_BYTES = 512 };

typedef struct message {
    char text[MESSAGE_BYTES];
    double time; /* s, of the clock that messages_now reads */
} message;

/* From now on what is said on stderr is kept. `wake` is called then, from any thread. */
void messages_begin(double (*now)(void), void (*wake)(void));
/* Keeps a text that is no error, as printf writes it. */
void messages_say(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Says nothing in the window until it is told to go on: of what was stopped on purpose. */
void messages_mute(bool mute);
/* Copies the newest ones, the last one last; how many there are. */
int messages_copy(message out[MESSAGES_KEPT]);

#endif
