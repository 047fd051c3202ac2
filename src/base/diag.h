/* Filling in diagnostics. Every failure in the library is reported by one of these three. */
#ifndef DP_BASE_DIAG_H
#define DP_BASE_DIAG_H

#include <drypoint/base.h>

#if defined(__GNUC__)
#define DP_PRINTF(text, rest) __attribute__((format(printf, text, rest)))
#else
#define DP_PRINTF(text, rest)
#endif

/* Fills *diag (may be NULL) and returns `result`, for use as `return dp_fail(…)`. */
dp_result dp_fail(dp_diag *diag, dp_result result, const char *format, ...) DP_PRINTF(3, 4);
/* The same with a line of a text file, from 1; the message need not repeat it. */
dp_result dp_fail_line(dp_diag *diag, dp_result result, uint64_t line, const char *format, ...)
    DP_PRINTF(4, 5);
/* The same with a byte offset. */
dp_result dp_fail_offset(dp_diag *diag, dp_result result, uint64_t offset, const char *format, ...)
    DP_PRINTF(4, 5);

#endif
