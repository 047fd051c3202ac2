// How triangles lie to the eye, as core/outline.c decides it: by the area on the screen, or, of those too thin there
// for it to tell, by the angle in space.

const double EDGE_ON = 1.0 / 4096.0; // px: a thinner polygon covers nothing
const double SEEN_EDGE_ON = 1e-3;    // sine

dvec3 view_vector(dvec3 p) {
    return is_perspective() ? normalize(p - picture.eye.xyz) : picture.forward.xyz;
}
// The sine of the angle at which the plane is seen; negative if the triangle faces the eye.
double sine_of(uint triangle) {
    dvec3 n = area_normal(triangle);
    double l = length(n);
    return l > 0.0 ? dot(n / l, view_vector(dvec3(world_of(corners[3u * triangle])))) : 0.0;
}
struct Facing {
    bool front;
    bool edge_on; // too thin on the screen to cover anything
};
Facing facing_in_space(uint triangle, bool edge_on) {
    return Facing(sine_of(triangle) < (edge_on ? -SEEN_EDGE_ON : -1e-12), edge_on);
}
Facing facing_of(uint triangle) {
    vec4 a = screen_of(corners[3u * triangle]), b = screen_of(corners[3u * triangle + 1u]),
         c = screen_of(corners[3u * triangle + 2u]);
    if (is_off_screen(a) || is_off_screen(b) || is_off_screen(c))
        return facing_in_space(triangle, false);
    precise dvec2 u = dvec2(b.xy) - dvec2(a.xy), v = dvec2(c.xy) - dvec2(a.xy);
    precise double area = u.x * v.y - u.y * v.x;
    double reach = max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y)));
    if (abs(area) > double(picture.step_.z) * reach) return Facing(area < 0.0, false);
    return facing_in_space(triangle, abs(area) <= EDGE_ON * reach);
}
bool is_front(uint triangle) { return facing_of(triangle).front; }
