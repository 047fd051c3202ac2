/* From the tiles' pieces to visible feature segments.
 *
 * A piece is a run of sample points [k0, k1) of an edge's spine. Where a spine crosses a tile
 * border its run continues in the neighbour with the next number: such open pieces are sorted by
 * edge and joined. All others are segments as they are. The order (tile by tile, then the joined
 * ones by polygon) does not depend on threads. */
#include "strokes/mark.h"
#include "strokes/stroke.h"

#include "base/hostile.h"
#include "kernel/kernels.h"
#include "pipe/classify.h"
#include "pipe/crossing.h"
#include "pipe/fold_batch.h"
#include "pipe/tile.h"

#include <stdlib.h>

enum { BLOCK = DP_TUNED(128, 7) };

void dp_stroke_store_free(dp_stroke_store *store, const dp_allocator *memory) {
    dp_free(memory, store->pieces);
    dp_free(memory, store->segments);
    dp_free(memory, store->strokes);
    *store = (dp_stroke_store){0};
}

static int ascending(uint32_t a, uint32_t b) { return (a > b) - (a < b); }

static int by_edge(const void *left, const void *right) {
    const dp_piece *const l = left, *const r = right;
    if (l->a != r->a) return ascending(l->a, r->a);
    if (l->edge != r->edge) return ascending(l->edge, r->edge);
    if (l->b != r->b) return ascending(l->b, r->b);
    if (l->line != r->line) return ascending(l->line, r->line);
    return ascending(l->k0, r->k0);
}

static bool continues(const dp_piece *p, const dp_piece *q) {
    return p->a == q->a && p->b == q->b && p->edge == q->edge && p->line == q->line &&
           p->k1 == q->k0;
}

/* All pieces to the front of the store: closed ones in order, then the joined open ones. */
static bool join_pieces(const dp_frame *frame, const dp_tile_worker *workers,
                        dp_stroke_store *store, size_t *count) {
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
            list->count ? workers[list->worker].pieces + list->first : NULL;
        for (size_t i = 0; i < list->count; i++) {
            dp_piece *const to = &store->pieces[pieces[i].open ? --open : closed++];
            *to = pieces[i];
            if (list->worker <= UINT16_MAX)
                to->worker = (uint16_t)list->worker;
            else
                to->bones = 0;
        }
    }
    if (total > closed)
        qsort(store->pieces + closed, total - closed, sizeof *store->pieces, by_edge);
    size_t last = closed;
    for (size_t i = closed; i < total; i++) {
        if (i > closed && continues(&store->pieces[last - 1], &store->pieces[i]))
            store->pieces[last - 1].k1 = store->pieces[i].k1;
        else
            store->pieces[last++] = store->pieces[i];
    }
    /* chains begin and run by the order of their segments, which must not depend on tiles */
    if (dp_is_by_hand(frame) && last) qsort(store->pieces, last, sizeof *store->pieces, by_edge);
    *count = last;
    return true;
}

/* Returns the end in the world. */
static dp_vec3 store_end(const dp_frame *frame, dp_pointd p, float screen[3], float world[3]) {
    const dp_vec3 q = dp_unproject(&frame->view, p);
    screen[0] = (float)p.x, screen[1] = (float)p.y,
    screen[2] = (float)dp_distance(&frame->view, p.d);
    world[0] = (float)q.x, world[1] = (float)q.y, world[2] = (float)q.z;
    return q;
}

/* Depth of the plane through `at` with unit normal `n`, as an affine function of the screen. */
static void screen_plane(const dp_view *view, dp_vec3 at, dp_vec3 n, float plane[3]) {
    const double c = dp_dot(n, at);
    const dp_vec3 o = view->corner, x = view->across, y = view->down;
    /* perspective: rays from the eye, d = n·ray / (c - n·eye); orthographic: o lies at d = 1 and
     * the plane is met after (c - n·o) / n·forward */
    const double under = view->perspective ? c - dp_dot(n, view->eye) : dp_dot(n, view->forward);
    const double over = view->perspective ? dp_dot(n, dp_sub(o, view->eye)) : dp_dot(n, o) - c;
    plane[0] = (float)(over / under) + (view->perspective ? 0 : 1);
    plane[1] = (float)(dp_dot(n, x) / under);
    plane[2] = (float)(dp_dot(n, y) / under);
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
static dp_bones find_bones(const dp_frame *frame, const dp_piece *piece) {
    const dp_polygons *const polygons = &frame->polygons;
    dp_bones out = {0};
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

static void make_segment(const dp_frame *frame, const dp_piece *piece, const dp_bones *found,
                         dp_segment *segment, dp_stroke *stroke) {
    const dp_style *const style = dp_polygon_style(frame, piece->a);
    const dp_line_style *const line = &style->line[piece->line];
    const dp_pointd a = dp_point_mix(found->a, found->b, (double)piece->k0 / piece->n);
    const dp_pointd b = dp_point_mix(found->a, found->b, (double)piece->k1 / piece->n);
    *segment = (dp_segment){.line = (dp_line)piece->line,
                            .polygon = source_number(frame, piece->a),
                            .other = source_number(frame, piece->b),
                            .edge = piece->edge,
                            .width = line->width,
                            .color = line->color};
    const dp_vec3 at = store_end(frame, a, segment->a, segment->world_a);
    (void)store_end(frame, b, segment->b, segment->world_b);
    const dp_vec3 sight = dp_view_vector(&frame->view, at);
    *stroke = (dp_stroke){.a = {(float)a.x, (float)a.y, (float)a.d},
                          .b = {(float)b.x, (float)b.y, (float)b.d},
                          .half_width = line->width / 2,
                          .color = line->color,
                          .line = piece->line};
    const uint32_t polygons[2] = {piece->a, piece->b};
    for (int i = 0; i < 2; i++) {
        stroke->plane[i][0] = NAN;
        if (polygons[i] == UINT32_MAX) continue;
        const bool back = dp_dot(found->normal[i], sight) >= 0;
        if (back && piece->line == DP_LINE_SILHOUETTE)
            continue; /* it leads towards the eye outside */
        screen_plane(&frame->view, at, found->normal[i], stroke->plane[i]);
    }
}

typedef struct job {
    dp_frame *frame;
    const dp_tile_worker *workers;
    const dp_stroke_store *store;
} job;

static void make_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const dp_stroke_store *const store = j->store;
    const size_t first = (size_t)index * BLOCK, count = j->frame->segment_count;
    const size_t end = first + BLOCK < count ? first + BLOCK : count;
    (void)worker;
    for (size_t i = first; i < end; i++) {
        const dp_piece *const p = &store->pieces[i];
        const dp_bones found = p->bones ? j->workers[p->worker].bones[p->bones - 1]
                                        : find_bones(j->frame, p);
        make_segment(j->frame, p, &found, &store->segments[i], &store->strokes[i]);
    }
}

bool dp_make_segments(dp_frame *frame, const dp_tile_worker *workers, dp_stroke_store *store) {
    size_t count;
    if (!join_pieces(frame, workers, store, &count)) return false;
    if (count > UINT32_MAX ||
        !dp_reserve(frame->memory, &store->segments, &store->segments_cap, count,
                    sizeof *store->segments) ||
        !dp_reserve(frame->memory, &store->strokes, &store->strokes_cap, count,
                    sizeof *store->strokes))
        return false;
    frame->segments = store->segments;
    frame->strokes = store->strokes;
    frame->segment_count = count;
    job j = {frame, workers, store};
    dp_parallel(frame->threads, (uint32_t)(count / BLOCK + (count % BLOCK != 0)), make_block, &j);
    return true;
}
