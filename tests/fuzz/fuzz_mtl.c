/* Fuzzes the reader of material libraries; each material found must be found again by its name. */
#include "io/mtl.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_materials materials;
    dp_stream *stream = NULL;
    if (dp_stream_open_memory(data, size, size & 1 ? 2 * DP_STREAM_AHEAD : DP_STREAM_WINDOW, NULL,
                              &stream, NULL))
        return 0;
    dp_materials_init(&materials, &memory);
    if (!dp_read_mtl(stream, &materials)) abort();
    for (size_t i = 0; i < materials.names.count; i++) {
        uint16_t number;
        const char *const name = dp_groups_name(&materials.names, (uint32_t)i);
        if (!dp_materials_find(&materials, name ? name : "", &number) || number != i) abort();
        const uint32_t color = dp_materials_color(&materials, number);
        if (color && (color & 255) != 255) abort();
    }
    dp_materials_destroy(&materials);
    dp_stream_close(stream);
    return 0;
}
