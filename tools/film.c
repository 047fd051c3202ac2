/* drypoint MODEL --frames N -o out-%04d.png, or -o out.mp4.
 *
 *     plan      how many frames, when, and from where (film_plan.c)
 *     see       one camera for all: fitted to what they show (film_seen.c)
 *     draw      frames side by side, in processes (film_jobs.c): each draws its frame as a picture is
 *               drawn (draw.c), and writes it if pictures are wanted
 *     take      frames in their order: into a file, or to ffmpeg (film_pipe.c)
 *
 * A frame depends on its number alone: in another order, by another process or alone (--frame) it is
 * the same bytes. */
#include "film.h"
#include "draw.h"
#include "files.h"
#include "film_jobs.h"
#include "film_pipe.h"
#include "film_plan.h"
#include "film_seen.h"
#include "film_stats.h"
#include "output.h"
#include "progress.h"
#include "report.h"

#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { OUTPUTS = FILES_MOST + OUTPUT_COUNT };

typedef struct film {
    const tool_settings *s;
    film_plan plan;
    drawing drawing;
    measured model;
    dp_extent beside;              /* of a mirror; see() */
    dp_camera cameras[SHEET_MOST]; /* of frame 0, before it is deepened */
    uint32_t *frames;              /* [count] what is drawn */
    uint32_t count, jobs, threads;
    uint64_t polygons; /* of the model, about */
    film_pipe pipes[FILES_MOST];
    uint32_t pipe_count;
    film_stats stats;
    struct timespec begin;
} film;

/* ---- names of a frame's files ---- */

static const char **output_at(tool_settings *s, int k) {
    return k < FILES_MOST ? &s->files[k] : &s->outputs[k - FILES_MOST];
}

/* The settings of one frame: with its names in the place of patterns. */
static bool name_frame(const tool_settings *s, uint32_t number, tool_settings *one,
                       char names[OUTPUTS][PATH_MAX]) {
    *one = *s;
    for (int k = 0; k < OUTPUTS; k++) {
        const char **const at = output_at(one, k);
        if (!*at || !output_is_sequence(*at)) continue;
        if (!output_number(*at, number, names[k], PATH_MAX))
            return wrong_usage("-o %s: the name for frame %u is too long", *at, number);
        *at = names[k];
    }
    return true;
}

static bool is_there(const tool_settings *s, uint32_t number) {
    char names[OUTPUTS][PATH_MAX];
    tool_settings one;
    struct stat status;
    if (!name_frame(s, number, &one, names)) return false;
    for (int k = 0; k < OUTPUTS; k++) {
        const char *const path = *output_at(&one, k);
        if (path && (stat(path, &status) || !S_ISREG(status.st_mode) || !status.st_size))
            return false;
    }
    return true;
}

static int choose_frames(film *f) {
    const tool_settings *const s = f->s;
    f->frames = calloc(f->plan.count, sizeof *f->frames);
    if (!f->frames || !film_stats_begin(&f->stats, f->plan.count))
        return wrong_usage("out of memory for %u frames", f->plan.count), EXIT_FAILED;
    for (uint32_t k = 0; k < f->plan.count; k++) {
        if (s->has_frame ? k != s->frame : s->resume && is_there(s, k)) continue;
        f->frames[f->count++] = k;
    }
    if (s->resume && !s->quiet)
        note("%u of %u frames are there already", f->plan.count - f->count, f->plan.count);
    return 0;
}

/* ---- one camera for all frames ---- */

/* Measures the motion without turns, then fits to what the turning camera sees of it. */
static int see(film *f) {
    const tool_settings *const s = f->s;
    drawing *const d = &f->drawing;
    dp_source *seen = NULL, *turned = NULL;
    dp_style style = {0};
    int code = film_seen_make(&f->plan, d->source, false, NULL, &seen, &f->polygons);
    if (!code) code = measure_model(s, seen, &f->model);
    if (!code) warn_coarse(s, &f->model.extent);
    if (!code) film_plan_centre(s, &f->model.extent, &f->plan);
    if (!code && f->plan.turn != 0) {
        measured mirrored = f->model;
        look_mirror(s, &mirrored, &style);
        f->beside = mirrored.beside;
        f->model.aspect = 0; /* it is to be fitted again */
        code = film_seen_make(&f->plan, d->source, true, s->has_mirror ? &f->beside : NULL, &turned,
                              NULL);
    }
    if (!code) code = drawing_prepare(s, d, turned ? turned : seen, &f->model);
    for (int k = 0; k < d->plan.view_count && !code; k++) f->cameras[k] = d->plan.views[k].camera;
    dp_source_destroy(turned);
    dp_source_destroy(seen);
    return code;
}

/* ---- in each process ---- */

static int begin(void *user) {
    film *const f = user;
    drawing *const d = &f->drawing;
    d->lent = f->pipe_count > 0;
    return drawing_open(f->s, d, f->threads);
}

/* Where eye and target are given nothing is fitted, and a frame is what a picture at its time is,
 * bit for bit: near and far are those of the model at this time alone. */
static bool is_as_a_picture(const film *f) {
    return f->s->has_eye && f->s->has_target && !f->s->has_mirror && f->plan.turn == 0;
}

static int aim(film *f, uint32_t number) {
    drawing *const d = &f->drawing;
    dp_extent extent = f->model.extent;
    dp_diag diag = {0};
    int code = 0;
    if (is_as_a_picture(f) && dp_source_extent(d->source, &extent, &diag))
        return report_model(f->s, &diag);
    if (extent.polygons <= extent.not_finite + extent.bad_index) /* nothing is there now */
        extent = f->model.extent;
    for (int k = 0; k < d->plan.view_count && !code; k++) {
        page_view *const v = &d->plan.views[k];
        v->camera = f->cameras[k];
        code = film_camera(&f->plan, number, (double)v->width / v->height, &extent, &v->camera);
        if (!code) look_deepen(&d->style, &extent, &v->camera);
    }
    return code;
}

static int draw(void *user, uint32_t number, uint8_t *pixels, film_frame *out) {
    film *const f = user;
    drawing *const d = &f->drawing;
    char names[OUTPUTS][PATH_MAX];
    tool_settings one;
    dp_diag diag = {0};
    if (!name_frame(f->s, number, &one, names)) return EXIT_USAGE;
    one.quiet = true;
    if (d->lent) d->target.rgba = pixels;
    if (dp_source_set_time(d->source, film_time(&f->plan, number), &diag))
        return report_model(f->s, &diag);
    int code = aim(f, number);
    if (!code) code = drawing_draw(&one, d);
    if (!code) code = drawing_write(&one, d);
    out->stats = d->stats[0];
    out->empty = drawing_is_empty(d);
    return code;
}

/* ---- in the program's own ---- */

static bool is_opaque(const tool_settings *s) {
    return !s->style.paper || (s->style.paper & 0xFF) == 0xFF;
}

static void warn_formats(const film *f) {
    const tool_settings *const s = f->s;
    if (s->quiet) return;
    if (!is_opaque(s) && files_have(s, FORMAT_MP4))
        warn("MP4 has no transparency: its paper is white; .webm, .gif and .apng have some");
    if (f->plan.fps > 50 && files_have(s, FORMAT_GIF))
        warn("players show GIFs of more than 50 frames a second slowly; give --fps 50, or write a "
             ".webm");
}

static int ready(void *user) {
    film *const f = user;
    const film_shape shape = {.width = f->drawing.plan.width,
                              .height = f->drawing.plan.height,
                              .count = f->plan.count,
                              .fps = f->plan.fps,
                              .paper = f->s->style.paper,
                              .opaque = is_opaque(f->s)};
    int code = 0;
    interrupt_hold();
    clock_gettime(CLOCK_MONOTONIC, &f->begin);
    progress_begin("drawing", f->s->quiet);
    for (uint32_t k = 0, at = 0; k < f->s->file_count && !code; k++)
        if (files_is_film(f->s, f->s->files[k]))
            code = film_pipe_open(f->s->files[k], files_format(f->s, f->s->files[k]), &shape,
                                  &f->pipes[at++]);
    return code;
}

static int take(void *user, const film_frame *frame, const uint8_t *pixels) {
    film *const f = user;
    int code = 0;
    film_stats_add(&f->stats, frame);
    for (uint32_t k = 0; k < f->pipe_count && !code; k++)
        code = film_pipe_write(&f->pipes[k], pixels);
    return code;
}

/* Films are whole when all of them are: the first is not renamed before the last is written. */
static int finish(film *f, int code) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    f->stats.seconds =
        (double)(now.tv_sec - f->begin.tv_sec) + 1e-9 * (double)(now.tv_nsec - f->begin.tv_nsec);
    for (uint32_t k = 0; k < f->pipe_count && !code; k++) code = film_pipe_finish(&f->pipes[k]);
    for (uint32_t k = 0; k < f->pipe_count && code; k++) film_pipe_abandon(&f->pipes[k]);
    progress_end();
    interrupt_release();
    return code;
}

/* ---- side by side ---- */

/* Frames that are drawn side by side need not wait for each other, and are done sooner than one after
 * the other by as many threads: by a quarter at 640x480, where a picture's stages are short, and
 * still by a few percent at 3200x2400. But each takes the memory of a drawing, about so much: */
static const double bytes_of_pixel = 24, bytes_of_polygon = 80, bytes_in_all = 2147483648.0;

static void choose_jobs(film *f) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const uint32_t all = f->s->threads ? f->s->threads : processors > 0 ? (uint32_t)processors : 1;
    const double pixels = (double)f->drawing.plan.width * f->drawing.plan.height;
    const double bytes = bytes_of_pixel * pixels + bytes_of_polygon * (double)f->polygons;
    const double fitting = fmax(floor(bytes_in_all / bytes), 1);
    f->jobs = f->s->jobs ? f->s->jobs : fitting < all ? (uint32_t)fitting : all;
    if (f->jobs > f->count) f->jobs = f->count;
    f->threads = f->jobs < all ? all / f->jobs : 1;
}

static int draw_frames(film *f) {
    const film_jobs jobs = {
        .frames = f->frames,
        .count = f->count,
        .jobs = f->jobs,
        .bytes = f->pipe_count ? (size_t)f->drawing.plan.width * f->drawing.plan.height * 4 : 0,
        .user = f,
        .begin = begin,
        .draw = draw,
        .ready = ready,
        .take = take};
    signal(SIGPIPE, SIG_IGN);
    return finish(f, film_jobs_run(&jobs));
}

/* ---- what is told ---- */

static void tell(film *f) {
    const tool_settings *const s = f->s;
    film_stats *const t = &f->stats;
    t->jobs = f->jobs, t->threads = f->threads;
    t->width = f->drawing.plan.width, t->height = f->drawing.plan.height;
    t->samples = f->drawing.target.samples;
    const char *const remark = dp_source_remark(f->drawing.source);
    if (remark && !s->quiet) warn_of_model(s, remark);
    if (!s->quiet) warn_dropped(s, &t->dropping), warn_lost(s, &t->dropping);
    if (!s->quiet && t->count && t->empty == t->count)
        tell_empty(s->file_count ? s->files[0] : s->model);
    film_stats_print(s, t, files_standard(s) ? stderr : stdout);
}

static bool check_programs(const tool_settings *s) {
    for (uint32_t k = 0; k < s->file_count; k++)
        if (files_is_film(s, s->files[k]) &&
            !film_pipe_possible(s->files[k], files_format(s, s->files[k])))
            return false;
    return true;
}

static int run(film *f) {
    const tool_settings *const s = f->s;
    if (!check_programs(s)) return EXIT_FAILED;
    int code = open_model(s, &f->drawing.source);
    if (!code) code = film_plan_make(s, f->drawing.source, &f->plan);
    if (!code) code = choose_frames(f);
    if (code || !f->count) return code;
    code = see(f);
    if (code) return code;
    for (uint32_t k = 0; k < s->file_count; k++) f->pipe_count += files_is_film(s, s->files[k]);
    choose_jobs(f);
    warn_formats(f);
    code = draw_frames(f);
    if (!code) tell(f);
    return code;
}

int film_draw(const tool_settings *s) {
    film *const f = calloc(1, sizeof *f);
    if (!f) return wrong_usage("out of memory for a film"), EXIT_FAILED;
    f->s = s;
    const int code = run(f);
    drawing_free(&f->drawing);
    film_plan_free(&f->plan);
    film_stats_free(&f->stats);
    free(f->frames);
    free(f);
    return code;
}
