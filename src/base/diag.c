/* Results as words, diagnostics filled by value, the version. */
#include "base/diag.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static dp_result fill(dp_diag *diag, dp_diag head, const char *format, va_list arguments) {
    if (!diag) return head.result;
    *diag = head;
    vsnprintf(diag->message, sizeof diag->message, format, arguments);
    return head.result;
}

dp_result dp_fail(dp_diag *diag, dp_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fill(diag, (dp_diag){.result = result}, format, arguments);
    va_end(arguments);
    return result;
}

dp_result dp_fail_line(dp_diag *diag, dp_result result, uint64_t line, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fill(diag, (dp_diag){.result = result, .line = line}, format, arguments);
    va_end(arguments);
    return result;
}

dp_result dp_fail_offset(dp_diag *diag, dp_result result, uint64_t offset, const char *format,
                         ...) {
    va_list arguments;
    va_start(arguments, format);
    fill(diag, (dp_diag){.result = result, .offset = offset}, format, arguments);
    va_end(arguments);
    return result;
}

const char *dp_result_name(dp_result result) {
    static const char *const names[] = {"ok",
                                        "wrong argument",
                                        "out of memory",
                                        "i/o error",
                                        "bad file content",
                                        "not supported",
                                        "limit reached",
                                        "cancelled"};
    const size_t index = (size_t)result;
    return index < sizeof names / sizeof *names ? names[index] : "unknown result";
}

#define STRING(x)                    #x
#define VERSION(major, minor, patch) STRING(major) "." STRING(minor) "." STRING(patch)

const char *dp_version(void) {
    return VERSION(DP_VERSION_MAJOR, DP_VERSION_MINOR, DP_VERSION_PATCH);
}

/* The rule of the shared library's name (SOVERSION) and of the CMake package. */
dp_result dp_version_check_header(uint32_t major, uint32_t minor, uint32_t patch, dp_diag *diag) {
    if (major == DP_VERSION_MAJOR && minor == DP_VERSION_MINOR) return DP_OK;
    return dp_fail(diag, DP_ERR_UNSUPPORTED,
                   "compiled with the headers of drypoint %" PRIu32 ".%" PRIu32 ".%" PRIu32
                   ", but the library that runs is %s: build both from one version, or let the "
                   "program find the library that it was built with",
                   major, minor, patch, dp_version());
}
