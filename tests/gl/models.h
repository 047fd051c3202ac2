/* Small models of different kinds, as arrays: of polygons or triangles, with and without groups, colours, normals and texture
 * coordinates. */
#ifndef TESTS_GL_MODELS_H
#define TESTS_GL_MODELS_H

#include <drypoint/source.h>

enum { VERTICES = 160, CORNERS = 640, POLYGONS = 192 };

typedef enum shape { TORUS, SHEETS, BOX, NOTHING, SHAPES } shape;

typedef struct model {
    float positions[VERTICES][3], normals[VERTICES][3], texcoords[VERTICES][2];
    uint32_t colors[VERTICES], corners[CORNERS], firsts[POLYGONS + 1];
    uint16_t groups[POLYGONS];
    uint32_t vertices, polygons;
} model;

/* `wave`: how far vertices stray along x. */
void make_model(model *m, shape s, float wave);
/* It reads the model's arrays. far_away: from another origin. */
dp_source *source_of(const model *m, shape s, bool far_away);

#endif
