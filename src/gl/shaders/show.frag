// The picture, into the application's framebuffer, whose rows run from the bottom up.
uniform sampler2D shown;
uniform ivec2 from; // the picture's lower left corner in the framebuffer
uniform int height;
layout(location = 0) out vec4 color;
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy) - from;
    color = texelFetch(shown, ivec2(p.x, height - 1 - p.y), 0);
}
