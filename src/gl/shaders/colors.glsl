// The colour of a surface without light: the style's; DP_COLOR_NONE shows the paper.
vec4 surface_color(uint triangle) {
    return picture.surface.a > 0.0 ? picture.surface : picture.paper;
}
