/* Planes of the target as pictures: normals as the paper's texture encodes them (half plus half,
 * opaque), distance from white (near) to black (far), groups as colours, the edge map unchanged. */
#include "planes.h"
#include "output.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* By plane: bytes of a pixel, and how it becomes a colour. */
static const size_t plane_size[PLANE_COUNT] = {
    [PLANE_EDGE_MAP] = 4, [PLANE_NORMALS] = 12, [PLANE_DEPTH] = 4, [PLANE_ID] = 2};

static void put_plane(dp_target *t, output_plane plane, void *block) {
    if (plane == PLANE_EDGE_MAP) t->edge_map = block;
    if (plane == PLANE_NORMALS) t->eye_normal = block;
    if (plane == PLANE_DEPTH) t->distance = block;
    if (plane == PLANE_ID) t->id = block;
}

int planes_prepare(const tool_settings *s, dp_target *t) {
    for (int k = 0; k < PLANE_COUNT; k++) {
        if (!s->outputs[k]) continue;
        if (!output_possible(s->outputs[k])) return EXIT_FAILED;
        void *const block = calloc((size_t)t->width * t->height, plane_size[k]);
        if (!block) {
            wrong_usage("out of memory for the %s; give a smaller --size", output_names[k]);
            return EXIT_FAILED;
        }
        put_plane(t, (output_plane)k, block);
    }
    return 0;
}

void planes_free(dp_target *t) {
    free(t->edge_map);
    free(t->eye_normal);
    free(t->distance);
    free(t->id);
}

static void gray(uint8_t out[4], double v) {
    out[0] = out[1] = out[2] = (uint8_t)(255 * v + 0.5);
    out[3] = 255;
}

static void draw_normals(const dp_target *t, size_t n, uint8_t *rgba) {
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++)
            rgba[4 * i + k] = (uint8_t)(127.5f + 127.5f * t->eye_normal[3 * i + k] + 0.5f);
        rgba[4 * i + 3] = 255;
    }
}

static void draw_distance(const dp_target *t, size_t n, uint8_t *rgba) {
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(t->distance[i])) continue;
        least = fmin(least, (double)t->distance[i]), most = fmax(most, (double)t->distance[i]);
    }
    const double range = most > least ? most - least : 1;
    for (size_t i = 0; i < n; i++) {
        if (isfinite(t->distance[i]))
            gray(rgba + 4 * i, 0.9 - 0.8 * ((double)t->distance[i] - least) / range);
        else
            gray(rgba + 4 * i, 0);
    }
}

/* One colour per group: hues apart by the golden ratio. */
static void draw_ids(const dp_target *t, size_t n, uint8_t *rgba) {
    for (size_t i = 0; i < n; i++) {
        gray(rgba + 4 * i, 1);
        if (!t->id[i]) continue;
        const double hue = 6 * fmod(0.07 + 0.6180339887 * t->id[i], 1);
        for (int k = 0; k < 3; k++) {
            const double off =
                fabs(fmod(hue + 8 - 2 * k, 6) - 3); /* 0 opposite, 3 at the channel */
            rgba[4 * i + k] = (uint8_t)(70 + 160 * fmin(fmax(off - 1, 0), 1));
        }
    }
}

static int write_plane(const char *path, const uint8_t *rgba, const dp_target *t) {
    dp_diag diag = {0};
    interrupt_hold();
    const dp_result result = dp_io_write_png(path, rgba, t->width, t->height, 0, &diag);
    interrupt_release();
    return result ? report_failure(NULL, &diag) : 0;
}

int planes_write(const tool_settings *s, const dp_target *t) {
    const size_t n = (size_t)t->width * t->height;
    int code = 0;
    for (int k = 0; k < PLANE_COUNT && !code; k++) {
        if (!s->outputs[k]) continue;
        uint8_t *const rgba = calloc(n, 4);
        if (!rgba) {
            wrong_usage("out of memory for the %s; give a smaller --size", output_names[k]);
            return EXIT_FAILED;
        }
        if (k == PLANE_EDGE_MAP) memcpy(rgba, t->edge_map, 4 * n);
        if (k == PLANE_NORMALS) draw_normals(t, n, rgba);
        if (k == PLANE_DEPTH) draw_distance(t, n, rgba);
        if (k == PLANE_ID) draw_ids(t, n, rgba);
        code = write_plane(s->outputs[k], rgba, t);
        free(rgba);
    }
    return code;
}
