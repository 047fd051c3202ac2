/* Fuzzes dp_source_open_memory as applications call it. Up to the first 0 byte the input is a
 * model, of any format; the rest is every file that the model names. A model with a 0 byte in it
 * (any binary one) is also read whole. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct beside {
    const uint8_t *data;
    size_t size;
    int open;
} beside;

static bool open_beside(void *user, const char *name, const void **data, size_t *size) {
    beside *const self = user;
    if (!*name || strchr(name, '\\')) abort();
    if (*name == '!') return false; /* some are not there */
    *data = self->data;
    *size = self->size;
    self->open++;
    return true;
}

static void close_beside(void *user, const void *data, size_t size) {
    beside *const self = user;
    if (data != self->data || size != self->size) abort();
    self->open--;
}

static void drain_both_ways(dp_source *source) {
    for (uint32_t g = 0; g < 3; g++) {
        const uint32_t color = dp_source_group_color(source, g);
        if (color && (color & 255) != 255) abort();
    }
    const uint64_t first = dp_fuzz_drain(source);
    dp_diag diag;
    if (dp_source_rewind(source, &diag) || dp_fuzz_drain(source) != first) abort();
}

static void open_one(const uint8_t *data, size_t size, beside *files) {
    const dp_memory_file file = {.data = data,
                                 .size = size,
                                 .name = "model.obj",
                                 .open_beside = open_beside,
                                 .close_beside = close_beside,
                                 .user = files};
    dp_source *source = NULL;
    dp_diag diag = {0};
    const dp_result result = dp_source_open_memory(&file, NULL, &source, &diag);
    if (files->open || !source != !!result) abort();
    if (result && (!diag.message[0] || diag.result != result)) abort();
    if (source) drain_both_ways(source);
    dp_source_destroy(source);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const uint8_t *const cut = size ? memchr(data, 0, size) : NULL;
    beside files = {0};
    open_one(data, size, &files);
    if (!cut) return 0;
    files.data = cut + 1;
    files.size = size - (size_t)(cut + 1 - data);
    open_one(data, (size_t)(cut - data), &files);
    return 0;
}
