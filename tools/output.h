/* Questions about an output's path, answered before any work is done. */
#ifndef TOOL_OUTPUT_H
#define TOOL_OUTPUT_H

#include <stdbool.h>

/* Is it standard output, a device or a pipe? These are written in place, and have no ending. */
bool output_in_place(const char *path);
/* The path without its directories. */
const char *output_name(const char *path);
/* Does the path end so (".png", say), in any case? */
bool output_has_ending(const char *path, const char *ending);
/* Length of the path without its ending. */
int output_stem(const char *path);
/* Are both one regular file, or one that does not exist yet under one name? */
bool output_same(const char *path, const char *other);
/* Can a file be made there? A message on stderr if not; the writing itself may still fail. */
bool output_possible(const char *path);

#endif
