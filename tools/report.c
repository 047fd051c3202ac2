/* Messages: one line each, the program's name first, then where, what and what to do. */
#include "report.h"

#include "options.h"
#include "progress.h"

#include <stdarg.h>
#include <stdio.h>

static void say(const char *prefix, const char *format, va_list arguments) {
    progress_clear();
    fputs(prefix, stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

bool wrong_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("drypoint: ", format, arguments);
    va_end(arguments);
    return false;
}

void warn(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("drypoint: warning: ", format, arguments);
    va_end(arguments);
}

void note(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("drypoint: ", format, arguments);
    va_end(arguments);
}

int report_failure(const char *file, const dp_diag *diag) {
    char where[32] = "";
    if (diag->line)
        snprintf(where, sizeof where, "%llu: ", (unsigned long long)diag->line);
    else if (diag->offset)
        snprintf(where, sizeof where, " byte %llu: ", (unsigned long long)diag->offset);
    const char *const message = *diag->message ? diag->message : dp_result_name(diag->result);
    progress_clear();
    if (file)
        fprintf(stderr, "drypoint: %s:%s%s%s\n", file, where, *where ? "" : " ", message);
    else
        fprintf(stderr, "drypoint: %s\n", message);
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
