"""Sources: where polygons come from."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np

from . import _arrays, _generated, _names, _shapes
from ._errors import ArgumentError, Error
from ._library import Owned, call, ffi, has_io, lib, text
from ._progress import Progress, Reporter
from ._struct import coerce
from ._texture import filler

Beside = Union[Mapping[str, bytes], Callable[[str], Optional[bytes]]]
"""Files beside one in memory: by name, or a function that finds them and gives None where there
is none."""


@dataclass(frozen=True)
class Group:
    """A group of polygons: an object, a material, a part of a scene.

    Attributes:
        number: as in Image.id - 1, and `group` of segments.
        name: "" where it has none.
        color: 0xRRGGBBAA; 0: none.
        polygons: how many.
        min, max: its box, world space; None where it holds no finite corner.
    """

    number: int
    name: str
    color: int
    polygons: int
    min: Optional[tuple[float, float, float]]
    max: Optional[tuple[float, float, float]]


class Source:
    """A model: arrays, a file, a generated shape, several joined to one.

    Make one with from_arrays(), from_mesh(), open(), from_bytes(), shape() or join(). Arrays are
    used where they lie as far as that is possible, are kept alive, and must not change while they
    are drawn. A source serves one thread at a time; others wait.
    """

    def __init__(self) -> None:
        self._owned = Owned("dp_source", lib.dp_source_destroy)
        self._keep: list[Any] = []
        self._reporter: Optional[Reporter] = None
        self._taken = False
        self._time = 0.0
        self._lock = threading.RLock()

    @property
    def _pointer(self) -> Any:
        if self._taken:
            raise ArgumentError("this source belongs to another one now, which was made of it")
        return self._owned._pointer

    # ---- where they come from ----

    @classmethod
    def from_arrays(
        cls,
        vertices: Any,
        faces: Any = None,
        *,
        groups: Any = None,
        edges: Any = None,
        normals: Any = None,
        texcoords: Any = None,
        colors: Any = None,
        check: bool = True,
    ) -> "Source":
        """A source of arrays.

        Args:
            vertices: (n, 3) real numbers of any type, world units; float64 keeps its digits far
                from 0, too.
            faces: (m, k) vertex numbers, counter-clockwise seen from the front; or a list of
                polygons of any lengths; or None: each three vertices are a triangle, and vertices
                may be (m, k, 3).
            groups: (m,) 0 to 65535, one for each face.
            edges: for each corner what the edge to the next one is: EdgeKind or its name.
            normals: (n, 3) or one for each corner; for shading only.
            texcoords: (n, 2) or one for each corner.
            colors: (n, 3 or 4) integers of 0 to 255 or floats of 0 to 1, or (n,) 0xRRGGBBAA; for
                shading with Shade(model_colors=True).
            check: refuse numbers of vertices out of range and coordinates that are not finite.
                Without, polygons that have some are dropped and counted (Stats.dropped_index,
                dropped_finite).

        >>> Source.from_arrays([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]).extent.exact_max
        (1.0, 1.0, 0.0)
        """
        arrays = _arrays.gather(
            vertices,
            faces,
            groups=groups,
            edges=edges,
            normals=normals,
            texcoords=texcoords,
            colors=colors,
            check=check,
        )
        source = cls()
        batch = source._batch(arrays)
        source._owned.make(lib.dp_source_from_arrays, batch, ffi.NULL)
        return source

    @classmethod
    def from_mesh(cls, mesh: Any, **attributes: Any) -> "Source":
        """A source of a mesh of trimesh, PyVista or Open3D, or of whatever has the same
        attributes: vertices and faces, points and faces (or regular_faces), vertices and
        triangles. attributes: as of from_arrays().
        """
        found = _shapes.recognize(mesh)
        if found is None:
            raise ArgumentError(
                f"a {type(mesh).__name__} has neither vertices and faces (or triangles) "
                "nor points and faces"
            )
        if found.colors is not None:
            attributes.setdefault("colors", found.colors)
        return cls.from_arrays(found.vertices, found.faces, **attributes)

    @classmethod
    def open(
        cls,
        path: Union[str, "os.PathLike[str]"],
        *,
        format: Union[_generated.FileFormat, str, int] = 0,
        progress: Optional[Progress] = None,
    ) -> "Source":
        """A model file: STL, PLY, OBJ, OFF, glTF; with Assimp all else that it knows (FBX, 3MF,
        COLLADA, …).

        Raises FileError, FormatError (with `line` or `offset`), UnsupportedError.
        """
        name = os.fspath(path)
        source = cls()
        options = source._options(format)
        encoded = os.fsencode("./-" if name == "-" else name)
        if b"\0" in encoded:
            raise ArgumentError(f"{name!r}: a file's name has no zero in it")
        function = lib.dp_io_open if has_io else lib.dp_source_open
        assert source._reporter
        source._reporter.run(
            progress, lambda: source._owned.make(function, encoded, options, subject=str(name))
        )
        return source

    @classmethod
    def from_bytes(
        cls,
        data: Any,
        name: str = "",
        *,
        beside: Optional[Beside] = None,
        format: Union[_generated.FileFormat, str, int] = 0,
    ) -> "Source":
        """A model file that lies in memory.

        Args:
            data: its bytes: bytes, memoryview, an array; kept alive.
            name: "part.obj", say: its ending tells the format where the content does not.
            beside: files that this one names, materials or buffers: {name: bytes}, or a function.
        """
        source = cls()
        options = source._options(format)
        try:
            view = ffi.from_buffer(data)
        except (TypeError, BufferError) as error:
            raise ArgumentError(f"data: {error}") from None
        encoded = ffi.new("char[]", name.encode()) if name else ffi.NULL
        files = _Beside(beside)
        file = ffi.new(
            "dp_memory_file *",
            {"data": view, "size": len(view), "name": encoded, "user": files.handle},
        )
        if beside is not None:
            file.open_beside = lib.drypoint_open_beside
        source._keep += [view, encoded]
        function = lib.dp_io_open_memory if has_io else lib.dp_source_open_memory
        try:
            source._owned.make(function, file, options, subject=name)
        finally:
            if files.failure is not None:
                raise files.failure
        return source

    @classmethod
    def shape(cls, name: str, *, triangles: int = 0, size: float = 0, seed: int = 0) -> "Source":
        """A generated model; shapes() tells their names.

        Args:
            triangles: about how many; 0: the shape's own default.
            size: extent, world units; 0 means 2.
            seed: of shapes with noise.
        """
        source = cls()
        encoded = ffi.new("char[]", str(name).encode())
        try:
            shape = ffi.new(
                "dp_shape *", {"name": encoded, "triangles": triangles, "size": size, "seed": seed}
            )
        except (TypeError, OverflowError) as error:
            raise ArgumentError(f"shape: {error}") from None
        source._owned.make(lib.dp_source_from_shape, shape)
        return source

    @classmethod
    def join(cls, sources: Iterable["Source"], names: Optional[Sequence[str]] = None) -> "Source":
        """One source of several, which belong to it then. names: of the sources, come before
        those of groups."""
        parts = list(sources)
        if names is not None and len(names) != len(parts):
            raise ArgumentError(f"{len(names)} names for {len(parts)} sources")
        scene = cls()
        pointers = [part._pointer for part in parts]
        encoded = [ffi.new("char[]", str(name).encode()) for name in names or ()]
        scene._owned.make(
            lib.dp_source_join,
            ffi.new("dp_source *[]", pointers),
            ffi.new("char *[]", encoded) if names else ffi.NULL,
            len(parts),
            ffi.NULL,
        )
        scene._adopt(parts)
        return scene

    def clip(self, planes: Union[_generated.Clip, Iterable[Any]]) -> "Source":
        """This source cut open; it belongs to the result then.

        Args:
            planes: a Clip, or a list of ClipPlane or of (normal, offset): what lies beyond, on
                the side that the normal points to, is taken away.

        >>> Source.shape("cube").clip([((0, 1, 0), 0.0)]).extent.exact_max[1]
        0.0
        """
        if not isinstance(planes, _generated.Clip):
            given = [
                p if isinstance(p, _generated.ClipPlane) else _generated.ClipPlane(*p)
                for p in planes
            ]
            planes = _generated.Clip(planes=given)
        return self._wrapped(lib.dp_source_clip, planes)

    def deform(self, deform: Any = None, **fields: Any) -> "Source":
        """This source with vertices that move with time; it belongs to the result then. Fields
        are Deform's:

        >>> Source.shape("flag").deform(kind="wave", amplitude=0.1).duration
        0.0
        """
        return self._wrapped(
            lib.dp_source_deform, coerce(_generated.Deform, deform or fields, "deform")
        )

    # ---- what they know ----

    @property
    def extent(self) -> _generated.Extent:
        """Its box and how much it holds; the source is read for it."""
        extent = ffi.new("dp_extent *")
        with self._lock:
            call(lib.dp_source_extent, self._pointer, extent)
        return filler.read(_generated.Extent, extent)

    @property
    def up(self) -> np.ndarray:
        """What is up: a unit vector, world space."""
        up = ffi.new("double[3]")
        lib.dp_source_up(self._pointer, up)
        return np.array(list(up))

    @property
    def groups(self) -> list[Group]:
        """Its groups that hold polygons; the source is read for it."""
        most, count = 64, ffi.new("uint32_t *")
        with self._lock:
            while True:
                groups = ffi.new("dp_group[]", most)
                call(lib.dp_source_groups, self._pointer, groups, most, count)
                if count[0] <= most:
                    return [
                        self._group(groups[i], i) for i in range(count[0]) if groups[i].polygons
                    ]
                most = count[0]

    @property
    def duration(self) -> float:
        """How long it moves, s; 0 where it does not, or without an end."""
        return lib.dp_source_duration(self._pointer)

    @property
    def time(self) -> float:
        """At what time it is, s. Setting it poses the model for the next drawing."""
        return self._time

    @time.setter
    def time(self, seconds: float) -> None:
        with self._lock:
            call(lib.dp_source_set_time, self._pointer, float(seconds))
        self._time = float(seconds)

    @property
    def clips(self) -> list[str]:
        """Names of the animations that it has."""
        scene = lib.dp_scene_of(self._pointer)
        return [text(scene.clips[i].name) for i in range(scene.clip_count)] if scene else []

    def play(self, clip: Union[str, int, None]) -> None:
        """Chooses what moves it: the name or the number of an animation, from 0 on; None:
        nothing."""
        names = self.clips
        if isinstance(clip, str):
            if clip not in names:
                raise _names.unknown("play", clip, names)
            clip = names.index(clip)
        if clip is not None and not 0 <= clip < len(names):
            raise ArgumentError(f"play: there is no animation {clip} among {len(names)}")
        with self._lock:
            call(lib.dp_scene_play, self._pointer, 0 if clip is None else clip + 1)

    @property
    def remark(self) -> str:
        """What is missing or wrong although it can be drawn; known when it has been read once."""
        return text(lib.dp_source_remark(self._pointer)) or text(
            lib.dp_source_color_remark(self._pointer)
        )

    def __repr__(self) -> str:
        return "<drypoint.Source, part of another one>" if self._taken else "<drypoint.Source>"

    # ---- inside ----

    def _batch(self, arrays: _arrays.Arrays) -> Any:
        """The dp_batch of arrays, which it keeps alive."""
        batch = ffi.new("dp_batch *")
        batch.positions = self._borrow("float[]", arrays.positions)
        batch.position_stride = _row_stride(arrays.positions)
        batch.vertex_count = len(arrays.positions)
        batch.corner_count, batch.polygon_count = arrays.corners, arrays.polygons
        batch.indices = self._borrow("uint32_t[]", arrays.indices)
        batch.firsts = self._borrow("uint32_t[]", arrays.firsts)
        batch.groups = self._borrow("uint16_t[]", arrays.groups)
        batch.edge_flags = self._borrow("uint8_t[]", arrays.edges)
        batch.colors = self._borrow("uint32_t[]", arrays.colors)
        batch.origin = arrays.origin.tolist()
        batch.stable = True
        for name in ("normals", "texcoords"):
            values = getattr(arrays, name)
            if values is not None:
                self._attribute(getattr(batch, name), values, arrays)
        return batch

    def _attribute(self, target: Any, values: np.ndarray, arrays: _arrays.Arrays) -> None:
        target.values, target.count = self._borrow("float[]", values), len(values)
        target.stride = _row_stride(values)
        if len(values) != len(arrays.positions):  # one for each corner
            target.indices = self._borrow("uint32_t[]", np.arange(len(values), dtype=np.uint32))

    def _borrow(self, type_name: str, array: Optional[np.ndarray]) -> Any:
        """A pointer to the first number of an array, which is kept alive."""
        if array is None:
            return ffi.NULL
        self._keep.append(array)
        return ffi.cast(type_name.replace("[]", " *"), array.ctypes.data)

    def _options(self, format: Any) -> Any:
        self._reporter = Reporter()
        number = int(_names.member(_generated.FileFormat, format, "format"))
        options = ffi.new(
            "dp_file_options *",
            {"format": number, "progress": self._reporter.call, "user": self._reporter.pointer},
        )
        self._keep.append(options)
        return options

    def _group(self, group: Any, number: int) -> Group:
        name = text(lib.dp_source_group_name(self._pointer, number))
        low: Any
        high: Any
        low, high = (
            (tuple(group.min), tuple(group.max)) if math.isfinite(group.min[0]) else (None, None)
        )
        return Group(
            number,
            name,
            lib.dp_source_group_color(self._pointer, number),
            group.polygons,
            low,
            high,
        )

    def _wrapped(self, function: Any, value: Any) -> "Source":
        """A source that owns this one."""
        made = type(self)()
        with self._lock:
            made._owned.make(function, self._pointer, filler.new(value, made._keep), ffi.NULL)
            made._adopt([self])
        return made

    def _adopt(self, parts: Sequence["Source"]) -> None:
        """Takes over sources that C's object owns now."""
        for part in parts:
            part._owned.take()
            part._taken = True
            self._keep.append((part._keep, part._reporter, part._owned))


def _row_stride(array: np.ndarray) -> int:
    """Bytes from row to row; 0, which is tight, for a single row: its stride may be anything."""
    return array.strides[0] if len(array) > 1 else 0


class _Beside:
    """Files beside one in memory, while it is opened."""

    def __init__(self, files: Optional[Beside]) -> None:
        self.files, self.failure = files, None
        self.buffers: list[Any] = []
        self.handle = ffi.new_handle(self)

    def find(self, name: str) -> Any:
        """The bytes of a file as a C buffer, or None."""
        assert self.files is not None
        data = self.files(name) if callable(self.files) else self.files.get(name)
        if data is None:
            return None
        self.buffers.append(ffi.from_buffer(data))
        return self.buffers[-1]


def _beside_failed(kind: Any, failure: BaseException, trace: Any) -> None:
    if trace is not None:
        ffi.from_handle(trace.tb_frame.f_locals["handle"]).failure = failure


@ffi.def_extern(name="drypoint_open_beside", error=False, onerror=_beside_failed)
def _open_beside(handle: Any, name: Any, data: Any, size: Any) -> bool:
    found = ffi.from_handle(handle).find(text(name))
    if found is None:
        return False
    data[0], size[0] = found, len(found)
    return True


def shapes() -> dict[str, str]:
    """Names of generated models, and what each is.

    >>> "bolt" in shapes()
    True
    """
    numbers = range(lib.dp_shape_count())
    return {text(lib.dp_shape_name(i)): text(lib.dp_shape_about(i)) for i in numbers}
