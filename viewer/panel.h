/* Controls over the picture, by Dear ImGui (panel.cpp), or none (no_panel.c). The functions between panel_begin and
 * panel_end are those of a simple immediate-mode interface: they are called once a frame, and say what the user did. */
#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct GLFWwindow GLFWwindow;

/* Is there a panel in this build? */
bool panel_exists(void);
/* After the window's callbacks were set, which are called as well. `scale`: of the screen's points. */
bool panel_create(GLFWwindow *window, float scale);
void panel_destroy(void);
/* Does it want what the mouse, or the keyboard, does now? */
bool panel_wants_mouse(void);
bool panel_wants_keys(void);

void panel_begin(void);
void panel_end(void); /* draws it over what the window holds */

/* A window at the left, one in a corner without a frame, one in the middle. */
void panel_side(const char *title, float width);
void panel_note(bool in_middle);
bool panel_box(const char *title); /* false: the user closed it; still call panel_close */
void panel_close(void);            /* ends each of the three */

void panel_text(const char *text);
void panel_faint(const char *text);
void panel_row(const char *left, const char *right);
void panel_line(const char *title); /* a new part; NULL: no title */
void panel_beside(void);            /* what comes next is on the same line */
bool panel_button(const char *label);
bool panel_check(const char *label, bool *value);
/* True when the value has been changed. */
bool panel_slider(const char *label, double *value, double least, double most, const char *format);
/* `words` with | between; *index from 0. */
bool panel_choice(const char *label, const char *words, int *index);
void panel_bar(double fraction, const char *text); /* negative: unknown */

#ifdef __cplusplus
}
#endif
#endif
