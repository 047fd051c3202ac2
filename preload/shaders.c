/* shaders.c: the three programs, and in them the whole geometry of the lines.
 *
 * Raskar (2001) adds polygons in a "primitive shader": that is the geometry shader below. For each edge of each
 * triangle T it makes the planes of the paper's polygons through that edge:
 *
 *   silhouettes (2.1)  T's own plane, continued beyond the edge, where T faces away
 *   ridges (2.2)       a plane at the dihedral angle theta to T, where T faces the viewer
 *   valleys (2.3)      a plane at the angle phi to T, likewise
 *
 * and one band around the edge's projection that covers all of them. The paper shows or hides its
 * polygons by depth tests as they are drawn, valleys by an interval between two depth buffers. Here the
 * lines come when the surfaces are finished, so a texture holds the depth z1 of what is seen, and each test is
 * an inequality in the fragment shader; the interval is z1 < z < z1 + trap. Depth is asked beside the edge,
 * REACH pixels outside and inside, at the centres of pixels, where both planes and z1 are exact: a
 * line's whole width, on both sides of the edge and with round ends, takes one answer, so it is smooth
 * and does not depend on how wide it is.
 *
 * In the notation below: window coordinates are px from the lower left corner; z is window depth, 0 near, 1 far;
 * a plane is z = z0 + dot(gradient, q - p0). "unit" is the change of depth over a way to the viewer as
 * long as a pixel is wide: the scale in which slopes are compared.
 *
 * Not handled: a neighbour that is narrower than REACH pixels on the screen (its depth is not seen), and two edges of
 * different bodies that coincide. */
#include "shaders.h"

/* Surfaces as paper. The position is the fixed pipeline's own. */
const char shader_paper_vertex[] = "#version 120\n"
                                   "void main() {\n"
                                   "    gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;\n"
                                   "    gl_Position = ftransform();\n"
                                   "}\n";
const char shader_paper_fragment[] = "#version 120\n"
                                     "uniform vec4 paper;\n"
                                     "void main() { gl_FragColor = paper; }\n";

const char shader_lines_vertex[] = "#version 150 compatibility\n"
                                   "in vec4 corner; /* x, y, z and whether an edge begins here */\n"
                                   "uniform mat4 modelview;\n"
                                   "out vec3 eye;\n"
                                   "out float edge;\n"
                                   "void main() {\n"
                                   "    eye = (modelview * vec4(corner.xyz, 1.0)).xyz;\n"
                                   "    edge = corner.w;\n"
                                   "    gl_Position = vec4(0.0);\n"
                                   "}\n";

/* Depth as an affine function of the window: for a point p0 of the plane with homogeneous window
 * coordinates (X, Y, Z, w) and eye-space directions u, v in it, relative(u) is what moving along u adds to
 * (X - x0 w, Y - y0 w, Z - z0 w), which is linear in u, also across the plane of the eye. The
 * gradient g solves dot(g, relative(u).xy) = relative(u).z, and the same for v. */
const char shader_lines_geometry[] =
    "#version 150 compatibility\n"
    "layout(triangles) in;\n"
    "layout(triangle_strip, max_vertices = 12) out;\n"
    "in vec3 eye[];\n"
    "in float edge[];\n"
    "uniform mat4 projection;\n"
    "uniform vec4 viewport;  /* x, y, width, height */\n"
    "uniform vec2 range;     /* glDepthRange */\n"
    "uniform vec4 viewpoint; /* homogeneous, eye space */\n"
    "uniform vec2 facing;    /* winding on the screen, 1 or -1: that is culled (0: none); of "
    "fronts */\n"
    "uniform float reach;    /* half a line's width and the smooth rim, px */\n"
    "uniform vec4 angles;    /* cos and sin of theta, of phi */\n"
    "flat out vec4 line;     /* p0, direction */\n"
    "flat out vec4 span;     /* length px; z0; z1 - z0; unit */\n"
    "flat out vec4 planes;   /* gradients of T and of theta's plane */\n"
    "flat out vec4 more;     /* gradient of phi's plane; outward normal of the edge */\n"
    "flat out vec2 kind;     /* bits 1, 2: theta's, phi's plane lies outwards, 4: T is drawn; T is "
    "back */\n"
    "vec4 window(vec3 p) {\n"
    "    vec4 c = projection * vec4(p, 1.0);\n"
    "    vec2 xy = viewport.xy + viewport.zw * (0.5 + 0.5 * c.xy / c.w);\n"
    "    return vec4(xy, mix(range.x, range.y, 0.5 + 0.5 * c.z / c.w), c.w);\n"
    "}\n"
    "vec3 relative(vec3 u, vec4 at) {\n"
    "    vec4 c = projection * vec4(u, 0.0);\n"
    "    vec2 xy = 0.5 * viewport.zw * c.xy - (at.xy - viewport.xy - 0.5 * viewport.zw) * c.w;\n"
    "    float half_range = 0.5 * (range.y - range.x);\n"
    "    return vec3(xy, half_range * c.z - (at.z - range.x - half_range) * c.w);\n"
    "}\n"
    "float area(vec3 u, vec3 v) { return u.x * v.y - v.x * u.y; }\n"
    "vec2 gradient(vec3 u, vec3 v) {\n"
    "    return vec2(u.z * v.y - v.z * u.y, u.x * v.z - v.x * u.z) / area(u, v);\n"
    "}\n"
    "/* Cuts the edge at the near plane; false: nothing is left. */\n"
    "bool cut(inout vec3 a, inout vec3 b) {\n"
    "    vec4 ca = projection * vec4(a, 1.0), cb = projection * vec4(b, 1.0);\n"
    "    float da = ca.z + ca.w, db = cb.z + cb.w;\n"
    "    if (da <= 0.0 && db <= 0.0) return false;\n"
    "    vec3 from = a, to = b;\n"
    "    if (da < 0.0) a = mix(from, to, da / (da - db) * 1.0001);\n"
    "    if (db < 0.0) b = mix(to, from, db / (db - da) * 1.0001);\n"
    "    return true;\n"
    "}\n"
    "void corner(vec2 p) {\n"
    "    gl_Position = vec4((p - viewport.xy) / viewport.zw * 2.0 - 1.0, 0.0, 1.0);\n"
    "    EmitVertex();\n"
    "}\n"
    "void band(vec3 a, vec3 b, vec3 third) {\n"
    "    vec3 along = normalize(b - a), inside = third - a;\n"
    "    vec3 across = inside - along * dot(inside, along);\n"
    "    if (!(length(across) > 1e-5 * length(inside))) return; /* T is a needle: it has no plane "
    "*/\n"
    "    vec3 outward = -normalize(across);\n"
    "    if (!cut(a, b)) return;\n"
    "    vec4 p0 = window(a), p1 = window(b);\n"
    "    float length_px = distance(p0.xy, p1.xy);\n"
    "    if (p0.w <= 0.0 || p1.w <= 0.0 || length_px < 0.01) return;\n"
    "    vec3 viewer = normalize(viewpoint.xyz - a * viewpoint.w);\n"
    "    vec3 to_viewer = relative(viewer, p0);\n"
    "    if (to_viewer.z > 0.0) viewer = -viewer;\n"
    "    vec3 normal = cross(along, outward);\n"
    "    if (dot(normal, viewer) < 0.0) normal = -normal;\n"
    "    vec3 side = cross(viewer, abs(viewer.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, "
    "0.0));\n"
    "    vec3 e = relative(along, p0), o = relative(outward, p0);\n"
    "    vec3 r = relative(-angles.x * outward - angles.y * normal, p0);\n"
    "    vec3 v = relative(-angles.z * outward - angles.w * normal, p0);\n"
    "    float turn = area(e, o); /* outward lies to the right of a front edge: negative */\n"
    "    if (turn == 0.0) return;\n"
    "    float winding = -sign(turn);\n"
    "    float bits = (area(e, r) * turn > 0.0 ? 1.0 : 0.0) + (area(e, v) * turn > 0.0 ? 2.0 : "
    "0.0) +\n"
    "                 (winding != facing.x ? 4.0 : 0.0);\n"
    "    vec2 t = (p1.xy - p0.xy) / length_px, n = vec2(t.y, -t.x) * winding;\n"
    "    float unit = abs(to_viewer.z) / length(relative(normalize(side), p0).xy);\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        line = vec4(p0.xy, t);\n"
    "        span = vec4(length_px, p0.z, p1.z - p0.z, unit);\n"
    "        planes = vec4(gradient(e, o), gradient(e, r));\n"
    "        more = vec4(gradient(e, v), n);\n"
    "        kind = vec2(bits, winding == facing.y ? 0.0 : 1.0);\n"
    "        vec2 base = i < 2 ? p0.xy - t * reach : p1.xy + t * reach;\n"
    "        corner(base + n * (i % 2 == 0 ? reach : -reach));\n"
    "    }\n"
    "    EndPrimitive();\n"
    "}\n"
    "void main() {\n"
    "    for (int i = 0; i < 3; i++)\n"
    "        if (edge[i] > 0.5) band(eye[i], eye[(i + 1) % 3], eye[(i + 2) % 3]);\n"
    "}\n";

/* The constants, in units unless said otherwise:
 *   REACH   1.2 px: the centre of the pixel that holds such a point lies 0.5 to 1.9 px beside the edge
 *   TRAP    16: a neighbour's depth changes as much over REACH when it is 4 degrees from edge-on
 *   JUMP    40: where depth falls that far, no neighbour was ever there: an outline, or a border */
const char shader_lines_fragment[] =
    "#version 150 compatibility\n"
    "const float REACH = 1.2, TRAP = 16.0, JUMP = 40.0;\n"
    "flat in vec4 line, span, planes, more;\n"
    "flat in vec2 kind;\n"
    "uniform sampler2D depth;\n"
    "uniform vec4 viewport;\n"
    "uniform float half_width; /* px */\n"
    "uniform float step;       /* the depth buffer's */\n"
    "uniform vec3 kinds;       /* silhouettes, ridges, valleys: 1 where they are wanted */\n"
    "float seen(vec2 q) { return texelFetch(depth, ivec2(q), 0).r; }\n"
    "vec2 centre(vec2 q) {\n"
    "    return clamp(floor(q), viewport.xy, viewport.xy + viewport.zw - 1.0) + 0.5;\n"
    "}\n"
    "float plane(vec2 g, vec2 q) { return span.y + dot(g, q - line.xy); }\n"
    "/* Which kinds the edge shows s px from its beginning. */\n"
    "vec3 found(float s, bool drawn, bvec2 outwards) {\n"
    "    vec2 n = more.zw, spine = line.xy + s * line.zw;\n"
    "    vec2 outside = centre(spine + REACH * n), inside = centre(spine - REACH * n);\n"
    "    if (dot(outside - line.xy, n) < 0.25) return vec3(0.0); /* the viewport ends there */\n"
    "    float unit = span.w, z = span.y + span.z * s / span.x, steep = length(planes.xy);\n"
    "    float z_out = seen(outside), behind = plane(planes.xy, inside) - seen(inside);\n"
    "    float slack = 0.05 * unit + 2.0 * step;\n"
    "    if (behind > slack + 0.02 * steep) { /* T is hidden: a silhouette where its edge is not */\n"
    "        float margin = drawn && kind.y < 0.5 ? 12.0 : 2.0;\n"
    "        return vec3(z < z_out - margin * unit - slack ? 1.0 : 0.0, 0.0, 0.0);\n"
    "    }\n"
    "    if (!drawn || behind < -(12.0 * unit + 2.0 * steep)) return vec3(0.0); /* T is not there */\n"
    "    float z_ridge = plane(planes.zw, outside), z_valley = plane(more.xy, outside);\n"
    "    if (z < z_out - JUMP * unit - 4.0 * steep)\n"
    "        return kinds.x > 0.0 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);\n"
    "    if (outwards.x && z_ridge < z_out - slack) return vec3(0.0, 1.0, 0.0);\n"
    "    bool trapped = z_valley > z_out + slack && z_valley < z_out + TRAP * unit;\n"
    "    return vec3(0.0, 0.0, outwards.y && trapped ? 1.0 : 0.0);\n"
    "}\n"
    "void main() {\n"
    "    vec2 c = gl_FragCoord.xy, from = c - line.xy;\n"
    "    float s = clamp(dot(from, line.zw), 0.0, span.x), d = dot(from, more.zw);\n"
    "    float cover = min(half_width + 0.5 - length(from - s * line.zw), 1.0);\n"
    "    if (cover <= 0.0) discard;\n"
    "    float bits = kind.x;\n"
    "    bool drawn = bits >= 4.0;\n"
    "    if (drawn) bits -= 4.0;\n"
    "    bvec2 outwards = bvec2(mod(bits, 2.0) >= 1.0, bits >= 2.0);\n"
    "    /* The median of three places: no dots, no pin-holes. */\n"
    "    vec3 a = found(max(s - 1.0, 0.0), drawn, outwards), b = found(s, drawn, outwards);\n"
    "    vec3 e = found(min(s + 1.0, span.x), drawn, outwards);\n"
    "    vec3 kinds_here = max(max(min(a, b), min(b, e)), min(a, e));\n"
    "    /* What is nearer than the line at this pixel hides it. */\n"
    "    float z = span.y + span.z * s / span.x, here = seen(c);\n"
    "    if (d >= 0.0 && z > here + (3.0 + (kinds_here.x > 0.0 ? 1.0 : 12.0) * d) * span.w) discard;\n"
    "    if (d < 0.0 && kinds_here.x == 0.0 &&\n"
    "        plane(planes.xy, c) > here + 2.0 * span.w + length(planes.xy)) discard;\n"
    "    gl_FragColor = vec4(kinds_here * kinds * cover, 1.0);\n"
    "}\n";

/* One triangle over the whole picture. */
const char shader_cover_vertex[] =
    "#version 150 compatibility\n"
    "in vec4 corner;\n"
    "void main() {\n"
    "    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    gl_Position = vec4(p, 0.0, 1.0) + 0.0 * corner;\n"
    "}\n";
/* Where kinds meet, the one that covers more gives its colour: a mean by squares. */
const char shader_cover_fragment[] =
    "#version 150 compatibility\n"
    "uniform sampler2D coverage;\n"
    "uniform mat3 inks; /* columns: silhouette, ridge, valley */\n"
    "void main() {\n"
    "    vec3 kinds = texelFetch(coverage, ivec2(gl_FragCoord.xy), 0).rgb;\n"
    "    float most = max(kinds.r, max(kinds.g, kinds.b));\n"
    "    if (most <= 0.0) discard;\n"
    "    vec3 weight = kinds * kinds;\n"
    "    gl_FragColor = vec4(inks * weight / dot(weight, vec3(1.0)), most);\n"
    "}\n";
