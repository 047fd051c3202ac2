/* --stroke, --pattern and related options: from settings to a texture and a stroke style, a pattern,
 * and light on lines. */
#include "commands.h"
#include "page.h"
#include "report.h"

#include <drypoint/io.h>

#include <math.h>
#include <string.h>

static bool is_known(const char *name) {
    for (uint32_t i = 0; i < dp_texture_count(); i++)
        if (!strcmp(name, dp_texture_name(i))) return true;
    return false;
}

static int unknown(const char *to, const char *name) {
    char known[256] = "";
    for (uint32_t i = 0; i < dp_texture_count(); i++)
        strcat(strcat(known, i ? ", " : ""), dp_texture_name(i));
    wrong_usage("--%s: \"%s\" is neither a PNG file nor one of %s", to, name, known);
    return EXIT_USAGE;
}

/* Loads a texture by name, or from a PNG file. */
static int load(const tool_settings *s, const char *to, const char *name, dp_texture **texture) {
    dp_diag diag = {0};
    if (is_known(name))
        return dp_texture_named(name, s->seed, NULL, texture, &diag) ? report_failure(NULL, &diag)
                                                                     : 0;
    if (!strpbrk(name, "./")) return unknown(to, name);
    return dp_io_read_texture(name, NULL, texture, &diag) ? report_failure(name, &diag) : 0;
}

/* A pattern takes the place of a preset's strokes; of them it keeps the hand's errors. */
static int load_either(const tool_settings *s, dp_style *style, dp_texture **texture) {
    if (s->pattern) return load(s, "pattern", s->pattern, texture);
    if (s->stroke && is_known(s->stroke)) dp_stroke_look(s->stroke, &style->stroke, NULL);
    return s->stroke ? load(s, "stroke", s->stroke, texture) : 0;
}

/* px; a length of 0 is none, whatever the stroke's kind has. */
static void put_length(const page_plan *plan, const tool_length *given, float *to) {
    if (given->unit) *to = fmaxf(page_length(plan, given), 0);
}

static void set_pattern(const tool_settings *s, const page_plan *plan, const dp_texture *texture,
                        dp_style *style) {
    style->pattern.texture = texture;
    put_length(plan, &s->pattern_length, &style->pattern.length);
    style->pattern.world_length = (float)s->pattern_units;
    style->pattern.screen = s->pattern_space == PATTERN_SCREEN;
}

int make_stroke(const tool_settings *s, const page_plan *plan, dp_style *style,
                dp_texture **texture) {
    *texture = NULL;
    const int code = load_either(s, style, texture);
    if (code) return code;
    if (s->line_light) style->line_light.lighting = (dp_line_lighting)(s->line_light - 1);
    style->line_light.lit = s->lit_color;
    if (s->pattern) set_pattern(s, plan, *texture, style);
    dp_stroke_style *const stroke = &style->stroke;
    const bool fins = style->edges == DP_EDGES_ADJACENCY && style->ink == DP_INK_QUADS;
    stroke->texture = s->pattern ? NULL : *texture;
    stroke->u =
        (s->stroke_u ? s->stroke_u == STROKE_POLAR : fins) ? DP_STROKE_POLAR : DP_STROKE_ARC;
    if (s->has_stroke_k) stroke->k = s->stroke_k == 0 ? -1e-9f : (float)s->stroke_k;
    put_length(plan, &s->taper, &stroke->taper);
    put_length(plan, &s->jitter, &stroke->jitter);
    put_length(plan, &s->overshoot, &stroke->overshoot);
    if (s->repeats) stroke->repeats = s->repeats;
    stroke->scale = (float)s->stroke_scale;
    stroke->depth = (float)s->width_by_depth;
    stroke->light = (float)s->width_by_light;
    stroke->seed = s->seed;
    return 0;
}
