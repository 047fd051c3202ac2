/* Between the words of a camera and an orbit. Invariant: if it is free, the line's camera is what orbit_write made of it. */
#include "free_camera.h"

#include <math.h>
#include <stdio.h>

bool free_camera_begin(free_camera *c, const cmdline *line, const picture *p, const loaded *model) {
    model_sides sides;
    if (!p->styled || !model->source) return false;
    if (c->is_free) return true;
    /* of the options alone: a view from above has an --up of its own */
    parsed given;
    cmdline plain = *line;
    plain.camera = (cmd_options){0};
    const bool sound = cmdline_parse(&plain, NULL, &given);
    if (sound) sides_of(&given.settings, model->source, &sides);
    parsed_free(&given);
    if (!sound) return false;
    c->orbit = orbit_of(&p->plan.views[0].camera, &sides, &model->seen.extent);
    c->is_free = true;
    return true;
}

bool free_camera_is_orthographic(const free_camera *c, const cmdline *line) {
    return c->is_free ? c->orbit.orthographic : cmdline_get(&line->camera, "ortho") != NULL;
}

static void set_number(cmd_options *options, const char *name, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.6g", value);
    cmdline_set(options, name, text);
}

/* A camera that is fitted again keeps how it projects. */
static void keep_projection(free_camera *c, cmdline *line, bool orthographic) {
    const bool usual = fabs(c->orbit.fov - 35) < 0.01;
    if (orthographic)
        cmdline_set(&line->camera, "ortho", "0");
    else if (c->is_free && !usual)
        set_number(&line->camera, "fov", c->orbit.fov);
    c->is_free = false;
}

bool free_camera_fit(free_camera *c, cmdline *line) {
    const bool orthographic = free_camera_is_orthographic(c, line);
    if (!c->is_free) return false;
    cmdline_clear(&line->camera);
    set_number(&line->camera, "azimuth", round(c->orbit.azimuth * 1e3) / 1e3);
    set_number(&line->camera, "elevation", round(c->orbit.elevation * 1e3) / 1e3);
    keep_projection(c, line, orthographic);
    return true;
}

void free_camera_view(free_camera *c, cmdline *line, const char *name) {
    const bool orthographic = free_camera_is_orthographic(c, line);
    cmdline_clear(&line->camera);
    if (name) cmdline_set(&line->camera, "view", name);
    keep_projection(c, line, orthographic);
}

bool free_camera_project(free_camera *c, cmdline *line, const picture *p, const loaded *model,
                         bool orthographic) {
    if (!c->is_free && !cmdline_get(&line->camera, "eye")) {
        cmdline_set(&line->camera, "fov", NULL);
        cmdline_set(&line->camera, "ortho", orthographic ? "0" : NULL);
        return true;
    }
    if (!free_camera_begin(c, line, p, model)) return false;
    if (c->orbit.orthographic != orthographic) orbit_project(&c->orbit, orthographic);
    orbit_write(&c->orbit, &line->camera);
    return true;
}
