/* Reads a PNG as RGBA of 8 bits per channel, whatever is in it: for textures. */
#include <drypoint/io.h>

#include "base/diag.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

static const size_t MOST_PIXELS = (size_t)1 << 28;

dp_result dp_io_read_png(const char *path, dp_io_pixels *pixels, dp_diag *diag) {
    if (!path || !pixels) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_read_png: nothing to read, or nowhere");
    *pixels = (dp_io_pixels){0};
    FILE *const file = fopen(path, "rb");
    if (!file) return dp_fail(diag, DP_ERR_IO, "cannot open it: %s", strerror(errno));
    png_image image = {.version = PNG_IMAGE_VERSION};
    dp_result result = DP_OK;
    uint8_t *rgba = NULL;
    if (!png_image_begin_read_from_stdio(&image, file))
        result = dp_fail(diag, DP_ERR_FORMAT, "no PNG that can be read: %s", image.message);
    else if ((size_t)image.width * image.height > MOST_PIXELS)
        result = dp_fail(diag, DP_ERR_LIMIT, "%u x %u pixels are too many", image.width, image.height);
    else if (!(rgba = malloc((size_t)4 * image.width * image.height)))
        result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for %u x %u pixels", image.width, image.height);
    image.format = PNG_FORMAT_RGBA;
    if (!result && !png_image_finish_read(&image, NULL, rgba, 0, NULL))
        result = dp_fail(diag, DP_ERR_FORMAT, "a PNG that is broken: %s", image.message);
    png_image_free(&image);
    fclose(file);
    if (result) free(rgba);
    else *pixels = (dp_io_pixels){rgba, image.width, image.height};
    return result;
}

void dp_io_free_pixels(dp_io_pixels *pixels) {
    if (!pixels) return;
    free(pixels->rgba);
    *pixels = (dp_io_pixels){0};
}
