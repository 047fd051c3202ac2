/* The bytes of a glTF file: a .glb file's chunk, data: URIs, and files beside it, each read when
 * it is first asked for. Invariant: no view reaches beyond its buffer, nor beyond what the
 * buffer says it has. */
#include "io/gltf.h"

#include "io/beside.h"

#include <string.h>

bool dp_gltf_read_all(dp_gltf *g, dp_stream *stream, dp_gltf_bytes *to) {
    uint8_t *data = NULL;
    size_t size = 0, cap = 0;
    const size_t known =
        stream->size == DP_STREAM_UNKNOWN ? 0 : dp_stream_hint(stream, stream->size, 1);
    bool enough = dp_reserve(&g->arena.memory, &data, &cap, known + 1, 1);
    while (enough && dp_stream_have(stream, 1)) {
        const size_t count = (size_t)(stream->end - stream->cursor);
        enough = dp_reserve(&g->arena.memory, &data, &cap, size + count, 1);
        if (enough) memcpy(data + size, stream->cursor, count);
        size += count;
        stream->cursor = stream->end;
    }
    to->data = to->owned = data;
    to->size = size;
    g->bytes += size;
    if (enough && !stream->result) return true;
    if (!stream->result) return dp_gltf_out_of_memory(g);
    g->result = dp_stream_fail(stream, g->diag);
    return false;
}

/* ------- data: URIs ------- */

static int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62; /* - and _: as in URLs */
    return c == '/' || c == '_' ? 63 : -1;
}

static bool decode(dp_gltf *g, const char *text, size_t size, dp_gltf_bytes *to) {
    uint8_t *const data = dp_arena_take(&g->arena, size / 4 * 3 + 3, 1);
    uint32_t bits = 0;
    size_t count = 0, letters = 0;
    if (!data) return dp_gltf_out_of_memory(g);
    while (size && text[size - 1] == '=') size--;
    for (size_t i = 0; i < size; i++) {
        const int value = base64_value(text[i]);
        if (value < 0)
            return dp_gltf_fail(g, DP_ERR_FORMAT, "its data: URI is not base64 at letter %zu", i);
        bits = bits << 6 | (uint32_t)value;
        if (++letters % 4 != 1)
            data[count++] = (uint8_t)(bits >> (8 - 2 * ((letters - 1) % 4 + 1)));
    }
    to->data = data, to->size = count;
    return true;
}

static bool read_data_uri(dp_gltf *g, const char *uri, size_t size, dp_gltf_bytes *to) {
    static const char mark[] = ";base64,";
    const char *const comma = memchr(uri, ',', size);
    const size_t head = comma ? (size_t)(comma + 1 - uri) : 0, length = sizeof mark - 1;
    if (head < length || memcmp(comma + 1 - length, mark, length) != 0)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "its data: URI must be in base64");
    return decode(g, comma + 1, size - head, to);
}

/* ------- files ------- */

static int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = (char)(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/* %20 and the like become bytes; a name with a 0 in it ends there. */
static size_t unescape(const char *uri, size_t size, char *to) {
    size_t count = 0;
    for (size_t i = 0; i < size; i++) {
        const bool escape = uri[i] == '%' && i + 2 < size && hex_value(uri[i + 1]) >= 0 &&
                            hex_value(uri[i + 2]) >= 0;
        to[count] = uri[i];
        if (escape) to[count] = (char)(hex_value(uri[i + 1]) << 4 | hex_value(uri[i + 2])), i += 2;
        if (!to[count]) break;
        count++;
    }
    to[count] = 0;
    return count;
}

static bool read_file(dp_gltf *g, const char *uri, size_t size, dp_gltf_bytes *to) {
    dp_diag why = {0};
    dp_stream *stream = NULL;
    char *const name = dp_arena_take(&g->arena, size + 1, 1);
    if (!name) return dp_gltf_out_of_memory(g);
    const size_t length = unescape(uri, size, name);
    if (!length) return dp_gltf_fail(g, DP_ERR_FORMAT, "\"uri\" is empty");
    const dp_result result = dp_open_beside(g->stream, name, length, &stream, &why);
    if (result == DP_ERR_UNSUPPORTED)
        return dp_gltf_fail(g, DP_ERR_IO,
                            "its bytes are in the file %.80s, which was not given with the model: "
                            "give the model's path, or a .glb file",
                            name);
    if (result == DP_ERR_MEMORY) return dp_gltf_out_of_memory(g);
    if (result)
        return dp_gltf_fail(g, DP_ERR_IO, "%.80s: %.80s; copy it beside the model", name,
                            why.message);
    const bool done = dp_gltf_read_all(g, stream, to);
    dp_stream_close(stream);
    return done;
}

/* ------- buffers and views ------- */

/* Does it only say how large what is compressed would be? */
static bool is_filler(const dp_json *buffer) {
    const dp_json *const extensions = dp_json_find(buffer, "extensions");
    return dp_json_find(extensions, "EXT_meshopt_compression") ||
           dp_json_find(extensions, "KHR_meshopt_compression");
}

static bool read_buffer(dp_gltf *g, uint32_t number, dp_gltf_bytes *to) {
    const dp_json *const buffer = dp_json_item(g->buffers, number), *uri;
    if (!dp_gltf_member(g, buffer, "uri", DP_JSON_STRING, &uri)) return false;
    if (!uri && number == 0 && g->chunk.data) {
        *to = g->chunk;
        return true;
    }
    if (!uri && is_filler(buffer))
        return dp_gltf_fail(g, DP_ERR_UNSUPPORTED,
                            "it is compressed with meshopt: export the model without compression");
    if (!uri)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "it has no \"uri\": the bytes that it stands for are not there");
    const char *const text = uri->as.string.text;
    const size_t size = uri->as.string.size;
    if (size >= 5 && memcmp(text, "data:", 5) == 0) return read_data_uri(g, text, size, to);
    return read_file(g, text, size, to);
}

/* The buffer's bytes: no more than it says it has. */
static const dp_gltf_bytes *open_buffer(dp_gltf *g, uint32_t number) {
    dp_gltf_bytes *const b = &g->buffer[number];
    uint32_t length;
    char where[sizeof g->where];
    if (b->data) return b;
    memcpy(where, g->where, sizeof where);
    dp_gltf_at(g, "buffer %u: ", number);
    if (!read_buffer(g, number, b) ||
        !dp_gltf_uint(g, dp_json_item(g->buffers, number), "byteLength", UINT32_MAX - 1, &length))
        return NULL;
    if (length < b->size) b->size = length;
    memcpy(g->where, where, sizeof where);
    return b;
}

bool dp_gltf_read_buffers(dp_gltf *g) {
    for (uint32_t i = 0; i < g->buffer_count; i++)
        if (!open_buffer(g, i)) return false;
    return true;
}

bool dp_gltf_view(dp_gltf *g, uint32_t number, uint64_t offset, uint64_t size, const uint8_t **to) {
    const dp_json *const view = dp_json_item(g->views, number);
    uint32_t buffer, start, length;
    if (!dp_gltf_index(g, view, "buffer", g->buffers, "buffer", &buffer) ||
        !dp_gltf_uint(g, view, "byteOffset", 0, &start) ||
        !dp_gltf_uint(g, view, "byteLength", 0, &length))
        return false;
    if (!buffer) return dp_gltf_fail(g, DP_ERR_FORMAT, "bufferView %u names no buffer", number);
    const dp_gltf_bytes *const bytes = open_buffer(g, buffer - 1);
    if (!bytes) return false;
    if (offset + size > length)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "it needs bytes up to %llu of bufferView %u, which has %u: the file is "
                            "damaged, export it again",
                            (unsigned long long)(offset + size), number, length);
    if ((uint64_t)start + length > bytes->size)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "bufferView %u ends at byte %llu of buffer %u, which has %zu: the file "
                            "is cut off, or damaged",
                            number, (unsigned long long)start + length, buffer - 1, bytes->size);
    *to = bytes->data + start + offset;
    return true;
}

bool dp_gltf_stride(dp_gltf *g, uint32_t view, uint32_t *to) {
    return dp_gltf_uint(g, dp_json_item(g->views, view), "byteStride", 0, to);
}
