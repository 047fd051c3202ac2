#!/usr/bin/env python3
"""Do the quick tests notice faults? Plants single ones at random in src/ and lists those they do not.

    scripts/mutants.py                      100 faults of seed 1: less than an hour on two processors
    scripts/mutants.py --seed 7 --faults 20
    scripts/mutants.py --seed 7 --list      only prints the faults, with their numbers
    scripts/mutants.py --seed 7 --only 12   fault 12 of seed 7 again; leaves it planted, to look at
    scripts/mutants.py --wide               faults not noticed also meet the unit and golden tests that are not quick
    make mutants SEED=7 FAULTS=20           the same by make; ONLY=12 and WIDE=1 too

All of it happens in build/mutants, on a copy of what git lists or would list here. A fault is drawn by its line
(every line of code is equally likely), then by its kind (scripts/faults.py). One that does not compile, or that
the compiler makes the same objects of, is not counted, and the next is drawn in its place; numbers count draws, so
some are missing. The same seed draws the same faults from the same files.

Tests labelled quick are run, and stop at the first that fails, crashes or hangs. Where none does, pictures are
compared by scripts/hashes.sh. The score is noticed / (noticed + unseen that change pictures); what changes nothing
that is looked at may be the same program or a gap, and is worth a look by hand. build/mutants/report.txt has it all.
"""
import argparse
import collections
import filecmp
import itertools
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # nothing is to appear beside the sources
import faults  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
WORK = ROOT / "build/mutants"
TREE, BUILD, PRISTINE, TEMPORARY = WORK / "tree", WORK / "build", WORK / "pristine", WORK / "tmp"
REFERENCE, REPORT = WORK / "reference/drypoint", WORK / "report.txt"
JOBS = int(os.environ.get("JOBS") or os.cpu_count() or 1)

# Optimisation takes longer than it saves here, and changes no picture. Warnings that are always mistakes are errors.
CONFIGURATION = ["-GNinja", "-DCMAKE_C_COMPILER=gcc", "-DCMAKE_BUILD_TYPE=Release", "-DDRYPOINT_SHARED=OFF",
                 "-DDRYPOINT_INSTALL=OFF", "-DCMAKE_C_FLAGS_RELEASE=-O1 -DNDEBUG", "-DCMAKE_C_FLAGS="
                 + " ".join("-Werror=" + warning for warning in (
                     "incompatible-pointer-types", "int-conversion", "discarded-qualifiers", "format"))]
PATIENCE, LEAST_PATIENCE = 10, 20  # a test hangs when it takes so many times as long as without a fault, and so many s
MEMORY = 16 << 30  # bytes of address space: a fault must not take all there is

Test = collections.namedtuple("Test", "name command environment folder skip_code will_fail targets")
Verdict = collections.namedtuple("Verdict", "number fault text state note")  # state: a key of STATES

STATES = {  # in the order of the report
    "unseen": "change pictures, unseen",
    "wide": "change no picture, but a test that is not quick notices",
    "silent": "change nothing that we can see (perhaps the same program: look by hand)",
    "noticed": "noticed",
}


def say(text, end="\n"):
    print(text, end=end, file=sys.stderr, flush=True)


def start(command, **more):
    """Starts a process in a group of its own, so that all its children can be killed."""
    return subprocess.Popen(command, start_new_session=True, stdin=subprocess.DEVNULL, **more)


def end(process):
    """Kills a process and what it has started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def call(command, folder=ROOT, limit=None):
    """Runs a command; returns its exit status, None if it took longer than limit s, and all it printed."""
    process = start(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    try:
        output, _ = process.communicate(timeout=limit)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        return None, ""
    finally:
        end(process)


# -- the copy and its build

def listed():
    """What belongs to the tree, by git, as it is now."""
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                           check=True, capture_output=True).stdout.decode().split("\0")
    return sorted({name for name in names if name and (ROOT / name).is_file()})


def copy_tree():
    """Makes TREE what the files here are; files that are the same already keep their times."""
    names = listed()
    for name in names:
        source, target = ROOT / name, TREE / name
        if not target.is_file() or not filecmp.cmp(source, target, shallow=False):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
            os.utime(target)
    for target in sorted(TREE.rglob("*")):
        if not target.is_dir() and str(target.relative_to(TREE)) not in names:
            target.unlink()
    shared = WORK / "shared"  # models beside the tree, which some tests and hashes.sh draw
    if (ROOT.parent / "shared").is_dir() and not shared.exists():
        shared.symlink_to(ROOT.parent / "shared")


def sources():
    names = [n for n in listed() if n.startswith("src/") and n.endswith((".c", ".h", ".inc"))]
    return [faults.Source(name, (ROOT / name).read_text()) for name in names]


def ninja(*targets):
    status, output = call(["ninja", "-C", str(BUILD), f"-j{JOBS}", *targets])
    return status == 0, output


def build_all():
    """Configures, builds everything once and keeps the objects."""
    say("building without a fault ... ", "")
    begin = time.time()
    status, output = call(["cmake", "-S", str(TREE), "-B", str(BUILD), *CONFIGURATION])
    good, output = ninja() if status == 0 else (False, output)
    if not good:
        sys.exit("does not build without a fault:\n" + output[-3000:])
    shutil.rmtree(PRISTINE, ignore_errors=True)
    for thing in objects():
        (PRISTINE / thing).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(BUILD / thing, PRISTINE / thing)
    REFERENCE.parent.mkdir(exist_ok=True)
    shutil.copy2(BUILD / "drypoint", REFERENCE)
    say(f"{time.time() - begin:.0f} s")


def objects():
    return [path.relative_to(BUILD) for path in BUILD.rglob("*.o")]


def changed_objects():
    """Objects that are not as they were without a fault: by time, and of these by content."""
    newer = [o for o in (p.relative_to(PRISTINE) for p in PRISTINE.rglob("*.o"))
             if not (BUILD / o).exists() or (BUILD / o).stat().st_mtime_ns != (PRISTINE / o).stat().st_mtime_ns]
    return newer, [o for o in newer if not (BUILD / o).exists()
                   or not filecmp.cmp(BUILD / o, PRISTINE / o, shallow=False)]


class Planted:
    """A fault in the tree for as long as it is needed; afterwards nothing needs to be compiled again."""

    def __init__(self, fault, text):
        self.path, self.text, self.fault = TREE / fault.path, text, fault

    def __enter__(self):
        self.times = self.path.stat()
        self.path.write_text(faults.planted(self.text, self.fault))
        return self

    def __exit__(self, *_):
        for archive in BUILD.glob("*.a"):
            archive.unlink()  # made again from the objects when next asked for, which also links what needs it
        for thing in changed_objects()[0]:
            shutil.copy2(PRISTINE / thing, BUILD / thing)
        self.path.write_text(self.text)  # last: without it the next run would compile the file again, so be it
        os.utime(self.path, ns=(self.times.st_atime_ns, self.times.st_mtime_ns))
        clear_temporary()


def clear_temporary():
    shutil.rmtree(TEMPORARY, ignore_errors=True)
    TEMPORARY.mkdir(parents=True)


# -- tests

def read_tests(labels):
    """The tests with a label, as ctest knows them."""
    _, output = call(["ctest", "--test-dir", str(BUILD), "--show-only=json-v1", "-L", labels])
    tests = []
    for test in json.loads(output[output.index("{"):])["tests"]:
        of = {p["name"]: p["value"] for p in test.get("properties", [])}
        command = test["command"]
        targets = [os.path.relpath(word, BUILD) for word in command
                   if word.startswith(f"{BUILD}{os.sep}") and os.path.isfile(word)]
        tests.append(Test(test["name"], command, dict(v.split("=", 1) for v in of.get("ENVIRONMENT", [])),
                          of.get("WORKING_DIRECTORY", str(BUILD)), of.get("SKIP_RETURN_CODE"),
                          of.get("WILL_FAIL", False), targets))
    return tests


class Running:
    def __init__(self, test, limit):
        self.test, self.limit, self.begin = test, limit, time.time()
        self.process = start(test.command, cwd=test.folder, env={**os.environ, **test.environment},
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def outcome(self):
        """None while it runs, "" when it passed, else what is wrong."""
        code = self.process.poll()
        if code is None:
            return "hangs" if time.time() > self.begin + self.limit else None
        if code == self.test.skip_code or (code != 0) == self.test.will_fail:
            return ""
        return f"crashes ({signal.Signals(-code).name})" if code < 0 else "fails"


def words_of(name):
    return {word.rstrip("s") for word in re.split(r"\W|_", name)}


class Subset:
    """Tests, how long each takes without a fault, and how many faults each has noticed."""

    def __init__(self, tests):
        self.tests, self.seconds, self.hits = tests, {}, collections.Counter()

    def measure(self):
        say(f"running {len(self.tests)} tests without a fault ... ", "")
        begin = time.time()
        bad = self.run(self.tests)
        if bad:
            sys.exit(f"without a fault {bad}")
        say(f"{time.time() - begin:.0f} s")

    def run(self, tests):
        """Runs tests, a few at a time; returns what is wrong with the first that is not right, or ""."""
        waiting, running, bad = list(tests), [], ""
        try:
            while (waiting or running) and not bad:
                while waiting and len(running) < JOBS:
                    test = waiting.pop(0)
                    known = self.seconds.get(test.name)
                    running.append(Running(test, max(LEAST_PATIENCE, PATIENCE * known) if known else 600))
                time.sleep(0.01)
                for one in [r for r in running if r.outcome() is not None]:
                    running.remove(one)
                    bad = self._note(one) or bad
        finally:
            for one in running:
                end(one.process)
        return bad

    def _note(self, one):
        outcome = one.outcome()
        end(one.process)
        self.seconds.setdefault(one.test.name, time.time() - one.begin)
        if not outcome:
            return ""
        self.hits[one.test.name] += 1
        return f"{one.test.name} {outcome}"

    def order(self, path):
        """First the tests that share a word with the file's name, then those that notice most in least time."""
        words = words_of(path) - {"src", "c", "h", "inc", "test"}

        def worth(test):
            near = len(words & words_of(test.name))
            return -near, -(self.hits[test.name] + 1) / (self.seconds.get(test.name, 1) + 0.5), test.name
        return sorted(self.tests, key=worth)

    def notice(self, path):
        """Builds and runs, in ever larger groups as most faults are noticed soon; returns what is wrong, or ""."""
        left, group = self.order(path), 3
        while left:
            tests, left, group = left[:group], left[group:], 3 * group
            good, output = ninja(*{t for test in tests for t in test.targets})
            if not good:
                raise RuntimeError(output)
            bad = self.run(tests)
            if bad:
                return bad
        return ""


# -- pictures

class Pictures:
    """What scripts/hashes.sh makes of the program without a fault."""

    def __init__(self):
        self.right, self.seconds = None, None

    def hashes(self, program, limit=None):
        status, output = call([str(TREE / "scripts/hashes.sh"), str(program)], TREE, limit)
        if status is None:
            return None
        return dict(reversed(line.split(" ", 1)) for line in output.splitlines() if " " in line)

    def differences(self):
        """What a fault changes, in words, or ""."""
        if self.right is None:
            begin = time.time()
            self.right = self.hashes(REFERENCE)
            self.seconds = time.time() - begin
            if not self.right:
                sys.exit("scripts/hashes.sh tells nothing about the program without a fault")
        good, output = ninja("drypoint")
        if not good:
            raise RuntimeError(output)
        now = self.hashes(BUILD / "drypoint", 5 * self.seconds + 60)
        if now is None:
            return "drawing hangs"
        names = [name for name in self.right if now.get(name) != self.right[name]]
        return f"{len(names)} of {len(self.right)} pictures, the first: {names[0].strip()}" if names else ""


# -- one fault after the other

class Run:
    def __init__(self, options):
        self.options, self.verdicts, self.uncompiled, self.same = options, [], 0, 0
        self.stopped, self.pictures = False, Pictures()
        self.sources = sources()
        self.texts = {source.path: source.text for source in self.sources}

    def prepare(self):
        copy_tree()
        clear_temporary()
        build_all()
        self.quick = Subset(read_tests("quick"))
        if not self.quick.tests:
            sys.exit("no test is labelled quick")
        self.quick.measure()
        self.more = None
        if self.options.wide:
            names = {test.name for test in self.quick.tests}
            self.more = Subset([test for test in read_tests("unit|golden") if test.name not in names])
            self.more.measure()

    def judge(self, number, fault):
        """What comes of a fault that is planted; None if it does not count."""
        good, _ = ninja("libdrypoint.a", "libdrypoint_io.a")
        if not good:
            self.uncompiled += 1
            return None
        if not changed_objects()[1]:
            self.same += 1
            return None
        try:
            state, note = self._look(fault)
        except RuntimeError:  # a test includes the file, and does not compile
            self.uncompiled += 1
            return None
        return Verdict(number, fault, faults.shown(self.texts[fault.path], fault), state, note)

    def _look(self, fault):
        bad = self.quick.notice(fault.path)
        if bad:
            return "noticed", bad
        different = self.pictures.differences()
        if different:
            return "unseen", different
        bad = self.more.notice(fault.path) if self.more else ""
        return ("wide", bad) if bad else ("silent", "")

    def all(self):
        self.begin, self.begin_busy = time.time(), processor_time()
        try:
            for number, fault in enumerate(faults.draw(self.sources, self.options.seed), 1):
                if len(self.verdicts) == self.options.faults:
                    break
                with Planted(fault, self.texts[fault.path]):
                    verdict = self.judge(number, fault)
                if verdict:
                    self.verdicts.append(verdict)
                    self._tell(verdict)
                    REPORT.write_text(self.report())
        except KeyboardInterrupt:
            self.stopped = True
            say("stopped")
        REPORT.write_text(self.report())

    def _tell(self, verdict):
        done, used = len(self.verdicts), time.time() - self.begin
        left = used / done * (self.options.faults - done)
        say(f"{done}/{self.options.faults}  {verdict.state:7}  {place(verdict)}  {verdict.note}"
            f"  ({used / done:.0f} s each, {left / 60:.0f} min left)")

    def one(self):
        """Plants the fault --only names and leaves it there."""
        fault = next(itertools.islice(faults.draw(self.sources, self.options.seed), self.options.only - 1, None))
        print(f"{fault.path}:{fault.line}: {fault.kind}: {faults.shown(self.texts[fault.path], fault)}", flush=True)
        Planted(fault, self.texts[fault.path]).__enter__()
        verdict = self.judge(self.options.only, fault)
        clear_temporary()
        print(f"{verdict.state}: {verdict.note}" if verdict
              else "does not compile, or the compiler makes the same of it")
        print(f"planted in {TREE / fault.path}\nbuilt in {BUILD}, without the fault {REFERENCE}")

    def report(self):
        count = collections.Counter(verdict.state for verdict in self.verdicts)
        title = "a part of the report: stopped" if self.stopped else "report"
        lines = [f"{title}, seed {self.options.seed}; not counted: {self.uncompiled} that do not compile, "
                 f"{self.same} of which the compiler makes the same", ""]
        for state, words in STATES.items():
            if count[state]:
                lines.append(f"{count[state]} {words}:")
                for verdict in (v for v in self.verdicts if v.state == state):
                    note = f"  ({verdict.note})" if verdict.note else ""
                    lines += [f"  {place(verdict)}{note}", f"      {verdict.text}"]
                lines.append("")
        lines.append("noticed by: " + ", ".join(f"{n} {t}" for t, n in self.quick.hits.most_common()))
        used, busy = time.time() - self.begin, processor_time() - self.begin_busy
        each = max(len(self.verdicts), 1)
        lines.append(f"time: {used / each:.0f} s for each fault, {busy / each:.0f} s of a processor")
        return "\n".join(lines) + f"\n\n{self.score(count)}\n"

    def score(self, count):
        seen, changing = count["noticed"], count["unseen"] + count["wide"]
        percent = f"{100 * seen / (seen + changing):.0f} %" if seen + changing else "none"
        return (f"{len(self.verdicts)} faults, {seen} noticed, {len(self.verdicts) - seen} unseen "
                f"of which {count['unseen']} change pictures: score {percent}")


def processor_time():
    """What all children so far have used, in s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def place(verdict):
    return f"{verdict.number}: {verdict.fault.path}:{verdict.fault.line}: {verdict.fault.kind}"


def options_of(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", default="1", help="which faults are drawn; any word (1)")
    parser.add_argument("--faults", type=int, default=100, metavar="N", help="how many are planted (100)")
    parser.add_argument("--only", type=int, metavar="N", help="plant fault N of the seed, and leave it")
    parser.add_argument("--list", action="store_true", help="print the first faults of the seed; some may not compile")
    parser.add_argument("--wide", action="store_true", help="show those not noticed to all unit and golden tests")
    return parser.parse_args(arguments)


def list_faults(options):
    found = sources()
    texts = {source.path: source.text for source in found}
    for number, fault in enumerate(itertools.islice(faults.draw(found, options.seed), options.faults), 1):
        print(f"{number}: {fault.path}:{fault.line}: {fault.kind}: {faults.shown(texts[fault.path], fault)}")


def main():
    options = options_of(sys.argv[1:])
    if options.list:
        return list_faults(options)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    os.environ["TMPDIR"] = str(TEMPORARY)
    run = Run(options)
    run.prepare()
    if options.only:
        return run.one()
    run.all()
    print(REPORT.read_text(), end="")
    if run.stopped:
        sys.exit(130)


if __name__ == "__main__":
    try:
        main()
    except (KeyboardInterrupt, BrokenPipeError):
        sys.exit(130)
