/* Affine transforms in double precision. */
#ifndef DP_SCENE_AFFINE_H
#define DP_SCENE_AFFINE_H

#include "base/vec.h"

/* Rows that take (x, y, z, 1) to one coordinate each. */
typedef struct dp_affine {
    double row[3][4];
} dp_affine;

static const dp_affine dp_affine_identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* What moves a node within its parent: translation * rotation * scale. */
typedef struct dp_trs {
    double translation[3], rotation[4] /* x, y, z, w */, scale[3];
} dp_trs;

/* a * b: first b, then a. */
static inline dp_affine dp_affine_compose(const dp_affine *a, const dp_affine *b) {
    dp_affine product;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) {
            double sum = c == 3 ? a->row[r][3] : 0;
            for (int k = 0; k < 3; k++) sum += a->row[r][k] * b->row[k][c];
            product.row[r][c] = sum;
        }
    return product;
}

/* Cofactors of the 3 x 3 part: they turn normals, up to the sign of the determinant. */
static inline void dp_affine_cofactors(const dp_affine *t, double to[3][3]) {
    const double(*const m)[4] = t->row;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            const int i = (r + 1) % 3, j = (r + 2) % 3, k = (c + 1) % 3, l = (c + 2) % 3;
            to[r][c] = m[i][k] * m[j][l] - m[i][l] * m[j][k];
        }
}

/* Of the 3 x 3 part; below 0 the transform mirrors. */
static inline double dp_affine_determinant(const dp_affine *t) {
    const double(*const m)[4] = t->row;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The matrix of a TRS. The rotation may have any length; 0 is none. */
dp_affine dp_affine_of(const dp_trs *trs);
/* The TRS next to a matrix: exact where it has no shear. */
dp_trs dp_affine_split(const dp_affine *matrix);

#endif
