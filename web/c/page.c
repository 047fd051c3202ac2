/* What the worker can ask for: open models, change options, move the camera, draw, save.
 *
 * As in the viewer, a command line is the only state (viewer/cmdline.h): each function changes its words, and what is drawn
 * and saved comes from parsing them as the program does. Functions that can fail return 0, or else a web_answer, after
 * a message on stderr, which the worker reads; what was seen before stays then.
 *
 * Changes come one by one and are accepted together, or not at all:
 *
 *     web_begin_changes     a copy of the command line
 *     web_change, web_restore   its words
 *     web_accept            parsed, the model opened again if it is made by other options, its style made: then it is
 *                            the page's, else it is forgotten
 *
 * Not handled: films, and other planes than the picture. */
#include "page.h"

#include "models.h"
#include "progress.h"
#include "report.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

page the_page;

static page *const self = &the_page;
static cmdline next; /* with changes that are not accepted yet */
static bool stopped; /* the last work was, by the worker */

/* ------- progress ------- */

/* clang-format off */
EM_JS(int, ask_worker, (double fraction), {
    return Module.tellProgress(fraction);
});
/* clang-format on */

static int hear(double fraction) {
    stopped = ask_worker(fraction) != 0;
    return stopped;
}

static int hear_drawing(void *user, double fraction) {
    (void)user;
    return hear(fraction);
}

static web_answer failed(void) { return stopped ? ANSWER_STOPPED : ANSWER_FAILED; }

/* ------- the beginning ------- */

EMSCRIPTEN_KEEPALIVE void web_begin(uint32_t threads) {
    progress_to(hear);
    self->threads = threads ? threads : 1;
    self->line.width = 1280, self->line.height = 800;
    self->picture.progress = hear_drawing;
}

const option *page_option(const char *name) {
    static const char unfit[] = "passes|backend|shade-texture|strokes";
    if (word_index(unfit, name)) return NULL;
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands >> COMMAND_VIEW & 1 && o->group < GROUP_PROGRAM && !strcmp(o->name, name))
            return cmdline_list(&the_page.line, name) ? o : NULL;
    return NULL;
}

/* ------- command lines ------- */

static bool copy_line(cmdline *to, const cmdline *from) {
    *to = (cmdline){.width = from->width, .height = from->height};
    return cmdline_models(to, from->model_count, (const char *const *)from->models) &&
           cmdline_copy(&to->options, &from->options) && cmdline_copy(&to->camera, &from->camera);
}

/* Puts another in the place of *line, which is freed. */
static void move_line(cmdline *line, cmdline *from) {
    cmdline_free(line);
    *line = *from;
    *from = (cmdline){0};
}

/* Parses it, with some model if there is none yet. */
static bool is_sound(const cmdline *line) {
    static char *some[] = {"shape:cube"};
    cmdline whole = *line;
    parsed p;
    if (!whole.model_count) whole.models = some, whole.model_count = 1;
    const bool sound = cmdline_parse(&whole, NULL, &p);
    if (sound) {
        p.settings.quiet = false;
        options_warn(&p.settings);
    }
    parsed_free(&p);
    return sound;
}

/* ------- models ------- */

/* Does it say which polygons there are? */
static bool makes_model(const option *o) {
    return o->group == GROUP_SECTION || o->group == GROUP_OBJECTS ||
           (o->group == GROUP_MOTION && strcmp(o->name, "time") != 0);
}

static bool same_value(const cmd_options *a, const cmd_options *b, const char *name) {
    uint32_t k = 0, n = 0;
    for (;; k++, n++) { /* both lists' next of that name */
        while (k < a->count && strcmp(a->items[k].name, name) != 0) k++;
        while (n < b->count && strcmp(b->items[n].name, name) != 0) n++;
        if (k == a->count || n == b->count) return k == a->count && n == b->count;
        const char *const one = a->items[k].value, *const other = b->items[n].value;
        if (strcmp(one ? one : "", other ? other : "") != 0) return false;
    }
}

static bool is_another_model(const cmdline *a, const cmdline *b) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (makes_model(o) && !same_value(&a->options, &b->options, o->name)) return true;
    return false;
}

static bool open_line(const cmdline *line, loaded *out) {
    parsed p;
    cmdline plain = *line;
    *out = (loaded){0};
    plain.camera = (cmd_options){0};
    stopped = false;
    const bool done = cmdline_parse(&plain, NULL, &p) && loaded_open(&p.settings, out);
    if (done) warn_coarse(&p.settings, &out->seen.extent);
    parsed_free(&p);
    if (!done) loaded_free(out);
    return done;
}

/* Tells the time of what moves, and no other. */
static void tell_time(cmdline *line, const loaded *model) {
    const char *const now = cmdline_get(&line->options, "time");
    if (!model->moves)
        cmdline_set(&line->options, "time", NULL);
    else if (!now)
        cmdline_set(&line->options, "time", "0");
}

/* Moves the model to the time of the settings, if that is another. */
static bool set_time(loaded *model) {
    const tool_settings *const s = &self->picture.line.settings;
    dp_diag diag = {0};
    measured seen;
    if (!model->moves || !s->has_time || s->time[0] == model->time) return true;
    if (dp_source_set_time(model->source, s->time[0], &diag)) {
        report_failure(NULL, &diag);
        return false;
    }
    if (measure_model(s, model->source, &seen)) return false;
    seen.aspect = 0;
    model->seen = seen;
    model->time = s->time[0];
    return true;
}

/* ------- pictures ------- */

/* Makes style and camera of the command line. */
static bool make_ready(void) {
    const bool restyle = self->restyle || !self->picture.styled, aim = self->aim;
    if (!self->model.source) return false;
    if (!restyle && !aim) return true;
    self->restyle = self->aim = false;
    if (!picture_aim(&self->picture, &self->line, &self->model, restyle)) return false;
    const double time = self->model.time;
    if (!set_time(&self->model)) return false;
    if (time != self->model.time && !picture_aim(&self->picture, &self->line, &self->model, false))
        return false;
    if (self->picture.line.settings.threads == 0)
        self->picture.line.settings.threads = self->threads;
    return true;
}

/* Puts another command line, and another model unless NULL, in the place of the page's, and frees those. False: no picture can
 * be made of them; they are freed, and all is as it was. */
static bool adopt(cmdline *line, loaded *model, bool same_camera) {
    cmdline old_line = self->line;
    loaded old = self->model;
    const free_camera camera = self->camera;
    self->line = *line;
    if (model) self->model = *model;
    if (!same_camera) self->camera.is_free = false;
    self->picture.styled = false; /* it may borrow from the old one */
    self->restyle = true;
    const bool done = !self->model.source || make_ready();
    if (!done) *line = self->line, self->line = old_line, self->camera = camera;
    if (!done && model) *model = self->model, self->model = old;
    if (!done) {
        self->restyle = true;
        if (self->model.source) make_ready();
    }
    cmdline_free(done ? &old_line : line);
    if (model) loaded_free(done ? &old : model);
    if (model && done) loaded_free(&self->draft), self->serial++;
    return done;
}

/* ------- opening ------- */

static bool name_models(cmdline *line, char *names) {
    const char *all[256];
    uint32_t count = 0;
    for (char *rest = names, *name; count < 256 && (name = strtok_r(rest, "\n", &rest));)
        all[count++] = name;
    return cmdline_models(line, count, all);
}

/* The same options for other models, which are seen as is usual; how they are projected stays. */
static bool line_for(char *names, cmdline *line) {
    free_camera camera = self->camera;
    const bool done = copy_line(line, &self->line) && name_models(line, names);
    cmdline_set(&line->options, "time", NULL);
    free_camera_view(&camera, line, NULL);
    return done || wrong_usage("out of memory for the options");
}

/* Opens models of the files that were handed over last, or generated ones: their names, each on a line of its own. */
EMSCRIPTEN_KEEPALIVE web_answer web_open(char *names) {
    cmdline line;
    loaded model = {0};
    bool done = line_for(names, &line) && open_line(&line, &model);
    if (done)
        tell_time(&line, &model);
    else
        cmdline_free(&line);
    done = done && adopt(&line, &model, false);
    if (done)
        files_keep_new();
    else
        files_drop_new();
    return done ? ANSWER_DONE : failed();
}

/* ------- drawing ------- */

/* Draws with a quality (viewer/picture.h); any but the full one of the simplified model, if there is one. */
EMSCRIPTEN_KEEPALIVE web_answer web_draw(int quality) {
    stopped = false;
    if (!make_ready()) return ANSWER_FAILED;
    const bool simple = quality != QUALITY_FULL && self->draft.source;
    const loaded *const model = simple ? &self->draft : &self->model;
    if (picture_draw(&self->picture, model, NULL, (picture_quality)quality)) return ANSWER_DONE;
    return self->picture.stopped ? ANSWER_STOPPED : ANSWER_FAILED;
}

EMSCRIPTEN_KEEPALIVE const uint8_t *web_pixels(void) { return self->picture.rgba; }

/* Of the last picture: width, height, ms, segments; of what can draw: threads, whether there is a draft; of the model: its
 * number, polygons, and whether it moves. */
EMSCRIPTEN_KEEPALIVE const double *web_frame(void) {
    static double numbers[9];
    const picture *const p = &self->picture;
    numbers[0] = p->width, numbers[1] = p->height;
    numbers[2] = p->ms, numbers[3] = (double)p->segments;
    numbers[4] = self->threads, numbers[5] = self->draft.source != NULL;
    numbers[6] = self->serial, numbers[7] = (double)self->model.seen.extent.polygons;
    numbers[8] = self->model.moves;
    return numbers;
}

/* FNV-1a, 64 bits, of the last picture's bytes. */
EMSCRIPTEN_KEEPALIVE const char *web_hash(void) {
    static char text[17];
    const picture *const p = &self->picture;
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t k = 0; k < (size_t)4 * p->width * p->height; k++)
        hash = (hash ^ p->rgba[k]) * 0x100000001b3;
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    return text;
}

EMSCRIPTEN_KEEPALIVE void web_resize(uint32_t width, uint32_t height) {
    self->line.width = width, self->line.height = height;
    self->restyle = true; /* widths may be shares of it */
}

/* ------- the camera ------- */

static bool free_it(void) {
    return make_ready() &&
           free_camera_begin(&self->camera, &self->line, &self->picture, &self->model);
}

static void moved(void) {
    orbit_write(&self->camera.orbit, &self->line.camera);
    self->aim = true;
}

EMSCRIPTEN_KEEPALIVE void web_turn(double right, double down) {
    if (!free_it()) return;
    orbit_turn(&self->camera.orbit, right, down);
    moved();
}

EMSCRIPTEN_KEEPALIVE void web_pan(double right, double down) {
    if (!free_it()) return;
    orbit_pan(&self->camera.orbit, right, down);
    moved();
}

/* About a point that many heights right of and below the middle. */
EMSCRIPTEN_KEEPALIVE void web_zoom(double factor, double right, double down) {
    if (!free_it()) return;
    orbit_zoom(&self->camera.orbit, factor, right, down);
    moved();
}

/* Turns and zooms about what is seen at a point from now on (shares of the picture's size). */
EMSCRIPTEN_KEEPALIVE void web_focus(double right, double down) {
    if (!free_it()) return;
    const loaded *const model = self->draft.source ? &self->draft : &self->model;
    const double depth = picture_depth(&self->picture, model, right, down);
    if (depth > 0) orbit_focus(&self->camera.orbit, depth);
}

EMSCRIPTEN_KEEPALIVE void web_fit(void) {
    if (free_it()) self->aim |= free_camera_fit(&self->camera, &self->line);
}

EMSCRIPTEN_KEEPALIVE web_answer web_view(const char *name) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (!strcmp(o->name, "view") && *name && !word_index(o->argument, name))
            return wrong_usage("there is no view \"%s\"; it is one of %s", name, o->argument),
                   ANSWER_FAILED;
    free_camera_view(&self->camera, &self->line, *name ? name : NULL);
    self->aim = true;
    return ANSWER_DONE;
}

EMSCRIPTEN_KEEPALIVE void web_project(int orthographic) {
    if (make_ready())
        self->aim |= free_camera_project(&self->camera, &self->line, &self->picture, &self->model,
                                         orthographic != 0);
}

/* ------- options ------- */

EMSCRIPTEN_KEEPALIVE web_answer web_begin_changes(void) {
    cmdline_free(&next);
    if (copy_line(&next, &self->line)) return ANSWER_DONE;
    return wrong_usage("out of memory for the options"), ANSWER_FAILED;
}

/* A preset takes the place of what was set of lines and looks before. */
static void clear_look(cmd_options *options) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->group == GROUP_LINES || o->group == GROUP_SURFACE || o->group == GROUP_STROKES ||
            o->group == GROUP_EDGE_MAP)
            if (strcmp(o->name, "mirror") != 0) cmdline_set(options, o->name, NULL);
}

/* An option that a page has not: of the program, perhaps. */
static web_answer unknown(const char *name) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (!strcmp(o->name, name))
            return wrong_usage("option --%s is none of a page", name), ANSWER_FAILED;
    return wrong_usage("unknown option --%s", name), ANSWER_FAILED;
}

/* Sets an option; value NULL takes it away. */
EMSCRIPTEN_KEEPALIVE web_answer web_change(const char *name, const char *value) {
    cmd_options *const list = cmdline_list(&next, name);
    if (!list || !page_option(name)) return unknown(name);
    if (!strcmp(name, "preset")) clear_look(list);
    if (!strcmp(name, "fov")) cmdline_set(list, "ortho", NULL);
    if (!strcmp(name, "ortho")) cmdline_set(list, "fov", NULL);
    cmdline_set(list, name, value);
    return ANSWER_DONE;
}

/* Splits a text into words in its place, as a shell does of what cmdline_text writes; how many there are. */
static int split(char *text, char **words, int most) {
    int count = 0;
    char *to = text;
    while (count < most) {
        while (isspace((unsigned char)*text)) text++;
        if (!*text) break;
        bool quoted = false;
        words[count++] = to;
        for (; *text && (quoted || !isspace((unsigned char)*text)); text++) {
            if (*text == '\'')
                quoted = !quoted;
            else if (!quoted && *text == '\\' && text[1])
                *to++ = *++text;
            else
                *to++ = *text;
        }
        text += *text != 0;
        *to++ = 0;
    }
    return count;
}

/* Are all options ones that a page has? */
static web_answer check_known(const cmd_options *options) {
    for (uint32_t k = 0; k < options->count; k++)
        if (!page_option(options->items[k].name)) return unknown(options->items[k].name);
    return ANSWER_DONE;
}

/* Puts other options, and another camera, in the place of all. */
EMSCRIPTEN_KEEPALIVE web_answer web_restore(char *text) {
    char *words[512];
    cmdline all = {.width = next.width, .height = next.height};
    const int count = split(text, words, 512);
    bool done = cmdline_read(&all, count, words);
    if (!done) wrong_usage("out of memory for the options");
    done = done && !check_known(&all.options) && !check_known(&all.camera);
    if (done && all.model_count) done = wrong_usage("\"%s\" is no option", all.models[0]);
    cmdline_models(&all, next.model_count, (const char *const *)next.models);
    if (done) move_line(&next, &all);
    cmdline_free(&all);
    return done ? ANSWER_DONE : ANSWER_FAILED;
}

static bool is_same_camera(const cmdline *a, const cmdline *b) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->group == GROUP_CAMERA && !same_value(&a->camera, &b->camera, o->name)) return false;
    return true;
}

EMSCRIPTEN_KEEPALIVE web_answer web_accept(void) {
    loaded model = {0};
    cmdline line = next;
    stopped = false;
    if (!is_sound(&next)) return ANSWER_FAILED;
    const bool other = self->model.source && is_another_model(&self->line, &next);
    if (other && !open_line(&next, &model)) return failed();
    next = (cmdline){0};
    if (other) tell_time(&line, &model);
    const bool same_camera = is_same_camera(&self->line, &line);
    return adopt(&line, other ? &model : NULL, same_camera) ? ANSWER_DONE : failed();
}

/* ------- saving ------- */

/* Draws a picture of that size and hands it to the worker: "png", "svg" and so on. */
EMSCRIPTEN_KEEPALIVE web_answer web_save(const char *ending, uint32_t width, uint32_t height) {
    char stem[STEM_BYTES], file[STEM_BYTES + 16], threads[16];
    cmdline line;
    if (!self->model.source) return wrong_usage("there is no picture to save yet"), ANSWER_FAILED;
    stopped = false;
    snprintf(threads, sizeof threads, "%u", self->threads);
    if (copy_line(&line, &self->line)) cmdline_set(&line.options, "threads", threads);
    line.width = width, line.height = height;
    model_stem(line.models[0], stem);
    snprintf(file, sizeof file, "%s.%s", stem, ending);
    const bool done = picture_save(&line, &self->model, NULL, file);
    cmdline_free(&line);
    return done ? ANSWER_DONE : failed();
}
