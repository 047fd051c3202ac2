/* noise IN OUT SHARE [SEED]: a model as a poor scanner would have measured it.
 *
 * Every vertex is moved along its normal by a normally distributed distance, whose standard
 * deviation is SHARE of the diagonal of the model's box (0.001, say). Vertices at one position move
 * together, so that nothing is torn open. Normals are those of the triangles around a vertex,
 * weighted by area. The same SEED (1) gives the same noise. */
#include "mesh_noise.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    char *rest = NULL;
    const double share = argc > 3 ? strtod(argv[3], &rest) : -1;
    if (argc < 4 || argc > 5 || !(share >= 0) || *rest)
        return fprintf(stderr, "usage: noise IN OUT.ply SHARE [SEED]\n"), 2;
    mesh m;
    if (!mesh_read(argv[1], &m)) return EXIT_FAILURE;
    const bool able = mesh_add_noise(&m, share, argc == 5 ? strtoull(argv[4], NULL, 10) : 1);
    if (!able) fprintf(stderr, "noise: not enough memory for %s\n", argv[2]);
    const bool written = able && mesh_write(&m, argv[2]);
    mesh_free(&m);
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
