"""The base of the dataclasses that mirror C's structs, and how they are copied there and back.

A class names its struct (`_c`) and says which fields need more than a copy (`_kinds`): names of
enums, colours, sets of lines, structs and arrays of them, images. Everything else is a number or
a few.
"""

from __future__ import annotations

import dataclasses
import functools
import operator
from collections.abc import Mapping
from typing import Any, ClassVar, TypeVar, Union, dataclass_transform

import numpy as np

from . import _names
from ._errors import ArgumentError
from ._names import Color, Lines

Pixels = Any
"""An image: an array of uint8, (height, width) or (height, width, 4); None is the built-in one."""

TextureLike = Any
"""A Texture, the name of one, or None."""

__all__ = ["Color", "Lines", "Pixels", "Struct", "TextureLike", "struct"]

S = TypeVar("S", bound="Struct")


@dataclass_transform()
def struct(cls: type[S]) -> type[S]:
    """A dataclass with slots (a mistyped name is no new attribute) whose unknown arguments are
    told with the nearest known one."""
    made = dataclasses.dataclass(slots=True)(cls)
    plain = made.__init__
    known = {field.name for field in dataclasses.fields(made)}

    @functools.wraps(plain)
    def init(self: Any, *arguments: Any, **named: Any) -> None:
        for name in named:
            if name not in known:
                raise _names.unknown(made.__name__, name, known)
        plain(self, *arguments, **named)

    made.__init__ = init  # type: ignore
    return made


class Struct:
    """What all of them can do."""

    __slots__ = ()
    _c: ClassVar[str]
    _kinds: ClassVar[dict[str, str]]

    def replace(self: S, **changes: Any) -> S:
        """A copy with other values for some fields."""
        for name in changes:
            if name not in names_of(type(self)):
                raise _names.unknown(type(self).__name__, name, names_of(type(self)))
        return dataclasses.replace(self, **changes)  # type: ignore[type-var]


def names_of(cls: Any) -> tuple[str, ...]:
    """Names of the fields of a dataclass, which are its slots."""
    return cls.__slots__


def coerce(cls: type[S], value: Union[S, Mapping[str, object], None], what: str) -> S:
    """An object of the class: itself, made of a mapping, or the default."""
    if value is None:
        return cls()
    if isinstance(value, cls):
        return value
    if isinstance(value, Mapping):
        return cls(**value)
    raise ArgumentError(f"{what}: {value!r} is no {cls.__name__}, and no mapping of its fields")


class Filler:
    """Copies dataclasses into C structs. `keep` collects what the structs point to."""

    def __init__(self, ffi: Any, lib: Any, generated: Any, texture: Any) -> None:
        self.ffi, self.lib, self.generated, self.texture = ffi, lib, generated, texture

    def new(self, value: Struct, keep: list[Any]) -> Any:
        """A new C struct of a dataclass."""
        made = self.ffi.new(value._c + " *")
        keep.append(made)
        self.fill(made, value, keep)
        return made

    def fill(self, target: Any, value: Struct, keep: list[Any]) -> None:
        """Copies all fields."""
        for name in names_of(type(value)):
            what = f"{type(value).__name__}.{name}"
            item = getattr(value, name)
            kind, *words = value._kinds.get(name, "plain").split()
            try:
                getattr(self, "_" + kind)(target, name, item, words, what, keep)
            except ArgumentError:
                raise
            except (TypeError, ValueError, OverflowError) as error:
                raise ArgumentError(f"{what}: {item!r} does not fit: {error}") from None

    def _plain(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        current = getattr(target, name)
        if not isinstance(current, self.ffi.CData):
            setattr(target, name, self._number(item, type(current), what))
            return
        if len(item) not in (0, len(current)):
            raise ArgumentError(f"{what}: {len(item)} numbers instead of {len(current)}")
        for index, number in enumerate(item):
            current[index] = float(number)

    def _number(self, item: Any, wanted: type, what: str) -> Any:
        """A number for cffi, which takes Python's own and not NumPy's, nor floats for integers."""
        if wanted is bool:
            if item is not True and item is not False and not isinstance(item, np.bool_):
                raise ArgumentError(f"{what}: {item!r} is neither True nor False")
            return bool(item)
        return operator.index(item) if wanted is int else float(item)

    def _enum(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        setattr(target, name, int(_names.member(getattr(self.generated, words[0]), item, what)))

    def _color(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        setattr(
            target, name, _names.color(item, what, self.generated.COLORS, self.lib.DP_COLOR_NONE)
        )

    def _lines(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        setattr(
            target, name, _names.line_bits(item, self.generated.Line, self.lib.DP_NO_LINES, what)
        )

    def _struct(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        self.fill(
            getattr(target, name), coerce(getattr(self.generated, words[0]), item, what), keep
        )

    def _by(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        self._indexed(getattr(target, name), item, words, what, keep)

    def _indexed(self, array: Any, item: Any, words: list[str], what: str, keep: list[Any]) -> None:
        """An array with an element for each member of an enum, of a mapping."""
        index, cls = (getattr(self.generated, word) for word in words)
        if not isinstance(item, Mapping):
            raise ArgumentError(
                f"{what}: {item!r} is no mapping from {index.__name__} to {cls.__name__}"
            )
        for key, element in item.items():
            place = _names.member(index, key, what)
            self.fill(array[place], coerce(cls, element, f"{what}[{key!r}]"), keep)

    def _levels(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        array = getattr(target, name)
        levels = [item] if isinstance(item, Mapping) else list(item)
        if len(levels) > len(array):
            raise ArgumentError(f"{what}: {len(levels)} levels; there are {len(array)} at most")
        for number, mapping in enumerate(levels):
            self._indexed(array[number], mapping, words, what, keep)

    def _counted(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        """A list whose length C wants, too: in the struct, or behind a pointer."""
        if item is None or len(item) == 0:
            return
        array = getattr(target, name)
        if self.ffi.typeof(array).kind == "array":
            if len(item) > len(array):
                raise ArgumentError(f"{what}: {len(item)} of them; there are {len(array)} at most")
            for number, element in enumerate(item):
                cls = getattr(self.generated, words[1])
                self.fill(array[number], coerce(cls, element, f"{what}[{number}]"), keep)
        else:
            made = self.ffi.new("uint8_t[]", [int(number) for number in item])
            keep.append(made)
            setattr(target, name, made)
        setattr(target, words[0], len(item))

    def _texture(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        if item is not None:
            texture = self.texture(item, what)
            keep.append(texture)
            setattr(target, name, texture.pointer)

    def _image(
        self, target: Any, name: str, item: Any, words: list[str], what: str, keep: list[Any]
    ) -> None:
        if item is None:
            return
        shape, channels = np.shape(item), {"shades": (4,)}.get(name, ())
        if len(shape) != 2 + len(channels) or shape[2:] != channels or 0 in shape:
            wanted = ", ".join(["height", "width", *map(str, channels)])
            raise ArgumentError(f"{what}: an array of shape {shape} is not ({wanted})")
        pixels = np.ascontiguousarray(item)
        if pixels.dtype != np.uint8:
            raise ArgumentError(f"{what}: pixels are of {pixels.dtype}, not uint8")
        keep.append(pixels)
        image = getattr(target, name)
        image.values = self.ffi.from_buffer("uint8_t[]", pixels)
        image.height, image.width = shape[:2]

    # ---- and back ----

    def read(self, cls: type[S], value: Any) -> S:
        """A dataclass of a C struct. What it points to (textures, images) is left out."""
        made = cls()
        for name in names_of(cls):
            kind, *words = cls._kinds.get(name, "plain").split()
            if kind not in ("texture", "image", "counted"):
                setattr(made, name, self._read(kind, words, getattr(value, name)))
        return made

    def _read(self, kind: str, words: list[str], item: Any) -> Any:
        if kind == "lines":
            return {line for line in self.generated.Line if item >> line & 1}
        if kind == "levels":
            return tuple(self._read("by", words, level) for level in item)
        classes = [getattr(self.generated, word) for word in words]
        if kind == "enum":
            return classes[0](item)
        if kind == "struct":
            return self.read(classes[0], item)
        if kind == "by":
            return {index: self.read(classes[1], item[index]) for index in classes[0]}
        return tuple(item) if isinstance(item, self.ffi.CData) else item
