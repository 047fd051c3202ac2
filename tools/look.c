/* From settings to shading, edge map and mirror: words to values, textures from PNG files, names to
 * groups. */
#include "look.h"
#include "colors.h"
#include "objects.h"
#include "report.h"

#include <drypoint/io.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int read_texture(const char *name, const char *path, dp_io_pixels *pixels) {
    dp_diag diag;
    if (!dp_io_read_png(path, pixels, &diag)) return 0;
    wrong_usage("--%s %s: %s; give a PNG file", name, path, diag.message);
    return EXIT_FAILED;
}

/* Reads toon shades: the middle row of a picture. */
static int read_shades(const tool_settings *s, look_data *data, dp_shade *shade) {
    dp_io_pixels p;
    if (!s->shade_texture) return 0;
    const int wrong = read_texture("shade-texture", s->shade_texture, &p);
    if (wrong) return wrong;
    data->shades = malloc((size_t)4 * p.width);
    if (data->shades)
        memcpy(data->shades, p.rgba + (size_t)4 * p.width * (p.height / 2), (size_t)4 * p.width);
    shade->shades = (dp_image){data->shades, p.width, 1};
    dp_io_free_pixels(&p);
    return data->shades ? 0 : EXIT_FAILED;
}

/* Reads a stroke texture: luminance over white paper. Dark is ink in the file: a pencil's
 * brightness is the luminance, priorities are 255 minus it. */
static int read_strokes(const tool_settings *s, look_data *data, dp_shade *shade) {
    dp_io_pixels p;
    if (!s->strokes) return 0;
    const int wrong = read_texture("strokes", s->strokes, &p);
    if (wrong) return wrong;
    const size_t n = (size_t)p.width * p.height;
    data->strokes = malloc(n);
    for (size_t i = 0; data->strokes && i < n; i++) {
        const uint8_t *const c = p.rgba + 4 * i;
        const unsigned gray = (54u * c[0] + 183u * c[1] + 19u * c[2]) >> 8;
        const unsigned ink = (255 - gray) * c[3] / 255;
        data->strokes[i] = (uint8_t)(shade->shading == DP_SHADING_PENCIL ? 255 - ink : ink);
    }
    shade->strokes = (dp_image){data->strokes, p.width, p.height};
    dp_io_free_pixels(&p);
    return data->strokes ? 0 : EXIT_FAILED;
}

static void from_angles(const double angles[2], float light[3]) {
    const double degree = 0.017453292519943295, az = angles[0] * degree, el = angles[1] * degree;
    light[0] = (float)(sin(az) * cos(el));
    light[1] = (float)sin(el);
    light[2] = (float)(cos(az) * cos(el));
}

/* ---- --enhance NAME,… ---- */

enum { GROUPS = 65536 };

static bool mark_groups(dp_source *source, const char *name, const char *end, uint8_t *enhanced) {
    bool found = false;
    for (uint32_t g = 0; g < GROUPS; g++) {
        const char *const group = dp_source_group_name(source, g);
        if (!group || !object_fits(group, name, end)) continue;
        enhanced[g] = 1;
        found = true;
    }
    return found;
}

static void known_names(dp_source *source, char *text, size_t size) {
    size_t length = 0;
    *text = 0;
    for (uint32_t g = 0; g < GROUPS && length + 64 < size; g++) {
        const char *const name = dp_source_group_name(source, g);
        if (name)
            length +=
                (size_t)snprintf(text + length, size - length, "%s%.48s", length ? ", " : "", name);
    }
}

static int read_enhanced(const tool_settings *s, dp_source *source, look_data *data,
                         dp_edge_map *map) {
    if (!s->enhance) return 0;
    data->enhanced = calloc(GROUPS, 1);
    if (!data->enhanced) return EXIT_FAILED;
    for (const char *at = s->enhance;;) {
        const char *const end = object_name_end(at);
        if (!mark_groups(source, at, end, data->enhanced)) {
            char names[400];
            known_names(source, names, sizeof names);
            wrong_usage("--enhance: the model has no object called \"%.*s\"; it has %s",
                        (int)(end - at), at, *names ? names : "no names");
            return EXIT_FAILED;
        }
        if (!*end) break;
        at = end + 1;
    }
    map->enhanced = data->enhanced;
    map->enhanced_count = GROUPS;
    return 0;
}

/* ---- all ---- */

static void make_edge_map(const tool_settings *s, dp_edge_map *map) {
    static const dp_edge_detector detectors[] = {DP_EDGE_MAP_DIAGONAL, DP_EDGE_MAP_DIAGONAL,
                                                 DP_EDGE_MAP_C1};
    const bool on = s->edges ? s->edges == EDGES_MAP || s->edges == EDGES_BOTH : s->edge_map > 0;
    map->detector = on || s->wants_edge_map ? detectors[s->edge_map] : DP_EDGE_MAP_OFF;
    map->as_printed = s->edge_measure == 2;
    map->eight_bits = s->precision == 2;
    map->radius = s->edge_radius;
    map->c1_passes = s->c1_passes;
    map->inner_angle = (float)s->inner_angle;
    map->inner_softness = (float)s->inner_softness;
    map->profile_depth = (float)s->profile_depth;
    map->profile_softness = (float)s->profile_softness;
    map->no_groups = s->group_edges == SWITCH_OFF;
    map->far_side = s->edge_sides == 2 || map->as_printed;
    map->inner = s->inner_color, map->profile = s->profile_color;
    map->hidden = !on;
}

int look_make(const tool_settings *s, dp_source *source, look_data *data, dp_style *style) {
    dp_shade *const shade = &style->shade;
    if (s->shading == 1)
        shade->shading = DP_SHADING_PAPER; /* the first word; the first value is flat */
    if (s->shading > 2) shade->shading = (dp_shading)(s->shading - 1);
    const bool lit = shade->shading != DP_SHADING_FLAT && shade->shading != DP_SHADING_PAPER;
    shade->model_colors = s->model_colors ? s->model_colors == SWITCH_ON : lit && !s->style.surface;
    if (style->surface && style->surface != DP_COLOR_NONE)
        style->surface =
            color_over(style->surface, style->paper ? style->paper : DP_RGB(255, 255, 255));
    if (style->section && style->section != DP_COLOR_NONE)
        style->section =
            color_over(style->section, style->paper ? style->paper : DP_RGB(255, 255, 255));
    if (s->has_light) from_angles(s->light, shade->light);
    if (s->normals) shade->normals = (dp_normals)(s->normals - 1);
    shade->crease_angle = (float)s->crease_angle;
    shade->highlight = (float)s->highlight;
    shade->gooch_plain = s->gooch_plain;
    shade->nearest = s->cartoon_map == SWITCH_OFF;
    shade->object_space = s->hatch_space == 2;
    shade->stroke_scale = (float)s->hatch_scale;
    shade->ink = s->hatch_color;
    if (s->has_pencil_s) shade->pencil_s = s->pencil_s > 0 ? (float)s->pencil_s : -1;
    if (s->has_pencil_o) shade->pencil_o = s->pencil_o > 0 ? (float)s->pencil_o : -1;
    shade->pencil_tones = s->pencil_tones;
    shade->pencil_printed = s->pencil_turns == 2;
    make_edge_map(s, &style->edge_map);
    if (s->edges == EDGES_MAP || s->edges == EDGES_NONE) style->lines = DP_NO_LINES;
    int code = read_shades(s, data, shade);
    if (!code) code = read_strokes(s, data, shade);
    if (!code) code = read_enhanced(s, source, data, &style->edge_map);
    return code;
}

/* ---- --mirror ---- */

static void corner_of(const dp_extent *e, int i, double p[3]) {
    for (int k = 0; k < 3; k++) p[k] = i >> k & 1 ? e->exact_max[k] : e->exact_min[k];
}

/* Rounds a coordinate as the model's positions are: to float32 from 0, or, where its box is as far
 * from there as 8 times its size, from the box. */
static double as_position(const dp_extent *e, int axis, double at) {
    const double from = e->exact_min[axis], size = e->exact_max[axis] - from;
    const double origin = fabs(from) > 8 * size ? from : 0;
    return origin + (double)(float)(at - origin);
}

/* Takes a coordinate into the box. */
static void widen(dp_extent *e, int axis, double at) {
    const float near = (float)at;
    e->exact_min[axis] = fmin(e->exact_min[axis], at);
    e->exact_max[axis] = fmax(e->exact_max[axis], at);
    e->min[axis] = fminf(e->min[axis], (double)near > at ? nextafterf(near, -INFINITY) : near);
    e->max[axis] = fmaxf(e->max[axis], (double)near < at ? nextafterf(near, INFINITY) : near);
}

void look_mirror(const tool_settings *s, measured *seen, dp_style *style) {
    const dp_extent model = seen->extent;
    dp_extent *const beside = &seen->beside;
    dp_mirror *const m = &style->mirror;
    double n[3], p[3], length = 0, largest = 0, least = INFINITY;
    if (!s->has_mirror) return;
    for (int k = 0; k < 3; k++) length += s->mirror[k] * s->mirror[k];
    for (int k = 0; k < 3; k++) {
        n[k] = s->mirror[k] / sqrt(length);
        m->normal[k] = n[k];
        m->center[k] = as_position(&model, k, 0.5 * (model.exact_min[k] + model.exact_max[k]));
        largest = fmax(largest, model.exact_max[k] - model.exact_min[k]);
    }
    for (int i = 0; i < 8; i++) {
        corner_of(&model, i, p);
        least = fmin(least, n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
    }
    const double offset = s->has_mirror_offset ? s->mirror[3] / sqrt(length) : least;
    m->offset = offset;
    m->size = (float)(s->mirror_size > 0 ? s->mirror_size : 1.5 * largest);
    m->fade = (float)s->mirror_fade;
    m->tint = s->mirror_tint ? s->mirror_tint | 0xFF : 0;
    m->tint_share = (float)(s->has_mirror_tint_share ? s->mirror_tint_share
                            : s->mirror_tint         ? 0.25
                                                     : 0);
    if (s->mirror_tint) m->tint_share *= (float)(s->mirror_tint & 0xFF) / 255;
    const double off = n[0] * m->center[0] + n[1] * m->center[1] + n[2] * m->center[2] - offset;
    for (int k = 0; k < 3; k++) {
        beside->exact_min[k] = INFINITY, beside->exact_max[k] = -INFINITY;
        beside->min[k] = INFINITY, beside->max[k] = -INFINITY;
    }
    for (int i = 0; i < 8; i++) /* corners of a box around the mirror */
        for (int k = 0; k < 3; k++) {
            const double half = 0.5 * (double)m->size * sqrt(fmax(1 - n[k] * n[k], 0));
            const double at = m->center[k] - off * n[k] + (i >> k & 1 ? half : -half);
            widen(&seen->extent, k, as_position(&model, k, at));
            widen(beside, k, as_position(&model, k, at));
        }
}

void look_deepen(const dp_style *style, const dp_extent *seen, dp_camera *camera) {
    const dp_mirror *const m = &style->mirror;
    dp_extent deep = *seen;
    if (!(m->size > 0)) return;
    for (int i = 0; i < 8; i++) { /* the image's box */
        double p[3], off = -m->offset;
        corner_of(seen, i, p);
        for (int k = 0; k < 3; k++) off += m->normal[k] * p[k];
        for (int k = 0; k < 3; k++)
            widen(&deep, k, as_position(seen, k, p[k] - 2 * off * m->normal[k]));
    }
    double near_z, far_z, *const matrix = camera->projection;
    dp_camera_near_far(camera, deep.min, deep.max, &near_z, &far_z);
    const bool perspective = matrix[11] != 0;
    matrix[10] = (perspective ? near_z + far_z : 2) / (near_z - far_z);
    matrix[14] = (perspective ? 2 * near_z * far_z : near_z + far_z) / (near_z - far_z);
}

void look_free(look_data *data) {
    free(data->shades);
    free(data->strokes);
    free(data->enhanced);
}
