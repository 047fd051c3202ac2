/* Scoring: pieces of truth are painted as capsules into masks (what ink may cover, what it must),
 * and samples of truth look for ink across the line.
 *
 * Which classes count: wanted ones must be there; neutral ones may. An edge that is a border or a
 * silhouette may also come out where ridges or valleys were asked for alone (Raskar 2001, section
 * 3), so there these are neutral. */
#include "score.h"

#include "mesh.h"

#include <stdlib.h>
#include <string.h>

#define REACH     1.0  /* px across the line in which ink is looked for */
#define INKED     0.4  /* coverage that counts as ink there */
#define UNCOVERED 0.3  /* coverage under which a pixel of the ideal stroke is uncovered */
#define STRAY     1.5  /* px beyond a line's border where ink may be */
#define GRAIN     0.25 /* px between the points of a segment */
#define ACROSS    0.1  /* px between the points of a profile */
#define AVERAGED  32   /* samples (a quarter px each) that one width is averaged over */
#define CELL      4.0  /* px, of the grid of points */

static bool wanted(uint32_t lines, unsigned kind) {
    return kind < DP_LINE_COUNT && (lines >> kind & 1);
}

static bool neutral(uint32_t lines, unsigned kind) {
    const uint32_t creases = DP_RIDGE | DP_VALLEY;
    if (kind == REF_NEUTRAL) return true;
    if (wanted(lines, kind)) return false;
    if (kind == DP_LINE_SILHOUETTE) return lines & creases;
    return kind == DP_LINE_BORDER && lines & (creases | DP_SILHOUETTE);
}

/* How far from a piece's spine ink may be, px. */
static double reach_of(uint32_t lines, unsigned kind, double px) {
    if (!wanted(lines, kind)) return px + STRAY + 1;
    return kind == DP_LINE_SILHOUETTE ? px + STRAY : px / 2 + STRAY;
}

/* Squared distance of a point from a piece, and where along it the foot is. */
static double distance2(const ref_piece *piece, double x, double y, double *along) {
    const double dx = piece->b[0] - piece->a[0], dy = piece->b[1] - piece->a[1];
    const double length2 = dx * dx + dy * dy;
    double t = 0;
    if (length2 > 0) t = ((x - piece->a[0]) * dx + (y - piece->a[1]) * dy) / length2;
    t = fmin(fmax(t, 0), 1);
    x -= piece->a[0] + t * dx;
    y -= piece->a[1] + t * dy;
    *along = t;
    return x * x + y * y;
}

/* The pixels whose centres may be within `radius` of a piece. */
typedef struct window {
    long x0, y0, x1, y1; /* px, the last ones excluded */
} window;

static window window_of(const ref_truth *truth, const ref_piece *piece, double radius) {
    const double w = truth->width, h = truth->height;
    return (window){.x0 = (long)fmin(fmax(fmin(piece->a[0], piece->b[0]) - radius, 0), w),
                    .y0 = (long)fmin(fmax(fmin(piece->a[1], piece->b[1]) - radius, 0), h),
                    .x1 = (long)fmin(fmax(fmax(piece->a[0], piece->b[0]) + radius + 1, 0), w),
                    .y1 = (long)fmin(fmax(fmax(piece->a[1], piece->b[1]) + radius + 1, 0), h)};
}

/* What is painted for every pixel. */
typedef struct masks {
    uint8_t *near; /* ink may be here */
    float *ideal;  /* depth of the nearest spine whose ideal stroke this is in, or 0 */
    float *ink;    /* coverage */
} masks;

static void paint(const ref_truth *truth, const ref_piece *piece, double radius, double inner,
                  const masks *mask) {
    const window box = window_of(truth, piece, radius);
    for (long y = box.y0; y < box.y1; y++) {
        for (long x = box.x0; x < box.x1; x++) {
            const size_t at = (size_t)y * truth->width + (size_t)x;
            double along;
            const double far = distance2(piece, x + 0.5, y + 0.5, &along);
            if (far <= radius * radius) mask->near[at] = 1;
            if (inner <= 0 || far > inner * inner) continue;
            const float depth = (float)(piece->a[2] + (piece->b[2] - piece->a[2]) * along);
            if (mask->ideal[at] == 0 || depth < mask->ideal[at]) mask->ideal[at] = depth;
        }
    }
}

static void paint_all(const ref_truth *truth, uint32_t lines, double px, const masks *mask) {
    for (size_t i = 0; i < truth->piece_count; i++) {
        const ref_piece *piece = &truth->pieces[i];
        const bool want = wanted(lines, piece->kind);
        if (!want && !neutral(lines, piece->kind)) continue;
        const bool ideal = want && piece->kind != DP_LINE_SILHOUETTE;
        paint(truth, piece, reach_of(lines, piece->kind, px), ideal ? px / 2 - 1 : 0, mask);
    }
}

static void read_ink(const ref_truth *truth, const uint8_t *rgba, float *ink) {
    for (size_t i = 0; i < (size_t)truth->width * truth->height; i++) {
        const uint8_t *p = rgba + 4 * i;
        const double light = (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255;
        ink[i] = (float)(p[3] / 255.0 * (1 - light));
    }
}

/* Bilinear between the pixels' centres; nothing outside. */
static double ink_at(const ref_truth *truth, const float *ink, double x, double y) {
    const long w = truth->width, h = truth->height;
    const double cx = floor(x - 0.5), cy = floor(y - 0.5);
    const double fx = x - 0.5 - cx, fy = y - 0.5 - cy;
    double sum = 0;
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            const long px = (long)cx + i, py = (long)cy + j;
            if (px < 0 || py < 0 || px >= w || py >= h) continue;
            sum += ink[py * w + px] * (i ? fx : 1 - fx) * (j ? fy : 1 - fy);
        }
    }
    return sum;
}

static bool has_ink(const ref_truth *truth, const float *ink, const ref_sample *s) {
    for (double o = -REACH; o <= REACH; o += 0.25) {
        if (ink_at(truth, ink, s->x + s->nx * o, s->y + s->ny * o) > INKED) return true;
    }
    return false;
}

/* Ink across the line at a sample: from its middle out to where it ends on both sides. */
static double width_at(const ref_truth *truth, const float *ink, const ref_sample *s, double px) {
    double sum = 0;
    for (int side = -1; side <= 1; side += 2) {
        double here = 1;
        for (double o = ACROSS / 2; o < px + STRAY && here > 0.01; o += ACROSS) {
            here = ink_at(truth, ink, s->x + side * s->nx * o, s->y + side * s->ny * o);
            sum += ACROSS * here;
        }
    }
    return sum;
}

/* For every pixel the line that has a sample there, plus 1, or 0. */
static uint32_t *mark_lines(const ref_truth *truth, uint32_t lines) {
    uint32_t *marks = calloc((size_t)truth->width * truth->height, sizeof *marks);
    if (marks == NULL) abort();
    for (size_t i = 0; i < truth->sample_count; i++) {
        const ref_sample *s = &truth->samples[i];
        if (!s->inside || !(wanted(lines, s->kind) || neutral(lines, s->kind))) continue;
        marks[(size_t)s->y * truth->width + (size_t)s->x] = s->line + 1;
    }
    return marks;
}

/* Whether no other line is so near that their strokes could touch. */
static bool stands_alone(const ref_truth *truth, const uint32_t *marks, const ref_sample *s,
                         double px) {
    for (double o = -px - STRAY; o <= px + STRAY; o += 0.5) {
        const double x = floor(s->x + s->nx * o), y = floor(s->y + s->ny * o);
        if (x < 0 || y < 0 || x >= truth->width || y >= truth->height) return false;
        const uint32_t mark = marks[(size_t)y * truth->width + (size_t)x];
        if (mark != 0 && mark != s->line + 1) return false;
    }
    return true;
}

static int by_value(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static void measure_widths(const ref_truth *truth, const float *ink, uint32_t lines, double px,
                           score *out) {
    double *widths = malloc((truth->sample_count + 1) * sizeof *widths);
    double *means = malloc((truth->sample_count + 1) * sizeof *means);
    uint32_t *marks = mark_lines(truth, lines);
    double run = 0;
    size_t count = 0, mean_count = 0, in_run = 0;
    uint32_t line = UINT32_MAX;
    if (widths == NULL || means == NULL) abort();
    for (size_t i = 0; i < truth->sample_count; i++) {
        const ref_sample *s = &truth->samples[i];
        if (!wanted(lines, s->kind) || !s->inside || s->length <= 4 * px) continue;
        if (s->along <= 0.25f || s->along >= 0.75f) continue;
        if (!stands_alone(truth, marks, s, px)) continue;
        const double width = width_at(truth, ink, s, px);
        if (s->line != line) run = 0, in_run = 0;
        line = s->line;
        widths[count++] = width;
        run += width;
        if (++in_run < AVERAGED) continue;
        means[mean_count++] = run / AVERAGED;
        run = 0, in_run = 0;
    }
    qsort(widths, count, sizeof *widths, by_value);
    qsort(means, mean_count, sizeof *means, by_value);
    out->width_samples = count;
    if (count > 0) out->width_median = widths[count / 2];
    if (mean_count > 0) {
        out->width_low = means[mean_count * 2 / 100];
        out->width_high = means[mean_count * 98 / 100];
    }
    free(widths);
    free(means);
    free(marks);
}

static void measure_recall(const ref_truth *truth, const float *ink, uint32_t lines, score *out) {
    size_t found = 0;
    for (size_t i = 0; i < truth->sample_count; i++) {
        const ref_sample *s = &truth->samples[i];
        if (!s->inside || !wanted(lines, s->kind)) continue;
        out->samples++;
        found += has_ink(truth, ink, s);
    }
    out->recall = out->samples > 0 ? (double)found / (double)out->samples : 1;
}

/* Whether the surface in the middle of a pixel is several line widths nearer than a spine. */
static bool hidden(const ref_truth *truth, size_t at, double depth, double px) {
    const double x = (double)(at % truth->width) + 0.5, y = (double)(at / truth->width) + 0.5;
    const double slack = 3 * px * ref_truth_pixel(truth, depth);
    return ref_truth_surface(truth, x, y) < depth - slack;
}

static void measure_masks(const ref_truth *truth, const masks *mask, double px, score *out) {
    size_t ideal = 0, empty = 0, cracked = 0;
    for (size_t i = 0; i < (size_t)truth->width * truth->height; i++) {
        out->ink += (double)mask->ink[i];
        if (!mask->near[i]) out->stray += (double)mask->ink[i];
        if (mask->ideal[i] == 0) continue;
        ideal++;
        if (mask->ink[i] >= (float)UNCOVERED) continue;
        empty++;
        cracked += !hidden(truth, i, (double)mask->ideal[i], px);
    }
    out->precision = out->ink > 0 ? 1 - out->stray / out->ink : 1;
    out->uncovered = ideal > 0 ? (double)empty / (double)ideal : 0;
    out->cracks = ideal > 0 ? (double)cracked / (double)ideal : 0;
}

score score_picture(const ref_truth *truth, const uint8_t *rgba, uint32_t lines, double px) {
    const size_t pixels = (size_t)truth->width * truth->height;
    const masks mask = {calloc(pixels, 1), calloc(pixels, sizeof(float)),
                        calloc(pixels, sizeof(float))};
    score out = {0};
    if (mask.near == NULL || mask.ideal == NULL || mask.ink == NULL) abort();
    read_ink(truth, rgba, mask.ink);
    paint_all(truth, lines, px, &mask);
    measure_recall(truth, mask.ink, lines, &out);
    measure_masks(truth, &mask, px, &out);
    measure_widths(truth, mask.ink, lines, px, &out);
    free(mask.near);
    free(mask.ideal);
    free(mask.ink);
    return out;
}

/* Points in a grid of square cells, for "is one within r". */
typedef struct point {
    float x, y;
} point;

typedef struct point_grid {
    point *points;
    size_t count, room;
    uint32_t *starts; /* per cell, and the end: into `sorted` */
    point *sorted;
    long columns, rows;
} point_grid;

static void grid_add(point_grid *grid, double x, double y) {
    mesh_reserve(&grid->points, &grid->room, grid->count + 1, sizeof *grid->points);
    grid->points[grid->count++] = (point){(float)x, (float)y};
}

static long cell_of(const point_grid *grid, double x, double y) {
    const double cx = floor((x + REF_MARGIN) / CELL), cy = floor((y + REF_MARGIN) / CELL);
    const long column = (long)fmin(fmax(cx, 0), (double)grid->columns - 1);
    const long row = (long)fmin(fmax(cy, 0), (double)grid->rows - 1);
    return row * grid->columns + column;
}

static void grid_sort(point_grid *grid, const ref_truth *truth) {
    grid->columns = (long)((truth->width + 2 * REF_MARGIN) / CELL) + 1;
    grid->rows = (long)((truth->height + 2 * REF_MARGIN) / CELL) + 1;
    grid->starts = calloc((size_t)(grid->columns * grid->rows) + 2, sizeof *grid->starts);
    grid->sorted = malloc((grid->count + 1) * sizeof *grid->sorted);
    if (grid->starts == NULL || grid->sorted == NULL) abort();
    uint32_t *const next = grid->starts + 1; /* counts, then ends, shifted by one */
    for (size_t i = 0; i < grid->count; i++)
        next[cell_of(grid, (double)grid->points[i].x, (double)grid->points[i].y) + 1]++;
    for (long c = 0; c < grid->columns * grid->rows; c++) next[c + 1] += next[c];
    for (size_t i = 0; i < grid->count; i++) {
        const point p = grid->points[i];
        grid->sorted[next[cell_of(grid, (double)p.x, (double)p.y)]++] = p;
    }
}

static bool grid_near(const point_grid *grid, double x, double y, double radius) {
    for (int j = -1; j <= 1; j++) {
        const long from = cell_of(grid, x - radius, y + j * radius);
        const long to = cell_of(grid, x + radius, y + j * radius);
        for (uint32_t i = grid->starts[from]; i < grid->starts[to + 1]; i++) {
            const point p = grid->sorted[i];
            if (hypot((double)p.x - x, (double)p.y - y) <= radius) return true;
        }
    }
    return false;
}

static void grid_free(point_grid *grid) {
    free(grid->points);
    free(grid->starts);
    free(grid->sorted);
}

static void collect_segments(point_grid *grid, const dp_segment *segments, size_t count,
                             dp_line line) {
    for (size_t i = 0; i < count; i++) {
        const dp_segment *s = &segments[i];
        if (s->line != line) continue;
        const double ax = (double)s->a[0], ay = (double)s->a[1];
        const double dx = (double)s->b[0] - ax, dy = (double)s->b[1] - ay;
        const double length = hypot(dx, dy);
        if (!(length < 1e5)) continue; /* nonsense finds nothing */
        const size_t steps = (size_t)(length / GRAIN) + 1;
        for (size_t k = 0; k < steps; k++) {
            const double u = ((double)k + 0.5) / (double)steps;
            grid_add(grid, ax + dx * u, ay + dy * u);
        }
    }
}

score score_segments(const ref_truth *truth, const dp_segment *segments, size_t count,
                     dp_line line) {
    const uint32_t lines = 1u << line;
    point_grid found = {0}, real = {0};
    score out = {0};
    size_t hits = 0, good = 0, total = 0;
    collect_segments(&found, segments, count, line);
    for (size_t i = 0; i < truth->sample_count; i++) {
        const ref_sample *s = &truth->samples[i];
        if (wanted(lines, s->kind) || neutral(lines, s->kind))
            grid_add(&real, (double)s->x, (double)s->y);
    }
    grid_sort(&found, truth);
    grid_sort(&real, truth);
    for (size_t i = 0; i < truth->sample_count; i++) {
        const ref_sample *s = &truth->samples[i];
        if (!s->inside || !wanted(lines, s->kind)) continue;
        out.samples++;
        hits += grid_near(&found, (double)s->x, (double)s->y, REACH);
    }
    for (size_t i = 0; i < found.count; i++) {
        const double x = (double)found.points[i].x, y = (double)found.points[i].y;
        if (x < 0 || y < 0 || x > truth->width || y > truth->height) continue;
        total++;
        good += grid_near(&real, x, y, STRAY);
    }
    out.recall = out.samples > 0 ? (double)hits / (double)out.samples : 1;
    out.precision = total > 0 ? (double)good / (double)total : 1;
    out.ink = (double)total * GRAIN;
    out.stray = (double)(total - good) * GRAIN;
    grid_free(&found);
    grid_free(&real);
    return out;
}

void score_draw_truth(const ref_truth *truth, uint32_t lines, double px, double dx, double dy,
                      uint8_t *rgba) {
    memset(rgba, 255, (size_t)4 * truth->width * truth->height);
    for (size_t i = 0; i < truth->piece_count; i++) {
        ref_piece piece = truth->pieces[i];
        if (!wanted(lines, piece.kind)) continue;
        piece.a[0] += dx, piece.b[0] += dx;
        piece.a[1] += dy, piece.b[1] += dy;
        const window box = window_of(truth, &piece, px / 2 + 1);
        for (long y = box.y0; y < box.y1; y++) {
            for (long x = box.x0; x < box.x1; x++) {
                uint8_t *p = rgba + 4 * ((size_t)y * truth->width + (size_t)x);
                double along;
                const double far = sqrt(distance2(&piece, x + 0.5, y + 0.5, &along));
                const double light = 1 - fmin(fmax(px / 2 - far + 0.5, 0), 1);
                const uint8_t value = (uint8_t)(light * 255 + 0.5);
                if (value < p[0]) p[0] = p[1] = p[2] = value;
            }
        }
    }
}
