// Puts the samples' ink into the picture: over the samples' surface or paper; LAYERED: over the shaded picture, as a layer of 8
// bits, as printed/quads_put.c and shade/compose.c do. ONCE: of the one pass.
#include "quads_faces.glsl"
#include "ids.glsl"
#include "colors.glsl"
#include "depths.glsl"
#include "over.glsl"

const float SPARE = 4.0; // a silhouette is not inked on a back face that is less than so many widths behind
layout(location = 0) out vec4 color;
#if SAMPLES > 1
uniform usampler2DMS lines, trapped;
uniform sampler2DMS line_depths;
#else
uniform usampler2D lines, trapped;
uniform sampler2D line_depths;
#endif
#ifdef LAYERED
uniform sampler2D under;
#endif
#ifdef ONCE
#define STATE_ACCESS readonly
#include "quads_state.glsl"
#endif

// Is the back face that is seen at the sample closely behind the silhouette?
bool is_spared(ivec2 p, int i, float window) {
    uint id = id_at(p, i);
    if (!is_triangle(id) || floatBitsToUint(faces[id - 1u].at.w) != 0u) return false;
    float surface = depth_at(p, i),
          d = (surface - depth_range.y) / depth_range.x,
          px = SPARE * picture.widths[SILHOUETTE].x,
          close = px * (d * picture.step_.x + picture.step_.y);
    return (window - surface) / depth_range.x < close;
}

// 1 + the class of a sample's ink, or 0.
uint ink_at(ivec2 p, int i) {
#ifdef ONCE
    uint state = states[place_in_states(p, i)], ink = ink_of_state(state);
    float window = window_of_state(state);
#else
    uint ink = texelFetch(lines, p, i).x;
    float window = texelFetch(line_depths, p, i).x;
    if (ink == 0u) return texelFetch(trapped, p, i).x;
#endif
    return ink == SILHOUETTE + 1u && is_spared(p, i, window) ? 0u : ink;
}

vec4 premultiplied(vec4 c) { return vec4(c.rgb * c.a, c.a); }

// The colour beneath a sample's ink.
vec4 beneath(ivec2 p, int i) {
#ifdef LAYERED
    return vec4(0.0);
#else
    uint id = id_at(p, i);
    return premultiplied(is_triangle(id) ? surface_color(id - 1u) : paper_color(id));
#endif
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0); // premultiplied
    bool any_ink = false;
    for (int i = 0; i < SAMPLES; i++) {
        uint ink = ink_at(p, i);
        vec4 over = ink != 0u ? premultiplied(picture.colors[ink - 1u]) : vec4(0.0);
        any_ink = any_ink || ink != 0u;
        sum += over + beneath(p, i) * (1.0 - over.a);
    }
    if (!any_ink) discard;
    color = vec4(sum.a > 0.0 ? sum.rgb / sum.a : picture.paper.rgb, sum.a / float(SAMPLES));
#ifdef LAYERED
    color = floor(color * 255.0 + 0.5) / 255.0;
    color = lay_over(texelFetch(under, p, 0), color, 1.0);
#endif
}
