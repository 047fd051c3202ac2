/* What of a style is drawn by OpenGL: the rest is named, and refused.
 *
 * Rules are data: one row a member. docs/opengl.md has the same table for people. */
#include "gl/scene.h"

/* Does the style give strokes a texture or a hand, and are there strokes? */
static bool has_stylized_strokes(const dp_style *style) {
    const dp_stroke_style *const s = &style->stroke;
    const uint32_t creases = DP_RIDGE | DP_VALLEY | DP_INTERSECTION,
                   outlines = DP_SILHOUETTE | DP_BORDER;
    const bool by_adjacency = style->edges == DP_EDGES_ADJACENCY;
    const uint32_t strokes = style->ink == DP_INK_STROKES ? creases | outlines
                             : by_adjacency               ? creases
                                                          : 0;
    return style->lines & strokes &&
           (s->texture || s->taper > 0 || s->jitter > 0 || s->overshoot > 0 || s->depth > 0 ||
            s->light > 0 || s->repeats > 1);
}

dp_result dp_gl_check_style(const dp_gl *gl, const dp_style *style, dp_diag *diag) {
    (void)gl;
    const struct {
        bool asked;
        const char *what;
    } rules[] = {
        {style->edges == DP_EDGES_ADJACENCY && style->ink == DP_INK_QUADS &&
             style->method == DP_METHOD_EXACT,
         "silhouettes as geometry beside their visible chains (method exact), but as printed or as "
         "strokes"},
        {has_stylized_strokes(style), "stylized strokes (texture, taper, jitter, overshoot, depth, "
                                      "light, repeats), but textured "
                                      "silhouettes and borders alone, by adjacency, as printed"},
        {style->hidden.look != DP_HIDDEN_NONE, "hidden lines"},
        {style->xray > 0 && style->xray < 1, "x-rays"},
        {style->detail > 0, "a detail of lines other than exact"},
        {style->smooth != DP_SMOOTH_OFF, "smooth models"},
        {style->exact_ends, "exact ends"},
        {style->pattern.texture != NULL, "patterns on lines"},
        {style->line_light.lighting != DP_LINE_LIGHT_OFF, "light on lines"},
    };
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].asked)
            return dp_fail(diag, DP_ERR_UNSUPPORTED, "OpenGL does not draw %s; dp_draw does",
                           rules[i].what);
    return DP_OK;
}
