/* The strokes of a text, for who draws pages elsewhere. */
#include "vector/font.h"

#include <drypoint/drawing.h>

void dp_page_text_strokes(const dp_page_text *text, dp_text_stroke *stroke, void *user) {
    double points[DP_LETTER_STROKE_MOST][2];
    size_t count;
    if (!text || !text->text || !stroke) return;
    const double unit = text->height / DP_LETTER_HEIGHT;
    dp_lettering lettering = {.rest = text->text};
    while ((count = dp_next_stroke(&lettering, points))) {
        for (size_t i = 0; i < count; i++) {
            points[i][0] = text->x + unit * points[i][0];
            points[i][1] = text->y - unit * points[i][1];
        }
        stroke(user, (const double(*)[2])points, count);
    }
}
