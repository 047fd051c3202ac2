/* bench_posed MODEL ANIMATION TIME OUT.ply: writes a model as it is at a time, for tests/accuracy/posed.py.
 * ANIMATION is a number from 1; 0 is at rest. */
#include <drypoint/io.h>
#include <drypoint/scene.h>

#include <stdio.h>
#include <stdlib.h>

static int failed(const dp_diag *diag) {
    fprintf(stderr, "bench_posed: %s\n", diag->message);
    return 1;
}

int main(int argc, char **argv) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (argc != 5) {
        fprintf(stderr, "usage: bench_posed MODEL ANIMATION TIME OUT.ply\n");
        return 2;
    }
    const uint32_t clip = (uint32_t)strtoul(argv[2], NULL, 10);
    if (dp_io_open(argv[1], NULL, &source, &diag)) return failed(&diag);
    if ((clip && dp_scene_play(source, clip, &diag)) ||
        dp_source_set_time(source, strtod(argv[3], NULL), &diag) ||
        dp_io_write_mesh(argv[4], DP_MESH_FILE_PLY_ASCII, source, NULL, NULL, &diag))
        return failed(&diag);
    dp_source_destroy(source);
    return 0;
}
