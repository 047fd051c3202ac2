/* dp_draw_grouped: a style for each group, with every look, ink and way to find lines. */
#include "scene.h"
#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    RED = 0xC02020FF,
    BLUE = 0x2040C0FF,
    GREEN = 0x20A040FF,
    PIXELS = SCENE_WIDTH * SCENE_HEIGHT
};

static scene boxes; /* two that stand apart, and one behind them: groups 0, 1, 2 */
static uint16_t box_groups[SCENE_POLYGONS];

static void fill_boxes(void) {
    static const float places[3][2][3] = {
        {{-3, -1, -1}, {-1, 1, 1}}, {{1, -1, -1}, {3, 1, 1}}, {{-2, -1.5f, -5}, {2, 1.5f, -3}}};
    if (boxes.polygons) return;
    for (int k = 0; k < 3; k++) {
        const size_t first = boxes.polygons;
        scene_box(&boxes, places[k][0], places[k][1]);
        for (size_t i = first; i < boxes.polygons; i++) box_groups[i] = (uint16_t)k;
    }
}

typedef struct drawn {
    picture picture;
    uint16_t id[PIXELS];
    dp_context *context;
} drawn;

static dp_result draw_source(drawn *d, dp_source *source, const dp_style *style,
                             const dp_style *groups, uint32_t count, bool grouped, dp_diag *diag) {
    const dp_camera camera = scene_camera(3, 4, 11, 0, 0, -1);
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = d->picture.rgba,
                              .line_class = d->picture.line_class,
                              .depth = d->picture.depth,
                              .id = d->id};
    return grouped
               ? dp_draw_grouped(d->context, source, &camera, style, groups, count, &target, diag)
               : dp_draw(d->context, source, &camera, style, &target, diag);
}

static dp_source *boxes_source(void) {
    dp_source *source;
    fill_boxes();
    dp_batch batch = scene_batch(&boxes);
    batch.groups = box_groups;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

static void begin(drawn *d, uint32_t threads) {
    const dp_context_desc desc = {.threads = threads};
    assert_int_equal(dp_context_create(&desc, &d->context, NULL), DP_OK);
}

/* With styles of `count` groups, or, if that is -1, by dp_draw. */
static void draw(drawn *d, const dp_style *style, const dp_style *groups, int count) {
    dp_diag diag = {0};
    dp_source *const source = boxes_source();
    if (draw_source(d, source, style, groups, (uint32_t)count, count >= 0, &diag))
        fail_msg("%s", diag.message);
    dp_source_destroy(source);
}

static drawn one, other;

static int set_up(void **state) {
    (void)state;
    begin(&one, 2);
    begin(&other, 2);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dp_context_destroy(one.context);
    dp_context_destroy(other.context);
    return 0;
}

static void assert_same(const char *what) {
    if (memcmp(&one.picture, &other.picture, sizeof one.picture) != 0 ||
        memcmp(one.id, other.id, sizeof one.id) != 0)
        fail_msg("%s: the pictures differ", what);
}

/* ------- one style for all ------- */

/* Every way to draw: with no groups, and with groups that are like the picture. */
static void groups_like_the_picture_change_nothing(void **state) {
    (void)state;
    const struct {
        const char *what;
        dp_style style;
    } cases[] = {
        {"defaults", {0}},
        {"colours", {.surface = RED, .paper = 0xFFFFE080, .line = {{5, BLUE}}}},
        {"gooch", {.surface = GREEN, .shade = {.shading = DP_SHADING_GOOCH}}},
        {"toon", {.surface = GREEN, .shade = {.shading = DP_SHADING_TOON}}},
        {"hatch", {.shade = {.shading = DP_SHADING_HATCH}}},
        {"pencil", {.shade = {.shading = DP_SHADING_PENCIL}}},
        {"paper", {.surface = RED, .shade = {.shading = DP_SHADING_PAPER}}},
        {"edge map", {.edge_map = {.detector = DP_EDGE_MAP_C1}}},
        {"hidden", {.hidden = {.look = DP_HIDDEN_DASHED, .levels = 3}}},
        {"quads", {.ink = DP_INK_QUADS, .line = {{4, BLUE}, {3, RED}}}},
        {"stencil", {.ink = DP_INK_QUADS, .between = DP_BETWEEN_STENCIL}},
        {"paper's quads", {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER}},
        {"adjacency", {.edges = DP_EDGES_ADJACENCY}},
        {"fins", {.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS, .method = DP_METHOD_PAPER}},
        {"smooth", {.smooth = DP_SMOOTH_SURFACE, .smooth_level = 2}},
        {"detail", {.detail = 1}},
        {"backs", {.cull_back_faces = true}},
        {"mirror",
         {.mirror = {.normal = {0, 1, 0}, .offset = -1.6, .size = 14, .tint_share = 0.2f}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dp_style groups[3];
        for (int g = 0; g < 3; g++) groups[g] = cases[i].style;
        draw(&one, &cases[i].style, NULL, -1);
        draw(&other, &cases[i].style, NULL, 0);
        assert_same(cases[i].what);
        draw(&other, &cases[i].style, groups, 3);
        assert_same(cases[i].what);
        draw(&other, &cases[i].style, groups, 1);
        assert_same(cases[i].what);
    }
    draw(&one, NULL, NULL, -1);
    draw(&other, NULL, NULL, 0);
    assert_same("no style");
}

/* What holds for the whole picture is not taken from groups. */
static void other_members_of_groups_are_not_looked_at(void **state) {
    (void)state;
    const dp_style all = {.surface = RED};
    const dp_style group = {.surface = RED,
                            .paper = BLUE,
                            .edges = (dp_edges)99,
                            .ink = DP_INK_QUADS,
                            .detail = 1,
                            .hidden = {.look = DP_HIDDEN_DASHED},
                            .stroke = {.jitter = 1e9f},
                            .mirror = {.size = 9},
                            .shade = {.shading = DP_SHADING_GOOCH, .highlight = 7}};
    draw(&one, &all, NULL, -1);
    draw(&other, &all, &group, 1);
    assert_same("a group's members");
}

/* ------- lines ------- */

static const dp_style plain = {
    .line = {{2, GREEN}, {2, GREEN}, {2, GREEN}, {2, GREEN}, {2, GREEN}}};

static void lines_have_the_style_of_their_group(void **state) {
    (void)state;
    dp_style groups[2] = {plain, plain};
    size_t count, of[3] = {0};
    groups[0].line[DP_LINE_RIDGE] = (dp_line_style){5, RED};
    groups[1].lines = DP_SILHOUETTE;
    groups[1].line[DP_LINE_SILHOUETTE] = (dp_line_style){3, BLUE};
    draw(&one, &plain, groups, 2);
    const dp_segment *const s = dp_segments(one.context, &count);
    for (size_t i = 0; i < count; i++) {
        const bool ridge = s[i].line == DP_LINE_RIDGE;
        assert_true(s[i].group < 3);
        of[s[i].group]++;
        if (s[i].group == 1) assert_int_equal(s[i].line, DP_LINE_SILHOUETTE);
        const dp_color color = s[i].group == 1 ? BLUE : s[i].group == 0 && ridge ? RED : GREEN;
        const float width = s[i].group == 1 ? 3 : s[i].group == 0 && ridge ? 5 : 2;
        assert_true(s[i].color == color && s[i].width == width);
    }
    assert_true(of[0] && of[1] && of[2]);
}

static void folds_are_told_by_the_angles_of_their_group(void **state) {
    (void)state;
    dp_style groups[2] = {plain, plain};
    size_t count, of[3] = {0};
    groups[1].ridge_angle = 80; /* a box's are of 90 degrees */
    draw(&one, &plain, groups, 2);
    const dp_segment *const s = dp_segments(one.context, &count);
    for (size_t i = 0; i < count; i++) of[s[i].group] += s[i].line == DP_LINE_RIDGE;
    assert_true(of[0] && !of[1] && of[2]);
}

static void hidden_lines_have_the_style_of_their_group(void **state) {
    (void)state;
    dp_style all = plain, groups[3] = {plain, plain, plain};
    size_t count, hidden = 0, whole;
    all.hidden = (dp_hidden){.look = DP_HIDDEN_SOLID, .levels = 1};
    for (int line = 0; line < DP_LINE_COUNT; line++)
        groups[2].hidden.line[0][line] = (dp_line_style){1.5f, RED};
    draw(&one, &all, groups, 3);
    const dp_segment *const s = dp_segments(one.context, &count);
    for (size_t i = 0; i < count; i++) {
        if (!s[i].level) continue;
        hidden += s[i].group == 2;
        assert_int_equal(s[i].color, s[i].group == 2 ? RED : GREEN);
        assert_true(s[i].width == (s[i].group == 2 ? 1.5f : 2));
    }
    assert_true(hidden);
    /* a group without lines has no hidden ones */
    groups[2].lines = DP_NO_LINES;
    draw(&one, &all, groups, 3);
    (void)dp_segments(one.context, &whole);
    const dp_segment *const t = dp_segments(one.context, &whole);
    for (size_t i = 0; i < whole; i++) assert_int_not_equal(t[i].group, 2);
}

/* One box of two groups: the edge between them is that of the polygon that comes first. */
static void shared_edges_are_the_first_polygon_s(void **state) {
    (void)state;
    static scene box;
    static uint16_t groups[6];
    const dp_edges ways[] = {DP_EDGES_EMERGENT, DP_EDGES_EMERGENT, DP_EDGES_ADJACENCY};
    if (!box.polygons) scene_box(&box, (const float[]){-1, -1, -1}, (const float[]){1, 1, 1});
    for (uint32_t way = 0; way < 12; way++) {
        dp_style all = plain, styles[2] = {plain, plain};
        dp_source *source;
        dp_diag diag = {0};
        size_t count, seen[2] = {0};
        const uint16_t first = way & 1;
        all.edges = ways[way / 4];
        all.edge_table_off = way / 4 == 1;
        for (int line = 0; line < DP_LINE_COUNT; line++)
            styles[1].line[line].color = RED; /* group 0 stays green */
        for (uint16_t i = 0; i < 6; i++) groups[i] = i < 3 ? first : !first;
        dp_batch batch = scene_batch(&box);
        batch.groups = groups;
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        drawn *const d = way & 2 ? &one : &other;
        if (draw_source(d, source, &all, styles, 2, true, &diag)) fail_msg("%s", diag.message);
        const dp_segment *const s = dp_segments(d->context, &count);
        assert_true(count >= 9);
        for (size_t i = 0; i < count; i++) {
            assert_int_equal(s[i].group, groups[s[i].polygon]);
            assert_int_equal(s[i].color, s[i].group ? RED : GREEN);
            if (all.edges != DP_EDGES_EMERGENT || all.edge_table_off || s[i].other == UINT64_MAX)
                continue;
            assert_true(s[i].polygon < s[i].other);
            seen[groups[s[i].other] != s[i].group]++;
        }
        if (all.edges == DP_EDGES_EMERGENT && !all.edge_table_off) assert_true(seen[0] && seen[1]);
        dp_source_destroy(source);
    }
}

static void threads_do_not_matter(void **state) {
    (void)state;
    dp_style all = {.shade = {.shading = DP_SHADING_GOOCH}}, groups[3] = {{0}};
    groups[0] = (dp_style){.surface = RED, .line = {{9, BLUE}}};
    groups[2] = (dp_style){.surface = DP_COLOR_NONE, .lines = DP_RIDGE | DP_SILHOUETTE};
    draw(&one, &all, groups, 3);
    const uint32_t threads[] = {1, 3, 7};
    for (int i = 0; i < 3; i++) {
        dp_context_destroy(other.context);
        begin(&other, threads[i]);
        draw(&other, &all, groups, 3);
        assert_same("threads");
    }
}

/* ------- as immediate mode ------- */

static void record(dp_context *context, const dp_style *group, size_t first, size_t last) {
    dp_disable(context, DP_ALL_LINES);
    dp_enable(context, group->lines ? group->lines : DP_ALL_LINES);
    for (int line = 0; line < DP_LINE_COUNT; line++) {
        dp_line_width(context, 1u << line, group->line[line].width);
        dp_line_color(context, 1u << line, group->line[line].color);
    }
    dp_surface_color(context, group->surface);
    for (size_t i = first; i < last; i++) {
        dp_begin(context, DP_POLYGON);
        for (uint32_t c = boxes.firsts[i]; c < boxes.firsts[i + 1]; c++)
            dp_vertex3fv(context, boxes.positions[c]);
        dp_end(context);
    }
}

static void immediate_mode_draws_the_same(void **state) {
    (void)state;
    fill_boxes();
    const dp_ink inks[] = {DP_INK_STROKES, DP_INK_QUADS};
    for (int i = 0; i < 2; i++) {
        const dp_style all = {.ink = inks[i], .paper = 0xEEEEEEFF};
        dp_style groups[3] = {{.surface = RED, .line = {{4, BLUE}}},
                              {.surface = DP_COLOR_NONE, .lines = DP_SILHOUETTE | DP_RIDGE},
                              {.surface = GREEN}};
        const dp_camera camera = scene_camera(3, 4, 11, 0, 0, -1);
        const dp_target target = {.width = SCENE_WIDTH,
                                  .height = SCENE_HEIGHT,
                                  .rgba = one.picture.rgba,
                                  .line_class = one.picture.line_class,
                                  .depth = one.picture.depth,
                                  .id = one.id};
        dp_set_style(one.context, &all);
        dp_set_camera(one.context, &camera);
        for (size_t g = 0; g < 3; g++) record(one.context, &groups[g], 6 * g, 6 * g + 6);
        dp_diag diag = {0};
        if (dp_finish(one.context, &target, &diag)) fail_msg("%s", diag.message);
        draw(&other, &all, groups, 3);
        assert_same("immediate mode");
    }
}

/* ------- surfaces ------- */

/* Pixels whose neighbours are of the same group look as if all were in that group's colour. */
static size_t compare_insides(const drawn *d, const drawn *wholes, uint16_t group,
                              const char *what) {
    size_t compared = 0;
    for (size_t y = 2; y < SCENE_HEIGHT - 2; y++)
        for (size_t x = 2; x < SCENE_WIDTH - 2; x++) {
            const size_t at = y * SCENE_WIDTH + x;
            bool inside = true;
            for (size_t k = 0; k < 25; k++)
                inside &= d->id[at + (k / 5 - 2) * SCENE_WIDTH + k % 5 - 2] == group + 1;
            if (!inside) continue;
            compared++;
            if (memcmp(d->picture.rgba + 4 * at, wholes->picture.rgba + 4 * at, 4) != 0)
                fail_msg("%s: pixel %zu, %zu of group %u differs", what, x, y, group);
        }
    return compared;
}

static void surfaces_have_the_colour_of_their_group(void **state) {
    (void)state;
    const dp_color colors[3] = {RED, BLUE, DP_COLOR_NONE};
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++) {
        const dp_style all = {.lines = DP_NO_LINES,
                              .surface = GREEN,
                              .paper = 0xFFF0C0FF,
                              .shade = {.shading = (dp_shading)shading}};
        dp_style groups[3] = {all, all, all};
        for (int g = 0; g < 3; g++) groups[g].surface = colors[g];
        draw(&one, &all, groups, 3);
        for (uint16_t g = 0; g < 3; g++) {
            dp_style whole = all;
            whole.surface = colors[g];
            draw(&other, &whole, NULL, -1);
            assert_true(compare_insides(&one, &other, g, dp_shading_name((dp_shading)shading)) >
                        100);
        }
    }
}

static const char colored_text[] =
    "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 1 1 0 1 0 0\no a\nf 1 2 3\no b\nf 2 4 3\n";

static void model_s_colours_are_a_group_s_own(void **state) {
    (void)state;
    const dp_memory_file file = {colored_text, sizeof colored_text - 1, "a.obj", NULL, NULL, NULL};
    static uint8_t rgba[64][64][4];
    dp_source *source;
    dp_camera camera;
    dp_diag diag = {0};
    assert_int_equal(dp_source_open_memory(&file, NULL, &source, NULL), DP_OK);
    dp_camera_look_at(&camera, (const double[]){0.5, 0.5, 5}, (const double[]){0.5, 0.5, 0},
                      (const double[]){0, 1, 0});
    dp_camera_orthographic(&camera, 1, 1, 1, 30);
    const dp_target target = {.rgba = (uint8_t *)rgba, .width = 64, .height = 64};
    for (int whole = 0; whole < 2; whole++) {
        dp_style all = {.lines = DP_NO_LINES, .surface = BLUE};
        dp_style groups[2] = {all, all};
        all.shade.model_colors = whole; /* only of groups beyond these */
        groups[1].shade.model_colors = true;
        if (dp_draw_grouped(one.context, source, &camera, &all, groups, 2, &target, &diag))
            fail_msg("%s", diag.message);
        assert_memory_equal(rgba[50][10], ((const uint8_t[]){0x20, 0x40, 0xC0, 255}), 4);
        assert_memory_equal(rgba[10][50], ((const uint8_t[]){255, 0, 0, 255}), 4);
    }
    dp_source_destroy(source);
}

static void mirrors_show_the_groups_own_styles(void **state) {
    (void)state;
    dp_style all = {.mirror = {.normal = {0, 1, 0}, .offset = -1.6, .size = 14},
                    .lines = DP_NO_LINES};
    dp_style groups[2] = {{.lines = DP_NO_LINES, .surface = RED},
                          {.lines = DP_NO_LINES, .surface = BLUE}};
    size_t red = 0, blue = 0;
    draw(&one, &all, groups, 2);
    for (size_t i = 0; i < PIXELS; i++) {
        if (one.id[i] != 1 + DP_MIRROR_GROUP) continue;
        red += one.picture.rgba[4 * i] > 150 && one.picture.rgba[4 * i + 1] < 80;
        blue += one.picture.rgba[4 * i + 2] > 150 && one.picture.rgba[4 * i + 1] < 80;
    }
    assert_true(red > 100 && blue > 100);
}

/* ------- arguments and memory ------- */

static void wrong_calls_are_refused(void **state) {
    (void)state;
    dp_source *const source = boxes_source();
    dp_style *const many = calloc(65537, sizeof *many);
    dp_style all = {0};
    dp_diag diag;
    assert_non_null(many);
    assert_int_equal(draw_source(&one, source, &all, NULL, 2, true, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(draw_source(&one, NULL, &all, many, 2, true, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(draw_source(&one, source, &all, many, 65537, true, &diag), DP_ERR_LIMIT);
    many[1].line[DP_LINE_VALLEY].width = 1000;
    assert_int_equal(draw_source(&one, source, &all, many, 2, true, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "group 1"));
    assert_non_null(strstr(diag.message, "valley"));
    assert_int_equal(draw_source(&one, source, &all, many, 2, true, NULL), DP_ERR_ARGUMENT);
    assert_null(dp_segments(one.context, NULL));
    many[1].line[DP_LINE_VALLEY].width = 0;
    all.mirror = (dp_mirror){.normal = {0, 1, 0}, .offset = -1.6, .size = 9};
    assert_int_equal(draw_source(&one, source, &all, many, DP_MIRROR_GROUP + 1, true, &diag),
                     DP_ERR_LIMIT);
    dp_source_destroy(source);
    free(many);
}

static void all_groups_may_have_a_style(void **state) {
    (void)state;
    enum { ALL = 65536 };
    dp_style *const styles = calloc(ALL, sizeof *styles);
    uint16_t *const groups = calloc(boxes.polygons, sizeof *groups);
    const dp_ink inks[] = {DP_INK_STROKES, DP_INK_QUADS};
    assert_true(styles && groups);
    for (size_t i = 0; i < boxes.polygons; i++) groups[i] = (uint16_t)(65535 - 9 * box_groups[i]);
    for (int i = 0; i < 2; i++) {
        const dp_style all = {.ink = inks[i], .line = {{3, GREEN}, {3, GREEN}}};
        for (int g = 0; g < ALL; g++) styles[g] = (dp_style){.surface = GREEN, .line = {{6, RED}}};
        dp_style near[3] = {styles[0], styles[0], styles[0]};
        near[1].line[0].color = styles[65535 - 9].line[0].color = BLUE;
        dp_batch batch = scene_batch(&boxes);
        dp_source *source;
        dp_diag diag = {0};
        batch.groups = groups;
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        if (draw_source(&one, source, &all, styles, ALL, true, &diag)) fail_msg("%s", diag.message);
        draw(&other, &all, near, 3);
        assert_memory_equal(&one.picture, &other.picture, sizeof one.picture);
        dp_source_destroy(source);
    }
    free(styles);
    free(groups);
}

/* An allocator that knows how much it has given. */
typedef struct ledger {
    size_t bytes, calls;
} ledger;
enum { HEAD = 64 };

static void *ledger_realloc(void *block, size_t size, void *user) {
    ledger *const l = user;
    uint8_t *const old = block ? (uint8_t *)block - HEAD : NULL;
    const size_t before = old ? *(size_t *)(void *)old : 0;
    uint8_t *const made = realloc(old, size + HEAD);
    l->calls++;
    if (!made) return NULL;
    l->bytes += size - before;
    *(size_t *)(void *)made = size;
    return made + HEAD;
}
static void *ledger_alloc(size_t size, void *user) { return ledger_realloc(NULL, size, user); }
static void ledger_free(void *block, void *user) {
    if (!block) return;
    ((ledger *)user)->bytes -= *(size_t *)(void *)((uint8_t *)block - HEAD);
    free((uint8_t *)block - HEAD);
}

static void memory_is_counted_and_stays(void **state) {
    (void)state;
    ledger l = {0, 0};
    const dp_allocator memory = {ledger_alloc, ledger_realloc, ledger_free, &l};
    const dp_context_desc desc = {.allocator = &memory, .threads = 1};
    const dp_style groups[3] = {{.surface = RED}, {.lines = DP_RIDGE}, {.surface = BLUE}};
    const dp_camera camera = scene_camera(3, 4, 11, 0, 0, -1);
    const dp_target target = {
        .width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = one.picture.rgba};
    dp_source *const source = boxes_source();
    dp_context *context;
    dp_stats stats;
    size_t first = 0;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    for (int frame = 0; frame < 4; frame++) {
        if (frame == 1) first = l.calls;
        assert_int_equal(dp_draw_grouped(context, source, &camera, NULL, groups, 3, &target, NULL),
                         DP_OK);
        dp_stats_of(context, &stats);
        assert_int_equal(stats.bytes, l.bytes);
    }
    assert_int_equal(l.calls, first);
    dp_context_destroy(context);
    dp_source_destroy(source);
    assert_int_equal(l.bytes, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_like_the_picture_change_nothing),
        cmocka_unit_test(other_members_of_groups_are_not_looked_at),
        cmocka_unit_test(lines_have_the_style_of_their_group),
        cmocka_unit_test(folds_are_told_by_the_angles_of_their_group),
        cmocka_unit_test(hidden_lines_have_the_style_of_their_group),
        cmocka_unit_test(shared_edges_are_the_first_polygon_s),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(immediate_mode_draws_the_same),
        cmocka_unit_test(surfaces_have_the_colour_of_their_group),
        cmocka_unit_test(model_s_colours_are_a_group_s_own),
        cmocka_unit_test(mirrors_show_the_groups_own_styles),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(all_groups_may_have_a_style),
        cmocka_unit_test(memory_is_counted_and_stays),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
