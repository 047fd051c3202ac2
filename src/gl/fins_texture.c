/* Stroke textures of silhouettes by adjacency, and the centre of their polar coordinates (Hermosilla and Vázquez 2010, 2.3.3).
 *
 * As on the CPU, a texture is looked up at one level of its pyramid (texture/texture.h): the one that is about as high as the
 * line is wide. That level is uploaded as it is: ink alone (R8), or colours times ink (RGBA16), whose means the texture unit
 * then takes as dp_texture_sample does. What differs is the unit's arithmetic: OpenGL lets it take shares between
 * texels in steps, of 1/256 usually, which is up to half a level of 255 along each axis.
 *
 * Data structure: two textures, of silhouettes and of borders, and a buffer with centre and repeats (fins_centre.comp).
 * Invariant: stroke_keys are hashes of what is uploaded. */
#include "gl/fins.h"

#include "texture/texture.h"

static uint64_t hash_bytes(uint64_t hash, const uint8_t *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) hash = (hash ^ bytes[i]) * 0x100000001b3u; /* FNV-1a */
    return hash;
}

static uint64_t key_of(const dp_texture *t, uint32_t level) {
    const uint64_t size = (uint64_t)t->width[level] << 32 | t->height[level];
    const uint64_t hash = (0xcbf29ce484222325u ^ size) * 0x100000001b3u ^ t->coloured;
    return hash_bytes(hash, t->pixels[level], 4 * (size_t)t->width[level] * t->height[level]) | 1;
}

/* Ink in one byte a texel, or colours times ink in four words of 16 bits. */
static void convert(const dp_texture *t, uint32_t level, void *out) {
    const size_t count = (size_t)t->width[level] * t->height[level];
    const uint8_t *const in = t->pixels[level];
    for (size_t i = 0; i < count && !t->coloured; i++) ((uint8_t *)out)[i] = in[4 * i + 3];
    for (size_t i = 0; i < count && t->coloured; i++) {
        uint16_t *const to = (uint16_t *)out + 4 * i;
        const uint32_t ink = in[4 * i + 3];
        for (int k = 0; k < 3; k++)
            to[k] = (uint16_t)((in[4 * i + (size_t)k] * ink * 65535u + 32512u) / 65025u);
        to[3] = (uint16_t)(ink * 257);
    }
}

static dp_result upload(dp_gl *gl, dp_gl_texture *texture, const dp_texture *t, uint32_t level,
                        dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    const uint32_t w = t->width[level], h = t->height[level];
    if (w > gl->texture_most || h > gl->texture_most)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s has no textures of %u x %u px", gl->device, w,
                       h);
    void *const texels = dp_alloc_array(&gl->memory, (size_t)w * h, t->coloured ? 8 : 1);
    if (!texels) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a stroke texture");
    convert(t, level, texels);
    const dp_result result = dp_gl_texture_reserve(gl, texture, t->coloured ? GL_RGBA16 : GL_R8, w,
                                                   h, 0, "a stroke texture", diag);
    if (!result) {
        dp_gl_texture_bind(gl, texture, DP_GL_UNIT_OWN);
        a->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)w, (GLsizei)h,
                         t->coloured ? GL_RGBA : GL_RED,
                         t->coloured ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, texels);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    }
    dp_free(&gl->memory, texels);
    return result;
}

/* ------- polar coordinates ------- */

static dp_result centre_pass(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t items,
                             dp_diag *diag) {
    const dp_stroke_style *const stroke = &gl->style.stroke;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->fins->centre, DP_GL_BIND_CENTRE);
    const float widths[2] = {gl->style.line[DP_LINE_SILHOUETTE].width,
                             gl->style.line[DP_LINE_BORDER].width};
    dp_gl_uniform_f(gl, program, "periods[0]",
                    dp_texture_period(stroke->texture, widths[0]) * stroke->scale);
    dp_gl_uniform_f(gl, program, "periods[1]",
                    dp_texture_period(stroke->texture, widths[1]) * stroke->scale);
    dp_gl_uniform_f(gl, program, "weight", stroke->k > 0 ? stroke->k : 0);
    dp_gl_dispatch(gl, items);
    return DP_OK;
}

static dp_result find_centre(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc box = {.compute = "fins_centre.comp",
                                           .defines = "#define BOX\n"},
                                    centre = {.compute = "fins_centre.comp"};
    static const uint32_t empty[16] = {[6] = UINT32_MAX, UINT32_MAX, UINT32_MAX};
    dp_result result =
        dp_gl_buffer_fill(gl, &gl->fins->centre, empty, sizeof empty, "the model's centre", diag);
    if (!result) result = centre_pass(gl, &box, gl->scene.vertex_count, diag);
    if (!result) result = centre_pass(gl, &centre, 1, diag);
    return result;
}

dp_result dp_gl_fins_texture(dp_gl *gl, dp_diag *diag) {
    static const dp_line lines[2] = {DP_LINE_SILHOUETTE, DP_LINE_BORDER};
    const dp_texture *const t = gl->style.stroke.texture;
    dp_gl_fins *const f = gl->fins;
    if (!t) return DP_OK;
    dp_result result = DP_OK;
    for (int i = 0; i < 2 && !result; i++) {
        const uint32_t level = dp_texture_level(t, gl->style.line[lines[i]].width);
        const uint64_t key = key_of(t, level);
        if (f->stroke_keys[i] == key) continue;
        f->stroke_keys[i] = 0;
        result = upload(gl, &f->strokes[i], t, level, diag);
        if (!result) f->stroke_keys[i] = key;
    }
    return result ? result : find_centre(gl, diag);
}

void dp_gl_fins_bind_texture(dp_gl *gl, uint32_t program) {
    if (!gl->style.stroke.texture) return;
    dp_gl_texture_bind(gl, &gl->fins->strokes[0], DP_GL_UNIT_OWN);
    dp_gl_texture_bind(gl, &gl->fins->strokes[1], DP_GL_UNIT_OWN + 1);
    dp_gl_uniform_i(gl, program, "stroke", DP_GL_UNIT_OWN);
    dp_gl_uniform_i(gl, program, "border_stroke", DP_GL_UNIT_OWN + 1);
    dp_gl_buffer_bind(gl, &gl->fins->centre, DP_GL_BIND_CENTRE);
}

const char *dp_gl_fins_texture_defines(const dp_gl *gl) {
    static const char *const defines[2][3] = {
        {"#define TEXTURED\n", "#define TEXTURED\n#define EXACT_LOOKUPS\n",
         "#define TEXTURED\n#define EXACT_LOOKUPS\n#define LOOKUP_STEPS 256.0\n"},
        {"#define TEXTURED\n#define COLOURED\n",
         "#define TEXTURED\n#define COLOURED\n#define EXACT_LOOKUPS\n",
         "#define TEXTURED\n#define COLOURED\n#define EXACT_LOOKUPS\n#define LOOKUP_STEPS "
         "256.0\n"}};
    const dp_texture *const t = gl->style.stroke.texture;
    return t ? defines[t->coloured][gl->lookups] : "";
}
