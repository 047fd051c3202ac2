// Do the interiors of two polygons cross? In double precision, as features/crossing.c.

// A polygon's fan of triangles.
uvec2 fan_of(uint triangle) {
    uint name = polygon_of(triangle), first = triangle, last = triangle;
    while (first > 0u && polygon_of(first - 1u) == name) first--;
    while (last + 1u < picture.counts.y && polygon_of(last + 1u) == name) last++;
    return uvec2(first, last);
}
uint corner_count(uvec2 fan) { return fan.y - fan.x + 3u; }
vec3 corner_at(uvec2 fan, uint i) {
    uint n = corner_count(fan);
    i = i >= n ? i - n : i;
    return world_of(corners[i == 0u ? 3u * fan.x : i + 1u == n ? 3u * fan.y + 2u
                                                               : 3u * (fan.x + i - 1u) + 1u]);
}
dvec3 normal_of(uvec2 fan) {
    dvec3 sum = dvec3(0.0);
    for (uint t = fan.x; t <= fan.y; t++) sum += area_normal(t);
    double l = length(sum);
    return l > 0.0 ? sum * (1.0 / l) : sum;
}
double extent_of(uvec2 fan) {
    double most = 0.0;
    dvec3 o = dvec3(corner_at(fan, 0u));
    for (uint i = 1u; i < corner_count(fan); i++)
        most = max(most, length(dvec3(corner_at(fan, i)) - o));
    return most;
}
// Do they have a corner position in common? Then they meet there by construction.
bool touch(uvec2 a, uvec2 b) {
    for (uint i = 0u; i < corner_count(a); i++)
        for (uint k = 0u; k < corner_count(b); k++)
            if (corner_at(a, i) == corner_at(b, k)) return true;
    return false;
}

// A corner nearer than this to a plane lies in it.
double flatness(uvec2 a, uvec2 b) {
    double ra = extent_of(a), rb = extent_of(b);
    dvec3 at = dvec3(ra < rb ? corner_at(a, 0u) : corner_at(b, 0u));
    double distance = dot(picture.sight.xyz, at) + picture.sight.w;
    double pixel = (is_perspective() ? max(distance, 0.0) : 1.0) / picture.forward.w;
    return max(1e-6LF * min(ra, rb), 0.01LF * pixel);
}
// The segment in which a plane cuts a polygon. False: it does not.
bool cut_polygon(uvec2 fan, dvec3 at, dvec3 n, double flat_, out dvec3 from, out dvec3 to) {
    int ends = 0;
    double least = 0.0, most = 0.0;
    from = to = at;
    for (uint i = 0u; i < corner_count(fan); i++) {
        dvec3 a = dvec3(corner_at(fan, i)), b = dvec3(corner_at(fan, i + 1u));
        double da = dot(a - at, n), db = dot(b - at, n);
        least = min(least, da), most = max(most, da);
        if ((da < 0.0) == (db < 0.0)) continue;
        dvec3 q = a + (b - a) * (da / (da - db));
        if (ends == 0)
            from = q;
        else
            to = q;
        ends++;
    }
    return ends == 2 && least < -flat_ && most > flat_;
}
bool do_cross(uvec2 a, uvec2 b) {
    dvec3 na = normal_of(a), nb = normal_of(b), line_ = cross(na, nb), from, to, from_b, to_b;
    double l = length(line_);
    if (l < 1e-6LF) return false; // the same plane
    double flat_ = flatness(a, b);
    if (!cut_polygon(a, dvec3(corner_at(b, 0u)), nb, flat_, from, to) ||
        !cut_polygon(b, dvec3(corner_at(a, 0u)), na, flat_, from_b, to_b))
        return false;
    dvec3 u = line_ * (1.0 / l);
    double a1 = dot(to - from, u), b0 = dot(from_b - from, u), b1 = dot(to_b - from, u);
    return min(max(0.0, a1), max(b0, b1)) - max(min(0.0, a1), min(b0, b1)) > flat_;
}
// Along every outline of a closed model a front and a back face come close without crossing.
bool may_intersect(uint triangle, uint other) {
    uvec2 a = fan_of(triangle), b = fan_of(other);
    if (touch(a, b)) return false;
    return (is_front(triangle) && is_front(other)) || do_cross(a, b);
}
