/* Reads PNG files, for textures, through libpng's simplified interface.
 *
 * libpng turns any PNG (palette, grey, 16 bits, interlaced) into RGBA of 8 bits; dp_texture_create
 * decides what is ink. Not handled: other formats. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "base/memory.h"
#include "base/print.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <string.h>

enum { LARGEST_STROKE = 8192 /* px, a side */ };
static const size_t MOST_PIXELS = (size_t)1 << 28;

static dp_result read_pixels(png_image *image, const dp_allocator *memory, dp_io_pixels *out,
                             dp_diag *diag) {
    if ((uint64_t)image->width * image->height > MOST_PIXELS)
        return dp_fail(diag, DP_ERR_LIMIT, "%u x %u pixels are too many", image->width,
                       image->height);
    uint8_t *const rgba = dp_alloc_array(memory, (size_t)image->width * image->height, 4);
    if (!rgba)
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for %u x %u pixels", image->width,
                       image->height);
    image->format = PNG_FORMAT_RGBA;
    if (!png_image_finish_read(image, NULL, rgba, 0, NULL)) {
        dp_free(memory, rgba);
        return dp_fail(diag, DP_ERR_FORMAT, "the PNG is broken: %s; save it again", image->message);
    }
    *out = (dp_io_pixels){rgba, image->width, image->height};
    return DP_OK;
}

/* Reads a file of at most `most` px per side. */
static dp_result read_file(const char *path, uint32_t most, const dp_allocator *memory,
                           dp_io_pixels *out, dp_diag *diag) {
    FILE *const file = fopen(path, "rb");
    if (!file)
        return dp_fail(diag, DP_ERR_IO, "cannot be opened: %s",
                       dp_print_error((char[DP_ERROR_TEXT]){0}, errno));
    png_image image = {.version = PNG_IMAGE_VERSION};
    dp_result result;
    if (!png_image_begin_read_from_stdio(&image, file))
        result = dp_fail(diag, DP_ERR_FORMAT,
                         "this is no PNG (%s); textures are read from PNG files", image.message);
    else if (image.width > most || image.height > most)
        result = dp_fail(diag, DP_ERR_LIMIT, "a texture of %u x %u px; give one of at most %u x %u",
                         image.width, image.height, most, most);
    else
        result = read_pixels(&image, memory, out, diag);
    png_image_free(&image);
    fclose(file);
    return result;
}

dp_result dp_io_read_png(const char *path, dp_io_pixels *pixels, dp_diag *diag) {
    if (!path || !pixels)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_read_png: nothing to read, or nowhere");
    *pixels = (dp_io_pixels){0};
    const dp_allocator memory = dp_allocator_resolve(NULL);
    return read_file(path, UINT32_MAX, &memory, pixels, diag);
}

void dp_io_free_pixels(dp_io_pixels *pixels) {
    if (!pixels) return;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_free(&memory, pixels->rgba);
    *pixels = (dp_io_pixels){0};
}

dp_result dp_io_read_texture(const char *path, const dp_allocator *allocator, dp_texture **out,
                             dp_diag *diag) {
    if (!path || !out)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_read_texture: path or out is NULL");
    *out = NULL;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    dp_io_pixels p = {0};
    const dp_result result = read_file(path, LARGEST_STROKE, &memory, &p, diag);
    if (result) return result;
    const dp_texture_desc desc = {.pixels = p.rgba,
                                  .width = p.width,
                                  .height = p.height,
                                  .channels = 4,
                                  .allocator = &memory};
    const dp_result made = dp_texture_create(&desc, out, diag);
    dp_free(&memory, p.rgba);
    return made;
}
