/* PLY's header: lines of words, up to end_header.
 *
 * Binary content follows end_header's line end at once, so that end must be exact: an LF after a CR
 * belongs to it if the first line, "ply", ended in CR LF too.
 *
 * Not handled: versions other than 1.0 (they are read as 1.0). */
#include "io/ply.h"

#include "io/text.h"

#include <string.h>

enum { WORD = 32 }; /* bytes; all known words are shorter */

typedef struct header_reader {
    dp_stream *stream;
    dp_ply_header *header;
    dp_diag *diag;
    bool pairs; /* lines end in CR LF */
} header_reader;

const char *dp_ply_kind_name(dp_ply_kind kind) {
    static const char *const names[] = {"other element", "vertex", "face", "tristrips"};
    return names[kind];
}

/* The next word of the line, "" where there is none. */
static const char *next_word(header_reader *self, char word[WORD]) {
    *word = 0;
    if (dp_text_blank(self->stream)) dp_text_word(self->stream, word, WORD);
    return word;
}

static bool parse_type(const char *word, dp_ply_type *type) {
    static const struct {
        const char *name;
        dp_ply_type type;
    } types[] = {
        {"char", DP_PLY_INT8},      {"int8", DP_PLY_INT8},       {"uchar", DP_PLY_UINT8},
        {"uint8", DP_PLY_UINT8},    {"short", DP_PLY_INT16},     {"int16", DP_PLY_INT16},
        {"ushort", DP_PLY_UINT16},  {"uint16", DP_PLY_UINT16},   {"int", DP_PLY_INT32},
        {"int32", DP_PLY_INT32},    {"uint", DP_PLY_UINT32},     {"uint32", DP_PLY_UINT32},
        {"float", DP_PLY_FLOAT32},  {"float32", DP_PLY_FLOAT32}, {"double", DP_PLY_FLOAT64},
        {"float64", DP_PLY_FLOAT64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (strcmp(types[i].name, word) != 0) continue;
        *type = types[i].type;
        return true;
    }
    return false;
}

static dp_result read_type(header_reader *self, dp_ply_type *type) {
    char word[WORD];
    if (parse_type(next_word(self, word), type)) return DP_OK;
    return dp_fail_line(self->diag, DP_ERR_FORMAT, self->stream->line,
                        "`%s` is no type of a PLY property: char, uchar, short, ushort, int, uint, "
                        "float and double are",
                        word);
}

static dp_ply_role role_of(dp_ply_kind kind, bool list, const char *name) {
    static const struct {
        const char *name;
        dp_ply_role role;
    } roles[] = {{"x", DP_PLY_X},
                 {"y", DP_PLY_Y},
                 {"z", DP_PLY_Z},
                 {"nx", DP_PLY_NX},
                 {"ny", DP_PLY_NY},
                 {"nz", DP_PLY_NZ},
                 {"s", DP_PLY_S},
                 {"t", DP_PLY_T},
                 {"u", DP_PLY_S},
                 {"v", DP_PLY_T},
                 {"texture_u", DP_PLY_S},
                 {"texture_v", DP_PLY_T},
                 {"red", DP_PLY_RED},
                 {"green", DP_PLY_GREEN},
                 {"blue", DP_PLY_BLUE},
                 {"diffuse_red", DP_PLY_RED},
                 {"diffuse_green", DP_PLY_GREEN},
                 {"diffuse_blue", DP_PLY_BLUE}};
    for (size_t i = 0; !list && i < sizeof roles / sizeof *roles; i++)
        if (strcmp(roles[i].name, name) == 0 &&
            (kind == DP_PLY_VERTEX || (kind == DP_PLY_FACE && roles[i].role >= DP_PLY_RED)))
            return roles[i].role;
    if (!list || (strcmp(name, "vertex_indices") != 0 && strcmp(name, "vertex_index") != 0))
        return DP_PLY_SKIP;
    return kind == DP_PLY_FACE        ? DP_PLY_POLYGON
           : kind == DP_PLY_TRISTRIPS ? DP_PLY_STRIP
                                      : DP_PLY_SKIP;
}

static dp_result out_of_memory(header_reader *self) {
    return dp_fail(self->diag, DP_ERR_MEMORY, "out of memory for a PLY header");
}

static dp_result read_format(header_reader *self) {
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char word[WORD];
    next_word(self, word);
    for (int i = 0; i < 3; i++) {
        if (strcmp(names[i], word) != 0) continue;
        self->header->encoding = (dp_ply_encoding)i;
        return DP_OK;
    }
    return dp_fail_line(
        self->diag, DP_ERR_FORMAT, self->stream->line,
        "`%s` is no PLY format: ascii, binary_little_endian and binary_big_endian are", word);
}

static dp_result read_element(header_reader *self) {
    dp_ply_header *const header = self->header;
    char word[WORD];
    next_word(self, word);
    dp_ply_element element = {.first = header->property_count};
    for (dp_ply_kind kind = DP_PLY_VERTEX; kind <= DP_PLY_TRISTRIPS; kind++)
        if (strcmp(word, dp_ply_kind_name(kind)) == 0) element.kind = kind;
    int64_t count = -1;
    dp_text_blank(self->stream);
    const uint8_t *const number = self->stream->cursor;
    if (!dp_text_int(self->stream, &count) || count < 0) {
        self->stream->cursor = number; /* for the message */
        return dp_text_expected(self->stream, self->diag, "the number of %s elements", word);
    }
    element.count = (uint64_t)count;
    if (!dp_reserve(&header->allocator, &header->elements, &header->element_capacity,
                    header->element_count + 1, sizeof *header->elements))
        return out_of_memory(self);
    header->elements[header->element_count++] = element;
    return DP_OK;
}

static dp_result read_property_types(header_reader *self, dp_ply_property *property) {
    dp_text_blank(self->stream);
    property->list = dp_text_match(self->stream, "list");
    const dp_result result = property->list ? read_type(self, &property->count) : DP_OK;
    return result ? result : read_type(self, &property->type);
}

static dp_result read_property(header_reader *self) {
    dp_ply_header *const header = self->header;
    char word[WORD];
    if (!header->element_count)
        return dp_fail_line(self->diag, DP_ERR_FORMAT, self->stream->line,
                            "a property before the first element: put an `element` line before it");
    dp_ply_element *const element = &header->elements[header->element_count - 1];
    dp_ply_property property = {0};
    const dp_result result = read_property_types(self, &property);
    if (result) return result;
    property.role = role_of(element->kind, property.list, next_word(self, word));
    if (element->roles >> property.role & 1) property.role = DP_PLY_SKIP; /* named twice */
    element->roles |= 1u << property.role;
    if (!dp_reserve(&header->allocator, &header->properties, &header->property_capacity,
                    header->property_count + 1, sizeof *header->properties))
        return out_of_memory(self);
    header->properties[header->property_count++] = property;
    element->properties++;
    return DP_OK;
}

/* Skips the line's end, and no byte of binary content. */
static void end_line(header_reader *self) {
    dp_stream *const stream = self->stream;
    const bool returned = dp_stream_have(stream, 1) && *stream->cursor == '\r';
    stream->cursor += returned;
    const bool fed = dp_stream_have(stream, 1) && *stream->cursor == '\n';
    if (fed && (self->pairs || !returned)) stream->cursor++;
    stream->line++;
}

/* Checks that the header describes polygons. */
static dp_result check_header(header_reader *self) {
    const unsigned xyz = 1u << DP_PLY_X | 1u << DP_PLY_Y | 1u << DP_PLY_Z;
    for (size_t i = 0; i < self->header->element_count; i++) {
        const dp_ply_element *const element = &self->header->elements[i];
        if (element->kind == DP_PLY_VERTEX && (element->roles & xyz) != xyz)
            return dp_fail_line(self->diag, DP_ERR_FORMAT, self->stream->line,
                                "the vertices lack x, y or z: export the model again");
    }
    return DP_OK;
}

/* Reads a line after its first word. *more: the header continues. Unknown words are comments:
 * Blender 2.4 wrote some without the keyword. */
static dp_result read_line(header_reader *self, const char *word, bool *more) {
    dp_result result = DP_OK;
    if (strcmp(word, "format") == 0)
        result = read_format(self);
    else if (strcmp(word, "element") == 0)
        result = read_element(self);
    else if (strcmp(word, "property") == 0)
        result = read_property(self);
    else if (strcmp(word, "comment") == 0)
        self->header->textured |= strcmp(next_word(self, (char[WORD]){0}), "TextureFile") == 0;
    else if (strcmp(word, "end_header") == 0)
        *more = false;
    return result;
}

dp_result dp_ply_read_header(dp_stream *stream, dp_ply_header *header, dp_diag *diag) {
    header_reader self = {.stream = stream, .header = header, .diag = diag};
    char word[WORD];
    *header = (dp_ply_header){.allocator = stream->allocator, .encoding = DP_PLY_ASCII};
    dp_text_skip_mark(stream);
    if (!dp_text_match(stream, "ply")) return dp_text_expected(stream, diag, "`ply`");
    while (dp_text_blank(stream)) dp_text_skip_word(stream);
    self.pairs =
        dp_stream_have(stream, 2) && stream->cursor[0] == '\r' && stream->cursor[1] == '\n';
    for (bool more = true; more;) {
        end_line(&self);
        if (!dp_stream_have(stream, 1)) return dp_text_expected(stream, diag, "`end_header`");
        const dp_result result = read_line(&self, next_word(&self, word), &more);
        if (result) return result;
        char rest[2]; /* comments, and what else the line holds */
        dp_text_rest(stream, rest, sizeof rest);
    }
    end_line(&self);
    return stream->result ? dp_stream_fail(stream, diag) : check_header(&self);
}

void dp_ply_destroy_header(dp_ply_header *header) {
    dp_free(&header->allocator, header->elements);
    dp_free(&header->allocator, header->properties);
}
