/* Fuzzes sources made of sources, and what lies over lines and surfaces: polygons from bytes, deformed,
 * cut by planes, moved group by group, and drawn at two times as an x-ray or with a pattern.
 *
 * Layout of the input: 8 bytes of style, 24 of wrappers, then triangles, 9 bytes each: their corners on a
 * small grid, or special values. Asserted is that a source has as many polygons in each reading, and
 * that what fails says why. */
#include <drypoint/drypoint.h>

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 400 /* triangles */, WIDTH = 75, HEIGHT = 66, GROUPS = 3, STYLE = 8, WRAPPERS = 24 };

static float coordinate(uint8_t b) {
    static const float special[] = {-0.0f, NAN,   INFINITY, 3e38f,       1e-40f,     1e20f,
                                    -1e6f, 1e-7f, 0.5f,     0.33333334f, 2.0000002f, 1e4f};
    return b >= 244 ? special[b - 244] : (float)(b % 9) - 4;
}

static dp_style style_of(const uint8_t *b, const dp_texture *texture) {
    return (dp_style){
        .xray = b[0] & 1 ? (float)(1 + b[1]) / 256 : 0,
        .xray_layers = b[0] >> 1 & 3,
        .pattern = {.texture = b[0] & 8 ? texture : NULL},
        .line_light = {.lighting = b[0] & 16 ? DP_LINE_LIGHT_TOON : DP_LINE_LIGHT_OFF},
        .ink = (b[0] & 32) && !(b[0] & 1) ? DP_INK_QUADS : DP_INK_STROKES,
        .hidden = {.look = b[0] & 64 && !(b[0] & 32) ? DP_HIDDEN_DASHED : DP_HIDDEN_NONE},
        .shade = {.shading = (dp_shading)(b[2] % DP_SHADING_COUNT)},
        .section = b[3] & 1 ? DP_RGB(200, 100, 50) : 0,
        .detail = b[3] & 2 ? 1 : 0};
}

/* Puts a new source in the place of *source if it could be made of it. */
static void wrap(dp_source **source, dp_result result, dp_source *out, const dp_diag *diag) {
    if (!out != !!result || (result && !diag->message[0])) abort();
    if (!result) *source = out;
}

static void deform(const uint8_t *b, dp_source **source) {
    const dp_deform desc = {.kind = (dp_deform_kind)(b[0] % 3),
                            .amplitude = (double)b[1] / 64,
                            .axis = {b[2] & 1, b[2] >> 1 & 1, b[2] >> 2 & 1}};
    dp_source *out = NULL;
    dp_diag diag = {0};
    const dp_result result = dp_source_deform(*source, &desc, NULL, &out, &diag);
    wrap(source, result, out, &diag);
}

static void clip(const uint8_t *b, dp_source **source) {
    dp_clip desc = {.plane_count = 1 + (b[0] & 1),
                    .look = (dp_section_look)(b[0] >> 1 & 3),
                    .hatch_spacing = (double)b[1] / 32};
    for (int k = 0; k < 2; k++)
        desc.planes[k] =
            (dp_clip_plane){.normal = {coordinate(b[2 + 4 * k]), coordinate(b[3 + 4 * k]),
                                       coordinate(b[4 + 4 * k])},
                            .offset = coordinate(b[5 + 4 * k])};
    dp_source *out = NULL;
    dp_diag diag = {0};
    const dp_result result = dp_source_clip(*source, &desc, NULL, &out, &diag);
    wrap(source, result, out, &diag);
}

static void arrange(const uint8_t *b, dp_source **source) {
    dp_placement places[GROUPS];
    for (int g = 0; g < GROUPS; g++)
        places[g] = (dp_placement){.hidden = b[0] >> g & 1, .offset = {coordinate(b[1 + g]), 0, 1}};
    dp_source *out = NULL;
    dp_diag diag = {0};
    const dp_result result = dp_source_arrange(*source, places, GROUPS, NULL, &out, &diag);
    wrap(source, result, out, &diag);
}

/* Polygons of one reading; UINT64_MAX: it fails. */
static uint64_t count(dp_source *source) {
    uint64_t sum = 0;
    dp_diag diag = {0};
    dp_batch batch = {.polygon_count = 1};
    if (dp_source_rewind(source, &diag)) abort();
    for (;;) {
        const dp_result result = dp_source_next(source, &batch, &diag);
        if (result && !diag.message[0]) abort();
        if (result) return UINT64_MAX;
        if (!batch.polygon_count) return sum;
        sum += batch.polygon_count;
    }
}

static void draw(dp_context *context, dp_source *source, const dp_style *style) {
    static uint8_t rgba[WIDTH * HEIGHT * 4];
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .samples = 4, .rgba = rgba};
    dp_camera camera;
    dp_diag diag = {0};
    if (dp_camera_look_at(&camera, (const double[]){5, 7, 12}, (const double[]){0, 0, 0},
                          (const double[]){0, 1, 0}) ||
        dp_camera_perspective(&camera, 40, (double)WIDTH / HEIGHT, 0.5, 1000))
        abort();
    if (dp_draw(context, source, &camera, style, &target, &diag) && !diag.message[0]) abort();
}

static void try_source(dp_source *source, const dp_style *style) {
    dp_context *context = NULL;
    const dp_context_desc two = {.threads = 2};
    if (dp_context_create(&two, &context, NULL)) return;
    for (int k = 0; k < 2; k++) {
        if (dp_source_set_time(source, 0.7 * k, NULL)) continue;
        const uint64_t once = count(source);
        draw(context, source, style);
        if (count(source) != once) abort();
    }
    dp_context_destroy(context);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static float positions[3 * MOST][3];
    static uint16_t groups[MOST];
    static const uint8_t ink[4] = {255, 0, 128, 255};
    if (size < STYLE + WRAPPERS + 9) return 0;
    const uint8_t *const corners = data + STYLE + WRAPPERS, *const w = data + STYLE;
    const size_t left = (size - STYLE - WRAPPERS) / 9, n = left < MOST ? left : MOST;
    for (size_t i = 0; i < 9 * n; i++) positions[i / 3][i % 3] = coordinate(corners[i]);
    for (size_t i = 0; i < n; i++) groups[i] = (uint16_t)(i * GROUPS / n);
    const dp_batch batch = {.positions = positions[0],
                            .vertex_count = 3 * n,
                            .corner_count = 3 * n,
                            .polygon_count = n,
                            .groups = groups};
    dp_source *source = NULL;
    dp_texture *texture = NULL;
    if (dp_source_from_arrays(&batch, NULL, &source, NULL)) return 0;
    if (dp_texture_create(&(dp_texture_desc){.pixels = ink, .width = 2, .height = 2, .channels = 1},
                          &texture, NULL))
        abort();
    for (int k = 0; k < 3; k++) switch (w[k] % 4) {
        case 0:
            deform(w + 3, &source);
            break;
        case 1:
            clip(w + 6, &source);
            break;
        case 2:
            arrange(w + 16, &source);
            break;
        default:
            break;
        }
    const dp_style style = style_of(data, texture);
    try_source(source, &style);
    dp_source_destroy(source);
    dp_texture_destroy(texture);
    return 0;
}
