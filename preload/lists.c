/* lists.c: display lists, compiled into segments so that their polygons can be found again.
 *
 * A list holds calls whose effect depends on the state when it is called, and changes that state on its way. Rather than
 * model that, a list of the program is compiled into several of GL's:
 *
 *     before a call that changes state, if the segment has polygons:     begin another segment
 *     before polygons, if the segment has changes of state:              begin another segment
 *     at glCallList(s), glClear and our token: end the segment, note the call, begin another
 *
 * and glCallList plays them one by one, asking GL for its state before each segment that has polygons, as
 * for any other draw call. The first segment bears the list's own name; a list without polygons and
 * inner calls is that one segment, and is not kept here at all.
 * Invariant: between its polygons a segment changes nothing that struct draw_state holds.
 *
 * Names of the other segments come from a range of their own, far from those that glGenLists gives, since
 * programs may also use names that they never asked for.
 *
 * Not handled: vertices in a list that is called between glBegin and glEnd: that draw has no lines. */
#include "lists.h"
#include "lines.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum item_kind { ITEM_SEGMENT, ITEM_CALL, ITEM_CALLS, ITEM_CLEAR, ITEM_LINES };

struct item {
    enum item_kind kind;
    GLuint name; /* segment: GL's list; call: the program's; clear: its mask; lines: on or off */
    struct mesh *mesh; /* segment: its polygons or NULL */
    GLenum type;       /* calls: as in glCallLists */
    GLsizei count;
    void *names;
};

struct list {
    atomic_int users; /* the table, and who plays it */
    struct list *next;
    GLuint name;
    struct item *items;
    size_t count, room;
    bool opens, closes; /* leaves a glBegin open, has a glEnd for one from outside */
};

struct list_recorder {
    struct list *list;
    GLenum mode;
    GLuint segment;               /* GL's list that is being compiled */
    bool has_polygons, has_state; /* in this segment so far */
    struct mesh *mesh;            /* of this segment */
    struct polygon_builder builder;
};

enum { BUCKETS = 4096, NESTING_MAX = 64 };
enum { SEGMENT_NAMES = 0x3d000000 };

struct share_group {
    atomic_int users;
    pthread_mutex_t lock;
    GLuint next_segment;
    struct list *buckets[BUCKETS];
};

/* Corners in display lists of all contexts; 256 MiB. */
enum { LIST_CORNERS_MAX = 16 << 20 };
static atomic_size_t list_corners;

/* ---- lists ---- */

static void item_free(struct item *item) {
    if (item->mesh) atomic_fetch_sub(&list_corners, item->mesh->count);
    mesh_release(item->mesh);
    free(item->names);
}

static void list_release(struct list *list) {
    if (!list || atomic_fetch_sub(&list->users, 1) != 1) return;
    for (size_t i = 0; i < list->count; i++) item_free(&list->items[i]);
    free(list->items);
    free(list);
}

/* Room for `more` items; without it the calls that ask keep what they have in one segment. */
static bool list_reserve(struct list *list, size_t more) {
    if (list->count + more <= list->room) return true;
    const size_t room = 2 * list->room + more;
    struct item *const grown = realloc(list->items, room * sizeof *grown);
    if (!grown) return false;
    list->items = grown;
    list->room = room;
    return true;
}

/* ---- share groups ---- */

struct share_group *share_group_create(void) {
    struct share_group *const group = calloc(1, sizeof *group);
    if (!group) return NULL;
    atomic_init(&group->users, 1);
    pthread_mutex_init(&group->lock, NULL);
    group->next_segment = SEGMENT_NAMES;
    return group;
}

struct share_group *share_group_join(struct share_group *group) {
    atomic_fetch_add(&group->users, 1);
    return group;
}

void share_group_release(struct share_group *group) {
    if (!group || atomic_fetch_sub(&group->users, 1) != 1) return;
    for (int i = 0; i < BUCKETS; i++)
        while (group->buckets[i]) {
            struct list *const list = group->buckets[i];
            group->buckets[i] = list->next;
            list_release(list);
        }
    pthread_mutex_destroy(&group->lock);
    free(group);
}

/* Where the list of that name hangs, or would hang. Locked. */
static struct list **find_place(struct share_group *group, GLuint name) {
    struct list **at = &group->buckets[name % BUCKETS];
    while (*at && (*at)->name != name) at = &(*at)->next;
    return at;
}

/* To be released; NULL: not one of ours. */
static struct list *find_list(struct share_group *group, GLuint name) {
    pthread_mutex_lock(&group->lock);
    struct list *const list = *find_place(group, name);
    if (list) atomic_fetch_add(&list->users, 1);
    pthread_mutex_unlock(&group->lock);
    return list;
}

static bool is_known(struct share_group *group, GLuint name) {
    struct list *const list = find_list(group, name);
    list_release(list);
    return list != NULL;
}

static void delete_segments(const struct list *list) {
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].kind == ITEM_SEGMENT && list->items[i].name != list->name)
            gl.glDeleteLists(list->items[i].name, 1);
}

/* Takes a list out; `instead` (or NULL) takes its place. */
static void replace_list(struct share_group *group, GLuint name, struct list *instead) {
    pthread_mutex_lock(&group->lock);
    struct list **const place = find_place(group, name);
    struct list *const old = *place;
    if (old) *place = old->next;
    if (instead) {
        instead->next = group->buckets[name % BUCKETS];
        group->buckets[name % BUCKETS] = instead;
    }
    pthread_mutex_unlock(&group->lock);
    if (!old) return;
    delete_segments(old);
    list_release(old);
}

static GLuint new_segment(struct share_group *group) {
    pthread_mutex_lock(&group->lock);
    do group->next_segment++;
    while (gl.glIsList(group->next_segment));
    const GLuint name = group->next_segment;
    pthread_mutex_unlock(&group->lock);
    return name;
}

/* ---- recording ---- */

void list_recorder_free(struct list_recorder *recorder) {
    if (!recorder) return;
    builder_free(&recorder->builder);
    mesh_release(recorder->mesh);
    list_release(recorder->list);
    free(recorder);
}

static struct list_recorder *recorder_create(GLuint name, GLenum mode) {
    struct list_recorder *const recorder = calloc(1, sizeof *recorder);
    struct list *const list = calloc(1, sizeof *list);
    if (!recorder || !list) {
        free(recorder);
        free(list);
        return NULL;
    }
    atomic_init(&list->users, 1);
    list->name = name;
    *recorder = (struct list_recorder){.list = list, .mode = mode, .segment = name};
    return recorder;
}

bool list_only(const struct context *context) {
    return context->list && context->list->mode == GL_COMPILE;
}

struct polygon_builder *list_builder(const struct context *context) {
    return context->list ? &context->list->builder : NULL;
}

/* Ends the segment, whose item there is room for. */
static void end_segment(struct list_recorder *recorder) {
    struct list *const list = recorder->list;
    gl.glEndList();
    if (recorder->mesh) atomic_fetch_add(&list_corners, recorder->mesh->count);
    list->items[list->count++] =
        (struct item){.kind = ITEM_SEGMENT, .name = recorder->segment, .mesh = recorder->mesh};
    recorder->mesh = NULL;
    recorder->has_polygons = recorder->has_state = false;
}

static void next_segment(struct context *context) {
    struct list_recorder *const recorder = context->list;
    recorder->segment = new_segment(context->share);
    gl.glNewList(recorder->segment, recorder->mode);
}

static void break_segment(struct context *context) {
    if (!list_reserve(context->list->list, 1)) return;
    end_segment(context->list);
    next_segment(context);
}

void list_open_draw(struct context *context, GLenum mode) {
    struct list_recorder *const recorder = context->list;
    if (is_polygon_mode(mode) && recorder->has_state) break_segment(context);
    builder_begin(&recorder->builder, mode);
}

void list_close_draw(struct context *context) {
    struct list_recorder *const recorder = context->list;
    if (!recorder->builder.open) {
        recorder->list->closes = true;
        return;
    }
    recorder->has_polygons = recorder->has_polygons || is_polygon_mode(recorder->builder.mode);
    if (!recorder->mesh) recorder->mesh = mesh_create();
    if (atomic_load(&list_corners) + recorder->builder.count > LIST_CORNERS_MAX) {
        say_once(SAY_MEMORY,
                 "display lists of more than %d triangles in all: the others have no lines",
                 LIST_CORNERS_MAX / 3);
        recorder->builder.unknown = true;
    }
    recorder->builder.open = false;
    if (recorder->mesh) builder_end(&recorder->builder, recorder->mesh);
}

void list_state_change(struct context *context) {
    struct list_recorder *const recorder = context->list;
    if (recorder->builder.open) return; /* wrong there, or about lighting */
    if (recorder->has_polygons) break_segment(context);
    recorder->has_state = true;
}

/* Notes what GL shall not compile; takes item.names. False: GL must. */
static bool note_item(struct context *context, struct item item) {
    struct list *const list = context->list->list;
    if (context->list->builder.open || !list_reserve(list, 2)) {
        free(item.names);
        return false;
    }
    end_segment(context->list);
    list->items[list->count++] = item;
    return true;
}

static void play_item(struct context *context, const struct item *item);

/* With GL_COMPILE_AND_EXECUTE it happens now, too; GL compiles nothing at this point. */
static void item_noted(struct context *context, const struct item *item) {
    struct list_recorder *const recorder = context->list;
    if (recorder->mode == GL_COMPILE_AND_EXECUTE) {
        context->list = NULL;
        play_item(context, item);
        context->list = recorder;
    }
    next_segment(context);
}

void list_switch_lines(struct context *context, bool on) {
    const struct item item = {.kind = ITEM_LINES, .name = on};
    if (note_item(context, item)) item_noted(context, &item);
}

bool list_clear(struct context *context, GLbitfield mask) {
    const struct item item = {.kind = ITEM_CLEAR, .name = mask};
    if (!note_item(context, item)) return false;
    item_noted(context, &item);
    return true;
}

EXPORT void glNewList(GLuint name, GLenum mode) {
    struct context *const context = context_current();
    const bool right = context && !context->list && !context->in_begin && name != 0 &&
                       (mode == GL_COMPILE || mode == GL_COMPILE_AND_EXECUTE);
    CALL(glNewList, name, mode);
    if (right && context_able(context)) context->list = recorder_create(name, mode);
}

/* One segment, and nothing in it that we would have to know. */
static bool is_plain(const struct list *list) {
    return list->count == 1 && !(list->items[0].mesh && list->items[0].mesh->count) &&
           !list->opens && !list->closes;
}

EXPORT void glEndList(void) {
    struct context *const context = context_current();
    struct list_recorder *const recorder = context ? context->list : NULL;
    if (!recorder || (context->in_begin && recorder->mode == GL_COMPILE_AND_EXECUTE)) {
        CALL(glEndList);
        return;
    }
    struct list *const list = recorder->list;
    list->opens = recorder->builder.open;
    if (list_reserve(list, 1))
        end_segment(recorder);
    else
        gl.glEndList();
    recorder->list = NULL;
    context->list = NULL;
    context->stale = true;
    list_recorder_free(recorder);
    const bool plain = is_plain(list);
    replace_list(context->share, list->name, plain ? NULL : list);
    if (plain) list_release(list);
}

/* ---- playing ---- */

static void play_list(struct context *context, GLuint name);

static void play_segment(struct context *context, const struct item *item) {
    if (!item->mesh || !item->mesh->count) {
        gl.glCallList(item->name);
        context->stale = true;
        return;
    }
    const bool lines = frame_open_draw(context);
    gl.glCallList(item->name);
    if (lines) frame_add_mesh(context, item->mesh);
    frame_close_draw(context);
}

static GLuint list_offset(GLenum type, const void *names, size_t i) {
    const GLubyte *const b = names;
    switch (type) {
    case GL_BYTE:
        return (GLuint)((const GLbyte *)names)[i];
    case GL_UNSIGNED_BYTE:
        return b[i];
    case GL_SHORT:
        return (GLuint)((const GLshort *)names)[i];
    case GL_UNSIGNED_SHORT:
        return ((const GLushort *)names)[i];
    case GL_INT:
        return (GLuint)((const GLint *)names)[i];
    case GL_UNSIGNED_INT:
        return ((const GLuint *)names)[i];
    case GL_FLOAT:
        return (GLuint)(GLint)((const GLfloat *)names)[i];
    case GL_2_BYTES:
        return b[2 * i] * 256u + b[2 * i + 1];
    case GL_3_BYTES:
        return (b[3 * i] * 256u + b[3 * i + 1]) * 256u + b[3 * i + 2];
    default:
        return ((b[4 * i] * 256u + b[4 * i + 1]) * 256u + b[4 * i + 2]) * 256u + b[4 * i + 3];
    }
}

/* Bytes of each name; 0: no such type. */
static size_t name_bytes(GLenum type) {
    switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
        return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_2_BYTES:
        return 2;
    case GL_3_BYTES:
        return 3;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
    case GL_4_BYTES:
        return 4;
    default:
        return 0;
    }
}

/* Text drawn with one list for each letter goes to GL in one call. */
static void play_lists(struct context *context, GLsizei count, GLenum type, const void *names) {
    GLint base = 0;
    bool any = false;
    gl.glGetIntegerv(GL_LIST_BASE, &base);
    for (GLsizei i = 0; i < count && !any; i++)
        any = is_known(context->share, (GLuint)base + list_offset(type, names, (size_t)i));
    if (!any) {
        gl.glCallLists(count, type, names);
        context->stale = true;
        return;
    }
    for (GLsizei i = 0; i < count; i++)
        play_list(context, (GLuint)base + list_offset(type, names, (size_t)i));
}

static void play_item(struct context *context, const struct item *item) {
    switch (item->kind) {
    case ITEM_SEGMENT:
        play_segment(context, item);
        break;
    case ITEM_CALL:
        play_list(context, item->name);
        break;
    case ITEM_CALLS:
        play_lists(context, item->count, item->type, item->names);
        break;
    case ITEM_CLEAR:
        frame_clear(context, item->name);
        break;
    case ITEM_LINES:
        context->lines = item->name != 0;
        break;
    }
}

/* Between glBegin and glEnd GL may be asked nothing: only the segments are passed on. */
static void play_in_begin(struct context *context, const struct list *list, GLuint name) {
    context->builder.unknown = true;
    if (!list) gl.glCallList(name);
    for (size_t i = 0; list && i < list->count; i++)
        if (list->items[i].kind == ITEM_SEGMENT) gl.glCallList(list->items[i].name);
}

static void play_list(struct context *context, GLuint name) {
    if (context->list_depth >= NESTING_MAX) return;
    struct list *const list = find_list(context->share, name);
    context->list_depth++;
    if (context->in_begin) {
        play_in_begin(context, list, name);
    } else if (!list) {
        gl.glCallList(name);
        context->stale = true;
    } else {
        for (size_t i = 0; i < list->count; i++) play_item(context, &list->items[i]);
    }
    context->list_depth--;
    if (list && list->closes) context->in_begin = false;
    if (list && list->opens) context->in_begin = context->builder.unknown = true;
    list_release(list);
}

EXPORT void glCallList(GLuint name) {
    struct context *const context = context_current();
    if (!context || !context_able(context)) {
        CALL(glCallList, name);
        return;
    }
    const struct item item = {.kind = ITEM_CALL, .name = name};
    if (!context->list) {
        play_list(context, name);
    } else if (note_item(context, item)) {
        item_noted(context, &item);
    } else {
        context->list->builder.unknown = true;
        gl.glCallList(name);
    }
}

/* Names are copied when a list is compiled, as GL does. */
static bool note_calls(struct context *context, GLsizei count, GLenum type, const void *names) {
    const size_t bytes = (size_t)count * name_bytes(type);
    struct item item = {.kind = ITEM_CALLS, .type = type, .count = count, .names = malloc(bytes)};
    if (!item.names) return false;
    memcpy(item.names, names, bytes);
    if (!note_item(context, item)) return false;
    item_noted(context, &item);
    return true;
}

EXPORT void glCallLists(GLsizei count, GLenum type, const void *names) {
    struct context *const context = context_current();
    const bool right =
        context && count > 0 && name_bytes(type) != 0 && names && context_able(context);
    if (right && !context->list && !context->in_begin) {
        play_lists(context, count, type, names);
        return;
    }
    if (right && context->list && note_calls(context, count, type, names)) return;
    if (context && context->list) context->list->builder.unknown = true;
    if (context) context->builder.unknown = true;
    CALL(glCallLists, count, type, names);
}

static void forget_range(struct share_group *group, GLuint first, GLuint count) {
    if (count <= BUCKETS) {
        for (GLuint i = 0; i < count; i++) replace_list(group, first + i, NULL);
        return;
    }
    for (int i = 0; i < BUCKETS; i++)
        for (const struct list *list = group->buckets[i]; list;) {
            const GLuint name = list->name;
            list = list->next;
            if (name - first < count) replace_list(group, name, NULL);
        }
}

EXPORT void glDeleteLists(GLuint first, GLsizei count) {
    struct context *const context = context_current();
    CALL(glDeleteLists, first, count);
    if (context && count > 0 && !context->in_begin)
        forget_range(context->share, first, (GLuint)count);
}
