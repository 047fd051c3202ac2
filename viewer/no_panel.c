/* No panel: the viewer was built without Dear ImGui, and has keys alone. */
#include "panel.h"

bool panel_exists(void) { return false; }
bool panel_create(GLFWwindow *window, float scale) { return (void)window, (void)scale, true; }
void panel_destroy(void) {}
bool panel_wants_mouse(void) { return false; }
bool panel_wants_keys(void) { return false; }
void panel_begin(void) {}
void panel_end(void) {}
void panel_side(const char *title, float width) { (void)title, (void)width; }
void panel_note(bool in_middle) { (void)in_middle; }
bool panel_box(const char *title) { return (void)title, true; }
void panel_close(void) {}
void panel_text(const char *text) { (void)text; }
void panel_faint(const char *text) { (void)text; }
void panel_row(const char *left, const char *right) { (void)left, (void)right; }
void panel_line(const char *title) { (void)title; }
void panel_beside(void) {}
bool panel_button(const char *label) { return (void)label, false; }
bool panel_check(const char *label, bool *value) { return (void)label, (void)value, false; }
bool panel_slider(const char *label, double *value, double least, double most, const char *format) {
    return (void)label, (void)value, (void)least, (void)most, (void)format, false;
}
bool panel_choice(const char *label, const char *words, int *index) {
    return (void)label, (void)words, (void)index, false;
}
void panel_bar(double fraction, const char *text) { (void)fraction, (void)text; }
