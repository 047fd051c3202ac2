/* immediate.c: glBegin, glVertex, glEnd, and glRect.
 *
 * Each call goes on to GL as it is. Beside that the vertices are kept, by the context for what is drawn now, and by
 * the list recorder for a display list that is being compiled (with GL_COMPILE_AND_EXECUTE both).
 * Wrong calls (a glBegin in a glBegin, a glVertex outside) are left to GL to report: they keep nothing.
 *
 * Not handled: evaluators (glEvalCoord, glEvalMesh), whose vertices only GL knows: no lines. */
#include "lines.h"
#include "lists.h"
#include "immediate.h"

/* A glBegin that GL will take. */
static bool begin_is_right(const struct context *context, GLenum mode) {
    const struct polygon_builder *const list = list_builder(context);
    return mode <= GL_POLYGON && !context->in_begin && !(list && list->open);
}

EXPORT void glBegin(GLenum mode) {
    struct context *const context = context_current();
    if (!context || !begin_is_right(context, mode)) {
        CALL(glBegin, mode);
        return;
    }
    if (context->list) list_open_draw(context, mode);
    if (!list_only(context)) {
        if (is_polygon_mode(mode)) frame_open_draw(context);
        if (context->recording) builder_begin(&context->builder, mode);
        context->in_begin = true;
    }
    CALL(glBegin, mode);
}

EXPORT void glEnd(void) {
    struct context *const context = context_current();
    CALL(glEnd);
    if (!context) return;
    const struct polygon_builder *const list = list_builder(context);
    if (list && list->open) list_close_draw(context);
    if (!context->in_begin || list_only(context)) return;
    context->in_begin = false;
    if (context->recording) frame_add_polygons(context);
    frame_close_draw(context);
    context->builder.open = false;
}

void immediate_vertex(float x, float y, float z, float w) {
    struct context *const context = context_last();
    if (!context) return;
    builder_vertex(&context->builder, x, y, z, w);
    struct polygon_builder *const list = list_builder(context);
    if (list) builder_vertex(list, x, y, z, w);
}

#define F(value) ((float)(value))
#define DEFINE_VERTEX(letter, type)                                                                \
    EXPORT void glVertex2##letter(type x, type y) {                                                \
        real_load();                                                                               \
        CALL(glVertex2##letter, x, y);                                                             \
        immediate_vertex(F(x), F(y), 0, 1);                                                        \
    }                                                                                              \
    EXPORT void glVertex3##letter(type x, type y, type z) {                                        \
        real_load();                                                                               \
        CALL(glVertex3##letter, x, y, z);                                                          \
        immediate_vertex(F(x), F(y), F(z), 1);                                                     \
    }                                                                                              \
    EXPORT void glVertex4##letter(type x, type y, type z, type w) {                                \
        real_load();                                                                               \
        CALL(glVertex4##letter, x, y, z, w);                                                       \
        immediate_vertex(F(x), F(y), F(z), F(w));                                                  \
    }                                                                                              \
    EXPORT void glVertex2##letter##v(const type *v) {                                              \
        real_load();                                                                               \
        CALL(glVertex2##letter##v, v);                                                             \
        immediate_vertex(F(v[0]), F(v[1]), 0, 1);                                                  \
    }                                                                                              \
    EXPORT void glVertex3##letter##v(const type *v) {                                              \
        real_load();                                                                               \
        CALL(glVertex3##letter##v, v);                                                             \
        immediate_vertex(F(v[0]), F(v[1]), F(v[2]), 1);                                            \
    }                                                                                              \
    EXPORT void glVertex4##letter##v(const type *v) {                                              \
        real_load();                                                                               \
        CALL(glVertex4##letter##v, v);                                                             \
        immediate_vertex(F(v[0]), F(v[1]), F(v[2]), F(v[3]));                                      \
    }
DEFINE_VERTEX(s, GLshort)
DEFINE_VERTEX(i, GLint)
DEFINE_VERTEX(f, GLfloat)
DEFINE_VERTEX(d, GLdouble)

/* glRect is glBegin(GL_POLYGON), four vertices, glEnd, and is passed on as that: GL says they are the same. */
static void rectangle(double x1, double y1, double x2, double y2) {
    glBegin(GL_POLYGON);
    glVertex2d(x1, y1);
    glVertex2d(x2, y1);
    glVertex2d(x2, y2);
    glVertex2d(x1, y2);
    glEnd();
}

#define DEFINE_RECTANGLE(letter, type)                                                             \
    EXPORT void glRect##letter(type x1, type y1, type x2, type y2) { rectangle(x1, y1, x2, y2); }  \
    EXPORT void glRect##letter##v(const type *a, const type *b) {                                  \
        rectangle(a[0], a[1], b[0], b[1]);                                                         \
    }
DEFINE_RECTANGLE(s, GLshort)
DEFINE_RECTANGLE(i, GLint)
DEFINE_RECTANGLE(f, GLfloat)
DEFINE_RECTANGLE(d, GLdouble)
