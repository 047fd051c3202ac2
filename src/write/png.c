/* Writes a picture as PNG, fast: a drawing is mostly plain paper, so the cheapest compression makes
 * it small. Channels that all pixels share are left out (colour if all are grey, alpha if all are
 * opaque): less to compress, and smaller files.
 *
 * libpng reports errors by longjmp: that stays within encode(), and everything that must survive it
 * is in the encoder, not in local variables.
 *
 * Not handled: palettes, 16 bits, interlacing, colour profiles. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "base/memory.h"
#include "write/file.h"
#include "write/png.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEVEL = 1, /* of zlib: higher levels take much longer and gain little on drawings */
    ROWS_PER_REPORT = 64,
    DPI_MOST = 1000000 /* of what fits into a PNG's 31 bits per metre */
};

typedef struct encoder {
    const dp_io_picture *picture;
    dp_output output;
    bool in_memory; /* instead: */
    char *bytes;
    size_t size, cap;
    dp_diag diag;
    dp_result result;
    png_structp png;
    png_infop info;
    uint8_t *row;
    bool gray, opaque;
} encoder;

static const uint8_t *row_of(const dp_io_picture *picture, uint32_t y) {
    const size_t stride = picture->stride ? picture->stride : (size_t)4 * picture->width;
    return picture->rgba + y * stride;
}

/* ---- libpng's callbacks ---- */

static void on_error(png_structp png, png_const_charp message) {
    encoder *const self = png_get_error_ptr(png);
    if (!self->result) self->result = dp_fail(&self->diag, DP_ERR_IO, "libpng: %s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static dp_result append(encoder *self, const void *bytes, size_t size) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    if (!dp_reserve(&memory, &self->bytes, &self->cap, self->size + size, 1))
        return dp_fail(&self->diag, DP_ERR_MEMORY, "out of memory for a PNG");
    memcpy(self->bytes + self->size, bytes, size);
    self->size += size;
    return DP_OK;
}

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    encoder *const self = png_get_io_ptr(png);
    self->result = self->in_memory ? append(self, bytes, size)
                                   : dp_output_write(&self->output, bytes, size, &self->diag);
    if (self->result) png_error(png, "write");
}

static void on_flush(png_structp png) { (void)png; }

/* ---- pixels ---- */

/* Combines a row with bitwise operators, so that the loop has no branches. */
static void look_for_colour(encoder *self) {
    const dp_io_picture *const p = self->picture;
    self->gray = self->opaque = true;
    for (uint32_t y = 0; y < p->height && (self->gray || self->opaque); y++) {
        const uint8_t *const row = row_of(p, y);
        uint8_t coloured = 0, alpha = 0xFF;
        for (size_t x = 0; x < (size_t)4 * p->width; x += 4) {
            coloured |= (uint8_t)((row[x] ^ row[x + 1]) | (row[x] ^ row[x + 2]));
            alpha &= row[x + 3];
        }
        if (coloured) self->gray = false;
        if (alpha != 0xFF) self->opaque = false;
    }
}

/* The row with only the channels that are written. */
static const uint8_t *pack_row(const encoder *self, const uint8_t *rgba) {
    const size_t n = self->picture->width;
    uint8_t *const to = self->row;
    if (!self->gray && !self->opaque) return rgba;
    if (self->gray && self->opaque)
        for (size_t x = 0; x < n; x++) to[x] = rgba[4 * x];
    else if (self->gray)
        for (size_t x = 0; x < n; x++) to[2 * x] = rgba[4 * x], to[2 * x + 1] = rgba[4 * x + 3];
    else
        for (size_t x = 0; x < n; x++)
            to[3 * x] = rgba[4 * x], to[3 * x + 1] = rgba[4 * x + 1],
                   to[3 * x + 2] = rgba[4 * x + 2];
    return to;
}

/* ---- the file ---- */

static int colour_type(const encoder *self) {
    if (self->gray) return self->opaque ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_GRAY_ALPHA;
    return self->opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
}

static uint32_t per_metre(uint32_t dpi) { return (uint32_t)(dpi / 0.0254 + 0.5); }

static void write_header(encoder *self) {
    png_set_write_fn(self->png, self, on_write, on_flush);
    png_set_compression_level(self->png, LEVEL);
    /* No filter: plain paper is runs of equal bytes already, and lines are too thin to predict. */
    png_set_filter(self->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_buffer_size(self->png, 1 << 16);
    png_set_IHDR(self->png, self->info, self->picture->width, self->picture->height, 8,
                 colour_type(self), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (self->picture->dpi)
        png_set_pHYs(self->png, self->info, per_metre(self->picture->dpi),
                     per_metre(self->picture->dpi), PNG_RESOLUTION_METER);
    png_write_info(self->png, self->info);
}

static void write_rows(encoder *self) {
    const dp_io_picture *const p = self->picture;
    for (uint32_t y = 0; y < p->height; y++) {
        if (p->progress && y % ROWS_PER_REPORT == 0 &&
            p->progress(p->user, (double)y / p->height)) {
            self->result = dp_fail(&self->diag, DP_ERR_CANCELLED, "writing was stopped");
            png_error(self->png, "cancelled");
        }
        png_write_row(self->png, pack_row(self, row_of(p, y)));
    }
}

/* Everything that may longjmp. */
static void encode(encoder *self) {
    if (setjmp(png_jmpbuf(self->png))) return;
    write_header(self);
    write_rows(self);
    png_write_end(self->png, self->info);
}

static dp_result prepare(encoder *self) {
    dp_diag *const diag = &self->diag;
    self->row = malloc(dp_times(4, self->picture->width));
    self->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, self, on_error, on_warning);
    if (self->png) self->info = png_create_info_struct(self->png);
    if (!self->row || !self->info) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a PNG");
    png_set_user_limits(self->png, self->picture->width, self->picture->height);
    look_for_colour(self);
    return DP_OK;
}

static dp_result write_picture(encoder *self, const char *path) {
    dp_result unprepared = prepare(self);
    if (!unprepared) unprepared = dp_output_open(&self->output, path, &self->diag);
    if (unprepared) return unprepared;
    encode(self);
    if (self->result)
        dp_output_abandon(&self->output);
    else
        self->result = dp_output_commit(&self->output, &self->diag);
    return self->result;
}

static dp_result check_size(const dp_io_picture *picture, dp_diag *diag) {
    if (picture->dpi > DPI_MOST)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u pixels per inch are too many; %d are the most",
                       picture->dpi, DPI_MOST);
    if (picture->width <= PNG_UINT_31_MAX / 4 && picture->height <= PNG_UINT_31_MAX) return DP_OK;
    return dp_fail(diag, DP_ERR_LIMIT, "a PNG cannot be %u x %u pixels large", picture->width,
                   picture->height);
}

dp_result dp_png_encode(const uint8_t *rgba, uint32_t width, uint32_t height, void **png,
                        size_t *size, dp_diag *diag) {
    const dp_io_picture picture = {.rgba = rgba, .width = width, .height = height};
    encoder self = {.picture = &picture, .in_memory = true};
    if (!width || !height)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a ground of %u x %u pixels", width, height);
    const dp_result too_large = check_size(&picture, diag);
    if (too_large) return too_large;
    self.result = prepare(&self);
    if (!self.result) encode(&self);
    png_destroy_write_struct(&self.png, &self.info);
    free(self.row);
    if (self.result) {
        free(self.bytes);
        if (diag) *diag = self.diag;
        return self.result;
    }
    *png = self.bytes;
    *size = self.size;
    return DP_OK;
}

dp_result dp_io_write_picture(const char *path, const dp_io_picture *picture, dp_diag *diag) {
    if (!path || !picture || !picture->rgba || !picture->width || !picture->height)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "nothing to write, or nowhere: path or rgba is NULL, or width or height 0");
    const dp_result too_large = check_size(picture, diag);
    if (too_large) return too_large;
    if (picture->stride && picture->stride < (size_t)4 * picture->width)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "rows are %zu bytes apart, but one of %u pixels takes %zu", picture->stride,
                       picture->width, (size_t)4 * picture->width);
    encoder self = {.picture = picture};
    const dp_result result = write_picture(&self, path);
    png_destroy_write_struct(&self.png, &self.info);
    free(self.row);
    if (result && diag) *diag = self.diag;
    return result;
}

dp_result dp_io_write_png(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height,
                          size_t stride, dp_diag *diag) {
    const dp_io_picture picture = {
        .rgba = rgba, .width = width, .height = height, .stride = stride};
    return dp_io_write_picture(path, &picture, diag);
}
