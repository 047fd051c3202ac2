/* Patterns and light on added polygons (Raskar 2001, 2.1 and 5).
 *
 *     while polygons are filled    each added one gets a mark, and the mark's number is the ink that
 *                                  the tests put into samples: of polygons of one line that whose
 *                                  edge is least far (quads_fill.c)
 *     when the tile is filled      for each inked sample: the mark's texture coordinates and colour
 *                                  (made when the first sample shows it: most are hidden), the
 *                                  texture's ink there, the light's colour
 *
 * Invariants: the same samples are inked as without marks; what one gets depends on its place on the
 * screen, the polygon and the view, not on the tile. Not handled: intersections, of which each polygon is a part and no edge is; they are plain. */
#include "printed/marks.h"

#include "features/lit.h"
#include "texture/texture.h"

/* A neighbour's surface lies within so many line widths of the quad, in depth. */
static const double NEIGHBOUR = 4;

static bool is_marked(const dp_style *s) { return s->pattern.texture || s->line_light.lighting; }

void dp_marks_begin(dp_printer *w) {
    const dp_frame *const frame = w->tile->frame;
    w->marked = false;
    for (uint32_t i = 0; i < frame->style_count; i++) w->marked |= is_marked(&frame->styles[i]);
    w->mark_count = w->shown_count = 0;
}

static dp_mark *add_mark(dp_printer *w) {
    if (!DP_TILE_RESERVE(w->tile, w, marks, marks_cap, w->mark_count + 1)) return NULL;
    return &w->marks[w->mark_count++];
}

uint32_t dp_mark_added(dp_printer *w, uint32_t ink, uint32_t polygon, uint32_t edge,
                       const dp_added *a) {
    dp_mark *const m = add_mark(w);
    if (!m) return 0;
    *m = (dp_mark){.polygon = polygon,
                   .edge = edge,
                   .style = dp_ink_style(ink),
                   .line = (uint8_t)dp_ink_line(ink),
                   .joint = a->joint,
                   .depth = {a->d0, a->dx, a->dy}};
    return (ink & DP_INK_ADDED) | (uint32_t)w->mark_count;
}

uint32_t dp_mark_class(dp_printer *w, uint32_t ink) {
    const uint32_t style = dp_ink_style(ink);
    const uint8_t line = (uint8_t)dp_ink_line(ink);
    const dp_mark *const last = w->mark_count ? &w->marks[w->mark_count - 1] : NULL;
    if (!last || !last->plain || last->line != line || last->style != style) {
        dp_mark *const m = add_mark(w);
        if (!m) return 0;
        *m = (dp_mark){.style = style, .line = line, .plain = true};
    }
    return (ink & DP_INK_ADDED) | (uint32_t)w->mark_count;
}

/* ------- what is seen ------- */

/* An outline's is its polygon's, as wound: the surface turns away there. A quad's is its own, R of
 * (Raskar 2001, 2.2), on the side that is seen. */
static dp_vec3 normal_of(const dp_mapped *m) {
    const dp_primitive *const p = m->primitive;
    if (m->line == DP_LINE_SILHOUETTE) return p->normal;
    const dp_vec3 r = dp_quad_normal(dp_edge_direction(p, m->edge), p->normal, &m->pen);
    const bool away = dp_dot(r, dp_view_vector(p->view, p->world[m->edge])) > 0;
    return away ? dp_scale(r, -1) : r;
}

static void make_shown(dp_printer *w, const dp_mark *mark, const dp_primitive *primitive,
                       dp_shown *out) {
    const dp_frame *const frame = w->tile->frame;
    const dp_style *const style = &frame->styles[mark->style];
    const dp_line line = (dp_line)mark->line;
    dp_mapped m = {.primitive = primitive,
                   .edge = mark->edge,
                   .line = line,
                   .pen = dp_quads_pen(style, line),
                   .joint = mark->joint,
                   .d0 = mark->depth[0],
                   .dx = mark->depth[1],
                   .dy = mark->depth[2],
                   .screen = style->pattern.screen};
    m.whole = dp_quads_whole(style, line) || line == DP_LINE_BORDER;
    if (style->pattern.texture) {
        m.length = dp_pattern_length(frame, style, style->line[line].width);
        dp_mapping_make(&m, &out->mapping);
    }
    out->normal = normal_of(&m);
    out->light = dp_light_direction(&frame->view, style);
}

/* NULL: out of memory. */
static const dp_shown *show(dp_printer *w, dp_mark *mark) {
    dp_primitive primitive;
    if (mark->shown) return &w->shown[mark->shown - 1];
    if (!DP_TILE_RESERVE(w->tile, w, shown, shown_cap, w->shown_count + 1) ||
        !dp_quads_fetch(w, mark->polygon, &primitive))
        return NULL;
    make_shown(w, mark, &primitive, &w->shown[w->shown_count]);
    mark->shown = (uint32_t)++w->shown_count;
    return &w->shown[mark->shown - 1];
}

/* ------- samples ------- */

void dp_mark_sample_at(const dp_printer *w, size_t lane, double *x, double *y) {
    const dp_sampling *const s = &w->tile->sampling;
    const size_t width = (size_t)4 * s->vectors, cell = lane / width, i = lane % width;
    *x = (double)(w->tile->tile_x + cell % s->cells_x * s->cell_width) + (double)s->x[i / 4][i % 4];
    *y = (double)(w->tile->tile_y + cell / s->cells_x) + (double)s->y[i / 4][i % 4];
}

static dp_color textured(const dp_printer *w, const dp_texture *texture, const dp_mapping *mapping,
                         size_t lane, dp_color color) {
    static const float shares[] = {1, 0, 0.5f, 0.3535534f, 0.25f}; /* px, by log2 of the samples */
    const float share = shares[__builtin_ctz(w->tile->sampling.samples)];
    double x, y;
    dp_mark_sample_at(w, lane, &x, &y);
    const dp_mapped_point p = dp_mapping_at(mapping, x, y);
    const dp_texel t = dp_texture_filtered(texture, (float)p.u, (float)p.v, (float)p.du * share,
                                           (float)p.dv * share);
    const dp_color rgb = texture->coloured ? DP_RGB((uint32_t)(t.r + 0.5f), (uint32_t)(t.g + 0.5f),
                                                    (uint32_t)(t.b + 0.5f))
                                           : color;
    return (rgb & ~0xffu) | (dp_color)(t.ink * (float)(color & 0xff) + 0.5f);
}

/* Half of a ridge lies on the neighbour of the polygon that draws it, and a valley behind it: where the
 * surface under the sample is that near, its normal says how the line is lit. Elsewhere the quad's
 * own does. An outline lies on nothing. */
static double cosine_at(const dp_printer *w, size_t lane, const dp_mark *mark, const dp_shown *s) {
    const dp_frame *const frame = w->tile->frame;
    const dp_style *const style = &frame->styles[mark->style];
    const uint32_t winner = w->tile->winner[lane];
    if (mark->line == DP_LINE_SILHOUETTE || winner == UINT32_MAX)
        return dp_dot(s->normal, s->light);
    const dp_tile_polygon *const p = &w->tile->polygons[winner];
    double x, y;
    dp_mark_sample_at(w, lane, &x, &y);
    const double d = mark->depth[0] + mark->depth[1] * x + mark->depth[2] * y,
                 surface = (double)w->tile->depth[lane];
    const double width = (double)style->line[mark->line].width;
    if (fabs(d - surface) > dp_depth_step(&frame->view, fabs(surface), NEIGHBOUR * width))
        return dp_dot(s->normal, s->light);
    const double cosine = dp_dot(dp_polygon_normal(frame, p->id), s->light);
    return p->flags & DP_POLYGON_FRONT ? cosine : -cosine;
}

static bool color_sample(dp_printer *w, size_t lane) {
    dp_mark *const mark = &w->marks[(w->ink[lane] & ~DP_INK_ADDED) - 1];
    const dp_style *const style = &w->tile->frame->styles[mark->style];
    dp_color color = style->line[mark->line].color;
    if (!mark->plain && is_marked(style)) {
        const dp_shown *const s = show(w, mark);
        if (!s) return false;
        if (style->pattern.texture)
            color = textured(w, style->pattern.texture, &s->mapping, lane, color);
        if (style->line_light.lighting)
            color = dp_lit_color(style, color, cosine_at(w, lane, mark, s));
    }
    w->colors[lane] = color;
    return true;
}

bool dp_marks_color(dp_printer *w) {
    const size_t n = w->tile->frame->tile_samples;
    if (!DP_TILE_RESERVE(w->tile, w, colors, colors_cap, n)) return false;
    for (size_t i = 0; i < n; i++)
        if (w->ink[i] && !color_sample(w, i)) return false;
    return true;
}
