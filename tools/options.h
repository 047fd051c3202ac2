/* The command line: one table of options serves parsing, --help, the man page and suggestions of
 * the nearest option. */
#ifndef TOOL_OPTIONS_H
#define TOOL_OPTIONS_H

#include <drypoint/drypoint.h>

#include <stdio.h>

enum { EXIT_FAILED = 1, EXIT_USAGE = 2 };

typedef enum tool_command {
    COMMAND_DRAW = 0,
    COMMAND_INFO,
    COMMAND_MAKE,
    COMMAND_BENCH,
    COMMAND_COUNT
} tool_command;

/* A question about the command, instead of running it. */
typedef enum question { QUESTION_NONE = 0, QUESTION_HELP, QUESTION_VERSION, QUESTION_MAN } question;

typedef enum stats_kind { STATS_NONE = 0, STATS_TABLE, STATS_JSON } stats_kind;

/* Words of an option: their index in the table's argument text, from 1; 0 means not given. */
enum { VIEW_FRONT = 1, VIEW_BACK, VIEW_LEFT, VIEW_RIGHT, VIEW_TOP, VIEW_BOTTOM, VIEW_ISO };
enum { SWITCH_ON = 1, SWITCH_OFF };
enum { STROKE_ARC = 1, STROKE_POLAR };
enum { HIDDEN_DASHED = 1, HIDDEN_DOTTED, HIDDEN_THIN, HIDDEN_SOLID, HIDDEN_NONE };
enum { EDGES_EMERGENT = 1, EDGES_ADJACENCY, EDGES_MAP, EDGES_BOTH, EDGES_NONE };

/* What --output NAME=FILE can name: planes of the G-buffer as pictures, and the lines as text. */
typedef enum output_plane {
    PLANE_EDGE_MAP = 0,
    PLANE_NORMALS,
    PLANE_DEPTH,
    PLANE_ID,
    PLANE_COUNT,
    OUTPUT_TRACE = PLANE_COUNT,
    OUTPUT_COUNT
} output_plane;
extern const char *const output_names[OUTPUT_COUNT];

/* All options of the command line; zero means not given. */
typedef struct tool_settings {
    tool_command command;
    question question;
    const char *model; /* of make: the shape's name */
    const char *output;

    uint32_t width, height; /* px */
    int samples;            /* word */
    uint32_t threads;
    double memory; /* bytes */
    int passes;    /* word */

    double eye[3], target[3], up[3];
    bool has_eye, has_target, has_up;
    double fov, ortho, azimuth, elevation,
        zoom; /* degrees, world units, degrees, degrees, factor */
    bool has_fov, has_ortho, has_azimuth, has_elevation;
    int view; /* word */

    dp_style style; /* lines, widths and colours; other members follow below */
    int hidden;     /* word; widths and colours of hidden lines are the style's */
    uint32_t levels;
    bool hidden_smooth;
    double ridge_angle, valley_angle;
    int edges, method, between, ink, edge_table; /* words */
    bool cull_back_faces;

    double pencil_s, pencil_o;
    bool has_pencil_s, has_pencil_o;
    uint32_t pencil_tones;
    int pencil_turns;   /* word */
    const char *stroke; /* a name, or a PNG file */
    int stroke_u;       /* word */
    double stroke_k, stroke_scale, taper, jitter, overshoot, width_by_depth, width_by_light;
    bool has_stroke_k, has_taper, has_jitter, has_overshoot;
    uint32_t repeats;
    int preset;  /* word; its options come first */
    int shading; /* word */
    double light[2];
    bool has_light;
    int normals; /* word */
    double crease_angle, highlight, hatch_scale;
    bool gooch_plain;
    int model_colors;             /* word */
    int cartoon_map, hatch_space; /* words */
    const char *shade_texture, *strokes;
    dp_color hatch_color;

    int edge_map, edge_measure, precision, edge_sides, group_edges; /* words */
    uint32_t edge_radius, c1_passes;
    double inner_angle, inner_softness, profile_depth, profile_softness;
    dp_color inner_color, profile_color;
    const char *enhance;
    double mirror[4]; /* normal, offset */
    bool has_mirror, has_mirror_offset;
    double mirror_size, mirror_fade, mirror_tint_share;
    dp_color mirror_tint;
    const char *outputs[OUTPUT_COUNT]; /* files */
    bool wants_edge_map;

    stats_kind stats;
    bool json, quiet;
    double read_time; /* s */
    uint32_t frames;
    uint64_t triangles;
    double shape_size;
    uint32_t seed;
} tool_settings;

typedef enum option_kind {
    OPTION_FLAG = 0, /* bool */
    OPTION_TEXT,     /* const char * */
    OPTION_COUNT,    /* uint32_t, within the limits */
    OPTION_COUNT64,  /* uint64_t */
    OPTION_NUMBER,   /* double, limits included */
    OPTION_INSIDE,   /* double, limits excluded */
    OPTION_POINT,    /* double[3] */
    OPTION_ANGLES,   /* double[2] */
    OPTION_PLANE,    /* double[4], then two bools as in tool_settings.mirror */
    OPTION_OUTPUT,   /* const char *, or one of tool_settings.planes */
    OPTION_WORD,     /* int: which of the argument's words */
    OPTION_SIZE,     /* uint32_t[2] */
    OPTION_BYTES,    /* double: a number and K, M or G */
    OPTION_LINES,    /* dp_style.lines */
    OPTION_WIDTHS,   /* dp_style.line[].width */
    OPTION_COLORS,   /* dp_style.line[].color */
    OPTION_COLOR,    /* dp_color */
    OPTION_STATS,    /* stats_kind; its argument may be left out */
    OPTION_QUESTION, /* question: ends the parsing */

    /* dp_style.hidden.line[][].width and .color */
    OPTION_HIDDEN_WIDTHS,
    OPTION_HIDDEN_COLORS
} option_kind;

typedef enum option_group {
    GROUP_PICTURE = 0,
    GROUP_CAMERA,
    GROUP_LINES,
    GROUP_STROKES,
    GROUP_SURFACE,
    GROUP_EDGE_MAP,
    GROUP_METHOD,
    GROUP_MODEL,
    GROUP_PROGRAM,
    GROUP_HIDDEN,
    GROUP_COUNT
} option_group;

typedef struct option {
    const char *name;     /* without the dashes */
    char letter;          /* short form, or 0 */
    const char *argument; /* as --help shows it; of words: the words themselves; or NULL */
    option_kind kind;
    option_group group;
    unsigned commands; /* set of 1u << command */
    size_t at;         /* offset of the value in tool_settings */
    size_t given;      /* offset of the bool that says whether it was given; 0: none */
    double least, most;
    const char *help;
} option;

extern const option option_table[];
extern const size_t option_count;

/* A command's name ("" for drawing), what follows it on the command line, one line about it. */
typedef struct command_text {
    const char *name, *arguments, *about;
    const char *examples[12]; /* command line, then what it does, … NULL */
} command_text;
extern const command_text command_table[COMMAND_COUNT];
extern const char *const group_names[GROUP_COUNT];

/* Fills *settings. False: the command line is wrong, and a message is on stderr. */
bool options_parse(int argc, char **argv, tool_settings *settings);

/* Stores one option's value. False: it is wrong, and a message is on stderr. */
bool option_store(const option *o, const char *value, tool_settings *settings);

/* Which of `words` ("exact|paper") is the word, from 1; 0: none. */
int word_index(const char *words, const char *word);

/* Edit distance from a to b, in letters. */
unsigned spelling_distance(const char *a, const char *b);

void options_help(FILE *out, tool_command command);
void options_man(FILE *out);

#endif
