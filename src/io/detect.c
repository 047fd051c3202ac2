/* Finds a stream's format: by its first bytes, and only then by its name.
 *
 * Looks at the window and consumes nothing. A binary STL has no mark (and may begin with "solid"):
 * its size tells, or, in a pipe, where the size is unknown, plausible triangles.
 *
 * Not handled: UTF-16; compressed files (the message names them). Other formats are named too, with
 * what to do about them. */
#include "io/readers.h"

#include "base/diag.h"
#include "io/text.h"

#include <math.h>
#include <string.h>

enum {
    STL_HEADER = 84, /* bytes: a title, then the number of triangles */
    STL_RECORD = 50, /* bytes: normal, three corners, an attribute */
    STL_PROBES = 16  /* records to look at in a pipe */
};

static size_t here(const dp_stream *stream) { return (size_t)(stream->end - stream->cursor); }

static bool is_letter(uint8_t byte) { return (byte | 0x20) >= 'a' && (byte | 0x20) <= 'z'; }

static const uint8_t *skip_spaces(const uint8_t *p) {
    while (*p == ' ' || (*p >= '\t' && *p <= '\r')) p++;
    return p;
}

static const uint8_t *skip_line(const uint8_t *p, const uint8_t *end) {
    while (p < end && *p != '\n' && *p != '\r') p++;
    return p;
}

/* Skips to the first word outside a comment. */
static const uint8_t *skip_comments(const uint8_t *p, const uint8_t *end) {
    for (p = skip_spaces(p); *p == '#'; p = skip_spaces(p)) p = skip_line(p, end);
    return p;
}

static bool begins(const dp_stream *stream, const char *magic, size_t size) {
    return here(stream) >= size && memcmp(stream->cursor, magic, size) == 0;
}

static bool is_ply(const dp_stream *stream) {
    return begins(stream, "ply", 3) && (stream->cursor[3] == '\n' || stream->cursor[3] == '\r' ||
                                        stream->cursor[3] == ' ' || stream->cursor[3] == '\t');
}

/* [ST][C][N][4][n]OFF, alone or with the counts behind it ("OFF490 518 0" is common). */
static bool is_off(const dp_stream *stream) {
    const uint8_t *p = skip_comments(stream->cursor, stream->end);
    if (p[0] == 'S' && p[1] == 'T') p += 2;
    p += *p == 'C';
    p += *p == 'N';
    p += *p == '4';
    p += *p == 'n';
    return p[0] == 'O' && p[1] == 'F' && p[2] == 'F' && !is_letter(p[3]) && p[3] != '_';
}

static bool is_solid(const dp_stream *stream) {
    static const char word[] = "solid";
    const uint8_t *p = skip_spaces(stream->cursor);
    for (size_t i = 0; i < 5; i++)
        if ((p[i] | 0x20) != word[i]) return false;
    return !is_letter(p[5]);
}

/* Is the first word of a line an OBJ keyword? *vertex: it is `v` with a number. */
static bool is_obj_word(const uint8_t *p, bool *vertex) {
    static const char *const words[] = {"v", "vn", "vt", "vp", "f",      "g",
                                        "o", "s",  "l",  "p",  "usemtl", "mtllib"};
    size_t length = 0;
    while (p[length] > ' ') length++;
    const uint8_t *number = p + length;
    while (*number == ' ' || *number == '\t') number++;
    *vertex =
        length == 1 && *p == 'v' &&
        (*number == '-' || *number == '+' || *number == '.' || (*number >= '0' && *number <= '9'));
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == length && memcmp(words[i], p, length) == 0)
            return *vertex || length > 1 || *p != 'v'; /* a bare "v" opens a NFF file */
    return false;
}

/* Are all lines up to the first vertex OBJ's? */
static bool is_obj(const dp_stream *stream) {
    bool vertex = false, any = false;
    const uint8_t *p = skip_comments(stream->cursor, stream->end);
    while (!vertex && p < stream->end) {
        if (!is_obj_word(p, &vertex)) return false;
        any = true;
        p = skip_comments(skip_line(p, stream->end), stream->end);
    }
    return any;
}

static uint32_t little32(const uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static bool is_text(const uint8_t *p, size_t size) {
    for (size_t i = 0; i < size; i++)
        if (p[i] < ' ' && !(p[i] >= '\t' && p[i] <= '\r')) return false;
    return true;
}

/* Does a record have plausible coordinates? 1e18 is about the square root of the largest float. */
static bool sane_record(const uint8_t *record) {
    for (size_t i = 0; i < 12; i++) {
        const uint32_t bits = little32(record + 4 * i);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (!(fabsf(value) < 1e18f)) return false;
        if (value != 0 && fabsf(value) < 1e-30f) return false;
    }
    return true;
}

static bool sane_records(const dp_stream *stream, uint32_t count) {
    const size_t whole = (here(stream) - STL_HEADER) / STL_RECORD;
    size_t probes = count < STL_PROBES ? count : STL_PROBES;
    if (probes > whole) probes = whole;
    for (size_t i = 0; i < probes; i++)
        if (!sane_record(stream->cursor + STL_HEADER + STL_RECORD * i)) return false;
    return probes > 0;
}

/* A known size decides; otherwise a title and content that are text mean ASCII. */
static bool is_binary_stl(const dp_stream *stream) {
    if (here(stream) < STL_HEADER) return false;
    const uint32_t count = little32(stream->cursor + STL_HEADER - 4);
    const uint64_t size = STL_HEADER + (uint64_t)STL_RECORD * count;
    const uint64_t known = stream->size != DP_STREAM_UNKNOWN ? stream->size
                           : stream->at_end                  ? stream->loaded
                                                             : 0;
    if (known) return size == known && count;
    const size_t looked = here(stream) < 512 ? here(stream) : 512;
    return !is_text(stream->cursor, looked) && sane_records(stream, count);
}

bool dp_detect_binary_stl(dp_stream *stream) {
    dp_stream_have(stream, DP_STREAM_AHEAD);
    if (is_binary_stl(stream)) return true;
    const uint8_t *const start = stream->cursor;
    const size_t looked = here(stream) < 512 ? here(stream) : 512;
    dp_text_skip_mark(stream);
    const bool ascii = is_solid(stream) && is_text(start, looked);
    stream->cursor = start;
    return !ascii;
}

/* By the name's ending, in any case. */
static bool by_name(const char *name, dp_file_format *format) {
    static const struct {
        const char *ending;
        dp_file_format format;
    } endings[] = {{".stl", DP_FORMAT_STL}, {".ply", DP_FORMAT_PLY},  {".obj", DP_FORMAT_OBJ},
                   {".off", DP_FORMAT_OFF}, {".glb", DP_FORMAT_GLTF}, {".gltf", DP_FORMAT_GLTF}};
    const char *const dot = name ? strrchr(name, '.') : NULL;
    const size_t length = dot ? strlen(dot) : 0;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t same = 0;
        if (strlen(endings[i].ending) != length) continue;
        while (same < length && (dot[same] | 0x20) == (endings[i].ending[same] | 0x20)) same++;
        if (same < length) continue;
        *format = endings[i].format;
        return true;
    }
    return false;
}

/* Other well-known formats, by their marks; for the message. */
typedef struct foreign {
    const char *magic;
    size_t size; /* of the mark, with which the file begins; 0: a word somewhere in the window */
    const char *what;
    const char *ending; /* of a format that Assimp reads, by the name's ending; or NULL */
    const char *advice; /* where there is no such ending */
} foreign;

/* Is the stream JSON or XML with that word in its window? */
static bool has_word(const dp_stream *stream, const char *word) {
    const size_t size = strlen(word);
    const bool marked = begins(stream, "\xef\xbb\xbf", 3);
    const uint8_t *p = skip_spaces(stream->cursor + (marked ? 3 : 0));
    if (*p != '{' && *p != '<') return false;
    for (; (size_t)(stream->end - p) >= size; p++)
        if (*p == (uint8_t)*word && memcmp(p, word, size) == 0) return true;
    return false;
}

static const foreign *find_foreign(const dp_stream *stream) {
    static const foreign table[] = {
        {"\x1f\x8b", 2, "compressed with gzip", NULL, ": unpack it first"},
        {"BZh", 3, "compressed with bzip2", NULL, ": unpack it first"},
        {"\xfd"
         "7zXZ",
         5, "compressed with xz", NULL, ": unpack it first"},
        {"\x28\xb5\x2f\xfd", 4, "compressed with zstd", NULL, ": unpack it first"},
        {"PK\x03\x04", 4, "a zip archive (3MF, say)", ".3mf", NULL},
        {"Kaydara FBX", 11, "an FBX file", ".fbx", NULL},
        {"BLENDER", 7, "a Blender file", ".blend", NULL},
        {"; FBX", 5, "an FBX file", ".fbx", NULL},
        {"<COLLADA", 0, "a COLLADA file", ".dae", NULL},
        {"<X3D", 0, "an X3D file", ".x3d", NULL},
        {"<amf", 0, "an AMF file", ".amf", NULL},
        {"\x89PNG", 4, "a picture (PNG), not a model", NULL, ""},
        {"\xff\xd8\xff", 3, "a picture (JPEG), not a model", NULL, ""},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].size ? begins(stream, table[i].magic, table[i].size)
                          : has_word(stream, table[i].magic))
            return &table[i];
    return NULL;
}

static dp_result refuse_foreign(const dp_stream *stream, const foreign *f, dp_diag *diag) {
    if (!f->ending) return dp_fail(diag, DP_ERR_UNSUPPORTED, "this is %s%s", f->what, f->advice);
    if (stream->more_readers)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "this is %s: give its path, ending in %s", f->what,
                       f->ending);
    return dp_fail(diag, DP_ERR_UNSUPPORTED, "this is %s: convert it to STL, PLY, OBJ or OFF",
                   f->what);
}

/* The name of the encoding if the text is UTF-16: by its mark, or because every other byte of its
 * first line is 0. */
static const char *find_utf16(const dp_stream *stream) {
    const uint8_t *const p = stream->cursor;
    size_t zeros[2] = {0, 0}, pairs = here(stream) / 2;
    if (begins(stream, "\xff\xfe", 2) || begins(stream, "\xfe\xff", 2)) return "UTF-16";
    if (pairs > 32) pairs = 32;
    for (size_t i = 0; i < 2 * pairs; i++) {
        if (p[i] ? p[i] < '\t' || p[i] >= 0x7f : zeros[1 - i % 2] > 0) return NULL;
        zeros[i % 2] += p[i] == 0;
    }
    if (pairs < 4 || zeros[0] + zeros[1] != pairs) return NULL;
    return zeros[1] ? "UTF-16LE" : "UTF-16BE";
}

static bool is_gltf(const dp_stream *stream) {
    return begins(stream, "glTF", 4) ||
           (*skip_spaces(stream->cursor) == '{' && has_word(stream, "\"asset\""));
}

static dp_file_format text_format(const dp_stream *stream) {
    if (is_ply(stream)) return DP_FORMAT_PLY;
    if (is_gltf(stream)) return DP_FORMAT_GLTF;
    if (is_off(stream)) return DP_FORMAT_OFF;
    if (is_solid(stream)) return DP_FORMAT_STL;
    return is_obj(stream) ? DP_FORMAT_OBJ : DP_FORMAT_AUTO;
}

static bool by_content(dp_stream *stream, dp_file_format *format) {
    const uint8_t *const start = stream->cursor;
    if (!is_ply(stream) && !begins(stream, "glTF", 4) && is_binary_stl(stream)) {
        *format = DP_FORMAT_STL;
        return true;
    }
    dp_text_skip_mark(stream);
    *format = text_format(stream);
    stream->cursor = start;
    return *format != DP_FORMAT_AUTO;
}

bool dp_has_own_ending(const char *name) {
    dp_file_format format;
    return by_name(name, &format) && format != DP_FORMAT_GLTF; /* Assimp reads what we do not */
}

dp_result dp_detect(dp_stream *stream, const char *name, dp_file_format *format, dp_diag *diag) {
    const char *const encoding = is_binary_stl(stream) ? NULL : find_utf16(stream);
    if (encoding) /* nothing for Assimp either: it fails, or finds wrong numbers */
        return dp_fail(diag, DP_ERR_FORMAT,
                       "this is UTF-16 text: convert it to UTF-8, e.g. iconv -f %s -t UTF-8",
                       encoding);
    if (by_content(stream, format)) return DP_OK;
    const foreign *const other = find_foreign(stream);
    if (other) return refuse_foreign(stream, other, diag);
    if (by_name(name, format)) return DP_OK;
    return dp_fail(diag, DP_ERR_UNSUPPORTED,
                   "not in a known format: convert it to STL, PLY, OBJ or OFF, or, if it is a "
                   "model, give a file whose name has its format's ending (.stl, .obj, .gltf, %s…)",
                   stream->more_readers ? ".dae, " : "");
}
