/* Letters of single strokes, for drawings that hold no fonts: straight strokes on a grid, upright,
 * in the proportions of lettering type B of ISO 3098 (capitals ten units high, small letters seven,
 * pens one unit wide, two units between letters). ASCII and Latin-1; letters with accents are put
 * together. What else there is, is drawn as a box.
 *
 * A letter is a text: how far the next one is, a character; then its strokes, separated by spaces.
 * A point is two characters: x counts from '0' on (':' is 10), y from 'd' on ('a' is -3, 'n' 10, 'q' 13). */
#include "vector/font.h"

#include "vector/out.h"

#include <string.h>

/* How far a dot goes up: many programs draw a line that goes nowhere too thin, or not at all. */
static const double DOT = 0.4;

static const char box[] = "80d0n6n6d0d";

/* From ' ' on. */
static const char *const ascii[] = {
    "5",
    "31n1g 1d1d",
    "51n1k 3n3k",
    "81d2n 4d5n 0g6g 0k6k",
    "80f2d4d6f6g4i2i0k0l2n4n6l 3c3o",
    "80d6n 1n0m0l1k2l2m1n 5g4f4e5d6e6f5g",
    "86d1l1m2n3n4m4l0g0e1d3d6g",
    "31n1k",
    "53o1l1f3c",
    "51o3l3f1c",
    "83l3f 0k6g 0g6k",
    "80i6i 3l3f",
    "41e1d0b",
    "60i4i",
    "31d1d",
    "60c4o",
    "72d3d5f5l3n2n0l0f2d",
    "71l3n3d",
    "70l2n3n5l5k0d5d",
    "70m1n3n5l5k3i2i 3i5g5f3d1d0e",
    "74d4n0g5g",
    "75n0n0i3i5g5f3d1d0e",
    "74n2n0k0f2d3d5f5g3i2i0g",
    "70n5n2d",
    "72i0k0l2n3n5l5k3i2i0g0f2d3d5f5g3i",
    "71d3d5g5l3n2n0l0k2i3i5k",
    "31d1d 1j1j",
    "41e1d0b 1j1j",
    "75l0i5f",
    "70k5k 0g5g",
    "70l5i0f",
    "70l2n3n5l5k2h2g 2d2d",
    ":6j5k4k3j3g4f5f6g 6k6g7f8g8l6n2n0l0f2d7d",
    "80d3n6d 1g5g",
    "80d0n4n6l6k4i0i 4i6g6f4d0d",
    "86l4n2n0l0f2d4d6f",
    "80d0n3n6k6g3d0d",
    "75n0n0d5d 0i4i",
    "75n0n0d 0i4i",
    "86l4n2n0l0f2d4d6f6i4i",
    "80d0n 6d6n 0i6i",
    "31d1n",
    "64n4f2d1d0e",
    "80d0n 6n0h 2j6d",
    "70n0d5d",
    "80d0n3h6n6d",
    "80d0n6d6n",
    "82d4d6f6l4n2n0l0f2d",
    "80d0n4n6l6k4i0i",
    "82d4d6f6l4n2n0l0f2d 4g6c",
    "80d0n4n6l6k4i0i 3i6d",
    "80f2d4d6f6g4i2i0k0l2n4n6l",
    "80n6n 3n3d",
    "80n0f2d4d6f6n",
    "80n3d6n",
    ":0n2d4l6d8n",
    "80d6n 0n6d",
    "80n3i6n 3i3d",
    "80n6n0d6d",
    "53o1o1c3c",
    "60o4c",
    "51o3o3c1c",
    "71k3n5k",
    "70b5b",
    "51n3l",
    "75k5d 5i3k2k0i0f2d3d5f",
    "70n0d 0f2d3d5f5i3k2k0i",
    "75j4k2k0i0f2d4d5e",
    "75n5d 5i3k2k0i0f2d3d5f",
    "70h5h5i3k2k0i0f2d4d5e",
    "54n3n2m2d 0k4k",
    "75k5b4a1a 5i3k2k0i0f2d3d5f",
    "70n0d 0i2k3k5i5d",
    "31k1d 1n1n",
    "42k2b1a0a 2n2n",
    "60n0d 4k0g 2i4d",
    "41n1e2d",
    ":0d0k 0i1k3k4i4d 4i5k7k8i8d",
    "70d0k 0i2k3k5i5d",
    "72d3d5f5i3k2k0i0f2d",
    "70a0k 0i2k3k5i5f3d2d0f",
    "75a5k 5i3k2k0i0f2d3d5f",
    "50d0k 0i2k3k",
    "70e1d4d5e5f4g1h0i0j1k4k5j",
    "52n2e3d4d 0k4k",
    "70k0f2d3d5f 5k5d",
    "60k2d4k",
    ":0k2d4k6d8k",
    "60d4k 0k4d",
    "60k2d 4k1a0a",
    "60k4k0d4d",
    "53o2n2k1i2g2d3c",
    "31o1b",
    "51o2n2k3i2g2d1c",
    "70h1i2i3h4h5i",
};

/* From U+00A0 on. NULL: put together, as `composed` has it. */
static const char *const latin[] = {
    "5",
    "31k1k 1h1a",
    "75j4k2k0i0f2d4d5e 3l3c",
    "75l4n3n2l2f0d5d 0i4i",
    "82f4f5g5i4j2j1i1g2f 0e2f 6e4f 0k2j 6k4j",
    "80n3i6n 3i3d 1i5i 1g5g",
    "31o1j 1g1b",
    "75m4n2n1m1l5i5h4g 1e2d4d5e5f1i1j2k",
    "51n1n 3n3n",
    ":2d6d8f8l6n2n0l0f2d 6j5k3k2j2h3g5g6h",
    "64n4j 4m3n1n0m0k1j3j4k 0h4h",
    "72k0h2e 5k3h5e",
    "70i5i5g",
    "60i4i",
    ":2d6d8f8l6n2n0l0f2d 3f3l5l6k5i3i 5i6f",
    "60n4n",
    "51n0m0l1k2k3l3m2n1n",
    "83m3g 0j6j 0d6d",
    "50m1n2n3m3l0i3i",
    "50n3n1l2l3k3j2i0i",
    "51l3n",
    "70k0a 0f2d3d5f 5k5d",
    "83d3n 6n2n0l0k2i3i 5n5d",
    "31i1i",
    "52d3c3b2a1a",
    "40m2n2i",
    "61n3n4m4k3j1j0k0m1n 0h4h",
    "70k2h0e 3k5h3e",
    ":0m1n1j 0d8n 7d7i5f8f",
    ":0m1n1j 0d8n 5h6i7i8h5d8d",
    ":0n2n1m2l2k1j0j 0d8n 7d7i5f8f",
    "75c3a2a0c0d3g3h 3k3k",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    ":0d4n8n 4n4d8d 1g4g 4i7i",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "91d1n4n7k7g4d1d 0i4i",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "71f5j 1j5f",
    "82d4d6f6l4n2n0l0f2d 0d6n",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "80d0n 0l4l6j6i4g0g",
    "70d0l2n3n4m4l2j5g5f3d2d",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    ":0j1k3k4i4f3d1d0e0g1h8h8i7k5k4i 4f5d7d8e",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "72d3d5f5i2n 5h3j2j0h0f2d 1l4n",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "80i6i 3l3l 3f3f",
    "72d3d5f5i3k2k0i0f2d 0d5k",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "70n0a 0i2k3k5i5f3d2d0f",
    NULL,
};

/* From U+00C0 on: a letter and its accent, or two blanks. */
static const char composed[] =
    "A`A'A^A~A\"Ao  C,E`E'E^E\"I`I'I^I\"  N~O`O'O^O~O\"    U`U'U^U\"Y'    "
    "a`a'a^a~a\"ao  c,e`e'e^e\"i`i'i^i\"  n~o`o'o^o~o\"    u`u'u^u\"y'  y\"";

/* Under accents, which are wider. */
static const char dotless_i[] = "52k2d", wide_I[] = "52n2d";

/* Over capitals, around x = 3. */
static const struct accent {
    char name;
    const char *strokes;
} accents[] = {{'`', "2q4o"},      {'\'', "4q2o"},      {'^', "1o3q5o"},    {'~', "1o2p4o5p"},
               {'"', "2p2p 4p4p"}, {'o', "2o2q4q4o2o"}, {',', "3d4c4b3a2a"}};

/* The middle of a letter's width. */
static double middle_of(const char *strokes) {
    int least = 99, most = 0;
    for (const char *s = strokes; *s; s += *s == ' ' ? 1 : 2) {
        if (*s == ' ') continue;
        if (*s - '0' < least) least = *s - '0';
        if (*s - '0' > most) most = *s - '0';
    }
    return (least + most) / 2.0;
}

static const char *find_letter(dp_lettering *l, uint32_t code) {
    if (code >= ' ' && code <= '~') return ascii[code - ' '];
    if (code < 0xA0 || code > 0xFF) return box;
    if (latin[code - 0xA0]) return latin[code - 0xA0];
    const char *const pair = composed + (size_t)2 * (code - 0xC0);
    const char *const letter = *pair == 'i'   ? dotless_i
                               : *pair == 'I' ? wide_I
                                              : ascii[*pair - ' '];
    for (size_t i = 0; i < sizeof accents / sizeof *accents; i++)
        if (accents[i].name == pair[1]) l->above = accents[i].strokes;
    l->above_x = middle_of(letter + 1) - 3;
    l->above_y = *pair >= 'a' && pair[1] != ',' ? -3 : 0;
    return letter;
}

/* The points up to the next blank, and past it. */
static size_t read_stroke(const char **strokes, double x, double y,
                          double points[DP_LETTER_STROKE_MOST][2]) {
    size_t count = 0;
    const char *s = *strokes;
    for (; *s && *s != ' ' && count < DP_LETTER_STROKE_MOST; s += 2, count++) {
        points[count][0] = x + (s[0] - '0');
        points[count][1] = y + (s[1] - 'd');
    }
    if (count == 2 && points[0][0] == points[1][0] && points[0][1] == points[1][1])
        points[1][1] += DOT;
    *strokes = *s == ' ' ? s + 1 : s;
    return count;
}

size_t dp_next_stroke(dp_lettering *l, double points[DP_LETTER_STROKE_MOST][2]) {
    for (;;) {
        if (l->strokes && *l->strokes) return read_stroke(&l->strokes, l->x, 0, points);
        if (l->above && *l->above)
            return read_stroke(&l->above, l->x + l->above_x, l->above_y, points);
        const uint32_t code = dp_next_character(&l->rest);
        if (!code) return 0;
        const char *const letter = find_letter(l, code);
        l->x = l->next_x;
        l->next_x += *letter - '0';
        l->strokes = letter + 1;
    }
}
