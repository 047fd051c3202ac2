"""draw(): one call from a mesh to a picture."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

from . import _shapes
from ._camera import Camera
from ._context import Context, StyleLike, own_context
from ._errors import ArgumentError
from ._image import Image
from ._progress import Progress
from ._source import Source


def source_of(mesh: Any, faces: Any = None, **attributes: Any) -> Source:
    """A source of whatever draw() takes."""
    if isinstance(mesh, (Source, str, os.PathLike)):
        if faces is not None or attributes:
            raise ArgumentError("a source or a file has its own faces and attributes")
        return mesh if isinstance(mesh, Source) else Source.open(mesh)
    if faces is None and _shapes.recognize(mesh) is not None:
        return Source.from_mesh(mesh, **attributes)
    return Source.from_arrays(mesh, faces, **attributes)


def draw(
    mesh: Any,
    faces: Any = None,
    *,
    camera: Optional[Camera] = None,
    style: StyleLike = None,
    size: tuple[int, int] = (800, 600),
    samples: int = 4,
    planes: Iterable[str] = (),
    group_styles: Optional[Mapping[Union[int, str], StyleLike]] = None,
    out: Optional[Image] = None,
    progress: Optional[Progress] = None,
    context: Optional[Context] = None,
    **attributes: Any,
) -> Image:
    """Draws a mesh.

    Args:
        mesh: vertices (n, 3), world units, of any real type; or a mesh of trimesh, PyVista or
            Open3D; or a Source; or the name of a file.
        faces: (m, k) vertex numbers, counter-clockwise seen from the front, or a list of
            polygons; None: each three vertices are a triangle.
        camera: a Camera; None: all of it, from the right, the front and above.
        style: a Style, or a mapping of its fields.
        size: (width, height), px.
        samples: per pixel: 1, 4, 8 or 16.
        planes: what else the image is to hold: 'depth', 'normals', 'classes', 'id', 'edge_map', …
        group_styles: styles of groups, by number or name.
        out: an image of an earlier call, whose memory is used again.
        progress: a function that is told the fraction that is done; True stops with Cancelled.
        context: whose threads and memory are used; None: the calling thread's own.
        attributes: groups, edges, normals, texcoords, colors, check: as of Source.from_arrays().

    >>> image = draw([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], size=(64, 48))
    >>> image.rgba.shape
    (48, 64, 4)
    >>> sorted({int(line) for line in image.segments()["line"]})  # all are borders
    [4]
    """
    source = source_of(mesh, faces, **attributes)
    return (context or own_context()).draw(
        source,
        camera=camera,
        style=style,
        size=size,
        samples=samples,
        planes=planes,
        group_styles=group_styles,
        out=out,
        progress=progress,
    )
