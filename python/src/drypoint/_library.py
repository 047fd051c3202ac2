"""The C library: loads the extension, checks that it fits this package, and turns results into
exceptions.

Whoever calls C does it as `call(lib.dp_draw, context, …)`, which adds the diagnostics and raises.
"""

from __future__ import annotations

import importlib
from typing import Any, Callable

from . import _generated
from ._errors import by_result


def _load() -> tuple[Any, str]:
    """The extension with all formats, or the core alone and why the other one could not be
    loaded."""
    try:
        return importlib.import_module("drypoint._native_io"), ""
    except ImportError as error:
        try:
            return importlib.import_module("drypoint._native"), str(error)
        except ImportError as second:
            raise ImportError(
                f"the package drypoint has no extension that loads here: {second}"
            ) from error


_native, missing = _load()
ffi: Any = _native.ffi
lib: Any = _native.lib
has_io: bool = not missing


def text(pointer: Any) -> str:
    """A C string; empty for NULL."""
    return ffi.string(pointer).decode("utf-8", "replace") if pointer else ""


def call(function: Callable[..., int], *arguments: Any, subject: str = "") -> None:
    """Calls what returns a dp_result and takes a dp_diag last; raises where it fails.

    subject: what the message is about, a file's name say.
    """
    diag = ffi.new("dp_diag *")
    result = function(*arguments, diag)
    if result:
        raise error_of(result, diag, subject)


def error_of(result: int, diag: Any, subject: str = "") -> Exception:
    """The exception for a result, with the C message."""
    message = text(diag.message) or text(lib.dp_result_name(result))
    if result == lib.DP_ERR_UNSUPPORTED and not has_io:
        message += f" (only the core's own readers are here; the others lack a library: {missing})"
    if subject:
        message = f"{subject}: {message}"
    return by_result(_generated.Result(result).name, message, diag.line, diag.offset, diag.item)


class Owned:
    """A pointer to a C object that is destroyed with this one, unless somebody takes it.

    A process that was forked leaves the objects of its parent alone: the threads they know are
        not there.
    """

    def __init__(self, type_name: str, destroy: Callable[[Any], None]) -> None:
        self._slot = ffi.new(f"{type_name} **")
        self._destroy = destroy
        self._pointer: Any = None

    def make(self, function: Callable[..., int], *arguments: Any, subject: str = "") -> Any:
        """Calls a function that makes the object: its last arguments are where it goes, and
        diagnostics."""
        call(function, *arguments, self._slot, subject=subject)
        self._pointer = ffi.gc(self._slot[0], self._destroy)
        return self._pointer

    def take(self) -> Any:
        """The pointer, whose destruction is from now on the taker's business."""
        return ffi.gc(self._pointer, None)


call(lib.dp_version_check_header, *_generated.VERSION)
