"""What people write: names of enums' members, colours, sets of lines. Unknown names raise with
the nearest known one."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from enum import IntEnum
from numbers import Integral
from typing import TypeVar, Union

from ._errors import ArgumentError

Color = Union[str, int, tuple[float, ...], None]
"""'#RGB', '#RRGGBB', '#RRGGBBAA', a name of CSS, 'none', 0xRRGGBBAA, or a tuple of 3 or 4:
integers of 0 to 255, or floats of 0 to 1. None is the default."""

Lines = Union[Iterable[Union[str, int]], str, int, None]
"""A set of names of lines, {'silhouette', 'ridge'}; one name; 'all'; 'none'; C's bits; or None,
the default: all."""

E = TypeVar("E", bound=IntEnum)


def unknown(what: str, name: object, known: Iterable[str]) -> ArgumentError:
    """The error for a name that is not among the known ones."""
    names = sorted(known)
    near = difflib.get_close_matches(str(name).lower(), names, 1, 0.5)
    hint = f"did you mean {near[0]!r}?" if near else "known: " + ", ".join(names[:24])
    return ArgumentError(f"{what}: there is no {name!r}; {hint}")


def member(enum: type[E], value: object, what: str) -> E:
    """A member of an enum, by name (any case, - or _), number or itself."""
    if isinstance(value, str):
        found = enum.__members__.get(value.upper().replace("-", "_"))
        if found is None:
            raise unknown(what, value, (name.lower() for name in enum.__members__))
        return found
    if isinstance(value, IntEnum) and not isinstance(value, enum):
        raise ArgumentError(f"{what}: {value!r} is a member of another enum than {enum.__name__}")
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < len(enum):
        return enum(value)
    raise ArgumentError(f"{what}: {value!r} is neither a name nor a member of {enum.__name__}")


def line_bits(lines: Lines, line_enum: type[IntEnum], no_lines: int, what: str = "lines") -> int:
    """C's bits of a set of lines."""
    if lines is None:
        return 0
    if isinstance(lines, int) and not isinstance(lines, IntEnum):
        if not 0 <= lines < 1 << 32:
            raise ArgumentError(f"{what}: {lines} is no set of lines")
        return lines
    if isinstance(lines, str) and lines in ("all", "none"):
        return 0 if lines == "all" else no_lines
    single = isinstance(lines, (str, IntEnum))
    try:
        members = [lines] if single else list(lines)  # type: ignore[arg-type]
    except TypeError:
        raise ArgumentError(f"{what}: {lines!r} is no set of names of lines") from None
    bits = sum({1 << member(line_enum, name, what) for name in members})
    return bits or no_lines


def _hex(text: str) -> int | None:
    """0xRRGGBBAA of '#…', or None."""
    digits = text[1:]
    if len(digits) in (3, 4):
        digits = "".join(2 * digit for digit in digits)
    if len(digits) == 6:
        digits += "FF"
    if len(digits) != 8 or not all(digit in "0123456789abcdefABCDEF" for digit in digits):
        return None
    return int(digits, 16)


def _named(text: str, what: str, colors: dict[str, int]) -> int:
    if text.startswith("#"):
        value = _hex(text)
        if value is None:
            raise ArgumentError(f"{what}: {text!r} is not #RGB, #RGBA, #RRGGBB or #RRGGBBAA")
        return value
    name = text.lower()
    if name == "none":
        return 0
    if name not in colors:
        raise unknown(what, text, ["none", *colors])
    return colors[name] << 8 | 0xFF


def _channels(values: tuple[float, ...], what: str) -> int:
    channels = list(values)
    whole = all(isinstance(value, Integral) for value in channels)
    if len(channels) == 3:
        channels.append(255 if whole else 1.0)
    most = 255 if whole else 1
    if len(channels) != 4 or not all(0 <= value <= most for value in channels):
        raise ArgumentError(
            f"{what}: {values!r} is not 3 or 4 integers of 0 to 255, or floats of 0 to 1"
        )
    result = 0
    for value in channels:
        result = result << 8 | (int(value) if whole else round(value * 255))
    return result


def color(value: Color, what: str, colors: dict[str, int], transparent: int) -> int:
    """0xRRGGBBAA, 0 for None. What is wholly transparent becomes `transparent`: 0 would mean the
    default."""
    if value is None:
        return 0
    if isinstance(value, str):
        result = _named(value, what, colors)
    elif isinstance(value, Integral):
        result = int(value)
        if not 0 <= result < 1 << 32:
            raise ArgumentError(f"{what}: {value!r} is not 0xRRGGBBAA")
        return result  # as in C, where 0 is the default
    else:
        try:
            result = _channels(tuple(value), what)  # type: ignore[arg-type]
        except TypeError:
            raise ArgumentError(f"{what}: {value!r} is no colour") from None
    return result if result & 0xFF else transparent
