/* Messages: one line each, the program's name first, then where, what and what to do. */
#include "report.h"

#include "options.h"
#include "progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static void (*listener)(const char *text);

void report_to(void (*hear)(const char *text)) { listener = hear; }

static void put(const char *text) {
    progress_clear();
    fprintf(stderr, "drypoint: %s\n", text);
    if (listener) listener(text);
}

/* Text of any length. */
static void say(const char *prefix, const char *format, va_list arguments) {
    char some[1024];
    va_list again;
    va_copy(again, arguments);
    const int start = snprintf(some, sizeof some, "%s", prefix);
    const int length = vsnprintf(some + start, sizeof some - (size_t)start, format, arguments);
    const size_t size = (size_t)(start + (length > 0 ? length : 0)) + 1;
    char *const all = size > sizeof some ? malloc(size) : NULL;
    if (all)
        vsnprintf(all + snprintf(all, size, "%s", prefix), size - (size_t)start, format, again);
    put(all ? all : some);
    free(all);
    va_end(again);
}

bool wrong_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("", format, arguments);
    va_end(arguments);
    return false;
}

void warn(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("warning: ", format, arguments);
    va_end(arguments);
}

void note(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("", format, arguments);
    va_end(arguments);
}

int report_failure(const char *file, const dp_diag *diag) {
    char where[32] = "";
    if (diag->line)
        snprintf(where, sizeof where, "%llu: ", (unsigned long long)diag->line);
    else if (diag->offset)
        snprintf(where, sizeof where, " byte %llu: ", (unsigned long long)diag->offset);
    const char *const message = *diag->message ? diag->message : dp_result_name(diag->result);
    if (file)
        note("%s:%s%s%s", file, where, *where ? "" : " ", message);
    else
        note("%s", message);
    return diag->result == DP_ERR_ARGUMENT ? EXIT_USAGE : EXIT_FAILED;
}

void print_json_string(FILE *out, const char *text) {
    fputc('"', out);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c < ' ')
            fprintf(out, "\\u%04x", c);
        else
            fputc(c, out);
    }
    fputc('"', out);
}
