/* Assimp's file system for a model in memory: the model under its own name, other files through the
 * application's open_beside.
 *
 * Invariant: Assimp never opens a file of the system. (aiImportFileFromMemory would, for every file
 * that the model names.)
 *
 * Not handled: writing. */
#include "io/assimp_files.h"

#include <string.h>

enum { NAME = 4096 };

typedef struct open_file {
    struct aiFile calls;
    dp_assimp_files *files;
    const uint8_t *data;
    size_t size, at;
    bool beside; /* from open_beside: to be given back */
} open_file;

static open_file *of(struct aiFile *file) { return (open_file *)(void *)file->UserData; }

/* Returns items, as fread does. */
static size_t file_read(struct aiFile *file, char *to, size_t size, size_t count) {
    open_file *const self = of(file);
    const size_t left = size ? (self->size - self->at) / size : 0;
    const size_t items = count < left ? count : left;
    if (items) memcpy(to, self->data + self->at, items * size);
    self->at += items * size;
    return items;
}

static size_t file_write(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file) { return of(file)->at; }
static size_t file_size(struct aiFile *file) { return of(file)->size; }
static void file_flush(struct aiFile *file) { (void)file; }

/* Negative offsets come as unsigned numbers and wrap around to the right place. */
static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *const self = of(file);
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? self->at : self->size;
    if (from + offset > self->size) return aiReturn_FAILURE;
    self->at = from + offset;
    return aiReturn_SUCCESS;
}

/* The name for open_beside: without "./", and with slashes for backslashes. False if too long. */
static bool plain_name(const char *name, char plain[NAME]) {
    while (name[0] == '.' && (name[1] == '/' || name[1] == '\\')) name += 2;
    const size_t length = strlen(name);
    if (length >= NAME) return false;
    for (size_t i = 0; i <= length; i++) plain[i] = name[i] == '\\' ? '/' : name[i];
    return true;
}

static bool find(const dp_assimp_files *files, const char *name, open_file *found) {
    char plain[NAME];
    const void *data = NULL;
    if (!plain_name(name, plain)) return false;
    if (!strcmp(plain, files->name)) {
        found->data = files->file->data;
        found->size = files->file->size;
        return true;
    }
    if (!files->file->open_beside ||
        !files->file->open_beside(files->file->user, plain, &data, &found->size))
        return false;
    found->data = data;
    found->beside = true;
    return found->data || !found->size;
}

static struct aiFile *open_one(struct aiFileIO *io, const char *name, const char *mode) {
    dp_assimp_files *const files = (dp_assimp_files *)(void *)io->UserData;
    if (!strchr(mode, 'r')) return NULL;
    open_file *const self = dp_alloc(&files->allocator, sizeof *self);
    if (!self) return NULL;
    *self = (open_file){.calls = {.ReadProc = file_read,
                                  .WriteProc = file_write,
                                  .TellProc = file_tell,
                                  .FileSizeProc = file_size,
                                  .SeekProc = file_seek,
                                  .FlushProc = file_flush,
                                  .UserData = (char *)self},
                        .files = files};
    if (find(files, name, self)) return &self->calls;
    dp_free(&files->allocator, self);
    return NULL;
}

static void close_one(struct aiFileIO *io, struct aiFile *file) {
    open_file *const self = of(file);
    const dp_memory_file *const model = self->files->file;
    (void)io;
    if (self->beside && model->close_beside)
        model->close_beside(model->user, self->data, self->size);
    dp_free(&self->files->allocator, self);
}

void dp_assimp_files_init(dp_assimp_files *files, const dp_memory_file *file,
                          const dp_allocator *allocator) {
    const char *name = file->name ? file->name : "";
    for (const char *p = name; *p; p++)
        if (*p == '/' || *p == '\\') name = p + 1;
    *files = (dp_assimp_files){
        .io = {.OpenProc = open_one, .CloseProc = close_one, .UserData = (char *)files},
        .file = file,
        .name = *name ? name : "model",
        .allocator = *allocator};
}
