/* Pages: checks, defaults, and the table of formats. */
#include "vector/writer.h"

#include "base/diag.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct format {
    const char *name;
    dp_page_writer *write;
} format;

static const format formats[DP_FORMAT_COUNT] = {[DP_FORMAT_SVG] = {"svg", dp_write_svg},
                                                [DP_FORMAT_PDF] = {"pdf", NULL},
                                                [DP_FORMAT_EPS] = {"eps", NULL},
                                                [DP_FORMAT_DXF] = {"dxf", NULL},
                                                [DP_FORMAT_JSON] = {"json", NULL}};

const char *dp_format_name(dp_format f) {
    return (unsigned)f < DP_FORMAT_COUNT ? formats[f].name : "unknown";
}

/* ------- output ------- */

void dp_put(dp_out *out, const void *bytes, size_t size) {
    if (out->result) return;
    out->result = out->write(out->user, bytes, size, out->diag);
    out->written += size;
}

void dp_put_text(dp_out *out, const char *text) { dp_put(out, text, strlen(text)); }

void dp_put_number(dp_out *out, double value, int decimals) {
    char text[64];
    int length = snprintf(text, sizeof text, "%.*f", decimals, value);
    for (int i = 0; i < length; i++)
        if (text[i] == ',') text[i] = '.'; /* a decimal comma */
    if (decimals) {
        while (text[length - 1] == '0') length--;
        if (text[length - 1] == '.') length--;
    }
    if (length == 2 && text[0] == '-' && text[1] == '0')
        dp_put(out, "0", 1);
    else
        dp_put(out, text, (size_t)length);
}

/* ------- pages ------- */

dp_result dp_page_write(const dp_page *page, dp_format f, dp_text_writer *write, void *user,
                        dp_diag *diag) {
    dp_out out = {write, user, diag, DP_OK, 0};
    if (!page || !write || (unsigned)f >= DP_FORMAT_COUNT)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_page_write: page, format or write is missing");
    dp_page full = *page;
    if (!formats[f].write)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s is not written yet", formats[f].name);
    if (full.width == 0 && full.height == 0 && full.view_count) {
        const dp_view_on_page *const v = &full.views[0];
        const double mm = v->mm_per_px > 0 ? v->mm_per_px : 25.4 / 96;
        full.width = v->x + mm * v->drawing->info.width,
        full.height = v->y + mm * v->drawing->info.height;
    }
    if (!(full.width > 0) || !(full.height > 0) || !isfinite(full.width) || !isfinite(full.height))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_page_write: the page has no size");
    formats[f].write(&out, &full);
    return out.result;
}

typedef struct growing {
    char *bytes;
    size_t size, cap;
} growing;

static dp_result append(void *user, const char *text, size_t size, dp_diag *diag) {
    growing *const g = user;
    if (!dp_reserve(NULL, &g->bytes, &g->cap, g->size + size, 1))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a page of %zu bytes",
                       g->size + size);
    memcpy(g->bytes + g->size, text, size);
    g->size += size;
    return DP_OK;
}

dp_result dp_page_write_memory(const dp_page *page, dp_format f, void **bytes, size_t *size,
                               dp_diag *diag) {
    growing g = {0};
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
