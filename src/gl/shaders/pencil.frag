// Pixel shader of pencil rendering (Hermosilla and Vázquez 2010, Listing 2.5), as shade/pencil_rows.inc has it.
//
//     for each corner of the triangle that the pixel shows    the angle of its direction of least curvature on the screen
//         look up the stroke texture at screen coordinates turned by it
//     value = mean of these;  tone = value ^ (dark S + O), from a table;  or between two of several textures
//
// PRINTED: by each exact angle. Else angles go in steps, cross-faded half way: neighbours that agree have the same strokes.
#include "gbuffer.glsl"
#include "scene.glsl"

layout(std430, binding = 3) readonly buffer Along { float along[]; };

uniform sampler2DArray tones;
uniform usampler2D powers; // [dark][value]
uniform isampler2D tooth;
uniform vec4 right, up; // world space: the screen's axes
uniform vec4 turns[18]; // cosine and sine of each step of half a turn
uniform float scale;

layout(location = 0) out vec4 color;

const float PI = 3.14159265;
const int TURNS = 18, TOOTH_SIZE = 512;
const float TOOTH = 0.55; // share of graphite that the paper's tooth adds or takes

// The angle of a direction without sign, [0, pi], within 2e-5.
float angle_of(float x, float y) {
    float ax = abs(x), ay = abs(y), most = max(ax, ay);
    precise float z = min(ax, ay) / (most > 0.0 ? most : 1.0), z2 = z * z;
    precise float p =
        z *
        (0.99997726 +
         z2 * (-0.33262347 +
               z2 * (0.19354346 + z2 * (-0.11643287 + z2 * (0.05265332 - z2 * 0.01172120)))));
    float quarter = ay > ax ? PI / 2.0 - p : p;
    return x * y < 0.0 ? PI - quarter : quarter;
}
float angle_at(uint corner) {
    uint v = 3u * corners[corner];
    precise vec3 d = vec3(along[v], along[v + 1u], along[v + 2u]);
    precise float x = right.x * d.x + right.y * d.y + right.z * d.z,
                  y = up.x * d.x + up.y * d.y + up.z * d.z;
    return angle_of(x, y);
}

float sample_tone(vec2 at, float which) {
#ifdef EXACT_LOOKUPS // by four texels in float32, as the CPU does, instead of by the texture unit
    ivec2 size = textureSize(tones, 0).xy;
    vec2 from = floor(at), share = at - from;
#ifdef LOOKUP_STEPS
    share = floor(share * LOOKUP_STEPS + 0.5) / LOOKUP_STEPS;
#endif
    ivec2 low = ivec2(mod(from, vec2(size))), high = ivec2((low.x + 1) % size.x, (low.y + 1) % size.y);
    int z = int(which);
    float a = texelFetch(tones, ivec3(low, z), 0).x, b = texelFetch(tones, ivec3(high.x, low.y, z), 0).x,
          c = texelFetch(tones, ivec3(low.x, high.y, z), 0).x, d = texelFetch(tones, ivec3(high, z), 0).x;
    return mix(mix(a, b, share.x), mix(c, d, share.x), share.y);
#else
    vec2 size = vec2(textureSize(tones, 0).xy);
    return textureLod(tones, vec3((at + 0.5) / size, which), 0.0).x;
#endif
}
// Brightness in two textures (of the tone below, of the one above), 0 to 255, turned by an angle of this cosine and sine. y
// runs down, directions up.
vec2 look_up(vec2 turn, vec2 layer) {
    vec2 pixel = gl_FragCoord.xy * scale;
    precise vec2 at = vec2(pixel.x * turn.x - pixel.y * turn.y, pixel.x * turn.y + pixel.y * turn.x);
    float value = sample_tone(at, layer.x);
    return 255.0 * vec2(value, layer.y == layer.x ? value : sample_tone(at, layer.y));
}

#ifdef PRINTED
// Cosine and sine of an angle in [0, pi], within 1e-7, which not every device's own are.
vec2 turn_of(float angle) {
    float x = angle - PI / 2.0, z = x * x;
    float s = x * (1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z * (1.0 / 362880.0 - z / 39916800.0)))));
    float c = 1.0 + z * (-0.5 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40320.0 + z * (-1.0 / 3628800.0 + z / 479001600.0)))));
    return vec2(-s, c);
}
vec2 mean_of_look_ups(uint triangle, vec2 layer) {
    vec2 sum = vec2(0.0);
    for (uint k = 0u; k < 3u; k++) {
        int parts = int(angle_at(3u * triangle + k) / PI * 65536.0) & 0xffff;
        sum += look_up(turn_of(float(parts) * (PI / 65536.0)), layer);
    }
    return sum / 3.0;
}
#else
// A step, and how much of the next one, of 255.
ivec2 steps_of(float angle) {
    precise float steps = angle * (float(TURNS) / PI);
    int low = int(steps);
    precise float t = min(max((steps - float(low) - 0.5) * 2.5 + 0.5, 0.0), 1.0);
    int part = int(t * t * (3.0 - 2.0 * t) * 255.0 + 0.5);
    if (part == 255) {
        low++;
        part = 0;
    }
    return ivec2(low >= TURNS ? low - TURNS : low, part);
}
int after(int step_) { return step_ + 1 < TURNS ? step_ + 1 : 0; }

vec2 mean_of_look_ups(uint triangle, vec2 layer) {
    ivec2 t[3];
    for (uint k = 0u; k < 3u; k++) t[k] = steps_of(angle_at(3u * triangle + k));
    vec2 sum = vec2(0.0);
    if (t[0].x == t[1].x && t[0].x == t[2].x) { // as most are
        int part = t[0].y + t[1].y + t[2].y;
        sum = look_up(turns[t[0].x].xy, layer) * (float(765 - part) / 765.0);
        if (part > 0) sum += look_up(turns[after(t[0].x)].xy, layer) * (float(part) / 765.0);
        return sum;
    }
    for (int k = 0; k < 3; k++) {
        sum += look_up(turns[t[k].x].xy, layer) * (float(255 - t[k].y) / 765.0);
        if (t[k].y > 0) sum += look_up(turns[after(t[k].x)].xy, layer) * (float(t[k].y) / 765.0);
    }
    return sum;
}
#endif

// The tone's brightness, 0 to 1.
float tone_of(uint triangle, float dark) {
    int count = textureSize(tones, 0).z;
    if (count > 1) {
        float last = float(count - 1), at = min(dark * last, last - 0.001);
        vec2 value = mean_of_look_ups(triangle, vec2(floor(at), floor(at) + 1.0));
        return mix(value.x, value.y, fract(at)) / 255.0;
    }
    float value = mean_of_look_ups(triangle, vec2(0.0)).x;
    ivec2 at = ivec2(int(min(value, 255.0) + 0.5), int(dark * 255.0 + 0.5));
    return float(texelFetch(powers, at, 0).x) / 255.0;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uvec2 what = what_at(p);
    color = vec4(0.0);
    if (id_of(what) == 0u) return;
    color = base_at(p);
    float dark = 1.0 - clamp(dot(geometry_at(p).xyz, shading.light.xyz), 0.0, 1.0);
    float value = tone_of(what.x - 1u, dark);
    ivec2 in_tooth = ivec2(p.x % TOOTH_SIZE, p.y % TOOTH_SIZE);
    float grain = float(texelFetch(tooth, in_tooth, 0).x) / 127.0;
    float graphite = min((1.0 - value) * (1.0 + TOOTH * grain), 1.0) * shading.ink.a;
    color.rgb += (shading.ink.rgb - color.rgb) * graphite;
}
