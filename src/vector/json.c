/* JSON: what a drawing knows of its lines, for programs (docs/vector.md, docs/drawing.schema.json).
 *
 * A path's points come as columns (points, distance, world, polygons, edges): shorter than an object
 * for each, and as programs want them. Pixels have three places, distances nine digits and places in
 * the world twelve: a micrometre at a thousand kilometres. What is not known is null. Polygons are
 * counted in 64 bits, of which many readers keep 53: larger numbers come as texts of digits. */
#include "vector/writer.h"

enum { WORLD_DIGITS = 12, DISTANCE_DIGITS = 9, WIDTH_DIGITS = 7 };

static void put_key(dp_out *out, const char *key) {
    dp_put_char(out, '"');
    dp_put_text(out, key);
    dp_put_text(out, "\":");
}

static void put_large(dp_out *out, uint64_t value) {
    const bool exact = value <= UINT64_C(1) << 53;
    if (value == UINT64_MAX) {
        dp_put_text(out, "null");
        return;
    }
    if (!exact) dp_put_char(out, '"');
    dp_put_integer(out, value);
    if (!exact) dp_put_char(out, '"');
}

/* "#rrggbbaa" */
static void put_color(dp_out *out, dp_color color) {
    dp_put_text(out, "\"#");
    for (int shift = 28; shift >= 0; shift -= 4)
        dp_put_char(out, "0123456789abcdef"[color >> shift & 15]);
    dp_put_char(out, '"');
}

static void put_numbers(dp_out *out, const double *values, size_t count) {
    dp_put_char(out, '[');
    for (size_t i = 0; i < count; i++) {
        if (i) dp_put_char(out, ',');
        dp_put_digits(out, values[i], WORLD_DIGITS);
    }
    dp_put_char(out, ']');
}

/* ------- columns of points ------- */

typedef void put_cell(dp_out *out, const dp_path_point *point);

static void put_place(dp_out *out, const dp_path_point *p) {
    dp_put_char(out, '[');
    dp_put_fixed(out, dp_fixed((double)p->x));
    dp_put_char(out, ',');
    dp_put_fixed(out, dp_fixed((double)p->y));
    dp_put_char(out, ']');
}

static void put_distance(dp_out *out, const dp_path_point *p) {
    dp_put_digits(out, (double)p->distance, DISTANCE_DIGITS);
}

static void put_world(dp_out *out, const dp_path_point *p) { put_numbers(out, p->world, 3); }

static void put_polygon(dp_out *out, const dp_path_point *p) { put_large(out, p->polygon); }

/* No edge: an intersection's line, or none. */
static void put_edge(dp_out *out, const dp_path_point *p) {
    put_large(out, p->edge == UINT32_MAX || p->polygon == UINT64_MAX ? UINT64_MAX : p->edge);
}

static const struct column {
    const char *key;
    put_cell *put;
    bool of_lines; /* an open path has one less than points */
} columns[] = {{"points", put_place, false},
               {"distance", put_distance, false},
               {"world", put_world, false},
               {"polygons", put_polygon, true},
               {"edges", put_edge, true}};

static void put_column(dp_out *out, const struct column *column, const dp_path_point *points,
                       size_t count) {
    dp_put_text(out, ",\n");
    put_key(out, column->key);
    dp_put_char(out, '[');
    for (size_t i = 0; i < count && !out->result; i++) {
        if (i) dp_put_char(out, ',');
        column->put(out, &points[i]);
    }
    dp_put_char(out, ']');
}

/* ------- paths ------- */

static void put_end(dp_out *out, dp_line_end end, uint64_t hider) {
    static const char *const kinds[] = {"vertex", "crossing", "hidden", "picture", "detail"};
    dp_put_char(out, '{');
    put_key(out, "kind");
    dp_put_json(out, (unsigned)end < sizeof kinds / sizeof *kinds ? kinds[end] : NULL);
    if (end == DP_END_HIDDEN) {
        dp_put_char(out, ',');
        put_key(out, "hider");
        put_large(out, hider);
    }
    dp_put_char(out, '}');
}

/* A member, after others. */
static void put_next(dp_out *out, const char *key) {
    dp_put_char(out, ',');
    put_key(out, key);
}

static void put_head(dp_out *out, const dp_stored_path *p) {
    dp_put_char(out, '{');
    put_key(out, "line");
    dp_put_json(out, dp_line_name(p->line));
    put_next(out, "level");
    dp_put_integer(out, p->level);
    put_next(out, "group");
    dp_put_integer(out, p->group);
    put_next(out, "width");
    dp_put_digits(out, (double)p->width, WIDTH_DIGITS);
    put_next(out, "color");
    put_color(out, p->color);
    put_next(out, "dash");
    const double dash[2] = {(double)p->dash[0], (double)p->dash[1]};
    if (dash[1] > 0)
        put_numbers(out, dash, 2);
    else
        dp_put_text(out, "null");
    put_next(out, "closed");
    dp_put_text(out, p->closed ? "true" : "false");
    put_next(out, "length");
    dp_put_fixed(out, dp_fixed((double)p->length));
    put_next(out, "ends");
    dp_put_char(out, '[');
    for (int i = 0; i < 2 && !p->closed; i++) {
        if (i) dp_put_char(out, ',');
        put_end(out, p->end[i], p->hider[i]);
    }
    dp_put_char(out, ']');
}

static void put_path(dp_out *out, const dp_drawing *d, const dp_stored_path *p) {
    put_head(out, p);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        put_column(out, &columns[i], d->points + p->first,
                   p->count - (columns[i].of_lines && !p->closed && p->count));
    dp_put_char(out, '}');
}

/* ------- the document ------- */

static void put_view(dp_out *out, const dp_view_on_page *view) {
    const dp_drawing *const d = view->drawing;
    dp_put_char(out, '{');
    put_key(out, "name");
    dp_put_json(out, view->name);
    put_next(out, "x");
    dp_put_number(out, view->x, 6);
    put_next(out, "y");
    dp_put_number(out, view->y, 6);
    put_next(out, "mm_per_px");
    dp_put_digits(out, dp_view_scale(view), WORLD_DIGITS);
    put_next(out, "width");
    dp_put_integer(out, d->info.width);
    put_next(out, "height");
    dp_put_integer(out, d->info.height);
    put_next(out, "levels");
    dp_put_integer(out, d->info.levels);
    put_next(out, "paths");
    dp_put_char(out, '[');
    for (size_t i = 0; i < d->info.paths && !out->result; i++) {
        dp_put_text(out, i ? ",\n" : "\n");
        put_path(out, d, &d->paths[i]);
    }
    dp_put_text(out, "]}");
}

static void put_text(dp_out *out, const dp_page_text *t) {
    dp_put_char(out, '{');
    put_key(out, "text");
    dp_put_json(out, t->text);
    put_next(out, "x");
    dp_put_number(out, t->x, 6);
    put_next(out, "y");
    dp_put_number(out, t->y, 6);
    put_next(out, "height");
    dp_put_number(out, t->height, 6);
    dp_put_char(out, '}');
}

static void put_rule(dp_out *out, const dp_page_rule *r) {
    dp_put_char(out, '{');
    put_key(out, "from");
    put_numbers(out, (const double[]){r->x0, r->y0}, 2);
    put_next(out, "to");
    put_numbers(out, (const double[]){r->x1, r->y1}, 2);
    put_next(out, "width");
    dp_put_number(out, r->width, 6);
    dp_put_char(out, '}');
}

static void put_page(dp_out *out, const dp_page *page) {
    dp_put_char(out, '{');
    put_key(out, "width");
    dp_put_number(out, page->width, 6);
    put_next(out, "height");
    dp_put_number(out, page->height, 6);
    put_next(out, "paper");
    if (dp_is_painted(page))
        put_color(out, page->paper);
    else
        dp_put_text(out, "null");
    dp_put_char(out, '}');
}

void dp_write_json(dp_out *out, dp_plan *plan) {
    const dp_page *const page = plan->page;
    dp_put_text(out, "{\"format\":\"drypoint drawing\",\"version\":1,\"generator\":\"drypoint ");
    dp_put_text(out, dp_version());
    dp_put_text(out, "\",\n\"title\":");
    dp_put_json(out, page->title);
    dp_put_text(out, ",\n\"page\":");
    put_page(out, page);
    dp_put_text(out, ",\n\"views\":[");
    for (size_t i = 0; i < page->view_count && !out->result; i++) {
        dp_put_text(out, i ? ",\n" : "\n");
        put_view(out, &page->views[i]);
    }
    dp_put_text(out, "],\n\"texts\":[");
    for (size_t i = 0; i < page->text_count && !out->result; i++) {
        dp_put_text(out, i ? ",\n" : "\n");
        put_text(out, &page->texts[i]);
    }
    dp_put_text(out, "],\n\"rules\":[");
    for (size_t i = 0; i < page->rule_count && !out->result; i++) {
        dp_put_text(out, i ? ",\n" : "\n");
        put_rule(out, &page->rules[i]);
    }
    dp_put_text(out, "]}\n");
}
