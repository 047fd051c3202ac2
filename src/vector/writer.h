/* What the writers of pages share: a page with its defaults, its layers, and text put piece by
 * piece. */
#ifndef DP_VECTOR_WRITER_H
#define DP_VECTOR_WRITER_H

#include "vector/drawing.h"

/* Where bytes go; the first failure stays, and nothing is written after it. */
typedef struct dp_out {
    dp_text_writer *write;
    void *user;
    dp_diag *diag;
    dp_result result;
    size_t written; /* bytes */
} dp_out;

void dp_put(dp_out *out, const void *bytes, size_t size);
void dp_put_text(dp_out *out, const char *text);
/* A number with up to `decimals` places behind the point, without trailing zeros, in any locale. */
void dp_put_number(dp_out *out, double value, int decimals);

/* One format: writes a whole page, whose defaults are resolved. */
typedef void dp_page_writer(dp_out *out, const dp_page *page);
dp_page_writer dp_write_svg;

#endif
