"""Images: a picture's planes, and its lines."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _files, _names, _png
from ._drawing import SEGMENT, Drawing, Polylines, chains_of
from ._errors import ArgumentError, Error
from ._generated import Cleaning, Stats
from ._library import ffi, lib
from ._struct import coerce
from ._texture import filler

if TYPE_CHECKING:
    from ._context import Slot

# Planes by the names that draw() takes: C's member of dp_target, its type, and what comes after
# [height][width].
PLANES: dict[str, tuple[str, str, tuple[int, ...]]] = {
    "rgba": ("rgba", "u1", (4,)),
    "depth": ("depth", "f4", ()),
    "classes": ("line_class", "u1", ()),
    "normals": ("normal", "f4", (3,)),
    "eye_normals": ("eye_normal", "f4", (3,)),
    "distance": ("distance", "f4", ()),
    "id": ("id", "u2", ()),
    "edge_map": ("edge_map", "u1", (4,)),
}


class Image:
    """What draw() makes. It is an array for NumPy, a picture for notebooks, and knows its lines.

    Attributes:
        rgba: (height, width, 4) of uint8, not premultiplied.
        width, height: px.

    Planes that draw() was asked for, (height, width), else None:
        depth: float32, world units along the line of sight; infinite where there is nothing.
        classes: uint8, 1 + Line of the ink that covers the pixel, or 0.
        normals: (…, 3) of float32, world space, towards the eye; 0: nothing.
        eye_normals: the same in camera space, as shaded.
        distance: float32, depth at the pixel's centre.
        id: uint16, 1 + number of the group; 0: nothing.
        edge_map: (…, 4) of uint8, see EdgeMap.
    """

    def __init__(self, size: tuple[int, int], planes: Iterable[str] = ()) -> None:
        self.width, self.height = size
        names = [planes] if isinstance(planes, str) else list(planes)
        for name in names:
            if name not in PLANES:
                raise _names.unknown("planes", name, PLANES)
        # C refuses pictures this large: nothing is allocated for them, so that it can.
        wanted = {"rgba", *names} if self.width * self.height <= 1 << 30 else set()
        self._planes = {
            name: np.empty((self.height, self.width, *more), kind)
            for name, (_, kind, more) in PLANES.items()
            if name in wanted
        }
        self._slot: Optional[Slot] = None  # whose last drawing this is
        self._stats: Any = None
        self._segments: Optional[np.ndarray] = None
        self._drawing: Optional[Drawing] = None

    def _plane(self, name: str) -> Optional[np.ndarray]:
        return self._planes.get(name)

    rgba = property(lambda self: self._planes["rgba"])
    depth = property(lambda self: self._plane("depth"))
    classes = property(lambda self: self._plane("classes"))
    normals = property(lambda self: self._plane("normals"))
    eye_normals = property(lambda self: self._plane("eye_normals"))
    distance = property(lambda self: self._plane("distance"))
    id = property(lambda self: self._plane("id"))
    edge_map = property(lambda self: self._plane("edge_map"))

    @property
    def size(self) -> tuple[int, int]:
        """(width, height), px."""
        return self.width, self.height

    @property
    def stats(self) -> Stats:
        """What was drawn, and how long it took."""
        if self._stats is None:
            raise ArgumentError("nothing has been drawn into this image")
        return filler.read(Stats, self._stats)

    # ---- lines ----

    def segments(self) -> np.ndarray:
        """The pieces of lines that were found, as a structured array (drypoint.SEGMENT), in an
        order that does not depend on threads."""
        if self._segments is None:
            with self._live() as context:
                count = ffi.new("size_t *")
                pointer = lib.dp_segments(context, count)
                buffer = ffi.buffer(pointer, count[0] * SEGMENT.itemsize) if count[0] else b""
                self._segments = np.frombuffer(buffer, SEGMENT).copy()
        return self._segments

    def chains(self) -> Polylines:
        """The segments joined end to end, as a pen draws them: lines (drypoint.CHAIN) and their
        points (drypoint.CHAIN_POINT)."""
        return chains_of(self.segments())

    def drawing(
        self, cleaning: Union[Cleaning, dict[str, Any], None] = None, **fields: Any
    ) -> Drawing:
        """The lines as paths, cleaned for pens and vectors. Fields are Cleaning's: join,
        min_length, tolerance, optimize, …"""
        if cleaning is None and not fields:
            if self._drawing is None:
                with self._live() as context:
                    self._drawing = Drawing(context, ffi.NULL)
            return self._drawing
        keep: list[Any] = []
        desc = filler.new(coerce(Cleaning, cleaning, "cleaning").replace(**fields), keep)
        with self._live() as context:
            return Drawing(context, desc)

    def svg(self, *, cleaning: Any = None, **page: Any) -> str:
        """The lines as SVG. page: as of Drawing.bytes_of(): mm_per_px, ground, paper, title,
        least_width."""
        return self.drawing(cleaning).svg(**page)

    def pdf(self, *, cleaning: Any = None, **page: Any) -> bytes:
        """The lines as PDF."""
        return self.drawing(cleaning).pdf(**page)

    def eps(self, *, cleaning: Any = None, **page: Any) -> bytes:
        """The lines as EPS."""
        return self.drawing(cleaning).eps(**page)

    def dxf(self, *, cleaning: Any = None, **page: Any) -> bytes:
        """The lines as DXF."""
        return self.drawing(cleaning).dxf(**page)

    def json(self, *, cleaning: Any = None, **page: Any) -> str:
        """The lines as JSON."""
        return self.drawing(cleaning).json(**page)

    def _live(self) -> Any:
        """The context whose last drawing this is, locked."""
        if self._slot is None:
            raise Error(
                "this image's context has drawn others since; what was kept of its lines are segments(), "
                "chains() and "
                "drawing() with default cleaning. Draw it again for more"
            )
        return self._slot.lent_to(self)

    def _keep_lines(self) -> None:
        """Copies the lines out of the context, which is about to draw something else."""
        self.segments()
        self.drawing()
        self._slot = None

    # ---- pictures ----

    def png(self, dpi: float = 0) -> bytes:
        """The picture as a PNG. dpi: for who prints it; 0: the file does not say."""
        return _png.encode(self.rgba, dpi)

    def save(self, path: _files.Path, *, dpi: float = 0, cleaning: Any = None, **page: Any) -> None:
        """Writes a file, by its ending: png, or the lines as svg, pdf, eps, dxf or json (page: as
        of Drawing.bytes_of()). An old file stays until the new one is complete."""
        kind = _files.ending(path)
        if kind == "png":
            if page or cleaning:
                raise ArgumentError("a PNG has no cleaning and no page")
            _files.write(path, self.png(dpi))
            return
        known = ["png", "svg", "pdf", "eps", "dxf", "json"]
        if kind not in known:
            raise _names.unknown(f"the ending of {path}", kind, known)
        self.drawing(cleaning).save(path, **page)

    def _repr_png_(self) -> bytes:
        return self.png()

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        array = self.rgba if dtype is None else self.rgba.astype(dtype, copy=False)
        return array.copy() if copy else array

    @property
    def __array_interface__(self) -> dict[str, Any]:
        """For Pillow: PIL.Image.fromarray(image)."""
        return self.rgba.__array_interface__

    def __repr__(self) -> str:
        more = "".join(f", {name}" for name in self._planes if name != "rgba")
        return f"<drypoint.Image, {self.width} x {self.height} px{more}>"
