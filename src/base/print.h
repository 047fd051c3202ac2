/* Numbers and system errors as text, whatever the application's locale and threads are. */
#ifndef DP_BASE_PRINT_H
#define DP_BASE_PRINT_H

enum { DP_NUMBER_TEXT = 40, DP_ERROR_TEXT = 96 /* bytes */ };

/* Prints like "%.*g" in the C locale, with up to 17 digits, and returns `text`. A literal can be
 * passed if the result is used at once: dp_print_number((char[DP_NUMBER_TEXT]){0}, x, 6). */
const char *dp_print_number(char text[DP_NUMBER_TEXT], double value, int digits);

/* Like strerror, but safe with threads; returns `text`. */
const char *dp_print_error(char text[DP_ERROR_TEXT], int code);

#endif
