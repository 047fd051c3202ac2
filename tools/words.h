/* What another process says on its stderr, kept until it is known whether it matters. */
#ifndef TOOL_WORDS_H
#define TOOL_WORDS_H

#include <stddef.h>

/* A file without a name, to be that process's stderr; below 0: errno says why not. */
int words_open(void);
/* Says them here. */
void words_show(int words);
/* The last lines of them, as one: "a; b". */
void words_tail(int words, char *text, size_t size);

#endif
