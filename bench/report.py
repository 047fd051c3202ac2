#!/usr/bin/env python3
"""report.py FOLDER: bench.json, a Markdown table and a plot of what scripts/bench.sh measured there.

Only the standard library. Ratios are of medians by the clock and, in brackets, of processor time,
which holds when other programs share the machine.
"""

import datetime
import json
import math
import os
import platform
import sys

PEERS = [
    ("llvmpipe_flat_0", "llvmpipe flat"),
    ("llvmpipe_flat_4", "llvmpipe flat, 4 samples"),
    ("llvmpipe_lines_0", "llvmpipe lines"),
    ("llvmpipe_lines_4", "llvmpipe lines, 4 samples"),
]
GROUPS = [  # group, heading, column heading, the main row's place in it
    ("triangles", "Triangles", "model", None),
    ("pixels", "Pixels", "pixels", (1, "1.8 MP")),
    ("width", "Line width", "width", (1, "2 px")),
    ("samples", "Samples per pixel", "samples", (1, "4")),
    ("threads", "Threads", "threads", (1, None)),
    ("lines", "Line classes", "classes", (5, "the paper's four")),
    ("method", "Ways to draw", "way", (0, "the default")),
    ("shading", "Shading and edge map, without other lines, beside flat white", "look", (0, "lines alone")),
]


def read_lines(path):
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def read_json(path):
    lines = read_lines(path)
    return lines[0] if lines else None


def number(value):
    return f"{value:.1f}" if value < 100 else f"{value:.0f}"


def ratio(row, to):
    own, other = row["own"], row.get(to)
    if not own or not other:
        return "–"
    return f"{own['frame_ms'] / other['frame_ms']:.2f} ({own['cpu_ms'] / other['cpu_ms']:.2f})"


def cells(row):
    own = row["own"]
    if not own:
        return ["–"] * (4 + len(PEERS))
    return [
        number(own["frame_ms"]),
        f"{number(own['frame_ms_q1'])}–{number(own['frame_ms_q3'])}",
        number(own["cpu_ms"]),
        ratio(row, "flat"),
    ] + [ratio(row, key) for key, _ in PEERS]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def model_name(row):
    return f"{row['model'].rsplit('.', 1)[0]} ({row['triangles']:,} triangles)".replace(",", " ")


def group_table(rows, group, column, main_place):
    chosen = [row for row in rows if row["group"] == group]
    named = [(model_name(row) if group == "triangles" else row["label"], row) for row in chosen]
    main = next((row for row in rows if row["main"] and row["group"] == "triangles"), None)
    if main and main_place and named:
        place, label = main_place
        if group in ("lines", "method"):
            place = place and len(named)
        named.insert(min(place, len(named)), (label or str(main["threads"]), main))
    head = [column, "ms", "middle half", "cpu ms", "/ own flat"]
    return table(head + [f"/ {label}" for _, label in PEERS], [[n] + cells(r) for n, r in named])


def goal_table(rows, starts):
    """What this is meant to reach, on the main model."""
    main = next((row for row in rows if row["main"] and row["group"] == "triangles"), None)
    quads = next((row for row in rows if row["label"] == "ink=quads"), None)
    single = next((row for row in rows if row["main"] and row["group"] == "threads"), None)
    body = []

    def goal(what, row, variant, to, most):
        if not row or not row[variant] or not row.get(to):
            return
        own, other = row[variant], row[to]
        by_clock, by_cpu = own["frame_ms"] / other["frame_ms"], own["cpu_ms"] / other["cpu_ms"]
        body.append([what, f"{most:.3f}", f"{by_clock:.3f}", f"{by_cpu:.3f}"])

    goal("lines / llvmpipe flat, no AA", main, "own", "llvmpipe_flat_0", 0.4)
    goal("lines / own flat", main, "own", "flat", 1.5)
    goal("own flat / llvmpipe flat, 4 samples", main, "flat", "llvmpipe_flat_4", 1 / 5)
    goal("lines / llvmpipe lines, 4 samples", main, "own", "llvmpipe_lines_4", 1 / 30)
    goal("ink=quads / llvmpipe lines, 4 samples", quads, "own", "llvmpipe_lines_4", 1 / 4)
    for label, most in (("edge map, diagonal", 1.5), ("Gooch", 1.3), ("toon, cartoon map", 1.3),
                        ("hatching on the screen", 1.8), ("hatching on the object", 1.8)):
        look = next((row for row in rows if row["group"] == "shading" and row["label"] == label), None)
        goal(f"{label} / own flat", look, "own", "flat", most)
    large = [row for row in rows if row["group"] == "triangles" and row["own"] and main
             and row["triangles"] > main["triangles"] > 0]
    for row in large:
        linear = row["triangles"] / main["triangles"]
        body.append([f"{row['model'].rsplit('.', 1)[0]} / main model, per triangle", "1.200"] +
                    [f"{row['own'][key] / main['own'][key] / linear:.3f}"
                     for key in ("frame_ms", "cpu_ms")])
    if single and single["own"] and main["threads"] == 2:
        gain = main["own"]["frame_ms"] / single["own"]["frame_ms"]
        body.append(["two threads / one", f"{1 / 1.8:.3f}", f"{gain:.3f}", "–"])
    for start in starts:
        if "871k" in start["model"]:
            run = start["run"]
            body.append(["file to picture, s", "0.300", f"{run['seconds']:.3f}",
                         f"{run['processor_seconds']:.3f}"])
            body.append(["file to picture, MB", "120", f"{run['peak_mb']:.0f}", "–"])
    return table(["", "at most", "by the clock", "by processor time"], body) if body else ""


def stage_table(rows):
    chosen = [row for row in rows if row["group"] == "triangles" and row["own"]]
    if not chosen:
        return ""
    stages = list(chosen[0]["own"]["stages"])
    body = []
    for row in chosen:
        for variant, word in (("own", "lines"), ("flat", "flat")):
            if row[variant]:
                times = [f"{row[variant]['stages'][stage]:.2f}" for stage in stages]
                body.append([f"{row['model'].rsplit('.', 1)[0]}, {word}"] + times)
    return table(["ms per stage"] + stages, body)


def moved(row):
    """Bytes that each stage has to read and write at the least, each datum once per pass over it."""
    vertices, triangles, segments = row["vertices"], row["triangles"], row["segments"]
    samples = row["width"] * row["height"] * row["samples"]
    return {
        "vertices": vertices * (12 + 16),            # positions; transformed vertices
        "bin": triangles * (12 + 48 + 2 * 16 + 8),   # corners, vertices; rectangles; entries
        # corners and vertices again, points and planes, a slot for each of three edges; depth and winner of
        # samples: cleared, drawn, looked at; pixels
        "tiles": triangles * (4 + 12 + 48 + 2 * 80 + 2 * 48) + samples * 3 * 8 + samples // row["samples"] * 4,
        "segments": segments * (32 + 100 + 60),      # pieces; segments; strokes
        "ink": segments * 60 + samples * 4 + samples // row["samples"] * 8,
    }


def bounds_table(rows, machine, instructions):
    """What a frame of the main model is bound by: each stage beside what the machine can do."""
    main = next((row for row in rows if row["main"] and row["group"] == "triangles"), None)
    if not main or not main["own"] or not machine:
        return ""
    threads = machine[-1]
    body = []
    for stage, count in moved(main).items():
        ms = main["own"]["stages"][stage]
        rate = count / ms / 1e6 if ms > 0 else 0
        executed = instructions.get(stage) if instructions else None
        body.append([stage, f"{ms:.2f}", f"{count / 1e6:.0f}", f"{rate:.1f}", f"{rate / threads['triad_gb_s']:.2f}",
                     f"{executed / 1e6:.0f}" if executed else "–",
                     f"{executed / ms / 1e6 / threads['threads']:.1f}" if executed and ms > 0 else "–"])
    return table(["stage", "ms", "MB moved, at the least", "GB/s", "of the triad",
                  "million instructions (AVX2)", "of them per ns and core"], body)


def start_table(starts):
    body = []
    for start in starts:
        run = start["run"]
        body.append([
            start["model"], f"{start['file_mb']:.1f}", f"{run['seconds']:.3f}",
            f"{run['seconds_min']:.3f}–{run['seconds_max']:.3f}",
            f"{run['processor_seconds']:.3f}", f"{run['peak_mb']:.0f}",
        ])
    return table(["file", "MB", "s", "least–most", "cpu s", "peak MB"], body)


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        return f"{names[0]}, {len(names)} processors"
    except (OSError, IndexError):
        return f"{platform.processor() or platform.machine()}, {os.cpu_count()} processors"


def markdown(report):
    rows = report["rows"]
    text = [
        f"# Bench, {report['date']}\n",
        f"{report['processor']}. Peer: {report['peer'] or 'none, Mesa was not there'}. Perspective, the"
        " whole model seen from direction (1, 0.6, 1); 1680×1050, 4 samples, lines of 2 px of the paper's"
        " four classes, one thread per processor, unless a row says otherwise. Medians of frames drawn"
        " in turn with what they are compared to; ratios by the clock and, in brackets, by processor"
        " time. llvmpipe lines: silhouettes and ridges by a geometry shader.\n",
    ]
    if report["machine"]:
        text.append(table(
            ["threads", "triad GB/s", "read GB/s", "fill GB/s", "Gflop/s"],
            [[str(m["threads"])] + [f"{m[k]:.1f}" for k in
             ("triad_gb_s", "read_gb_s", "fill_gb_s", "gflops")] for m in report["machine"]]))
    text.append("## Goals\n\n" + goal_table(rows, report["starts"]))
    for group, heading, column, main_place in GROUPS:
        if any(row["group"] == group for row in rows):
            text.append(f"## {heading}\n\n" + group_table(rows, group, column, main_place))
    text.append("## Stages\n\n" + stage_table(rows))
    text.append("## What bounds a frame of the main model\n\n" +
                bounds_table(rows, report["machine"], report["instructions"]))
    text.append("## File to picture, a new process\n\n" + start_table(report["starts"]))
    return "\n".join(text)


# The plot: frame time over triangles, both logarithmic.

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 470, 70, 200, 30, 60
SERIES = [  # variant, label, colour, dashes
    ("own", "Drypoint, four line classes", "#000000", ""),
    ("flat", "Drypoint, flat white", "#888888", ""),
    ("llvmpipe_flat_0", "llvmpipe flat, no AA", "#2a6fb0", "6 4"),
    ("llvmpipe_flat_4", "llvmpipe flat, 4 samples", "#2a6fb0", ""),
    ("llvmpipe_lines_0", "llvmpipe lines, no AA", "#b0402a", "6 4"),
    ("llvmpipe_lines_4", "llvmpipe lines, 4 samples", "#b0402a", ""),
]


def logarithms(values):
    """The range of the logarithms, with some room around them."""
    return math.log10(min(values)) - 0.1, math.log10(max(values)) + 0.1


def decades(limits):
    return range(math.ceil(limits[0]), math.floor(limits[1]) + 1)


def short(exponent):
    value = 10 ** (exponent % 3)
    return f"{value}{['', ' k', ' M', ' G'][exponent // 3]}"


def text_at(x, y, text, extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {extra}>{text}</text>'


def spread_apart(labels, step):
    """Moves (y, …) down until no two are nearer than step; sorted by y."""
    placed = []
    for y, *rest in sorted(labels):
        placed.append((max(y, placed[-1][0] + step) if placed else y, *rest))
    return placed


def axes(x_of, y_of, x_range, y_range):
    out = []
    for e in decades(x_range):
        x = x_of(10 ** e)
        out.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        out.append(text_at(x, HEIGHT - BOTTOM + 18, short(e), 'text-anchor="middle"'))
    for e in decades(y_range):
        y = y_of(10 ** e)
        label = f"{10 ** e:g} ms" if e < 3 else f"{10 ** (e - 3)} s"
        out.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        out.append(text_at(LEFT - 8, y + 4, label, 'text-anchor="end"'))
    middle = (LEFT + WIDTH - RIGHT) / 2
    out.append(text_at(middle, HEIGHT - 16, "triangles", 'text-anchor="middle"'))
    return out


def plot(rows):
    name = next((row["model"].split("-")[0] for row in rows if row["main"]), "")
    chosen = [row for row in rows if row["group"] == "triangles" and row["model"].startswith(name)]
    curves = [(series, [(r["triangles"], r[series[0]]["frame_ms"]) for r in chosen if r[series[0]]])
              for series in SERIES]
    curves = [(series, sorted(points)) for series, points in curves if points]
    if not curves:
        return ""
    x_range = logarithms([x for _, points in curves for x, _ in points])
    y_range = logarithms([y for _, points in curves for _, y in points])

    def x_of(x):
        part = (math.log10(x) - x_range[0]) / (x_range[1] - x_range[0])
        return LEFT + part * (WIDTH - LEFT - RIGHT)

    def y_of(y):
        part = (math.log10(y) - y_range[0]) / (y_range[1] - y_range[0])
        return HEIGHT - BOTTOM - part * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           f'font-family="sans-serif" font-size="12" fill="#222">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           text_at(LEFT, 18, f"Time of a frame against triangles: {name}, 1680×1050 pixels")]
    out += axes(x_of, y_of, x_range, y_range)
    labels = []
    for (_, label, colour, dashes), points in curves:
        places = [(x_of(x), y_of(y)) for x, y in points]
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
        out.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2" '
                   f'stroke-linejoin="round" stroke-dasharray="{dashes or "none"}"/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in places]
        labels.append((places[-1][1] + 4, places[-1][0] + 8, label, colour))
    out += [text_at(WIDTH - RIGHT + 8 if x < WIDTH - RIGHT else x, y, label, f'fill="{colour}"')
            for y, x, label, colour in spread_apart(labels, 15)]
    return "\n".join(out + ["</svg>", ""])


def main(folder):
    peer = read_json(os.path.join(folder, "llvmpipe.json"))
    report = {
        "date": datetime.date.today().isoformat(),
        "processor": processor(),
        "peer": peer and f"{peer['renderer']}, {peer['version']}",
        "machine": read_json(os.path.join(folder, "machine.json")),
        "instructions": read_json(os.path.join(folder, "instructions.json")),
        "rows": read_lines(os.path.join(folder, "rows.jsonl")),
        "starts": read_lines(os.path.join(folder, "starts.jsonl")),
    }
    for name, content in (("bench.json", json.dumps(report, indent=1) + "\n"),
                          ("bench.md", markdown(report)), ("bench.svg", plot(report["rows"]))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(content)


if __name__ == "__main__":
    main(sys.argv[1])
