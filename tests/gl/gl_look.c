/* Draws by OpenGL, and measures what was drawn. */
#include "gl/gl_look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void measure(gl_test *t, look *out) {
    const dp_segment *segments;
    size_t count;
    memset(out->length, 0, sizeof out->length);
    memset(out->world_length, 0, sizeof out->world_length);
    out->diag.result = dp_gl_segments(t->gl, &segments, &count, &out->diag);
    for (size_t i = 0; i < count && !out->diag.result; i++) {
        const dp_segment *const s = &segments[i];
        double world = 0;
        for (int k = 0; k < 3; k++) world += pow(s->world_a[k] - s->world_b[k], 2);
        out->world_length[s->line] += sqrt(world);
        out->length[s->line] +=
            hypot((double)s->a[0] - (double)s->b[0], (double)s->a[1] - (double)s->b[1]);
    }
}

void gl_look_draw(gl_test *t, dp_source *source, const dp_camera *camera, const look_how *how,
                  look *out) {
    const dp_style style = {
        .ridge_angle = 150, .valley_angle = 210, .edge_table_off = how->table_off};
    const dp_gl_target target = gl_test_target(t, how->width, how->height, how->samples);
    dp_gl_mesh *mesh = NULL;
    dp_diag *const diag = &out->diag;
    if (out->width != how->width || out->height != how->height) {
        free(out->rgba);
        out->width = how->width, out->height = how->height;
        out->rgba = malloc((size_t)4 * out->width * out->height);
        if (out->rgba == NULL) abort();
    }
    *diag = (dp_diag){.result = DP_OK};
    diag->result = dp_gl_mesh_from_source(t->gl, source, &mesh, diag);
    if (!diag->result) diag->result = dp_gl_draw(t->gl, &mesh, 1, camera, &style, &target, diag);
    if (!diag->result) diag->result = dp_gl_read(t->gl, &target, out->rgba, 0, diag);
    if (!diag->result) measure(t, out);
    dp_gl_mesh_destroy(mesh);
}
