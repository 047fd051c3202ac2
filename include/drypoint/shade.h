/* drypoint/shade.h: how surfaces look, and the edge map.
 *
 * Both follow M. Nienhaus and J. Döllner, Edge-Enhancement (WSCG 2003): polygons are drawn into a
 * G-buffer (normal, linear distance, group per pixel), discontinuities of the G-buffer make the
 * edge map, and shading and edge map are put together. docs/edge-map.md tells what is as printed
 * and what goes beyond. Every kind of shading works with every kind of line: the edge map, emergent
 * lines, both or none. */
#ifndef DRYPOINT_SHADE_H
#define DRYPOINT_SHADE_H

#include <drypoint/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 0xRRGGBBAA. 0 stands for the default of where it is used. */
typedef uint32_t dp_color;

typedef enum dp_shading {
    DP_SHADING_FLAT = 0, /* the surface's colour, without light */
    DP_SHADING_PAPER,    /* the paper's colour; hides what is behind */
    DP_SHADING_LAMBERT,  /* the colour times a half plus half of N·L */
    DP_SHADING_GOOCH,    /* cool to warm (Gooch et al. 1998) */
    DP_SHADING_TOON,     /* N·L looks up a row of shades (Lake et al. 2000) */
    DP_SHADING_HATCH,    /* strokes by priority, smooth threshold (Freudenberg et al. 2002) */
    DP_SHADING_HALFTONE, /* the same with dots */
    DP_SHADING_PENCIL,   /* strokes along the least curvature (Hermosilla and Vázquez 2010, 2.4) */
    DP_SHADING_COUNT
} dp_shading;

/* "flat", "paper", … */
DP_API const char *dp_shading_name(dp_shading shading);

/* Which normals are shaded and looked at by the edge map. */
typedef enum dp_normals {
    DP_NORMALS_MODEL = 0, /* the model's; made where it has none */
    DP_NORMALS_SMOOTH,    /* made: angle-weighted means within the crease angle */
    DP_NORMALS_FACET      /* those of the polygons */
} dp_normals;

/* A picture of one channel; borrowed. */
typedef struct dp_image {
    const uint8_t
        *values; /* [height][width], or [height][width][4] of shades; NULL: the built-in one */
    uint32_t width, height;
} dp_image;

/* How surfaces are shaded. Zero is the default: flat. */
typedef struct dp_shade {
    dp_shading shading;
    float light[3];    /* towards the light, camera space: x right, y up, z towards the eye; any
                          length;    {0} means (-0.5, 0.7, 0.6). It stands still beside the camera. */
    bool model_colors; /* surfaces have the colours that the source gives their groups, where it
                          does */
    dp_normals normals;
    float crease_angle; /* degrees, up to 180: folds up to this are smoothed where normals are made;
                           0 means 40 */

    /* Gooch: k_cool = blue + alpha k_d, k_warm = yellow + beta k_d, k_d the surface's colour */
    bool gooch_plain;               /* without the surface's colour: k_d = 0.5, grey */
    float gooch_blue, gooch_yellow; /* 0 means 0.4, 0.4 */
    float gooch_alpha, gooch_beta;  /* 0 means 0.2, 0.6 */
    float highlight; /* strength of Phong's highlight (Gooch, Lambert, toon); 0: none */

    dp_image shades; /* toon: [width][4] RGBA from dark (N·L = -1) to light, height 1; each is
                        multiplied by the surface's colour. Default: 4 shades of grey */
    bool nearest;    /* toon: no cartoon map; shades meet in jaggies */

    dp_image strokes;  /* hatch and halftone: priorities, tiled in both directions: a texel is inked
                          where  the tone (0 black, 255 white) is below it */
    bool object_space; /* hatch, halftone: strokes stick to the surface: by texture coordinates
                          where the model has them, along the three axes where not. Default: to the
                          screen */
    float stroke_scale; /* 0 means 1; 2: twice as large */
    dp_color ink;       /* of strokes and dots; 0 means black */

    /* pencil: brightness ^ ((1 - max(N·L, 0)) S + O); `strokes` then is brightness, 255 the
     * paper */
    float pencil_s, pencil_o; /* 0 means 2.6 and 0.12; negative: 0 */
    uint32_t pencil_tones;    /* 2 to 8: that many textures, from bare to dark, instead of the power
                                 (Lee et al. 2006) */
    bool pencil_printed; /* turn the texture by every exact angle, as printed: strokes break on fine
                            meshes */
} dp_shade;

typedef enum dp_edge_detector {
    DP_EDGE_MAP_OFF = 0,
    DP_EDGE_MAP_DIAGONAL, /* four diagonal neighbours; 4.1.2, first variant */
    DP_EDGE_MAP_C1        /* eight neighbours' depths in three accumulating passes; second variant.
                          Inner edges are those of the first */
} dp_edge_detector;

/* The edge map: inner edges from normals, profile edges from distance (and groups). */
typedef struct dp_edge_map {
    dp_edge_detector detector;
    bool as_printed;    /* the paper's differences: of distance between near and far, which fit the
                           enhanced groups; no thresholds of their own. Default: the difference beyond
                           what the    surface's slope explains, in pixel sizes, so that neither
                           distance    nor    grazing surfaces make false edges */
    bool eight_bits;    /* keep the G-buffer in 8 bits per channel, as the paper does */
    uint32_t c1_passes; /* C1: how many of its three passes, to look at them; 0 means all */
    uint32_t radius;    /* px from the pixel to the samples that are compared, 1 to 4; 0 means 1 */
    float inner_angle; /* degrees between neighbours' normals at which an inner edge begins; 0 means
                          24 */
    float inner_softness; /* how much of the scale 1 - I_N (0 to 2) from faint to full; 0 means 0.25
                           */
    float profile_depth; /* pixel sizes at which a difference of distance counts whole; 0 means 6 */
    float profile_softness; /* how much of the scale 1 - I_Z (0 to 1) from faint to full; 0 means
                               0.5 */
    bool no_groups;         /* do not draw profile edges where groups meet */
    bool far_side; /* profile edges on the further side of a step as well, as printed; default: only
                      on the nearer, whose outline is anti-aliased */
    dp_color inner, profile; /* 0 means black */
    bool hidden;             /* make the map (dp_target.edge_map), but do not draw it */
    const uint8_t
        *enhanced; /* [enhanced_count] by group: 0: not enhanced; NULL: all are. Borrowed */
    uint32_t enhanced_count; /* groups beyond are not enhanced */
} dp_edge_map;

/* A planar mirror: a square in the plane n·p = offset, in which the scene is drawn again,
 * reflected, with all its lines and shades (section 5). It reflects on the side that the eye is on;
 * polygons behind it have no image. Zero is none. It is drawn as one more polygon, of group
 * DP_MIRROR_GROUP. */
typedef struct dp_mirror {
    float normal[3];  /* of any length, not zero; the plane is that of the unit normal */
    float offset;     /* world units along the unit normal */
    float center[3];  /* of the square; moved into the plane */
    float size;       /* side of the square, world units; 0: there is no mirror */
    dp_color tint;    /* 0 means none, white */
    float tint_share; /* how much of what is seen is the tint, 0 to 1 */
    float fade;       /* images of points this far from the plane have faded away; 0: none fade */
} dp_mirror;

#define DP_MIRROR_GROUP 65534u

#ifdef __cplusplus
}
#endif
#endif
