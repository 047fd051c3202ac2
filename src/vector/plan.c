/* A page made ready to be written: its layers from the bottom up, and its styles.
 *
 * Layers lie sorted. Styles are found by hash; one that is found again and again, as neighbours of
 * one layer are, is found at once. Styles that look alike in thousandths of a unit are one.
 *
 * Dashes are of the spine, as those of the raster picture (strokes/hidden.c) and of every format here
 * are: round ends lie beyond. Lines that are written wider than they are (dp_page.least_width) have
 * their dashes longer by as much: else they would close. */
#include "vector/writer.h"

#include "base/diag.h"
#include "base/memory.h"
#include "sink/raster.h"
#include "vector/font.h"

#include <string.h>

enum { BLACK = DP_RGB(0, 0, 0), NO_STYLE = UINT32_MAX };

double dp_view_scale(const dp_view_on_page *view) {
    return view->mm_per_px > 0 ? view->mm_per_px : 25.4 / 96;
}

bool dp_is_painted(const dp_page *page) { return page->paper && page->paper != DP_COLOR_NONE; }

dp_color dp_blend(dp_color over, dp_color under) {
    const uint32_t alpha = over & 0xFF;
    dp_color result = 0xFF;
    for (int shift = 8; shift < 32; shift += 8) {
        const uint32_t a = over >> shift & 0xFF, b = under >> shift & 0xFF;
        result |= ((a * alpha + b * (255 - alpha) + 127) / 255) << shift;
    }
    return result;
}

/* ------- layers ------- */

/* From the bottom up: what hides more lies lower. */
static int place_of(dp_line line) {
    int place = 0;
    while (place < DP_LINE_COUNT && dp_layers[place] != line) place++;
    return place;
}

static bool lies_under(const dp_layer *a, const dp_layer *b) {
    if (a->kind != b->kind) return a->kind < b->kind;
    if (a->level != b->level) return a->level > b->level;
    return place_of(a->line) < place_of(b->line);
}

/* Where a layer is, or belongs. */
static size_t find_layer(const dp_plan *plan, const dp_layer *layer) {
    size_t low = 0, high = plan->layer_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (lies_under(&plan->layers[middle], layer))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool add_layer(dp_plan *plan, dp_layer_kind kind, dp_line line, uint32_t level) {
    const dp_layer layer = {.kind = kind, .level = level, .line = line, .first = NO_STYLE};
    const size_t at = find_layer(plan, &layer);
    if (at < plan->layer_count && !lies_under(&layer, &plan->layers[at])) return true;
    if (!dp_reserve(&plan->memory, &plan->layers, &plan->layers_cap, plan->layer_count + 1,
                    sizeof *plan->layers))
        return false;
    memmove(plan->layers + at + 1, plan->layers + at,
            (plan->layer_count - at) * sizeof *plan->layers);
    plan->layers[at] = layer;
    plan->layer_count++;
    return true;
}

static bool add_view_layers(dp_plan *plan, const dp_view_on_page *view) {
    const dp_drawing *const d = view->drawing;
    if (plan->grounds && (view->ground || view->ground_png) &&
        !add_layer(plan, DP_LAYER_SURFACE, 0, 0))
        return false;
    for (size_t i = 0; i < d->info.paths; i++) {
        const dp_stored_path *const p = &d->paths[i];
        if (i && p->line == p[-1].line && p->level == p[-1].level) continue;
        if (!add_layer(plan, DP_LAYER_LINES, p->line, p->level)) return false;
    }
    return true;
}

static bool list_layers(dp_plan *plan) {
    const dp_page *const page = plan->page;
    for (size_t v = 0; v < page->view_count; v++)
        if (!add_view_layers(plan, &page->views[v])) return false;
    return (!page->rule_count || add_layer(plan, DP_LAYER_FRAME, 0, 0)) &&
           (!page->text_count || add_layer(plan, DP_LAYER_TEXT, 0, 0));
}

const char *dp_layer_name(char name[DP_LAYER_NAME], const dp_layer *layer, char separator,
                          bool upper) {
    static const char *const kinds[] = {"surface", NULL, "frame", "text"};
    const bool lines = layer->kind == DP_LAYER_LINES;
    char digits[12], *end = name, *digit = digits + sizeof digits;
    *--digit = 0;
    for (uint32_t rest = layer->level; rest; rest /= 10) *--digit = (char)('0' + rest % 10);
    const char *const parts[] = {lines ? dp_line_name(layer->line) : kinds[layer->kind],
                                 lines && layer->level ? " hidden " : "",
                                 lines && layer->level ? digit : ""};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (const char *c = parts[i]; *c; c++)
            *end++ = *c == ' ' ? separator : upper && *c >= 'a' ? (char)(*c - 'a' + 'A') : *c;
    *end = 0;
    return name;
}

uint64_t dp_layer_number(const dp_layer *layer) {
    static const uint64_t numbers[] = {0, 0, 6, 7};
    if (layer->kind != DP_LAYER_LINES) return numbers[layer->kind];
    const uint64_t line = (uint64_t)layer->line + 1, frame_and_text = 2;
    return UINT64_C(10) * layer->level + line + (line > 5 ? frame_and_text : 0);
}

/* ------- styles ------- */

static uint64_t hash_of(const dp_page_style *s) {
    uint64_t hash = s->layer;
    const uint64_t parts[] = {s->color, (uint64_t)s->width, (uint64_t)s->dash[0],
                              (uint64_t)s->dash[1]};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        hash = (hash ^ parts[i]) * UINT64_C(0x9E3779B97F4A7C15);
        hash ^= hash >> 29;
    }
    return hash;
}

static bool looks_alike(const dp_page_style *a, const dp_page_style *b) {
    return a->layer == b->layer && a->color == b->color && a->width == b->width &&
           a->dash[0] == b->dash[0] && a->dash[1] == b->dash[1];
}

/* The slot of a style, or the empty one that it belongs into. */
static uint32_t *slot_of(const dp_plan *plan, const dp_page_style *style) {
    size_t at = (size_t)hash_of(style) & (plan->slot_count - 1);
    while (plan->slots[at] && !looks_alike(&plan->styles[plan->slots[at] - 1], style))
        at = (at + 1) & (plan->slot_count - 1);
    return &plan->slots[at];
}

static bool grow_slots(dp_plan *plan) {
    const size_t count = plan->slot_count ? 2 * plan->slot_count : 64;
    if (!dp_reserve(&plan->memory, &plan->slots, &plan->slots_cap, count, sizeof *plan->slots))
        return false;
    memset(plan->slots, 0, count * sizeof *plan->slots);
    plan->slot_count = count;
    for (size_t i = 0; i < plan->style_count; i++)
        *slot_of(plan, &plan->styles[i]) = (uint32_t)i + 1;
    return true;
}

static bool add_style(dp_plan *plan, dp_page_style style) {
    if (plan->style_count && looks_alike(&plan->styles[plan->last], &style)) return true;
    if (2 * plan->style_count >= plan->slot_count && !grow_slots(plan)) return false;
    uint32_t *const slot = slot_of(plan, &style);
    if (!*slot) {
        if (!dp_reserve(&plan->memory, &plan->styles, &plan->styles_cap, plan->style_count + 1,
                        sizeof *plan->styles))
            return false;
        dp_layer *const layer = &plan->layers[style.layer];
        if (layer->first == NO_STYLE) layer->first = (uint32_t)plan->style_count;
        style.place = layer->styles++;
        plan->styles[plan->style_count++] = style;
        *slot = (uint32_t)plan->style_count;
    }
    plan->last = *slot - 1;
    return true;
}

/* Number of a style that is there. */
static uint32_t find_style(dp_plan *plan, const dp_page_style *style) {
    if (!looks_alike(&plan->styles[plan->last], style)) plan->last = *slot_of(plan, style) - 1;
    return plan->last;
}

static int64_t width_of(const dp_plan *plan, double width /* mm */) {
    const double least = plan->page->least_width;
    const int64_t fixed = dp_fixed((width > least ? width : least) / plan->unit);
    return fixed > 0 ? fixed : 1; /* 0 is as thin as a device can in PDF */
}

static dp_page_style style_of_path(const dp_plan *plan, const dp_view_on_page *view,
                                   const dp_stored_path *p, uint32_t layer) {
    const double mm = dp_view_scale(view), own = (double)p->width * mm;
    dp_page_style s = {.layer = layer, .color = p->color, .width = width_of(plan, own)};
    double stretch = mm / plan->unit; /* of dashes, px to units */
    if (own > 0 && own < plan->page->least_width) stretch *= plan->page->least_width / own;
    const int64_t on = dp_fixed((double)p->dash[0] * stretch),
                  off = dp_fixed((double)p->dash[1] * stretch);
    if (on >= 0 && off > 0) s.dash[0] = on, s.dash[1] = off;
    return s;
}

static dp_page_style style_of_rule(const dp_plan *plan, const dp_page_rule *rule, size_t layer) {
    return (dp_page_style){
        .layer = (uint32_t)layer, .color = BLACK, .width = width_of(plan, rule->width)};
}

static dp_page_style style_of_text(const dp_plan *plan, const dp_page_text *text, size_t layer) {
    return (dp_page_style){.layer = (uint32_t)layer,
                           .color = BLACK,
                           .width = width_of(plan, text->height / DP_LETTER_HEIGHT)};
}

static bool list_view_styles(dp_plan *plan, const dp_view_on_page *view) {
    const dp_drawing *const d = view->drawing;
    size_t layer = 0;
    for (size_t i = 0; i < d->info.paths; i++) {
        const dp_stored_path *const p = &d->paths[i];
        if (!i || p->line != p[-1].line || p->level != p[-1].level)
            layer = find_layer(
                plan, &(dp_layer){.kind = DP_LAYER_LINES, .level = p->level, .line = p->line});
        if (!add_style(plan, style_of_path(plan, view, p, (uint32_t)layer))) return false;
    }
    return true;
}

static bool list_styles(dp_plan *plan) {
    const dp_page *const page = plan->page;
    const size_t frame = find_layer(plan, &(dp_layer){.kind = DP_LAYER_FRAME}),
                 text = find_layer(plan, &(dp_layer){.kind = DP_LAYER_TEXT});
    for (size_t v = 0; v < page->view_count; v++)
        if (!list_view_styles(plan, &page->views[v])) return false;
    for (size_t i = 0; i < page->rule_count; i++)
        if (!add_style(plan, style_of_rule(plan, &page->rules[i], frame))) return false;
    for (size_t i = 0; i < page->text_count; i++)
        if (!add_style(plan, style_of_text(plan, &page->texts[i], text))) return false;
    return true;
}

dp_result dp_plan_make(dp_plan *plan, const dp_page *page, bool millimetres, bool grounds,
                       const dp_allocator *memory, dp_diag *diag) {
    *plan = (dp_plan){.page = page, .memory = *memory, .up = millimetres, .grounds = grounds};
    plan->unit = millimetres ? 1 : page->view_count ? dp_view_scale(&page->views[0]) : 25.4 / 96;
    plan->width = page->width / plan->unit;
    plan->height = page->height / plan->unit;
    if (list_layers(plan) && list_styles(plan)) return DP_OK;
    dp_plan_free(plan);
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the styles of a page");
}

static const dp_array arrays[] = {DP_ARRAY(dp_plan, layers, layers_cap),
                                  DP_ARRAY(dp_plan, styles, styles_cap),
                                  DP_ARRAY(dp_plan, slots, slots_cap)};

void dp_plan_free(dp_plan *plan) { dp_arrays_free(&plan->memory, plan, DP_ARRAYS(arrays)); }

/* ------- marks ------- */

static void point_of(const dp_mark *m, size_t i, int64_t at[2]) {
    const double x = m->points ? (double)m->points[i].x : m->plane[i][0],
                 y = m->points ? (double)m->points[i].y : m->plane[i][1];
    at[0] = dp_fixed(m->to[0] + m->scale_x * x);
    at[1] = dp_fixed(m->to[1] + m->scale_y * y);
}

bool dp_trail_next(dp_trail *trail) {
    const dp_mark *const m = trail->mark;
    while (trail->next < m->count) {
        int64_t at[2];
        point_of(m, trail->next++, at);
        if (trail->given && at[0] == trail->at[0] && at[1] == trail->at[1]) continue;
        memcpy(trail->at, at, sizeof at);
        trail->given++;
        return true;
    }
    if (trail->given != 1) return false;
    trail->given++; /* a dot: its point once more */
    return true;
}

/* Lays a mark from points onto the page: `x`, `y` is where their origin lies, mm. */
static void place_mark(const dp_plan *plan, dp_mark *m, double x, double y, double scale /* mm */,
                       bool up /* the points' y */) {
    const double unit = scale / plan->unit;
    m->scale_x = unit;
    m->scale_y = plan->up != up ? -unit : unit;
    m->to[0] = x / plan->unit;
    m->to[1] = (plan->up ? plan->page->height - y : y) / plan->unit;
}

/* ------- walking ------- */

static void walk_grounds(const dp_plan *plan, const dp_pen *pen, const dp_out *out) {
    for (size_t v = 0; v < plan->page->view_count && !out->result && pen->ground; v++) {
        const dp_view_on_page *const view = &plan->page->views[v];
        if (!view->ground && !view->ground_png) continue;
        const double unit = dp_view_scale(view) / plan->unit;
        const dp_drawing_info *const info = &view->drawing->info;
        pen->ground(pen->user, &(dp_ground){.view = view,
                                            .columns = info->width,
                                            .rows = info->height,
                                            .x = view->x / plan->unit,
                                            .y = view->y / plan->unit,
                                            .width = unit * info->width,
                                            .height = unit * info->height});
    }
}

static void walk_view(dp_plan *plan, size_t layer, const dp_view_on_page *view, const dp_pen *pen,
                      const dp_out *out) {
    const dp_layer *const l = &plan->layers[layer];
    const dp_drawing *const d = view->drawing;
    for (size_t i = 0; i < d->info.paths && !out->result; i++) {
        const dp_stored_path *const p = &d->paths[i];
        if (p->line != l->line || p->level != l->level || !p->count) continue;
        const dp_page_style style = style_of_path(plan, view, p, (uint32_t)layer);
        dp_mark m = {.style = find_style(plan, &style),
                     .closed = p->closed,
                     .points = d->points + p->first,
                     .count = p->count};
        place_mark(plan, &m, view->x, view->y, dp_view_scale(view), false);
        pen->mark(pen->user, &m);
    }
}

static void walk_rules(dp_plan *plan, size_t layer, const dp_pen *pen, const dp_out *out) {
    for (size_t i = 0; i < plan->page->rule_count && !out->result; i++) {
        const dp_page_rule *const r = &plan->page->rules[i];
        const dp_page_style style = style_of_rule(plan, r, layer);
        const double ends[2][2] = {{r->x0, r->y0}, {r->x1, r->y1}};
        dp_mark m = {.style = find_style(plan, &style), .plane = ends, .count = 2};
        place_mark(plan, &m, 0, 0, 1, false);
        pen->mark(pen->user, &m);
    }
}

static void walk_text(dp_plan *plan, size_t layer, const dp_page_text *t, const dp_pen *pen,
                      const dp_out *out) {
    const dp_page_style style = style_of_text(plan, t, layer);
    double points[DP_LETTER_STROKE_MOST][2];
    dp_lettering lettering = {.rest = t->text};
    dp_mark m = {.style = find_style(plan, &style), .plane = points};
    place_mark(plan, &m, t->x, t->y, t->height / DP_LETTER_HEIGHT, true);
    while (!out->result && (m.count = dp_next_stroke(&lettering, points))) {
        pen->mark(pen->user, &m);
        m.joins = true;
    }
}

static void walk_layer(dp_plan *plan, size_t layer, const dp_pen *pen, const dp_out *out) {
    const dp_page *const page = plan->page;
    const dp_layer *const l = &plan->layers[layer];
    if (pen->begin) pen->begin(pen->user, l);
    switch (l->kind) {
    case DP_LAYER_SURFACE:
        walk_grounds(plan, pen, out);
        break;
    case DP_LAYER_LINES:
        for (size_t v = 0; v < page->view_count; v++)
            walk_view(plan, layer, &page->views[v], pen, out);
        break;
    case DP_LAYER_FRAME:
        walk_rules(plan, layer, pen, out);
        break;
    case DP_LAYER_TEXT:
        for (size_t i = 0; i < page->text_count; i++)
            walk_text(plan, layer, &page->texts[i], pen, out);
        break;
    }
    if (pen->end) pen->end(pen->user, l);
}

void dp_plan_walk(dp_plan *plan, const dp_pen *pen, const dp_out *out) {
    for (size_t i = 0; i < plan->layer_count && !out->result; i++) walk_layer(plan, i, pen, out);
}
