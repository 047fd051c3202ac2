/* Pages for tests of writers: drawings made by hand, of every class, level, dash and end. */
#ifndef DP_TEST_PAGE_SCENE_H
#define DP_TEST_PAGE_SCENE_H

#include "base/memory.h"
#include "vector/drawing.h"

#include <drypoint/drypoint.h>

#include <string.h>

enum { SCENE_WIDTH = 40, SCENE_HEIGHT = 30, SCENE_PATHS = 12, SCENE_POINTS = 40 };

typedef struct page_scene {
    struct dp_drawing drawing;
    dp_stored_path paths[SCENE_PATHS];
    dp_path_point points[SCENE_POINTS];
    uint8_t ground[4 * SCENE_WIDTH * SCENE_HEIGHT];
    dp_view_on_page views[2];
    dp_page page;
} page_scene;

/* 4 x 3 pixels: what the ground shows in fields of 10 x 10. */
static const uint8_t scene_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x00, 0x03, 0x08, 0x02, 0x00, 0x00,
    0x00, 0x3b, 0x96, 0x39, 0x91, 0x00, 0x00, 0x00, 0x29, 0x49, 0x44, 0x41, 0x54, 0x78,
    0xda, 0x0d, 0xc8, 0xa1, 0x01, 0x00, 0x30, 0x0c, 0xc3, 0xb0, 0xfe, 0x7f, 0x99, 0x71,
    0x71, 0x70, 0x70, 0x3f, 0xf0, 0x26, 0xa8, 0x31, 0x60, 0x82, 0xca, 0xb4, 0x15, 0xa8,
    0x97, 0x1b, 0x7e, 0x5e, 0x12, 0x77, 0xf7, 0x01, 0x6e, 0x2a, 0x1f, 0xbe, 0xdd, 0x9c,
    0x9d, 0xff, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
static const uint8_t scene_fields[3][4][3] = {
    {{255, 220, 200}, {200, 255, 220}, {220, 200, 255}, {255, 255, 200}},
    {{230, 230, 230}, {255, 200, 200}, {200, 230, 255}, {240, 220, 240}},
    {{200, 220, 200}, {255, 240, 220}, {220, 220, 255}, {210, 210, 210}}};

/* Adds a path; `places`: x and y of its points. */
static inline dp_stored_path *scene_path(page_scene *s, dp_line line, uint32_t level, float width,
                                         dp_color color, const float *places, size_t count) {
    dp_drawing_info *const info = &s->drawing.info;
    dp_stored_path *const p = &s->paths[info->paths++];
    *p = (dp_stored_path){.line = line,
                          .level = level,
                          .width = width,
                          .color = color,
                          .end = {DP_END_HIDDEN, DP_END_VERTEX},
                          .hider = {7, UINT64_MAX},
                          .first = info->points,
                          .count = count};
    for (size_t i = 0; i < count; i++) {
        const uint64_t polygon = i + 1 < count ? 10 * info->paths + i : UINT64_MAX;
        s->points[info->points++] =
            (dp_path_point){.x = places[2 * i],
                            .y = places[2 * i + 1],
                            .distance = 2.5f,
                            .edge = line == DP_LINE_INTERSECTION ? UINT32_MAX : (uint32_t)i % 3,
                            .polygon = polygon,
                            .world = {(double)places[2 * i], 0.1, -1e-3}};
    }
    return p;
}

#define SCENE_PLACES(...)                                                                          \
    (const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / (2 * sizeof(float))

static inline void scene_lines(page_scene *s) {
    const dp_color black = DP_RGB(0, 0, 0), red = DP_RGB(200, 0, 0), blue = DP_RGB(0, 0, 200);
    dp_stored_path *p =
        scene_path(s, DP_LINE_RIDGE, 2, 0.5f, red, SCENE_PLACES(2, 4, 37, 6, 36.5f, 27));
    p->dash[1] = 2;
    p = scene_path(s, DP_LINE_VALLEY, 1, 0.5f, black, SCENE_PLACES(3, 20, 38, 8));
    p->dash[0] = 5.5f, p->dash[1] = 2;
    p = scene_path(s, DP_LINE_SILHOUETTE, 1, 1, 0x0000C880u,
                   SCENE_PLACES(6, 16, 20, 16, 20, 27, 6, 27));
    p->dash[0] = 3, p->dash[1] = 3, p->closed = true;
    scene_path(s, DP_LINE_VALLEY, 0, 0.5f, black, SCENE_PLACES(3, 26, 9, 24.125f, 15, 26));
    scene_path(s, DP_LINE_INTERSECTION, 0, 0.5f, blue, SCENE_PLACES(22, 12, 34, 13.3333f));
    scene_path(s, DP_LINE_RIDGE, 0, 0.5f, black, SCENE_PLACES(8, 14, 17.0004f, 14, 17, 14));
    scene_path(s, DP_LINE_BORDER, 0, 0.75f, DP_RGB(0, 96, 0), SCENE_PLACES(24, 18, 34, 18, 34, 25));
    p = scene_path(s, DP_LINE_SILHOUETTE, 0, 1, black, SCENE_PLACES(5, 12, 18, 3, 16.123f, 13));
    p->closed = true;
    scene_path(s, DP_LINE_SILHOUETTE, 0, 3, black, SCENE_PLACES(28, 5, 28, 5));
    p = scene_path(s, DP_LINE_SILHOUETTE, 0, 1, DP_RGB(255, 128, 0),
                   SCENE_PLACES(22, 8, 24, 6.5f, 26, 8, -3, 33));
    s->points[p->first].polygon = (UINT64_C(1) << 53) + 1;
}

/* A page that has all there is; `rich` false: a single picture, as the program writes it. */
static inline dp_page *scene_make(page_scene *s, bool rich) {
    static const dp_page_text texts[] = {
        {"Flansch \xC3\x98 35 (1:2) <&>", 5, 27, 3.5},
        {"\xC3\x84\xC3\xA7\xC3\xAE \xE2\x82\xAC \xFF!", 5, 34, 2.5}};
    static const dp_page_rule rules[] = {{2, 2, 58, 2, 0.7}, {2, 29, 58, 29, 0.1}};
    *s = (page_scene){0};
    s->drawing.memory = dp_allocator_resolve(NULL);
    s->drawing.paths = s->paths;
    s->drawing.points = s->points;
    s->drawing.info = (dp_drawing_info){.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .levels = 2};
    scene_lines(s);
    for (int y = 0; y < SCENE_HEIGHT; y++)
        for (int x = 0; x < SCENE_WIDTH; x++) {
            uint8_t *const pixel = s->ground + 4 * (y * SCENE_WIDTH + x);
            memcpy(pixel, scene_fields[y / 10][x / 10], 3);
            pixel[3] = x < 36 ? 255 : 102;
        }
    s->views[0] = (dp_view_on_page){.drawing = &s->drawing};
    s->page = (dp_page){.views = s->views, .view_count = 1};
    if (!rich) return &s->page;
    s->views[0] = (dp_view_on_page){.drawing = &s->drawing,
                                    .x = 4,
                                    .y = 5,
                                    .mm_per_px = 0.5,
                                    .name = "front",
                                    .ground = s->ground,
                                    .ground_png = scene_png,
                                    .ground_png_size = sizeof scene_png};
    s->views[1] = (dp_view_on_page){
        .drawing = &s->drawing, .x = 30, .y = 6, .mm_per_px = 0.25, .name = "\"side\" & back"};
    s->page = (dp_page){.width = 60,
                        .height = 37.5,
                        .paper = DP_RGB(255, 253, 245),
                        .views = s->views,
                        .view_count = 2,
                        .texts = texts,
                        .text_count = 2,
                        .rules = rules,
                        .rule_count = 2,
                        .least_width = 0.18,
                        .title = "Gr\xC3\xB6\xC3\x9F"
                                 "e (a\\b) <1> & \xFE"};
    return &s->page;
}

#endif
