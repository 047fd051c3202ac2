/* Questions about an output's path, answered before any work is done. */
#ifndef TOOL_OUTPUT_H
#define TOOL_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
/* Is it a folder, or named like one? */
bool output_is_folder(const char *path);
/* Does a model's name belong into it, where %s is? */
bool output_is_pattern(const char *path);
/* Puts it there; in such a path %% is a percent sign, unless output_number makes one of it later.
 * False: it takes more than `size` bytes. */
bool output_fill(const char *pattern, const char *stem, char *path, size_t size);
/* Does the number of a film's frame belong into it, where %d or %04d is? */
bool output_is_sequence(const char *path);
/* Puts it there, as output_fill does. */
bool output_number(const char *pattern, uint32_t number, char *path, size_t size);
/* Can a file be made there, or the first of a sequence? A message on stderr if not; the writing itself may still fail. */
bool output_possible(const char *path);

#endif
