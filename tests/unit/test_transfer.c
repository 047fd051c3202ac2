/* The program's way of moving models from one process to another (tools/transfer.c): they arrive as they
 * were sent, and whatever arrives instead does no harm. */
#include "reading.h"

#include "pipe.h"
#include "progress.h"
#include "transfer.h"

#include <drypoint/scene.h>

#include <math.h>

int progress_report(void *user, double fraction) {
    (void)user, (void)fraction;
    return 0;
}

/* ---- what is sent ---- */

static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const uint32_t colors[4] = {0xFF0000FF, 0, 0, 0x00FF00FF};
static const uint32_t indices[7] = {0, 1, 2, 0, 1, 2, 3}, firsts[3] = {0, 3, 7};
static const uint16_t groups[2] = {0, 2};

static dp_batch make_batch(void) {
    return (dp_batch){
        .positions = &corners[0][0],
        .vertex_count = 4,
        .indices = indices,
        .corner_count = 7,
        .firsts = firsts,
        .polygon_count = 2,
        .normals = {.values = &corners[0][0], .count = 4},
        .texcoords = {.values = &corners[0][0], .count = 2, .stride = 12, .indices = indices},
        .colors = colors};
}

static dp_source *plain_source(void) {
    dp_source *source = NULL;
    dp_batch batch = make_batch();
    batch.groups = groups;
    batch.texcoords = (dp_attribute){0};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

/* A little of everything. */
static dp_source *scene_source(void) {
    static const double matrix[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
    const dp_scene_node nodes[2] = {{.name = "arm", .matrix = matrix}, {.parent = 1}};
    const dp_scene_morph morphs[2] = {{&corners[0][0], NULL}, {NULL, &corners[0][0]}};
    static const uint16_t joints[4] = {0, 1, 0, 1};
    static const float weights[4] = {1, 1, 0.5f, 1}, rest[2] = {0.25f, 0};
    const dp_scene_mesh meshes[2] = {{.name = "sheet",
                                      .batch = make_batch(),
                                      .color = 0x123456FF,
                                      .morphs = morphs,
                                      .morph_count = 2,
                                      .joints = joints,
                                      .weights = weights,
                                      .influences = 1},
                                     {.batch = make_batch()}};
    static const uint32_t bones[2] = {1, 2};
    static const double binds[24] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
                                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const dp_scene_skin skins[1] = {{bones, binds, 2}};
    const dp_scene_instance instances[3] = {
        {.node = 1, .mesh = 1, .skin = 1, .weights = rest, .weight_count = 2},
        {.node = 2, .mesh = 2},
        {.mesh = 2}};
    static const double times[2] = {0, 1};
    static const float turn[8] = {0, 0, 0, 1, 0, 0, 1, 0}, grow[4] = {0, 0, 1, 1};
    static const float slide[18] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 2, 0, 0, 0};
    const dp_scene_channel channels[3] = {
        {.node = 1, .path = DP_SCENE_ROTATION, .times = times, .values = turn, .key_count = 2},
        {.node = 1,
         .path = DP_SCENE_WEIGHTS,
         .times = times,
         .values = grow,
         .key_count = 2,
         .width = 2},
        {.node = 2,
         .path = DP_SCENE_TRANSLATION,
         .interpolation = DP_INTERPOLATION_CUBIC,
         .times = times,
         .values = slide,
         .key_count = 2}};
    const dp_scene_clip clips[2] = {{"wave", channels, 3, 0}, {NULL, NULL, 0, 3}};
    const dp_scene_desc desc = {nodes,
                                meshes,
                                instances,
                                skins,
                                clips,
                                2,
                                2,
                                3,
                                1,
                                2,
                                {0, 0, 2},
                                "a remark",
                                "a remark on colours"};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_from_scene(&desc, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

/* ---- there and back, through a file ---- */

static int open_file(void) {
    char path[300];
    temporary_name(path, sizeof path, "transfer");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    unlink(path);
    return file;
}

static size_t send_source(dp_source *source, uint8_t **data) {
    const int file = open_file();
    dp_diag diag = {0};
    assert_true(transfer_send(file, source, &diag));
    const off_t size = lseek(file, 0, SEEK_END);
    *data = malloc((size_t)size);
    assert_non_null(*data);
    assert_int_equal(pread(file, *data, (size_t)size, 0), size);
    close(file);
    return (size_t)size;
}

static transfer_end receive(int file, const uint8_t *data, size_t size, dp_source **source,
                            dp_diag *diag) {
    *source = NULL;
    assert_int_equal(ftruncate(file, 0), 0);
    assert_int_equal(pwrite(file, data, size, 0), size);
    assert_int_equal(lseek(file, 0, SEEK_SET), 0);
    return transfer_receive(file, pipe_clock() + 60, source, diag);
}

static const char *trace_copy(dp_source *source, double time) {
    static char text[20000];
    assert_int_equal(dp_source_set_time(source, time, NULL), DP_OK);
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    trace(source, text, sizeof text);
    return text;
}

static dp_source *there_and_back(dp_source *source) {
    uint8_t *data;
    dp_source *copy;
    dp_diag diag = {0};
    const int file = open_file();
    const size_t size = send_source(source, &data);
    assert_int_equal(receive(file, data, size, &copy, &diag), TRANSFER_DONE);
    assert_int_equal(diag.result, DP_OK);
    assert_non_null(copy);
    close(file);
    free(data);
    return copy;
}

static void scenes_arrive_as_they_were_sent(void **state) {
    (void)state;
    dp_source *const source = scene_source(), *const copy = there_and_back(source);
    const dp_scene_desc *const a = dp_scene_of(source), *const b = dp_scene_of(copy);
    assert_non_null(b);
    assert_string_equal(dp_source_remark(copy), "a remark");
    assert_string_equal(dp_source_color_remark(copy), "a remark on colours");
    assert_string_equal(b->clips[0].name, "wave");
    assert_null(b->clips[1].name);
    assert_true(b->clips[1].duration == 3 && b->up[2] == a->up[2]);
    assert_int_equal(b->meshes[0].color, 0x123456FF);
    assert_memory_equal(b->meshes[0].batch.colors, colors, sizeof colors);
    for (uint32_t clip = 0; clip <= 2; clip++)
        for (int k = 0; k < 4; k++) {
            assert_int_equal(dp_scene_play(source, clip, NULL), DP_OK);
            assert_int_equal(dp_scene_play(copy, clip, NULL), DP_OK);
            char wanted[20000];
            snprintf(wanted, sizeof wanted, "%s", trace_copy(source, 0.4 * k));
            assert_string_equal(trace_copy(copy, 0.4 * k), wanted);
        }
    dp_source_destroy(source);
    dp_source_destroy(copy);
}

static void batches_arrive_as_they_were_sent(void **state) {
    (void)state;
    dp_source *const source = plain_source(), *const copy = there_and_back(source);
    char wanted[20000];
    snprintf(wanted, sizeof wanted, "%s", trace_copy(source, 0));
    assert_string_equal(trace_copy(copy, 0), wanted);
    assert_contains(wanted, "(0 0 0)(1 0 0)(1 1 0)(0 1 0)");
    assert_null(dp_scene_of(copy));
    dp_source_destroy(source);
    dp_source_destroy(copy);
}

static void failures_arrive(void **state) {
    (void)state;
    const int file = open_file();
    dp_source *source = NULL;
    dp_diag sent = {.result = DP_ERR_FORMAT, .message = "it is broken"}, diag = {0};
    assert_true(transfer_send(file, NULL, &sent));
    assert_int_equal(lseek(file, 0, SEEK_SET), 0);
    assert_int_equal(transfer_receive(file, pipe_clock() + 60, &source, &diag), TRANSFER_DONE);
    assert_int_equal(diag.result, DP_ERR_FORMAT);
    assert_string_equal(diag.message, "it is broken");
    assert_null(source);
    close(file);
}

/* ---- what does not arrive, or something else ---- */

static void use(dp_source *source) {
    dp_extent extent;
    dp_diag diag;
    dp_scene_play(source, 1, &diag);
    dp_source_set_time(source, 0.3, &diag);
    dp_source_extent(source, &extent, &diag);
    for (uint32_t g = 0; g < 5; g++) dp_source_group_name(source, g);
    dp_source_destroy(source);
}

static void check_cut(dp_source *source) {
    uint8_t *data;
    dp_source *copy;
    dp_diag diag = {0};
    const int file = open_file();
    const size_t size = send_source(source, &data);
    for (size_t cut = 0; cut < size; cut += 1 + cut % 7) {
        assert_int_equal(receive(file, data, cut, &copy, &diag), TRANSFER_BROKEN);
        assert_null(copy);
    }
    close(file);
    free(data);
    dp_source_destroy(source);
}

static void what_is_cut_is_broken(void **state) {
    (void)state;
    check_cut(scene_source());
    check_cut(plain_source());
}

static uint32_t next_random(uint32_t *seed) { return *seed = *seed * 1664525u + 1013904223u; }

/* Overwrites some bytes, or words, by odd values. */
static void damage(uint8_t *data, size_t size, uint32_t *seed) {
    static const uint32_t odd[] = {0, 1, 2, 3, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7FC00000};
    for (uint32_t k = next_random(seed) >> 8 & 3; k < 4; k++) {
        const size_t at = (next_random(seed) >> 8) % (size - 4);
        if (next_random(seed) >> 31)
            data[at] ^= (uint8_t)(1u << (next_random(seed) >> 29));
        else
            memcpy(data + at / 4 * 4, &odd[next_random(seed) >> 29], 4);
    }
}

static void check_damaged(dp_source *source, int rounds) {
    uint8_t *data;
    uint32_t seed = 7;
    int arrived = 0;
    const int file = open_file();
    const size_t size = send_source(source, &data);
    uint8_t *const copy = malloc(size);
    assert_non_null(copy);
    for (int k = 0; k < rounds; k++) {
        dp_source *received = NULL;
        dp_diag diag = {0};
        memcpy(copy, data, size);
        damage(copy, size, &seed);
        if (receive(file, copy, size, &received, &diag) != TRANSFER_DONE) assert_null(received);
        if (received) use(received), arrived++;
    }
    assert_true(arrived > rounds / 100 && arrived < rounds);
    close(file);
    free(copy);
    free(data);
    dp_source_destroy(source);
}

static void damage_does_no_harm(void **state) {
    (void)state;
    check_damaged(scene_source(), 20000);
    check_damaged(plain_source(), 5000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_arrive_as_they_were_sent),
        cmocka_unit_test(batches_arrive_as_they_were_sent),
        cmocka_unit_test(failures_arrive),
        cmocka_unit_test(what_is_cut_is_broken),
        cmocka_unit_test(damage_does_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
