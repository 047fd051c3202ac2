/* Scripts that complete the program's options in shells. */
#ifndef TOOL_COMPLETIONS_H
#define TOOL_COMPLETIONS_H

#include "options.h"

/* Prints the script for a shell: a word of --completions. */
void completions_write(FILE *out, int shell);

#endif
