/* From the tiles' pieces to feature segments.
 *
 *     join pieces: a spine that crosses a tile border has a piece in each tile; the sample points
 *         of the second begin where those of the first end
 *     make segments, many at once: ends on the screen and in the world, planes of the polygons
 *         beside them, and what ends them (segments.inc)
 *
 * Data structure: a piece is a run [k0, k1) of the sample points of a spine. Pieces that touch a
 * tile border (`open`) are sorted by edge and joined; all others are segments as they are. The
 * tile has kept the spine's ends and normals (segment geometry); they are computed again only
 * where it has not. Invariant: the order (tile by tile, then the joined ones by polygon) does not
 * depend on threads. */
#include "strokes/lines.h"
#include "strokes/segment_batch.h"

#include "base/hostile.h"
#include "strokes/evidence.h"
#include "strokes/kernels.h"
#include "features/crossing.h"
#include "features/lit.h"
#include "core/outline.h"
#include "core/spine.h"
#include "base/sort.h"

enum { BLOCK = DP_TUNED(128, 7) };

static const dp_array arrays[] = {DP_ARRAY(dp_lines, pieces, pieces_cap),
                                  DP_ARRAY(dp_lines, segments, segments_cap),
                                  DP_ARRAY(dp_lines, strokes, strokes_cap),
                                  DP_ARRAY(dp_lines, sides, sides_cap),
                                  DP_ARRAY(dp_lines, inked, inked_cap),
                                  DP_ARRAY(dp_lines, hidden.strokes, hidden.strokes_cap),
                                  DP_ARRAY(dp_lines, hidden.segment, hidden.segment_cap),
                                  DP_ARRAY(dp_lines, hidden.dropped, hidden.dropped_cap),
                                  DP_ARRAY(dp_lines, hidden.points, hidden.points_cap),
                                  DP_ARRAY(dp_lines, hidden.arc, hidden.arc_cap)};

void dp_lines_free(dp_lines *drawing, const dp_allocator *memory) {
    dp_arrays_free(memory, drawing, DP_ARRAYS(arrays));
    dp_chain_store_free(&drawing->chains, memory);
    dp_chain_store_free(&drawing->hidden.chains, memory);
    dp_stylized_store_free(&drawing->stylized, memory);
}

uint64_t dp_lines_bytes(const dp_lines *drawing) {
    return dp_arrays_bytes(drawing, DP_ARRAYS(arrays)) + dp_chain_store_bytes(&drawing->chains) +
           dp_chain_store_bytes(&drawing->hidden.chains) +
           dp_stylized_store_bytes(&drawing->stylized);
}

static int ascending(uint32_t a, uint32_t b) { return (a > b) - (a < b); }

int dp_piece_order(const dp_piece *l, const dp_piece *r) {
    if (l->a != r->a) return ascending(l->a, r->a);
    if (l->edge != r->edge) return ascending(l->edge, r->edge);
    if (l->b != r->b) return ascending(l->b, r->b);
    if (l->line != r->line) return ascending(l->line, r->line);
    if (l->k0 != r->k0) return ascending(l->k0, r->k0);
    return ascending(l->level, r->level);
}

static int by_edge(const void *left, const void *right) { return dp_piece_order(left, right); }

bool dp_piece_goes_on(const dp_piece *p, const dp_piece *q) {
    return p->a == q->a && p->b == q->b && p->edge == q->edge && p->line == q->line &&
           p->level == q->level && p->through == q->through && p->k1 == q->k0;
}

/* All pieces to the front of the store: closed ones in order, then the joined open ones. */
static bool join_pieces(const dp_frame *frame, const dp_found *found, dp_lines *store,
                        size_t *count) {
    const uint32_t tiles = frame->tiles_x * frame->tiles_y;
    size_t total = 0, closed = 0, open;
    for (uint32_t t = 0; t < tiles; t++) total += frame->tile_pieces[t].count;
    if (!dp_reserve(frame->memory, &store->pieces, &store->pieces_cap, total,
                    sizeof *store->pieces))
        return false;
    open = total;
    for (uint32_t t = 0; t < tiles; t++) {
        const dp_tile_pieces *const list = &frame->tile_pieces[t];
        const dp_piece *const pieces =
            list->count ? found[list->worker].pieces + list->first : NULL;
        for (size_t i = 0; i < list->count; i++) {
            dp_piece *const to = &store->pieces[pieces[i].open ? --open : closed++];
            *to = pieces[i];
            to->worker = list->worker;
        }
    }
    if (total > closed)
        dp_sort(store->pieces + closed, total - closed, sizeof *store->pieces, by_edge);
    size_t last = closed;
    for (size_t i = closed; i < total; i++) {
        if (i > closed && dp_piece_goes_on(&store->pieces[last - 1], &store->pieces[i])) {
            store->pieces[last - 1].k1 = store->pieces[i].k1;
            store->pieces[last - 1].hider[1] = store->pieces[i].hider[1];
            store->pieces[last - 1].end[1] = store->pieces[i].end[1];
        } else {
            store->pieces[last++] = store->pieces[i];
        }
    }
    *count = last;
    return true;
}

static void edge_of(const dp_polygons *polygons, const dp_piece *piece, uint32_t *va,
                    uint32_t *vb) {
    const uint32_t first = dp_first_corner(polygons, piece->a),
                   n = dp_corner_count(polygons, piece->a);
    *va = dp_corner_vertex(polygons, first + piece->edge);
    *vb = dp_corner_vertex(polygons, first + (piece->edge + 1) % n);
}

/* What a segment is made of, found again. The spine could be made when the piece was found: it can
 * now. */
static dp_segment_geometry find_geometry(const dp_frame *frame, const dp_piece *piece) {
    const dp_polygons *const polygons = &frame->polygons;
    dp_segment_geometry out = {0};
    dp_spine spine = {0};
    dp_vec3 a, b, normal;
    if (piece->edge != DP_CROSSING) {
        uint32_t va, vb;
        edge_of(polygons, piece, &va, &vb);
        (void)dp_spine_ends(&frame->view, dp_v3f(dp_vertex_position(polygons, va)),
                            dp_v3f(dp_vertex_position(polygons, vb)), &spine);
    } else if (dp_crossing_find(frame, piece->a, piece->b, &a, &b, &normal)) {
        (void)dp_spine_ends(&frame->view, a, b, &spine);
    }
    out.a = spine.a, out.b = spine.b;
    out.normal[0] = dp_polygon_normal(frame, piece->a);
    if (piece->b != UINT32_MAX) out.normal[1] = dp_polygon_normal(frame, piece->b);
    return out;
}

static uint64_t source_number(const dp_frame *frame, uint32_t polygon) {
    if (polygon == UINT32_MAX) return UINT64_MAX;
    return frame->polygons.source_polygon ? frame->polygons.source_polygon[polygon] : polygon;
}

typedef struct job {
    const dp_frame *frame;
    const dp_found *found;
    dp_lines *store;
} job;

static void put_geometry(const job *j, const dp_piece *piece, dp_segment_batch *out, uint32_t i) {
    const dp_segment_geometry geometry = piece->geometry
                                             ? j->found[piece->worker].geometry[piece->geometry - 1]
                                             : find_geometry(j->frame, piece);
    out->a[0][i] = geometry.a.x, out->a[1][i] = geometry.a.y, out->a[2][i] = geometry.a.d;
    out->b[0][i] = geometry.b.x, out->b[1][i] = geometry.b.y, out->b[2][i] = geometry.b.d;
    out->share[0][i] = ((double)piece->k0 + (double)piece->end[0]) / piece->n;
    out->share[1][i] = ((double)piece->k1 + (double)piece->end[1]) / piece->n;
    for (int k = 0; k < 2; k++)
        out->normal[k][0][i] = geometry.normal[k].x, out->normal[k][1][i] = geometry.normal[k].y,
        out->normal[k][2][i] = geometry.normal[k].z;
}

/* What a stroke may not lie in front of: not a polygon that is hidden behind an outline. */
static void take_plane(const dp_segment_batch *made, uint32_t i, int k, const dp_piece *piece,
                       float plane[3]) {
    plane[0] = NAN, plane[1] = plane[2] = 0;
    if ((k ? piece->b : piece->a) == UINT32_MAX || !(piece->seen >> k & 1)) return;
    for (int c = 0; c < 3; c++) plane[c] = made->plane[k][c][i];
}

static dp_point take_end(const dp_frame *frame, const dp_segment_batch *made, uint32_t i, int k,
                         float screen[3], double world[3]) {
    const dp_point p = {made->screen[k][0][i], made->screen[k][1][i], made->screen[k][2][i]};
    screen[0] = p.x, screen[1] = p.y, screen[2] = made->distance[k][i];
    for (int c = 0; c < 3; c++) world[c] = frame->origin[c] + (double)made->world[k][c][i];
    return p;
}

/* w - z and w + z are affine in world space: over
 * their gradients they are distances from the planes, which tell at any ratio of near to far; z / w
 * is nearly 1 for much of the depth where near is close to the eye. */
bool dp_lies_on_plane(const dp_view *view, const float world[3]) {
    const dp_clip_point c = dp_to_clip(view, dp_v3f(world));
    const double *const z = view->clip[2], *const w = view->clip[3];
    const double reach = 1e-5 * fabs(c.distance) + 1e-6 * dp_length(dp_v3f(world));
    for (int sign = -1; sign <= 1; sign += 2) {
        const dp_vec3 gradient = dp_v3(w[0] + sign * z[0], w[1] + sign * z[1], w[2] + sign * z[2]);
        if (fabs(c.w + sign * c.z) <= reach * dp_length(gradient)) return true;
    }
    return false;
}

/* Does a segment leave the picture at its end, as far as half the distance of two sample points and
 * what those are lifted by tell? Where a tile holds only one sample point of a line, it does not
 * know which way the line goes on. */
static bool leaves_picture(const dp_view *view, const float end[3], const float other[3]) {
    const double most[2] = {view->width, view->height};
    const double on[2] = {(double)end[0] - (double)other[0], (double)end[1] - (double)other[1]};
    const double length = sqrt(on[0] * on[0] + on[1] * on[1]);
    for (int i = 0; i < 2 && length > 0; i++) {
        const double beyond = (double)end[i] + on[i] / length * (DP_PROBE_SPACING / 2);
        if (on[i] < 0 ? beyond < DP_PROBE_LIFT : on[i] > 0 && beyond > most[i] - DP_PROBE_LIFT)
            return true;
    }
    return false;
}

/* Why a piece ends where it does. A spine that the near or far plane has cut ends there. */
static void take_line_end(const dp_frame *frame, const dp_segment_batch *made, uint32_t i,
                          const dp_piece *piece, int k, dp_segment *out) {
    const int32_t hider = (int32_t)piece->hider[k];
    const bool leaves = hider == DP_HIDER_UNKNOWN &&
                        leaves_picture(&frame->view, k ? out->b : out->a, k ? out->a : out->b);
    out->hider[k] = UINT64_MAX;
    if (hider == DP_HIDER_PICTURE || leaves) {
        out->end[k] = DP_END_PICTURE;
    } else if (hider == DP_HIDER_NONE) {
        const float world[3] = {made->world[k][0][i], made->world[k][1][i], made->world[k][2][i]};
        out->end[k] = dp_lies_on_plane(&frame->view, world) ? DP_END_PICTURE
                      : piece->edge == DP_CROSSING          ? DP_END_CROSSING
                                                            : DP_END_VERTEX;
    } else {
        out->end[k] = DP_END_HIDDEN;
        if (hider != DP_HIDER_UNKNOWN) out->hider[k] = source_number(frame, piece->hider[k]);
    }
}

/* Of an x-ray, what surfaces of the style's colour and opacity leave of a line's colour: as ink on
 * paper, where pixels are blended layer by layer (sink/xray.c). */
static dp_color faded(const dp_style *style, float through, dp_color color) {
    const dp_color over = style->surface & 0xff ? style->surface : style->paper;
    dp_color out = color & 0xff;
    for (int shift = 8; shift < 32; shift += 8) {
        const float c = (float)(color >> shift & 0xff), o = (float)(over >> shift & 0xff);
        out |= (dp_color)(o + (c - o) * through + 0.5f) << shift;
    }
    return out;
}

/* The colour of a visible line in the light that falls on the polygons beside it: at a crease, both
 * are taken as they are seen. */
static dp_color lit(const dp_frame *frame, const dp_style *style, const dp_piece *piece,
                    dp_color color) {
    const bool outline = piece->line == DP_LINE_SILHOUETTE;
    const uint32_t polygons[2] = {piece->a, piece->b};
    dp_vec3 sum = {0, 0, 0};
    for (int k = 0; k < 2; k++) {
        if (polygons[k] == UINT32_MAX) continue;
        const dp_vec3 n = dp_polygon_normal(frame, polygons[k]);
        const bool away = !outline && !dp_polygon_faces_eye(frame, polygons[k]);
        sum = dp_mad(sum, n, away ? -1 : 1);
    }
    return dp_lit_color(style, color,
                        dp_dot(dp_unit(sum), dp_light_direction(&frame->view, style)));
}

void dp_take_look(const dp_frame *frame, const dp_piece *piece, dp_segment *segment,
                  dp_stroke *stroke) {
    const dp_style *const style = dp_polygon_style(frame, piece->a);
    const bool own = piece->level && style->hidden.look; /* else an x-ray's look as visible ones */
    const dp_line_style *const line =
        own ? &style->hidden.line[piece->level - 1][piece->line] : &style->line[piece->line];
    segment->level = stroke->level = piece->level;
    segment->width = line->width;
    dp_color color = line->color;
    if (style->line_light.lighting && !own) color = lit(frame, style, piece, color);
    stroke->color = color;
    segment->color = frame->xray && piece->level ? faded(style, piece->through, color) : color;
    stroke->half_width = line->width / 2;
}

/* Smoothing cuts an edge into many, and a polygon by others. */
static uint32_t source_edge(const dp_frame *frame, const dp_piece *piece) {
    const dp_polygons *const p = &frame->polygons;
    if (piece->edge == DP_CROSSING) return UINT32_MAX;
    if (!p->source_edges) return piece->edge;
    const uint16_t edge = p->source_edges[dp_first_corner(p, piece->a) + piece->edge];
    return edge == DP_EDGE_INSIDE ? UINT32_MAX : edge;
}

/* Degrees between the normals of its two polygons, turned as the eye has them, whatever their winding:
 * both to the eye at a crease, one away from it at an outline. */
static float turn_at(const dp_view *view, const dp_segment_batch *made, uint32_t i,
                     const dp_piece *piece) {
    if (piece->b == UINT32_MAX || piece->edge == DP_CROSSING) return 0;
    const float at[3] = {made->world[0][0][i], made->world[0][1][i], made->world[0][2][i]};
    const dp_vec3 sight = dp_view_vector(view, dp_v3f(at));
    dp_vec3 normal[2];
    for (int k = 0; k < 2; k++)
        normal[k] = dp_v3(made->normal[k][0][i], made->normal[k][1][i], made->normal[k][2][i]);
    const bool alike = (dp_dot(normal[0], sight) < 0) == (dp_dot(normal[1], sight) < 0);
    const double cosine = dp_dot(normal[0], normal[1]);
    return dp_degrees_of_cosine(
        (float)(alike == (piece->line != DP_LINE_SILHOUETTE) ? cosine : -cosine));
}

static void take_segment(const dp_frame *frame, const dp_piece *piece, const dp_segment_batch *made,
                         uint32_t i, dp_segment *segment, dp_stroke *stroke) {
    segment->line = (dp_line)piece->line;
    segment->polygon = source_number(frame, piece->a);
    segment->other = source_number(frame, piece->b);
    segment->edge = source_edge(frame, piece);
    segment->group = frame->polygons.groups ? frame->polygons.groups[piece->a] : 0;
    segment->chain = segment->place = 0;
    segment->reversed = false;
    stroke->a = take_end(frame, made, i, 0, segment->a, segment->world_a);
    stroke->b = take_end(frame, made, i, 1, segment->b, segment->world_b);
    for (int k = 0; k < 2; k++) take_line_end(frame, made, i, piece, k, segment);
    stroke->line = piece->line;
    stroke->stops =
        (uint8_t)((segment->end[0] == DP_END_HIDDEN) | (segment->end[1] == DP_END_HIDDEN) << 1);
    dp_take_look(frame, piece, segment, stroke);
    for (int k = 0; k < 2; k++) take_plane(made, i, k, piece, stroke->plane[k]);
    stroke->turn = turn_at(&frame->view, made, i, piece);
}

static void make_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_lines *const store = j->store;
    const size_t first = (size_t)index * BLOCK, count = j->store->count;
    const size_t end = first + BLOCK < count ? first + BLOCK : count;
    dp_segment_batch batch = {0};
    (void)worker;
    for (size_t at = first; at < end; at += DP_SEGMENTS) {
        const uint32_t n = end - at < DP_SEGMENTS ? (uint32_t)(end - at) : DP_SEGMENTS;
        for (uint32_t i = 0; i < n; i++) put_geometry(j, &store->pieces[at + i], &batch, i);
        dp_stroke_kernels_for(j->frame->lanes)->segments(&j->frame->view, &batch, n);
        for (uint32_t i = 0; i < n; i++)
            take_segment(j->frame, &store->pieces[at + i], &batch, i, &store->segments[at + i],
                         &store->strokes[at + i]);
    }
}

bool dp_make_segments(const dp_frame *frame, const dp_found *found, dp_lines *store) {
    size_t count;
    if (!join_pieces(frame, found, store, &count)) return false;
    if (count > UINT32_MAX ||
        !dp_reserve(frame->memory, &store->segments, &store->segments_cap, count,
                    sizeof *store->segments) ||
        !dp_reserve(frame->memory, &store->strokes, &store->strokes_cap, count,
                    sizeof *store->strokes))
        return false;
    store->count = count;
    store->chained = false;
    store->inks_hidden = false;
    store->stylizes = dp_is_stylized(frame);
    store->patterned = frame->styles[0].pattern.texture;
    store->lit = frame->styles[0].line_light.lighting;
    store->lies_outside = dp_lies_outside(frame);
    store->silhouette_width = frame->styles[0].line[DP_LINE_SILHOUETTE].width;
    store->paper = frame->styles[0].paper;
    store->hidden_look = frame->hidden_look;
    store->surface = frame->styles[0].surface;
    job j = {frame, found, store};
    dp_parallel(frame->threads, (uint32_t)(count / BLOCK + (count % BLOCK != 0)), make_block, &j);
    return true;
}
