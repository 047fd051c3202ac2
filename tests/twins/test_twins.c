/* Twins of random scenes must look the same: other winding, order, corners, cuts, places, ways.
 *
 *   test_twins                        SEEDS seeds of every kind, against the table below
 *   test_twins --seeds 10000          so many (--from N: the first)
 *   test_twins --kind fan,star        only these kinds
 *   test_twins --seed 17 --kind fan --write FOLDER
 *                                     one seed; writes base and twin as OBJ, both pictures, their
 *                                     difference (red: only the base has a line there), and what
 *                                     an eye says of each (red: a line is missing, blue: stray ink)
 *   test_twins --known FILE           more known failures: lines "SEED KIND reason"
 *   test_twins --threads N, --samples 1 or 4
 *
 * A twin fails by its picture, when more than 30 of 600 x 450 pixels differ by more than 30 %, or by
 * its lines, when some kind of line is longer or shorter by more than 0.5 % and 4 px. Each kind has
 * a line of output that begins with `ok` or `not ok`. */
#include "eye.h"
#include "look.h"
#include "twin.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <drypoint/io.h>

enum { WIDTH = 600, HEIGHT = 450, PIXELS_ALLOWED = 30, KINDS_MOST = 32, THREADS_MOST = 64 };
enum { SEEDS = DP_TEST_PATIENCE > 1 ? 12 : 200 };

/* How many of the first 200 seeds may fail, by picture and by lines: what the finder of lines does
 * today. Each number is to fall to 0, and never to rise. What is left of the lines are short parts
 * that two edges make both, or walls seen so steeply that rounding decides. */
static const struct allowance {
    const char *kind;
    unsigned pictures, lines;
} allowances[] = {
    {"reverse-all", 0, 4},
    {"reverse-some", 0, 2},
    {"double-all", 0, 1},
    {"double-some", 0, 0},
    {"collinear", 0, 10},
    {"fan", 0, 1},
    {"star", 0, 3},
    {"cut", 0, 8},
    {"shuffle", 0, 4},
    {"soup", 0, 0},
    {"weld", 0, 0},
    {"far-1e3", 0, 1},
    {"far-5e5", 0, 0},
    {"small", 0, 0},
    {"big", 0, 0},
    {"streamed", 0, 4},
    {"table-off", 0, 12},
    {"adjacency", SEEDS, SEEDS}, /* reported only: it knows but exact neighbours */
    {"mixed", 2, 33},
    {"mixed-streamed", 8, 36},
};

/* Twins that may differ for good, with the reason. */
static const struct known {
    uint64_t seed;
    const char *kind, *reason;
} knowns[] = {
    {UINT64_MAX, "none", "none is known yet"},
};

typedef struct outcome {
    uint32_t pixels;
    float length; /* px */
    uint8_t line; /* of look_kind_names */
    bool noted, drawn, skipped, known;
} outcome;

typedef struct options {
    uint64_t from, seeds;
    bool kinds[KINDS_MOST];
    bool some_kinds;
    uint32_t threads, samples;
    const char *folder, *known;
} options;

typedef struct suite {
    const options *options;
    outcome *outcomes; /* [seeds][twin_kind_count] */
    atomic_ullong next;
} suite;

/* One worker's. */
typedef struct desk {
    dp_context *context;
    look base, twin;
} desk;

/* ------- one twin ------- */

static look_how how_of(const twin_kind *kind, uint32_t samples) {
    return (look_how){.width = WIDTH,
                      .height = HEIGHT,
                      .samples = samples,
                      .streamed = kind->streamed,
                      .table_off = kind->table_off,
                      .adjacency = kind->adjacency};
}

static const twin_kind base_kind = {.name = "base", .place = {.scale = 1}};

static soup_place place_of(const twin_kind *kind) {
    soup_place place = kind->place;
    if (kind->exact_only && SOUP_HAS_ORIGIN) place.origin = true;
    return place;
}

static void draw_kind(desk *at, const scene *s, uint64_t seed, const twin_kind *kind,
                      uint32_t samples, look *out) {
    const soup_place place = place_of(kind);
    const dp_camera camera = scene_camera(s, &place, (double)WIDTH / HEIGHT);
    const look_how how = how_of(kind, samples);
    soup polygons = {0};
    soup_arrays arrays;
    twin_make(s, seed, kind, &polygons);
    soup_arrays_make(&polygons, &place, &arrays);
    look_draw(at->context, &arrays.batch, &camera, &how, out);
    soup_arrays_free(&arrays);
    soup_free(&polygons);
}

/* Adds what one number of samples shows to what others did. */
static void note(outcome *o, const desk *at) {
    int line;
    const uint32_t pixels = look_pixels(&at->base, &at->twin);
    const double length = look_lengths(&at->base, &at->twin, &line);
    const bool drawn = at->base.diag.result == DP_OK && at->twin.diag.result == DP_OK;
    o->drawn = drawn && (!o->noted || o->drawn);
    o->noted = true;
    if (pixels > o->pixels) o->pixels = pixels;
    if (length > (double)o->length) o->length = (float)length, o->line = (uint8_t)line;
}

static bool is_known(const options *o, uint64_t seed, const char *kind) {
    for (size_t i = 0; i < sizeof knowns / sizeof *knowns; i++)
        if (knowns[i].seed == seed && !strcmp(knowns[i].kind, kind)) return true;
    FILE *const file = o->known != NULL ? fopen(o->known, "r") : NULL;
    char line[512], name[64];
    unsigned long long number;
    bool found = false;
    while (file != NULL && !found && fgets(line, sizeof line, file) != NULL)
        found =
            sscanf(line, "%llu %63s", &number, name) == 2 && number == seed && !strcmp(name, kind);
    if (file != NULL) fclose(file);
    return found;
}

/* Would float32 move some corner of a scene that is placed so, by more than 1e-5? */
static bool is_moved(const scene *s, const soup_place *place) {
    for (size_t i = 0; i < s->soup.point_count; i++)
        for (int k = 0; k < 3; k++) {
            const double at = v3_axis(s->soup.points[i], k) + v3_axis(place->offset, k);
            if (fabs((double)(float)at - at) > 1e-5) return true;
        }
    return false;
}

static void run_seed(const suite *all, desk *at, uint64_t index) {
    const options *const o = all->options;
    const uint64_t seed = o->from + index;
    outcome *const outcomes = all->outcomes + index * twin_kind_count;
    scene s;
    scene_make(seed, &s);
    for (uint32_t samples = 1; samples <= 4; samples += 3) {
        if (o->samples != 0 && o->samples != samples) continue;
        draw_kind(at, &s, seed, &base_kind, samples, &at->base);
        for (size_t k = 0; k < twin_kind_count; k++) {
            const twin_kind *const kind = &twin_kinds[k];
            outcomes[k].skipped =
                kind->exact_only && !SOUP_HAS_ORIGIN && is_moved(&s, &kind->place);
            if (!o->kinds[k] || outcomes[k].skipped) continue;
            draw_kind(at, &s, seed, kind, samples, &at->twin);
            note(&outcomes[k], at);
        }
    }
    scene_free(&s);
}

static bool by_picture(const outcome *o) { return !o->drawn || o->pixels > PIXELS_ALLOWED; }
static bool by_lines(const outcome *o) { return o->length > 0; }

static void desk_make(desk *at) {
    const dp_context_desc desc = {.threads = 1};
    dp_diag diag;
    *at = (desk){0};
    if (dp_context_create(&desc, &at->context, &diag) != DP_OK) {
        fprintf(stderr, "test_twins: %s\n", diag.message);
        exit(1);
    }
}

static void desk_free(desk *at) {
    look_free(&at->base);
    look_free(&at->twin);
    dp_context_destroy(at->context);
}

static void *work(void *arg) {
    suite *const all = arg;
    desk at;
    desk_make(&at);
    for (;;) {
        const uint64_t index = atomic_fetch_add(&all->next, 1);
        if (index >= all->options->seeds) break;
        run_seed(all, &at, index);
    }
    desk_free(&at);
    return NULL;
}

static void run_all(suite *all) {
    pthread_t threads[THREADS_MOST];
    uint32_t count = 0;
    for (; count < all->options->threads; count++)
        if (pthread_create(&threads[count], NULL, work, all)) break;
    if (count == 0) work(all);
    for (uint32_t i = 0; i < count; i++) pthread_join(threads[i], NULL);
}

/* ------- what is said of it ------- */

static struct allowance allowance_of(const char *kind) {
    for (size_t i = 0; i < sizeof allowances / sizeof *allowances; i++)
        if (!strcmp(allowances[i].kind, kind)) return allowances[i];
    return (struct allowance){kind, 0, 0};
}

/* Of so many seeds: in proportion beyond 200, rounded up, and the whole number below. */
static uint64_t allowed(unsigned of_200, uint64_t seeds) {
    return seeds <= 200 ? of_200 : (of_200 * seeds + 199) / 200;
}

typedef struct tally {
    uint64_t tried, pictures, lines, failed, known, worst_seed, longest_seed;
    uint32_t worst;
    double longest;
    uint8_t line;
} tally;

static void count_one(tally *t, outcome *o, uint64_t seed) {
    if (o->skipped) return;
    t->tried++;
    if (o->known) {
        t->known += by_picture(o) || by_lines(o);
        return;
    }
    t->failed += !o->drawn;
    t->pictures += by_picture(o);
    t->lines += by_lines(o);
    if (o->pixels > t->worst) t->worst = o->pixels, t->worst_seed = seed;
    if ((double)o->length > t->longest)
        t->longest = (double)o->length, t->longest_seed = seed, t->line = o->line;
}

static void list_seeds(const suite *all, size_t k, bool (*fails)(const outcome *),
                       const char *what) {
    enum { LISTED = 40 };
    uint64_t listed = 0;
    for (uint64_t i = 0; i < all->options->seeds; i++) {
        const outcome *const o = &all->outcomes[i * twin_kind_count + k];
        if (o->skipped || o->known || !fails(o)) continue;
        if (listed == 0) printf("#   %s:", what);
        if (++listed <= LISTED) printf(" %llu", (unsigned long long)(all->options->from + i));
    }
    if (listed > LISTED) printf(" and %llu more", (unsigned long long)(listed - LISTED));
    if (listed > 0) printf("\n");
}

/* True: no more fail than may. */
static bool report(const suite *all, size_t k) {
    const options *const o = all->options;
    const twin_kind *const kind = &twin_kinds[k];
    const struct allowance may = allowance_of(kind->name);
    const uint64_t pictures = allowed(may.pictures, o->seeds);
    const uint64_t lines = allowed(may.lines, o->seeds);
    tally t = {0};
    for (uint64_t i = 0; i < o->seeds; i++) {
        outcome *const one = &all->outcomes[i * twin_kind_count + k];
        one->known = is_known(o, o->from + i, kind->name);
        count_one(&t, one, o->from + i);
    }
    const bool good = t.pictures <= pictures && t.lines <= lines;
    printf("%s %-14s of %llu pictures differ %llu (%llu may), lines %llu (%llu may)",
           good ? "ok" : "not ok", kind->name, (unsigned long long)t.tried,
           (unsigned long long)t.pictures, (unsigned long long)pictures,
           (unsigned long long)t.lines, (unsigned long long)lines);
    printf("; worst %u px at %llu", t.worst, (unsigned long long)t.worst_seed);
    if (t.longest > 0)
        printf(", %.0f px of %s at %llu", t.longest, look_kind_names[t.line],
               (unsigned long long)t.longest_seed);
    if (t.failed > 0) printf("; %llu could not be drawn", (unsigned long long)t.failed);
    if (t.known > 0) printf("; %llu known", (unsigned long long)t.known);
    printf("\n");
    if (!good || o->seeds != SEEDS) {
        list_seeds(all, k, by_picture, "pictures");
        list_seeds(all, k, by_lines, "lines");
    } else if (t.pictures < pictures || t.lines < lines)
        printf("#   fewer than may: lower the table to %llu, %llu\n",
               (unsigned long long)t.pictures, (unsigned long long)t.lines);
    return good;
}

/* ------- one seed, to be looked at ------- */

static void write_picture(const char *folder, const char *name, const uint8_t *rgba) {
    char path[4096];
    dp_diag diag;
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (dp_io_write_png(path, rgba, WIDTH, HEIGHT, 0, &diag) != DP_OK)
        fprintf(stderr, "test_twins: %s\n", diag.message);
}

/* What an eye says of a picture. */
static void judge(const char *folder, const char *name, const dp_batch *arrays,
                  const dp_camera *camera, const look *l) {
    static uint8_t marked[4 * WIDTH * HEIGHT];
    char text[200];
    eye_truth *const truth = eye_see(arrays, camera, WIDTH, HEIGHT, 150, 210);
    const eye_score score = eye_judge(truth, l->rgba, 2);
    printf("#   %s: recall %.4f, precision %.4f\n", name, score.recall, score.precision);
    eye_mark(truth, l->rgba, 2, marked);
    snprintf(text, sizeof text, "%s-eye", name);
    write_picture(folder, text, marked);
    eye_free(truth);
}

static void print_command(const scene *s, const soup_place *place, const char *path) {
    const v3 eye = v3_add(v3_mul(s->eye, place->scale), place->offset);
    const v3 target = v3_add(v3_mul(s->target, place->scale), place->offset);
    printf("#   drypoint %s -o out.png --size %dx%d --up 0,0,1 --eye %.17g,%.17g,%.17g "
           "--target %.17g,%.17g,%.17g ",
           path, WIDTH, HEIGHT, eye.x, eye.y, eye.z, target.x, target.y, target.z);
    if (s->height > 0)
        printf("--ortho %.17g\n", s->height * place->scale);
    else
        printf("--fov %g\n", s->fov_y);
}

static void write_model(const char *folder, const char *name, const scene *s, uint64_t seed,
                        const twin_kind *kind, const look *l) {
    const soup_place place = place_of(kind);
    const dp_camera camera = scene_camera(s, &place, (double)WIDTH / HEIGHT);
    char path[4096];
    soup polygons = {0};
    soup_arrays arrays;
    twin_make(s, seed, kind, &polygons);
    soup_arrays_make(&polygons, &place, &arrays);
    snprintf(path, sizeof path, "%s/%s.obj", folder, name);
    if (!soup_arrays_write(&arrays, &place, path))
        fprintf(stderr, "test_twins: %s cannot be written\n", path);
    print_command(s, &place, path);
    if (!place.origin) judge(folder, name, &arrays.batch, &camera, l);
    soup_arrays_free(&arrays);
    soup_free(&polygons);
}

static void print_lengths(const look *l, const char *name) {
    printf("#   %-14s", name);
    for (int k = 0; k < DP_LINE_COUNT; k++)
        printf(" %s %.1f", dp_line_name((dp_line)k), l->length[k]);
    printf("\n");
}

static void write_one(const options *o, uint64_t seed, const twin_kind *kind) {
    static uint8_t difference[4 * WIDTH * HEIGHT];
    const uint32_t samples = o->samples ? o->samples : 4;
    desk at;
    scene s;
    char name[128];
    scene_make(seed, &s);
    desk_make(&at);
    printf("# seed %llu: %s\n", (unsigned long long)seed, s.about);
    draw_kind(&at, &s, seed, &base_kind, samples, &at.base);
    draw_kind(&at, &s, seed, kind, samples, &at.twin);
    print_lengths(&at.base, "base");
    print_lengths(&at.twin, kind->name);
    look_difference(&at.base, &at.twin, difference);
    snprintf(name, sizeof name, "%llu-base", (unsigned long long)seed);
    write_picture(o->folder, name, at.base.rgba);
    write_model(o->folder, name, &s, seed, &base_kind, &at.base);
    snprintf(name, sizeof name, "%llu-%s", (unsigned long long)seed, kind->name);
    write_picture(o->folder, name, at.twin.rgba);
    write_model(o->folder, name, &s, seed, kind, &at.twin);
    snprintf(name, sizeof name, "%llu-%s-difference", (unsigned long long)seed, kind->name);
    write_picture(o->folder, name, difference);
    desk_free(&at);
    scene_free(&s);
}

/* ------- the command line ------- */

static void usage(const char *wrong) {
    fprintf(stderr,
            "test_twins: %s\nusage: test_twins [--seeds N] [--from N] [--seed N] [--kind K,...] "
            "[--samples 1|4] [--threads N] [--known FILE] [--write FOLDER]\nkinds:",
            wrong);
    for (size_t k = 0; k < twin_kind_count; k++) fprintf(stderr, " %s", twin_kinds[k].name);
    fprintf(stderr, "\n");
    exit(2);
}

static void choose_kinds(options *o, char *names) {
    o->some_kinds = true;
    for (char *name = strtok(names, ","); name != NULL; name = strtok(NULL, ",")) {
        const twin_kind *const kind = twin_kind_named(name);
        if (kind == NULL) usage(name);
        o->kinds[kind - twin_kinds] = true;
    }
}

static options parse(int count, char **words) {
    options o = {.seeds = SEEDS, .threads = 2};
    for (int i = 1; i < count; i += 2) {
        const char *const word = words[i];
        char *const value = i + 1 < count ? words[i + 1] : NULL;
        if (value == NULL) usage(word);
        if (!strcmp(word, "--seeds"))
            o.seeds = strtoull(value, NULL, 10);
        else if (!strcmp(word, "--from"))
            o.from = strtoull(value, NULL, 10);
        else if (!strcmp(word, "--seed"))
            o.from = strtoull(value, NULL, 10), o.seeds = 1;
        else if (!strcmp(word, "--kind"))
            choose_kinds(&o, value);
        else if (!strcmp(word, "--samples"))
            o.samples = (uint32_t)strtoul(value, NULL, 10);
        else if (!strcmp(word, "--threads"))
            o.threads = (uint32_t)strtoul(value, NULL, 10);
        else if (!strcmp(word, "--known"))
            o.known = value;
        else if (!strcmp(word, "--write"))
            o.folder = value;
        else
            usage(word);
    }
    if (o.threads < 1 || o.threads > THREADS_MOST) usage("--threads");
    if (o.samples != 0 && o.samples != 1 && o.samples != 4) usage("--samples");
    for (size_t k = 0; k < twin_kind_count && !o.some_kinds; k++) o.kinds[k] = true;
    return o;
}

int main(int argc, char **argv) {
    const options o = parse(argc, argv);
    suite all = {.options = &o, .outcomes = calloc(o.seeds * twin_kind_count + 1, sizeof(outcome))};
    bool good = true;
    if (all.outcomes == NULL) abort();
    run_all(&all);
    for (size_t k = 0; k < twin_kind_count; k++)
        if (o.kinds[k]) good &= report(&all, k);
    for (size_t k = 0; k < twin_kind_count && o.folder != NULL; k++)
        for (uint64_t i = 0; i < o.seeds; i++)
            if (o.kinds[k] && (o.seeds == 1 || by_picture(&all.outcomes[i * twin_kind_count + k])))
                write_one(&o, o.from + i, &twin_kinds[k]);
    free(all.outcomes);
    return good ? 0 : 1;
}
