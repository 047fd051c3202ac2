/* Plans films.
 *
 * Frame k of N is drawn at T0 + (T1 - T0) k / N: a film of one round of a motion, or of whole turns,
 * loops, as what would be frame N is frame 0 again. What has an end that differs from its beginning
 * and is nothing else, a turn by 90 degrees or an open path, ends with its last frame: k / (N - 1). */
#include "film_plan.h"
#include "report.h"
#include "sides.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES_MOST = 1000000, FRAMES_OF_TURN = 120 };
static const double usual_fps = 25;
static const double degree = 0.017453292519943295;

/* ---- the path's file ---- */

enum { PATH_BYTES = 16 << 20 };

static int fail_path(const char *file, const char *what) {
    wrong_usage("--path %s: %s", file, what);
    return EXIT_FAILED;
}

static int read_path(const char *file, const double up[3], dp_camera_path **out) {
    FILE *const from = fopen(file, "rb");
    if (!from) return fail_path(file, "cannot be read; is the name right?");
    char *const text = malloc(PATH_BYTES);
    const size_t size = text ? fread(text, 1, PATH_BYTES, from) : 0;
    const bool failed = ferror(from);
    fclose(from);
    dp_diag diag = {0};
    int code = 0;
    if (!text)
        code = fail_path(file, "out of memory");
    else if (failed)
        code = fail_path(file, "cannot be read; is it a folder?");
    else if (size == PATH_BYTES)
        code = fail_path(file, "is larger than 16 MiB; give fewer views");
    else if (dp_camera_path_read(text, size, up, NULL, out, &diag))
        code = report_failure(file, &diag);
    free(text);
    return code;
}

/* ---- how many frames ---- */

/* 0: the settings do not say. */
static double frames_of(const tool_settings *s, const dp_source *source, const film_plan *plan) {
    const double duration = dp_source_duration(source);
    if (s->frames) return s->frames;
    if (s->time[1] != s->time[0]) return fabs(s->time[1] - s->time[0]) * plan->fps;
    if (plan->path) {
        const double length = dp_camera_path_end(plan->path) - dp_camera_path_begin(plan->path);
        return length * plan->fps + !dp_camera_path_closed(plan->path);
    }
    if (duration > 0) return duration * plan->fps;
    return s->has_turn ? FRAMES_OF_TURN : 0;
}

static int count_frames(const tool_settings *s, const dp_source *source, film_plan *plan) {
    const double count = frames_of(s, source, plan);
    if (!(count > 0))
        return wrong_usage("how long is the film? The model does not say: add --frames N, --time "
                           "T0:T1, or --turn 360"),
               EXIT_USAGE;
    if (!(count <= FRAMES_MOST))
        return wrong_usage("a film of %.0f frames is too long: %d are the most; give a shorter "
                           "--time, or --frames",
                           count, FRAMES_MOST),
               EXIT_USAGE;
    plan->count = (uint32_t)fmax(floor(count + 0.5), 1);
    if (!s->has_frame || s->frame < plan->count) return 0;
    wrong_usage("--frame %u: the film has %u frames, 0 to %u", s->frame, plan->count,
                plan->count - 1);
    return EXIT_USAGE;
}

int film_plan_make(const tool_settings *s, const dp_source *source, film_plan *plan) {
    model_sides sides;
    sides_of(s, source, &sides);
    *plan = (film_plan){.fps = s->fps > 0 ? s->fps : usual_fps, .turn = s->turn};
    memcpy(plan->axis, sides.up, sizeof plan->axis);
    int code = s->path ? read_path(s->path, sides.up, &plan->path) : 0;
    if (!code) code = count_frames(s, source, plan);
    plan->time[0] = s->time[0];
    plan->time[1] = s->time[1] != s->time[0] ? s->time[1] : s->time[0] + plan->count / plan->fps;
    return code;
}

void film_plan_free(film_plan *plan) {
    dp_camera_path_destroy(plan->path);
    plan->path = NULL;
}

void film_plan_centre(const tool_settings *s, const dp_extent *extent, film_plan *plan) {
    for (int k = 0; k < 3; k++)
        plan->centre[k] = s->has_target ? s->target[k]
                                        : extent->exact_min[k] +
                                              0.5 * (extent->exact_max[k] - extent->exact_min[k]);
}

/* ---- frames ---- */

double film_time(const film_plan *plan, uint32_t k) {
    return plan->time[0] + (plan->time[1] - plan->time[0]) * k / plan->count;
}

/* How far the film has come at frame k, from 0 to 1; `loops`: 1 would be 0 again. */
static double share_of(const film_plan *plan, uint32_t k, bool loops) {
    const uint32_t whole = loops || plan->count == 1 ? plan->count : plan->count - 1;
    return (double)k / whole;
}

static double angle_of(const film_plan *plan, uint32_t k) {
    return plan->turn * share_of(plan, k, fmod(plan->turn, 360) == 0) * degree;
}

/* Rodrigues' formula, by minus the angle. */
void film_turn_back(const film_plan *plan, uint32_t k, double rotation[3][3]) {
    const double angle = angle_of(plan, k), c = cos(angle), s = -sin(angle);
    const double *const a = plan->axis;
    const double cross[3][3] = {{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            rotation[i][j] = c * (i == j) + s * cross[i][j] + (1 - c) * a[i] * a[j];
}

/* Turns the world about the centre before frame 0's camera sees it. */
static void turn_camera(const film_plan *plan, uint32_t k, dp_camera *camera) {
    double r[3][3], *const m = camera->view;
    const double first[16] = {m[0], m[1], m[2],  m[3],  m[4],  m[5],  m[6],  m[7],
                              m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
    const double *const c = plan->centre;
    film_turn_back(plan, k, r);
    for (int row = 0; row < 3; row++) {
        double offset = first[12 + row];
        for (int column = 0; column < 3; column++) {
            double sum = 0;
            for (int i = 0; i < 3; i++) sum += first[4 * i + row] * r[i][column];
            m[4 * column + row] = sum;
            offset += (first[4 * column + row] - sum) * c[column];
        }
        m[12 + row] = offset;
    }
}

/* Near and far are told anew, in whatever projection. */
static void deepen(const dp_extent *extent, dp_camera *camera) {
    double near_z, far_z, *const m = camera->projection;
    dp_camera_near_far(camera, extent->min, extent->max, &near_z, &far_z);
    const bool perspective = m[11] != 0;
    m[10] = (perspective ? near_z + far_z : 2) / (near_z - far_z);
    m[14] = (perspective ? 2 * near_z * far_z : near_z + far_z) / (near_z - far_z);
}

static int camera_on_path(const film_plan *plan, uint32_t k, double aspect, const dp_extent *extent,
                          dp_camera *camera) {
    const double begin = dp_camera_path_begin(plan->path), end = dp_camera_path_end(plan->path),
                 share = share_of(plan, k, dp_camera_path_closed(plan->path));
    dp_diag diag = {0};
    if (!dp_camera_path_at(plan->path, begin + (end - begin) * share, aspect, extent->min,
                           extent->max, camera, &diag))
        return 0;
    report_failure(NULL, &diag);
    return EXIT_FAILED;
}

int film_camera(const film_plan *plan, uint32_t k, double aspect, const dp_extent *extent,
                dp_camera *camera) {
    if (plan->path) return camera_on_path(plan, k, aspect, extent, camera);
    if (angle_of(plan, k) != 0) turn_camera(plan, k, camera);
    deepen(extent, camera);
    return 0;
}
