/* What is drawn and scored: models, views, classes, widths, and the figures that must be met. */
#ifndef DP_TEST_SUITE_H
#define DP_TEST_SUITE_H

#include "score.h"

/* A model in memory with its reference. */
typedef struct suite_model {
    char name[64];
    dp_batch arrays; /* owned */
    dp_source *source;
    ref_model *reference;
    dp_extent extent;
} suite_model;

/* Copies the source (which it does not keep) into arrays. `shuffle` != 0: as a soup without
 * indices, its triangles in an order that the number decides. Crossings are sought in models of at
 * most `crossings` polygons. NULL, with the reason in *diag, when the source fails. */
suite_model *suite_model_create(const char *name, dp_source *source, uint32_t shuffle,
                                size_t crossings, dp_diag *diag);
void suite_model_destroy(suite_model *model); /* NULL allowed */

/* A camera in relation to a model's box. */
typedef struct suite_view {
    const char *name;
    double direction[3]; /* from the centre of the box to the eye */
    double fov_y;        /* degrees */
    bool orthographic;
    double nearer; /* 0: the model fits; else the eye stands at this share of the distance */
} suite_view;

enum { SUITE_VIEWS = 4, SUITE_CLOSE_VIEWS = 2, SUITE_CLASSES = 5, SUITE_WIDTHS = 4 };
extern const suite_view suite_views[SUITE_VIEWS];
extern const suite_view
    suite_close_views[SUITE_CLOSE_VIEWS]; /* part of the model is behind the eye */
extern const double suite_widths[SUITE_WIDTHS];

/* A set of classes asked for together, and what its pictures must reach. */
typedef struct suite_class {
    const char *name;
    uint32_t lines;
    double recall, precision;         /* at least */
    double uncovered;                 /* at most */
    double ridge_angle, valley_angle; /* degrees */
    unsigned widths;                  /* how many of suite_widths */
} suite_class;
extern const suite_class suite_classes[SUITE_CLASSES]; /* the last: all together */

dp_camera suite_camera(const suite_model *model, const suite_view *view, uint32_t width,
                       uint32_t height);
ref_truth *suite_truth(const suite_model *model, const suite_view *view, const suite_class *set,
                       uint32_t width, uint32_t height);

/* The style of a picture with these classes alone, black on white. */
dp_style suite_style(const suite_class *set, double px, const dp_style *base);

/* Draws into rgba with these classes alone, black on white. */
dp_result suite_draw(dp_context *context, const suite_model *model, const ref_truth *truth,
                     const suite_class *set, double px, const dp_style *base, uint8_t *rgba,
                     dp_diag *diag);

/* Writes which figures the score misses to text, "" for none; true when one is. What rests on less
 * than a pixel or two of line counts as met. */
bool suite_missed(const suite_class *set, double px, const score *score, char *text, size_t size);

#endif
