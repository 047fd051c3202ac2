/* Quads as ink: (Raskar 2001) as printed. The added polygons are the lines; nothing else is drawn.
 *
 *    for each polygon of the tile
 *        front face   each edge adds a ridge quad (2.2) and a valley quad (2.3)
 *        back face    each edge adds its part of the enlargement: a silhouette (2.1)
 *        itself       is tested against the surface: an intersection (2.4)
 *    fill what is added, with a depth test that depends on its class and on style.between
 *
 *    between    silhouettes, ridges       valleys, intersections
 *    plane      nearest wins, over the    inked behind the surface, if the two planes cross within
 *               finished faces            half a line width on the screen
 *    interval   update z1 like a face     between-test: z1 >= d >= z2, with z2 = z1 - offset
 *               passes = 1: in one walk, as polygons come; passes = 2: against the finished z1
 *    stencil    as plane                  pass 2: samples nearer than the surface count down
 *                                         pass 3: the same moved nearer by offset count up;
 *                                         the count of a sample is how many quads are trapped
 *
 * Depth d is larger when nearer, unlike in the paper. The stencil way needs one depth buffer and
 * one stencil buffer (Raskar 2001, 7). All but interval with passes = 1 are independent of the
 * order of polygons.
 *
 * Data structure: per sample, the ink that it holds (0: none; else class and style) and that ink's
 * depth; for interval the same array is z1, of faces and lines. Invariant: faces keep their own
 * depth, so surface, distance and normal of the picture are those of other inks. Not handled: a
 * border has no quad of its own; it is drawn as a ridge. */
#include "printed/quads.h"

#include "features/features.h"
#include "printed/marks.h"

#include <string.h>

/* Added polygons are held off what they may touch: silhouettes and ridges behind it, valleys before
 * it. A few roundings of float32 depth are enough; more would leave holes where both halves of a
 * line meet. Two surfaces within twice that distance are one: duplicate polygons do not
 * intersect. */
static const double BIAS = 1, SAME = 2;
static double hold_off(const dp_view *view, double d, double bias) {
    return bias * (4e-7 * fabs(d) + fabs(dp_depth_step(view, d, 0.0005)));
}

/* A trapped fragment lies at most this many line widths behind the surface, in world space. */
static const double TRAP = 4;

static dp_step step_of(const dp_view *view, double px) {
    if (view->perspective) return (dp_step){(float)(1 - px / view->focal), 0};
    return (dp_step){1, (float)(-px / view->focal)};
}

/* The number of a polygon's style. */
static uint32_t style_of(const dp_printer *w, uint32_t polygon) {
    const uint16_t *const groups = w->tile->frame->polygons.groups;
    return dp_style_number(w->tile->frame, groups ? groups[polygon] : 0);
}

/* ------- what the lines of a group are drawn with ------- */

typedef struct tool {
    dp_pen pen;
    dp_brush brush;
    float reach;  /* px; how far it draws from its edge */
    uint32_t ink; /* the brush's, without marks */
} tool;

/* What depends on the style alone. Polygons of one group mostly follow each other. */
typedef struct style_cache {
    uint32_t number;
    const dp_style *style;
    tool tools[DP_LINE_COUNT];
    /* How far what a polygon adds reaches: `reach` px on the screen; in depth, towards the eye or
     * towards the surface that traps it, from d to scale * d + offset. Not known, and `may_hide` is
     * false, where a step in depth is too large for perspective. */
    float reach;
    double scale, offset;
    bool may_hide;
    double off[2]; /* hold_off(d, bias) = bias * (off[0] * |d| + off[1]) */
} style_cache;

/* Ridges and valleys are drawn half from each side. One pass of the depth interval shows a valley
 * from one side only, so that side gets the whole width. */
bool dp_quads_whole(const dp_style *style, dp_line line) {
    return line == DP_LINE_SILHOUETTE ||
           (line == DP_LINE_VALLEY && style->between == DP_BETWEEN_INTERVAL && style->passes == 1);
}

dp_pen dp_quads_pen(const dp_style *style, dp_line line) {
    const bool whole = dp_quads_whole(style, line);
    const float angle = line == DP_LINE_VALLEY ? style->valley_angle : style->ridge_angle;
    return dp_pen_make(style->method, (double)style->line[line].width * (whole ? 1 : 0.5),
                       (double)angle);
}

static void set_test(dp_brush *b, const dp_style *style, dp_line line) {
    const dp_view *const view = &b->w->tile->frame->view;
    const double width = (double)style->line[line].width, offset = (double)style->between_offset;
    b->reach = (float)(width / 2);
    b->trap = step_of(view, style->between == DP_BETWEEN_PLANE ? TRAP * width : offset);
    b->nearer = step_of(view, -offset);
}

static void set_tool(dp_printer *w, tool *t, const dp_style *style, uint32_t number, dp_line line) {
    t->pen = dp_quads_pen(style, line);
    t->reach =
        (float)t->pen.reach * (t->pen.method == DP_METHOD_PAPER ? (float)DP_PAPER_MARGIN : 1) + 1;
    t->ink = dp_ink_of(line, number);
    t->brush = (dp_brush){.w = w, .ink = t->ink, .other = UINT32_MAX};
    set_test(&t->brush, style, line);
}

/* Finds how far the widest line reaches. */
static void set_reach(style_cache *o, const dp_view *view) {
    const dp_style *const style = o->style;
    const bool paper = style->method == DP_METHOD_PAPER;
    float width = 0;
    for (int i = 0; i < DP_LINE_COUNT; i++) width = dp_maxf(width, style->line[i].width);
    const double nearer = paper ? 1 / DP_PAPER_GRAZING : DP_STEEPEST;
    const double trap =
        style->between == DP_BETWEEN_PLANE ? TRAP * (double)width : (double)style->between_offset;
    const double share = (nearer * (double)width + trap + 1) / view->focal; /* in pixel sizes */
    o->reach = width * (paper ? (float)DP_PAPER_MARGIN : 1) + 1;
    o->may_hide = !view->perspective || share <= 0.5;
    o->scale = view->perspective ? 1 / (1 - share) : 1;
    o->offset = view->perspective ? 0 : share;
}

static void fill_cache(dp_printer *w, style_cache *o, uint32_t number) {
    const dp_view *const view = &w->tile->frame->view;
    o->number = number;
    o->style = &w->tile->frame->styles[number];
    for (int line = 0; line < DP_LINE_COUNT; line++)
        set_tool(w, &o->tools[line], o->style, number, (dp_line)line);
    set_reach(o, view);
    o->off[1] = hold_off(view, 0, 1);
    o->off[0] = hold_off(view, 1, 1) - o->off[1];
}

/* ------- polygons through the primitive shaders ------- */

/* One walk over the tile's polygons: how silhouettes, ridges and borders are filled, and how
 * valleys are. NULL: not drawn in this walk. */
typedef struct shading {
    dp_printer *w;
    dp_fill *line, *valley;
    style_cache style_cache;
} shading;

/* How lines are filled with marks. */
static dp_fill *marked_fill(dp_fill *line) {
    return line == dp_fill_line       ? dp_fill_marked_line
           : line == dp_fill_interval ? dp_fill_marked_interval
                                      : line;
}

static void begin_shading(shading *pass, dp_printer *w, dp_fill *line, dp_fill *valley) {
    pass->w = w;
    pass->line = w->marked ? marked_fill(line) : line, pass->valley = valley;
    fill_cache(w, &pass->style_cache, 0);
}

static uint32_t block_of(float px) {
    return px <= 0 ? 0 : px >= DP_TILE - 1 ? DP_TILE / DP_BLOCK - 1 : (uint32_t)px / DP_BLOCK;
}

/* Is the surface all around the polygon nearer by more than lines reach? Then nothing it adds
 * shows. */
static bool is_hidden(const dp_printer *w, const style_cache *o, const dp_tile_polygon *p) {
    if (!o->may_hide) return false;
    const float limit = (float)((double)p->nearest * o->scale + o->offset);
    const uint32_t x0 = block_of(p->x0 - o->reach), x1 = block_of(p->x1 + 1 + o->reach);
    const uint32_t y0 = block_of(p->y0 - o->reach), y1 = block_of(p->y1 + 1 + o->reach);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++)
            if (w->tile->farthest[0][0][y + 1][x + 1] <= limit) return false;
    return true;
}

bool dp_quads_fetch(dp_printer *w, uint32_t index, dp_primitive *out) {
    const dp_polygons *const polygons = &w->tile->frame->polygons;
    const dp_tile_polygon *const p = &w->tile->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    if (!DP_TILE_RESERVE(w->tile, w, world, world_cap, n) ||
        !DP_TILE_RESERVE(w->tile, w, clip, clip_cap, n) ||
        !DP_TILE_RESERVE(w->tile, w, screen_edges, screen_edges_cap, n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        w->world[i] = dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i)));
        w->clip[i] = dp_to_clip(&w->tile->frame->view, w->world[i]);
    }
    *out = (dp_primitive){.view = &w->tile->frame->view,
                          .n = n,
                          .world = w->world,
                          .clip = w->clip,
                          .edge_flags = polygons->edge_flags ? polygons->edge_flags + first : NULL,
                          .has_diagonals = polygons->has_diagonals,
                          .normal = dp_polygon_normal(w->tile->frame, p->id),
                          .front = p->flags & DP_POLYGON_FRONT};
    dp_screen_edges_make(out, w->screen_edges);
    out->edges = w->screen_edges;
    return true;
}

/* Fills an added polygon. Its points go from screen to tile space in float32, as those of faces do,
 * so that shared edges stay shared. */
static void fill_added(dp_brush *b, const style_cache *o, const dp_added *a, double bias,
                       dp_fill *with) {
    const dp_printer *const w = b->w;
    const float tile_x = (float)w->tile->tile_x, tile_y = (float)w->tile->tile_y;
    dp_point points[DP_ADDED_POINTS];
    double nearest = a->points[0].d;
    for (uint32_t i = 0; i < a->count; i++) {
        points[i] = (dp_point){(float)a->points[i].x - tile_x, (float)a->points[i].y - tile_y,
                               (float)a->points[i].d};
        nearest = dp_max(nearest, a->points[i].d);
    }
    for (int i = 0; i < 2; i++)
        b->root[i] = (dp_point){(float)(a->root[i].x - w->tile->tile_x),
                                (float)(a->root[i].y - w->tile->tile_y), 0};
    const double shift = -bias * (o->off[0] * fabs(nearest) + o->off[1]);
    b->plane =
        (dp_plane){(float)(a->d0 + a->dx * w->tile->tile_x + a->dy * w->tile->tile_y + shift),
                   (float)a->dx, (float)a->dy, (float)(a->nearest + shift)};
    with(b, points, a->count);
}

/* How joints are filled where lines are filled so; silhouettes have none that need be asked. */
static dp_fill *joint_fill(dp_line line, dp_fill *with) {
    if (line == DP_LINE_SILHOUETTE) return with;
    return with == dp_fill_line          ? dp_fill_joint
           : with == dp_fill_marked_line ? dp_fill_marked_joint
                                         : with;
}

/* Gives an added polygon its mark. */
static __attribute__((noinline)) void mark(dp_brush *b, uint32_t ink, uint32_t edge,
                                           const dp_added *added) {
    b->ink = dp_mark_added(b->w, ink, b->self, edge, added);
    for (int i = 0; i < 2; i++) b->screen_root[i] = added->root[i];
}

/* Fills everything of one class that polygon `index` adds. */
static void add_class(shading *pass, const dp_primitive *primitive, uint32_t index, dp_line line,
                      dp_primitive_shader *shade, double bias, dp_fill *with) {
    dp_printer *const w = pass->w;
    tool *const t = &pass->style_cache.tools[line];
    dp_fill *const joint = joint_fill(line, with);
    const bool marked = w->marked;
    t->brush.self = index;
    for (uint32_t edge = 0; edge < primitive->n; edge++) {
        dp_added added[DP_ADDED_MOST];
        if (!dp_tile_edge_reaches(w->tile, &w->tile->polygons[index], edge, t->reach)) continue;
        const uint32_t count = shade(primitive, edge, &t->pen, added);
        for (uint32_t i = 0; i < count; i++) {
            if (marked) /* of a joint, the second half is the next edge's */
                mark(&t->brush, t->ink,
                     i <= count / 2             ? edge
                     : edge + 1 == primitive->n ? 0
                                                : edge + 1,
                     &added[i]);
            fill_added(&t->brush, &pass->style_cache, &added[i], bias,
                       added[i].joint ? joint : with);
        }
        w->tile->stats.added_polygons += count;
    }
}

/* Adds the lines of one polygon. Ridge quads show borders too: as ridges, or, with ridges off, in
 * the borders' colour. */
static void add_lines(shading *pass, uint32_t index) {
    dp_printer *const w = pass->w;
    const dp_tile_polygon *const p = &w->tile->polygons[index];
    const uint32_t number = style_of(w, p->id);
    if (number != pass->style_cache.number) fill_cache(w, &pass->style_cache, number);
    const bool front = p->flags & DP_POLYGON_FRONT;
    const uint32_t drawn = (pass->line ? ~(uint32_t)DP_VALLEY : 0) | (pass->valley ? DP_VALLEY : 0);
    const uint32_t lines = pass->style_cache.style->lines & drawn;
    dp_primitive primitive;
    if (!(lines & (front ? DP_RIDGE | DP_BORDER | DP_VALLEY : DP_SILHOUETTE))) return;
    if (is_hidden(w, &pass->style_cache, p) || !dp_quads_fetch(w, index, &primitive)) return;
    if (!front)
        add_class(pass, &primitive, index, DP_LINE_SILHOUETTE, dp_shade_silhouette, BIAS,
                  pass->line);
    else if (lines & DP_RIDGE)
        add_class(pass, &primitive, index, DP_LINE_RIDGE, dp_shade_ridge, BIAS, pass->line);
    else if (lines & DP_BORDER)
        add_class(pass, &primitive, index, DP_LINE_BORDER, dp_shade_ridge, BIAS, pass->line);
    if (front && lines & DP_VALLEY)
        add_class(pass, &primitive, index, DP_LINE_VALLEY, dp_shade_valley, -BIAS, pass->valley);
}

static void add_all(dp_printer *w, dp_fill *line, dp_fill *valley) {
    shading pass;
    begin_shading(&pass, w, line, valley);
    for (uint32_t i = 0; i < w->tile->polygon_count && !w->tile->failed; i++) add_lines(&pass, i);
}

/* ------- faces ------- */

/* The ink of what no added polygon draws. */
static uint32_t ink_of(dp_printer *w, dp_line line, uint32_t style) {
    const uint32_t ink = dp_ink_of(line, style);
    return w->marked ? dp_mark_class(w, ink) : ink;
}

static void fill_face(dp_brush *b, const dp_tile_polygon *p, dp_fill *with) {
    b->plane = (dp_plane){p->d0, p->dx, p->dy, p->nearest};
    const dp_vertex *const v = b->w->tile->points + p->point;
    for (uint32_t i = 2; i < p->points; i++) {
        const dp_point triangle[3] = {dp_place(v[0]), dp_place(v[i - 1]), dp_place(v[i])};
        with(b, triangle, 3);
    }
}

/* Tests the polygon itself. `back`: back faces too, where they are painted. */
static void add_face(dp_printer *w, uint32_t index, bool back, double bias, dp_fill *with) {
    const dp_tile_polygon *const p = &w->tile->polygons[index];
    const uint32_t number = style_of(w, p->id);
    const dp_style *const style = &w->tile->frame->styles[number];
    if (!(style->lines & DP_INTERSECTION) || !dp_is_surface(w->tile, p)) return;
    if (!back && !(p->flags & DP_POLYGON_FRONT)) return;
    dp_brush b = {.w = w,
                  .ink = ink_of(w, DP_LINE_INTERSECTION, number),
                  .self = index,
                  .face = true,
                  .other = UINT32_MAX};
    set_test(&b, style, DP_LINE_INTERSECTION);
    dp_tile_polygon q = *p;
    const float shift = (float)hold_off(&w->tile->frame->view, (double)p->nearest, bias);
    q.d0 -= shift, q.nearest -= shift;
    fill_face(&b, &q, with);
}

static void add_faces(dp_printer *w, bool back, double bias, dp_fill *with) {
    if (!(w->tile->frame->lines & DP_INTERSECTION)) return;
    for (uint32_t i = 0; i < w->tile->polygon_count; i++) add_face(w, i, back, bias, with);
}

/* ------- the three between-tests ------- */

/* In one walk: a valley is never inked over a line, and a line always over a valley, so the order
 * does not matter. */
static void between_planes(dp_printer *w) {
    add_all(w, dp_fill_line, dp_fill_between_planes);
    add_faces(w, true, SAME, dp_fill_between_planes);
}

/* In submission order: a polygon, its silhouette or ridges, its valleys. */
static void between_depths_once(dp_printer *w) {
    shading pass;
    begin_shading(&pass, w, dp_fill_interval, dp_fill_trap_in_interval);
    for (uint32_t i = 0; i < w->tile->polygon_count && !w->tile->failed; i++) {
        const dp_tile_polygon *const p = &w->tile->polygons[i];
        const uint32_t number = style_of(w, p->id);
        const dp_style *const style = &w->tile->frame->styles[number];
        if (dp_is_surface(w->tile, p)) {
            dp_brush b = {.w = w,
                          .ink = ink_of(w, DP_LINE_INTERSECTION, number),
                          .face = true,
                          .intersections =
                              style->lines & DP_INTERSECTION && p->flags & DP_POLYGON_FRONT};
            set_test(&b, style, DP_LINE_INTERSECTION);
            fill_face(&b, p, dp_fill_interval);
        }
        add_lines(&pass, i);
    }
}

/* First the finished z1 of faces and of lines that update it; then what is trapped. */
static void between_depths_twice(dp_printer *w) {
    for (size_t i = 0; i < w->tile->frame->tile_samples; i++)
        w->ink_depth[i] = dp_maxf(w->ink_depth[i], w->tile->depth[i]);
    add_all(w, dp_fill_interval, NULL);
    add_all(w, NULL, dp_fill_trap_in_interval);
    add_faces(w, false, -SAME,
              dp_fill_trap_in_interval); /* nor are the surface itself and its duplicates */
}

/* Inks samples where something is trapped and no nearer line is, in the colour of the surface's
 * group. Clears the stencil. */
static void ink_stencil(dp_printer *w, dp_line line) {
    for (size_t i = 0; i < w->tile->frame->tile_samples; i++) {
        const uint8_t count = w->stencil[i];
        w->stencil[i] = 0;
        if (!count || w->tile->winner[i] == UINT32_MAX) continue;
        if (w->ink[i] & DP_INK_ADDED) continue;
        w->ink[i] = w->marked && w->trapped[i]
                        ? w->trapped[i]
                        : ink_of(w, line, style_of(w, w->tile->polygons[w->tile->winner[i]].id));
        if (w->marked) w->trapped[i] = 0;
    }
}

static void between_by_stencil(dp_printer *w) {
    add_all(w, dp_fill_line, NULL);
    if (w->tile->frame->lines & DP_VALLEY) {
        add_all(w, NULL, dp_fill_count_down);
        add_all(w, NULL, dp_fill_count_up);
        ink_stencil(w, DP_LINE_VALLEY);
    }
    if (w->tile->frame->lines & DP_INTERSECTION) {
        add_faces(w, false, -SAME,
                  dp_fill_count_down); /* counts the surface itself and its duplicates too */
        add_faces(w, false, 0, dp_fill_count_up);
        ink_stencil(w, DP_LINE_INTERSECTION);
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
    memset(w->stencil, 0, n);
    dp_marks_begin(w);
    if (w->marked) {
        if (!DP_TILE_RESERVE(w->tile, w, trapped, trapped_cap, n) ||
            !DP_TILE_RESERVE(w->tile, w, rank, rank_cap, n))
            return false;
        memset(w->trapped, 0, n * sizeof *w->trapped);
    }
    /* In perspective nothing lies beyond infinity, d = 0, though a steep plane may lead there. */
    const float farthest = w->tile->frame->view.perspective ? 0 : DP_DEPTH_EMPTY;
    for (size_t i = 0; i < n; i++) w->ink_depth[i] = farthest;
    return true;
}

void dp_tile_quads(dp_printer *w) {
    const dp_style *const style = &w->tile->frame->styles[0];
    if (!w->tile->polygon_count || !begin(w)) return;
    if (style->between == DP_BETWEEN_PLANE)
        between_planes(w);
    else if (style->between == DP_BETWEEN_STENCIL)
        between_by_stencil(w);
    else if (style->passes == 1)
        between_depths_once(w);
    else
        between_depths_twice(w);
    if (!w->tile->failed) dp_quads_put(w);
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_printer, ink, ink_cap),
                                  DP_ARRAY(dp_printer, ink_depth, ink_depth_cap),
                                  DP_ARRAY(dp_printer, stencil, stencil_cap),
                                  DP_ARRAY(dp_printer, world, world_cap),
                                  DP_ARRAY(dp_printer, clip, clip_cap),
                                  DP_ARRAY(dp_printer, screen_edges, screen_edges_cap),
                                  DP_ARRAY(dp_printer, marks, marks_cap),
                                  DP_ARRAY(dp_printer, shown, shown_cap),
                                  DP_ARRAY(dp_printer, colors, colors_cap),
                                  DP_ARRAY(dp_printer, trapped, trapped_cap),
                                  DP_ARRAY(dp_printer, rank, rank_cap)};

void dp_printer_free(dp_printer *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_printer_bytes(const dp_printer *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
