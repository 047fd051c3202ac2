/* Fuzzes the drawing: polygons, camera and style from bytes, corners from special values as well.
 *
 * Layout of the input: 8 bytes of style, 8 of camera, then polygons as bytes (corner count, then x,
 * y, z per corner, a byte each); or, by a bit of the style, their corners are vertices and all
 * bytes once more the vertex numbers of triangles. Bytes map to a small grid, so that edges meet,
 * overlap and touch, and some to values that arithmetic stumbles over. Nothing is asserted but that
 * it ends without a fault. */
#include <drypoint/drypoint.h>

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_CORNERS = 4096, WIDTH = 75, HEIGHT = 66 }; /* two tiles by two */

static float coordinate(uint8_t b) {
    static const float special[] = {0,          -0.0f, NAN,   INFINITY, 3e38f, -3e38f,
                                    1e-40f,     1e20f, -1e6f, 1e-7f,    0.5f,  0.33333334f,
                                    2.0000002f, 1e4f,  -1e4f, 1};
    return b >= 240 ? special[b - 240] : (float)(b % 17) - 8 + (b > 200 ? 0.25f : 0);
}

static dp_style style_of(const uint8_t *b) {
    static const float details[] = {0, 0.01f, 0.3f, 1, 3, 100};
    dp_style s = {.lines = b[0] & DP_ALL_LINES ? b[0] & DP_ALL_LINES : DP_ALL_LINES,
                  .ridge_angle = 1 + (float)b[1] * 1.4f,
                  .valley_angle = 1 + (float)b[2] * 1.4f,
                  .method = b[3] & 1 ? DP_METHOD_PAPER : DP_METHOD_EXACT,
                  .between = (dp_between)(b[3] >> 1 & 3) % 3,
                  .ink = b[3] & 8 ? DP_INK_QUADS : DP_INK_STROKES,
                  .surface = b[3] & 16 ? DP_COLOR_NONE : 0,
                  .cull_back_faces = b[3] & 32,
                  .edge_table_off = b[3] & 64,
                  .detail = details[b[6] % 6],
                  .hidden = {.look = b[7] & 1 ? DP_HIDDEN_DASHED : DP_HIDDEN_NONE, .levels = 2},
                  .exact_ends = b[7] & 2,
                  .stroke = {.taper = b[7] & 4 ? 3 : 0}};
    for (int i = 0; i < DP_LINE_COUNT; i++) s.line[i].width = 0.5f + (float)(b[4] % 64);
    return s;
}

static bool camera_of(const uint8_t *b, dp_camera *camera) {
    const double eye[3] = {coordinate(b[0]), coordinate(b[1]), coordinate(b[2])};
    const double target[3] = {coordinate(b[3]), coordinate(b[4]), coordinate(b[5])};
    memset(camera, 0, sizeof *camera);
    if (dp_camera_look_at(camera, eye, target, (const double[3]){0, 1, 0})) return false;
    const double scale = 1 + (double)b[6];
    return !(b[7] & 1
                 ? dp_camera_orthographic(camera, scale / 8, 1.6, -100, 100)
                 : dp_camera_perspective(camera, 1 + scale / 2, 1.6, b[7] & 2 ? 1e-3 : 0.5, 1000));
}

/* Polygons until the bytes end. */
static size_t polygons_of(const uint8_t *data, size_t size, float (*positions)[3],
                          uint32_t *firsts) {
    size_t count = 0, corners = 0;
    firsts[0] = 0;
    for (size_t at = 0; at < size;) {
        const size_t n = data[at++] % 9;
        if (at + 3 * n > size || corners + n > MAX_CORNERS) break;
        for (size_t i = 0; i < n; i++, corners++)
            for (int k = 0; k < 3; k++) positions[corners][k] = coordinate(data[at++]);
        firsts[++count] = (uint32_t)corners;
    }
    return count;
}

/* Triangles over the vertices there are; some numbers are out of range. */
static dp_batch triangles_of(const uint8_t *data, size_t size, const float *positions,
                             uint32_t vertices, uint32_t *indices) {
    const size_t count = size / 3;
    for (size_t i = 0; i < 3 * count; i++)
        indices[i] = data[i] == 255 ? UINT32_MAX : data[i] % (vertices + 1);
    return (dp_batch){.positions = positions,
                      .vertex_count = vertices,
                      .indices = indices,
                      .corner_count = 3 * count,
                      .polygon_count = count};
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static float positions[MAX_CORNERS][3];
    static uint32_t firsts[MAX_CORNERS * 3 + 2], indices[MAX_CORNERS * 3 + 2];
    static uint8_t rgba[WIDTH * HEIGHT * 4], classes[WIDTH * HEIGHT];
    static float depth[WIDTH * HEIGHT], normal[WIDTH * HEIGHT * 3];
    dp_camera camera;
    if (size < 16 || size > sizeof firsts / sizeof *firsts || !camera_of(data + 8, &camera))
        return 0;
    const dp_style style = style_of(data);
    const size_t count = polygons_of(data + 16, size - 16, positions, firsts);
    const dp_batch polygons = {.positions = positions[0],
                               .vertex_count = firsts[count],
                               .corner_count = firsts[count],
                               .firsts = firsts,
                               .polygon_count = count};
    const dp_batch triangles =
        triangles_of(data + 16, size - 16, positions[0], firsts[count], indices);
    const dp_batch batch = data[3] & 128 ? triangles : polygons;
    static const uint32_t samples[] = {1, 4, 8, 16};
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .samples = samples[data[5] & 3],
                              .rgba = rgba,
                              .depth = depth,
                              .line_class = classes,
                              .normal = normal};
    const dp_context_desc one_thread = {.threads = 1};
    dp_context *context = NULL;
    dp_source *source = NULL;
    if (!dp_context_create(&one_thread, &context, NULL) &&
        !dp_source_from_arrays(&batch, NULL, &source, NULL))
        (void)dp_draw(context, source, &camera, &style, &target, NULL);
    dp_source_destroy(source);
    dp_context_destroy(context);
    return 0;
}
