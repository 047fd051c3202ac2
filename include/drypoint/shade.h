/* drypoint/shade.h: how surfaces are shaded, the edge map, and mirrors.
 *
 * All three follow Nienhaus and Döllner, Edge-Enhancement (WSCG 2003):
 *
 *     polygons  -> G-buffer: normal, linear distance and group of each pixel
 *     G-buffer  -> edge map: its discontinuities
 *     G-buffer  -> shades
 *     picture   =  shades, then edge map, then lines
 *
 * docs/edge-map.md says what is as printed and what goes beyond. Every kind of shading works with
 * the edge map, with lines, with both and with neither. */
#ifndef DRYPOINT_SHADE_H
#define DRYPOINT_SHADE_H

#include <drypoint/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 0xRRGGBBAA; 0 means the default, which each member states. */
typedef uint32_t dp_color;

typedef enum dp_shading {
    DP_SHADING_FLAT = 0, /* the surface's colour, without light */
    DP_SHADING_PAPER,    /* the paper's colour; hides what is behind */
    DP_SHADING_LAMBERT,  /* the colour times 0.3 + 0.7 max(N·L, 0) */
    DP_SHADING_GOOCH,    /* cool to warm (Gooch et al. 1998) */
    DP_SHADING_TOON,     /* N·L indexes a row of shades (Lake et al. 2000) */
    DP_SHADING_HATCH,    /* prioritized strokes, smooth threshold (Freudenberg et al. 2002) */
    DP_SHADING_HALFTONE, /* the same with dots */
    DP_SHADING_PENCIL,   /* strokes along minimal curvature (Hermosilla and Vázquez 2010, 2.4) */
    DP_SHADING_COUNT
} dp_shading;

/* "flat", "paper", … */
DP_API const char *dp_shading_name(dp_shading shading);

/* Which normals the shading and the edge map use. */
typedef enum dp_normals {
    DP_NORMALS_MODEL = 0, /* the model's; computed (as SMOOTH) where it has none */
    DP_NORMALS_SMOOTH,    /* computed: angle-weighted means within the crease angle */
    DP_NORMALS_FACET      /* the polygons' */
} dp_normals;

/* An image; borrowed. */
typedef struct dp_image {
    /* [height][width] of one channel; dp_shade.shades: [height][width][4] RGBA.
     * NULL: the built-in image. */
    const uint8_t *values;
    uint32_t width, height;
} dp_image;

/* How surfaces are shaded. Zero is the default: flat. */
typedef struct dp_shade {
    dp_shading shading;

    /* Towards the light, camera space (x right, y up, z towards the eye), any length; fixed to the
     * camera. {0} means (-0.5, 0.7, 0.6). */
    float light[3];
    bool model_colors; /* use the colours that the source gives its vertices, else its groups */
    dp_normals normals;
    float crease_angle; /* degrees, up to 180; 0 means 40. Computed normals are smooth across
                           edges that bend by no more than this */

    /* Gooch: k_cool = blue + alpha k_d, k_warm = yellow + beta k_d, with k_d the surface's
     * colour (Gooch et al. 1998). */
    bool gooch_plain;               /* k_d = 0.5 (grey) instead */
    float gooch_blue, gooch_yellow; /* 0 means 0.4, 0.4 */
    float gooch_alpha, gooch_beta;  /* 0 means 0.2, 0.6 */

    /* Gooch, Lambert, toon. */
    float highlight; /* strength of Phong's highlight; 0: none */

    /* Toon: [width][4] RGBA, height 1, from dark (N·L = -1) to light (N·L = 1); each is multiplied
     * by the surface's colour. Default: 4 shades of grey. */
    dp_image shades;
    bool nearest; /* no cartoon map: the borders between shades are jagged */

    /* Hatch and halftone: priorities, tiled in both directions. A texel is inked where the tone
     * (0 black, 255 white) is below it. Pencil: brightness, 255 = paper. */
    dp_image strokes;
    bool object_space;  /* hatch, halftone: strokes stick to the surface, by texture coordinates
                          or, without any, along the three axes. Default: to the screen */
    float stroke_scale; /* 0 means 1; 2: twice as large */
    dp_color ink;       /* of strokes, dots and graphite, over the surface by its alpha; 0 means
                          black */

    /* Pencil: brightness ^ ((1 - max(N·L, 0)) S + O) (Hermosilla and Vázquez 2010, 2.4.3). */
    float pencil_s, pencil_o; /* 0 means 2.6, 0.12; negative means 0 */
    uint32_t pencil_tones;    /* 2 to 8: that many textures, from light to dark, instead of the
                                 power (Lee et al. 2006); 0: the power */
    bool pencil_printed;      /* turn the texture by every exact angle, as printed; strokes break
                                 up on fine meshes */
} dp_shade;

/* Nienhaus and Döllner 2003, 4.1.2. */
typedef enum dp_edge_detector {
    DP_EDGE_MAP_OFF = 0,
    DP_EDGE_MAP_DIAGONAL, /* first variant: four diagonal neighbours */
    DP_EDGE_MAP_C1        /* second variant: depths of eight neighbours, accumulated in three
                             passes; inner edges as in the first variant */
} dp_edge_detector;

/* The edge map: inner edges from normals (I_N), profile edges from distance (I_Z) and groups.
 * Zero is the default: off. */
typedef struct dp_edge_map {
    dp_edge_detector detector;

    /* Take the paper's differences, of distance scaled between the enhanced groups' near and far,
     * without thresholds. Default: the difference beyond what the surface's slope explains, in
     * pixel sizes, so that neither distance nor a grazing view makes false edges. */
    bool as_printed;
    bool eight_bits;    /* store the G-buffer in 8 bits per channel, as the paper does */
    uint32_t c1_passes; /* C1: how many of the three passes to run, to look at them; 0 means 3 */
    uint32_t radius;    /* px from the pixel to the samples compared, 1 to 4; 0 means 1 */

    float inner_angle;      /* degrees between neighbours' normals where an inner edge begins;
                               0 means 24 */
    float inner_softness;   /* range of 1 - I_N (0 to 2) from faint to full; 0 means 0.25 */
    float profile_depth;    /* pixel sizes: a difference of distance that counts whole; 0 means 6 */
    float profile_softness; /* range of 1 - I_Z (0 to 1) from faint to full; 0 means 0.5 */
    bool no_groups;         /* no profile edges where groups meet */
    bool far_side;          /* profile edges on the far side of a step too, as printed. Default:
                               only on the near side, whose outline is anti-aliased */
    dp_color inner, profile; /* 0 means black */
    bool hidden;             /* make the map (dp_target.edge_map), but do not draw it */

    /* [enhanced_count], by group: 0: not enhanced. Borrowed. NULL: all groups are enhanced; groups
     * from enhanced_count on are not. */
    const uint8_t *enhanced;
    uint32_t enhanced_count;
} dp_edge_map;

/* A planar mirror: a square in the plane n·p = offset, in which the scene is drawn again,
 * reflected, with all its lines and shades (Nienhaus and Döllner 2003, 5). It reflects on the side
 * that the eye is on; polygons behind it have no image. It is drawn as one more polygon, of group
 * DP_MIRROR_GROUP. Zero is the default: no mirror. */
typedef struct dp_mirror {
    double normal[3]; /* any length but zero; the plane is that of the unit normal */
    double offset;    /* world units along the unit normal */
    double center[3]; /* of the square, world space; moved into the plane */
    float size;       /* side of the square, world units; 0: no mirror */
    dp_color tint;    /* 0 means white */
    float tint_share; /* share of the tint in what is seen, 0 to 1 */
    float fade;       /* world units from the plane at which images have faded; 0: none fade */
} dp_mirror;

#define DP_MIRROR_GROUP 65534u

#ifdef __cplusplus
}
#endif
#endif
