/* Statistics of a film: of its frames the median, the least and the most, of all the sum. */
#include "film_stats.h"
#include "report.h"

#include <stdlib.h>

bool film_stats_begin(film_stats *stats, uint32_t frames) {
    stats->frame_ms = calloc((size_t)frames + 1, sizeof *stats->frame_ms);
    stats->segments = calloc((size_t)frames + 1, sizeof *stats->segments);
    stats->room = frames;
    return stats->frame_ms && stats->segments;
}

void film_stats_free(film_stats *stats) {
    free(stats->frame_ms);
    free(stats->segments);
    *stats = (film_stats){0};
}

void film_stats_add(film_stats *stats, const film_frame *frame) {
    const dp_stats *const s = &frame->stats;
    if (stats->count == stats->room) return;
    stats->frame_ms[stats->count] = s->frame_ms;
    stats->segments[stats->count++] = s->segments;
    stats->empty += frame->empty;
    stats->triangles = s->triangles;
    if (!stats->dropping.polygons && (s->dropped || s->edges_lost)) stats->dropping = *s;
}

/* ---- printing ---- */

static int by_time(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int by_count(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void print_table(FILE *out, const film_stats *f) {
    const uint32_t last = f->count - 1;
    const double rate = f->seconds > 0 ? f->count / f->seconds : 0;
    fprintf(out, "%-30s %14u\n", "frames drawn", f->count);
    fprintf(out, "%-30s %14u\n", "jobs", f->jobs);
    fprintf(out, "%-30s %14u\n", "threads of each", f->threads);
    fprintf(out, "%-30s %14llu\n", "triangles", (unsigned long long)f->triangles);
    fprintf(out, "%-30s %14llu\n", "visible segments, median",
            (unsigned long long)f->segments[last / 2]);
    fprintf(out, "%-30s %14.2f ms\n", "frame, median", f->frame_ms[last / 2]);
    fprintf(out, "%-30s %14.2f ms\n", "  least", f->frame_ms[0]);
    fprintf(out, "%-30s %14.2f ms\n", "  most", f->frame_ms[last]);
    fprintf(out, "%-30s %14.2f s\n", "the whole film", f->seconds);
    fprintf(out, "%-30s %14.2f\n", "frames a second", rate);
}

static void print_json(FILE *out, const tool_settings *s, const film_stats *f) {
    const uint32_t last = f->count - 1;
    fputc('{', out);
    if (s->is_one_of_several) {
        fputs("\"model\": ", out);
        print_json_string(out, s->model);
        fputs(", ", out);
    }
    fprintf(out, "\"frames\": %u, \"width\": %u, \"height\": %u, \"samples\": %u", f->count,
            f->width, f->height, f->samples);
    fprintf(out, ", \"jobs\": %u, \"threads\": %u, \"triangles\": %llu, \"segments\": %llu",
            f->jobs, f->threads, (unsigned long long)f->triangles,
            (unsigned long long)f->segments[last / 2]);
    fprintf(out, ", \"frame_ms\": %.3f, \"frame_ms_min\": %.3f, \"frame_ms_max\": %.3f",
            f->frame_ms[last / 2], f->frame_ms[0], f->frame_ms[last]);
    fprintf(out, ", \"seconds\": %.3f, \"frames_per_second\": %.3f}\n", f->seconds,
            f->seconds > 0 ? f->count / f->seconds : 0);
}

void film_stats_print(const tool_settings *s, film_stats *f, FILE *out) {
    if (!f->count || !s->stats) return;
    qsort(f->frame_ms, f->count, sizeof *f->frame_ms, by_time);
    qsort(f->segments, f->count, sizeof *f->segments, by_count);
    if (s->stats == STATS_TABLE) print_table(stderr, f);
    if (s->stats == STATS_JSON) print_json(out, s, f);
}
