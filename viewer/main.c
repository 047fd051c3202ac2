/* drypoint-view: a model in a window.
 *
 *    words → settings → window, context → a thread reads the model
 *    loop:  wait for events → draw what has changed → copy it to the window → controls over it
 *
 * Nothing is drawn while nothing changes. While something moves, pictures that take too long are drawn with less
 * (picture_quality), and whole again when it stands. */
#include "viewer.h"

#include "messages.h"
#include "models.h"
#include "panel.h"
#include "progress.h"
#include "report.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double longest_ms = 27;      /* of a picture, while something moves */
static const double standing_after = 0.2; /* s */

double view_now(void) { return glfwGetTime(); }
void view_wake(void) { glfwPostEmptyEvent(); }

void *view_function(void *user, const char *name) {
    const GLFWglproc found = glfwGetProcAddress(name);
    void *address;
    (void)user;
    memcpy(&address, &found, sizeof address);
    return address;
}

/* ------- events ------- */

static viewer *of(GLFWwindow *window) { return glfwGetWindowUserPointer(window); }

static void on_character(GLFWwindow *window, unsigned character) {
    if (!panel_wants_keys()) keys_character(of(window), character);
}

static void on_key(GLFWwindow *window, int key, int code, int action, int mods) {
    (void)code, (void)mods;
    if (action != GLFW_RELEASE && !panel_wants_keys()) keys_other(of(window), key);
}

static void on_button(GLFWwindow *window, int button, int action, int mods) {
    viewer *const v = of(window);
    glfwGetCursorPos(window, &v->x, &v->y);
    v->drag = DRAG_NONE;
    if (action != GLFW_PRESS || panel_wants_mouse()) return;
    v->drag = button == GLFW_MOUSE_BUTTON_LEFT && !(mods & GLFW_MOD_SHIFT) ? DRAG_TURN : DRAG_PAN;
}

static void on_pointer(GLFWwindow *window, double x, double y) {
    viewer *const v = of(window);
    int width, height;
    glfwGetWindowSize(window, &width, &height);
    const double right = (x - v->x) / fmax(height, 1), down = (y - v->y) / fmax(height, 1);
    v->x = x, v->y = y;
    if (v->drag == DRAG_NONE || !view_free_camera(v)) return;
    if (v->drag == DRAG_TURN)
        orbit_turn(&v->camera.orbit, right, down);
    else
        orbit_pan(&v->camera.orbit, right, down);
    view_moved(v);
}

/* Lets the wheel go to what is seen at the pointer: looked for when it begins to turn, or the pointer has moved. */
static void focus(viewer *v, double right, double down) {
    const bool same = v->focus_x == v->x && v->focus_y == v->y;
    const double time = view_now(), since = time - v->focus_time;
    v->focus_x = v->x, v->focus_y = v->y, v->focus_time = time;
    if (same && since < 1) return;
    const double depth = picture_depth(&v->picture, &v->model, right, down);
    if (depth > 0) orbit_focus(&v->camera.orbit, depth);
}

static void on_wheel(GLFWwindow *window, double x, double y) {
    viewer *const v = of(window);
    int width, height;
    (void)x;
    if (panel_wants_mouse() || !view_free_camera(v)) return;
    glfwGetWindowSize(window, &width, &height);
    glfwGetCursorPos(window, &v->x, &v->y);
    focus(v, v->x / fmax(width, 1), v->y / fmax(height, 1));
    orbit_zoom(&v->camera.orbit, pow(1.15, y), (v->x - 0.5 * width) / fmax(height, 1),
               (v->y - 0.5 * height) / fmax(height, 1));
    view_moved(v);
}

static void on_drop(GLFWwindow *window, int count, const char **files) {
    if (count > 0) view_open(of(window), (uint32_t)count, files);
}

static void on_size(GLFWwindow *window, int width, int height) {
    viewer *const v = of(window);
    if (width < 1 || height < 1) return; /* it is hidden */
    v->line.width = (uint32_t)width, v->line.height = (uint32_t)height;
    v->restyle = true;
}

static void on_error(int code, const char *text) {
    wrong_usage("the window: %s (%#x)", text, code);
}

/* ------- a frame ------- */

static bool is_moving(const viewer *v) {
    return v->playing || view_now() - v->last_move < standing_after;
}

/* The quality that holds the frame rate, from how long the last pictures took. */
static void choose_quality(viewer *v) {
    picture_quality *const q = &v->moving_quality;
    const double ms = v->picture.ms;
    if (v->quality == *q && ms > longest_ms && *q + 1 < QUALITY_COUNT) ++*q;
    if (v->quality == *q && ms < longest_ms / 4 && *q > QUALITY_FULL) --*q;
    v->quality = is_moving(v) ? *q : QUALITY_FULL;
}

/* Uploads the model to the device; false: after a message. */
static bool take_by_gl(viewer *v) {
    dp_diag diag = {0};
    if (v->gl_taken) return true;
    if (gl_take(v->gl, v->model.source, v->playing, &diag))
        return report_failure(NULL, &diag), false;
    return v->gl_taken = true;
}

static void show(viewer *v) {
    int width, height;
    glfwGetFramebufferSize(v->window, &width, &height);
    screen_show(v->screen, width, height);
    controls_show(v);
    glfwSwapBuffers(v->window);
}

static void show_picture(viewer *v) {
    const picture *const p = &v->picture;
    if (p->by_gl)
        screen_borrow(v->screen, gl_framebuffer(v->gl), p->width, p->height);
    else
        screen_upload(v->screen, p->rgba, p->width, p->height);
}

/* Says, before the first picture by OpenGL, why the window may stand still. Twice, as controls settle in the second. */
static void say_compiling(viewer *v) {
    if (v->gl_drew) return;
    v->gl_drew = true;
    messages_say("OpenGL compiles its shaders: some seconds, but only the first time");
    show(v);
    show(v);
}

/* Draws; what OpenGL refuses is drawn by the processor, and so is all that follows until it is asked for again. */
static void draw_picture(viewer *v) {
    v->draw = false;
    if (v->line.gl) say_compiling(v);
    if (v->line.gl && take_by_gl(v) && picture_draw(&v->picture, &v->model, v->gl, v->quality)) {
        show_picture(v);
        return;
    }
    if (v->line.gl) {
        messages_say("The processor draws instead");
        v->line.gl = false;
        v->restyle = true;
        return;
    }
    if (picture_draw(&v->picture, &v->model, NULL, v->quality)) show_picture(v);
}

/* Brings the picture up to date. */
static void update_picture(viewer *v) {
    if (!v->model.source) return;
    if (v->quality && !is_moving(v)) v->draw = true;
    do {
        const bool restyle = v->restyle, aim = v->aim;
        v->restyle = v->aim = false;
        if (restyle || aim) v->draw = picture_aim(&v->picture, &v->line, &v->model, restyle);
        if (!v->draw || !v->picture.styled) return;
        choose_quality(v);
        draw_picture(v);
    } while (v->restyle); /* OpenGL refused */
}

static void go_on_playing(viewer *v) {
    const double now = view_now();
    double time = v->model.time + now - v->play_last;
    if (!v->playing || !v->model.source) return;
    v->play_last = now;
    if (v->model.lasts > 0) time = fmod(time, v->model.lasts);
    view_seek(v, time);
}

static void frame(viewer *v) {
    if (v->job && load_ended(v->job)) view_take(v);
    go_on_playing(v);
    update_picture(v);
    show(v);
}

/* Waits for something to do. Controls settle in the frames after an event. */
static void wait_for_events(viewer *v, int *more) {
    message all[MESSAGES_KEPT];
    const int said = messages_copy(all);
    const bool fresh = said && view_now() - all[said - 1].time < 7;
    if (v->playing || *more > 0) {
        glfwPollEvents();
        --*more;
        return;
    }
    if (v->job)
        glfwWaitEventsTimeout(0.05);
    else if (v->quality)
        glfwWaitEventsTimeout(0.05);
    else if (fresh)
        glfwWaitEventsTimeout(0.5);
    else
        glfwWaitEvents();
    *more = 2;
}

/* ------- --spin ------- */

static bool read_now(viewer *v) {
    while (v->job && !glfwWindowShouldClose(v->window)) {
        glfwWaitEventsTimeout(0.05);
        if (load_ended(v->job)) view_take(v);
    }
    return v->model.source != NULL;
}

/* Turns the model once round; prints the rate, and how much of each frame the picture took. */
static int spin(viewer *v, uint32_t frames) {
    double drawn = 0;
    uint32_t whole = 0;
    if (!v->line.model_count) wrong_usage("--spin needs a model: drypoint view MODEL --spin 100");
    if (!read_now(v)) return EXIT_FAILED;
    update_picture(v);
    if (!view_free_camera(v)) return EXIT_FAILED;
    glfwSwapInterval(0);
    show(v);
    const double start = view_now();
    for (uint32_t k = 0; k < frames; k++) {
        glfwPollEvents();
        orbit_turn(&v->camera.orbit, -2.0 / frames, 0);
        view_moved(v);
        update_picture(v);
        show(v);
        drawn += v->picture.ms;
        whole += v->quality == QUALITY_FULL;
    }
    const double seconds = view_now() - start;
    printf(
        "%.1f frames a second: %u of %u x %u px, %.1f ms each, the picture %.1f of them; %u whole, "
        "%u with fewer samples\n",
        frames / seconds, frames, v->line.width, v->line.height, 1000 * seconds / frames,
        drawn / frames, whole, frames - whole);
    return 0;
}

/* ------- the program ------- */

static GLFWwindow *open_window(uint32_t width, uint32_t height) {
    static const int versions[][2] = {{4, 3}, {3, 3}, {3, 2}};
    GLFWwindow *window = NULL;
    for (size_t k = 0; k < sizeof versions / sizeof *versions && !window; k++) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, versions[k][0]);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, versions[k][1]);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwSetErrorCallback(k + 1 == sizeof versions / sizeof *versions ? on_error : NULL);
        window = glfwCreateWindow((int)width, (int)height, "Drypoint", NULL, NULL);
    }
    glfwSetErrorCallback(on_error);
    return window;
}

/* What fits on the screen, unless a size was asked for. */
static void choose_size(const tool_settings *s, uint32_t *width, uint32_t *height) {
    int x, y, w = 0, h = 0;
    GLFWmonitor *const monitor = glfwGetPrimaryMonitor();
    *width = s->width ? s->width : 1200, *height = s->width ? s->height : 900;
    if (s->width || !monitor) return;
    glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
    if (w > 200 && (uint32_t)w < *width) *width = (uint32_t)w;
    if (h > 200 && (uint32_t)h < *height) *height = (uint32_t)h;
}

/* --size is of pixels; a window may be measured in larger points. */
static void make_size_pixels(GLFWwindow *window, uint32_t width, uint32_t height) {
    int w, h, fw, fh;
    glfwGetWindowSize(window, &w, &h);
    glfwGetFramebufferSize(window, &fw, &fh);
    if (fw > w && w > 0 && fh > 0)
        glfwSetWindowSize(window, (int)width * w / fw, (int)height * h / fh);
}

static void set_callbacks(viewer *v) {
    GLFWwindow *const w = v->window;
    glfwSetWindowUserPointer(w, v);
    glfwSetCharCallback(w, on_character);
    glfwSetKeyCallback(w, on_key);
    glfwSetMouseButtonCallback(w, on_button);
    glfwSetCursorPosCallback(w, on_pointer);
    glfwSetScrollCallback(w, on_wheel);
    glfwSetDropCallback(w, on_drop);
    glfwSetFramebufferSizeCallback(w, on_size);
}

static bool begin_window(viewer *v, const tool_settings *s) {
    uint32_t width, height;
    float scale = 1, other;
    int w, h, points, other_points;
    choose_size(s, &width, &height);
    v->window = open_window(width, height);
    if (!v->window)
        return wrong_usage(
            "no window with OpenGL 3.2 or later can be opened: install a newer driver, try "
            "LIBGL_ALWAYS_SOFTWARE=1, or draw into files: drypoint MODEL -o OUT.png");
    glfwMakeContextCurrent(v->window);
    glfwSwapInterval(1);
    make_size_pixels(v->window, width, height);
    glfwGetFramebufferSize(v->window, &w, &h);
    v->line.width = (uint32_t)(w > 0 ? w : 1), v->line.height = (uint32_t)(h > 0 ? h : 1);
    v->screen = screen_create(view_function);
    if (!v->screen) return wrong_usage("this OpenGL lacks framebuffers; 3.0 or later is needed");
    set_callbacks(v);
    glfwGetWindowContentScale(v->window, &scale, &other);
    glfwGetWindowSize(v->window, &points, &other_points);
    scale *= (float)points / (float)v->line.width; /* where points are large, so are letters */
    v->panel = points >= 700 * scale;
    return panel_create(v->window, scale) || wrong_usage("the panel cannot be made");
}

static int run(viewer *v, const tool_settings *s) {
    int more = 2;
    if (s->backend == BACKEND_GL) act_backend(v, 0);
    if (v->line.model_count) view_read(v);
    if (s->spin) return spin(v, s->spin);
    bool dropped = !s->dropped;
    while (!glfwWindowShouldClose(v->window)) {
        frame(v);
        if (!dropped && !v->job) {
            on_drop(v->window, 1, (const char *[]){s->dropped});
            dropped = true;
        }
        wait_for_events(v, &more);
    }
    view_stop_reading(v); /* which may have failed, and been told so */
    return v->code;
}

static void end(viewer *v) {
    view_stop_reading(v);
    gl_close(v->gl);
    screen_destroy(v->screen);
    panel_destroy();
    picture_free(&v->picture);
    loaded_free(&v->model);
    cmdline_clear(&v->at_start);
    cmdline_free(&v->line);
    if (v->window) glfwDestroyWindow(v->window);
    glfwTerminate();
}

/* Answers --help and --version as the program does. */
static int answer(const tool_settings *s) {
    if (s->question == QUESTION_HELP && !options_help(stdout, s->command, s->topic))
        return EXIT_USAGE;
    if (s->question == QUESTION_VERSION) printf("drypoint %s\n", dp_version());
    return 0;
}

static int view(const tool_settings *s, int count, char **words) {
    static viewer v; /* its plan of pages is large */
    if (!cmdline_read(&v.line, count, words) || !cmdline_copy(&v.at_start, &v.line.options))
        return wrong_usage("out of memory"), EXIT_FAILED;
    glfwSetErrorCallback(on_error);
    int code = EXIT_FAILED;
    if (glfwInit()) {
        messages_begin(view_now, view_wake);
        if (begin_window(&v, s)) code = run(&v, s);
        report_to(NULL);
    } else {
        wrong_usage("no window can be opened: is DISPLAY or WAYLAND_DISPLAY set? Without one, "
                    "drypoint MODEL -o OUT.png "
                    "draws into files");
    }
    end(&v);
    return code;
}

int main(int argc, char **argv) {
    char **const words = calloc((size_t)argc + 2, sizeof *words);
    tool_settings settings;
    dp_diag diag;
    if (!words) return EXIT_FAILED;
    if (dp_version_check(&diag)) return report_failure(NULL, &diag);
    words[0] = (char[]){"drypoint"}, words[1] = (char[]){"view"};
    for (int k = 1; k < argc; k++) words[k + 1] = argv[k];
    const bool sound = options_parse(argc + 1, words, &settings);
    interrupt_install();
    int code = EXIT_USAGE;
    if (sound) code = settings.question ? answer(&settings) : view(&settings, argc - 1, words + 2);
    models_free(&settings);
    option_lists_free(&settings);
    free(words);
    return code;
}
