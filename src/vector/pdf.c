/* PDF 1.5: one page, whose layers are optional content that viewers can switch off.
 *
 *     1 catalog   2 pages   3 page   4 information   5 … a group of optional content per layer
 *     then, as they come: parts of the page's content, and images of grounds
 *
 * Content is in units of the page with y down, which its first operator makes of PDF's points. It is
 * gathered in parts of some ten thousand bytes, each a stream of its own, cut between operators: so
 * memory does not grow with the page, though a compressor takes a stream at once. What names all
 * objects (page, catalog, cross-references) comes last. The same page gives the same bytes: there are
 * no dates, and no identifier.
 *
 * Not handled: UserUnit; some viewers show no more than 14400 points (5 m). */
#include "vector/writer.h"

#include "base/diag.h"
#include "base/memory.h"

#include <string.h>

enum { CATALOG = 1, PAGES, PAGE, INFORMATION, FIRST_LAYER, PART = 1 << 16 /* bytes */ };

typedef struct pdf {
    dp_out *out;
    dp_plan *plan;
    dp_out text; /* the page's content, into: */
    char *part;
    size_t part_size, part_cap;
    uint64_t part_begin; /* of text.put */
    uint64_t *offsets;   /* [objects], from object 1 on; 0: not written yet */
    size_t objects, offsets_cap;
    uint32_t *contents, *images; /* numbers of their objects */
    size_t content_count, contents_cap, image_count, images_cap;
    bool alphas[256]; /* which are used */
    uint32_t layer;   /* that is open */
    dp_page_style now;
    bool open; /* a path */
} pdf;

static const dp_array arrays[] = {
    DP_ARRAY(pdf, part, part_cap), DP_ARRAY(pdf, offsets, offsets_cap),
    DP_ARRAY(pdf, contents, contents_cap), DP_ARRAY(pdf, images, images_cap)};

static void run_out_of_memory(pdf *self) {
    if (!self->out->result)
        self->out->result = dp_fail(self->out->diag, DP_ERR_MEMORY, "out of memory for a PDF");
}

/* ------- objects ------- */

static uint32_t new_object(pdf *self) {
    if (!dp_reserve(&self->plan->memory, &self->offsets, &self->offsets_cap, self->objects + 1,
                    sizeof *self->offsets)) {
        run_out_of_memory(self);
        return 0;
    }
    self->offsets[self->objects++] = 0;
    return (uint32_t)self->objects;
}

static void remember(pdf *self, uint32_t **list, size_t *count, size_t *cap, uint32_t object) {
    if (dp_reserve(&self->plan->memory, list, cap, *count + 1, sizeof **list))
        (*list)[(*count)++] = object;
    else
        run_out_of_memory(self);
}

static void begin_object(pdf *self, uint32_t object) {
    if (object) self->offsets[object - 1] = self->out->put;
    dp_put_integer(self->out, object);
    dp_put_text(self->out, " 0 obj\n");
}

static void end_object(pdf *self) { dp_put_text(self->out, "\nendobj\n"); }

static void put_reference(dp_out *out, uint64_t object) {
    dp_put_integer(out, object);
    dp_put_text(out, " 0 R");
}

static dp_result put_through(void *user, const char *bytes, size_t size, dp_diag *diag) {
    dp_out *const out = user;
    (void)diag;
    dp_put(out, bytes, size);
    return out->result;
}

/* Ends a dictionary, of which `<<` and what else it says is written, and its object. */
static void put_stream(pdf *self, const void *bytes, size_t size) {
    dp_out *const out = self->out;
    dp_compressor *const compress = self->plan->page->compress;
    const uint32_t length = compress ? new_object(self) : 0;
    if (out->result) return;
    dp_put_text(out, "/Length ");
    if (compress) {
        put_reference(out, length);
        dp_put_text(out, "/Filter/FlateDecode");
    } else {
        dp_put_integer(out, size);
    }
    dp_put_text(out, ">>\nstream\n");
    const uint64_t begin = out->put;
    if (compress) {
        const dp_result result = compress(bytes, size, put_through, out, out->diag);
        if (!out->result) out->result = result;
    } else {
        dp_put(out, bytes, size);
    }
    const uint64_t written = out->put - begin;
    dp_put_text(out, "\nendstream");
    end_object(self);
    if (!compress) return;
    begin_object(self, length);
    dp_put_integer(out, written);
    end_object(self);
}

/* ------- content ------- */

static dp_result add_to_part(void *user, const char *bytes, size_t size, dp_diag *diag) {
    pdf *const self = user;
    if (!dp_reserve(&self->plan->memory, &self->part, &self->part_cap, self->part_size + size, 1))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a PDF");
    memcpy(self->part + self->part_size, bytes, size);
    self->part_size += size;
    return DP_OK;
}

static void end_part(pdf *self) {
    dp_put_flush(&self->text);
    if (!self->out->result) self->out->result = self->text.result;
    if (self->part_size && !self->out->result) {
        const uint32_t object = new_object(self);
        remember(self, &self->contents, &self->content_count, &self->contents_cap, object);
        begin_object(self, object);
        dp_put_text(self->out, "<<");
        put_stream(self, self->part, self->part_size);
    }
    self->part_size = 0;
    self->part_begin = self->text.put;
}

/* Ends an operator: content may be cut after it. */
static void put_operator(pdf *self, const char *name) {
    dp_put_text(&self->text, name);
    dp_put_char(&self->text, '\n');
    if (self->text.put - self->part_begin >= PART) end_part(self);
}

static void put_operand(pdf *self, int64_t thousandths) {
    dp_put_short(&self->text, thousandths);
    dp_put_char(&self->text, ' ');
}

/* ------- styles ------- */

static void put_color(pdf *self, dp_color color, const char *gray, const char *rgb) {
    const uint32_t r = color >> 24, g = color >> 16 & 0xFF, b = color >> 8 & 0xFF;
    const bool is_gray = r == g && g == b;
    put_operand(self, dp_fixed(r / 255.0));
    if (!is_gray) put_operand(self, dp_fixed(g / 255.0));
    if (!is_gray) put_operand(self, dp_fixed(b / 255.0));
    put_operator(self, is_gray ? gray : rgb);
}

static void put_alpha(pdf *self, dp_color color) {
    self->alphas[color & 0xFF] = true;
    dp_put_text(&self->text, "/A");
    dp_put_integer(&self->text, color & 0xFF);
    dp_put_char(&self->text, ' ');
    put_operator(self, "gs");
}

/* The changes from the style that the pen has. */
static void put_style(pdf *self, const dp_page_style *s) {
    dp_page_style *const now = &self->now;
    if ((s->color ^ now->color) >> 8) put_color(self, s->color, "G", "RG");
    if ((s->color ^ now->color) & 0xFF) put_alpha(self, s->color);
    if (s->width != now->width) {
        put_operand(self, s->width);
        put_operator(self, "w");
    }
    if (s->dash[0] != now->dash[0] || s->dash[1] != now->dash[1]) {
        dp_put_char(&self->text, '[');
        if (s->dash[1]) {
            put_operand(self, s->dash[0]);
            dp_put_short(&self->text, s->dash[1]);
        }
        dp_put_text(&self->text, "]0 ");
        put_operator(self, "d");
    }
    *now = *s;
}

/* ------- layers ------- */

static void begin_layer(void *user, const dp_layer *layer) {
    pdf *const self = user;
    (void)layer;
    dp_put_text(&self->text, "/OC/L");
    dp_put_integer(&self->text, self->layer++);
    dp_put_char(&self->text, ' ');
    put_operator(self, "BDC");
}

static void stroke(pdf *self) {
    if (self->open) put_operator(self, "S");
    self->open = false;
}

static void end_layer(void *user, const dp_layer *layer) {
    (void)layer;
    stroke(user);
    put_operator(user, "EMC");
}

static void put_mark(void *user, const dp_mark *m) {
    pdf *const self = user;
    dp_trail trail = {.mark = m};
    if (!m->joins) {
        stroke(self);
        put_style(self, &self->plan->styles[m->style]);
    }
    while (dp_trail_next(&trail) && !self->out->result) {
        put_operand(self, trail.at[0]);
        put_operand(self, trail.at[1]);
        put_operator(self, trail.given == 1 ? "m" : "l");
    }
    if (m->closed) put_operator(self, "h");
    self->open = true;
}

/* ------- grounds ------- */

static bool is_opaque(const uint8_t *rgba, size_t pixels) {
    uint8_t all = 0xFF;
    for (size_t i = 0; i < pixels; i++) all &= rgba[4 * i + 3];
    return all == 0xFF;
}

/* An image of `channels` (3: colour, 1: how opaque) of a ground. */
static uint32_t put_image(pdf *self, const dp_ground *g, size_t channels, uint32_t mask) {
    dp_out *const out = self->out;
    const size_t pixels = dp_times(g->columns, g->rows);
    const uint8_t *const rgba = g->view->ground;
    const uint32_t object = new_object(self);
    uint8_t *const bytes = dp_alloc_array(&self->plan->memory, pixels, channels);
    if (!bytes) run_out_of_memory(self);
    if (!out->result) {
        for (size_t i = 0; i < pixels; i++)
            memcpy(bytes + channels * i, rgba + 4 * i + (channels == 1 ? 3 : 0), channels);
        begin_object(self, object);
        dp_put_text(out, "<</Type/XObject/Subtype/Image/BitsPerComponent 8/ColorSpace/Device");
        dp_put_text(out, channels == 1 ? "Gray/Width " : "RGB/Width ");
        dp_put_integer(out, g->columns);
        dp_put_text(out, "/Height ");
        dp_put_integer(out, g->rows);
        if (mask) {
            dp_put_text(out, "/SMask ");
            put_reference(out, mask);
        }
        put_stream(self, bytes, pixels * channels);
    }
    dp_free(&self->plan->memory, bytes);
    return object;
}

static void put_ground(void *user, const dp_ground *g) {
    pdf *const self = user;
    if (!g->view->ground || !g->columns || !g->rows) return;
    const bool opaque = is_opaque(g->view->ground, (size_t)g->columns * g->rows);
    const uint32_t mask = opaque ? 0 : put_image(self, g, 1, 0);
    const uint32_t image = put_image(self, g, 3, mask);
    put_operator(self, "q");
    put_operand(self, dp_fixed(g->width));
    dp_put_text(&self->text, "0 0 ");
    put_operand(self, dp_fixed(-g->height));
    put_operand(self, dp_fixed(g->x));
    put_operand(self, dp_fixed(g->y + g->height));
    put_operator(self, "cm");
    dp_put_text(&self->text, "/I");
    dp_put_integer(&self->text, self->image_count);
    dp_put_char(&self->text, ' ');
    put_operator(self, "Do");
    put_operator(self, "Q");
    remember(self, &self->images, &self->image_count, &self->images_cap, image);
}

/* ------- the document ------- */

static void put_content(pdf *self) {
    const dp_plan *const plan = self->plan;
    const double points = plan->unit * 72 / 25.4;
    const dp_pen pen = {self, begin_layer, put_ground, put_mark, end_layer};
    dp_put_number(&self->text, points, 9);
    dp_put_text(&self->text, " 0 0 ");
    dp_put_number(&self->text, -points, 9);
    dp_put_text(&self->text, " 0 ");
    dp_put_number(&self->text, plan->page->height * 72 / 25.4, 6);
    put_operator(self, " cm");
    put_operator(self, "1 J 1 j");
    if (dp_is_painted(plan->page)) {
        put_color(self, plan->page->paper, "g", "rg");
        if ((plan->page->paper & 0xFF) != 0xFF) put_alpha(self, plan->page->paper);
        dp_put_text(&self->text, "0 0 ");
        dp_put_number(&self->text, plan->width, 6);
        dp_put_char(&self->text, ' ');
        dp_put_number(&self->text, plan->height, 6);
        put_operator(self, " re f");
        if ((plan->page->paper & 0xFF) != 0xFF) put_alpha(self, 0xFF);
    }
    dp_plan_walk(self->plan, &pen, self->out);
    end_part(self);
}

static void put_catalog(pdf *self) {
    dp_out *const out = self->out;
    const size_t layers = self->plan->layer_count;
    begin_object(self, CATALOG);
    dp_put_text(out, "<</Type/Catalog/Pages 2 0 R");
    if (layers) {
        dp_put_text(out, "\n/OCProperties<</OCGs[");
        for (size_t i = 0; i < layers; i++)
            put_reference(out, FIRST_LAYER + i), dp_put_char(out, ' ');
        dp_put_text(out, "]\n/D<</Order["); /* as lists of layers have it: the upper first */
        for (size_t i = layers; i--;) put_reference(out, FIRST_LAYER + i), dp_put_char(out, ' ');
        dp_put_text(out, "]>>>>");
    }
    dp_put_text(out, ">>");
    end_object(self);
    begin_object(self, PAGES);
    dp_put_text(out, "<</Type/Pages/Kids[3 0 R]/Count 1>>");
    end_object(self);
}

static void put_layers(pdf *self) {
    dp_out *const out = self->out;
    for (size_t i = 0; i < self->plan->layer_count; i++) {
        const dp_layer *const layer = &self->plan->layers[i];
        char name[DP_LAYER_NAME];
        begin_object(self, (uint32_t)(FIRST_LAYER + i));
        dp_put_text(out, "<</Type/OCG/Name(");
        dp_put_integer(out, dp_layer_number(layer));
        dp_put_char(out, ' ');
        dp_put_text(out, dp_layer_name(name, layer, ' ', false));
        dp_put_text(out, ")>>");
        end_object(self);
    }
}

/* A dictionary of resources: names with numbers, and the objects that they stand for. */
static void put_names(pdf *self, const char *kind, const char *name, const uint32_t *objects,
                      size_t first, size_t count) {
    if (!count) return;
    dp_put_text(self->out, kind);
    for (size_t i = 0; i < count; i++) {
        dp_put_text(self->out, name);
        dp_put_integer(self->out, i);
        dp_put_char(self->out, ' ');
        put_reference(self->out, objects ? objects[i] : first + i);
    }
    dp_put_text(self->out, ">>\n");
}

static void put_alphas(pdf *self) {
    dp_put_text(self->out, "/ExtGState<<");
    for (uint32_t a = 0; a < 256; a++) {
        if (!self->alphas[a]) continue;
        dp_put_text(self->out, "/A");
        dp_put_integer(self->out, a);
        dp_put_text(self->out, "<</CA ");
        dp_put_short(self->out, dp_fixed(a / 255.0));
        dp_put_text(self->out, "/ca ");
        dp_put_short(self->out, dp_fixed(a / 255.0));
        dp_put_text(self->out, ">>");
    }
    dp_put_text(self->out, ">>\n");
}

static void put_page(pdf *self) {
    dp_out *const out = self->out;
    const dp_page *const page = self->plan->page;
    begin_object(self, PAGE);
    dp_put_text(out, "<</Type/Page/Parent 2 0 R/MediaBox[0 0 ");
    dp_put_number(out, page->width * 72 / 25.4, 6);
    dp_put_char(out, ' ');
    dp_put_number(out, page->height * 72 / 25.4, 6);
    dp_put_text(out, "]\n/Resources<<\n");
    put_names(self, "/Properties<<", "/L", NULL, FIRST_LAYER, self->plan->layer_count);
    put_names(self, "/XObject<<", "/I", self->images, 0, self->image_count);
    put_alphas(self);
    dp_put_text(out, ">>\n/Contents[");
    for (size_t i = 0; i < self->content_count; i++)
        put_reference(out, self->contents[i]), dp_put_char(out, ' ');
    dp_put_text(out, "]>>");
    end_object(self);
}

static void put_information(pdf *self) {
    begin_object(self, INFORMATION);
    dp_put_text(self->out, "<</Producer(drypoint ");
    dp_put_text(self->out, dp_version());
    dp_put_char(self->out, ')');
    if (self->plan->page->title) {
        dp_put_text(self->out, "/Title");
        dp_put_pdf(self->out, self->plan->page->title);
    }
    dp_put_text(self->out, ">>");
    end_object(self);
}

static void put_references(pdf *self) {
    dp_out *const out = self->out;
    const uint64_t begin = out->put;
    dp_put_text(out, "xref\n0 ");
    dp_put_integer(out, self->objects + 1);
    dp_put_text(out, "\n0000000000 65535 f \n");
    for (size_t i = 0; i < self->objects; i++) {
        dp_put_padded(out, self->offsets[i], 10);
        dp_put_text(out, " 00000 n \n");
    }
    dp_put_text(out, "trailer\n<</Size ");
    dp_put_integer(out, self->objects + 1);
    dp_put_text(out, "/Root 1 0 R/Info 4 0 R>>\nstartxref\n");
    dp_put_integer(out, begin);
    dp_put_text(out, "\n%%EOF\n");
}

static void write_document(pdf *self) {
    dp_put_text(self->out, "%PDF-1.5\n%\xE2\xE3\xCF\xD3\n");
    for (size_t i = 1; i < FIRST_LAYER + self->plan->layer_count; i++) (void)new_object(self);
    put_content(self);
    if (self->out->result) return; /* of memory, lists may be too short */
    put_layers(self);
    put_page(self);
    put_information(self);
    put_catalog(self);
    put_references(self);
}

void dp_write_pdf(dp_out *out, dp_plan *plan) {
    pdf self = {.out = out, .plan = plan, .now = {.color = DP_RGB(0, 0, 0), .width = 1000}};
    self.text = (dp_out){.write = add_to_part, .user = &self, .diag = out->diag};
    write_document(&self);
    dp_arrays_free(&plan->memory, &self, DP_ARRAYS(arrays));
}
