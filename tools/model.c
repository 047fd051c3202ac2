/* Opening models for every command: files, standard input, generated shapes. */
#include "commands.h"
#include "keep.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char scheme[] = "shape:";

static bool is_shape(const char *name) {
    for (uint32_t k = 0; k < dp_shape_count(); k++)
        if (!strcmp(name, dp_shape_name(k))) return true;
    return false;
}

/* shape:NAME or shape:NAME:TRIANGLES */
static int open_shape(const char *text, dp_source **out) {
    char name[64];
    const char *const colon = text + strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)(colon - text), text);
    dp_shape shape = {.name = name};
    if (*colon) {
        const option count = {.name = "triangles",
                              .kind = OPTION_COUNT64,
                              .at = offsetof(tool_settings, triangles),
                              .least = 1,
                              .most = 1e11};
        tool_settings parsed;
        if (!option_store(&count, colon + 1, &parsed)) return EXIT_USAGE;
        shape.triangles = parsed.triangles;
    }
    dp_diag diag;
    if (!dp_source_from_shape(&shape, out, &diag)) return 0;
    return report_failure(NULL, &diag);
}

int open_model(const tool_settings *s, dp_source **out) {
    *out = NULL;
    if (!strncmp(s->model, scheme, sizeof scheme - 1))
        return open_shape(s->model + sizeof scheme - 1, out);
    struct stat status;
    const bool standard = !strcmp(s->model, "-");
    if (!standard && is_shape(s->model) && stat(s->model, &status)) {
        wrong_usage("%s: there is no such file; did you mean shape:%s, or \"drypoint make %s -o "
                    "%s.ply\"?",
                    s->model, s->model, s->model, s->model);
        return EXIT_FAILED;
    }
    const dp_file_options options = {.progress = progress_report};
    dp_diag diag = {0};
    progress_begin("reading", s->quiet);
    dp_result result = dp_io_open(s->model, &options, out, &diag);
    if (!result && !dp_source_rewindable(*out)) result = keep_source(out, &diag);
    progress_end();
    if (!result) return 0;
    report_failure(standard ? "standard input" : s->model, &diag);
    return EXIT_FAILED;
}

int measure_model(const tool_settings *s, dp_source *source, dp_extent *extent) {
    const char *const name = strcmp(s->model, "-") ? s->model : "standard input";
    dp_diag diag = {0};
    if (dp_source_extent(source, extent, &diag)) {
        report_failure(name, &diag);
        return EXIT_FAILED;
    }
    if (extent->polygons > extent->not_finite + extent->bad_index) return 0;
    if (!extent->polygons)
        wrong_usage("%s: there are no polygons in it; give a model with faces", name);
    else
        wrong_usage(
            "%s: none of its %llu polygons can be drawn: %llu have coordinates that are not "
            "numbers, %llu name a vertex that is not there; mend the file",
            name, (unsigned long long)extent->polygons, (unsigned long long)extent->not_finite,
            (unsigned long long)extent->bad_index);
    return EXIT_FAILED;
}
