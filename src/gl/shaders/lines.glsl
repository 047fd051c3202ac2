// What the passes of visibility.c hand on to each other.
#include "candidates.glsl"

// A candidate's spine (spine.glsl), and the words of its sample points.
struct Line {
    double a[3], b[3], probe_a[3], probe_b[3];
    uint n, first; // sample points, of 32 a word; the first word, NONE: there are none
    uint asks_back;
    uint free;
};
#ifndef LINES_ACCESS
#define LINES_ACCESS readonly
#endif
layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 5) readonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 6) LINES_ACCESS buffer Lines { Line lines[]; };
layout(std430, binding = 7) buffer Words { uvec2 words[]; }; // candidate, and bits of visible points

uniform uint candidates_room, words_room;

dvec3 vector_of(double v[3]) { return dvec3(v[0], v[1], v[2]); }
double[3] array_of(dvec3 v) { return double[3](v.x, v.y, v.z); }

// Sample point k.
dvec3 probe_of(uint line, uint k) {
    dvec3 a = vector_of(lines[line].probe_a);
    precise dvec3 p = a + (vector_of(lines[line].probe_b) - a) *
                              ((double(k) + 0.5LF) / double(lines[line].n));
    return p;
}
bool is_probe_in_picture(dvec3 p) {
    return p.x >= 0.0LF && p.y >= 0.0LF && p.x < double(picture.size.x) &&
           p.y < double(picture.size.y);
}
