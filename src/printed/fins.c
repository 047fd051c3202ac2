/* Textured silhouettes as printed (Hermosilla and Vázquez 2010, 2.3): triangles added beside
 * silhouette edges found by adjacency, with their depth test and texture. Used with
 * DP_EDGES_ADJACENCY, DP_INK_QUADS and DP_METHOD_PAPER.
 *
 *    paper's stage     here                                                           listing
 *    vertex shader     raster/vertices.c: positions to the screen
 *    geometry shader   core/facing.c: which edges are silhouettes                     2.1
 *                      features/extrude.c: the triangles beside them                  2.2
 *    pixel shader      shade: (x, y, v) -> u by polar coordinates, texture, alpha     2.3
 *
 * One pass (2.3.4): one walk over the tile's polygons draws them and what they add; front faces are
 * drawn already while they are assembled. The pixel stage tells surface and fins apart by v, which
 * is 2 on the surface. Two passes: first all faces, then the polygons once more for their fins.
 *
 * Data structure: per sample the ink's colour (0: none), depth and class. A fin's triangles are
 * drawn at once and not stored. Invariant: ink has its own depth, so both ways give the same
 * picture, in any order of polygons. Not handled: creases and intersections (other stages draw
 * them). */
#include "printed/fins.h"

#include "features/extrude.h"
#include "raster/kernels.h"
#include "core/facing.h"
#include "core/blend.h"
#include "raster/coverage.h"
#include "features/silhouette_edge.h"
#include "texture/texture.h"

#include <string.h>

/* v of the surface (Hermosilla and Vázquez 2010, 2.3.4). */
static const float SURFACE = 2;
/* Fragments with less ink are discarded (Hermosilla and Vázquez 2010, Listing 2.3). */
static const float LEAST_INK = 0.1f;

/* ------- pixel stage ------- */

typedef struct fragment {
    dp_printer *w;
    const dp_texture *texture;
    uint32_t level;
    double tx[3], ty[3], v[3],
        d[3]; /* affine on the screen: value at the corner, change along x and y */
    float k, scale;
    dp_color color;
    uint8_t line;
} fragment;

static double affine(const double f[3], double x, double y) { return f[0] + f[1] * x + f[2] * y; }

static dp_color mixed(dp_color line, const dp_texture *texture, dp_texel t) {
    const float alpha = t.ink * (float)(line & 0xff);
    const dp_color rgb = texture->coloured ? DP_RGB((uint32_t)(t.r + 0.5f), (uint32_t)(t.g + 0.5f),
                                                    (uint32_t)(t.b + 0.5f))
                                           : line;
    return (rgb & ~0xffu) | (dp_color)(alpha + 0.5f);
}

/* The colour of a fragment; 0: discarded. */
static dp_color shade(const fragment *f, double x, double y) {
    if (!f->texture) return f->color;
    const dp_frame *const frame = f->w->tile->frame;
    const double half = frame->view.height / 2;
    const double px = affine(f->tx, x, y) - frame->centre[0],
                 py = frame->centre[1] - affine(f->ty, x, y);
    const float u = (float)dp_stroke_polar(px / half, py / half, (double)f->k) * f->scale;
    const dp_texel t = dp_texture_sample(f->texture, f->level, u, (float)affine(f->v, x, y));
    return t.ink < LEAST_INK ? 0 : mixed(f->color, f->texture, t);
}

/* Where a sample lies on the screen, not in the tile: results must not depend on the tile. */
static void sample_at(const dp_printer *w, size_t lane, double *x, double *y) {
    const dp_sampling *const s = &w->tile->sampling;
    const size_t width = (size_t)4 * s->vectors, cell = lane / width, i = lane % width;
    *x = (double)(w->tile->tile_x + cell % s->cells_x * s->cell_width) + (double)s->x[i / 4][i % 4];
    *y = (double)(w->tile->tile_y + cell / s->cells_x) + (double)s->y[i / 4][i % 4];
}

static void cover(void *arg, size_t lane, dp_i4 in, dp_f4 nearest) {
    const fragment *const f = arg;
    dp_printer *const w = f->w;
    (void)nearest;
    if (!dp_any(in)) return;
    for (uint32_t i = 0; i < 4; i++) {
        double x, y;
        if (!in[i]) continue;
        sample_at(w, lane + i, &x, &y);
        const float d = (float)affine(f->d, x, y);
        if (!(d > w->ink_depth[lane + i] && d > w->tile->depth[lane + i])) continue;
        const dp_color color = shade(f, x, y);
        if (!color) continue;
        w->ink[lane + i] = color;
        w->ink_depth[lane + i] = d;
        w->stencil[lane + i] = f->line;
    }
}

/* ------- geometry stage ------- */

/* The affine function on the screen with these values at three points. */
static void make_affine(const dp_fin_point p[3], const double value[3], double out[3]) {
    const double ax = p[1].at.x - p[0].at.x, ay = p[1].at.y - p[0].at.y, av = value[1] - value[0];
    const double bx = p[2].at.x - p[0].at.x, by = p[2].at.y - p[0].at.y, bv = value[2] - value[0];
    const double area = ax * by - ay * bx;
    const double dx = area != 0 ? (av * by - ay * bv) / area : 0,
                 dy = area != 0 ? (ax * bv - av * bx) / area : 0;
    out[0] = value[0] - dx * p[0].at.x - dy * p[0].at.y, out[1] = dx, out[2] = dy;
}

static void fill_triangle(fragment *f, const dp_fin_point *p) {
    const dp_printer *const w = f->w;
    dp_point points[3];
    dp_coverage area;
    for (int i = 0; i < 3; i++)
        points[i] = (dp_point){(float)p[i].at.x - (float)w->tile->tile_x,
                               (float)p[i].at.y - (float)w->tile->tile_y, (float)p[i].at.d};
    if (!dp_coverage_make(points[0], points[1], points[2], &area)) return;
    make_affine(p, (const double[3]){p[0].tx, p[1].tx, p[2].tx}, f->tx);
    make_affine(p, (const double[3]){p[0].ty, p[1].ty, p[2].ty}, f->ty);
    make_affine(p, (const double[3]){p[0].v, p[1].v, p[2].v}, f->v);
    make_affine(p, (const double[3]){p[0].at.d, p[1].at.d, p[2].at.d}, f->d);
    const dp_plane plane = {0, 0, 0, 0}; /* depth is computed by `cover` */
    dp_coverage_fill(&w->tile->sampling, &area, &plane, w->tile->sampling.vectors, cover, f);
}

static void add_fin(dp_printer *w, uint32_t polygon, uint32_t corner, dp_line line) {
    const dp_frame *const frame = w->tile->frame;
    const dp_style *const style = dp_polygon_style(frame, polygon);
    if (!(style->lines & (1u << line))) return;
    dp_silhouette_edge edge;
    dp_fin_point strip[DP_FIN_POINTS];
    const float width = style->line[line].width;
    if (!dp_find_silhouette_edge(frame, polygon, corner, &edge) ||
        !dp_extrude(&edge, (double)width, strip))
        return;
    const dp_stroke_style *const stroke = &style->stroke;
    fragment f = {.w = w,
                  .texture = stroke->texture,
                  .k = stroke->k,
                  .color = style->line[line].color,
                  .line = (uint8_t)(line + 1)};
    if (f.texture) {
        f.level = dp_texture_level(f.texture, width);
        f.scale = dp_polar_repeats(frame, stroke, width);
    }
    for (uint32_t i = 0; i < DP_FIN_TRIANGLES; i++) fill_triangle(&f, strip + i);
    w->tile->stats.added_polygons += DP_FIN_TRIANGLES;
}

static void add_fins(dp_printer *w, uint32_t polygon) {
    const dp_polygons *const polygons = &w->tile->frame->polygons;
    if (!w->tile->frame->outlined[polygon]) return;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    for (uint32_t c = first; c < first + n; c++) {
        if (!dp_edge_may_be_line(polygons, c)) continue;
        const int line = dp_outline_of_edge(w->tile->frame, polygon, c);
        if (line >= 0) add_fin(w, polygon, c, (dp_line)line);
    }
}

/* ------- the picture ------- */

static bool begin(dp_printer *w) {
    const size_t n = w->tile->frame->tile_samples;
    if (!DP_TILE_RESERVE(w->tile, w, ink, ink_cap, n) ||
        !DP_TILE_RESERVE(w->tile, w, ink_depth, ink_depth_cap, n) ||
        !DP_TILE_RESERVE(w->tile, w, stencil, stencil_cap, n))
        return false;
    memset(w->ink, 0, n * sizeof *w->ink);
    for (size_t i = 0; i < n; i++) w->ink_depth[i] = DP_DEPTH_EMPTY;
    return true;
}

/* v of a sample, by which one pass tells surface and silhouettes apart. */
static float v_of(const dp_printer *w, size_t lane) {
    return w->ink[lane] && w->ink_depth[lane] > w->tile->depth[lane] ? 1 : SURFACE;
}

/* Blends a pixel's ink over the surface. */
static void put_pixel(const dp_printer *w, uint32_t x, uint32_t y) {
    const dp_target *const target = &w->tile->frame->target;
    const size_t lane = dp_pixel_lane(&w->tile->sampling, x - w->tile->tile_x, y - w->tile->tile_y);
    float sum[4] = {0, 0, 0, 0};
    uint32_t count = 0;
    uint8_t line = 0;
    for (uint32_t i = 0; i < w->tile->sampling.samples; i++) {
        if (v_of(w, lane + i) >= SURFACE) continue;
        const dp_color c = w->ink[lane + i];
        const float alpha = (float)(c & 0xff) / 255;
        for (int k = 0; k < 3; k++) sum[k] += alpha * (float)(c >> (24 - 8 * k) & 0xff);
        sum[3] += alpha;
        line = w->stencil[lane + i];
        count++;
    }
    if (!count) return;
    if (target->rgba && sum[3] > 0) {
        const dp_color c =
            DP_RGB((uint32_t)(sum[0] / sum[3] + 0.5f), (uint32_t)(sum[1] / sum[3] + 0.5f),
                   (uint32_t)(sum[2] / sum[3] + 0.5f));
        dp_blend(dp_ink_place(w->tile->frame, x, y), c, sum[3] / (float)w->tile->sampling.samples);
    }
    if (target->line_class && 2 * count >= w->tile->sampling.samples)
        target->line_class[(size_t)y * target->width + x] = line;
}

static void put_ink(const dp_printer *w) {
    const dp_target *const target = &w->tile->frame->target;
    for (uint32_t y = w->tile->tile_y; y < w->tile->tile_y + DP_TILE && y < target->height; y++)
        for (uint32_t x = w->tile->tile_x; x < w->tile->tile_x + DP_TILE && x < target->width; x++)
            put_pixel(w, x, y);
}

void dp_printed_fins_two_passes(dp_printer *w) {
    dp_tile_faces(w->tile);
    dp_tile_surface(w->tile);
    if (!begin(w)) return;
    for (uint32_t i = 0; i < w->tile->polygon_count; i++) add_fins(w, w->tile->polygons[i].id);
    put_ink(w);
}

void dp_printed_fins_one_pass(dp_printer *w) {
    /* all polygons: none may count as hidden yet */
    if (!begin(w) || !dp_tile_see(w->tile, false)) return;
    for (uint32_t i = 0; i < w->tile->polygon_count; i++) {
        const dp_tile_polygon *const p = &w->tile->polygons[i];
        if (!(p->flags & DP_POLYGON_FRONT) && dp_is_surface(w->tile, p))
            dp_raster_kernels_for(w->tile->frame->lanes)->raster(w->tile, p, i);
        add_fins(w, p->id);
    }
    dp_tile_surface(w->tile);
    put_ink(w);
}

float dp_fin_reach(const dp_frame *frame) {
    float widest = 0;
    for (uint32_t i = 0; i < frame->style_count; i++)
        widest = dp_maxf(widest, dp_maxf(frame->styles[i].line[DP_LINE_SILHOUETTE].width,
                                         frame->styles[i].line[DP_LINE_BORDER].width));
    return widest + 1;
}
