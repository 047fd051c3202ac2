/* Wavefront OBJ: vertices, faces, normals, texture coordinates and vertices' colours (`v x y z r g
 * b`, which many programs write), read whole.
 *
 * Polygons stay polygons. A face's group is named "object/group/material", without the parts that
 * are not given; groups are numbered in order of their first face, and have the colour of their
 * material (mtl.c), wherever in the file its library is named. An index of no vertex (0, before the
 * first, beyond 32 bits) becomes UINT32_MAX, so that the face is dropped and counted. An index of
 * no normal or texture coordinate means none.
 *
 * Not handled: free-form curves and surfaces, points, lines, smoothing groups; their lines are
 * ignored. */
#include "io/readers.h"

#include "io/color.h"
#include "io/mtl.h"
#include "io/number.h"
#include "io/text.h"

#include <string.h>

enum { NAME = DP_MATERIAL_NAME, LIBRARIES = 4096 };

enum { OBJECT, GROUP, MATERIAL, NAME_KINDS };

typedef struct obj {
    dp_stream *stream;
    dp_builder *builder;
    dp_diag *diag;
    char names[NAME_KINDS][NAME];
    bool renamed;   /* since the last face */
    uint16_t group; /* of the last face */
    dp_materials materials;
    uint32_t *material_of; /* [material_count] by group: 1 + its material's number, 0: none */
    size_t material_count, material_capacity;
    float most; /* dp_color_guess */
} obj;

/* Reads up to three numbers after the position: a colour, or one weight, which is ignored. */
static bool read_color(obj *self) {
    float rgb[3];
    int n = 0;
    while (n < 3 && dp_text_blank(self->stream) && dp_text_float(self->stream, &rgb[n])) n++;
    return n < 3 || dp_builder_vertex_color(self->builder, self->builder->vertex_count - 1,
                                            dp_color_guess(rgb, &self->most));
}

static dp_result read_vertex(obj *self) {
    float rounded[3];
    double position[3];
    for (int k = 0; k < 3; k++) {
        dp_text_blank(self->stream);
        if (!dp_text_wide(self->stream, &rounded[k], &position[k]))
            return dp_text_expected(self->stream, self->diag, "a vertex's %c", 'x' + k);
    }
    if (!dp_builder_place(self->builder, position, rounded) ||
        (dp_text_blank(self->stream) && !read_color(self)))
        return dp_builder_fail(self->builder, self->diag);
    return DP_OK;
}

/* vn x y z, or vt u [v [w]]: missing or bad numbers are 0, as only shading uses them. */
static dp_result read_value(obj *self, dp_builder_attribute *attribute, size_t width) {
    float value[3] = {0};
    for (size_t k = 0; k < width && dp_text_blank(self->stream); k++)
        if (!dp_text_float(self->stream, &value[k])) break;
    float *const to = dp_builder_value(self->builder, attribute, width);
    if (!to) return dp_builder_fail(self->builder, self->diag);
    memcpy(to, value, width * sizeof *to);
    return DP_OK;
}

/* A group has one material: it is part of its name. */
static bool note_material(obj *self) {
    uint16_t number = 0;
    const bool named = *self->names[MATERIAL];
    if (named && !dp_materials_find(&self->materials, self->names[MATERIAL], &number)) return false;
    if (!dp_reserve(&self->builder->allocator, &self->material_of, &self->material_capacity,
                    (size_t)self->group + 1, sizeof *self->material_of))
        return false;
    while (self->material_count <= self->group) self->material_of[self->material_count++] = 0;
    self->material_of[self->group] = named ? 1 + (uint32_t)number : 0;
    return true;
}

static bool color_groups(obj *self) {
    if (self->materials.textured) dp_builder_note_textures(self->builder);
    for (size_t g = 0; g < self->material_count; g++) {
        if (!self->material_of[g]) continue;
        const uint32_t color =
            dp_materials_color(&self->materials, (uint16_t)(self->material_of[g] - 1));
        if (color && !dp_builder_color(self->builder, (uint16_t)g, color)) return false;
    }
    return true;
}

/* The group of the current names. */
static dp_result find_group(obj *self) {
    char joined[NAME_KINDS * NAME] = "";
    size_t length = 0;
    for (int i = 0; i < NAME_KINDS; i++) {
        if (!*self->names[i]) continue;
        if (length) joined[length++] = '/';
        const size_t size = strlen(self->names[i]);
        memcpy(joined + length, self->names[i], size + 1);
        length += size;
    }
    self->renamed = false;
    if (dp_groups_find(&self->builder->names, joined, &self->group) && note_material(self))
        return DP_OK;
    return dp_builder_fail(self->builder, self->diag);
}

/* Reads the number after a slash; 0 if there is none. */
static inline const uint8_t *read_more(const uint8_t *p, int64_t *number) {
    const bool negative = *p == '-';
    int64_t value = 0;
    p += negative;
    for (; *p >= '0' && *p <= '9'; p++)
        if (value < INT64_C(1) << 40) value = 10 * value + (*p - '0');
    *number = negative ? -value : value;
    return p;
}

/* v, v/vt, v//vn or v/vt/vn at the cursor; more[0] is vt's number, more[1] vn's, 0: none. */
static inline bool read_corner(dp_stream *stream, int64_t *index, int64_t more[2]) {
    const uint8_t *p = stream->cursor;
    uint32_t number = 0;
    for (uint32_t digit; (digit = (uint32_t)*p - '0') <= 9; p++) number = number * 10 + digit;
    *index = number;
    if ((size_t)(p - stream->cursor) - 1 > 8) p = dp_number_int(stream->cursor, index);
    if (!p) return false;
    more[0] = more[1] = 0;
    for (int k = 0; k < 2 && *p == '/'; k++) p = read_more(p + 1, &more[k]);
    while (*p == '/' || *p == '-' || (*p >= '0' && *p <= '9')) p++;
    const bool ended = p == stream->end ? stream->at_end : *p <= ' ' || *p == '\\';
    if (ended) stream->cursor = p;
    return ended;
}

/* Sets the last corner's normal or texture coordinate; number: from 1, or negative from the end. */
static bool set_value(dp_builder *builder, dp_builder_attribute *attribute, int64_t number) {
    number += number < 0 ? (int64_t)attribute->count : -1;
    const bool fits = number >= 0 && number < UINT32_MAX;
    return dp_builder_corner_value(builder, attribute, fits ? (uint32_t)number : UINT32_MAX);
}

static dp_result read_face(obj *self) {
    if (self->renamed) {
        const dp_result result = find_group(self);
        if (result) return result;
    }
    while (dp_text_blank(self->stream)) {
        int64_t index, more[2];
        if (*self->stream->cursor == '#') break;
        if (!read_corner(self->stream, &index, more))
            return dp_text_expected(self->stream, self->diag, "a face's vertex number");
        index += index < 0 ? (int64_t)self->builder->vertex_count : -1;
        if (!dp_builder_corner(self->builder, index))
            return dp_builder_fail(self->builder, self->diag);
        if ((more[0] && !set_value(self->builder, &self->builder->texcoords, more[0])) ||
            (more[1] && !set_value(self->builder, &self->builder->normals, more[1])))
            return dp_builder_fail(self->builder, self->diag);
    }
    if (!dp_builder_close(self->builder, self->group))
        return dp_builder_fail(self->builder, self->diag);
    return DP_OK;
}

static dp_result read_name(obj *self, int kind) {
    dp_text_blank(self->stream);
    dp_text_rest(self->stream, self->names[kind], NAME);
    self->renamed = true;
    return DP_OK;
}

static dp_result read_libraries(obj *self) {
    char names[LIBRARIES];
    dp_text_blank(self->stream);
    dp_text_rest(self->stream, names, sizeof names);
    if (dp_open_mtl(self->stream, names, &self->materials, self->builder->color_remark,
                    sizeof self->builder->color_remark))
        return DP_OK;
    return dp_builder_fail(self->builder, self->diag);
}

/* Skips the line's first word if it is `word` and something follows. Byte by byte, as the file may
 * end within. */
static inline bool keyword(dp_stream *stream, const char *word) {
    const uint8_t *p = stream->cursor;
    for (; *word; p++, word++)
        if (*p != (uint8_t)*word) return false;
    if (*p != ' ' && *p != '\t') return false;
    stream->cursor = p;
    return true;
}

static dp_result read_line(obj *self) {
    dp_stream *const stream = self->stream;
    if (keyword(stream, "v")) return read_vertex(self);
    if (keyword(stream, "f")) return read_face(self);
    if (keyword(stream, "vn")) return read_value(self, &self->builder->normals, 3);
    if (keyword(stream, "vt")) return read_value(self, &self->builder->texcoords, 2);
    if (keyword(stream, "o")) return read_name(self, OBJECT);
    if (dp_text_match(stream, "g")) return read_name(self, GROUP); /* may stand alone */
    if (keyword(stream, "usemtl")) return read_name(self, MATERIAL);
    if (keyword(stream, "mtllib")) return read_libraries(self);
    return DP_OK;
}

static dp_result read_lines(obj *self) {
    dp_text_skip_mark(self->stream);
    while (dp_text_space(self->stream)) {
        const dp_result result = read_line(self);
        if (result) return result;
        dp_text_skip_line(self->stream);
    }
    return color_groups(self) ? DP_OK : dp_builder_fail(self->builder, self->diag);
}

dp_result dp_read_obj(dp_stream *stream, dp_builder *builder, dp_diag *diag) {
    obj self = {.stream = stream, .builder = builder, .diag = diag, .renamed = true, .most = 1};
    dp_materials_init(&self.materials, &builder->allocator);
    const dp_result result = read_lines(&self);
    dp_materials_destroy(&self.materials);
    dp_free(&builder->allocator, self.material_of);
    return result;
}
