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

#include <stddef.h>

/* Shader text written as it is; comments do not get into it, and it is one line to GL. */
#define GLSL(...) #__VA_ARGS__

static const char version_120[] = "#version 120\n";
static const char version_150[] = "#version 150 compatibility\n";

/* clang-format off */

/* Surfaces as paper. The position is the fixed pipeline's own. */
static const char paper_vertex[] = GLSL(
    void main() {
        gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;
        gl_Position = ftransform();
    }
);

static const char paper_fragment[] = GLSL(
    uniform vec4 paper;
    void main() { gl_FragColor = paper; }
);

static const char lines_vertex[] = GLSL(
    in vec4 corner; /* x, y, z and whether an edge begins here */
    uniform mat4 modelview;
    out vec3 eye;
    out float edge;
    void main() {
        eye = (modelview * vec4(corner.xyz, 1.0)).xyz;
        edge = corner.w;
        gl_Position = vec4(0.0);
    }
);

/* Which kinds an edge shows, s px from its beginning: (silhouette, ridge, valley), each 0 or 1.
 *   line    p0, direction
 *   span    length px; z0; z1 - z0; unit
 *   planes  gradients of T and of theta's plane
 *   more    gradient of phi's plane; normal of the edge, outwards
 *   kind    theta's, phi's plane lies outwards; T is drawn (not culled): 0 or 1; the margin
 * The constants, in units unless said otherwise:
 *   REACH   1.2 px: the centre of the pixel that holds such a point lies 0.5 to 1.9 px beside the edge
 *   NEAR    0.72 px: half a pixel's diagonal, so that centre is just outside. Edges that are hidden but less
 *           than REACH inside an outline have it, and what lies far behind at REACH, beside them
 *   TRAP    16: a neighbour's depth changes as much over REACH when it is 4 degrees from edge-on
 *   JUMP    40: where depth falls that far, no neighbour was ever there: an outline, or a border
 *   margin  a silhouette's edge is nearer than what lies outside by 2; by 12 if T is drawn and
 *           called front, for then only inverted winding makes it one */
static const char found[] = GLSL(
    const float REACH = 1.2;
    const float NEAR = 0.72;
    const float TRAP = 16.0;
    const float JUMP = 40.0;
    uniform sampler2D depth;
    uniform vec4 viewport;    /* x, y, width, height */
    uniform float step_depth; /* the depth buffer's */
    uniform vec3 kinds;       /* silhouettes, ridges, valleys: 1 where they are wanted */
    float seen(vec2 q) { return texelFetch(depth, ivec2(q), 0).r; }
    vec2 centre(vec2 q) {
        return clamp(floor(q), viewport.xy, viewport.xy + viewport.zw - 1.0) + 0.5;
    }
    vec3 find(float s, vec4 line, vec4 span, vec4 planes, vec4 more, vec4 kind) {
        vec2 n = more.zw;
        vec2 spine = line.xy + s * line.zw;
        vec2 outside = centre(spine + REACH * n);
        vec2 inside = centre(spine - REACH * n);
        vec2 to_outside = outside - line.xy;
        if (dot(to_outside, n) < 0.25) return vec3(0.0); /* the viewport ends there */
        float unit = span.w;
        float z = span.y + span.z * s / span.x;
        float steep = length(planes.xy);
        float z_out = seen(outside);
        float behind = span.y + dot(planes.xy, inside - line.xy) - seen(inside);
        float z_free = min(z_out, seen(centre(spine + NEAR * n)));
        float slack = 0.05 * unit + 2.0 * step_depth;
        if (behind > slack + 0.02 * steep) /* T is hidden: a silhouette where its edge is not */
            return vec3(z < z_free - kind.w * unit - slack ? 1.0 : 0.0, 0.0, 0.0);
        if (kind.z < 0.5 || behind < -(12.0 * unit + 2.0 * steep)) return vec3(0.0); /* T is not there */
        if (z < z_free - JUMP * unit - 4.0 * steep)
            return kinds.x > 0.0 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        if (kind.x > 0.5 && span.y + dot(planes.zw, to_outside) < z_out - slack) return vec3(0.0, 1.0, 0.0);
        float z_valley = span.y + dot(more.xy, to_outside);
        bool trapped = z_valley > z_out + slack && z_valley < z_out + TRAP * unit;
        return vec3(0.0, 0.0, kind.y > 0.5 && trapped ? 1.0 : 0.0);
    }
);

/* Depth as an affine function of the window: for a point p0 of the plane with homogeneous window
 * coordinates (X, Y, Z, w) and eye-space directions u, v in it, relative(u) is what moving along u adds to
 * (X - x0 w, Y - y0 w, Z - z0 w), which is linear in u, also across the plane of the eye. The
 * gradient g solves dot(g, relative(u).xy) = relative(u).z, and the same for v. */
static const char planes_of_edges[] = GLSL(
    uniform mat4 projection;
    uniform vec2 range; /* glDepthRange */
    vec4 window(vec3 p) {
        vec4 c = projection * vec4(p, 1.0);
        vec2 xy = viewport.xy + viewport.zw * (0.5 + 0.5 * c.xy / c.w);
        return vec4(xy, mix(range.x, range.y, 0.5 + 0.5 * c.z / c.w), c.w);
    }
    vec3 relative(vec3 u, vec4 at) {
        vec4 c = projection * vec4(u, 0.0);
        vec2 xy = 0.5 * viewport.zw * c.xy - (at.xy - viewport.xy - 0.5 * viewport.zw) * c.w;
        float half_range = 0.5 * (range.y - range.x);
        return vec3(xy, half_range * c.z - (at.z - range.x - half_range) * c.w);
    }
    float area(vec3 u, vec3 v) { return u.x * v.y - v.x * u.y; }
    vec2 gradient(vec3 u, vec3 v) {
        return vec2(u.z * v.y - v.z * u.y, u.x * v.z - v.x * u.z) / area(u, v);
    }
    /* Cuts the edge at the near plane; false: nothing is left. */
    bool cut(inout vec3 a, inout vec3 b) {
        vec4 ca = projection * vec4(a, 1.0);
        vec4 cb = projection * vec4(b, 1.0);
        float da = ca.z + ca.w;
        float db = cb.z + cb.w;
        if (da <= 0.0 && db <= 0.0) return false;
        vec3 from = a;
        vec3 to = b;
        if (da < 0.0) a = mix(from, to, da / (da - db) * 1.0001);
        if (db < 0.0) b = mix(to, from, db / (db - da) * 1.0001);
        return true;
    }
);

/* A short edge is looked along before its band is made, at places 2 px apart: most edges show nothing. */
static const char lines_geometry[] = GLSL(
    const float THIN = 0.02; /* px: what rounding of coordinates may add up to */
    uniform vec4 viewpoint; /* homogeneous, eye space */
    uniform vec2 facing;    /* winding on the screen, 1 or -1: what is culled (0: none); of fronts */
    uniform float reach;    /* half a line's width and half a smooth rim, px */
    uniform vec4 angles;    /* cos and sin of theta, of phi */
    in vec3 eye[];
    in float edge[];
    flat out vec4 line;
    flat out vec4 span;
    flat out vec4 planes;
    flat out vec4 more;
    flat out vec4 kind;
    bool shows(vec4 l, vec4 s, vec4 p, vec4 m, vec4 k) {
        int places = int(0.5 * s.x) + 1;
        if (places > 12) return true;
        bool any_found = false;
        for (int i = 0; i < places; i++) {
            vec3 f = find((float(i) + 0.5) / float(places) * s.x, l, s, p, m, k) * kinds;
            any_found = any_found || f.x + f.y + f.z > 0.0;
        }
        return any_found;
    }
    void band(vec3 a, vec3 b, vec3 third) {
        vec3 along = normalize(b - a);
        vec3 inside = third - a;
        vec3 across = inside - along * dot(inside, along);
        if (!(length(across) > 1e-5 * length(inside))) return; /* T is a needle: it has no plane */
        vec3 outward = -normalize(across);
        if (!cut(a, b)) return;
        vec4 p0 = window(a);
        vec4 p1 = window(b);
        float length_px = distance(p0.xy, p1.xy);
        if (p0.w <= 0.0 || p1.w <= 0.0 || length_px < 0.01) return;
        vec2 t = (p1.xy - p0.xy) / length_px;
        vec4 p2 = window(third);
        vec2 aside = p2.xy - p0.xy;
        if (p2.w > 0.0 && abs(t.x * aside.y - t.y * aside.x) < THIN) return; /* nor has it a side */
        vec3 viewer = normalize(viewpoint.xyz - a * viewpoint.w);
        vec3 to_viewer = relative(viewer, p0);
        if (to_viewer.z > 0.0) viewer = -viewer;
        vec3 normal = cross(along, outward);
        if (dot(normal, viewer) < 0.0) normal = -normal;
        vec3 e = relative(along, p0);
        vec3 o = relative(outward, p0);
        vec3 r = relative(-angles.x * outward - angles.y * normal, p0);
        vec3 v = relative(-angles.z * outward - angles.w * normal, p0);
        float turn = area(e, o);
        if (turn == 0.0) return;
        float winding = -sign(turn); /* what is outwards lies to the right of a counter-clockwise edge */
        float drawn = winding != facing.x ? 1.0 : 0.0;
        vec3 side = cross(viewer, abs(viewer.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        float unit = abs(to_viewer.z) / length(relative(normalize(side), p0).xy);
        vec2 n = vec2(t.y, -t.x) * winding;
        vec4 l = vec4(p0.xy, t);
        vec4 s = vec4(length_px, p0.z, p1.z - p0.z, unit);
        vec4 p = vec4(gradient(e, o), gradient(e, r));
        vec4 m = vec4(gradient(e, v), n);
        vec4 k = vec4(area(e, r) * turn > 0.0 ? 1.0 : 0.0, area(e, v) * turn > 0.0 ? 1.0 : 0.0, drawn,
                      drawn > 0.5 && winding == facing.y ? 12.0 : 2.0);
        if (!shows(l, s, p, m, k)) return;
        for (int i = 0; i < 4; i++) {
            line = l;
            span = s;
            planes = p;
            more = m;
            kind = k;
            vec2 base = i < 2 ? p0.xy - t * reach : p1.xy + t * reach;
            vec2 at = base + n * (i == 0 || i == 2 ? reach : -reach);
            gl_Position = vec4((at - viewport.xy) / viewport.zw * 2.0 - 1.0, 0.0, 1.0);
            EmitVertex();
        }
        EndPrimitive();
    }
    void main() {
        for (int i = 0; i < 3; i++)
            if (edge[i] > 0.5) band(eye[i], eye[i < 2 ? i + 1 : 0], eye[i > 0 ? i - 1 : 2]);
    }
);

static const char lines_fragment[] = GLSL(
    flat in vec4 line;
    flat in vec4 span;
    flat in vec4 planes;
    flat in vec4 more;
    flat in vec4 kind;
    uniform float half_width; /* px */
    void main() {
        vec2 from = gl_FragCoord.xy - line.xy;
        float s = clamp(dot(from, line.zw), 0.0, span.x);
        float d = dot(from, more.zw);
        float cover = min(half_width + 0.5 - length(from - s * line.zw), 1.0);
        if (cover <= 0.0) discard;
        /* The median of three places: no dots, no pin-holes. */
        vec3 a = find(max(s - 1.0, 0.0), line, span, planes, more, kind);
        vec3 b = find(s, line, span, planes, more, kind);
        vec3 c = find(min(s + 1.0, span.x), line, span, planes, more, kind);
        vec3 shown = max(max(min(a, b), min(b, c)), min(a, c));
        /* What is nearer than the line at this pixel hides it. */
        float z = span.y + span.z * s / span.x;
        float here = seen(gl_FragCoord.xy);
        float rise = shown.x > 0.0 ? 1.0 : 12.0;
        if (d >= 0.0 && z > here + (3.0 + rise * d) * span.w) discard;
        float z_inside = span.y + dot(planes.xy, from);
        if (d < 0.0 && shown.x == 0.0 && z_inside > here + 2.0 * span.w + length(planes.xy)) discard;
        gl_FragColor = vec4(shown * kinds * cover, 1.0);
    }
);

/* One triangle over the whole picture. */
static const char cover_vertex[] = GLSL(
    in vec4 corner;
    void main() {
        vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
        gl_Position = vec4(p, 0.0, 1.0) + 0.0 * corner;
    }
);

/* Where kinds meet, the one that covers more gives its colour: a mean by squares. */
static const char cover_fragment[] = GLSL(
    uniform sampler2D coverage;
    uniform mat3 inks; /* columns: silhouette, ridge, valley */
    void main() {
        vec3 covered = texelFetch(coverage, ivec2(gl_FragCoord.xy), 0).rgb;
        float most = max(covered.r, max(covered.g, covered.b));
        if (most <= 0.0) discard;
        vec3 weight = covered * covered;
        gl_FragColor = vec4(inks * weight / dot(weight, vec3(1.0)), most);
    }
);
/* clang-format on */

/* In 1.50 layouts stand before all else. */
static const char layouts[] = "layout(triangles) in;\n"
                              "layout(triangle_strip, max_vertices = 12) out;\n";

const shader_text shader_paper_vertex = {version_120, paper_vertex};
const shader_text shader_paper_fragment = {version_120, paper_fragment};
const shader_text shader_lines_vertex = {version_150, lines_vertex};
const shader_text shader_lines_geometry = {version_150, layouts, found, planes_of_edges,
                                           lines_geometry};
const shader_text shader_lines_fragment = {version_150, found, lines_fragment};
const shader_text shader_cover_vertex = {version_150, cover_vertex};
const shader_text shader_cover_fragment = {version_150, cover_fragment};
