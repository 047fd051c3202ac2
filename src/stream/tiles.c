/* The tiles of a streamed drawing: the ordinary stages, over lists and pending triangles.
 *
 *     first reading    draw_faces   each list of triangles is drawn into frame->depth
 *     in between       find_lines   the pending triangles are a small mesh, whose edge flags mark
 *                                     the edges that may be lines. The edge table and emergence
 *                                     find its lines, whose sample points stay with the tiles
 *     second reading   hide_probes  every triangle that touches a pixel with sample points is
 *                                     rasterized onto them: exactly what the whole model hides
 *
 * Invariant: frame->polygons is the list while a list is drawn; at all other times, from
 * dp_stream_find_lines on, it is the mesh of pending triangles. */
#include "stream/draw.h"

#include "core/precision.h"

#include <string.h>

static const float MARGIN = 0.75f; /* px, as in draw/draw.c */

/* Pixel sizes: by less, depths are equal. */
static const float AGAIN = 0.01f;

/* Transforms and bins frame->polygons. */
bool dp_stream_place_polygons(dp_stream_draw *s) {
    dp_frame *const f = s->frame;
    if (!dp_reserve(s->memory, &f->vertices, &f->vertices_cap, f->polygons.vertex_count,
                    sizeof *f->vertices))
        return false;
    dp_transform_vertices(f);
    return dp_bin_polygons(f, MARGIN, s->bin_workers);
}

static bool place_list(dp_stream_draw *s) {
    s->frame->polygons = (dp_polygons){.positions = (const float *)s->corners,
                                       .stride = 3 * sizeof(float),
                                       .vertex_count = 3 * s->covering,
                                       .count = s->covering};
    return dp_stream_place_polygons(s);
}

static bool workers_are_sound(const dp_stream_draw *s) {
    for (uint32_t i = 0; i < s->worker_count; i++)
        if (s->finders[i].tile.failed || s->workers[i].failed) return false;
    return true;
}

bool dp_stream_for_tiles(dp_stream_draw *s, dp_task *task) {
    const dp_frame *const f = s->frame;
    dp_parallel(s->frame->threads, f->tiles_x * f->tiles_y, task, s);
    return workers_are_sound(s);
}

/* ------- faces ------- */

/* Writes the normals of the pixels that this list has won. */
static void put_normals(const dp_finder *w) {
    const dp_target *const target = &w->tile.frame->target;
    for (uint32_t y = 0; y < DP_TILE && w->tile.tile_y + y < target->height; y++)
        for (uint32_t x = 0; x < DP_TILE && w->tile.tile_x + x < target->width; x++) {
            const uint32_t winner = w->tile.winner[dp_pixel_lane(&w->tile.sampling, x, y)];
            if (winner == UINT32_MAX) continue;
            const dp_tile_polygon *const p = &w->tile.polygons[winner];
            const dp_vec3 n = dp_scale(dp_polygon_normal(w->tile.frame, p->id),
                                       p->flags & DP_POLYGON_FRONT ? 1 : -1);
            float *const out = target->normal + 3 * ((size_t)(w->tile.tile_y + y) * target->width +
                                                     w->tile.tile_x + x);
            out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
        }
}

static void draw_faces(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_frame *const f = s->frame;
    dp_finder *const w = &s->finders[worker];
    if (!dp_bins_tile_count(&f->polygon_bins, tile)) return;
    w->tile.finds_edges = false;
    dp_finder_open(w, tile);
    if (w->tile.tests_near_depth) w->tile.away = s->away + (size_t)tile * f->tile_samples / 64;
    dp_tile_assemble(&w->tile);
    dp_tile_faces(&w->tile);
    w->tile.away = NULL;
    for (size_t y = 0; y < DP_BLOCKS; y++)
        memcpy(s->farthest + ((size_t)tile * DP_BLOCKS + y) * DP_BLOCKS,
               &w->tile.farthest[0][0][y + 1][1], DP_BLOCKS * sizeof *s->farthest);
    if (f->target.normal) put_normals(w);
    if (w->tile.tests_near_depth) dp_stream_note_candidate_pixels(s, w, &s->workers[worker]);
}

bool dp_stream_draw_faces(dp_stream_draw *s) {
    if (!s->covering) return true;
    const bool sound = place_list(s) && dp_stream_for_tiles(s, draw_faces);
    s->covering = 0;
    return sound;
}

/* ------- the pending triangles as a mesh ------- */

bool dp_stream_add_polygons(dp_stream_draw *s, const dp_pending_triangle *triangles, size_t count) {
    const size_t first = s->mesh_count, all = first + count;
    dp_polygons *const polygons = &s->frame->polygons;
    if (all >= UINT32_MAX / 4 ||
        !dp_reserve(s->memory, &s->positions, &s->positions_cap, dp_times(9, all),
                    sizeof *s->positions) ||
        !dp_reserve(s->memory, &s->edge_flags, &s->flags_cap, dp_times(3, all), 1) ||
        !dp_reserve(s->memory, &s->polygon_numbers, &s->polygon_numbers_cap, all,
                    sizeof *s->polygon_numbers) ||
        !dp_reserve(s->memory, &s->source_polygons, &s->source_cap, all,
                    sizeof *s->source_polygons))
        return false;
    for (size_t i = 0; i < count; i++) {
        const dp_pending_triangle *const t = &triangles[i];
        memcpy(s->positions + 9 * (first + i), t->corners, sizeof t->corners);
        for (int e = 0; e < 3; e++) s->edge_flags[3 * (first + i) + (size_t)e] = t->edges[e];
        s->polygon_numbers[first + i] = t->number;
        s->source_polygons[first + i] = t->polygon;
    }
    s->mesh_count = (uint32_t)all;
    *polygons = (dp_polygons){.positions = s->positions,
                              .stride = 3 * sizeof(float),
                              .vertex_count = (uint32_t)(3 * all),
                              .edge_flags = s->edge_flags,
                              .source_polygon = s->source_polygons,
                              .count = (uint32_t)all};
    return true;
}

static bool make_mesh(dp_stream_draw *s) {
    const bool sound = dp_stream_add_polygons(s, s->pending.earlier, s->pending.earlier_count);
    dp_pending_free(&s->pending);
    return sound;
}

/* ------- surface ------- */

/* One colour needs to know only which samples hold a surface, not which. */
static void paint_surface(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_finder *const w = &s->finders[worker];
    s->frame->tile_pieces[tile] = (dp_tile_pieces){.worker = worker};
    dp_finder_open(w, tile);
    for (size_t i = 0; i < w->tile.frame->tile_samples; i++)
        w->tile.winner[i] = w->tile.depth[i] == DP_DEPTH_EMPTY ? UINT32_MAX : 0;
    dp_tile_surface(&w->tile);
}

/* ------- lines ------- */

/* The pixels that hold visible sample points. */
static void want_pixels(const dp_tile_lines *lines, uint64_t rows[DP_TILE]) {
    memset(rows, 0, DP_TILE * sizeof *rows);
    for (uint32_t i = 0; i < lines->probe_count; i++) {
        const float px = lines->probes.x[i], py = lines->probes.y[i];
        if (lines->probes.limit[i] == INFINITY) continue;
        const uint32_t x = px <= 0 ? 0 : px >= DP_TILE ? DP_TILE - 1 : (uint32_t)px;
        const uint32_t y = py <= 0 ? 0 : py >= DP_TILE ? DP_TILE - 1 : (uint32_t)py;
        rows[y] |= (uint64_t)1 << x;
    }
}

bool dp_tile_lines_make(dp_tile_lines *out, uint32_t candidates, uint32_t probes,
                        const dp_allocator *memory) {
    const size_t head = candidates * sizeof *out->candidates,
                 member = probes * sizeof *out->probes.x,
                 size = head + 3 * member + DP_PROBES_ROOM * sizeof *out->probes.x;
    uint8_t *const block = dp_alloc(memory, size);
    if (!block) return false;
    float *const x = (float *)(void *)(block + head);
    memset(x + 3 * (size_t)probes, 0, DP_PROBES_ROOM * sizeof *x);
    *out = (dp_tile_lines){.candidates = (dp_candidate *)(void *)block,
                           .probes = {x, x + probes, x + 2 * (size_t)probes},
                           .candidate_count = candidates,
                           .probe_count = probes,
                           .size = size};
    return true;
}

void dp_tile_lines_free(dp_tile_lines *lines, const dp_allocator *memory) {
    dp_free(memory, lines->candidates);
    *lines = (dp_tile_lines){0};
}

void dp_tile_lines_put(const dp_tile_lines *from, dp_tile_lines *to, uint32_t candidate,
                       uint32_t probe) {
    const size_t bytes = from->probe_count * sizeof *from->probes.x;
    if (!from->candidate_count) return;
    memcpy(to->candidates + candidate, from->candidates,
           from->candidate_count * sizeof *from->candidates);
    for (uint32_t i = 0; i < from->candidate_count; i++) {
        to->candidates[candidate + i].probe += probe;
        to->candidates[candidate + i].geometry = 0; /* geometry stays with the worker */
    }
    if (!bytes) return;
    memcpy(to->probes.x + probe, from->probes.x, bytes);
    memcpy(to->probes.y + probe, from->probes.y, bytes);
    memcpy(to->probes.limit + probe, from->probes.limit, bytes);
}

static dp_tile_lines lines_of(const dp_finder *w) {
    return (dp_tile_lines){.candidates = w->lines.candidates,
                           .probes = w->lines.probes,
                           .candidate_count = w->lines.candidate_count,
                           .probe_count = w->lines.probe_count};
}

static bool store_lines(const dp_stream_draw *s, dp_finder *w, dp_tile_lines *out) {
    const dp_tile_lines own = lines_of(w);
    w->found->geometry_count = 0;
    if (!own.candidate_count) return true;
    if (!dp_tile_lines_make(out, own.candidate_count, own.probe_count, s->memory)) return false;
    dp_tile_lines_put(&own, out, 0, 0);
    return true;
}

/* Which unpaired edges do not emerge, because their other triangle may be missing:
 *     edges known to be lines    when lines were thinned (otherwise the other triangle is hidden)
 *     edges that are alone       when waiting edges were given up */
static void drop_halves(const dp_stream_draw *s, dp_finder *w) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < w->emergence.unpaired_count; i++) {
        const dp_unpaired_edge l = w->emergence.unpaired[i];
        const bool alone =
            s->edge_flags[3 * (size_t)w->tile.polygons[l.polygon].id + l.edge] == DP_EDGE_ALONE;
        if (!(alone ? s->waited_in_vain : s->thinned)) w->emergence.unpaired[left++] = l;
    }
    w->emergence.unpaired_count = left;
}

bool dp_stream_draw_apart(const dp_stream_draw *s, dp_finder *w, dp_stream_worker *own) {
    if (!dp_reserve(s->memory, &own->depth, &own->depth_cap, w->tile.frame->tile_samples,
                    sizeof *own->depth))
        return !(own->failed = true);
    w->tile.depth = own->depth;
    return true;
}

/* Lets the tile draw into a copy of its depth, a little further away: the kept triangles that are
 * seen win their samples again, and so are known. (With one reading samples beside the tile are
 * read, too, which other workers may be redrawing.) */
static bool draw_again_apart(const dp_stream_draw *s, dp_finder *w, dp_stream_worker *own) {
    const float *const drawn = w->tile.depth;
    if (!dp_stream_draw_apart(s, w, own)) return false;
    for (size_t i = 0; i < w->tile.frame->tile_samples; i++)
        w->tile.depth[i] = drawn[i] > DP_DEPTH_EMPTY
                               ? drawn[i] - fabsf(dp_depth_steps(w->tile.frame, drawn[i], AGAIN))
                               : drawn[i];
    return true;
}

static void find_lines(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_finder *const w = &s->finders[worker];
    dp_tile_lines *const lines = &s->lines[tile];
    if (!dp_bins_tile_count(&s->frame->polygon_bins, tile)) return;
    w->tile.finds_edges = true;
    dp_finder_open(w, tile);
    if (!draw_again_apart(s, w, &s->workers[worker])) return;
    dp_tile_assemble(&w->tile);
    dp_tile_faces(&w->tile);
    dp_find_edges(w);
    drop_halves(s, w);
    dp_find_emergent(w);
    if (!s->read_again) dp_stream_hide_by_samples(w);
    if (!store_lines(s, w, lines)) w->tile.failed = true;
    want_pixels(lines, s->wanted + (size_t)tile * DP_TILE);
}

bool dp_stream_find_lines(dp_stream_draw *s) {
    dp_frame *const f = s->frame;
    float *const normal = f->target.normal; /* written list by list */
    f->target.normal = NULL;
    const bool painted = dp_stream_for_tiles(s, paint_surface);
    f->target.normal = normal;
    if (!painted || !f->lines) return painted;
    if (!make_mesh(s)) return false;
    dp_find_tolerances(f);
    return dp_stream_place_polygons(s) && dp_stream_for_tiles(s, find_lines) &&
           (!s->read_again || dp_stream_make_fans(s));
}

/* ------- second reading ------- */

/* Index of the stream's triangle in the list; UINT32_MAX - 1: it is not there. */
static uint32_t place_in_list(const dp_stream_draw *s, uint32_t number) {
    uint32_t lo = 0, hi = s->covering;
    while (hi - lo > 1) {
        const uint32_t mid = lo + (hi - lo) / 2;
        if (s->numbers[mid] <= number)
            lo = mid;
        else
            hi = mid;
    }
    return hi && s->numbers[lo] == number ? lo : UINT32_MAX - 1;
}

/* Finds the candidates' own polygons in the list. */
static bool find_owners(const dp_stream_draw *s, dp_finder *w, dp_stream_worker *own) {
    if (!dp_reserve(s->memory, &own->owners, &own->owners_cap, w->lines.candidate_count,
                    sizeof *own->owners))
        return false;
    for (uint32_t i = 0; i < w->lines.candidate_count; i++) {
        const dp_candidate *const c = &w->lines.candidates[i];
        own->owners[i][0] = place_in_list(s, s->polygon_numbers[c->a]);
        own->owners[i][1] =
            c->b == UINT32_MAX ? UINT32_MAX - 1 : place_in_list(s, s->polygon_numbers[c->b]);
    }
    w->lines.owners = (const uint32_t(*)[2])own->owners;
    return true;
}

/* Lends a tile's lines to the worker, and takes its own back. */
static void swap_lines(dp_finder *w, dp_tile_lines *lines) {
    const dp_tile_lines own = lines_of(w);
    w->lines.candidates = lines->candidates, w->lines.probes = lines->probes;
    w->lines.candidate_count = lines->candidate_count, w->lines.probe_count = lines->probe_count;
    lines->candidates = own.candidates, lines->probes = own.probes;
    lines->candidate_count = own.candidate_count, lines->probe_count = own.probe_count;
}

static void hide_probes(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_finder *const w = &s->finders[worker];
    dp_stream_worker *const own = &s->workers[worker];
    dp_tile_lines *const lines = &s->lines[tile];
    if (!lines->candidate_count || !dp_bins_tile_count(&s->frame->polygon_bins, tile)) return;
    const bool tests_near_depth = w->tile.tests_near_depth;
    w->tile.finds_edges = false;
    dp_finder_open(w, tile);
    swap_lines(w, lines);
    w->tile.tests_near_depth = false; /* depth is final: drawing the faces again changes nothing */
    dp_tile_assemble(&w->tile);
    dp_tile_faces(&w->tile);
    w->tile.tests_near_depth = tests_near_depth;
    if (find_owners(s, w, own))
        dp_hide_points(w);
    else
        w->tile.failed = true;
    w->lines.owners = NULL;
    swap_lines(w, lines);
    want_pixels(lines, s->wanted + (size_t)tile * DP_TILE);
}

bool dp_stream_hide_probes(dp_stream_draw *s) {
    if (!s->covering) return true;
    const dp_polygons mesh = s->frame->polygons;
    const bool sound = place_list(s) && dp_stream_for_tiles(s, hide_probes);
    s->frame->polygons = mesh;
    s->covering = 0;
    return sound;
}

static void collect_tile(void *arg, uint32_t tile, uint32_t worker) {
    dp_stream_draw *const s = arg;
    dp_finder *const w = &s->finders[worker];
    dp_tile_pieces *const out = &s->frame->tile_pieces[tile];
    *out = (dp_tile_pieces){.worker = worker, .first = w->found->piece_count};
    if (!s->lines[tile].candidate_count) return;
    dp_stream_settle_fans(s, &s->lines[tile]);
    swap_lines(w, &s->lines[tile]);
    dp_tile_place(&w->tile, tile);
    w->lines.streamed = true;
    dp_collect_pieces(w);
    swap_lines(w, &s->lines[tile]);
    out->count = w->found->piece_count - out->first;
}

bool dp_stream_collect(dp_stream_draw *s) { return dp_stream_for_tiles(s, collect_tile); }
