"""Textures of strokes and patterns."""

from __future__ import annotations

import os
from typing import Any, Union

import numpy as np

from . import _arrays, _generated
from ._errors import ArgumentError, UnsupportedError
from ._library import Owned, ffi, has_io, lib, missing, text
from ._struct import Filler


class Texture:
    """An image that repeats along a line. u runs along the line, v across it.

    >>> Texture.named("pencil").pixels.shape[2]
    4
    """

    def __init__(self) -> None:
        self._owned = Owned("dp_texture", lib.dp_texture_destroy)

    @property
    def pointer(self) -> Any:
        """C's object."""
        return self._owned._pointer

    @classmethod
    def named(cls, name: str, seed: int = 0) -> "Texture":
        """A procedural texture; textures() tells their names. Each seed gives another one of the
        kind."""
        texture = cls()
        texture._owned.make(lib.dp_texture_named, str(name).encode(), seed, ffi.NULL)
        return texture

    @classmethod
    def from_array(cls, pixels: Any) -> "Texture":
        """A texture of an array of uint8, (height, width), or (height, width, 1 to 4): grey, grey
        and alpha, RGB, RGBA. Alpha is the amount of ink; without it, black is full ink."""
        array = np.ascontiguousarray(_arrays.real(pixels, "texture"))
        if array.dtype != np.uint8 or array.ndim not in (2, 3) or not array.size:
            raise ArgumentError(
                f"texture: an array of {array.dtype} of shape {array.shape} is not one of uint8 "
                "of shape "
                "(height, width) or (height, width, channels)"
            )
        height, width = array.shape[:2]
        desc = {
            "pixels": ffi.from_buffer("uint8_t[]", array),
            "width": width,
            "height": height,
            "channels": array.shape[2] if array.ndim == 3 else 1,
        }
        texture = cls()
        texture._owned.make(lib.dp_texture_create, ffi.new("dp_texture_desc *", desc))
        return texture

    @classmethod
    def open(cls, path: Union[str, "os.PathLike[str]"]) -> "Texture":
        """A texture of a PNG file."""
        if not has_io:
            raise UnsupportedError(
                f"{path}: reading PNG files lacks a library here ({missing}); give "
                "from_array() the "
                "pixels"
            )
        texture = cls()
        texture._owned.make(lib.dp_io_read_texture, os.fsencode(path), ffi.NULL, subject=str(path))
        return texture

    @property
    def pixels(self) -> np.ndarray:
        """(height, width, 4) of uint8: colour, and ink as alpha."""
        size = ffi.new("uint32_t[2]")
        pixels = lib.dp_texture_pixels(self.pointer, size, size + 1)
        buffer = ffi.buffer(pixels, 4 * size[0] * size[1])
        return np.frombuffer(buffer, np.uint8).reshape(size[1], size[0], 4).copy()


def texture_of(value: Any, what: str) -> Texture:
    """A texture of one, of a name or of pixels."""
    if isinstance(value, Texture):
        return value
    if isinstance(value, str):
        return Texture.named(value)
    if isinstance(value, np.ndarray):
        return Texture.from_array(value)
    raise ArgumentError(
        f"{what}: {value!r} is no Texture, and neither the name nor the pixels of one"
    )


filler = Filler(ffi, lib, _generated, texture_of)
"""Copies dataclasses into C's structs."""


def textures() -> dict[str, str]:
    """Names of procedural textures, and what each is."""
    numbers = range(lib.dp_texture_count())
    return {text(lib.dp_texture_name(i)): text(lib.dp_texture_about(i)) for i in numbers}
