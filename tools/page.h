/* Where a run's drawings lie: on a page, on a sheet of several views, or each a picture of its own. */
#ifndef TOOL_PAGE_H
#define TOOL_PAGE_H

#include "commands.h"

enum { RULES_MOST = 256, TEXTS_MOST = 16, TEXT_BYTES = 128 };

typedef struct page_view {
    const char *name; /* "front"; NULL: the only one */
    dp_camera camera;
    uint32_t x, y, width, height; /* px, on the page */
    bool bare;                    /* without hidden lines */
} page_view;

/* One camera per view, and one size of a pixel, for all outputs of a run. */
typedef struct page_plan {
    uint32_t width, height;     /* px, of the page */
    double mm_width, mm_height; /* of the page; 0: the picture's */
    double mm_per_px;
    uint32_t dpi; /* for PNG; 0: it does not say */
    bool paged;   /* lengths are told in mm */
    page_view views[SHEET_MOST];
    int view_count;
    dp_page_rule rules[RULES_MOST];
    size_t rule_count;
    dp_page_text texts[TEXTS_MOST];
    char text[TEXTS_MOST][TEXT_BYTES];
    size_t text_count;
} page_plan;

/* Plans the page for a model. 0, or the exit code after a message. */
int page_make(const tool_settings *s, dp_source *source, const measured *model, page_plan *plan);

/* px: the settings' lines on the plan's page. False: one is too wide; a message is on stderr. */
bool page_widths(const tool_settings *s, const page_plan *plan, dp_style *style);
/* px: a length of the settings on the plan's page; 0 is "none" and becomes negative, as
 * dp_drawing_desc has it. */
float page_length(const page_plan *plan, const tool_length *length);

/* ---- for sheet.c ---- */

/* mm: top, right, bottom, left. */
const double *page_margins(const tool_settings *s);
/* mm on paper for one unit of the model, at a scale. */
double page_scale(const tool_settings *s, double scale);
/* The largest of 1:1, 1:2, 1:5, 1:10, … and 2:1, 5:1, … at which what fits() says so of still fits;
 * 0: none. */
double page_standard_scale(bool (*fits)(const void *user, double scale), const void *user);
/* "1:10" */
void page_scale_text(double scale, char text[32]);
/* The page's size in pixels. 0, or the exit code after a message. */
int page_pixels(page_plan *plan);
/* Makes an orthographic camera that shows `height` world units, with a point of camera space in the
 * middle. */
dp_result page_aim(dp_camera *camera, const dp_extent *extent, const double centre[2],
                   double height, double aspect);
/* mm: the widest line. */
double page_widest(const tool_settings *s, const page_plan *plan);
void page_rule(page_plan *plan, double x0, double y0, double x1, double y1, double width);
void page_text(page_plan *plan, double x, double y, double height, const char *text);

#endif
