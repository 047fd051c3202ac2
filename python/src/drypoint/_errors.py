"""Exceptions: one for each class of failure that the C library tells apart."""

from __future__ import annotations


class Error(Exception):
    """What the library refuses or cannot do. The text is C's message.

    Attributes:
        line: of a text file, from 1 on; 0 where there is none.
        offset: in a binary file, bytes; 0 where there is none.
        item: number of the polygon, vertex, … that is meant, from 0 on.
    """

    def __init__(self, message: str, line: int = 0, offset: int = 0, item: int = 0) -> None:
        super().__init__(message)
        self.line, self.offset, self.item = line, offset, item


class ArgumentError(Error, ValueError):
    """The call is wrong."""


class OutOfMemory(Error, MemoryError):
    """An allocation failed: provide more memory, or draw less."""


class FileError(Error, OSError):
    """The system refused to open, read or write."""


class FormatError(Error):
    """A file's content is not what its format says. `line` or `offset` tell where, where that is
    known."""


class UnsupportedError(Error):
    """Sound, but not something this build or this version does."""


class LimitError(Error):
    """A count or size beyond what the library can address."""


class Cancelled(Error):
    """A progress callback asked to stop."""


_CLASSES = {
    "ERR_ARGUMENT": ArgumentError,
    "ERR_MEMORY": OutOfMemory,
    "ERR_IO": FileError,
    "ERR_FORMAT": FormatError,
    "ERR_UNSUPPORTED": UnsupportedError,
    "ERR_LIMIT": LimitError,
    "ERR_CANCELLED": Cancelled,
}


def by_result(name: str, message: str, line: int, offset: int, item: int) -> Error:
    """The exception for a member of Result."""
    return _CLASSES.get(name, Error)(message, line, offset, item)
