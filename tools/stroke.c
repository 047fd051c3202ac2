/* --stroke and related options: from settings to a texture and a stroke style. */
#include "commands.h"
#include "report.h"

#include <drypoint/io.h>

#include <string.h>

static bool is_known(const char *name) {
    for (uint32_t i = 0; i < dp_texture_count(); i++)
        if (!strcmp(name, dp_texture_name(i))) return true;
    return false;
}

static int unknown(const char *name) {
    char known[160] = "";
    for (uint32_t i = 0; i < dp_texture_count(); i++)
        strcat(strcat(known, i ? ", " : ""), dp_texture_name(i));
    wrong_usage("--stroke: \"%s\" is neither a PNG file nor one of %s", name, known);
    return EXIT_USAGE;
}

static int load(const tool_settings *s, dp_style *style, dp_texture **texture) {
    dp_diag diag = {0};
    if (is_known(s->stroke)) {
        dp_stroke_look(s->stroke, &style->stroke, NULL);
        return dp_texture_named(s->stroke, s->seed, NULL, texture, &diag)
                   ? report_failure(NULL, &diag)
                   : 0;
    }
    if (!strpbrk(s->stroke, "./")) return unknown(s->stroke);
    return dp_io_read_texture(s->stroke, NULL, texture, &diag) ? report_failure(s->stroke, &diag)
                                                               : 0;
}

int make_stroke(const tool_settings *s, dp_style *style, dp_texture **texture) {
    *texture = NULL;
    const int code = s->stroke ? load(s, style, texture) : 0;
    if (code) return code;
    dp_stroke_style *const stroke = &style->stroke;
    const bool fins = style->edges == DP_EDGES_ADJACENCY && style->ink == DP_INK_QUADS;
    stroke->texture = *texture;
    stroke->u =
        (s->stroke_u ? s->stroke_u == STROKE_POLAR : fins) ? DP_STROKE_POLAR : DP_STROKE_ARC;
    if (s->has_stroke_k) stroke->k = s->stroke_k == 0 ? -1e-9f : (float)s->stroke_k;
    if (s->has_taper) stroke->taper = (float)s->taper;
    if (s->has_jitter) stroke->jitter = (float)s->jitter;
    if (s->has_overshoot) stroke->overshoot = (float)s->overshoot;
    if (s->repeats) stroke->repeats = s->repeats;
    stroke->scale = (float)s->stroke_scale;
    stroke->depth = (float)s->width_by_depth;
    stroke->light = (float)s->width_by_light;
    stroke->seed = s->seed;
    return 0;
}

/* No option is ignored without a message. */
void warn_strokeless(const tool_settings *s, const dp_style *style) {
    const bool asked = s->stroke || s->taper > 0 || s->jitter > 0 || s->overshoot > 0 ||
                       s->repeats > 1 || s->width_by_depth > 0 || s->width_by_light > 0;
    if (!asked) return;
    if (s->edges == EDGES_MAP)
        warn("an edge map is of pixels and has no strokes: --edges both draws lines with them as "
             "well");
    else if (style->ink == DP_INK_QUADS && style->edges != DP_EDGES_ADJACENCY)
        warn(
            "with --ink quads lines are plain: leave it out for strokes, or add --edges adjacency");
}
