/* context.h: what we know of a GL context, and the state that a draw call meets. */
#ifndef PRELOAD_CONTEXT_H
#define PRELOAD_CONTEXT_H

#include "mesh.h"
#include "real.h"
#include "settings.h"

/* What becomes of a draw call. */
enum verdict {
    DRAW_WITH_LINES,
    DRAW_UNTOUCHED, /* blended, textured, a wire frame, ... */
    DRAW_ABOVE_ALL, /* untouched, and not depth-tested: the lines so far must be below it */
};

/* The state that lines depend on, as GL says at the draw call. */
struct draw_state {
    float modelview[16], projection[16]; /* columns, as GL has them */
    float viewpoint[4];                  /* homogeneous, eye space */
    int viewport[4], scissor[4];         /* px; scissor is the viewport where there is none */
    float range[2];                      /* glDepthRange */
    int culled; /* 0: none, 1: what is counter-clockwise on the screen, -1: clockwise */
    int fronts; /* 1: what is counter-clockwise is front, -1: clockwise */
};

struct draw {
    struct mesh *mesh; /* shared; NULL: the frame's own */
    size_t first, count;
    struct draw_state state;
};

/* What has been drawn with lines since the depth buffer was cleared. */
struct frame {
    struct mesh *own; /* of draws that are not display lists; NULL until there are any */
    struct draw *draws;
    size_t count, room;
    size_t inked; /* so many draws had their lines drawn */
};

/* GL objects of ours in one context; all 0 until first needed. */
struct painter {
    GLuint paper, lines, cover; /* programs: white surfaces, lines, lines onto the picture */
    GLuint array, buffer, target, depth, coverage;
    size_t buffer_room; /* bytes */
    bool constants;     /* the programs know the settings */
    int width, height;  /* px, of depth and coverage */
    GLint u_modelview, u_projection, u_viewport, u_range, u_viewpoint, u_facing, u_step;
};

struct list_recorder;
struct share_group;

struct context {
    void *handle;
    enum { UNTRIED, CAPABLE, NOT_CAPABLE } ability;
    bool lines;     /* GL_SIL_RIDGE_VALLEY is enabled, or the environment asks */
    bool in_begin;  /* GL is between glBegin and glEnd: may not be asked anything */
    bool papered;   /* our paper program is bound, for the draw call in progress */
    bool recording; /* the draw call in progress gets lines */
    bool stale;     /* something may have changed `state` */
    int list_depth; /* of glCallList within glCallList */
    enum verdict verdict;
    struct draw_state state;
    struct polygon_builder builder;
    struct list_recorder *list; /* the display list that is being compiled */
    struct share_group *share;  /* its display lists */
    struct frame frame;
    struct painter painter;
    GLenum error; /* the program's, that we took while drawing lines */
};

/* The calling thread's current context; NULL when it has none, or no memory. */
struct context *context_current(void);
/* The same, without asking GLX and EGL: only where one of context_current's callers was just before. */
struct context *context_last(void);

/* Before the window system's context `handle` is destroyed, or after one was created. */
void context_forget(void *handle);
void context_shares(void *handle, void *with);

/* Can this context draw lines? Makes our programs at the first call; says why not, once. */
bool context_able(struct context *context);

/* The program asked by glEnable, or the environment does: lines for draws from now on. */
bool context_draws_lines(struct context *context);

/* Reads `state` and `verdict` from GL if they may have changed. */
void context_read_state(struct context *context);

/* Errors of ours must not reach the program, nor may we swallow its own. */
void context_errors_begin(struct context *context);
void context_errors_end(void);

#endif
