/* What the program says on stderr. */
#ifndef TOOL_REPORT_H
#define TOOL_REPORT_H

#include <drypoint/base.h>

#include <stdio.h>

/* "drypoint: …" and a newline; false, so that `return wrong_usage(…)` reads well. */
bool wrong_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "drypoint: FILE:LINE: …" from a diagnostic; the exit code that fits. */
int report_failure(const char *file, const dp_diag *diag);

/* "drypoint: warning: …" */
void warn(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "drypoint: …": something worth knowing, and not wrong. */
void note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* From now on all that is said on stderr is told to `hear` as well, without the program's name, from whatever thread says
 * it. NULL: to nobody. */
void report_to(void (*hear)(const char *text));

/* Prints a JSON string; names of files may contain any byte. */
void print_json_string(FILE *out, const char *text);

#endif
