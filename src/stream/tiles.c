/* The tiles of a streamed drawing: the ordinary stages, over what a reading has listed or kept.
 *
 * First reading: each list of triangles is drawn into the depth that stays for the whole picture; pairs
 * that cross are noted. Then the triangles that were kept are a small mesh whose edge flags mark the
 * edges that matter; its lines are found by the same edge table and by emergence, and their sample points
 * stay with the tiles. Second reading: every triangle that touches a pixel with sample points is rasterized
 * onto them, so that what is hidden is exactly what the whole model hides.
 *
 * Invariant: frame->polygons is the list at hand while a list is drawn, and what was kept from
 * dp_stream_find_lines on at all other times. */
#include "stream/draw.h"

#include "pipe/crossing.h"

#include <stdlib.h>
#include <string.h>

static const float MARGIN = 0.75f; /* px, as in draw.c */

/* Transforms and bins frame->polygons. */
static bool place_polygons(dp_stream_draw *s) {
    dp_context *const c = s->context;
    dp_frame *const f = &c->frame;
    if (!dp_reserve(s->memory, &f->vertices, &c->vertices_cap, f->polygons.vertex_count, sizeof *f->vertices)) return false;
    dp_transform_vertices(f);
    return dp_bin_polygons(f, MARGIN, c->bin_workers);
}

static bool place_list(dp_stream_draw *s) {
    s->context->frame.polygons = (dp_polygons){.positions = (const float *)s->corners, .stride = 3 * sizeof(float),
                                               .vertex_count = 3 * s->covering, .count = s->covering};
    return place_polygons(s);
}

static bool workers_are_sound(const dp_stream_draw *s) {
    for (uint32_t i = 0; i < s->context->workers; i++)
        if (s->context->tile_workers[i].failed || s->workers[i].failed) return false;
    return true;
}

static bool for_all_tiles(dp_stream_draw *s, dp_task *task) {
    const dp_frame *const f = &s->context->frame;
    dp_parallel(s->context->threads, f->tiles_x * f->tiles_y, task, s);
    return workers_are_sound(s);
}

/* ------- faces ------- */

static void note_crossings(dp_stream_draw *s, const dp_tile_worker *w, dp_stream_worker *own) {
    for (uint32_t i = 0; i < w->candidate_count; i++) {
        const dp_candidate *const c = &w->candidates[i];
        if (!dp_reserve(s->memory, &own->pairs, &own->pairs_cap, own->pair_count + 1, sizeof *own->pairs)) {
            own->failed = true;
            return;
        }
        dp_crossing_pair *const pair = &own->pairs[own->pair_count++];
        const uint32_t ab[2] = {c->a, c->b};
        for (int k = 0; k < 2; k++) {
            pair->numbers[k] = s->numbers[ab[k]];
            memcpy(pair->corners[k], s->corners[ab[k]], sizeof pair->corners[k]);
        }
    }
}

/* Normals of the pixels that this list has won. */
static void put_normals(const dp_tile_worker *w) {
    const dp_target *const target = &w->frame->target;
    for (uint32_t y = 0; y < DP_TILE && w->tile_y + y < target->height; y++)
        for (uint32_t x = 0; x < DP_TILE && w->tile_x + x < target->width; x++) {
            const uint32_t winner = w->winner[dp_pixel_lane(&w->sampling, x, y)];
            if (winner == UINT32_MAX) continue;
            const dp_tile_polygon *const p = &w->polygons[winner];
            const dp_vec3 n = dp_scale(dp_polygon_normal(w->frame, p->id), p->flags & DP_POLYGON_FRONT ? 1 : -1);
            float *const out = target->normal + 3 * ((size_t)(w->tile_y + y) * target->width + w->tile_x + x);
            out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
        }
}

static void draw_faces(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_frame *const f = &s->context->frame;
    dp_tile_worker *const w = &s->context->tile_workers[worker];
    if (!dp_bins_tile_count(&f->polygon_bins, tile)) return;
    dp_tile_open(w, tile);
    dp_tile_assemble(w);
    dp_tile_faces(w);
    memcpy(s->farthest + (size_t)tile * DP_BLOCKS * DP_BLOCKS, w->farthest[0][0], sizeof w->farthest[0][0]);
    if (f->target.normal) put_normals(w);
    if (!(f->lines & DP_INTERSECTION)) return;
    dp_tile_intersections(w);
    note_crossings(s, w, &s->workers[worker]);
}

bool dp_stream_draw_faces(dp_stream_draw *s) {
    if (!s->covering) return true;
    const bool sound = place_list(s) && for_all_tiles(s, draw_faces);
    s->covering = 0;
    return sound;
}

/* ------- what was kept, as a mesh ------- */

static int by_numbers(const void *left, const void *right) {
    const dp_crossing_pair *const l = left, *const r = right;
    for (int k = 0; k < 2; k++)
        if (l->numbers[k] != r->numbers[k]) return l->numbers[k] < r->numbers[k] ? -1 : 1;
    return 0;
}

/* All workers' pairs in order, each once: neighbouring tiles find the same. */
static bool gather_pairs(dp_stream_draw *s) {
    size_t count = 0;
    for (uint32_t i = 0; i < s->context->workers; i++) count += s->workers[i].pair_count;
    if (!count) return true;
    s->pairs = dp_alloc_array(s->memory, count, sizeof *s->pairs);
    if (!s->pairs) return false;
    count = 0;
    for (uint32_t i = 0; i < s->context->workers; i++) {
        const dp_stream_worker *const w = &s->workers[i];
        if (w->pair_count) memcpy(s->pairs + count, w->pairs, w->pair_count * sizeof *w->pairs);
        count += w->pair_count;
    }
    qsort(s->pairs, count, sizeof *s->pairs, by_numbers);
    for (size_t i = 0; i < count; i++)
        if (!i || by_numbers(&s->pairs[s->pair_count - 1], &s->pairs[i])) s->pairs[s->pair_count++] = s->pairs[i];
    return true;
}

static void put_polygon(dp_stream_draw *s, size_t at, const float corners[9], uint32_t number, uint32_t polygon) {
    memcpy(s->positions + 9 * at, corners, 9 * sizeof(float));
    s->polygon_numbers[at] = number;
    s->source_polygons[at] = polygon;
}

static bool make_mesh(dp_stream_draw *s) {
    const size_t kept = s->kept.earlier_count, count = kept + 2 * (size_t)s->pair_count;
    dp_frame *const f = &s->context->frame;
    if (count >= UINT32_MAX / 4) return false;
    s->positions = dp_alloc_array(s->memory, count, 9 * sizeof *s->positions);
    s->edge_flags = dp_alloc_zeroed(s->memory, 3 * count);
    s->polygon_numbers = dp_alloc_array(s->memory, count, sizeof *s->polygon_numbers);
    s->source_polygons = dp_alloc_array(s->memory, count, sizeof *s->source_polygons);
    if (!s->positions || !s->edge_flags || !s->polygon_numbers || !s->source_polygons) return false;
    for (size_t i = 0; i < kept; i++) {
        const dp_kept_triangle *const t = &s->kept.earlier[i];
        put_polygon(s, i, t->corners, t->number, t->polygon);
        for (int e = 0; e < 3; e++) s->edge_flags[3 * i + (size_t)e] = t->edges[e] != DP_EDGE_PLAIN;
    }
    s->first_crossing = (uint32_t)kept;
    for (uint32_t i = 0; i < s->pair_count; i++)
        for (uint32_t k = 0; k < 2; k++)
            put_polygon(s, kept + 2 * (size_t)i + k, s->pairs[i].corners[k], s->pairs[i].numbers[k], s->pairs[i].numbers[k]);
    dp_free(s->memory, s->pairs);
    s->pairs = NULL;
    dp_kept_free(&s->kept);
    f->polygons = (dp_polygons){.positions = s->positions, .stride = 3 * sizeof(float), .vertex_count = (uint32_t)(3 * count),
                                .edge_flags = s->edge_flags, .source_polygon = s->source_polygons, .count = (uint32_t)count};
    return true;
}

/* ------- surface ------- */

/* Which samples hold any surface is all that one colour needs to know. */
static void paint_surface(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_tile_worker *const w = &s->context->tile_workers[worker];
    s->context->frame.tile_pieces[tile] = (dp_tile_pieces){.worker = worker};
    dp_tile_open(w, tile);
    for (size_t i = 0; i < w->frame->tile_samples; i++) w->winner[i] = w->depth[i] == DP_DEPTH_EMPTY ? UINT32_MAX : 0;
    dp_tile_surface(w);
}

/* ------- lines ------- */

static void add_crossing(dp_tile_worker *w, uint32_t a, uint32_t b) {
    dp_vec3 from, to, normal;
    dp_spine spine;
    if (!dp_crossing_find(w->frame, a, b, &from, &to, &normal)) return;
    if (!dp_spine_make(&w->frame->view, from, to, normal, &spine)) return;
    dp_tile_add_candidate(w, (dp_candidate){.a = a, .b = b, .edge = DP_CROSSING, .k1 = UINT32_MAX, .line = DP_LINE_INTERSECTION}, &spine);
}

static void add_crossings(const dp_stream_draw *s, dp_tile_worker *w) {
    for (uint32_t i = 0; i < w->polygon_count && !w->failed; i++) {
        const uint32_t id = w->polygons[i].id;
        if (id >= s->first_crossing && (id - s->first_crossing) % 2 == 0) add_crossing(w, id, id + 1);
    }
}

/* The pixels that hold sample points still visible. */
static void want_pixels(const dp_tile_lines *lines, uint64_t rows[DP_TILE]) {
    memset(rows, 0, DP_TILE * sizeof *rows);
    for (uint32_t i = 0; i < lines->probe_count; i++) {
        const dp_probe *const p = &lines->probes[i];
        if (p->hidden) continue;
        const uint32_t x = p->x <= 0 ? 0 : p->x >= DP_TILE ? DP_TILE - 1 : (uint32_t)p->x;
        const uint32_t y = p->y <= 0 ? 0 : p->y >= DP_TILE ? DP_TILE - 1 : (uint32_t)p->y;
        rows[y] |= (uint64_t)1 << x;
    }
}

static bool store_lines(const dp_stream_draw *s, const dp_tile_worker *w, dp_tile_lines *out) {
    const size_t head = w->candidate_count * sizeof *w->candidates, tail = w->probe_count * sizeof *w->probes;
    if (!w->candidate_count) return true;
    uint8_t *const block = dp_alloc(s->memory, head + tail);
    if (!block) return false;
    memcpy(block, w->candidates, head);
    memcpy(block + head, w->probes, tail);
    *out = (dp_tile_lines){(dp_candidate *)(void *)block, (dp_probe *)(void *)(block + head), w->candidate_count, w->probe_count};
    return true;
}

static void find_lines(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_tile_worker *const w = &s->context->tile_workers[worker];
    dp_tile_lines *const lines = &s->lines[tile];
    if (!dp_bins_tile_count(&s->context->frame.polygon_bins, tile)) return;
    dp_tile_open(w, tile);
    dp_tile_assemble(w);
    dp_tile_faces(w);
    dp_tile_edges(w);
    dp_tile_emerge(w);
    add_crossings(s, w);
    if (!s->read_again) dp_stream_hide_by_samples(w);
    if (!store_lines(s, w, lines)) w->failed = true;
    want_pixels(lines, s->wanted + (size_t)tile * DP_TILE);
}

bool dp_stream_find_lines(dp_stream_draw *s, bool read_again) {
    dp_frame *const f = &s->context->frame;
    float *const normal = f->target.normal; /* written list by list */
    s->read_again = read_again;
    f->target.normal = NULL;
    const bool painted = for_all_tiles(s, paint_surface);
    f->target.normal = normal;
    if (!painted || !f->lines) return painted;
    return gather_pairs(s) && make_mesh(s) && place_polygons(s) && for_all_tiles(s, find_lines);
}

/* ------- second reading ------- */

/* Where a triangle of the stream stands in the list at hand; UINT32_MAX - 1: nowhere. */
static uint32_t place_in_list(const dp_stream_draw *s, uint32_t number) {
    uint32_t lo = 0, hi = s->covering;
    while (hi - lo > 1) {
        const uint32_t mid = lo + (hi - lo) / 2;
        if (s->numbers[mid] <= number) lo = mid;
        else hi = mid;
    }
    return hi && s->numbers[lo] == number ? lo : UINT32_MAX - 1;
}

/* Sample points know their own polygons by the numbers of the list at hand. */
static void renumber_probes(const dp_stream_draw *s, dp_tile_worker *w) {
    for (uint32_t i = 0; i < w->candidate_count; i++) {
        const dp_candidate *const c = &w->candidates[i];
        const uint32_t a = place_in_list(s, s->polygon_numbers[c->a]);
        const uint32_t b = c->b == UINT32_MAX ? UINT32_MAX - 1 : place_in_list(s, s->polygon_numbers[c->b]);
        for (uint32_t k = 0; k < c->k1 - c->k0; k++) {
            dp_probe *const p = &w->probes[c->probe + k];
            p->own_a = a, p->own_b = b;
        }
    }
}

/* Lends a tile's lines to the worker, and takes its own back. */
static void swap_lines(dp_tile_worker *w, dp_tile_lines *lines) {
    const dp_tile_lines own = {w->candidates, w->probes, w->candidate_count, w->probe_count};
    w->candidates = lines->candidates, w->probes = lines->probes;
    w->candidate_count = lines->candidate_count, w->probe_count = lines->probe_count;
    *lines = own;
}

static void hide_probes(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_tile_worker *const w = &s->context->tile_workers[worker];
    dp_tile_lines *const lines = &s->lines[tile];
    if (!lines->candidate_count || !dp_bins_tile_count(&s->context->frame.polygon_bins, tile)) return;
    dp_tile_open(w, tile);
    swap_lines(w, lines);
    renumber_probes(s, w);
    dp_tile_assemble(w);
    dp_tile_faces(w);
    dp_tile_hide(w);
    swap_lines(w, lines);
    want_pixels(lines, s->wanted + (size_t)tile * DP_TILE);
}

bool dp_stream_hide_probes(dp_stream_draw *s) {
    if (!s->covering) return true;
    const dp_polygons kept = s->context->frame.polygons;
    const bool sound = place_list(s) && for_all_tiles(s, hide_probes);
    s->context->frame.polygons = kept;
    s->covering = 0;
    return sound;
}

static void collect_tile(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_tile_worker *const w = &s->context->tile_workers[worker];
    dp_tile_pieces *const out = &s->context->frame.tile_pieces[tile];
    *out = (dp_tile_pieces){.worker = worker, .first = w->piece_count};
    if (!s->lines[tile].candidate_count) return;
    swap_lines(w, &s->lines[tile]);
    dp_tile_collect(w);
    swap_lines(w, &s->lines[tile]);
    out->count = w->piece_count - out->first;
}

bool dp_stream_collect(dp_stream_draw *s) { return for_all_tiles(s, collect_tile); }
