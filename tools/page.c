/* Plans pages.
 *
 *     given             the picture                          its camera
 *     nothing           --size                               as tools/view.c says
 *     --page            what the margins leave of the page   the same; orthographic with --scale
 *     --scale           as large as the drawing              orthographic
 *     --scale, --size   --size                               orthographic
 *     --sheet           tools/sheet.c
 *
 * All is in whole pixels of 25.4 mm / --dpi, so that PNGs and vectors have the same lines in the
 * same places. On a page the drawing reaches from margin to margin, or has its --scale, and lies in
 * the middle, unless --eye and --target say otherwise. */
#include "page.h"
#include "commands.h"
#include "report.h"
#include "sheet.h"
#include "view_box.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PIXELS_MOST = 32768 };

static const double usual_margins[4] = {10, 10, 10, 10}; /* mm */

/* ---- scales ---- */

double page_scale(const tool_settings *s, double scale) {
    static const double mm[] = {1, 1, 10, 1000, 25.4, 304.8}; /* by word of --unit */
    return scale * mm[s->unit];
}

static double tens(int power) {
    double product = 1;
    while (power-- > 0) product *= 10;
    return product;
}

double page_standard_scale(bool (*fits)(const void *user, double scale), const void *user) {
    static const double steps[] = {5, 2, 1};
    for (int power = 6; power >= -9; power--)
        for (int k = 0; k < 3; k++) {
            /* 500:1, 200:1, 100:1, … 1:1, and then, with power -1, 1:1, 1:2, 1:5 */
            const double scale =
                power < 0 ? 1 / (steps[2 - k] * tens(-1 - power)) : steps[k] * tens(power);
            if (fits(user, scale)) return scale;
        }
    return 0;
}

void page_scale_text(double scale, char text[32]) {
    if (scale >= 1)
        snprintf(text, 32, "%.10g:1", scale);
    else
        snprintf(text, 32, "1:%.10g", 1 / scale);
}

/* ---- what lies on the page ---- */

void page_rule(page_plan *plan, double x0, double y0, double x1, double y1, double width) {
    if (plan->rule_count < RULES_MOST)
        plan->rules[plan->rule_count++] = (dp_page_rule){x0, y0, x1, y1, width};
}

void page_text(page_plan *plan, double x, double y, double height, const char *text) {
    if (plan->text_count == TEXTS_MOST) return;
    char *const copy = plan->text[plan->text_count];
    snprintf(copy, TEXT_BYTES, "%s", text);
    plan->texts[plan->text_count++] = (dp_page_text){copy, x, y, height};
}

int page_pixels(page_plan *plan) {
    const double width = round(plan->mm_width / plan->mm_per_px),
                 height = round(plan->mm_height / plan->mm_per_px);
    if (width >= 1 && height >= 1 && width <= PIXELS_MOST && height <= PIXELS_MOST) {
        plan->width = (uint32_t)width, plan->height = (uint32_t)height;
        return 0;
    }
    wrong_usage("at %.0f dpi %.4g x %.4g mm are %.0f x %.0f pixels, and 1 to %d are possible; give "
                "another --dpi",
                25.4 / plan->mm_per_px, plan->mm_width, plan->mm_height, width, height,
                PIXELS_MOST);
    return EXIT_USAGE;
}

dp_result page_aim(dp_camera *camera, const dp_extent *extent, const double centre[2],
                   double height, double aspect) {
    double near_z, far_z;
    camera->view[12] -= centre[0];
    camera->view[13] -= centre[1];
    dp_camera_near_far(camera, extent->min, extent->max, &near_z, &far_z);
    return dp_camera_orthographic(camera, height, aspect, near_z, far_z);
}

/* ---- one picture ---- */

typedef struct picture {
    const tool_settings *s;
    page_plan *plan;
    page_view *view;
    bool sized;         /* the drawing has a size: by --scale, or what the page allows */
    double mm_per_unit; /* then: mm on paper for one of the box's */
    view_box box;       /* of the model, in camera space */
    double left, top, mm_width, mm_height; /* of the place for it, mm */
} picture;

/* How large the drawing is on paper, mm. */
static double drawn_width(const picture *p, double mm_per_unit) {
    return view_box_width(&p->box) * mm_per_unit + page_widest(p->s, p->plan);
}
static double drawn_height(const picture *p, double mm_per_unit) {
    return view_box_height(&p->box) * mm_per_unit + page_widest(p->s, p->plan);
}

static bool fits(const void *user, double scale) {
    const picture *const p = user;
    const double mm = page_scale(p->s, scale), slack = 1e-6;
    return drawn_width(p, mm) <= p->mm_width + slack && drawn_height(p, mm) <= p->mm_height + slack;
}

static int check_fits(const picture *p) {
    const double scale = p->s->scale.paper / p->s->scale.model;
    char standard[32];
    if (fits(p, scale)) return 0;
    const double best = page_standard_scale(fits, p);
    page_scale_text(best > 0 ? best : 1, standard);
    wrong_usage(
        "at %g:%g the drawing is %.4g x %.4g mm, and the page has %.4g x %.4g mm between its "
        "margins: %s%s",
        p->s->scale.paper, p->s->scale.model, drawn_width(p, p->mm_per_unit),
        drawn_height(p, p->mm_per_unit), p->mm_width, p->mm_height,
        best > 0 ? standard : "no standard scale fits",
        best > 0 ? " is the largest standard scale that fits" : "; make them smaller");
    return EXIT_USAGE;
}

/* The view's place in whole pixels. Of a page that ends between two, the last is not its own, even
 * where rounding tells so of the view. */
static int place(picture *p) {
    const double mm = p->plan->mm_per_px;
    const double left = round(p->left / mm), top = round(p->top / mm),
                 right = fmin(round((p->left + p->mm_width) / mm), p->plan->width),
                 bottom = fmin(round((p->top + p->mm_height) / mm), p->plan->height);
    if (left >= 0 && top >= 0 && right > left && bottom > top) {
        p->view->x = (uint32_t)left, p->view->y = (uint32_t)top;
        p->view->width = (uint32_t)(right - left), p->view->height = (uint32_t)(bottom - top);
        return 0;
    }
    wrong_usage(
        "--margin: nothing is left of %.4g x %.4g mm between the margins; make them smaller",
        p->plan->mm_width, p->plan->mm_height);
    return EXIT_USAGE;
}

static void turn(const tool_settings *s, bool wide, page_plan *plan) {
    const tool_page *const page = &s->page;
    const double small = fmin(page->width, page->height), large = fmax(page->width, page->height);
    if (s->landscape || page->turn == TURN_LANDSCAPE)
        wide = true;
    else if (page->turn == TURN_PORTRAIT)
        wide = false;
    else if (page->turn == TURN_AS_IS)
        wide = page->width > page->height;
    plan->mm_width = wide ? large : small;
    plan->mm_height = wide ? small : large;
}

const double *page_margins(const tool_settings *s) {
    return s->has_margin ? s->margin : usual_margins;
}

static int lie_on_page(picture *p) {
    const double *const m = page_margins(p->s);
    turn(p->s, view_box_width(&p->box) >= view_box_height(&p->box), p->plan);
    p->left = m[MARGIN_LEFT], p->top = m[MARGIN_TOP];
    p->mm_width = p->plan->mm_width - m[MARGIN_LEFT] - m[MARGIN_RIGHT];
    p->mm_height = p->plan->mm_height - m[MARGIN_TOP] - m[MARGIN_BOTTOM];
    const int code = page_pixels(p->plan);
    return code ? code : place(p);
}

static uint32_t some_pixels(const picture *p, double mm) {
    return (uint32_t)fmin(fmax(round(mm / p->plan->mm_per_px), 1), PIXELS_MOST);
}

/* The page is as large as the drawing and its margins, in whole pixels. Widths that are shares of it
 * are, for now, of what it is without its lines. */
static int wrap_drawing(picture *p) {
    const double mm = p->plan->mm_per_px;
    double m[4];
    for (int k = 0; k < 4; k++) m[k] = mm * round(page_margins(p->s)[k] / mm);
    p->plan->width =
        some_pixels(p, m[MARGIN_LEFT] + view_box_width(&p->box) * p->mm_per_unit + m[MARGIN_RIGHT]);
    p->plan->height = some_pixels(p, m[MARGIN_TOP] + view_box_height(&p->box) * p->mm_per_unit +
                                         m[MARGIN_BOTTOM]);
    p->left = m[MARGIN_LEFT], p->top = m[MARGIN_TOP];
    p->mm_width = mm * ceil(drawn_width(p, p->mm_per_unit) / mm);
    p->mm_height = mm * ceil(drawn_height(p, p->mm_per_unit) / mm);
    p->plan->mm_width = m[MARGIN_LEFT] + p->mm_width + m[MARGIN_RIGHT];
    p->plan->mm_height = m[MARGIN_TOP] + p->mm_height + m[MARGIN_BOTTOM];
    const int code = page_pixels(p->plan);
    return code ? code : place(p);
}

static void fill_size(picture *p) {
    const dp_target target = make_target(p->s);
    p->plan->width = p->view->width = target.width;
    p->plan->height = p->view->height = target.height;
    p->mm_width = target.width * p->plan->mm_per_px;
    p->mm_height = target.height * p->plan->mm_per_px;
}

/* Looks at the model from where it will be seen. */
static int measure(picture *p, dp_source *source, const measured *model, bool *whole) {
    dp_camera *const camera = &p->view->camera;
    dp_diag diag;
    const int code = make_camera(p->s, source, model, first_aspect(p->s), camera);
    if (code) return code;
    p->box = view_box_of(camera, &model->extent);
    *whole = p->sized && !p->s->has_target;
    if (!*whole || !dp_source_rewindable(source)) return 0;
    if (view_boxes(source, camera, 1, &p->box, &diag)) return report_model(p->s, &diag);
    if (p->s->has_mirror) view_box_add(&p->box, camera, &model->beside);
    return 0;
}

/* Makes a perspective picture of the box's middle, at the drawing's scale: as with a lens that is
 * shifted, the eye stays where it is. */
static dp_result shift_lens(const picture *p, const dp_extent *extent, const double centre[2]) {
    dp_camera *const camera = &p->view->camera;
    double near_z, far_z, *const m = camera->projection;
    dp_camera_near_far(camera, extent->min, extent->max, &near_z, &far_z);
    const dp_result wrong = dp_camera_perspective(camera, 90, 1, near_z, far_z);
    if (wrong) return wrong;
    m[0] = 2 * p->mm_per_unit / (p->view->width * p->plan->mm_per_px);
    m[5] = 2 * p->mm_per_unit / (p->view->height * p->plan->mm_per_px);
    m[8] = m[0] * centre[0], m[9] = m[5] * centre[1]; /* times z, which is divided by -z */
    return DP_OK;
}

static dp_result aim(const picture *p, const dp_extent *extent, const double centre[2]) {
    const double aspect = (double)p->view->width / p->view->height,
                 height = p->view->height * p->plan->mm_per_px / p->mm_per_unit;
    return p->view->camera.projection[11] != 0
               ? shift_lens(p, extent, centre)
               : page_aim(&p->view->camera, extent, centre, height, aspect);
}

static int look(picture *p, dp_source *source, const measured *model, bool whole) {
    static const double eye_axis[2] = {0, 0};
    const double aspect = (double)p->view->width / p->view->height;
    if (!p->sized) return make_camera(p->s, source, model, aspect, &p->view->camera);
    const double centre[2] = {0.5 * (p->box.min[0] + p->box.max[0]),
                              0.5 * (p->box.min[1] + p->box.max[1])};
    if (!aim(p, &model->extent, whole ? centre : eye_axis)) return 0;
    wrong_usage(
        "at this scale the model is too small or too large to be seen; give another --scale, "
        "or --unit");
    return EXIT_USAGE;
}

/* Is the drawing to be as large as the page allows? */
static bool is_fitted(const tool_settings *s) {
    return s->page.width > 0 && !(s->scale.paper > 0) && !(s->ortho > 0) && !s->has_eye &&
           !s->has_target;
}

static void fit_page(picture *p) {
    const double lines = page_widest(p->s, p->plan), width = view_box_width(&p->box),
                 height = view_box_height(&p->box);
    const double by_width = width > 0 ? (p->mm_width - lines) / width : INFINITY,
                 by_height = height > 0 ? (p->mm_height - lines) / height : INFINITY;
    const double mm = fmin(by_width, by_height) * (p->s->zoom > 0 ? p->s->zoom : 1);
    p->mm_per_unit = isfinite(mm) && mm > 0 ? mm : 1;
}

static int make_picture(const tool_settings *s, dp_source *source, const measured *model,
                        page_plan *plan) {
    const bool on_page = s->page.width > 0, scaled = s->scale.paper > 0;
    picture p = {.s = s, .plan = plan, .view = &plan->views[0], .sized = scaled || is_fitted(s)};
    bool whole = false;
    if (scaled) p.mm_per_unit = page_scale(s, s->scale.paper / s->scale.model);
    plan->view_count = 1;
    int code = on_page || scaled ? measure(&p, source, model, &whole) : 0;
    if (code) return code;
    if (on_page)
        code = lie_on_page(&p);
    else if (scaled && !s->width)
        code = wrap_drawing(&p);
    else
        fill_size(&p);
    if (!code && scaled && whole && on_page) code = check_fits(&p);
    if (!scaled && p.sized) fit_page(&p);
    return code ? code : look(&p, source, model, whole);
}

int page_make(const tool_settings *s, dp_source *source, const measured *model, page_plan *plan) {
    memset(plan, 0, sizeof *plan);
    plan->paged = s->page.width > 0 || s->sheet.count || s->scale.paper > 0;
    const uint32_t dpi = s->dpi ? s->dpi : plan->paged ? 150 : 96;
    plan->mm_per_px = 25.4 / dpi;
    plan->dpi = s->dpi || plan->paged ? dpi : 0;
    return s->sheet.count ? sheet_make(s, source, &model->extent, plan)
                          : make_picture(s, source, model, plan);
}
