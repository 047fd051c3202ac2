/* Numbers as text with a decimal point in any locale.
 *
 * printf takes the decimal point from the locale, which an application may change at any time for
 * all threads, and no reader takes a file with decimal commas. The point may have several bytes: it
 * is whatever in the number is no digit, letter or sign. */
#include "base/print.h"

#include <stdio.h>
#include <string.h>

const char *dp_print_number(char text[DP_NUMBER_TEXT], double value, int digits) {
    static const char others[] = "0123456789+-abcdefghijklmnopqrstuvwxyz";
    snprintf(text, DP_NUMBER_TEXT, "%.*g", digits, value);
    char *const point = text + strspn(text, others);
    if (!*point) return text;
    char *end = point + 1;
    while (*end && !strchr(others, *end)) end++;
    *point = '.';
    memmove(point + 1, end, strlen(end) + 1);
    return text;
}

/* POSIX returns an int and always fills the text. GNU, with _GNU_SOURCE, returns the message, which
 * may be elsewhere. */
const char *dp_print_error(char text[DP_ERROR_TEXT], int code) {
#if defined __GLIBC__ && defined _GNU_SOURCE
    const char *const message = strerror_r(code, text, DP_ERROR_TEXT);
    if (message != text) snprintf(text, DP_ERROR_TEXT, "%s", message);
#else
    *text = 0;
    (void)strerror_r(code, text, DP_ERROR_TEXT);
    if (!*text) snprintf(text, DP_ERROR_TEXT, "error %d", code);
#endif
    return text;
}
