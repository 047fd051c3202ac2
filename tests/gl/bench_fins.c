/* Times of Hermosilla and Vázquez 2010 by OpenGL, beside their Tables 2.1 and 2.2:
 *
 *     bench_fins [MODEL...]         files; without any, generated models of the sizes of theirs
 *
 * As they have it: 1680 x 1050, one sample a pixel; silhouettes alone, 8 px, textured; pencil without lines. Each is
 * drawn FRAMES times, turning; what is told are medians of the device's time by timer queries, ms: of the frame, and
 * of its stages; then the frames a second that makes, and how many times theirs at the nearest size. DP_TEST_PICTURES=DIR
 * keeps pictures, and compares them with the CPU's; DP_TEST_EGL_DEVICE=N draws on the system's device N. Curvature is made once a shape, on the CPU, and is told apart. */
#include "gl/context.h"

#include "gl/gl.h"

#include <drypoint/io.h>
#include <drypoint/shapes.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum { WIDTH = 1680, HEIGHT = 1050, FRAMES_MOST = 101 };

static const struct {
    const char *name;
    uint32_t triangles;
    double silhouettes, pencil; /* frames a second: Tables 2.1 and 2.2 */
} theirs[] = {{"Buddha", 1087716, 8.50, 87.71},        {"Armadillo", 345944, 21.07, 117.22},
              {"Asian Dragon", 225588, 25.75, 199.20}, {"Dragon", 100000, 60.07, 344.28},
              {"Bunny", 69666, 110.78, 422.20},        {"Atenea", 15014, 337.59, 553.55}};
enum { MODELS = sizeof theirs / sizeof *theirs };

typedef struct way {
    const char *name;
    bool pencil, pulled;
    int passes;
} way;

static const way ways[] = {{"geometry shader, 1 pass", false, false, 1},
                           {"geometry shader, 2 passes", false, false, 2},
                           {"pulled", false, true, 2},
                           {"pencil", true, false, 0}};

static size_t nearest_of(uint64_t triangles) {
    size_t best = 0;
    for (size_t i = 1; i < MODELS; i++)
        if (fabs(log((double)theirs[i].triangles / (double)triangles)) <
            fabs(log((double)theirs[best].triangles / (double)triangles)))
            best = i;
    return best;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
static double median(double *values, size_t count) {
    qsort(values, count, sizeof *values, by_value);
    return values[count / 2];
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static dp_camera camera_at(dp_source *source, double turn) {
    dp_camera camera;
    const dp_fit fit = {.direction = {sin(turn), 0.35, cos(turn)},
                        .aspect = (double)WIDTH / HEIGHT};
    dp_diag diag;
    if (dp_camera_fit_source(&camera, &fit, source, NULL, &diag)) {
        fprintf(stderr, "%s\n", diag.message);
        exit(1);
    }
    return camera;
}

static dp_style style_of(const way *w, const dp_texture *texture) {
    dp_style style = {.lines = w->pencil ? DP_NO_LINES : DP_SILHOUETTE};
    if (w->pencil) {
        style.shade.shading = DP_SHADING_PENCIL;
        return style;
    }
    style.edges = DP_EDGES_ADJACENCY, style.ink = DP_INK_QUADS, style.method = DP_METHOD_PAPER;
    style.passes = w->passes;
    style.line[DP_LINE_SILHOUETTE].width = 8;
    style.stroke.texture = texture, style.stroke.u = DP_STROKE_POLAR;
    return style;
}

static void keep(gl_test *t, const char *model, const way *w, const dp_style *style,
                 const dp_gl_target *target, dp_source *source) {
    char name[200];
    if (!getenv("DP_TEST_PICTURES")) return;
    uint8_t *const rgba = malloc((size_t)4 * WIDTH * HEIGHT);
    const dp_camera camera = camera_at(source, 0);
    dp_gl_read(t->gl, target, rgba, 0, NULL);
    uint8_t *const cpu = gl_test_draw_cpu(source, &camera, style, WIDTH, HEIGHT, 1);
    snprintf(name, sizeof name, "bench-%s-%s", model, w->name);
    gl_test_keep(name, rgba, WIDTH, HEIGHT);
    printf("    within 2 levels of the CPU's: %.5f, within 16: %.5f\n",
           gl_test_alike(rgba, cpu, WIDTH, HEIGHT, 2), gl_test_alike(rgba, cpu, WIDTH, HEIGHT, 16));
    snprintf(name, sizeof name, "bench-%s-%s-cpu", model, w->name);
    gl_test_keep(name, cpu, WIDTH, HEIGHT);
    free(rgba), free(cpu);
}

static void tell(const way *w, uint64_t triangles, double frame, double stages[DP_GL_STAGE_COUNT]) {
    const size_t n = nearest_of(triangles);
    const double fps = frame > 0 ? 1000 / frame : 0,
                 their = w->pencil ? theirs[n].pencil : theirs[n].silhouettes;
    printf("  %-26s %8.3f ms  %8.1f fps  %7.1f times %s (%u triangles, %.1f fps)\n   ", w->name,
           frame, fps, fps / their, theirs[n].name, theirs[n].triangles, their);
    for (int i = 0; i < DP_GL_STAGE_COUNT; i++)
        if (stages[i] > 0.0005) printf(" %s %.3f", dp_gl_stage_name((dp_gl_stage)i), stages[i]);
    printf("\n");
}

static int draw(gl_test *t, dp_gl_mesh *mesh, const dp_camera *camera, const dp_style *style,
                const dp_gl_target *target) {
    dp_diag diag;
    if (dp_gl_draw(t->gl, &mesh, 1, camera, style, target, &diag) == DP_OK) return 0;
    fprintf(stderr, "%s\n", diag.message);
    return 1;
}

static int run(gl_test *t, const char *model, dp_gl_mesh *mesh, dp_source *source, const way *w,
               const dp_texture *texture, int frames) {
    static double frame[FRAMES_MOST], stage[DP_GL_STAGE_COUNT][FRAMES_MOST];
    double stages[DP_GL_STAGE_COUNT];
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    const dp_style style = style_of(w, texture);
    dp_gl_stats stats = {0};
    dp_camera camera = camera_at(source, 0);
    t->gl->no_geometry_shader = w->pulled;
    const double start = now_ms();
    if (draw(t, mesh, &camera, &style, &target)) return 1; /* programs, mates, curvature */
    dp_gl_stats_of(t->gl, &stats, NULL);
    printf("  first frame, with programs and what is kept: %.1f ms\n", now_ms() - start);
    keep(t, model, w, &style, &target, source);
    for (int i = 0; i < frames; i++) {
        camera = camera_at(source, 6.283185307179586 * i / frames);
        if (draw(t, mesh, &camera, &style, &target)) return 1;
        dp_gl_stats_of(t->gl, &stats, NULL);
        frame[i] = 0;
        for (int s = 0; s < DP_GL_STAGE_COUNT; s++)
            stage[s][i] = stats.stage_ms[s], frame[i] += stats.stage_ms[s];
    }
    for (int s = 0; s < DP_GL_STAGE_COUNT; s++) stages[s] = median(stage[s], (size_t)frames);
    tell(w, stats.triangles, median(frame, (size_t)frames), stages);
    t->gl->no_geometry_shader = false;
    return 0;
}

static int bench(gl_test *t, const char *name, dp_source *source, const dp_texture *texture,
                 int frames) {
    dp_gl_mesh *mesh;
    dp_diag diag;
    int failed = 0;
    if (dp_gl_mesh_from_source(t->gl, source, &mesh, &diag)) {
        fprintf(stderr, "%s: %s\n", name, diag.message);
        return 1;
    }
    printf("%s\n", name);
    for (size_t i = 0; i < sizeof ways / sizeof *ways && !failed; i++)
        failed = run(t, name, mesh, source, &ways[i], texture, frames);
    dp_gl_mesh_destroy(mesh);
    return failed;
}

static const char *end_of(const char *path) {
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static int bench_all(gl_test *t, int count, char **paths, const dp_texture *texture, int frames) {
    int failed = 0;
    for (int i = 0; i < (count ? count : MODELS) && !failed; i++) {
        const dp_shape shape = {.name = "torso", .triangles = theirs[count ? 0 : i].triangles};
        dp_source *source = NULL;
        dp_diag diag = {0};
        const dp_result result = count ? dp_source_open(paths[i], NULL, &source, &diag)
                                       : dp_source_from_shape(&shape, &source, &diag);
        if (result) fprintf(stderr, "%s\n", diag.message);
        failed =
            result || bench(t, count ? end_of(paths[i]) : theirs[i].name, source, texture, frames);
        dp_source_destroy(source);
    }
    return failed;
}

int main(int argc, char **argv) {
    void *state = NULL;
    dp_texture *texture = NULL;
    const char *const asked = getenv("FRAMES");
    int frames = asked ? atoi(asked) : 21;
    if (frames < 1 || frames > FRAMES_MOST) frames = 21;
    if (gl_test_setup(&state)) return 1;
    gl_test *const t = state;
    if (!t->gl || dp_texture_named("charcoal", 0, NULL, &texture, NULL)) return 1;
    dp_gl_time_stages(t->gl, true);
    printf("%s; %d frames each\n", dp_gl_device(t->gl), frames);
    const int failed = bench_all(t, argc - 1, argv + 1, texture, frames);
    dp_texture_destroy(texture);
    gl_test_teardown(&state);
    return failed;
}
