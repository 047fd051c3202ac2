/* drypoint info MODEL...: what each model contains, and which of its polygons drawing would drop. */
#include "clips.h"
#include "commands.h"
#include "edges.h"
#include "models.h"
#include "progress.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct line {
    const char *key, *text;
    uint64_t value;
} line;

enum { LINES = 10 };

static void fill_lines(const dp_extent *e, const edge_counts *edges, line lines[LINES]) {
    const uint64_t dropped = edges->index + edges->finite + edges->area + edges->corners;
    const line filled[LINES] = {
        {"polygons", "polygons", e->polygons},
        {"corners", "corners", e->corners},
        {"vertices", "vertices", e->vertices},
        {"open_edges", "open edges met", edges->open},
        {"manifold_breaks", "edges of more than two polygons", edges->crowded},
        {"dropped", "would be dropped", dropped},
        {"dropped_index", "  index out of range", edges->index},
        {"dropped_finite", "  coordinate not finite", edges->finite},
        {"dropped_area", "  no area", edges->area},
        {"dropped_corners", "  fewer than three corners", edges->corners},
    };
    memcpy(lines, filled, sizeof filled);
}

/* Digits of a coordinate: those of a float32, or, where there is more to tell, as many as its
 * positions have about their origin. */
static int digits_of(double v, double spacing) {
    if (v == (double)(float)v || !(spacing > 0)) return 9;
    const double digits = floor(log10(fabs(v))) + 1 + floor(-log10(spacing));
    return (int)fmin(fmax(digits, 9), 17);
}

static void print_place(const char *before, const char *between, const char *after,
                        const double p[3], double spacing) {
    fputs(before, stdout);
    for (int k = 0; k < 3; k++) printf("%s%.*g", k ? between : "", digits_of(p[k], spacing), p[k]);
    fputs(after, stdout);
}

static void print_table(const tool_settings *s, const dp_source *source, const dp_extent *e,
                        const line lines[LINES]) {
    double up[3];
    const bool said = dp_source_up(source, up);
    printf("%-32s %s\n", "model", s->model);
    for (int k = 0; k < LINES; k++)
        printf("%-32s %llu\n", lines[k].text, (unsigned long long)lines[k].value);
    printf("%-32s ", "bounds from");
    print_place("", " ", "\n", e->exact_min, e->spacing);
    printf("%-32s ", "bounds to");
    print_place("", " ", "\n", e->exact_max, e->spacing);
    printf("%-32s %.9g x %.9g x %.9g\n", "size", e->exact_max[0] - e->exact_min[0],
           e->exact_max[1] - e->exact_min[1], e->exact_max[2] - e->exact_min[2]);
    printf("%-32s %.9g %.9g %.9g%s\n", "up", up[0], up[1], up[2],
           said ? "" : " (as is usual: the file does not say)");
    clips_print_table(source);
}

static void print_json(const tool_settings *s, const dp_source *source, const dp_extent *e,
                       const line lines[LINES]) {
    double up[3];
    const bool said = dp_source_up(source, up);
    printf("{\"model\": ");
    print_json_string(stdout, s->model);
    for (int k = 0; k < LINES; k++)
        printf(", \"%s\": %llu", lines[k].key, (unsigned long long)lines[k].value);
    print_place(", \"min\": [", ", ", "]", e->exact_min, e->spacing);
    print_place(", \"max\": [", ", ", "]", e->exact_max, e->spacing);
    printf(", \"up\": [%.9g, %.9g, %.9g], \"up_said\": %s", up[0], up[1], up[2],
           said ? "true" : "false");
    clips_print_json(source);
    puts("}");
}

static int inspect(const tool_settings *s, dp_source *source) {
    dp_extent extent, whole;
    edge_counts edges;
    dp_diag diag = {0};
    progress_begin("counting edges", s->quiet);
    dp_result result = dp_source_extent(source, &whole, &diag);
    if (!result) result = count_edges(source, &extent, &edges, &diag);
    progress_end();
    if (result) {
        report_model(s, &diag);
        return EXIT_FAILED;
    }
    if (!extent.polygons) {
        wrong_usage("%s: there are no polygons in it; give a model with faces", s->model);
        return EXIT_FAILED;
    }
    const char *const remark = dp_source_remark(source);
    if (remark && !s->quiet) warn_of_model(s, remark);
    line lines[LINES];
    warn_coarse(s, &whole);
    extent.spacing = whole.spacing;
    fill_lines(&extent, &edges, lines);
    if (s->number && !s->json) fputc('\n', stdout);
    if (s->json)
        print_json(s, source, &extent, lines);
    else
        print_table(s, source, &extent, lines);
    return 0;
}

static int inform(const tool_settings *s) {
    dp_source *source = NULL;
    int code = open_model(s, &source);
    if (!code) code = inspect(s, source);
    dp_source_destroy(source);
    return code;
}

int command_info(const tool_settings *s) { return models_each(s, inform); }
