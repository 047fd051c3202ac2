/* Lays out sheets: views of a model on one page, in one scale, as ISO 5456-2 has it.
 *
 *     third angle                 first angle
 *              top    iso                  bottom
 *     left    front   right  back   right  front   left  back
 *             bottom                       top     iso
 *
 * Views of one column have the same width and the same middle, views of one row the same height:
 * so front and top share x, front and right share y, to the last bit. The pictorial view (iso) fills
 * the free corner. Gaps are equal, also between columns and rows; what is left goes to the edges.
 *
 * The views turn with what is up (sides.h). */
#include "sheet.h"
#include "commands.h"
#include "output.h"
#include "report.h"
#include "sides.h"
#include "view_box.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLUMNS = 4, ROWS = 3, MIDDLE = 1 };

static const double least_gap = 8, largest_gap = 25; /* mm, between views */
static const double inset = 4;                       /* mm, from the frame to views, at least */

static const tool_page usual_page = {"A4", 210, 297, TURN_AUTO};

typedef struct span {
    double from, to; /* camera space; from > to: there is none */
} span;

typedef struct layout {
    const tool_settings *s;
    const page_plan *plan;
    int count, views[SHEET_MOST];
    dp_camera cameras[SHEET_MOST];
    view_box boxes[SHEET_MOST];
    span column[COLUMNS], row[ROWS]; /* x and y of the views in them */
    int iso;                         /* index of that view; -1: there is none */
    bool first_angle;
    double left, top, width, height; /* mm: the place for views */
} layout;

/* ---- cameras ---- */

static bool make_cameras(layout *l, const dp_source *source, const dp_extent *extent) {
    model_sides sides;
    double centre[3], radius = 0;
    sides_of(l->s, source, &sides);
    for (int k = 0; k < 3; k++) {
        const double half = 0.5 * (extent->exact_max[k] - extent->exact_min[k]);
        centre[k] = extent->exact_min[k] + half;
        radius += half * half;
    }
    radius = radius > 0 ? sqrt(radius) : 1;
    for (int i = 0; i < l->count; i++) {
        double d[3], up[3], eye[3];
        sides_view(&sides, l->views[i], d, up);
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++) eye[k] = centre[k] + 2 * radius * d[k] / length;
        if (dp_camera_look_at(&l->cameras[i], eye, centre, up))
            return wrong_usage("the model's size is beyond all numbers");
    }
    return true;
}

/* ---- columns and rows ---- */

static int column_of(const layout *l, int view) {
    static const int columns[] = {
        [VIEW_FRONT] = 1, [VIEW_BACK] = 3,   [VIEW_LEFT] = 0, [VIEW_RIGHT] = 2,
        [VIEW_TOP] = 1,   [VIEW_BOTTOM] = 1, [VIEW_ISO] = 2};
    const bool side = view == VIEW_LEFT || view == VIEW_RIGHT;
    return side && l->first_angle ? 2 - columns[view] : columns[view];
}

static int row_of(const layout *l, int view) {
    static const int rows[] = {
        [VIEW_FRONT] = 1, [VIEW_BACK] = 1,   [VIEW_LEFT] = 1, [VIEW_RIGHT] = 1,
        [VIEW_TOP] = 0,   [VIEW_BOTTOM] = 2, [VIEW_ISO] = 0};
    return l->first_angle ? 2 - rows[view] : rows[view];
}

static void widen(span *s, double from, double to) {
    s->from = fmin(s->from, from), s->to = fmax(s->to, to);
}

static void fill_grid(layout *l) {
    l->iso = -1;
    for (int k = 0; k < COLUMNS; k++) l->column[k] = (span){INFINITY, -INFINITY};
    for (int k = 0; k < ROWS; k++) l->row[k] = (span){INFINITY, -INFINITY};
    for (int i = 0; i < l->count; i++) {
        const view_box *const b = &l->boxes[i];
        if (l->views[i] == VIEW_ISO) {
            l->iso = i;
            continue;
        }
        widen(&l->column[column_of(l, l->views[i])], b->min[0], b->max[0]);
        widen(&l->row[row_of(l, l->views[i])], b->min[1], b->max[1]);
    }
}

static bool is_there(const span *s) { return s->from <= s->to; }

/* mm on paper, lines included. */
static double size_of(const layout *l, const span *s, double mm_per_unit) {
    const double lines = page_widest(l->s, l->plan) + 2 * l->plan->mm_per_px;
    return is_there(s) ? (s->to - s->from) * mm_per_unit + lines : 0;
}

/* The sizes of a layout at one scale, mm. */
typedef struct sizes {
    double column[COLUMNS], row[ROWS], iso[2];
    double iso_left, iso_width; /* its place: where the columns right of the middle are */
    double width, height;
    int gaps[2]; /* across, down */
} sizes;

static sizes measure(const layout *l, double mm_per_unit, double gap) {
    sizes z = {0};
    const int iso_row = row_of(l, VIEW_ISO);
    bool beside = false; /* is there a column before? */
    for (int k = 0; k < COLUMNS; k++) {
        z.column[k] = size_of(l, &l->column[k], mm_per_unit);
        if (k == MIDDLE + 1) z.iso_left = z.width + (beside ? gap : 0);
        if (!is_there(&l->column[k])) continue;
        if (beside) z.width += gap, z.gaps[0]++;
        z.width += z.column[k];
        beside = true;
    }
    if (l->iso >= 0) {
        const view_box *const b = &l->boxes[l->iso];
        const span x = {b->min[0], b->max[0]}, y = {b->min[1], b->max[1]};
        z.iso[0] = size_of(l, &x, mm_per_unit), z.iso[1] = size_of(l, &y, mm_per_unit);
        z.iso_width = fmax(z.width - z.iso_left, z.iso[0]);
        if (z.width <= z.iso_left && z.iso_left > 0) z.gaps[0]++;
        z.width = z.iso_left + z.iso_width;
    }
    beside = false;
    for (int k = 0; k < ROWS; k++) {
        const bool iso = l->iso >= 0 && k == iso_row;
        z.row[k] = size_of(l, &l->row[k], mm_per_unit);
        if (iso) z.row[k] = fmax(z.row[k], z.iso[1]);
        if (!is_there(&l->row[k]) && !iso) continue;
        if (beside) z.height += gap, z.gaps[1]++;
        z.height += z.row[k];
        beside = true;
    }
    return z;
}

static bool fits(const void *user, double scale) {
    const layout *const l = user;
    const sizes z = measure(l, page_scale(l->s, scale), least_gap);
    return z.width <= l->width && z.height <= l->height;
}

/* The scale that is wanted, or the largest standard one. */
static int choose_scale(const layout *l, double *scale) {
    const tool_scale *const given = &l->s->scale;
    const double best = page_standard_scale(fits, l);
    char standard[32];
    *scale = given->paper > 0 ? given->paper / given->model : best;
    if (*scale > 0 && fits(l, *scale)) return 0;
    page_scale_text(best > 0 ? best : 1, standard);
    if (given->paper > 0 && best > 0) {
        const sizes z = measure(l, page_scale(l->s, *scale), least_gap);
        wrong_usage("at %g:%g the views take %.4g x %.4g mm, and the sheet has %.4g x %.4g mm for "
                    "them: %s is the largest standard scale that fits",
                    given->paper, given->model, z.width, z.height, l->width, l->height, standard);
    } else {
        wrong_usage(
            "the sheet has %.4g x %.4g mm for the views, and they fit at no standard scale; "
            "give a larger --page, or fewer views",
            fmax(l->width, 0), fmax(l->height, 0));
    }
    return EXIT_USAGE;
}

/* ---- places ---- */

static double middle(const span *s) { return 0.5 * (s->from + s->to); }

/* A view in the rectangle of this size at (x, y), mm, with `centre` in its middle. */
static bool put_view(const layout *l, int i, const double at[2], const double size[2],
                     const double centre[2], const dp_extent *extent, double mm_per_unit,
                     page_plan *plan) {
    static const char *const names[] = {
        [VIEW_FRONT] = "front", [VIEW_BACK] = "back", [VIEW_LEFT] = "left",
        [VIEW_RIGHT] = "right", [VIEW_TOP] = "top",   [VIEW_BOTTOM] = "bottom",
        [VIEW_ISO] = "iso"};
    const double mm = plan->mm_per_px;
    page_view *const v = &plan->views[plan->view_count++];
    v->name = names[l->views[i]];
    v->bare = l->views[i] == VIEW_ISO;
    v->camera = l->cameras[i];
    v->x = (uint32_t)round(at[0] / mm), v->y = (uint32_t)round(at[1] / mm);
    v->width = (uint32_t)ceil(size[0] / mm), v->height = (uint32_t)ceil(size[1] / mm);
    const dp_result wrong = page_aim(&v->camera, extent, centre, v->height * mm / mm_per_unit,
                                     (double)v->width / v->height);
    return wrong ? wrong_usage("the model is too small or too large to be seen; give --unit")
                 : true;
}

/* Where columns or rows begin. */
static void starts(const double *size, int count, double at, double gap, double *start) {
    for (int k = 0; k < count; k++) {
        start[k] = at;
        if (size[k] > 0) at += size[k] + gap;
    }
}

static bool put_views(const layout *l, const dp_extent *extent, double mm_per_unit,
                      page_plan *plan) {
    sizes z = measure(l, mm_per_unit, 0);
    const double across = (l->width - z.width) / (z.gaps[0] + 1),
                 down = (l->height - z.height) / (z.gaps[1] + 1);
    const double gap = fmin(fmax(fmin(across, down), least_gap), largest_gap);
    z = measure(l, mm_per_unit, gap);
    double x[COLUMNS], y[ROWS];
    const double left = l->left + 0.5 * (l->width - z.width);
    starts(z.column, COLUMNS, left, gap, x);
    starts(z.row, ROWS, l->top + 0.5 * (l->height - z.height), gap, y);
    for (int i = 0; i < l->count; i++) {
        const int c = column_of(l, l->views[i]), r = row_of(l, l->views[i]);
        const span *const across_span = &l->column[c], *const down_span = &l->row[r];
        double at[2] = {x[c], y[r]}, size[2], centre[2];
        if (i == l->iso) {
            const view_box *const b = &l->boxes[i];
            for (int k = 0; k < 2; k++)
                size[k] = z.iso[k], centre[k] = 0.5 * (b->min[k] + b->max[k]);
            at[0] = left + z.iso_left + 0.5 * (z.iso_width - size[0]);
            at[1] += 0.5 * (z.row[r] - size[1]);
        } else {
            size[0] = z.column[c], size[1] = size_of(l, down_span, mm_per_unit);
            centre[0] = middle(across_span), centre[1] = middle(down_span);
            if (r < MIDDLE) at[1] += z.row[r] - size[1]; /* next to the front view */
        }
        if (!put_view(l, i, at, size, centre, extent, mm_per_unit, plan)) return false;
    }
    return true;
}

/* ---- the sheet ---- */

static void size_page(const tool_settings *s, page_plan *plan) {
    const tool_page *const page = s->page.width > 0 ? &s->page : &usual_page;
    const bool tall = page->turn == TURN_PORTRAIT ||
                      (page->turn == TURN_AS_IS && page->height > page->width && !s->landscape);
    const double small = fmin(page->width, page->height), large = fmax(page->width, page->height);
    plan->mm_width = tall ? small : large;
    plan->mm_height = tall ? large : small;
}

/* What a model is called, where it has no title: its file's name without the ending; of a scene, what
 * its models are called together. */
static void name_model(const tool_settings *s, char name[TEXT_BYTES]) {
    const char *const path = s->model;
    const char *const colon = strchr(path, ':'), *const file = output_name(path);
    snprintf(name, TEXT_BYTES, "%s", !strncmp(path, "shape:", 6) && colon ? colon + 1 : file);
    char *const dot = s->model_count == 1 ? strrchr(name, '.') : NULL;
    if (dot && dot > name) *dot = 0;
}

static void put_frame(const tool_settings *s, double scale, page_plan *plan) {
    static const char *const units[] = {"mm", "mm", "cm", "m", "in", "ft"};
    const double *const m = page_margins(s);
    char text[32], name[TEXT_BYTES];
    name_model(s, name);
    page_scale_text(scale, text);
    if (s->scale.paper > 0) snprintf(text, sizeof text, "%g:%g", s->scale.paper, s->scale.model);
    const title_block block = {.left = m[MARGIN_LEFT],
                               .top = m[MARGIN_TOP],
                               .right = plan->mm_width - m[MARGIN_RIGHT],
                               .bottom = plan->mm_height - m[MARGIN_BOTTOM],
                               .title = s->title ? s->title : name,
                               .model = strcmp(s->model, "-") ? output_name(s->model) : "",
                               .scale = text,
                               .unit = units[s->unit],
                               .page = s->page.name ? s->page.name : usual_page.name,
                               .first_angle = s->angle == ANGLE_FIRST};
    title_draw(&block, plan);
}

static void find_place(layout *l, const page_plan *plan) {
    const tool_settings *const s = l->s;
    const double *const m = page_margins(s);
    l->left = m[MARGIN_LEFT] + inset, l->top = m[MARGIN_TOP] + inset;
    l->width = plan->mm_width - m[MARGIN_RIGHT] - inset - l->left;
    l->height = plan->mm_height - m[MARGIN_BOTTOM] - title_height - inset - l->top;
}

int sheet_make(const tool_settings *s, dp_source *source, const dp_extent *extent,
               page_plan *plan) {
    dp_diag diag;
    double scale;
    layout l = {
        .s = s, .plan = plan, .count = s->sheet.count, .first_angle = s->angle == ANGLE_FIRST};
    memcpy(l.views, s->sheet.views, sizeof l.views);
    size_page(s, plan);
    int code = page_pixels(plan);
    if (code) return code;
    if (!make_cameras(&l, source, extent)) return EXIT_USAGE;
    if (view_boxes(source, l.cameras, l.count, l.boxes, &diag)) return report_model(s, &diag);
    fill_grid(&l);
    find_place(&l, plan);
    code = choose_scale(&l, &scale);
    if (code) return code;
    if (!put_views(&l, extent, page_scale(s, scale), plan)) return EXIT_USAGE;
    put_frame(s, scale, plan);
    return 0;
}
