/* The models of a run. Shells hand over many files; a quoted pattern is expanded here, too, where no
 * file has that very name. */
#include "models.h"
#include "output.h"
#include "report.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool out_of_memory(void) { return wrong_usage("out of memory for the names of models"); }

bool models_add(tool_settings *s, const char *name) {
    char **const longer = realloc(s->models, (s->model_count + (size_t)1) * sizeof *longer);
    if (longer) s->models = longer;
    char *const copy = longer ? strdup(name) : NULL;
    if (!copy) return out_of_memory();
    s->models[s->model_count++] = copy;
    return true;
}

void models_free(tool_settings *s) {
    for (uint32_t k = 0; k < s->model_count; k++) free(s->models[k]);
    free(s->models);
    s->models = NULL;
    s->model_count = 0;
}

/* ---- patterns ---- */

static bool is_pattern(const char *name) {
    struct stat status;
    return strpbrk(name, "*?[") && stat(name, &status);
}

/* Adds the files that a pattern fits, in alphabetical order; the pattern itself, which cannot be
 * opened, if there are none. */
static bool add_matches(tool_settings *s, const char *pattern) {
    glob_t found;
    const int result = glob(pattern, GLOB_NOCHECK, NULL, &found);
    if (result == GLOB_NOSPACE) return out_of_memory();
    if (result) return models_add(s, pattern);
    bool done = true;
    for (size_t k = 0; done && k < found.gl_pathc; k++) done = models_add(s, found.gl_pathv[k]);
    globfree(&found);
    return done;
}

static bool expand(tool_settings *s) {
    tool_settings given = *s;
    bool done = true;
    s->models = NULL, s->model_count = 0;
    for (uint32_t k = 0; done && k < given.model_count; k++)
        done = is_pattern(given.models[k]) ? add_matches(s, given.models[k])
                                           : models_add(s, given.models[k]);
    models_free(&given);
    return done;
}

/* ---- names ---- */

const char *model_spoken(const char *model) {
    return strcmp(model, "-") ? model : "standard input";
}

static const char *short_name(const char *model) { return output_name(model_spoken(model)); }

static void name_run(tool_settings *s) {
    if (s->model_count == 1) s->model = s->models[0];
    if (s->model_count < 2) return;
    if (s->model_count == 2)
        snprintf(s->models_name, sizeof s->models_name, "%s and %s", short_name(s->models[0]),
                 short_name(s->models[1]));
    else
        snprintf(s->models_name, sizeof s->models_name, "%s and %u more", short_name(s->models[0]),
                 s->model_count - 1);
    s->model = s->models_name;
}

static bool check_standard_input(const tool_settings *s) {
    int count = 0;
    for (uint32_t k = 0; k < s->model_count; k++) count += !strcmp(s->models[k], "-");
    return count < 2 || wrong_usage("only one model can come from standard input; name files for "
                                    "the others");
}

bool models_settle(tool_settings *s) {
    if (!s->model_count) return true;
    if (!expand(s) || !check_standard_input(s)) return false;
    name_run(s);
    return true;
}

void model_stem(const char *model, char stem[STEM_BYTES]) {
    static const char scheme[] = "shape:";
    if (!strncmp(model, scheme, sizeof scheme - 1)) {
        const char *const name = model + sizeof scheme - 1;
        snprintf(stem, STEM_BYTES, "%.*s", (int)strcspn(name, ":"), name);
    } else if (!strcmp(model, "-")) {
        snprintf(stem, STEM_BYTES, "stdin");
    } else {
        snprintf(stem, STEM_BYTES, "%s", output_name(model));
        char *const dot = strrchr(stem, '.');
        if (dot && dot > stem) *dot = 0;
    }
}

/* ---- each ---- */

tool_settings models_choose(const tool_settings *s, uint32_t k) {
    tool_settings one = *s;
    one.models = s->models + k;
    one.model_count = 1;
    one.model = s->models[k];
    one.is_one_of_several = s->model_count > 1;
    one.number = k;
    return one;
}

static void tell_failed(const tool_settings *s, const bool *failed, uint32_t count) {
    char names[400] = "";
    size_t length = 0;
    uint32_t told = 0;
    for (uint32_t k = 0; k < s->model_count; k++) {
        if (!failed[k] || length + strlen(s->models[k]) + 16 > sizeof names) continue;
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", told ? ", " : "",
                                   model_spoken(s->models[k]));
        told++;
    }
    if (told < count)
        snprintf(names + length, sizeof names - length, "%s%u more", told ? " and " : "",
                 count - told);
    wrong_usage("%u of %u models failed: %s", count, s->model_count, names);
}

int models_each(const tool_settings *s, int (*command)(const tool_settings *one)) {
    bool *const failed = calloc(s->model_count, sizeof *failed);
    uint32_t count = 0, of_usage = 0;
    if (!failed) return out_of_memory(), EXIT_FAILED;
    int code = 0;
    for (uint32_t k = 0; k < s->model_count; k++) {
        const tool_settings one = models_choose(s, k);
        code = command(&one);
        failed[k] = code != 0;
        count += code != 0, of_usage += code == EXIT_USAGE;
    }
    if (count && s->model_count > 1) tell_failed(s, failed, count);
    free(failed);
    return !count ? 0 : of_usage == s->model_count ? EXIT_USAGE : EXIT_FAILED;
}
