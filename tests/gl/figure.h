/* A torus of the tests' own, as arrays, and a camera in front of it. */
#ifndef TESTS_GL_FIGURE_H
#define TESTS_GL_FIGURE_H

#include "gl/context.h"

enum {
    FIGURE_ROUND = 24,
    FIGURE_TUBE = 12,
    FIGURE_VERTICES = FIGURE_ROUND * FIGURE_TUBE,
    FIGURE_TRIANGLES = 2 * FIGURE_VERTICES
};

typedef struct figure {
    float positions[FIGURE_VERTICES][3];
    uint32_t indices[FIGURE_TRIANGLES][3];
} figure;

/* Its axis is z; its middle is moved by `x`. */
void figure_make(figure *out, float x);
/* Turned about the x axis, as the matrix has it (column-major). */
void figure_turn_matrix(double matrix[16], double degrees, double x);
void figure_place(figure *f, const double matrix[16]);
dp_source *figure_source(const figure *f);
dp_camera figure_camera(bool orthographic, double far_z);

#endif
