/* Samples channels: steps, lines, arcs, Hermite splines (glTF 2.0, appendix C). Invariant: keys
 * ascend and are finite (copy.c). */
#include "scene/sample.h"

#include "base/elementary.h"

#include <math.h>

/* The last key at or before `time`, which is not before the first. */
static uint32_t find_key(const dp_scene_channel *channel, double time) {
    uint32_t low = 0, high = channel->key_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (channel->times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* A key's values: of splines, without the tangents. */
static const float *value_of(const dp_scene_channel *channel, uint32_t key) {
    const size_t width = channel->width;
    if (channel->interpolation == DP_INTERPOLATION_CUBIC)
        return channel->values + (3 * (size_t)key + 1) * width;
    return channel->values + key * width;
}

static void copy(const float *from, uint32_t width, double *to) {
    for (uint32_t k = 0; k < width; k++) to[k] = from[k];
}

static double length_of(const float q[4]) {
    double square = 0;
    for (int k = 0; k < 4; k++) square += (double)q[k] * q[k];
    return sqrt(square);
}

/* Along the arc, the short way (C.4). */
static void slerp(const float a[4], const float b[4], double t, double to[4]) {
    const double lengths = length_of(a) * length_of(b);
    double dot = 0, from_a = 1 - t, from_b = t;
    if (!(lengths > 0)) return copy(a, 4, to);
    for (int k = 0; k < 4; k++) dot += (double)a[k] * b[k];
    const double cosine = fmin(fabs(dot) / lengths, 1), angle = dp_acos(cosine);
    if (angle > 1e-6) { /* below, the arc is a line to the last bit of a float */
        const double sine = dp_sin(angle);
        from_a = dp_sin(angle * (1 - t)) / sine;
        from_b = dp_sin(angle * t) / sine;
    }
    from_a /= length_of(a), from_b /= dot < 0 ? -length_of(b) : length_of(b);
    for (int k = 0; k < 4; k++) to[k] = from_a * a[k] + from_b * b[k];
}

/* C.5; `t` is a share of `seconds`. */
static void spline(const dp_scene_channel *channel, uint32_t key, double t, double seconds,
                   double *to) {
    const size_t width = channel->width;
    const float *const a = value_of(channel, key), *const b = value_of(channel, key + 1);
    const float *const out_of_a = a + width, *const into_b = b - width;
    const double t2 = t * t, t3 = t2 * t;
    for (size_t k = 0; k < width; k++)
        to[k] = (2 * t3 - 3 * t2 + 1) * a[k] + seconds * (t3 - 2 * t2 + t) * out_of_a[k] +
                (3 * t2 - 2 * t3) * b[k] + seconds * (t3 - t2) * into_b[k];
}

bool dp_channel_sample(const dp_scene_channel *channel, double time, double *to) {
    const uint32_t width = channel->width;
    if (!channel->key_count) return false;
    const uint32_t key = time < channel->times[0] ? 0 : find_key(channel, time);
    const bool between = time > channel->times[key] && key + 1 < channel->key_count;
    const float *const a = value_of(channel, key);
    if (!between || channel->interpolation == DP_INTERPOLATION_STEP) {
        copy(a, width, to);
        return true;
    }
    const double seconds = channel->times[key + 1] - channel->times[key];
    const double t = (time - channel->times[key]) / seconds;
    const float *const b = value_of(channel, key + 1);
    if (channel->interpolation == DP_INTERPOLATION_CUBIC)
        spline(channel, key, t, seconds, to);
    else if (channel->path == DP_SCENE_ROTATION)
        slerp(a, b, t, to);
    else
        for (uint32_t k = 0; k < width; k++) to[k] = (1 - t) * a[k] + t * b[k];
    return true;
}
