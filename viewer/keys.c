/* The keys: one table serves the keyboard, the help in the window and that on the terminal. Characters are those that
 * the layout has, whatever keys they lie on. */
#include "viewer.h"

#include <GLFW/glfw3.h>

typedef struct key {
    unsigned character; /* 0: `key` */
    int key;            /* GLFW's */
    void (*act)(viewer *v, int arg);
    int arg;
    const char *keys, *about; /* NULL: it is told in another row */
} key;

static const key table[] = {
    {0, 0, NULL, 0, "drag", "Turn the model"},
    {0, 0, NULL, 0, "shift + drag", "Move it; the middle button, too"},
    {0, 0, NULL, 0, "wheel", "Zoom to the pointer"},
    {0, 0, NULL, 0, "drop", "Show the dropped files, several as one scene"},
    {'f', 0, act_fit, 0, "f", "Fit the model into the picture"},
    {'1', 0, act_view, VIEW_FRONT, "1 ... 7", "Front, right, top, back, left, bottom, isometric"},
    {'2', 0, act_view, VIEW_RIGHT, NULL, NULL},
    {'3', 0, act_view, VIEW_TOP, NULL, NULL},
    {'4', 0, act_view, VIEW_BACK, NULL, NULL},
    {'5', 0, act_view, VIEW_LEFT, NULL, NULL},
    {'6', 0, act_view, VIEW_BOTTOM, NULL, NULL},
    {'7', 0, act_view, VIEW_ISO, NULL, NULL},
    {'0', 0, act_view, 0, "0", "The view of the beginning"},
    {0, GLFW_KEY_LEFT, act_turn, 0, "arrows", "Turn by five degrees"},
    {0, GLFW_KEY_RIGHT, act_turn, 1, NULL, NULL},
    {0, GLFW_KEY_UP, act_turn, 2, NULL, NULL},
    {0, GLFW_KEY_DOWN, act_turn, 3, NULL, NULL},
    {0, GLFW_KEY_PAGE_UP, act_zoom, 1, "page up, down", "Nearer, farther"},
    {0, GLFW_KEY_PAGE_DOWN, act_zoom, -1, NULL, NULL},
    {'o', 0, act_ortho, 0, "o", "Orthographic or in perspective"},
    {' ', 0, act_play, 0, "space", "Play what moves, or stop it"},
    {0, GLFW_KEY_F1, act_class, DP_LINE_SILHOUETTE, "F1 ... F5",
     "Silhouettes, ridges, valleys, intersections, borders on or off"},
    {0, GLFW_KEY_F2, act_class, DP_LINE_RIDGE, NULL, NULL},
    {0, GLFW_KEY_F3, act_class, DP_LINE_VALLEY, NULL, NULL},
    {0, GLFW_KEY_F4, act_class, DP_LINE_INTERSECTION, NULL, NULL},
    {0, GLFW_KEY_F5, act_class, DP_LINE_BORDER, NULL, NULL},
    {'+', 0, act_width, 1, "+ -", "Wider, narrower lines"},
    {'-', 0, act_width, -1, NULL, NULL},
    {'r', 0, act_ridge, -5, "r R", "Fewer, more ridges (--ridge-angle)"},
    {'R', 0, act_ridge, 5, NULL, NULL},
    {'v', 0, act_valley, 5, "v V", "Fewer, more valleys (--valley-angle)"},
    {'V', 0, act_valley, -5, NULL, NULL},
    {'d', 0, act_detail, 1, "d", "Detail: auto, exact, 2, 0.5"},
    {'h', 0, act_hidden, 1, "h H", "Hidden lines: none, dashed, dotted, thin, solid"},
    {'H', 0, act_hidden, -1, NULL, NULL},
    {'x', 0, act_xray, 0, "x", "See-through surfaces on or off"},
    {'l', 0, act_look, 1, "l L", "Next, previous look of surfaces (--style)"},
    {'L', 0, act_look, -1, NULL, NULL},
    {'p', 0, act_preset, 1, "p P", "Next, previous preset"},
    {'P', 0, act_preset, -1, NULL, NULL},
    {0, GLFW_KEY_BACKSPACE, act_reset, 0, "backspace", "Lines and looks as at the beginning"},
    {'g', 0, act_backend, 0, "g", "Draw by OpenGL or by the processor"},
    {'s', 0, act_save_png, 0, "s", "Save the picture: MODEL-001.png, then -002"},
    {'S', 0, act_save_svg, 0, "S", "Save its lines: MODEL-001.svg"},
    {'c', 0, act_copy, 0, "c", "Copy the command line that draws it, and print it"},
    {0, GLFW_KEY_TAB, act_panel, 0, "tab", "Show or hide the panel"},
    {'?', 0, act_help, 0, "?", "Show or hide this help"},
    {0, GLFW_KEY_ESCAPE, act_close, 0, "escape", "Close the help, or the window"},
    {'q', 0, act_quit, 0, "q", "Close the window"},
};
enum { KEYS = sizeof table / sizeof *table };

void keys_character(viewer *v, unsigned character) {
    for (int k = 0; k < KEYS; k++)
        if (table[k].character == character && table[k].act) {
            table[k].act(v, table[k].arg);
            return;
        }
}

void keys_other(viewer *v, int pressed) {
    for (int k = 0; k < KEYS; k++)
        if (!table[k].character && table[k].key == pressed && table[k].act) {
            table[k].act(v, table[k].arg);
            return;
        }
}

bool keys_row(int number, key_row *row) {
    for (int k = 0; k < KEYS; k++)
        if (table[k].keys && number-- == 0) {
            *row = (key_row){table[k].keys, table[k].about};
            return true;
        }
    return false;
}
