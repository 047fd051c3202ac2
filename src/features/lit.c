/* Light on lines: a colour by N·L.
 *
 *     Lambert    c + t (lit - c)             t = max(N·L, 0)
 *     toon       the same                    t = 0, 1/2, 1, by thirds of (1 + N·L) / 2
 *     Gooch      t warm + (1 - t) cool       t = (1 + N·L) / 2, cool and warm as in shade/gooch.inc
 *
 * t is taken in steps of 1/32, so that neighbours in nearly the same light have one colour: they stay
 * one path of a vector file, and plain ink is united by colours. */
#include "features/lit.h"

enum { STEPS = 32 };

dp_vec3 dp_light_direction(const dp_view *view, const dp_style *style) {
    const dp_vec3 back = dp_scale(view->forward, -1);
    const dp_vec3 across = dp_sub(view->across, dp_scale(back, dp_dot(view->across, back)));
    const dp_vec3 down = dp_sub(view->down, dp_scale(back, dp_dot(view->down, back)));
    const float *const l = style->shade.light;
    return dp_unit(
        dp_mad(dp_mad(dp_scale(dp_unit(across), (double)l[0]), dp_unit(down), -(double)l[1]), back,
               (double)l[2]));
}

static double channel(dp_color c, int k) { return (double)(c >> (24 - 8 * k) & 0xff); }

static dp_color color_of(const double rgb[3], dp_color alpha) {
    uint32_t c[3];
    for (int k = 0; k < 3; k++) c[k] = (uint32_t)(dp_min(dp_max(rgb[k], 0), 255) + 0.5);
    return c[0] << 24 | c[1] << 16 | c[2] << 8 | (alpha & 0xff);
}

static dp_color mixed(const dp_style *style, dp_color c, double t) {
    const dp_color given = style->line_light.lit, lit = given ? given : style->paper;
    const double share = t * (given ? channel(given, 3) / 255 : 0.8);
    double rgb[3];
    for (int k = 0; k < 3; k++) rgb[k] = channel(c, k) + share * (channel(lit, k) - channel(c, k));
    return color_of(rgb, c);
}

static dp_color gooch(const dp_shade *s, dp_color c, double t) {
    const double blue = (double)s->gooch_blue, yellow = (double)s->gooch_yellow;
    const double cool[3] = {0, 0, blue}, warm[3] = {yellow, yellow, 0};
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        const double own = channel(c, k) / 255, from = cool[k] + (double)s->gooch_alpha * own,
                     to = warm[k] + (double)s->gooch_beta * own;
        rgb[k] = 255 * (from + (to - from) * t);
    }
    return color_of(rgb, c);
}

dp_color dp_lit_color(const dp_style *style, dp_color color, double cosine) {
    const double half = dp_min(dp_max(0.5 + 0.5 * cosine, 0), 1);
    switch (style->line_light.lighting) {
    case DP_LINE_LIGHT_LAMBERT:
        return mixed(style, color, floor(dp_max(2 * half - 1, 0) * STEPS + 0.5) / STEPS);
    case DP_LINE_LIGHT_TOON:
        return mixed(style, color, half >= 2.0 / 3 ? 1 : half >= 1.0 / 3 ? 0.5 : 0);
    case DP_LINE_LIGHT_GOOCH:
        return gooch(&style->shade, color, floor(half * STEPS + 0.5) / STEPS);
    default:
        return color;
    }
}
