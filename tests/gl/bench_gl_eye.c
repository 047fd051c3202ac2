/* scratch */
#include "gl/context.h"
#include "gl/gl.h"
#include "gl/lines.h"
#include "twins/look.h"
#include "twins/scene.h"
#include "accuracy/vec.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <cmocka.h>

enum { W = 300, H = 225 };

static void run_seed(gl_test *t, uint64_t seed, double sums[2][3]) {
    static const soup_place here = {.scale = 1};
    scene s;
    soup_arrays arrays;
    dp_source *source;
    dp_context *c;
    dp_diag diag = {0};
    scene_make(seed, &s);
    const dp_camera camera = scene_camera(&s, &here, (double)W / H);
    soup_arrays_make(&s.soup, &here, &arrays);
    dp_source_from_arrays(&arrays.batch, NULL, &source, NULL);
    const dp_style style = {.ridge_angle = 150, .valley_angle = 210, .edge_table_off = true, .lines = DP_ALL_LINES & ~DP_INTERSECTION};
    look_how how = {.width = W, .height = H, .samples = 4, .table_off = true};
    look picture = {0};
    dp_context_create(NULL, &c, NULL);
    look_draw_source(c, source, &camera, &how, &picture);
    size_t count;
    const dp_segment *seg = dp_segments(c, &count);
    dp_gl_mesh *mesh;
    const dp_gl_target target = gl_test_target(t, W, H, 4);
    if (dp_gl_mesh_from_source(t->gl, source, &mesh, &diag) ||
        dp_gl_draw(t->gl, &mesh, 1, &camera, &style, &target, &diag)) { printf("%s\n", diag.message); exit(1); }
    uint32_t head[4];
    dp_gl_counters k;
    dp_gl_buffer_read(t->gl, &t->gl->lines.counters, 0, sizeof k, &k);
    dp_gl_buffer_read(t->gl, &t->gl->eye.words, 0, sizeof head, head);
    dp_gl_candidate *cand = malloc(sizeof *cand * (k.candidates + 1));
    dp_gl_buffer_read(t->gl, &t->gl->lines.candidates, 0, sizeof *cand * k.candidates, cand);
    uint32_t *corners = malloc(12 * t->gl->scene.triangle_count);
    float *vert = malloc(32 * t->gl->scene.vertex_count);
    dp_gl_buffer_read(t->gl, &t->gl->scene.corners, 0, 12 * t->gl->scene.triangle_count, corners);
    dp_gl_buffer_read(t->gl, &t->gl->scene.vertices, 0, 32 * t->gl->scene.vertex_count, vert);
    double missed[5] = {0}, all[5] = {0};
    for (size_t i = 0; i < count; i++) {
        const double dx = seg[i].b[0] - seg[i].a[0], dy = seg[i].b[1] - seg[i].a[1], l = hypot(dx, dy);
        const int n = (int)(l * 4) + 1;
        double miss_here = 0;
        for (int j = 0; j < n; j++) {
            const double f = (j + .5) / n, x = seg[i].a[0] + dx * f, y = seg[i].a[1] + dy * f;
            bool found = false;
            for (uint32_t q = 0; q < k.candidates && !found; q++) {
                if (cand[q].line != (uint32_t)seg[i].line) continue;
                const uint32_t h = 3 * cand[q].a + cand[q].edge, h2 = h % 3 == 2 ? h - 2 : h + 1;
                const float *a = vert + 8 * corners[h], *b = vert + 8 * corners[h2];
                const double ex = b[0] - a[0], ey = b[1] - a[1], el = hypot(ex, ey);
                const double m = ceil(el * 4);
                const double on = ((x - a[0]) * ex + (y - a[1]) * ey) / (el * el), off = ((x - a[0]) * ey - (y - a[1]) * ex) / el;
                found = fabs(off) < .05 && on * m >= cand[q].k0 - .6 && on * m <= cand[q].k1 + .6;
            }
            all[seg[i].line] += l / n;
            if (!found) missed[seg[i].line] += l / n, miss_here += l / n;
        }
        if (miss_here > .5 && getenv("VERBOSE"))
            printf("   missed %.1f of %.1f px: line %d polygon %d edge %d other %d  %.1f,%.1f - %.1f,%.1f\n", miss_here, l, (int)seg[i].line,
                   (int)seg[i].polygon, (int)seg[i].edge, (int)seg[i].other, seg[i].a[0], seg[i].a[1], seg[i].b[0], seg[i].b[1]);
    }
    printf("seed %d: %u candidates, looked %u chunks %u places %u nodes %u; missed", (int)seed, k.candidates, head[0], head[1], head[2], head[3]);
    for (int i = 0; i < 5; i++) if (i != 3) printf(" %.1f/%.0f", missed[i], all[i]);
    for (int i = 0; i < 5; i++) if (i != 3) sums[0][0] += missed[i], sums[0][1] += all[i];
    printf("\n");
    dp_gl_mesh_destroy(mesh);
    dp_context_destroy(c);
    dp_source_destroy(source);
    look_free(&picture);
    soup_arrays_free(&arrays);
    scene_free(&s);
    free(cand), free(corners), free(vert);
}

int main(int argc, char **argv) {
    void *state;
    double sums[2][3] = {{0}};
    gl_test_setup(&state);
    const int from = argc > 1 ? atoi(argv[1]) : 0, n = argc > 2 ? atoi(argv[2]) : 10;
    for (int i = from; i < from + n; i++) run_seed(state, (uint64_t)i, sums);
    printf("missed %.2f of %.0f px\n", sums[0][0], sums[0][1]);
    gl_test_teardown(&state);
    return 0;
}
