/* Noise on a mesh. Vertices at one position move together, so that nothing is torn open. Normals are those of the
 * triangles around a vertex, weighted by area. */
#include "mesh_noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A vertex, to be sorted by position. */
typedef struct place {
    float position[3];
    uint32_t vertex;
} place;

static int by_position(const void *left, const void *right) {
    const place *const a = left, *const b = right;
    for (int k = 0; k < 3; k++)
        if (a->position[k] != b->position[k]) return a->position[k] < b->position[k] ? -1 : 1;
    return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

/* Gives each vertex the number of the first one at its position. False: no memory. */
static bool find_same(const mesh *m, uint32_t *same) {
    place *const places = malloc((m->vertex_count + 1) * sizeof *places);
    if (!places) return false;
    for (size_t v = 0; v < m->vertex_count; v++) {
        memcpy(places[v].position, m->positions + 3 * v, sizeof places[v].position);
        places[v].vertex = (uint32_t)v;
    }
    qsort(places, m->vertex_count, sizeof *places, by_position);
    for (size_t p = 0, first = 0; p < m->vertex_count; p++) {
        for (int k = 0; k < 3; k++)
            if (places[p].position[k] != places[first].position[k]) first = p;
        same[places[p].vertex] = places[first].vertex;
    }
    free(places);
    return true;
}

/* Adds each triangle's normal, twice its area long, to its vertices' ones. */
static void add_normals(const mesh *m, const uint32_t *same, double (*normals)[3]) {
    for (size_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *const v = m->indices + 3 * t;
        double side[2][3];
        for (int s = 0; s < 2; s++)
            for (int k = 0; k < 3; k++)
                side[s][k] = (double)m->positions[3 * (size_t)v[s + 1] + k] -
                             (double)m->positions[3 * (size_t)v[0] + k];
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            const double normal = side[0][i] * side[1][j] - side[0][j] * side[1][i];
            for (int c = 0; c < 3; c++) normals[same[v[c]]][k] += normal;
        }
    }
}

static double diagonal(const mesh *m) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double min = INFINITY, max = -INFINITY;
        for (size_t v = 0; v < m->vertex_count; v++) {
            min = fmin(min, (double)m->positions[3 * v + k]);
            max = fmax(max, (double)m->positions[3 * v + k]);
        }
        square += (max - min) * (max - min);
    }
    return sqrt(square);
}

/* In (0, 1), from a counter: splitmix64 (Steele, Lea and Flood 2014). */
static double uniform(uint64_t *state) {
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return ((double)((z ^ z >> 31) >> 11) + 0.5) / 9007199254740992.0; /* 2^53 */
}

/* Normally distributed, mean 0, standard deviation 1 (Box and Muller 1958). */
static double normal_number(uint64_t *state) {
    const double radius = sqrt(-2 * log(uniform(state)));
    return radius * cos(2 * 3.14159265358979323846 * uniform(state));
}

/* Each vertex's noise follows from the seed and from the first vertex at its position alone. */
static void move(mesh *m, const uint32_t *same, double (*normals)[3], double sigma, uint64_t seed) {
    for (size_t v = 0; v < m->vertex_count; v++) {
        const double *const n = normals[same[v]];
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        uint64_t state = seed << 32 ^ same[v];
        const double by = sigma * normal_number(&state) / (length > 0 ? length : 1);
        for (int k = 0; k < 3; k++)
            m->positions[3 * v + k] = (float)((double)m->positions[3 * v + k] + by * n[k]);
    }
}

bool mesh_add_noise(mesh *m, double share, uint64_t seed) {
    uint32_t *const same = malloc((m->vertex_count + 1) * sizeof *same);
    double(*const normals)[3] = calloc(m->vertex_count + 1, sizeof *normals);
    const bool able = same && normals && find_same(m, same);
    if (able) {
        add_normals(m, same, normals);
        move(m, same, normals, share * diagonal(m), seed);
    }
    free(same);
    free(normals);
    return able;
}
