/* Names for mkstemp and mkdtemp, below $TMPDIR where that is set. */
#ifndef DP_TEST_TEMPORARY_H
#define DP_TEST_TEMPORARY_H

#include <stdio.h>
#include <stdlib.h>

static inline void temporary_name(char *path, size_t size, const char *what) {
    const char *const base = getenv("TMPDIR");
    snprintf(path, size, "%s/drypoint-%s-XXXXXX", base ? base : "/tmp", what);
}

#endif
