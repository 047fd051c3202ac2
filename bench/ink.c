/* Compares drawings by distance from ink to ink.
 *
 * Whether ink lies within px of a pixel is asked exactly, by two steps: `above` holds each pixel's
 * distance to the nearest ink of its own column; ink of column x + dx is then within px if that
 * distance there, squared, plus dx squared is at most px squared. This is the Euclidean distance
 * transform, cut off at px, where few columns need to be looked at.
 *
 * Crumbs: pieces are filled from a stack. Every pixel is pushed once at most, as it is marked when
 * it is pushed. */
#include "ink.h"

#include <drypoint/io.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double half_white = 128; /* luminance below which a pixel is ink */

/* Of a pixel on white paper, 0 to 255: Rec. 709's weights, of values as they are stored. */
static double luminance(const uint8_t rgba[4]) {
    const double grey = 0.212656 * rgba[0] + 0.715158 * rgba[1] + 0.072186 * rgba[2];
    const double alpha = rgba[3] / 255.0;
    return 255 * (1 - alpha) + grey * alpha;
}

bool ink_make(const uint8_t *rgba, uint32_t width, uint32_t height, ink *out) {
    const size_t pixels = (size_t)width * height;
    *out = (ink){.pixels = malloc(pixels + 1), .width = width, .height = height};
    if (!out->pixels) return false;
    for (size_t p = 0; p < pixels; p++) {
        out->pixels[p] = round(luminance(rgba + 4 * p)) < half_white;
        out->count += out->pixels[p];
    }
    return true;
}

bool ink_read(const char *path, ink *out) {
    dp_io_pixels picture = {0};
    dp_diag diag = {0};
    *out = (ink){0};
    if (dp_io_read_png(path, &picture, &diag))
        return fprintf(stderr, "%s: %s\n", path, diag.message), false;
    const bool made = ink_make(picture.rgba, picture.width, picture.height, out);
    if (!made) fprintf(stderr, "%s: not enough memory\n", path);
    dp_io_free_pixels(&picture);
    return made;
}

void ink_free(ink *i) {
    free(i->pixels);
    *i = (ink){0};
}

/* [height][width]: distance to the nearest ink of the pixel's own column, at most `far`, which
 * means that there is none. NULL: no memory. */
static uint32_t *column_distances(const ink *i, uint32_t far) {
    const size_t width = i->width, pixels = width * i->height;
    uint32_t *const distance = malloc((pixels + 1) * sizeof *distance);
    if (!distance) return NULL;
    for (size_t p = 0; p < pixels; p++) {
        const uint32_t above = p < width ? far : distance[p - width];
        distance[p] = i->pixels[p] ? 0 : above < far ? above + 1 : far;
    }
    for (size_t p = pixels; p-- > width;)
        if (distance[p - width] > distance[p] + 1) distance[p - width] = distance[p] + 1;
    return distance;
}

/* Whether a row of column distances, cut off at `far`, says that ink is within px of column x. */
static bool is_near(const uint32_t *row, uint32_t width, uint32_t far, uint32_t x, double px) {
    const uint32_t reach = px < width ? (uint32_t)px : width;
    const uint32_t from = x < reach ? 0 : x - reach;
    const uint32_t to = width - 1 - x < reach ? width - 1 : x + reach;
    for (uint32_t c = from; c <= to; c++) {
        const double dx = (double)c - (double)x, dy = row[c];
        if (row[c] < far && dx * dx + dy * dy <= px * px) return true;
    }
    return false;
}

size_t ink_near(const ink *a, const ink *b, double px) {
    const uint32_t far = px < b->height ? (uint32_t)px + 1 : b->height + 1;
    uint32_t *const distance = column_distances(b, far);
    if (!distance) return SIZE_MAX;
    size_t near = 0;
    for (uint32_t y = 0; b->count && y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++) {
            const size_t row = (size_t)y * a->width;
            near += a->pixels[row + x] && is_near(distance + row, a->width, far, x, px);
        }
    free(distance);
    return near;
}

/* A piece of ink while it is filled. */
typedef struct piece {
    uint32_t left, right, top, bottom;
    size_t count;
} piece;

/* Pixels that wait to be filled, by number; unseen: ink that was never among them. */
typedef struct filling {
    uint8_t *unseen;
    size_t *stack, waiting;
} filling;

static void push(filling *f, size_t pixel) {
    if (!f->unseen[pixel]) return;
    f->unseen[pixel] = 0;
    f->stack[f->waiting++] = pixel;
}

static piece fill(filling *f, uint32_t width, uint32_t height, size_t first) {
    piece p = {.left = width, .top = height};
    push(f, first);
    while (f->waiting) {
        const size_t pixel = f->stack[--f->waiting];
        const uint32_t x = (uint32_t)(pixel % width), y = (uint32_t)(pixel / width);
        p.count++;
        if (x < p.left) p.left = x;
        if (x > p.right) p.right = x;
        if (y < p.top) p.top = y;
        if (y > p.bottom) p.bottom = y;
        for (uint32_t v = y ? y - 1 : 0; v <= y + 1 && v < height; v++)
            for (uint32_t u = x ? x - 1 : 0; u <= x + 1 && u < width; u++)
                push(f, (size_t)v * width + u);
    }
    return p;
}

size_t ink_crumbs(const ink *i, uint32_t size) {
    const size_t pixels = (size_t)i->width * i->height;
    filling f = {malloc(pixels + 1), malloc((i->count + 1) * sizeof *f.stack), 0};
    size_t crumbs = SIZE_MAX;
    if (f.unseen && f.stack) {
        crumbs = 0;
        memcpy(f.unseen, i->pixels, pixels);
        for (size_t first = 0; first < pixels; first++) {
            if (!f.unseen[first]) continue;
            const piece p = fill(&f, i->width, i->height, first);
            if (p.right - p.left + 1 < size && p.bottom - p.top + 1 < size) crumbs += p.count;
        }
    }
    free(f.unseen);
    free(f.stack);
    return crumbs;
}
