// What each triangle shows to the eye: that of the polygon it is part of (sides.comp).
struct Side {
    vec3 normal; // unit, as it is wound
    uint kind;
};
const uint SIDE_FRONT = 1u, SIDE_EDGE_ON = 2u, SIDE_NO_AREA = 4u;
