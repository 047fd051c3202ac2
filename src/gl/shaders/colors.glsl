// The colour of a surface without light: the style's; DP_COLOR_NONE shows the paper.
vec4 surface_color(uint triangle) {
    return picture.surface.a > 0.0 ? picture.surface : picture.paper;
}
// What a sample without a surface shows: the paper, or nothing where the application has drawn something nearer.
vec4 paper_color(uint id) {
    return id == ID_FOREIGN ? vec4(picture.paper.rgb, 0.0) : picture.paper;
}
