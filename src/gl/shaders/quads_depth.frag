// The depth of faces, into another depth buffer.
#include "depths.glsl"
void main() { gl_FragDepth = depth_at(ivec2(gl_FragCoord.xy), gl_SampleID); }
