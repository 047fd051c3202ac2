/* Reads a model in memory and writes a picture through the component io; fails when either does. */
#include <drypoint/io.h>

#include <stdio.h>

int main(void) {
    static const char model[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const uint8_t rgba[4] = {0, 0, 0, 255};
    const dp_memory_file file = {.data = model, .size = sizeof model - 1, .name = "model.off"};
    dp_source *source = NULL;
    dp_diag diag;
    dp_result result = dp_io_open_memory(&file, NULL, &source, &diag);
    dp_source_destroy(source);
    if (!result) result = dp_io_write_png("consumed.png", rgba, 1, 1, 4, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    return result != DP_OK;
}
