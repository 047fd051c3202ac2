/* Hand-made models: see models.h. */
#include "models.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

typedef struct point {
    double x, y, z;
} point;

/* Adds a polygon; backwards where it is turned. */
static void add(model *m, size_t n, const point *at, bool turned) {
    if (m->corners + n > MODEL_CORNERS || m->polygons + 1 > MODEL_POLYGONS) abort();
    for (size_t i = 0; i < n; i++) {
        const point p = at[turned ? n - 1 - i : i];
        float *const to = m->positions[m->corners + i];
        to[0] = (float)p.x, to[1] = (float)p.y, to[2] = (float)p.z;
        m->flags[m->corners + i] = 1;
    }
    m->groups[m->polygons] = m->group;
    m->firsts[m->polygons++] = (uint32_t)m->corners;
    m->corners += n;
    m->firsts[m->polygons] = (uint32_t)m->corners;
}

static void add_triangle(model *m, point a, point b, point c, bool turned) {
    add(m, 3, (const point[]){a, b, c}, turned);
}

static void add_quad(model *m, point a, point b, point c, point d, bool turned) {
    add(m, 4, (const point[]){a, b, c, d}, turned);
}

/* The same numbers everywhere: in [0, 1). */
static double random_number(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

void make_fans(model *m) {
    /* degrees towards the eye; sides: 1 to the right, -1 to the left */
    static const double rise[3] = {25, -15, -55};
    static const int sides[3][3] = {{1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};
    for (int set = 0; set < 3; set++) {
        for (int wound = 0; wound < 8; wound++) {
            const double x = -100 + 28.5 * wound + (set == 0 ? -6 : 0), y = 60 - 60 * set;
            for (int page = 0; page < 3; page++) {
                m->group = (uint16_t)page;
                const double turn = rise[page] * PI / 180, reach = set == 0 ? 20 : 12;
                const double dx = sides[set][page] * reach * cos(turn), dz = reach * sin(turn);
                add_quad(m, (point){x, y - 22, 0}, (point){x + dx, y - 20 - 2 * page, dz},
                         (point){x + dx, y + 20 + 2 * page, dz}, (point){x, y + 22, 0},
                         wound >> page & 1);
            }
        }
    }
    m->group = 0;
}

void make_crossing(model *m) {
    uint32_t random = 3;
    for (int i = 0; i < 16; i++) { /* three triangles to a place, two of them at one corner */
        const double x = -88 + 58 * (i % 4), y = 66 - 44 * (i / 4);
        point at[3][3];
        for (int t = 0; t < 3; t++)
            for (int c = 0; c < 3; c++) {
                const double turn = 2 * PI * (c + random_number(&random)) / 3,
                             reach = 16 + 10 * random_number(&random);
                at[t][c] = (point){x + reach * cos(turn), y + 0.8 * reach * sin(turn),
                                   60 * (random_number(&random) - 0.5)};
            }
        at[1][0] = at[0][0];
        for (int t = 0; t < 3; t++) {
            m->group = (uint16_t)((t + i) % 3);
            add(m, 3, at[t], (i + t) % 4 == 3);
        }
    }
    m->group = 0;
}

/* A rectangle in a tilted plane through `middle`: from (u0, v0) to (u1, v1) along its axes. */
static void add_tilted(model *m, point middle, double tilt, double turn, const double box[4],
                       bool turned) {
    const point u = {cos(turn), sin(turn) * cos(tilt), sin(turn) * sin(tilt)};
    const point v = {-sin(turn), cos(turn) * cos(tilt), cos(turn) * sin(tilt)};
    point at[4];
    for (int i = 0; i < 4; i++) {
        const double a = box[i == 1 || i == 2 ? 2 : 0], b = box[i >= 2 ? 3 : 1];
        at[i] = (point){middle.x + a * u.x + b * v.x, middle.y + a * u.y + b * v.y,
                        middle.z + a * u.z + b * v.z};
    }
    add(m, 4, at, turned);
}

void make_sheets(model *m) {
    for (int i = 0; i < 12; i++) {
        const point middle = {-90 + 60 * (i % 4), 58 - 58 * (i / 4), 7.3 * i};
        const double tilt = 0.35 + 0.07 * i, turn = 0.2 + 0.37 * i;
        static const double boxes[4][4] = {
            {-22, -16, 10, 14}, {-12, -9, 20, 11}, {-5.3, -20, 4.1, 20}, {-12, -9, 20, 11}};
        for (int k = 0; k < 4; k++) {
            m->group = (uint16_t)(k % 3);
            add_tilted(m, middle, tilt, turn, boxes[k], k == 3 && i % 2);
        }
    }
    m->group = 0;
}

void make_flush(model *m) {
    uint32_t random = 7;
    for (int i = 0; i < 60; i++) {
        const double x = -100 + 200 * random_number(&random),
                     y = -70 + 140 * random_number(&random);
        const double w = 8 + 20 * random_number(&random), h = 6 + 16 * random_number(&random);
        m->group = (uint16_t)(i % 3);
        add_quad(m, (point){x - w, y - h, 0}, (point){x + w, y - h, 0}, (point){x + w, y + h, 0},
                 (point){x - w, y + h, 0}, false);
    }
    m->group = 0;
}

static void add_floor(model *m) {
    add_quad(m, (point){-115, -85, 0}, (point){115, -85, 0}, (point){115, 85, 0},
             (point){-115, 85, 0}, false);
}

void make_steep(model *m) {
    add_floor(m);
    for (int i = 0; i < 4; i++) {
        const double x = -84 + 56 * i, steep = 5 + 3 * i, reach = 12; /* px of depth per px */
        add_quad(m, (point){x - reach, -80, steep * reach}, (point){x - reach, 80, steep * reach},
                 (point){x + reach, 80, -steep * reach}, (point){x + reach, -80, -steep * reach},
                 true);
    }
}

void make_valleys(model *m) {
    for (int i = 0; i < 6; i++) {
        const double x = -95 + 38 * i, steep = 0.4 * (1 << i); /* px of depth per px */
        const double y = 80, reach = 17;
        add_quad(m, (point){x - reach, -y, 3}, (point){x, -y, 0}, (point){x, y, 0},
                 (point){x - reach, y, 3}, false);
        add_quad(m, (point){x, -y, 0}, (point){x + reach, -y, steep * reach},
                 (point){x + reach, y, steep * reach}, (point){x, y, 0}, false);
    }
}

/* A strip of which only the upper edge draws. */
static void add_line(model *m, point a, point b) {
    const size_t first = m->corners;
    add_quad(m, (point){a.x, a.y - 3, a.z}, (point){b.x, b.y - 3, b.z}, b, a, false);
    m->flags[first] = m->flags[first + 1] = m->flags[first + 3] = 0;
}

void make_gaps(model *m) {
    for (int i = 0; i < 14; i++) {
        const double y = 80 - 12 * i, slope = 1.1 * (i - 7), z = i % 2 ? -280 : 0;
        add_line(m, (point){-100, y - slope, 0}, (point){-1.2, y, 0});
        add_line(m, (point){1.2, y, z}, (point){100, y + slope, z});
    }
}

void make_bars(model *m) {
    for (int i = 0; i < 9; i++) {
        const double x = -100 + 25 * i;
        add_quad(m, (point){x - 3, -85, 20}, (point){x + 3, -85, 20 + i},
                 (point){x + 3, 85, 20 + i}, (point){x - 3, 85, 20}, false);
    }
    for (int i = 0; i < 8; i++) {
        const double y = 66 - 19 * i, lift = 2.3 * (i - 3);
        add_quad(m, (point){-110, y - 4 - lift, -30}, (point){110, y - 4 + lift, 12},
                 (point){110, y + 4 + lift, 12}, (point){-110, y + 4 - lift, -30}, false);
    }
}

static point wave(int i, int k) {
    const double x = -110 + 10 * i + 5 * k - 45, y = -80 + 8 * k; /* sheared: obtuse triangles */
    return (point){x, y, 14 * sin(x / 17) * cos(y / 23) + 9 * sin((x + y) / 31)};
}

void make_waves(model *m) {
    for (int k = 0; k < 20; k++) {
        for (int i = 0; i < 22; i++) {
            const point a = wave(i, k), b = wave(i + 1, k), c = wave(i + 1, k + 1),
                        d = wave(i, k + 1);
            add_triangle(m, a, b, c, false); /* along the longer diagonal */
            add_triangle(m, a, c, d, false);
        }
    }
}

/* Its sides along the axes, so that faces that touch lie in exactly one plane. */
static void add_box(model *m, point min, point max, uint32_t faces, bool turned) {
    static const int corner[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; f++) {
        point at[4];
        if (!(faces >> f & 1)) continue;
        for (int c = 0; c < 4; c++) {
            const int k = corner[f][c];
            at[c] = (point){k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z};
        }
        add(m, 4, at, turned);
    }
}

static void add_whole_box(model *m, point min, point max) { add_box(m, min, max, 63, false); }

void make_touching(model *m) {
    add_whole_box(m, (point){-95, 10, -20}, (point){-65, 60, 20}); /* side by side */
    add_whole_box(m, (point){-65, 10, -20}, (point){-35, 60, 20});
    add_whole_box(m, (point){-20, 5, -20}, (point){25, 35, 20}); /* one upon the other */
    add_whole_box(m, (point){-20, 35, -20}, (point){25, 60, 20});
    add_whole_box(m, (point){40, 35, -20}, (point){70, 65, 20}); /* around one edge */
    add_whole_box(m, (point){70, 5, -20}, (point){100, 35, 20});
    for (int i = 0; i < 2; i++) /* in one place */
        add_whole_box(m, (point){-80, -55, -20}, (point){-40, -25, 20});
    add_whole_box(m, (point){-10, -60, -20}, (point){20, -30, 20}); /* the other way */
    add_whole_box(m, (point){20, -30, -20}, (point){50, -15, 20});
    add_whole_box(m, (point){60, -65, -20}, (point){90, -45, 10}); /* at a part of a face */
    add_whole_box(m, (point){60, -45, -10}, (point){75, -25, 10});
}

void make_double(model *m) {
    /* without top; without top and front; a floor and a wall; three walls */
    static const uint32_t faces[] = {63 - 8, 63 - 8 - 32, 4 + 16, 1 + 16 + 32, 63 - 8, 63 - 2};
    for (int i = 0; i < 6; i++) {
        const double x = -95 + 66 * (i % 3), y = i < 3 ? 5 : -75;
        for (int back = 0; back < 2; back++)
            add_box(m, (point){x, y, -20}, (point){x + 45, y + 40, 25}, faces[i], back == (i >= 3));
    }
}

void make_concave(model *m) {
    enum { KINDS = 8 };
    /* on a grid, so that corners lie exactly on diagonals and edges */
    static const signed char kinds[KINDS][12][2] = {
        {{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}, {1, 2}},
        {{0, 0}, {2, 1}, {4, 0}, {3, 2}, {4, 4}, {2, 3}, {0, 4}, {1, 2}},
        {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}},
        {{0, 0},
         {1, 0},
         {1, 3},
         {2, 3},
         {2, 1},
         {3, 1},
         {3, 3},
         {4, 3},
         {4, 0},
         {5, 0},
         {5, 5},
         {0, 5}},
        /* these touch themselves */
        {{4, 3}, {0, 4}, {2, 0}, {3, 0}, {3, 3}, {1, 2}, {3, 1}},
        {{4, 4}, {1, 4}, {0, 2}, {3, 2}, {2, 4}, {1, 2}, {2, 2}, {4, 1}},
        {{1, 0}, {2, 0}, {4, 4}, {0, 2}, {0, 0}, {3, 0}, {3, 2}, {1, 2}},
        {{0, 2}, {1, 0}, {4, 0}, {2, 4}, {1, 3}, {3, 1}, {3, 2}, {2, 2}, {0, 4}},
    };
    static const int counts[KINDS] = {6, 8, 8, 12, 7, 8, 8, 9};
    for (int i = 0; i < 3 * KINDS; i++) {
        const int kind = i % KINDS, n = counts[kind], row = i / KINDS;
        point at[12];
        for (int k = 0; k < n; k++) { /* begun at another corner in each row */
            const signed char *const p = kinds[kind][(k + 3 * row) % n];
            at[k] = (point){-118 + 30 * kind + 6 * p[0], 40 - 50 * row + 8 * p[1], 0};
        }
        add(m, (size_t)n, at, false);
    }
}

void make_badly_wound(model *m) {
    enum { SIDES = 12 };
    for (int kind = 0; kind < 4; kind++) {
        const double x = -87 + 58 * kind;
        point low[SIDES], high[SIDES];
        for (int i = 0; i < SIDES; i++) {
            const double a = 2 * PI * i / SIDES, dx = 25 * cos(a), dz = 25 * sin(a);
            low[i] = (point){x + dx, -55 - 0.5 * dz, dz};
            high[i] = (point){x + dx, 55 - 0.5 * dz, dz};
        }
        for (int i = 0; i < SIDES; i++) {
            const int k = (i + 1) % SIDES;
            const bool turned = kind == 3 || (kind == 1 && i % 3 == 0) || (kind == 2 && i % 2);
            add_quad(m, low[k], low[i], high[i], high[k], turned);
        }
        add(m, SIDES, high, kind != 3);
        add(m, SIDES, low, kind == 3);
    }
}

void make_open(model *m) {
    /* a tray: a floor and four walls, open to the eye */
    const point in[4] = {{-100, 5, -30}, {-50, 5, -30}, {-50, 55, -30}, {-100, 55, -30}};
    const point out[4] = {{-115, -5, 10}, {-40, -5, 10}, {-40, 75, 10}, {-115, 75, 10}};
    add(m, 4, in, false);
    for (int i = 0; i < 4; i++)
        add_quad(m, in[(i + 1) % 4], in[i], out[i], out[(i + 1) % 4], false);
    /* a roof whose one side is cut into pieces: T-junctions */
    add_quad(m, (point){-20, 10, 30}, (point){110, 20, 30}, (point){110, 60, 0},
             (point){-20, 60, 0}, false);
    for (int i = 0; i < 5; i++) {
        const double x = -20 + 26 * i, y = 10 + 2 * i;
        add_quad(m, (point){x, -20, -5}, (point){x + 26, -20, -5}, (point){x + 26, y + 2, 30},
                 (point){x, y, 30}, false);
    }
    /* a sheet folded to and fro, and its back */
    for (int i = 0; i < 8; i++) {
        const double x = -110 + 26 * i, z = i % 2 ? 18 : -6, next = i % 2 ? -6 : 18;
        add_quad(m, (point){x, -80, z}, (point){x + 26, -80, next}, (point){x + 26, -45, next},
                 (point){x, -40, z}, i >= 4);
    }
}
