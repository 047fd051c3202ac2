/* The passes over the whole picture, between finding lines and inking them (Nienhaus and Döllner
 * 2003, 4, "Rendering Passes"). The tiles have filled the G-buffer.
 *
 *     0  SHADE    G-buffer -> color        right after the tile is filled, if the style needs no
 *                                            other pixel
 *     1  CARTOON  color -> smooth          toon with a cartoon map
 *     2  STORE    G-buffer to 8 bits       only if asked for
 *     3  EDGES    G-buffer -> edge map, and its edges over color (or smooth)
 *     4  RESOLVE  color (or smooth) -> target
 *
 * Each pass runs over tiles in parallel and reads what earlier passes left around its pixels. It
 * visits only the spans of rows that hold a surface, so that background costs nothing. */
#include "shade/passes.h"

#include "base/kernels.h"
#include "shade/pencil.h"

#include <string.h>

enum { SHADE, CARTOON, STORE, EDGES, RESOLVE };

/* Toon, from N·L = -1 to 1. All that the light does not reach has one shade. */
const uint8_t dp_toon_shades[DP_TOON_SHADES][4] = {
    {96, 96, 96, 255},    {96, 96, 96, 255},    {96, 96, 96, 255},    {96, 96, 96, 255},
    {156, 156, 156, 255}, {208, 208, 208, 255}, {208, 208, 208, 255}, {255, 255, 255, 255}};

static const dp_array arrays[] = {
    DP_ARRAY(dp_shade_store, color, color_cap), DP_ARRAY(dp_shade_store, smooth, smooth_cap),
    DP_ARRAY(dp_shade_store, inked, inked_cap), DP_ARRAY(dp_shade_store, hatching, hatching_cap),
    DP_ARRAY(dp_shade_store, halftone, halftone_cap)};

void dp_shade_store_free(dp_shade_store *s, const dp_allocator *memory) {
    dp_gbuffer_free(&s->gbuffer, memory);
    dp_pencil_store_free(&s->pencil, memory);
    dp_arrays_free(memory, s, DP_ARRAYS(arrays));
    *s = (dp_shade_store){0};
}

uint64_t dp_shade_store_bytes(const dp_shade_store *s) {
    return dp_gbuffer_bytes(&s->gbuffer) + dp_pencil_store_bytes(&s->pencil) +
           dp_arrays_bytes(s, DP_ARRAYS(arrays));
}

/* Does any group have the model's colours? */
static bool has_model_colors(const dp_frame *frame) {
    for (uint32_t i = 0; i < frame->style_count; i++)
        if (frame->styles[i].shade.model_colors) return true;
    return false;
}

static bool is_shaded(const dp_frame *frame) {
    const dp_shading shading = frame->styles[0].shade.shading;
    return (shading != DP_SHADING_FLAT && shading != DP_SHADING_PAPER) || has_model_colors(frame);
}

static bool wants_colors(const dp_frame *frame, bool mirror) {
    const dp_edge_map *const map = &frame->styles[0].edge_map;
    return frame->target.rgba && (is_shaded(frame) || mirror || (map->detector && !map->hidden));
}

static bool wants_planes(const dp_target *t) { return t->eye_normal || t->distance || t->id; }

static bool is_active(const dp_frame *frame, bool mirror) {
    return wants_colors(frame, mirror) || wants_planes(&frame->target) || frame->target.edge_map;
}

bool dp_shade_needs_normals(const dp_shade_store *s) {
    const dp_frame *const frame = s->frame;
    const dp_normals normals = frame->styles[0].shade.normals;
    return s->active && (normals == DP_NORMALS_SMOOTH ||
                         (normals == DP_NORMALS_MODEL && !frame->polygons.normals.values));
}

bool dp_shade_uses_model_normals(const dp_shade_store *s) {
    return s->active && s->frame->styles[0].shade.normals == DP_NORMALS_MODEL &&
           s->frame->polygons.normals.values;
}

static bool make_texture(uint8_t **values, size_t *cap, void (*make)(uint8_t *),
                         const dp_allocator *memory) {
    if (*values) return true;
    if (!dp_reserve(memory, values, cap, (size_t)DP_STROKES_SIZE * DP_STROKES_SIZE, 1))
        return false;
    make(*values);
    return true;
}

static bool choose_strokes(dp_shade_store *s, const dp_allocator *memory) {
    const dp_shade *const shade = &s->setup.shade;
    if (shade->shading != DP_SHADING_HATCH && shade->shading != DP_SHADING_HALFTONE) return true;
    const bool dots = shade->shading == DP_SHADING_HALFTONE;
    s->setup.strokes =
        (dp_strokes_texture){shade->strokes.values, shade->strokes.width, shade->strokes.height};
    if (shade->strokes.values) return true;
    if (!make_texture(dots ? &s->halftone : &s->hatching,
                      dots ? &s->halftone_cap : &s->hatching_cap,
                      dots ? dp_make_halftone : dp_make_hatching, memory))
        return false;
    s->setup.strokes =
        (dp_strokes_texture){dots ? s->halftone : s->hatching, DP_STROKES_SIZE, DP_STROKES_SIZE};
    return true;
}

/* A float of the exponent e is a power of two, 2^(e - 127). */
void dp_anchor_strokes(const double origin[3], uint32_t width, uint32_t height,
                       dp_hatch_anchor *out) {
    const double a = (double)DP_HATCH_COSINE, b = (double)DP_HATCH_SINE;
    for (int k = 0; k < 3; k++)
        for (int e = 0; e < 256; e++) {
            const double u = ldexp(origin[(k + 1) % 3], e - 127),
                         v = ldexp(origin[(k + 2) % 3], e - 127);
            (*out)[k][0][e] = (float)fmod(a * u + b * v, width);
            (*out)[k][1][e] = (float)fmod(a * v - b * u, height);
        }
}

/* Do strokes stick to the surface along the model's texture coordinates? */
static bool wants_texcoords(const dp_shade_store *s) {
    const dp_shade *const shade = &s->setup.shade;
    return (shade->shading == DP_SHADING_HATCH || shade->shading == DP_SHADING_HALFTONE) &&
           shade->object_space && s->frame->polygons.texcoords.values;
}

static bool wants_own_colors(const dp_shade_store *s) {
    const dp_polygons *const p = &s->frame->polygons;
    return s->colored &&
           ((s->model_colors && p->colors && s->setup.shade.shading != DP_SHADING_PAPER) ||
            dp_colors_sections(s->frame));
}

bool dp_shade_gathered(dp_shade_store *s) {
    if (!s->active) return true;
    if (!dp_gbuffer_begin(&s->gbuffer, s->frame, wants_texcoords(s), wants_own_colors(s)))
        return false;
    s->gbuffer.polygon = NULL;
    return s->setup.shade.shading != DP_SHADING_PENCIL ||
           dp_pencil_begin(&s->pencil, s->frame, &s->gbuffer, &s->setup);
}

static void set_up(dp_shade_store *s, const dp_frame *frame) {
    const dp_shade *const shade = &frame->styles[0].shade;
    const dp_color ink = shade->ink;
    s->model_colors = has_model_colors(frame);
    s->setup = (dp_shading_setup){.shade = *shade,
                                  .g = &s->gbuffer,
                                  .shades = shade->shades.values,
                                  .shade_count = shade->shades.width};
    for (int k = 0; k < 3; k++) s->setup.ink[k] = (float)(ink >> (24 - 8 * k) & 0xff) / 255;
    s->setup.ink_alpha = (float)(ink & 0xff) / 255;
    if (s->setup.shades) return;
    s->setup.shades = dp_toon_shades[0];
    s->setup.shade_count = DP_TOON_SHADES;
}

bool dp_shade_begin(dp_shade_store *s, const dp_frame *frame) {
    s->frame = frame;
    s->active = is_active(frame, s->mirrored);
    s->colored = wants_colors(frame, s->mirrored);
    if (!s->active) return true;
    const size_t pixels = (size_t)frame->target.width * frame->target.height;
    s->shaders = dp_shaders_for(dp_lanes_best());
    set_up(s, frame);
    const dp_shade *const shade = &s->setup.shade;
    const bool smooth = shade->shading == DP_SHADING_TOON && !shade->nearest;
    if (!choose_strokes(s, frame->memory) ||
        (s->colored &&
         !dp_reserve(frame->memory, &s->color, &s->color_cap, dp_times(4, pixels), 1)) ||
        (s->colored && smooth &&
         !dp_reserve(frame->memory, &s->smooth, &s->smooth_cap, dp_times(4, pixels), 1)))
        return false;
    if (frame->origin[0] != 0 || frame->origin[1] != 0 || frame->origin[2] != 0) {
        dp_anchor_strokes(frame->origin, s->setup.strokes.width, s->setup.strokes.height,
                          &s->anchor);
        s->setup.anchor = (const dp_hatch_anchor *)&s->anchor;
    }
    s->shown = smooth ? s->smooth : s->color;
    return true;
}

/* ------- shading ------- */

static dp_color surface_of(const dp_shade_store *s, uint16_t id) {
    const uint32_t group = id - 1u;
    const dp_style *const styles = s->frame->styles, *const style =
                                                         &styles[dp_style_number(s->frame, group)];
    const dp_color own = style->shade.model_colors && style->shade.shading != DP_SHADING_PAPER
                             ? dp_source_group_color(s->source, group)
                             : 0;
    const dp_color c = own ? own : style->surface;
    return c & 0xff ? c : styles[0].paper;
}

static void to_floats(dp_color c, float rgba[4]) {
    for (int k = 0; k < 4; k++) rgba[k] = (float)(c >> (24 - 8 * k) & 0xff) / 255;
}

/* Paints each stretch of one group in that group's colour. */
static void paint_groups(const dp_shade_store *s, dp_shade_run *run) {
    for (uint32_t i = 0, end; i < run->n; i = end) {
        float rgba[4];
        for (end = i + 1; end < run->n && run->id[end] == run->id[i]; end++) {
        }
        to_floats(run->id[i] ? surface_of(s, run->id[i]) : 0, rgba);
        for (uint32_t k = i; k < end; k++) {
            run->color[0][k] = rgba[0], run->color[1][k] = rgba[1], run->color[2][k] = rgba[2];
            run->alpha[k] = rgba[3];
        }
    }
}

/* Where pixels have colours of their own, these replace the group's (gbuffer/fill.c). */
static void paint_own_colors(const uint32_t *color, dp_shade_run *run) {
    for (uint32_t i = 0; i < run->n; i++) {
        float rgba[4];
        if (!run->id[i] || !color[i]) continue;
        to_floats(color[i], rgba);
        run->color[0][i] = rgba[0], run->color[1][i] = rgba[1], run->color[2][i] = rgba[2];
        run->alpha[i] = rgba[3];
    }
}

static void begin_run(const dp_shade_store *s, uint32_t y, uint32_t x0, uint32_t x1,
                      dp_shade_run *run) {
    const dp_gbuffer *const g = &s->gbuffer;
    const size_t at = (size_t)y * g->stride + x0;
    run->nx = g->nx + at, run->ny = g->ny + at, run->nz = g->nz + at,
    run->distance = g->distance + at;
    run->u = g->u ? g->u + at : NULL, run->v = g->v ? g->v + at : NULL, run->id = g->id + at;
    run->stride = g->stride, run->x = x0, run->y = y, run->n = x1 - x0;
    if (s->frame->style_count == 1 && !s->model_colors) {
        float rgba[4];
        to_floats(surface_of(s, 1), rgba);
        s->shaders->paint(rgba, run);
    } else {
        paint_groups(s, run);
    }
    if (g->colored) paint_own_colors(g->color + at, run);
}

static void end_run(const dp_shade_store *s, const dp_shade_run *run) {
    uint32_t words[DP_TILE];
    s->shaders->pack(run, words);
    memcpy(s->color + 4 * ((size_t)run->y * s->gbuffer.width + run->x), words, 4 * (size_t)run->n);
}

/* Where a pixel shows the mirror, puts the picture of the reflected scene. */
static void put_mirror(const dp_shade_store *s, const dp_shade_run *run) {
    const size_t at = (size_t)run->y * s->gbuffer.width + run->x;
    for (uint32_t i = 0; i < run->n; i++)
        if (run->id[i] == 1 + DP_MIRROR_GROUP)
            memcpy(s->color + 4 * (at + i), s->mirrored + 4 * (at + i), 4);
}

static void shade_tile(dp_shade_store *s, uint32_t tile) {
    const dp_shading shading = s->setup.shade.shading;
    dp_shade_operator *const style =
        shading == DP_SHADING_PENCIL ? dp_shade_pencil : s->shaders->styles[shading];
    const dp_gbuffer *const g = &s->gbuffer;
    const uint32_t first = tile / g->tiles_x * DP_TILE;
    for (uint32_t row = 0; row < DP_TILE && first + row < g->height; row++) {
        uint32_t x0, x1;
        dp_shade_run run;
        if (!dp_gbuffer_span(g, tile, row, &x0, &x1)) continue;
        x0 -= x0 % DP_TILE % DP_GBUFFER_STRIP;
        begin_run(s, first + row, x0, x1, &run);
        if (style) style(&s->setup, &run);
        end_run(s, &run);
        if (s->mirrored) put_mirror(s, &run);
    }
}

/* Strokes along texture coordinates take their scale from neighbouring pixels. */
static bool looks_around(const dp_shade_store *s) { return s->gbuffer.textured; }

bool dp_shade_at_once(dp_shade_store *s, uint32_t tile) {
    if (!s->colored || looks_around(s)) return false;
    shade_tile(s, tile);
    return true;
}

/* ------- the target's own planes ------- */

static void clear_outputs(const dp_target *t) {
    const size_t pixels = (size_t)t->width * t->height;
    if (t->edge_map) memset(t->edge_map, 255, 4 * pixels);
    if (t->eye_normal) memset(t->eye_normal, 0, 3 * pixels * sizeof(float));
    if (t->id) memset(t->id, 0, pixels * sizeof *t->id);
    for (size_t i = 0; t->distance && i < pixels; i++) t->distance[i] = INFINITY;
}

static void put_outputs(const dp_shade_store *s, uint32_t tile) {
    const dp_gbuffer *const g = &s->gbuffer;
    const dp_target *const t = &s->frame->target;
    const uint32_t first = tile / g->tiles_x * DP_TILE, tile_x = tile % g->tiles_x * DP_TILE;
    for (uint32_t row = 0; row < DP_TILE && first + row < g->height; row++)
        for (uint64_t bits = g->mask[(size_t)tile * DP_TILE + row]; bits; bits &= bits - 1) {
            const uint32_t x = tile_x + (uint32_t)__builtin_ctzll(bits), y = first + row;
            const size_t from = (size_t)y * g->stride + x, to = (size_t)y * g->width + x;
            if (dp_gbuffer_is_partial(g, from)) continue;
            if (t->eye_normal) {
                t->eye_normal[3 * to] = g->nx[from];
                t->eye_normal[3 * to + 1] = g->ny[from];
                t->eye_normal[3 * to + 2] = g->nz[from];
            }
            if (t->distance) t->distance[to] = g->distance[from];
            if (t->id) t->id[to] = g->id[from];
        }
}

/* ------- the passes ------- */

void dp_shade_prepare(dp_shade_store *s) {
    const dp_edge_map *const map = &s->frame->styles[0].edge_map;
    if (map->detector && (map->as_printed || map->eight_bits))
        dp_gbuffer_fit_range(&s->gbuffer, s->frame, map->enhanced, map->enhanced_count);
    dp_gbuffer_pad(&s->gbuffer);
    clear_outputs(&s->frame->target);
}

bool dp_shade_pass_runs(const dp_shade_store *s, int pass) {
    const dp_edge_map *const map = &s->frame->styles[0].edge_map;
    switch (pass) {
    case SHADE:
        return s->colored && looks_around(s);
    case CARTOON:
        return s->colored && s->shown == s->smooth;
    case STORE:
        return map->detector && map->eight_bits;
    case EDGES:
        return map->detector;
    default:
        return true;
    }
}

void dp_shade_pass_ends(dp_shade_store *s, int pass) {
    if (pass == STORE && dp_shade_pass_runs(s, pass)) dp_gbuffer_pad(&s->gbuffer);
}

void dp_shade_pass(dp_shade_store *s, int pass, uint32_t tile) {
    switch (pass) {
    case SHADE:
        shade_tile(s, tile);
        break;
    case CARTOON:
        dp_cartoon_map_tile(s, tile);
        break;
    case STORE:
        dp_gbuffer_quantize(&s->gbuffer, tile);
        break;
    case EDGES:
        dp_edges_tile(s, tile);
        break;
    default:
        if (s->colored) dp_resolve_tile(s, tile);
        if (wants_planes(&s->frame->target)) put_outputs(s, tile);
        break;
    }
}
