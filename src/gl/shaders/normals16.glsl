// Unit normals, 16 bits a component: x and y; z, and in its upper half a mark.
vec3 unpack_normal(uvec2 w) {
    ivec2 n = ivec2(w);
    return vec3(bitfieldExtract(n.x, 0, 16), bitfieldExtract(n.x, 16, 16), bitfieldExtract(n.y, 0, 16));
}
uvec2 pack_normal(vec3 n) {
    float l = length(n);
    if (!(l > 0.0 && l < 1e30)) return uvec2(0u);
    uvec3 v = uvec3(ivec3(roundEven(n / l * 32767.0))) & 0xffffu;
    return uvec2(v.x | v.y << 16, v.z);
}
