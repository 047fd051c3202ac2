"""What texts say runs: doctests of the package, blocks of docs/python.md and of README.md, and
the examples."""

import doctest
import glob
import importlib
import os
import pkgutil
import re
import runpy
import shutil
import sys
import tempfile
import unittest

import drypoint

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PAGES = [os.path.join(ROOT, "docs", "python.md"), os.path.join(ROOT, "python", "README.md")]


def load_tests(loader, tests, pattern):
    """The doctests as well."""
    for module in pkgutil.iter_modules(drypoint.__path__, "drypoint."):
        if "_native" not in module.name:
            loaded = importlib.import_module(module.name)
            if doctest.DocTestFinder(exclude_empty=True).find(loaded, globs={}):
                try:
                    tests.addTests(
                        doctest.DocTestSuite(loaded, globs=vars(drypoint) | vars(loaded))
                    )
                except ValueError:
                    pass  # it has none
    return tests


class Pages(unittest.TestCase):
    """In a folder of their own, one block after the other."""

    def setUp(self):
        before, folder = os.getcwd(), tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        self.addCleanup(os.chdir, before)
        os.chdir(folder)

    def test_blocks(self):
        for page in PAGES:
            with open(page, encoding="utf-8") as file:
                text = file.read()
            names = {}
            for found in re.finditer(r"```python\n(.*?)```", text, re.DOTALL):
                line = text.count("\n", 0, found.start(1))
                with self.subTest(page=os.path.basename(page), line=line + 1):
                    exec(compile("\n" * line + found.group(1), page, "exec"), names)
            self.assertGreater(len(names), 3, page)

    def test_examples(self):
        for path in sorted(glob.glob(os.path.join(ROOT, "python", "examples", "*.py"))):
            with self.subTest(os.path.basename(path)):
                sys.argv = [path, "120x90"]
                runpy.run_path(path, run_name="__main__")
                self.assertTrue(os.listdir("."), path)


if __name__ == "__main__":
    unittest.main()
