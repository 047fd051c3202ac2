/* Fuzzes the cleaning of drawings: segments from bytes, many of them degenerate.
 *
 * Layout of the input: a byte of options, a byte of lengths, then 5 bytes a segment: its ends on a
 * small grid, or at coordinates that arithmetic stumbles over, and a byte of class, level and pen.
 * Asserted is what must hold whatever the segments are: lengths add up, no path is too short. */
#include "vector/drawing.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 4096 };

static float coordinate(uint8_t b) {
    static const float special[] = {0,     -0.0f,  1e-40f, 1e-7f, 1e6f,  -1e6f, 3e9f, -3e9f,
                                    0.02f, 40.01f, 40.02f, 1e-3f, 41.9f, 42.1f, 7.5f, 32768};
    return b >= 240 ? special[b - 240] : 10 * (float)(b % 16) + 0.015625f * (float)(b / 16);
}

static dp_segment segment_of(const uint8_t *b, uint64_t number) {
    dp_segment s = {.line = (dp_line)(b[4] % DP_LINE_COUNT),
                    .a = {coordinate(b[0]), coordinate(b[1]), 1 + (float)(b[4] >> 6)},
                    .b = {coordinate(b[2]), coordinate(b[3]), 1 + (float)(b[4] >> 7)},
                    .polygon = number,
                    .level = b[4] >> 3 & 1,
                    .width = 1 + (float)(b[4] >> 4 & 1),
                    .color = b[4] & 32 ? 0xFF : 0xFF0000FF};
    for (int k = 0; k < 2; k++) s.world_a[k] = (double)s.a[k], s.world_b[k] = (double)s.b[k];
    return s;
}

static void check(const dp_drawing *d, float min_length) {
    dp_drawing_info info;
    double length = 0;
    dp_drawing_info_of(d, &info);
    for (size_t i = 0; i < info.paths; i++) {
        dp_path p;
        if (!dp_drawing_path(d, i, &p) || p.count < 2 || !(p.length >= min_length)) abort();
        length += (double)p.length;
        for (size_t k = 0; k < p.count; k++)
            if (!isfinite(p.points[k].x) || !isfinite(p.points[k].y)) abort();
    }
    if (!(fabs(length - info.length) <= 1e-3 + 1e-5 * length)) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static dp_segment segments[MOST];
    static const float joins[] = {0, -1, 5, 1000}, least[] = {0, -1, 0.1f, 30};
    if (size < 2) return 0;
    const uint8_t options = data[0];
    size_t count = 0;
    for (size_t at = 2; at + 5 <= size && count < MOST; at += 5, count++)
        segments[count] = segment_of(data + at, count);
    const dp_drawn drawn = {.segments = segments,
                            .count = count,
                            .width = 160,
                            .height = 160,
                            .perspective = options & 1,
                            .focal = options & 2 ? 100 : 0};
    const dp_drawing_desc desc = {.join = joins[data[1] & 3],
                                  .min_length = least[data[1] >> 2 & 3],
                                  .tolerance = data[1] & 16 ? 3 : 0,
                                  .join_classes = options & 4,
                                  .keep_coincident = options & 8,
                                  .optimize = options & 16};
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_drawing *drawing = NULL;
    if (dp_drawing_make(&drawn, &desc, &memory, &drawing, NULL)) abort();
    check(drawing, desc.min_length > 0 ? desc.min_length : desc.min_length < 0 ? 0 : 1);
    dp_drawing_destroy(drawing);
    return 0;
}
