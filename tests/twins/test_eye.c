/* Pictures of random scenes against what an eye sees of them (eye.h), and the eye against what is
 * known of simple models.
 *
 *   test_eye                            SEEDS seeds, against the table below
 *   test_eye --seeds 1000 --from 0      so many
 *   test_eye --twins 100                the eye on this many scenes and their twins
 *   test_eye --seed 17 --write FOLDER   one; writes the model, its picture, and the picture marked:
 *                                       missing lines red, stray ink blue, undecided grey
 *
 * Each check has a line of output that begins with `ok` or `not ok`. */
#include "eye.h"
#include "look.h"
#include "twin.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <drypoint/io.h>

enum { WIDTH = 300, HEIGHT = 225, THREADS = 2 };
enum { SEEDS = DP_TEST_PATIENCE > 1 ? 8 : 200, TWINS = DP_TEST_PATIENCE > 1 ? 2 : 8 /* scenes */ };
static const double good = 0.995; /* recall and precision of a good picture */

/* What the first 200 scenes must reach. These are what the finder of lines does today, not what is
 * right: the counts are to fall to 0, and the least scores to rise to 0.995. */
static const struct least {
    double recall, precision;                 /* of any scene */
    unsigned recalls_below, precisions_below; /* how many may be below `good` */
    unsigned lengths;                         /* how many may have segments of another length */
} least = {0.999, 0.995, 0, 0, 13};

static unsigned failures;

static void check(bool right, const char *what, const char *detail) {
    printf("%s %s%s%s\n", right ? "ok" : "not ok", what, *detail ? ": " : "", detail);
    failures += !right;
}

/* ------- the eye on models that are known ------- */

static void add_box(soup *s, v3 low, v3 high) {
    const double x[] = {low.x, high.x}, y[] = {low.y, high.y}, z[] = {low.z, high.z};
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int f = 0; f < 6; f++) {
        v3 p[4];
        for (int c = 0; c < 4; c++) {
            const int k = faces[f][c];
            p[c] = (v3){x[k & 1], y[k >> 1 & 1], z[k >> 2]};
        }
        soup_add(s, p, 4, 0);
    }
}

/* Seen without perspective along (-1, -1, -1), 4 units high. */
static eye_truth *see_corner(const soup *s) {
    static const soup_place here = {.scale = 1};
    const scene view = {.eye = {6, 6, 6}, .up = {0, 0, 1}, .height = 4, .radius = 6};
    const dp_camera camera = scene_camera(&view, &here, (double)WIDTH / HEIGHT);
    soup_arrays arrays;
    soup_arrays_make(s, &here, &arrays);
    eye_truth *const truth = eye_see(&arrays.batch, &camera, WIDTH, HEIGHT, 150, 210);
    soup_arrays_free(&arrays);
    return truth;
}

/* Lengths in units of an axis's unit length on the picture. */
static void expect_lengths(const char *what, const soup *s, double outline, double ridge,
                           double valley) {
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    const double unit = sqrt(2.0 / 3) * HEIGHT / 4;
    const double expected[] = {outline, ridge, valley, 0};
    bool right = true;
    char text[200] = "";
    eye_truth *const truth = see_corner(s);
    memset(rgba, 255, sizeof rgba);
    const eye_score blank = eye_judge(truth, rgba, 2);
    for (int k = 0; k < EYE_KINDS; k++) {
        const double length = blank.length[k] / unit;
        const size_t used = strlen(text);
        right &= fabs(length - expected[k]) < 0.02 * expected[k] + 0.02;
        snprintf(text + used, sizeof text - used, "%s%.2f for %.2f", used ? ", " : "", length,
                 expected[k]);
    }
    check(right, what, text);
    check(blank.recall == 0 && blank.precision == 0, "  a blank picture has nothing of it", "");
    eye_draw(truth, 2, 0, rgba);
    const eye_score ideal = eye_judge(truth, rgba, 2);
    check(ideal.recall > 0.9999 && ideal.precision > 0.9999, "  its own lines are all right", "");
    eye_draw(truth, 2, 4, rgba);
    const eye_score moved = eye_judge(truth, rgba, 2);
    check(moved.recall < 0.8 && moved.precision < 0.8, "  the same, moved, are not", "");
    eye_free(truth);
}

static void turn_over(soup *s) {
    for (size_t i = 0; i < s->polygon_count; i++) {
        v3 *const p = s->points + s->polygons[i].first;
        const v3 second = p[1];
        p[1] = p[3], p[3] = second;
    }
}

static void known_models(void) {
    soup s = {0};
    add_box(&s, (v3){-.5, -.5, -.5}, (v3){.5, .5, .5});
    expect_lengths("a cube has 6 outlines and 3 ridges", &s, 6, 3, 0);
    turn_over(&s);
    expect_lengths("so it has inside out", &s, 6, 3, 0);
    add_box(&s, (v3){-.5, -.5, -.5}, (v3){.5, .5, .5});
    expect_lengths("so it has doubled", &s, 6, 3, 0);
    add_box(&s, (v3){-.5, .5, -.5}, (v3){.5, 1, .5});
    expect_lengths("a box flush with it makes it longer", &s, 7, 3.5, 0);
    soup_free(&s);
    add_box(&s, (v3){-1, -1, -.25}, (v3){1, 1, 0});
    add_box(&s, (v3){-.5, -.5, 0}, (v3){.5, .5, 1});
    expect_lengths("a box on a plate has 2 valleys", &s, 10.5, 7.25, 2);
    soup_free(&s);
    add_box(&s, (v3){-.5, -.5, -.5}, (v3){.5, .5, .5});
    s.polygons[1] = s.polygons[--s.polygon_count]; /* without its lid */
    expect_lengths("an open box shows its inner edges", &s, 8, 1, 1);
    soup_free(&s);
}

/* ------- the eye on twins ------- */

/* A scene's lines are those of its twins: so the eye is sure, and twins are made right. */
static void expect_same_truth(const scene *s, uint64_t seed, const twin_kind *kind,
                              const eye_truth *truth) {
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    const double enough = 0.998;
    const dp_camera camera = scene_camera(s, &kind->place, (double)WIDTH / HEIGHT);
    soup polygons = {0};
    soup_arrays arrays;
    char text[200];
    twin_make(s, seed, kind, &polygons);
    soup_arrays_make(&polygons, &kind->place, &arrays);
    eye_truth *const other = eye_see(&arrays.batch, &camera, WIDTH, HEIGHT, 150, 210);
    eye_draw(truth, 2, 0, rgba);
    const eye_score score = eye_judge(other, rgba, 2);
    snprintf(text, sizeof text, "recall %.4f, precision %.4f of %s of seed %llu", score.recall,
             score.precision, kind->name, (unsigned long long)seed);
    if (score.recall < enough || score.precision < enough) check(false, "twins to the eye", text);
    eye_free(other);
    soup_arrays_free(&arrays);
    soup_free(&polygons);
}

static void known_twins(uint64_t scenes) {
    static const soup_place here = {.scale = 1};
    const unsigned before = failures;
    for (uint64_t seed = 0; seed < scenes; seed++) {
        scene s;
        soup_arrays arrays;
        scene_make(seed, &s);
        const dp_camera camera = scene_camera(&s, &here, (double)WIDTH / HEIGHT);
        soup_arrays_make(&s.soup, &here, &arrays);
        eye_truth *const truth = eye_see(&arrays.batch, &camera, WIDTH, HEIGHT, 150, 210);
        for (size_t k = 0; k < twin_kind_count; k++)
            if (!twin_kinds[k].exact_only) expect_same_truth(&s, seed, &twin_kinds[k], truth);
        eye_free(truth);
        soup_arrays_free(&arrays);
        scene_free(&s);
    }
    check(failures == before, "scenes and their twins are the same to the eye", "");
}

/* ------- random scenes ------- */

typedef struct options {
    uint64_t from, seeds, twins;
    const char *folder;
} options;

typedef struct score_sheet {
    const options *options;
    eye_score *scores;
    float (*lengths)[LOOK_KINDS]; /* px, of the segments */
    atomic_ullong next;
} score_sheet;

static void write_files(const options *o, uint64_t seed, const scene *s, const soup_arrays *arrays,
                        const eye_truth *truth, const look *picture) {
    static const soup_place here = {.scale = 1};
    uint8_t *const marked = malloc((size_t)4 * WIDTH * HEIGHT);
    char path[4096];
    if (marked == NULL) abort();
    eye_mark(truth, picture->rgba, 2, marked);
    snprintf(path, sizeof path, "%s/%llu-eye.png", o->folder, (unsigned long long)seed);
    dp_io_write_png(path, marked, WIDTH, HEIGHT, 0, NULL);
    snprintf(path, sizeof path, "%s/%llu-picture.png", o->folder, (unsigned long long)seed);
    dp_io_write_png(path, picture->rgba, WIDTH, HEIGHT, 0, NULL);
    free(marked);
    snprintf(path, sizeof path, "%s/%llu.obj", o->folder, (unsigned long long)seed);
    if (!soup_arrays_write(arrays, &here, path)) fprintf(stderr, "cannot write %s\n", path);
    printf("# seed %llu: %s\n#   eye %.17g %.17g %.17g target %.17g %.17g %.17g up 0 0 1 ",
           (unsigned long long)seed, s->about, s->eye.x, s->eye.y, s->eye.z, s->target.x,
           s->target.y, s->target.z);
    if (s->height > 0)
        printf("ortho %.17g\n", s->height);
    else
        printf("fov %g\n", s->fov_y);
}

static eye_score score_seed(const options *o, dp_context *context, uint64_t seed, float *lengths) {
    static const soup_place here = {.scale = 1};
    const look_how how = {.width = WIDTH, .height = HEIGHT, .samples = seed % 2 ? 1 : 4};
    look picture = {0};
    soup_arrays arrays;
    scene s;
    scene_make(seed, &s);
    const dp_camera camera = scene_camera(&s, &here, (double)WIDTH / HEIGHT);
    soup_arrays_make(&s.soup, &here, &arrays);
    look_draw(context, &arrays.batch, &camera, &how, &picture);
    eye_truth *const truth = eye_see(&arrays.batch, &camera, WIDTH, HEIGHT, 150, 210);
    const eye_score score = eye_judge(truth, picture.rgba, 2);
    for (int k = 0; k < LOOK_KINDS; k++) lengths[k] = (float)look_length(&picture, k);
    if (o->folder != NULL) write_files(o, seed, &s, &arrays, truth, &picture);
    eye_free(truth);
    look_free(&picture);
    soup_arrays_free(&arrays);
    scene_free(&s);
    return score;
}

static void *work(void *arg) {
    score_sheet *const all = arg;
    const dp_context_desc desc = {.threads = 1};
    dp_context *context;
    if (dp_context_create(&desc, &context, NULL) != DP_OK) abort();
    for (;;) {
        const uint64_t i = atomic_fetch_add(&all->next, 1);
        if (i >= all->options->seeds) break;
        all->scores[i] = score_seed(all->options, context, all->options->from + i, all->lengths[i]);
    }
    dp_context_destroy(context);
    return NULL;
}

static void run_all(score_sheet *all) {
    pthread_t threads[THREADS];
    uint32_t count = 0;
    for (; count < THREADS; count++)
        if (pthread_create(&threads[count], NULL, work, all)) break;
    if (count == 0) work(all);
    for (uint32_t i = 0; i < count; i++) pthread_join(threads[i], NULL);
}

static void print_score(const score_sheet *all, uint64_t i) {
    const eye_score *const s = &all->scores[i];
    const uint64_t seed = all->options->from + i;
    static const char *const names[] = {"outline", "ridge", "valley"};
    printf("#   seed %llu: recall %.4f precision %.4f", (unsigned long long)seed, s->recall,
           s->precision);
    for (int k = 0; k < EYE_UNDECIDED; k++)
        printf(" %s %.1f %.4f segments %.1f", names[k], s->length[k],
               s->length[k] > 0 ? s->found[k] / s->length[k] : 1, (double)all->lengths[i][k]);
    printf(" undecided %.1f stray %.1f\n", s->length[EYE_UNDECIDED], s->stray);
}

static double share_of(const score_sheet *all, uint64_t i, int which) {
    return which == 0 ? all->scores[i].recall : all->scores[i].precision;
}

/* Recall, or precision, of all scenes. */
static void report(const score_sheet *all, int which, double least_share, unsigned may_be_below) {
    const uint64_t seeds = all->options->seeds;
    uint64_t worst = 0, below = 0;
    double sum = 0;
    char text[300];
    for (uint64_t i = 0; i < seeds; i++) {
        below += share_of(all, i, which) < good;
        sum += share_of(all, i, which);
        if (share_of(all, i, which) < share_of(all, worst, which)) worst = i;
    }
    snprintf(text, sizeof text,
             "mean %.4f, least %.4f at seed %llu (%.4f needed), below %.3f: %llu of %llu (%u may)",
             sum / (double)seeds, share_of(all, worst, which),
             (unsigned long long)(all->options->from + worst), least_share, good,
             (unsigned long long)below, (unsigned long long)seeds, may_be_below);
    const bool other = all->options->seeds > 200 || all->options->from > 0; /* not in the table */
    check(other || (share_of(all, worst, which) >= least_share && below <= may_be_below),
          which == 0 ? "recall of scenes" : "precision of scenes", text);
}

/* Are segments as long as what the eye sees, of each kind? They are not where lines are missing,
 * there twice, or of another kind. The eye measures 1 % too little, more at corners. */
static double length_excess(const score_sheet *all, uint64_t i, int kind) {
    const eye_score *const s = &all->scores[i];
    const double seen = s->length[kind], drawn = (double)all->lengths[i][kind];
    const double slack = 0.03 * seen + 8 + s->length[EYE_UNDECIDED];
    return fabs(drawn - seen) > slack ? drawn - seen : 0;
}

static bool any_excess(const score_sheet *all, uint64_t i) {
    bool any = false;
    for (int k = 0; k < LOOK_KINDS; k++) any |= length_excess(all, i, k) != 0;
    return any;
}

static void report_lengths(const score_sheet *all) {
    const uint64_t seeds = all->options->seeds;
    uint64_t wrong = 0, worst_seed = 0;
    double worst = 0;
    int worst_kind = 0;
    char text[200];
    for (uint64_t i = 0; i < seeds; i++) {
        for (int k = 0; k < LOOK_KINDS; k++) {
            const double excess = length_excess(all, i, k);
            if (fabs(excess) > fabs(worst)) worst = excess, worst_seed = i, worst_kind = k;
        }
        wrong += any_excess(all, i);
    }
    snprintf(text, sizeof text, "wrong in %llu of %llu (%u may); worst %+.0f px of %s at seed %llu",
             (unsigned long long)wrong, (unsigned long long)seeds, least.lengths, worst,
             look_kind_names[worst_kind], (unsigned long long)(all->options->from + worst_seed));
    check(seeds > 200 || all->options->from > 0 || wrong <= least.lengths, "lengths of segments",
          text);
}

static options parse(int count, char **words) {
    options o = {.seeds = SEEDS, .twins = TWINS};
    for (int i = 1; i + 1 < count; i += 2) {
        if (!strcmp(words[i], "--seeds")) o.seeds = strtoull(words[i + 1], NULL, 10);
        if (!strcmp(words[i], "--from")) o.from = strtoull(words[i + 1], NULL, 10);
        if (!strcmp(words[i], "--seed")) o.from = strtoull(words[i + 1], NULL, 10), o.seeds = 1;
        if (!strcmp(words[i], "--twins")) o.twins = strtoull(words[i + 1], NULL, 10);
        if (!strcmp(words[i], "--write")) o.folder = words[i + 1];
    }
    return o;
}

int main(int argc, char **argv) {
    const options o = parse(argc, argv);
    score_sheet all = {.options = &o,
                       .scores = calloc(o.seeds + 1, sizeof(eye_score)),
                       .lengths = calloc(o.seeds + 1, sizeof *all.lengths)};
    if (all.scores == NULL || all.lengths == NULL || o.seeds == 0) abort();
    known_models();
    known_twins(o.twins);
    run_all(&all);
    report(&all, 0, least.recall, least.recalls_below);
    report(&all, 1, least.precision, least.precisions_below);
    report_lengths(&all);
    for (uint64_t i = 0; i < o.seeds; i++)
        if (all.scores[i].recall < good || all.scores[i].precision < good || any_excess(&all, i) ||
            o.seeds == 1)
            print_score(&all, i);
    free(all.scores);
    free(all.lengths);
    return failures > 0;
}
