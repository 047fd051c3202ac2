"""Drawings: the lines of a picture as paths, and files of them."""

from __future__ import annotations

import os
import zlib
from collections.abc import Iterator
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _files, _names, _png
from ._errors import ArgumentError
from ._generated import COLORS, DrawingInfo, Format
from ._library import Owned, call, ffi, lib
from ._struct import Color
from ._texture import filler


def dtype_of(name: str) -> np.dtype:
    """The structured dtype of a C struct: the same names, at the same places. Pointers are left
    out."""
    fields = [
        (key, field) for key, field in ffi.typeof(name).fields if field.type.kind != "pointer"
    ]
    return np.dtype(
        {
            "names": [key for key, _ in fields],
            "formats": [_format(field.type) for _, field in fields],
            "offsets": [field.offset for _, field in fields],
            "itemsize": ffi.sizeof(name),
        }
    )


def _format(kind: Any) -> Any:
    if kind.kind == "array":
        base, shape = _format(kind.item), kind.length
        return (base, (shape,)) if not isinstance(base, tuple) else (base[0], (shape, *base[1]))
    if kind.kind == "enum":
        return np.dtype(f"u{ffi.sizeof(kind)}")
    if kind.cname in ("float", "double"):
        return np.dtype(f"f{ffi.sizeof(kind)}")
    return np.dtype("?" if kind.cname == "_Bool" else f"u{ffi.sizeof(kind)}")


SEGMENT = dtype_of("dp_segment")
"""A piece of a feature line: C's dp_segment. Ends a and b are x, y in px and the distance in
world units; `line` is a Line, `end` a LineEnd each; polygons are counted from 0, 2^64 - 1:
none."""

POINT = dtype_of("dp_path_point")
"""A point of a path: x and y in px, distance and world in world units, edge and polygon of what
leads on."""

PATH = np.dtype(
    [
        (name, dtype_of("dp_path")[name])
        for name in (
            "line",
            "level",
            "group",
            "width",
            "color",
            "dash",
            "closed",
            "end",
            "hider",
            "length",
        )
    ]
    + [("first", "u8"), ("count", "u8")]
)
"""A path: what C's dp_path holds, px; its points are points[first : first + count]."""

CHAIN = np.dtype(
    [
        ("line", "u4"),
        ("level", "u4"),
        ("group", "u4"),
        ("width", "f4"),
        ("color", "u4"),
        ("closed", "?"),
        ("first", "u8"),
        ("count", "u8"),
    ]
)
"""A chain of segments: what its first one is; its points are points[first : first + count]."""

CHAIN_POINT = np.dtype([("x", "f4"), ("y", "f4"), ("distance", "f4"), ("world", "f8", 3)])
"""A point of a chain: px, world units."""


class Polylines(NamedTuple):
    """Lines of several points each: lines['first'] and lines['count'] say which of the points are
    a line's."""

    lines: np.ndarray
    points: np.ndarray

    def each(self) -> Iterator[tuple[Any, np.ndarray]]:
        """(line, its points), line by line."""
        for line in self.lines:
            yield line, self.points[line["first"] : line["first"] + line["count"]]


def chains_of(segments: np.ndarray) -> Polylines:
    """Chains of segments, joined end to end in their order."""
    order = np.lexsort((segments["place"], segments["chain"]))
    ordered = segments[order]
    starts = (
        np.flatnonzero(np.diff(ordered["chain"], prepend=np.uint32(2**32 - 1)) != 0)
        if len(order)
        else order
    )
    lengths = np.diff(np.append(starts, len(ordered)))
    first = starts + np.arange(len(starts))  # each chain has a point more than segments
    begin, end = _ends(ordered)
    points = np.zeros(len(ordered) + len(starts), CHAIN_POINT)
    heads = np.zeros(len(points), bool)
    heads[first] = True
    points[~heads] = end
    points[heads] = begin[starts]
    lines = np.zeros(len(starts), CHAIN)
    for name in ("line", "level", "group", "width", "color"):
        lines[name] = ordered[name][starts]
    lines["first"], lines["count"] = first, lengths + 1
    last = first + lengths
    lines["closed"] = (points["x"][first] == points["x"][last]) & (
        points["y"][first] == points["y"][last]
    )
    return Polylines(lines, points)


def _ends(segments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Begin and end of each segment as it is drawn."""
    ends = []
    for near, far in (("a", "b"), ("b", "a")):
        points = np.zeros(len(segments), CHAIN_POINT)
        turned = segments["reversed"][:, None]
        screen = np.where(turned, segments[far], segments[near])
        points["x"], points["y"], points["distance"] = screen[:, 0], screen[:, 1], screen[:, 2]
        points["world"] = np.where(turned, segments["world_" + far], segments["world_" + near])
        ends.append(points)
    return ends[0], ends[1]


@ffi.def_extern(name="drypoint_compress", error=lib.DP_ERR_MEMORY)
def _compress(data: Any, size: int, write: Any, user: Any, diag: Any) -> int:
    """A PDF's streams."""
    packed = zlib.compress(ffi.buffer(data, size))
    return write(user, ffi.from_buffer("char[]", packed), len(packed), diag)


class Drawing:
    """The lines of a picture as paths, cleaned for pens and vectors. It stands for itself.
    Image.drawing() makes one.

    A length of one px is 25.4 / 96 mm on paper unless `mm_per_px` says otherwise.
    """

    def __init__(self, context: Any, desc: Any) -> None:
        self._owned = Owned("dp_drawing", lib.dp_drawing_destroy)
        self._owned.make(lib.dp_drawing_create, context, desc)

    @property
    def info(self) -> DrawingInfo:
        """What it holds, and what making it did."""
        info = ffi.new("dp_drawing_info *")
        lib.dp_drawing_info_of(self._owned._pointer, info)
        return filler.read(DrawingInfo, info)

    def paths(self) -> Polylines:
        """Its paths (PATH) and their points (POINT), from the bottom up."""
        info = self.info
        lines, points = np.zeros(info.paths, PATH), np.zeros(info.points, POINT)
        path, first = ffi.new("dp_path *"), 0
        copied = [name for name in PATH.fields or () if name not in ("first", "count")]
        raw = np.frombuffer(ffi.buffer(path), dtype_of("dp_path"))
        for index in range(info.paths):
            lib.dp_drawing_path(self._owned._pointer, index, path)
            for name in copied:
                lines[name][index] = raw[name][0]
            buffer = ffi.buffer(path.points, path.count * POINT.itemsize)
            points[first : first + path.count] = np.frombuffer(buffer, POINT)
            lines["first"][index], lines["count"][index] = first, path.count
            first += path.count
        return Polylines(lines, points)

    def svg(self, **page: Any) -> str:
        """SVG, a layer for each class and level. page: as of bytes_of()."""
        return self.bytes_of(Format.SVG, **page).decode()

    def pdf(self, **page: Any) -> bytes:
        """PDF, compressed."""
        return self.bytes_of(Format.PDF, **page)

    def eps(self, **page: Any) -> bytes:
        """EPS."""
        return self.bytes_of(Format.EPS, **page)

    def dxf(self, **page: Any) -> bytes:
        """DXF of R12, millimetres."""
        return self.bytes_of(Format.DXF, **page)

    def json(self, **page: Any) -> str:
        """JSON by the schema of docs/vector.md."""
        return self.bytes_of(Format.JSON, **page).decode()

    def bytes_of(
        self,
        format: Any,
        *,
        mm_per_px: float = 0,
        ground: Any = None,
        paper: Color = None,
        title: str = "",
        least_width: float = 0,
    ) -> bytes:
        """A page of this drawing alone.

        Args:
            format: a Format or its name.
            mm_per_px: 0 means 25.4 / 96.
            ground: what lies under the lines: an Image of the same size, drawn without lines, or
                its pixels.
            paper: painted over the whole page (not in DXF); None: nothing is.
            title: of the file.
            least_width: mm; narrower lines are written this wide.
        """
        keep: list[Any] = []
        view = ffi.new(
            "dp_view_on_page *", {"drawing": self._owned._pointer, "mm_per_px": float(mm_per_px)}
        )
        if ground is not None:
            self._lay(view, ground, keep)
        page = ffi.new(
            "dp_page *",
            {
                "views": view,
                "view_count": 1,
                "least_width": float(least_width),
                "compress": lib.drypoint_compress,
            },
        )
        page.paper = _names.color(paper, "paper", COLORS, lib.DP_COLOR_NONE)
        if title:
            keep.append(ffi.new("char[]", title.encode()))
            page.title = keep[-1]
        out, size = ffi.new("void **"), ffi.new("size_t *")
        call(
            lib.dp_page_write_memory, page, int(_names.member(Format, format, "format")), out, size
        )
        try:
            return ffi.buffer(out[0], size[0])[:]
        finally:
            lib.dp_bytes_free(out[0])

    def _lay(self, view: Any, ground: Any, keep: list[Any]) -> None:
        """Puts a picture under the lines."""
        pixels, info = np.ascontiguousarray(ground), self.info
        if pixels.shape != (info.height, info.width, 4) or pixels.dtype != np.uint8:
            raise ArgumentError(
                f"ground: an array of {pixels.dtype} of shape {pixels.shape} is not one of "
                "uint8 of shape "
                f"({info.height}, {info.width}, 4)"
            )
        png = _png.encode(pixels)
        keep += [pixels, png]
        view.ground = ffi.from_buffer("uint8_t[]", pixels)
        view.ground_png, view.ground_png_size = ffi.from_buffer(png), len(png)
        keep.append(view.ground_png)

    def save(
        self, path: "str | os.PathLike[str]", format: Optional[str] = None, **page: Any
    ) -> None:
        """Writes a file; its ending, or `format`, says which: svg, pdf, eps, dxf, json. An old
        one stays until the new one is complete."""
        kind = format or _files.ending(path)
        _files.write(path, self.bytes_of(_names.member(Format, kind, f"{os.fspath(path)}"), **page))

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        info = self.info
        return f"<drypoint.Drawing, {info.width} x {info.height} px, {info.paths} paths>"
