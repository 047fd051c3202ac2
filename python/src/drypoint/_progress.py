"""Progress: C reports to Python now and then, which tells the caller's function and lets
interrupts through.

An exception that this raises, KeyboardInterrupt too, stops what runs in C and is raised again
there after.
"""

from __future__ import annotations

from typing import Any, Callable, Optional

from ._errors import Cancelled
from ._library import ffi, lib

Progress = Callable[[float], object]
"""Is told the fraction that is done, 0 to 1, negative where that is not known; True stops with
Cancelled."""


class Reporter:
    """Stands between one C object and whoever wants to know. `pointer` and `call` are what C is
    given."""

    def __init__(self) -> None:
        self.function: Optional[Progress] = None
        self.failure: Optional[BaseException] = None
        self._handle = ffi.new_handle(self)
        self.pointer = ffi.new("drypoint_progress *")
        self.call = ffi.addressof(lib, "drypoint_progress_call")

    def run(self, function: Optional[Progress], action: Callable[[], None]) -> None:
        """Runs an action in C; its reports go to `function`."""
        self.function, self.failure = function, None
        self.pointer.handle = self._handle
        lib.drypoint_progress_begin(self.pointer)
        try:
            action()
        except Cancelled:
            failure, self.failure = self.failure, None
            if failure is not None:
                raise failure from None
            raise
        finally:
            self.function, self.pointer.handle = None, ffi.NULL


def _failed(kind: Any, failure: BaseException, trace: Any) -> None:
    """cffi calls this where a report raised: the frame's `handle` says whose."""
    if trace is not None:
        ffi.from_handle(trace.tb_frame.f_locals["handle"]).failure = failure


@ffi.def_extern(name="drypoint_report", error=1, onerror=_failed)
def _report(handle: Any, fraction: float) -> int:
    reporter = ffi.from_handle(handle)
    return 1 if reporter.function is not None and reporter.function(fraction) else 0
