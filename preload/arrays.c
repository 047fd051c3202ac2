/* arrays.c: glDrawArrays, glDrawElements and their kin, and glArrayElement.
 *
 * Where the vertices and indices are is asked from GL at the draw call; they are read as GL will read them, out of
 * the program's memory or out of buffer objects (glGetBufferSubData, which makes a GPU wait until
 * it is idle). The draw call itself goes on to GL as it is.
 * Invariant: reading a buffer object never leaves its bounds. In the program's memory there are no bounds to know: an
 * index that would make GL crash makes us crash.
 *
 * Not handled, drawn without lines: primitive restart, instancing, base vertices and indirect draws, and
 * draws of more than MESH_CORNERS_MAX vertices. */
#include "lines.h"
#include "lists.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Bytes of an array: the program's, or a copy of a buffer object's. */
struct bytes {
    const unsigned char *at;
    size_t count; /* SIZE_MAX: unknown */
    void *copy;   /* to free, or NULL */
};

struct vertex_array {
    struct bytes bytes;
    GLint size, type, stride;
};

static GLint integer(GLenum name) {
    GLint value = 0;
    gl.glGetIntegerv(name, &value);
    return value;
}

/* The buffer object bound to target (its name is known) from `offset` on, at most `most` bytes. */
static bool copy_buffer(struct bytes *bytes, GLenum target, size_t offset, size_t most) {
    GLint size = 0;
    gl.glGetBufferParameteriv(target, GL_BUFFER_SIZE, &size);
    GLint mapped = 0;
    gl.glGetBufferParameteriv(target, GL_BUFFER_MAPPED, &mapped);
    if (mapped || size <= 0 || offset >= (size_t)size) return false;
    const size_t count = (size_t)size - offset < most ? (size_t)size - offset : most;
    unsigned char *const copy = malloc(count);
    if (!copy) return false;
    gl.glGetBufferSubData(target, (GLintptr)offset, (GLsizeiptr)count, copy);
    *bytes = (struct bytes){copy, count, copy};
    return true;
}

enum { BUFFER_BYTES_MAX = 256 << 20 };

/* The position array of a vertex buffer object, whose binding is not GL_ARRAY_BUFFER's. */
static bool open_vertex_buffer(struct vertex_array *array, GLint buffer, const void *offset) {
    const GLint bound = integer(GL_ARRAY_BUFFER_BINDING);
    gl.glBindBuffer(GL_ARRAY_BUFFER, (GLuint)buffer);
    const bool good =
        copy_buffer(&array->bytes, GL_ARRAY_BUFFER, (size_t)(uintptr_t)offset, BUFFER_BYTES_MAX);
    gl.glBindBuffer(GL_ARRAY_BUFFER, (GLuint)bound);
    return good;
}

static size_t type_bytes(GLint type) {
    switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
        return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
        return 2;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
        return 4;
    case GL_DOUBLE:
        return 8;
    default:
        return 0;
    }
}

static bool array_open(struct vertex_array *array) {
    GLvoid *pointer = NULL;
    *array = (struct vertex_array){0};
    if (!gl.glIsEnabled(GL_VERTEX_ARRAY)) return false;
    array->size = integer(GL_VERTEX_ARRAY_SIZE);
    array->type = integer(GL_VERTEX_ARRAY_TYPE);
    array->stride = integer(GL_VERTEX_ARRAY_STRIDE);
    gl.glGetPointerv(GL_VERTEX_ARRAY_POINTER, &pointer);
    const size_t bytes = type_bytes(array->type);
    if (!bytes || array->size < 2 || array->size > 4) return false;
    if (!array->stride) array->stride = array->size * (GLint)bytes;
    const GLint buffer = integer(GL_VERTEX_ARRAY_BUFFER_BINDING);
    if (buffer) return open_vertex_buffer(array, buffer, pointer);
    array->bytes = (struct bytes){pointer, SIZE_MAX, NULL};
    return pointer != NULL;
}

static void array_close(struct vertex_array *array) { free(array->bytes.copy); }

static float component(const unsigned char *at, GLint type) {
    union {
        GLshort s;
        GLint i;
        GLfloat f;
        GLdouble d;
    } value;
    memcpy(&value, at, type_bytes(type));
    return type == GL_SHORT    ? (float)value.s
           : type == GL_INT    ? (float)value.i
           : type == GL_DOUBLE ? (float)value.d
                               : value.f;
}

/* False: there is no such vertex. */
static bool array_vertex(const struct vertex_array *array, size_t index, float vertex[4]) {
    const size_t bytes = type_bytes(array->type), at = index * (size_t)array->stride;
    if (array->bytes.count != SIZE_MAX &&
        (at > array->bytes.count || (size_t)array->size * bytes > array->bytes.count - at))
        return false;
    vertex[2] = 0;
    vertex[3] = 1;
    for (int i = 0; i < array->size; i++)
        vertex[i] = component(array->bytes.at + at + (size_t)i * bytes, array->type);
    return true;
}

/* ---- indices ---- */

static bool indices_open(struct bytes *indices, GLenum type, GLsizei count, const void *pointer) {
    const size_t bytes = type_bytes((GLint)type) * (size_t)count;
    *indices = (struct bytes){pointer, bytes, NULL};
    if (!integer(GL_ELEMENT_ARRAY_BUFFER_BINDING)) return pointer != NULL;
    return copy_buffer(indices, GL_ELEMENT_ARRAY_BUFFER, (size_t)(uintptr_t)pointer, bytes) &&
           indices->count == bytes;
}

static size_t index_at(const struct bytes *indices, GLenum type, size_t i) {
    switch (type) {
    case GL_UNSIGNED_BYTE:
        return indices->at[i];
    case GL_UNSIGNED_SHORT: {
        GLushort value;
        memcpy(&value, indices->at + 2 * i, 2);
        return value;
    }
    default: {
        GLuint value;
        memcpy(&value, indices->at + 4 * i, 4);
        return value;
    }
    }
}

/* ---- a draw call ---- */

/* One glDrawArrays (type 0, from `first` on) or glDrawElements. */
struct call {
    GLenum mode, type;
    GLint first;
    GLsizei count;
    const void *indices;
};

static bool call_is_right(const struct call *call) {
    return is_polygon_mode(call->mode) && call->count > 0 && call->first >= 0 &&
           call->count <= MESH_CORNERS_MAX / 3 &&
           (!call->type || call->type == GL_UNSIGNED_BYTE || call->type == GL_UNSIGNED_SHORT ||
            call->type == GL_UNSIGNED_INT);
}

static bool restarts(void) {
    return gl.glIsEnabled(GL_PRIMITIVE_RESTART) || gl.glIsEnabled(GL_PRIMITIVE_RESTART_FIXED_INDEX);
}

static void read_call(struct polygon_builder *builder, const struct call *call,
                      const struct vertex_array *array, const struct bytes *indices) {
    for (size_t i = 0; i < (size_t)call->count; i++) {
        float v[4];
        const size_t index =
            call->type ? index_at(indices, call->type, i) : (size_t)call->first + i;
        if (!array_vertex(array, index, v)) {
            builder->unknown = true;
            return;
        }
        builder_vertex(builder, v[0], v[1], v[2], v[3]);
    }
}

/* Vertices of the call into the builder; it becomes unknown if they cannot be read. */
static void build(struct polygon_builder *builder, const struct call *call) {
    struct vertex_array array;
    struct bytes indices = {0};
    builder_begin(builder, call->mode);
    if (array_open(&array) && !restarts() &&
        (!call->type || indices_open(&indices, call->type, call->count, call->indices)))
        read_call(builder, call, &array, &indices);
    else
        builder->unknown = true;
    free(indices.copy);
    array_close(&array);
}

/* Before GL draws; true: after_call must follow. */
static bool before_call(struct context *context, const struct call *call) {
    if (!context || context->in_begin || !call_is_right(call) || !context_able(context))
        return false;
    if (context->list) {
        list_open_draw(context, call->mode);
        context_errors_begin(context);
        build(list_builder(context), call);
        context_errors_end();
        if (list_only(context)) return true;
    }
    if (!frame_open_draw(context)) return context->list != NULL;
    context_errors_begin(context);
    build(&context->builder, call);
    context_errors_end();
    return true;
}

static void after_call(struct context *context) {
    if (context->list) list_close_draw(context);
    if (context->recording) frame_add_polygons(context);
    frame_close_draw(context);
    context->builder.open = false;
}

EXPORT void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    struct context *const context = context_current();
    const struct call call = {mode, 0, first, count, NULL};
    const bool kept = before_call(context, &call);
    CALL(glDrawArrays, mode, first, count);
    if (kept) after_call(context);
}

EXPORT void glDrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices) {
    struct context *const context = context_current();
    const struct call call = {mode, type, 0, count, indices};
    const bool kept = type != 0 && before_call(context, &call);
    CALL(glDrawElements, mode, count, type, indices);
    if (kept) after_call(context);
}

EXPORT void glDrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
                                const void *indices) {
    struct context *const context = context_current();
    const struct call call = {mode, type, 0, count, indices};
    const bool kept = type != 0 && before_call(context, &call);
    CALL(glDrawRangeElements, mode, start, end, count, type, indices);
    if (kept) after_call(context);
}

/* The same as many calls, says GL; but an error in one of them stops none of the others. */
EXPORT void glMultiDrawArrays(GLenum mode, const GLint *first, const GLsizei *count,
                              GLsizei draws) {
    for (GLsizei i = 0; i < draws; i++) glDrawArrays(mode, first[i], count[i]);
}

EXPORT void glMultiDrawElements(GLenum mode, const GLsizei *count, GLenum type,
                                const void *const *indices, GLsizei draws) {
    for (GLsizei i = 0; i < draws; i++) glDrawElements(mode, count[i], type, indices[i]);
}

EXPORT void glArrayElement(GLint index) {
    struct context *const context = context_current();
    CALL(glArrayElement, index);
    if (!context || index < 0) return;
    struct polygon_builder *const list = list_builder(context);
    const bool in_list = list && list->open;
    if (!in_list && !context->recording) return;
    /* Between glBegin and glEnd GL answers nothing: we cannot know where the array is. */
    if (in_list) list->unknown = true;
    if (context->recording) context->builder.unknown = true;
}
