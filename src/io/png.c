/* Reading stroke textures from PNG files, through libpng's simplified interface.
 *
 * Any PNG is taken (palette, grey, 16 bits, interlaced): libpng turns it into RGBA of 8 bits, and what of that is ink
 * is decided by dp_texture_create. Does not handle: other formats. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "base/memory.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <string.h>

enum { LARGEST = 8192 };

static dp_result read_pixels(png_image *image, const dp_allocator *memory, dp_texture **out, dp_diag *diag) {
    if (image->width > LARGEST || image->height > LARGEST)
        return dp_fail(diag, DP_ERR_LIMIT, "a texture of %u x %u px; give one of at most %d x %d", image->width,
                       image->height, LARGEST, LARGEST);
    image->format = PNG_FORMAT_RGBA;
    uint8_t *const pixels = dp_alloc_array(memory, (size_t)image->width * image->height, 4);
    if (!pixels) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a texture");
    dp_result result;
    if (png_image_finish_read(image, NULL, pixels, 0, NULL)) {
        const dp_texture_desc desc = {.pixels = pixels, .width = image->width, .height = image->height, .channels = 4,
                                      .allocator = memory};
        result = dp_texture_create(&desc, out, diag);
    } else {
        result = dp_fail(diag, DP_ERR_FORMAT, "the PNG is broken: %s; save it again", image->message);
    }
    dp_free(memory, pixels);
    return result;
}

dp_result dp_io_read_texture(const char *path, const dp_allocator *allocator, dp_texture **out, dp_diag *diag) {
    if (!path || !out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_read_texture: path or out is NULL");
    *out = NULL;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    FILE *const file = fopen(path, "rb");
    if (!file) return dp_fail(diag, DP_ERR_IO, "cannot be opened: %s", strerror(errno));
    png_image image = {.version = PNG_IMAGE_VERSION};
    dp_result result;
    if (png_image_begin_read_from_stdio(&image, file)) result = read_pixels(&image, &memory, out, diag);
    else result = dp_fail(diag, DP_ERR_FORMAT, "this is no PNG (%s); textures are read from PNG files", image.message);
    png_image_free(&image);
    fclose(file);
    return result;
}
