// What quads_faces.comp keeps of each triangle.
#include "scene.glsl"
#ifndef FACES_ACCESS
#define FACES_ACCESS readonly
#endif
struct Face {
    vec4 at; // a point of its plane: x, y, d; w, as bits: does it face the eye?
    vec4 slope;
};
layout(std430, binding = 6) FACES_ACCESS buffer Faces { Face faces[]; };
