/* Writing pages: what is refused, what stops a writer, large and odd drawings, and files. What pages
 * hold is kept in golden/pages (test_pages.c). */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "page_scene.h"
#include "temporary.h"

#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include <zlib.h>

#include <cmocka.h>

static page_scene scene;

/* ------- a writer that counts, keeps and fails ------- */

typedef struct sheet {
    char bytes[1 << 21];
    size_t size, most; /* bytes; it fails where it would hold more than `most` (0: all) */
    bool failed;
} sheet;

static sheet paper;

static dp_result keep(void *user, const char *text, size_t size, dp_diag *diag) {
    sheet *const s = user;
    assert_false(s->failed); /* nothing is written after a failure */
    if (s->most && s->size + size > s->most) {
        s->failed = true;
        if (diag) *diag = (dp_diag){.result = DP_ERR_IO, .message = "full"};
        return DP_ERR_IO;
    }
    if (s->size + size < sizeof s->bytes) memcpy(s->bytes + s->size, text, size);
    s->size += size;
    if (s->size < sizeof s->bytes) s->bytes[s->size] = 0;
    return DP_OK;
}

static const char *write_text(const dp_page *page, dp_format format) {
    dp_diag diag = {0};
    paper.size = paper.most = 0;
    paper.failed = false;
    if (dp_page_write(page, format, keep, &paper, &diag)) fail_msg("%s", diag.message);
    return paper.bytes;
}

static void assert_holds(const char *text, const char *part) {
    if (!strstr(text, part)) fail_msg("no %s in:\n%.3000s", part, text);
}

/* ------- what is refused ------- */

static void assert_refused(const dp_page *page, const char *why) {
    for (int f = 0; f < DP_FORMAT_COUNT; f++) {
        dp_diag diag = {0};
        paper = (sheet){.size = 0};
        assert_int_equal(dp_page_write(page, (dp_format)f, keep, &paper, &diag), DP_ERR_ARGUMENT);
        assert_int_equal(diag.result, DP_ERR_ARGUMENT);
        assert_holds(diag.message, why);
        assert_int_equal(paper.size, 0);
    }
}

static void wrong_pages_are_refused(void **state) {
    (void)state;
    const double sizes[] = {0, -1, NAN, INFINITY, 2e6, 1e-9};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        assert_refused(&(dp_page){.width = sizes[i], .height = 10}, "");
    assert_refused(&(dp_page){.width = 0}, "above 0 mm");
    dp_page page = *scene_make(&scene, true);
    page.views = NULL;
    assert_refused(&page, "NULL");
    page = *scene_make(&scene, true);
    page.least_width = NAN;
    assert_refused(&page, "least_width");
    static const double wrong[] = {-1, NAN, INFINITY, 1e9, 1e-9};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        page = *scene_make(&scene, true);
        scene.views[1].mm_per_px = wrong[i];
        assert_refused(&page, "view 1");
    }
    scene.views[1].mm_per_px = 1;
    scene.views[1].x = NAN;
    assert_refused(&page, "view 1");
    scene.views[1].x = 0;
    scene.views[1].drawing = NULL;
    assert_refused(&page, "view 1 has no drawing");
}

static void wrong_marks_are_refused(void **state) {
    (void)state;
    dp_page_text text = {"x", 0, 0, NAN};
    dp_page_rule rule = {0, 0, INFINITY, 0, 1};
    dp_page page = {.width = 9, .height = 9, .texts = &text, .text_count = 1};
    assert_refused(&page, "text 0");
    text = (dp_page_text){NULL, 0, 0, 3};
    assert_refused(&page, "text 0");
    page = (dp_page){.width = 9, .height = 9, .rules = &rule, .rule_count = 1};
    assert_refused(&page, "rule 0");
    page = *scene_make(&scene, false);
    scene.points[5].y = NAN;
    assert_refused(&page, "not finite");
    page = *scene_make(&scene, false);
    scene.paths[3].width = INFINITY;
    assert_refused(&page, "path 3 of view 0");
}

static void a_ground_without_its_png_is_refused(void **state) {
    (void)state;
    dp_diag diag = {0};
    void *bytes = NULL;
    size_t size;
    const dp_page page = *scene_make(&scene, true);
    scene.views[0].ground_png = NULL;
    assert_int_equal(dp_page_write_memory(&page, DP_FORMAT_SVG, &bytes, &size, &diag),
                     DP_ERR_ARGUMENT);
    assert_holds(diag.message, "ground_png");
    assert_int_equal(dp_page_write_memory(&page, DP_FORMAT_COUNT, &bytes, &size, &diag),
                     DP_ERR_ARGUMENT);
    assert_null(bytes);
    assert_string_equal(dp_format_name(DP_FORMAT_DXF), "dxf");
    assert_string_equal(dp_format_name(DP_FORMAT_COUNT), "unknown");
}

/* ------- what stops a writer ------- */

/* "Compresses" to twice as much. */
static dp_result double_bytes(const void *bytes, size_t size, dp_text_writer *write, void *user,
                              dp_diag *diag) {
    const dp_result result = write(user, bytes, size, diag);
    return result ? result : write(user, bytes, size, diag);
}

static void writers_stop_at_any_byte(void **state) {
    (void)state;
    for (int compressed = 0; compressed < 2; compressed++)
        for (int f = 0; f < DP_FORMAT_COUNT; f++) {
            dp_page page = *scene_make(&scene, true);
            if (compressed) page.compress = double_bytes;
            (void)write_text(&page, (dp_format)f);
            const size_t size = paper.size;
            for (size_t most = 1; most < size; most += most < 200 ? 1 : 97) {
                dp_diag diag = {0};
                paper.size = 0, paper.most = most, paper.failed = false;
                assert_int_equal(dp_page_write(&page, (dp_format)f, keep, &paper, &diag),
                                 DP_ERR_IO);
                assert_string_equal(diag.message, "full");
            }
        }
}

typedef struct poor {
    size_t left; /* allocations that succeed */
    size_t held, most;
} poor;

typedef union header {
    size_t size;
    max_align_t align;
} header;

static void *poor_realloc(void *block, size_t size, void *user) {
    poor *const p = user;
    header *const old = block ? (header *)block - 1 : NULL;
    if (!p->left) return NULL;
    p->left--;
    const size_t before = old ? old->size : 0;
    header *const h = realloc(old, sizeof *h + size);
    assert_non_null(h);
    h->size = size;
    p->held += size - before;
    if (p->held > p->most) p->most = p->held;
    return h + 1;
}

static void *poor_alloc(size_t size, void *user) { return poor_realloc(NULL, size, user); }

static void poor_free(void *block, void *user) {
    if (!block) return;
    header *const h = (header *)block - 1;
    ((poor *)user)->held -= h->size;
    free(h);
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    poor p = {0};
    for (int f = 0; f < DP_FORMAT_COUNT; f++) {
        const dp_page page = *scene_make(&scene, true);
        scene.drawing.memory = (dp_allocator){poor_alloc, poor_realloc, poor_free, &p};
        dp_result result = DP_ERR_MEMORY;
        for (size_t count = 0; result; count++) {
            dp_diag diag = {0};
            assert_true(count < 200);
            p.left = count;
            paper.size = paper.most = 0, paper.failed = false;
            result = dp_page_write(&page, (dp_format)f, keep, &paper, &diag);
            assert_int_equal(p.held, 0);
            if (result) assert_int_equal(result, DP_ERR_MEMORY);
            if (result) assert_holds(diag.message, "out of memory");
        }
    }
}

/* ------- large and odd drawings ------- */

enum { MANY = 5000, LONG = 40000 };

static dp_stored_path many_paths[MANY];
static dp_path_point many_points[LONG];

/* `count` paths of two points each, of styles of their own; or, with `count` 1, one of `points`. */
static dp_page make_many(page_scene *s, size_t count, size_t points) {
    const dp_page page = *scene_make(s, false);
    for (size_t i = 0; i < points; i++) {
        const float angle = (float)i * 0.001f;
        many_points[i] = (dp_path_point){.x = 20 + 10 * angle / 40 * (float)(i % 7),
                                         .y = (float)(i * 30) / (float)points};
    }
    for (size_t i = 0; i < count; i++)
        many_paths[i] = (dp_stored_path){.line = DP_LINE_SILHOUETTE,
                                         .width = 1 + (float)i * 0.01f,
                                         .color = (dp_color)(i * 7919) << 8 | 0xFF,
                                         .dash = {4 + (float)(i % 100), 2},
                                         .first = count > 1 ? 2 * (i % (points / 2)) : 0,
                                         .count = count > 1 ? 2 : points};
    s->drawing.paths = many_paths;
    s->drawing.points = many_points;
    s->drawing.info.paths = count;
    return page;
}

static void thousands_of_styles(void **state) {
    (void)state;
    const dp_page page = make_many(&scene, MANY, 1000);
    const char *const svg = write_text(&page, DP_FORMAT_SVG);
    assert_holds(svg, ".dp-silhouette-5000{stroke:#");
    (void)write_text(&page, DP_FORMAT_PDF);
    (void)write_text(&page, DP_FORMAT_EPS);
    const char *const dxf = write_text(&page, DP_FORMAT_DXF);
    assert_holds(dxf, "LTYPE\n70\n101\n"); /* of a hundred lengths; and the whole line */
    assert_holds(dxf, "DASHED100\n");
}

/* Ten times the points do not take more memory. */
static void memory_does_not_grow(void **state) {
    (void)state;
    size_t most[2];
    for (int f = 0; f < DP_FORMAT_COUNT; f++) {
        for (int k = 0; k < 2; k++) {
            poor p = {.left = SIZE_MAX};
            const dp_page page = make_many(&scene, 1, k ? LONG : LONG / 10);
            scene.drawing.memory = (dp_allocator){poor_alloc, poor_realloc, poor_free, &p};
            (void)write_text(&page, (dp_format)f);
            most[k] = p.most;
        }
        assert_in_range(most[1], 1, f == DP_FORMAT_PDF ? 200000 : most[0]);
    }
}

/* Old interpreters hold 1500 points: no path has more, and dashes go on. */
static void long_paths_are_stroked_in_parts(void **state) {
    (void)state;
    const dp_page page = make_many(&scene, 1, 5000);
    many_paths[0].closed = true;
    size_t points = 0, paths = 0, closed = 0, dashes = 0;
    for (const char *line = write_text(&page, DP_FORMAT_EPS); *line;
         line = strchr(line, '\n') + 1) {
        const char *const end = strchr(line, '\n');
        if (end[-1] == 'm') points = 1;
        if (end[-1] == 'l' && ++points > 1401) fail_msg("%zu points", points);
        paths += end - line == 1 && *line == 's';
        closed += end - line == 1 && *line == 'z';
        dashes += *line == '[' && end[-1] == 'd';
    }
    assert_int_equal(paths, 4);
    assert_int_equal(dashes, 4);
    assert_int_equal(closed, 0); /* its start is stroked already */
    assert_true(paper.size < sizeof paper.bytes);
}

static void huge_coordinates_are_numbers(void **state) {
    (void)state;
    const dp_page page = *scene_make(&scene, false);
    scene.points[0].x = 3e38f;
    scene.points[1].y = -3e38f;
    scene.points[2].x = 1e-30f;
    for (int f = 0; f < DP_FORMAT_COUNT; f++) {
        const char *const text = write_text(&page, (dp_format)f);
        assert_null(strstr(text, "inf"));
        assert_null(strstr(text, "nan"));
        assert_holds(text, "1000000000000");
    }
}

static void lines_are_wide_enough(void **state) {
    (void)state;
    dp_page page = *scene_make(&scene, false);
    page.least_width = 2 * 25.4 / 96; /* two pixels */
    const char *const svg = write_text(&page, DP_FORMAT_SVG);
    assert_holds(svg, ".dp-valley{stroke:#000;stroke-width:2;}");
    /* of 0.5, 5.5 drawn and 2 not: all four times */
    assert_holds(svg, ".dp-valley-hidden-1{stroke:#000;stroke-width:2;stroke-dasharray:22,8;}");
    assert_holds(svg, "stroke-width:3;}"); /* as it was */
}

/* ------- files ------- */

static char directory[300], path[340];

static int enter_directory(void **state) {
    (void)state;
    temporary_name(directory, sizeof directory, "page");
    if (!mkdtemp(directory)) return -1;
    snprintf(path, sizeof path, "%s/page.svg", directory);
    return 0;
}

static int leave_directory(void **state) {
    (void)state;
    unlink(path);
    return rmdir(directory); /* fails when anything was left behind */
}

static size_t read_file(char *bytes, size_t most) {
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, most - 1, file);
    bytes[size] = 0;
    fclose(file);
    return size;
}

static char content[1 << 17];

static void grounds_become_pngs(void **state) {
    (void)state;
    const dp_page page = *scene_make(&scene, true);
    scene.views[0].ground_png = NULL;
    assert_int_equal(dp_io_write_page(path, &page, DP_FORMAT_SVG, NULL), DP_OK);
    read_file(content, sizeof content);
    assert_holds(content, "width=\"40\" height=\"30\" preserveAspectRatio=\"none\" "
                          "xlink:href=\"data:image/png;base64,iVBORw0KGgo");
    assert_null(scene.views[0].ground_png);
}

/* The first stream of a PDF, inflated, is the one that is not compressed. */
static void pdf_is_compressed(void **state) {
    (void)state;
    static char plain[1 << 16];
    const dp_page page = make_many(&scene, 1, 1000);
    assert_int_equal(dp_io_write_page(path, &page, DP_FORMAT_PDF, NULL), DP_OK);
    const size_t size = read_file(content, sizeof content);
    assert_holds(content, "/Filter/FlateDecode>>\nstream\n");
    const char *const stream = strstr(content, "stream\n") + 7;
    z_stream z = {.next_in = (Bytef *)(uintptr_t)stream,
                  .avail_in = (uInt)(size - (size_t)(stream - content)),
                  .next_out = (Bytef *)plain,
                  .avail_out = sizeof plain};
    assert_int_equal(inflateInit(&z), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    const size_t length = z.total_out;
    inflateEnd(&z);
    const char *const whole = strstr(write_text(&page, DP_FORMAT_PDF), "stream\n") + 7;
    assert_memory_equal(plain, whole, length);
    assert_true(size < paper.size / 2);
}

static void old_files_stay(void **state) {
    (void)state;
    dp_diag diag = {0};
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fputs("old", file);
    fclose(file);
    const dp_page page = *scene_make(&scene, false);
    scene.points[0].x = NAN;
    assert_int_equal(dp_io_write_page(path, &page, DP_FORMAT_SVG, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(read_file(content, sizeof content), 3);
    assert_int_equal(dp_io_write_page(NULL, &page, DP_FORMAT_SVG, &diag), DP_ERR_ARGUMENT);
    (void)scene_make(&scene, false);
    assert_int_equal(dp_io_write_page("/nowhere/x.svg", &page, DP_FORMAT_SVG, &diag), DP_ERR_IO);
    if (access("/dev/full", W_OK)) return;
    for (int f = 0; f < DP_FORMAT_COUNT; f++)
        assert_int_equal(dp_io_write_page("/dev/full", &page, (dp_format)f, &diag), DP_ERR_IO);
    assert_holds(diag.message, "/dev/full");
}

static void standard_output_is_a_file(void **state) {
    (void)state;
    const dp_page page = *scene_make(&scene, false);
    const char *const svg = write_text(&page, DP_FORMAT_SVG);
    fflush(stdout);
    const int kept = dup(STDOUT_FILENO);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(dup2(fileno(file), STDOUT_FILENO) >= 0);
    const dp_result result = dp_io_write_page("-", &page, DP_FORMAT_SVG, NULL);
    assert_true(dup2(kept, STDOUT_FILENO) >= 0);
    close(kept);
    fclose(file);
    assert_int_equal(result, DP_OK);
    assert_int_equal(read_file(content, sizeof content), paper.size);
    assert_string_equal(content, svg);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_pages_are_refused),
        cmocka_unit_test(wrong_marks_are_refused),
        cmocka_unit_test(a_ground_without_its_png_is_refused),
        cmocka_unit_test(writers_stop_at_any_byte),
        cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(thousands_of_styles),
        cmocka_unit_test(memory_does_not_grow),
        cmocka_unit_test(long_paths_are_stroked_in_parts),
        cmocka_unit_test(huge_coordinates_are_numbers),
        cmocka_unit_test(lines_are_wide_enough),
        cmocka_unit_test_setup_teardown(grounds_become_pngs, enter_directory, leave_directory),
        cmocka_unit_test_setup_teardown(pdf_is_compressed, enter_directory, leave_directory),
        cmocka_unit_test_setup_teardown(standard_output_is_a_file, enter_directory,
                                        leave_directory),
        cmocka_unit_test_setup_teardown(old_files_stay, enter_directory, leave_directory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
