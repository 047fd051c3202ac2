#!/usr/bin/env python3
"""pages.py PROGRAM: do other programs like our pages, and see the same in them?

Looks at the pages that are kept in golden/pages (test_pages.c: they are what is written today) and at what the program
writes: with xmllint and rsvg-convert, qpdf and pdftoppm, gs, and ezdxf; JSON with Python, against the schema. The same
page as SVG, PDF and EPS must show the same ink, and the program's SVG that of its PNG. What a machine lacks is skipped,
with a word. Exit status 77: it lacks everything."""
import json, os, re, shutil, struct, subprocess, sys, tempfile, zlib

HERE = os.path.dirname(os.path.abspath(__file__))
PAGES = os.path.join(HERE, "pages")
SCHEMA = os.path.join(HERE, "..", "..", "docs", "drawing.schema.json")
failed = done = 0


def tell(good, what, why=""):
    global failed, done
    done += 1
    failed += not good
    print(("ok " if good else "not ok ") + what + ("" if good else ": " + str(why).strip()[:600]))


def run(*command):
    p = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return p.returncode, p.stdout.decode("utf-8", "replace")


def have(tool, what):
    if shutil.which(tool):
        return True
    print("skipped: %s, as there is no %s" % (what, tool))
    return False


# ------- pictures -------


def unfilter(raw, width, height, channels):
    rows, before = [], bytearray(width * channels)
    for y in range(height):
        kind = raw[y * (width * channels + 1)]
        row = bytearray(raw[y * (width * channels + 1) + 1 : (y + 1) * (width * channels + 1)])
        for i in range(len(row)):
            a = row[i - channels] if i >= channels else 0
            b, c = before[i], before[i - channels] if i >= channels else 0
            if kind == 1: row[i] = row[i] + a & 255
            elif kind == 2: row[i] = row[i] + b & 255
            elif kind == 3: row[i] = row[i] + (a + b >> 1) & 255
            elif kind == 4:
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                row[i] = row[i] + near & 255
        rows.append(row)
        before = row
    return rows


def dark_of_png(path):
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR": width, height, depth, color = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT": packed += body
        at += size + 12
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    rows = unfilter(zlib.decompress(packed), width, height, channels)
    alpha, colors = channels in (2, 4), 1 if channels < 3 else 3
    dark = set()
    for y, row in enumerate(rows):
        for x in range(width):
            p = row[x * channels : (x + 1) * channels]
            light = sum(p[:colors]) / colors
            if alpha: light = 255 + (light - 255) * p[-1] / 255
            if light < 110: dark.add((x, y))
    return dark, (width, height)


def dark_of_ppm(path):
    data = open(path, "rb").read()
    m = re.match(rb"P6\s(?:#.*\n)?\s*(\d+)\s+(\d+)\s+255\s", data)
    width, height, body = int(m[1]), int(m[2]), data[m.end() :]
    return {(i % width, i // width) for i in range(width * height)
            if sum(body[3 * i : 3 * i + 3]) < 330}, (width, height)


def shares(a, b, reach):
    """Of a's dark pixels, how many have one of b within reach."""
    near = {(x + i, y + k) for x, y in b for i in range(-reach, reach + 1) for k in range(-reach, reach + 1)}
    return len(a & near) / len(a) if a else 1.0


def agree(what, a, b):
    forth, back = shares(a[0], b[0], 1), shares(b[0], a[0], 1)
    close = all(abs(x - y) <= 1 for x, y in zip(a[1], b[1]))
    tell(close and min(forth, back) >= 0.99, what, "sizes %s and %s, %.3f forth, %.3f back" % (a[1], b[1], forth, back))


# ------- JSON -------


def check(value, rule, root, at):
    """Against as much of JSON Schema as ours has."""
    if "$ref" in rule:
        target = root
        for key in rule["$ref"].split("/")[1:]: target = target[key]
        return check(value, target, root, at)
    whole = isinstance(value, int) and not isinstance(value, bool)
    kinds = {"object": isinstance(value, dict), "array": isinstance(value, list), "string": isinstance(value, str),
             "null": value is None, "boolean": isinstance(value, bool), "integer": whole,
             "number": whole or isinstance(value, float)}
    wanted = rule.get("type", list(kinds))
    wrong = None
    if not any(kinds[k] for k in ([wanted] if isinstance(wanted, str) else wanted)): wrong = "type"
    if "const" in rule and value != rule["const"]: wrong = "const"
    if "enum" in rule and value not in rule["enum"]: wrong = "enum"
    if "anyOf" in rule and all(check(value, r, root, at) for r in rule["anyOf"]): wrong = "anyOf"
    if kinds["number"] and not rule.get("minimum", value) <= value <= rule.get("maximum", value): wrong = "range"
    if kinds["number"] and value <= rule.get("exclusiveMinimum", value - 1): wrong = "range"
    if kinds["string"] and not re.search(rule.get("pattern", ""), value): wrong = "pattern"
    if kinds["array"] and not rule.get("minItems", 0) <= len(value) <= rule.get("maxItems", len(value)): wrong = "items"
    if kinds["object"]:
        known = rule.get("properties", {})
        wrong = wrong or next(("lacks " + k for k in rule.get("required", []) if k not in value), None)
        if rule.get("additionalProperties") is False:
            wrong = wrong or next(("has " + k for k in value if k not in known), None)
    if wrong: return "%s: %s" % (at, wrong)
    parts = []
    if kinds["array"]: parts = [(v, rule.get("items", {}), "%s[%d]" % (at, i)) for i, v in enumerate(value)]
    if kinds["object"]: parts = [(v, known.get(k, {}), at + "." + k) for k, v in value.items()]
    return next((e for e in (check(v, r, root, a) for v, r, a in parts) if e), None)


def refuse(text):
    raise ValueError("no JSON: " + text)


def check_json(path):
    name = "json: " + os.path.basename(path)
    try:
        schema = json.load(open(SCHEMA, encoding="utf-8"))
        value = json.load(open(path, encoding="utf-8"), parse_constant=refuse)
        wrong = check(value, schema, schema, "page")
        tell(not wrong, name, wrong)
    except Exception as error:
        tell(False, name, error)


# ------- the other formats -------


def check_dxf(path):
    code = ("import ezdxf, sys; d = ezdxf.readfile(sys.argv[1]); a = d.audit(); "
            "print(d.dxfversion, a.errors, a.fixes); sys.exit(d.dxfversion != 'AC1009' or len(a.errors) + len(a.fixes) > 0)")
    tell(*(lambda r: (r[0] == 0, "dxf: ezdxf on " + os.path.basename(path), r[1]))(run("/usr/bin/python3", "-c", code, path)))


def check_lines(path):
    longest = max(len(line) for line in open(path, "rb").read().split(b"\n"))
    tell(longest < 255, "eps: lines of " + os.path.basename(path), longest)


def look_at(stem, tools, room):
    """Checks a page in every format it is there in; returns its ink by format."""
    name, ink = os.path.basename(stem), {}
    file = lambda ending: stem + "." + ending
    there = lambda ending: os.path.exists(file(ending))
    picture = lambda ending: os.path.join(room, name + "." + ending)
    if there("svg") and tools["xmllint"]:
        status, text = run("xmllint", "--noout", file("svg"))
        tell(not status and not text, "svg: xmllint on " + name, text)
    if there("svg") and tools["rsvg-convert"]:
        status, text = run("rsvg-convert", "-d", "384", "-p", "384", file("svg"), "-o", picture("svg.png"))
        tell(not status and not text, "svg: rsvg-convert on " + name, text)
        if not status: ink["SVG"] = dark_of_png(picture("svg.png"))
    if there("pdf") and tools["qpdf"]:
        status, text = run("qpdf", "--check", file("pdf"))
        tell(not status, "pdf: qpdf on " + name, text)
    if there("pdf") and tools["pdftoppm"]:
        status, text = run("pdftoppm", "-r", "384", "-singlefile", file("pdf"), picture("pdf"))
        tell(not status and not text, "pdf: pdftoppm on " + name, text)
        if not status: ink["PDF"] = dark_of_ppm(picture("pdf.ppm"))
    if there("eps"): check_lines(file("eps"))
    if there("eps") and tools["gs"]:
        status, text = run("gs", "-q", "-dSAFER", "-dBATCH", "-dNOPAUSE", "-dEPSCrop", "-sDEVICE=ppmraw", "-r384",
                           "-dGraphicsAlphaBits=4", "-sOutputFile=" + picture("eps.ppm"), file("eps"))
        tell(not status and not text, "eps: gs on " + name, text)
        if not status: ink["EPS"] = dark_of_ppm(picture("eps.ppm"))
    if there("dxf") and tools["ezdxf"]: check_dxf(file("dxf"))
    if there("json"): check_json(file("json"))
    return ink


def compare(name, ink):
    for other in list(ink)[1:]:
        first = list(ink)[0]
        agree("%s: %s as %s" % (name, first, other), ink[first], ink[other])


def look_at_program(program, tools, room):
    """What the program draws is in its SVG too."""
    stem = os.path.join(room, "drawn")
    view = ["shape:boxes", "--size", "320x240", "--quiet"]
    for ending in ("png", "svg"):
        status, text = run(program, *view, "-o", stem + "." + ending)
        if status: return tell(False, "the program writes " + ending, text)
    ink = look_at(stem, tools, room)
    if "SVG" not in ink: return
    status, text = run("rsvg-convert", "-d", "96", "-p", "96", stem + ".svg", "-o", stem + ".96.png")
    agree("the program's SVG as its PNG", dark_of_png(stem + ".96.png"), dark_of_png(stem + ".png"))


def main():
    tools = {t: have(t, w) for t, w in (("xmllint", "XML"), ("rsvg-convert", "SVG as a picture"), ("qpdf", "PDF"),
                                        ("pdftoppm", "PDF as a picture"), ("gs", "EPS"))}
    tools["ezdxf"] = os.path.exists("/usr/bin/python3") and not run("/usr/bin/python3", "-c", "import ezdxf")[0]
    if not tools["ezdxf"]: print("skipped: DXF, as there is no ezdxf")
    with tempfile.TemporaryDirectory() as room:
        for name in sorted({f.split(".")[0] for f in os.listdir(PAGES)}):
            compare(name, look_at(os.path.join(PAGES, name), tools, room))
        if len(sys.argv) > 1: look_at_program(sys.argv[1], tools, room)
    sys.exit(1 if failed else 0 if any(tools.values()) else 77)


main()
