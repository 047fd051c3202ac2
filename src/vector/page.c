/* Pages: what may be written, defaults, and the table of formats.
 *
 * All that a page says is checked before the first byte is written, so that writers need not: numbers
 * are finite, sizes within reason. Names and texts may be anything (names.c). */
#include "vector/writer.h"

#include "base/diag.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* No page is larger than a kilometre or thinner than a nanometre, and no more than a thousand million
 * units long: numbers then have the digits that they are written with. */
static const double most_mm = 1e6, least_mm = 1e-6, most_units = 1e9;

typedef struct format {
    const char *name;
    dp_page_writer *write;
    bool millimetres, grounds; /* as in dp_plan_make */
} format;

static const format formats[DP_FORMAT_COUNT] = {
    [DP_FORMAT_SVG] = {"svg", dp_write_svg, .grounds = true},
    [DP_FORMAT_PDF] = {"pdf", dp_write_pdf, .grounds = true},
    [DP_FORMAT_EPS] = {"eps", dp_write_eps, .grounds = true},
    [DP_FORMAT_DXF] = {"dxf", dp_write_dxf, .millimetres = true},
    [DP_FORMAT_JSON] = {"json", dp_write_json, .grounds = false}};

const char *dp_format_name(dp_format f) {
    return (unsigned)f < DP_FORMAT_COUNT ? formats[f].name : "unknown";
}

/* ------- checks ------- */

static bool within(double value, double most) { return value >= -most && value <= most; }

static dp_result check_paths(const dp_drawing *d, size_t view, dp_diag *diag) {
    for (size_t i = 0; i < d->info.paths; i++) {
        const dp_stored_path *const p = &d->paths[i];
        bool finite = isfinite(p->width) && isfinite(p->dash[0]) && isfinite(p->dash[1]);
        for (size_t k = 0; k < p->count; k++)
            finite &= isfinite(d->points[p->first + k].x) && isfinite(d->points[p->first + k].y);
        if (!finite)
            return dp_fail(diag, DP_ERR_ARGUMENT,
                           "path %zu of view %zu holds a number that is not finite", i, view);
    }
    return DP_OK;
}

static dp_result check_views(const dp_page *page, dp_diag *diag) {
    for (size_t v = 0; v < page->view_count; v++) {
        const dp_view_on_page *const view = &page->views[v];
        if (!view->drawing) return dp_fail(diag, DP_ERR_ARGUMENT, "view %zu has no drawing", v);
        const double mm = dp_view_scale(view);
        if (!(view->mm_per_px >= 0) || mm < least_mm || mm > most_mm || !within(view->x, most_mm) ||
            !within(view->y, most_mm))
            return dp_fail(diag, DP_ERR_ARGUMENT,
                           "view %zu: its place and its mm_per_px must be finite and within reason",
                           v);
        const dp_result wrong = check_paths(view->drawing, v, diag);
        if (wrong) return wrong;
    }
    return DP_OK;
}

static dp_result check_marks(const dp_page *page, dp_diag *diag) {
    for (size_t i = 0; i < page->text_count; i++) {
        const dp_page_text *const t = &page->texts[i];
        if (!t->text || !within(t->x, most_mm) || !within(t->y, most_mm) || !(t->height > 0) ||
            t->height > most_mm)
            return dp_fail(diag, DP_ERR_ARGUMENT,
                           "text %zu needs letters, a place, and a height above 0 mm", i);
    }
    for (size_t i = 0; i < page->rule_count; i++) {
        const dp_page_rule *const r = &page->rules[i];
        if (!within(r->x0, most_mm) || !within(r->y0, most_mm) || !within(r->x1, most_mm) ||
            !within(r->y1, most_mm) || !(r->width >= 0) || r->width > most_mm)
            return dp_fail(diag, DP_ERR_ARGUMENT,
                           "rule %zu needs ends, and a width of 0 mm or more", i);
    }
    if (!(page->least_width >= 0) || page->least_width > most_mm)
        return dp_fail(diag, DP_ERR_ARGUMENT, "least_width must be 0 mm or more");
    return DP_OK;
}

/* The size of the first view where the page has none of its own. */
static dp_result resolve_size(dp_page *page, dp_diag *diag) {
    const dp_view_on_page *const first = page->view_count ? page->views : NULL;
    const double unit = first ? dp_view_scale(first) : 25.4 / 96;
    if (page->width == 0 && page->height == 0 && first) {
        page->width = first->x + unit * first->drawing->info.width;
        page->height = first->y + unit * first->drawing->info.height;
    }
    if (!(page->width > 0) || !(page->height > 0))
        return dp_fail(diag, DP_ERR_ARGUMENT, "a page's width and height must be above 0 mm");
    if (page->width < least_mm || page->width > most_mm || page->height < least_mm ||
        page->height > most_mm || page->width / unit > most_units ||
        page->height / unit > most_units)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a page must be a nanometre to a kilometre large, and at most %.0f pixels",
                       most_units);
    return DP_OK;
}

/* ------- pages ------- */

static dp_result write_page(const dp_page *page, const format *f, dp_out *out) {
    const dp_allocator *const given = page->view_count ? &page->views[0].drawing->memory : NULL;
    const dp_allocator memory = dp_allocator_resolve(given);
    dp_plan plan;
    const dp_result failed =
        dp_plan_make(&plan, page, f->millimetres, f->grounds, &memory, out->diag);
    if (failed) return failed;
    f->write(out, &plan);
    dp_put_flush(out);
    dp_plan_free(&plan);
    return out->result;
}

dp_result dp_page_write(const dp_page *page, dp_format f, dp_text_writer *write, void *user,
                        dp_diag *diag) {
    if (!page || !write || (unsigned)f >= DP_FORMAT_COUNT)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_page_write: page, format or write is missing");
    if ((page->view_count && !page->views) || (page->text_count && !page->texts) ||
        (page->rule_count && !page->rules))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_page_write: a list of the page is NULL");
    dp_page full = *page;
    dp_result wrong = check_views(page, diag);
    if (!wrong) wrong = check_marks(page, diag);
    if (!wrong) wrong = resolve_size(&full, diag);
    if (wrong) return wrong;
    dp_out out = {.write = write, .user = user, .diag = diag};
    return write_page(&full, &formats[f], &out);
}

typedef struct growing {
    dp_allocator memory;
    char *bytes;
    size_t size, cap;
} growing;

static dp_result append(void *user, const char *text, size_t size, dp_diag *diag) {
    growing *const g = user;
    if (!dp_reserve(&g->memory, &g->bytes, &g->cap, g->size + size, 1))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a page of %zu bytes",
                       g->size + size);
    memcpy(g->bytes + g->size, text, size);
    g->size += size;
    return DP_OK;
}

dp_result dp_page_write_memory(const dp_page *page, dp_format f, void **bytes, size_t *size,
                               dp_diag *diag) {
    growing g = {.memory = dp_allocator_resolve(NULL)}; /* dp_bytes_free knows no other */
    if (!bytes || !size)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_page_write_memory: bytes or size is NULL");
    const dp_result result = dp_page_write(page, f, append, &g, diag);
    if (result) {
        dp_bytes_free(g.bytes);
        return result;
    }
    *bytes = g.bytes;
    *size = g.size;
    return DP_OK;
}

void dp_bytes_free(void *bytes) { free(bytes); }
