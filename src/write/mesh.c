/* Writes a polygon source as PLY, STL or OBJ, batch by batch.
 *
 *     format       must know beforehand                           readings of the source
 *     OBJ          nothing                                        1
 *     STL, binary  number of triangles                            2
 *     PLY          numbers of vertices and polygons, and writes   3
 *                    all vertices before all polygons
 *
 * An STL of a source that can be read only once gets its count at the end, if the file is seekable.
 *
 * Invariant: every format holds the same polygons: those with at least three corners whose vertices
 * exist and are finite. A vertex that is not finite is written as 0 0 0, so that numbers stay
 * right. Text has nine digits, which give back the same float. Positions about an origin are written
 * in world space: as doubles to PLY, with sixteen digits to text, and as float32, which loses what
 * that cannot hold, to STL.
 *
 * Not handled: normals, colours, groups, edge flags; welding beyond the source's indices. STL:
 * larger polygons become fans of triangles, which is right for convex ones. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "base/print.h"
#include "write/file.h"

#include <math.h>
#include <string.h>
#include <strings.h>

typedef struct writer {
    dp_mesh_file kind;
    dp_source *source;
    dp_output output;
    dp_diag *diag;
    int (*progress)(void *user, double fraction);
    void *user;
    uint64_t vertices, polygons, triangles; /* of the whole source, once counted */
    uint32_t most_corners;                  /* of one polygon */
    bool wide;                              /* PLY: some positions are about an origin */
    uint64_t done;                          /* polygons handled so far, over all readings */
    int readings;                           /* number that write, for progress; 0 while counting */
} writer;

/* What a reading does with a batch; `base` is the number of its first vertex. */
typedef dp_result batch_function(writer *w, const dp_batch *batch, uint64_t base);

/* ---- batches ---- */

static const float *position(const dp_batch *batch, size_t v) {
    return (const float *)(const void *)((const char *)batch->positions +
                                         v * batch->position_stride);
}

static uint32_t index_of(const dp_batch *batch, size_t corner) {
    return batch->indices ? batch->indices[corner] : (uint32_t)corner;
}

static size_t first_of(const dp_batch *batch, size_t polygon) {
    return batch->firsts ? batch->firsts[polygon] : 3 * polygon;
}

static bool finite(const float p[3]) { return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]); }

static bool usable(const dp_batch *batch, size_t first, size_t last) {
    if (last - first < 3) return false;
    for (size_t c = first; c < last; c++) {
        const uint32_t v = index_of(batch, c);
        if (v >= batch->vertex_count || !finite(position(batch, v))) return false;
    }
    return true;
}

static bool has_origin(const dp_batch *batch) {
    return batch->origin[0] != 0 || batch->origin[1] != 0 || batch->origin[2] != 0;
}

/* A vertex in world space. */
static void place(const dp_batch *batch, size_t v, double world[3]) {
    const float *const p = position(batch, v);
    for (int k = 0; k < 3; k++) world[k] = batch->origin[k] + (double)p[k];
}

/* The same; 0 0 0 where it is not finite. */
static void place_shown(const dp_batch *batch, size_t v, double world[3]) {
    if (finite(position(batch, v)))
        place(batch, v, world);
    else
        memset(world, 0, 3 * sizeof *world);
}

static dp_result put(writer *w, const void *bytes, size_t size) {
    return dp_output_write(&w->output, bytes, size, w->diag);
}

static dp_result put_text(writer *w, const char *text, int length) {
    return put(w, text, (size_t)length);
}

/* Calls `each` on every batch, from the source's start. */
static dp_result read_source(writer *w, batch_function *each) {
    uint64_t base = 0;
    dp_result result =
        dp_source_rewindable(w->source) ? dp_source_rewind(w->source, w->diag) : DP_OK;
    while (!result) {
        dp_batch batch;
        result = dp_source_next(w->source, &batch, w->diag);
        if (result || !batch.polygon_count) break;
        result = each(w, &batch, base);
        base += batch.vertex_count;
        w->done += batch.polygon_count;
        const double all = (double)w->readings * (double)w->polygons;
        if (!result && w->progress && w->progress(w->user, all > 0 ? (double)w->done / all : -1))
            result = dp_fail(w->diag, DP_ERR_CANCELLED, "writing was stopped");
    }
    return result;
}

static dp_result count_batch(writer *w, const dp_batch *batch, uint64_t base) {
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const size_t first = first_of(batch, i), last = first_of(batch, i + 1);
        if (!usable(batch, first, last)) continue;
        w->polygons++;
        w->triangles += last - first - 2;
        if (last - first > w->most_corners) w->most_corners = (uint32_t)(last - first);
    }
    w->vertices = base + batch->vertex_count;
    w->wide |= has_origin(batch);
    return DP_OK;
}

/* Counts the source; `readings` that write will follow. */
static dp_result count(writer *w, int readings) {
    const dp_result result = read_source(w, count_batch);
    w->done = 0;
    w->readings = readings;
    return result;
}

/* ---- PLY ---- */

enum { MOST_IN_BYTE = 255 };

/* Little endian on every machine. */
static void put_u32(uint8_t *to, uint32_t value) {
    for (int k = 0; k < 4; k++) to[k] = (uint8_t)(value >> 8 * k);
}

static void put_f64(uint8_t *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int k = 0; k < 8; k++) to[k] = (uint8_t)(bits >> 8 * k);
}

static void put_f32(uint8_t *to, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_u32(to, bits);
}

static dp_result ply_header(writer *w) {
    char text[400];
    const char *const type = w->wide ? "double" : "float";
    const int n =
        snprintf(text, sizeof text,
                 "ply\nformat %s 1.0\ncomment written by Drypoint %s\n"
                 "element vertex %llu\nproperty %s x\nproperty %s y\n"
                 "property %s z\nelement face %llu\n"
                 "property list %s %s vertex_indices\nend_header\n",
                 w->kind == DP_MESH_FILE_PLY ? "binary_little_endian" : "ascii", dp_version(),
                 (unsigned long long)w->vertices, type, type, type, (unsigned long long)w->polygons,
                 w->most_corners > MOST_IN_BYTE ? "uint" : "uchar",
                 w->vertices > INT32_MAX ? "uint" : "int");
    return put_text(w, text, n);
}

static dp_result text_vertex(writer *w, const char *prefix, const dp_batch *batch, size_t v) {
    char text[16 + 3 * DP_NUMBER_TEXT], number[3][DP_NUMBER_TEXT];
    double p[3];
    place_shown(batch, v, p);
    for (int k = 0; k < 3; k++) dp_print_number(number[k], p[k], batch->origin[k] != 0 ? 16 : 9);
    return put_text(
        w, text,
        snprintf(text, sizeof text, "%s%s %s %s\n", prefix, number[0], number[1], number[2]));
}

static dp_result ply_vertices(writer *w, const dp_batch *batch, uint64_t base) {
    dp_result result = DP_OK;
    (void)base;
    for (size_t v = 0; v < batch->vertex_count && !result; v++) {
        double p[3];
        uint8_t bytes[24];
        const size_t size = w->wide ? 8 : 4;
        place_shown(batch, v, p);
        for (size_t k = 0; k < 3; k++)
            if (w->wide)
                put_f64(bytes + size * k, p[k]);
            else
                put_f32(bytes + size * k, (float)p[k]);
        result =
            w->kind == DP_MESH_FILE_PLY ? put(w, bytes, 3 * size) : text_vertex(w, "", batch, v);
    }
    return result;
}

static dp_result ply_polygon(writer *w, const dp_batch *batch, uint64_t base, size_t first,
                             size_t last) {
    uint8_t bytes[4];
    put_u32(bytes, (uint32_t)(last - first));
    dp_result result = put(w, bytes, w->most_corners > MOST_IN_BYTE ? 4 : 1);
    for (size_t c = first; c < last && !result; c++) {
        put_u32(bytes, (uint32_t)(base + index_of(batch, c)));
        result = put(w, bytes, sizeof bytes);
    }
    return result;
}

/* Writes "prefix v v v\n", vertices counted from `origin`; an empty prefix is the number of
 * corners. */
static dp_result text_polygon(writer *w, const dp_batch *batch, uint64_t origin, size_t first,
                              size_t last, const char *prefix) {
    char text[32];
    if (!prefix) snprintf(text, sizeof text, "%zu", last - first);
    dp_result result = prefix ? put(w, prefix, strlen(prefix)) : put(w, text, strlen(text));
    for (size_t c = first; c < last && !result; c++)
        result = put_text(w, text,
                          snprintf(text, sizeof text, " %llu",
                                   (unsigned long long)(origin + index_of(batch, c))));
    return result ? result : put(w, "\n", 1);
}

static dp_result ply_polygons(writer *w, const dp_batch *batch, uint64_t base) {
    dp_result result = DP_OK;
    for (size_t i = 0; i < batch->polygon_count && !result; i++) {
        const size_t first = first_of(batch, i), last = first_of(batch, i + 1);
        if (!usable(batch, first, last)) continue;
        result = w->kind == DP_MESH_FILE_PLY ? ply_polygon(w, batch, base, first, last)
                                             : text_polygon(w, batch, base, first, last, NULL);
    }
    return result;
}

static dp_result write_ply(writer *w) {
    if (!dp_source_rewindable(w->source))
        return dp_fail(w->diag, DP_ERR_UNSUPPORTED,
                       "a PLY needs its counts first, and this source can be read only once; "
                       "write an OBJ");
    dp_result result = count(w, 2);
    if (!result && w->vertices > UINT32_MAX)
        result = dp_fail(w->diag, DP_ERR_LIMIT,
                         "a PLY numbers at most %u vertices, not %llu; write an STL", UINT32_MAX,
                         (unsigned long long)w->vertices);
    if (!result) result = ply_header(w);
    if (!result) result = read_source(w, ply_vertices);
    return result ? result : read_source(w, ply_polygons);
}

/* ---- STL ---- */

/* The unit normal; 0 without area. */
static void normal_of(const float a[3], const float b[3], const float c[3], float normal[3]) {
    double u[3], v[3], n[3];
    for (int k = 0; k < 3; k++) u[k] = (double)b[k] - a[k], v[k] = (double)c[k] - a[k];
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) normal[k] = length > 0 ? (float)(n[k] / length) : 0;
}

static dp_result stl_triangle(writer *w, const dp_batch *batch, const uint32_t corner[3]) {
    uint8_t bytes[50] = {0};
    float normal[3];
    normal_of(position(batch, corner[0]), position(batch, corner[1]), position(batch, corner[2]),
              normal);
    for (int k = 0; k < 3; k++) put_f32(bytes + 4 * k, normal[k]);
    for (int c = 0; c < 3; c++) {
        double p[3];
        place(batch, corner[c], p);
        for (int k = 0; k < 3; k++) put_f32(bytes + 12 + 12 * c + 4 * k, (float)p[k]);
    }
    return put(w, bytes, sizeof bytes);
}

static dp_result stl_triangles(writer *w, const dp_batch *batch, uint64_t base) {
    dp_result result = DP_OK;
    (void)base;
    for (size_t i = 0; i < batch->polygon_count && !result; i++) {
        const size_t first = first_of(batch, i), last = first_of(batch, i + 1);
        if (!usable(batch, first, last)) continue;
        for (size_t c = first + 1; c + 1 < last && !result; c++)
            result = stl_triangle(w, batch,
                                  (const uint32_t[3]){index_of(batch, first), index_of(batch, c),
                                                      index_of(batch, c + 1)});
    }
    return result;
}

static dp_result stl_header(writer *w, uint64_t triangles) {
    uint8_t header[84] = {0};
    if (triangles > UINT32_MAX)
        return dp_fail(w->diag, DP_ERR_LIMIT, "an STL counts at most %u triangles, not %llu",
                       UINT32_MAX, (unsigned long long)triangles);
    snprintf((char *)header, 80, "binary STL written by Drypoint %s", dp_version());
    put_u32(header + 80, (uint32_t)triangles);
    return put(w, header, sizeof header);
}

static dp_result count_and_write(writer *w, const dp_batch *batch, uint64_t base) {
    const dp_result result = count_batch(w, batch, base);
    return result ? result : stl_triangles(w, batch, base);
}

/* With one reading: the count is written into the header afterwards. */
static dp_result write_stl_once(writer *w) {
    if (fseek(w->output.file, 0, SEEK_SET))
        return dp_fail(w->diag, DP_ERR_UNSUPPORTED,
                       "an STL needs its count first, and this source can be read only once; "
                       "write to a file, or an OBJ");
    dp_result result = stl_header(w, 0);
    if (!result) result = read_source(w, count_and_write);
    if (!result && fseek(w->output.file, 0, SEEK_SET))
        result = dp_fail(w->diag, DP_ERR_IO, "the STL's header cannot be filled in");
    return result ? result : stl_header(w, w->triangles);
}

static dp_result write_stl(writer *w) {
    if (!dp_source_rewindable(w->source)) return write_stl_once(w);
    dp_result result = count(w, 1);
    if (!result) result = stl_header(w, w->triangles);
    return result ? result : read_source(w, stl_triangles);
}

/* ---- OBJ ---- */

static dp_result obj_batch(writer *w, const dp_batch *batch, uint64_t base) {
    dp_result result = DP_OK;
    for (size_t v = 0; v < batch->vertex_count && !result; v++)
        result = text_vertex(w, "v ", batch, v);
    for (size_t i = 0; i < batch->polygon_count && !result; i++) {
        const size_t first = first_of(batch, i), last = first_of(batch, i + 1);
        if (usable(batch, first, last)) result = text_polygon(w, batch, base + 1, first, last, "f");
    }
    return result;
}

static dp_result write_obj(writer *w) {
    char text[80];
    dp_result result = DP_OK;
    if (w->progress && dp_source_rewindable(w->source)) result = count(w, 1); /* for the progress */
    if (!result)
        result = put_text(w, text,
                          snprintf(text, sizeof text, "# written by Drypoint %s\n", dp_version()));
    return result ? result : read_source(w, obj_batch);
}

/* ---- any ---- */

static dp_mesh_file kind_by_name(const char *path) {
    const size_t n = strlen(path);
    if (n >= 4 && !strcasecmp(path + n - 4, ".stl")) return DP_MESH_FILE_STL;
    if (n >= 4 && !strcasecmp(path + n - 4, ".obj")) return DP_MESH_FILE_OBJ;
    if (n >= 4 && !strcasecmp(path + n - 4, ".ply")) return DP_MESH_FILE_PLY;
    return DP_MESH_FILE_AUTO;
}

static dp_result write_all(writer *w) {
    switch (w->kind) {
    case DP_MESH_FILE_PLY:
    case DP_MESH_FILE_PLY_ASCII:
        return write_ply(w);
    case DP_MESH_FILE_STL:
        return write_stl(w);
    case DP_MESH_FILE_OBJ:
        return write_obj(w);
    case DP_MESH_FILE_AUTO:
        break;
    }
    return dp_fail(w->diag, DP_ERR_ARGUMENT, "dp_io_write_mesh: unknown kind of file");
}

dp_result dp_io_write_mesh(const char *path, dp_mesh_file kind, dp_source *source,
                           int (*progress)(void *user, double fraction), void *user,
                           dp_diag *diag) {
    dp_diag unused;
    if (!path || !source)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_write_mesh: path or source is NULL");
    writer w = {.kind = kind ? kind : kind_by_name(path),
                .source = source,
                .diag = diag ? diag : &unused,
                .progress = progress,
                .user = user};
    if (w.kind == DP_MESH_FILE_AUTO)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%.120s: models are written as .ply, .stl or .obj",
                       path);
    dp_result result = dp_output_open(&w.output, path, w.diag);
    if (result) return result;
    result = write_all(&w);
    if (!result) return dp_output_commit(&w.output, w.diag);
    dp_output_abandon(&w.output);
    return result;
}
