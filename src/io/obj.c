/* Wavefront OBJ: vertices and faces, read whole.
 *
 * Polygons stay polygons. A face's group is named by what holds at its line,
 * "object/group/material" without the parts that were not given; groups are numbered as their first
 * face comes. An index that names no vertex (0, before the first vertex, beyond 32 bits) becomes
 * UINT32_MAX: the engine drops the face and counts it.
 *
 * Does not handle: free-form curves and surfaces, points, lines, texture coordinates, normals,
 * smoothing groups, material files; their lines are passed over. */
#include "io/readers.h"

#include "io/number.h"
#include "io/text.h"

#include <string.h>

enum { NAME = 256 };

enum { OBJECT, GROUP, MATERIAL, NAME_KINDS };

typedef struct obj {
    dp_stream *stream;
    dp_builder *builder;
    dp_diag *diag;
    char names[NAME_KINDS][NAME];
    bool renamed;   /* since the last face */
    uint16_t group; /* of the last face */
} obj;

static dp_result read_vertex(obj *self) {
    float position[3];
    for (int k = 0; k < 3; k++) {
        dp_text_blank(self->stream);
        if (!dp_text_float(self->stream, &position[k]))
            return dp_text_expected(self->stream, self->diag, "a vertex's %c", 'x' + k);
    }
    float *const to = dp_builder_vertex(self->builder);
    if (!to) return dp_builder_fail(self->builder, self->diag);
    memcpy(to, position, sizeof position);
    return DP_OK;
}

/* The names that hold, joined, as a group number. */
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
    if (dp_groups_find(&self->builder->names, joined, &self->group)) return DP_OK;
    return dp_builder_fail(self->builder, self->diag);
}

/* v, v/vt, v//vn or v/vt/vn at the cursor: only v counts. */
static inline bool read_corner(dp_stream *stream, int64_t *index) {
    const uint8_t *p = stream->cursor;
    uint32_t number = 0;
    for (uint32_t digit; (digit = (uint32_t)*p - '0') <= 9; p++) number = number * 10 + digit;
    *index = number;
    if ((size_t)(p - stream->cursor) - 1 > 8) p = dp_number_int(stream->cursor, index);
    if (!p) return false;
    while (*p == '/' || *p == '-' || (*p >= '0' && *p <= '9')) p++;
    const bool ended = p == stream->end ? stream->at_end : *p <= ' ' || *p == '\\';
    if (ended) stream->cursor = p;
    return ended;
}

static dp_result read_face(obj *self) {
    if (self->renamed) {
        const dp_result result = find_group(self);
        if (result) return result;
    }
    while (dp_text_blank(self->stream)) {
        int64_t index;
        if (*self->stream->cursor == '#') break;
        if (!read_corner(self->stream, &index))
            return dp_text_expected(self->stream, self->diag, "a face's vertex number");
        index += index < 0 ? (int64_t)self->builder->vertex_count : -1;
        if (!dp_builder_corner(self->builder, index))
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

/* Passes over the line's first word if it is `word`, with something behind it. Byte by byte: the
 * file may end within. */
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
    if (keyword(stream, "o")) return read_name(self, OBJECT);
    if (dp_text_match(stream, "g")) return read_name(self, GROUP); /* may stand alone */
    if (keyword(stream, "usemtl")) return read_name(self, MATERIAL);
    return DP_OK;
}

dp_result dp_read_obj(dp_stream *stream, dp_builder *builder, dp_diag *diag) {
    obj self = {.stream = stream, .builder = builder, .diag = diag, .renamed = true};
    dp_text_skip_mark(stream);
    while (dp_text_space(stream)) {
        const dp_result result = read_line(&self);
        if (result) return result;
        dp_text_skip_line(stream);
    }
    return DP_OK;
}
