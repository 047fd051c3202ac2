/* Styles: every default is filled in here, and nowhere else. */
#include <drypoint/style.h>

#include "base/diag.h"
#include "base/print.h"
#include "base/vec.h"

#include <math.h>

static const char *const line_names[DP_LINE_COUNT] = {
    "silhouette", "ridge", "valley", "intersection", "border", "section", "hatching"};

const char *dp_line_name(dp_line line) {
    return (unsigned)line < DP_LINE_COUNT ? line_names[line] : "unknown";
}

/* A number in a message. */
#define NUMBER(value) dp_print_number((char[DP_NUMBER_TEXT]){0}, (double)(value), 6)

static dp_color color_or(dp_color color, dp_color other) { return color ? color : other; }

static dp_result resolve_line(dp_line_style *line, dp_line which, dp_diag *diag) {
    if (line->width == 0) line->width = 2;
    if (!(line->width >= 0.5f && line->width <= 64))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the %s width is %s px; it must be 0.5 to 64",
                       dp_line_name(which), NUMBER(line->width));
    line->color = color_or(line->color, DP_RGB(0, 0, 0));
    return DP_OK;
}

static dp_result resolve_angle(float *angle, float other, const char *name, dp_diag *diag) {
    if (*angle == 0) *angle = other;
    if (!(*angle > 0 && *angle < 360))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the %s angle is %s degrees; it must be between 0 and 360", name,
                       NUMBER(*angle));
    return DP_OK;
}

/* How often polygons are gone through, by what is drawn: from `least` to `most`. */
typedef struct passes_rule {
    const char *what;
    int least, most, usual;
} passes_rule;

static passes_rule passes_rule_of(const dp_style *style) {
    /* there is no between-test */
    if (style->edges == DP_EDGES_ADJACENCY) return (passes_rule){"lines by adjacency", 1, 2, 1};
    if (style->ink != DP_INK_QUADS) return (passes_rule){"strokes", 1, 2, 2};
    /* only the paper's own test works with one pass; the plane test needs the finished depth */
    switch (style->between) {
    case DP_BETWEEN_INTERVAL:
        return (passes_rule){"quads with the interval test", 1, 2, 1};
    case DP_BETWEEN_STENCIL:
        return (passes_rule){"quads with the stencil test", 3, 3, 3};
    default:
        return (passes_rule){"quads with the plane test", 2, 2, 2};
    }
}

static dp_result resolve_passes(dp_style *style, dp_diag *diag) {
    const passes_rule rule = passes_rule_of(style);
    if (style->passes == 0) style->passes = rule.usual;
    if (style->passes >= rule.least && style->passes <= rule.most) return DP_OK;
    if (rule.least < rule.most)
        return dp_fail(diag, DP_ERR_ARGUMENT, "passes is %d; for %s it must be %d or %d",
                       style->passes, rule.what, rule.least, rule.most);
    return dp_fail(diag, DP_ERR_ARGUMENT, "passes is %d; for %s it must be %d%s", style->passes,
                   rule.what, rule.least,
                   style->passes == 1 ? "; one pass needs the interval test (--between interval)"
                                      : "");
}

static bool within(float value, float least, float most) { return value >= least && value <= most; }

static dp_result resolve_stroke(dp_stroke_style *s, dp_diag *diag) {
    if (s->k == 0) s->k = 0.5f;
    if (s->scale == 0) s->scale = 1;
    if (!s->repeats) s->repeats = 1;
    if ((unsigned)s->u > DP_STROKE_WORLD || s->repeats > 8 || !within(s->k, -100, 100) ||
        !within(s->scale, 1e-3f, 1e3f) || !within(s->taper, 0, 1e4f) || !within(s->jitter, 0, 64) ||
        !within(s->overshoot, 0, 1e3f) || !within(s->depth, 0, 1) || !within(s->light, 0, 1))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the stroke's u, k, scale, taper, jitter, overshoot, depth, light or "
                       "repeats is out of range");
    return DP_OK;
}

/* With strokes a pattern is their texture. */
static dp_result take_pattern(dp_style *style, dp_diag *diag) {
    const dp_pattern *const p = &style->pattern;
    if (style->ink == DP_INK_QUADS) {
        if (style->edges != DP_EDGES_ADJACENCY) return DP_OK;
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "silhouettes added by adjacency have stroke textures, and no pattern");
    }
    if (style->stroke.texture && style->stroke.texture != p->texture)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "strokes have a texture or a pattern, not both; leave one out");
    style->stroke.texture = p->texture;
    style->stroke.u = p->screen ? DP_STROKE_ARC : DP_STROKE_WORLD;
    return DP_OK;
}

static dp_result resolve_pattern(dp_style *style, dp_diag *diag) {
    const dp_pattern *const p = &style->pattern;
    if ((unsigned)style->line_light.lighting > DP_LINE_LIGHT_GOOCH)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the light on lines is not one of its values");
    if (!(p->length == 0 || within(p->length, 1, 1e5f)))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a repeat of the pattern is %s px long; it must be 1 to 100000",
                       NUMBER(p->length));
    if (!(p->world_length == 0 || (p->world_length > 0 && isfinite(p->world_length))))
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "a repeat of the pattern is %s of the model's units long; it must be above 0",
            NUMBER(p->world_length));
    return p->texture ? take_pattern(style, diag) : DP_OK;
}

const char *dp_shading_name(dp_shading shading) {
    static const char *const names[DP_SHADING_COUNT] = {"flat", "paper", "lambert",  "gooch",
                                                        "toon", "hatch", "halftone", "pencil"};
    return (unsigned)shading < DP_SHADING_COUNT ? names[shading] : "unknown";
}

/* Fills in a default and checks the range; NaN is out of every range. */
static dp_result resolve_number(float *value, float other, float least, float most,
                                const char *name, dp_diag *diag) {
    if (*value == 0) *value = other;
    if (*value >= least && *value <= most) return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT, "the %s is %s; it must be %s to %s", name, NUMBER(*value),
                   NUMBER(least), NUMBER(most));
}

static dp_result resolve_light(float light[3], dp_diag *diag) {
    static const float usual[3] = {-0.5f, 0.7f, 0.6f};
    const bool none = light[0] == 0 && light[1] == 0 && light[2] == 0;
    for (int k = 0; k < 3 && none; k++) light[k] = usual[k];
    const float length = sqrtf(light[0] * light[0] + light[1] * light[1] + light[2] * light[2]);
    if (!(length > 1e-18f) || !isfinite(length))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the light's direction is too short, too long or not finite");
    for (int k = 0; k < 3; k++) light[k] /= length;
    return DP_OK;
}

static dp_result check_image(const dp_image *image, uint32_t most, const char *name,
                             dp_diag *diag) {
    if (!image->values ||
        (image->width && image->height && image->width <= most && image->height <= most))
        return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT, "the %s texture is %u x %u; each side must be 1 to %u",
                   name, image->width, image->height, most);
}

static dp_result resolve_pencil(float *value, float other, const char *name, dp_diag *diag) {
    if (*value == 0)
        *value = other;
    else if (*value < 0 && *value >= -100)
        *value = -1e-9f; /* stays when resolved twice */
    if (!(*value >= -1 && *value <= 100))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the pencil's %s is %s; it must be 0 to 100", name,
                       NUMBER(*value));
    return DP_OK;
}

static dp_result resolve_shade(dp_shade *s, dp_diag *diag) {
    if ((unsigned)s->shading >= DP_SHADING_COUNT || (unsigned)s->normals > DP_NORMALS_FACET)
        return dp_fail(diag, DP_ERR_ARGUMENT, "shading or normals is not one of its values");
    dp_result result = resolve_light(s->light, diag);
    if (!result) result = resolve_number(&s->crease_angle, 40, 0, 180, "crease angle", diag);
    if (!result) result = resolve_number(&s->gooch_blue, 0.4f, 0, 1, "blue of Gooch shading", diag);
    if (!result)
        result = resolve_number(&s->gooch_yellow, 0.4f, 0, 1, "yellow of Gooch shading", diag);
    if (!result)
        result = resolve_number(&s->gooch_alpha, 0.2f, 0, 1, "alpha of Gooch shading", diag);
    if (!result) result = resolve_number(&s->gooch_beta, 0.6f, 0, 1, "beta of Gooch shading", diag);
    if (!result) result = resolve_number(&s->highlight, 0, 0, 1, "highlight's strength", diag);
    if (!result) result = resolve_number(&s->stroke_scale, 1, 0.05f, 50, "scale of strokes", diag);
    if (!result) result = check_image(&s->shades, 65536, "shade", diag);
    if (!result) result = check_image(&s->strokes, 16384, "stroke", diag);
    if (!result) result = resolve_pencil(&s->pencil_s, 2.6f, "S", diag);
    if (!result) result = resolve_pencil(&s->pencil_o, 0.12f, "O", diag);
    if (!result && (s->pencil_tones == 1 || s->pencil_tones > 8))
        result = dp_fail(diag, DP_ERR_ARGUMENT, "pencil with %u tones; give 2 to 8, or 0 for none",
                         s->pencil_tones);
    s->ink = color_or(s->ink, DP_RGB(0, 0, 0));
    return result;
}

static dp_result resolve_mirror(dp_mirror *m, dp_diag *diag) {
    const double length = sqrt(m->normal[0] * m->normal[0] + m->normal[1] * m->normal[1] +
                               m->normal[2] * m->normal[2]);
    if (m->size == 0) return DP_OK;
    if (!(m->size > 0) || !isfinite(m->size) || !isfinite(m->offset) ||
        !isfinite(m->center[0] + m->center[1] + m->center[2]))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the mirror's size must be above zero, and its place finite");
    if (!(length > 1e-18) || !isfinite(length))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the mirror's normal is too short, too long or not finite");
    for (int k = 0; k < 3; k++) m->normal[k] /= length;
    m->tint = color_or(m->tint, DP_RGB(255, 255, 255));
    if (!(m->fade >= 0) || !isfinite(m->fade))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the mirror's fade must be 0 or above");
    return resolve_number(&m->tint_share, 0, 0, 1, "share of the mirror's tint", diag);
}

static dp_result resolve_edge_map(dp_edge_map *m, dp_diag *diag) {
    if ((unsigned)m->detector > DP_EDGE_MAP_C1)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the edge detector is not one of its values");
    if (!m->radius) m->radius = 1;
    if (!m->c1_passes) m->c1_passes = 3;
    if (m->c1_passes > 3)
        return dp_fail(diag, DP_ERR_ARGUMENT, "C1 has three passes, not %u", m->c1_passes);
    if (m->enhanced_count && !m->enhanced)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the edge map's enhanced_count is %u, but enhanced is NULL",
                       m->enhanced_count);
    if (m->radius > 4)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the edge map's radius is %u px; it must be 1 to 4",
                       m->radius);
    dp_result result =
        resolve_number(&m->inner_angle, 24, 0.01f, 180, "angle of inner edges", diag);
    if (!result)
        result =
            resolve_number(&m->inner_softness, 0.25f, 1e-3f, 2, "softness of inner edges", diag);
    if (!result)
        result = resolve_number(&m->profile_depth, 6, 0.01f, 1e6f, "depth of profile edges", diag);
    if (!result)
        result =
            resolve_number(&m->profile_softness, 0.5f, 1e-3f, 1, "softness of profile edges", diag);
    m->inner = color_or(m->inner, DP_RGB(0, 0, 0));
    m->profile = color_or(m->profile, DP_RGB(0, 0, 0));
    return result;
}

/* Hidden lines are those of the tiles' edge tables, drawn as strokes. */
static dp_result check_hidden(const dp_style *style, dp_diag *diag) {
    if (!style->hidden.look) return DP_OK;
    if (style->edges == DP_EDGES_ADJACENCY)
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "hidden lines emerge from the tiles; with lines by adjacency there are none");
    if (style->ink == DP_INK_QUADS)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "hidden lines are drawn as strokes; with quads as ink there are none");
    return DP_OK;
}

/* Transparent surfaces: lines show through them as hidden ones do. */
static dp_result resolve_xray(dp_style *style, dp_diag *diag) {
    if (!(style->xray >= 0 && style->xray <= 1))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "xray is %s; it must be 0 to 1, the opacity of surfaces",
                       NUMBER(style->xray));
    if (!style->xray_layers) style->xray_layers = DP_LEVELS;
    if (style->xray_layers > DP_LEVELS)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u layers of an x-ray; there are 1 to %d",
                       style->xray_layers, DP_LEVELS);
    if (!(style->xray > 0 && style->xray < 1)) return DP_OK;
    if (style->edges == DP_EDGES_ADJACENCY)
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "an x-ray's lines emerge from the tiles; with lines by adjacency there is none");
    if (style->ink == DP_INK_QUADS)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "an x-ray's lines are drawn as strokes; with quads as ink there is none");
    return DP_OK;
}

/* Lines that something hides: narrower than the visible ones, in their colour. */
static dp_result resolve_hidden(dp_style *style, dp_diag *diag) {
    dp_hidden *const h = &style->hidden;
    if ((unsigned)h->look > DP_HIDDEN_SOLID)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the look of hidden lines is not one of its values");
    if (!h->levels) h->levels = 1;
    if (h->levels > DP_LEVELS)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u levels of hidden lines; there are 1 to %d",
                       h->levels, DP_LEVELS);
    for (int level = 0; level < DP_LEVELS; level++)
        for (int i = 0; i < DP_LINE_COUNT; i++) {
            dp_line_style *const line = &h->line[level][i];
            if (line->width == 0)
                line->width = h->look == DP_HIDDEN_SOLID ? style->line[i].width
                                                         : dp_maxf(style->line[i].width / 2, 0.5f);
            line->color = color_or(line->color, style->line[i].color);
            const dp_result result = resolve_line(line, (dp_line)i, diag);
            if (result) return result;
        }
    return DP_OK;
}

dp_result dp_style_resolve(const dp_style *style, dp_style *resolved, dp_diag *diag) {
    if (!resolved) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_style_resolve: resolved is NULL");
    dp_style full = style ? *style : (dp_style){0};
    if (full.lines & ~(DP_ALL_LINES | DP_NO_LINES))
        return dp_fail(diag, DP_ERR_ARGUMENT, "lines holds bits that stand for no class of lines");
    if (!full.lines) full.lines = DP_ALL_LINES;
    full.lines &= DP_ALL_LINES;
    if (!full.lines) full.lines = DP_NO_LINES; /* stays so when resolved twice */
    for (int i = 0; i < DP_LINE_COUNT; i++) {
        const dp_result result = resolve_line(&full.line[i], (dp_line)i, diag);
        if (result) return result;
    }
    dp_result result = resolve_hidden(&full, diag);
    if (!result) result = resolve_angle(&full.ridge_angle, 150, "ridge", diag);
    if (!result) result = resolve_angle(&full.valley_angle, 210, "valley", diag);
    if (!result) result = resolve_stroke(&full.stroke, diag);
    if (!result) result = resolve_passes(&full, diag);
    if (result) return result;
    if ((unsigned)full.method > DP_METHOD_PAPER || (unsigned)full.between > DP_BETWEEN_STENCIL ||
        (unsigned)full.ink > DP_INK_QUADS || (unsigned)full.edges > DP_EDGES_ADJACENCY)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "edges, method, between or ink is not one of its values");
    if ((result = check_hidden(&full, diag)) || (result = resolve_xray(&full, diag)) ||
        (result = resolve_pattern(&full, diag)))
        return result;
    if (full.stroke.texture && full.stroke.u == DP_STROKE_WORLD && full.ink == DP_INK_QUADS)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the stroke's u in the model's space is of strokes; with quads as ink give "
                       "a pattern");
    if (full.detail != 0 && !(full.detail >= 0.01f && full.detail <= 100))
        return dp_fail(diag, DP_ERR_ARGUMENT, "detail is %s; it must be 0, or 0.01 to 100",
                       NUMBER(full.detail));
    if ((unsigned)full.smooth > DP_SMOOTH_SURFACE || full.smooth_level > DP_SMOOTH_LEVELS)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "smoothing is not one of its values, or its level, %u, is above %d",
                       full.smooth_level, DP_SMOOTH_LEVELS);
    if (full.between_offset == 0) full.between_offset = 1;
    if (!(full.between_offset > 0) || !isfinite(full.between_offset))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the between offset must be above zero");
    if ((result = resolve_shade(&full.shade, diag)) ||
        (result = resolve_edge_map(&full.edge_map, diag)) ||
        (result = resolve_mirror(&full.mirror, diag)))
        return result;
    if (full.shade.shading == DP_SHADING_PAPER) full.surface = DP_COLOR_NONE;
    full.paper = color_or(full.paper, DP_RGB(255, 255, 255));
    full.surface = color_or(full.surface, DP_RGB(255, 255, 255));
    *resolved = full;
    return DP_OK;
}
