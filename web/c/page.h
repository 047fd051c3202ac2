/* Between the page's worker (web/src/engine/worker.js) and the program's own code.
 *
 * The worker calls the functions that are exported by page.c, state.c, files.c and mesh.c; what they ask of it are
 * members of its Module: tellProgress, tellBytes and so on. */
#ifndef WEB_PAGE_H
#define WEB_PAGE_H

#include "free_camera.h"

#include <emscripten.h>

/* What is seen on the page. Zero is empty. */
typedef struct page {
    cmdline line;
    loaded model;
    loaded
        draft; /* the same with fewer polygons, to be drawn while something moves; no source: there is none */
    picture picture;
    free_camera camera;
    bool restyle, aim; /* what the next picture needs: options, camera */
    uint32_t threads;  /* that draw */
    uint32_t serial;   /* number of the model, from 1 */
} page;

/* There is one page. (page.c) */
extern page the_page;

/* The option that a page may set; NULL: there is none of that name. */
const option *page_option(const char *name);

/* ------- files.c: files that were dropped on the page ------- */

/* Those that came since the last call of either are the page's from now on, and those before are gone; or the other way
 * round. */
void files_keep_new(void);
void files_drop_new(void);

/* What functions that can fail answer; those that stopped were told to by the worker. */
typedef enum web_answer { ANSWER_DONE = 0, ANSWER_FAILED, ANSWER_STOPPED } web_answer;

/* ------- files.c ------- */
int web_file(const char *name, uint8_t *bytes, size_t size);
/* ------- page.c ------- */
void web_begin(uint32_t threads);
web_answer web_open(char *names);
web_answer web_draw(int quality);
const uint8_t *web_pixels(void);
const double *web_frame(void);
const char *web_hash(void);
void web_resize(uint32_t width, uint32_t height);
void web_turn(double right, double down);
void web_pan(double right, double down);
void web_zoom(double factor, double right, double down);
void web_focus(double right, double down);
void web_fit(void);
web_answer web_view(const char *name);
void web_project(int orthographic);
web_answer web_begin_changes(void);
web_answer web_change(const char *name, const char *value);
web_answer web_restore(char *text);
web_answer web_accept(void);
web_answer web_save(const char *ending, uint32_t width, uint32_t height);
/* ------- mesh.c ------- */
web_answer web_mesh(void);
const double *web_mesh_parts(void);
void web_mesh_free(void);
web_answer web_draft(float *positions, size_t vertices, uint32_t *indices, size_t triangles,
                     uint16_t *groups);
/* ------- state.c ------- */
const char *web_info(void);
const char *web_state(void);

#endif
