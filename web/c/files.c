/* Files of a page that has no file system: models are read from the files that were dropped on it, and what the program
 * writes goes to the worker, piece by piece.
 *
 * The program's own code asks for files by stat(), access(), glob() and open_file(), and writes by the functions of
 * drypoint/io.h: those stand here, and know nothing but the dropped files.
 *
 * Invariant: each file's bytes lie once in memory, as the worker has put them there, and stay while a model may read
 * them. While a model is opened there are the files of the last one, too; new ones are found first.
 *
 * Streams of a PDF are compressed, and grounds of an SVG encoded, by the browser, which needs time of its own: what is
 * written the first time names the bytes, and is written again when their results are there (worker.js).
 *
 * Not handled: formats that Assimp reads; PNG files as textures. */
#define _GNU_SOURCE /* strcasecmp */
#include "page.h"

#include "models.h"
#include "output.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

#include <errno.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------- what was dropped ------- */

typedef struct dropped {
    char *name;
    uint8_t *bytes; /* [size] */
    size_t size;
    bool is_new;
} dropped;

static dropped *files; /* [file_count] */
static uint32_t file_count;

/* Takes a block of malloc's, and copies the name. Not 0: memory is out, and the block stays the caller's. */
EMSCRIPTEN_KEEPALIVE int web_file(const char *name, uint8_t *bytes, size_t size) {
    dropped *const longer = realloc(files, (file_count + (size_t)1) * sizeof *longer);
    if (longer) files = longer;
    char *const copy = longer ? strdup(name) : NULL;
    if (!copy) return EXIT_FAILED;
    files[file_count++] = (dropped){.name = copy, .bytes = bytes, .size = size, .is_new = true};
    return 0;
}

static void leave_out(bool which) {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < file_count; k++) {
        if (files[k].is_new == which)
            free(files[k].name), free(files[k].bytes);
        else
            files[kept++] = files[k];
    }
    file_count = kept;
}

void files_keep_new(void) {
    leave_out(false);
    for (uint32_t k = 0; k < file_count; k++) files[k].is_new = false;
}

void files_drop_new(void) { leave_out(true); }

typedef int compare(const char *a, const char *b);

static const dropped *find(const char *name, compare *differ) {
    for (uint32_t k = file_count; k-- > 0;)
        if (!differ(files[k].name, name)) return &files[k];
    return NULL;
}

/* The file that another one names: folders are lost when files are dropped, and the case of letters may be wrong. */
static const dropped *find_named(const char *path) {
    const char *const name = output_name(path);
    const dropped *found = find(path, strcmp);
    if (!found) found = find(name, strcmp);
    return found ? found : find(name, strcasecmp);
}

static bool open_beside(void *user, const char *name, const void **data, size_t *size) {
    const dropped *const found = find_named(name);
    (void)user;
    if (!found) return false;
    *data = found->bytes, *size = found->size;
    return true;
}

dp_result open_file(const tool_settings *s, const char *model, dp_source **out, dp_diag *diag) {
    const dropped *const found = find(model, strcmp);
    const dp_file_options options = {.progress = progress_report};
    (void)s;
    *diag = (dp_diag){.result = DP_ERR_IO,
                      .message = "there is no such file on this page; drop it here"};
    if (!found) return diag->result;
    const dp_memory_file file = {
        .data = found->bytes, .size = found->size, .name = found->name, .open_beside = open_beside};
    return dp_source_open_memory(&file, &options, out, diag);
}

/* ------- what the C library says of files ------- */

int stat(const char *restrict path, struct stat *restrict status) {
    memset(status, 0, sizeof *status);
    status->st_mode = strcmp(path, ".") ? S_IFREG : S_IFDIR; /* one folder, in which all lie */
    if (S_ISDIR(status->st_mode) || find(path, strcmp)) return 0;
    errno = ENOENT;
    return -1;
}

/* Any name can be written. */
int access(const char *path, int how) {
    struct stat status;
    return how == F_OK ? stat(path, &status) : 0;
}

int glob(const char *restrict pattern, int flags, int (*fail)(const char *, int),
         glob_t *restrict found) {
    (void)pattern, (void)flags, (void)fail, (void)found;
    return GLOB_NOMATCH;
}

void globfree(glob_t *found) { (void)found; }

/* ------- writing ------- */

/* clang-format off */
EM_JS(void, tell_bytes, (const void *bytes, size_t size), {
    Module.tellBytes(bytes >>> 0, size >>> 0);
});
EM_JS(void, tell_picture, (const void *rgba, uint32_t width, uint32_t height, uint32_t dpi), {
    Module.tellPicture(rgba >>> 0, width, height, dpi);
});
/* What has become of the bytes when they were named before, malloc's; NULL: they are named now. */
EM_JS(uint8_t *, tell_deflated, (const void *bytes, size_t size, size_t *result), {
    return Module.tellDeflated(bytes >>> 0, size >>> 0, result >>> 0);
});
EM_JS(uint8_t *, tell_encoded, (const void *rgba, uint32_t width, uint32_t height, size_t *result), {
    return Module.tellEncoded(rgba >>> 0, width, height, result >>> 0);
});
/* clang-format on */

static dp_result write_bytes(void *user, const char *bytes, size_t size, dp_diag *diag) {
    (void)user, (void)diag;
    tell_bytes(bytes, size);
    return DP_OK;
}

static dp_result compress_bytes(const void *bytes, size_t size, dp_text_writer *write, void *user,
                                dp_diag *diag) {
    size_t count = 0;
    uint8_t *const deflated = tell_deflated(bytes, size, &count);
    const dp_result result = deflated ? write(user, (const char *)deflated, count, diag) : DP_OK;
    free(deflated);
    return result;
}

static void encode_ground(dp_view_on_page *view) {
    dp_drawing_info info;
    if (!view->ground || view->ground_png || !view->drawing) return;
    dp_drawing_info_of(view->drawing, &info);
    uint8_t *const png =
        tell_encoded(view->ground, info.width, info.height, &view->ground_png_size);
    if (png) view->ground_png = png;
    if (!png) view->ground = NULL;
}

dp_result dp_io_write_page(const char *path, const dp_page *page, dp_format format, dp_diag *diag) {
    dp_view_on_page views[SHEET_MOST];
    dp_page full = *page;
    (void)path;
    full.compress = compress_bytes;
    full.views = views;
    for (size_t k = 0; k < page->view_count; k++) {
        views[k] = page->views[k];
        if (format == DP_FORMAT_SVG) encode_ground(&views[k]);
    }
    const dp_result result = dp_page_write(&full, format, write_bytes, NULL, diag);
    for (size_t k = 0; k < page->view_count; k++)
        if (views[k].ground_png != page->views[k].ground_png)
            free((void *)(uintptr_t)views[k].ground_png);
    return result;
}

dp_result dp_io_write_picture(const char *path, const dp_io_picture *picture, dp_diag *diag) {
    (void)path, (void)diag;
    tell_picture(picture->rgba, picture->width, picture->height, picture->dpi);
    return DP_OK;
}

/* ------- what a page has not ------- */

static dp_result refuse(dp_diag *diag, const char *what) {
    *diag = (dp_diag){.result = DP_ERR_UNSUPPORTED};
    snprintf(diag->message, sizeof diag->message, "a page in a browser %s", what);
    return diag->result;
}

static const char no_planes[] = "saves drawings only: the program, drypoint, writes this";
static const char no_textures[] =
    "reads no PNG files as textures; give the name of one, or use the program, drypoint";

dp_result dp_io_write_png(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height,
                          size_t stride, dp_diag *diag) {
    (void)path, (void)rgba, (void)width, (void)height, (void)stride;
    return refuse(diag, no_planes);
}

dp_result dp_io_write_trace(const char *path, dp_context *context, dp_diag *diag) {
    (void)path, (void)context;
    return refuse(diag, no_planes);
}

dp_result dp_io_read_texture(const char *path, const dp_allocator *allocator, dp_texture **out,
                             dp_diag *diag) {
    (void)path, (void)allocator;
    *out = NULL;
    return refuse(diag, no_textures);
}

dp_result dp_io_read_png(const char *path, dp_io_pixels *pixels, dp_diag *diag) {
    (void)path;
    *pixels = (dp_io_pixels){0};
    return refuse(diag, no_textures);
}

void dp_io_free_pixels(dp_io_pixels *pixels) { (void)pixels; }
