/* Quads as ink: the paper's method whole. The added polygons are the line; nothing else is drawn.
 *
 * Every polygon of the tile goes through the primitive shaders (features/), and what they add is
 * rasterized like any polygon, with depth tests that depend on its class and on style.between:
 *
 *   plane      pass 1: silhouette and ridge polygons, nearest wins, over the finished faces.
 *              pass 2: valley quads and the faces themselves (intersections) are inked where they lie
 *              behind the surface and the two planes cross within half a line width. Free of order.
 *   interval   the paper's two depth buffers, z1 and z2 = z1 + offset, and between-test, in one pass over
 *              the polygons as they come; with passes = 2 the between-test waits for the finished z1.
 *   stencil    pass 1 as for plane. Pass 2: valley quads before z1 count down in a stencil buffer;
 *              pass 3: the same quads, moved nearer by the offset, count up. What is left is how many
 *              are trapped. One depth buffer, one stencil buffer, free of order (Raskar 2001, 7).
 *
 * Data structure: per sample, the ink that it holds (0: none, else class and group) and that ink's depth;
 * for the interval test the same array is z1, of faces and lines. Faces keep their own depth, so that
 * surface, distance and normal of the picture are those of the other inks.
 * Not handled: a border has no quad of its own; it is drawn as a ridge. */
#include "pipe/coverage.h"
#include "pipe/crossing.h"
#include "pipe/tile.h"

#include "features/features.h"

#include <string.h>

/* Added polygons are held off what they may touch, silhouettes and ridges behind it, valleys before it, by a
 * few roundings of float32 depth: more would leave holes where both halves of a line meet. Two surfaces
 * twice as close as that are one: duplicate polygons do not intersect. */
static const double BIAS = 1, SAME = 2;
static double hold_off(const dp_view *view, double d, double bias) {
    return bias * (4e-7 * fabs(d) + fabs(dp_depth_step(view, d, 0.0005)));
}

/* A trapped fragment lies at most this many line widths behind the surface, in space. */
static const double TRAP = 4;
/* Silhouettes of back faces that are seen themselves (open models) are not inked on a back face that
 * is closer behind than this many line widths: there the enlargement only meets its neighbours. */
static const double SPARE = 4;
/* The plane of a surface under a ridge's joint passes the corner within this share of the joint's reach. */
static const float JOINT = 0.1f;

/* Depth d farther by `px` pixel sizes, as scale * d + offset: a pixel grows with distance in perspective. */
typedef struct step {
    float scale, offset;
} step;

static step step_of(const dp_view *view, double px) {
    if (view->perspective) return (step){(float)(1 - px / view->focal), 0};
    return (step){1, (float)(-px / view->focal)};
}

/* Ink of an added polygon that is as good as a face: not trapped behind one. */
static const uint32_t ADDED = 1u << 31;

static uint32_t ink_of(dp_line line, uint32_t group) {
    const bool trapped = line == DP_LINE_VALLEY || line == DP_LINE_INTERSECTION;
    return (trapped ? 0 : ADDED) | (line + 1u) << 16 | group;
}
static dp_line ink_line(uint32_t ink) { return (dp_line)((ink >> 16 & 7) - 1); }

static uint32_t group_of(const dp_tile_worker *w, uint32_t polygon) {
    const uint16_t *const groups = w->frame->polygons.groups;
    const uint32_t group = groups ? groups[polygon] : 0;
    return group < w->frame->style_count ? group : 0;
}

/* ------- depth tests: what is done with the samples that a polygon covers ------- */

typedef struct brush {
    dp_tile_worker *w;
    uint32_t ink;
    uint32_t self;  /* tile polygon */
    dp_plane plane; /* of what is drawn */
    float reach;    /* px, plane test */
    dp_point root[2]; /* the same: what an added polygon grows from */
    step trap;      /* how far behind the surface still counts */
    step nearer;    /* stencil: how far it is moved towards the eye */
    bool face, front, intersections;
    uint32_t other; /* intersections: the last polygon asked about, and the answer */
    bool meets;
} brush;

static dp_f4 *depth_at(const brush *b, size_t lane) { return (dp_f4 *)(void *)(b->w->depth + lane); }
static dp_f4 *ink_depth_at(const brush *b, size_t lane) { return (dp_f4 *)(void *)(b->w->ink_depth + lane); }
static dp_i4 *ink_at(const brush *b, size_t lane) { return (dp_i4 *)(void *)(b->w->ink + lane); }
static dp_i4 splat(uint32_t v) { return (dp_i4){(int32_t)v, (int32_t)v, (int32_t)v, (int32_t)v}; }
static dp_f4 behind(dp_f4 d, step s) { return d * dp_splat(s.scale) + dp_splat(s.offset); }

/* The place in tile space where a sample lies. */
static void sample_at(const dp_sampling *s, size_t lane, float *x, float *y) {
    const size_t width = (size_t)4 * s->vectors, cell = lane / width, i = lane % width;
    *x = (float)(cell % s->cells_x * s->cell_width) + s->x[i / 4][i % 4];
    *y = (float)(cell / s->cells_x) + s->y[i / 4][i % 4];
}

/* Does the surface at the sample pass through what the added polygon grows from, as the neighbour there
 * does? The planes must cross within `reach` px of the root's nearest point. What merely lies close before
 * a hidden valley, or curves away beyond a corner, does not. */
static bool passes_root(const brush *b, size_t lane, float d, float reach) {
    const dp_tile_polygon *const q = &b->w->polygons[b->w->winner[lane]];
    const float gx = q->dx - b->plane.dx, gy = q->dy - b->plane.dy;
    float x, y;
    sample_at(&b->w->sampling, lane, &x, &y);
    const dp_point p = b->root[0], to = b->root[1];
    const float ex = to.x - p.x, ey = to.y - p.y, length2 = ex * ex + ey * ey;
    const float along = length2 > 0 ? ((x - p.x) * ex + (y - p.y) * ey) / length2 : 0;
    const float t = dp_minf(dp_maxf(along, 0), 1);
    const float gap = b->w->depth[lane] - d - gx * (x - p.x - t * ex) - gy * (y - p.y - t * ey);
    return dp_planes_cross_within(gap, gx, gy, reach);
}

/* Nearest wins, over the finished faces. */
DP_INLINED void draw_line(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    const dp_i4 win = in & (d > *depth_at(b, lane)) & (d > *ink_depth_at(b, lane));
    *ink_depth_at(b, lane) = dp_select(win, d, *ink_depth_at(b, lane));
    *ink_at(b, lane) = dp_selecti(win, splat(b->ink), *ink_at(b, lane));
}

/* The same for the joints of ridges. Around a corner lie polygons that share no edge with this one and may
 * curve away from it without any fold: close surfaces must pass through the corner. */
DP_INLINED void draw_joint(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    const dp_i4 win = in & (d > *depth_at(b, lane)) & (d > *ink_depth_at(b, lane));
    if (!dp_any(win)) return;
    const dp_i4 close = win & (*depth_at(b, lane) >= behind(d, b->trap));
    for (uint32_t i = 0; i < 4; i++) {
        if (!win[i] || (close[i] && !passes_root(b, lane + i, d[i], JOINT * b->reach))) continue;
        b->w->ink_depth[lane + i] = d[i];
        b->w->ink[lane + i] = b->ink;
    }
}

/* Both polygons' fronts are seen, or else their interiors cross indeed: a front and a back face come
 * close along every outline of a closed model without crossing there. */
static bool may_intersect(brush *b, uint32_t other) {
    if (b->other == other) return b->meets;
    const dp_tile_polygon *const p = &b->w->polygons[b->self], *const q = &b->w->polygons[other];
    b->other = other;
    b->meets = !dp_polygons_touch(&b->w->frame->polygons, p->id, q->id);
    dp_vec3 from, to, normal;
    if (b->meets && !(p->flags & q->flags & DP_POLYGON_FRONT))
        b->meets = dp_crossing_find(b->w->frame, p->id, q->id, &from, &to, &normal);
    return b->meets;
}

/* The between-test of planes, against the finished faces. */
DP_INLINED void trap_between_planes(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    brush *const b = arg;
    const dp_f4 surface = *depth_at(b, lane);
    const dp_i4 trapped = in & (d <= surface) & (d >= behind(surface, b->trap));
    if (!dp_any(trapped)) return;
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t winner = b->w->winner[lane + i], held = b->w->ink[lane + i];
        if (!trapped[i] || winner == b->self || winner == UINT32_MAX) continue;
        if (held & ADDED || (held && !b->face)) continue;
        const dp_tile_polygon *const q = &b->w->polygons[winner];
        if (!b->face && !(q->flags & DP_POLYGON_FRONT)) continue;
        if (!dp_planes_cross_within(surface[i] - d[i], q->dx - b->plane.dx, q->dy - b->plane.dy, b->reach))
            continue;
        if (b->face ? !may_intersect(b, winner) : !passes_root(b, lane + i, d[i], b->reach)) continue;
        b->w->ink[lane + i] = b->ink;
    }
}

/* The between-test: z1 >= d >= z2, where z1 is that of a face. Nothing is trapped under a silhouette or a
 * ridge, although these update z1 too. */
DP_INLINED dp_i4 between(const brush *b, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_f4 z1 = *ink_depth_at(b, lane);
    const dp_i4 ink = *ink_at(b, lane);
    const dp_i4 line = ink & splat(ADDED);
    return in & (d < z1) & (d >= behind(z1, b->trap)) & (line == 0);
}

/* The paper's: faces and lines update z1; what does not is asked for the between-test. */
DP_INLINED void draw_interval(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    const dp_f4 z1 = *ink_depth_at(b, lane);
    const dp_i4 win = in & (d > z1);
    const dp_i4 trapped = between(b, lane, in, d) & splat(b->intersections ? ~0u : 0);
    *ink_depth_at(b, lane) = dp_select(win, d, z1);
    const dp_i4 ink = dp_selecti(win, splat(b->face ? 0 : b->ink), *ink_at(b, lane));
    *ink_at(b, lane) = dp_selecti(trapped, splat(b->ink), ink);
}

DP_INLINED void trap_in_interval(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    *ink_at(b, lane) = dp_selecti(between(b, lane, in, d), splat(b->ink), *ink_at(b, lane));
}

DP_INLINED void count_down(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    const dp_i4 front = in & (d > *depth_at(b, lane));
    for (uint32_t i = 0; i < 4; i++) b->w->stencil[lane + i] += (uint8_t)front[i]; /* a mask is -1 */
}

DP_INLINED void count_up(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const brush *const b = arg;
    const dp_i4 front = in & (behind(d, b->nearer) > *depth_at(b, lane));
    for (uint32_t i = 0; i < 4; i++) b->w->stencil[lane + i] -= (uint8_t)front[i];
}

/* ------- rasterizing ------- */

#define DEFINE_FILL(name, test)                                                                        \
    static void name(brush *b, const dp_coverage *area) {                                              \
        const dp_sampling *const s = &b->w->sampling;                                                  \
        if (s->vectors == 1) dp_coverage_fill(s, area, &b->plane, 1, test, b);                         \
        else dp_coverage_fill(s, area, &b->plane, s->vectors, test, b);                                \
    }
DEFINE_FILL(fill_line, draw_line)
DEFINE_FILL(fill_joint, draw_joint)
DEFINE_FILL(fill_between_planes, trap_between_planes)
DEFINE_FILL(fill_interval, draw_interval)
DEFINE_FILL(fill_trap_in_interval, trap_in_interval)
DEFINE_FILL(fill_count_down, count_down)
DEFINE_FILL(fill_count_up, count_up)

typedef void fill(brush *b, const dp_coverage *area);

static void fill_points(brush *b, const dp_point *p, uint32_t n, fill *with) {
    for (uint32_t i = 2; i < n; i++) {
        dp_coverage area;
        if (dp_coverage_make(p[0], p[i - 1], p[i], &area)) with(b, &area);
    }
}

static void fill_face(brush *b, const dp_tile_polygon *p, fill *with) {
    b->plane = (dp_plane){p->d0, p->dx, p->dy, p->nearest};
    const dp_vertex *const v = b->w->points + p->point;
    for (uint32_t i = 2; i < p->points; i++) {
        const dp_point triangle[3] = {dp_place(v[0]), dp_place(v[i - 1]), dp_place(v[i])};
        fill_points(b, triangle, 3, with);
    }
}

/* Screen to tile space, in float32 as the faces are, so that edges they share stay shared. */
static void fill_added(brush *b, const dp_added *a, double bias, fill *with) {
    const dp_tile_worker *const w = b->w;
    dp_point points[DP_ADDED_POINTS];
    double nearest = a->points[0].d;
    for (uint32_t i = 0; i < a->count; i++) {
        points[i] = (dp_point){(float)a->points[i].x - (float)w->tile_x,
                               (float)a->points[i].y - (float)w->tile_y, (float)a->points[i].d};
        nearest = dp_max(nearest, a->points[i].d);
    }
    for (int i = 0; i < 2; i++)
        b->root[i] = (dp_point){(float)(a->root[i].x - w->tile_x), (float)(a->root[i].y - w->tile_y), 0};
    const double shift = -hold_off(&w->frame->view, nearest, bias);
    b->plane = (dp_plane){(float)(a->d0 + a->dx * w->tile_x + a->dy * w->tile_y + shift), (float)a->dx,
                          (float)a->dy, (float)(a->nearest + shift)};
    fill_points(b, points, a->count, with);
}

/* ------- polygons through the primitive shaders ------- */

typedef struct shading {
    dp_tile_worker *w;
    uint32_t lines; /* classes to be drawn */
    fill *with;
} shading;

/* ------- what is hidden anyway ------- */

static uint32_t block_of(float px) {
    return px <= 0 ? 0 : px >= DP_TILE - 1 ? DP_TILE / DP_BLOCK - 1 : (uint32_t)px / DP_BLOCK;
}

/* Nothing that the polygon adds within `reach` px can come out: it would have to come nearer, or be trapped
 * behind something that is nearer, by more than `rise` pixel sizes. */
static bool is_hidden(const dp_tile_worker *w, const dp_tile_polygon *p, float reach, double rise) {
    const dp_view *const view = &w->frame->view;
    const double near_d = (double)p->nearest, share = rise / view->focal;
    if (view->perspective && share > 0.5) return false;
    const float limit = (float)(view->perspective ? near_d / (1 - share) : near_d + share);
    const uint32_t x0 = block_of(p->x0 - reach), x1 = block_of(p->x1 + 1 + reach);
    const uint32_t y0 = block_of(p->y0 - reach), y1 = block_of(p->y1 + 1 + reach);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++)
            if (w->farthest[0][0][y][x] <= limit) return false;
    return true;
}

/* A polygon of the tile with its corners fetched; false: no memory. */
static bool fetch(dp_tile_worker *w, uint32_t index, dp_primitive *out) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    if (!DP_WORKER_RESERVE(w, world, world_cap, n) || !DP_WORKER_RESERVE(w, clip, clip_cap, n) ||
        !DP_WORKER_RESERVE(w, screen_edges, screen_edges_cap, n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        w->world[i] = dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i)));
        w->clip[i] = dp_to_clip(&w->frame->view, w->world[i]);
    }
    *out = (dp_primitive){.view = &w->frame->view, .n = n, .world = w->world, .clip = w->clip,
                          .edge_flags = polygons->edge_flags ? polygons->edge_flags + first : NULL,
                          .normal = dp_polygon_normal(w->frame, p->id),
                          .front = p->flags & DP_POLYGON_FRONT};
    for (uint32_t i = 0; i < n; i++)
        if (!dp_screen_edge_make(out, i, &w->screen_edges[i])) w->screen_edges[i].length = 0;
    out->edges = w->screen_edges;
    return true;
}

/* A polygon that is not clipped has an edge from point to point of its outline. */
static bool edge_near_tile(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t edge, float reach) {
    if (p->flags & DP_POLYGON_CLIPPED) return true;
    const dp_vertex a = w->points[p->point + edge];
    const dp_vertex b = w->points[p->point + (edge + 1 == p->points ? 0 : edge + 1)];
    return dp_maxf(a.x, b.x) >= -reach && dp_minf(a.x, b.x) <= DP_TILE + reach &&
           dp_maxf(a.y, b.y) >= -reach && dp_minf(a.y, b.y) <= DP_TILE + reach;
}

/* What a class is drawn with. Ridges and valleys are drawn half from either side; the paper's one pass
 * shows a valley on one side only, and gives it the whole width. */
static dp_pen pen_of(const dp_style *style, dp_line line) {
    const bool whole = line == DP_LINE_SILHOUETTE ||
                       (line == DP_LINE_VALLEY && style->between == DP_BETWEEN_INTERVAL && style->passes == 1);
    const float angle = line == DP_LINE_VALLEY ? style->valley_angle : style->ridge_angle;
    return dp_pen_make(style->method, (double)style->line[line].width * (whole ? 1 : 0.5), (double)angle);
}

static void aim(brush *b, const dp_style *style, dp_line line) {
    const dp_view *const view = &b->w->frame->view;
    const double width = (double)style->line[line].width, offset = (double)style->between_offset;
    b->reach = (float)(width / 2);
    b->trap = step_of(view, style->between == DP_BETWEEN_PLANE ? TRAP * width : offset);
    b->nearer = step_of(view, -offset);
}

/* Everything of one class that polygon `index` adds. */
static void add_class(const shading *pass, const dp_primitive *primitive, uint32_t index, dp_line line,
                      dp_primitive_shader *shade, double bias) {
    dp_tile_worker *const w = pass->w;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t group = group_of(w, p->id);
    const dp_style *const style = &w->frame->styles[group];
    const dp_pen pen = pen_of(style, line);
    const float reach = (float)pen.reach * (pen.method == DP_METHOD_PAPER ? (float)DP_PAPER_MARGIN : 1) + 1;
    brush b = {.w = w, .ink = ink_of(line, group), .self = index, .other = UINT32_MAX};
    aim(&b, style, line);
    for (uint32_t edge = 0; edge < primitive->n; edge++) {
        dp_added added[DP_ADDED_MOST];
        if (!edge_near_tile(w, p, edge, reach)) continue;
        const uint32_t count = shade(primitive, edge, &pen, added);
        for (uint32_t i = 0; i < count; i++) {
            const bool joint = added[i].joint && line != DP_LINE_SILHOUETTE && pass->with == fill_line;
            fill_added(&b, &added[i], bias, joint ? fill_joint : pass->with);
        }
        w->stats.added_polygons += count;
    }
}

/* How far the widest line of a polygon reaches on the screen, and towards the eye or the surface that traps it. */
static bool hides_all(const dp_tile_worker *w, const dp_tile_polygon *p) {
    const dp_style *const style = dp_polygon_style(w->frame, p->id);
    const bool paper = style->method == DP_METHOD_PAPER;
    float width = 0;
    for (int i = 0; i < DP_LINE_COUNT; i++) width = dp_maxf(width, style->line[i].width);
    const double nearer = paper ? 1 / DP_PAPER_GRAZING : DP_STEEPEST;
    const double trap = style->between == DP_BETWEEN_PLANE ? TRAP * (double)width : (double)style->between_offset;
    return is_hidden(w, p, width * (paper ? (float)DP_PAPER_MARGIN : 1) + 1, nearer * (double)width + trap + 1);
}

/* Ridge quads show borders too: as ridges, or with ridges off in the borders' colour. */
static void add_lines(const shading *pass, uint32_t index) {
    dp_tile_worker *const w = pass->w;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t lines = dp_polygon_style(w->frame, p->id)->lines & pass->lines;
    const bool front = p->flags & DP_POLYGON_FRONT;
    dp_primitive primitive;
    if (hides_all(w, p)) return;
    if (!(lines & (front ? DP_RIDGE | DP_BORDER | DP_VALLEY : DP_SILHOUETTE)) || !fetch(w, index, &primitive))
        return;
    if (!front) add_class(pass, &primitive, index, DP_LINE_SILHOUETTE, dp_shade_silhouette, BIAS);
    else if (lines & DP_RIDGE) add_class(pass, &primitive, index, DP_LINE_RIDGE, dp_shade_ridge, BIAS);
    else if (lines & DP_BORDER) add_class(pass, &primitive, index, DP_LINE_BORDER, dp_shade_ridge, BIAS);
    if (front && lines & DP_VALLEY) add_class(pass, &primitive, index, DP_LINE_VALLEY, dp_shade_valley, -BIAS);
}

static void add_all(dp_tile_worker *w, uint32_t lines, fill *with) {
    const shading pass = {w, lines, with};
    for (uint32_t i = 0; i < w->polygon_count && !w->failed; i++) add_lines(&pass, i);
}

/* The polygon itself as what is tested. `back` takes back faces too, where they are painted. */
static void add_face(dp_tile_worker *w, uint32_t index, bool back, double bias, fill *with) {
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t group = group_of(w, p->id);
    const dp_style *const style = &w->frame->styles[group];
    if (!(style->lines & DP_INTERSECTION) || !dp_is_surface(w, p)) return;
    if (!back && !(p->flags & DP_POLYGON_FRONT)) return;
    brush b = {.w = w, .ink = ink_of(DP_LINE_INTERSECTION, group), .self = index, .face = true,
               .other = UINT32_MAX};
    aim(&b, style, DP_LINE_INTERSECTION);
    dp_tile_polygon q = *p;
    const float shift = (float)hold_off(&w->frame->view, (double)p->nearest, bias);
    q.d0 -= shift, q.nearest -= shift;
    fill_face(&b, &q, with);
}

static void add_faces(dp_tile_worker *w, bool back, double bias, fill *with) {
    if (!(w->frame->lines & DP_INTERSECTION)) return;
    for (uint32_t i = 0; i < w->polygon_count; i++) add_face(w, i, back, bias, with);
}

/* ------- the three between-tests ------- */

static void between_planes(dp_tile_worker *w) {
    add_all(w, ~(uint32_t)DP_VALLEY, fill_line);
    add_all(w, DP_VALLEY, fill_between_planes);
    add_faces(w, true, SAME, fill_between_planes);
}

/* In submission order: the polygon, its silhouette or ridge, its valley. */
static void between_depths_once(dp_tile_worker *w) {
    const shading lines = {w, ~(uint32_t)DP_VALLEY, fill_interval};
    const shading valleys = {w, DP_VALLEY, fill_trap_in_interval};
    for (uint32_t i = 0; i < w->polygon_count && !w->failed; i++) {
        const dp_tile_polygon *const p = &w->polygons[i];
        const uint32_t group = group_of(w, p->id);
        const dp_style *const style = &w->frame->styles[group];
        if (dp_is_surface(w, p)) {
            brush b = {.w = w, .ink = ink_of(DP_LINE_INTERSECTION, group), .face = true,
                       .intersections = style->lines & DP_INTERSECTION && p->flags & DP_POLYGON_FRONT};
            aim(&b, style, DP_LINE_INTERSECTION);
            fill_face(&b, p, fill_interval);
        }
        add_lines(&lines, i);
        add_lines(&valleys, i);
    }
}

/* The finished z1: of faces, then of the lines that are polygons like any other. */
static void between_depths_twice(dp_tile_worker *w) {
    for (size_t i = 0; i < w->frame->tile_samples; i++)
        w->ink_depth[i] = dp_maxf(w->ink_depth[i], w->depth[i]);
    add_all(w, ~(uint32_t)DP_VALLEY, fill_interval);
    add_all(w, DP_VALLEY, fill_trap_in_interval);
    add_faces(w, false, SAME, fill_trap_in_interval);
}

/* Inks where anything is trapped and no nearer line is; the colour is that of the surface's group. Clears
 * the stencil. */
static void ink_stencil(dp_tile_worker *w, dp_line line) {
    for (size_t i = 0; i < w->frame->tile_samples; i++) {
        const uint8_t count = w->stencil[i];
        w->stencil[i] = 0;
        if (!count || w->winner[i] == UINT32_MAX) continue;
        if (w->ink[i] & ADDED) continue;
        w->ink[i] = ink_of(line, group_of(w, w->polygons[w->winner[i]].id));
    }
}

static void between_by_stencil(dp_tile_worker *w) {
    add_all(w, ~(uint32_t)DP_VALLEY, fill_line);
    if (w->frame->lines & DP_VALLEY) {
        add_all(w, DP_VALLEY, fill_count_down);
        add_all(w, DP_VALLEY, fill_count_up);
        ink_stencil(w, DP_LINE_VALLEY);
    }
    if (w->frame->lines & DP_INTERSECTION) {
        add_faces(w, false, -SAME, fill_count_down); /* the surface itself and its duplicates too */
        add_faces(w, false, 0, fill_count_up);
        ink_stencil(w, DP_LINE_INTERSECTION);
    }
}

/* ------- the picture ------- */

/* The enlargements of back faces that are seen meet each other as folds do; only what lies beyond an
 * outline is a silhouette. */
static void spare_back_faces(dp_tile_worker *w) {
    for (size_t i = 0; i < w->frame->tile_samples; i++) {
        const uint32_t winner = w->winner[i], ink = w->ink[i];
        if (!ink || ink_line(ink) != DP_LINE_SILHOUETTE || winner == UINT32_MAX) continue;
        if (w->polygons[winner].flags & DP_POLYGON_FRONT) continue;
        const double width = (double)w->frame->styles[ink & 0xffff].line[DP_LINE_SILHOUETTE].width;
        const double close = dp_depth_step(&w->frame->view, (double)w->depth[i], SPARE * width);
        if ((double)w->ink_depth[i] - (double)w->depth[i] < close) w->ink[i] = 0;
    }
}

static dp_color surface_color(const dp_tile_worker *w, size_t lane) {
    const dp_color paper = w->frame->styles[0].paper;
    if (w->winner[lane] == UINT32_MAX) return paper;
    const dp_color surface = dp_polygon_style(w->frame, w->polygons[w->winner[lane]].id)->surface;
    return surface & 0xff ? surface : paper;
}

/* Adds one sample: ink over what is under it. */
static void add_sample(const dp_tile_worker *w, size_t lane, float sum[4]) {
    const uint32_t ink = w->ink[lane];
    const dp_color under = surface_color(w, lane);
    const dp_color over = ink ? w->frame->styles[ink & 0xffff].line[ink_line(ink)].color : 0;
    const float a = (float)(over & 0xff) / 255, b = (float)(under & 0xff) / 255 * (1 - a);
    for (int k = 0; k < 3; k++)
        sum[k] += a * (float)(over >> (24 - 8 * k) & 0xff) + b * (float)(under >> (24 - 8 * k) & 0xff);
    sum[3] += a + b;
}

static void put_color(const dp_tile_worker *w, size_t lane, uint8_t out[4]) {
    const uint32_t samples = w->sampling.samples;
    float sum[4] = {0, 0, 0, 0};
    for (uint32_t i = 0; i < samples; i++) add_sample(w, lane + i, sum);
    for (int k = 0; k < 3 && sum[3] > 0; k++) out[k] = (uint8_t)(sum[k] / sum[3] + 0.5f);
    out[3] = (uint8_t)(255 * sum[3] / (float)samples + 0.5f);
}

/* The class that holds most of the samples, when ink holds half of them. */
static uint8_t class_of(const dp_tile_worker *w, size_t lane) {
    uint32_t counts[DP_LINE_COUNT] = {0}, all = 0;
    uint8_t best = 0;
    for (uint32_t i = 0; i < w->sampling.samples; i++) {
        if (!w->ink[lane + i]) continue;
        counts[ink_line(w->ink[lane + i])]++;
        all++;
    }
    for (uint8_t i = 1; i < DP_LINE_COUNT; i++)
        if (counts[i] > counts[best]) best = i;
    return all > 0 && 2 * all >= w->sampling.samples ? (uint8_t)(best + 1) : 0;
}

static bool has_ink(const dp_tile_worker *w, size_t lane) {
    for (uint32_t i = 0; i < w->sampling.samples; i++)
        if (w->ink[lane + i]) return true;
    return false;
}

static void put_ink(const dp_tile_worker *w) {
    const dp_target *const target = &w->frame->target;
    for (uint32_t y = w->tile_y; y < w->tile_y + DP_TILE && y < target->height; y++)
        for (uint32_t x = w->tile_x; x < w->tile_x + DP_TILE && x < target->width; x++) {
            const size_t lane = dp_pixel_lane(&w->sampling, x - w->tile_x, y - w->tile_y);
            if (!has_ink(w, lane)) continue;
            if (target->rgba) put_color(w, lane, target->rgba + y * target->rgba_stride + 4 * (size_t)x);
            if (target->line_class) target->line_class[(size_t)y * target->width + x] = class_of(w, lane);
        }
}

static bool begin(dp_tile_worker *w) {
    const size_t n = w->frame->tile_samples;
    if (!DP_WORKER_RESERVE(w, ink, ink_cap, n) || !DP_WORKER_RESERVE(w, ink_depth, ink_depth_cap, n) ||
        !DP_WORKER_RESERVE(w, stencil, stencil_cap, n))
        return false;
    memset(w->ink, 0, n * sizeof *w->ink);
    memset(w->stencil, 0, n);
    /* nothing lies beyond infinity, where a steep plane in perspective may lead */
    const float farthest = w->frame->view.perspective ? 0 : DP_DEPTH_EMPTY;
    for (size_t i = 0; i < n; i++) w->ink_depth[i] = farthest;
    return true;
}

void dp_tile_quads(dp_tile_worker *w) {

    const dp_style *const style = &w->frame->styles[0];
    if (!w->polygon_count || !begin(w)) return;
    if (style->between == DP_BETWEEN_PLANE) between_planes(w);
    else if (style->between == DP_BETWEEN_STENCIL) between_by_stencil(w);
    else if (style->passes == 1) between_depths_once(w);
    else between_depths_twice(w);
    spare_back_faces(w);
    put_ink(w);
}
