// The mirror's plane, and where the mesh stands (mirror.c).
layout(std140, binding = 1) uniform Reflection {
    dvec4 placement[3]; // rows: the mesh's own space to the scene's
    dvec4 plane;        // n·p = w, scene space
};
uniform uint is_placed;

double side_of(vec3 p) {
    precise double s = plane.x * double(p.x) + plane.y * double(p.y) + plane.z * double(p.z) - plane.w;
    return s;
}
