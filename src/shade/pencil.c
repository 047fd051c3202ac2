/* Pencil rendering (Hermosilla and Vázquez 2010, 2.4, after Lee, Kwon and Lee 2006).
 *
 *     vertex stage    for each vertex:  angle of its direction of minimal curvature on the screen
 *     geometry stage  the G-buffer holds each pixel's polygon, so that a pixel reads its three
 *                       corners' directions without interpolation (Listing 2.4)
 *     pixel stage     for each pixel:   for each of three corners: look up the stroke texture at
 *                                         screen coordinates turned by the corner's angle
 *                                       value = mean of the three look-ups
 *                                       tone  = value ^ ((1 - max(N·L, 0)) S + O)  (Listing 2.5)
 *
 * As printed (`pencil_printed`), angles are exact. Far from the origin, two angles that hardly
 * differ lead to different parts of the texture, so that strokes break at every edge, and on fine
 * meshes turn into noise. By default angles have DP_TURNS steps, and textures of neighbouring steps
 * are cross-faded: neighbours that agree have the same strokes.
 *
 * tone is a table of bytes, by value and light. `pencil_tones` (Lee et al. 2006): a row of textures
 * with more and more strokes instead of the power; two are mixed.
 *
 * Not handled: polygons of more than three corners use three of them. */
#include "shade/pencil.h"

#include "base/elementary.h"
#include "base/hostile.h"
#include "base/kernels.h"
#include "shade/pencil_rows.h"
#include "texture/graphite.h"

enum { BLOCK = DP_TUNED(16384, 5) };
static const float PI = 3.14159265f;

/* ------- memory and textures ------- */

static const dp_array arrays[] = {
    DP_ARRAY(dp_pencil_store, turns, turns_cap), DP_ARRAY(dp_pencil_store, polygon, polygon_cap),
    DP_ARRAY(dp_pencil_store, powers, powers_cap),
    DP_ARRAY(dp_pencil_store, graphite, graphite_cap), DP_ARRAY(dp_pencil_store, tooth, tooth_cap)};

void dp_pencil_store_free(dp_pencil_store *s, const dp_allocator *memory) {
    dp_curvature_store_free(&s->curvature, memory);
    dp_arrays_free(memory, s, DP_ARRAYS(arrays));
    *s = (dp_pencil_store){0};
}

uint64_t dp_pencil_store_bytes(const dp_pencil_store *s) {
    return dp_curvature_store_bytes(&s->curvature) + dp_arrays_bytes(s, DP_ARRAYS(arrays));
}

static const size_t TEXTURE = (size_t)DP_GRAPHITE_SIZE * DP_GRAPHITE_SIZE; /* bytes */

static bool make_tooth(dp_pencil_store *s, const dp_allocator *memory) {
    if (s->tooth) return true;
    if (!dp_reserve(memory, &s->tooth, &s->tooth_cap, TEXTURE, sizeof *s->tooth)) return false;
    dp_make_tooth(s->tooth);
    dp_make_pencil_table(&s->table);
    return true;
}

static bool make_powers(dp_pencil_store *s, const dp_shade *shade, const dp_allocator *memory) {
    if (s->powers && s->powers_of[0] == shade->pencil_s && s->powers_of[1] == shade->pencil_o)
        return true;
    if (!dp_reserve(memory, &s->powers, &s->powers_cap, 256 * 256, 1)) return false;
    dp_make_powers(s->powers, shade->pencil_s, shade->pencil_o);
    s->powers_of[0] = shade->pencil_s, s->powers_of[1] = shade->pencil_o;
    return true;
}

static bool make_graphite(dp_pencil_store *s, uint32_t tones, const dp_allocator *memory) {
    if (s->tones == tones) return true;
    s->tones = 0;
    if (!dp_reserve(memory, &s->graphite, &s->graphite_cap, tones * TEXTURE, 1)) return false;
    float *const scratch = dp_alloc_array(memory, TEXTURE, sizeof *scratch);
    if (!scratch) return false;
    dp_make_graphite(s->graphite, tones, scratch);
    dp_free(memory, scratch);
    s->tones = tones;
    return true;
}

static void set_up_textures(const dp_pencil_store *s, uint32_t tones, dp_shading_setup *setup) {
    const dp_image *const strokes = &setup->shade.strokes;
    setup->tooth = s->tooth;
    setup->powers = s->powers;
    setup->pencil = &s->table;
    setup->tone_count = tones;
    for (uint32_t i = 0; i < tones; i++)
        setup->tones[i] =
            (dp_strokes_texture){s->graphite + i * TEXTURE, DP_GRAPHITE_SIZE, DP_GRAPHITE_SIZE};
    if (strokes->values)
        setup->tones[0] = (dp_strokes_texture){strokes->values, strokes->width, strokes->height};
}

bool dp_pencil_begin(dp_pencil_store *s, const dp_frame *frame, dp_gbuffer *g,
                     dp_shading_setup *setup) {
    const dp_allocator *const memory = frame->memory;
    const dp_shade *const shade = &setup->shade;
    const size_t vertices = (size_t)frame->polygons.vertex_count + 1;
    const uint32_t tones = shade->strokes.values || !shade->pencil_tones ? 1 : shade->pencil_tones;
    if (!dp_reserve(memory, &s->polygon, &s->polygon_cap, g->stride * g->height,
                    sizeof *s->polygon) ||
        !make_tooth(s, memory) || !make_powers(s, shade, memory) ||
        !make_graphite(s, tones, memory) ||
        !dp_curvature_directions(&s->curvature, &frame->polygons, frame->threads, memory) ||
        !dp_reserve(memory, &s->turns, &s->turns_cap, vertices, sizeof *s->turns))
        return false;
    g->polygon = s->polygon;
    set_up_textures(s, tones, setup);
    dp_pencil_vertices(frame, (const float(*)[3])s->curvature.along, s->turns);
    setup->frame = frame;
    setup->turns = s->turns;
    return true;
}

/* ------- vertex stage ------- */

typedef struct turning {
    const dp_pencil_rows *rows;
    const float (*along)[3];
    dp_turn *turns;
    bool printed;
    float right[3], up[3];
    uint32_t count;
} turning;

static void turn_block(void *arg, uint32_t index, uint32_t worker) {
    const turning *const t = arg;
    const uint32_t first = index * BLOCK, n = t->count - first < BLOCK ? t->count - first : BLOCK;
    (void)worker;
    if (t->printed)
        t->rows->turn_exactly(t->along + first, t->right, t->up, n, t->turns + first);
    else
        t->rows->turn(t->along + first, t->right, t->up, n, t->turns + first);
}

void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], dp_turn *turns) {
    const dp_view *const view = &frame->view;
    const uint32_t count = frame->polygons.vertex_count;
    turning t = {.rows = dp_pencil_rows_for(frame->lanes),
                 .along = along,
                 .turns = turns,
                 .count = count,
                 .printed = frame->styles[0].shade.pencil_printed};
    const dp_vec3 x = dp_v3(view->clip[0][0], view->clip[0][1], view->clip[0][2]);
    const dp_vec3 right = dp_unit(dp_sub(x, dp_scale(view->forward, dp_dot(x, view->forward))));
    const dp_vec3 up = dp_cross(right, view->forward);
    const double r[3] = {right.x, right.y, right.z}, u[3] = {up.x, up.y, up.z};
    for (int k = 0; k < 3; k++) t.right[k] = (float)r[k], t.up[k] = (float)u[k];
    dp_parallel(frame->threads, count / BLOCK + (count % BLOCK != 0), turn_block, &t);
}

/* ------- pixel stage ------- */

/* The pixels of a run that show a surface, with the turns of three corners of their polygons. */
typedef struct corners {
    uint32_t count;
    uint32_t pixel[DP_TILE];
    uint32_t vertex[DP_TILE][3];
    dp_turn turn[DP_TILE][3];
} corners;

/* In separate loops, so that many memory reads are under way at once. */
static void find_corners(const dp_shading_setup *setup, const dp_shade_run *run, corners *c) {
    const dp_polygons *const polygons = &setup->frame->polygons;
    const uint32_t *const shown = setup->g->polygon + (size_t)run->y * setup->g->stride + run->x;
    c->count = 0;
    for (uint32_t i = 0; i < run->n; i++) {
        c->pixel[c->count] = i;
        c->count += run->id[i] != 0;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        const uint32_t polygon = shown[c->pixel[i]], first = dp_first_corner(polygons, polygon);
        const uint32_t n = polygons->firsts ? dp_corner_count(polygons, polygon) : 3;
        for (uint32_t k = 0; k < 3; k++) /* of more corners: three of them */
            c->vertex[i][k] = dp_corner_vertex(polygons, first + k * n / 3);
    }
    for (uint32_t i = 0; i < c->count; i++)
        for (uint32_t k = 0; k < 3; k++) c->turn[i][k] = setup->turns[c->vertex[i][k]];
}

static void turn_of(float angle, float *cosine, float *sine) {
    *cosine = (float)dp_cos((double)angle);
    *sine = (float)dp_sin((double)angle);
}

void dp_make_pencil_table(dp_pencil_table *p) {
    for (uint32_t i = 0; i < DP_TURNS; i++) turn_of((float)i * PI / DP_TURNS, &p->c[i], &p->s[i]);
    for (uint32_t i = 0; i < 256; i++) p->weight[i] = (float)i / 765;
}

static inline void put_strand(dp_strands *s, uint32_t at, uint32_t pixel, float cosine, float sine,
                              float weight) {
    s->pixel[at] = (int32_t)pixel, s->c[at] = cosine, s->s[at] = sine, s->weight[at] = weight;
}

/* One pixel's steps and their weights. */
typedef struct shares {
    uint32_t count, step[DP_STRANDS_PER_PIXEL];
    float weight[DP_STRANDS_PER_PIXEL];
} shares;

/* Adds a weight to its step, which is a new one if it is not there yet. */
static inline void add_share(shares *s, uint32_t step, float weight) {
    uint32_t i = 0;
    while (i < s->count && s->step[i] != step) i++;
    if (i == s->count)
        s->step[s->count] = step, s->weight[s->count++] = weight;
    else
        s->weight[i] += weight;
}

static uint32_t after(uint32_t step) { return step + 1 < DP_TURNS ? step + 1 : 0; }

static void add_differing(const dp_pencil_table *p, const dp_turn turn[3], uint32_t pixel,
                          dp_strands *s) {
    shares of = {.count = 0};
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t low = turn[k] >> 8, part = turn[k] & 0xff;
        add_share(&of, low, p->weight[255 - part]);
        if (part) add_share(&of, after(low), p->weight[part]);
    }
    for (uint32_t i = 0; i < of.count; i++)
        put_strand(s, s->count++, pixel, p->c[of.step[i]], p->s[of.step[i]], of.weight[i]);
}

/* Usually the three corners have the same step: one look-up, and one of the next step if any corner
 * has a part of it. */
static void find_strands(const dp_pencil_table *p, const corners *c, dp_strands *s) {
    s->count = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        const dp_turn *const turn = c->turn[i];
        const uint32_t pixel = c->pixel[i], low = turn[0] >> 8, next = after(low);
        if (((turn[0] ^ turn[1]) | (turn[0] ^ turn[2])) >> 8) {
            add_differing(p, turn, pixel, s);
            continue;
        }
        const uint32_t a = turn[0] & 0xff, b = turn[1] & 0xff, d = turn[2] & 0xff;
        put_strand(s, s->count, pixel, p->c[low], p->s[low],
                   p->weight[255 - a] + p->weight[255 - b] + p->weight[255 - d]);
        put_strand(s, s->count + 1, pixel, p->c[next], p->s[next],
                   p->weight[a] + p->weight[b] + p->weight[d]);
        s->count += 1 + ((a | b | d) != 0); /* not a branch: it could not be predicted */
    }
}

/* As printed: each corner's exact angle. Pixels side by side often share cosine and sine. */
static void find_strands_printed(const corners *c, dp_strands *s) {
    s->count = 3 * c->count;
    for (uint32_t i = 0; i < c->count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t at = 3 * i + k;
            const float angle = (float)c->turn[i][k] * (PI / 65536);
            const bool same = i && c->turn[i - 1][k] == c->turn[i][k];
            float cosine, sine;
            if (same)
                cosine = s->c[at - 3], sine = s->s[at - 3];
            else
                turn_of(angle, &cosine, &sine);
            put_strand(s, at, c->pixel[i], cosine, sine, 1.0f / 3);
        }
}

void dp_make_powers(uint8_t *powers, float s, float o) {
    for (uint32_t v = 0; v < 256; v++) {
        const double logarithm = dp_log((double)((float)v / 255));
        for (uint32_t dark = 0; dark < 256; dark++) {
            const float exponent = (float)dark / 255 * s + dp_maxf(o, 0);
            const float power = exponent == 0 ? 1 : (float)dp_exp((double)exponent * logarithm);
            powers[256 * dark + v] = (uint8_t)(255 * power + 0.5f);
        }
    }
}

void dp_shade_pencil(const dp_shading_setup *setup, dp_shade_run *run) {
    corners c;
    dp_strands strands;
    find_corners(setup, run, &c);
    if (setup->shade.pencil_printed)
        find_strands_printed(&c, &strands);
    else
        find_strands(setup->pencil, &c, &strands);
    dp_pencil_rows_for(setup->frame->lanes)->shade(setup, &strands, run);
}
