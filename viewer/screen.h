/* Pixels on the window: a texture that is copied to it, larger or smaller if need be. */
#ifndef VIEWER_SCREEN_H
#define VIEWER_SCREEN_H

#include <stdbool.h>
#include <stdint.h>

typedef struct screen screen;

/* In the current context; NULL: OpenGL is too old, or memory is out. `function` gives the addresses of its functions. */
screen *screen_create(void *(*function)(void *user, const char *name));
void screen_destroy(screen *s); /* NULL allowed */
/* Takes a picture: [height][width][4], rows from top to bottom. */
void screen_upload(screen *s, const uint8_t *rgba, uint32_t width, uint32_t height);
/* Takes another's framebuffer, whose first row is the lowest, for what is shown from now on. */
void screen_borrow(screen *s, uint32_t framebuffer, uint32_t width, uint32_t height);
/* Fills the window with the picture last taken, or with white. */
void screen_show(const screen *s, int width, int height);

#endif
