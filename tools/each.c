/* drypoint A.stl B.obj -o '%s.svg': a drawing for each model. Without %s in an output, all models
 * are one scene.
 *
 * Whether every drawing has files of its own is known before the first one is begun. */
#include "commands.h"
#include "files.h"
#include "models.h"
#include "objects.h"
#include "output.h"
#include "report.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* One output of the settings, by number: files, then NAME=FILE. NULL: there is none. */
enum { OUTPUTS = FILES_MOST + OUTPUT_COUNT };
static const char **output_at(tool_settings *s, int k) {
    const char **const at = k < FILES_MOST ? &s->files[k] : &s->outputs[k - FILES_MOST];
    return *at ? at : NULL;
}

static bool has_pattern(const tool_settings *s) {
    tool_settings copy = *s;
    for (int k = 0; k < OUTPUTS; k++) {
        const char **const at = output_at(&copy, k);
        if (at && output_is_pattern(*at)) return true;
    }
    return false;
}

/* Files for one model, in the place of patterns; `names` holds them. */
static bool name_outputs(tool_settings *one, char names[OUTPUTS][PATH_MAX]) {
    char stem[STEM_BYTES];
    model_stem(one->model, stem);
    for (int k = 0; k < OUTPUTS; k++) {
        const char **const at = output_at(one, k);
        if (!at || !output_is_pattern(*at)) continue;
        if (!output_fill(*at, stem, names[k], PATH_MAX))
            return wrong_usage("-o %s: the name for %s is too long", *at, one->model);
        *at = names[k];
    }
    return true;
}

static int draw_one(const tool_settings *s) {
    char names[OUTPUTS][PATH_MAX];
    tool_settings one = *s;
    return name_outputs(&one, names) ? draw_scene(&one) : EXIT_USAGE;
}

/* ---- before the first ---- */

static int check_patterns(const tool_settings *s) {
    tool_settings copy = *s;
    for (int k = 0; k < OUTPUTS && s->model_count > 1; k++) {
        const char **const at = output_at(&copy, k);
        if (at && !output_is_pattern(*at)) {
            wrong_usage("-o %s would be written for each of %u models: put %%s into its name, or "
                        "leave %%s out of all",
                        *at, s->model_count);
            return EXIT_USAGE;
        }
    }
    return 0;
}

typedef struct stem {
    char text[STEM_BYTES];
    uint32_t model;
} stem;

static int by_text(const void *a, const void *b) {
    const stem *const x = a, *const y = b;
    const int order = strcmp(x->text, y->text);
    return order ? order : (x->model > y->model) - (x->model < y->model);
}

static bool differ(const tool_settings *s, const stem *stems) {
    for (uint32_t k = 1; k < s->model_count; k++)
        if (!strcmp(stems[k - 1].text, stems[k].text))
            return wrong_usage("%s and %s would be drawn to the same file, as both are \"%s\" in "
                               "the place of %%s; draw them in two runs",
                               s->models[stems[k - 1].model], s->models[stems[k].model],
                               stems[k].text);
    return true;
}

static int check_stems(const tool_settings *s) {
    stem *const stems = calloc(s->model_count, sizeof *stems);
    if (!stems) return wrong_usage("out of memory for names"), EXIT_FAILED;
    for (uint32_t k = 0; k < s->model_count; k++) {
        model_stem(s->models[k], stems[k].text);
        stems[k].model = k;
    }
    qsort(stems, s->model_count, sizeof *stems, by_text);
    const bool fine = differ(s, stems);
    free(stems);
    return fine ? 0 : EXIT_USAGE;
}

/* Is an output another model? Names are compared first, as asking for files takes long. */
static int check_other_models(const tool_settings *s, tool_settings *one) {
    for (int i = 0; i < OUTPUTS; i++) {
        const char **const at = output_at(one, i);
        for (uint32_t k = 0; at && k < s->model_count; k++)
            if (!strcmp(output_name(*at), output_name(s->models[k])) &&
                output_same(*at, s->models[k])) {
                wrong_usage("%s, the drawing of %s, is a model; name another file for the output",
                            *at, one->model);
                return EXIT_USAGE;
            }
    }
    return 0;
}

static int check_files(const tool_settings *s) {
    char names[OUTPUTS][PATH_MAX];
    int code = 0;
    for (uint32_t k = 0; k < s->model_count && !code; k++) {
        tool_settings one = models_choose(s, k);
        if (!name_outputs(&one, names)) return EXIT_USAGE;
        code = files_check(&one);
        if (!code) code = check_other_models(s, &one);
    }
    return code;
}

int command_draw(const tool_settings *s) {
    if (s->list) return objects_print(s);
    if (!has_pattern(s)) return draw_scene(s);
    int code = check_patterns(s);
    if (!code) code = check_stems(s);
    if (!code) code = check_files(s);
    return code ? code : models_each(s, draw_one);
}
