/* What keys and panel do: each changes words of the command line, and says what the next picture needs. */
#include "viewer.h"

#include "messages.h"
#include "models.h"
#include "panel.h"
#include "report.h"

#include <GLFW/glfw3.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const tool_settings *settings(const viewer *v) { return &v->picture.line.settings; }

/* ------- options ------- */

const char *view_words(const char *option_name) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands >> COMMAND_VIEW & 1 && !strcmp(o->name, option_name)) return o->argument;
    return "";
}

void view_set(viewer *v, const char *name, const char *value) {
    cmdline_set(&v->line.options, name, value);
    v->restyle = true;
}

void view_set_model(viewer *v, const char *name, const char *value) {
    cmdline_set(&v->line.options, name, value);
    view_read(v);
}

/* Word number `index` of some with | between, from 0; false: there are no more. */
static bool word_at(const char *words, int index, char word[32]) {
    for (; index > 0 && *words; index--) {
        words += strcspn(words, "|");
        words += *words == '|';
    }
    snprintf(word, 32, "%.*s", (int)strcspn(words, "|"), words);
    return *words != 0;
}

/* The word `step` further than number `now`, round and round. */
static void next_word(const char *words, int now, int step, char word[32]) {
    int count = 0;
    while (word_at(words, count, word)) count++;
    word_at(words, ((now + step) % count + count) % count, word);
}

/* ------- camera ------- */

bool view_free_camera(viewer *v) {
    return free_camera_begin(&v->camera, &v->line, &v->picture, &v->model);
}

void view_moved(viewer *v) {
    orbit_write(&v->camera.orbit, &v->line.camera);
    v->aim = true;
    v->last_move = view_now();
}

void act_fit(viewer *v, int arg) {
    (void)arg;
    v->aim |= free_camera_fit(&v->camera, &v->line);
}

void act_view(viewer *v, int word) {
    char name[32] = "";
    if (word) word_at(view_words("view"), word - 1, name);
    free_camera_view(&v->camera, &v->line, *name ? name : NULL);
    v->aim = true;
}

void act_ortho(viewer *v, int arg) {
    const bool now = free_camera_is_orthographic(&v->camera, &v->line);
    (void)arg;
    v->aim |= free_camera_project(&v->camera, &v->line, &v->picture, &v->model, !now);
}

void act_turn(viewer *v, int side) {
    static const double right[] = {-1, 1, 0, 0}, down[] = {0, 0, -1, 1};
    const double step = 5.0 / 180;
    if (!view_free_camera(v)) return;
    orbit_turn(&v->camera.orbit, step * right[side], step * down[side]);
    view_moved(v);
}

void act_zoom(viewer *v, int step) {
    if (!view_free_camera(v)) return;
    orbit_zoom(&v->camera.orbit, pow(1.25, step), 0, 0);
    view_moved(v);
}

/* ------- motion ------- */

void view_seek(viewer *v, double time) {
    char text[32];
    dp_diag diag = {0};
    measured seen;
    snprintf(text, sizeof text, "%.3f", time);
    const double rounded = strtod(text, NULL);
    snprintf(text, sizeof text, "%.6g", rounded);
    if (dp_source_set_time(v->model.source, rounded, &diag)) {
        report_failure(NULL, &diag);
        v->playing = false;
        return;
    }
    if (measure_model(settings(v), v->model.source, &seen)) {
        v->playing = false;
        return;
    }
    seen.aspect = 0;
    v->model.seen = seen;
    v->model.time = rounded;
    v->gl_taken = false;
    cmdline_set(&v->line.options, "time", text);
    v->aim = true;
}

void act_play(viewer *v, int arg) {
    (void)arg;
    if (!v->model.source) return;
    if (!v->model.moves) {
        messages_say("Nothing moves in this model; --deform wave would make it");
        return;
    }
    /* a camera that is fitted to each time would shake */
    v->playing = !v->playing && view_free_camera(v);
    if (v->playing) view_moved(v);
    v->play_last = view_now();
}

/* ------- lines ------- */

void act_class(viewer *v, int line) {
    const uint32_t now = settings(v)->style.lines ? settings(v)->style.lines : DP_ALL_LINES;
    const uint32_t set = (now & DP_ALL_LINES) ^ 1u << line;
    char text[128] = "";
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        if (!(set >> k & 1)) continue;
        const size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "%s%s", length ? "," : "",
                 dp_line_name((dp_line)k));
    }
    view_set(v, "lines", set == DP_ALL_LINES ? "all" : set ? text : "none");
}

/* Widths as they were given, and of the classes in `set` as they are in pixels. */
static void write_widths(viewer *v, unsigned set, const double px[DP_LINE_COUNT]) {
    char text[256] = "";
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        const tool_length *const given = &settings(v)->width_of[k];
        const double value = given->halved ? given->value / 2 : given->value;
        const size_t n = strlen(text);
        const char *const comma = n ? "," : "", *const name = dp_line_name((dp_line)k);
        if (set >> k & 1)
            snprintf(text + n, sizeof text - n, "%s%s=%.3g", comma, name, px[k]);
        else if (given->unit == LENGTH_SHARE)
            snprintf(text + n, sizeof text - n, "%s%s=%.4g%%", comma, name, 100 * value);
        else if (given->unit)
            snprintf(text + n, sizeof text - n, "%s%s=%.4g%s", comma, name, value,
                     given->unit == LENGTH_MM ? "mm" : "");
    }
    view_set(v, "width", text);
}

void view_set_width(viewer *v, int line, double px) {
    double all[DP_LINE_COUNT] = {0};
    all[line] = px;
    write_widths(v, 1u << line, all);
}

void act_width(viewer *v, int step) {
    double px[DP_LINE_COUNT];
    if (!v->picture.styled) return;
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        const double now = (double)v->picture.style.line[k].width;
        px[k] = fmin(fmax(step > 0 ? now * 1.25 : now / 1.25, 0.5), 64);
    }
    write_widths(v, (1u << DP_LINE_COUNT) - 1, px);
}

static void set_angle(viewer *v, const char *name, double degrees) {
    char text[32];
    snprintf(text, sizeof text, "%.4g", fmin(fmax(degrees, 1), 359));
    view_set(v, name, text);
}

void act_ridge(viewer *v, int degrees) {
    const double now = settings(v)->ridge_angle;
    set_angle(v, "ridge-angle", (now > 0 ? now : 150) + degrees);
}

void act_valley(viewer *v, int degrees) {
    const double now = settings(v)->valley_angle;
    set_angle(v, "valley-angle", (now > 0 ? now : 210) + degrees);
}

void act_detail(viewer *v, int step) {
    static const char words[] = "auto|exact|2|0.5";
    const char *const now = cmdline_get(&v->line.options, "detail");
    char word[32];
    const int index = now ? word_index(words, now) : 1;
    next_word(words, index ? index - 1 : 0, step, word);
    view_set(v, "detail", word);
    messages_say("Detail: %s", word);
}

void act_hidden(viewer *v, int step) {
    const char *const words = view_words("hidden");
    char word[32];
    const int now = settings(v)->hidden ? settings(v)->hidden : HIDDEN_NONE;
    next_word(words, now - 1, step, word);
    view_set(v, "hidden", word);
    messages_say("Hidden lines: %s", word);
}

void act_xray(viewer *v, int arg) {
    (void)arg;
    view_set(v, "xray", settings(v)->xray > 0 ? NULL : "0.3");
}

/* ------- looks ------- */

void act_look(viewer *v, int step) {
    char word[32];
    const int now = settings(v)->shading ? settings(v)->shading : SHADING_FLAT;
    next_word(view_words("style"), now - 1, step, word);
    view_set(v, "style", word);
    messages_say("Look: %s", word);
}

/* A preset takes the place of what was set of lines and looks before. */
void view_preset(viewer *v, const char *name) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->group == GROUP_LINES || o->group == GROUP_SURFACE || o->group == GROUP_STROKES ||
            o->group == GROUP_EDGE_MAP)
            if (strcmp(o->name, "mirror")) cmdline_set(&v->line.options, o->name, NULL);
    view_set(v, "preset", name);
}

void act_preset(viewer *v, int step) {
    char words[256], word[32];
    const char *const now = cmdline_get(&v->line.options, "preset");
    snprintf(words, sizeof words, "none|%s", view_words("preset"));
    next_word(words, now ? word_index(words, now) - 1 : 0, step, word);
    view_preset(v, strcmp(word, "none") ? word : NULL);
    messages_say("Preset: %s", word);
}

void act_reset(viewer *v, int arg) {
    (void)arg;
    char time[32];
    const char *const now = cmdline_get(&v->line.options, "time");
    snprintf(time, sizeof time, "%s", now ? now : "");
    cmdline_clear(&v->line.options);
    cmdline_copy(&v->line.options, &v->at_start);
    if (*time) cmdline_set(&v->line.options, "time", time);
    v->restyle = true;
}

void act_backend(viewer *v, int arg) {
    dp_diag diag = {0};
    (void)arg;
    if (!v->line.gl && !v->gl) {
        if (gl_adopt(view_function, NULL, &v->gl, &diag)) {
            report_failure(NULL, &diag);
            return;
        }
        v->gl_taken = false;
    }
    v->line.gl = !v->line.gl;
    v->restyle = true;
    messages_say("%s draws", v->line.gl ? gl_device(v->gl) : "The processor");
}

/* ------- saving ------- */

static void new_name(const viewer *v, const char *ending, char name[STEM_BYTES + 16]) {
    char stem[STEM_BYTES];
    model_stem(v->line.model_count ? v->line.models[0] : "drawing", stem);
    for (int n = 1; n < 1000; n++) {
        snprintf(name, STEM_BYTES + 16, "%s-%03d.%s", stem, n, ending);
        if (access(name, F_OK)) return;
    }
}

static void save(viewer *v, const char *ending) {
    char name[STEM_BYTES + 16];
    if (!v->model.source) {
        messages_say("There is no picture to save yet");
        return;
    }
    new_name(v, ending, name);
    if (!access(name, F_OK)) {
        messages_say("%s and all names before it exist; move some away", name);
        return;
    }
    if (picture_save(&v->line, &v->model, v->line.gl ? v->gl : NULL, name))
        messages_say("Saved %s", name);
    v->restyle = true; /* the context of OpenGL holds another picture now */
}

void act_save_png(viewer *v, int arg) {
    (void)arg;
    save(v, "png");
}

void act_save_svg(viewer *v, int arg) {
    (void)arg;
    save(v, "svg");
}

void act_copy(viewer *v, int arg) {
    char stem[STEM_BYTES], name[STEM_BYTES + 8];
    (void)arg;
    if (!v->line.model_count) return;
    model_stem(v->line.models[0], stem);
    snprintf(name, sizeof name, "%s.png", stem);
    char *const text = cmdline_text(&v->line, name);
    if (!text) return;
    glfwSetClipboardString(v->window, text);
    printf("%s\n", text);
    fflush(stdout);
    messages_say("Copied: %s", text);
    free(text);
}

/* ------- the window ------- */

void act_panel(viewer *v, int arg) {
    (void)arg;
    v->panel = !v->panel;
}

static void print_help(void) {
    key_row row;
    for (int k = 0; keys_row(k, &row); k++) printf("  %-14s %s\n", row.keys, row.about);
    fflush(stdout);
}

void act_help(viewer *v, int arg) {
    (void)arg;
    v->help = !v->help;
    if (!panel_exists()) print_help();
}

void act_quit(viewer *v, int arg) {
    (void)arg;
    glfwSetWindowShouldClose(v->window, GLFW_TRUE);
}

void act_close(viewer *v, int arg) {
    if (v->help && panel_exists())
        v->help = false;
    else
        act_quit(v, arg);
}

/* ------- models ------- */

void view_stop_reading(viewer *v) {
    loaded none = {0};
    if (!v->job) return;
    messages_mute(true);
    load_stop();
    if (load_end(v->job, &none))
        loaded_free(&none);
    else if (!v->model.source && !load_was_stopped())
        v->code = EXIT_FAILED; /* it had failed before; a key came between */
    cmdline_free(&v->reading);
    v->job = NULL;
    messages_mute(false);
}

void view_read(viewer *v) {
    view_stop_reading(v);
    v->reading = v->line;
    v->reading.models = NULL, v->reading.model_count = 0;
    cmdline_models(&v->reading, v->line.model_count, (const char *const *)v->line.models);
    cmdline_copy(&v->reading.options, &v->line.options);
    v->reading.camera = (cmd_options){0};
    v->job = load_begin(&v->reading, view_wake);
    if (!v->job) cmdline_free(&v->reading);
}

void view_open(viewer *v, uint32_t count, const char *const *files) {
    cmdline line = v->line;
    line.models = NULL, line.model_count = 0;
    cmdline_models(&line, count, files);
    /* the line's models are changed once these are there */
    char **const models = v->line.models;
    const uint32_t old = v->line.model_count;
    v->line.models = line.models, v->line.model_count = line.model_count;
    const char *const time = cmdline_get(&v->line.options, "time");
    char *const keep = time ? strdup(time) : NULL;
    cmdline_set(&v->line.options, "time", NULL);
    view_read(v);
    if (keep) cmdline_set(&v->line.options, "time", keep);
    free(keep);
    cmdline_models(&v->line, 0, NULL);
    v->line.models = models, v->line.model_count = old;
}

static void name_window(viewer *v) {
    char title[STEM_BYTES + 32];
    const char *const name = v->line.model_count ? settings(v)->model : NULL;
    const char *const slash = name ? strrchr(name, '/') : NULL;
    snprintf(title, sizeof title, "%s%sDrypoint", name ? slash ? slash + 1 : name : "",
             name ? " - " : "");
    glfwSetWindowTitle(v->window, title);
}

static bool same_models(const cmdline *a, const cmdline *b) {
    bool same = a->model_count == b->model_count;
    for (uint32_t k = 0; same && k < a->model_count; k++)
        same = !strcmp(a->models[k], b->models[k]);
    return same;
}

void view_take(viewer *v) {
    loaded next = {0};
    const bool other = !same_models(&v->reading, &v->line);
    const bool first = !v->model.source;
    const bool done = load_end(v->job, &next);
    v->job = NULL;
    if (done) {
        if (other)
            cmdline_models(&v->line, v->reading.model_count,
                           (const char *const *)v->reading.models);
        v->picture.styled = false; /* it borrows from the old one */
        loaded_free(&v->model);
        v->model = next;
        if (!next.moves) cmdline_set(&v->line.options, "time", NULL);
        if (next.moves && !cmdline_get(&v->line.options, "time"))
            cmdline_set(&v->line.options, "time", "0");
        if (other && !first) act_view(v, 0);
        v->playing = false;
        v->gl_taken = false;
        v->restyle = true;
        v->code = 0;
        if (picture_aim(&v->picture, &v->line, &v->model, true)) name_window(v);
        if (first) messages_say("Drag turns it, the wheel zooms, ? lists the keys");
    } else if (first) {
        v->code = EXIT_FAILED;
    }
    cmdline_free(&v->reading);
}
