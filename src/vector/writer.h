/* What the writers of pages share: a page made ready (its layers, styles and units), and a pen that
 * is led over it.
 *
 *     dp_plan_make(&plan, page, …)    checks the page, lists its layers and styles
 *     dp_plan_walk(&plan, &pen)       layer by layer from the bottom up, mark by mark
 *
 * Invariant: a plan's size depends on how many layers and styles there are, not on how many paths. */
#ifndef DP_VECTOR_WRITER_H
#define DP_VECTOR_WRITER_H

#include "vector/drawing.h"
#include "vector/out.h"

/* ------- layers ------- */

typedef enum dp_layer_kind {
    DP_LAYER_SURFACE = 0, /* grounds */
    DP_LAYER_LINES,       /* of one class and level */
    DP_LAYER_FRAME,       /* rules */
    DP_LAYER_TEXT
} dp_layer_kind;

typedef struct dp_layer {
    dp_layer_kind kind;
    uint32_t level;
    dp_line line;
    uint32_t styles; /* how many */
    uint32_t first;  /* the style that its first mark has; others are exceptions */
} dp_layer;

enum { DP_LAYER_NAME = 64 /* bytes */ };
/* "silhouette hidden 1" with the separator " ", "SILHOUETTE_HIDDEN_1" with "_" and `upper`. */
const char *dp_layer_name(char name[DP_LAYER_NAME], const dp_layer *layer, char separator,
                          bool upper);
/* The number that stays with a class and a level, and that plotters know it by: 10 * level, and 1
 * for silhouettes, 2 ridges, 3 valleys, 4 intersections, 5 borders; 0 surface, 6 frame, 7 text; 8
 * sections, 9 hatching. */
uint64_t dp_layer_number(const dp_layer *layer);

/* ------- styles ------- */

/* Lengths in thousandths of a unit. */
typedef struct dp_page_style {
    uint32_t layer, place; /* number of its layer, and its own among that layer's */
    dp_color color;
    int64_t width;
    int64_t dash[2]; /* of the spine, round ends lie beyond; 0 and 0: a whole line */
} dp_page_style;

/* ------- marks ------- */

/* A polyline: of a path, a rule, or a stroke of a letter. */
typedef struct dp_mark {
    uint32_t style;
    bool closed;
    bool joins;                  /* the figure that the mark before began: strokes of one text */
    const dp_path_point *points; /* or NULL: */
    const double (*plane)[2];
    size_t count;                   /* of either */
    double scale_x, scale_y, to[2]; /* from points to units of the page */
} dp_mark;

/* Goes along a mark's points, in thousandths of a unit. Points that coincide there come once, but a
 * mark has two at least. */
typedef struct dp_trail {
    const dp_mark *mark;
    size_t next, given;
    int64_t at[2];
} dp_trail;
bool dp_trail_next(dp_trail *trail); /* sets `at`; false: there are no more */

/* ------- plans ------- */

typedef struct dp_plan {
    const dp_page *page; /* its size is resolved */
    dp_allocator memory;
    double unit;           /* mm, of the page's units */
    double width, height;  /* units */
    bool up;               /* y counts from the lower edge */
    bool grounds;          /* grounds are taken */
    dp_layer *layers;      /* [layer_count], from the bottom up */
    dp_page_style *styles; /* [style_count], in the order in which they come */
    uint32_t *slots;       /* [slot_count], a power of two: numbers of styles by hash, and 1 */
    size_t layer_count, layers_cap, style_count, styles_cap, slot_count, slots_cap;
    uint32_t last; /* the style that was found last */
} dp_plan;

/* Units are pixels of the first view, with y down; with `millimetres` those, with y up. */
dp_result dp_plan_make(dp_plan *plan, const dp_page *page, bool millimetres, bool grounds,
                       const dp_allocator *memory, dp_diag *diag);
void dp_plan_free(dp_plan *plan);
double dp_view_scale(const dp_view_on_page *view); /* mm per px, resolved */

/* A view's ground on the page, units. */
typedef struct dp_ground {
    const dp_view_on_page *view;
    uint32_t columns, rows;
    double x, y, width, height; /* of its upper left corner, and its size */
} dp_ground;

/* What a writer does where it is led; any function may be NULL but `mark`. */
typedef struct dp_pen {
    void *user;
    void (*begin)(void *user, const dp_layer *layer);
    void (*ground)(void *user, const dp_ground *ground);
    void (*mark)(void *user, const dp_mark *mark);
    void (*end)(void *user, const dp_layer *layer);
} dp_pen;

/* Ends early where `out` has failed. */
void dp_plan_walk(dp_plan *plan, const dp_pen *pen, const dp_out *out);

/* ------- formats ------- */

/* Writes a whole page; may fail by out->result. */
typedef void dp_page_writer(dp_out *out, dp_plan *plan);
dp_page_writer dp_write_svg, dp_write_pdf, dp_write_eps, dp_write_dxf, dp_write_json;

/* What painting over `under` with a colour gives, opaque. */
dp_color dp_blend(dp_color over, dp_color under);
/* Is the page painted? */
bool dp_is_painted(const dp_page *page);

#endif
