/* context.c: one record for each GL context that draws.
 *
 * Records are found by the window system's handle in a list under a lock; each thread remembers its last
 * one, and asks GLX and EGL which context is current where a draw call begins. A record is used by one
 * thread at a time, as a GL context is. Display lists belong to a share group.
 *
 * Not handled: a context that is destroyed while it is current somewhere lives on in GL until it is
 * released; here it is forgotten at once, and its display lists pass without lines from then on. */
#include "context.h"
#include "lines.h"
#include "lists.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct node {
    struct node *next;
    struct context context;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct node *nodes;
static _Thread_local struct context *last; /* of this thread */
static atomic_uint generation;             /* changes whenever a record goes */
static _Thread_local unsigned last_generation;

static void *current_handle(void) {
    void *const handle = gl.glXGetCurrentContext ? (void *)gl.glXGetCurrentContext() : NULL;
    if (handle || !gl.eglGetCurrentContext) return handle;
    return gl.eglGetCurrentContext();
}

/* Locked. */
static struct context *find_or_make(void *handle) {
    for (struct node *node = nodes; node; node = node->next)
        if (node->context.handle == handle) return &node->context;
    struct node *const node = calloc(1, sizeof *node);
    if (!node) return NULL;
    node->context.handle = handle;
    node->context.stale = true;
    node->context.share = share_group_create();
    if (!node->context.share) {
        free(node);
        return NULL;
    }
    node->next = nodes;
    nodes = node;
    return &node->context;
}

struct context *context_current(void) {
    real_load();
    void *const handle = current_handle();
    if (last && last_generation != atomic_load(&generation)) last = NULL;
    if (last && last->handle == handle) return last;
    if (!handle) return last = NULL;
    pthread_mutex_lock(&lock);
    last = find_or_make(handle);
    last_generation = atomic_load(&generation);
    pthread_mutex_unlock(&lock);
    return last;
}

struct context *context_last(void) {
    return last && last_generation == atomic_load(&generation) ? last : NULL;
}

/* GL deletes the objects of ours together with the context. */
static void context_free(struct context *context) {
    list_recorder_free(context->list);
    builder_free(&context->builder);
    frame_reset(context);
    mesh_release(context->frame.own);
    free(context->frame.draws);
    share_group_release(context->share);
}

void context_forget(void *handle) {
    pthread_mutex_lock(&lock);
    for (struct node **at = &nodes; *at; at = &(*at)->next) {
        struct node *const node = *at;
        if (node->context.handle != handle) continue;
        *at = node->next;
        atomic_fetch_add(&generation, 1);
        context_free(&node->context);
        free(node);
        break;
    }
    pthread_mutex_unlock(&lock);
}

void context_shares(void *handle, void *with) {
    if (!handle || !with) return;
    pthread_mutex_lock(&lock);
    struct context *const other = find_or_make(with);
    struct context *const context = find_or_make(handle);
    if (other && context && context->share != other->share) {
        share_group_release(context->share);
        context->share = share_group_join(other->share);
    }
    pthread_mutex_unlock(&lock);
}

/* "4.5 (Compatibility Profile) Mesa" -> 45; OpenGL ES, and what cannot be read: 0. */
static int version_of(const char *text) {
    if (!text || text[0] < '1' || text[0] > '9' || text[1] != '.') return 0;
    return text[2] >= '0' && text[2] <= '9' ? 10 * (text[0] - '0') + (text[2] - '0') : 0;
}

/* glBegin exists in compatibility profiles alone. */
static bool is_core_profile(void) {
    GLint mask = 0;
    gl.glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &mask);
    return mask & GL_CONTEXT_CORE_PROFILE_BIT;
}

static bool try_context(struct context *context) {
    const char *const text = gl.glGetString ? (const char *)gl.glGetString(GL_VERSION) : NULL;
    if (version_of(text) < 32) {
        say_once(SAY_VERSION,
                 "no lines: they need OpenGL 3.2 with the compatibility profile, here is %.60s",
                 text ? text : "none");
        return false;
    }
    if (is_core_profile()) {
        say_once(SAY_SHADERS, "what the program draws with its own shaders is left as it is");
        return false;
    }
    return lines_create_programs(&context->painter);
}

bool context_able(struct context *context) {
    if (context->ability == UNTRIED && !context->in_begin) {
        context_errors_begin(context);
        context->ability = try_context(context) ? CAPABLE : NOT_CAPABLE;
        context_errors_end();
    }
    return context->ability == CAPABLE;
}

bool context_draws_lines(struct context *context) {
    return (context->lines || settings()->forced) && context_able(context);
}

void context_errors_begin(struct context *context) {
    const GLenum error = gl.glGetError();
    if (error != GL_NO_ERROR && context->error == GL_NO_ERROR) context->error = error;
}

void context_errors_end(void) {
    for (int i = 0; i < 16 && gl.glGetError() != GL_NO_ERROR; i++) continue;
}
