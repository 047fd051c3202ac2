/* A model in memory, and the files that it names, as a file system for Assimp. */
#ifndef DP_IO_ASSIMP_FILES_H
#define DP_IO_ASSIMP_FILES_H

#include "base/memory.h"
#include <drypoint/source.h>

#include <assimp/cfileio.h>

typedef struct dp_assimp_files {
    struct aiFileIO io;
    const dp_memory_file *file;
    const char *name; /* by which Assimp knows the model; without folders */
    dp_allocator allocator;
} dp_assimp_files;

/* There is nothing to free; `file` and `files` must live until the scene is released. */
void dp_assimp_files_init(dp_assimp_files *files, const dp_memory_file *file,
                          const dp_allocator *allocator);

#endif
