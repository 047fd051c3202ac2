/* Filling diagnostics: every failure in the library is made by one of these three. */
#ifndef DP_BASE_DIAG_H
#define DP_BASE_DIAG_H

#include <drypoint/base.h>

#if defined(__GNUC__)
#define DP_PRINTF(text, rest) __attribute__((format(printf, text, rest)))
#else
#define DP_PRINTF(text, rest)
#endif

/* Fills *diag (NULL allowed) and returns `result`, so that `return dp_fail(…)` reads well. */
dp_result dp_fail(dp_diag *diag, dp_result result, const char *format, ...) DP_PRINTF(3, 4);
/* The same with the 1-based line of a text file; the message need not repeat it. */
dp_result dp_fail_line(dp_diag *diag, dp_result result, uint64_t line, const char *format, ...)
    DP_PRINTF(4, 5);
/* The same with a byte offset. */
dp_result dp_fail_offset(dp_diag *diag, dp_result result, uint64_t offset, const char *format, ...)
    DP_PRINTF(4, 5);

#endif
