/* Intersections: segments where two polygons of a tile cross in sight (Raskar 2001, 2.4).
 *
 *    candidate pixels: those where a second surface comes close in depth (raster/near_depth.c)
 *        of pairs with a back face, keep only those where a back face is seen nearby
 *    intersection candidates: polygons whose box holds a pixel around candidate pixels
 *        sort them by the first row of their boxes
 *    for each one, in that order
 *        for those that may cross it, up to its last row (meet.inc)
 *            both boxes hold one of these pixels, and each polygon has corners on both
 *            sides of the other's plane: cross them exactly (features/crossing.c)
 *    in the order of the source, what no earlier crossing has covered becomes candidates
 *
 * Raskar's between-test finds intersections sample by sample; here it only says where to look. Each
 * crossing segment becomes a candidate with sample points, like an edge.
 *
 * Invariant: each pair is tested once, by the one that comes first in the sorted order. Not
 * handled: crossings that no sample's depth comes near, and polygons that share two corners (an
 * edge). */
#include "find/kernels.h"
#include "base/sort.h"
#include "core/spine.h"
#include "features/crossing.h"
#include "find/finder.h"

#include <string.h>

/* Along every outline of a closed model a front and a back face come close. They cross in sight
 * only where the back face is seen too, so only candidate pixels near a pixel whose winner is a
 * back face are kept. */
static void keep_seen_back_faces(const dp_finder *w, uint64_t candidate_pixels[DP_TILE]) {
    uint64_t near[DP_TILE], backs[DP_TILE];
    if (!dp_widen(candidate_pixels, near)) return;
    dp_find_kernels_for(w->tile.frame->lanes)->show_backs(w, near, backs);
    dp_widen(backs, near);
    for (int y = 0; y < DP_TILE; y++) candidate_pixels[y] &= near[y];
}

/* ------- pairs ------- */

/* The corners, a bit each, at which two triangles of the tile have the same position; positions are
 * compared by their keys, which are hashes. Other and clipped polygons get no bits here; for them
 * dp_shared_corners decides. */
static void find_shared(const dp_finder *w, const dp_tile_polygon *p, const dp_tile_polygon *q,
                        uint32_t *of_p, uint32_t *of_q) {
    *of_p = *of_q = 0;
    if ((p->flags | q->flags) & DP_POLYGON_CLIPPED || (p->points ^ 3) | (q->points ^ 3)) return;
    const dp_vertex *const a = w->tile.points + p->point, *const b = w->tile.points + q->point;
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = 0; j < 3; j++) {
            const uint32_t same = a[i].key == b[j].key;
            *of_p |= same << i, *of_q |= same << j;
        }
}

/* Does p lie on one side of q's plane, in screen space? A cheap first test. Shared corners lie in
 * the plane and do not count. */
static bool is_beside(const dp_finder *w, const dp_tile_polygon *p, const dp_tile_polygon *q,
                      uint32_t shared) {
    bool nearer = false, further = false;
    for (uint32_t i = 0; i < p->points; i++) {
        const dp_vertex at = w->tile.points[p->point + i];
        const float gap = at.d - dp_plane_at(q, at.x, at.y);
        const bool apart = !(i < 3 && shared >> i & 1);
        nearer |= apart & (gap >= 0), further |= apart & (gap <= 0);
    }
    return !(nearer & further);
}

/* Does one polygon lie on one side of the other's plane? */
static bool are_beside(const dp_finder *w, const dp_tile_polygon *p, const dp_tile_polygon *q) {
    uint32_t of_p, of_q;
    find_shared(w, p, q, &of_p, &of_q);
    if ((p->flags | q->flags) & DP_POLYGON_EDGE_ON) return false;
    return is_beside(w, p, q, of_p) || is_beside(w, q, p, of_q);
}

/* Two polygons of the frame that cross, a < b. */
typedef struct dp_crossed {
    uint32_t a, b;
    uint32_t spine; /* where: number of the crossing */
    uint32_t next;  /* 1 + an earlier pair whose crossing runs at about the same angle; 0: none */
} crossed;

static void test_pair(dp_finder *w, uint32_t a, uint32_t b) {
    const dp_tile_polygon *const p = &w->tile.polygons[a], *const q = &w->tile.polygons[b];
    if (are_beside(w, p, q) || dp_shared_corners(w->tile.frame, p->id, q->id) > 1) return;
    dp_intersecting *const list = &w->intersecting;
    const crossed out = {.a = p->id < q->id ? p->id : q->id,
                         .b = p->id < q->id ? q->id : p->id,
                         .spine = list->crossing_count};
    dp_vec3 from, to, normal;
    dp_spine spine;
    if (!(dp_polygon_style(w->tile.frame, out.a)->lines & DP_INTERSECTION)) return;
    if (!dp_crossing_find(w->tile.frame, out.a, out.b, &from, &to, &normal)) return;
    if (!dp_spine_make(&w->tile.frame->view, from, to, normal, &spine)) return;
    if (!DP_TILE_RESERVE(&w->tile, list, crossed, crossed_cap, (size_t)list->crossing_count + 1) ||
        !DP_TILE_RESERVE(&w->tile, list, crossings, crossings_cap,
                         (size_t)list->crossing_count + 1))
        return;
    list->crossed[list->crossing_count] = out;
    list->crossings[list->crossing_count++] = spine;
}

/* ------- crossings that are there twice ------- */

static int by_polygons(const void *left, const void *right) {
    const crossed *const l = left, *const r = right;
    if (l->a != r->a) return l->a < r->a ? -1 : 1;
    return (l->b > r->b) - (l->b < r->b);
}

/* px on the screen, pixel sizes in depth: crossings no farther apart are one. */
static const double SAME = 0.02, SAME_DEPTH = 0.2;

/* Crossings by the angle at which they run on the screen: only those of one bucket, or of the next,
 * may be one. */
enum { ANGLES = 32 /* half a turn, and over again */ };
static uint32_t angle_of(const dp_spine *s) {
    const double x = fabs(s->b.x - s->a.x), y = s->b.y - s->a.y,
                 up = s->b.x < s->a.x ? -y : y; /* both directions are one angle */
    const double turned = x + fabs(up) > 0 ? up / (x + fabs(up)) : 0; /* -1 to 1 */
    return (uint32_t)((turned + 1) * (ANGLES / 2 - 1e-9));
}

/* A range of a spine's sample points in the tile, and which of them are covered. */
enum { POINTS = 512 }; /* more than fit the tile's diagonal */
typedef struct cover {
    uint32_t k0, k1;
    bool there[POINTS];
} cover;

/* Covers the sample points of `s` beside which `other` runs. */
static void cover_by(const dp_finder *w, const dp_spine *s, const dp_spine *other, cover *c) {
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = dp_hypot(ex, ey);
    double t[2];
    if (!(length > 0)) return;
    for (int i = 0; i < 2; i++) {
        const dp_pointd p = i ? other->b : other->a;
        const double x = p.x - s->a.x, y = p.y - s->a.y;
        if (fabs(ex * y - ey * x) > SAME * length) return;
        t[i] = (ex * x + ey * y) / (length * length);
        const double d = s->a.d + t[i] * (s->b.d - s->a.d);
        if (fabs(p.d - d) > fabs(dp_depth_step(&w->tile.frame->view, d, SAME_DEPTH))) return;
    }
    const double from = dp_min(t[0], t[1]) * s->n, to = dp_max(t[0], t[1]) * s->n;
    for (uint32_t k = c->k0; k < c->k1; k++) c->there[k - c->k0] |= k + 0.5 > from && k + 0.5 < to;
}

static void add_uncovered(dp_finder *w, const crossed *x, const cover *c) {
    for (uint32_t k = c->k0, start = k; k <= c->k1; k++) {
        if (k < c->k1 && !c->there[k - c->k0]) continue;
        /* a range that reaches the end of the part looked at goes on as far as the tile does */
        const dp_candidate candidate = {.a = x->a,
                                        .b = x->b,
                                        .edge = DP_CROSSING,
                                        .k0 = start == c->k0 ? 0 : start,
                                        .k1 = k == c->k1 ? UINT32_MAX : k,
                                        .line = DP_LINE_INTERSECTION,
                                        .seen = 3};
        if (k > start) dp_add_candidate(w, candidate, &w->intersecting.crossings[x->spine], NULL);
        start = k + 1;
    }
}

/* Doubled faces cross as often as they are there: what an earlier crossing covers is left out. */
static void add_crossings(dp_finder *w) {
    dp_intersecting *const list = &w->intersecting;
    uint32_t first[ANGLES] = {0}; /* by angle: 1 + the last one so far */
    dp_sort(list->crossed, list->crossing_count, sizeof *list->crossed, by_polygons);
    for (uint32_t i = 0; i < list->crossing_count && !w->tile.failed; i++) {
        crossed *const x = &list->crossed[i];
        const dp_spine *const s = &list->crossings[x->spine];
        const uint32_t angle = angle_of(s);
        cover c = {.k0 = 0};
        if (!dp_spine_range(s, w->tile.tile_x, w->tile.tile_y, 1, &c.k0, &c.k1)) continue;
        if (c.k1 - c.k0 > POINTS) c.k1 = c.k0 + POINTS; /* rounding: the tile's diagonal is less */
        for (uint32_t k = 0; k < 3; k++)
            for (uint32_t at = first[(angle + ANGLES - 1 + k) % ANGLES]; at;
                 at = list->crossed[at - 1].next)
                cover_by(w, s, &list->crossings[list->crossed[at - 1].spine], &c);
        x->next = first[angle];
        first[angle] = i + 1;
        add_uncovered(w, x, &c);
    }
}

/* ------- the intersection candidates ------- */

/* Pixels by rows, and the first and last row that hold any. */
typedef struct pixels {
    uint64_t row[DP_TILE];
    uint32_t first, last;
} pixels;

/* Widens candidate pixels by their neighbours; false if there are none. */
static bool find_surroundings(const uint64_t candidate_pixels[DP_TILE], pixels *out) {
    if (!dp_widen(candidate_pixels, out->row)) return false;
    out->first = 0, out->last = DP_TILE - 1;
    while (!out->row[out->first]) out->first++;
    while (!out->row[out->last]) out->last--;
    return true;
}

/* Does a polygon's box (dp_tile_polygon.box) hold any of these pixels? */
static inline bool comes_near(uint32_t box, const pixels *near) {
    const uint32_t x0 = box & 255, y0 = box >> 8 & 255, x1 = box >> 16 & 255, y1 = box >> 24;
    const uint64_t span = (~(uint64_t)0 >> (63 - (x1 - x0))) << x0;
    const uint32_t first = y0 > near->first ? y0 : near->first,
                   last = y1 < near->last ? y1 : near->last;
    for (uint32_t y = first; y <= last; y++)
        if (near->row[y] & span) return true;
    return false;
}

/* Pixels around candidate pixels, for front faces and for back faces. */
typedef struct surroundings {
    pixels front, back;
    bool mixed; /* there are some for back faces */
} surroundings;

static const pixels *pixels_for(const surroundings *near, uint32_t flags) {
    return flags & DP_POLYGON_FRONT ? &near->front : &near->back;
}

/* Is there a pixel in both polygons' boxes that counts for both? */
static bool meet_near(const surroundings *near, const dp_tile_polygon *p,
                      const dp_tile_polygon *q) {
    const uint64_t span = dp_box_span(p) & dp_box_span(q);
    const pixels *const of_p = pixels_for(near, p->flags), *const of_q = pixels_for(near, q->flags);
    const uint32_t first = p->y0 > q->y0 ? p->y0 : q->y0, last = p->y1 < q->y1 ? p->y1 : q->y1;
    for (uint32_t y = first; y <= last; y++)
        if (of_p->row[y] & of_q->row[y] & span) return true;
    return false;
}

/* Marks cells that hold surroundings, then blocks of cells, for a first test. */
static void find_cells(const surroundings *near, dp_cell_bits cells) {
    const uint32_t all = DP_CELLS * DP_CELLS;
    memset(cells, 0, sizeof(dp_cell_bits));
    for (uint32_t y = 0; y < DP_TILE; y++)
        for (uint32_t x = 0; x < DP_CELLS; x++) {
            const uint32_t at = x * DP_CELL, cell = y / DP_CELL * DP_CELLS + x;
            const uint64_t columns = (uint64_t)((1 << DP_CELL) - 1) << at;
            if (near->front.row[y] & columns) cells[0][0][cell] |= DP_NEAR_FRONT;
            if (near->mixed && near->back.row[y] & columns) cells[0][0][cell] |= DP_NEAR_BACK;
        }
    for (uint32_t s = 1; s < DP_CELL_SPANS; s++)
        for (uint32_t i = 0; i < all; i++) cells[0][s][i] = cells[0][s - 1][i] | cells[0][0][i + s];
    for (uint32_t s = 1; s < DP_CELL_SPANS; s++)
        for (uint32_t k = 0; k < DP_CELL_SPANS; k++)
            for (uint32_t i = 0; i < all; i++)
                cells[s][k][i] = cells[s - 1][k][i] | cells[0][k][i + s * DP_CELLS];
}

/* Lists polygons near candidate pixels in `polygon`, and counts them by the first row of their
 * boxes. */
static bool list_intersecting(dp_finder *w, const surroundings *near, uint32_t *polygon,
                              uint32_t rows[DP_TILE + 1]) {
    dp_intersecting *const intersecting = &w->intersecting;
    const uint32_t *const boxes = dp_seen_words(&w->tile, DP_SEEN_BOX);
    const uint32_t *const flags = dp_seen_words(&w->tile, DP_SEEN_FLAGS);
    dp_cell_bits cells;
    find_cells(near, cells);
    const uint32_t count =
        dp_find_kernels_for(w->tile.frame->lanes)->come_near(w, &cells[0][0][0], polygon);
    intersecting->count = 0;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = polygon[k]; /* read before the list grows over it */
        if (!near->mixed && !(flags[i] & DP_POLYGON_FRONT)) continue;
        if (!comes_near(boxes[i], pixels_for(near, flags[i]))) continue;
        polygon[intersecting->count++] = w->tile.seen[i];
        rows[(boxes[i] >> 8 & 255) + 1]++;
    }
    const size_t room = (size_t)intersecting->count + DP_INTERSECTING_ROOM;
    return DP_TILE_RESERVE(&w->tile, w, intersecting.polygon, intersecting.polygon_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, intersecting.met, intersecting.met_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, intersecting.members, intersecting.members_cap,
                           DP_INTERSECTING_MEMBERS * room) &&
           DP_TILE_RESERVE(&w->tile, w, intersecting.keys, intersecting.keys_cap, 3 * room);
}

static void put_shape(const dp_finder *w, const dp_tile_polygon *p, uint32_t at) {
    const size_t stride = w->intersecting.stride;
    float *const out = w->intersecting.members + at;
    const dp_vertex *const v = w->tile.points + p->point;
    const bool told = p->points == 3 && !(p->flags & (DP_POLYGON_CLIPPED | DP_POLYGON_EDGE_ON));
    dp_f4 least = {v->x, v->y, v->d, 0}, most = least;
    for (uint32_t i = 0; i < p->points; i++) {
        const dp_f4 at_i = {v[i].x, v[i].y, v[i].d, 0};
        least = dp_select(at_i < least, at_i, least), most = dp_select(at_i > most, at_i, most);
        for (uint32_t k = 0; k < 3 && told; k++)
            out[(DP_INTERSECTING_CORNERS + 3 * i + k) * stride] = at_i[k];
    }
    for (uint32_t k = 0; k < 3; k++)
        out[(DP_INTERSECTING_LEAST + k) * stride] = least[k],
                                          out[(DP_INTERSECTING_MOST + k) * stride] = most[k];
    out[DP_INTERSECTING_PLANE * stride] = told ? p->d0 : NAN;
    out[(DP_INTERSECTING_PLANE + 1) * stride] = p->dx,
                                      out[(DP_INTERSECTING_PLANE + 2) * stride] = p->dy;
}

/* Writes a triangle's keys, which are hashes: a false match of two corners loses a crossing. Other
 * polygons get numbers that match as seldom; dp_shared_corners compares them later. */
static void put_keys(const dp_finder *w, const dp_tile_polygon *p, uint32_t at) {
    const dp_intersecting *const intersecting = &w->intersecting;
    const bool known = p->points == 3 && !(p->flags & DP_POLYGON_CLIPPED);
    for (uint32_t k = 0; k < 3; k++)
        intersecting->keys[k * (size_t)intersecting->stride + at] =
            known ? w->tile.points[p->point + k].key : 3 * at + k;
}

/* Sorts the candidates by the first rows of their boxes (counting sort). `rows` becomes the start
 * of each row's run. */
static void sort_intersecting(dp_finder *w, const uint32_t *polygon, uint32_t rows[DP_TILE + 1]) {
    dp_intersecting *const intersecting = &w->intersecting;
    uint32_t next[DP_TILE];
    intersecting->stride = intersecting->count + DP_INTERSECTING_ROOM;
    for (int y = 0; y < DP_TILE; y++) next[y] = rows[y], rows[y + 1] += rows[y];
    for (uint32_t i = 0; i < intersecting->count; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[polygon[i]];
        const uint32_t at = next[p->y0]++;
        intersecting->polygon[at] = polygon[i];
        put_shape(w, p, at);
        put_keys(w, p, at);
    }
}

/* Tests each pair once, when the one that comes first in the sorted order has its turn. */
void dp_find_intersections(dp_finder *w) {
    surroundings near;
    dp_tile_test_near_depth(&w->tile);
    keep_seen_back_faces(w, w->tile.candidate_pixels[1]);
    near.mixed = find_surroundings(w->tile.candidate_pixels[1], &near.back);
    for (int y = 0; y < DP_TILE; y++)
        w->tile.candidate_pixels[0][y] |= w->tile.candidate_pixels[1][y];
    dp_drop_lone(w->tile.candidate_pixels[0]);
    if (!find_surroundings(w->tile.candidate_pixels[0], &near.front)) return;
    uint32_t rows[DP_TILE + 1] = {0};
    if (!DP_TILE_RESERVE(&w->tile, w, intersecting.listed, intersecting.listed_cap,
                         (size_t)w->tile.seen_count + DP_INTERSECTING_ROOM) ||
        !list_intersecting(w, &near, w->intersecting.listed, rows))
        return;
    sort_intersecting(w, w->intersecting.listed, rows);
    w->intersecting.crossing_count = 0;
    for (uint32_t i = 0; i < w->intersecting.count && !w->tile.failed; i++) {
        const uint32_t a = w->intersecting.polygon[i];
        const uint32_t met = dp_find_kernels_for(w->tile.frame->lanes)
                                 ->meet(&w->intersecting, i, rows[w->tile.polygons[a].y1 + 1]);
        for (uint32_t k = 0; k < met; k++) {
            const uint32_t b = w->intersecting.polygon[w->intersecting.met[k]];
            if (meet_near(&near, &w->tile.polygons[a], &w->tile.polygons[b])) test_pair(w, a, b);
        }
    }
    add_crossings(w);
}

/* ------- crossings that nobody sees ------- */

/* The most polygons that lie in one pixel, and in no other, of which crossings are looked for. All pairs
 * of them would be tested, and nothing of a line in one pixel can be seen below more. */
enum { CROWD = 512 };

/* The tile's polygons by stripes of columns, those of each by the first row of their boxes. Large ones
 * lie in several stripes; those that lie in a crowded pixel, in none. */
typedef struct stripes {
    uint32_t count;
    uint32_t shift;                         /* their width is 1 << shift px */
    uint32_t first[DP_CELLS * DP_TILE + 1]; /* by stripe and row: its first polygon in the list */
    uint16_t inside[DP_TILE * DP_TILE]; /* by pixel: how many lie in it alone, CROWD + 1 at most */
} stripes;

/* The first and the last stripe of a box (dp_tile_polygon.box), and the bin of it in the first. */
static inline uint32_t first_stripe(const stripes *s, uint32_t box) {
    return (box & 255) >> s->shift;
}
static inline uint32_t last_stripe(const stripes *s, uint32_t box) {
    return (box >> 16 & 255) >> s->shift;
}
static inline uint32_t bin_of(uint32_t stripe, uint32_t box) {
    return stripe * DP_TILE + (box >> 8 & 255);
}

/* The pixel in which a box lies; false: it is larger. */
static inline bool pixel_of(uint32_t box, uint32_t *pixel) {
    *pixel = (box >> 8 & 255) * DP_TILE + (box & 255);
    return (box & 0xffff) == box >> 16;
}

static void count_inside(const dp_finder *w, stripes *s) {
    const uint32_t *const boxes = dp_seen_words(&w->tile, DP_SEEN_BOX);
    uint32_t pixel;
    memset(s->inside, 0, sizeof s->inside);
    for (uint32_t i = 0; i < w->tile.seen_count; i++)
        if (pixel_of(boxes[i], &pixel) && s->inside[pixel] <= CROWD) s->inside[pixel]++;
}

/* Counts the polygons of each bin, or lists them from the end of the bin's run towards its start. */
static void visit_stripes(dp_finder *w, stripes *s, bool counting) {
    const uint32_t *const boxes = dp_seen_words(&w->tile, DP_SEEN_BOX);
    const uint32_t *const flags = dp_seen_words(&w->tile, DP_SEEN_FLAGS);
    for (uint32_t i = w->tile.seen_count; i-- > 0;) {
        uint32_t pixel;
        if (!(flags[i] & DP_POLYGON_TOUCHES)) continue;
        if (pixel_of(boxes[i], &pixel) && s->inside[pixel] > CROWD) continue;
        const uint32_t last = last_stripe(s, boxes[i]);
        for (uint32_t k = first_stripe(s, boxes[i]); k <= last; k++) {
            uint32_t *const bin = &s->first[bin_of(k, boxes[i])];
            if (counting)
                ++*bin;
            else
                w->intersecting.listed[--*bin] = w->tile.seen[i];
        }
    }
}

/* So few polygons are as soon compared as sorted. */
enum { FEW = 64 };

/* Lists the tile's polygons by stripe and row (counting sort). */
static bool list_by_stripe(dp_finder *w, stripes *s) {
    uint32_t sum = 0;
    s->count = w->tile.seen_count <= FEW ? 1 : DP_CELLS;
    s->shift = (uint32_t)__builtin_ctz(DP_TILE / s->count);
    const uint32_t bins = s->count * DP_TILE;
    memset(s->first, 0, (bins + 1) * sizeof *s->first);
    count_inside(w, s);
    visit_stripes(w, s, true);
    for (uint32_t i = 0; i < bins; i++) s->first[i] = sum += s->first[i];
    s->first[bins] = sum;
    if (!DP_TILE_RESERVE(&w->tile, w, intersecting.listed, intersecting.listed_cap,
                         (size_t)sum + DP_INTERSECTING_ROOM))
        return false;
    visit_stripes(w, s, false);
    return true;
}

static bool put_stripe(dp_finder *w, const uint32_t *polygon, uint32_t count) {
    enum { OTHER = DP_POLYGON_CLIPPED | DP_POLYGON_EDGE_ON };
    dp_intersecting *const own = &w->intersecting;
    const size_t room = (size_t)count + DP_INTERSECTING_ROOM;
    own->count = count, own->stride = (uint32_t)room;
    if (!DP_TILE_RESERVE(&w->tile, own, polygon, polygon_cap, room) ||
        !DP_TILE_RESERVE(&w->tile, own, met, met_cap, room) ||
        !DP_TILE_RESERVE(&w->tile, own, members, members_cap, DP_INTERSECTING_MEMBERS * room) ||
        !DP_TILE_RESERVE(&w->tile, own, keys, keys_cap, 3 * room))
        return false;
    memcpy(own->polygon, polygon, count * sizeof *polygon);
    dp_find_kernels_for(w->tile.frame->lanes)->shapes(w, own);
    for (uint32_t i = 0; i < count; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[polygon[i]];
        if (p->points == 3 && !(p->flags & OTHER)) continue;
        put_shape(w, p, i);
        put_keys(w, p, i);
    }
    return true;
}

/* Does an edge of p have all of q on its other side on the screen? Corners that both share lie on it,
 * exactly. */
static bool parts(const dp_tile *t, const dp_tile_polygon *p, const dp_tile_polygon *q) {
    const dp_vertex *const a = t->points + p->point, *const b = t->points + q->point;
    const float turn = p->flags & DP_POLYGON_FRONT ? -1.0f : 1.0f; /* y runs down */
    for (uint32_t i = 0; i < p->points; i++) {
        const dp_vertex s = a[i], e = a[i + 1 == p->points ? 0 : i + 1];
        const float ex = turn * (e.x - s.x), ey = turn * (e.y - s.y);
        bool inside = false;
        for (uint32_t k = 0; k < q->points && !inside; k++)
            inside = ex * (b[k].y - s.y) - ey * (b[k].x - s.x) > 0;
        if (!inside) return true;
    }
    return false;
}

/* Do the two lie side by side on the screen, as neighbours on a surface do? Then they do not cross. */
static bool lie_apart(const dp_tile *t, const dp_tile_polygon *p, const dp_tile_polygon *q) {
    if ((p->flags | q->flags) & (DP_POLYGON_EDGE_ON | DP_POLYGON_CLIPPED)) return false;
    return parts(t, p, q) || parts(t, q, p);
}

/* Pairs of a stripe, but for those that an earlier one holds too; `bins`: of the stripe's rows. */
static void cross_in_stripe(dp_finder *w, const stripes *s, uint32_t stripe, const uint32_t *bins) {
    const dp_intersecting *const own = &w->intersecting;
    const uint32_t left = stripe << s->shift;
    for (uint32_t i = 0; i < own->count && !w->tile.failed; i++) {
        const uint32_t a = own->polygon[i];
        const dp_tile_polygon *const p = &w->tile.polygons[a];
        const uint32_t met =
            dp_find_kernels_for(w->tile.frame->lanes)->meet(own, i, bins[p->y1 + 1] - bins[0]);
        for (uint32_t k = 0; k < met; k++) {
            const uint32_t b = own->polygon[own->met[k]];
            const dp_tile_polygon *const q = &w->tile.polygons[b];
            if ((p->x0 < left && q->x0 < left) || lie_apart(&w->tile, p, q)) continue;
            test_pair(w, a, b);
        }
    }
}

/* No sample says where these are: all pairs are tested whose boxes meet, but in crowded pixels. */
void dp_find_crossings(dp_finder *w) {
    stripes s;
    w->intersecting.crossing_count = 0;
    if (!(w->tile.frame->lines & DP_INTERSECTION) || !list_by_stripe(w, &s)) return;
    for (uint32_t i = 0; i < s.count; i++) {
        const uint32_t *const bins = s.first + i * DP_TILE;
        const uint32_t count = bins[DP_TILE] - bins[0];
        if (count < 2) continue;
        if (!put_stripe(w, w->intersecting.listed + bins[0], count)) return;
        cross_in_stripe(w, &s, i, bins);
    }
    add_crossings(w);
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_intersecting, polygon, polygon_cap),
                                  DP_ARRAY(dp_intersecting, members, members_cap),
                                  DP_ARRAY(dp_intersecting, keys, keys_cap),
                                  DP_ARRAY(dp_intersecting, met, met_cap),
                                  DP_ARRAY(dp_intersecting, listed, listed_cap),
                                  DP_ARRAY(dp_intersecting, crossed, crossed_cap),
                                  DP_ARRAY(dp_intersecting, crossings, crossings_cap)};

void dp_intersecting_free(dp_intersecting *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_intersecting_bytes(const dp_intersecting *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
