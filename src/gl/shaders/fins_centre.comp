// The projected centre of the box of all vertices (Hermosilla and Vázquez 2010, 2.3.3), as features/silhouette_edge.c finds it.
//
//     BOX       all vertices → box, in the order that keeps that of numbers
//     (centre)  one invocation: box → centre, and how often textures repeat around it
#ifdef BOX
#define COMPUTE 64
#else
#define COMPUTE 1
#endif
#include "scene.glsl"

layout(std430, binding = 5) buffer Centre {
    vec2 centre;
    float half_height, k;
    float repeats[2];
    uint box[6]; // least x, y, z; largest
};

uniform float periods[2]; // of the texture along silhouettes and borders, px
uniform float weight;     // k

// Larger for larger numbers.
uint to_order(float f) {
    uint b = floatBitsToUint(f);
    return (b & 0x80000000u) != 0u ? ~b : b | 0x80000000u;
}
float from_order(uint b) {
    return uintBitsToFloat((b & 0x80000000u) != 0u ? b & 0x7fffffffu : ~b);
}

#ifdef BOX
shared uint least[3], most[3];
void main() {
    uint i = dp_item();
    if (gl_LocalInvocationIndex < 3u) {
        least[gl_LocalInvocationIndex] = 0xFFFFFFFFu;
        most[gl_LocalInvocationIndex] = 0u;
    }
    barrier();
    vec3 p = world_of(min(i, picture.counts.x - 1u));
    float sum = p.x + p.y + p.z;
    if (i < picture.counts.x && sum - sum == 0.0)
        for (int c = 0; c < 3; c++) {
            atomicMin(least[c], to_order(p[c]));
            atomicMax(most[c], to_order(p[c]));
        }
    barrier();
    if (gl_LocalInvocationIndex < 3u) {
        atomicMin(box[gl_LocalInvocationIndex], least[gl_LocalInvocationIndex]);
        atomicMax(box[gl_LocalInvocationIndex + 3u], most[gl_LocalInvocationIndex]);
    }
}
#else
void main() {
    double reach = 0.0lf, radius = double(picture.size.y) / 2.0lf;
    vec3 low, high;
    for (int c = 0; c < 3; c++) {
        low[c] = from_order(box[c]);
        high[c] = from_order(box[c + 3]);
    }
    centre = picture.size.xy / 2.0;
    half_height = picture.size.y / 2.0;
    k = weight;
    ClipPoint middle = to_clip(vec3((dvec3(low) + dvec3(high)) * 0.5lf));
    if (box[0] <= box[3] && middle.c.w > 0.0lf) { // points behind the eye are left out
        dvec3 at = to_screen(middle);
        centre = vec2(at.xy);
        for (int i = 0; i < 8; i++) {
            ClipPoint p = to_clip(vec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                       (i & 4) != 0 ? high.z : low.z));
            if (p.c.w > 0.0lf) reach = max(reach, length(to_screen(p).xy - at.xy));
        }
        if (reach > 0.0lf) radius = reach;
    }
    double around = 2.0lf * 3.14159265358979323846lf * radius * 0.6lf;
    for (int i = 0; i < 2; i++)
        repeats[i] = float(max(1.0lf, floor(around / double(periods[i]) + 0.5lf)));
}
#endif
