/* --stroke and related options: from settings to a texture and a stroke style. */
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

/* px; a length of 0 is none, whatever the stroke's kind has. */
static void put_length(const page_plan *plan, const tool_length *given, float *to) {
    if (given->unit) *to = fmaxf(page_length(plan, given), 0);
}

int make_stroke(const tool_settings *s, const page_plan *plan, dp_style *style,
                dp_texture **texture) {
    *texture = NULL;
    const int code = s->stroke ? load(s, style, texture) : 0;
    if (code) return code;
    dp_stroke_style *const stroke = &style->stroke;
    const bool fins = style->edges == DP_EDGES_ADJACENCY && style->ink == DP_INK_QUADS;
    stroke->texture = *texture;
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
