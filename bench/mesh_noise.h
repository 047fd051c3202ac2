/* A mesh as a poor scanner would have measured it. */
#ifndef BENCH_MESH_NOISE_H
#define BENCH_MESH_NOISE_H

#include "mesh.h"

/* Moves every vertex along its normal by a normally distributed distance, whose standard deviation
 * is `share` of the diagonal of the mesh's box. The same seed gives the same noise. False: no
 * memory. */
bool mesh_add_noise(mesh *m, double share, uint64_t seed);

#endif
