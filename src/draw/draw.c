/* Drawing one picture: the stages in order. The context keeps their memory (context.c).
 *
 *     source → gather (→ smooth) → vertices → bin → tiles (faces, edges, visibility) → segments, chains
 *            → shading → sink (ink) → target
 *
 * Each stage runs in parallel over blocks, chunks or tiles and ends before the next begins. What a
 * stage hands on is in submission or tile order, so that the picture does not depend on threads. */
#include "draw/context.h"
#include "draw/tile.h"

#include "base/diag.h"
#include "base/elementary.h"
#include "features/features.h"
#include "base/kernels.h"
#include "mesh/source.h"
#include "core/closed.h"
#include "core/precision.h"
#include "core/facing.h"
#include "printed/fins.h"
#include "features/silhouette_edge.h"
#include "sink/sink.h"
#include "stream/stream.h"
#include "vector/once.h"
#include "strokes/hidden.h"

#include <string.h>
#include <time.h>

/* Tiles are widened by this, so that an edge along a tile's border meets both its polygons (px). */
static const float MARGIN = 0.75f;

/* Quads as ink: a polygon's added polygons may reach a tile that it does not. */
static float margin_of(const dp_frame *f) {
    float widest = 0;
    if (f->styles[0].ink != DP_INK_QUADS || f->styles[0].edges == DP_EDGES_ADJACENCY) return MARGIN;
    for (uint32_t i = 0; i < f->style_count; i++)
        for (int k = 0; k < DP_LINE_COUNT; k++) widest = fmaxf(widest, f->styles[i].line[k].width);
    return 1 + widest * (f->styles[0].method == DP_METHOD_PAPER ? (float)DP_PAPER_MARGIN : 1);
}

const char *dp_stage_name(dp_stage stage) {
    static const char *const names[DP_STAGE_COUNT] = {"gather",   "vertices", "bin", "tiles",
                                                      "segments", "shade",    "ink"};
    return (unsigned)stage < DP_STAGE_COUNT ? names[stage] : "unknown";
}

/* ------- stages ------- */

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory while drawing");
}

/* Nothing that is made for a picture's pixels and samples takes more bytes than this at once. */
static size_t largest_array(const dp_target *t) {
    enum { BYTES_PER_PIXEL = 4 * sizeof(float) }; /* of planes; of depth, one float per sample */
    const size_t tiles =
        (size_t)((t->width + DP_TILE - 1) / DP_TILE) * ((t->height + DP_TILE - 1) / DP_TILE);
    const size_t bytes = t->samples * sizeof(float);
    return dp_times(tiles, (size_t)DP_TILE * DP_TILE *
                               (bytes > BYTES_PER_PIXEL ? bytes : BYTES_PER_PIXEL));
}

dp_result dp_check_target(const dp_target *target, dp_target *out, dp_diag *diag) {
    *out = *target;
    if (!out->samples) out->samples = 4;
    if (!out->rgba_stride) out->rgba_stride = 4 * (size_t)out->width;
    if (out->width < 1 || out->height < 1 || out->width > DP_PICTURE_MOST ||
        out->height > DP_PICTURE_MOST)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the picture is %u x %u px; each side must be 1 to %d", out->width,
                       out->height, DP_PICTURE_MOST);
    if (out->samples != 1 && out->samples != 4 && out->samples != 8 && out->samples != 16)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u samples per pixel; it must be 1, 4, 8 or 16",
                       out->samples);
    if (out->rgba_stride < 4 * (size_t)out->width)
        return dp_fail(diag, DP_ERR_ARGUMENT, "rgba_stride is less than a row of pixels");
    if (largest_array(out) > PTRDIFF_MAX)
        return dp_fail(diag, DP_ERR_LIMIT,
                       "%u x %u px of %u samples are more than %zu bits of address can hold",
                       out->width, out->height, out->samples, 8 * sizeof(size_t));
    return DP_OK;
}

/* What kernels need of the view, in float32. */
static void begin_view(dp_frame *f) {
    const float size = (float)(1 / f->view.focal);
    f->lanes = dp_lanes_best();
    dp_begin_hidden(f);
    f->culls_backs =
        f->styles[0].ink == DP_INK_STROKES || f->styles[0].edges == DP_EDGES_ADJACENCY || !f->lines;
    f->nearly_edge_on = dp_nearly_edge_on(&f->view);
    f->step_scale = f->view.perspective ? size : 0;
    f->step_offset = f->view.perspective ? 0 : size;
    f->touching = DP_TOUCHING, f->crack = DP_CRACK, f->precision = 0;
}

static bool begin_workers(dp_context *c) {
    for (uint32_t i = 0; i < c->workers; i++) {
        dp_bin_worker_begin(&c->bin_workers[i]);
        if (!dp_finder_begin(&c->finders[i], &c->frame, &c->found[i])) return false;
    }
    return true;
}

/* Sizes what depends on the picture. */
static bool begin_frame(dp_context *c) {
    dp_frame *const f = &c->frame;
    f->tiles_x = (f->target.width + DP_TILE - 1) / DP_TILE;
    f->tiles_y = (f->target.height + DP_TILE - 1) / DP_TILE;
    f->tile_samples = (size_t)DP_TILE * DP_TILE * f->target.samples;
    const size_t tiles = (size_t)f->tiles_x * f->tiles_y;
    return dp_reserve(&c->memory, &f->depth, &f->depth_cap, dp_times(tiles, f->tile_samples),
                      sizeof *f->depth) &&
           dp_reserve(&c->memory, &f->tile_pieces, &f->tile_pieces_cap, tiles,
                      sizeof *f->tile_pieces) &&
           begin_workers(c);
}

/* Half a degree short of the least fold that any group draws, a right angle at the most; above 1
 * where flat edges are lines too. */
static float flat_cosine(const dp_style *styles, uint32_t count) {
    float least = 180;
    for (uint32_t i = 0; i < count; i++)
        least = dp_minf(least, dp_minf(180 - styles[i].ridge_angle, styles[i].valley_angle - 180));
    return least > 1
               ? (float)dp_cos(((double)dp_minf(least, 90) - 0.5) * 3.14159265358979323846 / 180)
               : 2;
}

static void find_tile(void *arg, uint32_t index, uint32_t worker) {
    dp_context *const c = arg;
    c->frame.tile_pieces[index].worker = worker;
    dp_draw_tile(&c->finders[worker], &c->printers[worker], index);
    const bool xray = c->frame.xray && c->frame.target.rgba && !c->frame.tile_pieces[index].empty;
    dp_tile *const tile = &c->finders[worker].tile;
    if (xray) dp_xray_take(&c->xray, tile, worker, 0);
    if (c->shade.active) {
        dp_gbuffer_fill(&c->shade.gbuffer, tile, c->frame.styles[0].shade.normals);
        dp_shade_at_once(&c->shade, index); /* while it is in the cache */
    }
    if (xray && c->xray.plain) dp_xray_peel_all(&c->xray, tile, worker);
}

static void shade_tile(void *arg, uint32_t index, uint32_t worker) {
    dp_context *const c = arg;
    (void)worker;
    dp_shade_pass(&c->shade, c->shade_pass, index);
}

/* Progress when a stage is over; what is read in parts ends at DP_STREAMED instead. */
static const double TRANSFORMED = 0.06, PAIRED = 0.08, BINNED = 0.1, FOUND = 0.8, SHADED = 0.85,
                    XRAYED = 0.93;

/* A part of a long loop, so that progress can be told between the parts. */
typedef struct part {
    dp_task *task;
    void *arg;
    uint32_t first;
} part;

static void part_task(void *arg, uint32_t index, uint32_t worker) {
    const part *const p = arg;
    p->task(p->arg, p->first + index, worker);
}

dp_result dp_tell_progress(dp_context *c, double fraction, dp_diag *diag) {
    if (!c->progress) return DP_OK;
    /* min: the sum may be rounded up, and the end is to be met exactly */
    const double done = c->share_from + (c->share_to - c->share_from) * fraction;
    const double told = fraction < 0 ? -1 : fraction >= 1 ? c->share_to : dp_min(done, c->share_to);
    if (told >= 0) c->told = told;
    if (c->progress(c->user, told)) return dp_fail(diag, DP_ERR_CANCELLED, "drawing was stopped");
    return DP_OK;
}

/* Progress runs from `from` to `to`. */
dp_result dp_for_tiles(dp_context *c, dp_task *task, void *arg, double from, double to,
                       dp_diag *diag) {
    const uint32_t tiles = c->frame.tiles_x * c->frame.tiles_y;
    const uint32_t step = c->progress && tiles > 64 ? (tiles + 15) / 16 : tiles;
    for (uint32_t first = 0; first < tiles; first += step) {
        part p = {task, arg, first};
        dp_parallel(c->threads, tiles - first < step ? tiles - first : step, part_task, &p);
        const double done = tiles - first > step ? (double)(first + step) / tiles : 1;
        const dp_result result =
            dp_tell_progress(c, done < 1 ? dp_min(from + (to - from) * done, to) : to, diag);
        if (result) return result;
    }
    return DP_OK;
}

static void add_counts(dp_stats *sum, const dp_stats *s) {
    sum->dropped_index += s->dropped_index;
    sum->dropped_finite += s->dropped_finite;
    sum->dropped_area += s->dropped_area;
    sum->dropped_corners += s->dropped_corners;
    sum->clipped += s->clipped;
    sum->edges_resolved += s->edges_resolved;
    sum->edges_emergent += s->edges_emergent;
    sum->open_edges += s->open_edges;
    sum->added_polygons += s->added_polygons;
}

/* An error when nothing is left. */
static dp_result check_dropped(dp_stats *s, dp_diag *diag) {
    s->dropped = s->dropped_index + s->dropped_finite + s->dropped_area + s->dropped_corners;
    if (!s->dropped || s->dropped < s->polygons) return DP_OK;
    return dp_fail(
        diag, DP_ERR_FORMAT,
        "none of the %llu polygons can be drawn: %llu with indices out of range, %llu with "
        "coordinates that are not finite, %llu without area, %llu with fewer than 3 corners",
        (unsigned long long)s->polygons, (unsigned long long)s->dropped_index,
        (unsigned long long)s->dropped_finite, (unsigned long long)s->dropped_area,
        (unsigned long long)s->dropped_corners);
}

static void lap(dp_stats *stats, dp_stage stage, double *since) {
    const double now = now_ms();
    stats->stage_ms[stage] = now - *since;
    *since = now;
}

/* Does any texture need the centre of the picture? */
bool dp_needs_centre(const dp_frame *f) {
    for (uint32_t i = 0; i < f->style_count; i++) {
        const dp_style *const s = &f->styles[i];
        if (s->pattern.texture || (s->stroke.texture && s->stroke.u != DP_STROKE_ARC)) return true;
    }
    return dp_draws_fins(f);
}

/* Who paints: the tiles, or shading after them. Tiles that ink before surfaces are shaded (quads,
 * silhouette fins) do so on a layer of its own then. False when memory is out. */
static bool begin_paint(dp_context *c) {
    dp_frame *const f = &c->frame;
    const bool inks_early = f->lines && (f->styles[0].ink == DP_INK_QUADS || dp_draws_fins(f));
    f->painted_later = c->shade.colored || (f->xray && f->target.rgba);
    if (!f->painted_later || !inks_early) return true;
    if (!dp_reserve(&c->memory, &c->shade.inked, &c->shade.inked_cap,
                    dp_times(4, (size_t)f->target.width * f->target.height), 1))
        return false;
    f->ink_layer = c->shade.inked;
    return true;
}

/* Adjacency, kept from the last frame where the topology is the same, and what faces the eye. */
static bool find_adjacency(dp_context *c) {
    dp_frame *const f = &c->frame;
    bool built;
    if (!dp_adjacency_update(&c->adjacency, &f->polygons, c->threads, &c->memory, &built) ||
        !dp_reserve(&c->memory, &f->facing, &f->facing_cap, f->polygons.count, sizeof *f->facing) ||
        !dp_reserve(&c->memory, &f->outlined, &f->outlined_cap, f->polygons.count,
                    sizeof *f->outlined))
        return false;
    f->adjacency = &c->adjacency;
    c->stats.adjacency_ms = built ? c->adjacency.ms : 0;
    c->stats.adjacency_bytes = dp_adjacency_bytes(&c->adjacency);
    dp_find_facing(f);
    f->fin_reach = dp_draws_fins(f) ? dp_fin_reach(f) : 0;
    return true;
}

static dp_result report(void *arg, double done, dp_diag *diag) {
    return dp_tell_progress(arg, done, diag);
}

static dp_result stream_lines(dp_context *c, dp_source *source, double *since, dp_diag *diag) {
    const dp_stream_setup setup = {&c->frame, c->finders, c->bin_workers, c->workers,
                                   c->limit,  &c->stats,  report,         c};
    c->frame.exact_ends = false; /* tiles do not hold what hides their lines */
    dp_result result = dp_stream_read_model(&setup, source, &c->stream, diag);
    if (result) return result;
    lap(&c->stats, DP_STAGE_GATHER, since);
    if ((result = dp_stream_find(c->stream, diag))) return result;
    lap(&c->stats, DP_STAGE_TILES, since);
    for (uint32_t i = 0; i < c->workers; i++) add_counts(&c->stats, &c->finders[i].tile.stats);
    return check_dropped(&c->stats, diag);
}

static dp_result place_vertices(dp_context *c, dp_diag *diag) {
    dp_frame *const f = &c->frame;
    if (!dp_reserve(&c->memory, &f->vertices, &f->vertices_cap, f->polygons.vertex_count,
                    sizeof *f->vertices))
        return out_of_memory(diag);
    dp_transform_vertices(f);
    if (!dp_find_closed(f)) return out_of_memory(diag);
    dp_find_tolerances(f);
    dp_result result = dp_tell_progress(c, TRANSFORMED, diag);
    if (!result && f->styles[0].edges == DP_EDGES_ADJACENCY)
        result = find_adjacency(c) ? dp_tell_progress(c, PAIRED, diag) : out_of_memory(diag);
    if (!result && dp_needs_centre(f)) dp_find_centre(f);
    return result;
}

bool dp_compute_normals(dp_context *c, dp_source *source, dp_attribute *out) {
    return dp_normals_make(&c->normals, &c->frame.polygons, c->frame.styles[0].shade.crease_angle,
                           source->constant ? &source->key : NULL, c->threads, &c->memory, out);
}

/* Normals for shading: made ones, also of those batches that have none. */
static bool make_normals(dp_context *c, dp_source *source) {
    dp_polygons *const p = &c->frame.polygons;
    dp_attribute_store *const gathered = &c->polygons.normals;
    const size_t corners = dp_first_corner(p, p->count);
    dp_attribute made;
    if (dp_shade_needs_normals(&c->shade)) return dp_compute_normals(c, source, &p->normals);
    if (!dp_shade_uses_model_normals(&c->shade) || p->normals.values != gathered->values ||
        !dp_attribute_lacks(gathered, corners))
        return true;
    if (!dp_compute_normals(c, source, &made) ||
        !dp_attribute_fill(gathered, &made, 3, corners, &c->memory))
        return false;
    p->normals = dp_attribute_of_store(gathered, 3);
    return true;
}

/* What is made of a model that moves is made again in each frame, and keeps its scratch. */
static void expect_motion(dp_context *c, bool moves) {
    c->normals.moves = c->smooth.edges.moves = c->shade.pencil.curvature.moves = moves;
}

static dp_result find_lines(dp_context *c, dp_source *source, double *since, dp_diag *diag) {
    dp_frame *const f = &c->frame;
    bool streams;
    dp_result result = dp_gather_picture(c, source, &streams, diag);
    if (result) return result;
    if (streams) return stream_lines(c, source, since, diag);
    if (f->styles[0].smooth && f->polygons.mark_count)
        return dp_fail(
            diag, DP_ERR_UNSUPPORTED,
            "a model with sections cannot be drawn smooth: its surface would leave them");
    expect_motion(c, source->moves);
    if (f->styles[0].smooth && (result = dp_smooth_frame(c, source, diag))) return result;
    c->shade.pencil.curvature.ms = 0; /* of an earlier picture */
    if (!dp_shade_gathered(&c->shade)) return out_of_memory(diag);
    c->stats.curvature_ms = c->shade.pencil.curvature.ms;
    if (!f->styles[0].smooth && !make_normals(c, source)) return out_of_memory(diag);
    if (c->shade.active && f->polygons.normals.values) {
        if (!dp_normals_pack(&c->normals, &f->polygons, c->threads, &c->memory))
            return out_of_memory(diag);
        c->shade.gbuffer.normals = &c->normals.packed;
    }
    lap(&c->stats, DP_STAGE_GATHER, since);
    if ((result = dp_tell_progress(c, DP_GATHERED, diag))) return result;
    if ((result = place_vertices(c, diag))) return result;
    lap(&c->stats, DP_STAGE_VERTICES, since);
    if (!dp_bin_polygons(f, margin_of(f), c->bin_workers) || !dp_bin_marks(f))
        return out_of_memory(diag);
    for (uint32_t i = 0; i < c->workers; i++) add_counts(&c->stats, &c->bin_workers[i].stats);
    lap(&c->stats, DP_STAGE_BIN, since);
    if ((result = check_dropped(&c->stats, diag))) return result;
    if ((result = dp_tell_progress(c, BINNED, diag))) return result;
    if (!begin_paint(c)) return out_of_memory(diag);
    if ((result = dp_for_tiles(c, find_tile, c, BINNED, FOUND, diag))) return result;
    for (uint32_t i = 0; i < c->workers; i++) {
        if (c->finders[i].tile.failed) return out_of_memory(diag);
        add_counts(&c->stats, &c->finders[i].tile.stats);
    }
    lap(&c->stats, DP_STAGE_TILES, since);
    return DP_OK;
}

/* Shading and edge map: passes over the picture, each over before the next begins. */
dp_result dp_shade_picture(dp_context *c, double first, double last, dp_diag *diag) {
    if (!c->shade.active) return DP_OK;
    dp_shade_prepare(&c->shade);
    for (int pass = 0; pass < DP_SHADE_PASSES; pass++) {
        const double share = (last - first) / DP_SHADE_PASSES, from = first + pass * share;
        if (!dp_shade_pass_runs(&c->shade, pass)) continue;
        c->shade_pass = pass;
        const dp_result result = dp_for_tiles(c, shade_tile, c, from, from + share, diag);
        if (result) return result;
        dp_shade_pass_ends(&c->shade, pass);
    }
    return DP_OK;
}

/* The last loop over tiles, as the raster sink runs it. */
typedef struct last_loop {
    dp_context *context;
    double from, to;
} last_loop;

static dp_result for_last_tiles(void *user, dp_task *task, void *arg, dp_diag *diag) {
    const last_loop *const l = user;
    return dp_for_tiles(l->context, task, arg, l->from, l->to, diag);
}

/* From the tiles' pieces to what is inked: stylized strokes and dashes of hidden lines too. */
static bool make_lines(dp_context *c) {
    const dp_frame *const f = &c->frame;
    dp_lines *const lines = &c->drawing;
    if (!dp_make_segments(f, c->found, lines) || !dp_clean_lines(f, lines, &c->detail) ||
        !dp_finish_hidden(f, lines))
        return false;
    c->inks_once = dp_strokes_have_gaps(f);
    dp_lines *const inked = c->inks_once ? &c->once : lines;
    if (c->inks_once && !dp_lines_once(f, lines, inked, &c->once_scratch)) return false;
    if (f->hidden && !(dp_chain_lines(f, inked) && dp_ink_hidden(f, inked, lines))) return false;
    return dp_stylize(f, inked);
}

static dp_result ink(dp_context *c, double from, dp_diag *diag) {
    last_loop loop = {c, from, 1};
    dp_inking inking = {&c->frame,
                        &c->drawing,
                        &c->raster,
                        for_last_tiles,
                        &loop,
                        false,
                        c->frame.xray && c->frame.target.rgba ? &c->xray : NULL};
    const dp_sink sink = dp_raster_sink(&inking);
    const bool once = c->drawing.stylizes && c->inks_once;
    if (c->drawing.stylizes &&
        (inking.xray || dp_is_hidden_inked(&c->drawing))) { /* below stylized strokes */
        inking.plain = true;
        loop.to = from + (1 - from) / 2;
        const dp_result result = dp_hand_over(&c->frame, &c->drawing, &sink, diag);
        if (result) return result;
        inking.plain = false, inking.xray = NULL;
        loop = (last_loop){c, loop.to, 1};
    }
    if (once) inking.drawing = &c->once;
    return dp_hand_over(&c->frame, inking.drawing, &sink, diag);
}

/* start: when reading the source began. */
static dp_result draw_stages(dp_context *c, dp_source *source, double start, dp_diag *diag) {
    double since = start;
    c->shade.source = source;
    if (!begin_frame(c) || !dp_shade_begin(&c->shade, &c->frame) ||
        (c->frame.xray && c->frame.target.rgba &&
         !dp_xray_begin(&c->xray, &c->frame, c->workers, c->shade.colored)))
        return out_of_memory(diag);
    dp_result result = find_lines(c, source, &since, diag);
    if (result) return result;
    if (!make_lines(c)) return out_of_memory(diag);
    c->stats.segments = c->drawing.count;
    lap(&c->stats, DP_STAGE_SEGMENTS, &since);
    dp_shade_layer(c, 0);
    if ((result = dp_shade_picture(c, FOUND, SHADED, diag)) ||
        (result = dp_draw_layers(c, SHADED, XRAYED, diag)))
        return result;
    lap(&c->stats, DP_STAGE_SHADE, &since);
    if ((result = ink(c, c->stream ? DP_STREAMED : c->frame.xray ? XRAYED : SHADED, diag)))
        return result;
    lap(&c->stats, DP_STAGE_INK, &since);
    c->stats.frame_ms = now_ms() - start;
    return DP_OK;
}

static dp_result draw(dp_context *c, dp_source *source, double start, dp_diag *diag) {
    const double from = c->share_from;
    const dp_result result = draw_stages(c, source, start, diag);
    c->share_from = from;
    dp_stream_free(c->stream);
    c->stream = NULL;
    return result;
}

void dp_forget_drawing(dp_context *c) {
    c->drawn = false;
    c->told = 0;
    c->drawing.count = 0;
    c->drawing.chained = false;
}

/* The view of positions about the source's origin. */
static dp_result init_view(dp_frame *f, dp_source *source, const dp_camera *camera, dp_diag *diag) {
    const uint32_t width = f->target.width, height = f->target.height;
    dp_result result = dp_view_init(&f->view, camera, width, height, diag); /* is it one? */
    if (!result) result = dp_source_begin(source, f->origin, diag);
    if (result) return result;
    const dp_camera about = dp_camera_about(camera, f->origin);
    return dp_view_init(&f->view, &about, width, height, diag);
}

dp_result dp_draw_groups(dp_context *c, dp_source *source, const dp_camera *camera,
                         const dp_style *styles, uint32_t style_count, const dp_target *target,
                         dp_diag *diag) {
    dp_frame *const f = &c->frame;
    c->stats = (dp_stats){0};
    dp_forget_drawing(c);
    f->painted_later = false;
    f->ink_layer = NULL;
    f->adjacency = NULL;
    f->fin_reach = 0;
    f->memory = &c->memory;
    f->threads = c->threads;
    f->styles = styles;
    f->style_count = style_count;
    /* many small triangles lie along a curved contour, nearly edge-on */
    f->exact_ends = styles[0].exact_ends || styles[0].smooth;
    f->lines = 0;
    for (uint32_t i = 0; i < style_count; i++) f->lines |= styles[i].lines & DP_ALL_LINES;
    f->flat_cosine = flat_cosine(styles, style_count);
    dp_result result = dp_check_target(target, &f->target, diag);
    const double start = now_ms();
    if (!result) result = init_view(f, source, camera, diag);
    if (!result) begin_view(f);
    if (!result) result = draw(c, source, start, diag);
    if (result) c->drawing.count = 0;
    c->drawn = !result;
    f->styles = NULL; /* borrowed for this call only */
    return result;
}

dp_result dp_draw_resolved(dp_context *c, dp_source *source, const dp_camera *camera,
                           dp_style *styles, uint32_t style_count, const dp_target *target,
                           dp_diag *diag) {
    if (styles[0].mirror.size > 0)
        return dp_draw_mirrored(c, source, camera, styles, style_count, target, diag);
    return dp_draw_groups(c, source, camera, styles, style_count, target, diag);
}

static dp_result draw_styled(dp_context *c, dp_source *source, const dp_camera *camera,
                             const dp_style *style, const dp_target *target, dp_diag *diag) {
    dp_style resolved;
    const dp_result result = dp_style_resolve(style, &resolved, diag);
    if (result) return result;
    return dp_draw_resolved(c, source, camera, &resolved, 1, target, diag);
}

dp_result dp_draw(dp_context *context, dp_source *source, const dp_camera *camera,
                  const dp_style *style, const dp_target *target, dp_diag *diag) {
    if (context) dp_forget_drawing(context);
    if (!context || !source || !camera || !target)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_draw: context, source, camera or target is NULL");
    dp_source_lend(source, context->threads);
    const dp_result result = draw_styled(context, source, camera, style, target, diag);
    dp_source_lend(source, NULL);
    return dp_context_settle(context, result, diag);
}

/* Makes the chains when they are first asked for; statistics count their memory from then on. */
static bool chain_drawing(dp_context *c) {
    if (c->drawing.chained) return true;
    const bool done = dp_chain_lines(&c->frame, &c->drawing);
    c->stats.bytes = dp_context_bytes(c);
    return done;
}

const dp_segment *dp_segments(dp_context *context, size_t *count) {
    const bool any = context && context->drawn && context->drawing.count && chain_drawing(context);
    if (count) *count = any ? context->drawing.count : 0;
    return any ? context->drawing.segments : NULL;
}

dp_result dp_send(dp_context *context, const dp_sink *sink, dp_diag *diag) {
    if (!context || !sink)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_send: context or sink is NULL");
    if (!context->drawn) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_send: nothing has been drawn");
    if (!chain_drawing(context))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the chains of a drawing");
    return dp_hand_over(&context->frame, &context->drawing, sink, diag);
}

dp_result dp_trace(dp_context *context, dp_text_writer *write, void *user, dp_diag *diag) {
    if (!write) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_trace: write is NULL");
    dp_tracing tracing = {.write = write, .user = user};
    const dp_sink sink = dp_trace_sink(&tracing);
    return dp_send(context, &sink, diag);
}

void dp_stats_of(const dp_context *context, dp_stats *stats) {
    if (!stats) return;
    *stats = context ? context->stats : (dp_stats){0};
}
