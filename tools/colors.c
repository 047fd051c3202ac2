/* Colours as people write them: by name, or as #RGB, #RGBA, #RRGGBB or #RRGGBBAA (CSS Color Module
 * Level 4). */
#include "colors.h"
#include "options.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

typedef struct named_color {
    const char *name;
    uint32_t rgb;
} named_color;

/* The 148 named colours of CSS, in order. */
/* clang-format off */
static const named_color names[] = {
    {"aliceblue", 0xF0F8FF}, {"antiquewhite", 0xFAEBD7}, {"aqua", 0x00FFFF},
    {"aquamarine", 0x7FFFD4}, {"azure", 0xF0FFFF}, {"beige", 0xF5F5DC}, {"bisque", 0xFFE4C4},
    {"black", 0x000000}, {"blanchedalmond", 0xFFEBCD}, {"blue", 0x0000FF}, {"blueviolet", 0x8A2BE2},
    {"brown", 0xA52A2A}, {"burlywood", 0xDEB887}, {"cadetblue", 0x5F9EA0}, {"chartreuse", 0x7FFF00},
    {"chocolate", 0xD2691E}, {"coral", 0xFF7F50}, {"cornflowerblue", 0x6495ED},
    {"cornsilk", 0xFFF8DC}, {"crimson", 0xDC143C}, {"cyan", 0x00FFFF}, {"darkblue", 0x00008B},
    {"darkcyan", 0x008B8B}, {"darkgoldenrod", 0xB8860B}, {"darkgray", 0xA9A9A9},
    {"darkgreen", 0x006400}, {"darkgrey", 0xA9A9A9}, {"darkkhaki", 0xBDB76B},
    {"darkmagenta", 0x8B008B}, {"darkolivegreen", 0x556B2F}, {"darkorange", 0xFF8C00},
    {"darkorchid", 0x9932CC}, {"darkred", 0x8B0000}, {"darksalmon", 0xE9967A},
    {"darkseagreen", 0x8FBC8F}, {"darkslateblue", 0x483D8B}, {"darkslategray", 0x2F4F4F},
    {"darkslategrey", 0x2F4F4F}, {"darkturquoise", 0x00CED1}, {"darkviolet", 0x9400D3},
    {"deeppink", 0xFF1493}, {"deepskyblue", 0x00BFFF}, {"dimgray", 0x696969}, {"dimgrey", 0x696969},
    {"dodgerblue", 0x1E90FF}, {"firebrick", 0xB22222}, {"floralwhite", 0xFFFAF0},
    {"forestgreen", 0x228B22}, {"fuchsia", 0xFF00FF}, {"gainsboro", 0xDCDCDC},
    {"ghostwhite", 0xF8F8FF}, {"gold", 0xFFD700}, {"goldenrod", 0xDAA520}, {"gray", 0x808080},
    {"green", 0x008000}, {"greenyellow", 0xADFF2F}, {"grey", 0x808080}, {"honeydew", 0xF0FFF0},
    {"hotpink", 0xFF69B4}, {"indianred", 0xCD5C5C}, {"indigo", 0x4B0082}, {"ivory", 0xFFFFF0},
    {"khaki", 0xF0E68C}, {"lavender", 0xE6E6FA}, {"lavenderblush", 0xFFF0F5},
    {"lawngreen", 0x7CFC00}, {"lemonchiffon", 0xFFFACD}, {"lightblue", 0xADD8E6},
    {"lightcoral", 0xF08080}, {"lightcyan", 0xE0FFFF}, {"lightgoldenrodyellow", 0xFAFAD2},
    {"lightgray", 0xD3D3D3}, {"lightgreen", 0x90EE90}, {"lightgrey", 0xD3D3D3},
    {"lightpink", 0xFFB6C1}, {"lightsalmon", 0xFFA07A}, {"lightseagreen", 0x20B2AA},
    {"lightskyblue", 0x87CEFA}, {"lightslategray", 0x778899}, {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xB0C4DE}, {"lightyellow", 0xFFFFE0}, {"lime", 0x00FF00},
    {"limegreen", 0x32CD32}, {"linen", 0xFAF0E6}, {"magenta", 0xFF00FF}, {"maroon", 0x800000},
    {"mediumaquamarine", 0x66CDAA}, {"mediumblue", 0x0000CD}, {"mediumorchid", 0xBA55D3},
    {"mediumpurple", 0x9370DB}, {"mediumseagreen", 0x3CB371}, {"mediumslateblue", 0x7B68EE},
    {"mediumspringgreen", 0x00FA9A}, {"mediumturquoise", 0x48D1CC}, {"mediumvioletred", 0xC71585},
    {"midnightblue", 0x191970}, {"mintcream", 0xF5FFFA}, {"mistyrose", 0xFFE4E1},
    {"moccasin", 0xFFE4B5}, {"navajowhite", 0xFFDEAD}, {"navy", 0x000080}, {"oldlace", 0xFDF5E6},
    {"olive", 0x808000}, {"olivedrab", 0x6B8E23}, {"orange", 0xFFA500}, {"orangered", 0xFF4500},
    {"orchid", 0xDA70D6}, {"palegoldenrod", 0xEEE8AA}, {"palegreen", 0x98FB98},
    {"paleturquoise", 0xAFEEEE}, {"palevioletred", 0xDB7093}, {"papayawhip", 0xFFEFD5},
    {"peachpuff", 0xFFDAB9}, {"peru", 0xCD853F}, {"pink", 0xFFC0CB}, {"plum", 0xDDA0DD},
    {"powderblue", 0xB0E0E6}, {"purple", 0x800080}, {"rebeccapurple", 0x663399}, {"red", 0xFF0000},
    {"rosybrown", 0xBC8F8F}, {"royalblue", 0x4169E1}, {"saddlebrown", 0x8B4513},
    {"salmon", 0xFA8072}, {"sandybrown", 0xF4A460}, {"seagreen", 0x2E8B57}, {"seashell", 0xFFF5EE},
    {"sienna", 0xA0522D}, {"silver", 0xC0C0C0}, {"skyblue", 0x87CEEB}, {"slateblue", 0x6A5ACD},
    {"slategray", 0x708090}, {"slategrey", 0x708090}, {"snow", 0xFFFAFA}, {"springgreen", 0x00FF7F},
    {"steelblue", 0x4682B4}, {"tan", 0xD2B48C}, {"teal", 0x008080}, {"thistle", 0xD8BFD8},
    {"tomato", 0xFF6347}, {"turquoise", 0x40E0D0}, {"violet", 0xEE82EE}, {"wheat", 0xF5DEB3},
    {"white", 0xFFFFFF}, {"whitesmoke", 0xF5F5F5}, {"yellow", 0xFFFF00}, {"yellowgreen", 0x9ACD32},
};
/* clang-format on */
enum { NAME_COUNT = sizeof names / sizeof *names, NAME_LONGEST = 32 };

/* A value that no colour has: 0 is what is not given. */
static dp_color opaque_or_none(dp_color color) { return color ? color : DP_COLOR_NONE; }

static int digit_of(char c) {
    static const char digits[] = "0123456789abcdef";
    const char *const at = c ? strchr(digits, c >= 'A' && c <= 'F' ? c + 32 : c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* Digits behind the #: one or two for each of red, green, blue and, if there is a fourth, alpha. */
static bool read_digits(const char *text, size_t count, dp_color *color) {
    const size_t each = count > 4 ? 2 : 1, parts = count / each;
    if (count != parts * each || parts < 3 || parts > 4) return false;
    dp_color rgba = 0;
    for (size_t k = 0; k < parts; k++) {
        const int high = digit_of(text[k * each]), low = digit_of(text[k * each + each - 1]);
        if (high < 0 || low < 0) return false;
        rgba = rgba << 8 | (dp_color)(16 * high + low);
    }
    *color = opaque_or_none(parts == 3 ? rgba << 8 | 0xFF : rgba);
    return true;
}

/* The word in small letters; names are so short that what is cut off is none. */
static void copy_small(const char *text, size_t length, char word[NAME_LONGEST]) {
    snprintf(word, NAME_LONGEST, "%.*s", (int)length, text);
    for (char *c = word; *c; c++)
        if (*c >= 'A' && *c <= 'Z') *c = (char)(*c + 32);
}

bool color_read(const char *text, const char *end, dp_color *color) {
    char word[NAME_LONGEST];
    const size_t length = (size_t)(end - text);
    if (length && *text == '#') return read_digits(text + 1, length - 1, color);
    if (length >= NAME_LONGEST) return false;
    copy_small(text, length, word);
    *color = DP_COLOR_NONE;
    if (!strcmp(word, "transparent") || !strcmp(word, "none")) return true;
    for (size_t k = 0; k < NAME_COUNT; k++) {
        *color = (dp_color)(names[k].rgb << 8 | 0xFF);
        if (!strcmp(names[k].name, word)) return true;
    }
    return false;
}

static uint32_t part_of(dp_color color, int shift) { return color >> shift & 0xFF; }

dp_color color_over(dp_color over, dp_color under) {
    const uint32_t share = part_of(over, 0) * 255,
                   rest = part_of(under, 0) * (255 - part_of(over, 0)),
                   alpha = share + rest; /* of 255 squared */
    dp_color color = (alpha + 127) / 255;
    for (int shift = 8; shift < 32 && alpha; shift += 8)
        color |= ((part_of(over, shift) * share + part_of(under, shift) * rest + alpha / 2) / alpha)
                 << shift;
    return opaque_or_none(color);
}

/* The name that is spelt most like the word, or NULL if none is like it. */
static const char *nearest_name(const char *word) {
    const char *best = names[0].name;
    for (size_t k = 0; k < NAME_COUNT; k++)
        if (spelling_distance(word, names[k].name) < spelling_distance(word, best))
            best = names[k].name;
    const size_t length = strlen(word);
    return 3 * spelling_distance(word, best) <= 2 * length ? best : NULL;
}

bool color_wrong(const char *name, const char *text, const char *end) {
    char word[NAME_LONGEST];
    const int length = (int)(end - text);
    copy_small(text, (size_t)length, word);
    const char *const near = *text == '#' ? NULL : nearest_name(word);
    return wrong_usage("--%s: \"%.*s\" is not a colour; %s%s%s", name, length, text,
                       near ? "did you mean " : "", near ? near : "",
                       near ? "?"
                            : "give one like #3060A0, #3060A080 with its alpha, or a name like "
                              "steelblue");
}
