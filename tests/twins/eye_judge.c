/* The eye's verdict on a picture. */
#include "eye.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEAR_UNDECIDED = 1, NEAR_TRUTH = 2 };

static double ink_of(const uint8_t *p) {
    return p[3] / 255.0 * (1 - (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255);
}

/* Calls on every pixel within reach of a point. */
static void around(const eye_truth *t, double x, double y, double reach,
                   void (*each)(void *user, size_t pixel), void *user) {
    const int x0 = (int)fmax(0, floor(x - reach - 0.5)), y0 = (int)fmax(0, floor(y - reach - 0.5));
    for (int j = y0; j < (int)t->height && j <= y + reach; j++)
        for (int i = x0; i < (int)t->width && i <= x + reach; i++)
            if (hypot(i + 0.5 - x, j + 0.5 - y) <= reach)
                each(user, (size_t)j * t->width + (size_t)i);
}

typedef struct search {
    const uint8_t *rgba;
    bool found;
} search;

static void find_ink(void *user, size_t pixel) {
    search *const s = user;
    s->found |= ink_of(s->rgba + 4 * pixel) > 0.4;
}

typedef struct spread {
    uint8_t *near, bit;
} spread;

static void set_near(void *user, size_t pixel) {
    const spread *const s = user;
    s->near[pixel] |= s->bit;
}

static uint8_t *near_truth(const eye_truth *t, double reach) {
    uint8_t *const near = calloc((size_t)t->width * t->height, 1);
    if (near == NULL) abort();
    for (size_t i = 0; i < t->count; i++) {
        const eye_point *const p = &t->points[i];
        spread s = {near, p->kind == EYE_UNDECIDED ? NEAR_UNDECIDED : NEAR_TRUTH};
        around(t, p->x, p->y, reach, set_near, &s);
    }
    return near;
}

static bool is_inside(const eye_truth *t, const eye_point *p) {
    return p->x >= 2 && p->y >= 2 && p->x <= t->width - 2.0 && p->y <= t->height - 2.0;
}

static bool has_ink(const eye_truth *t, const eye_point *p, const uint8_t *rgba, double reach) {
    search s = {rgba, false};
    around(t, p->x, p->y, reach, find_ink, &s);
    return s.found;
}

eye_score eye_judge(const eye_truth *t, const uint8_t *rgba, double px) {
    const double reach = px / 2 + 1;
    uint8_t *const near = near_truth(t, reach);
    eye_score s = {0};
    double truth = 0, found = 0, good = 0;
    for (size_t i = 0; i < t->count; i++) {
        const eye_point *const p = &t->points[i];
        if (!is_inside(t, p)) continue;
        s.length[p->kind] += p->length;
        if (has_ink(t, p, rgba, reach)) s.found[p->kind] += p->length;
    }
    for (int k = 0; k < EYE_UNDECIDED; k++) truth += s.length[k], found += s.found[k];
    for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
        const double ink = ink_of(rgba + 4 * i);
        s.ink += ink;
        if (near[i] & NEAR_TRUTH)
            good += ink;
        else if (near[i] == 0)
            s.stray += ink;
    }
    s.recall = truth > 0 ? found / truth : 1;
    s.precision = good + s.stray > 0 ? good / (good + s.stray) : truth > 0 ? 0 : 1;
    free(near);
    return s;
}

typedef struct pen {
    uint8_t *rgba;
} pen;

static void blacken(void *user, size_t pixel) {
    memset(((const pen *)user)->rgba + 4 * pixel, 0, 3);
}

void eye_draw(const eye_truth *t, double px, double dx, uint8_t *rgba) {
    pen p = {rgba};
    memset(rgba, 255, (size_t)4 * t->width * t->height);
    for (size_t i = 0; i < t->count; i++)
        if (t->points[i].kind != EYE_UNDECIDED)
            around(t, t->points[i].x + dx, t->points[i].y + dx, px / 2, blacken, &p);
}

static void paint(uint8_t *rgba, size_t pixel, int r, int g, int b) {
    const uint8_t color[4] = {(uint8_t)r, (uint8_t)g, (uint8_t)b, 255};
    memcpy(rgba + 4 * pixel, color, 4);
}

void eye_mark(const eye_truth *t, const uint8_t *rgba, double px, uint8_t *marked) {
    const double reach = px / 2 + 1;
    uint8_t *const near = near_truth(t, reach);
    for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
        const double ink = ink_of(rgba + 4 * i);
        const int rest = (int)(255 * (1 - ink)), light = 255 - (int)(60 * ink);
        if (near[i])
            paint(marked, i, light, light, light);
        else
            paint(marked, i, rest, rest, 255);
    }
    for (int red = 0; red < 2; red++)
        for (size_t i = 0; i < t->count; i++) {
            const eye_point *const p = &t->points[i];
            if (!is_inside(t, p) || (p->kind == EYE_UNDECIDED) == (red == 1)) continue;
            const size_t pixel = (size_t)p->y * t->width + (size_t)p->x;
            if (red == 0)
                paint(marked, pixel, 128, 128, 128);
            else if (!has_ink(t, p, rgba, reach))
                paint(marked, pixel, 255, 0, 0);
        }
    free(near);
}
