"""Recognizes meshes of other packages by their attributes; none of these packages is imported.

    trimesh     vertices, faces; visual.vertex_colors where visual.kind is 'vertex'
    PyVista     points, faces: counts and vertex numbers by turns; or regular_faces
    Open3D      vertices, triangles; vertex_colors
"""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np

from ._errors import ArgumentError


class Mesh(NamedTuple):
    """What a mesh object holds. faces: as draw() takes them. colors: None, or (n, 3 or 4)."""

    vertices: Any
    faces: Any
    colors: Any = None


def _has(mesh: Any, *names: str) -> bool:
    return all(hasattr(mesh, name) for name in names)


def counted(numbers: Any) -> Any:
    """PyVista's runs, [3, a, b, c, 4, d, e, f, g, …]: an array (m, k) where all have k corners,
    else a list."""
    numbers = np.asarray(numbers)
    if numbers.ndim == 2:
        return numbers
    if numbers.ndim != 1 or (numbers.size and numbers.dtype.kind not in "iu"):
        raise ArgumentError("faces with counts must be one array of integers")
    if not numbers.size:
        return np.empty((0, 3), np.uint32)
    corners = int(numbers[0])
    if corners > 0 and numbers.size % (corners + 1) == 0:
        rows = numbers.reshape(-1, corners + 1)
        if (rows[:, 0] == corners).all():
            return rows[:, 1:]
    faces, place = [], 0
    while place < numbers.size:
        count = int(numbers[place])
        if count < 0 or place + 1 + count > numbers.size:
            raise ArgumentError(
                f"faces with counts: {count} at place {place} of {numbers.size} numbers"
            )
        faces.append(numbers[place + 1 : place + 1 + count])
        place += 1 + count
    return faces


def _trimesh_colors(mesh: Any) -> Any:
    visual: Any = getattr(mesh, "visual", None)
    return visual.vertex_colors if getattr(visual, "kind", None) == "vertex" else None


def _open3d_colors(mesh: Any) -> Optional[np.ndarray]:
    colors = np.asarray(getattr(mesh, "vertex_colors", ()))
    return colors if colors.ndim == 2 and len(colors) else None


def recognize(mesh: Any) -> Optional[Mesh]:
    """The parts of a mesh object; None where it is none."""
    if _has(mesh, "points", "faces"):
        return Mesh(np.asarray(mesh.points), counted(mesh.faces))
    if _has(mesh, "points", "regular_faces"):
        return Mesh(np.asarray(mesh.points), np.asarray(mesh.regular_faces))
    if _has(mesh, "points", "cells"):
        raise ArgumentError(
            "this mesh has cells, not faces: give its surface (PyVista: mesh.extract_surface())"
        )
    if _has(mesh, "vertices", "faces"):
        return Mesh(np.asarray(mesh.vertices), mesh.faces, _trimesh_colors(mesh))
    if _has(mesh, "vertices", "triangles"):
        return Mesh(np.asarray(mesh.vertices), np.asarray(mesh.triangles), _open3d_colors(mesh))
    return None
