/* Turns a model of sheets into batches of triangles, a block of cells at a time.
 *
 * Invariant: a point that two sheets share has the same bits in both, so that a closed model is
 * closed when vertices are compared by position. That holds because points are functions of
 * integers, weights of 0 and 1 are exact, sums of two products commute (-ffp-contract=off), and -0
 * becomes 0. Within a batch equal positions are one vertex. Triangles whose corners coincide are
 * left out, so a row of cells may shrink to a point or a line.
 *
 * Memory is two blocks for any model. Not handled: points that depend on a neighbouring sheet. */
#include "mesh/sheet.h"

#include "base/diag.h"
#include "base/elementary.h"

#include <math.h>
#include <string.h>

#ifdef DP_HOSTILE
enum { BLOCK = 3, BATCH_TRIANGLES = 64 };
#else
enum {
    BLOCK = 96,               /* cells per side */
    BATCH_TRIANGLES = 1 << 16 /* so that every default model except the terrain is one batch */
};
#endif
enum {
    BLOCK_POINTS = (BLOCK + 1) * (BLOCK + 1),
    BATCH_POINTS = BATCH_TRIANGLES / 2 + 4 * BLOCK_POINTS,
    SLOTS = 1 << 17 /* of the welding table: over twice the points */
};

typedef struct slot {
    uint32_t vertex;
    uint32_t batch; /* the slot is free unless this is the current batch */
} slot;

typedef struct generator {
    dp_model model;
    double scale;
    dp_allocator memory;
    uint32_t sheet, block_i, block_j; /* the next block */
    uint32_t batch;                   /* number of the current batch, from 1 */
    uint32_t point_count;
    uint32_t corner_count;
    float (*points)[3]; /* [BATCH_POINTS] */
    uint32_t *corners;  /* [3 * BATCH_TRIANGLES] */
    slot *slots;        /* [SLOTS] */
    uint32_t grid[BLOCK_POINTS];
} generator;

/* ---- points ---- */

void dp_between_points(const double a[3], const double b[3], uint32_t k, uint32_t n, double p[3]) {
    const double u = (double)(n - k) / n, v = (double)k / n;
    for (int c = 0; c < 3; c++) p[c] = a[c] * u + b[c] * v;
}

void dp_turn(uint32_t k, uint32_t n, double *c, double *s) {
    static const double full = 6.283185307179586;
    k %= n;
    /* Angles within an eighth of a turn of an axis, so that all quadrants round alike. */
    const uint64_t eighths = 8 * (uint64_t)k / n;
    const uint64_t quarter = (eighths + 1) / 2;                      /* the nearest axis, 0 … 4 */
    const double rest = (4.0 * k - (double)quarter * n) / (4.0 * n); /* of a turn */
    const double x = dp_cos(full * rest), y = dp_sin(full * rest);
    const double table[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
    *c = table[quarter % 4][0];
    *s = table[quarter % 4][1];
}

/* The concentric map from square to disc, ring by ring. The corner (0, 0) is at angle 0 and (n, 0)
 * at a quarter turn; sides go counter-clockwise. */
void dp_disc(uint32_t i, uint32_t j, uint32_t n, double *x, double *y) {
    const uint32_t di = i < n - i ? i : n - i, dj = j < n - j ? j : n - j;
    const uint32_t ring = di < dj ? di : dj; /* 0 is the outermost */
    const uint32_t side = n - 2 * ring;      /* cells along one side of the ring */
    *x = *y = 0;
    if (!side) return;
    const uint32_t a = i - ring, b = j - ring;
    uint32_t k;
    if (b == 0)
        k = a;
    else if (a == side)
        k = side + b;
    else if (b == side)
        k = 3 * side - a;
    else
        k = 4 * side - b;
    dp_turn(k, 4 * side, x, y);
    *x *= (double)side / n;
    *y *= (double)side / n;
}

static void loft_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                       double p[3]) {
    double a[3], b[3];
    sheet->curve(model, sheet->from, i, a);
    sheet->curve(model, sheet->to, i, b);
    dp_between_points(a, b, j, sheet->nv, p);
}

static void quad_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                       double p[3]) {
    double a[3], b[3];
    (void)model;
    dp_between_points(sheet->corner[0], sheet->corner[1], i, sheet->nu, a);
    dp_between_points(sheet->corner[3], sheet->corner[2], i, sheet->nu, b);
    dp_between_points(a, b, j, sheet->nv, p);
}

static void triangle_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                           double p[3]) {
    const double n = sheet->nu, u = i / n, v = j / n, w = (sheet->nu - i - j) / n;
    (void)model;
    for (int c = 0; c < 3; c++)
        p[c] = sheet->corner[0][c] * w + sheet->corner[1][c] * u + sheet->corner[2][c] * v;
}

/* ---- models ---- */

dp_sheet *dp_model_add(dp_model *model, uint32_t nu, uint32_t nv) {
    dp_sheet *const sheet = &model->sheets[model->sheet_count++];
    *sheet = (dp_sheet){.nu = nu, .nv = nv};
    return sheet;
}

dp_sheet *dp_model_loft(dp_model *model, dp_curve *curve, int from, int to, uint32_t nu,
                        uint32_t nv) {
    dp_sheet *const sheet = dp_model_add(model, nu, nv);
    sheet->point = loft_point;
    sheet->curve = curve;
    sheet->from = from;
    sheet->to = to;
    return sheet;
}

dp_sheet *dp_model_quad(dp_model *model, double corners[4][3], uint32_t nu, uint32_t nv) {
    dp_sheet *const sheet = dp_model_add(model, nu, nv);
    sheet->point = quad_point;
    memcpy(sheet->corner, corners, 4 * sizeof *corners);
    return sheet;
}

dp_sheet *dp_model_triangle(dp_model *model, double corners[3][3], uint32_t n) {
    dp_sheet *const sheet = dp_model_add(model, n, n);
    sheet->point = triangle_point;
    sheet->triangular = true;
    memcpy(sheet->corner, corners, 3 * sizeof *corners);
    return sheet;
}

uint64_t dp_model_triangles(const dp_model *model) {
    uint64_t sum = 0;
    for (uint32_t s = 0; s < model->sheet_count; s++) {
        const dp_sheet *const sheet = &model->sheets[s];
        sum += (uint64_t)sheet->nu * sheet->nv * (sheet->triangular ? 1 : 2);
    }
    return sum;
}

/* ---- a block of cells ---- */

static uint32_t append(generator *self, const float p[3]) {
    memcpy(self->points[self->point_count], p, 3 * sizeof *p);
    return self->point_count++;
}

/* The batch's vertex at this position. */
static uint32_t weld(generator *self, const float p[3]) {
    uint32_t bits[3];
    memcpy(bits, p, sizeof bits);
    uint64_t hash = bits[0] * 0x9E3779B97F4A7C15u ^ bits[1] * 0xC2B2AE3D27D4EB4Fu ^
                    bits[2] * 0x165667B19E3779F9u;
    hash ^= hash >> 29;
    for (uint32_t at = (uint32_t)(hash * 0xBF58476D1CE4E5B9u >> 32) & (SLOTS - 1);;
         at = (at + 1) & (SLOTS - 1)) {
        slot *const s = &self->slots[at];
        if (s->batch != self->batch) {
            *s = (slot){self->point_count, self->batch};
            return append(self, p);
        }
        if (!memcmp(self->points[s->vertex], p, 3 * sizeof *p)) return s->vertex;
    }
}

static void make_point(const generator *self, const dp_sheet *sheet, uint32_t i, uint32_t j,
                       float q[3]) {
    double p[3];
    sheet->point(&self->model, sheet, i, j, p);
    for (int c = 0; c < 3; c++) /* + 0: minus zero becomes zero */
        q[c] = (float)((p[c] - self->model.centre[c]) * self->scale) + 0.0F;
}

static void add_triangle(generator *self, bool reversed, uint32_t a, uint32_t b, uint32_t c) {
    if (a == b || b == c || c == a) return;
    uint32_t *const at = self->corners + self->corner_count;
    at[0] = a;
    at[1] = reversed ? c : b;
    at[2] = reversed ? b : c;
    self->corner_count += 3;
}

static float distance2(const generator *self, uint32_t a, uint32_t b) {
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        const float d = self->points[a][c] - self->points[b][c];
        sum += d * d;
    }
    return sum;
}

/* Adds the two triangles of a cell, split along the shorter diagonal. Of nearly equal diagonals
 * always the first, or rounding would choose at random. */
static void add_cell(generator *self, bool reversed, const uint32_t corner[4]) {
    const uint32_t a = corner[0], b = corner[1], c = corner[2], d = corner[3];
    if (distance2(self, a, c) <= 1.001F * distance2(self, b, d)) {
        add_triangle(self, reversed, a, b, c);
        add_triangle(self, reversed, a, c, d);
    } else {
        add_triangle(self, reversed, a, b, d);
        add_triangle(self, reversed, b, c, d);
    }
}

static void add_half_cell(generator *self, const dp_sheet *sheet, uint32_t rest,
                          const uint32_t corner[4]) {
    add_triangle(self, sheet->reversed, corner[0], corner[1], corner[3]);
    if (rest > 1) add_triangle(self, sheet->reversed, corner[1], corner[2], corner[3]);
}

static uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* Adds a block's points. Only those on its edge are welded, unless cells shrink to nothing. */
static void add_points(generator *self, const dp_sheet *sheet, uint32_t i0, uint32_t j0, uint32_t w,
                       uint32_t h) {
    for (uint32_t j = 0; j <= h; j++)
        for (uint32_t i = 0; i <= w; i++) {
            uint32_t *const at = self->grid + j * (w + 1) + i;
            const uint32_t left = sheet->nu - (i0 + i);
            float p[3];
            *at = 0;
            if (sheet->triangular && j0 + j > left) continue;
            make_point(self, sheet, i0 + i, j0 + j, p);
            const bool edge = !i || !j || i == w || j == h || (sheet->triangular && j0 + j == left);
            *at = edge || sheet->shrinks ? weld(self, p) : append(self, p);
        }
}

static void add_block(generator *self, const dp_sheet *sheet, uint32_t i0, uint32_t j0) {
    const uint32_t w = smaller(BLOCK, sheet->nu - i0), h = smaller(BLOCK, sheet->nv - j0);
    add_points(self, sheet, i0, j0, w, h);
    for (uint32_t j = 0; j < h; j++)
        for (uint32_t i = 0; i < w; i++) {
            const uint32_t *const row = self->grid + j * (w + 1) + i;
            const uint32_t corner[4] = {row[0], row[1], row[w + 2], row[w + 1]};
            const uint32_t along = i0 + i + j0 + j;
            if (!sheet->triangular)
                add_cell(self, sheet->reversed, corner);
            else if (along < sheet->nu)
                add_half_cell(self, sheet, sheet->nu - along, corner);
        }
}

/* ---- the source ---- */

/* Goes to the next block; after a sheet's last one, to the next sheet. */
static void advance(generator *self, const dp_sheet *sheet) {
    self->block_i += BLOCK;
    if (self->block_i < sheet->nu) return;
    self->block_i = 0;
    self->block_j += BLOCK;
    if (self->block_j < sheet->nv) return;
    self->block_j = 0;
    self->sheet++;
}

/* Could the block overflow the batch? */
static bool fits(const generator *self, const dp_sheet *sheet) {
    const uint32_t w = smaller(BLOCK, sheet->nu - self->block_i);
    const uint32_t h = smaller(BLOCK, sheet->nv - self->block_j);
    return self->corner_count + 6 * w * h <= 3 * BATCH_TRIANGLES &&
           self->point_count + (w + 1) * (h + 1) <= BATCH_POINTS;
}

/* Fills a batch with as many blocks as fit; it may have no triangle if all cells have shrunk. */
static void fill(generator *self) {
    self->batch++;
    self->point_count = self->corner_count = 0;
    while (self->sheet < self->model.sheet_count) {
        const dp_sheet *const sheet = &self->model.sheets[self->sheet];
        if (!fits(self, sheet)) break;
        add_block(self, sheet, self->block_i, self->block_j);
        advance(self, sheet);
    }
}

static dp_result generator_next(void *user, dp_batch *batch, dp_diag *diag) {
    generator *const self = user;
    (void)diag;
    do fill(self);
    while (!self->corner_count && self->sheet < self->model.sheet_count);
    *batch = (dp_batch){.positions = self->points[0],
                        .vertex_count = self->point_count,
                        .indices = self->corners,
                        .corner_count = self->corner_count,
                        .polygon_count = self->corner_count / 3};
    return DP_OK;
}

static dp_result generator_rewind(void *user, dp_diag *diag) {
    generator *const self = user;
    (void)diag;
    self->sheet = self->block_i = self->block_j = 0;
    return DP_OK;
}

static void generator_destroy(void *user) {
    generator *const self = user;
    const dp_allocator memory = self->memory;
    dp_free(&memory, self->slots);
    dp_free(&memory, self->corners);
    dp_free(&memory, self->points);
    dp_free(&memory, self);
}

dp_result dp_model_source(const dp_model *model, double scale, const dp_allocator *memory,
                          dp_source **out, dp_diag *diag) {
    generator *const self = dp_alloc_zeroed(memory, sizeof *self);
    if (!self) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a generated model");
    self->model = *model;
    self->scale = scale;
    self->memory = *memory;
    self->points = dp_alloc_array(memory, BATCH_POINTS, sizeof *self->points);
    self->corners = dp_alloc_array(memory, (size_t)3 * BATCH_TRIANGLES, sizeof *self->corners);
    self->slots = dp_alloc_zeroed(memory, SLOTS * sizeof *self->slots);
    dp_result result = DP_ERR_MEMORY;
    if (self->points && self->corners && self->slots) {
        const dp_source_callbacks callbacks = {.user = self,
                                               .next = generator_next,
                                               .rewind = generator_rewind,
                                               .destroy = generator_destroy,
                                               .up = {0, 1, 0}};
        result = dp_source_from_callbacks(&callbacks, memory, out, diag);
    } else {
        dp_fail(diag, DP_ERR_MEMORY, "out of memory for a generated model");
    }
    if (result) generator_destroy(self);
    return result;
}
