/* The frame of a sheet and its title block, in rules and single-stroke texts:
 *
 *     ┌ title ────────────────────────┬ scale ──┬ projection ┐
 *     │ Bracket                       │ 1:2     │  (o)  <]   │
 *     ├ model ────────────────────────┼ unit ───┤            │
 *     │ bracket.stl                   │ mm  A4  │            │
 *     └───────────────────────────────┴─────────┴────────────┘
 *
 * At most 180 mm wide, as ISO 7200 has it, and no wider than the frame. Nothing depends on the day. */
#include "sheet.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const double title_height = 20; /* mm, two rows */

enum { TITLE_WIDTH = 180, ARC_STEPS = 32 };
static const double wide = 0.5, narrow = 0.25;             /* mm */
static const double label_height = 1.8, text_height = 3.5; /* mm */

static void reach(void *user, const double (*points)[2], size_t count) {
    double *const right = user;
    for (size_t i = 0; i < count; i++) *right = fmax(*right, points[i][0]);
}

/* mm, of a text that is 1 mm high. */
static double width_of(const char *text) {
    double right = 0;
    dp_page_text_strokes(&(dp_page_text){.text = text, .height = 1}, reach, &right);
    return right;
}

/* Takes letters off a text's end until it is as narrow as that, and shows that some are gone. */
static void cut(char text[TEXT_BYTES], double width) {
    size_t n = strlen(text);
    while (n && width_of(text) > width) {
        do n--;
        while (n && ((unsigned char)text[n] & 0xC0) == 0x80); /* whole letters of UTF-8 */
        strcpy(text + n, n + 3 < TEXT_BYTES ? ".." : "");
    }
}

/* A text that is made smaller, and in the end shorter, where its cell is too narrow. */
static void fit_text(page_plan *plan, double x, double y, double width, const char *text) {
    char copy[TEXT_BYTES];
    snprintf(copy, sizeof copy, "%s", text);
    const double whole = width_of(copy);
    const double height = fmin(text_height, whole > 0 ? width / whole : text_height);
    if (height < label_height) cut(copy, width / label_height);
    if (*copy) page_text(plan, x, y, fmax(height, label_height), copy);
}

/* A cell's label in its upper left corner, and its text below. */
static void cell(page_plan *plan, double x, double y, double width, const char *label,
                 const char *text) {
    page_text(plan, x + 1.5, y + 1.2 + label_height, label_height, label);
    fit_text(plan, x + 1.5, y + 8.4, width - 3, text);
}

static void box(page_plan *plan, double x0, double y0, double x1, double y1, double width) {
    page_rule(plan, x0, y0, x1, y0, width);
    page_rule(plan, x1, y0, x1, y1, width);
    page_rule(plan, x1, y1, x0, y1, width);
    page_rule(plan, x0, y1, x0, y0, width);
}

static void circle(page_plan *plan, double x, double y, double radius) {
    const double step = 6.283185307179586 / ARC_STEPS;
    for (int k = 0; k < ARC_STEPS; k++)
        page_rule(plan, x + radius * cos(step * k), y + radius * sin(step * k),
                  x + radius * cos(step * (k + 1)), y + radius * sin(step * (k + 1)), narrow);
}

/* A centre line: long dash, gap, dot, gap, … */
static void centre_line(page_plan *plan, double x0, double y0, double x1, double y1) {
    const double length = hypot(x1 - x0, y1 - y0), dx = (x1 - x0) / length, dy = (y1 - y0) / length;
    static const double pattern[] = {2.5, 0.7, 0.3, 0.7};
    double at = 0;
    for (int k = 0; at < length; at += pattern[k++ % 4]) {
        const double to = fmin(at + pattern[k % 4], length);
        if (k % 2 == 0)
            page_rule(plan, x0 + dx * at, y0 + dy * at, x0 + dx * to, y0 + dy * to, narrow / 2);
    }
}

/* The truncated cone of ISO 5456-2 and its view from the left, where its small end is: in first
 * angle that view lies to the right of the cone, in third angle to the left. */
static void angle_symbol(page_plan *plan, double x, double y, double width, bool first_angle) {
    const double unit = fmin(width / 25, 1);
    const double small = 2 * unit, large = 4 * unit, half = 4 * unit, apart = 6 * unit;
    const double cone = first_angle ? x - apart : x + apart,
                 eye = first_angle ? x + apart : x - apart;
    circle(plan, eye, y, small);
    circle(plan, eye, y, large);
    page_rule(plan, cone - half, y - small, cone - half, y + small, narrow);
    page_rule(plan, cone - half, y + small, cone + half, y + large, narrow);
    page_rule(plan, cone + half, y + large, cone + half, y - large, narrow);
    page_rule(plan, cone + half, y - large, cone - half, y - small, narrow);
    centre_line(plan, x - apart - large - 1.5, y, x + apart + large + 1.5, y);
    centre_line(plan, eye, y - large - 1.5, eye, y + large + 1.5);
}

void title_draw(const title_block *b, page_plan *plan) {
    const double width = fmin(TITLE_WIDTH, b->right - b->left);
    const double left = b->right - width, top = b->bottom - title_height, row = title_height / 2;
    const double symbol = b->right - 0.15 * width, scale = symbol - 0.2 * width;
    box(plan, b->left, b->top, b->right, b->bottom, wide);
    page_rule(plan, left, top, b->right, top, wide);
    page_rule(plan, left, top, left, b->bottom, wide);
    page_rule(plan, scale, top, scale, b->bottom, narrow);
    page_rule(plan, symbol, top, symbol, b->bottom, narrow);
    page_rule(plan, left, top + row, symbol, top + row, narrow);
    page_rule(plan, 0.5 * (scale + symbol), top + row, 0.5 * (scale + symbol), b->bottom, narrow);
    cell(plan, left, top, scale - left, "title", b->title);
    cell(plan, left, top + row, scale - left, "model", b->model);
    cell(plan, scale, top, symbol - scale, "scale", b->scale);
    cell(plan, scale, top + row, 0.1 * width, "unit", b->unit);
    cell(plan, 0.5 * (scale + symbol), top + row, 0.1 * width, "page", b->page);
    angle_symbol(plan, 0.5 * (symbol + b->right), top + row, b->right - symbol, b->first_angle);
}
