/* Inking stylized strokes: with texture and a width that varies, over the surface.
 *
 *     for each class, for each chain in the tile:
 *         for each part: cover pixels; a pixel belongs to the part whose spine is nearest
 *         blend the pixels over the picture
 *
 * The nearest part gives a pixel u (along) and v (across), so that u runs on through joints without
 * a jump. Coverage is that of plain strokes (ink.c) times the texture's ink.
 *
 * Parts that lie outside (extruded silhouettes, Hermosilla and Vázquez 2010, 2.3) have v = 0 on the
 * spine and 1 at their width outside. A sector around their common point joins two of them, so
 * that there are no gaps at any width. */
#include "sink/raster.h"

#include "core/blend.h"
#include "texture/texture.h"

#include <string.h>

/* Extruded ink reaches this far over its spine, px, to where the surface ends. */
#define INSIDE (-0.25f)

typedef struct brush {
    const dp_frame *frame;
    const dp_stylized *stylized; /* of the drawing */
    dp_ink_worker *worker;
    const float *depth; /* the tile's samples; NULL: there is no surface */
    uint32_t x0, y0, x1, y1;
    const dp_stroke_style *style;
    bool outlines_outside;
    bool pattern; /* the texture is a pattern */
} brush;

/* Texels with less ink are discarded. */
static float least_ink(const dp_stylized *m) { return m->outside ? 0.1f : 1.0f / 512; }

void dp_place_stylized(void *arg, uint32_t first, uint32_t count, dp_tile_rect *rects,
                       uint32_t worker) {
    const dp_inking *const k = arg;
    (void)worker;
    for (uint32_t i = 0; i < count; i++)
        rects[i] = dp_stroke_rect(&k->drawing->stylized.stylized[first + i].stroke);
}

/* Where a pixel lies on a part. */
typedef struct spot {
    float t;        /* along the spine, 0 to 1 */
    float along;    /* the same, not held to that */
    float distance; /* px from the spine */
    float across;   /* the same, signed */
    float cover;    /* share of the pixel */
    float v;
} spot;

static float clamp01(float x) { return dp_minf(dp_maxf(x, 0), 1); }

/* Overlap of a pixel's box with [low, high]. */
static float overlap(float x, float low, float high) {
    return clamp01(dp_minf(x + 0.5f, high) - dp_maxf(x - 0.5f, low));
}

/* False where it is out of the part's reach. */
static bool find_spot(const dp_stylized *m, float x, float y, spot *s) {
    const dp_point a = m->stroke.a, b = m->stroke.b;
    const float ex = b.x - a.x, ey = b.y - a.y, length2 = m->length * m->length,
                reach = m->stroke.half_width + 0.5f;
    s->along = length2 > 0 ? ((x - a.x) * ex + (y - a.y) * ey) / length2 : 0;
    s->t = clamp01(s->along);
    const float dx = x - a.x - s->t * ex, dy = y - a.y - s->t * ey, distance2 = dx * dx + dy * dy;
    if (distance2 > reach * reach) return false;
    s->distance = sqrtf(distance2);
    const float cross = ex * (y - a.y) - ey * (x - a.x);
    s->across = cross < 0 ? -s->distance : s->distance;
    return true;
}

static void cover_centred(const dp_stylized *m, spot *s) {
    const float half = m->half[0] + (m->half[1] - m->half[0]) * s->t;
    s->cover = overlap(s->distance, -half, half);
    s->v = 0.5f + 0.5f * (m->flipped ? -s->across : s->across) / half;
}

/* Does a chain begin here? */
static bool starts(const dp_stylized *m) { return m->before[0] == 0 && m->before[1] == 0; }

/* Patterns end square, or where lines meet the round ends of one would lie over the pattern of the
 * other: the share of a pixel that lies between a chain's ends. */
static float within_ends(const dp_stylized *m, const spot *s) {
    const float ahead = starts(m) ? -s->along * m->length : -1,
                past = m->ends ? (s->along - 1) * m->length : -1;
    return clamp01(0.5f - ahead) * clamp01(0.5f - past);
}

/* The sector at the joint with the part before: beyond that one's end, before this one's start. */
static bool in_joint(const dp_stylized *m, float dx, float dy) {
    if (starts(m)) return false;
    return m->before[0] * dx + m->before[1] * dy >= -0.5f && m->length > 0 &&
           m->middle[0] * dx + m->middle[1] * dy > 0;
}

static void cover_outside(const dp_stylized *m, spot *s, float x, float y) {
    const float width = m->half[0] + (m->half[1] - m->half[0]) * s->t;
    const float dx = x - m->stroke.a.x, dy = y - m->stroke.a.y;
    const float length = m->length;
    const float out = m->outward[0] * dx + m->outward[1] * dy;
    s->cover = 0;
    const float past = (s->along - 1) * length, ahead = -s->along * length; /* px beyond the ends */
    if (ahead > 0 && in_joint(m, dx, dy)) {
        s->cover = overlap(s->distance, INSIDE, width);
        s->v = s->distance / width;
        return;
    }
    if (!(out > -0.5f)) return;
    if ((ahead > 0 && starts(m)) || (past > 0 && m->ends)) { /* round ends */
        s->cover = overlap(s->distance, INSIDE, width) * clamp01(out + 0.75f);
        s->v = s->distance / width;
        return;
    }
    const float ends = dp_minf(clamp01(1.75f - ahead),
                               clamp01(1.75f - past)); /* parts of a chain overlap a little */
    s->cover = ends * overlap(out, INSIDE, width);
    s->v = dp_maxf(out, 0) / width;
}

/* u in repeats of the texture. It stands still around a joint and runs on beyond the ends. */
static float u_at(const dp_stylized *m, const spot *s) {
    const float along = (s->along < 0 && starts(m)) || (s->along > 1 && m->ends) ? s->along : s->t;
    if (m->world && along > 0 && along < 1) /* as lengths in space are seen */
        return (m->arc[0] * m->stroke.a.d * (1 - along) + m->arc[1] * m->stroke.b.d * along) /
               (m->stroke.a.d * (1 - along) + m->stroke.b.d * along);
    return m->arc[0] + (m->arc[1] - m->arc[0]) * along;
}

/* The texture's ink: of a pattern, which may be seen from afar, the mean over the pixel. */
static dp_texel texel_at(const brush *b, const dp_stylized *m, uint32_t level, const spot *s) {
    const dp_texture *const texture = b->style->texture;
    const float u = u_at(m, s);
    if (!b->pattern) return dp_texture_sample(texture, level, u, s->v);
    const float width = (m->outside ? 1 : 2) * (m->half[0] + (m->half[1] - m->half[0]) * s->t);
    const float du = m->length > 0 ? fabsf(m->arc[1] - m->arc[0]) / m->length : 0;
    return dp_texture_filtered(texture, u - floorf(u), s->v, dp_minf(du, 1e3f), 1 / width);
}

/* The distance by which dp_visible_share lets a surface come nearer and still not hide the stroke.
 * Around a line's end no further than at the end itself, or a thin arc of its round end would stand
 * out over what hides the rest of it. And where outlines lie outside, they do not cover what stands
 * out beside a crease that runs under one: less all along. */
static float trusted_distance(const brush *b, const dp_stylized *m, const spot *s) {
    const bool beyond = (s->along < 0 && starts(m)) || (s->along > 1 && m->ends);
    return (beyond ? dp_minf(s->distance, 1) : s->distance) * (b->outlines_outside ? 0.375f : 1);
}

/* Share of the pixel's samples over which extruded ink shows: those that fall away behind the
 * outline, by at least an eighth of a pixel size per px. What is merely beside it on the same
 * surface, as around a hidden fold of a single triangle, does not. */
static float beyond_share(const brush *b, const dp_stylized *m, const spot *s, uint32_t x,
                          uint32_t y) {
    if (!b->depth) return 1;
    const uint32_t samples = b->frame->target.samples;
    const float *const depth = b->depth + (size_t)((y - b->y0) * DP_TILE + (x - b->x0)) * samples;
    const float spine = m->stroke.a.d + (m->stroke.b.d - m->stroke.a.d) * s->t;
    const float step = (float)dp_depth_step(&b->frame->view, (double)spine, 1);
    const float limit = spine + step * (1 - 0.125f * s->distance);
    uint32_t visible = 0;
    for (uint32_t i = 0; i < samples; i++) visible += depth[i] <= limit;
    return (float)visible / (float)samples;
}

static void cover_pixel(const brush *b, const dp_stylized *m, uint32_t level, uint32_t x,
                        uint32_t y) {
    const float fx = (float)x + 0.5f, fy = (float)y + 0.5f;
    spot s;
    if (!find_spot(m, fx, fy, &s)) return;
    const uint32_t px = x - b->x0, py = y - b->y0;
    dp_ink_worker *const w = b->worker;
    const bool set = w->row[py] >> px & 1;
    const size_t at = py * DP_TILE + px;
    if (!m->outside && set && s.distance >= w->nearest[at]) return;
    if (m->outside && !m->core)
        cover_outside(m, &s, fx, fy);
    else
        cover_centred(m, &s);
    if (!(s.cover > 0)) return;
    if (m->core) s.v = 0;
    if (b->pattern) s.cover *= within_ends(m, &s);
    if (!(s.cover > 0)) return;
    const float rank = m->outside ? s.distance + 1000 * (1 - s.cover) : s.distance;
    if (set && rank >= w->nearest[at]) return;
    s.cover *= m->outside && !m->core
                   ? beyond_share(b, m, &s, x, y)
                   : dp_visible_share(b->frame, b->depth, b->x0, b->y0, &m->stroke, x, y, s.t,
                                      trusted_distance(b, m, &s));
    if (!(s.cover > 0)) return;
    dp_color color = m->stroke.color;
    if (b->style->texture) {
        const dp_texel t = texel_at(b, m, level, &s);
        s.cover *= t.ink < least_ink(m)
                       ? 0
                       : t.ink; /* discarded, it is this part's pixel all the same, no other's */
        if (b->style->texture->coloured)
            color = DP_RGB((uint32_t)(t.r + 0.5f), (uint32_t)(t.g + 0.5f), (uint32_t)(t.b + 0.5f));
    }
    w->row[py] |= (uint64_t)1 << px;
    w->nearest[at] = rank;
    w->coverage[at] = s.cover;
    w->color[at] = color;
}

static uint32_t clamp_to(float v, uint32_t lo, uint32_t hi) {
    return v <= (float)lo ? lo : v >= (float)hi ? hi : (uint32_t)v;
}

static void cover(const brush *b, const dp_stylized *m) {
    const dp_stroke *const k = &m->stroke;
    const float r = k->half_width + 1;
    const uint32_t y0 = clamp_to(dp_minf(k->a.y, k->b.y) - r, b->y0, b->y1),
                   y1 = clamp_to(dp_maxf(k->a.y, k->b.y) + r + 1, b->y0, b->y1);
    const uint32_t x0 = clamp_to(dp_minf(k->a.x, k->b.x) - r, b->x0, b->x1),
                   x1 = clamp_to(dp_maxf(k->a.x, k->b.x) + r + 1, b->x0, b->x1);
    const dp_texture *const texture = b->style->texture;
    const uint32_t level =
        texture ? dp_texture_level(texture, m->outside ? k->half_width : 2 * k->half_width) : 0;
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++) cover_pixel(b, m, level, x, y);
}

static void flush(const brush *b, dp_line line) {
    const dp_target *const target = &b->frame->target;
    dp_ink_worker *const w = b->worker;
    for (uint32_t py = 0; py < DP_TILE; py++) {
        for (uint64_t bits = w->row[py]; bits; bits &= bits - 1) {
            const uint32_t px = (uint32_t)__builtin_ctzll(bits), x = b->x0 + px, y = b->y0 + py;
            const size_t at = py * DP_TILE + px;
            if (target->rgba)
                dp_blend(target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)x,
                         w->color[at], w->coverage[at]);
            if (target->line_class && w->coverage[at] >= 0.5f)
                target->line_class[(size_t)y * target->width + x] = (uint8_t)(1 + line);
        }
        w->row[py] = 0;
    }
}

static void ink_layer(const brush *b, const uint32_t *stylized, size_t count, dp_line line) {
    bool any = false;
    uint32_t chain = 0;
    for (size_t i = 0; i < count; i++) {
        const dp_stylized *const m = &b->stylized[stylized[i]];
        if (m->stroke.line != line) continue;
        if (any && m->chain != chain) flush(b, line);
        chain = m->chain;
        any = true;
        cover(b, m);
    }
    if (any) flush(b, line);
}

void dp_ink_stylized(const dp_inking *k, dp_ink_worker *worker, uint32_t tile) {
    const dp_frame *const frame = k->frame;
    size_t count;
    if (!dp_fetch_strokes(k, worker, tile, &count)) {
        worker->failed = true;
        return;
    }
    if (!count) return;
    const uint32_t x0 = tile % frame->tiles_x * DP_TILE, y0 = tile / frame->tiles_x * DP_TILE;
    const dp_target *const target = &frame->target;
    const brush b = {.frame = frame,
                     .stylized = k->drawing->stylized.stylized,
                     .worker = worker,
                     .style = &frame->styles[0].stroke,
                     .outlines_outside = dp_lies_outside(frame),
                     .pattern = frame->styles[0].pattern.texture,
                     .depth = frame->tile_pieces[tile].empty
                                  ? NULL
                                  : frame->depth + (size_t)tile * frame->tile_samples,
                     .x0 = x0,
                     .y0 = y0,
                     .x1 = x0 + DP_TILE < target->width ? x0 + DP_TILE : target->width,
                     .y1 = y0 + DP_TILE < target->height ? y0 + DP_TILE : target->height};
    memset(worker->row, 0, sizeof worker->row);
    for (int i = 0; i < DP_LINE_COUNT; i++) ink_layer(&b, worker->strokes, count, dp_layers[i]);
}
