/* Agreement of two lists of segments: lengths are added up by class and pair of polygons. */
#include "gl/agree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct row {
    uint64_t low, high;
    int line;
    double length[2];
    const dp_segment *one;
} row;

static int by_pair(const void *left, const void *right) {
    const row *const a = left, *const b = right;
    if (a->line != b->line) return a->line < b->line ? -1 : 1;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return a->high < b->high ? -1 : a->high > b->high;
}

static int by_difference(const void *left, const void *right) {
    const row *const a = left, *const b = right;
    const double p = fabs(a->length[0] - a->length[1]), q = fabs(b->length[0] - b->length[1]);
    return p > q ? -1 : p < q;
}

static double length_of(const dp_segment *s) {
    const double x = (double)s->b[0] - (double)s->a[0], y = (double)s->b[1] - (double)s->a[1];
    return sqrt(x * x + y * y);
}

static row *rows_of(const dp_segment *const lists[2], const size_t counts[2], dp_line line,
                    size_t *count) {
    row *const rows = malloc((counts[0] + counts[1] + 1) * sizeof *rows);
    size_t n = 0, last = 0;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < counts[k]; i++) {
            const dp_segment *const s = &lists[k][i];
            if (line != DP_LINE_COUNT && s->line != line) continue;
            row *const r = &rows[n++];
            *r = (row){s->polygon < s->other ? s->polygon : s->other,
                       s->polygon < s->other ? s->other : s->polygon,
                       s->line,
                       {0, 0},
                       s};
            r->length[k] = length_of(s);
        }
    qsort(rows, n, sizeof *rows, by_pair);
    for (size_t i = 0; i < n; i++) {
        if (last && !by_pair(&rows[last - 1], &rows[i])) {
            rows[last - 1].length[0] += rows[i].length[0];
            rows[last - 1].length[1] += rows[i].length[1];
        } else {
            rows[last++] = rows[i];
        }
    }
    *count = last;
    return rows;
}

agreement agree(const dp_segment *a, size_t a_count, const dp_segment *b, size_t b_count,
                dp_line line) {
    agreement g = {0};
    size_t count;
    row *const rows =
        rows_of((const dp_segment *[]){a, b}, (const size_t[]){a_count, b_count}, line, &count);
    for (size_t i = 0; i < count; i++) {
        const double *const l = rows[i].length, most = fmax(l[0], l[1]);
        g.length[0] += l[0], g.length[1] += l[1];
        g.all += most, g.common += fmin(l[0], l[1]);
        if (fabs(l[0] - l[1]) <= 0.5) g.alike += most;
    }
    free(rows);
    return g;
}

double agree_share(const agreement *g) { return g->all > 0 ? g->alike / g->all : 1; }

void agree_print(const dp_segment *a, size_t a_count, const dp_segment *b, size_t b_count,
                 dp_line line, size_t most) {
    size_t count;
    row *const rows =
        rows_of((const dp_segment *[]){a, b}, (const size_t[]){a_count, b_count}, line, &count);
    qsort(rows, count, sizeof *rows, by_difference);
    for (size_t i = 0; i < count && i < most; i++)
        printf("    %-12s %llu/%lld edge %u: %.2f, %.2f px at (%.2f, %.2f) to (%.2f, %.2f)\n",
               dp_line_name((dp_line)rows[i].line), (unsigned long long)rows[i].one->polygon,
               (long long)rows[i].one->other, rows[i].one->edge, rows[i].length[0],
               rows[i].length[1], (double)rows[i].one->a[0], (double)rows[i].one->a[1],
               (double)rows[i].one->b[0], (double)rows[i].one->b[1]);
    free(rows);
}
