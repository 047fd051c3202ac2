/* STL: triangles in batches; a file is never held whole.
 *
 *     binary   80 bytes of title, the number of triangles, 50 bytes for each
 *     ASCII    solids of facets; each solid's name is a group
 *
 * Normals are ignored: the corners' order tells the front. A binary file's triangles can also be
 * read in any order (dp_records).
 *
 * Invariant: a failure is final: every call reports it again until the source is rewound.
 *
 * Not handled: colours in the attribute bytes. */
#include "io/readers.h"

#include "base/print.h"
#include "io/text.h"
#include "mesh/source.h"
#include "mesh/wide.h"

#include <inttypes.h>
#include <string.h>

#if defined(DP_HOSTILE)
enum { BATCH = 3 };
#else
enum { BATCH = 8192 /* triangles: 288 KiB of positions */ };
#endif

enum {
    HEADER = 84,     /* bytes: title and count */
    RECORD = 50,     /* bytes: normal, corners, attribute */
    CORNERS_AT = 12, /* bytes: behind the normal */
    NAME = 256
};

typedef struct stl {
    dp_allocator allocator;
    dp_stream *stream;
    bool binary;
    bool started;          /* the header, or the first solid, is read */
    bool ended;            /* ASCII: the last solid is closed */
    bool unclosed;         /* the file has ended before it was */
    uint32_t announced;    /* binary: triangles, by the header */
    uint64_t read;         /* triangles since the start */
    float (*positions)[9]; /* [BATCH] */
    dp_wide wide;          /* ASCII: of the first batch, which chooses … */
    bool settled;          /* … whether there is an origin, */
    double origin[3];      /* once and for all readings */
    uint16_t *groups;      /* [BATCH] */
    dp_groups names;
    uint16_t group;
    dp_result result; /* a failure, with its diagnostic */
    dp_diag diag;
} stl;

/* ------- binary ------- */

static uint32_t little32(const uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static dp_result cut_short(stl *self) {
    if (self->stream->result) return dp_stream_fail(self->stream, &self->diag);
    dp_fail_offset(&self->diag, DP_ERR_FORMAT, self->stream->loaded,
                   "binary STL that announces %" PRIu32 " triangles ends in triangle %" PRIu64
                   ": it is cut short, copy or export it again",
                   self->announced, self->read);
    self->diag.item = self->read;
    return DP_ERR_FORMAT;
}

static dp_result read_binary_header(stl *self) {
    dp_stream *const stream = self->stream;
    if (!dp_stream_have(stream, HEADER)) {
        if (stream->result) return dp_stream_fail(stream, &self->diag);
        return dp_fail_offset(&self->diag, DP_ERR_FORMAT, stream->loaded,
                              "neither ASCII STL (no `solid`) nor binary STL (under 84 bytes): "
                              "export it again");
    }
    self->announced = little32(stream->cursor + HEADER - 4);
    stream->cursor += HEADER;
    self->started = true;
    if (self->announced) return DP_OK;
    return dp_fail_offset(
        &self->diag, DP_ERR_FORMAT, HEADER - 4,
        "binary STL that announces no triangles: there is nothing to draw, export "
        "it again");
}

/* Reports triangles that are missing by the file's size, before anything is drawn. */
static dp_result check_size(stl *self) {
    const dp_stream *const stream = self->stream;
    if (stream->size == DP_STREAM_UNKNOWN) return DP_OK;
    const uint64_t need = HEADER + (uint64_t)RECORD * self->announced;
    if (stream->size >= need) return DP_OK;
    return dp_fail_offset(&self->diag, DP_ERR_FORMAT, stream->size,
                          "binary STL that announces %" PRIu32 " triangles has bytes for %" PRIu64
                          ": it is cut short or no STL, copy or export it again",
                          self->announced, (stream->size - HEADER) / RECORD);
}

static void take_record(const uint8_t *record, float position[9]) {
    for (size_t i = 0; i < 9; i++) {
        const uint32_t bits = little32(record + CORNERS_AT + 4 * i);
        memcpy(&position[i], &bits, sizeof bits);
    }
}

static dp_result read_binary(stl *self, size_t *count) {
    dp_stream *const stream = self->stream;
    dp_result result = self->started ? DP_OK : read_binary_header(self);
    if (!result && !self->read) result = check_size(self);
    while (!result && *count < BATCH && self->read < self->announced) {
        if (!dp_stream_have(stream, RECORD)) return cut_short(self);
        take_record(stream->cursor, self->positions[(*count)++]);
        stream->cursor += RECORD;
        self->read++;
    }
    return result;
}

/* ------- ASCII ------- */

static dp_result expected(stl *self, const char *what) {
    const dp_result result =
        dp_text_expected(self->stream, &self->diag, "%s (triangle %" PRIu64 ")", what, self->read);
    self->diag.item = self->read;
    return result;
}

static bool next_is(stl *self, const char *word) {
    return dp_text_space(self->stream) && dp_text_match(self->stream, word);
}

static dp_result out_of_memory(stl *self) {
    return dp_fail(&self->diag, DP_ERR_MEMORY, "out of memory for a batch of triangles");
}

static dp_result read_corner(stl *self, size_t facet, size_t corner) {
    float *const to = self->positions[facet] + 3 * corner;
    double wide[3];
    if (!next_is(self, "vertex")) return expected(self, "`vertex`");
    for (int k = 0; k < 3; k++) {
        dp_text_space(self->stream);
        if (!dp_text_wide(self->stream, &to[k], &wide[k])) return expected(self, "a coordinate");
    }
    if (!self->settled &&
        !dp_wide_note(&self->wide, 3 * facet + corner, wide, to, &self->allocator))
        return out_of_memory(self);
    for (int k = 0; k < 3; k++)
        if (self->origin[k] != 0)
            to[k] = dp_wide_place(to[k], dp_wide_rest(wide[k], to[k]), self->origin[k]);
    return DP_OK;
}

/* Reads what follows `facet`: normal x y z, outer loop, three corners, endloop, endfacet. */
static dp_result read_facet(stl *self, size_t facet) {
    if (!next_is(self, "normal")) return expected(self, "`normal`");
    for (int k = 0; k < 3; k++) {
        dp_text_space(self->stream);
        dp_text_skip_word(self->stream);
    }
    if (!next_is(self, "outer")) return expected(self, "`outer loop`");
    if (!next_is(self, "loop")) return expected(self, "`loop`");
    for (size_t c = 0; c < 3; c++) {
        const dp_result result = read_corner(self, facet, c);
        if (result) return result;
    }
    if (!next_is(self, "endloop")) return expected(self, "`endloop` after three vertices");
    if (!next_is(self, "endfacet")) return expected(self, "`endfacet`");
    return DP_OK;
}

static dp_result read_solid(stl *self) {
    char name[NAME];
    dp_text_blank(self->stream);
    dp_text_rest(self->stream, name, sizeof name);
    self->started = true;
    self->ended = false;
    if (dp_groups_find(&self->names, name, &self->group)) return DP_OK;
    return dp_fail(&self->diag, DP_ERR_MEMORY, "out of memory for the name of a solid");
}

/* At the end of the file, which must be between facets. Files without the last `endsolid` are
 * common; whether such a file is cut short cannot be known. */
static dp_result check_end(stl *self) {
    if (self->stream->result || !self->started) return expected(self, "`solid`");
    self->unclosed = !self->ended;
    if (self->read) return DP_OK;
    return dp_fail_line(&self->diag, DP_ERR_FORMAT, self->stream->line,
                        "ASCII STL without facets: there is nothing to draw, export it again");
}

static dp_result read_ascii(stl *self, size_t *count) {
    if (!self->started) dp_text_skip_mark(self->stream);
    while (*count < BATCH) {
        dp_result result = DP_OK;
        if (!dp_text_space(self->stream)) return check_end(self);
        if (self->started && dp_text_match(self->stream, "facet")) {
            result = read_facet(self, *count);
            self->groups[*count] = self->group;
            *count += !result;
            self->read += !result;
            self->ended = false;
        } else if (self->started && dp_text_match(self->stream, "endsolid")) {
            dp_text_skip_line(self->stream);
            self->ended = true;
        } else if (dp_text_match(self->stream, "solid")) {
            result = read_solid(self);
        } else {
            return expected(self, self->started ? "`facet` or `endsolid`" : "`solid`");
        }
        if (result) return result;
    }
    return DP_OK;
}

/* ------- source ------- */

static bool any_group(const uint16_t *groups, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (groups[i]) return true;
    return false;
}

static dp_result stl_next(void *user, dp_batch *batch, dp_diag *diag) {
    stl *const self = user;
    size_t count = 0;
    if (!self->result)
        self->result = self->binary ? read_binary(self, &count) : read_ascii(self, &count);
    if (self->result) {
        *diag = self->diag;
        return self->result;
    }
    if (!self->binary && !self->settled) {
        dp_wide_settle(&self->wide, self->positions[0], 3 * count, self->origin, &self->allocator);
        self->settled = true;
    }
    *batch = (dp_batch){.positions = self->positions[0],
                        .vertex_count = 3 * count,
                        .corner_count = 3 * count,
                        .polygon_count = count,
                        .groups = any_group(self->groups, count) ? self->groups : NULL};
    memcpy(batch->origin, self->origin, sizeof batch->origin);
    return DP_OK;
}

static dp_result stl_rewind(void *user, dp_diag *diag) {
    stl *const self = user;
    self->started = self->ended = false;
    self->read = 0;
    self->group = 0;
    self->result = DP_OK;
    return dp_stream_rewind(self->stream, diag);
}

/* From any thread. Fails if the file has become shorter since it was opened. */
static dp_result stl_records(void *user, uint64_t first, uint32_t count, uint8_t *to,
                             dp_diag *diag) {
    const stl *const self = user;
    const uint64_t at = HEADER + RECORD * first;
    const size_t size = (size_t)RECORD * count;
    size_t got = 0;
    int error = 0;
    if (dp_stream_read_at(self->stream, at, to, size, &got, &error)) {
        if (got == size) return DP_OK;
        dp_fail_offset(diag, DP_ERR_FORMAT, at + got,
                       "binary STL that announces %" PRIu32 " triangles ends in triangle %" PRIu64
                       ": it is cut short, copy or export it again",
                       self->announced, first + got / RECORD);
        diag->item = first + got / RECORD;
        return DP_ERR_FORMAT;
    }
    return dp_fail_offset(diag, DP_ERR_IO, at + got, "reading failed: %s",
                          dp_print_error((char[DP_ERROR_TEXT]){0}, error));
}

static bool is_little_endian(void) {
    const uint32_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static void offer_records(stl *self, dp_source *source) {
    if (!self->binary || !dp_stream_rewindable(self->stream) || !is_little_endian()) return;
    source->records = (dp_records){.user = self,
                                   .count = self->announced,
                                   .size = RECORD,
                                   .corners = CORNERS_AT,
                                   .read = stl_records,
                                   .progress = self->stream->progress,
                                   .progress_user = self->stream->user};
}

static const char *stl_group_name(void *user, uint32_t group) {
    return dp_groups_name(&((stl *)user)->names, group);
}

static const char *stl_remark(void *user) {
    return ((stl *)user)->unclosed
               ? "ASCII STL without its last `endsolid`: if it is cut short, facets are missing"
               : NULL;
}

/* Frees all but the stream. */
static void release(stl *self) {
    const dp_allocator memory = self->allocator;
    dp_groups_destroy(&self->names);
    dp_wide_free(&self->wide, &memory);
    dp_free(&memory, self->positions);
    dp_free(&memory, self->groups);
    dp_free(&memory, self);
}

static void stl_destroy(void *user) {
    stl *const self = user;
    dp_stream_close(self->stream);
    release(self);
}

static stl *create(dp_stream *stream) {
    const dp_allocator memory = stream->allocator;
    stl *const self = dp_alloc(&memory, sizeof *self);
    if (!self) return NULL;
    *self = (stl){.allocator = memory, .stream = stream, .names = {.allocator = memory}};
    self->positions = dp_alloc_array(&memory, BATCH, sizeof *self->positions);
    self->groups = dp_alloc_zeroed(&memory, BATCH * sizeof *self->groups);
    if (self->positions && self->groups) return self;
    release(self);
    return NULL;
}

/* Checks the header and the size before a source is made. */
static dp_result open_binary(stl *self) {
    const dp_result result = read_binary_header(self);
    return result ? result : check_size(self);
}

dp_result dp_read_stl(dp_stream *stream, dp_source **out, dp_diag *diag) {
    stl *const self = create(stream);
    if (!self) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a batch of triangles");
    self->binary = dp_detect_binary_stl(stream);
    dp_result result = self->binary ? open_binary(self) : DP_OK;
    if (result && diag) *diag = self->diag;
    const dp_source_callbacks callbacks = {.user = self,
                                           .next = stl_next,
                                           .rewind =
                                               dp_stream_rewindable(stream) ? stl_rewind : NULL,
                                           .destroy = stl_destroy,
                                           .group_name = stl_group_name,
                                           .remark = stl_remark,
                                           .up = {0, 0, 1}, /* as slicers and CAD have it */
                                           .up_assumed = true};
    if (!result) result = dp_source_from_callbacks(&callbacks, &stream->allocator, out, diag);
    if (result)
        release(self);
    else
        offer_records(self, *out);
    return result;
}
