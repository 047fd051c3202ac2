/* Hashes of drawings: what two builds of the library must print alike.
 *
 *     pictures [--threads N] [FILE...]
 *
 * Draws every look below of every model, generated ones unless files are named, and prints a line
 * for each: model, look, hash of the pixels, of the segments (dp_trace) and of the pages in all
 * formats. A drawing that is refused prints its message instead: that, too, must be the same.
 *
 * Not handled: speed; what differs in floats that no pixel, segment or page shows. */
#include <drypoint/drypoint.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240 };

#define TAN  DP_RGB(224, 196, 150)
#define BLUE DP_RGB(40, 60, 160)

typedef struct picture_look {
    const char *name;
    dp_style style;
    const char *texture; /* of strokes, with its own way to draw them; NULL: none */
    const char *pattern; /* on lines; NULL: none */
    dp_stroke_u u;       /* of the texture */
    bool cut;            /* by two planes through the middle of the model */
} picture_look;

static const picture_look looks[] = {
    {.name = "plain"},
    {.name = "gooch",
     .style = {.surface = TAN,
               .shade = {.shading = DP_SHADING_GOOCH, .highlight = 0.5f},
               .edge_map = {.detector = DP_EDGE_MAP_C1}}},
    {.name = "charcoal", .texture = "charcoal"},
    {.name = "pencil-shading",
     .style = {.shade = {.shading = DP_SHADING_PENCIL}},
     .texture = "pencil"},
    {.name = "quads", .style = {.ink = DP_INK_QUADS, .line[DP_LINE_VALLEY] = {3, BLUE}}},
    {.name = "quads-paper",
     .style = {.ink = DP_INK_QUADS,
               .method = DP_METHOD_PAPER,
               .between = DP_BETWEEN_INTERVAL,
               .shade = {.shading = DP_SHADING_LAMBERT}}},
    {.name = "hatch", .style = {.shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
    {.name = "adjacency-polar",
     .style = {.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS, .line[0].width = 6},
     .texture = "brush",
     .u = DP_STROKE_POLAR},
    {.name = "strokes-polar",
     .style = {.edges = DP_EDGES_ADJACENCY, .line[0].width = 5},
     .texture = "ink",
     .u = DP_STROKE_POLAR},
    {.name = "toon",
     .style = {.surface = TAN,
               .shade = {.shading = DP_SHADING_TOON},
               .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                            .as_printed = true,
                            .eight_bits = true},
               .mirror = {.normal = {0.1, 1, 0}, .offset = -1.1, .size = 4, .tint_share = 0.3f}}},
    {.name = "hidden",
     .style = {.exact_ends = true,
               .hidden = {.look = DP_HIDDEN_DASHED, .levels = 3, .smooth = true}}},
    {.name = "xray",
     .style = {.xray = 0.4f, .surface = BLUE, .shade = {.shading = DP_SHADING_HALFTONE}}},
    {.name = "smooth", .style = {.smooth = DP_SMOOTH_SURFACE, .detail = 1}},
    {.name = "section", .style = {.section = TAN}, .cut = true},
    {.name = "pattern",
     .style = {.line_light = {.lighting = DP_LINE_LIGHT_GOOCH}, .line[0].width = 6},
     .pattern = "rope"},
};

static const dp_shape shapes[] = {
    {.name = "bolt"},  {.name = "bracket"}, {.name = "stairs"},
    {.name = "torus"}, {.name = "boxes"},   {.name = "terrain", .triangles = 3000, .seed = 5},
};

/* ------- hashes: FNV-1a ------- */

static const uint64_t EMPTY = 0xcbf29ce484222325u;

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size) {
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static dp_result hash_text(void *user, const char *text, size_t size, dp_diag *diag) {
    (void)diag;
    *(uint64_t *)user = hash_bytes(*(uint64_t *)user, text, size);
    return DP_OK;
}

static dp_result hash_pages(dp_context *context, uint64_t *hash, dp_diag *diag) {
    dp_drawing *drawing = NULL;
    dp_result result =
        dp_drawing_create(context, &(dp_drawing_desc){.optimize = true}, &drawing, diag);
    const dp_view_on_page view = {.drawing = drawing, .name = "front"};
    const dp_page page = {.views = &view, .view_count = 1, .title = "pictures"};
    for (int format = 0; !result && format < DP_FORMAT_COUNT; format++) {
        void *bytes = NULL;
        size_t size = 0;
        result = dp_page_write_memory(&page, (dp_format)format, &bytes, &size, diag);
        *hash = hash_bytes(*hash, bytes, size);
        dp_bytes_free(bytes);
    }
    dp_drawing_destroy(drawing);
    return result;
}

/* ------- drawings ------- */

/* Takes away what is on the eye's right and above, beyond the middle of the model. */
static dp_result cut(dp_source **source, dp_diag *diag) {
    dp_extent extent;
    dp_source *rest = NULL;
    dp_result result = dp_source_extent(*source, &extent, diag);
    if (result) return result;
    double middle[3];
    for (int k = 0; k < 3; k++) middle[k] = ((double)extent.min[k] + (double)extent.max[k]) / 2;
    const dp_clip clip = {.planes = {{{1, 0, 0}, middle[0]}, {{0, 1, 0.3}, middle[1] + 0.25}},
                          .plane_count = 2};
    result = dp_source_clip(*source, &clip, NULL, &rest, diag);
    if (!result) *source = rest;
    return result;
}

static dp_result open_model(const char *file, uint32_t number, dp_source **out, dp_diag *diag) {
    return file ? dp_source_open(file, NULL, out, diag)
                : dp_source_from_shape(&shapes[number], out, diag);
}

static dp_result complete(const picture_look *look, dp_style *style, dp_texture **texture,
                          dp_diag *diag) {
    const char *const name = look->texture ? look->texture : look->pattern;
    *style = look->style;
    dp_result result = name ? dp_texture_named(name, 3, NULL, texture, diag) : DP_OK;
    if (!result && look->texture) result = dp_stroke_look(look->texture, &style->stroke, diag);
    if (look->texture) style->stroke.texture = *texture, style->stroke.u = look->u;
    if (look->pattern) style->pattern.texture = *texture;
    return result;
}

/* Draws, and prints the rest of the line. */
static dp_result draw(dp_context *context, dp_source *source, const dp_style *style,
                      dp_diag *diag) {
    static uint8_t rgba[HEIGHT][WIDTH][4];
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba[0][0]};
    uint64_t trace = EMPTY, pages = EMPTY;
    dp_camera camera;
    dp_result result = dp_camera_fit_source(&camera, NULL, source, NULL, diag);
    if (!result) result = dp_draw(context, source, &camera, style, &target, diag);
    const bool segments = style->ink == DP_INK_STROKES || style->edges == DP_EDGES_ADJACENCY;
    if (!result && segments) result = dp_trace(context, hash_text, &trace, diag);
    if (!result && segments) result = hash_pages(context, &pages, diag);
    if (!result)
        printf("%016" PRIx64 " %016" PRIx64 " %016" PRIx64 "\n",
               hash_bytes(EMPTY, rgba, sizeof rgba), trace, pages);
    return result;
}

/* One line. */
static void print_look(dp_context *context, const char *file, uint32_t number,
                       const picture_look *look) {
    const char *const slash = file ? strrchr(file, '/') : NULL;
    dp_diag diag = {0};
    dp_source *source = NULL;
    dp_texture *texture = NULL;
    dp_style style;
    printf("%s %s ", slash ? slash + 1 : file ? file : shapes[number].name, look->name);
    dp_result result = open_model(file, number, &source, &diag);
    if (!result && look->cut) result = cut(&source, &diag);
    if (!result) result = complete(look, &style, &texture, &diag);
    if (!result) result = draw(context, source, &style, &diag);
    if (result) printf("%s\n", diag.message);
    dp_source_destroy(source);
    dp_texture_destroy(texture);
}

int main(int argc, char **argv) {
    dp_context_desc desc = {.threads = 1};
    dp_context *context = NULL;
    dp_diag diag;
    const bool threads = argc > 2 && !strcmp(argv[1], "--threads");
    const int at = threads ? 3 : 1;
    if (threads) desc.threads = (uint32_t)strtoul(argv[2], NULL, 10);
    if (dp_context_create(&desc, &context, &diag))
        return fprintf(stderr, "pictures: %s\n", diag.message), 1;
    const uint32_t models = argc > at ? (uint32_t)(argc - at) : sizeof shapes / sizeof *shapes;
    for (uint32_t m = 0; m < models; m++)
        for (size_t l = 0; l < sizeof looks / sizeof *looks; l++)
            print_look(context, argc > at ? argv[at + (int)m] : NULL, m, &looks[l]);
    dp_context_destroy(context);
    return 0;
}
