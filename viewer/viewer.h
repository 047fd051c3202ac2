/* The viewer's whole state, and what can be done to it. */
#ifndef VIEWER_VIEWER_H
#define VIEWER_VIEWER_H

#include "cmdline.h"
#include "free_camera.h"
#include "load.h"
#include "picture.h"
#include "screen.h"

typedef struct GLFWwindow GLFWwindow;

typedef struct viewer {
    GLFWwindow *window;
    screen *screen;
    tool_gl *gl;   /* NULL: not asked for yet, or not there */
    bool gl_taken; /* it has the model as it is now */
    bool gl_drew;  /* it has drawn a picture, or begun to */

    cmdline line;         /* what is seen */
    cmd_options at_start; /* its options at first */
    loaded model;
    load_job *job;   /* NULL: none is read */
    cmdline reading; /* what it reads */

    free_camera camera;
    bool restyle, aim, draw; /* what the next picture needs: options, camera, pixels */
    picture picture;
    picture_quality quality,
        moving_quality; /* of the last picture; of those while something moves */
    double last_move;   /* s */

    bool playing;
    double play_last; /* s: when the time went on last */

    double x, y;                         /* of the pointer, window coordinates */
    double focus_x, focus_y, focus_time; /* where the wheel turned last, and when */
    enum { DRAG_NONE = 0, DRAG_TURN, DRAG_PAN } drag;
    bool panel, help; /* are they shown? */
    int code;         /* exit code: no model could be read */
} viewer;

/* ------- main.c ------- */
double view_now(void);                             /* s */
void view_wake(void);                              /* from any thread: something is to be shown */
void *view_function(void *user, const char *name); /* of OpenGL, in the window's context */

/* ------- actions.c: what keys and panel do; `arg` is the key's ------- */
void act_fit(viewer *v, int arg);
void act_view(viewer *v, int word); /* of --view; 0: the usual one */
void act_ortho(viewer *v, int arg);
void act_play(viewer *v, int arg);
void act_class(viewer *v, int line);
void act_width(viewer *v, int step);
void act_ridge(viewer *v, int degrees);
void act_valley(viewer *v, int degrees);
void act_preset(viewer *v, int step);
void act_look(viewer *v, int step);
void act_hidden(viewer *v, int step);
void act_detail(viewer *v, int step);
void act_xray(viewer *v, int arg);
void act_backend(viewer *v, int arg);
void act_reset(viewer *v, int arg);
void act_save_png(viewer *v, int arg);
void act_save_svg(viewer *v, int arg);
void act_copy(viewer *v, int arg);
void act_panel(viewer *v, int arg);
void act_help(viewer *v, int arg);
void act_close(viewer *v, int arg); /* the help, or the window */
void act_quit(viewer *v, int arg);
void act_turn(viewer *v, int side); /* 0 left, 1 right, 2 up, 3 down */
void act_zoom(viewer *v, int step);

/* Sets an option (NULL takes it away) and draws again. */
void view_set(viewer *v, const char *name, const char *value);
/* Takes the options of a preset (NULL: none) in the place of all that was set of lines and looks. */
void view_preset(viewer *v, const char *name);
/* The same of one that makes another model, which is read again. */
void view_set_model(viewer *v, const char *name, const char *value);
/* Sets the width of a class of lines in pixels. */
void view_set_width(viewer *v, int line, double px);
void view_seek(viewer *v, double time);
/* Makes the camera one that can be moved; false: there is no picture yet. */
bool view_free_camera(viewer *v);
/* The orbit has changed. */
void view_moved(viewer *v);
/* Reads files in the place of the model. */
void view_open(viewer *v, uint32_t count, const char *const *files);
/* Begins to read the command line's models. */
void view_read(viewer *v);
/* Stops reading, if anything is read. */
void view_stop_reading(viewer *v);
/* Takes a model that has been read. */
void view_take(viewer *v);
/* Which of an option's words the settings have, by name. */
const char *view_words(const char *option_name);

/* ------- keys.c ------- */
typedef struct key_row {
    const char *keys, *about; /* as help shows them */
} key_row;
/* What a character or another key (GLFW's number) does. */
void keys_character(viewer *v, unsigned character);
void keys_other(viewer *v, int key);
/* Row number k of the help; false: there are no more. */
bool keys_row(int k, key_row *row);

/* ------- controls.c: what the panel and the other windows in the picture hold ------- */
void controls_show(viewer *v);

#endif
