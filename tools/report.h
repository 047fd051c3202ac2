/* What the program says on stderr. */
#ifndef TOOL_REPORT_H
#define TOOL_REPORT_H

#include <drypoint/base.h>

/* "drypoint: …" and a newline; false, so that `return wrong_usage(…)` reads well. */
bool wrong_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "drypoint: FILE:LINE: …" from a diagnostic; the exit code that fits. */
int report_failure(const char *file, const dp_diag *diag);

/* "drypoint: warning: …" */
void warn(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "drypoint: …": something worth knowing, and not wrong. */
void note(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
