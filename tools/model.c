/* Opens models for every command: files, standard input, generated shapes; several as one scene. */
#include "clips.h"
#include "commands.h"
#include "deform.h"
#include "film.h"
#include "keep.h"
#include "models.h"
#include "objects.h"
#include "progress.h"
#include "report.h"
#include "section.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

static const char scheme[] = "shape:";
static const char no_polygons[] = "%s: there are no polygons in it; give a model with faces";
static const double default_memory = 256.0 * (1 << 20); /* bytes, as dp_context_desc.memory */

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

/* Can the model be drawn without knowing its extent, and in one reading? */
static bool is_drawn_unseen(const tool_settings *s) {
    return s->command == COMMAND_DRAW && s->passes == 1 && s->has_eye && s->has_target &&
           s->ink != 2 && !s->has_deform && !s->morph && !objects_asked(s);
}

static int open_named(const tool_settings *s, const char *model, dp_source **out) {
    struct stat status;
    if (!strncmp(model, scheme, sizeof scheme - 1))
        return open_shape(model + sizeof scheme - 1, out);
    if (strcmp(model, "-") && is_shape(model) && stat(model, &status)) {
        wrong_usage("%s: there is no such file; did you mean shape:%s, or \"drypoint make %s -o "
                    "%s.ply\"?",
                    model, model, model, model);
        return EXIT_FAILED;
    }
    dp_diag diag = {0};
    progress_begin("reading", s->quiet);
    dp_result result = open_file(s, model, out, &diag);
    if (!result && !dp_source_rewindable(*out) && (film_wanted(s) || !is_drawn_unseen(s)))
        result = keep_source(out, s->memory > 0 ? s->memory : default_memory, &diag);
    progress_end();
    if (!result) return 0;
    report_failure(model_spoken(model), &diag);
    return EXIT_FAILED;
}

/* Opens a model, and plays its animation. */
static int open_one(const tool_settings *s, const char *model, clips_tally *tally,
                    dp_source **out) {
    int code = open_named(s, model, out);
    if (!code) code = clips_play(s, *out, tally);
    if (code) dp_source_destroy(*out), *out = NULL;
    return code;
}

/* ---- scenes ---- */

/* An STL file stays open while the scene is there. */
static void allow_many_files(void) {
    struct rlimit files;
    if (getrlimit(RLIMIT_NOFILE, &files)) return;
    files.rlim_cur = files.rlim_max;
    setrlimit(RLIMIT_NOFILE, &files);
}

/* A scene is not drawn without one of its models: looks for a first polygon in each. */
static int check_not_empty(const char *model, dp_source *source) {
    dp_batch batch;
    dp_diag diag = {0};
    if (!dp_source_rewindable(source)) return 0;
    dp_result result = dp_source_next(source, &batch, &diag);
    const bool empty = !result && !batch.polygon_count;
    if (!result) result = dp_source_rewind(source, &diag);
    if (empty) wrong_usage(no_polygons, model_spoken(model));
    if (result) report_failure(model_spoken(model), &diag);
    return empty || result ? EXIT_FAILED : 0;
}

static int join(const tool_settings *s, dp_source **parts, dp_source **out) {
    const char **const names = calloc(s->model_count, sizeof *names);
    dp_diag diag = {.result = DP_ERR_MEMORY};
    for (uint32_t k = 0; names && k < s->model_count; k++) names[k] = model_spoken(s->models[k]);
    const dp_result result =
        names ? dp_source_join(parts, names, s->model_count, NULL, out, &diag) : DP_ERR_MEMORY;
    free(names);
    return result ? report_failure(NULL, &diag) : 0;
}

static int open_scene(const tool_settings *s, clips_tally *tally, dp_source **out) {
    dp_source **const parts = calloc(s->model_count, sizeof *parts);
    int code = parts ? 0 : EXIT_FAILED;
    if (code) wrong_usage("out of memory for %u models", s->model_count);
    allow_many_files();
    for (uint32_t k = 0; k < s->model_count && !code; k++) {
        code = open_one(s, s->models[k], tally, &parts[k]);
        if (!code) code = check_not_empty(s->models[k], parts[k]);
    }
    if (!code) code = join(s, parts, out);
    for (uint32_t k = 0; parts && k < s->model_count && code; k++) dp_source_destroy(parts[k]);
    free(parts);
    return code;
}

/* Moves the model to --time. */
static int move_model(const tool_settings *s, dp_source **source) {
    dp_diag diag = {0};
    if (!s->has_time || !dp_source_set_time(*source, s->time[0], &diag)) return 0;
    report_failure(s->model_count > 1 ? NULL : model_spoken(s->model), &diag);
    dp_source_destroy(*source);
    *source = NULL;
    return EXIT_FAILED;
}

/* Deforms and blends the model, all parts of a scene as one. */
static int reshape_model(const tool_settings *s, clips_tally *tally, dp_source **source) {
    dp_source *other = NULL;
    const int code = s->morph ? open_one(s, s->morph, tally, &other) : 0;
    if (!code) return deform_model(s, source, other);
    dp_source_destroy(*source);
    *source = NULL;
    return code;
}

int open_model(const tool_settings *s, dp_source **out) {
    clips_tally tally = {0};
    object_places places = {0};
    *out = NULL;
    int code =
        s->model_count > 1 ? open_scene(s, &tally, out) : open_one(s, s->models[0], &tally, out);
    if (!code) code = reshape_model(s, &tally, out);
    if (!code) code = clips_check(s, &tally);
    /* where it is cut, and where parts go, does not depend on the time */
    if (!code) code = objects_place(s, *out, &places);
    if (!code) code = open_section(s, out);
    if (!code) code = objects_arrange(&places, out);
    if (!code) code = move_model(s, out);
    objects_places_free(&places);
    if (!code) return 0;
    dp_source_destroy(*out);
    *out = NULL;
    return code;
}

/* A scene's messages name the model already. */
int report_model(const tool_settings *s, const dp_diag *diag) {
    return report_failure(s->model_count > 1 ? NULL : model_spoken(s->model), diag);
}

void warn_of_model(const tool_settings *s, const char *text) {
    if (s->is_one_of_several)
        warn("%s: %s", model_spoken(s->model), text);
    else
        warn("%s", text);
}

/* The extent assumed then, for near and far: a hundred times the eye's distance, on all sides. */
static void unseen_extent(const tool_settings *s, dp_extent *extent) {
    double square = 0;
    *extent = (dp_extent){.polygons = 1};
    for (int k = 0; k < 3; k++) square += (s->eye[k] - s->target[k]) * (s->eye[k] - s->target[k]);
    for (int k = 0; k < 3; k++) {
        extent->min[k] = (float)(extent->exact_min[k] = s->target[k] - 100 * sqrt(square));
        extent->max[k] = (float)(extent->exact_max[k] = s->target[k] + 100 * sqrt(square));
    }
}

/* Finds the extent, and fits the camera in the same reading unless that depends on the extent. */
static dp_result read_once(const tool_settings *s, dp_source *source, measured *model,
                           dp_diag *diag) {
    dp_result result = DP_ERR_ARGUMENT;
    const double aspect = first_aspect(s);
    if (is_camera_fitted(s) && !s->has_mirror)
        result =
            fit_camera(s, source, &model->beside, aspect, &model->fitted, &model->extent, diag);
    if (!result) model->aspect = aspect;
    return result == DP_ERR_ARGUMENT ? dp_source_extent(source, &model->extent, diag) : result;
}

int measure_model(const tool_settings *s, dp_source *source, measured *model) {
    const char *const name = model_spoken(s->model);
    const dp_extent *const extent = &model->extent;
    dp_diag diag = {0};
    *model = (measured){0};
    if (!dp_source_rewindable(source)) { /* drawn with an assumed extent around the target */
        unseen_extent(s, &model->extent);
        return 0;
    }
    progress_begin("reading", s->quiet);
    const dp_result result = read_once(s, source, model, &diag);
    progress_end();
    if (result) {
        report_model(s, &diag);
        return EXIT_FAILED;
    }
    if (extent->polygons > extent->not_finite + extent->bad_index) return 0;
    if (!extent->polygons && s->section.count)
        wrong_usage(
            "%s: the clip planes leave nothing of what is to be drawn; turn a normal round, or "
            "move a plane",
            name);
    else if (!extent->polygons)
        wrong_usage(no_polygons, name);
    else
        wrong_usage(
            "%s: none of its %llu polygons can be drawn: %llu have coordinates that are not "
            "numbers, %llu name a vertex that is not there; mend the file",
            name, (unsigned long long)extent->polygons, (unsigned long long)extent->not_finite,
            (unsigned long long)extent->bad_index);
    return EXIT_FAILED;
}

/* Shares of the box's longest side that may lie between neighbouring values: half a pixel of a
 * picture of a thousand. */
static const double coarsest = 1.0 / 2000;

void warn_coarse(const tool_settings *s, const dp_extent *extent) {
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, extent->exact_max[k] - extent->exact_min[k]);
    if (s->quiet || !(extent->spacing > coarsest * size)) return;
    warn("%s: so far from 0 its coordinates are %g apart as float32, and its shape is rounded to "
         "that; export it nearer to 0, or with all digits, as OBJ or as PLY with doubles",
         model_spoken(s->model), extent->spacing);
}
