/* SVG 1.1: a group per layer, a path each line.
 *
 *     <svg width="444.5mm" height="277.8125mm" viewBox="0 0 1680 1050" …>
 *     <style>.dp-valley{stroke:#000;stroke-width:2}</style>
 *     <g id="valley" inkscape:groupmode="layer" inkscape:label="3 valley" class="dp-valley" stroke="#000" …>
 *     <path d="m10.5 20 1.25-.5"/>
 *     </g>
 *     </svg>
 *
 * Units are pixels of the first view: a single picture's coordinates stay what they were. A layer
 * has the style of its first path, twice: as attributes, for programs that know no style sheets, and
 * as a class, to be restyled by. Paths of another style have their own. Path data are relative and in
 * thousandths, between points that are rounded first: no error adds up. */
#include "vector/writer.h"

#include <math.h>

#include "base/diag.h"

typedef struct svg {
    dp_out *out;
    const dp_plan *plan;
    bool open; /* a path */
} svg;

static void put_hex(dp_out *out, dp_color color) {
    char text[7] = "#";
    const uint32_t rgb = color >> 8;
    const bool doubled = (rgb >> 4 & 0x0F0F0F) == (rgb & 0x0F0F0F);
    int at = 1;
    for (int i = 5; i >= 0; i -= doubled ? 2 : 1)
        text[at++] = "0123456789abcdef"[rgb >> 4 * i & 15];
    dp_put(out, text, (size_t)at);
}

static void put_alpha(dp_out *out, dp_color color) {
    dp_put_fixed(out, dp_fixed((double)(color & 0xFF) / 255));
}

/* ------- styles ------- */

static void put_class(const svg *self, const dp_page_style *s) {
    char name[DP_LAYER_NAME];
    dp_put_text(self->out, "dp-");
    dp_put_text(self->out, dp_layer_name(name, &self->plan->layers[s->layer], '-', false));
    if (!s->place) return;
    dp_put_char(self->out, '-');
    dp_put_integer(self->out, s->place + UINT64_C(1));
}

/* One property as an attribute or in a style sheet. */
static void begin_property(dp_out *out, const char *name, bool sheet) {
    if (!sheet) dp_put_char(out, ' ');
    dp_put_text(out, name);
    dp_put_text(out, sheet ? ":" : "=\"");
}

static void end_property(dp_out *out, bool sheet) { dp_put_char(out, sheet ? ';' : '"'); }

static void put_dash(dp_out *out, const dp_page_style *s) {
    if (!s->dash[1]) {
        dp_put_text(out, "none");
        return;
    }
    dp_put_fixed(out, s->dash[0]);
    dp_put_char(out, ',');
    dp_put_fixed(out, s->dash[1]);
}

/* What a style has that `inherited` (NULL: SVG's own defaults) has not. */
static void put_properties(dp_out *out, const dp_page_style *s, const dp_page_style *inherited,
                           bool sheet) {
    begin_property(out, "stroke", sheet);
    put_hex(out, s->color);
    end_property(out, sheet);
    begin_property(out, "stroke-width", sheet);
    dp_put_fixed(out, s->width);
    end_property(out, sheet);
    if ((s->color & 0xFF) != 0xFF || (inherited && (inherited->color & 0xFF) != 0xFF)) {
        begin_property(out, "stroke-opacity", sheet);
        put_alpha(out, s->color);
        end_property(out, sheet);
    }
    if (s->dash[1] || (inherited && inherited->dash[1])) {
        begin_property(out, "stroke-dasharray", sheet);
        put_dash(out, s);
        end_property(out, sheet);
    }
}

/* The style of a layer that a style of its own lies in; NULL: it is that one. */
static const dp_page_style *inherited_by(const dp_plan *plan, const dp_page_style *s) {
    return s->place ? &plan->styles[plan->layers[s->layer].first] : NULL;
}

static void put_sheet(const svg *self) {
    const dp_plan *const plan = self->plan;
    if (!plan->style_count) return;
    dp_put_text(self->out, "<style type=\"text/css\">\n");
    for (size_t i = 0; i < plan->style_count && !self->out->result; i++) {
        const dp_page_style *const s = &plan->styles[i];
        dp_put_char(self->out, '.');
        put_class(self, s);
        dp_put_char(self->out, '{');
        put_properties(self->out, s, inherited_by(plan, s), true);
        dp_put_text(self->out, "}\n");
    }
    dp_put_text(self->out, "</style>\n");
}

static void put_style(const svg *self, const dp_page_style *s) {
    dp_put_text(self->out, " class=\"");
    put_class(self, s);
    dp_put_char(self->out, '"');
    put_properties(self->out, s, inherited_by(self->plan, s), false);
}

/* ------- layers ------- */

static void begin_layer(void *user, const dp_layer *layer) {
    svg *const self = user;
    dp_out *const out = self->out;
    char name[DP_LAYER_NAME];
    dp_put_text(out, "<g id=\"");
    dp_put_text(out, dp_layer_name(name, layer, '-', false));
    dp_put_text(out, "\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    dp_put_integer(out, dp_layer_number(layer));
    dp_put_char(out, ' ');
    dp_put_text(out, dp_layer_name(name, layer, ' ', false));
    dp_put_char(out, '"');
    if (layer->styles) put_style(self, &self->plan->styles[layer->first]);
    dp_put_text(out, ">\n");
}

static void close_path(svg *self) {
    if (self->open) dp_put_text(self->out, "\"/>\n");
    self->open = false;
}

static void end_layer(void *user, const dp_layer *layer) {
    (void)layer;
    close_path(user);
    dp_put_text(((svg *)user)->out, "</g>\n");
}

/* A sign separates, too. */
static void put_step(dp_out *out, int64_t step, bool separated) {
    if (!separated && step >= 0) dp_put_char(out, ' ');
    dp_put_short(out, step);
}

static void put_points(dp_out *out, const dp_mark *m) {
    dp_trail trail = {.mark = m};
    int64_t from[2] = {0, 0};
    while (dp_trail_next(&trail) && !out->result) {
        if (trail.given <= 2) dp_put_char(out, trail.given == 1 ? 'M' : 'l');
        put_step(out, trail.at[0] - from[0], trail.given <= 2);
        put_step(out, trail.at[1] - from[1], false);
        from[0] = trail.at[0], from[1] = trail.at[1];
    }
    if (m->closed) dp_put_char(out, 'z');
}

static void put_mark(void *user, const dp_mark *m) {
    svg *const self = user;
    const dp_page_style *const s = &self->plan->styles[m->style];
    if (!m->joins) {
        close_path(self);
        dp_put_text(self->out, "<path");
        if (s->place) put_style(self, s);
        dp_put_text(self->out, " d=\"");
        self->open = true;
    }
    put_points(self->out, m);
}

static void put_attribute(dp_out *out, const char *name, double value) {
    dp_put_char(out, ' ');
    dp_put_text(out, name);
    dp_put_text(out, "=\"");
    dp_put_fixed(out, dp_fixed(value));
    dp_put_char(out, '"');
}

static void put_ground(void *user, const dp_ground *g) {
    dp_out *const out = ((svg *)user)->out;
    dp_put_text(out, "<image");
    put_attribute(out, "x", g->x);
    put_attribute(out, "y", g->y);
    put_attribute(out, "width", g->width);
    put_attribute(out, "height", g->height);
    dp_put_text(out, " preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,");
    dp_put_base64(out, g->view->ground_png, g->view->ground_png_size);
    dp_put_text(out, "\"/>\n");
}

/* ------- the document ------- */

static bool has_ground(const dp_plan *plan) {
    return plan->layer_count && plan->layers[0].kind == DP_LAYER_SURFACE;
}

/* mm: never more than the size, as programs that make pixels of it round them up. */
static double whole_micrometres(double mm) { return floor(mm * 1000 + 1e-6) / 1000; }

static void put_head(const svg *self) {
    const dp_plan *const plan = self->plan;
    dp_out *const out = self->out;
    dp_put_text(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                     "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                     "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" ");
    if (has_ground(plan)) dp_put_text(out, "xmlns:xlink=\"http://www.w3.org/1999/xlink\" ");
    dp_put_text(out, "version=\"1.1\" width=\"");
    dp_put_number(out, whole_micrometres(plan->page->width), 3);
    dp_put_text(out, "mm\" height=\"");
    dp_put_number(out, whole_micrometres(plan->page->height), 3);
    dp_put_text(out, "mm\" viewBox=\"0 0 ");
    dp_put_number(out, plan->width, 6);
    dp_put_char(out, ' ');
    dp_put_number(out, plan->height, 6);
    dp_put_text(out, "\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
}

static void put_title(const svg *self) {
    const dp_page *const page = self->plan->page;
    dp_out *const out = self->out;
    if (page->title) {
        dp_put_text(out, "<title>");
        dp_put_xml(out, page->title);
        dp_put_text(out, "</title>\n");
    }
    dp_put_text(out, "<desc>drypoint ");
    dp_put_text(out, dp_version());
    for (size_t v = 0, named = 0; v < page->view_count; v++) {
        if (!page->views[v].name) continue;
        dp_put_text(out, named++ ? ", " : ": ");
        dp_put_xml(out, page->views[v].name);
    }
    dp_put_text(out, "</desc>\n");
}

/* In a layer whose name plotters' programs leave out: they would draw around the page. */
static void put_paper(const svg *self) {
    const dp_color paper = self->plan->page->paper;
    if (!dp_is_painted(self->plan->page)) return;
    dp_put_text(self->out, "<g id=\"paper\" inkscape:groupmode=\"layer\" "
                           "inkscape:label=\"%paper\">\n"
                           "<rect width=\"100%\" height=\"100%\" fill=\"");
    put_hex(self->out, paper);
    if ((paper & 0xFF) != 0xFF) {
        dp_put_text(self->out, "\" fill-opacity=\"");
        put_alpha(self->out, paper);
    }
    dp_put_text(self->out, "\"/>\n</g>\n");
}

void dp_write_svg(dp_out *out, dp_plan *plan) {
    svg self = {.out = out, .plan = plan};
    const dp_pen pen = {&self, begin_layer, put_ground, put_mark, end_layer};
    for (size_t v = 0; v < plan->page->view_count; v++)
        if (plan->page->views[v].ground && !plan->page->views[v].ground_png) {
            out->result =
                dp_fail(out->diag, DP_ERR_ARGUMENT,
                        "view %zu has a ground, which SVG takes as a PNG (ground_png)", v);
            return;
        }
    put_head(&self);
    put_title(&self);
    put_sheet(&self);
    put_paper(&self);
    dp_plan_walk(plan, &pen, out);
    dp_put_text(out, "</svg>\n");
}
