"""Turns what people have, arrays of any type and layout, into what dp_batch wants, copying only
where it must.

Floats of 32 bits and integers of 32 bits are used where they lie, rows of any stride too. Doubles
far from 0 are counted from an origin, as the library's own readers do (src/mesh/wide.c), so that
no digits are lost.

With `check`, what C would drop and count is refused: numbers of vertices out of range,
coordinates that are not finite.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from . import _names
from ._errors import ArgumentError, LimitError
from ._generated import COLORS, EdgeKind

FAR = 8  # times a model's size: from there on its coordinates are counted from an origin
MOST = 2**32 - 1  # vertices
NO_VERTEX = np.uint32(MOST)


@dataclass
class Arrays:
    """One dp_batch. All arrays are C's types; positions may have rows farther apart than 12
    bytes."""

    positions: np.ndarray
    origin: np.ndarray
    indices: Optional[np.ndarray]  # (corners,)
    firsts: Optional[np.ndarray]  # (polygons + 1,); None: triangles
    corners: int
    polygons: int
    groups: Optional[np.ndarray] = None
    edges: Optional[np.ndarray] = None
    normals: Optional[np.ndarray] = None
    texcoords: Optional[np.ndarray] = None
    colors: Optional[np.ndarray] = None


def real(values: Any, what: str) -> np.ndarray:
    """An array of real numbers of any type."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ArgumentError(f"{what}: {error}") from None
    if array.size and array.dtype.kind not in "fiu":
        raise ArgumentError(f"{what}: an array of {array.dtype} holds no real numbers")
    return array


def floats(values: Any, columns: int, what: str) -> np.ndarray:
    """(n, columns) of float32: the array itself where it is one, with numbers of a row side by
    side."""
    array = real(values, what)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ArgumentError(f"{what}: an array of shape {array.shape} is not (n, {columns})")
    if array.dtype == np.float32 and array.flags.aligned:
        rows, step = array.strides
        if step == 4 and rows >= 4 * columns and rows % 4 == 0:
            return array
    with np.errstate(
        over="ignore"
    ):  # what is beyond float32 becomes infinite, and is refused or dropped
        return np.ascontiguousarray(array, dtype=np.float32)


def far_origin(vertices: np.ndarray) -> np.ndarray:
    """From where positions are to be counted so that float32 keeps their digits; 0: from 0."""
    origin, finite = np.zeros(3), vertices
    if not np.isfinite(vertices).all():
        finite = vertices[np.isfinite(vertices).all(axis=1)]
    if not len(finite):
        return origin
    low, high = (np.array([one(finite[:, k]) for k in range(3)], float) for one in (np.min, np.max))
    size = (high - low).max()
    far = np.maximum(abs(low), abs(high)) > FAR * size
    if size == 0 or not far.any() or (finite.astype(np.float32) == finite).all():
        return origin
    step = 2.0 ** np.floor(np.log2(size) - 1)  # whole steps: short decimals stay exact
    origin[far] = (np.round((low + high) / 2 / step) * step)[far]
    return origin


def place(vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Positions of float32 and their origin."""
    if vertices.dtype == np.float32 or vertices.dtype.itemsize <= 2:
        return floats(vertices, 3, "vertices"), np.zeros(3)
    origin = far_origin(vertices)
    moved = vertices - origin if origin.any() else vertices
    return floats(moved, 3, "vertices"), origin


def numbers(values: Any, what: str) -> np.ndarray:
    """An array of whole numbers, in the machine's byte order."""
    array = real(values, what)
    if not array.size:
        return np.empty(array.shape, np.uint32)
    if array.dtype.kind == "f":
        raise ArgumentError(f"{what}: an array of {array.dtype} holds no whole numbers")
    return array


def as_indices(array: np.ndarray, vertices: int, check: bool) -> np.ndarray:
    """Vertex numbers as uint32, in one dimension; those out of range are refused, or become
    none."""
    flat = array.reshape(-1)
    if check and flat.size:
        for number in (int(flat.min()), int(flat.max())):
            if not 0 <= number < vertices:
                item = int((flat == number).argmax())
                polygon = item // array.shape[1] if array.ndim == 2 else item
                raise ArgumentError(
                    f"faces: vertex number {number} (in face {polygon}) is not one of 0 to "
                    f"{vertices - 1}",
                    item=polygon,
                )
    if flat.dtype == np.int32 and flat.dtype.isnative and flat.flags.aligned:
        flat = flat.view(np.uint32)  # negative ones become too large ones
    if check:
        return np.require(flat, np.uint32, ["C", "A"])
    if flat.dtype.itemsize == 8:
        flat = np.where((flat < 0) | (flat > MOST), NO_VERTEX, flat)
    elif flat.dtype.kind == "i":
        flat = flat.astype(np.int64)
        flat = np.where(flat < 0, NO_VERTEX, flat)
    return np.require(flat, np.uint32, ["C", "A"])


def polygons_of(
    faces: Any, vertices: int, check: bool
) -> tuple[np.ndarray, Optional[np.ndarray], int]:
    """Indices, firsts and the number of polygons, of an array (m, k) or a list of polygons."""
    ragged = isinstance(faces, (list, tuple)) and len({np.size(face) for face in faces}) > 1
    if ragged:
        parts = [numbers(face, f"face {i}").reshape(-1) for i, face in enumerate(faces)]
        firsts = np.zeros(len(parts) + 1, np.uint32)
        firsts[1:] = np.cumsum([part.size for part in parts])
        return as_indices(np.concatenate(parts), vertices, check), firsts, len(parts)
    array = numbers(faces, "faces")
    if not array.size:
        return np.empty(0, np.uint32), None, 0
    if array.ndim != 2:
        raise ArgumentError(
            f"faces: an array of shape {array.shape} is not (m, k); "
            "runs of counts and numbers are known of objects with points"
        )
    count, corners = array.shape
    if corners < 3 and check:
        raise ArgumentError(f"faces: polygons of {corners} corners")
    starts = None if corners == 3 else np.arange(0, count * corners + 1, corners, dtype=np.uint32)
    return as_indices(array, vertices, check), starts, count


def soup(vertices: np.ndarray) -> tuple[np.ndarray, Optional[np.ndarray], int]:
    """Vertices (n, 3), firsts and the number of polygons, of triangles (3m, 3) or polygons (m, k,
    3)."""
    if vertices.ndim == 2:
        if len(vertices) % 3:
            raise ArgumentError(
                f"without faces, {len(vertices)} vertices are no whole number of triangles"
            )
        return vertices, None, len(vertices) // 3
    count, corners, _ = vertices.shape
    firsts = (
        None
        if corners == 3
        else np.arange(0, count * corners + 1, max(corners, 1), dtype=np.uint32)
    )
    return vertices.reshape(-1, 3), firsts, count


def refuse_infinite(
    positions: np.ndarray, indices: Optional[np.ndarray], vertices: np.ndarray
) -> None:
    """Raises where a polygon uses a vertex that is not finite; others harm nobody."""
    if np.isfinite(positions).all():
        return
    bad = ~np.isfinite(positions).all(axis=1)
    used = np.ones(len(bad), bool) if indices is None else np.zeros(len(bad), bool)
    if indices is not None:
        used[indices] = True
    item = (bad & used).argmax()
    if bad[item] and used[item]:
        raise ArgumentError(
            f"vertices: vertex {item} is {vertices[item].tolist()}, which float32 does not hold; "
            "check=False drops the polygons that use it",
            item=int(item),
        )


def group_numbers(values: Any, polygons: int) -> np.ndarray:
    """(m,) of uint16."""
    array = numbers(values, "groups")
    if array.shape != (polygons,):
        raise ArgumentError(
            f"groups: an array of shape {array.shape} is not ({polygons},), one for each polygon"
        )
    if array.size and not (0 <= array.min() and array.max() <= 65535):
        raise ArgumentError("groups: numbers are 0 to 65535")
    return np.require(array, np.uint16, ["C", "A"])


def vertex_colors(values: Any, vertices: int) -> np.ndarray:
    """(n,) 0xRRGGBBAA, of such, of (n, 3 or 4) integers of 0 to 255, or of floats of 0 to 1."""
    array = real(values, "colors")
    if (
        len(array) != vertices
        or array.ndim not in (1, 2)
        or (array.ndim == 2 and array.shape[1] not in (3, 4))
    ):
        raise ArgumentError(
            f"colors: an array of shape {array.shape} is not ({vertices},), ({vertices}, 3) or "
            f"({vertices}, 4)"
        )
    if array.ndim == 1:
        return np.require(numbers(array, "colors"), np.uint32, ["C", "A"])
    most = 1 if array.dtype.kind == "f" else 255
    if array.size and not (0 <= array.min() and array.max() <= most):
        raise ArgumentError(f"colors: channels of {array.dtype} are 0 to {most}")
    bytes_ = np.round(array * 255) if most == 1 else array
    channels = np.full((vertices, 4), 255, np.uint32)
    channels[:, : array.shape[1]] = bytes_
    return channels @ np.array([1 << 24, 1 << 16, 1 << 8, 1], np.uint32)


def edge_kinds(values: Any, corners: int) -> np.ndarray:
    """(corners,) of uint8: what the edge from each corner to the next is."""
    if isinstance(values, (list, tuple)):
        values = [_names.member(EdgeKind, value, "edges") for value in values]
    array = numbers(values, "edges").reshape(-1)
    if array.shape != (corners,):
        raise ArgumentError(f"edges: {array.size} kinds for {corners} corners")
    return np.require(np.clip(array, 0, 255), np.uint8, ["C", "A"])


def attribute(values: Any, columns: int, vertices: int, corners: int, what: str) -> np.ndarray:
    """One row for each vertex or, without common vertices, for each corner."""
    array = floats(values, columns, what)
    if len(array) not in (vertices, corners):
        raise ArgumentError(
            f"{what}: {len(array)} rows for {vertices} vertices and {corners} corners"
        )
    return array


def gather(
    vertices: Any,
    faces: Any = None,
    *,
    groups: Any = None,
    edges: Any = None,
    normals: Any = None,
    texcoords: Any = None,
    colors: Any = None,
    check: bool = True,
) -> Arrays:
    """All arrays of a mesh."""
    given = real(vertices, "vertices")
    if not given.size:
        given = np.empty((0, 3), np.float32)
    indices: Optional[np.ndarray] = None
    if given.ndim not in (2, 3) or given.shape[-1] != 3 or (given.ndim == 3 and faces is not None):
        raise ArgumentError(
            f"vertices: an array of shape {given.shape} is not (n, 3), nor (m, k, 3) without faces"
        )
    if faces is None:
        given, firsts, count = soup(given)
    if len(given) > MOST:
        raise LimitError(f"vertices: {len(given)} are more than {MOST}")
    if faces is not None:
        indices, firsts, count = polygons_of(faces, len(given), check)
    if count == 0:
        raise ArgumentError("this mesh has no polygons")
    positions, origin = place(given)
    if check:
        refuse_infinite(positions, indices, given)
    corners = len(given) if indices is None else len(indices)
    if corners > MOST:
        raise LimitError(f"faces: {corners} corners are more than {MOST}")
    made = Arrays(positions, origin, indices, firsts, corners, count)
    if groups is not None:
        made.groups = group_numbers(groups, count)
    if edges is not None:
        made.edges = edge_kinds(edges, corners)
    if normals is not None:
        made.normals = attribute(normals, 3, len(given), corners, "normals")
    if texcoords is not None:
        made.texcoords = attribute(texcoords, 2, len(given), corners, "texcoords")
    if colors is not None:
        made.colors = vertex_colors(colors, len(given))
    return made
