/* Intersections of a streamed model (Raskar 2001, 2.4; find/intersect.c).
 *
 *     first reading     each list, each tile: note candidate pixels, and samples with back faces
 *     between           flagged = candidate pixels that are not alone, and their neighbours;
 *                         those of a front and a back face: only where back faces are seen
 *     second reading    each triangle that touches a flagged pixel and is not hidden joins the
 *                         intersection candidates
 *     at the end        each tile: draw the candidates alone into empty samples, find candidate
 *                         pixels, pairs and crossings as among all triangles
 *
 * A drawing of the candidates alone is enough: in flagged pixels they are all that can be seen, so
 * they hide what is hidden; elsewhere along a crossing the picture's samples do.
 *
 * One reading: the intersection candidates are the pairs found within each list. */
#include "stream/draw.h"

#include "base/sort.h"

#include <string.h>

/* ------- first reading ------- */

/* Notes which samples show a back face; samples that the list did not win stay as they were. */
static void note_facing(const dp_finder *w, uint64_t *away) {
    for (size_t word = 0; word < w->tile.frame->tile_samples / 64; word++) {
        const uint32_t *const winner = w->tile.winner + 64 * word;
        uint64_t won = 0, back = 0;
        for (uint32_t i = 0; i < 64; i++) {
            if (winner[i] == UINT32_MAX) continue;
            won |= (uint64_t)1 << i;
            back |= (uint64_t) !(w->tile.polygons[winner[i]].flags & DP_POLYGON_FRONT) << i;
        }
        away[word] = (away[word] & ~won) | back;
    }
}

/* One reading: notes the triangles of a list that cross others. */
static void note_pairs(const dp_stream_draw *s, const dp_finder *w, dp_stream_worker *own) {
    for (uint32_t i = 0; i < w->lines.candidate_count; i++) {
        const uint32_t ids[2] = {w->lines.candidates[i].a, w->lines.candidates[i].b};
        if (own->intersecting_count + 2 > s->intersecting_limit) return;
        if (!dp_reserve(s->memory, &own->intersecting, &own->intersecting_cap,
                        own->intersecting_count + 2, sizeof *own->intersecting)) {
            own->failed = true;
            return;
        }
        for (int k = 0; k < 2; k++) {
            dp_pending_triangle *const t = &own->intersecting[own->intersecting_count++];
            *t = (dp_pending_triangle){.number = s->numbers[ids[k]], .polygon = s->numbers[ids[k]]};
            memcpy(t->corners, s->corners[ids[k]], sizeof t->corners);
        }
    }
}

void dp_stream_note_candidate_pixels(dp_stream_draw *s, dp_finder *w, dp_stream_worker *own) {
    uint64_t(*const candidate_pixels)[DP_TILE] = s->candidate_pixels[w->tile.index];
    for (int k = 0; k < 2; k++)
        for (uint32_t y = 0; y < DP_TILE; y++)
            candidate_pixels[k][y] |= w->tile.candidate_pixels[k][y];
    note_facing(w, s->away + (size_t)w->tile.index * w->tile.frame->tile_samples / 64);
    if (s->read_again) return;
    dp_find_intersections(w);
    note_pairs(s, w, own);
}

/* ------- between the readings ------- */

/* Pixels whose samples all show back faces; single samples do on the outlines of fine meshes. */
static void find_away(const dp_stream_draw *s, uint32_t tile, uint64_t rows[DP_TILE]) {
    const dp_frame *const f = s->frame;
    const uint64_t *const away = s->away + (size_t)tile * f->tile_samples / 64;
    memset(rows, 0xff, DP_TILE * sizeof *rows);
    for (size_t i = 0; i < f->tile_samples; i++) {
        const size_t pixel = i / f->target.samples;
        if (!(away[i / 64] >> i % 64 & 1))
            rows[pixel / DP_TILE] &= ~((uint64_t)1 << pixel % DP_TILE);
    }
    dp_drop_lone(rows);
}

static void choose_flagged(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    uint64_t(*const candidate_pixels)[DP_TILE] = s->candidate_pixels[tile];
    uint64_t away[DP_TILE], near[DP_TILE];
    (void)worker;
    find_away(s, tile, away);
    dp_widen(away, near);
    for (uint32_t y = 0; y < DP_TILE; y++)
        candidate_pixels[0][y] |= candidate_pixels[1][y] & near[y];
    dp_drop_lone(candidate_pixels[0]);
    dp_widen(candidate_pixels[0], s->flagged + (size_t)tile * DP_TILE);
}

static int by_number(const void *left, const void *right) {
    const dp_pending_triangle *const l = left, *const r = right;
    return (l->number > r->number) - (l->number < r->number);
}

/* Merges all workers' triangles, in order, each once. */
static bool gather_pairs(dp_stream_draw *s) {
    size_t count = 0;
    for (uint32_t i = 0; i < s->worker_count; i++) count += s->workers[i].intersecting_count;
    if (!count) return true;
    if (!dp_reserve(s->memory, &s->intersecting, &s->intersecting_cap, count,
                    sizeof *s->intersecting))
        return false;
    count = 0;
    for (uint32_t i = 0; i < s->worker_count; i++) {
        const dp_stream_worker *const w = &s->workers[i];
        if (w->intersecting_count)
            memcpy(s->intersecting + count, w->intersecting,
                   w->intersecting_count * sizeof *w->intersecting);
        count += w->intersecting_count;
    }
    dp_sort(s->intersecting, count, sizeof *s->intersecting, by_number);
    for (size_t i = 0; i < count; i++)
        if (!i || s->intersecting[s->intersecting_count - 1].number != s->intersecting[i].number)
            s->intersecting[s->intersecting_count++] = s->intersecting[i];
    return true;
}

bool dp_stream_choose_flagged(dp_stream_draw *s) {
    if (!(s->frame->lines & DP_INTERSECTION)) return true;
    return dp_stream_for_tiles(s, choose_flagged) && (s->read_again || gather_pairs(s));
}

/* ------- at the end ------- */

/* Adds a tile's crossings to its lines; their polygons are counted from `first`. */
static bool add_lines(const dp_stream_draw *s, const dp_finder *w, uint32_t first,
                      dp_tile_lines *lines) {
    const dp_tile_lines own = {.candidates = w->lines.candidates,
                               .probes = w->lines.probes,
                               .candidate_count = w->lines.candidate_count,
                               .probe_count = w->lines.probe_count};
    const uint32_t candidates = lines->candidate_count + own.candidate_count;
    dp_tile_lines all;
    if (!dp_tile_lines_make(&all, candidates, lines->probe_count + own.probe_count, s->memory))
        return false;
    dp_tile_lines_put(lines, &all, 0, 0);
    dp_tile_lines_put(&own, &all, lines->candidate_count, lines->probe_count);
    for (uint32_t i = lines->candidate_count; i < candidates; i++)
        all.candidates[i].a += first, all.candidates[i].b += first;
    dp_tile_lines_free(lines, s->memory);
    *lines = all;
    return true;
}

static void find_crossings(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_finder *const w = &s->finders[worker];
    dp_stream_worker *const own = &s->workers[worker];
    const uint64_t *const flagged = s->flagged + (size_t)tile * DP_TILE;
    if (!dp_bins_tile_count(&w->tile.frame->polygon_bins, tile)) return;
    w->tile.finds_edges = false;
    dp_finder_open(w, tile);
    if (!dp_stream_draw_apart(s, w, own)) return;
    for (size_t i = 0; i < w->tile.frame->tile_samples; i++) w->tile.depth[i] = DP_DEPTH_EMPTY;
    dp_tile_assemble(&w->tile);
    dp_tile_faces(&w->tile);
    for (uint32_t y = 0; y < DP_TILE; y++)
        w->tile.candidate_pixels[0][y] &= flagged[y], w->tile.candidate_pixels[1][y] &= flagged[y];
    dp_find_intersections(w);
    if (!w->lines.candidate_count) return;
    dp_stream_hide_by_samples(w);
    if (!add_lines(s, w, (uint32_t)(s->mesh_count - s->intersecting_count), &s->lines[tile]))
        own->failed = true;
}

bool dp_stream_find_crossings(dp_stream_draw *s) {
    dp_frame *const f = s->frame;
    const uint32_t first = s->mesh_count;
    if (!s->intersecting_count) return true;
    if (!dp_stream_add_polygons(s, s->intersecting, s->intersecting_count)) return false;
    const dp_polygons all = f->polygons;
    f->polygons = (dp_polygons){.positions = s->positions + 9 * (size_t)first,
                                .stride = 3 * sizeof(float),
                                .vertex_count = (uint32_t)(3 * s->intersecting_count),
                                .count = (uint32_t)s->intersecting_count};
    const bool sound = dp_stream_place_polygons(s) && dp_stream_for_tiles(s, find_crossings);
    f->polygons = all;
    return sound;
}
