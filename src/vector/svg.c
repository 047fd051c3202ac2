/* SVG: a layer per class and level, a path each line. */
#include "vector/writer.h"

#include <stdio.h>

static void put_path(dp_out *out, const dp_drawing *d, const dp_stored_path *p) {
    dp_put_text(out, "<path d=\"M");
    for (size_t i = 0; i < p->count; i++) {
        if (i) dp_put_text(out, " ");
        dp_put_number(out, (double)d->points[p->first + i].x, 3);
        dp_put_text(out, " ");
        dp_put_number(out, (double)d->points[p->first + i].y, 3);
    }
    dp_put_text(out, p->closed ? "z\"/>\n" : "\"/>\n");
}

void dp_write_svg(dp_out *out, const dp_page *page) {
    char head[256];
    const dp_drawing *const d = page->views[0].drawing;
    snprintf(head, sizeof head,
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%gmm\" height=\"%gmm\" "
             "viewBox=\"0 0 %u %u\">\n<g fill=\"none\" stroke=\"#000\" stroke-width=\"2\" "
             "stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
             page->width, page->height, d->info.width, d->info.height);
    dp_put_text(out, head);
    for (size_t i = 0; i < d->info.paths; i++) put_path(out, d, &d->paths[i]);
    dp_put_text(out, "</g>\n</svg>\n");
}
