// A texture of the picture's size, as it is.
uniform sampler2D colors;
layout(location = 0) out vec4 color;
void main() { color = texelFetch(colors, ivec2(gl_FragCoord.xy), 0); }
