/* Parses JSON strictly: one value, no comments, no trailing commas, no NaN.
 *
 * Values that are not complete yet lie on a stack; when an array or object ends, its items are
 * copied from there into the arena, one after the other. Invariant: no byte is read beyond the
 * text, and the program's stack grows by one small frame for each of at most DEEPEST levels.
 *
 * Not handled: other encodings than UTF-8, numbers of more digits than a double has (they are
 * rounded). */
#include "base/json.h"

#include "base/diag.h"

#include <math.h>
#include <string.h>

enum { DEEPEST = 256, MOST = 1 << 28 /* values */ };

typedef struct parser {
    const char *start, *at, *end;
    dp_arena *arena;
    dp_json *stack; /* [depth] */
    size_t depth, stack_cap, values;
    dp_diag *diag;
    dp_result result;
} parser;

/* ------- failing ------- */

static uint64_t line_of(const parser *p) {
    uint64_t line = 1;
    for (const char *c = p->start; c < p->at; c++) line += *c == '\n';
    return line;
}

static bool expected(parser *p, const char *what) {
    if (p->at >= p->end)
        p->result = dp_fail_line(p->diag, DP_ERR_FORMAT, line_of(p),
                                 "expected %s, but the JSON text ends", what);
    else if (*p->at > ' ' && *p->at < 0x7f)
        p->result = dp_fail_line(p->diag, DP_ERR_FORMAT, line_of(p), "expected %s, found '%c'",
                                 what, *p->at);
    else
        p->result = dp_fail_line(p->diag, DP_ERR_FORMAT, line_of(p),
                                 "expected %s, found byte 0x%02x", what, (unsigned char)*p->at);
    return false;
}

static bool out_of_memory(parser *p) {
    p->result = dp_fail(p->diag, DP_ERR_MEMORY, "out of memory for JSON");
    return false;
}

/* ------- words ------- */

static void skip_spaces(parser *p) {
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\n' || *p->at == '\r' || *p->at == '\t'))
        p->at++;
}

static bool skip(parser *p, char c) {
    if (p->at >= p->end || *p->at != c) return false;
    p->at++;
    return true;
}

static bool is_digit(const parser *p) { return p->at < p->end && *p->at >= '0' && *p->at <= '9'; }

static bool read_word(parser *p, const char *word) {
    const size_t size = strlen(word);
    if ((size_t)(p->end - p->at) < size || memcmp(p->at, word, size) != 0)
        return expected(p, "a value");
    p->at += size;
    return true;
}

/* ------- numbers ------- */

/* digits * 10^exponent. Powers up to 10^22 are exact, so numbers of a few digits are rounded
 * once. */
static double scale(double digits, int64_t exponent) {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (digits == 0 || exponent < -400) return 0;
    if (exponent > 400) return INFINITY;
    for (; exponent > 22; exponent -= 22) digits *= powers[22];
    for (; exponent < -22; exponent += 22) digits /= powers[22];
    return exponent < 0 ? digits / powers[-exponent] : digits * powers[exponent];
}

/* Digits go into 64 bits while they fit; later ones only count. */
typedef struct digits {
    uint64_t value;
    int64_t exponent;
} digits;

static void read_digits(parser *p, digits *d, int fraction) {
    for (; is_digit(p); p->at++) {
        const bool fits = d->value <= (UINT64_MAX - 9) / 10;
        if (fits) d->value = 10 * d->value + (uint64_t)(*p->at - '0');
        d->exponent += !fits - fraction;
    }
}

static bool read_exponent(parser *p, digits *d) {
    if (!skip(p, 'e') && !skip(p, 'E')) return true;
    const bool negative = p->at < p->end && *p->at == '-';
    if (negative || (p->at < p->end && *p->at == '+')) p->at++;
    if (!is_digit(p)) return expected(p, "an exponent's digit");
    int64_t exponent = 0;
    for (; is_digit(p); p->at++)
        if (exponent < 1000000000) exponent = 10 * exponent + (*p->at - '0');
    d->exponent += negative ? -exponent : exponent;
    return true;
}

static bool read_number(parser *p, dp_json *to) {
    digits d = {0};
    const char *const start = p->at;
    const bool negative = skip(p, '-');
    if (!is_digit(p)) return expected(p, negative ? "a digit" : "a value");
    if (!skip(p, '0')) read_digits(p, &d, 0);
    if (skip(p, '.')) {
        if (!is_digit(p)) return expected(p, "a digit");
        read_digits(p, &d, 1);
    }
    if (!read_exponent(p, &d)) return false;
    const double size = scale((double)d.value, d.exponent);
    *to = (dp_json){.kind = DP_JSON_NUMBER, .as.number = negative ? -size : size};
    if (isfinite(size)) return true;
    p->at = start;
    p->result = dp_fail_line(p->diag, DP_ERR_FORMAT, line_of(p), "a number beyond 1.8e308");
    return false;
}

/* ------- strings ------- */

static bool read_hex(parser *p, uint32_t *code) {
    *code = 0;
    for (int k = 0; k < 4; k++, p->at++) {
        const char c = p->at < p->end ? *p->at : 0;
        const char lower = c >= 'A' && c <= 'F' ? (char)(c | 0x20) : c;
        if (c >= '0' && c <= '9')
            *code = *code << 4 | (uint32_t)(c - '0');
        else if (lower >= 'a' && lower <= 'f')
            *code = *code << 4 | (uint32_t)(lower - 'a' + 10);
        else
            return expected(p, "four hexadecimal digits");
    }
    return true;
}

static char *write_utf8(char *to, uint32_t code) {
    if (code < 0x80) return *to++ = (char)code, to;
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    static const uint8_t marks[] = {0, 0xc0, 0xe0, 0xf0};
    *to++ = (char)(marks[more] | code >> 6 * more);
    for (int k = more - 1; k >= 0; k--) *to++ = (char)(0x80 | (code >> 6 * k & 0x3f));
    return to;
}

/* \uXXXX, or two of them for what lies beyond 16 bits; half a pair becomes U+FFFD. */
static char *read_code(parser *p, char *to) {
    uint32_t code, low;
    if (!read_hex(p, &code)) return NULL;
    if (code >= 0xd800 && code < 0xdc00 && p->end - p->at >= 6 && p->at[0] == '\\' &&
        p->at[1] == 'u') {
        const char *const back = p->at;
        p->at += 2;
        if (!read_hex(p, &low)) return NULL;
        if (low >= 0xdc00 && low < 0xe000)
            return write_utf8(to, 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00));
        p->at = back;
    }
    return write_utf8(to, code >= 0xd800 && code < 0xe000 ? 0xfffd : code);
}

static char *read_escape(parser *p, char *to) {
    static const char from[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    if (skip(p, 'u')) return read_code(p, to);
    const char *const found = p->at < p->end && *p->at ? strchr(from, *p->at) : NULL;
    if (!found) return expected(p, "an escape (\\n, \\u0041 …)"), NULL;
    p->at++;
    *to++ = meant[found - from];
    return to;
}

/* The end of a string, at its quotation mark. *escapes: it holds some. */
static bool find_end(parser *p, bool *escapes) {
    *escapes = false;
    for (; p->at < p->end && *p->at != '"'; p->at++) {
        if ((unsigned char)*p->at < ' ') return expected(p, "the string's end");
        if (*p->at != '\\') continue;
        *escapes = true;
        if (++p->at >= p->end) break;
    }
    return p->at < p->end || expected(p, "the string's end");
}

/* What an escape means is no longer than the escape. */
static bool copy_unescaped(parser *p, const char *start, const char *end, const char **text,
                           size_t *size) {
    char *const copy = dp_arena_take(p->arena, (size_t)(end - start), 1);
    if (!copy) return out_of_memory(p);
    char *to = copy;
    for (p->at = start; p->at < end;) {
        if (*p->at != '\\') {
            *to++ = *p->at++;
            continue;
        }
        p->at++;
        to = read_escape(p, to);
        if (!to) return false;
    }
    *text = copy, *size = (size_t)(to - copy);
    return true;
}

static bool read_string(parser *p, const char **text, size_t *size) {
    bool escapes;
    if (!skip(p, '"')) return expected(p, "a string");
    const char *const start = p->at;
    if (!find_end(p, &escapes)) return false;
    const char *const end = p->at;
    *text = start, *size = (size_t)(end - start);
    if (escapes && !copy_unescaped(p, start, end, text, size)) return false;
    p->at = end + 1;
    return true;
}

/* ------- values ------- */

static bool push(parser *p, const dp_json *value) {
    if (p->values++ >= MOST) {
        p->result = dp_fail(p->diag, DP_ERR_LIMIT, "JSON of more than %d values", (int)MOST);
        return false;
    }
    if (!dp_reserve(&p->arena->memory, &p->stack, &p->stack_cap, p->depth + 1, sizeof *p->stack))
        return out_of_memory(p);
    p->stack[p->depth++] = *value;
    return true;
}

/* Makes items of what lies on the stack from `base` on. */
static bool pop(parser *p, size_t base, dp_json *to) {
    to->count = (uint32_t)(p->depth - base);
    to->as.items =
        dp_arena_copy(p->arena, to->count ? p->stack + base : NULL, to->count, sizeof *p->stack);
    p->depth = base;
    return to->as.items || out_of_memory(p);
}

static bool read_value(parser *p, int level, dp_json *to);

static bool read_name(parser *p, dp_json *member) {
    const char *name;
    size_t size;
    if (!read_string(p, &name, &size)) return false;
    if (size > UINT32_MAX) return expected(p, "a shorter name");
    skip_spaces(p);
    if (!skip(p, ':')) return expected(p, "':'");
    member->name = name, member->name_size = (uint32_t)size;
    return true;
}

/* After the opening bracket. */
static bool read_items(parser *p, int level, char close, dp_json *to) {
    const size_t base = p->depth;
    const bool named = close == '}';
    if (level >= DEEPEST) {
        p->result = dp_fail(p->diag, DP_ERR_LIMIT, "JSON nested more than %d deep", (int)DEEPEST);
        return false;
    }
    skip_spaces(p);
    if (skip(p, close)) return pop(p, base, to);
    do {
        dp_json name = {0}, item;
        skip_spaces(p);
        if ((named && !read_name(p, &name)) || !read_value(p, level + 1, &item)) return false;
        item.name = name.name, item.name_size = name.name_size;
        if (!push(p, &item)) return false;
        skip_spaces(p);
    } while (skip(p, ','));
    if (!skip(p, close)) return expected(p, named ? "',' or '}'" : "',' or ']'");
    return pop(p, base, to);
}

static bool read_value(parser *p, int level, dp_json *to) {
    skip_spaces(p);
    *to = (dp_json){0};
    switch (p->at < p->end ? *p->at : 0) {
    case '{':
        p->at++, to->kind = DP_JSON_OBJECT;
        return read_items(p, level, '}', to);
    case '[':
        p->at++, to->kind = DP_JSON_ARRAY;
        return read_items(p, level, ']', to);
    case '"':
        to->kind = DP_JSON_STRING;
        return read_string(p, &to->as.string.text, &to->as.string.size);
    case 't':
        *to = (dp_json){.kind = DP_JSON_BOOL, .as.truth = true};
        return read_word(p, "true");
    case 'f':
        to->kind = DP_JSON_BOOL;
        return read_word(p, "false");
    case 'n':
        return read_word(p, "null");
    default:
        return read_number(p, to);
    }
}

dp_result dp_json_parse(const char *text, size_t size, dp_arena *arena, const dp_json **out,
                        dp_diag *diag) {
    parser p = {.start = text, .at = text, .end = text + size, .arena = arena, .diag = diag};
    dp_json *const root = dp_arena_take(arena, 1, sizeof *root);
    *out = NULL;
    if (!root) return out_of_memory(&p), p.result;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) p.at += 3;
    bool done = read_value(&p, 0, root);
    if (done) skip_spaces(&p);
    if (done && p.at < p.end) done = expected(&p, "the end of the JSON text");
    dp_free(&arena->memory, p.stack);
    if (done) *out = root;
    return done ? DP_OK : p.result;
}

const dp_json *dp_json_find(const dp_json *object, const char *name) {
    const size_t size = strlen(name);
    if (!object || object->kind != DP_JSON_OBJECT) return NULL;
    for (uint32_t i = 0; i < object->count; i++) {
        const dp_json *const member = &object->as.items[i];
        if (member->name_size == size && memcmp(member->name, name, size) == 0) return member;
    }
    return NULL;
}

const dp_json *dp_json_item(const dp_json *array, uint32_t i) {
    return i < dp_json_count(array) ? &array->as.items[i] : NULL;
}

uint32_t dp_json_count(const dp_json *array) {
    return array && array->kind == DP_JSON_ARRAY ? array->count : 0;
}

bool dp_json_is(const dp_json *string, const char *text) {
    const size_t size = strlen(text);
    return string && string->kind == DP_JSON_STRING && string->as.string.size == size &&
           memcmp(string->as.string.text, text, size) == 0;
}
