/* Colours of vertices and faces: read from every format that has them; those of vertices are
 * interpolated over polygons of every kind, and only where they are asked for. */
#include "reading.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

static dp_source *open_text(const char *text, const char *name) {
    dp_source *source = NULL;
    dp_diag diag;
    const dp_memory_file file = {.data = text, .size = strlen(text), .name = name};
    if (dp_io_open_memory(&file, NULL, &source, &diag)) fail_msg("%s: %s", name, diag.message);
    return source;
}

/* ------- readers ------- */

static void assert_colors(const char *text, const char *name, const uint32_t *colors) {
    dp_batch batch;
    dp_source *const source = open_text(text, name);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_int_equal(batch.colors != NULL, colors != NULL);
    for (size_t v = 0; colors && v < 3; v++)
        if (batch.colors[v] != colors[v])
            fail_msg("%s: vertex %zu is %08x", name, v, batch.colors[v]);
    dp_source_destroy(source);
}

#define PLY_HEAD(type, red)                                                                        \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nproperty " type " " red "red\nproperty " type " " red                       \
    "green\nproperty " type " " red "blue\nelement face 1\n"                                       \
    "property list uchar int vertex_index\nend_header\n"

static void own_readers_know_them(void **state) {
    static const uint32_t rgb[3] = {0xFF0000FF, 0x00FF00FF, 0x0000FFFF};
    static const uint32_t half[3] = {0x804000FF, 0x000000FF, 0xFFFFFFFF};
    static const uint32_t second[3] = {0, 0xFF0000FF, 0};
    (void)state;
    assert_colors(PLY_HEAD("uchar", "") "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n",
                  "a.ply", rgb);
    assert_colors(PLY_HEAD("ushort", "diffuse_") "0 0 0 32896 16448 0\n1 0 0 0 0 0\n"
                                                 "0 1 0 65535 65535 65535\n3 0 1 2\n",
                  "a.ply", half);
    assert_colors(PLY_HEAD("float", "") "0 0 0 .5 .25 0\n1 0 0 0 0 0\n0 1 0 1 1 1\n3 0 1 2\n",
                  "a.ply", half);
    assert_colors(PLY_HEAD("float", "") "0 0 0 128 64 0\n1 0 0 0 0 0\n0 1 0 255 255 255\n3 0 1 2\n",
                  "a.ply", half);
    assert_colors("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 9\n3 0 1 2\n",
                  "a.off", rgb);
    assert_colors("CNOFF\n3 1 0\n0 0 0 0 0 1 .5 .25 0\n1 0 0 0 0 1 0 0 0 1\n0 1 0 0 0 1 1 1 1\n"
                  "3 0 1 2\n",
                  "a.off", half);
    assert_colors("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", "a.off", NULL);
    assert_colors("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1 # last\nf 1 2 3\n", "a.obj", rgb);
    assert_colors("v 0 0 0 1\nv 1 0 0 255 0 0\nv 0 1 0 # none\nf 1 2 3\n", "a.obj", second);
    assert_colors("v 0 0 0 1\nv 1 0 0 1 x\nv 0 1 0\nf 1 2 3\n", "a.obj", NULL);
}

/* Bytes: three positions, then three colours of four shares. */
#define GLTF                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"                   \
    "\"nodes\":[{\"mesh\":0}],\"materials\":[{\"pbrMetallicRoughness\":"                           \
    "{\"baseColorFactor\":[1,0.5,1,1],\"baseColorTexture\":{\"index\":0}}}],"                      \
    "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"absent.png\"}],"                         \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":1},"                 \
    "\"material\":0}]}],\"buffers\":[{\"byteLength\":48,\"uri\":\""                                \
    "data:application/octet-stream;base64,"                                                        \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA/wAA/wD/AP8AAP//\"}],"                        \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"                                           \
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":12}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","       \
    "\"min\":[0,0,0],\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5121,"                   \
    "\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}]}"

static void assimp_s_are_multiplied_by_the_material(void **state) {
    static const uint32_t colors[3] = {0xFF0000FF, 0x008000FF, 0x0000FFFF};
    (void)state;
    assert_colors(GLTF, "a.gltf", colors);
}

static void assert_remark(const char *text, const char *name, const char *remark) {
    dp_source *const source = open_text(text, name);
    if (remark)
        assert_contains(dp_source_color_remark(source), remark);
    else
        assert_null(dp_source_color_remark(source));
    assert_null(dp_source_remark(source));
    dp_source_destroy(source);
}

static void what_is_not_drawn_is_remarked(void **state) {
    (void)state;
    static const char ply[] = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\n"
                              "property float x\nproperty float y\nproperty float z\nelement face "
                              "1\nproperty list uchar int vertex_index\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_remark(GLTF, "a.gltf", "textures are not drawn");
    assert_remark(ply, "a.ply", "textures are not drawn");
    assert_remark("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # red\n", "a.off", NULL);
}

/* ------- faces ------- */

static void assert_face_colors(const char *text, const char *name, const uint32_t wanted[4]) {
    dp_batch batch;
    dp_source *const source = open_text(text, name);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_int_equal(batch.polygon_count, 4);
    for (size_t i = 0; i < 4; i++) {
        const uint32_t group = batch.groups ? batch.groups[i] : 0;
        if (dp_source_group_color(source, group) != wanted[i])
            fail_msg("%s: face %zu is %08x", name, i, dp_source_group_color(source, group));
    }
    assert_null(dp_source_color_remark(source));
    dp_source_destroy(source);
}

static void faces_have_colours_as_groups(void **state) {
    static const uint32_t rgb[4] = {0xFF0000FF, 0xFF0000FF, 0x00FF00FF, 0x0000FFFF};
    static const uint32_t some[4] = {0, 0, 0xFF0000FF, 0};
    static const uint32_t one[4] = {0xFF8000FF, 0xFF8000FF, 0xFF8000FF, 0xFF8000FF};
    (void)state;
    assert_face_colors("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 1 2 255 0 0 255\n"
                       "3 0 1 2 0 255 0 # green\n3 0 1 2 0 0 255\n",
                       "a.off", rgb);
    assert_face_colors("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 .5 0\n3 0 1 2 1.0 0.5 0\n"
                       "3 0 1 2 1 .5 0\n3 0 1 2 1 .5 0\n",
                       "a.off", one);
    assert_face_colors("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2 7\n3 0 1 2 1 0 0\n"
                       "3 0 1 2 x\n",
                       "a.off", some);
    assert_face_colors("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 4\nproperty uchar red\n"
                       "property list uchar int vertex_index\nproperty uchar green\n"
                       "property uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n255 3 0 1 2 0 0\n"
                       "255 3 0 1 2 0 0\n0 3 0 1 2 255 0\n0 3 0 1 2 0 255\n",
                       "a.ply", rgb);
}

/* More colours than groups: those that come last are rounded. */
static void too_many_colours_of_faces_are_rounded(void **state) {
    enum { FACES = 65536 };
    char *const text = malloc(40 * FACES + 100), *at = text;
    (void)state;
    assert_non_null(text);
    at += sprintf(at, "OFF\n3 %d 0\n0 0 0\n1 0 0\n0 1 0\n", FACES);
    for (int i = 0; i < FACES; i++) at += sprintf(at, "3 0 1 2 255 %d %d\n", i >> 8 & 255, i & 255);
    dp_source *const source = open_text(text, "a.off");
    dp_batch batch;
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    for (int i = 0; i < FACES; i++) {
        const uint32_t color = dp_source_group_color(source, batch.groups[i]);
        for (int shift = 0; shift < 16; shift += 8) {
            const int off = (int)(color >> (8 + shift) & 255) - (i >> shift & 255);
            if (abs(off) > (i < 60000 ? 0 : 15)) fail_msg("face %d is %08x", i, color);
        }
    }
    dp_source_destroy(source);
    free(text);
}

/* ------- drawing ------- */

enum { SIZE = 64 };
static uint8_t rgba[SIZE][SIZE][4];

static void draw(dp_source *source, dp_style style) {
    dp_context *context = NULL;
    dp_camera camera;
    dp_camera_look_at(&camera, (const double[]){0, 0, 5}, (const double[]){0, 0, 0},
                      (const double[]){0, 1, 0});
    dp_camera_orthographic(&camera, 2, 1, 1, 30);
    const dp_target target = {.rgba = (uint8_t *)rgba, .width = SIZE, .height = SIZE};
    dp_diag diag = {0};
    style.lines = DP_NO_LINES;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    if (dp_draw(context, source, &camera, &style, &target, &diag)) fail_msg("%s", diag.message);
    dp_context_destroy(context);
}

static void assert_pixel(int x, int y, const uint8_t wanted[3]) {
    for (int c = 0; c < 3; c++)
        if (abs(rgba[y][x][c] - wanted[c]) > 3)
            fail_msg("pixel %d, %d: %d %d %d", x, y, rgba[y][x][0], rgba[y][x][1], rgba[y][x][2]);
}

/* Two triangles, or one quadrilateral, that fill the picture: black on the left, (0.5, 1, 0) on the
 * right. bend: how far a corner is off the plane. */
#define SQUARE(bend) "v -1 -1 0 0 0 0\nv 1 -1 0 .5 1 0\nv 1 1 " bend " .5 1 0\nv -1 1 0 0 0 0\n"

static void assert_gradient(const char *text, dp_style style) {
    dp_source *const source = open_text(text, "a.obj");
    static const uint8_t left[3] = {32, 64, 0}, right[3] = {96, 191, 0};
    style.shade.model_colors = true;
    draw(source, style);
    for (int y = 8; y < SIZE; y += 16) {
        assert_pixel(SIZE / 4, y, left);
        assert_pixel(3 * SIZE / 4, y, right);
    }
    dp_source_destroy(source);
}

static void are_interpolated(void **state) {
    (void)state;
    assert_gradient(SQUARE("0") "f 1 2 3\nf 1 3 4\n", (dp_style){0});
    assert_gradient(SQUARE("0") "f 1 2 3 4\n", (dp_style){0});
    assert_gradient(SQUARE("1") "f 1 2 3 4\n", (dp_style){0}); /* to be split */
    assert_gradient(SQUARE("0") "f 1 2 3\nf 1 3 4\n",
                    (dp_style){.shade = {.normals = DP_NORMALS_FACET}});
    assert_gradient("v 0 0 9 1 1 1\n" SQUARE("6") "f 2 3 5\nf 3 4 5\n",
                    (dp_style){0}); /* clipped */
}

static void only_where_asked_for(void **state) {
    static const uint8_t plain[3] = {16, 32, 48}, middle[3] = {64, 128, 0},
                         white[3] = {255, 255, 255};
    (void)state;
    dp_style style = {.surface = DP_RGB(16, 32, 48)};
    dp_source *source = open_text(SQUARE("0") "f 1 2 3 4\n", "a.obj");
    draw(source, style);
    assert_pixel(SIZE / 2, SIZE / 2, plain);
    style.shade.shading = DP_SHADING_PAPER;
    style.shade.model_colors = true;
    draw(source, style);
    assert_pixel(SIZE / 2, SIZE / 2, white);
    style.shade.shading = DP_SHADING_FLAT;
    draw(source, style);
    assert_pixel(SIZE / 2, SIZE / 2, middle);
    dp_source_destroy(source);
    source =
        open_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 9 9 9 1 0 0\nf 1 2 3 4\n", "a.obj");
    draw(source, style); /* the vertices without a colour have their group's, here none */
    assert_pixel(SIZE / 2, SIZE / 2, plain);
    dp_source_destroy(source);
}

/* The image of a square that reaches from behind the mirror, which cuts it, to behind the eye, so
 * that at the top only the image is seen. */
static void are_seen_in_mirrors(void **state) {
    static const uint8_t left[3] = {32, 64, 0}, right[3] = {96, 191, 0};
    (void)state;
    dp_source *const source = open_text("v -1 -1 -5 0 0 0\nv 1 -1 -5 .5 1 0\nv 1 1 9 .5 1 0\n"
                                        "v -1 1 9 0 0 0\nf 1 2 3 4\n",
                                        "a.obj");
    draw(source,
         (dp_style){.shade = {.model_colors = true}, .mirror = {.normal = {0, 0, 1}, .size = 8}});
    for (int y = 2; y < 14; y++) {
        assert_pixel(SIZE / 4, y, left);
        assert_pixel(3 * SIZE / 4, y, right);
    }
    dp_source_destroy(source);
}

/* ------- several batches ------- */

typedef struct batches {
    dp_batch batch[3];
    size_t next;
} batches;

static dp_result next_batch(void *user, dp_batch *batch, dp_diag *diag) {
    batches *const self = user;
    (void)diag;
    if (self->next < 3) *batch = self->batch[self->next++];
    return DP_OK;
}

static dp_result first_batch(void *user, dp_diag *diag) {
    (void)diag;
    ((batches *)user)->next = 0;
    return DP_OK;
}

/* Three stripes, of which the middle one has a colour. */
static void batches_may_have_none(void **state) {
    static const float stripe[3][4][3] = {{{-1, -1, 0}, {-.4f, -1, 0}, {-.4f, 1, 0}, {-1, 1, 0}},
                                          {{-.4f, -1, 0}, {.4f, -1, 0}, {.4f, 1, 0}, {-.4f, 1, 0}},
                                          {{.4f, -1, 0}, {1, -1, 0}, {1, 1, 0}, {.4f, 1, 0}}};
    static const uint32_t firsts[2] = {0, 4},
                          colors[4] = {0xFF0000FF, 0xFF0000FF, 0xFF0000FF, 0xFF0000FF};
    static const uint8_t red[3] = {255, 0, 0}, plain[3] = {16, 32, 48};
    batches b = {.next = 0};
    dp_source *source = NULL;
    (void)state;
    for (size_t i = 0; i < 3; i++)
        b.batch[i] = (dp_batch){.positions = stripe[i][0],
                                .vertex_count = 4,
                                .corner_count = 4,
                                .firsts = firsts,
                                .polygon_count = 1,
                                .colors = i == 1 ? colors : NULL};
    const dp_source_callbacks callbacks = {.user = &b, .next = next_batch, .rewind = first_batch};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    draw(source, (dp_style){.surface = DP_RGB(16, 32, 48), .shade = {.model_colors = true}});
    assert_pixel(SIZE / 8, SIZE / 2, plain);
    assert_pixel(SIZE / 2, SIZE / 2, red);
    assert_pixel(7 * SIZE / 8, SIZE / 2, plain);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_readers_know_them),
        cmocka_unit_test(assimp_s_are_multiplied_by_the_material),
        cmocka_unit_test(what_is_not_drawn_is_remarked),
        cmocka_unit_test(faces_have_colours_as_groups),
        cmocka_unit_test(too_many_colours_of_faces_are_rounded),
        cmocka_unit_test(are_interpolated),
        cmocka_unit_test(only_where_asked_for),
        cmocka_unit_test(are_seen_in_mirrors),
        cmocka_unit_test(batches_may_have_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
