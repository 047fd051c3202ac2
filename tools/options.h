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
    COMMAND_VIEW,
    COMMAND_COUNT
} tool_command;

/* A question about the command, instead of running it. */
typedef enum question {
    QUESTION_NONE = 0,
    QUESTION_HELP,
    QUESTION_VERSION,
    QUESTION_MAN,
    QUESTION_COMPLETIONS
} question;

typedef enum stats_kind { STATS_NONE = 0, STATS_TABLE, STATS_JSON } stats_kind;

/* Words of an option: their index in the table's argument text, from 1; 0 means not given. */
enum { VIEW_FRONT = 1, VIEW_BACK, VIEW_LEFT, VIEW_RIGHT, VIEW_TOP, VIEW_BOTTOM, VIEW_ISO };
enum { SWITCH_ON = 1, SWITCH_OFF };
enum { STROKE_ARC = 1, STROKE_POLAR };
enum { PATTERN_OBJECT = 1, PATTERN_SCREEN };
enum { HIDDEN_DASHED = 1, HIDDEN_DOTTED, HIDDEN_THIN, HIDDEN_SOLID, HIDDEN_NONE };
enum { INK_STROKES = 1, INK_QUADS };
enum { BACKEND_CPU = 1, BACKEND_GL };
enum {
    SHADING_PAPER = 1,
    SHADING_FLAT,
    SHADING_LAMBERT,
    SHADING_GOOCH,
    SHADING_TOON,
    SHADING_HATCH,
    SHADING_HALFTONE,
    SHADING_PENCIL
};
enum { EDGE_MAP_DIAGONAL = 1, EDGE_MAP_C1 };
enum { MEASURE_SCALED = 1, MEASURE_PAPER };
enum { EDGES_EMERGENT = 1, EDGES_ADJACENCY, EDGES_MAP, EDGES_BOTH, EDGES_NONE };

enum { UNIT_MM = 1, UNIT_CM, UNIT_M, UNIT_IN, UNIT_FT };
enum { ANGLE_FIRST = 1, ANGLE_THIRD };
enum { GROUND_PNG = 1, GROUND_NONE };

/* What --output NAME=FILE can name: planes of the G-buffer as pictures, the lines as text, and the
 * paths as JSON. */
typedef enum output_plane {
    PLANE_EDGE_MAP = 0,
    PLANE_NORMALS,
    PLANE_DEPTH,
    PLANE_ID,
    PLANE_COUNT,
    OUTPUT_TRACE = PLANE_COUNT,
    OUTPUT_SEGMENTS,
    OUTPUT_COUNT
} output_plane;
extern const char *const output_names[OUTPUT_COUNT];

enum { FILES_MOST = 16, OPTIONS_MOST = 192 };

/* A length on paper or screen; not given: value and unit are 0. A share is of the picture's, or
 * page's, smaller side. */
typedef enum length_unit { LENGTH_NONE = 0, LENGTH_PX, LENGTH_MM, LENGTH_SHARE } length_unit;

typedef struct tool_length {
    double value;
    length_unit unit;
    bool halved; /* half of it is meant: of hatching, where a width is for all classes */
} tool_length;

/* --page: name, and size in mm as it was named; width 0: not given, below 0: none. */
typedef enum page_turn { TURN_AUTO = 0, TURN_PORTRAIT, TURN_LANDSCAPE, TURN_AS_IS } page_turn;

typedef struct tool_page {
    const char *name; /* "A4", "200x100mm" */
    double width, height;
    page_turn turn;
} tool_page;

enum { MARGIN_TOP = 0, MARGIN_RIGHT, MARGIN_BOTTOM, MARGIN_LEFT };

/* Values of an option that may be given several times, in their order; borrowed. */
typedef struct text_list {
    const char **items; /* [count] */
    uint32_t count;
} text_list;

/* --scale: lengths on paper and in the model; over 0 and 0: to fit. */
typedef struct tool_scale {
    double paper, model;
} tool_scale;

/* --sheet: words of --view, in their order. */
enum { SHEET_MOST = 7 };
typedef struct tool_sheet {
    int views[SHEET_MOST];
    int count;
} tool_sheet;

/* --clip and --section…: a model cut open. */
typedef struct tool_section {
    double plane[DP_CLIP_PLANES][4]; /* normal of any length; n·p = offset, world units */
    bool has_offset[DP_CLIP_PLANES]; /* else through the model's middle */
    uint32_t count;
    int look;              /* word */
    double angle;          /* degrees */
    double spacing, share; /* world units; of the model's size */
    bool has_angle;
} tool_section;

/* All options of the command line; zero means not given. */
typedef struct tool_settings {
    tool_command command;
    question question;
    bool given[OPTIONS_MOST]; /* on the command line itself: by the option's place in its table */
    const char *topic;        /* of --help; NULL: none */
    int completions;          /* word */
    const char *model;     /* its name, or what several are called together; of make: the shape's */
    char **models;         /* [model_count] what to draw, inspect or time (models.h) */
    uint32_t model_count;  /* of make: 0 */
    char models_name[600]; /* "a.stl and 2 more" */
    bool is_one_of_several; /* this run is about one model, and others come before or after it */
    uint32_t number;        /* of it among them, from 0 */
    const char *output;     /* of make */
    const char *files[FILES_MOST]; /* of drawing */
    uint32_t file_count;
    int format, ground; /* words */

    tool_length join, min_length, tolerance;
    bool join_classes, keep_coincident, optimize;

    tool_page page;
    double margin[4]; /* mm: top, right, bottom, left */
    bool landscape, has_margin, has_scale;
    tool_scale scale;
    int unit, angle; /* words */
    uint32_t dpi;
    tool_sheet sheet;
    const char *title;

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

    dp_style style; /* lines and colours; other members follow below */
    tool_length width_of[DP_LINE_COUNT];
    int hidden; /* word; colours of hidden lines are the style's */
    tool_length hidden_width[DP_LEVELS][DP_LINE_COUNT];
    uint32_t levels;
    bool hidden_smooth;
    double xray; /* 0: off */
    uint32_t xray_layers;
    int smooth, smooth_what; /* words */
    double ridge_angle, valley_angle;
    double detail; /* 0: exact */
    bool has_detail;
    int edges, method, between, ink, edge_table; /* words */
    bool cull_back_faces;
    bool gl;             /* drawn by OpenGL */
    int backend;         /* word, of view */
    uint32_t spin;       /* frames that view times */
    const char *dropped; /* a file that view is to take as if it was dropped on its window */

    double pencil_s, pencil_o;
    bool has_pencil_s, has_pencil_o;
    uint32_t pencil_tones;
    int pencil_turns;    /* word */
    const char *stroke;  /* a name, or a PNG file */
    const char *pattern; /* the same */
    tool_length pattern_length;
    double pattern_units;
    int pattern_space, line_light; /* words */
    dp_color lit_color;
    int stroke_u; /* word */
    double stroke_k, stroke_scale, width_by_depth, width_by_light;
    tool_length taper, jitter, overshoot;
    bool has_stroke_k;
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
    bool has_mirror, has_mirror_offset, has_mirror_tint_share;
    double mirror_size, mirror_fade, mirror_tint_share;
    dp_color mirror_tint;
    const char *outputs[OUTPUT_COUNT]; /* files */
    bool wants_edge_map;
    tool_section section;

    text_list only, without, objects; /* names, and NAME:SETTINGS of --object (objects.h) */
    double explode;
    bool has_explode, list;
    int explode_axis; /* word */

    double time[2]; /* s: from and to, the same for a picture */
    bool has_time;
    const char *animation; /* name or number, from 1; "none" */
    dp_deform deform;
    const char *morph; /* a model */
    double blend;
    bool has_deform, has_blend;
    double fps, turn; /* turn: degrees */
    const char *path; /* of the camera: a file */
    uint32_t frame, jobs;
    bool has_turn, has_frame, resume;

    stats_kind stats;
    bool json, quiet;
    double read_time; /* s */
    uint32_t frames;  /* of a film, or of bench */
    uint64_t triangles;
    double shape_size;
    uint32_t seed;
} tool_settings;

typedef enum option_kind {
    OPTION_FLAG = 0,      /* bool */
    OPTION_TEXT,          /* const char * */
    OPTION_COUNT,         /* uint32_t, within the limits */
    OPTION_COUNT64,       /* uint64_t */
    OPTION_NUMBER,        /* double, limits included */
    OPTION_INSIDE,        /* double, limits excluded */
    OPTION_POINT,         /* double[3] */
    OPTION_UP,            /* double[3]: a direction, or the word for one */
    OPTION_ANGLES,        /* double[2] */
    OPTION_TIME,          /* double[2]: a time, s, or from and to */
    OPTION_DEFORM,        /* dp_deform */
    OPTION_PLANE,         /* double[4], then two bools as in tool_settings.mirror */
    OPTION_CLIP,          /* tool_settings.section: one more plane */
    OPTION_SPACING,       /* tool_section: spacing or share */
    OPTION_OUTPUT,        /* tool_settings.files, .outputs, or of make .output */
    OPTION_WORD,          /* int: which of the argument's words */
    OPTION_SIZE,          /* uint32_t[2] */
    OPTION_BYTES,         /* double: a number and K, M or G */
    OPTION_LINES,         /* dp_style.lines */
    OPTION_WIDTHS,        /* tool_settings.width_of */
    OPTION_LENGTH,        /* tool_length, in pixels, mm or pt */
    OPTION_PAGE,          /* tool_page */
    OPTION_MARGIN,        /* double[4], mm */
    OPTION_SCALE,         /* tool_scale */
    OPTION_DETAIL,        /* double; words are numbers */
    OPTION_SHEET,         /* tool_sheet */
    OPTION_COLORS,        /* dp_style.line[].color */
    OPTION_HIDDEN_WIDTHS, /* tool_settings.hidden_width */
    OPTION_HIDDEN_COLORS, /* dp_style.hidden.line[][].color */
    OPTION_COLOR,         /* dp_color */
    OPTION_NAMES,         /* text_list: names of objects */
    OPTION_OBJECT,        /* text_list: names and settings */
    OPTION_STATS,         /* stats_kind; its argument may be left out */
    OPTION_QUESTION       /* question: ends the parsing */
} option_kind;

typedef enum option_group {
    GROUP_PICTURE = 0,
    GROUP_PAGE,
    GROUP_CAMERA,
    GROUP_LINES,
    GROUP_PATHS,
    GROUP_STROKES,
    GROUP_SURFACE,
    GROUP_SECTION,
    GROUP_OBJECTS,
    GROUP_EDGE_MAP,
    GROUP_METHOD,
    GROUP_MOTION,
    GROUP_FILM,
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
    const char *examples[24]; /* command line, then what it does, … NULL */
} command_text;
extern const command_text command_table[COMMAND_COUNT];
extern const char *const group_names[GROUP_COUNT];
extern const char *const group_topics[GROUP_COUNT]; /* for --help; NULL: none */

/* What shows a group's options at work. */
typedef struct option_example {
    option_group group;
    const char *command, *about;
} option_example;
extern const option_example option_examples[];
extern const size_t option_example_count;
extern const char *const models_text[]; /* what MODEL can be; paragraphs, then NULL */

/* Fills *settings; models_free frees what it holds. False: the command line is wrong, and a message is on stderr. */
bool options_parse(int argc, char **argv, tool_settings *settings);

/* Stores one option's value. False: it is wrong, and a message is on stderr. */
bool option_store(const option *o, const char *value, tool_settings *settings);

/* Stores the values of pages: paper, margins, scales, sheets, lengths (page_values.c). */
bool store_page(const option *o, const char *value, tool_page *to);
bool store_margin(const option *o, const char *value, double to[4]);
bool store_scale(const option *o, const char *value, tool_scale *to);
bool store_sheet(const option *o, const char *value, tool_sheet *to);
bool store_length(const option *o, const char *value, tool_length *to);
/* KIND:NAME=VALUE,... (deform.c). */
bool store_deform(const option *o, const char *value, dp_deform *to);
/* Adds a value to an option's list (option_lists.c). */
bool store_list(const option *o, const char *value, text_list *to);
void option_lists_free(tool_settings *s);
/* Is none of the names in [text, end), with commas between, empty? */
bool option_names_check(const char *name, const char *text, const char *end);

/* Reads a plain decimal number, and nothing else, up to `end`. */
bool read_number(const char *text, const char *end, double *number);
/* Reads a number that may have a unit, px, mm, cm, in or pt, up to `end`. */
bool read_length(const char *text, const char *end, tool_length *length);

/* The word of `words` that is spelt most like `word`. */
const char *nearest_word(const char *words, const char *word, char *best, size_t size);
/* Is it spelt so much like `best` that this may have been meant? */
bool is_slip(const char *word, const char *best);

/* Do the settings say enough, and no two of them different things? A message on stderr if not. */
bool options_check(const tool_settings *settings);

/* Says on stderr which given options change nothing beside the others (option_effects.c). */
void options_warn(const tool_settings *settings);
/* Was the option given on the command line itself, not by a preset? */
bool option_given(const tool_settings *settings, const char *name);

/* Which of `words` ("exact|paper") is the word, from 1; 0: none. */
int word_index(const char *words, const char *word);

/* Edit distance from a to b, in letters. */
unsigned spelling_distance(const char *a, const char *b);

/* Prints a first screen, or all about a command other than drawing, or about a topic. False: there
 * is no such topic, and a message is on stderr. */
bool options_help(FILE *out, tool_command command, const char *topic);
/* The topics of --help with something between them. */
void topic_words(char *text, size_t size, const char *between);
void options_man(FILE *out);

#endif
