/* Reads a source into one set of convex polygons.
 *
 * One stable batch of sound polygons is used in place: nothing is copied. Everything else is
 * appended to a store that the context keeps from frame to frame, positions about the first batch's
 * origin. Diagonals of split polygons are
 * flagged as such. Invariant: a flag is one of dp_edge_kind's. */
#include "mesh/polygons.h"

#include "base/diag.h"
#include "base/hostile.h"
#include "mesh/batch.h"

#include <math.h>
#include <string.h>

typedef struct gatherer {
    dp_polygon_store *store;
    const dp_allocator *memory;
    dp_stats *stats;
    dp_diag *diag;
    bool has_firsts, has_flags, has_groups, has_source, has_colors;
    uint64_t handed_out; /* polygons of earlier batches */
    size_t only;         /* polygons of a source of one batch; 0: not known */
    double origin[3];    /* of the first batch; positions of others are moved to it */
} gatherer;

/* Polygons between two reports. */
enum { STEP = DP_TUNED(1 << 16, 64) };

/* A source of one batch is checked first, and stored where that finds something. How long others
 * are is not known: reports come ever closer to the end. */
static const double CHECKED = 0.2, MANY = 1 << 20;

static dp_result tell(gatherer *g, double done) {
    return g->store->tell ? g->store->tell(g->store->tell_arg, done, g->diag) : DP_OK;
}

static dp_result tell_checked(gatherer *g, size_t i) {
    return i && i % STEP == 0 ? tell(g, CHECKED * (double)i / (double)g->only) : DP_OK;
}

static dp_result tell_stored(gatherer *g, size_t i) {
    const double sum = (double)g->handed_out + (double)i;
    if (!sum || fmod(sum, STEP) != 0) return DP_OK;
    return tell(g, g->only ? CHECKED + (1 - CHECKED) * sum / (double)g->only : sum / (sum + MANY));
}

static const dp_array arrays[] = {DP_ARRAY(dp_polygon_store, positions, positions_cap),
                                  DP_ARRAY(dp_polygon_store, corners, corners_cap),
                                  DP_ARRAY(dp_polygon_store, firsts, firsts_cap),
                                  DP_ARRAY(dp_polygon_store, source_polygon, source_cap),
                                  DP_ARRAY(dp_polygon_store, colors, colors_cap),
                                  DP_ARRAY(dp_polygon_store, edge_flags, flags_cap),
                                  DP_ARRAY(dp_polygon_store, groups, groups_cap),
                                  DP_ARRAY(dp_polygon_store, marks, marks_cap)};

void dp_polygon_store_free(dp_polygon_store *store, const dp_allocator *allocator) {
    dp_arrays_free(allocator, store, DP_ARRAYS(arrays));
    dp_attribute_store_free(&store->normals, allocator);
    dp_attribute_store_free(&store->texcoords, allocator);
    dp_split_scratch_free(&store->scratch, allocator);
    *store = (dp_polygon_store){0};
}

uint64_t dp_polygon_store_bytes(const dp_polygon_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays)) + dp_attribute_store_bytes(&store->normals) +
           dp_attribute_store_bytes(&store->texcoords) + dp_split_scratch_bytes(&store->scratch);
}

static dp_result out_of_memory(gatherer *g) {
    return dp_fail(g->diag, DP_ERR_MEMORY, "out of memory for %zu polygons", g->store->polygons);
}

static uint32_t batch_vertex(const dp_batch *batch, size_t corner) {
    return batch->indices ? batch->indices[corner] : (uint32_t)corner;
}

static const float *batch_position(const dp_batch *batch, uint32_t vertex) {
    return (const float *)(const void *)((const char *)batch->positions +
                                         (size_t)vertex * batch->position_stride);
}

/* Finds the corners' positions; false if an index is out of range or a coordinate not finite
 * (binning drops the polygon). */
static bool locate(const dp_batch *batch, size_t first, size_t n, const float **at) {
    for (size_t i = 0; i < n; i++) {
        const uint32_t vertex = batch_vertex(batch, first + i);
        if (vertex >= batch->vertex_count) return false;
        at[i] = batch_position(batch, vertex);
        if (!isfinite(at[i][0]) || !isfinite(at[i][1]) || !isfinite(at[i][2])) return false;
    }
    return true;
}

/* The largest of a batch's flags. */
static uint8_t largest_flag(const dp_batch *batch) {
    uint8_t most = 0;
    for (size_t i = 0; batch->edge_flags && i < batch->corner_count; i++)
        most = batch->edge_flags[i] > most ? batch->edge_flags[i] : most;
    return most;
}

/* Can the polygons of a batch be used as they are? */
static bool is_sound(gatherer *g, const dp_batch *batch, dp_result *result) {
    *result = DP_OK;
    if (largest_flag(batch) > DP_EDGE_FACE) return false;
    if (batch->polygon_count > UINT32_MAX / 4 || !batch->firsts)
        return batch->polygon_count <= UINT32_MAX / 4;
    if (batch->corner_count > UINT32_MAX) return false;
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const size_t n = batch->firsts[i + 1] - batch->firsts[i];
        if ((*result = tell_checked(g, i)) || n < 3) return false;
        if (n == 3) continue;
        if (!dp_split_scratch_reserve(&g->store->scratch, n, g->memory)) {
            *result = out_of_memory(g);
            return false;
        }
        if (locate(batch, batch->firsts[i], n, g->store->scratch.at) &&
            !dp_stays_whole(g->store->scratch.at, (uint32_t)n))
            return false;
    }
    return true;
}

static void use_as_is(const dp_batch *batch, dp_polygons *out, dp_stats *stats) {
    *out = (dp_polygons){.positions = batch->positions,
                         .stride = batch->position_stride,
                         .vertex_count = (uint32_t)batch->vertex_count,
                         .corners = batch->indices,
                         .firsts = batch->firsts,
                         .edge_flags = batch->edge_flags,
                         .has_diagonals = largest_flag(batch) > DP_EDGE_NORMAL,
                         .groups = batch->groups,
                         .normals = batch->normals,
                         .texcoords = batch->texcoords,
                         .colors = batch->colors,
                         .count = (uint32_t)batch->polygon_count};
    stats->polygons = batch->polygon_count;
    const uint64_t corners = batch->firsts ? batch->firsts[batch->polygon_count] - batch->firsts[0]
                                           : 3 * (uint64_t)batch->polygon_count;
    stats->triangles = corners - 2 * stats->polygons;
}

/* ------- appending to the store ------- */

static bool reserve_polygon(gatherer *g, size_t corners) {
    dp_polygon_store *const s = g->store;
    const size_t n = s->polygons + 1, c = s->corner_count + corners;
    return dp_reserve(g->memory, &s->corners, &s->corners_cap, c, sizeof *s->corners) &&
           dp_reserve(g->memory, &s->edge_flags, &s->flags_cap, c, 1) &&
           dp_reserve(g->memory, &s->firsts, &s->firsts_cap, n + 1, sizeof *s->firsts) &&
           dp_reserve(g->memory, &s->source_polygon, &s->source_cap, n,
                      sizeof *s->source_polygon) &&
           dp_reserve(g->memory, &s->groups, &s->groups_cap, n, sizeof *s->groups) &&
           dp_attribute_reserve_corners(&s->normals, c, g->memory) &&
           dp_attribute_reserve_corners(&s->texcoords, c, g->memory);
}

static void begin_polygon(gatherer *g, const dp_batch *batch, size_t i) {
    dp_polygon_store *const s = g->store;
    s->firsts[s->polygons] = (uint32_t)s->corner_count;
    s->source_polygon[s->polygons] = (uint32_t)(g->handed_out + i);
    s->groups[s->polygons] = batch->groups ? batch->groups[i] : 0;
    if (s->source_polygon[s->polygons] != s->polygons) g->has_source = true;
    s->polygons++;
}

static void add_corner(gatherer *g, uint32_t base, const dp_batch *batch, size_t corner,
                       uint8_t flag) {
    dp_polygon_store *const s = g->store;
    const uint32_t vertex = batch_vertex(batch, corner);
    s->corners[s->corner_count] = vertex < batch->vertex_count ? base + vertex : UINT32_MAX;
    s->edge_flags[s->corner_count] = flag;
    if (flag != 1) g->has_flags = true;
    dp_attribute_add_corner(&s->normals, &batch->normals, corner, vertex, s->corner_count);
    dp_attribute_add_corner(&s->texcoords, &batch->texcoords, corner, vertex, s->corner_count);
    s->corner_count++;
}

static uint8_t flag_of(const dp_batch *batch, size_t corner) {
    const uint8_t flag = batch->edge_flags ? batch->edge_flags[corner] : DP_EDGE_NORMAL;
    return flag <= DP_EDGE_FACE ? flag : DP_EDGE_NORMAL;
}

static dp_result append_whole(gatherer *g, const dp_batch *batch, size_t i, size_t first, size_t n,
                              uint32_t base) {
    if (!reserve_polygon(g, n)) return out_of_memory(g);
    begin_polygon(g, batch, i);
    for (size_t k = 0; k < n; k++) add_corner(g, base, batch, first + k, flag_of(batch, first + k));
    if (n != 3) g->has_firsts = true;
    return DP_OK;
}

static dp_result append_split(gatherer *g, const dp_batch *batch, size_t i, size_t first, size_t n,
                              uint32_t base) {
    const uint32_t count = dp_split_polygon(&g->store->scratch, (uint32_t)n);
    g->stats->split++;
    for (uint32_t t = 0; t < count; t++) {
        if (!reserve_polygon(g, 3)) return out_of_memory(g);
        begin_polygon(g, batch, i);
        for (int k = 0; k < 3; k++) {
            const uint32_t from = g->store->scratch.triangles[t][k],
                           to = g->store->scratch.triangles[t][(k + 1) % 3];
            const bool outline = to == (from + 1) % n;
            add_corner(g, base, batch, first + from,
                       outline ? flag_of(batch, first + from) : DP_EDGE_DIAGONAL);
        }
    }
    return DP_OK;
}

static dp_result append_polygon(gatherer *g, const dp_batch *batch, size_t i, uint32_t base) {
    const size_t first = batch->firsts ? batch->firsts[i] : 3 * i;
    const size_t n = batch->firsts ? batch->firsts[i + 1] - first : 3;
    if (n < 3) {
        g->stats->dropped_corners++;
        return DP_OK;
    }
    g->stats->triangles += n - 2;
    if (n == 3) return append_whole(g, batch, i, first, n, base);
    if (!dp_split_scratch_reserve(&g->store->scratch, n, g->memory)) return out_of_memory(g);
    const bool known = locate(batch, first, n, g->store->scratch.at);
    if (!known || dp_stays_whole(g->store->scratch.at, (uint32_t)n))
        return append_whole(g, batch, i, first, n, base);
    return append_split(g, batch, i, first, n, base);
}

/* Vertices have colours from the first batch on that has some; earlier ones then have none. False
 * when memory is out. */
static bool append_colors(gatherer *g, const dp_batch *batch) {
    dp_polygon_store *const s = g->store;
    const size_t base = s->vertices;
    if (!batch->colors && !g->has_colors) return true;
    if (!dp_reserve(g->memory, &s->colors, &s->colors_cap, base + batch->vertex_count,
                    sizeof *s->colors))
        return false;
    if (!g->has_colors) memset(s->colors, 0, base * sizeof *s->colors);
    g->has_colors = true;
    if (batch->colors)
        memcpy(s->colors + base, batch->colors, batch->vertex_count * sizeof *s->colors);
    else
        memset(s->colors + base, 0, batch->vertex_count * sizeof *s->colors);
    return true;
}

static void append_positions(const gatherer *g, const dp_batch *batch, float *to) {
    double shift[3];
    const bool moved = dp_batch_shift(batch, g->origin, shift);
    for (size_t v = 0; v < batch->vertex_count; v++, to += 3) {
        const float *const p = batch_position(batch, (uint32_t)v);
        memcpy(to, p, 3 * sizeof *to);
        for (int k = 0; moved && k < 3; k++) to[k] = (float)((double)p[k] + shift[k]);
    }
}

static dp_result append_batch(gatherer *g, const dp_batch *batch) {
    dp_polygon_store *const s = g->store;
    const size_t base = s->vertices;
    if (base + batch->vertex_count >= UINT32_MAX ||
        s->corner_count + batch->corner_count >= UINT32_MAX / 2 ||
        g->handed_out + batch->polygon_count >= UINT32_MAX / 4)
        return dp_fail(g->diag, DP_ERR_LIMIT, "more than %u vertices, corners or polygons",
                       UINT32_MAX / 4);
    if (!dp_reserve(g->memory, &s->positions, &s->positions_cap,
                    dp_times(3, base + batch->vertex_count), sizeof *s->positions) ||
        !dp_attribute_add_values(&s->normals, &batch->normals, 3, s->corner_count, g->memory) ||
        !dp_attribute_add_values(&s->texcoords, &batch->texcoords, 2, s->corner_count, g->memory) ||
        !append_colors(g, batch))
        return out_of_memory(g);
    if (batch->vertex_count) append_positions(g, batch, s->positions + 3 * base);
    s->vertices += batch->vertex_count;
    if (batch->groups) g->has_groups = true;
    for (size_t i = 0; i < batch->polygon_count; i++) {
        dp_result result = tell_stored(g, i);
        if (!result) result = append_polygon(g, batch, i, (uint32_t)base);
        if (result) return result;
    }
    g->handed_out += batch->polygon_count;
    g->stats->polygons += batch->polygon_count;
    return DP_OK;
}

/* Memory of the store and of the stages after it. Per vertex: position, and vertex on the screen;
 * per polygon: number, group, and entries in bins. */
static bool is_beyond_limit(const dp_polygon_store *s) {
    enum { VERTEX = 28, CORNER = 5, POLYGON = 34 };
    return s->limit &&
           VERTEX * s->vertices + CORNER * s->corner_count + POLYGON * s->polygons > s->limit;
}

static void use_store(const gatherer *g, dp_polygons *out) {
    const dp_polygon_store *const s = g->store;
    if (s->firsts) s->firsts[s->polygons] = (uint32_t)s->corner_count;
    *out = (dp_polygons){.positions = s->positions,
                         .stride = 3 * sizeof(float),
                         .vertex_count = (uint32_t)s->vertices,
                         .corners = s->corners,
                         .firsts = g->has_firsts ? s->firsts : NULL,
                         .edge_flags = g->has_flags ? s->edge_flags : NULL,
                         .has_diagonals = g->has_flags,
                         .source_polygon = g->has_source ? s->source_polygon : NULL,
                         .groups = g->has_groups ? s->groups : NULL,
                         .normals = dp_attribute_of_store(&s->normals, 3),
                         .texcoords = dp_attribute_of_store(&s->texcoords, 2),
                         .colors = g->has_colors ? s->colors : NULL,
                         .count = (uint32_t)s->polygons};
}

static dp_result gather(gatherer *g, dp_source *source, dp_polygons *out) {
    dp_batch batch, next;
    dp_result result = dp_source_next(source, &batch, g->diag);
    if (result) return result;
    const bool stable = batch.stable && batch.polygon_count;
    memcpy(g->origin, batch.origin, sizeof g->origin);
    if (stable) {
        const dp_batch first = batch;
        if ((result = dp_source_next(source, &next, g->diag))) return result;
        if (!next.polygon_count) g->only = first.polygon_count;
        if (!next.polygon_count && is_sound(g, &first, &result)) {
            use_as_is(&first, out, g->stats);
            return DP_OK;
        }
        if (result || (result = append_batch(g, &first))) return result;
        batch = next;
    }
    while (batch.polygon_count) {
        if ((result = append_batch(g, &batch))) return result;
        if ((g->store->is_beyond = is_beyond_limit(g->store)))
            return dp_fail(g->diag, DP_ERR_LIMIT, "the model takes more than %zu MB of memory",
                           g->store->limit >> 20);
        if ((result = dp_source_next(source, &batch, g->diag))) return result;
    }
    use_store(g, out);
    return DP_OK;
}

/* ------- marked edges ------- */

/* Most models have no marked edges, and of those that do most polygons: flags are looked at block by
 * block. */
enum { BLOCK = DP_TUNED(1024, 3) /* polygons */ };

static bool is_mark(uint8_t flag) { return flag == DP_EDGE_SECTION || flag == DP_EDGE_HATCHING; }

static bool any_mark(const uint8_t *flags, uint32_t count) {
    uint32_t marks = 0;
    for (uint32_t i = 0; i < count; i++)
        marks |= (uint32_t)(flags[i] == DP_EDGE_SECTION) | (flags[i] == DP_EDGE_HATCHING);
    return marks;
}

/* Polygons that lie in the source's own memory may name vertices that do not exist: nothing of them is drawn. */
static bool names_vertices(const dp_polygons *p, uint32_t first, uint32_t n) {
    for (uint32_t i = 0; i < n; i++)
        if (dp_corner_vertex(p, first + i) >= p->vertex_count) return false;
    return true;
}

static bool list_polygon(dp_polygon_store *store, const dp_allocator *memory, dp_polygons *p,
                         uint32_t polygon) {
    const uint32_t first = dp_first_corner(p, polygon), n = dp_corner_count(p, polygon);
    if (!names_vertices(p, first, n)) return true;
    for (uint32_t i = 0; i < n; i++) {
        if (!is_mark(p->edge_flags[first + i])) continue;
        if (!dp_reserve(memory, &store->marks, &store->marks_cap, p->mark_count + (size_t)1,
                        sizeof *store->marks))
            return false;
        store->marks[p->mark_count++] = (dp_marked_edge){polygon, i};
    }
    return true;
}

static bool list_marks(dp_polygon_store *store, const dp_allocator *memory, dp_polygons *p) {
    p->mark_count = 0;
    for (uint32_t from = 0; p->has_diagonals && from < p->count; from += BLOCK) {
        const uint32_t to = p->count - from < BLOCK ? p->count : from + BLOCK,
                       first = dp_first_corner(p, from), end = dp_first_corner(p, to);
        if (!any_mark(p->edge_flags + first, end - first)) continue;
        for (uint32_t i = from; i < to; i++)
            if (!list_polygon(store, memory, p, i)) return false;
    }
    p->marks = store->marks;
    return true;
}

dp_result dp_gather(dp_source *source, dp_polygon_store *store, const dp_allocator *allocator,
                    dp_polygons *out, dp_stats *stats, dp_diag *diag) {
    const dp_result begun = dp_source_begun(source, diag);
    if (begun) return begun;
    store->vertices = store->corner_count = store->polygons = 0;
    store->is_beyond = false;
    store->normals.count = store->texcoords.count = 0;
    store->normals.used = store->texcoords.used = false;
    gatherer g = {.store = store, .memory = allocator, .stats = stats, .diag = diag};
    const dp_result result = gather(&g, source, out);
    if (result || list_marks(store, allocator, out)) return result;
    return out_of_memory(&g);
}
