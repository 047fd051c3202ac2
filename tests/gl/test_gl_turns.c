/* Pictures of all kinds in turn by one dp_gl, each the same, byte by byte, as a dp_gl draws it that has drawn nothing before.
 *
 * A turn changes the meshes a little (positions, topology, places, the list itself, buffers of the application's), and draws
 * them by a style, projection, size and target of its own. Data structure: `scene`, from which both dp_gl can have their
 * meshes. Numbers come from seeds, DP_TEST_SEED is one to take, of DP_TEST_TURNS turns. */
#include "gl/context.h"
#include "gl/models.h"

#include "gl/gl.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 112, THINGS = 3, SIZES = 5 };

/* ------- numbers ------- */

static uint64_t dice_state;

static uint32_t dice(uint32_t sides) {
    uint64_t z = dice_state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u, z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (uint32_t)((z ^ z >> 31) >> 33) % sides;
}

/* ------- things: meshes, and what they are made of ------- */

typedef struct thing {
    shape shape;
    float wave;
    bool placed, moved; /* by a matrix; by its batch's origin */
    bool buffers;       /* the application's: of SHEETS */
    double degrees;
    uint32_t names[3]; /* positions, indices, normals */
    dp_gl_mesh *mesh;
} thing;

typedef struct turn {
    dp_style style;
    dp_camera camera;
    dp_gl_target target;
    uint32_t reads; /* bits: segments, hand-over, lines of the device, stats */
    char name[200];
} turn;

typedef struct turns {
    gl_test *test;
    const dp_gl_api *api;
    thing things[THINGS];
    uint32_t count;
    uint32_t framebuffer, texture, depth[SIZES]; /* depth: of the application's, by size */
    dp_texture *textures[2];
} turns;

static int complaints;

static void APIENTRY hear(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                          const GLchar *text, const void *user) {
    (void)source, (void)type, (void)id, (void)length, (void)user;
    if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
    complaints++;
    print_message("OpenGL: %s\n", text);
}

static void check(turns *t, dp_result result, const dp_diag *diag, const char *what) {
    if (result) fail_msg("%s: %s", what, diag->message);
    const GLenum error = t->api->GetError();
    if (error) fail_msg("%s leaves error 0x%04x", what, error);
}

static void matrix_of(const thing *g, double m[16]) {
    const double c = cos(g->degrees / 57.3), s = sin(g->degrees / 57.3);
    const double turned[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0.3, 0.125, -0.2, 1};
    memcpy(m, turned, sizeof turned);
}

static void put(turns *t, uint32_t *name, const void *data, size_t size) {
    if (!*name) t->api->GenBuffers(1, name);
    t->api->BindBuffer(GL_COPY_WRITE_BUFFER, *name);
    t->api->BufferData(GL_COPY_WRITE_BUFFER, (GLsizeiptr)size, data, GL_DYNAMIC_DRAW);
    t->api->BindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

static dp_gl_mesh *mesh_of(turns *t, dp_gl *gl, const thing *g, const model *m) {
    dp_gl_mesh *mesh = NULL;
    dp_diag diag = {0};
    double matrix[16];
    if (g->buffers) {
        const dp_gl_buffers buffers = {.positions = g->names[0],
                                       .vertex_count = m->vertices,
                                       .indices = g->names[1],
                                       .triangle_count = m->polygons,
                                       .normals = g->names[2]};
        check(t, dp_gl_mesh_from_buffers(gl, &buffers, &mesh, &diag), &diag, "mesh_from_buffers");
    } else {
        dp_source *const source = source_of(m, g->shape, g->moved);
        check(t, dp_gl_mesh_from_source(gl, source, &mesh, &diag), &diag, "mesh_from_source");
        dp_source_destroy(source);
    }
    matrix_of(g, matrix);
    check(t, dp_gl_mesh_place(mesh, g->placed ? matrix : NULL, &diag), &diag, "mesh_place");
    return mesh;
}

static void upload(turns *t, thing *g, const model *m) {
    put(t, &g->names[0], m->positions, 12 * (size_t)m->vertices);
    put(t, &g->names[1], m->corners, 4 * (size_t)m->firsts[m->polygons]);
    put(t, &g->names[2], m->normals, 12 * (size_t)m->vertices);
}

static void make_anew(turns *t, thing *g) {
    model m;
    dp_gl_mesh_destroy(g->mesh);
    g->shape = (shape)(dice(8) ? dice(3) : NOTHING);
    g->buffers = g->shape == SHEETS && dice(2);
    g->wave = 0, g->placed = dice(3) == 0, g->degrees = dice(90), g->moved = dice(5) == 0;
    make_model(&m, g->shape, g->wave);
    if (g->buffers) upload(t, g, &m);
    g->mesh = mesh_of(t, t->test->gl, g, &m);
}

static void update(turns *t, thing *g) {
    model m;
    dp_diag diag = {0};
    make_model(&m, g->shape, g->wave);
    if (g->buffers) {
        upload(t, g, &m);
        return;
    }
    dp_source *const source = source_of(&m, g->shape, g->moved);
    check(t, dp_gl_mesh_update(g->mesh, source, &diag), &diag, "mesh_update");
    dp_source_destroy(source);
}

static void change(turns *t) {
    thing *const g = &t->things[dice(THINGS)];
    double matrix[16];
    switch (dice(6)) {
    case 0:
        make_anew(t, g);
        break;
    case 1: /* positions */
        g->wave = 0.1f * (float)dice(4);
        update(t, g);
        break;
    case 2: /* topology */
        if (!g->buffers) g->shape = (shape)dice(SHAPES), g->moved = dice(5) == 0;
        update(t, g);
        break;
    case 3:
        g->placed = dice(4), g->degrees = dice(90);
        matrix_of(g, matrix);
        assert_int_equal(dp_gl_mesh_place(g->mesh, g->placed ? matrix : NULL, NULL), DP_OK);
        break;
    case 4:
        t->count = dice(8) ? 1 + dice(THINGS) : 0;
        break;
    default:
        break; /* the same again */
    }
}

/* ------- styles ------- */

static void choose_lines(dp_style *s, turns *t) {
    static const uint32_t sets[] = {0,
                                    0,
                                    DP_SILHOUETTE,
                                    DP_NO_LINES,
                                    DP_SIL_RIDGE_VALLEY,
                                    DP_INTERSECTION,
                                    DP_BORDER | DP_VALLEY};
    const uint32_t kind = dice(8);
    s->lines = sets[dice(sizeof sets / sizeof *sets)];
    s->line[DP_LINE_SILHOUETTE] = (dp_line_style){(float[]){0, 3, 64, 0.5f}[dice(4)], 0};
    s->line[DP_LINE_RIDGE].color = dice(2) ? DP_RGB(200, 30, 10) : 0;
    if (dice(4) == 0) s->ridge_angle = (float[]){0.1f, 359.9f, 179}[dice(3)];
    if (dice(4) == 0) s->valley_angle = (float[]){0.1f, 359.9f, 181}[dice(3)];
    s->cull_back_faces = dice(4) == 0, s->edge_table_off = dice(4) == 0;
    if (kind < 3) {
        s->edges = kind == 2 ? DP_EDGES_ADJACENCY : DP_EDGES_EMERGENT;
    } else if (kind < 7) {
        s->ink = DP_INK_QUADS, s->method = (dp_method)dice(2);
        s->between = (dp_between)dice(3);
        if (s->between == DP_BETWEEN_INTERVAL) s->passes = 1 + (int)dice(2);
    } else {
        s->ink = DP_INK_QUADS, s->edges = DP_EDGES_ADJACENCY, s->method = DP_METHOD_PAPER;
        s->passes = 1 + (int)dice(2);
        s->lines = dice(2) ? DP_SILHOUETTE | DP_BORDER : DP_SILHOUETTE;
        if (dice(2)) s->stroke.texture = t->textures[dice(2)];
    }
}

static void choose_shades(dp_style *s, bool buffers) {
    static uint8_t strokes[16 * 16];
    dp_shade *const h = &s->shade;
    for (int i = 0; i < 256; i++) strokes[i] = (uint8_t)(i * 37);
    h->shading = dice(2) ? (dp_shading)dice(DP_SHADING_COUNT) : DP_SHADING_FLAT;
    h->model_colors = dice(3) == 0, h->object_space = dice(2), h->nearest = dice(2);
    h->normals = (dp_normals)(buffers ? 2 * dice(2) : dice(3));
    h->crease_angle = dice(2) ? 0 : 100;
    if (dice(4) == 0) h->strokes = (dp_image){strokes, 16, 16};
    h->pencil_tones = dice(2) ? 0 : 3, h->pencil_printed = dice(2);
    if (dice(3) == 0)
        s->edge_map = (dp_edge_map){.detector = (dp_edge_detector)(1 + dice(2)),
                                    .as_printed = dice(2),
                                    .eight_bits = dice(2),
                                    .hidden = dice(5) == 0,
                                    .radius = 1 + dice(4)};
    if (dice(4) == 0)
        s->mirror = (dp_mirror){.normal = {0, 1, 0.2},
                                .offset = -0.75 - 0.25 * dice(3),
                                .size = 4,
                                .tint_share = 0.2f,
                                .fade = dice(2) ? 0 : 2};
    s->surface = (dp_color[]){0, DP_RGB(210, 180, 90), DP_COLOR_NONE}[dice(3)];
}

static void choose_camera(turn *u) {
    static const double eyes[3][3] = {{1.5, 2, 4}, {-3, 1, 2}, {0.5, 0.25, 0.5}}, at[3] = {0, 0, 0},
                        up[3] = {0, 1, 0};
    const double aspect = (double)u->target.width / u->target.height;
    assert_int_equal(dp_camera_look_at(&u->camera, eyes[dice(8) ? dice(2) : 2], at, up), DP_OK);
    const dp_result result = dice(2) ? dp_camera_perspective(&u->camera, 45, aspect, 0.5, 20)
                                     : dp_camera_orthographic(&u->camera, 3.5, aspect, -2, 20);
    assert_int_equal(result, DP_OK);
}

/* Something of the application's in the left half, at a depth in between. */
static uint32_t depth_of(turns *t, int size, const dp_gl_target *target) {
    float values[SIDE * SIDE];
    uint32_t *const name = &t->depth[size];
    if (*name) return *name;
    for (uint32_t i = 0; i < target->width * target->height; i++)
        values[i] = i % target->width < target->width / 2 ? 0.85f : 1;
    t->api->GenTextures(1, name);
    t->api->ActiveTexture(GL_TEXTURE0);
    t->api->BindTexture(GL_TEXTURE_2D, *name);
    t->api->TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, (GLsizei)target->width,
                         (GLsizei)target->height);
    t->api->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)target->width, (GLsizei)target->height,
                          GL_DEPTH_COMPONENT, GL_FLOAT, values);
    t->api->BindTexture(GL_TEXTURE_2D, 0);
    return *name;
}

static bool has_buffers(const turns *t) {
    bool has = false;
    for (uint32_t i = 0; i < t->count; i++) has |= t->things[i].buffers;
    return has;
}

static void choose(turns *t, turn *u) {
    static const uint32_t sizes[SIZES][2] = {{96, 64}, {64, 96}, {33, 17}, {1, 1}, {SIDE, 1}};
    const uint32_t size = dice(8) ? dice(3) : 3 + dice(2);
    memset(u, 0, sizeof *u);
    choose_lines(&u->style, t);
    choose_shades(&u->style, has_buffers(t));
    u->target = (dp_gl_target){.framebuffer = t->framebuffer,
                               .width = sizes[size][0],
                               .height = sizes[size][1],
                               .samples = dice(3)   ? 4
                                          : dice(6) ? 1
                                                    : 16,
                               .transparent = dice(4) == 0};
    u->target.x = (int32_t)dice(SIDE - u->target.width + 1);
    u->target.y = (int32_t)dice(SIDE - u->target.height + 1);
    if (dice(6) == 0) u->target.depth_texture = depth_of(t, (int)size, &u->target);
    choose_camera(u);
    u->reads = dice(16);
    const dp_style *const s = &u->style;
    snprintf(u->name, sizeof u->name,
             "%ux%u/%u lines %x ink %d edges %d method %d between %d passes %d shading %d normals "
             "%d map %d mirror %d depth %d cull %d texture %d colors %d meshes %u",
             u->target.width, u->target.height, u->target.samples, s->lines, s->ink, s->edges,
             s->method, s->between, s->passes, s->shade.shading, s->shade.normals,
             s->edge_map.detector, s->mirror.size > 0, u->target.depth_texture != 0,
             s->cull_back_faces, s->stroke.texture != NULL, s->shade.model_colors, t->count);
}

/* ------- a picture, both ways ------- */

typedef struct picture {
    uint8_t rgba[4 * SIDE * SIDE];
    dp_segment *segments;
    size_t count;
    dp_result result;
} picture;

static void clear_framebuffer(turns *t) {
    static const GLfloat color[4] = {0.25f, 0.5f, 0.75f, 0.5f};
    t->api->BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    t->api->ClearBufferfv(GL_COLOR, 0, color);
    t->api->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void draw(turns *t, dp_gl *gl, dp_gl_mesh *const *meshes, const turn *u, picture *out) {
    const dp_gl_target all = {.framebuffer = t->framebuffer, .width = SIDE, .height = SIDE};
    const dp_segment *segments = NULL;
    dp_diag diag = {0};
    clear_framebuffer(t);
    out->result = dp_gl_draw(gl, meshes, t->count, &u->camera, &u->style, &u->target, &diag);
    out->segments = NULL, out->count = 0;
    check(t, out->result == DP_ERR_UNSUPPORTED ? DP_OK : out->result, &diag, u->name);
    if (out->result) return;
    check(t, dp_gl_read(gl, &all, out->rgba, 0, &diag), &diag, "dp_gl_read");
    check(t, dp_gl_segments(gl, &segments, &out->count, &diag), &diag, "dp_gl_segments");
    out->segments = malloc((out->count + 1) * sizeof *segments);
    if (out->count) memcpy(out->segments, segments, out->count * sizeof *segments);
}

static void draw_fresh(turns *t, const turn *u, picture *out) {
    const dp_gl_desc desc = {.get_proc_address = gl_context_proc, .user = t->test->context};
    dp_gl_mesh *meshes[THINGS] = {NULL};
    dp_gl *gl;
    dp_diag diag = {0};
    check(t, dp_gl_create(&desc, &gl, &diag), &diag, "dp_gl_create");
    for (uint32_t i = 0; i < t->count; i++) {
        model m;
        make_model(&m, t->things[i].shape, t->things[i].wave);
        meshes[i] = mesh_of(t, gl, &t->things[i], &m);
    }
    draw(t, gl, meshes, u, out);
    for (uint32_t i = 0; i < t->count; i++) dp_gl_mesh_destroy(meshes[i]);
    dp_gl_destroy(gl);
    check(t, DP_OK, &diag, "dp_gl_destroy");
}

static bool same_segment(const dp_segment *a, const dp_segment *b) {
    return a->line == b->line && !memcmp(a->a, b->a, sizeof a->a) &&
           !memcmp(a->b, b->b, sizeof a->b) && !memcmp(a->world_a, b->world_a, sizeof a->world_a) &&
           !memcmp(a->world_b, b->world_b, sizeof a->world_b) && a->polygon == b->polygon &&
           a->other == b->other && a->edge == b->edge && a->group == b->group &&
           !memcmp(a->end, b->end, sizeof a->end) && !memcmp(a->hider, b->hider, sizeof a->hider) &&
           a->chain == b->chain && a->place == b->place && a->reversed == b->reversed &&
           !(a->width < b->width) && !(a->width > b->width) && a->color == b->color;
}

static int compare(const picture *a, const picture *b, const turn *u, uint32_t number) {
    size_t pixels = 0, segments = 0;
    for (size_t i = 0; i < sizeof a->rgba && !a->result; i += 4)
        pixels += memcmp(a->rgba + i, b->rgba + i, 4) != 0;
    for (size_t i = 0; i < a->count && i < b->count; i++)
        segments += !same_segment(&a->segments[i], &b->segments[i]);
    if (!pixels && !segments && a->count == b->count && a->result == b->result) return 0;
    print_message("turn %u: %zu pixels, %zu segments of %zu and %zu are others: %s\n", number,
                  pixels, segments, a->count, b->count, u->name);
    return 1;
}

/* What an application may do with the last picture before it goes on. */
static void use(turns *t, uint32_t reads, dp_context *context) {
    dp_gl *const gl = t->test->gl;
    const dp_segment *segments;
    dp_gl_lines lines;
    dp_gl_stats stats;
    dp_diag diag = {0};
    size_t count;
    if (reads & 1) check(t, dp_gl_segments(gl, &segments, &count, &diag), &diag, "dp_gl_segments");
    if (reads & 2) check(t, dp_gl_hand_over(gl, context, &diag), &diag, "dp_gl_hand_over");
    if (reads & 4) check(t, dp_gl_lines_of(gl, &lines, &diag), &diag, "dp_gl_lines_of");
    if (reads & 8) check(t, dp_gl_stats_of(gl, &stats, &diag), &diag, "dp_gl_stats_of");
    dp_gl_time_stages(gl, reads & 8);
}

static int take_turn(turns *t, uint32_t number, dp_context *context) {
    static picture kept, fresh;
    dp_gl_mesh *meshes[THINGS];
    turn u;
    for (uint32_t i = dice(3); i > 0; i--) change(t);
    choose(t, &u);
    for (uint32_t i = 0; i < t->count; i++) meshes[i] = t->things[i].mesh;
    draw(t, t->test->gl, meshes, &u, &kept);
    if (!kept.result) use(t, u.reads, context);
    draw_fresh(t, &u, &fresh);
    const int wrong = compare(&kept, &fresh, &u, number);
    free(kept.segments), free(fresh.segments);
    return wrong;
}

/* ------- objects of OpenGL's ------- */

static int count_objects(const turns *t) {
    enum { NAMES = 4096 };
    const dp_gl_api *const a = t->api;
    int count = 0;
    for (int i = 0; i < SIZES; i++) count -= t->depth[i] != 0;
    for (GLuint i = 1; i < NAMES; i++)
        count += a->IsBuffer(i) + a->IsTexture(i) + a->IsFramebuffer(i);
    return count;
}

/* ------- tests ------- */

static void begin(turns *t, gl_test *test) {
    static const char *const names[2] = {"charcoal", "rope"};
    const dp_gl_target target = gl_test_target(test, SIDE, SIDE, 1);
    memset(t, 0, sizeof *t);
    t->test = test, t->api = &test->gl->api;
    t->framebuffer = target.framebuffer;
    for (int i = 0; i < 2; i++)
        assert_int_equal(dp_texture_named(names[i], 0, NULL, &t->textures[i], NULL), DP_OK);
    t->api->DebugMessageCallback(hear, NULL);
    t->api->Enable(GL_DEBUG_OUTPUT);
    for (int i = 0; i < THINGS; i++) make_anew(t, &t->things[i]);
    t->count = 1;
}

static void end(turns *t) {
    dp_gl_stats stats;
    for (int i = 0; i < THINGS; i++) {
        dp_gl_mesh_destroy(t->things[i].mesh);
        t->api->DeleteBuffers(3, t->things[i].names);
    }
    for (int i = 0; i < 2; i++) dp_texture_destroy(t->textures[i]);
    t->api->DeleteTextures(SIZES, t->depth);
    assert_int_equal(dp_gl_stats_of(t->test->gl, &stats, NULL), DP_OK);
    assert_int_equal(complaints, 0);
}

static int take_turns(turns *t, uint64_t seed, uint32_t count) {
    dp_context *context;
    int wrong = 0;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    dice_state = seed;
    for (uint32_t i = 0; i < count; i++) wrong += take_turn(t, i, context);
    dp_context_destroy(context);
    return wrong;
}

static void draws_as_if_new(void **state) {
    const char *const seed = getenv("DP_TEST_SEED"), *const asked = getenv("DP_TEST_TURNS");
    const uint32_t count = asked ? (uint32_t)atoi(asked) : 12;
    gl_test *const test = *state;
    turns t;
    if (!test->gl) skip();
    begin(&t, test);
    if (seed)
        assert_int_equal(take_turns(&t, strtoull(seed, NULL, 0), count), 0);
    else
        for (uint64_t s = 1; s <= 3; s++) assert_int_equal(take_turns(&t, s, count), 0);
    end(&t);
}

/* One dp_gl after the other: nothing of them stays. */
static void leaves_nothing(void **state) {
    gl_test *const test = *state;
    turns t;
    turn u;
    static picture out;
    if (!test->gl) skip();
    dice_state = 7;
    begin(&t, test);
    int before = 0;
    for (int i = 0; i < 20; i++) {
        if (i == 1) before = count_objects(&t);
        choose(&t, &u);
        u.target.depth_texture = 0;
        draw_fresh(&t, &u, &out);
        free(out.segments);
    }
    assert_int_equal(count_objects(&t), before);
    end(&t);
}

/* Many meshes are as one, with and without a mirror. */
static void joins_many(void **state) {
    enum { MANY = 33 };
    static model models[MANY];
    static uint8_t many[4 * SIDE * SIDE], one[4 * SIDE * SIDE];
    gl_test *const test = *state;
    const dp_gl_target target = gl_test_target(test, SIDE, SIDE, 4);
    dp_source *sources[MANY], *joined;
    dp_gl_mesh *meshes[MANY], *mesh;
    dp_camera camera;
    dp_diag diag;
    static const double eye[3] = {2, 3, 6}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    dp_style style = {.surface = DP_RGB(200, 180, 160)};
    if (!test->gl) skip();
    assert_int_equal(dp_camera_look_at(&camera, eye, at, up), DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 45, 1, 0.5, 20), DP_OK);
    for (int i = 0; i < MANY; i++) {
        make_model(&models[i], i % 2 ? TORUS : BOX, 0);
        for (uint32_t v = 0; v < models[i].vertices; v++) {
            float *const p = models[i].positions[v];
            for (int k = 0; k < 3; k++) p[k] *= 0.5f;
            p[0] += (float)(i % 6) * 0.6f - 1.5f, p[1] += (float)(i / 6) * 0.5f - 1.5f;
        }
        sources[i] = source_of(&models[i], i % 2 ? TORUS : BOX, false);
        assert_int_equal(dp_gl_mesh_from_source(test->gl, sources[i], &meshes[i], &diag), DP_OK);
    }
    assert_int_equal(dp_source_join(sources, NULL, MANY, NULL, &joined, NULL), DP_OK);
    assert_int_equal(dp_gl_mesh_from_source(test->gl, joined, &mesh, &diag), DP_OK);
    for (int i = 0; i < 2; i++) {
        if (i) style.mirror = (dp_mirror){.normal = {0, 1, 0.2}, .offset = -2, .size = 6};
        assert_int_equal(dp_gl_draw(test->gl, meshes, MANY, &camera, &style, &target, &diag), 0);
        assert_int_equal(dp_gl_read(test->gl, &target, many, 0, &diag), DP_OK);
        assert_int_equal(dp_gl_draw(test->gl, &mesh, 1, &camera, &style, &target, &diag), DP_OK);
        assert_int_equal(dp_gl_read(test->gl, &target, one, 0, &diag), DP_OK);
        gl_test_keep(i ? "turns_many_mirrored" : "turns_many", many, SIDE, SIDE);
        gl_test_keep(i ? "turns_one_mirrored" : "turns_one", one, SIDE, SIDE);
        assert_true(gl_test_alike(many, one, SIDE, SIDE, 0) == 1.0);
    }
    for (int i = 0; i < MANY; i++) dp_gl_mesh_destroy(meshes[i]);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(joined);
}

/* A dp_gl each of two contexts, by turns. */
static void lives_in_two_contexts(void **state) {
    gl_test *const test = *state;
    void *second;
    turns t[2];
    turn u;
    static picture out[2];
    if (!test->gl) skip();
    assert_int_equal(gl_test_setup(&second), 0);
    gl_test *const tests[2] = {test, second};
    for (int i = 0; i < 2; i++) {
        gl_context_use(tests[i]->context);
        dice_state = 11;
        begin(&t[i], tests[i]);
    }
    for (uint32_t number = 0; number < 4; number++) {
        const uint64_t dice_before = dice_state;
        for (int i = 0; i < 2; i++) {
            dp_gl_mesh *meshes[THINGS];
            gl_context_use(tests[i]->context);
            dice_state = dice_before;
            change(&t[i]);
            choose(&t[i], &u);
            for (uint32_t k = 0; k < t[i].count; k++) meshes[k] = t[i].things[k].mesh;
            draw(&t[i], tests[i]->gl, meshes, &u, &out[i]);
        }
        assert_int_equal(compare(&out[0], &out[1], &u, number), 0);
        for (int i = 0; i < 2; i++) free(out[i].segments);
    }
    for (int i = 0; i < 2; i++) {
        gl_context_use(tests[i]->context);
        end(&t[i]);
    }
    gl_test_teardown(&second);
    gl_context_use(test->context);
}

static dp_result refuse(void *user, dp_batch *batch, dp_diag *diag) {
    (void)user, (void)batch, (void)diag;
    return DP_ERR_FORMAT;
}

/* After an update that failed there are no lines, of no mesh, and then others again. */
static void forgets_lines_of_a_failed_update(void **state) {
    static model m;
    gl_test *const test = *state;
    const dp_gl_target target = gl_test_target(test, 512, 1, 16);
    const dp_source_callbacks callbacks = {.next = refuse};
    const dp_style style = {.line[DP_LINE_SILHOUETTE].width = 64};
    const dp_segment *segments;
    dp_source *good, *bad;
    dp_gl_mesh *mesh;
    dp_camera camera;
    dp_diag diag;
    size_t count;
    static const double eye[3] = {2, 3, 6}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, at, up), DP_OK);
    assert_int_equal(dp_camera_orthographic(&camera, 3, 1, 0.5, 20), DP_OK);
    make_model(&m, TORUS, 0);
    good = source_of(&m, TORUS, false);
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &bad, NULL), DP_OK);
    assert_int_equal(dp_gl_mesh_from_source(test->gl, good, &mesh, &diag), DP_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(dp_gl_draw(test->gl, &mesh, 1, &camera, &style, &target, &diag), DP_OK);
        assert_int_equal(dp_gl_segments(test->gl, &segments, &count, &diag), DP_OK);
        assert_true(count > 0);
        assert_int_equal(dp_gl_mesh_update(mesh, bad, &diag), DP_ERR_FORMAT);
        assert_int_equal(dp_gl_segments(test->gl, &segments, &count, &diag), DP_ERR_ARGUMENT);
        assert_int_equal(dp_gl_mesh_update(mesh, good, &diag), DP_OK);
    }
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(good), dp_source_destroy(bad);
}

#define FRESH(f) cmocka_unit_test_setup_teardown(f, gl_test_setup, gl_test_teardown)

int main(void) {
    const struct CMUnitTest tests[] = {FRESH(draws_as_if_new), FRESH(leaves_nothing),
                                       FRESH(joins_many), FRESH(lives_in_two_contexts),
                                       FRESH(forgets_lines_of_a_failed_update)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
