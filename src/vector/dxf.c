/* DXF of release 12 (AC1009), which every program reads: millimetres, y up, from the page's lower left
 * corner.
 *
 * A layer per class and level, with the colour (the nearest of AutoCAD's 255) and the line type of
 * its first line; lines of another style have their own. Line types have their lengths in
 * millimetres. Release 12 knows no width of lines but the drawn one of a polyline, which plotters take
 * for a shape: lines come without. Grounds and paper do not come.
 *
 * A file is pairs of lines: a group code, and its value. */
#include "vector/writer.h"

#include "base/diag.h"
#include "base/memory.h"

typedef struct dxf {
    dp_out *out;
    dp_plan *plan;
    uint32_t *types; /* [style]: number of its line type; 0: continuous */
    size_t types_cap;
    uint32_t dashed, dotted; /* how many line types there are of each */
} dxf;

/* ------- pairs ------- */

static void put_code(dp_out *out, int code) {
    dp_put_integer(out, (uint64_t)code);
    dp_put_char(out, '\n');
}

static void put_name(dp_out *out, int code, const char *text) {
    put_code(out, code);
    dp_put_text(out, text);
    dp_put_char(out, '\n');
}

static void put_integer(dp_out *out, int code, uint64_t value) {
    put_code(out, code);
    dp_put_integer(out, value);
    dp_put_char(out, '\n');
}

static void put_fixed(dp_out *out, int code, int64_t thousandths) {
    put_code(out, code);
    dp_put_fixed(out, thousandths);
    dp_put_text(out, thousandths % DP_FIXED_ONE ? "\n" : ".0\n"); /* a real has a point */
}

static void put_place(dp_out *out, int64_t x, int64_t y) {
    put_fixed(out, 10, x);
    put_fixed(out, 20, y);
    put_fixed(out, 30, 0);
}

/* ------- colours ------- */

/* AutoCAD's colour number `index`, which the format refers to: 1 to 9 by name, 10 to 249 by hue (24 of
 * them), value (5) and saturation (2), 250 to 255 greys. */
static void color_of_index(int index, int rgb[3]) {
    static const int named[][3] = {{255, 0, 0},     {255, 255, 0},   {0, 255, 0},
                                   {0, 255, 255},   {0, 0, 255},     {255, 0, 255},
                                   {255, 255, 255}, {128, 128, 128}, {192, 192, 192}};
    static const int values[] = {255, 165, 127, 76, 38}, greys[] = {51, 80, 105, 130, 190, 255};
    if (index >= 250 || index < 10) {
        for (int i = 0; i < 3; i++) rgb[i] = index < 10 ? named[index - 1][i] : greys[index - 250];
        return;
    }
    const int hue = index / 10 - 1,
              value = values[index % 10 / 2]; /* hue: 0 to 23, 15 degrees each */
    const int least = index % 2 ? value / 2 : 0;
    for (int i = 0; i < 3; i++) {
        int away = (hue - 8 * i + 24) % 24; /* from the hue of red, green or blue */
        if (away > 12) away = 24 - away;
        const int part = away <= 4 ? 4 : away >= 8 ? 0 : 8 - away; /* quarters */
        rgb[i] = least + (value - least) * part / 4;
    }
}

/* The nearest number; black is 7, which is black on white and white on black. */
static int index_of(dp_color color) {
    const int own[3] = {(int)(color >> 24), (int)(color >> 16 & 0xFF), (int)(color >> 8 & 0xFF)};
    int best = 7, least = own[0] * own[0] + own[1] * own[1] + own[2] * own[2];
    for (int index = 1; index < 256; index++) {
        int rgb[3], sum = 0;
        color_of_index(index, rgb);
        for (int i = 0; i < 3; i++) sum += (rgb[i] - own[i]) * (rgb[i] - own[i]);
        if (sum < least) least = sum, best = index;
    }
    return best;
}

static dp_color seen_color(const dxf *self, dp_color color) {
    const dp_page *const page = self->plan->page;
    return dp_blend(color, dp_is_painted(page) ? page->paper : DP_RGB(255, 255, 255));
}

/* ------- line types ------- */

static bool is_dotted(const dp_page_style *s) { return s->dash[1] && !s->dash[0]; }

/* "DASHED", "DASHED2", …; "DOTTED", … */
static void put_type_name(const dxf *self, int code, size_t style) {
    put_code(self->out, code);
    if (!self->types[style]) {
        dp_put_text(self->out, "CONTINUOUS\n");
        return;
    }
    dp_put_text(self->out, is_dotted(&self->plan->styles[style]) ? "DOTTED" : "DASHED");
    if (self->types[style] > 1) dp_put_integer(self->out, self->types[style]);
    dp_put_char(self->out, '\n');
}

static bool are_dashed_alike(const dp_page_style *a, const dp_page_style *b) {
    return a->dash[0] == b->dash[0] && a->dash[1] == b->dash[1];
}

static bool name_types(dxf *self) {
    const dp_plan *const plan = self->plan;
    if (!dp_reserve(&plan->memory, &self->types, &self->types_cap, plan->style_count + 1,
                    sizeof *self->types))
        return false;
    for (size_t i = 0; i < plan->style_count; i++) {
        const dp_page_style *const s = &plan->styles[i];
        self->types[i] = 0;
        for (size_t k = 0; k < i && s->dash[1] && !self->types[i]; k++)
            if (plan->styles[k].dash[1] && are_dashed_alike(s, &plan->styles[k]))
                self->types[i] = self->types[k];
        if (s->dash[1] && !self->types[i])
            self->types[i] = is_dotted(s) ? ++self->dotted : ++self->dashed;
    }
    return true;
}

static void put_type(const dxf *self, size_t style, const char *what, const int64_t dash[2]) {
    dp_out *const out = self->out;
    put_name(out, 0, "LTYPE");
    put_type_name(self, 2, style);
    put_integer(out, 70, 0);
    put_name(out, 3, what);
    put_integer(out, 72, 65);
    put_integer(out, 73, 2);
    put_fixed(out, 40, dash[0] + dash[1]);
    put_fixed(out, 49, dash[0]);
    put_fixed(out, 49, -dash[1]);
}

static void put_types(const dxf *self) {
    dp_out *const out = self->out;
    uint32_t dashed = 0, dotted = 0;
    put_name(out, 0, "TABLE\n2\nLTYPE");
    put_integer(out, 70, UINT64_C(1) + self->dashed + self->dotted);
    put_name(out, 0, "LTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid line\n72\n65\n73\n0\n40\n0.0");
    for (size_t i = 0; i < self->plan->style_count; i++) {
        const dp_page_style *const s = &self->plan->styles[i];
        uint32_t *const known = is_dotted(s) ? &dotted : &dashed;
        if (self->types[i] <= *known) continue;
        *known = self->types[i];
        put_type(self, i, is_dotted(s) ? ". . . . ." : "__ __ __", s->dash);
    }
    put_name(out, 0, "ENDTAB");
}

/* ------- layers ------- */

static void put_layer_name(dp_out *out, int code, const dp_layer *layer) {
    char name[DP_LAYER_NAME];
    put_name(out, code, dp_layer_name(name, layer, '_', true));
}

static void put_layers(const dxf *self) {
    const dp_plan *const plan = self->plan;
    dp_out *const out = self->out;
    put_name(out, 0, "TABLE\n2\nLAYER");
    put_integer(out, 70, plan->layer_count + 1);
    put_name(out, 0, "LAYER\n2\n0\n70\n0\n62\n7\n6\nCONTINUOUS"); /* every file has it */
    for (size_t i = 0; i < plan->layer_count; i++) {
        const dp_layer *const layer = &plan->layers[i];
        put_name(out, 0, "LAYER");
        put_layer_name(out, 2, layer);
        put_integer(out, 70, 0);
        if (layer->styles) {
            const dp_color color = plan->styles[layer->first].color;
            put_integer(out, 62, (uint64_t)index_of(seen_color(self, color)));
            put_type_name(self, 6, layer->first);
        } else {
            put_name(out, 62, "7\n6\nCONTINUOUS");
        }
    }
    put_name(out, 0, "ENDTAB");
}

/* ------- lines ------- */

/* Of a polyline and of its points: the layer; and colour and line type where they are not the
 * layer's. */
static void put_properties(const dxf *self, uint32_t style) {
    const dp_plan *const plan = self->plan;
    const dp_page_style *const s = &plan->styles[style];
    const dp_layer *const layer = &plan->layers[s->layer];
    put_layer_name(self->out, 8, layer);
    if (style == layer->first) return;
    const int color = index_of(seen_color(self, s->color));
    if (color != index_of(seen_color(self, plan->styles[layer->first].color)))
        put_integer(self->out, 62, (uint64_t)color);
    if (self->types[style] != self->types[layer->first] ||
        is_dotted(s) != is_dotted(&plan->styles[layer->first]))
        put_type_name(self, 6, style);
}

static void put_mark(void *user, const dp_mark *m) {
    const dxf *const self = user;
    dp_out *const out = self->out;
    const dp_layer *const layer = &self->plan->layers[self->plan->styles[m->style].layer];
    dp_trail trail = {.mark = m};
    put_name(out, 0, "POLYLINE");
    put_properties(self, m->style);
    put_integer(out, 66, 1);
    put_place(out, 0, 0);
    /* 1: closed; 128: dashes run on past its points */
    put_integer(out, 70, (m->closed ? 1 : 0) + (self->types[m->style] ? 128 : 0));
    while (dp_trail_next(&trail) && !out->result) {
        put_name(out, 0, "VERTEX");
        put_layer_name(out, 8, layer);
        put_place(out, trail.at[0], trail.at[1]);
    }
    put_name(out, 0, "SEQEND");
    put_layer_name(out, 8, layer);
}

/* ------- the document ------- */

static void put_comment(dp_out *out, const char *what, const char *text) {
    put_code(out, 999);
    dp_put_text(out, what);
    dp_put_ascii(out, text);
    dp_put_char(out, '\n');
}

static void put_corner(dp_out *out, const char *name, double x, double y) {
    put_name(out, 9, name);
    put_fixed(out, 10, dp_fixed(x));
    put_fixed(out, 20, dp_fixed(y));
}

static void put_head(const dxf *self) {
    const dp_page *const page = self->plan->page;
    dp_out *const out = self->out;
    put_comment(out, "drypoint ", dp_version());
    put_comment(out, "units: millimetres", "");
    if (page->title) put_comment(out, "title: ", page->title);
    put_name(out, 0, "SECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009");
    put_corner(out, "$EXTMIN", 0, 0);
    put_corner(out, "$EXTMAX", page->width, page->height);
    put_corner(out, "$LIMMIN", 0, 0);
    put_corner(out, "$LIMMAX", page->width, page->height);
    put_name(out, 9, "$LTSCALE\n40\n1.0");
    put_name(out, 0, "ENDSEC\n0\nSECTION\n2\nTABLES");
    put_types(self);
    put_layers(self);
    put_name(out, 0, "ENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nENDSEC\n0\nSECTION\n2\nENTITIES");
}

void dp_write_dxf(dp_out *out, dp_plan *plan) {
    dxf self = {.out = out, .plan = plan};
    const dp_pen pen = {.user = &self, .mark = put_mark};
    if (!name_types(&self)) {
        out->result = dp_fail(out->diag, DP_ERR_MEMORY, "out of memory for the styles of a page");
        return;
    }
    put_head(&self);
    dp_plan_walk(plan, &pen, out);
    put_name(out, 0, "ENDSEC\n0\nEOF");
    dp_free(&plan->memory, self.types);
}
