/* A ring of messages behind a lock. */
#include "messages.h"

#include "report.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static message ring[MESSAGES_KEPT];
static unsigned count; /* that have ever been said; ring[k % MESSAGES_KEPT] is number k */
static double (*clock_now)(void);
static void (*wake_up)(void);
static bool muted;

void messages_mute(bool mute) {
    pthread_mutex_lock(&lock);
    muted = mute;
    pthread_mutex_unlock(&lock);
}

static void keep(const char *text) {
    pthread_mutex_lock(&lock);
    if (!muted) {
        message *const m = &ring[count++ % MESSAGES_KEPT];
        snprintf(m->text, sizeof m->text, "%s", text);
        m->time = clock_now ? clock_now() : 0;
    }
    pthread_mutex_unlock(&lock);
    if (wake_up) wake_up();
}

void messages_begin(double (*now)(void), void (*wake)(void)) {
    clock_now = now;
    wake_up = wake;
    report_to(keep);
}

void messages_say(const char *format, ...) {
    char text[MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    keep(text);
}

int messages_copy(message out[MESSAGES_KEPT]) {
    pthread_mutex_lock(&lock);
    const unsigned n = count < MESSAGES_KEPT ? count : MESSAGES_KEPT;
    for (unsigned k = 0; k < n; k++) out[k] = ring[(count - n + k) % MESSAGES_KEPT];
    pthread_mutex_unlock(&lock);
    return (int)n;
}
