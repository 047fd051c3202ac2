/* The operators on runs of pixels at the width DP_LANES; compiled once for each width
 * (CMakeLists.txt). They work in whole vectors: what they write beyond a run's end is not used. */
#include "shade/shade.h"

#include "base/vec.h"
#include "base/lanes.h"

/* x of pixel centres from column `first` on, px. */
DP_LANES_INLINE dp_lf columns(uint32_t first) {
    return l_splat((float)(int32_t)first) + l_steps() + l_splat(0.5f);
}

/* Pixels that show a surface. */
DP_LANES_INLINE dp_lm are_surface(const dp_shade_run *run, uint32_t i) {
    float shows[DP_LANES];
    for (uint32_t l = 0; l < DP_LANES; l++) shows[l] = run->id[i + l] ? 1.0f : 0.0f;
    return l_gt(l_load(shows), l_splat(0));
}

#include "shade/lambert.inc"

#include "shade/gooch.inc"
#include "shade/hatch.inc"
#include "shade/toon.inc"

#include "shade/cartoon.inc"

/* Sets all pixels to one colour. */
static void paint(const float rgba[4], dp_shade_run *run) {
    for (uint32_t i = 0; i < run->n; i += DP_LANES) {
        for (int k = 0; k < 3; k++) l_store(run->color[k] + i, l_splat(rgba[k]));
        l_store(run->alpha + i, l_splat(rgba[3]));
    }
}

DP_LANES_INLINE dp_lu to_byte(dp_lf v) {
    return (dp_lu)l_truncate(l_min(l_max(v, l_splat(0)), l_splat(1)) * l_splat(255) +
                             l_splat(0.5f));
}

/* To pixels of four bytes: red, green, blue, alpha. */
static void pack(const dp_shade_run *run, uint32_t *words) {
    enum {
        BIG = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__,
        R = BIG ? 24 : 0,
        G = BIG ? 16 : 8,
        B = BIG ? 8 : 16,
        A = BIG ? 0 : 24
    };
    for (uint32_t i = 0; i < run->n; i += DP_LANES) {
        const dp_lu word =
            to_byte(l_load(run->color[0] + i)) << R | to_byte(l_load(run->color[1] + i)) << G |
            to_byte(l_load(run->color[2] + i)) << B | to_byte(l_load(run->alpha + i)) << A;
        li_store(words + i, (dp_li)word);
    }
}

const dp_shaders DP_KERNEL_TABLE(dp_shaders) = {
    .lanes = DP_LANES,
    .styles = {[DP_SHADING_LAMBERT] = lambert,
               [DP_SHADING_GOOCH] = gooch,
               [DP_SHADING_TOON] = toon,
               [DP_SHADING_HATCH] = hatch,
               [DP_SHADING_HALFTONE] = hatch},
    .highlight = highlight,
    .paint = paint,
    .pack = pack,
    .smooth = smooth,
};

#include "shade/pencil_rows.inc"
