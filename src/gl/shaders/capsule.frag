// How far a pixel is covered by a stroke, as far as nothing hides it (sink/cover.inc): in its class's channel.
#include "picture.glsl"
#include "ids.glsl"
#include "depths.glsl"

uniform uint cuts; // bit 0: surfaces hide strokes, bit 1: so does what the application has drawn

flat in vec3 a, along;
flat in float half_width;
flat in uint line;
flat in vec3 planes[2];

layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;

const float SLOPE = 8.0; // DP_STROKE_SLOPE

// The depth from which on something hides the stroke: x, a surface (dp_stroke_limit); y, anything else.
vec2 limits_at(vec2 p, float t, float distance) {
    float spine = a.z + along.z * t, step = depth_steps(spine, 1.0);
    float rounded = line == SILHOUETTE ? sqrt(picture.size.y * distance) : 0.0;
    float limit = spine + step * (2.0 + SLOPE * distance + rounded);
    for (int i = 0; i < 2; i++) {
        vec3 q = planes[i];
        float own = q.x + q.y * p.x + q.z * p.y + 0.5 * (abs(q.y) + abs(q.z)) + 2.0 * step;
        if (own > limit) limit = own; // not where it is NaN
    }
    return vec2(limit, spine + 2.0 * step) * depth_range.x + depth_range.y;
}

bool is_hidden(ivec2 pixel, int sample_, vec2 limit) {
    float z = depth_at(pixel, sample_);
    if (z <= min(limit.x, limit.y) || z == 0.0) return false;
    if (cuts == 1u) return z > limit.x; // numbers need not be looked at
    bool foreign = id_at(pixel, sample_) == ID_FOREIGN;
    return foreign ? z > limit.y : (cuts & 1u) != 0u && z > limit.x;
}

// The share of the pixel's samples that is not hidden.
float share_behind(vec2 p, float t, float distance) {
    vec2 limit = limits_at(p, t, distance);
    int sum = SAMPLES;
    for (int i = 0; i < SAMPLES; i++) sum -= int(is_hidden(ivec2(p), i, limit));
    return float(sum) / float(SAMPLES);
}

void main() {
    vec2 p = gl_FragCoord.xy, from = p - a.xy;
    float length2 = dot(along.xy, along.xy);
    float t = length2 > 0.0 ? clamp(dot(from, along.xy) / length2, 0.0, 1.0) : 0.0;
    float distance = length(from - t * along.xy);
    float share = clamp(min(distance + 0.5, half_width) - max(distance - 0.5, -half_width), 0.0, 1.0);
    if (share <= 0.0) discard;
    if (cuts != 0u) share *= share_behind(p, t, distance);
    vec4 channel = vec4(equal(uvec4(line & 3u), uvec4(0, 1, 2, 3))) * share;
    first = line < 4u ? channel : vec4(0.0);
    second = line < 4u ? vec4(0.0) : channel;
}
