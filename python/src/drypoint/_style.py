"""What C tells about styles: their defaults, and what suits a texture."""

from __future__ import annotations

from typing import Any

from ._errors import ArgumentError
from ._generated import Stroke, Style
from ._library import call, ffi, lib
from ._struct import coerce
from ._texture import Texture, filler


def resolved(style: Any = None) -> Style:
    """A style with every default filled in; refuses what is out of range.

    >>> from drypoint import Line
    >>> resolved(Style(line={"ridge": {"width": 3}})).line[Line.RIDGE].width
    3.0
    >>> resolved().ridge_angle
    150.0
    """
    keep: list[Any] = []
    given = filler.new(coerce(Style, style, "style"), keep)
    full = ffi.new("dp_style *")
    call(lib.dp_style_resolve, given, full)
    return filler.read(Style, full)


def stroke_look(name: str, seed: int = 0) -> Stroke:
    """A Stroke with a named texture and what suits it: a pencil jitters, an ink pen tapers.

    >>> stroke_look("pencil").jitter > 0
    True
    """
    style = ffi.new("dp_stroke_style *")
    call(lib.dp_stroke_look, str(name).encode(), style)
    made = filler.read(Stroke, style)
    made.texture = Texture.named(name, seed)
    return made
