/* Times the edge detectors over a picture full of surface, on one core, for every kind of processor
 * this one can be: nanoseconds per pixel, the least of many runs. One JSON object per line. */
#include "gbuffer/detect.h"
#include "base/kernels.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WIDTH = 1680, HEIGHT = 1050, MARGIN = 4, STRIDE = 1696, RUN = 64, ROUNDS = 15 };

static float planes[4][HEIGHT + 2 * MARGIN][STRIDE];

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static dp_rows rows_at(int plane, int x, int y) {
    return (dp_rows){&planes[plane][y - 1][x], &planes[plane][y][x], &planes[plane][y + 1][x]};
}

/* Tiles in order, as the passes go; runs of 64 pixels. */
static double time_one(const dp_detectors *d, int which) {
    static const dp_depth_measure scaled = {.scale = 90, .perspective = true},
                                  printed = {.scale = 0.3f};
    static const dp_rays rays = {true, 840, 525, 1665, 1665};
    double least = 1e30;
    volatile float sink = 0;
    for (int round = 0; round < ROUNDS; round++) {
        const double start = now();
        for (int ty = 0; ty < HEIGHT; ty += RUN)
            for (int x = MARGIN; x < WIDTH; x += RUN)
                for (int y = ty + MARGIN; y < ty + RUN && y < HEIGHT + MARGIN; y++) {
                    float a[RUN], b[RUN] = {0}, slope[RUN];
                    const dp_rows nx = rows_at(0, x, y), ny = rows_at(1, x, y),
                                  nz = rows_at(2, x, y), z = rows_at(3, x, y);
                    switch (which) {
                    case 0:
                        d->diagonal_scaled(nx, ny, nz, z, &scaled, 1, RUN, a, b);
                        break;
                    case 1:
                        d->diagonal_normals(nx, ny, nz, 1, RUN, a);
                        d->diagonal_depth_printed(z, &printed, 1, RUN, b);
                        break;
                    case 2:
                        d->c1_slope(&rays, nx.at, ny.at, nz.at, (uint32_t)x, (uint32_t)y, RUN,
                                    slope);
                        for (int pass = 0; pass < 3; pass++)
                            d->c1_scaled(z, slope, &scaled, pass, 1, RUN, b);
                        break;
                    default:
                        for (int pass = 0; pass < 3; pass++)
                            d->c1_printed(z, &printed, pass, 1, RUN, b);
                        break;
                    }
                    sink = b[y % RUN];
                }
        const double spent = now() - start;
        if (spent < least) least = spent;
    }
    (void)sink;
    return least / ((double)WIDTH * HEIGHT);
}

int main(void) {
    static const char *const names[4] = {"diagonal_scaled", "diagonal_printed", "c1_scaled",
                                         "c1_printed"};
    dp_width list[DP_WIDTHS_MOST];
    for (size_t i = 0; i < sizeof planes / sizeof(float); i++)
        ((float *)planes)[i] = (float)(rand() & 1023) / 1024 + 0.5f;
    const uint32_t n = dp_widths_list(list);
    for (uint32_t k = 0; k < n; k++) {
        const dp_detectors *const d = dp_detectors_for(list[k].lanes);
        printf("{\"processor\": \"%s\"", list[k].name);
        for (int which = 0; which < 4; which++)
            printf(", \"%s_ns\": %.2f", names[which], time_one(d, which));
        printf("}\n");
    }
    return 0;
}
