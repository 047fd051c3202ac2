/* Procedural stroke textures, and the stroke style that suits each.
 *
 * Each texture is a function from (u, v) in [0, 1]² to ink in [0, 1], made of value noise that
 * repeats along u, so that it has no seam. v = 0.5 is the middle of the stroke. All noise comes
 * from integer hashes of lattice points and the seed: the same on every machine. */
#include <drypoint/strokes.h>

#include "base/diag.h"
#include "base/memory.h"
#include "texture/rules.h"

#include <string.h>

static uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u;
    return h ^ h >> 15;
}

static float lattice(int32_t x, int32_t y, int32_t period, uint32_t seed) {
    return (float)(hash((uint32_t)((x % period + period) % period), (uint32_t)y, seed) >> 8) /
           16777216.0f;
}

static float smooth(float t) { return t * t * (3 - 2 * t); }

/* Value noise on a lattice of `columns` cells along u, where it repeats, and `rows` across. */
static float noise(float u, float v, int32_t columns, float rows, uint32_t seed) {
    const float x = u * (float)columns, y = v * rows, fx = floorf(x), fy = floorf(y);
    const int32_t i = (int32_t)fx, j = (int32_t)fy;
    const float ax = smooth(x - fx), ay = smooth(y - fy);
    const float low =
        lattice(i, j, columns, seed) * (1 - ax) + lattice(i + 1, j, columns, seed) * ax;
    const float high =
        lattice(i, j + 1, columns, seed) * (1 - ax) + lattice(i + 1, j + 1, columns, seed) * ax;
    return low * (1 - ay) + high * ay;
}

/* 0 below `from`, 1 above `to`. */
static float ramp(float from, float to, float x) {
    const float t = (x - from) / (to - from);
    return smooth(dp_minf(dp_maxf(t, 0), 1));
}

/* How far inside the stroke: 0 at its border, 1 in the middle. */
static float depth_in(float v) { return 1 - fabsf(2 * v - 1); }

/* Graphite caught by the paper's grain; pressure wanders along the stroke. */
static float pencil(float u, float v, uint32_t seed) {
    const float grain = 0.6f * noise(u, v, 256, 24, seed) + 0.4f * noise(u, v, 128, 10, seed + 1);
    const float pressure = 0.55f + 0.35f * noise(u, 0, 9, 1, seed + 2);
    const float rim = ramp(0, 0.55f, depth_in(v) - 0.12f * noise(u, v, 64, 4, seed + 3));
    return rim * ramp(0.78f - pressure, 1.15f - pressure, grain);
}

/* Bristles: each leaves a streak that runs dry and comes back. */
static float brush(float u, float v, uint32_t seed) {
    const float streak = 0.65f * noise(u, v, 6, 22, seed) + 0.35f * noise(u, v, 20, 44, seed + 1);
    const float edge = 0.10f + 0.22f * noise(u, v < 0.5f ? 0 : 7, 12, 1, seed + 2);
    const float load = 0.30f + 0.25f * noise(u, 3, 5, 1, seed + 3);
    return ramp(edge - 0.06f, edge + 0.08f, depth_in(v)) * ramp(load - 0.16f, load + 0.10f, streak);
}

/* Crumbs: coarse grain, no clear border. */
static float charcoal(float u, float v, uint32_t seed) {
    const float grain = 0.5f * noise(u, v, 110, 14, seed) + 0.3f * noise(u, v, 240, 30, seed + 1) +
                        0.2f * noise(u, v, 16, 3, seed + 2);
    const float body = smooth(dp_minf(1.35f * depth_in(v), 1));
    return 0.92f * ramp(0.62f - 0.42f * body, 0.80f - 0.42f * body, grain) *
           ramp(0, 0.2f, depth_in(v));
}

/* A pen: full ink, a width that swells a little. */
static float pen(float u, float v, uint32_t seed) {
    const float rim = 0.05f + 0.14f * noise(u, v < 0.5f ? 0 : 5, 7, 1, seed) +
                      0.04f * noise(u, v < 0.5f ? 2 : 9, 29, 1, seed + 1);
    return ramp(rim - 0.03f, rim + 0.05f, depth_in(v));
}

/* Three fifths drawn, two fifths not. The texture is eight times as long as tall. */
static float dashes(float u, float v, uint32_t seed) {
    (void)seed, (void)v;
    const float off = fabsf(u - 0.5f) - 0.3f;
    return 1 - ramp(-0.006f, 0.006f, off);
}

/* A disc in the middle of every second square. */
static float dots(float u, float v, uint32_t seed) {
    (void)seed;
    const float x = (u - 0.5f) * 4, y = 2 * v - 1;
    return 1 - ramp(0.92f, 1.0f, sqrtf(x * x + y * y));
}

typedef struct preset {
    const char *name, *about;
    dp_rule *make;
    uint32_t width, height; /* px */
    float taper, jitter, overshoot;
    uint32_t repeats;
} preset;

static const preset presets[] = {
    {"pencil", "graphite on grained paper, a little off the line", pencil, 512, 32, 10, 0.6f, 4, 1},
    {"brush", "bristles that run dry, thinning out at both ends", brush, 512, 64, 60, 0.5f, 0, 1},
    {"charcoal", "coarse and crumbling, without a clear rim", charcoal, 512, 64, 14, 0.8f, 3, 1},
    {"ink", "a pen: full ink, tapered ends", pen, 512, 64, 48, 0.25f, 2, 1},
    {"dashes", "dashes of five widths, three widths apart", dashes, 256, 32, 0, 0, 0, 1},
    {"dots", "round dots, one every two widths", dots, 128, 64, 0, 0, 0, 1},
    {"hatch", "slanted strokes between two rules", dp_rule_hatch, 128, 128, 0, 0, 0, 1},
    {"rope", "two strands laid round each other", dp_rule_rope, 128, 96, 0, 0, 0, 1},
    {"waves", "a line that swings from side to side", dp_rule_waves, 256, 96, 0, 0, 0, 1},
    {"checks", "two rows of squares", dp_rule_checks, 128, 128, 0, 0, 0, 1},
    {"chevrons", "arrows along the line", dp_rule_chevrons, 96, 96, 0, 0, 0, 1},
    {"lace", "scallops with holes, hung on the edge of an outline", dp_rule_lace, 128, 116, 0, 0, 0,
     1},
    {"meander", "the Greek key, on the edge of an outline", dp_rule_meander, 192, 160, 0, 0, 0, 1},
};
enum { PRESETS = sizeof presets / sizeof *presets };

uint32_t dp_texture_count(void) { return PRESETS; }
const char *dp_texture_name(uint32_t index) { return index < PRESETS ? presets[index].name : NULL; }
const char *dp_texture_about(uint32_t index) {
    return index < PRESETS ? presets[index].about : NULL;
}

/* The preset of a name; NULL, with *diag filled, if there is none. */
static const preset *find(const char *name, dp_diag *diag) {
    char known[256] = "";
    for (uint32_t i = 0; i < PRESETS; i++) {
        if (name && !strcmp(name, presets[i].name)) return &presets[i];
        strcat(strcat(known, i ? ", " : ""), presets[i].name);
    }
    dp_fail(diag, DP_ERR_ARGUMENT, "\"%s\" is no stroke; there are %s", name ? name : "", known);
    return NULL;
}

dp_result dp_stroke_look(const char *name, dp_stroke_style *style, dp_diag *diag) {
    const preset *const l = find(name, diag);
    if (!l || !style) return DP_ERR_ARGUMENT;
    style->taper = l->taper, style->jitter = l->jitter, style->overshoot = l->overshoot,
    style->repeats = l->repeats;
    return DP_OK;
}

dp_result dp_texture_named(const char *name, uint32_t seed, const dp_allocator *allocator,
                           dp_texture **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_texture_named: out is NULL");
    *out = NULL;
    const preset *const l = find(name, diag);
    if (!l) return DP_ERR_ARGUMENT;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    uint8_t *const pixels = dp_alloc_zeroed(&memory, (size_t)2 * l->width * l->height);
    if (!pixels) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a texture");
    for (uint32_t y = 0; y < l->height; y++)
        for (uint32_t x = 0; x < l->width; x++) {
            const float u = ((float)x + 0.5f) / (float)l->width,
                        v = ((float)y + 0.5f) / (float)l->height;
            const float ink = dp_minf(dp_maxf(l->make(u, v, seed * 16), 0), 1);
            pixels[2 * ((size_t)y * l->width + x) + 1] = (uint8_t)(ink * 255 + 0.5f);
        }
    const dp_texture_desc desc = {.pixels = pixels,
                                  .width = l->width,
                                  .height = l->height,
                                  .channels = 2,
                                  .allocator = allocator};
    const dp_result result = dp_texture_create(&desc, out, diag);
    dp_free(&memory, pixels);
    return result;
}
