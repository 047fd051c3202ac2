#!/usr/bin/env python3
"""Are faults of every kind planted, in code only, and the same ones each time? Prints TAP."""
import itertools
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
import faults  # noqa: E402


def made(body, path="a.c", whole=False):
    """All (kind, text before, text after) of the faults in a function with this body, or in a whole file."""
    text = body if whole else "int f(int a, int b)\n{\n" + body + "\n}\n"
    source = faults.Source(path, text)
    assert source.balanced, body
    return {(f.kind, text[f.start:f.end], f.text.strip())
            for by_kind in source.faults().values() for found in by_kind.values() for f in found}


def has(body, *wanted):
    missing = set(wanted) - made(body)
    assert not missing, f"{body}: no {missing}, only {made(body)}"


def lacks(body, *words, whole=False, path="a.c"):
    touched = {before for _, before, _ in made(body, path, whole)}
    wrong = [word for word in words if any(before == word or before.startswith(word + " ") for before in touched)]
    assert not wrong, f"{body}: touches {wrong}"


def nothing(body, path="a.c"):
    assert not made(body, path, whole=True), f"{body}: {made(body, path, whole=True)}"


def arithmetic_is_changed():
    has("a = b * c + d;", ("arithmetic", "*", "/"), ("arithmetic", "+", "-"))
    has("a -= b << 2;", ("arithmetic", "-=", "+="), ("arithmetic", "<<", ">>"))
    has("for (int i = 0; i < n; i++) g(i);", ("arithmetic", "++", "--"))


def pointers_are_no_products():
    lacks("float *p = q, *r; *p = *q; g(&a, *b); return *p;", "*", "&")


def comparisons_and_logic_are_changed():
    has("return a < b && c == d;", ("comparison", "<", "<="), ("comparison", "<", ">"), ("comparison", "==", "!="),
        ("logic", "&&", "||"))


def signs_are_dropped():
    has("a = -b;", ("sign", "-", ""))


def numbers_are_changed():
    has("a = 2 + 0.5f * 1000u;", ("number", "2", "3"), ("number", "2", "1"), ("number", "0.5f", "0.55f"),
        ("number", "0.5f", "0.45f"), ("number", "1000u", "1100u"))
    has("a = 0; b = 0.0f; c = 0x10;", ("number", "0", "1"), ("number", "0.0f", "0.1f"), ("number", "0x10", "0x11"))
    assert faults.other_numbers("1e-6f") == ["1.1e-06f", "9e-07f"], faults.other_numbers("1e-6f")
    assert faults.other_numbers("10.0") == ["11.0", "9.0"]


def statements_are_dropped():
    has("a = b; g(a); p->n++; if (a) return 1; if (b) { g(b); continue; } return 0;", ("drop", "a = b;", ";"),
        ("drop", "g(a);", ";"), ("drop", "p->n++;", ";"), ("drop", "return 1;", ";"), ("drop", "continue;", ";"))
    lacks("int a = b; (void)a; return a;", "int a", "(void)a;", "return")


def arguments_change_places():
    has("a = g(b, h(c, d), e);", ("swap", "b, h(c, d)", "h(c, d), b"), ("swap", "c, d", "d, c"))
    lacks("a = fmaxf(b, c); if (b, c) return 0;", "b, c")


def conditions_are_negated():
    has("if (a < b) g(); while (!a) g();", ("negate", "(a < b)", "(!(a < b))"), ("negate", "!", ""))
    has("return a ? b : c ? d : e;", ("negate", "? b : c ? d : e", "? c ? d : e : b"))


def comments_strings_and_directives_are_left():
    nothing("/* a = 1 + 2; */\n// b = 3;\n#define X(a) \\\n    (a + 1)\n")
    nothing("const char *s = \"a + '1\" \"2\";\nchar c = '+';\n")
    has('a = "/*" + 1; /* " */ b = 2;', ("number", "1", "2"), ("number", "2", "3"))


def declarations_are_left():
    nothing("struct s {\n    int a[3], b : 4;\n};\nenum e { A = 1, B = A + 2 };\nint f(int a[3]);\nextern int x[4];\n")
    nothing("_Static_assert(1 + 2 == 3, \"\");\ntypedef int t[3];\n")
    lacks("float a[3], b[4] = {sizeof(int[5])}; assert(a > 6); switch (a) { case 7: break; }", *"34567")


def tables_are_code():
    assert ("number", "1.0f", "1.1f") in made("static const float t[7] = {1.0f, -2.0f};\n", whole=True)
    assert ("sign", "-", "") in made("static const float t[7] = {1.0f, -2.0f};\n", whole=True)
    lacks("static const float t[7] = {[3] = 1.0f};\n", "7", "3", whole=True)


def headers_have_code_in_functions_only():
    text = "enum { A = 1 };\nstatic const int t[] = {2};\nint f(int a[3]);\n" \
           "static inline int g(int a) { return a + 4; }\n"
    lacks(text, *"123", whole=True, path="a.h")
    assert ("number", "4", "5") in made(text, "a.h", whole=True)


def lines_keep_their_numbers():
    text = "int f(int a)\n{\n    g(a,\n      1);\n    return a;\n}\n"
    for by_kind in faults.Source("a.c", text).faults().values():
        for fault in itertools.chain(*by_kind.values()):
            assert faults.planted(text, fault).count("\n") == text.count("\n"), fault


def seeds_say_which():
    text = "int f(int a)\n{\n" + "    a = a * 3 + 1;\n" * 40 + "    return a;\n}\n"

    def first(seed):
        return list(itertools.islice(faults.draw([faults.Source("a.c", text)], seed), 20))
    assert first("1") == first("1") != first("2")
    assert len(set(first("1"))) == 20


def sources_here_are_understood():
    kinds = set()
    for path in sorted((ROOT / "src").rglob("*.*")):
        if path.suffix in (".c", ".h", ".inc"):
            source = faults.Source(str(path), path.read_text())
            assert source.balanced, path
            kinds.update(*source.faults().values())
    assert kinds == set(faults.KINDS), kinds


def main():
    failed = 0
    tests = [value for value in globals().values() if getattr(value, "__module__", "") == __name__
             and value not in (made, has, lacks, nothing, main)]
    for number, test in enumerate(tests, 1):
        try:
            test()
            print(f"ok {number} {test.__name__}")
        except AssertionError as error:
            failed += 1
            print(f"not ok {number} {test.__name__}: {error}")
    print(f"1..{len(tests)}")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
