"""Files that are there whole or not at all."""

from __future__ import annotations

import os
import tempfile
from typing import Union

from ._errors import FileError

Path = Union[str, "os.PathLike[str]"]


def ending(path: Path) -> str:
    """ "svg" of "a/b.SVG"; empty without one."""
    return os.path.splitext(os.fspath(path))[1][1:].lower()


def _permissions(path: Path) -> int:
    """Those of the file that is replaced, else what the process gives new ones."""
    try:
        return os.stat(path).st_mode & 0o777
    except OSError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask


def write(path: Path, data: bytes) -> None:
    """Writes under another name beside it and renames that when it is complete; until then the
    old file stays. What is there and no regular file, a pipe say, is written in place."""
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as pipe:
            pipe.write(data)
        return
    target = os.path.realpath(path)
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(
            prefix=".", suffix=".part", dir=os.path.dirname(target)
        )
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, _permissions(target))
        os.replace(temporary, target)
    except OSError as error:
        raise FileError(
            f"{os.fspath(path)}: cannot be written: {error.strerror or error}"
        ) from error
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
