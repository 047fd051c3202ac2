/* settings.h: what the environment says, and messages. */
#ifndef PRELOAD_SETTINGS_H
#define PRELOAD_SETTINGS_H

#include <stdbool.h>

enum {
    LINES_SILHOUETTE = 1u << 0,
    LINES_RIDGE = 1u << 1,
    LINES_VALLEY = 1u << 2,
    LINES_ALL = LINES_SILHOUETTE | LINES_RIDGE | LINES_VALLEY,
};

/* Colours: red, green, blue in [0, 1]. */
struct settings {
    unsigned lines;         /* which kinds */
    bool forced;            /* also for programs that do not ask */
    bool paper_white;       /* surfaces and background become paper */
    bool textured, blended; /* textured and blended polygons get lines, too */
    float width;            /* px */
    float ridge_angle;      /* theta, degrees */
    float valley_angle;     /* phi, degrees */
    float paper[3];
    float ink[3 /* silhouette, ridge, valley */][3];
};

/* Read from the environment at the first call. */
const struct settings *settings(void);

/* What is said at most once in a process. */
enum message {
    SAY_SHADERS,
    SAY_TEXTURED,
    SAY_BLENDED,
    SAY_FRAMEBUFFER,
    SAY_VERSION,
    SAY_COMPILE,
    SAY_DEPTH,
    SAY_MEMORY,
    SAY_MATRICES,
    SAY_COUNT
};
void say_once(enum message message, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
