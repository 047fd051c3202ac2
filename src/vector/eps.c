/* Encapsulated PostScript, level 2: one page, with a comment where each layer begins.
 *
 * Units are those of the page with y down. There is no transparency: colours are blended with the
 * paper (white where there is none). Old interpreters hold 1500 points of a path: longer ones are
 * stroked in parts, which the round ends join without a seam; dashes go on where they were. */
#include "vector/packed.h"
#include "vector/writer.h"

#include <math.h>

enum { POINTS_MOST = 1400 };

typedef struct eps {
    dp_out *out;
    const dp_plan *plan;
    dp_page_style now;
    bool begun;   /* `now` is set */
    bool shifted; /* dashes do not begin at their start */
    bool open;    /* a path */
    int points;   /* that it has */
} eps;

static dp_color on_paper(const eps *self, dp_color color) {
    const dp_page *const page = self->plan->page;
    const dp_color white = DP_RGB(255, 255, 255);
    return dp_blend(color, dp_is_painted(page) ? dp_blend(page->paper, white) : white);
}

static void put_operand(dp_out *out, int64_t thousandths) {
    dp_put_short(out, thousandths);
    dp_put_char(out, ' ');
}

/* ------- styles ------- */

static void put_color(dp_out *out, dp_color color) {
    const uint32_t r = color >> 24, g = color >> 16 & 0xFF, b = color >> 8 & 0xFF;
    put_operand(out, dp_fixed(r / 255.0));
    if (r != g || g != b) {
        put_operand(out, dp_fixed(g / 255.0));
        put_operand(out, dp_fixed(b / 255.0));
        dp_put_text(out, "c\n");
    } else {
        dp_put_text(out, "g\n");
    }
}

static void put_dash(eps *self, const dp_page_style *s, double begin /* units */) {
    dp_put_char(self->out, '[');
    if (s->dash[1]) {
        put_operand(self->out, s->dash[0]);
        dp_put_short(self->out, s->dash[1]);
    }
    dp_put_text(self->out, "] ");
    put_operand(self->out, dp_fixed(begin));
    dp_put_text(self->out, "d\n");
    self->shifted = begin > 0;
}

/* The changes from the style that the pen has. */
static void put_style(eps *self, const dp_page_style *s) {
    dp_page_style *const now = &self->now;
    if (!self->begun || s->color != now->color) put_color(self->out, on_paper(self, s->color));
    if (!self->begun || s->width != now->width) {
        put_operand(self->out, s->width);
        dp_put_text(self->out, "w\n");
    }
    if (self->shifted || s->dash[0] != now->dash[0] || s->dash[1] != now->dash[1])
        put_dash(self, s, 0);
    self->now = *s;
    self->begun = true;
}

/* ------- paths ------- */

static void stroke(eps *self) {
    if (self->open) dp_put_text(self->out, "s\n");
    self->open = false;
    self->points = 0;
}

static void put_point(eps *self, const int64_t at[2], bool first) {
    put_operand(self->out, at[0]);
    put_operand(self->out, at[1]);
    dp_put_text(self->out, first ? "m\n" : "l\n");
    self->open = true;
    self->points++;
}

static double distance(const int64_t a[2], const int64_t b[2]) {
    const double x = (double)(b[0] - a[0]), y = (double)(b[1] - a[1]);
    return sqrt(x * x + y * y) / DP_FIXED_ONE;
}

/* Begins a path where the last one ended, `length` from its start. */
static void go_on(eps *self, const dp_page_style *s, const int64_t at[2], double length) {
    stroke(self);
    const double period = (double)(s->dash[0] + s->dash[1]) / DP_FIXED_ONE;
    if (period > 0) put_dash(self, s, fmod(length, period));
    put_point(self, at, true);
}

static void put_mark(void *user, const dp_mark *m) {
    eps *const self = user;
    const dp_page_style *const s = &self->plan->styles[m->style];
    dp_trail trail = {.mark = m};
    int64_t first[2] = {0, 0}, last[2] = {0, 0};
    double length = 0;
    bool split = false;
    if (!m->joins || self->points >= POINTS_MOST / 2) stroke(self);
    if (!m->joins) put_style(self, s);
    while (dp_trail_next(&trail) && !self->out->result) {
        if (trail.given == 1) {
            first[0] = trail.at[0], first[1] = trail.at[1];
        } else {
            if (self->points >= POINTS_MOST) {
                go_on(self, s, last, length);
                split = true;
            }
            length += distance(last, trail.at);
        }
        put_point(self, trail.at, trail.given == 1);
        last[0] = trail.at[0], last[1] = trail.at[1];
    }
    if (!m->closed) return;
    if (split) /* the path's start is stroked already */
        put_point(self, first, false);
    else
        dp_put_text(self->out, "z\n");
}

/* ------- layers ------- */

static void begin_layer(void *user, const dp_layer *layer) {
    dp_out *const out = ((eps *)user)->out;
    char name[DP_LAYER_NAME];
    dp_put_text(out, "% layer ");
    dp_put_integer(out, dp_layer_number(layer));
    dp_put_char(out, ' ');
    dp_put_text(out, dp_layer_name(name, layer, ' ', false));
    dp_put_char(out, '\n');
}

static void end_layer(void *user, const dp_layer *layer) {
    (void)layer;
    stroke(user);
}

static void put_matrix(dp_out *out, double x, double y, const char *name) {
    put_operand(out, dp_fixed(x));
    put_operand(out, dp_fixed(y));
    dp_put_text(out, name);
}

static void put_ground(void *user, const dp_ground *g) {
    eps *const self = user;
    dp_out *const out = self->out;
    const uint8_t *pixel = g->view->ground;
    if (!pixel || !g->columns || !g->rows) return;
    dp_put_text(out, "gsave\n");
    put_matrix(out, g->x, g->y, "translate\n");
    put_matrix(out, g->width, g->height, "scale\n/DeviceRGB setcolorspace\n");
    dp_put_text(out, "<</ImageType 1/Width ");
    dp_put_integer(out, g->columns);
    dp_put_text(out, "/Height ");
    dp_put_integer(out, g->rows);
    dp_put_text(out, "\n/ImageMatrix[");
    dp_put_integer(out, g->columns);
    dp_put_text(out, " 0 0 ");
    dp_put_integer(out, g->rows);
    dp_put_text(out, " 0 0]/BitsPerComponent 8/Decode[0 1 0 1 0 1]\n/DataSource currentfile"
                     "/ASCII85Decode filter/RunLengthDecode filter>>image\n");
    dp_packed packed = {.out = out};
    for (uint32_t y = 0; y < g->rows && !out->result; y++)
        for (uint32_t x = 0; x < g->columns; x++, pixel += 4) {
            const dp_color color =
                on_paper(self, (dp_color)pixel[0] << 24 | (dp_color)pixel[1] << 16 |
                                   (dp_color)pixel[2] << 8 | pixel[3]);
            for (int shift = 24; shift; shift -= 8) dp_packed_put(&packed, color >> shift & 0xFF);
        }
    dp_packed_end(&packed);
    dp_put_text(out, "grestore\n");
}

/* ------- the document ------- */

static void put_head(const eps *self) {
    const dp_page *const page = self->plan->page;
    dp_out *const out = self->out;
    const double width = page->width * 72 / 25.4, height = page->height * 72 / 25.4;
    dp_put_text(out, "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 ");
    dp_put_number(out, ceil(width), 0);
    dp_put_char(out, ' ');
    dp_put_number(out, ceil(height), 0);
    dp_put_text(out, "\n%%HiResBoundingBox: 0 0 ");
    dp_put_number(out, width, 6);
    dp_put_char(out, ' ');
    dp_put_number(out, height, 6);
    dp_put_text(out, "\n%%Creator: (drypoint ");
    dp_put_text(out, dp_version());
    dp_put_text(out, ")\n");
    if (page->title) {
        dp_put_text(out, "%%Title: ");
        dp_put_postscript(out, page->title);
        dp_put_char(out, '\n');
    }
    dp_put_text(out, "%%LanguageLevel: 2\n%%DocumentData: Clean7Bit\n%%Pages: 1\n%%EndComments\n"
                     "%%BeginProlog\n/drypoint 16 dict def\ndrypoint begin\n"
                     "/m{moveto}bind def\n/l{lineto}bind def\n/z{closepath}bind def\n"
                     "/s{stroke}bind def\n/w{setlinewidth}bind def\n/d{setdash}bind def\n"
                     "/g{setgray}bind def\n/c{setrgbcolor}bind def\nend\n%%EndProlog\n"
                     "%%Page: 1 1\ndrypoint begin\ngsave\n");
}

/* To units of the page. */
static void put_units(const eps *self) {
    const double points = self->plan->unit * 72 / 25.4;
    dp_put_text(self->out, "0 ");
    dp_put_number(self->out, self->plan->page->height * 72 / 25.4, 6);
    dp_put_text(self->out, " translate\n");
    dp_put_number(self->out, points, 9);
    dp_put_char(self->out, ' ');
    dp_put_number(self->out, -points, 9);
    dp_put_text(self->out, " scale\n1 setlinecap 1 setlinejoin\n");
}

static void put_paper(const eps *self) {
    dp_out *const out = self->out;
    if (!dp_is_painted(self->plan->page)) return;
    put_color(out, on_paper(self, self->plan->page->paper));
    dp_put_text(out, "0 0 ");
    dp_put_number(out, self->plan->width, 6);
    dp_put_char(out, ' ');
    dp_put_number(out, self->plan->height, 6);
    dp_put_text(out, " rectfill\n");
}

void dp_write_eps(dp_out *out, dp_plan *plan) {
    eps self = {.out = out, .plan = plan};
    const dp_pen pen = {&self, begin_layer, put_ground, put_mark, end_layer};
    put_head(&self);
    put_units(&self);
    put_paper(&self);
    dp_plan_walk(plan, &pen, out);
    dp_put_text(out, "grestore\nend\nshowpage\n%%Trailer\n%%EOF\n");
}
