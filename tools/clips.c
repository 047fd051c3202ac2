/* --animation names a clip exactly, or by its number in its file, from 1; a name goes first. Each of
 * several models plays its own clip of that name or number. */
#include "clips.h"

#include "commands.h"
#include "film.h"
#include "models.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- which one plays ---- */

static bool is_rest(const char *name) { return !strcmp(name, "none"); }

/* The whole number that the text is; 0: it is none. */
static uint32_t number_of(const char *text) {
    const size_t digits = strspn(text, "0123456789");
    return digits && digits < 10 && !text[digits] ? (uint32_t)strtoul(text, NULL, 10) : 0;
}

/* The clip, 1 + number; 0: there is none. */
static uint32_t find_clip(const dp_scene_desc *scene, const char *name) {
    const uint32_t number = number_of(name);
    for (uint32_t k = 0; k < scene->clip_count; k++)
        if (scene->clips[k].name && !strcmp(scene->clips[k].name, name)) return k + 1;
    return number <= scene->clip_count ? number : 0;
}

/* Keeps the name that is most like the wanted one. */
static void note_nearest(const dp_scene_desc *scene, const char *wanted, clips_tally *tally) {
    for (uint32_t k = 0; k < scene->clip_count; k++) {
        const char *const name = scene->clips[k].name;
        if (!name || strlen(name) >= sizeof tally->nearest) continue;
        const unsigned distance = spelling_distance(wanted, name);
        if (*tally->nearest && distance >= tally->distance) continue;
        tally->distance = distance;
        snprintf(tally->nearest, sizeof tally->nearest, "%s", name);
    }
}

int clips_play(const tool_settings *s, dp_source *source, clips_tally *tally) {
    const dp_scene_desc *const scene = dp_scene_of(source);
    dp_diag diag = {0};
    if (!scene || (!s->animation && !s->has_time)) return 0;
    tally->clips += scene->clip_count;
    if (s->animation && is_rest(s->animation)) return 0;
    const uint32_t clip = s->animation ? find_clip(scene, s->animation) : scene->clip_count > 0;
    if (!clip) note_nearest(scene, s->animation ? s->animation : "", tally);
    if (!clip) return 0;
    tally->playing++;
    return dp_scene_play(source, clip, &diag) ? report_model(s, &diag) : 0;
}

/* A twist without a speed. */
static bool stands_twisted(const tool_settings *s) {
    return s->has_deform && s->deform.kind == DP_DEFORM_TWIST && !(fabs(s->deform.speed) > 0);
}
/* Does something else than an animation take --time? */
static bool is_moved_otherwise(const tool_settings *s) {
    return (s->has_deform && !stands_twisted(s)) || s->morph;
}

/* Nothing of the model moves. */
static void warn_of_rest(const tool_settings *s) {
    const bool lasts = s->frames || s->time[1] != s->time[0]; /* else that is an error of its own */
    if (film_wanted(s) && lasts && !s->has_turn && !s->path && !s->has_frame)
        warn_of_model(s, stands_twisted(s)
                             ? "all frames are alike: a twist stands still without a speed; add "
                               "speed=1 to it, say"
                             : "all frames are alike: nothing moves; add --turn 360, say");
    else if (!film_wanted(s) && option_given(s, "time"))
        warn_of_model(s, s->animation ? "--time changes nothing: no animation plays"
                         : stands_twisted(s)
                             ? "--time changes nothing: a twist stands still without a "
                               "speed; add speed=1 to it, say"
                             : "--time changes nothing: there is no animation in it");
}

static int tell_missing(const tool_settings *s, const clips_tally *tally) {
    const char *const model = model_spoken(s->model);
    if (!tally->clips)
        wrong_usage("%s: --animation %s: there is no animation in it", model, s->animation);
    else if (number_of(s->animation))
        wrong_usage("%s: --animation %s: there are only %u; \"drypoint info\" lists them", model,
                    s->animation, tally->clips);
    else if (*tally->nearest && 2 * tally->distance <= strlen(tally->nearest))
        wrong_usage("%s: --animation %s: there is no such animation; did you mean \"%s\"?", model,
                    s->animation, tally->nearest);
    else
        wrong_usage("%s: --animation %s: there is no such animation; \"drypoint info\" lists them",
                    model, s->animation);
    return EXIT_FAILED;
}

int clips_check(const tool_settings *s, const clips_tally *tally) {
    if (tally->playing) return 0;
    if (s->animation && !is_rest(s->animation)) return tell_missing(s, tally);
    if (!s->quiet && !is_moved_otherwise(s)) warn_of_rest(s);
    return 0;
}

/* ---- a list ---- */

static uint64_t count_morphs(const dp_scene_desc *scene) {
    uint64_t count = 0;
    for (uint32_t k = 0; k < scene->mesh_count; k++) count += scene->meshes[k].morph_count;
    return count;
}

/* Letters of files are for terminals only if they are no controls. */
static void print_name(const char *name) {
    for (; *name; name++) putchar((unsigned char)*name < ' ' || *name == 127 ? '?' : *name);
}

void clips_print_table(const dp_source *source) {
    const dp_scene_desc *const scene = dp_scene_of(source);
    if (!scene) return;
    printf("%-32s %u\n%-32s %u\n%-32s %llu\n%-32s %u\n", "nodes", scene->node_count, "skins",
           scene->skin_count, "morph targets", (unsigned long long)count_morphs(scene),
           "animations", scene->clip_count);
    for (uint32_t k = 0; k < scene->clip_count; k++) {
        const dp_scene_clip *const clip = &scene->clips[k];
        printf("  %-30u %.6g s  ", k + 1, clip->duration);
        print_name(clip->name ? clip->name : "(without a name)");
        putchar('\n');
    }
}

void clips_print_json(const dp_source *source) {
    static const dp_scene_desc none;
    const dp_scene_desc *const scene = dp_scene_of(source) ? dp_scene_of(source) : &none;
    printf(", \"nodes\": %u, \"skins\": %u, \"morph_targets\": %llu, \"animations\": [",
           scene->node_count, scene->skin_count, (unsigned long long)count_morphs(scene));
    for (uint32_t k = 0; k < scene->clip_count; k++) {
        const dp_scene_clip *const clip = &scene->clips[k];
        printf("%s{\"name\": ", k ? ", " : "");
        if (clip->name)
            print_json_string(stdout, clip->name);
        else
            fputs("null", stdout);
        printf(", \"seconds\": %.9g}", clip->duration);
    }
    putchar(']');
}
