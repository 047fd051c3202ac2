/* Lengths in pixels, and the widths of lines: what the settings say, or what suits the picture.
 *
 * Two weights, as technical illustrators have them: a line is wide where the surface ends on one side
 * of it (silhouettes, borders, sections), and narrow where surfaces are seen on both (ridges, valleys,
 * intersections); hatching is narrow everywhere.
 *
 *     a picture        shares of its smaller side, so that a thumbnail and a poster look alike
 *     a page           0.5 and 0.25 mm: line group 0.5 of ISO 128-2
 *     --width W        W, and W / 2 for hatching, which is a tone: as wide as outlines it would be black
 *     a sheet          0.5 mm: in drawings by ISO 128-2 outlines and edges are wide lines, and hidden
 *                      ones narrow
 *
 * Hidden lines are all narrow, so that their dashes are alike; `thin` ones half as wide again, to be
 * told from creases. Where a class has a width of its own, they are half as wide (drypoint/style.h). */
#include "objects.h"
#include "page.h"
#include "report.h"

#include <math.h>

static const double thinnest = 0.5, thickest = 64; /* px */

/* Weights of classes that have no width of their own. */
typedef struct weights {
    double wide, narrow;             /* shares of the picture's smaller side */
    double least_wide, least_narrow; /* px: less is hard to see, and both look the same */
    double page_wide, page_narrow;   /* mm */
    double sheet;                    /* mm */
} weights;
static const weights usual = {1 / 400.0, 1 / 800.0, 1.1, 0.65, 0.5, 0.25, 0.5};

static bool is_wide(int line) {
    return line == DP_LINE_SILHOUETTE || line == DP_LINE_BORDER || line == DP_LINE_SECTION;
}

/* px */
static double smaller_side(const page_plan *plan) { return fmin(plan->width, plan->height); }

float page_length(const page_plan *plan, const tool_length *length) {
    if (length->unit == LENGTH_NONE) return 0;
    if (!(length->value > 0)) return -1;
    const double value = length->halved ? length->value / 2 : length->value;
    return (float)(length->unit == LENGTH_MM      ? value / plan->mm_per_px
                   : length->unit == LENGTH_SHARE ? value * smaller_side(plan)
                                                  : value);
}

/* px, of a class whose width is not given. */
static double usual_width(const tool_settings *s, const page_plan *plan, int line) {
    const weights *const w = &usual;
    const bool wide = is_wide(line);
    if (s->sheet.count)
        return (line == DP_LINE_HATCHING ? w->page_narrow : w->sheet) / plan->mm_per_px;
    if (plan->paged) return (wide ? w->page_wide : w->page_narrow) / plan->mm_per_px;
    const double side = smaller_side(plan);
    return wide ? fmax(w->wide * side, w->least_wide) : fmax(w->narrow * side, w->least_narrow);
}

/* px, of the hidden lines of a class; 0: what follows from the visible ones. */
static double hidden_width(const tool_settings *s, const page_plan *plan, dp_hidden_look look,
                           int line) {
    if (s->width_of[line].unit || look == DP_HIDDEN_SOLID || s->sheet.count) return 0;
    const double narrow = usual_width(s, plan, DP_LINE_RIDGE);
    return fmin(fmax(look == DP_HIDDEN_THIN ? 0.5 * narrow : narrow, thinnest), thickest);
}

static double width_of(const tool_settings *s, const page_plan *plan, int line) {
    const double given = (double)page_length(plan, &s->width_of[line]);
    return fmax(given > 0 ? given : fmin(usual_width(s, plan, line), thickest), thinnest);
}

/* px */
static double widest_of(const tool_settings *s, const page_plan *plan) {
    double widest = 0;
    for (int k = 0; k < DP_LINE_COUNT; k++) widest = fmax(widest, width_of(s, plan, k));
    return widest;
}

double page_widest(const tool_settings *s, const page_plan *plan) {
    double widest = widest_of(s, plan);
    for (uint32_t k = 0; k < s->objects.count; k++) {
        tool_settings own = *s;
        (void)object_apply(s->objects.items[k], &own);
        widest = fmax(widest, widest_of(&own, plan));
    }
    return widest * plan->mm_per_px;
}

/* Which limits widths have met. */
typedef struct limits {
    bool thin, thick;
} limits;

/* Stores a width, and notes whether it had to be changed. A share of a large picture is made smaller;
 * a length on paper cannot be. */
static bool put_width(const page_plan *plan, double px, const tool_length *given, float *to,
                      limits *met) {
    const bool shared = given->unit == LENGTH_SHARE;
    met->thin |=
        given->unit == LENGTH_MM && !given->halved && px > (double)page_length(plan, given) + 1e-3;
    met->thick |= shared && px > thickest;
    *to = (float)(shared ? fmin(px, thickest) : px);
    return (double)*to <= thickest ||
           wrong_usage("--width: %g mm are %.0f pixels at %.0f dpi, and %.0f are the most; give a "
                       "smaller --dpi",
                       px * plan->mm_per_px, px, 25.4 / plan->mm_per_px, thickest);
}

static void warn_limits(const page_plan *plan, const limits *met) {
    if (met->thin)
        warn("--width: lines are at least half a pixel wide, %.3g mm at %.0f dpi; give a larger "
             "--dpi for finer ones",
             thinnest * plan->mm_per_px, 25.4 / plan->mm_per_px);
    if (met->thick)
        warn("--width: lines are at most %.0f pixels wide, %.2g%% of %.0f; draw a smaller picture "
             "for bolder ones",
             thickest, 100 * thickest / smaller_side(plan), smaller_side(plan));
}

bool page_widths(const tool_settings *s, const page_plan *plan, dp_style *style) {
    limits met = {false, false};
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        if (!put_width(plan, width_of(s, plan, k), &s->width_of[k], &style->line[k].width, &met))
            return false;
        for (int level = 0; level < DP_LEVELS; level++) {
            const tool_length *const given = &s->hidden_width[level][k];
            const double px = fmax((double)page_length(plan, given), thinnest);
            float *const to = &style->hidden.line[level][k].width;
            *to = (float)hidden_width(s, plan, style->hidden.look, k);
            if (given->unit && !put_width(plan, px, given, to, &met)) return false;
        }
    }
    if (!s->quiet) warn_limits(plan, &met);
    return true;
}
