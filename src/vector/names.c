/* Names and titles as each format wants them.
 *
 * They come as UTF-8 from anywhere. What is not UTF-8 becomes U+FFFD, byte by byte, and so do control
 * characters where a format has no way to write them: every file stays valid whatever the text is. */
#include "vector/out.h"

/* How many bytes follow the first of a character, and the least number that needs as many. */
static int bytes_after(uint8_t first, uint32_t *least) {
    if (first >= 0xC2 && first < 0xE0) return *least = 0x80, 1;
    if (first >= 0xE0 && first < 0xF0) return *least = 0x800, 2;
    if (first >= 0xF0 && first < 0xF5) return *least = 0x10000, 3;
    return 0;
}

uint32_t dp_next_character(const char **text) {
    const uint8_t *const at = (const uint8_t *)*text;
    uint32_t least = 0, code = *at;
    if (!code) return 0;
    (*text)++;
    if (code < 0x80) return code;
    const int count = bytes_after(*at, &least);
    if (!count) return DP_NO_CHARACTER;
    code &= 0x3Fu >> count;
    for (int i = 1; i <= count; i++) {
        if ((at[i] & 0xC0) != 0x80) return DP_NO_CHARACTER; /* the closing 0 is none either */
        code = code << 6 | (at[i] & 0x3Fu);
    }
    if (code < least || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
        return DP_NO_CHARACTER;
    *text += count;
    return code;
}

static void put_utf8(dp_out *out, uint32_t code) {
    if (code < 0x80) {
        dp_put_char(out, (char)code);
        return;
    }
    const int after = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    dp_put_char(out, (char)(code >> 6 * after | (0xF80u >> after & 0xFF)));
    for (int i = after; i--;) dp_put_char(out, (char)((code >> 6 * i & 0x3F) | 0x80));
}

static void put_hex(dp_out *out, uint32_t value, int digits) {
    for (int i = digits; i--;) dp_put_char(out, "0123456789ABCDEF"[value >> 4 * i & 15]);
}

/* XML 1.0, 2.2: which characters a document may have at all. */
static bool is_xml(uint32_t code) {
    return code == '\t' || code == '\n' || (code >= ' ' && code != 0xFFFE && code != 0xFFFF);
}

void dp_put_xml(dp_out *out, const char *text) {
    for (uint32_t code; (code = dp_next_character(&text));) {
        if (code == '&')
            dp_put_text(out, "&amp;");
        else if (code == '<')
            dp_put_text(out, "&lt;");
        else if (code == '>')
            dp_put_text(out, "&gt;");
        else if (code == '"')
            dp_put_text(out, "&quot;");
        else
            put_utf8(out, is_xml(code) ? code : DP_NO_CHARACTER);
    }
}

void dp_put_json(dp_out *out, const char *text) {
    if (!text) {
        dp_put_text(out, "null");
        return;
    }
    dp_put_char(out, '"');
    for (uint32_t code; (code = dp_next_character(&text));) {
        if (code == '"' || code == '\\') dp_put_char(out, '\\');
        if (code >= ' ') {
            put_utf8(out, code);
        } else {
            dp_put_text(out, "\\u");
            put_hex(out, code, 4);
        }
    }
    dp_put_char(out, '"');
}

static bool is_plain(const char *text) {
    for (uint32_t code; (code = dp_next_character(&text));)
        if (code < ' ' || code > '~') return false;
    return true;
}

/* ASCII between parentheses, escaped; `most` characters of it. */
static void put_literal(dp_out *out, const char *text, int most) {
    dp_put_char(out, '(');
    for (uint32_t code; most-- && (code = dp_next_character(&text));) {
        if (code == '(' || code == ')' || code == '\\') dp_put_char(out, '\\');
        dp_put_char(out, code < ' ' || code > '~' ? '?' : (char)code);
    }
    dp_put_char(out, ')');
}

void dp_put_pdf(dp_out *out, const char *text) {
    if (is_plain(text)) {
        put_literal(out, text, -1);
        return;
    }
    dp_put_text(out, "<FEFF");
    for (uint32_t code; (code = dp_next_character(&text));) {
        if (code >= 0x10000) {
            put_hex(out, 0xD800 + ((code - 0x10000) >> 10), 4);
            code = 0xDC00 + ((code - 0x10000) & 0x3FF);
        }
        put_hex(out, code, 4);
    }
    dp_put_char(out, '>');
}

/* A line of a DSC file has at most 255 characters; each here may become two. */
void dp_put_postscript(dp_out *out, const char *text) { put_literal(out, text, 100); }

void dp_put_ascii(dp_out *out, const char *text) {
    int room = 200;
    for (uint32_t code; room-- && (code = dp_next_character(&text));)
        dp_put_char(out, code < ' ' || code > '~' ? '?' : (char)code);
}
