/* Deforming: an application's vertex function, or one of the library's own (deform.h has their
 * formulas).
 *
 * A vertex is looked at from the centre of the model's box, in double precision, so that far from
 * zero a model is deformed as it is near to it; what is added to its float32 position is small then.
 * A vertex that does not move keeps its bits. */
#include "base/diag.h"
#include "base/elementary.h"
#include "base/vec.h"
#include "mesh/moved.h"

static const double TURN = 6.283185307179586; /* radians */

typedef struct deformer {
    dp_allocator memory;
    dp_deform given;  /* with defaults filled in */
    double centre[3]; /* of the box, world space */
    double half;      /* of the extent along the axis, world units; 0: nothing moves */
} deformer;

/* ------- the vertex functions ------- */

/* What is the same for a run's vertices. */
typedef struct setting {
    const dp_deform *d;
    dp_vec3 axis, across, beside; /* beside: across both */
    double extent, share;         /* along the axis; 1 / that, or 0 */
    double turns;                 /* speed * time, its fraction */
    double now;                   /* how much it swells or turns at that time, of 1 */
} setting;

/* What is added to the vertex at p, seen from the box's centre. u: as in dp_deform. */
typedef dp_vec3 displacement(const setting *s, dp_vec3 p, double u);

static dp_vec3 wave(const setting *s, dp_vec3 p, double u) {
    const double rises = u * (2 - u), along = u + s->d->slant * dp_dot(p, s->beside) * s->share;
    const double height = s->d->amplitude * s->extent * rises;
    return dp_scale(s->across, height * dp_sin(TURN * (along / s->d->length - s->turns)));
}

/* From the line through the centre to p. */
static dp_vec3 radius_of(const setting *s, dp_vec3 p) {
    return dp_mad(p, s->axis, -dp_dot(p, s->axis));
}

static dp_vec3 breathe(const setting *s, dp_vec3 p, double u) {
    const double h = (u - s->d->at) / s->d->length, falls = dp_max(1 - h * h, 0);
    const double swells = s->d->amplitude * falls * falls * s->now;
    return dp_scale(radius_of(s, p), swells);
}

static dp_vec3 twist(const setting *s, dp_vec3 p, double u) {
    const double grown = dp_max(dp_min(u / s->d->length, 1), 0);
    const double angle = s->d->amplitude / 360 * TURN * grown * s->now;
    const dp_vec3 r = radius_of(s, p), aside = dp_cross(s->axis, r);
    return dp_sub(dp_mad(dp_scale(r, dp_cos(angle)), aside, dp_sin(angle)), r);
}

static displacement *const displacements[] = {wave, breathe, twist};
enum { KINDS = sizeof displacements / sizeof *displacements };

static dp_vec3 direction(const double v[3]) { return dp_v3(v[0], v[1], v[2]); }

static void move_shaped(void *user, const dp_vertex_run *run, const dp_batch *other,
                        size_t first_of_batch) {
    const deformer *const f = user;
    displacement *const displace = displacements[f->given.kind];
    const double turns = fmod(f->given.speed * run->time, 1);
    const dp_vec3 axis = direction(f->given.axis), across = direction(f->given.across);
    const bool begins_full = f->given.kind == DP_DEFORM_TWIST;
    const setting s = {.d = &f->given,
                       .axis = axis,
                       .across = across,
                       .beside = dp_unit(dp_cross(across, axis)),
                       .extent = 2 * f->half,
                       .share = f->half > 0 ? 0.5 / f->half : 0,
                       .turns = turns,
                       .now = begins_full ? dp_cos(TURN * turns) : dp_sin(TURN * turns)};
    const dp_vec3 from = dp_v3(run->origin[0] - f->centre[0], run->origin[1] - f->centre[1],
                               run->origin[2] - f->centre[2]);
    const char *at = (const char *)run->positions;
    (void)other, (void)first_of_batch;
    for (size_t i = 0; i < run->count; i++, at += run->stride) {
        const dp_vec3 rest = dp_v3f((const float *)(const void *)at), p = dp_add(rest, from);
        const double u = (dp_dot(p, s.axis) + f->half) * s.share;
        const dp_vec3 moved = dp_add(rest, displace(&s, p, u));
        run->moved[i][0] = (float)moved.x;
        run->moved[i][1] = (float)moved.y;
        run->moved[i][2] = (float)moved.z;
    }
}

static void move_given(void *user, const dp_vertex_run *run, const dp_batch *other,
                       size_t first_of_batch) {
    const deformer *const f = user;
    (void)other, (void)first_of_batch;
    f->given.vertices(f->given.user, run);
}

static dp_result check_time(void *user, double time, dp_diag *diag) {
    static const double most = 1e12; /* beyond, a double does not tell the parts of a period */
    (void)user;
    if (fabs(time) <= most) return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT,
                   "how a model is deformed at %g s is not known; give a time within %g s of 0",
                   time, most);
}

static void deformer_destroy(void *user) {
    deformer *const f = user;
    const dp_allocator memory = f->memory;
    dp_free(&memory, f);
}

/* ------- defaults ------- */

static const struct {
    const char *name;
    double amplitude, length, speed, at; /* defaults */
    double least, most;                  /* amplitude */
} kinds[KINDS] = {{"wave", 0.08, 0.6, 1, 0, -10, 10},
                  {"breathe", 0.08, 0.5, 0.25, 0.5, -1, 10},
                  {"twist", 90, 1, 0, 0, -36000, 36000}};

static dp_result check_number(const char *kind, const char *name, double value, double least,
                              double most, dp_diag *diag) {
    if (value == 0 || (value >= least && value <= most)) return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT, "%s: %s is %g; it must lie between %g and %g", kind, name,
                   value, least, most);
}

static dp_result check_direction(const char *kind, const char *name, const double v[3],
                                 dp_diag *diag) {
    if (isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2])) return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT, "%s: %s is not finite", kind, name);
}

static dp_result check(const dp_deform *d, dp_diag *diag) {
    if (d->vertices) return DP_OK;
    if ((unsigned)d->kind >= KINDS)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_deform: there is no kind %d",
                       (int)d->kind);
    const char *const kind = kinds[d->kind].name;
    dp_result result = check_number(kind, "amplitude", d->amplitude, kinds[d->kind].least,
                                    kinds[d->kind].most, diag);
    if (!result) result = check_number(kind, "length", d->length, 0.001, 1000, diag);
    if (!result) result = check_number(kind, "speed", d->speed, -1e6, 1e6, diag);
    if (!result) result = check_number(kind, "slant", d->slant, -10, 10, diag);
    if (!result) result = check_number(kind, "at", d->at, -100, 100, diag);
    if (!result) result = check_direction(kind, "axis", d->axis, diag);
    if (!result) result = check_direction(kind, "across", d->across, diag);
    return result;
}

/* Makes a direction's length 1, or takes coordinate axis k where it is 0. */
static void settle_direction(double v[3], int k) {
    const double largest = dp_max(fabs(v[0]), dp_max(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0)) v[k] = 1;
    const double scale = largest > 0 ? largest : 1;
    const dp_vec3 unit = dp_unit(dp_v3(v[0] / scale, v[1] / scale, v[2] / scale));
    v[0] = unit.x, v[1] = unit.y, v[2] = unit.z;
}

static int longest_side(const double side[3]) {
    int k = side[1] > side[0] ? 1 : 0;
    if (side[2] > side[k]) k = 2;
    return k;
}

/* The shortest side other than the one that the axis follows most. */
static int shortest_side(const double side[3], const double axis[3]) {
    const double along[3] = {fabs(axis[0]), fabs(axis[1]), fabs(axis[2])};
    const int taken = longest_side(along);
    int best = taken == 0 ? 1 : 0;
    for (int k = 0; k < 3; k++)
        if (k != taken && side[k] < side[best]) best = k;
    return best;
}

static void fill_in(deformer *f, const dp_extent *extent) {
    dp_deform *const d = &f->given;
    double side[3];
    for (int k = 0; k < 3; k++) {
        side[k] = extent->exact_max[k] - extent->exact_min[k];
        f->centre[k] = extent->exact_min[k] + 0.5 * side[k];
    }
    if (d->amplitude == 0) d->amplitude = kinds[d->kind].amplitude;
    if (d->length == 0) d->length = kinds[d->kind].length;
    if (d->speed == 0) d->speed = kinds[d->kind].speed;
    if (d->at == 0) d->at = kinds[d->kind].at;
    settle_direction(d->axis, longest_side(side));
    settle_direction(d->across, shortest_side(side, d->axis));
    for (int k = 0; k < 3; k++) f->half += 0.5 * fabs(d->axis[k]) * side[k];
}

/* ------- making ------- */

static dp_result measure(deformer *f, dp_source *source, dp_diag *diag) {
    dp_extent extent = {0};
    if (f->given.vertices) return DP_OK;
    if (!dp_source_rewindable(source))
        return dp_fail(diag, DP_ERR_UNSUPPORTED,
                       "%s: the model must be measured first, but can be read only once",
                       kinds[f->given.kind].name);
    const dp_result result = dp_source_extent(source, &extent, diag);
    if (!result) fill_in(f, &extent);
    return result;
}

dp_result dp_source_deform(dp_source *source, const dp_deform *deform,
                           const dp_allocator *allocator, dp_source **out, dp_diag *diag) {
    static const dp_deform usual = {0};
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_deform: out is NULL");
    *out = NULL;
    if (!source) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_deform: source is NULL");
    const dp_result wrong = check(deform ? deform : &usual, diag);
    if (wrong) return wrong;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    deformer *const f = dp_alloc_zeroed(&memory, sizeof *f);
    if (!f) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a deformed model");
    f->memory = memory;
    f->given = deform ? *deform : usual;
    const bool own = f->given.vertices != NULL;
    const dp_moved_desc desc = {.inner = source,
                                .move = own ? move_given : move_shaped,
                                .user = f,
                                .set_time = own ? NULL : check_time,
                                .destroy = deformer_destroy,
                                .normals = own && f->given.normals};
    dp_result result = measure(f, source, diag);
    if (!result) result = dp_source_moved(&desc, &memory, out, diag);
    if (result) deformer_destroy(f);
    return result;
}

const dp_deform *dp_deform_of(const dp_source *source) {
    const deformer *f = dp_moved_user(source, move_shaped);
    if (!f) f = dp_moved_user(source, move_given);
    return f ? &f->given : NULL;
}
