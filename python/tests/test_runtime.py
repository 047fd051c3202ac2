"""Threads, interrupts, forks, and what happens without Assimp."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

import drypoint

LONG = dict(size=(1200, 900), samples=16)


def long_model(triangles=600_000):
    return drypoint.Source.shape("terrain", triangles=triangles)


def run(program, *arguments):
    """What a Python of its own prints."""
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, timeout=60
    )
    return done.stdout + done.stderr


class Threads(unittest.TestCase):
    """Drawing lets other threads go on, and draws the same in each."""

    def test_the_lock_is_free(self):
        source, over = long_model(), threading.Event()

        def draw():
            drypoint.draw(source, context=drypoint.Context(threads=1), **LONG)
            over.set()

        thread, rounds = threading.Thread(target=draw), 0
        thread.start()
        while not over.is_set():
            rounds += 1
            time.sleep(0)
        thread.join()
        self.assertGreater(rounds, 500)

    def test_at_the_same_time(self):
        expected = drypoint.draw(drypoint.Source.shape("bolt"), size=(200, 150)).rgba.tobytes()
        results, together = [], threading.Barrier(4)

        def draw():
            together.wait()
            for _ in range(5):
                results.append(
                    drypoint.draw(drypoint.Source.shape("bolt"), size=(200, 150)).rgba.tobytes()
                )

        threads = [threading.Thread(target=draw) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(set(results), {expected})
        self.assertEqual(len(results), 20)

    def test_one_context_one_source_for_all(self):
        context, source, results = drypoint.Context(), drypoint.Source.shape("bolt"), []

        def draw(direction):
            camera = drypoint.Camera.fit(direction=direction)
            image = context.draw(source, camera=camera, size=(200, 150))
            results.append((direction, len(image.segments())))

        directions = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)] * 3
        threads = [threading.Thread(target=draw, args=(d,)) for d in directions]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 12)
        self.assertEqual(len(set(results)), 4)

    def test_numbers_of_threads(self):
        images = [
            drypoint.Context(threads=n).draw(drypoint.Source.shape("bolt"), size=(200, 150)).rgba
            for n in (1, 2, 7)
        ]
        for image in images[1:]:
            np.testing.assert_array_equal(image, images[0])
        for wrong in ({"threads": -1}, {"memory": 2**70}, {"threads": "many"}, {"memory": 1}):
            with self.assertRaises(drypoint.Error):
                drypoint.Context(**wrong).draw(drypoint.Source.shape("cube"))


class Stopping(unittest.TestCase):
    """Progress, cancelling, interrupts."""

    def test_progress(self):
        told = []
        drypoint.draw(long_model(), progress=told.append, **LONG)
        self.assertGreater(len(told), 1)
        self.assertEqual(told, sorted(told))
        self.assertTrue(all(0 <= fraction <= 1 for fraction in told))

    def test_cancel(self):
        source, context = long_model(), drypoint.Context()
        with self.assertRaises(drypoint.Cancelled):
            context.draw(source, progress=lambda fraction: True, **LONG)
        self.assertGreater(len(context.draw(drypoint.Source.shape("cube")).segments()), 0)

    def test_exceptions_go_through(self):
        def fail(fraction):
            raise KeyError("mine")

        context = drypoint.Context()
        with self.assertRaises(KeyError):
            context.draw(long_model(), progress=fail, **LONG)
        with self.assertRaisesRegex(drypoint.Error, "must not draw"):
            context.draw(
                long_model(),
                progress=lambda f: [context.draw(drypoint.Source.shape("cube")) for _ in range(2)],
                **LONG,
            )
        self.assertGreater(len(context.draw(drypoint.Source.shape("cube")).segments()), 0)

    def test_interrupt(self):
        # What runs in a shell's background ignores Ctrl-C, and Python with it.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        source = long_model(4_000_000)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        start = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):
                drypoint.draw(source, **LONG)
        timer.join()
        self.assertLess(time.monotonic() - start, 30)
        self.assertGreater(len(drypoint.draw(drypoint.Source.shape("cube")).segments()), 0)


class Processes(unittest.TestCase):
    """Lives of processes and objects."""

    def test_fork(self):
        program = """
import os, drypoint
cube, context = drypoint.Source.shape("cube"), drypoint.Context(threads=2)
first = context.draw(cube).rgba.tobytes(), drypoint.draw(cube).rgba.tobytes()
child = os.fork()
second = context.draw(cube).rgba.tobytes(), drypoint.draw(cube).rgba.tobytes()
assert first == second
if child == 0:
    print("child", flush=True)
    raise SystemExit
print("parent", os.waitpid(child, 0)[1])
"""
        self.assertEqual(run(program).split(), ["child", "parent", "0"])

    def test_without_assimp(self):
        program = """
import sys
sys.modules["drypoint._native_io"] = None
import drypoint
assert not drypoint.has_io
print(len(drypoint.Source.from_bytes(b"OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n", "a.off").groups))
for function in (drypoint.Texture.open, drypoint.Source.open):
    try:
        function(sys.argv[1])
    except drypoint.UnsupportedError as error:
        print("said", "lack" in str(error), "_native_io" in str(error))
"""
        path = os.path.join(os.path.dirname(__file__), "unknown.fbx")
        with open(path, "wb") as file:
            file.write(b"Kaydara FBX Binary  \0")
        self.addCleanup(os.unlink, path)
        self.assertEqual(run(program, path).split(), ["1"] + ["said", "True", "True"] * 2)

    def test_nothing_grows(self):
        source = drypoint.Source.shape("bolt")

        def draw():
            drypoint.draw(source, size=(100, 80), style={"stroke": {"texture": "pencil"}}).drawing(
                optimize=True
            )
            drypoint.Source.from_bytes(
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off"
            ).groups
            try:
                drypoint.draw(source, progress=lambda fraction: 1 / 0, size=(100, 80))
            except ZeroDivisionError:
                pass

        def resident():
            gc.collect()
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1]) * 4096

        for _ in range(10):
            draw()
        before = resident()
        for _ in range(60):
            draw()
        self.assertLess(resident() - before, 6e6)

    def test_end_with_threads_and_contexts(self):
        self.assertEqual(
            run(
                "import drypoint; kept = [drypoint.draw(drypoint.Source.shape('bolt')) for _ in range(4)]"
            ),
            "",
        )


if __name__ == "__main__":
    unittest.main()
