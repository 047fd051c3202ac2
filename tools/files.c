/* The files that a run writes: how, and that none is written twice or lies over the model. */
#include "files.h"
#include "models.h"
#include "output.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

/* By word of --format, from 1. */
static int format_of_word(int word) {
    const int films = 2 + DP_FORMAT_COUNT;
    return word == 1 ? FORMAT_PNG : word < films ? word - 2 : FORMAT_RGBA + word - films;
}

static int format_by_ending(const char *path) {
    static const char *const films[] = {".rgba", ".mp4", ".webm", ".gif", ".apng"};
    for (int k = 0; k < FORMAT_UNKNOWN - FORMAT_RGBA; k++)
        if (output_has_ending(path, films[k])) return FORMAT_RGBA + k;
    if (output_has_ending(path, ".png")) return FORMAT_PNG;
    for (int k = 0; k < DP_FORMAT_COUNT; k++) {
        char ending[16];
        snprintf(ending, sizeof ending, ".%s", dp_format_name((dp_format)k));
        if (output_has_ending(path, ending)) return k;
    }
    return FORMAT_UNKNOWN;
}

int files_format(const tool_settings *s, const char *path) {
    const int format = strcmp(path, "-") ? format_by_ending(path) : FORMAT_UNKNOWN;
    if (format != FORMAT_UNKNOWN) return format;
    if (s->format) return format_of_word(s->format);
    return output_in_place(path) ? FORMAT_PNG : FORMAT_UNKNOWN;
}

static bool is_standard(const char *path) { return path && !strcmp(path, "-"); }

int files_count(const tool_settings *s) {
    int count = (int)s->file_count;
    for (int k = 0; k < OUTPUT_COUNT; k++) count += s->outputs[k] != NULL;
    return count;
}

int files_standard(const tool_settings *s) {
    int count = 0;
    for (uint32_t k = 0; k < s->file_count; k++) count += is_standard(s->files[k]);
    for (int k = 0; k < OUTPUT_COUNT; k++) count += is_standard(s->outputs[k]);
    return count;
}

bool files_have(const tool_settings *s, int format) {
    for (uint32_t k = 0; k < s->file_count; k++)
        if (files_format(s, s->files[k]) == format) return true;
    return false;
}

bool files_is_film(const tool_settings *s, const char *path) {
    const int format = files_format(s, path);
    return format >= FORMAT_RGBA && format < FORMAT_UNKNOWN;
}

bool files_have_pixels(const tool_settings *s) {
    for (uint32_t k = 0; k < s->file_count; k++)
        if (files_is_film(s, s->files[k])) return true;
    return files_have(s, FORMAT_PNG);
}

bool files_have_paths(const tool_settings *s) {
    for (int format = 0; format < DP_FORMAT_COUNT; format++)
        if (files_have(s, format)) return true;
    return s->outputs[OUTPUT_SEGMENTS] != NULL;
}

/* A folder is no file: says what would be one. */
static bool check_no_folder(const tool_settings *s, const char *before, const char *path,
                            const char *ending) {
    char stem[STEM_BYTES];
    if (!output_is_folder(path)) return true;
    const char *const slash = path[strlen(path) - 1] == '/' ? "" : "/";
    model_stem(s->model_count ? s->models[0] : s->model, stem);
    const bool several = s->model_count > 1; /* the shell would like quotes there */
    return wrong_usage("-o %s%s: that is a folder; name a file in it: -o %s%s%s%s%s.%s%s", before,
                       path, several ? "'" : "", before, path, slash, several ? "%s" : stem, ending,
                       several ? "'" : "");
}

bool files_no_folder(const tool_settings *s, const char *path, const char *ending) {
    return check_no_folder(s, "", path, ending);
}

static bool check_no_folders(const tool_settings *s) {
    for (uint32_t k = 0; k < s->file_count; k++)
        if (!files_no_folder(s, s->files[k], "png")) return false;
    for (int k = 0; k < OUTPUT_COUNT; k++) {
        char before[32];
        snprintf(before, sizeof before, "%s=", output_names[k]);
        if (s->outputs[k] && !check_no_folder(s, before, s->outputs[k],
                                              k < PLANE_COUNT        ? "png"
                                              : k == OUTPUT_SEGMENTS ? "json"
                                                                     : "txt"))
            return false;
    }
    return true;
}

/* An unknown ending is taken for a mistake, and so is a format that no output takes. */
static bool check_formats(const tool_settings *s) {
    bool used = !s->format;
    for (uint32_t k = 0; k < s->file_count; k++) {
        const char *const path = s->files[k];
        const int format = files_format(s, path);
        if (format == FORMAT_UNKNOWN)
            return wrong_usage("-o %s: drawings are written as .png, .svg, .pdf, .eps, .dxf or "
                               ".json; name it %.*s.png, say, or give --format",
                               path, output_stem(path), path);
        used |= s->format && format == format_of_word(s->format);
    }
    if (used) return true;
    return wrong_usage("--format is for outputs whose name does not end in a format, and there is "
                       "none; leave it out");
}

static bool is_model(const tool_settings *s, const char *path) {
    for (uint32_t k = 0; k < s->model_count; k++)
        if (!is_standard(s->models[k]) && output_same(path, s->models[k])) return true;
    return false;
}

/* Every output has a file of its own, and none is a model. */
static bool check_apart(const tool_settings *s) {
    const char *paths[FILES_MOST + OUTPUT_COUNT];
    size_t count = 0;
    for (uint32_t k = 0; k < s->file_count; k++) paths[count++] = s->files[k];
    for (int k = 0; k < OUTPUT_COUNT; k++)
        if (s->outputs[k]) paths[count++] = s->outputs[k];
    for (size_t i = 0; i < count; i++) {
        if (is_model(s, paths[i]))
            return wrong_usage("%s is %s model; name another file for the output", paths[i],
                               s->model_count > 1 ? "a" : "the");
        for (size_t k = 0; k < i; k++)
            if (output_same(paths[i], paths[k]))
                return wrong_usage("two outputs go to %s; name another file", paths[i]);
    }
    return true;
}

int files_check(const tool_settings *s) {
    if (!check_no_folders(s) || !check_formats(s) || !check_apart(s)) return EXIT_USAGE;
    for (uint32_t k = 0; k < s->file_count; k++)
        if (!output_possible(s->files[k])) return EXIT_FAILED;
    for (int k = PLANE_COUNT; k < OUTPUT_COUNT; k++)
        if (s->outputs[k] && !output_possible(s->outputs[k])) return EXIT_FAILED;
    return 0;
}
