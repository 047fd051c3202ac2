/* What a frame did, as a table for people and as JSON for programs. */
#include "commands.h"
#include "report.h"

#include <string.h>

/* The counts, in the order of the frame; both forms come from here. */
typedef struct count {
    const char *key, *text;
    size_t at; /* in dp_stats, a uint64_t */
} count;

#define AT(member) offsetof(dp_stats, member)
static const count counts[] = {
    {"polygons", "polygons", AT(polygons)},
    {"triangles", "triangles", AT(triangles)},
    {"split", "split (concave or not plane)", AT(split)},
    {"dropped", "dropped", AT(dropped)},
    {"dropped_index", "  index out of range", AT(dropped_index)},
    {"dropped_finite", "  coordinate not finite", AT(dropped_finite)},
    {"dropped_area", "  no area", AT(dropped_area)},
    {"dropped_corners", "  fewer than three corners", AT(dropped_corners)},
    {"clipped", "clipped", AT(clipped)},
    {"edges_resolved", "edges resolved by tables", AT(edges_resolved)},
    {"edges_emergent", "edges left to emerge", AT(edges_emergent)},
    {"open_edges", "open edges met", AT(open_edges)},
    {"added_polygons", "polygons added", AT(added_polygons)},
    {"edges_lost", "edges lost for want of memory", AT(edges_lost)},
    {"xray_layers", "layers of an x-ray", AT(xray_layers)},
    {"xray_lost", "  samples with more layers", AT(xray_lost)},
    {"segments", "visible segments", AT(segments)},
    {"bytes", "bytes of scratch memory", AT(bytes)},
    {"adjacency_bytes", "  adjacency", AT(adjacency_bytes)},
};

static unsigned long long value_of(const dp_stats *stats, const count *c) {
    uint64_t value;
    memcpy(&value, (const char *)stats + c->at, sizeof value);
    return value;
}

void print_stats_table(FILE *out, const tool_settings *s, const dp_stats *stats) {
    if (s->is_one_of_several) fprintf(out, "%-30s %14s\n", "model", s->model);
    if (s->model_count > 1) fprintf(out, "%-30s %14u\n", "models", s->model_count);
    for (const count *c = counts; c < counts + sizeof counts / sizeof *counts; c++)
        fprintf(out, "%-30s %14llu\n", c->text, value_of(stats, c));
    for (int k = 0; k < DP_STAGE_COUNT; k++)
        fprintf(out, "%-30s %14.2f ms\n", dp_stage_name((dp_stage)k), stats->stage_ms[k]);
    fprintf(out, "%-30s %14.2f ms\n", "frame", stats->frame_ms);
    if (stats->adjacency_ms > 0)
        fprintf(out, "%-30s %14.2f ms\n", "of it, building adjacency", stats->adjacency_ms);
    if (stats->curvature_ms > 0)
        fprintf(out, "%-30s %14.2f ms\n", "of it, making curvature", stats->curvature_ms);
}

void print_stats_json(FILE *out, const tool_settings *s, const dp_stats *stats,
                      const dp_target *target) {
    fputc('{', out);
    if (s->is_one_of_several) {
        fputs("\"model\": ", out);
        print_json_string(out, s->model);
        fputs(", ", out);
    }
    if (s->model_count > 1) fprintf(out, "\"models\": %u, ", s->model_count);
    fprintf(out, "\"width\": %u, \"height\": %u, \"samples\": %u", target->width, target->height,
            target->samples);
    for (const count *c = counts; c < counts + sizeof counts / sizeof *counts; c++)
        fprintf(out, ", \"%s\": %llu", c->key, value_of(stats, c));
    fputs(", \"stages\": {", out);
    for (int k = 0; k < DP_STAGE_COUNT; k++)
        fprintf(out, "%s\"%s\": %.3f", k ? ", " : "", dp_stage_name((dp_stage)k),
                stats->stage_ms[k]);
    fprintf(out, "}, \"frame_ms\": %.3f, \"adjacency_ms\": %.3f, \"curvature_ms\": %.3f}\n",
            stats->frame_ms, stats->adjacency_ms, stats->curvature_ms);
}

void warn_lost(const tool_settings *s, const dp_stats *stats) {
    char text[160];
    if (!stats->edges_lost) return;
    snprintf(text, sizeof text,
             "%llu edges or more could not be followed within --memory, and lines may be missing; "
             "give more",
             (unsigned long long)stats->edges_lost);
    warn_of_model(s, text);
}

void tell_empty(const char *file) {
    note("%s: no line is in it: nothing of the model is seen, or none of the lines asked for",
         file);
}

/* Does it matter that polygons are dropped? Those without area leave no hole: most programs export
 * some, and only many of them hint at a file that is broken, or flat. */
static bool is_worth_telling(const dp_stats *s) {
    return s->dropped_index || s->dropped_finite ||
           (s->dropped_area + s->dropped_corners) * 10 > s->polygons;
}

void warn_dropped(const tool_settings *s, const dp_stats *stats) {
    static const struct {
        const char *text;
        size_t at;
    } causes[] = {{"with an index out of range", AT(dropped_index)},
                  {"with a coordinate that is not finite", AT(dropped_finite)},
                  {"without area", AT(dropped_area)},
                  {"with fewer than three corners", AT(dropped_corners)}};
    char text[400] = "";
    if (!is_worth_telling(stats)) return;
    size_t length = (size_t)snprintf(
        text, sizeof text, "%llu of %llu polygons dropped: ", (unsigned long long)stats->dropped,
        (unsigned long long)stats->polygons);
    const size_t begin = length;
    for (size_t k = 0; k < sizeof causes / sizeof *causes; k++) {
        uint64_t n;
        memcpy(&n, (const char *)stats + causes[k].at, sizeof n);
        if (n)
            length +=
                (size_t)snprintf(text + length, sizeof text - length, "%s%llu %s",
                                 length > begin ? ", " : "", (unsigned long long)n, causes[k].text);
    }
    warn_of_model(s, text);
}
