/* accuracy: a Markdown table of how well pictures agree with the exact visible lines.
 *
 *     accuracy [--gl] [--quads] [--paper] [--size WxH] [MODEL or FOLDER]...
 *
 * Draws every generated model, and every OBJ or PLY file named or found in the folders named (and
 * in $DRYPOINT_MODELS), in four views: each class alone at four widths, and all together; with --gl by OpenGL (where the tests were built with it). Exit code
 * 0 unless something could not be drawn: figures are judged by test_accuracy. */
#include "suite.h"

#if DP_TEST_HAS_GL
#include "gl/context.h"
#endif

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { CROSSINGS = 20000 /* polygons up to which crossings are sought */ };

typedef struct options {
    uint32_t width, height;
    dp_style base;
    dp_context *context;
    uint8_t *rgba;
    void *gl; /* gl_test; NULL: the CPU draws */
    bool failed;
} options;

/* One row: worst and median over the views. */
typedef struct table_row {
    double recall[SUITE_VIEWS], precision[SUITE_VIEWS], uncovered[SUITE_VIEWS], cracks[SUITE_VIEWS];
    double width[SUITE_VIEWS];
    unsigned views, widths;
    size_t samples;
} table_row;

static int by_value(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static void add_score(table_row *row, const score *s) {
    row->recall[row->views] = s->recall;
    row->precision[row->views] = s->precision;
    row->uncovered[row->views] = s->uncovered;
    row->cracks[row->views++] = s->cracks;
    if (s->width_samples > 0) row->width[row->widths++] = s->width_median;
    row->samples += s->samples;
}

static void print_row(const char *model, const char *set, double px, table_row *row) {
    const unsigned n = row->views;
    if (n == 0 || row->samples == 0) return;
    qsort(row->recall, n, sizeof(double), by_value);
    qsort(row->precision, n, sizeof(double), by_value);
    qsort(row->uncovered, n, sizeof(double), by_value);
    qsort(row->cracks, n, sizeof(double), by_value);
    qsort(row->width, row->widths, sizeof(double), by_value);
    printf("| %s | %s | %g | %.4f / %.4f | %.4f / %.4f | %.4f / %.4f | %.4f | ", model, set, px,
           row->recall[0], row->recall[n / 2], row->precision[0], row->precision[n / 2],
           row->uncovered[n - 1], row->uncovered[n / 2], row->cracks[n - 1]);
    if (row->widths > 0)
        printf("%.2f |\n", row->width[row->widths / 2]);
    else
        printf("– |\n");
    fflush(stdout);
}

static dp_result draw(const options *o, const suite_model *model, const ref_truth *truth,
                      const suite_class *set, double px, dp_diag *diag) {
#if DP_TEST_HAS_GL
    if (o->gl) {
        const dp_style style = suite_style(set, px, &o->base);
        const dp_gl_target target = gl_test_target(o->gl, truth->width, truth->height, 0);
        dp_gl *const gl = ((gl_test *)o->gl)->gl;
        dp_gl_mesh *mesh = NULL;
        dp_result result = dp_gl_mesh_from_source(gl, model->source, &mesh, diag);
        if (!result) result = dp_gl_draw(gl, &mesh, 1, &truth->camera, &style, &target, diag);
        if (!result) result = dp_gl_read(gl, &target, o->rgba, 0, diag);
        dp_gl_mesh_destroy(mesh);
        return result;
    }
#endif
    return suite_draw(o->context, model, truth, set, px, &o->base, o->rgba, diag);
}

static bool open_gl(options *o) {
#if DP_TEST_HAS_GL
    if (gl_test_setup(&o->gl) == 0 && ((gl_test *)o->gl)->gl) return true;
#endif
    fprintf(stderr, "accuracy: there is no OpenGL here\n");
    o->gl = NULL;
    return false;
}

static void score_set(options *o, const suite_model *model, const suite_class *set) {
    table_row rows[SUITE_WIDTHS] = {0};
    for (unsigned v = 0; v < SUITE_VIEWS; v++) {
        ref_truth *truth = suite_truth(model, &suite_views[v], set, o->width, o->height);
        for (unsigned w = 0; w < set->widths; w++) {
            dp_diag diag = {0};
            if (draw(o, model, truth, set, suite_widths[w], &diag) != DP_OK) {
                fprintf(stderr, "accuracy: %s: %s\n", model->name, diag.message);
                o->failed = true;
                continue;
            }
            const score s = score_picture(truth, o->rgba, set->lines, suite_widths[w]);
            add_score(&rows[w], &s);
        }
        ref_truth_destroy(truth);
    }
    for (unsigned w = 0; w < set->widths; w++)
        print_row(model->name, set->name, suite_widths[w], &rows[w]);
}

static void score_source(options *o, const char *name, dp_source *source) {
    dp_diag diag = {.message = "cannot be read"};
    suite_model *model = suite_model_create(name, source, 0, CROSSINGS, &diag);
    if (model == NULL) {
        fprintf(stderr, "accuracy: %s: %s\n", name, diag.message);
        o->failed = true;
        return;
    }
    for (unsigned c = 0; c < SUITE_CLASSES; c++) score_set(o, model, &suite_classes[c]);
    suite_model_destroy(model);
}

static void score_file(options *o, const char *path) {
    const char *const slash = strrchr(path, '/');
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_open(path, NULL, &source, &diag) != DP_OK) {
        fprintf(stderr, "accuracy: %s: %s\n", path, diag.message);
        o->failed = true;
        return;
    }
    score_source(o, slash ? slash + 1 : path, source);
    dp_source_destroy(source);
}

static bool is_model(const char *name) {
    const char *const dot = strrchr(name, '.');
    return dot && (!strcmp(dot, ".obj") || !strcmp(dot, ".ply"));
}

static int by_name(const struct dirent **left, const struct dirent **right) {
    return strcmp((*left)->d_name, (*right)->d_name);
}

/* A file, or a folder's models by name. */
static void score_path(options *o, const char *path) {
    struct dirent **entries = NULL;
    struct stat about;
    if (stat(path, &about) != 0) {
        fprintf(stderr, "accuracy: left out: %s is not there\n", path);
        return;
    }
    if (!S_ISDIR(about.st_mode)) {
        score_file(o, path);
        return;
    }
    const int count = scandir(path, &entries, NULL, by_name);
    for (int i = 0; i < count; i++) {
        char file[4096];
        snprintf(file, sizeof file, "%s/%s", path, entries[i]->d_name);
        if (is_model(entries[i]->d_name)) score_file(o, file);
        free(entries[i]);
    }
    free(entries);
}

static void score_shapes(options *o) {
    for (uint32_t i = 0; i < dp_shape_count(); i++) {
        const dp_shape shape = {.name = dp_shape_name(i)};
        dp_source *source = NULL;
        if (dp_source_from_shape(&shape, &source, NULL) != DP_OK) abort();
        score_source(o, shape.name, source);
        dp_source_destroy(source);
    }
}

int main(int argc, char **argv) {
    options o = {.width = 1280, .height = 960};
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i++) {
        if (!strcmp(argv[i], "--gl")) {
            if (!open_gl(&o)) return 1;
        } else if (!strcmp(argv[i], "--quads"))
            o.base.ink = DP_INK_QUADS;
        else if (!strcmp(argv[i], "--paper"))
            o.base.method = DP_METHOD_PAPER;
        else if (!strcmp(argv[i], "--size") && i + 1 < argc &&
                 sscanf(argv[i + 1], "%ux%u", &o.width, &o.height) == 2)
            i++;
        else {
            fprintf(
                stderr,
                "usage: accuracy [--gl] [--quads] [--paper] [--size WxH] [MODEL or FOLDER]...\n");
            return 2;
        }
    }
    if (o.width < 16 || o.height < 16 || o.width > 8192 || o.height > 8192) return 2;
    o.rgba = malloc((size_t)4 * o.width * o.height);
    if (o.rgba == NULL || dp_context_create(NULL, &o.context, NULL) != DP_OK) return 1;
    printf("| model | lines | width | recall worst / median | precision worst / median "
           "| uncovered worst / median | cracks worst | width median, px |\n"
           "|---|---|---|---|---|---|---|---|\n");
    score_shapes(&o);
    for (; i < argc; i++) score_path(&o, argv[i]);
    const char *const folder = getenv("DRYPOINT_MODELS");
    if (folder) score_path(&o, folder);
#if DP_TEST_HAS_GL
    if (o.gl) gl_test_teardown(&o.gl);
#endif
    dp_context_destroy(o.context);
    free(o.rgba);
    return o.failed ? 1 : 0;
}
