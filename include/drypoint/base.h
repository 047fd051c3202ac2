/* drypoint/base.h: results, diagnostics, memory, version.
 *
 * Every call that can fail returns a dp_result whose value says what the caller can do about it,
 * and, where a `dp_diag *` is taken (NULL allowed), fills it with where and why. There is no hidden
 * "last error", nothing is printed, and the library never exits. */
#ifndef DRYPOINT_BASE_H
#define DRYPOINT_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DP_VERSION_MAJOR 0
#define DP_VERSION_MINOR 1
#define DP_VERSION_PATCH 0

#if defined(_WIN32)
#define DP_API
#else
#define DP_API __attribute__((visibility("default")))
#endif

/* What went wrong, by what the caller can do about it. */
typedef enum dp_result {
    DP_OK = 0,
    DP_ERR_ARGUMENT,    /* the call is wrong: mend the program or the command line */
    DP_ERR_MEMORY,      /* an allocation failed: provide more memory, or draw less */
    DP_ERR_IO,          /* the system refused to open, read or write */
    DP_ERR_FORMAT,      /* the file's content is not what its format says */
    DP_ERR_UNSUPPORTED, /* sound, but not something this build or this version does */
    DP_ERR_LIMIT,       /* a count or size beyond what the library can address */
    DP_ERR_CANCELLED    /* the progress callback asked to stop */
} dp_result;

/* Where and why. Filled by value. Messages are one line of English without a final newline; numbers
 * in them have a decimal point. */
typedef struct dp_diag {
    dp_result result;
    uint64_t line;   /* 1-based line of a text file, 0 where there is none */
    uint64_t offset; /* byte offset in a binary file, 0 where there is none */
    uint64_t item;   /* 0-based id of the polygon, vertex, … that is meant */
    char message[240];
} dp_diag;

/* Where memory comes from; if any member is NULL, malloc, realloc and free for all three. Blocks
 * must be aligned as malloc's are. `user` is passed to each call. Calls may come from several
 * threads at once. An object that is given an allocator takes all its memory from it, with these
 * exceptions: threads' stacks come from the system; libpng, zlib, Assimp and the writers of
 * drypoint/io.h use malloc. */
typedef struct dp_allocator {
    void *(*alloc)(size_t size, void *user);
    void *(*realloc)(void *block, size_t size, void *user); /* block may be NULL */
    void (*free)(void *block, void *user);                  /* block may be NULL */
    void *user;
} dp_allocator;

/* A short name of the result class, "out of memory" say. Never NULL. */
DP_API const char *dp_result_name(dp_result result);

/* Version of the library that runs: "0.1.0". */
DP_API const char *dp_version(void);

/* Whether the library that runs fits headers of version major.minor.patch: DP_OK when major and
 * minor are its own (a patch changes no interface), otherwise DP_ERR_UNSUPPORTED (structs may
 * differ), with both versions in diag's message. */
DP_API dp_result dp_version_check_header(uint32_t major, uint32_t minor, uint32_t patch,
                                         dp_diag *diag);

/* The same for the headers that the caller is compiled with. Applications that load the library as
 * a shared one call it first. */
static inline dp_result dp_version_check(dp_diag *diag) {
    return dp_version_check_header(DP_VERSION_MAJOR, DP_VERSION_MINOR, DP_VERSION_PATCH, diag);
}

#ifdef __cplusplus
}
#endif
#endif
