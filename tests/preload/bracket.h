/* bracket.h: an L-shaped bracket and where its corners are in the picture, for scene.c, which draws it, and for
 * test_preload.c, which looks for its lines. */
#ifndef BRACKET_H
#define BRACKET_H

enum { PICTURE = 200 }; /* px, width and height */

/* The profile in x and y, counter-clockwise; its one concave corner is (1, 1). Extruded from z = 0 to 2. Points in
 * the middle of straight sides make all faces conform. */
static const float bracket_profile[][2] = {{0, 0}, {1, 0}, {3, 0}, {3, 1},
                                           {1, 1}, {1, 3}, {0, 3}, {0, 1}};
enum { BRACKET_SIDES = 8 };

/* Three squares and rectangles fill the profile, as indices into it. */
static const int bracket_cap[3][4] = {{0, 1, 4, 7}, {1, 2, 3, 4}, {7, 4, 5, 6}};

/* Columns, as OpenGL has them. The viewer looks along (-0.6, -0.5, -0.62), so that the front, the right and the upper
 * faces show. Parallel: window = half + scale * (modelview * p). */
static const float bracket_modelview[16] = {0.7182f, -0.3516f, 0.6005f,  0,        0,       0.8628f,
                                            0.5056f, 0,        -0.6958f, -0.3631f, 0.6197f, 0,
                                            -0.381f, -0.404f,  -10,      1};
static const float bracket_scale = 40; /* px for a unit */

static inline void bracket_project(const float p[3], float window[2]) {
    for (int i = 0; i < 2; i++) {
        float v = bracket_modelview[12 + i];
        for (int k = 0; k < 3; k++) v += bracket_modelview[4 * k + i] * p[k];
        window[i] = PICTURE / 2 + bracket_scale * v;
    }
}

#endif
