// What samples show: 1 + triangle, 0 for the paper, ID_FOREIGN.
#if SAMPLES > 1
uniform usampler2DMS ids;
vec2 place_of(int sample_) { return picture.places[sample_].xy; }
#else
uniform usampler2D ids;
vec2 place_of(int sample_) { return vec2(0.5); }
#endif
uint id_at(ivec2 pixel, int sample_) { return texelFetch(ids, pixel, sample_).x; }
bool is_triangle(uint id) { return id != 0u && id != ID_FOREIGN; }
bool is_in_picture(ivec2 p) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(picture.size.xy)));
}
