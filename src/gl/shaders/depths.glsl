// Depth of samples, as the window has it: d * depth_range.x + depth_range.y, and 0 where there is no surface.
#if SAMPLES > 1
uniform sampler2DMS depths;
#else
uniform sampler2D depths;
#endif
uniform vec2 depth_range;
float depth_at(ivec2 pixel, int sample_) { return texelFetch(depths, pixel, sample_).x; }
