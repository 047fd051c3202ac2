// The fold of two polygons at an edge, as core/fold.c has it. Angles are compared by their cosines: of a dihedral angle
// and a threshold T, both in (0, 360) degrees, with the angle of the normals' cosine c,
//
//     convex:  180 - angle <= T   if T >= 180, or c <= -cos T
//     concave: 180 + angle <= T   if T >= 180 and c >= -cos T
#include "scene.glsl"
#include "facing.glsl"
#include "polygons.glsl"

// Cosine and sine of a thousandth of a degree: thresholds allow for so much rounding.
const double ROUNDING_COS = 0.99999999984769130LF, ROUNDING_SIN = 1.7453292519057202e-5LF;

// `cosine`, `sine`: of the threshold.
bool is_at_most(double c, bool concave, double cosine, double sine) {
    double cos_t = cosine * ROUNDING_COS - sine * ROUNDING_SIN,
           sin_t = sine * ROUNDING_COS + cosine * ROUNDING_SIN;
    bool wide = sin_t <= 0.0; // T >= 180
    return concave ? wide && c >= -cos_t : wide || c <= -cos_t;
}
// RIDGE, VALLEY or NONE.
uint line_of_fold(double c, bool concave) {
    if (is_at_most(c, concave, picture.angles.x, picture.angles.y)) return RIDGE;
    return is_at_most(c, concave, picture.angles.z, picture.angles.w) ? NONE : VALLEY;
}

dvec3 normal_at(uint triangle, bool fans) {
    if (!fans) return normal_of(triangle, 3u);
    uint first = first_of(triangle);
    return normal_of(first, corner_count(first));
}

// An edge as the eye sees it (dp_sight_make): unit vectors, each perpendicular to the others.
struct Sight {
    dvec3 along, right, away;
};
bool sight_of(dvec3 a, dvec3 b, out Sight s) {
    s.along = unit(b - a);
    dvec3 right = cross_of(view_vector(a + (b - a) * 0.5), s.along);
    s.right = unit(right);
    s.away = cross_of(s.along, s.right);
    return length(right) > 1e-9;
}
// How steeply a surface with this normal, turned to the eye, recedes to the right (dp_beside_edge).
double recedes(Sight s, dvec3 turned) {
    return dot(turned, s.right) / max(-dot(turned, s.away), 1e-12);
}
