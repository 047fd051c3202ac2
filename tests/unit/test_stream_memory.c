/* Streaming's memory is bounded: the peak of a process that draws two million triangles of binary
 * STL (100 MB). Skipped where sanitizers or the hostile build make memory meaningless. */
#define _DEFAULT_SOURCE /* wait4 */
#include "temporary.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 1680, HEIGHT = 1050, TRIANGLES = 2000000, MB = 1 << 20 };

static char path[300];

static int write_model(void) {
    dp_source *source;
    dp_diag diag = {0};
    const dp_shape shape = {.name = "terrain", .triangles = TRIANGLES};
    if (dp_source_from_shape(&shape, &source, &diag)) return 1;
    const dp_result result = dp_io_write_mesh(path, DP_MESH_FILE_STL, source, NULL, NULL, &diag);
    dp_source_destroy(source);
    return result;
}

/* 0, or what went wrong. */
static int draw_model(void) {
    dp_context *context;
    dp_source *source;
    dp_extent extent;
    dp_camera camera;
    dp_diag diag = {0};
    dp_stats stats;
    const dp_context_desc desc = {.memory = 64 * MB};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = malloc(4 * WIDTH * HEIGHT)};
    if (!target.rgba || dp_context_create(&desc, &context, &diag)) return 1;
    if (dp_source_open(path, NULL, &source, &diag) || dp_source_extent(source, &extent, &diag))
        return 2;
    dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    if (dp_camera_fit(&camera, &fit) || dp_draw(context, source, &camera, NULL, &target, &diag))
        return 3;
    dp_stats_of(context, &stats);
    if (stats.segments < 1000 || stats.edges_lost || stats.polygons < TRIANGLES / 10 * 9) return 4;
    dp_context_destroy(context);
    dp_source_destroy(source);
    free(target.rgba);
    return 0;
}

/* Exit status of a task in a process of its own; its peak in MB. */
static int apart(int (*task)(void), double *peak) {
    int status = 0;
    struct rusage usage;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (!child) _exit(task());
    assert_true(wait4(child, &status, 0, &usage) == child);
    *peak = (double)usage.ru_maxrss / 1024;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

static void two_million_triangles(void **state) {
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(DP_HOSTILE)
    skip();
#endif
    double peak;
    temporary_name(path, sizeof path, "memory");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    const int written = apart(write_model, &peak);
    if (!written && peak > 40) fail_msg("writing held %.0f MB", peak);
    const int drawn = written ? 0 : apart(draw_model, &peak);
    unlink(path);
    assert_int_equal(written, 0);
    assert_int_equal(drawn, 0);
    /* what was allowed, the picture (its colours and the depth of its samples), and the program */
    const double picture = (4.0 + 4 * sizeof(float)) * (WIDTH + 63) * (HEIGHT + 63) / MB;
    if (peak > 64 + picture + 16) fail_msg("drawing held %.0f MB", peak);
    print_message("drawing held %.0f MB\n", peak);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_million_triangles)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
