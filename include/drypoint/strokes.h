/* drypoint/strokes.h: stroke textures, and how strokes are stylized.
 *
 *     dp_texture *texture = NULL;
 *     dp_texture_named("charcoal", 0, NULL, &texture, &diag);
 *     dp_style style = {.stroke = {.texture = texture, .taper = 12, .jitter = 0.8f}};
 *     ... dp_draw(context, source, &camera, &style, &target, &diag) ...
 *     dp_texture_destroy(texture);
 *
 * A texture's u runs along the line, its v across it (Hermosilla and Vázquez 2010, 2.3.3).
 * Textures from PNG files: drypoint/io.h. */
#ifndef DRYPOINT_STROKES_H
#define DRYPOINT_STROKES_H

#include <drypoint/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An image that repeats along a line. Immutable: any number of contexts may use it at once. */
typedef struct dp_texture dp_texture;

typedef struct dp_texture_desc {
    const uint8_t *pixels;  /* [height][width][channels], rows from v = 0 to v = 1; copied */
    uint32_t width, height; /* 1 to 8192 */
    uint32_t channels;      /* 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA */
    size_t stride;          /* bytes from row to row; 0 means width * channels */
    const dp_allocator *allocator;
} dp_texture_desc;

/* Makes a texture; the caller destroys *out. Alpha is the amount of ink. Without alpha, or with
 * alpha 255 everywhere, the image is ink on white paper: black is full ink, white none. If all ink
 * is grey, strokes have the line's colour; otherwise the texture's own colours.
 * DP_ERR_ARGUMENT, DP_ERR_MEMORY. */
DP_API dp_result dp_texture_create(const dp_texture_desc *desc, dp_texture **out, dp_diag *diag);
DP_API void dp_texture_destroy(dp_texture *texture); /* NULL allowed */

/* Makes one of the procedural textures: "pencil", "brush", "charcoal", "ink", "dashes", "dots", and
 * ornaments for wide lines: "hatch", "rope", "waves", "checks", "chevrons", "lace", "meander".
 * Each seed gives another one of the same kind; the caller destroys *out. DP_ERR_ARGUMENT for an
 * unknown name (the message names the nearest known one), DP_ERR_MEMORY. */
DP_API dp_result dp_texture_named(const char *name, uint32_t seed, const dp_allocator *allocator,
                                  dp_texture **out, dp_diag *diag);
DP_API uint32_t dp_texture_count(void);
DP_API const char *dp_texture_name(uint32_t index);
DP_API const char *dp_texture_about(uint32_t index); /* one line */

/* Its pixels, [height][width][4]: colour, and ink as alpha. Borrowed. */
DP_API const uint8_t *dp_texture_pixels(const dp_texture *texture, uint32_t *width,
                                        uint32_t *height);

/* How u is measured. */
typedef enum dp_stroke_u {
    DP_STROKE_ARC = 0, /* length along chains of segments: no seams, no stretching */
    DP_STROKE_POLAR,   /* u = angle / 2 pi + k * distance, about the projected centre of the
                          model's box (Hermosilla and Vázquez 2010, 2.3.3) */
    DP_STROKE_WORLD    /* length in the model's space along chains of segments: what is farther, or
                          runs away from the eye, has shorter repeats. With DP_INK_STROKES */
} dp_stroke_u;

/* How strokes are stylized. Zero is a plain stroke. */
typedef struct dp_stroke_style {
    const dp_texture *texture; /* NULL: solid ink; must outlive the drawing */
    dp_stroke_u u;
    float k;          /* polar: weight of the distance, per half picture height; 0 means 0.5;
                         negative means 0 */
    float scale;      /* how many times longer than natural the texture is (natural: as tall as the
                         line is wide); 0 means 1 */
    float taper;      /* px from each end over which a stroke thins out, at most half its length;
                         0: blunt ends */
    float jitter;     /* px, about: how far strokes stray from the line */
    float overshoot;  /* px by which strokes run on beyond their ends */
    float depth;      /* 0 to 1: how much thinner the farthest lines are than the nearest */
    float light;      /* 0 to 1: how much thinner lines are on the lit side (the light is at the
                         eye's upper left) */
    uint32_t repeats; /* how often each line is drawn, with other jitter each time; 0 means 1; at
                         most 8 */
    uint32_t seed;    /* of jitter and repeats: the same seed draws the same picture */
} dp_stroke_style;

/* Polar u = angle / 2 pi + k * distance (Hermosilla and Vázquez 2010, 2.3.3). x, y: from the
 * centre, in half picture heights, y up. The angle counts counter-clockwise from the x axis, in
 * turns [0, 1). */
DP_API double dp_stroke_polar(double x, double y, double k);

/* Fills *style with what suits a texture of that name: a pencil jitters, an ink pen tapers;
 * style->texture is not touched. DP_ERR_ARGUMENT for an unknown name. */
DP_API dp_result dp_stroke_look(const char *name, dp_stroke_style *style, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
