"""run.py [NAME...]: runs the tests and prints a line for each: `ok N - name` or `not ok N - name`
and what went wrong.

NAME: parts of test modules' names; without any, all run.
"""

import importlib
import os
import sys
import traceback
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))


class Lines(unittest.TestResult):
    """Counts and prints as the Test Anything Protocol does."""

    def tell(self, word, test, error=None):
        print(f"{word} {self.testsRun} - {test.id()}", flush=True)
        if error:
            print("".join(traceback.format_exception(*error)), flush=True)

    def addSuccess(self, test):
        self.tell("ok", test)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        print(f"# skipped: {test.id()}: {reason}", flush=True)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.tell("not ok", test, err)

    addError = addFailure

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err:
            self.tell("not ok", subtest, err)


def main(wanted):
    """All test_*.py beside this file."""
    sys.path.insert(0, HERE)
    suite = unittest.TestSuite()
    for name in sorted(os.listdir(HERE)):
        if (
            name.startswith("test_")
            and name.endswith(".py")
            and (not wanted or any(part in name for part in wanted))
        ):
            suite.addTests(
                unittest.defaultTestLoader.loadTestsFromModule(importlib.import_module(name[:-3]))
            )
    result = Lines()
    suite.run(result)
    print(f"1..{result.testsRun}")
    return 0 if result.wasSuccessful() and result.testsRun else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
