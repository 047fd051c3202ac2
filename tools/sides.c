/* The sides of a model turn with what is up: with +y front is what lies on +z, with +z what lies on
 * -y, and right is +x both times; dp_camera_sides has them all. Sheets, views and angles go by it. */
#include "sides.h"
#include "report.h"

#include <math.h>
#include <unistd.h>

static const double degree = 0.017453292519943295;

void sides_of(const tool_settings *s, const dp_source *source, model_sides *sides) {
    dp_source_up(source, sides->up);
    if (s->has_up) {
        const double length = sqrt(s->up[0] * s->up[0] + s->up[1] * s->up[1] + s->up[2] * s->up[2]);
        for (int k = 0; k < 3; k++) sides->up[k] = s->up[k] / length;
    }
    dp_camera_sides(sides->up, sides->right, sides->front);
}

void sides_view(const model_sides *f, int view, double d[3], double up[3]) {
    const bool flat = view == VIEW_TOP || view == VIEW_BOTTOM;
    for (int k = 0; k < 3; k++) {
        const double by_view[] = {[0] = f->right[k] + 0.6 * f->up[k] + f->front[k],
                                  [VIEW_FRONT] = f->front[k],
                                  [VIEW_BACK] = -f->front[k],
                                  [VIEW_LEFT] = -f->right[k],
                                  [VIEW_RIGHT] = f->right[k],
                                  [VIEW_TOP] = f->up[k],
                                  [VIEW_BOTTOM] = -f->up[k],
                                  [VIEW_ISO] = f->front[k] + f->right[k] + f->up[k]};
        d[k] = by_view[view];
        up[k] = !flat ? f->up[k] : view == VIEW_TOP ? -f->front[k] : f->front[k];
    }
}

/* Without what sine and cosine leave of a right angle. */
static double clean(double value) { return fabs(value) < 1e-15 ? 0 : value; }

void sides_angles(const model_sides *f, double azimuth, double elevation, double d[3],
                  double up[3]) {
    const double across = clean(sin(azimuth * degree)), ahead = clean(cos(azimuth * degree));
    const double rise = clean(sin(elevation * degree)), level = clean(cos(elevation * degree));
    for (int k = 0; k < 3; k++) {
        const double outwards = across * f->right[k] + ahead * f->front[k];
        d[k] = level * outwards + rise * f->up[k];
        up[k] = level * f->up[k] - rise * outwards;
    }
}

const char *sides_assumed(const tool_settings *s, const dp_source *source) {
    double up[3];
    if (s->has_up || dp_source_up(source, up)) return NULL;
    return up[2] > 0 ? "up is +z, as usual in STL (--up y turns it)"
                     : "up is +y, as the file does not say (--up z turns it)";
}

void sides_tell(const tool_settings *s, const dp_source *source) {
    const char *const assumed = sides_assumed(s, source);
    if (assumed && !s->quiet && !s->number && isatty(STDERR_FILENO)) note("%s", assumed);
}
