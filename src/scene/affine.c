/* Translations, rotations and scales to matrices and back. */
#include "scene/affine.h"

#include <math.h>

dp_affine dp_affine_of(const dp_trs *trs) {
    const double *const q = trs->rotation;
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const double s = square > 0 ? 2 / square : 0; /* a quaternion of length 0 turns nothing */
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[3][3] = {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                               {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
                               {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}};
    dp_affine matrix;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) matrix.row[r][c] = turn[r][c] * trs->scale[c];
        matrix.row[r][3] = trs->translation[r];
    }
    return matrix;
}

/* The quaternion of a rotation matrix, by its largest component (Shepperd 1978). */
static void find_rotation(const double m[3][3], double q[4]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (trace > m[0][0] && trace > m[1][1] && trace > m[2][2]) {
        q[3] = 1 + trace;
        for (int k = 0; k < 3; k++)
            q[k] = m[(k + 2) % 3][(k + 1) % 3] - m[(k + 1) % 3][(k + 2) % 3];
    } else {
        const int i = m[0][0] >= m[1][1] && m[0][0] >= m[2][2] ? 0 : m[1][1] >= m[2][2] ? 1 : 2;
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
        q[j] = m[j][i] + m[i][j];
        q[k] = m[k][i] + m[i][k];
        q[3] = m[k][j] - m[j][k];
    }
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) q[k] = length > 0 ? q[k] / length : k == 3;
}

dp_trs dp_affine_split(const dp_affine *matrix) {
    dp_trs trs;
    double turn[3][3];
    const double sign = dp_affine_determinant(matrix) < 0 ? -1 : 1;
    for (int c = 0; c < 3; c++) {
        double square = 0;
        for (int r = 0; r < 3; r++) square += matrix->row[r][c] * matrix->row[r][c];
        trs.scale[c] = sign * sqrt(square);
        trs.translation[c] = matrix->row[c][3];
        for (int r = 0; r < 3; r++)
            turn[r][c] = square > 0 ? matrix->row[r][c] / trs.scale[c] : r == c;
    }
    find_rotation((const double(*)[3])turn, trs.rotation);
    return trs;
}
