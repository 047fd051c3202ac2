/* Edges of more than two triangles, of which the first reading may have dropped some.
 *
 * Two of them may have been plain to each other and been forgotten before the others came; those
 * others then make a line among themselves, or wait for ever and emerge as an outline.
 *
 *     between      make_fans      a table of all edges of candidates, with one triangle each
 *     2nd reading  look_for_fans  each triangle of a chunk with such an edge is noted
 *                  join_fans      on either side of the edge on the screen, the triangle that rises
 *                                   most towards the eye stays (as resolve_fan in find/edges.c)
 *     at the end   settle_fans    the two that are left decide which line it is, if any
 *
 * Edges at which no new triangle came by stay as they are.
 *
 * Data structure: open addressing over edges of candidates, and a bit filter before it. The result
 * does not depend on the order of triangles. */
#include "stream/draw.h"

#include "raster/kernels.h"

#include <string.h>

/* A triangle at an edge, seen from the eye. */
typedef struct incident_face {
    double rise;    /* change of depth per px away from the edge */
    dp_vec3 normal; /* unit, of the side that is seen */
    dp_vec3 corner; /* the one that is not on the edge */
    uint32_t number;
    bool front, there;
} incident_face;

struct dp_fan {
    uint32_t corner;       /* of frame->polygons, where the edge begins */
    bool met;              /* a triangle came by that the edge table had not seen */
    incident_face side[2]; /* left and right of the edge on the screen */
};

static const dp_array arrays[] = {DP_ARRAY(dp_fan_table, fans, fans_cap),
                                  DP_ARRAY(dp_fan_table, slots, slots_cap),
                                  DP_ARRAY(dp_fan_table, filter, filter_cap)};

void dp_fan_table_free(dp_fan_table *table, const dp_allocator *memory) {
    dp_arrays_free(memory, table, DP_ARRAYS(arrays));
    *table = (dp_fan_table){0};
}

uint64_t dp_fan_table_bytes(const dp_fan_table *table) {
    return dp_arrays_bytes(table, DP_ARRAYS(arrays));
}

static const float *position(const dp_stream_draw *s, uint32_t corner) {
    return s->positions + 3 * (size_t)corner;
}
static uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

static bool make_incident_face(const dp_stream_draw *s, const float *a, const float *b,
                               const float *c, const float *triangle, uint32_t number, int *side,
                               incident_face *out) {
    const dp_view *const view = &s->frame->view;
    dp_spine spine;
    const dp_clip_point clip = dp_to_clip(view, dp_v3f(c));
    if (!(clip.w > 0) || !dp_spine_make(view, dp_v3f(a), dp_v3f(b), dp_v3(0, 0, 0), &spine))
        return false;
    const dp_pointd p = dp_to_screen(view, clip);
    const double ex = spine.b.x - spine.a.x, ey = spine.b.y - spine.a.y, length = dp_hypot(ex, ey);
    const double x = p.x - spine.a.x, y = p.y - spine.a.y, across = (ex * y - ey * x) / length;
    if (!(length > 0) || !(fabs(across) > 0)) return false;
    const double on_edge =
        spine.a.d + (spine.b.d - spine.a.d) * (ex * x + ey * y) / (length * length);
    const dp_vec3 o = dp_v3f(triangle);
    const dp_vec3 n =
        dp_unit(dp_cross(dp_sub(dp_v3f(triangle + 3), o), dp_sub(dp_v3f(triangle + 6), o)));
    const bool front = dp_dot(n, dp_view_vector(view, o)) < 0;
    *side = across < 0;
    *out = (incident_face){(p.d - on_edge) / fabs(across),
                           dp_scale(n, front ? 1 : -1),
                           dp_v3f(c),
                           number,
                           front,
                           true};
    return true;
}

/* Keeps the incident face nearest to the eye on its side; of equals the first in the stream. */
static void offer(dp_fan *fan, int side, const incident_face *f) {
    incident_face *const best = &fan->side[side];
    if (!best->there || f->rise > best->rise || (f->rise >= best->rise && f->number < best->number))
        *best = *f;
}

/* The key that kernels make of a chunk's edges. */
static uint32_t edge_key(const dp_stream_draw *s, const float *a, const float *b) {
    dp_vertex v[2];
    dp_raster_kernels_for(s->frame->lanes)
        ->transform(s->view.view, a, 3 * sizeof *a, 1, &v[0], false);
    dp_raster_kernels_for(s->frame->lanes)
        ->transform(s->view.view, b, 3 * sizeof *b, 1, &v[1], false);
    return v[0].key + v[1].key;
}

static void add_fan(dp_stream_draw *s, uint32_t corner) {
    dp_fan *const fan = &s->fans.fans[s->fans.count];
    const uint32_t polygon = corner / 3;
    const float *const a = position(s, corner), *const b = position(s, next_corner(corner));
    const float *const c = position(s, next_corner(next_corner(corner)));
    int side;
    incident_face own;
    *fan = (dp_fan){.corner = corner};
    if (!make_incident_face(s, a, b, c, position(s, 3 * polygon), s->polygon_numbers[polygon],
                            &side, &own))
        return;
    offer(fan, side, &own);
    uint32_t slot = dp_edge_hash(a, b) & (s->fans.slot_count - 1);
    while (s->fans.slots[slot]) slot = (slot + 1) & (s->fans.slot_count - 1);
    s->fans.slots[slot] = ++s->fans.count;
    const uint32_t bit = edge_key(s, a, b) & (s->fans.filter_bits - 1);
    s->fans.filter[bit / 64] |= (uint64_t)1 << bit % 64;
}

static const dp_fan *fan_at(const dp_stream_draw *s, uint32_t corner) {
    const float *const a = position(s, corner), *const b = position(s, next_corner(corner));
    for (uint32_t slot = dp_edge_hash(a, b) & (s->fans.slot_count - 1); s->fans.slots[slot];
         slot = (slot + 1) & (s->fans.slot_count - 1))
        if (s->fans.fans[s->fans.slots[slot] - 1].corner == corner)
            return &s->fans.fans[s->fans.slots[slot] - 1];
    return NULL;
}

static bool reserve_fans(dp_fan_table *t, size_t count, const dp_allocator *memory) {
    t->slot_count = 64;
    while (t->slot_count < 2 * count) t->slot_count *= 2;
    t->filter_bits = t->slot_count < 1u << 27 ? 16 * t->slot_count : 1u << 31; /* few are set */
    return dp_reserve_zeroed(memory, &t->slots, &t->slots_cap, t->slot_count, sizeof *t->slots) &&
           dp_reserve(memory, &t->fans, &t->fans_cap, count, sizeof *t->fans) &&
           dp_reserve_zeroed(memory, &t->filter, &t->filter_cap, t->filter_bits / 64,
                             sizeof *t->filter);
}

bool dp_stream_make_fans(dp_stream_draw *s) {
    const uint32_t tiles = s->frame->tiles_x * s->frame->tiles_y;
    size_t count = 0;
    for (uint32_t t = 0; t < tiles; t++) count += s->lines[t].candidate_count;
    if (!count || count > s->intersecting_limit / 2) return true; /* too many to be looked after */
    if (!reserve_fans(&s->fans, count, s->memory)) return false;
    for (uint32_t t = 0; t < tiles; t++)
        for (uint32_t i = 0; i < s->lines[t].candidate_count; i++) {
            const uint32_t corner =
                3 * s->lines[t].candidates[i].a + s->lines[t].candidates[i].edge;
            if (!fan_at(s, corner)) add_fan(s, corner);
        }
    return true;
}

static bool is_edge(const dp_stream_draw *s, const dp_fan *fan, const float *a, const float *b) {
    const float *const p = position(s, fan->corner), *const q =
                                                         position(s, next_corner(fan->corner));
    const size_t size = 3 * sizeof(float);
    return (!memcmp(p, a, size) && !memcmp(q, b, size)) ||
           (!memcmp(p, b, size) && !memcmp(q, a, size));
}

void dp_stream_look_for_fans(const dp_stream_draw *s, const float *a, const float *b,
                             const float *c, const float *triangle, uint32_t number,
                             dp_stream_worker *own) {
    const uint32_t mask = s->fans.slot_count - 1;
    for (uint32_t slot = dp_edge_hash(a, b) & mask; s->fans.slots[slot]; slot = (slot + 1) & mask) {
        const dp_fan *const fan = &s->fans.fans[s->fans.slots[slot] - 1];
        if (s->polygon_numbers[fan->corner / 3] == number || !is_edge(s, fan, a, b)) continue;
        if (!dp_reserve(s->memory, &own->partners, &own->partners_cap, own->partner_count + 1,
                        sizeof *own->partners)) {
            own->failed = true;
            return;
        }
        dp_partner *const partner = &own->partners[own->partner_count++];
        *partner = (dp_partner){.fan = s->fans.slots[slot] - 1, .number = number};
        memcpy(partner->corner, c, sizeof partner->corner);
        memcpy(partner->triangle, triangle, sizeof partner->triangle);
    }
}

/* Is the partner a pending triangle, with this edge? Then the edge table has seen it. */
static bool is_known(const dp_stream_draw *s, const dp_fan *fan, uint32_t number) {
    uint32_t lo = 0, hi = s->mesh_count;
    while (hi - lo > 1) {
        const uint32_t mid = lo + (hi - lo) / 2;
        if (s->polygon_numbers[mid] <= number)
            lo = mid;
        else
            hi = mid;
    }
    if (!hi || s->polygon_numbers[lo] != number) return false;
    for (uint32_t c = 3 * lo; c < 3 * lo + 3; c++)
        if (s->edge_flags[c] != DP_EDGE_PLAIN &&
            is_edge(s, fan, position(s, c), position(s, next_corner(c))))
            return true;
    return false;
}

bool dp_stream_join_fans(dp_stream_draw *s) {
    for (uint32_t i = 0; i < s->worker_count; i++) {
        dp_stream_worker *const w = &s->workers[i];
        if (w->failed) return false;
        for (size_t k = 0; k < w->partner_count; k++) {
            const dp_partner *const partner = &w->partners[k];
            dp_fan *const fan = &s->fans.fans[partner->fan];
            int side;
            incident_face f;
            /* left and right are those of the fan's own edge */
            if (!make_incident_face(s, position(s, fan->corner),
                                    position(s, next_corner(fan->corner)), partner->corner,
                                    partner->triangle, partner->number, &side, &f))
                continue;
            offer(fan, side, &f);
            fan->met = fan->met || !is_known(s, fan, partner->number);
        }
        w->partner_count = 0;
    }
    return true;
}

/* ------- what line it is ------- */

/* dp_line, or -1. */
static int line_of(const dp_stream_draw *s, const dp_fan *fan) {
    const incident_face *const l = &fan->side[0], *const r = &fan->side[1];
    if (!l->there || !r->there) return DP_LINE_SILHOUETTE;
    if (!l->front && !r->front) return -1;
    const dp_vec3 into = dp_sub(r->corner, dp_v3f(position(s, fan->corner)));
    const dp_fold fold = {
        .normal_a = l->normal, .normal_b = r->normal, .concave = dp_dot(l->normal, into) > 0};
    return dp_fold_line(&fold, &s->frame->styles[0]);
}

void dp_stream_settle_fans(const dp_stream_draw *s, dp_tile_lines *lines) {
    if (!s->fans.count) return;
    for (uint32_t i = 0; i < lines->candidate_count; i++) {
        dp_candidate *const c = &lines->candidates[i];
        const dp_fan *const fan = c->edge == DP_CROSSING ? NULL : fan_at(s, 3 * c->a + c->edge);
        if (!fan || !fan->met) continue;
        const int line = line_of(s, fan);
        if (line >= 0) c->line = (uint8_t)line;
        if (line >= 0 && s->frame->styles[0].lines >> line & 1) continue;
        for (uint32_t k = 0; k < c->k1 - c->k0; k++) lines->probes.limit[c->probe + k] = INFINITY;
    }
}
