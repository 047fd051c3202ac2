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
 * noise. Here angles are told apart in DP_TURNS steps, and between two steps their textures are cross-faded: neighbours
 * that agree have the same strokes. `pencil_printed` is as printed.
 *
 * Brightness, light and tone are looked up in a table of bytes.
 * Tones (Lee et al.): a row of textures with more and more strokes instead of the power; two are mixed. */
#include "shade/pencil.h"

#include "base/hostile.h"
#include "texture/graphite.h"

enum { BLOCK = DP_TUNED(16384, 5) };
static const float PI = 3.14159265f;
static const float TOOTH = 0.55f; /* how much the paper's tooth takes or leaves */

/* ------- vertex stage ------- */

typedef struct turning {
    const float (*along)[3];
    dp_turn *turns;
    bool printed;
    float right[3], up[3];
    uint32_t count;
} turning;

/* An angle between two steps; mostly one of them, with a short cross-fade half way between. */
static dp_turn to_steps(float angle) {
    const float steps = angle * ((float)DP_TURNS / PI), low = floorf(steps);
    const float t = dp_minf(dp_maxf((steps - low - 0.5f) * 2.5f + 0.5f, 0), 1);
    return (dp_turn)((uint32_t)low % DP_TURNS << 8 | (uint32_t)(t * t * (3 - 2 * t) * 255 + 0.5f));
}

/* The angle of a direction without sign, [0, pi): an odd polynomial for the arc tangent of [0, 1], within 2e-5. */
static float angle_of(float x, float y) {
    const float ax = fabsf(x), ay = fabsf(y), most = dp_maxf(ax, ay), z = most > 0 ? dp_minf(ax, ay) / most : 0, z2 = z * z;
    const float p = z * (0.99997726f + z2 * (-0.33262347f + z2 * (0.19354346f + z2 * (-0.11643287f + z2 * (0.05265332f - z2 * 0.01172120f)))));
    const float quarter = ay > ax ? PI / 2 - p : p;
    return x * y < 0 ? PI - quarter : quarter;
}

static void turn_block(void *arg, uint32_t index, uint32_t worker) {
    const turning *const t = arg;
    (void)worker;
    const uint32_t first = index * BLOCK, last = t->count - first < BLOCK ? t->count : first + BLOCK;
    for (uint32_t v = first; v < last; v++) {
        const float *const d = t->along[v];
        const float x = t->right[0] * d[0] + t->right[1] * d[1] + t->right[2] * d[2];
        const float y = t->up[0] * d[0] + t->up[1] * d[1] + t->up[2] * d[2];
        const float angle = angle_of(x, y);
        /* as printed: 16 bits of the angle; half a turn is the same */
        t->turns[v] = t->printed ? (dp_turn)((uint32_t)(angle / PI * 65536) & 0xffff) : to_steps(angle);
    }
}

void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], dp_turn *turns) {
    const dp_view *const view = &frame->view;
    const uint32_t count = frame->polygons.vertex_count;
    turning t = {.along = along, .turns = turns, .count = count, .printed = frame->styles[0].shade.pencil_printed};
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
    int32_t x0 = (int32_t)(x + 65536) - 65536, y0 = (int32_t)(y + 65536) - 65536; /* floor, without a call */
    const float s = x - (float)x0, r = y - (float)y0;
    const int32_t w = (int32_t)t->width, h = (int32_t)t->height;
    if (w == DP_GRAPHITE_SIZE && h == DP_GRAPHITE_SIZE) {
        x0 &= DP_GRAPHITE_SIZE - 1, y0 &= DP_GRAPHITE_SIZE - 1;
    } else {
        x0 = (x0 % w + w) % w, y0 = (y0 % h + h) % h;
    }
    const int32_t x1 = x0 + 1 < w ? x0 + 1 : 0, y1 = y0 + 1 < h ? y0 + 1 : 0;
    const uint8_t *const top = t->values + (ptrdiff_t)y0 * w, *const low = t->values + (ptrdiff_t)y1 * w;
    const float a = (float)top[x0] + s * ((float)top[x1] - (float)top[x0]);
    const float b = (float)low[x0] + s * ((float)low[x1] - (float)low[x0]);
    return a + r * (b - a); /* 0 to 255 */
}

/* A direction and how much of it there is in a pixel. */
typedef struct strand {
    float c, s, weight;
} strand;

typedef struct pencil {
    const dp_shading_setup *setup;
    float c[DP_TURNS], s[DP_TURNS]; /* the steps */
    float scale;                    /* texels per px */
} pencil;

static uint32_t add_step(strand *strands, uint32_t n, const pencil *p, uint32_t step, float weight) {
    for (uint32_t i = 0; i < n; i++)
        if (strands[i].c == p->c[step]) { /* over half a turn no two cosines are equal */
            strands[i].weight += weight;
            return n;
        }
    strands[n] = (strand){p->c[step], p->s[step], weight};
    return n + 1;
}

static uint32_t add_turn(strand *strands, uint32_t n, const pencil *p, dp_turn turn) {
    const uint32_t low = turn >> 8, part = turn & 0xff;
    if (part < 255) n = add_step(strands, n, p, low, (float)(255 - part) / 765);
    return part ? add_step(strands, n, p, low + 1 < DP_TURNS ? low + 1 : 0, (float)part / 765) : n;
}

/* The three directions of the pixel's polygon; of one with more corners, of three of them. */
static uint32_t find_strands(const pencil *p, uint32_t polygon, strand strands[6]) {
    const dp_polygons *const polygons = &p->setup->frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon), corners = polygons->firsts ? dp_corner_count(polygons, polygon) : 3;
    uint32_t n = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const dp_turn turn = p->setup->turns[dp_corner_vertex(polygons, first + k * corners / 3)];
        if (!p->setup->shade.pencil_printed) n = add_turn(strands, n, p, turn);
        else strands[n++] = (strand){cosf((float)turn * (PI / 65536)), sinf((float)turn * (PI / 65536)), 1.0f / 3};
    }
    return n;
}

/* Brightness of one texture along all strands, 0 to 255. y runs down, directions up. */
static float blend(const strand *strands, uint32_t n, const dp_strokes_texture *texture, float x, float y) {
    float sum = 0;
    for (uint32_t i = 0; i < n; i++)
        sum += strands[i].weight * sample(texture, x * strands[i].c - y * strands[i].s, x * strands[i].s + y * strands[i].c);
    return sum;
}

void dp_make_powers(uint8_t *powers, float s, float o) {
    for (uint32_t dark = 0; dark < 256; dark++)
        for (uint32_t v = 0; v < 256; v++)
            powers[256 * dark + v] = (uint8_t)(255 * powf((float)v / 255, (float)dark / 255 * s + dp_maxf(o, 0)) + 0.5f);
}

static float tone_of(const pencil *p, const strand *strands, uint32_t n, float dark, float x, float y) {
    const dp_shading_setup *const setup = p->setup;
    const uint32_t tones = setup->tone_count;
    if (tones < 2) {
        const float value = blend(strands, n, &setup->tones[0], x, y);
        return (float)setup->powers[256 * (uint32_t)(dark * 255 + 0.5f) + (uint32_t)(dp_minf(value, 255) + 0.5f)] * (1 / 255.0f);
    }
    const float at = dp_minf(dark * (float)(tones - 1), (float)(tones - 1) - 0.001f);
    const uint32_t low = (uint32_t)at;
    const float a = blend(strands, n, &setup->tones[low], x, y), b = blend(strands, n, &setup->tones[low + 1], x, y);
    return (a + (b - a) * (at - (float)low)) * (1 / 255.0f);
}

void dp_shade_pencil(const dp_shading_setup *setup, dp_shade_run *run) {
    const dp_shade *const shade = &setup->shade;
    const uint32_t *const polygons = setup->g->polygon + (size_t)run->y * setup->g->stride + run->x;
    pencil p = {.setup = setup, .scale = 1 / shade->stroke_scale};
    for (uint32_t i = 0; i < DP_TURNS; i++)
        p.c[i] = cosf((float)i * PI / DP_TURNS), p.s[i] = sinf((float)i * PI / DP_TURNS);
    for (uint32_t i = 0; i < run->n; i++) {
        if (!run->id[i]) continue;
        strand strands[6];
        const uint32_t n = find_strands(&p, polygons[i], strands), px = run->x + i;
        const float x = ((float)px + 0.5f) * p.scale, y = ((float)run->y + 0.5f) * p.scale;
        const float lit = run->nx[i] * shade->light[0] + run->ny[i] * shade->light[1] + run->nz[i] * shade->light[2];
        const float value = tone_of(&p, strands, n, 1 - dp_minf(dp_maxf(lit, 0), 1), x, y);
        const float tooth = (float)setup->tooth[(run->y % DP_GRAPHITE_SIZE) * DP_GRAPHITE_SIZE + px % DP_GRAPHITE_SIZE] / 127;
        const float graphite = dp_minf((1 - value) * (1 + TOOTH * tooth), 1);
        for (int k = 0; k < 3; k++) run->color[k][i] += (setup->ink[k] - run->color[k][i]) * graphite;
    }
}
