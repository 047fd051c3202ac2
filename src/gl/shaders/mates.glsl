// Half-edges, and the table in which they meet (mates.c).
#include "scene.glsl"

layout(std430, binding = 3) buffer Mates { uint mates[]; };
