/* Rules and texts of a page as pixels: each is a thick line with round ends, whose coverage of a
 * pixel is taken from its distance to the pixel's centre. */
#include "page_ink.h"

#include <math.h>

void ink_paper(const dp_target *page, dp_color paper) {
    const uint32_t color = !paper ? 0xFFFFFFFFU : paper == DP_COLOR_NONE ? 0xFFFFFF00U : paper;
    const size_t n = (size_t)page->width * page->height;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 4; k++) page->rgba[4 * i + k] = (uint8_t)(color >> (24 - 8 * k));
}

/* Black over a pixel that is not premultiplied. */
static void blacken(uint8_t *pixel, double share) {
    const double under = pixel[3] / 255.0, over = share + under * (1 - share);
    if (!(share > 0)) return;
    for (int k = 0; k < 3; k++) pixel[k] = (uint8_t)(pixel[k] * under * (1 - share) / over + 0.5);
    pixel[3] = (uint8_t)(255 * over + 0.5);
}

static double distance_to(const double a[2], const double b[2], double x, double y) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

/* px. All pixels of the box around it are looked at: lines of a page are short, or run along its
 * edges. */
static void ink_line(const dp_target *page, const double a[2], const double b[2], double width) {
    const double reach = 0.5 * width + 1;
    const double top = fmax(floor(fmin(a[1], b[1]) - reach), 0),
                 bottom = fmin(ceil(fmax(a[1], b[1]) + reach), page->height),
                 left = fmax(floor(fmin(a[0], b[0]) - reach), 0),
                 right = fmin(ceil(fmax(a[0], b[0]) + reach), page->width);
    for (double y = top; y < bottom; y++)
        for (double x = left; x < right; x++) {
            const double off = distance_to(a, b, x + 0.5, y + 0.5);
            const double share = fmin(fmax(0.5 * width + 0.5 - off, 0), fmin(width, 1));
            blacken(page->rgba + 4 * ((size_t)y * page->width + (size_t)x), share);
        }
}

typedef struct pen {
    const dp_target *page;
    double px; /* per mm */
    double width;
} pen;

static void ink_stroke(void *user, const double (*points)[2], size_t count) {
    const pen *const p = user;
    for (size_t i = 0; i + 1 < count; i++) {
        const double a[2] = {points[i][0] * p->px, points[i][1] * p->px},
                     b[2] = {points[i + 1][0] * p->px, points[i + 1][1] * p->px};
        ink_line(p->page, a, b, p->width);
    }
}

void ink_page(const page_plan *plan, const dp_target *page) {
    const double px = 1 / plan->mm_per_px;
    for (size_t k = 0; k < plan->rule_count; k++) {
        const dp_page_rule *const r = &plan->rules[k];
        const double a[2] = {r->x0 * px, r->y0 * px}, b[2] = {r->x1 * px, r->y1 * px};
        ink_line(page, a, b, r->width * px);
    }
    for (size_t k = 0; k < plan->text_count; k++) {
        pen p = {page, px, 0.1 * plan->texts[k].height * px};
        dp_page_text_strokes(&plan->texts[k], ink_stroke, &p);
    }
}
