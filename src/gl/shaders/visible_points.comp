// Which sample points are visible: a word of them.
#define COMPUTE 64
#include "hide.glsl"
#include "lines.glsl"

bool is_back_seen(vec2 at) {
    ivec2 p = ivec2(floor(at - 0.5));
    for (int n = 0; n < 4 * SAMPLES; n++) {
        int k = n / SAMPLES;
        ivec2 q = p + ivec2(k & 1, k >> 1);
        uint id = is_in_picture(q) ? id_at(q, n % SAMPLES) : 0u;
        if (!is_triangle(id)) continue;
        vec4 a = screen_of(corners[3u * id - 3u]), b = screen_of(corners[3u * id - 2u]),
             c = screen_of(corners[3u * id - 1u]);
        float area = cross2(b.xy - a.xy, c.xy - a.xy);
        if (area > 0.0 || area != area) return true;
    }
    return false;
}

bool is_visible(uint line, uint k, uint a, uint b) {
    dvec3 p = probe_of(line, k);
    uint hider;
    if (!is_probe_in_picture(p)) return false;
    return !is_hidden(query_of(vec2(p.xy), limit_at(p.z), a, b), hider) &&
           (lines[line].asks_back == 0u || is_back_seen(vec2(p.xy)));
}

void main() {
    uint w = dp_item();
    if (w >= min(counters[7], words_room)) return;
    uint line = words[w].x;
    if (lines[line].first == NONE) return;
    Candidate c = candidates[line];
    uint bits = 0u, first = 32u * (w - lines[line].first), last = min(min(first + 32u, lines[line].n), c.k1);
    for (uint k = max(first, c.k0); k < last; k++)
        if (is_visible(line, k, c.a, c.b)) bits |= 1u << (k - first);
    words[w].y = bits;
}
