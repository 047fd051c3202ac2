/* PLY after its header: vertices, faces and triangle strips, read whole.
 *
 * One walk over elements and properties serves ASCII and both byte orders; only the three functions
 * that take a scalar differ. ASCII values may be spread over lines in any way. Strips: -1 begins a
 * new one, every other triangle is reversed, and triangles with equal corners, which only join
 * strips, are left out.
 *
 * Invariant: no more is allocated for announced counts than the file's size allows.
 *
 * Not handled: polygons given by edges; materials; textures (that there are some is noted). */
#include "io/ply.h"

#include "io/color.h"
#include "io/readers.h"
#include "io/text.h"

#include <inttypes.h>
#include <string.h>

typedef struct ply {
    dp_stream *stream;
    dp_builder *builder;
    dp_diag *diag;
    dp_ply_header header;
    const dp_ply_element *element; /* being read */
    uint64_t item;                 /* its number */
    float most;                    /* dp_color_guess */
} ply;

/* ------- scalars ------- */

static const uint8_t size_of_type[] = {1, 1, 2, 2, 4, 4, 4, 8};

/* Reads bytes of either order, on machines of either order. */
static inline uint32_t load16(const uint8_t *p, bool big) {
    return big ? (uint32_t)p[0] << 8 | p[1] : (uint32_t)p[1] << 8 | p[0];
}
static inline uint32_t load32(const uint8_t *p, bool big) {
    if (big) return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
    return (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}
static inline uint64_t load(const uint8_t *p, size_t size, bool big) {
    if (size == 4) return load32(p, big);
    if (size == 1) return *p;
    if (size == 2) return load16(p, big);
    const uint64_t first = load32(p, big), second = load32(p + 4, big);
    return big ? first << 32 | second : second << 32 | first;
}

/* The next scalar's bits; false at the file's end. */
static inline bool take_bits(ply *self, dp_ply_type type, uint64_t *bits) {
    dp_stream *const stream = self->stream;
    const size_t size = size_of_type[type];
    if (!dp_stream_have(stream, size)) return false;
    *bits = load(stream->cursor, size, self->header.encoding == DP_PLY_BIG);
    stream->cursor += size;
    return true;
}

static inline double double_of_bits(uint64_t bits, dp_ply_type type) {
    double wide;
    float value;
    const uint32_t low = (uint32_t)bits;
    switch (type) {
    case DP_PLY_INT8:
        return (int8_t)bits;
    case DP_PLY_INT16:
        return (int16_t)bits;
    case DP_PLY_INT32:
        return (int32_t)low;
    case DP_PLY_FLOAT32:
        return memcpy(&value, &low, sizeof low), (double)value;
    case DP_PLY_FLOAT64:
        return memcpy(&wide, &bits, sizeof bits), wide;
    case DP_PLY_UINT8:
    case DP_PLY_UINT16:
    case DP_PLY_UINT32:
        break;
    }
    return low;
}

static inline bool next_wide(ply *self, dp_ply_type type, float *value, double *wide) {
    if (self->header.encoding == DP_PLY_ASCII)
        return dp_text_space(self->stream) && dp_text_wide(self->stream, value, wide);
    uint64_t bits;
    if (!take_bits(self, type, &bits)) return false;
    *wide = double_of_bits(bits, type);
    *value = (float)*wide;
    return true;
}

static bool next_float(ply *self, dp_ply_type type, float *value) {
    double unused;
    return next_wide(self, type, value, &unused);
}

/* Vertex numbers and list lengths may be of any type, but not fractions. */
static int64_t int_of_double(double value) {
    if (!(value > -1e15 && value < 1e15) || value != (double)(int64_t)value) return UINT32_MAX;
    return (int64_t)value;
}

static inline int64_t int_of_bits(uint64_t bits, dp_ply_type type) {
    double wide;
    switch (type) {
    case DP_PLY_INT8:
        return (int8_t)bits;
    case DP_PLY_INT16:
        return (int16_t)bits;
    case DP_PLY_INT32:
        return (int32_t)(uint32_t)bits;
    case DP_PLY_FLOAT32:
        return int_of_double(double_of_bits(bits, type));
    case DP_PLY_FLOAT64:
        return memcpy(&wide, &bits, sizeof bits), int_of_double(wide);
    case DP_PLY_UINT8:
    case DP_PLY_UINT16:
    case DP_PLY_UINT32:
        break;
    }
    return (int64_t)bits;
}

static inline bool next_int(ply *self, dp_ply_type type, int64_t *value) {
    if (self->header.encoding != DP_PLY_ASCII) {
        uint64_t bits;
        if (!take_bits(self, type, &bits)) return false;
        *value = int_of_bits(bits, type);
        return true;
    }
    if (!dp_text_space(self->stream)) return false;
    if (type < DP_PLY_FLOAT32) return dp_text_int(self->stream, value);
    float number;
    if (!dp_text_float(self->stream, &number)) return false;
    *value = int_of_double((double)number);
    return true;
}

static bool skip_scalars(ply *self, dp_ply_type type, uint64_t count) {
    if (self->header.encoding != DP_PLY_ASCII)
        return dp_stream_skip(self->stream, count * size_of_type[type]);
    for (; count; count--) {
        if (!dp_text_space(self->stream)) return false;
        dp_text_skip_word(self->stream);
    }
    return true;
}

/* ------- elements ------- */

static dp_result expected(ply *self, const char *what) {
    const char *const kind = dp_ply_kind_name(self->element->kind);
    dp_result result;
    if (self->header.encoding == DP_PLY_ASCII)
        result = dp_text_expected(self->stream, self->diag, "%s of %s %" PRIu64 " of %" PRIu64,
                                  what, kind, self->item, self->element->count);
    else if (self->stream->result)
        result = dp_stream_fail(self->stream, self->diag);
    else
        result = dp_fail_offset(self->diag, DP_ERR_FORMAT, self->stream->loaded,
                                "the file ends in %s %" PRIu64 " of %" PRIu64
                                ": it is cut short, copy or export it again",
                                kind, self->item, self->element->count);
    if (self->diag) self->diag->item = self->item;
    return result;
}

static dp_result read_length(ply *self, const dp_ply_property *property, int64_t *length) {
    const uint64_t offset = dp_stream_offset(self->stream);
    if (!next_int(self, property->count, length)) return expected(self, "a list's length");
    if (*length >= 0 && (property->count < DP_PLY_FLOAT32 || *length < UINT32_MAX)) return DP_OK;
    if (self->header.encoding == DP_PLY_ASCII)
        return dp_fail_line(self->diag, DP_ERR_FORMAT, self->stream->line,
                            "a list's length is %" PRId64 ": export the model again", *length);
    return dp_fail_offset(self->diag, DP_ERR_FORMAT, offset,
                          "a list's length is %" PRId64 ": export the model again", *length);
}

/* Takes the corners of the usual binary case, a few of 32 bits, with one check. Returns how many: 0
 * in other cases, fewer when memory is out; read_polygon continues from there. */
static inline int64_t take_corners(ply *self, dp_ply_type type, int64_t length) {
    dp_stream *const stream = self->stream;
    const bool usual = type == DP_PLY_INT32 || type == DP_PLY_UINT32;
    if (!usual || self->header.encoding == DP_PLY_ASCII || length > 64) return 0;
    if (!dp_stream_have(stream, 4 * (size_t)length)) return 0;
    const bool big = self->header.encoding == DP_PLY_BIG;
    int64_t taken = 0;
    for (; taken < length; taken++, stream->cursor += 4) {
        const uint32_t bits = load32(stream->cursor, big);
        if (!dp_builder_corner(self->builder, int_of_bits(bits, type))) break;
    }
    return taken;
}

static dp_result read_polygon(ply *self, const dp_ply_property *property, int64_t length) {
    int64_t vertex;
    for (int64_t i = take_corners(self, property->type, length); i < length; i++) {
        if (!next_int(self, property->type, &vertex)) return expected(self, "a vertex number");
        if (!dp_builder_corner(self->builder, vertex))
            return dp_builder_fail(self->builder, self->diag);
    }
    if (!dp_builder_close(self->builder, 0)) return dp_builder_fail(self->builder, self->diag);
    return DP_OK;
}

static bool add_triangle(dp_builder *builder, int64_t a, int64_t b, int64_t c) {
    if (a == b || b == c || c == a) return true;
    return dp_builder_corner(builder, a) && dp_builder_corner(builder, b) &&
           dp_builder_corner(builder, c) && dp_builder_close(builder, 0);
}

static dp_result read_strip(ply *self, const dp_ply_property *property, int64_t length) {
    int64_t a = 0, b = 0, c;
    uint64_t corners = 0; /* of this strip */
    for (int64_t i = 0; i < length; i++) {
        if (!next_int(self, property->type, &c)) return expected(self, "a vertex number");
        corners = c == -1 || c == UINT32_MAX ? 0 : corners + 1;
        const bool odd = corners % 2 == 0; /* the strip's second triangle, fourth, … */
        if (corners >= 3 && !add_triangle(self->builder, odd ? b : a, odd ? a : b, c))
            return dp_builder_fail(self->builder, self->diag);
        a = b;
        b = c;
    }
    return DP_OK;
}

static dp_result read_list(ply *self, const dp_ply_property *property) {
    int64_t length;
    const dp_result result = read_length(self, property, &length);
    if (result) return result;
    if (property->role == DP_PLY_POLYGON) return read_polygon(self, property, length);
    if (property->role == DP_PLY_STRIP) return read_strip(self, property, length);
    if (!skip_scalars(self, property->type, (uint64_t)length)) return expected(self, "a list");
    return DP_OK;
}

/* What an item may have besides a position: a vertex's normal, texture coordinates, colour. Faces may
 * have a colour. */
enum { NORMAL_AT = 0, TEXCOORD_AT = 3, COLOR_AT = 5, MORE = 8 };
enum { COLOR_ROLES = 7u << DP_PLY_RED };

/* What an item holds. */
typedef struct ply_item {
    float rounded[3]; /* its position as float32 */
    double position[3];
    float more[MORE];
} ply_item;

static bool read_value(ply *self, const dp_ply_property *property, ply_item *v) {
    if (property->role >= DP_PLY_NX)
        return next_float(self, property->type, &v->more[property->role - DP_PLY_NX]);
    const int axis = property->role - DP_PLY_X;
    return next_wide(self, property->type, &v->rounded[axis], &v->position[axis]);
}

static dp_result read_item(ply *self, ply_item *item) {
    const dp_ply_property *property = self->header.properties + self->element->first;
    const dp_ply_property *const end = property + self->element->properties;
    for (; property < end; property++) {
        if (property->list) {
            const dp_result result = read_list(self, property);
            if (result) return result;
        } else if (property->role == DP_PLY_SKIP) {
            if (!skip_scalars(self, property->type, 1)) return expected(self, "a value");
        } else if (!read_value(self, property, item)) {
            return expected(self, "a coordinate");
        }
    }
    return DP_OK;
}

/* The fewest bytes that one of the element's items takes. */
static size_t least_bytes(const ply *self) {
    const dp_ply_property *const properties = self->header.properties + self->element->first;
    size_t bytes = 0;
    for (size_t i = 0; i < self->element->properties; i++) {
        const dp_ply_type type = properties[i].list ? properties[i].count : properties[i].type;
        bytes += self->header.encoding == DP_PLY_ASCII ? 2 : size_of_type[type];
    }
    return bytes;
}

/* Reserves room for vertices, or for triangles with the shortest indices. */
static bool expect_items(ply *self) {
    const size_t bytes = least_bytes(self);
    const uint64_t count = self->element->count;
    if (self->element->kind == DP_PLY_VERTEX)
        return dp_builder_expect_vertices(self->builder,
                                          dp_stream_hint(self->stream, count, bytes));
    if (self->element->roles & 1u << DP_PLY_POLYGON)
        return dp_builder_expect_corners(
            self->builder, dp_times(3, dp_stream_hint(self->stream, count, bytes + 3)));
    return true;
}

/* Colours are shares of the largest number of their type, those of floats of 1 or of 255. */
static uint32_t color_of(ply *self, const float rgb[3]) {
    const dp_ply_property *property = self->header.properties + self->element->first;
    while (property->role != DP_PLY_RED) property++;
    if (property->type >= DP_PLY_FLOAT32) return dp_color_guess(rgb, &self->most);
    return dp_color_of(rgb, size_of_type[property->type] == 1   ? 255
                            : size_of_type[property->type] == 2 ? 65535
                                                                : 4294967295.0F);
}

static bool has_roles(const ply *self, unsigned roles) {
    return (self->element->roles & roles) == roles;
}

/* Stores the vertex's normal, texture coordinates and colour, if all of their parts exist. */
static bool keep_more_of_vertex(ply *self, const float more[MORE]) {
    dp_builder *const builder = self->builder;
    if (has_roles(self, 7u << DP_PLY_NX)) {
        float *const to = dp_builder_vertex_value(builder, &builder->normals, 3);
        if (!to) return false;
        memcpy(to, more + NORMAL_AT, 3 * sizeof *to);
    }
    if (has_roles(self, 3u << DP_PLY_S)) {
        float *const to = dp_builder_vertex_value(builder, &builder->texcoords, 2);
        if (!to) return false;
        memcpy(to, more + TEXCOORD_AT, 2 * sizeof *to);
    }
    return !has_roles(self, COLOR_ROLES) ||
           dp_builder_vertex_color(builder, builder->vertex_count - 1,
                                   color_of(self, more + COLOR_AT));
}

/* Stores the face's colour, if it has one. */
static bool keep_more_of_face(ply *self, const float more[MORE]) {
    return !has_roles(self, COLOR_ROLES | 1u << DP_PLY_POLYGON) ||
           dp_builder_polygon_color(self->builder, color_of(self, more + COLOR_AT));
}

/* Are coordinates float32 in the file? They have nothing to lose then, and have lost it already
 * where the model lies far from 0 (dp_extent.spacing). */
static bool is_single(const ply *self) {
    const dp_ply_property *const properties = self->header.properties + self->element->first;
    for (size_t i = 0; i < self->element->properties; i++)
        if (!properties[i].list && properties[i].role >= DP_PLY_X &&
            properties[i].role <= DP_PLY_Z && properties[i].type != DP_PLY_FLOAT32)
            return false;
    return self->header.encoding != DP_PLY_ASCII;
}

static bool keep_position(ply *self, const ply_item *v, bool single) {
    if (!single) return dp_builder_place(self->builder, v->position, v->rounded);
    float *const to = dp_builder_vertex(self->builder);
    if (to) memcpy(to, v->rounded, sizeof v->rounded);
    return to;
}

static dp_result read_element(ply *self, const dp_ply_element *element) {
    self->element = element;
    if (!element->properties) return DP_OK; /* items of no bytes, however many */
    if (!expect_items(self)) return dp_builder_fail(self->builder, self->diag);
    dp_result result = DP_OK;
    ply_item v = {0};
    const bool is_vertex = element->kind == DP_PLY_VERTEX, single = is_single(self);
    bool (*const keep_more)(ply *, const float *) =
        is_vertex ? keep_more_of_vertex : keep_more_of_face;
    const bool has_more = element->roles >> DP_PLY_NX & 255;
    for (self->item = 0; self->item < element->count && !result; self->item++) {
        result = read_item(self, &v);
        if (!result && ((is_vertex && !keep_position(self, &v, single)) ||
                        (has_more && !keep_more(self, v.more))))
            result = dp_builder_fail(self->builder, self->diag);
    }
    return result;
}

/* Text after the last element means that something before was misread. */
static dp_result check_end(ply *self) {
    if (self->header.encoding != DP_PLY_ASCII || !dp_text_space(self->stream)) return DP_OK;
    return dp_fail_line(self->diag, DP_ERR_FORMAT, self->stream->line,
                        "text behind the last element: the header's counts or properties do not "
                        "match the content, export the model again");
}

dp_result dp_read_ply(dp_stream *stream, dp_builder *builder, dp_diag *diag) {
    ply self = {.stream = stream, .builder = builder, .diag = diag, .most = 1};
    dp_result result = dp_ply_read_header(stream, &self.header, diag);
    if (self.header.textured) dp_builder_note_textures(builder);
    for (size_t i = 0; i < self.header.element_count && !result; i++)
        result = read_element(&self, &self.header.elements[i]);
    if (!result) result = check_end(&self);
    dp_ply_destroy_header(&self.header);
    return result;
}
