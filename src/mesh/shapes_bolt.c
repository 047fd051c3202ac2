/* A hexagonal bolt, axis y, head up: chamfered head, washer face, plain shank and a real
 * right-handed helical thread that runs out at both ends.
 *
 * The thread is one sheet whose rows follow the helix, so that crests and roots are rows. A row
 * climbs one pitch per turn and continues as the row of the turn above; places along the axis are
 * integers, so both sides of that seam are the same points. Rows that would leave the thread stay
 * at its end, where its depth is 0: cells there shrink to nothing, and the sheet ends in a circle.
 *
 * Lengths are in units of the shank's radius; proportions follow ISO 4014 with a coarser thread. */
#include "mesh/models.h"

#include "base/elementary.h"

#include <math.h>

static const double FLATS = 1.6;                        /* half the width across flats */
static const double CHAMFER = 1.52;                     /* radius of the head's top */
static const double CHAMFER_SLOPE = 0.5773502691896258; /* 30 degrees */
static const double WASHER = 1.46;
static const double PITCH = 0.4, DEPTH = 0.245, CORE = 1 - 0.245;
static const double TOP = 1.28, UNDER = 0.1, SHOULDER = -2.0, RUN_OUT = 0.245, TIP = 0.14;

enum { TURNS = 11 };
enum { AROUND, ROWS }; /* n: points round the axis; rows per quarter of a profile */

/* ---- rings from the top down ---- */

enum ring {
    HEAD_TOP,
    HEAD_EDGE,
    HEAD_BASE,
    WASHER_TOP,
    WASHER_BASE,
    SHANK_TOP,
    SHANK_BASE,
    THREAD_TOP,
    THREAD_BASE,
    TIP_EDGE,
    RINGS
};

/* Distance from the axis to the hexagon at point k of n. */
static double hexagon(uint32_t k, uint32_t n) {
    const uint32_t side = n / 6;
    const double from_middle = (double)(k % side) / side - 0.5;
    return FLATS / dp_cos(from_middle * 1.0471975511965976);
}

static double thread_y(uint64_t along, uint64_t whole) {
    return SHOULDER - RUN_OUT - TURNS * PITCH * ((double)along / (double)whole);
}

static void ring_point(const dp_model *model, int ring, uint32_t k, double p[3]) {
    const double hex = hexagon(k, model->n[AROUND]);
    const double end = thread_y(1, 1);
    const double table[RINGS][2 /* radius, y */] = {
        [HEAD_TOP] = {CHAMFER, TOP},  [HEAD_EDGE] = {hex, TOP - (hex - CHAMFER) * CHAMFER_SLOPE},
        [HEAD_BASE] = {hex, UNDER},   [WASHER_TOP] = {WASHER, UNDER},
        [WASHER_BASE] = {WASHER, 0},  [SHANK_TOP] = {1, 0},
        [SHANK_BASE] = {1, SHOULDER}, [THREAD_TOP] = {CORE, thread_y(0, 1)},
        [THREAD_BASE] = {CORE, end},  [TIP_EDGE] = {CORE - TIP, end - TIP},
    };
    double c, s;
    dp_turn(k, model->n[AROUND], &c, &s);
    p[0] = table[ring][0] * c;
    p[1] = table[ring][1];
    p[2] = -(table[ring][0] * s);
}

/* A flat end: `from` is its ring. */
static void end_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                      double p[3]) {
    double rim[3];
    ring_point(model, sheet->from, 0, rim);
    dp_disc(i, j, sheet->nu, &p[0], &p[2]);
    p[0] = rim[0] * p[0];
    p[1] = rim[1];
    p[2] = -(rim[0] * p[2]);
}

/* ---- the thread ---- */

/* The profile of a pitch in sixteenths: root 4, flank 5, crest 2, flank 5. */
enum { SIXTEENTHS = 16, PARTS = 4 };
static const uint32_t part_start[PARTS] = {0, 4, 9, 11}, part_width[PARTS] = {4, 5, 2, 5};

/* Row j's place along the axis at angle 0, in sixteenths of a pitch / rows; its height, 0 … 1. */
static uint64_t row_place(const dp_model *model, uint32_t j, double *height) {
    const uint32_t rows = model->n[ROWS], turn = j / (PARTS * rows), e = j % (PARTS * rows);
    const uint32_t part = e / rows, t = e % rows;
    const double share = (double)t / rows;
    const double heights[PARTS] = {0, share, 1, 1 - share};
    *height = heights[part];
    return (uint64_t)turn * SIXTEENTHS * rows + part_start[part] * rows + part_width[part] * t;
}

/* Depth of the thread, 0 to 1: grows over one pitch at the top, fades over one at the tip. */
static double depth_at(uint64_t along, uint64_t whole) {
    const double from_top = TURNS * ((double)along / (double)whole);
    const double from_tip = TURNS * ((double)(whole - along) / (double)whole);
    return fmin(1, fmin(from_top, from_tip));
}

static void thread_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                         double p[3]) {
    double c, s, height;
    const uint64_t around = sheet->nu, pitch = (uint64_t)SIXTEENTHS * model->n[ROWS] * around;
    const uint64_t whole = TURNS * pitch, climb = pitch / around * i;
    const uint64_t place = row_place(model, j, &height) * around;
    uint64_t along = place > climb ? place - climb : 0; /* down the axis from the thread's top */
    if (along > whole) along = whole;
    const double radius = CORE + DEPTH * height * depth_at(along, whole);
    dp_turn(i, sheet->nu, &c, &s);
    p[0] = radius * c;
    p[1] = thread_y(along, whole);
    p[2] = -(radius * s);
}

/* ---- the model ---- */

/* Number of cells along a length, at least one; cells are twice as long as wide. */
static uint32_t cells(const dp_model *model, double length) {
    const double n = floor(length * model->fine + 0.5);
    return n < 1 ? 1 : (uint32_t)n;
}

static void add_end(dp_model *model, enum ring ring, bool reversed) {
    dp_sheet *const sheet = dp_model_add(model, model->n[AROUND] / 4, model->n[AROUND] / 4);
    sheet->point = end_point;
    sheet->from = (int)ring;
    sheet->reversed = reversed;
}

void dp_build_bolt(dp_model *model) {
    static const double lengths[RINGS] = {0.15, 1, 0.2, 0.1, 0.4, 2, 0.2, 0, 0.1};
    model->n[AROUND] = 12 * model->fine;
    model->n[ROWS] = (model->fine + 7) / 8;
    for (int ring = HEAD_TOP; ring < TIP_EDGE; ring++)
        if (ring != THREAD_TOP)
            dp_model_loft(model, ring_point, ring + 1, ring, model->n[AROUND],
                          cells(model, lengths[ring]));
    dp_sheet *const thread =
        dp_model_add(model, model->n[AROUND], PARTS * model->n[ROWS] * (TURNS + 1));
    thread->point = thread_point;
    thread->reversed = true;
    thread->shrinks = true;
    add_end(model, HEAD_TOP, false);
    add_end(model, TIP_EDGE, true);
    const double low = thread_y(1, 1) - TIP;
    model->extent = TOP - low;
    model->centre[1] = 0.5 * (TOP + low);
}
