/* drypoint/drawing.h: the lines of a picture as paths, cleaned for pens and vectors, and pages of
 * them written as SVG, PDF, EPS, DXF or JSON (docs/vector.md).
 *
 *     const dp_style style = {.exact_ends = true, .hidden = {.look = DP_HIDDEN_DASHED}};
 *     dp_drawing *drawing = NULL;
 *     dp_draw(context, source, &camera, &style, &(dp_target){.width = 1600, .height = 1200}, &diag);
 *     dp_drawing_create(context, NULL, &drawing, &diag);
 *     const dp_view_on_page view = {.drawing = drawing};
 *     const dp_page page = {.views = &view, .view_count = 1};
 *     dp_page_write(&page, DP_FORMAT_SVG, write, file, &diag);
 *     dp_drawing_destroy(drawing);
 *
 * Lengths on the screen are in pixels, as widths are; the page says how large a pixel is.
 *
 * Not here: files (drypoint/io.h: dp_io_write_page), curves: paths are polylines. */
#ifndef DRYPOINT_DRAWING_H
#define DRYPOINT_DRAWING_H

#include <drypoint/sink.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a drawing is cleaned, in this order: what coincides on the screen is drawn once (visible
 * before hidden, lower levels before higher ones, outlines before creases), segments are chained
 * (one class, one level), chains are joined over gaps, folds within 0.1 px are taken out of them
 * (unless keep_coincident), points are left out where a line is straight, what is short then is
 * dropped. Zero is the default. */
typedef struct dp_drawing_desc {
    float join;           /* px: gaps up to this are closed; 0 means 2; below 0: none are */
    float min_length;     /* px: paths shorter than this are dropped, after joining; 0 means 1;
                              below 0: none are */
    float tolerance;      /* px: a point is left out where the path stays this near to it; 0 means
                              0.02; below 0: none are */
    bool join_classes;    /* gaps are closed, and paths go on, between classes too; a path is then
                              of the class that most of its length has */
    bool keep_coincident; /* lines that lie on others on the screen stay, and so do folds */
    bool optimize;        /* orders and turns paths so that a pen travels little between them */
} dp_drawing_desc;

/* A cleaned drawing. It stands for itself: neither the context nor the source need to live on. */
typedef struct dp_drawing dp_drawing;

/* Makes a drawing of the lines of the context's last dp_draw. desc may be NULL. Paths come layer by
 * layer from the bottom up (hidden ones first, the highest level first; classes as in dp_sink),
 * with `optimize` in pen order within each layer; the order does not depend on threads.
 * DP_ERR_ARGUMENT (nothing has been drawn, or a number is not finite), DP_ERR_LIMIT (more than 2^30
 * segments), DP_ERR_MEMORY. */
DP_API dp_result dp_drawing_create(dp_context *context, const dp_drawing_desc *desc,
                                   dp_drawing **out, dp_diag *diag);
DP_API void dp_drawing_destroy(dp_drawing *drawing); /* NULL allowed */

/* A point of a path, and what the line is that leads on from it. */
typedef struct dp_path_point {
    float x, y;       /* px: right, down */
    float distance;   /* along the line of sight, world units */
    uint32_t edge;    /* as in dp_segment, of the line to the next point; */
    uint64_t polygon; /* its polygon; UINT64_MAX: it closes a gap, or there is no next point */
    double world[3];
} dp_path_point;

typedef struct dp_path {
    dp_line line;
    uint32_t level; /* 0: visible; as in dp_segment */
    uint32_t group;
    float width; /* px, the whole line */
    dp_color color;
    float dash[2]; /* px drawn and px not, by turns, from the path's start; 0 and 0: a whole line.
                      What is drawn has round ends beyond that: where dash[0] is 0 it is a dot */
    bool closed;   /* the last point is joined to the first, which is not repeated */
    dp_line_end end[2]; /* at the first point and at the last; of closed paths DP_END_VERTEX */
    uint64_t hider[2];  /* as in dp_segment */
    const dp_path_point *points; /* [count], at least 2; borrowed from the drawing */
    size_t count;
    float length; /* px, closing line included */
} dp_path;

/* What a drawing holds, and what making it did. */
typedef struct dp_drawing_info {
    uint32_t width, height; /* px, of the picture */
    dp_color paper;
    uint32_t levels; /* the highest level of any path */
    size_t segments; /* it was made from */
    size_t paths, points;
    double length;     /* px, of all paths */
    double coincident; /* px that were left out because they lay on other lines, folds included */
    size_t joined;     /* gaps closed */
    double joined_length;
    size_t dropped; /* chains shorter than min_length */
    double dropped_length;
    double travel;        /* px between paths, in their order */
    double travel_before; /* the same before they were ordered; 0 without `optimize` */
    size_t bytes;         /* memory that the drawing holds */
} dp_drawing_info;

DP_API void dp_drawing_info_of(const dp_drawing *drawing, dp_drawing_info *info);

/* Path number `index`; false: there is none. */
DP_API bool dp_drawing_path(const dp_drawing *drawing, size_t index, dp_path *path);

/* ------- pages ------- */

typedef enum dp_format {
    DP_FORMAT_SVG = 0, /* a layer per class and level, a path each line */
    DP_FORMAT_PDF,     /* 1.5, a layer (optional content) per class and level */
    DP_FORMAT_EPS,     /* level 2 */
    DP_FORMAT_DXF,     /* R12, millimetres, y up */
    DP_FORMAT_JSON,    /* docs/vector.md has its schema */
    DP_FORMAT_COUNT
} dp_format;

/* "svg", "pdf", "eps", "dxf", "json": also the ending of their files. */
DP_API const char *dp_format_name(dp_format format);

/* A drawing, and where on a page its picture lies. */
typedef struct dp_view_on_page {
    const dp_drawing *drawing;
    double x, y;      /* mm, of its upper left corner from the page's */
    double mm_per_px; /* 0 means 25.4 / 96 */
    const char *name; /* "front", UTF-8; NULL: none */
    /* The surface under the lines: [height][width][4], not premultiplied, rows without gaps; NULL:
     * none. SVG takes it as a PNG instead, which dp_io_write_page makes of it; DXF and JSON have
     * none. */
    const uint8_t *ground;
    const void *ground_png;
    size_t ground_png_size; /* bytes */
} dp_view_on_page;

/* A line of text, drawn with single strokes. */
typedef struct dp_page_text {
    const char *text; /* UTF-8; what is neither ASCII nor Latin-1 is drawn as a box */
    double x, y;      /* mm, of the start of its base line from the page's upper left corner */
    double height;    /* mm, of a capital letter */
} dp_page_text;

/* Calls `stroke` for each stroke of a text as the writers draw it, for who draws pages elsewhere:
 * points in mm on the page, at least two. A stroke is a tenth of the text's height wide. */
typedef void dp_text_stroke(void *user, const double (*points)[2], size_t count);
DP_API void dp_page_text_strokes(const dp_page_text *text, dp_text_stroke *stroke, void *user);

/* A straight line on the page itself, of a title block say. */
typedef struct dp_page_rule {
    double x0, y0, x1, y1; /* mm */
    double width;          /* mm */
} dp_page_rule;

/* Compresses for PDF: appends a zlib stream of `size` bytes to the output, through `write`. */
typedef dp_result dp_compressor(const void *bytes, size_t size, dp_text_writer *write, void *user,
                                dp_diag *diag);

typedef struct dp_page {
    double width, height; /* mm; 0 and 0: those of the first view */
    dp_color paper; /* painted over the whole page (not in DXF); 0, DP_COLOR_NONE: nothing is */
    const dp_view_on_page *views;
    size_t view_count;
    const dp_page_text *texts;
    size_t text_count;
    const dp_page_rule *rules;
    size_t rule_count;
    double least_width;      /* mm: narrower lines are written this wide */
    const char *title;       /* of the file, UTF-8; NULL: none */
    dp_compressor *compress; /* NULL: PDF is not compressed */
} dp_page;

/* Writes a page, piece by piece: memory does not grow with it (but for a PDF's ground, three bytes a
 * pixel) and comes from the first view's drawing's allocator. The bytes depend on the page alone. A
 * drawing without paths makes a valid file without lines; paths beyond the page are written as they
 * are. DP_ERR_ARGUMENT (sizes are not finite, not above 0 or beyond a kilometre, a path's point is
 * not finite, a ground without its PNG for SVG), DP_ERR_MEMORY, and whatever `write` returns. */
DP_API dp_result dp_page_write(const dp_page *page, dp_format format, dp_text_writer *write,
                               void *user, dp_diag *diag);

/* The same into memory, which the caller frees with dp_bytes_free. */
DP_API dp_result dp_page_write_memory(const dp_page *page, dp_format format, void **bytes,
                                      size_t *size, dp_diag *diag);
DP_API void dp_bytes_free(void *bytes); /* NULL allowed */

#ifdef __cplusplus
}
#endif
#endif
