/* drypoint/io.h: files, in the component libdrypoint_io (needs libpng, zlib and Assimp).
 *
 * The core library reads STL, PLY, OBJ, OFF and glTF 2.0 itself (drypoint/source.h). This component reads
 * every format that Assimp knows, and writes pictures as PNG, pages of lines (SVG, PDF, …), and
 * models as PLY, STL and OBJ. */
#ifndef DRYPOINT_IO_H
#define DRYPOINT_IO_H

#include <drypoint/drawing.h>
#include <drypoint/sink.h>
#include <drypoint/source.h>
#include <drypoint/strokes.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As dp_source_open, and everything else (FBX, 3MF, COLLADA, …) through Assimp, some of whose
 * readers crash or hang on broken files: an application that is given files by strangers does well
 * to read them in a process of its own, as the program does (tools/apart.c). */
DP_API dp_result dp_io_open(const char *path, const dp_file_options *options, dp_source **out,
                            dp_diag *diag);

/* As dp_source_open_memory, and everything else through Assimp. open_beside finds a scene's other
 * files (a glTF's buffers) and is also asked for files that need not exist (textures, say). Where
 * the content does not tell the format, as in most text formats, file->name must have the format's
 * ending. */
DP_API dp_result dp_io_open_memory(const dp_memory_file *file, const dp_file_options *options,
                                   dp_source **out, dp_diag *diag);

/* Writes [height][width][4] RGBA, not premultiplied, rows `stride` bytes apart (0: 4 * width), as a
 * PNG. A regular file is written under another name and renamed when complete; until then the old
 * one stays. A device or pipe is written in place; "-" is standard output. DP_ERR_IO (also for a
 * full disk), DP_ERR_MEMORY, DP_ERR_LIMIT, DP_ERR_ARGUMENT (also for a stride shorter than a
 * row). */
DP_API dp_result dp_io_write_png(const char *path, const uint8_t *rgba, uint32_t width,
                                 uint32_t height, size_t stride, dp_diag *diag);

/* The same with progress, and a resolution. DP_ERR_CANCELLED (by progress), DP_ERR_ARGUMENT also for a
 * dpi above 1,000,000. */
typedef struct dp_io_picture {
    const uint8_t *rgba;    /* [height][width][4], not premultiplied */
    uint32_t width, height; /* px */
    size_t stride;          /* bytes from row to row; 0 means 4 * width */
    uint32_t dpi;           /* px per inch, for who prints it; 0: the file does not say */
    /* Called now and then, fraction in [0, 1]; a non-zero return stops with DP_ERR_CANCELLED, and
     * the old file stays. NULL allowed. */
    int (*progress)(void *user, double fraction);
    void *user;
} dp_io_picture;

DP_API dp_result dp_io_write_picture(const char *path, const dp_io_picture *picture, dp_diag *diag);

/* Writes the lines of the last dp_draw as text (dp_trace), with the same care; "-" is standard
 * output. DP_ERR_IO, DP_ERR_MEMORY, DP_ERR_ARGUMENT (nothing has been drawn). */
DP_API dp_result dp_io_write_trace(const char *path, dp_context *context, dp_diag *diag);

/* Writes a page of drawings with the same care: PDF is compressed, and the grounds of an SVG's
 * views become PNGs in it. "-" is standard output. DP_ERR_IO, DP_ERR_LIMIT (a ground too large for
 * a PNG), and as dp_page_write. */
DP_API dp_result dp_io_write_page(const char *path, const dp_page *page, dp_format format,
                                  dp_diag *diag);

/* Makes a stroke texture of a PNG of any kind, at most 8192 px wide and high, as
 * dp_texture_create does. The caller destroys *out. DP_ERR_IO, DP_ERR_FORMAT,
 * DP_ERR_LIMIT, DP_ERR_MEMORY. */
DP_API dp_result dp_io_read_texture(const char *path, const dp_allocator *allocator,
                                    dp_texture **out, dp_diag *diag);

/* A picture that was read; dp_io_free_pixels frees it. */
typedef struct dp_io_pixels {
    uint8_t *rgba; /* [height][width][4], not premultiplied */
    uint32_t width, height;
} dp_io_pixels;

/* Reads a PNG of any kind (for textures). DP_ERR_IO, DP_ERR_FORMAT, DP_ERR_LIMIT, DP_ERR_MEMORY. */
DP_API dp_result dp_io_read_png(const char *path, dp_io_pixels *pixels, dp_diag *diag);
DP_API void dp_io_free_pixels(dp_io_pixels *pixels); /* NULL allowed */

typedef enum dp_mesh_file {
    DP_MESH_FILE_AUTO = 0, /* by the name's ending */
    DP_MESH_FILE_PLY,      /* binary little endian */
    DP_MESH_FILE_PLY_ASCII,
    DP_MESH_FILE_STL, /* binary */
    DP_MESH_FILE_OBJ
} dp_mesh_file;

/* Writes a source as a model file, batch by batch, and renames it when complete (as pictures).
 * Numbers have a decimal point in every locale. Positions about an origin (dp_batch) are written in
 * world space: PLY then has doubles and OBJ the digits, but an STL's float32 are coarse there. PLY and OBJ share a vertex only where the source's
 * indices do. PLY needs a rewindable source. `progress`: as in dp_io_picture. DP_ERR_IO,
 * DP_ERR_MEMORY, DP_ERR_ARGUMENT, and the source's own errors. */
DP_API dp_result dp_io_write_mesh(const char *path, dp_mesh_file kind, dp_source *source,
                                  int (*progress)(void *user, double fraction), void *user,
                                  dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
