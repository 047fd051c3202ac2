// Where the stencil buffer counts polygons that are trapped: the line's class.
#include "picture.glsl"
#include "ids.glsl"
uniform uint line;
layout(location = 0) out uint ink;
void main() {
    if (!is_triangle(id_at(ivec2(gl_FragCoord.xy), gl_SampleID))) discard;
    ink = line + 1u;
}
