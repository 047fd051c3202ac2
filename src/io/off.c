/* OFF: counts, vertices, faces; read whole.
 *
 * COFF, NOFF, STOFF and their combinations have normals, colours and texture coordinates after the
 * position, in this order, and any face may have a colour: all on the same line. Of these, colours
 * are read, and what is left of a vertex's or face's line is ignored. '#' begins a comment. The
 * keyword may be missing.
 *
 * Not handled: OFF BINARY; four or n coordinates per vertex (4OFF, nOFF); colours of faces as numbers
 * of a table. */
#include "io/readers.h"

#include "io/color.h"
#include "io/text.h"

#include <inttypes.h>

typedef struct off {
    dp_stream *stream;
    dp_builder *builder;
    dp_diag *diag;
    int64_t vertices, faces;  /* announced */
    bool normals, colors;     /* follow the position */
    float most, most_of_face; /* dp_color_guess */
} off;

/* Skips to the next word outside a comment. */
static bool next_word(dp_stream *stream) {
    while (dp_text_space(stream)) {
        if (*stream->cursor != '#') return true;
        dp_text_skip_line(stream);
    }
    return false;
}

/* Skips [ST][C][N][4][n]OFF, which the counts may follow without a blank; false if it is not there.
 * *dimensions: vertices do not have three coordinates. */
static bool take_keyword(off *self, bool *dimensions) {
    dp_stream *const stream = self->stream;
    const uint8_t *p = stream->cursor;
    if (p[0] == 'S' && p[1] == 'T') p += 2;
    self->colors = *p == 'C';
    p += self->colors;
    self->normals = *p == 'N';
    p += self->normals;
    *dimensions = *p == '4' || *p == 'n';
    p += *p == '4';
    p += *p == 'n';
    if (p[0] != 'O' || p[1] != 'F' || p[2] != 'F') return false;
    stream->cursor = p + 3;
    return true;
}

static dp_result read_keyword(off *self) {
    dp_stream *const stream = self->stream;
    bool dimensions = false;
    if (!next_word(stream)) return dp_text_expected(stream, self->diag, "`OFF`");
    const bool number = *stream->cursor >= '0' && *stream->cursor <= '9';
    if (!take_keyword(self, &dimensions) && !number)
        return dp_text_expected(stream, self->diag, "`OFF`");
    if (dimensions)
        return dp_fail_line(self->diag, DP_ERR_UNSUPPORTED, stream->line,
                            "OFF with other than three coordinates: export it as plain OFF");
    next_word(stream);
    if (!dp_text_match(stream, "binary")) return DP_OK;
    return dp_fail_line(self->diag, DP_ERR_UNSUPPORTED, stream->line,
                        "binary OFF: export it as ASCII OFF, PLY or STL");
}

/* Reads a number >= 0; anything else stays at the cursor, for the message. */
static bool next_natural(dp_stream *stream, int64_t *value) {
    next_word(stream);
    const uint8_t *const start = stream->cursor;
    if (!dp_text_int(stream, value)) return false;
    if (*value < 0) stream->cursor = start;
    return *value >= 0;
}

static dp_result read_count(off *self, const char *what, int64_t *count) {
    if (next_natural(self->stream, count)) return DP_OK;
    return dp_text_expected(self->stream, self->diag, "the number of %s", what);
}

/* Reports that `what` of vertex or face `item` of `count` is missing. */
static dp_result expected(off *self, const char *what, int64_t item, int64_t count) {
    const dp_result result =
        dp_text_expected(self->stream, self->diag, "%s %" PRId64 " of %" PRId64, what, item, count);
    if (self->diag) self->diag->item = (uint64_t)item;
    return result;
}

/* Reads what follows the position on a vertex's line. False when memory is out. */
static bool read_color(off *self) {
    float values[6];
    const int first = self->normals ? 3 : 0, last = first + 3;
    int n = 0;
    while (n < last && dp_text_blank(self->stream) && dp_text_float(self->stream, &values[n])) n++;
    return n < last || dp_builder_vertex_color(self->builder, self->builder->vertex_count - 1,
                                               dp_color_guess(values + first, &self->most));
}

static dp_result read_vertex(off *self, int64_t vertex) {
    float rounded[3];
    double position[3];
    for (int k = 0; k < 3; k++) {
        next_word(self->stream);
        if (!dp_text_wide(self->stream, &rounded[k], &position[k]))
            return expected(self, "a coordinate of vertex", vertex, self->vertices);
    }
    if (!dp_builder_place(self->builder, position, rounded) || (self->colors && !read_color(self)))
        return dp_builder_fail(self->builder, self->diag);
    dp_text_skip_line(self->stream);
    return DP_OK;
}

/* Reads three numbers behind a face's corners; one is an index of a table that nobody has. False
 * when memory is out. */
static bool read_face_color(off *self) {
    float rgb[3];
    int n = 0;
    while (n < 3 && dp_text_blank(self->stream) && dp_text_float(self->stream, &rgb[n])) n++;
    return n < 3 ||
           dp_builder_polygon_color(self->builder, dp_color_guess(rgb, &self->most_of_face));
}

static dp_result read_face(off *self, int64_t face) {
    int64_t corners, index;
    if (!next_natural(self->stream, &corners))
        return expected(self, "the number of corners of face", face, self->faces);
    for (int64_t c = 0; c < corners; c++) {
        next_word(self->stream);
        if (!dp_text_int(self->stream, &index))
            return expected(self, "a vertex number of face", face, self->faces);
        if (!dp_builder_corner(self->builder, index))
            return dp_builder_fail(self->builder, self->diag);
    }
    const bool closed = dp_builder_close(self->builder, 0) && read_face_color(self);
    dp_text_skip_line(self->stream);
    return closed ? DP_OK : dp_builder_fail(self->builder, self->diag);
}

/* Keyword, vertices, faces; the edges' count is often missing and never needed. */
static dp_result read_header(off *self) {
    dp_result result = read_keyword(self);
    if (!result) result = read_count(self, "vertices", &self->vertices);
    if (!result) result = read_count(self, "faces", &self->faces);
    if (result) return result;
    dp_text_skip_line(self->stream);
    const size_t vertices = dp_stream_hint(self->stream, (uint64_t)self->vertices, 6);
    const size_t triangles = dp_stream_hint(self->stream, (uint64_t)self->faces, 8);
    if (dp_builder_expect_vertices(self->builder, vertices) &&
        dp_builder_expect_corners(self->builder, dp_times(3, triangles)))
        return DP_OK;
    return dp_builder_fail(self->builder, self->diag);
}

dp_result dp_read_off(dp_stream *stream, dp_builder *builder, dp_diag *diag) {
    off self = {.stream = stream, .builder = builder, .diag = diag, .most = 1, .most_of_face = 1};
    dp_text_skip_mark(stream);
    dp_result result = read_header(&self);
    for (int64_t i = 0; i < self.vertices && !result; i++) result = read_vertex(&self, i);
    for (int64_t i = 0; i < self.faces && !result; i++) result = read_face(&self, i);
    return result;
}
