/* bench_scene: what scenes cost, in processors' time. A thousand instances of a part, beside the
 * same polygons in one array; and a skinned model that moves, beside the same at rest. */
#include <drypoint/drypoint.h>

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { COPIES = 1000, WIDTH = 1680, HEIGHT = 1050, ROUNDS = 11, HEAD = 16 };

static atomic_llong bytes;

static void *count_alloc(size_t size, void *user) {
    (void)user;
    size_t *const block = malloc(HEAD + size);
    if (!block) return NULL;
    *block = size;
    bytes += (long long)size;
    return (char *)block + HEAD;
}
static void count_free(void *block, void *user) {
    (void)user;
    if (!block) return;
    size_t *const head = (size_t *)(void *)((char *)block - HEAD);
    bytes -= (long long)*head;
    free(head);
}
static void *count_realloc(void *block, size_t size, void *user) {
    void *const moved = count_alloc(size, user);
    const size_t had = block ? *(size_t *)(void *)((char *)block - HEAD) : 0;
    if (moved && block) memcpy(moved, block, had < size ? had : size);
    if (moved) count_free(block, user);
    return moved;
}
static const dp_allocator counting = {count_alloc, count_realloc, count_free, NULL};

/* Of all threads' processors, so that others on the machine do not count. */
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void check(dp_result result, const dp_diag *diag) {
    if (!result) return;
    fprintf(stderr, "bench_scene: %s\n", diag->message);
    exit(1);
}

/* The best time of some pictures, ms. step: seconds between them. */
static double time_frames(dp_context *context, dp_source *source, double step) {
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    double best = 1e9;
    dp_diag diag;
    dp_camera camera;
    check(dp_camera_fit_source(&camera, NULL, source, NULL, &diag), &diag);
    for (int k = 0; k < ROUNDS; k++) {
        const double begun = now();
        check(dp_source_set_time(source, step * k, &diag), &diag);
        check(dp_draw(context, source, &camera, NULL, &target, &diag), &diag);
        const double taken = now() - begun;
        if (k && taken < best) best = taken;
    }
    return best;
}

static dp_context *new_context(void) {
    dp_context *context;
    dp_diag diag;
    check(dp_context_create(NULL, &context, &diag), &diag);
    return context;
}

static dp_batch shape_of(const char *name, uint64_t triangles) {
    const dp_shape shape = {.name = name, .triangles = triangles};
    dp_source *source; /* stays until the end */
    dp_batch batch;
    dp_diag diag;
    check(dp_source_from_shape(&shape, &source, &diag), &diag);
    check(dp_source_next(source, &batch, &diag), &diag);
    return batch;
}

/* Where copy number k stands. */
static void place(int k, double to[3]) {
    to[0] = 3 * (k % 10), to[1] = 3 * (k / 10 % 10), to[2] = 3 * (k / 100);
}

/* ------- instances ------- */

static dp_source *scene_of_copies(const dp_batch *part) {
    static dp_scene_node nodes[COPIES];
    static dp_scene_instance instances[COPIES];
    const dp_scene_mesh mesh = {.batch = *part};
    for (int k = 0; k < COPIES; k++) {
        place(k, nodes[k].translation);
        instances[k] = (dp_scene_instance){.node = (uint32_t)k + 1, .mesh = 1};
    }
    const dp_scene_desc desc = {.nodes = nodes,
                                .meshes = &mesh,
                                .instances = instances,
                                .node_count = COPIES,
                                .mesh_count = 1,
                                .instance_count = COPIES};
    dp_source *source;
    dp_diag diag;
    check(dp_source_from_scene(&desc, &counting, &source, &diag), &diag);
    return source;
}

/* Bytes: of the arrays. */
static dp_source *array_of_copies(const dp_batch *part, size_t *size) {
    const size_t n = part->vertex_count, corners = part->corner_count;
    float *const positions = malloc(COPIES * n * 3 * sizeof *positions);
    uint32_t *const indices = malloc(COPIES * corners * sizeof *indices);
    for (int k = 0; k < COPIES; k++) {
        double at[3];
        place(k, at);
        for (size_t v = 0; v < n; v++)
            for (size_t a = 0; a < 3; a++)
                positions[3 * ((size_t)k * n + v) + a] =
                    (float)((double)part->positions[3 * v + a] + at[a]);
        for (size_t c = 0; c < corners; c++)
            indices[(size_t)k * corners + c] = (uint32_t)((size_t)k * n) + part->indices[c];
    }
    const dp_batch batch = {.positions = positions,
                            .vertex_count = COPIES * n,
                            .indices = indices,
                            .corner_count = COPIES * corners,
                            .polygon_count = COPIES * part->polygon_count};
    dp_source *source;
    dp_diag diag;
    *size = COPIES * (n * 3 * sizeof *positions + corners * sizeof *indices);
    check(dp_source_from_arrays(&batch, NULL, &source, &diag), &diag);
    return source;
}

static void bench_instances(void) {
    const dp_batch part = shape_of("sphere", 1000);
    size_t size;
    dp_context *const context = new_context();
    dp_source *const array = array_of_copies(&part, &size), *const scene = scene_of_copies(&part);
    double plain = 1e9, placed = 1e9;
    for (int k = 0; k < 3; k++) {
        plain = fmin(plain, time_frames(context, array, 0));
        placed = fmin(placed, time_frames(context, scene, 0));
    }
    printf("%d copies of %zu polygons: %.1f MB and %.1f ms; as one array %.1f MB and %.1f ms; "
           "x %.2f and x %.2f\n",
           COPIES, part.polygon_count, (double)bytes / 1e6, placed, (double)size / 1e6, plain,
           (double)bytes / (double)size, placed / plain);
    dp_source_destroy(scene);
    dp_source_destroy(array);
    dp_context_destroy(context);
}

/* ------- a skin ------- */

static void bench_skin(void) {
    static const double times[] = {0, 1};
    static const float turns[] = {0, 0, 0, 1, 0, 0.2f, 0, 0.98f};
    static const uint32_t joints[] = {1, 2, 3, 4};
    const dp_batch part = shape_of("sphere", 200000);
    const size_t count = 4 * part.vertex_count;
    uint16_t *const numbers = malloc(count * sizeof *numbers);
    float *const weights = malloc(count * sizeof *weights);
    for (size_t i = 0; i < count; i++) { /* a chain of joints along y */
        const double at = 2 * (double)part.positions[3 * (i / 4) + 1] + 1.5 - (double)(i % 4);
        numbers[i] = (uint16_t)(i % 4);
        weights[i] = (float)(1 / (0.1 + at * at));
    }
    const dp_scene_node nodes[] = {{0}, {.parent = 1}, {.parent = 2}, {.parent = 3}};
    const dp_scene_mesh mesh = {
        .batch = part, .joints = numbers, .weights = weights, .influences = 4};
    const dp_scene_instance instance = {.mesh = 1, .skin = 1};
    const dp_scene_skin skin = {.joints = joints, .joint_count = 4};
    const dp_scene_channel channel = {
        .node = 3, .path = DP_SCENE_ROTATION, .times = times, .values = turns, .key_count = 2};
    const dp_scene_clip clip = {.channels = &channel, .channel_count = 1};
    const dp_scene_desc desc = {.nodes = nodes,
                                .meshes = &mesh,
                                .instances = &instance,
                                .skins = &skin,
                                .clips = &clip,
                                .node_count = 4,
                                .mesh_count = 1,
                                .instance_count = 1,
                                .skin_count = 1,
                                .clip_count = 1};
    dp_source *source;
    dp_diag diag;
    check(dp_source_from_scene(&desc, NULL, &source, &diag), &diag);
    dp_context *const context = new_context();
    check(dp_scene_play(source, 1, &diag), &diag);
    const double still = time_frames(context, source, 0); /* posed once: nothing is written again */
    const double moving = time_frames(context, source, 1e-3);
    dp_batch batch;
    check(dp_source_set_time(source, 0.05, &diag), &diag);
    const double begun = now();
    check(dp_source_next(source, &batch, &diag), &diag);
    printf("a skin of %zu polygons: %.1f ms a frame that moves, %.1f ms one that does not; x %.2f; "
           "the pose alone, by one "
           "thread, %.1f ms\n",
           batch.polygon_count, moving, still, moving / still, now() - begun);
    dp_context_destroy(context);
    dp_source_destroy(source);
    free(numbers), free(weights);
}

int main(void) {
    bench_instances();
    bench_skin();
    return 0;
}
