/* Fuzzes the writers of pages: drawings that no picture would give, and pages that nobody would ask
 * for, in every format.
 *
 * Layout of the input: a byte each for the format, flags, views, texts and rules; 8 for the page;
 * then views, rules and paths from what follows, as numbers of a byte, some of which arithmetic
 * stumbles over; texts are what remains. Asserted is that a page that is accepted is written, and the
 * same twice. */
#include "base/memory.h"
#include "vector/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { PATHS_MOST = 64, POINTS_MOST = 2048, VIEWS_MOST = 3, WIDTH = 9, HEIGHT = 5 };

typedef struct bytes {
    const uint8_t *at, *end;
} bytes;

static uint8_t next(bytes *b) { return b->at < b->end ? *b->at++ : 0; }

static double number(bytes *b) {
    static const double special[] = {0,    -0.0, NAN,    INFINITY, 3e38, -3e38,    1e-40, 1e20,
                                     -1e6, 1e-7, 0.0005, 0.3333,   1e9,  999999.9, 1e4,   1};
    const uint8_t value = next(b);
    return value >= 248   ? special[value & 15]
           : value >= 232 ? special[value & 7]
                          : value / 4.0 - 20;
}

static dp_color color(bytes *b) {
    const uint32_t value = next(b);
    return value << 24 | (value * 7 & 255) << 16 | (value * 31 & 255) << 8 |
           (value & 1 ? 255 : value);
}

static void add_path(bytes *b, struct dp_drawing *d) {
    dp_stored_path *const p = &d->paths[d->info.paths];
    const uint8_t kind = next(b);
    *p = (dp_stored_path){.line = (dp_line)(kind % 5),
                          .level = kind & 128 ? next(b) : kind >> 3 & 3,
                          .closed = kind & 64,
                          .width = (float)number(b),
                          .color = color(b),
                          .dash = {(float)number(b), (float)number(b)},
                          .end = {(dp_line_end)(kind & 3), (dp_line_end)(kind >> 2 & 7)},
                          .hider = {UINT64_MAX >> (kind & 15), kind},
                          .first = d->info.points,
                          .count = next(b) % 40};
    if (kind & 32) p->count *= 40;
    if (p->first + p->count > POINTS_MOST) p->count = POINTS_MOST - p->first;
    for (size_t i = 0; i < p->count; i++) {
        const bool far = kind & 32 && i % 40; /* of long ones, most points go on */
        d->points[d->info.points++] = (dp_path_point){.x = far ? (float)i : (float)number(b),
                                                      .y = far ? (float)(i % 3) : (float)number(b),
                                                      .distance = (float)number(b),
                                                      .edge = next(b),
                                                      .polygon = UINT64_MAX >> (i & 31),
                                                      .world = {number(b), 1 / 3.0, -1e300}};
    }
    d->info.paths++;
}

typedef struct hash {
    uint64_t value;
    size_t size;
} hash;

static dp_result add(void *user, const char *text, size_t size, dp_diag *diag) {
    hash *const h = user;
    (void)diag;
    for (size_t i = 0; i < size; i++)
        h->value = (h->value ^ (uint8_t)text[i]) * UINT64_C(0x100000001B3);
    h->size += size;
    return DP_OK;
}

static void write_twice(const dp_page *page, dp_format format) {
    hash a = {0}, b = {0};
    dp_diag diag = {0};
    const dp_result result = dp_page_write(page, format, add, &a, &diag);
    if (result && (result != DP_ERR_ARGUMENT || a.size || !*diag.message)) abort();
    if (!result && !a.size) abort();
    if (dp_page_write(page, format, add, &b, &diag) != result || a.value != b.value) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static dp_stored_path paths[PATHS_MOST];
    static dp_path_point points[POINTS_MOST];
    static uint8_t ground[4 * WIDTH * HEIGHT];
    struct dp_drawing drawing = {.memory = dp_allocator_resolve(NULL),
                                 .paths = paths,
                                 .points = points,
                                 .info = {.width = WIDTH, .height = HEIGHT, .levels = 3}};
    dp_view_on_page views[VIEWS_MOST] = {0};
    dp_page_rule rules[4] = {0};
    dp_page_text texts[4] = {0};
    char text[64] = {0};
    bytes b = {data, data + size};
    const uint8_t format = next(&b), flags = next(&b);
    dp_page page = {.views = views,
                    .view_count = next(&b) % (VIEWS_MOST + 1),
                    .texts = texts,
                    .text_count = next(&b) % 5,
                    .rules = rules,
                    .rule_count = next(&b) % 5,
                    .paper = color(&b),
                    .title = flags & 1 ? text : NULL};
    page.width = flags & 2 ? number(&b) : 0, page.height = flags & 2 ? number(&b) : 0;
    page.least_width = flags & 4 ? number(&b) : 0;
    for (size_t v = 0; v < page.view_count; v++) {
        views[v] = (dp_view_on_page){.drawing = &drawing,
                                     .name = flags & 8 ? text : NULL,
                                     .ground = flags & 16 ? ground : NULL,
                                     .ground_png = flags & 32 ? ground : NULL,
                                     .ground_png_size = flags & 32 ? sizeof ground - v : 0};
        if (flags & 64)
            views[v].x = number(&b), views[v].y = number(&b), views[v].mm_per_px = number(&b);
    }
    for (size_t i = 0; i < page.rule_count; i++)
        rules[i] = (dp_page_rule){number(&b), number(&b), number(&b), number(&b), number(&b)};
    for (size_t i = 0; i < page.text_count; i++)
        texts[i] = (dp_page_text){text, number(&b), number(&b), number(&b)};
    for (size_t i = 0; i < sizeof text - 1 && flags & 128; i++) text[i] = (char)next(&b);
    for (size_t i = 0; i < sizeof ground; i++) ground[i] = flags & 16 ? (uint8_t)(i * flags) : 255;
    while (b.at < b.end && drawing.info.paths < PATHS_MOST) add_path(&b, &drawing);
    for (int f = 0; f < DP_FORMAT_COUNT; f++)
        if (format >= 128 || f == format % DP_FORMAT_COUNT) write_twice(&page, (dp_format)f);
    return 0;
}
