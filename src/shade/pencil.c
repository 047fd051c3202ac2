/* Pencil rendering (Hermosilla and Vázquez 2010, 2.4, after Lee, Kwon and Lee 2006).
 *
 *   vertex stage     dp_pencil_vertices: the direction of least curvature, turned to the camera, x and y of it
 *   geometry stage   the G-buffer keeps which polygon a pixel shows, so that a pixel gets the three directions of its
 *                    polygon's corners as they are, without interpolation and without a copy of any vertex (Listing 2.4)
 *   pixel stage      three look-ups at screen coordinates turned by the three directions, blended by thirds; then
 *                    tone = value ^ ((1 - max(N·L, 0)) S + O)                                          (Listing 2.5)
 *
 * As printed each pixel's coordinates are turned by its corners' exact angles. Far from the origin two angles that
 * hardly differ lead to different places in the texture, so that strokes break at every edge: on fine meshes they turn into
 * noise. Here angles are told apart in TURNS steps, and between two steps their textures are cross-faded: neighbours
 * that agree have the same strokes. `pencil_printed` is as printed.
 *
 * Tones (Lee et al.): a row of textures with more and more strokes instead of the power; two are mixed. */
#include "shade/pencil.h"

#include "base/hostile.h"
#include "texture/graphite.h"

enum { TURNS = 18, BLOCK = DP_TUNED(16384, 5) };
static const float PI = 3.14159265f;
static const float TOOTH = 0.8f; /* how much the paper's tooth takes or leaves */

/* ------- vertex stage ------- */

typedef struct turning {
    const float (*along)[3];
    float (*turns)[2];
    float right[3], up[3];
    uint32_t count;
} turning;

static void turn_block(void *arg, uint32_t index, uint32_t worker) {
    const turning *const t = arg;
    (void)worker;
    const uint32_t first = index * BLOCK, last = t->count - first < BLOCK ? t->count : first + BLOCK;
    for (uint32_t v = first; v < last; v++) {
        const float *const d = t->along[v];
        const float x = t->right[0] * d[0] + t->right[1] * d[1] + t->right[2] * d[2];
        const float y = t->up[0] * d[0] + t->up[1] * d[1] + t->up[2] * d[2];
        const float length2 = x * x + y * y, inverse = length2 > 1e-12f ? 1 / sqrtf(length2) : 0;
        t->turns[v][0] = inverse > 0 ? x * inverse : 1, t->turns[v][1] = y * inverse;
    }
}

void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], float (*turns)[2]) {
    const dp_view *const view = &frame->view;
    const uint32_t count = frame->polygons.vertex_count;
    turning t = {.along = along, .turns = turns, .count = count};
    const dp_vec3 x = dp_v3(view->clip[0][0], view->clip[0][1], view->clip[0][2]);
    const dp_vec3 right = dp_unit(dp_sub(x, dp_scale(view->forward, dp_dot(x, view->forward))));
    const dp_vec3 up = dp_cross(right, view->forward);
    const double r[3] = {right.x, right.y, right.z}, u[3] = {up.x, up.y, up.z};
    for (int k = 0; k < 3; k++) t.right[k] = (float)r[k], t.up[k] = (float)u[k];
    dp_parallel(frame->threads, count / BLOCK + (count % BLOCK != 0), turn_block, &t);
}

/* ------- pixel stage ------- */

/* Brightness at (x, y), texels, bilinear; repeats. Sizes need not be powers of two. */
static float sample(const dp_strokes_texture *t, float x, float y) {
    const float w = (float)t->width, h = (float)t->height;
    const float u = x - w * floorf(x / w), v = y - h * floorf(y / h);
    uint32_t x0 = (uint32_t)u, y0 = (uint32_t)v;
    const float s = u - (float)x0, r = v - (float)y0;
    if (x0 >= t->width) x0 = 0; /* by rounding */
    if (y0 >= t->height) y0 = 0;
    const uint32_t x1 = x0 + 1 < t->width ? x0 + 1 : 0, y1 = y0 + 1 < t->height ? y0 + 1 : 0;
    const uint8_t *const top = t->values + (size_t)y0 * t->width, *const low = t->values + (size_t)y1 * t->width;
    const float a = (float)top[x0] + s * ((float)top[x1] - (float)top[x0]);
    const float b = (float)low[x0] + s * ((float)low[x1] - (float)low[x0]);
    return (a + r * (b - a)) * (1 / 255.0f);
}

/* A direction and how much of it there is in a pixel. */
typedef struct strand {
    float c, s, weight;
} strand;

typedef struct pencil {
    const dp_shading_setup *setup;
    float c[TURNS], s[TURNS]; /* the steps */
    float scale;              /* texels per px */
} pencil;

static uint32_t add_step(strand *strands, uint32_t n, const pencil *p, uint32_t step, float weight) {
    for (uint32_t i = 0; i < n; i++)
        if (strands[i].c == p->c[step] && strands[i].s == p->s[step]) {
            strands[i].weight += weight;
            return n;
        }
    strands[n] = (strand){p->c[step], p->s[step], weight};
    return n + 1;
}

/* The steps on either side of an angle; mostly one of them, with a short cross-fade half way between. */
static uint32_t add_turn(strand *strands, uint32_t n, const pencil *p, const float turn[2]) {
    const float angle = atan2f(turn[1], turn[0]), steps = (angle < 0 ? angle + PI : angle) * ((float)TURNS / PI);
    const uint32_t low = (uint32_t)steps % TURNS, high = low + 1 < TURNS ? low + 1 : 0;
    const float t = dp_minf(dp_maxf((steps - floorf(steps) - 0.5f) * 2.5f + 0.5f, 0), 1), weight = t * t * (3 - 2 * t);
    if (weight < 1) n = add_step(strands, n, p, low, (1 - weight) / 3);
    return weight > 0 ? add_step(strands, n, p, high, weight / 3) : n;
}

/* The three directions of the pixel's polygon; of one with more corners, of three of them. */
static uint32_t find_strands(const pencil *p, uint32_t polygon, strand strands[6]) {
    const dp_polygons *const polygons = &p->setup->frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon), corners = dp_corner_count(polygons, polygon);
    uint32_t n = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const float *const turn = p->setup->turns[dp_corner_vertex(polygons, first + k * corners / 3)];
        if (p->setup->shade.pencil_printed) strands[n++] = (strand){turn[0], turn[1], 1.0f / 3};
        else n = add_turn(strands, n, p, turn);
    }
    return n;
}

/* Brightness of one texture along all strands. y runs down, directions up. */
static float blend(const strand *strands, uint32_t n, const dp_strokes_texture *texture, float x, float y) {
    float sum = 0;
    for (uint32_t i = 0; i < n; i++)
        sum += strands[i].weight * sample(texture, x * strands[i].c - y * strands[i].s, x * strands[i].s + y * strands[i].c);
    return sum;
}

static float tone_of(const pencil *p, const strand *strands, uint32_t n, float dark, float x, float y) {
    const dp_shading_setup *const setup = p->setup;
    const uint32_t tones = setup->tone_count;
    if (tones < 2) return powf(blend(strands, n, &setup->tones[0], x, y), dark * setup->shade.pencil_s + setup->shade.pencil_o);
    const float at = dp_minf(dark * (float)(tones - 1), (float)(tones - 1) - 0.001f);
    const uint32_t low = (uint32_t)at;
    const float a = blend(strands, n, &setup->tones[low], x, y), b = blend(strands, n, &setup->tones[low + 1], x, y);
    return a + (b - a) * (at - (float)low);
}

void dp_shade_pencil(const dp_shading_setup *setup, dp_shade_run *run) {
    const dp_shade *const shade = &setup->shade;
    const uint32_t *const polygons = setup->g->polygon + (size_t)run->y * setup->g->stride + run->x;
    pencil p = {.setup = setup, .scale = 1 / shade->stroke_scale};
    for (uint32_t i = 0; i < TURNS; i++)
        p.c[i] = cosf((float)i * PI / TURNS), p.s[i] = sinf((float)i * PI / TURNS);
    for (uint32_t i = 0; i < run->n; i++) {
        if (!run->id[i]) continue;
        strand strands[6];
        const uint32_t n = find_strands(&p, polygons[i], strands), px = run->x + i;
        const float x = ((float)px + 0.5f) * p.scale, y = ((float)run->y + 0.5f) * p.scale;
        const float lit = run->nx[i] * shade->light[0] + run->ny[i] * shade->light[1] + run->nz[i] * shade->light[2];
        const float value = tone_of(&p, strands, n, 1 - dp_maxf(lit, 0), x, y);
        const float tooth = (float)setup->tooth[(run->y % DP_GRAPHITE_SIZE) * DP_GRAPHITE_SIZE + px % DP_GRAPHITE_SIZE] / 127;
        const float graphite = dp_minf((1 - value) * (1 + TOOTH * tooth), 1);
        for (int k = 0; k < 3; k++) run->color[k][i] += (setup->ink[k] - run->color[k][i]) * graphite;
    }
}
