/* An Assimp that breaks, to be preloaded: what it does follows from the file's name. */
#include <assimp/cimport.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fill_memory(void) {
    for (size_t n = 0;; n++) {
        char *const block = malloc((size_t)1 << 20);
        if (!block) abort();
        if (n % 4096 == 0) memset(block, 1, 1 << 20);
    }
}

const struct aiScene *aiImportFileExWithProperties(const char *path, unsigned flags,
                                                   struct aiFileIO *files,
                                                   const struct aiPropertyStore *properties) {
    (void)flags, (void)files, (void)properties;
    puts("What a reader prints"), fflush(stdout);
    fputs("is not for the user\n", stderr);
    if (strstr(path, "crash")) abort();
    if (strstr(path, "exit")) exit(0);
    if (strstr(path, "memory")) fill_memory();
    while (strstr(path, "hang")) {
    }
    return NULL;
}
