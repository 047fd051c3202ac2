/* drypoint/strokes.h: how ink lies along a line: textures, and what the hand does.
 *
 *     dp_texture *texture = NULL;
 *     dp_texture_named("charcoal", 0, NULL, &texture, &diag);
 *     dp_style style = {.stroke = {.texture = texture, .taper = 12, .jitter = 0.8f}};
 *     ... dp_draw(context, source, &camera, &style, &target, &diag) ...
 *     dp_texture_destroy(texture);
 *
 * A texture's u runs along the line, its v across it. Not here: files (drypoint/io.h reads a
 * PNG). */
#ifndef DRYPOINT_STROKES_H
#define DRYPOINT_STROKES_H

#include <drypoint/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An image that repeats along a line. Never changes once made: any number of contexts may use it at
 * once. */
typedef struct dp_texture dp_texture;

typedef struct dp_texture_desc {
    const uint8_t *pixels;  /* [height][width][channels], rows from v = 0 to v = 1; copied */
    uint32_t width, height; /* 1 to 8192 */
    uint32_t channels;      /* 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA */
    size_t stride;          /* bytes from row to row; 0 means width * channels */
    const dp_allocator *allocator;
} dp_texture_desc;

/* Alpha says how much ink there is. Without alpha (or when it is 255 everywhere) the image is ink
 * on white paper: black is full ink, white none. Where the ink is grey it takes the line's colour;
 * where any of it is coloured, the texture's own colours are drawn. DP_ERR_ARGUMENT,
 * DP_ERR_MEMORY. */
DP_API dp_result dp_texture_create(const dp_texture_desc *desc, dp_texture **out, dp_diag *diag);
DP_API void dp_texture_destroy(dp_texture *texture); /* NULL allowed */

/* Textures that are made by rule: "pencil", "brush", "charcoal", "ink", "dashes", "dots". Another
 * seed makes another one of the same kind. DP_ERR_ARGUMENT for an unknown name, with the nearest
 * known one. */
DP_API dp_result dp_texture_named(const char *name, uint32_t seed, const dp_allocator *allocator,
                                  dp_texture **out, dp_diag *diag);
DP_API uint32_t dp_texture_count(void);
DP_API const char *dp_texture_name(uint32_t index);
DP_API const char *dp_texture_about(uint32_t index); /* one line */

/* Its pixels, [height][width][4]: colour, and ink as alpha. Borrowed. */
DP_API const uint8_t *dp_texture_pixels(const dp_texture *texture, uint32_t *width,
                                        uint32_t *height);

/* What u is measured by. */
typedef enum dp_stroke_u {
    DP_STROKE_ARC = 0, /* length along chains of segments: no seams, no stretching */
    DP_STROKE_POLAR    /* u = angle / 2 pi + k * distance, about the projected centre of the model's
                          box    (Hermosilla and Vázquez 2010, 2.3.3) */
} dp_stroke_u;

/* Zero is a plain stroke. */
typedef struct dp_stroke_style {
    const dp_texture *texture; /* NULL: even ink; must outlive the drawing */
    dp_stroke_u u;
    float k;     /* polar: weight of the distance, per half a picture height; 0 means 0.5; negative:
                    none */
    float scale; /* how many times longer than natural (as tall as the line is wide) the texture is;
                    0 means 1 */
    float taper; /* px from each end over which a stroke thins out, at most half its length; 0:
                    blunt */
    float jitter;    /* px by which the hand is off the line, about */
    float overshoot; /* px that strokes run on beyond their ends */
    float depth;     /* 0 to 1: how much thinner the farthest lines are than the nearest */
    float light; /* 0 to 1: how much thinner lines on the lit side are (light from the eye's upper
                    left) */
    uint32_t repeats; /* how often each line is drawn, each time with other errors; 0 means 1; at
                         most 8 */
    uint32_t seed;    /* of jitter and repeats: the same seed draws the same picture */
} dp_stroke_style;

/* u by the polar formula: `x`, `y` from the centre, in half picture heights, y up; the angle counts
 * from the x axis, counter-clockwise, in turns [0, 1). */
DP_API double dp_stroke_polar(double x, double y, double k);

/* Fills what suits a texture of that name: a pencil is jittery, an ink pen tapers. DP_ERR_ARGUMENT
 * for an unknown name. `texture` is not touched. */
DP_API dp_result dp_stroke_look(const char *name, dp_stroke_style *style, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
