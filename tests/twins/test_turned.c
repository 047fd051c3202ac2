/* Generated models as files come: turned inside out, with some triangles turned over or doubled. The
 * picture must stay the same.
 *
 *   test_turned                    all; those that fail today may
 *   test_turned --shape sphere     one
 *   test_turned --write FOLDER     also writes both pictures and how they differ
 *
 * Each model has a line of output for each kind, which begins with `ok` or `not ok`. */
#include "look.h"
#include "twin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <drypoint/io.h>
#include <drypoint/shapes.h>

enum { WIDTH = 480, HEIGHT = 360, PIXELS_ALLOWED = 30 };

static const struct model {
    const char *shape;
    uint64_t triangles; /* 0: the shape's own number */
} models[] = {
    {"cube", 0},  {"tetrahedron", 0}, {"cylinder", 0},   {"gear", 0},
    {"bolt", 0},  {"bracket", 0},     {"stairs", 0},     {"boxes", 0},
    {"torus", 0}, {"sphere", 0},      {"sphere", 20000}, {"terrain", 5000},
};

static const char *const kinds[] = {"reverse-all", "reverse-some", "double-all", "double-some"};

/* What fails today, model and kind: to become none. */
static const char *const fail_today[] = {
    "", /* so that the list may become empty */
    "sphere-20000 reverse-some",
};

typedef struct desk {
    dp_context *context;
    const char *folder;
    look plain, turned;
} desk;

/* As triangles, as they are read. */
static void gather(dp_source *source, soup *out) {
    for (;;) {
        dp_batch b;
        if (dp_source_next(source, &b, NULL) != DP_OK) abort();
        if (b.polygon_count == 0) return;
        const size_t stride = b.position_stride ? b.position_stride : 3 * sizeof(float);
        for (size_t i = 0; i < b.polygon_count; i++) {
            const size_t from = b.firsts ? b.firsts[i] : 3 * i;
            const size_t to = b.firsts ? b.firsts[i + 1] : 3 * i + 3;
            v3 p[TWIN_CORNERS];
            if (to - from > TWIN_CORNERS) abort();
            for (size_t c = from; c < to; c++) {
                const size_t vertex = b.indices ? b.indices[c] : c;
                const float *const q =
                    (const float *)(const void *)((const char *)b.positions + vertex * stride);
                p[c - from] = (v3){(double)q[0], (double)q[1], (double)q[2]};
            }
            soup_add(out, p, (uint32_t)(to - from), 0);
        }
    }
}

static void open_model(const struct model *m, scene *s, dp_camera *camera) {
    const dp_shape shape = {.name = m->shape, .triangles = m->triangles};
    dp_source *source;
    dp_extent extent;
    dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    *s = (scene){0};
    if (dp_source_from_shape(&shape, &source, NULL) != DP_OK) abort();
    if (dp_source_extent(source, &extent, NULL) != DP_OK) abort();
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    if (dp_camera_fit(camera, &fit) != DP_OK) abort();
    gather(source, &s->soup);
    dp_source_destroy(source);
}

static void draw(const desk *at, const scene *s, const twin_kind *kind, const dp_camera *camera,
                 look *out) {
    static const soup_place apart = {.scale = 1, .sharing = SOUP_NONE};
    const look_how how = {.width = WIDTH, .height = HEIGHT, .samples = 4};
    soup polygons = {0};
    soup_arrays arrays;
    twin_make(s, 1, kind, &polygons);
    soup_arrays_make(&polygons, &apart, &arrays);
    look_draw(at->context, &arrays.batch, camera, &how, out);
    soup_arrays_free(&arrays);
    soup_free(&polygons);
}

static void write_rgba(const desk *at, const char *name, const char *what, const uint8_t *rgba) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s-%s.png", at->folder, name, what);
    if (dp_io_write_png(path, rgba, WIDTH, HEIGHT, 0, NULL) != DP_OK)
        fprintf(stderr, "cannot write %s\n", path);
}

static bool fails_today(const char *name) {
    for (size_t i = 0; i < sizeof fail_today / sizeof *fail_today; i++)
        if (!strcmp(fail_today[i], name)) return true;
    return false;
}

/* True: the same picture, or known to fail. */
static bool compare(const desk *at, const struct model *m, const char *kind) {
    static uint8_t difference[4 * WIDTH * HEIGHT];
    char name[100];
    const uint32_t pixels = look_pixels(&at->plain, &at->turned);
    const bool right = at->turned.diag.result == DP_OK && pixels <= PIXELS_ALLOWED;
    if (m->triangles == 0)
        snprintf(name, sizeof name, "%s %s", m->shape, kind);
    else
        snprintf(name, sizeof name, "%s-%llu %s", m->shape, (unsigned long long)m->triangles, kind);
    const bool known = fails_today(name);
    printf("%s %s: %u pixels differ%s\n", right || known ? "ok" : "not ok", name, pixels,
           !known  ? ""
           : right ? " # passes now: take it off the list"
                   : " # known to fail today");
    if (at->folder != NULL) {
        look_difference(&at->plain, &at->turned, difference);
        write_rgba(at, name, "plain", at->plain.rgba);
        write_rgba(at, name, "turned", at->turned.rgba);
        write_rgba(at, name, "difference", difference);
    }
    return right || known;
}

static bool run_model(desk *at, const struct model *m) {
    static const twin_kind plain = {.name = "plain"};
    bool right = true;
    dp_camera camera;
    scene s;
    open_model(m, &s, &camera);
    draw(at, &s, &plain, &camera, &at->plain);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        draw(at, &s, twin_kind_named(kinds[k]), &camera, &at->turned);
        right &= compare(at, m, kinds[k]);
    }
    scene_free(&s);
    return right;
}

int main(int argc, char **argv) {
    desk at = {0};
    const char *only = "";
    bool right = true;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--shape")) only = argv[i + 1];
        if (!strcmp(argv[i], "--write")) at.folder = argv[i + 1];
    }
    if (dp_context_create(NULL, &at.context, NULL) != DP_OK) return 1;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++)
        if (strstr(models[i].shape, only) != NULL) right &= run_model(&at, &models[i]);
    look_free(&at.plain);
    look_free(&at.turned);
    dp_context_destroy(at.context);
    return right ? 0 : 1;
}
