/* Stylizing: from chains of segments to stylized strokes.
 *
 *     for each chain, cut at corners where a pen is lifted, and for each repeat:
 *         take points along it at even depths
 *         smooth them, but not at corners; move them by jitter; lengthen both ends by overshoot
 *         make a part of a stroke of each two points: width by taper, depth and light; u by length
 *
 * A pattern's u (DP_STROKE_WORLD) is measured in space, from point to point of the same points, with
 * their depths smoothed (which are affine on a straight line): a zigzag towards the eye and away, as outlines of round
 * surfaces have it, is not seen and takes no length.
 *
 * The texture of a closed chain is stretched to fit a whole number of times, so that it has no
 * seam. Jitter is noise over the arc length, seeded by the style's seed, the repeat and the
 * polygon at which the chain begins: it depends neither on threads nor on the rest of the
 * picture. Extruded silhouettes (Hermosilla and Vázquez 2010, 2.3) lie outside their chain and are
 * not moved. */
#include "strokes/lines.h"

#include "features/mapping.h"
#include "features/silhouette_edge.h"
#include "core/outline.h"
#include "texture/texture.h"

enum { SMOOTHINGS = 3, DEPTH_SMOOTHINGS = 48 };
static const float CORNER = 0.77f; /* cosine: sharper turns than 40 degrees are meant, and stay */
static const float BREAK = 0.34f;  /* at corners of more than 70 degrees the pen is lifted */
static const float SWELL = 0.4f;   /* px of width per px of an extruded outline's length */
static const float CORE = 0.6f; /* px, half the width of the edges themselves under extruded ink */
static const float THINNEST = 0.12f; /* of the width, at the end of a taper */

typedef struct dp_stylized_point {
    float x, y, d;
    float arc;        /* px from the chain's start */
    float reach;      /* world units from there, with DP_STROKE_WORLD; else as arc */
    uint32_t segment; /* that follows */
} path_point;

static const dp_array arrays[] = {DP_ARRAY(dp_stylized_store, stylized, stylized_cap),
                                  DP_ARRAY(dp_stylized_store, points, points_cap),
                                  DP_ARRAY(dp_stylized_store, lights, lights_cap),
                                  DP_ARRAY(dp_stylized_store, depths, depths_cap)};

void dp_stylized_store_free(dp_stylized_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_stylized_store_bytes(const dp_stylized_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}

bool dp_lies_outside(const dp_frame *f) { return f->adjacency && f->styles[0].ink == DP_INK_QUADS; }

bool dp_is_stylized(const dp_frame *f) {
    const dp_stroke_style *const s = &f->styles[0].stroke;
    return dp_lies_outside(f) || s->texture || s->taper > 0 || s->jitter > 0 || s->overshoot > 0 ||
           s->depth > 0 || s->light > 0 || s->repeats > 1;
}

/* ------- noise ------- */

static uint32_t hash(uint32_t a, uint32_t b) {
    uint32_t h = a * 0x9e3779b1u ^ b * 0x85ebca77u;
    h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u;
    return h ^ h >> 15;
}

static float random_at(uint32_t i, uint32_t seed) {
    return (float)(hash(i, seed) >> 8) / 8388608.0f - 1;
}

/* Smooth, in [-1, 1], about one swing per unit. */
static float noise(float t, uint32_t seed) {
    const float f = floorf(t), a = t - f, w = a * a * (3 - 2 * a);
    const uint32_t i = (uint32_t)(int32_t)f;
    return random_at(i, seed) * (1 - w) + random_at(i + 1, seed) * w;
}

/* ------- one chain's points ------- */

typedef struct stylizer {
    const dp_frame *frame;
    const dp_lines *drawing;
    dp_stylized_store *store;
    const dp_stroke_style *style;
    bool outside;            /* the line that is being drawn lies beside its spine */
    float nearest, farthest; /* depths of all lines */
} stylizer;

/* A part of a chain between two corners at which the pen is lifted; or the whole. */
typedef struct run {
    const dp_link *links; /* of the chain */
    uint32_t total;       /* how many those are; the run may go round their end */
    uint32_t first, count;
    bool closed;
} run;

static const dp_link *link_at(const run *r, uint32_t i) {
    return &r->links[(r->first + i) % r->total];
}
static dp_point link_start(const stylizer *h, const dp_link *l) {
    return l->reversed ? h->drawing->strokes[l->segment].b : h->drawing->strokes[l->segment].a;
}
static dp_point link_end(const stylizer *h, const dp_link *l) {
    return l->reversed ? h->drawing->strokes[l->segment].a : h->drawing->strokes[l->segment].b;
}

static bool add_point(stylizer *h, size_t *n, dp_point p, uint32_t segment) {
    dp_stylized_store *const s = h->store;
    if (!dp_reserve(h->frame->memory, &s->points, &s->points_cap, *n + 1, sizeof *s->points))
        return false;
    s->points[(*n)++] = (path_point){p.x, p.y, p.d, 0, 0, segment};
    return true;
}

static float cosine(float ax, float ay, float bx, float by) {
    const float length = sqrtf((ax * ax + ay * ay) * (bx * bx + by * by));
    return length > 0 ? (ax * bx + ay * by) / length : 1;
}

/* Points along the chain, each at least `spacing` from the last and no further than that within a
 * segment: what zigzags within that distance does so no more. Where long segments meet always. */
static bool take_points(stylizer *h, const run *chain, float spacing, size_t *n) {
    dp_point last = {0, 0, 0};
    *n = 0;
    for (uint32_t i = 0; i < chain->count; i++) {
        const dp_link *const link = link_at(chain, i);
        const dp_point p = link_start(h, link), q = link_end(h, link);
        const float dx = q.x - p.x, dy = q.y - p.y, step = dp_hypotf(dx, dy),
                    from_last = dp_hypotf(p.x - last.x, p.y - last.y);
        if (i == 0 || from_last >= (step > 2 * spacing ? spacing / 4 : spacing)) {
            if (!add_point(h, n, p, link->segment)) return false;
            last = p;
        }
        const float parts = floorf(step / spacing);
        for (float k = 1; k < parts; k++) {
            const float t = k / parts;
            last = (dp_point){p.x + dx * t, p.y + dy * t, p.d + (q.d - p.d) * t};
            if (!add_point(h, n, last, link->segment)) return false;
        }
    }
    const dp_link *const end = link_at(chain, chain->count - 1);
    const dp_point q = link_end(h, end);
    /* the end itself: moves what is too close to it onto it */
    if (*n > 1 && dp_hypotf(q.x - last.x, q.y - last.y) < spacing / 2) --*n;
    return add_point(h, n, q, end->segment);
}

/* Arc lengths of the points as they lie now. */
static float measure(path_point *p, size_t n) {
    float arc = 0;
    for (size_t i = 0; i < n; i++) {
        if (i) arc += dp_hypotf(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
        p[i].arc = arc;
    }
    return arc;
}

static bool is_world(const stylizer *h) {
    return h->style->texture && h->style->u == DP_STROKE_WORLD;
}

/* Smooths a row of numbers, but for its ends. */
static void even_out(double *v, size_t n) {
    for (int pass = 0; pass < DEPTH_SMOOTHINGS; pass++) {
        double last = v[0];
        for (size_t i = 1; i + 1 < n; i++) {
            const double own = v[i];
            v[i] = (last + 2 * own + v[i + 1]) / 4;
            last = own;
        }
    }
}

/* Lengths in space from the chain's start, for u. */
static bool measure_space(stylizer *h, size_t n) {
    dp_stylized_store *const s = h->store;
    const dp_view *const view = &h->frame->view;
    path_point *const p = s->points;
    for (size_t i = 0; i < n; i++) p[i].reach = p[i].arc;
    if (!is_world(h)) return true;
    if (!dp_reserve(h->frame->memory, &s->depths, &s->depths_cap, n, sizeof *s->depths))
        return false;
    for (size_t i = 0; i < n; i++) s->depths[i] = (double)p[i].d;
    even_out(s->depths, n);
    dp_vec3 last = {0, 0, 0};
    double reach = 0;
    for (size_t i = 0; i < n; i++) {
        const dp_vec3 at =
            dp_unproject(view, (dp_pointd){(double)p[i].x, (double)p[i].y, s->depths[i]});
        if (i) reach += dp_length(dp_sub(at, last));
        p[i].reach = (float)reach;
        last = at;
    }
    return true;
}

/* Where a ring closes is a point like any other. */
static void smooth(path_point *p, size_t n, bool closed) {
    for (int pass = 0; pass < SMOOTHINGS; pass++) {
        float x = p[0].x, y = p[0].y;
        const float seam_x = (p[n - 2].x + 2 * x + p[1].x) / 4,
                    seam_y = (p[n - 2].y + 2 * y + p[1].y) / 4;
        for (size_t i = 1; i + 1 < n; i++) {
            const float cx = p[i].x, cy = p[i].y, nx = p[i + 1].x, ny = p[i + 1].y;
            if (cosine(cx - x, cy - y, nx - cx, ny - cy) >= CORNER)
                p[i].x = (x + 2 * cx + nx) / 4, p[i].y = (y + 2 * cy + ny) / 4;
            x = cx, y = cy;
        }
        if (closed && n > 3) p[0].x = p[n - 1].x = seam_x, p[0].y = p[n - 1].y = seam_y;
    }
}

/* Off the line, square to it: a slow sway and a small tremble. Ends of closed chains stay
 * together. */
static void sway(path_point *p, size_t n, float by, uint32_t seed, bool closed) {
    if (!(by > 0)) return;
    float x = p[0].x, y = p[0].y;
    const float length = p[n - 1].arc;
    for (size_t i = 0; i < n; i++) {
        const path_point *const next = &p[i + 1 < n ? i + 1 : i];
        const float dx = next->x - x, dy = next->y - y, step = dp_hypotf(dx, dy);
        const float hold = closed ? dp_minf(1, dp_minf(p[i].arc, length - p[i].arc) / 20) : 1;
        const float off =
            by * hold * (0.8f * noise(p[i].arc / 45, seed) + 0.3f * noise(p[i].arc / 11, seed + 1));
        x = p[i].x, y = p[i].y;
        if (step > 0) p[i].x -= dy / step * off, p[i].y += dx / step * off;
    }
}

/* Runs the ends on along their directions. */
static void overshoot(path_point *p, size_t n, float by) {
    const float most = p[n - 1].arc / 4, reach = by < most ? by : most;
    const float ax = p[0].x - p[1].x, ay = p[0].y - p[1].y, a = dp_hypotf(ax, ay);
    const float bx = p[n - 1].x - p[n - 2].x, by_ = p[n - 1].y - p[n - 2].y, b = dp_hypotf(bx, by_);
    if (a > 0) p[0].x += ax / a * reach, p[0].y += ay / a * reach;
    if (b > 0) p[n - 1].x += bx / b * reach, p[n - 1].y += by_ / b * reach;
}

/* ------- width ------- */

/* Light from the eye's upper left, on the mean of the line's polygons. */
static float light_of(const dp_frame *f, const dp_piece *piece) {
    const dp_view *const v = &f->view;
    const dp_vec3 right = dp_unit(dp_v3(v->clip[0][0], v->clip[0][1], v->clip[0][2]));
    const dp_vec3 up = dp_unit(dp_v3(v->clip[1][0], v->clip[1][1], v->clip[1][2]));
    const dp_vec3 side = dp_sub(right, dp_scale(v->forward, dp_dot(right, v->forward)));
    const dp_vec3 to_light = dp_unit(dp_add(
        dp_add(dp_scale(dp_unit(side), -0.6), dp_scale(up, 0.7)), dp_scale(v->forward, -0.4)));
    dp_vec3 n = dp_polygon_normal(f, piece->a);
    if (piece->b != UINT32_MAX) n = dp_add(n, dp_polygon_normal(f, piece->b));
    return (float)dp_max(0, dp_dot(dp_unit(n), to_light));
}

static void find_distances(stylizer *h) {
    h->nearest = INFINITY, h->farthest = -INFINITY;
    for (size_t i = 0; i < h->drawing->count; i++) {
        if (h->drawing->segments[i].level) continue;
        const float a = h->drawing->segments[i].a[2], b = h->drawing->segments[i].b[2];
        h->nearest = dp_minf(h->nearest, dp_minf(a, b)),
        h->farthest = dp_maxf(h->farthest, dp_maxf(a, b));
    }
}

static float ramp(float t) {
    const float c = dp_minf(dp_maxf(t, 0), 1);
    return c * c * (3 - 2 * c);
}

/* Share of the line's width at a point. */
static float width_at(const stylizer *h, const path_point *p, float length, bool closed) {
    const dp_stroke_style *const s = h->style;
    float share = 1;
    if (s->taper > 0 && !closed && length > 0) {
        const float reach = dp_minf(s->taper, length / 2),
                    from_end = dp_minf(p->arc, length - p->arc);
        share *= THINNEST + (1 - THINNEST) * ramp(from_end / reach);
    }
    if (s->depth > 0 && h->farthest > h->nearest) {
        const float distance = (float)dp_distance(&h->frame->view, (double)p->d);
        share *=
            1 -
            s->depth * dp_minf(dp_maxf((distance - h->nearest) / (h->farthest - h->nearest), 0), 1);
    }
    if (s->light > 0) share *= 1 - s->light * h->store->lights[p->segment];
    return dp_maxf(share, 0.05f);
}

/* ------- parts of strokes ------- */

/* How many repeats of the texture one px, or one unit of space, is long. Closed chains have no seam; long open ones that
 * begin where the texture does end where it does, so that no dot is cut, for a stretch of an eighth
 * at most. */
static float repeats_per_px(const stylizer *h, float width, float length, bool closed) {
    if (!h->style->texture) return 0;
    const float period = (float)dp_pattern_length(h->frame, &h->frame->styles[0], width);
    if (length < (closed ? 0.5f : 4) * period || (!closed && h->style->jitter > 0))
        return 1 / period;
    return floorf(length / period + 0.5f) / length;
}

static void set_directions(dp_stylized *m, const path_point *before, bool outside, float side) {
    const float ex = m->stroke.b.x - m->stroke.a.x, ey = m->stroke.b.y - m->stroke.a.y,
                e = dp_hypotf(ex, ey);
    m->length = e;
    if (outside && e > 0) m->outward[0] = -ey / e * side, m->outward[1] = ex / e * side;
    if (!before) return;
    const float bx = m->stroke.a.x - before->x, by = m->stroke.a.y - before->y,
                b = dp_hypotf(bx, by);
    if (b > 0) m->before[0] = bx / b, m->before[1] = by / b;
    m->middle[0] = m->outward[0] - m->before[1] * side,
    m->middle[1] = m->outward[1] + m->before[0] * side;
}

/* u by the polar formula at a point, in turns; whole turns are added so that it lies within half a
 * turn of `near`. */
static float polar_at(const stylizer *h, dp_point p, float near) {
    const dp_frame *const f = h->frame;
    const double half = f->view.height / 2;
    const double u = dp_stroke_polar((p.x - f->centre[0]) / half, (f->centre[1] - p.y) / half,
                                     (double)h->style->k);
    return (float)(u - floor(u - (double)near + 0.5));
}

/* With its core, extruded ink is as wide as asked, and hardly wider than what it lies along is
 * long: fine meshes are full of folds of a few triangles. */
static float outside_width(float full, float length) {
    return dp_maxf(dp_minf(full, 1.5f + SWELL * length) - CORE, 0.25f);
}

/* Does a pattern's v, which runs to the right of the stroke's way, run towards the model? */
static bool is_flipped(const stylizer *h, const dp_link *l) {
    const dp_piece *const piece = &h->drawing->pieces[l->segment];
    if (!h->frame->styles[0].pattern.texture || !(1u << piece->line & DP_OUTLINES)) return false;
    const dp_point a = link_start(h, l), b = link_end(h, l);
    double out[2];
    dp_find_outside(h->frame, piece->a, (dp_pointd){a.x, a.y, 0}, (dp_pointd){b.x, b.y, 0}, out);
    return (b.x - a.x) * out[1] - (b.y - a.y) * out[0] < 0;
}

static bool add_parts(stylizer *h, const run *chain, size_t n, float length, uint32_t id,
                      uint32_t seed) {
    dp_stylized_store *const s = h->store;
    const path_point *const p = s->points;
    if (!dp_reserve(h->frame->memory, &s->stylized, &s->stylized_cap, s->count + n,
                    sizeof *s->stylized))
        return false;
    const dp_link *const head = link_at(chain, 0);
    const dp_stroke *const first = &h->drawing->strokes[head->segment];
    const float full =
        h->outside ? outside_width(2 * first->half_width, length) : first->half_width;
    const float per_px = repeats_per_px(h, 2 * first->half_width, p[n - 1].reach, chain->closed);
    const float start =
        h->style->jitter > 0 && !chain->closed ? 0.5f + 0.5f * random_at(7, seed) : 0;
    const bool polar = h->style->texture && h->style->u == DP_STROKE_POLAR;
    const float turns = polar ? dp_polar_repeats(h->frame, h->style, 2 * first->half_width) : 0;
    const float side =
        h->outside ? (float)(h->drawing->sides[head->segment] * (head->reversed ? -1 : 1)) : 0;
    const bool flipped = is_flipped(h, head);
    for (size_t i = 0; i + 1 < n; i++) {
        const bool closed = chain->closed;
        dp_stylized *const m = &s->stylized[s->count++];
        *m = (dp_stylized){.stroke = h->drawing->strokes[p[i].segment],
                           .chain = id,
                           .outside = h->outside,
                           .flipped = flipped,
                           .ends = i + 2 == n && !chain->closed};
        m->stroke.a = (dp_point){p[i].x, p[i].y, p[i].d},
        m->stroke.b = (dp_point){p[i + 1].x, p[i + 1].y, p[i + 1].d};
        m->half[0] = full * width_at(h, &p[i], length, closed);
        m->half[1] = full * width_at(h, &p[i + 1], length, closed);
        m->stroke.half_width = dp_maxf(m->half[0], m->half[1]);
        m->arc[0] = start + p[i].reach * per_px, m->arc[1] = start + p[i + 1].reach * per_px;
        m->world = is_world(h) && h->frame->view.perspective;
        if (polar) {
            m->arc[0] = polar_at(h, m->stroke.a, 0.5f);
            m->arc[1] = polar_at(h, m->stroke.b, m->arc[0]);
            for (int k = 0; k < 2; k++) m->arc[k] *= turns;
        }
        set_directions(m, i ? &p[i - 1] : chain->closed ? &p[n - 2] : NULL, h->outside, side);
    }
    return true;
}

static float raw_length(const stylizer *h, const run *r) {
    float sum = 0;
    for (uint32_t i = 0; i < r->count; i++) {
        const dp_stroke *const k = &h->drawing->strokes[link_at(r, i)->segment];
        sum += dp_hypotf(k->b.x - k->a.x, k->b.y - k->a.y);
    }
    return sum;
}

/* Extruded ink lies beside points taken at a distance; the edges themselves are inked as they are,
 * thinly, so that none is lost between two points or on a surface that hardly falls away. u is that
 * of the parts, by the share of the length. */
static bool add_core(stylizer *h, const run *r, size_t first_part, uint32_t id) {
    dp_stylized_store *const s = h->store;
    if (!dp_reserve(h->frame->memory, &s->stylized, &s->stylized_cap, s->count + r->count,
                    sizeof *s->stylized))
        return false;
    const bool any = s->count > first_part;
    const float from = any ? s->stylized[first_part].arc[0] : 0,
                to = any ? s->stylized[s->count - 1].arc[1] : 0;
    const float total = raw_length(h, r);
    float arc = 0;
    for (uint32_t i = 0; i < r->count && total > 0; i++) {
        const dp_link *const l = link_at(r, i);
        dp_stylized *const m = &s->stylized[s->count++];
        *m = (dp_stylized){.stroke = h->drawing->strokes[l->segment],
                           .chain = id,
                           .outside = true,
                           .core = true,
                           .half = {CORE, CORE}};
        m->stroke.a = link_start(h, l), m->stroke.b = link_end(h, l);
        m->stroke.half_width = CORE;
        m->length = dp_hypotf(m->stroke.b.x - m->stroke.a.x, m->stroke.b.y - m->stroke.a.y);
        m->arc[0] = from + (to - from) * (arc / total);
        arc += m->length;
        m->arc[1] = from + (to - from) * (arc / total);
    }
    return true;
}

/* What is shorter than it is wide shows nothing of a pattern but a blot: fine meshes are full of folds
 * of a few triangles. */
static bool shows_pattern(const stylizer *h, const dp_link *head, float length) {
    const float width = 2 * h->drawing->strokes[head->segment].half_width;
    return !h->frame->styles[0].pattern.texture || length >= width;
}

static bool draw_run(stylizer *h, const run *chain, uint32_t repeat, uint32_t *id) {
    const dp_stroke_style *const s = h->style;
    const dp_link *const head = link_at(chain, 0);
    const dp_piece *const piece = &h->drawing->pieces[head->segment];
    const uint32_t seed = hash(hash(s->seed * 8 + repeat, piece->a), piece->edge * 4 + piece->line);
    const float spacing =
        dp_minf(dp_maxf(h->drawing->strokes[head->segment].half_width, 1.5f), h->outside ? 4 : 5);
    const float quarter =
        dp_maxf(raw_length(h, chain) / 4, 0.25f); /* a small ring is more than a point */
    size_t n;
    if (!take_points(h, chain, dp_minf(spacing, quarter), &n)) return false;
    path_point *const p = h->store->points;
    float length = measure(p, n);
    if (!h->outside) {
        smooth(p, n, chain->closed);
        measure(p, n);
        sway(p, n, s->jitter + (repeat ? 0.8f : 0), seed, chain->closed);
        if (s->overshoot > 0 && !chain->closed)
            overshoot(p, n, s->overshoot * (repeat ? 1 + 0.5f * random_at(3, seed) : 1));
        length = measure(p, n);
    }
    const size_t first = h->store->count;
    if (!measure_space(h, n)) return false;
    if (length > 0 && shows_pattern(h, head, length) && !add_parts(h, chain, n, length, *id, seed))
        return false;
    if (h->outside && !add_core(h, chain, first, *id)) return false;
    ++*id;
    return true;
}

/* Does the pen stop before link i? Where two segments that are long on the screen make a corner.
 * What is short may zigzag as it likes. */
static bool is_cut(const stylizer *h, const run *r, uint32_t i) {
    const dp_link *const l = link_at(r, i + r->total - 1), *const m = link_at(r, i);
    const dp_point a = link_start(h, l), b = link_end(h, l), c = link_start(h, m),
                   d = link_end(h, m);
    const float least = 4 + 2 * h->drawing->strokes[m->segment].half_width;
    if (dp_hypotf(b.x - a.x, b.y - a.y) < least || dp_hypotf(d.x - c.x, d.y - c.y) < least)
        return false;
    return cosine(b.x - a.x, b.y - a.y, d.x - c.x, d.y - c.y) < BREAK;
}

/* A chain's runs, each as often as the style says. */
static bool draw_chain(stylizer *h, const dp_chain *chain, uint32_t *id) {
    h->outside = h->drawing->sides[h->drawing->chains.links[chain->first].segment];
    run r = {.links = h->drawing->chains.links + chain->first,
             .total = chain->count,
             .count = chain->count,
             .closed = chain->closed};
    const uint32_t repeats = h->outside ? 1 : h->style->repeats;
    for (uint32_t i = 0; !h->outside && r.closed && i < r.total; i++)
        if (is_cut(h, &r, i)) r.first = i, r.closed = false;
    run rest = r;
    for (uint32_t i = 1; i <= r.total; i++) {
        if (i < r.total && (h->outside || !is_cut(h, &r, i))) continue;
        rest.count = i - ((rest.first + r.total - r.first) % r.total);
        for (uint32_t k = 0; k < repeats; k++)
            if (!draw_run(h, &rest, k, id)) return false;
        rest.first = (r.first + i) % r.total;
    }
    return true;
}

/* How lit lines are. */
static bool find_lights(stylizer *h) {
    dp_stylized_store *const s = h->store;
    if (!(h->style->light > 0)) return true;
    if (!dp_reserve(h->frame->memory, &s->lights, &s->lights_cap, h->drawing->count,
                    sizeof *s->lights))
        return false;
    for (size_t i = 0; i < h->drawing->count; i++)
        s->lights[i] = light_of(h->frame, &h->drawing->pieces[i]);
    return true;
}

/* Hidden lines are dashed, not stylized (hidden.c). */
static bool is_hidden(const dp_lines *d, const dp_chain *chain) {
    return d->segments[d->chains.links[chain->first].segment].level;
}

bool dp_stylize(const dp_frame *frame, dp_lines *drawing) {
    dp_stylized_store *const store = &drawing->stylized;
    stylizer h = {
        .frame = frame, .drawing = drawing, .store = store, .style = &frame->styles[0].stroke};
    store->count = 0;
    if (!drawing->stylizes) return true;
    if (!dp_chain_lines(frame, drawing) || !find_lights(&h)) return false;
    find_distances(&h);
    uint32_t id = 0;
    for (uint32_t c = 0; c < drawing->chains.chain_count; c++)
        if (!is_hidden(drawing, &drawing->chains.chains[c]) &&
            !draw_chain(&h, &drawing->chains.chains[c], &id))
            return false;
    return store->count < UINT32_MAX;
}
