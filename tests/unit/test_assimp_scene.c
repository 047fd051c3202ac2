/* Scenes that move, from Assimp's formats: every animated model of Debian's assimp-testmodels poses as
 * an evaluator of the tests' own does (assimp_pose.c); without the package these tests are skipped.
 * What files can have wrong is made here. */
#include "assimp_pose.h"
#include "reading.h"

#include <drypoint/io.h>
#include <drypoint/scene.h>

#include <assimp/cimport.h>

#include <math.h>

/* Debian 12's Assimp leaks some bytes of a model that it reads; what is ours is still told. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp\n"; }

#define MODELS "/usr/share/assimp/models/"

/* ---- against the evaluator ---- */

typedef struct moved {
    const char *file;
    unsigned clips;
    bool moves;     /* false: only a camera does, or there is one pose */
    double seconds; /* of the first clip */
} moved;

static const moved models[] = {
    {"FBX/animation_with_skeleton.fbx", 1, true, 20 / 24.0},
    {"FBX/huesitos.fbx", 1, true, 39 / 25.0},
    {"Collada/anims_with_full_rotations_between_keys.DAE", 1, true, 11.9667},
    {"Collada/box_nested_animation.dae", 1, true, 40 / 24.0},
    {"X/BCN_Epileptic.X", 1, true, 3.3},
    {"X/Testwuson.X", 3, true, 29 / 30.0},
    {"X/anim_test.x", 1, true, 1},
    {"BVH/Boxing_Toes.bvh", 1, true, 30.68},
    {"CSM/ThomasFechten.csm", 1, true, 2439 / 120.0},
    {"MDL/MDL (HL1)/man.mdl", 6, true, 1 / 30.0},
    {"MDL/MDL (HL1)/chrome_sphere.mdl", 1, true, 220 / 25.0},
    {"3DS/CameraRollAnimWithChildObject.3ds", 1, true, 120 / 25.0},
    {"3DS/RotatingCube.3DS", 1, true, 181 / 25.0},
    {"3DS/CameraRollAnim.3ds", 1, false, 120 / 25.0},
    {"ASE/CameraRollAnimWithChildObject.ase", 1, true, 4},
    {"ASE/MotionCaptureROM.ase", 1, true, 2168 / 48.0},
    {"ASE/RotatingCube.ASE", 1, true, 6},
    {"ASE/anim.ASE", 1, true, 160 / 48.0},
    {"ASE/anim2.ASE", 1, true, 160 / 48.0},
    {"LWS/move_x.lws", 1, true, 2},
    {"LWS/move_xz_bezier.lws", 1, true, 4},
    {"SMD/WusonSMD.smd", 1, false, 0},
};
enum { MODEL_COUNT = sizeof models / sizeof *models };

static dp_source *open_model(const char *file) {
    char path[300];
    dp_source *source = NULL;
    dp_diag diag = {0};
    snprintf(path, sizeof path, MODELS "%s", file);
    if (access(MODELS, R_OK)) {
        print_message("there is no " MODELS ": install assimp-testmodels\n");
        skip();
    }
    if (dp_io_open(path, NULL, &source, &diag)) fail_msg("%s: %s", file, diag.message);
    return source;
}

/* The farthest that a vertex lies from where it should, as a share of the box's longest side. */
static double compare(dp_source *source, double (*const wanted)[3], size_t count) {
    double farthest = 0, size = 0, min[3], max[3];
    size_t at = 0;
    dp_batch batch;
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    while (!dp_source_next(source, &batch, NULL) && batch.polygon_count)
        for (size_t v = 0; v < batch.vertex_count; v++, at++) {
            const float *const p = batch.positions + 3 * v;
            assert_true(at < count);
            for (int k = 0; k < 3; k++) {
                const double apart = fabs(batch.origin[k] + p[k] - wanted[at][k]);
                if (!(apart <= farthest)) farthest = apart;
                min[k] = at ? fmin(min[k], wanted[at][k]) : wanted[at][k];
                max[k] = at ? fmax(max[k], wanted[at][k]) : wanted[at][k];
            }
        }
    assert_int_equal(at, count);
    for (int k = 0; k < 3; k++) size = fmax(size, max[k] - min[k]);
    return farthest / size;
}

/* The same of a model's clip at a time; `first` gets the vertices of the evaluator. */
static double compare_at(dp_source *source, const struct aiScene *scene, int clip, double time,
                         double (**vertices)[3], size_t *count) {
    dp_diag diag = {0};
    if (dp_scene_play(source, (uint32_t)(clip + 1), &diag) ||
        dp_source_set_time(source, time, &diag))
        fail_msg("%s", diag.message);
    *vertices = pose_vertices(scene, clip, time, count);
    return compare(source, *vertices, *count);
}

static bool differ(double (*const a)[3], double (*const b)[3], size_t count) {
    return memcmp(a, b, count * sizeof *a) != 0;
}

/* Five times of a clip. True: something moves. */
static bool check_clip(const char *file, dp_source *source, const struct aiScene *scene, int clip) {
    static const double shares[] = {0, 0.13, 0.37, 0.71, 1};
    const double seconds = dp_source_duration(source);
    double(*first)[3] = NULL;
    bool moves = false;
    for (size_t k = 0; k < 5; k++) {
        double(*now)[3];
        size_t count;
        const double error = compare_at(source, scene, clip, shares[k] * seconds, &now, &count);
        if (!(error <= 1e-5))
            fail_msg("%s, animation %d at %g s: %g of its size apart", file, clip + 1,
                     shares[k] * seconds, error);
        if (first) moves |= differ(first, now, count);
        if (!first) first = now;
        if (now != first) free(now);
    }
    free(first);
    return moves;
}

static void check_model(const moved *m) {
    char path[300];
    double(*rest)[3];
    size_t count;
    bool moves = false;
    dp_source *const source = open_model(m->file);
    snprintf(path, sizeof path, MODELS "%s", m->file);
    const struct aiScene *const scene = pose_import(path);
    const dp_scene_desc *const desc = dp_scene_of(source);
    assert_non_null(scene);
    assert_non_null(desc);
    assert_int_equal(desc->clip_count, m->clips);
    const double error = compare_at(source, scene, -1, 0, &rest, &count);
    if (!(error <= 1e-5)) fail_msg("%s, at rest: %g of its size apart", m->file, error);
    free(rest);
    for (unsigned k = 0; k < m->clips; k++) {
        assert_int_equal(dp_scene_play(source, k + 1, NULL), DP_OK);
        if (!k) assert_true(fabs(dp_source_duration(source) - m->seconds) <= 1e-4);
        moves |= check_clip(m->file, source, scene, (int)k);
    }
    if (moves != m->moves) fail_msg("%s %s", m->file, moves ? "moves" : "does not move");
    aiReleaseImport(scene);
    dp_source_destroy(source);
}

static void models_pose_as_another_evaluator_says(void **state) {
    (void)state;
    for (size_t k = 0; k < MODEL_COUNT; k++) check_model(&models[k]);
}

/* The nodes that the pivots of FBX become change nothing at rest: models that stand still come without. */
static void pivots_change_nothing_at_rest(void **state) {
    static const char *const still[] = {"FBX/cubes_with_mirroring_and_pivot.fbx", "FBX/spider.fbx",
                                        "FBX/close_to_identity_transforms.fbx",
                                        "FBX/global_settings.fbx"};
    (void)state;
    for (size_t k = 0; k < sizeof still / sizeof *still; k++) {
        char path[300];
        size_t count;
        dp_source *const source = open_model(still[k]);
        assert_null(dp_scene_of(source));
        snprintf(path, sizeof path, MODELS "%s", still[k]);
        const struct aiScene *const scene = pose_import(path);
        double(*const vertices)[3] = pose_vertices(scene, -1, 0, &count);
        const double error = compare(source, vertices, count);
        if (!(error <= 1e-5)) fail_msg("%s: %g of its size apart", still[k], error);
        free(vertices);
        aiReleaseImport(scene);
        dp_source_destroy(source);
    }
}

/* ---- small files ---- */

static dp_source *open_text(const char *ending, const char *text) {
    const char *const path = write_file(ending, text, strlen(text));
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_io_open(path, NULL, &source, &diag)) fail_msg("%s", diag.message);
    unlink(path);
    return source;
}

/* At a time of a clip (0: at rest), a vertex lies there. */
static void assert_vertex(dp_source *source, uint32_t clip, double time, uint32_t vertex, double x,
                          double y, double z) {
    const double wanted[3] = {x, y, z};
    dp_batch batch;
    assert_int_equal(dp_scene_play(source, clip, NULL), DP_OK);
    assert_int_equal(dp_source_set_time(source, time, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_true(vertex < batch.vertex_count);
    const float *const p = batch.positions + 3 * (size_t)vertex;
    for (int k = 0; k < 3; k++)
        if (!(fabs(p[k] - wanted[k]) <= 1e-5))
            fail_msg("at %g s it lies at %g %g %g", time, (double)p[0], (double)p[1], (double)p[2]);
}

/* FBX: a triangle that turns by 180 degrees about z in two seconds, about a pivot at x = 10. */
static const char turning[] =
    "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\n"
    "Objects: {\nGeometry: 1, \"Geometry::g\", \"Mesh\" {\n"
    "Vertices: *9 {\na: 0,0,0,1,0,0,0,1,0\n}\nPolygonVertexIndex: *3 {\na: 0,1,-3\n}\n}\n"
    "Model: 2, \"Model::door\", \"Mesh\" {\nVersion: 232\nProperties70: {\n"
    "P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",10,0,0\n"
    "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,0,7\n}\n}\n"
    "AnimationStack: 3, \"AnimStack::open\", \"\" {\nProperties70: {\n"
    "P: \"LocalStop\", \"KTime\", \"Time\", \"\",92372316000\n}\n}\n"
    "AnimationLayer: 4, \"AnimLayer::base\", \"\" {\n}\n"
    "AnimationCurveNode: 5, \"AnimCurveNode::R\", \"\" {\n}\n"
    "AnimationCurve: 6, \"AnimCurve::\", \"\" {\nKeyVer: 4008\n"
    "KeyTime: *3 {\na: 0,46186158000,92372316000\n}\n"
    "KeyValueFloat: *3 {\na: 0,90,180\n}\n}\n}\n"
    "Connections: {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",4,3\nC: \"OO\",5,4\n"
    "C: \"OP\",5,2, \"Lcl Rotation\"\nC: \"OP\",6,5, \"d|Z\"\n}\n";

static void pivots_of_fbx_are_turned_about(void **state) {
    (void)state;
    dp_source *const source = open_text(".fbx", turning);
    assert_vertex(source, 0, 0, 1, 1, 0, 7);
    assert_vertex(source, 1, 0, 1, 1, 0, 7);
    assert_vertex(source, 1, 1, 1, 10, -9, 7);
    assert_vertex(source, 1, 2, 1, 19, 0, 7);
    assert_true(fabs(dp_source_duration(source) - 2) < 1e-6);
    dp_source_destroy(source);
}

/* FBX: a triangle whose target lifts it by 4, from 0 to half of that in one second. */
static const char lifted[] =
    "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\n"
    "Objects: {\nGeometry: 1, \"Geometry::g\", \"Mesh\" {\n"
    "Vertices: *9 {\na: 0,0,0,1,0,0,0,1,0\n}\nPolygonVertexIndex: *3 {\na: 0,1,-3\n}\n}\n"
    "Geometry: 12, \"Geometry::up\", \"Shape\" {\nVersion: 100\nIndexes: *2 {\na: 1,2\n}\n"
    "Vertices: *6 {\na: 0,0,4,0,0,4\n}\nNormals: *6 {\na: 0,0,0,0,0,0\n}\n}\n"
    "Model: 2, \"Model::door\", \"Mesh\" {\nVersion: 232\n}\n"
    "Deformer: 10, \"Deformer::shapes\", \"BlendShape\" {\nVersion: 100\n}\n"
    "Deformer: 11, \"SubDeformer::up\", \"BlendShapeChannel\" {\nVersion: 100\nDeformPercent: 0\n"
    "FullWeights: *1 {\na: 100\n}\n}\n"
    "AnimationStack: 3, \"AnimStack::lift\", \"\" {\nProperties70: {\n"
    "P: \"LocalStop\", \"KTime\", \"Time\", \"\",46186158000\n}\n}\n"
    "AnimationLayer: 4, \"AnimLayer::base\", \"\" {\n}\n"
    "AnimationCurveNode: 5, \"AnimCurveNode::DeformPercent\", \"\" {\n}\n"
    "AnimationCurve: 6, \"AnimCurve::\", \"\" {\nKeyVer: 4008\n"
    "KeyTime: *2 {\na: 0,46186158000\n}\nKeyValueFloat: *2 {\na: 0,50\n}\n}\n}\n"
    "Connections: {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",10,1\nC: \"OO\",11,10\n"
    "C: \"OO\",12,11\nC: \"OO\",4,3\nC: \"OO\",5,4\nC: \"OP\",5,11, \"DeformPercent\"\n"
    "C: \"OP\",6,5, \"d|DeformPercent\"\n}\n";

static void targets_of_fbx_are_weighted(void **state) {
    (void)state;
    dp_source *const source = open_text(".fbx", lifted);
    assert_int_equal(dp_scene_of(source)->meshes[0].morph_count, 1);
    assert_vertex(source, 0, 0, 1, 1, 0, 0);
    assert_vertex(source, 1, 0.5, 0, 0, 0, 0);
    assert_vertex(source, 1, 0.5, 1, 1, 0, 1);
    assert_vertex(source, 1, 1, 2, 0, 1, 2);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_pose_as_another_evaluator_says),
        cmocka_unit_test(pivots_change_nothing_at_rest),
        cmocka_unit_test(pivots_of_fbx_are_turned_about),
        cmocka_unit_test(targets_of_fbx_are_weighted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
