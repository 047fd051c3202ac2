/* How much of the lines that OpenGL finds are those of the CPU, and what finding them takes.
 *
 *     bench_lines [--size WxH] [--samples N] [--views N] [--angles RIDGE,VALLEY] [--ortho] [--print N] MODEL...
 *     bench_lines --time [TRIANGLES]
 *
 * A model is a file, or shape:NAME or shape:NAME:TRIANGLES. Prints a Markdown table: by class the length on the CPU and
 * here, px, and the share of it that is alike (agree.h). With --time: processor time (all threads, as llvmpipe is one) of
 * a frame of faces alone, of the same with lines, and of the first one. */
#include "gl/agree.h"
#include "gl/context.h"

#include <drypoint/io.h>
#include <drypoint/shapes.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct options {
    uint32_t width, height, samples, views, print;
    bool orthographic;
    dp_style style;
} options;

static const double directions[][3] = {
    {1, 0.6, 1}, {-0.8, 0.3, 0.7}, {0.2, 1, -0.6}, {-0.5, -0.4, -1}};

static void need(dp_result result, const dp_diag *diag) {
    if (!result) return;
    fprintf(stderr, "bench_lines: %s\n", diag->message);
    exit(1);
}

static dp_source *open_model(const char *name) {
    dp_source *source;
    dp_diag diag = {0};
    char shape[64] = "";
    unsigned triangles = 0;
    if (strncmp(name, "shape:", 6) != 0) {
        need(dp_io_open(name, NULL, &source, &diag), &diag);
        return source;
    }
    sscanf(name + 6, "%63[^:]:%u", shape, &triangles);
    const dp_shape made = {.name = shape, .triangles = triangles};
    need(dp_source_from_shape(&made, &source, &diag), &diag);
    return source;
}

static dp_camera camera_of(const options *o, dp_source *source, uint32_t view) {
    dp_camera camera;
    dp_diag diag = {0};
    dp_fit fit = {.aspect = (double)o->width / o->height, .orthographic = o->orthographic};
    memcpy(fit.direction, directions[view % 4], sizeof fit.direction);
    need(dp_camera_fit_source(&camera, &fit, source, NULL, &diag), &diag);
    return camera;
}

static void print_view(const options *o, const char *name, uint32_t view, const dp_segment *cpu,
                       size_t cpu_count, const dp_segment *gpu, size_t gpu_count) {
    for (int i = 0; i <= DP_LINE_COUNT; i++) {
        const agreement g = agree(cpu, cpu_count, gpu, gpu_count, (dp_line)i);
        if (!(g.all > 0)) continue;
        printf("| %s | %u | %s | %.0f | %.0f | %.5f | %.5f |\n", name, view,
               i < DP_LINE_COUNT ? dp_line_name((dp_line)i) : "all", g.length[0], g.length[1],
               agree_share(&g), g.common / g.all);
    }
    if (o->print) agree_print(cpu, cpu_count, gpu, gpu_count, DP_LINE_COUNT, o->print);
    fflush(stdout);
}

static void compare(gl_test *t, const options *o, dp_context *context, const char *name) {
    dp_source *const source = open_model(name);
    dp_gl_mesh *mesh;
    dp_diag diag = {0};
    const char *const slash = strrchr(name, '/');
    need(dp_gl_mesh_from_source(t->gl, source, &mesh, &diag), &diag);
    for (uint32_t v = 0; v < o->views; v++) {
        const dp_camera camera = camera_of(o, source, v);
        const dp_gl_target target = gl_test_target(t, o->width, o->height, o->samples);
        const dp_target plain = {.width = o->width, .height = o->height, .samples = o->samples};
        const dp_segment *gpu;
        size_t cpu_count, gpu_count;
        need(dp_draw(context, source, &camera, &o->style, &plain, &diag), &diag);
        need(dp_gl_draw(t->gl, &mesh, 1, &camera, &o->style, &target, &diag), &diag);
        const dp_segment *const cpu = dp_segments(context, &cpu_count);
        need(dp_gl_segments(t->gl, &gpu, &gpu_count, &diag), &diag);
        print_view(o, slash ? slash + 1 : name, v, cpu, cpu_count, gpu, gpu_count);
    }
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

static double processor_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* One frame, and until it is done. */
static double frame_ms(gl_test *t, const options *o, dp_gl_mesh *mesh, const dp_camera *camera,
                       const dp_style *style) {
    const dp_gl_target target = gl_test_target(t, o->width, o->height, o->samples);
    uint8_t *const rgba = malloc((size_t)4 * o->width * o->height);
    dp_diag diag = {0};
    const double since = processor_ms();
    need(dp_gl_draw(t->gl, &mesh, 1, camera, style, &target, &diag), &diag);
    need(dp_gl_read(t->gl, &target, rgba, 0, &diag), &diag);
    free(rgba);
    return processor_ms() - since;
}

static double least_ms(gl_test *t, const options *o, dp_gl_mesh *mesh, const dp_camera *camera,
                       const dp_style *style) {
    double least = INFINITY;
    for (int i = 0; i < 5; i++) least = fmin(least, frame_ms(t, o, mesh, camera, style));
    return least;
}

static void print_stages(gl_test *t) {
    dp_gl_stats stats;
    dp_diag diag = {0};
    need(dp_gl_stats_of(t->gl, &stats, &diag), &diag);
    printf("%llu triangles, %llu candidates, %llu segments, %.0f MB of the device;",
           (unsigned long long)stats.triangles, (unsigned long long)stats.candidates,
           (unsigned long long)stats.segments, (double)stats.bytes * 1e-6);
    for (int i = 0; i < DP_GL_STAGE_COUNT; i++)
        printf(" %s %.1f", dp_gl_stage_name((dp_gl_stage)i), stats.stage_ms[i]);
    printf(" ms\n");
}

static void measure(gl_test *t, const options *o, unsigned triangles) {
    char name[64];
    snprintf(name, sizeof name, "shape:torus:%u", triangles);
    dp_source *const source = open_model(name);
    const dp_camera camera = camera_of(o, source, 0);
    dp_gl_mesh *mesh;
    dp_diag diag = {0};
    dp_style flat = o->style, lines = o->style;
    flat.lines = DP_NO_LINES;
    lines.lines = DP_SILHOUETTE | DP_RIDGE | DP_VALLEY;
    need(dp_gl_mesh_from_source(t->gl, source, &mesh, &diag), &diag);
    frame_ms(t, o, mesh, &camera, &lines); /* programs are compiled */
    const double faces = least_ms(t, o, mesh, &camera, &flat),
                 kept = least_ms(t, o, mesh, &camera, &lines);
    double first = INFINITY;
    for (int i = 0; i < 3; i++) {
        dp_gl_mesh_topology_changed(mesh);
        first = fmin(first, frame_ms(t, o, mesh, &camera, &lines));
    }
    dp_gl_time_stages(t->gl, true);
    dp_gl_mesh_topology_changed(mesh);
    frame_ms(t, o, mesh, &camera, &lines);
    print_stages(t);
    printf("faces alone %.0f ms, lines with mates kept %.0f ms (%.2f x), first frame %.0f ms "
           "(%.2f x), of processor time\n",
           faces, kept, kept / faces, first, first / faces);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

/* Reads one option; how many arguments it took, 0: it is none. */
static int take_option(options *o, char **at) {
    float ridge, valley;
    if (!strcmp(at[0], "--ortho")) return o->orthographic = true, 1;
    if (!at[1]) return 0;
    if (!strcmp(at[0], "--size")) return sscanf(at[1], "%ux%u", &o->width, &o->height) == 2 ? 2 : 0;
    if (!strcmp(at[0], "--samples")) return o->samples = (uint32_t)atoi(at[1]), 2;
    if (!strcmp(at[0], "--views")) return o->views = (uint32_t)atoi(at[1]), 2;
    if (!strcmp(at[0], "--print")) return o->print = (uint32_t)atoi(at[1]), 2;
    if (!strcmp(at[0], "--angles") && sscanf(at[1], "%f,%f", &ridge, &valley) == 2)
        return o->style.ridge_angle = ridge, o->style.valley_angle = valley, 2;
    return 0;
}

int main(int argc, char **argv) {
    options o = {.width = 1680, .height = 1050, .samples = 4, .views = 3};
    dp_context *context;
    void *state;
    if (gl_test_setup(&state)) return 1;
    gl_test *const t = state;
    if (!t->gl) return 77;
    if (dp_context_create(NULL, &context, NULL)) return 1;
    bool heads = true;
    for (int i = 1, n; i < argc; i += n) {
        n = 1;
        if (!strcmp(argv[i], "--time")) {
            measure(t, &o, i + 1 < argc ? (unsigned)atoi(argv[i + 1]) : 1000000);
            n = 2;
        } else if (argv[i][0] == '-') {
            if (!(n = take_option(&o, argv + i)))
                return fprintf(stderr, "what is %s?\n", argv[i]), 2;
        } else {
            if (heads)
                printf("| model | view | class | CPU, px | OpenGL, px | alike | in common "
                       "|\n|---|---|---|---|---|---|---|\n");
            heads = false;
            compare(t, &o, context, argv[i]);
        }
    }
    dp_context_destroy(context);
    return gl_test_teardown(&state);
}
