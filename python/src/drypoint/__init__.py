"""Drypoint turns polygons into line drawings: silhouettes, ridges, valleys, intersections and
borders.

    import drypoint image = drypoint.draw(vertices, faces)           # arrays, or a mesh of
    trimesh, PyVista, Open3D image.save("part.png") image.save("part.svg")

Lengths on the screen are px, angles degrees, all else world units. Of every setting 0 is the
default; what that means is said by its class: help(drypoint.Style).
"""

from ._camera import Camera
from ._context import Context
from ._draw import draw
from ._drawing import CHAIN, CHAIN_POINT, PATH, POINT, SEGMENT, Drawing, Polylines
from ._errors import (
    ArgumentError,
    Cancelled,
    Error,
    FileError,
    FormatError,
    LimitError,
    OutOfMemory,
    UnsupportedError,
)
from ._generated import (
    Between,
    Cleaning,
    Clip,
    ClipPlane,
    Deform,
    DeformKind,
    DrawingInfo,
    EdgeDetector,
    EdgeKind,
    EdgeMap,
    Edges,
    Extent,
    FileFormat,
    Fit,
    Format,
    Hidden,
    HiddenLook,
    Ink,
    Line,
    LineEnd,
    LineLight,
    LineLighting,
    LineStyle,
    Method,
    Mirror,
    Normals,
    Pattern,
    SectionLook,
    Shade,
    Shading,
    Smoothing,
    Stage,
    Stats,
    Stroke,
    StrokeU,
    Style,
)
from ._image import Image
from ._library import has_io, lib, missing, text
from ._source import Group, Source, shapes
from ._style import resolved, stroke_look
from ._texture import Texture, textures

__version__ = text(lib.dp_version())
"""Version of the C library that draws."""

__all__ = [
    "ArgumentError",
    "Between",
    "CHAIN",
    "CHAIN_POINT",
    "Camera",
    "Cancelled",
    "Cleaning",
    "Clip",
    "ClipPlane",
    "Context",
    "Deform",
    "DeformKind",
    "Drawing",
    "DrawingInfo",
    "EdgeDetector",
    "EdgeKind",
    "EdgeMap",
    "Edges",
    "Error",
    "Extent",
    "FileError",
    "FileFormat",
    "Fit",
    "Format",
    "FormatError",
    "Group",
    "Hidden",
    "HiddenLook",
    "Image",
    "Ink",
    "LimitError",
    "Line",
    "LineEnd",
    "LineLight",
    "LineLighting",
    "LineStyle",
    "Method",
    "Mirror",
    "Normals",
    "OutOfMemory",
    "PATH",
    "POINT",
    "Pattern",
    "Polylines",
    "SEGMENT",
    "SectionLook",
    "Shade",
    "Shading",
    "Smoothing",
    "Source",
    "Stage",
    "Stats",
    "Stroke",
    "StrokeU",
    "Style",
    "Texture",
    "UnsupportedError",
    "draw",
    "has_io",
    "missing",
    "resolved",
    "shapes",
    "stroke_look",
    "textures",
]
del lib, text
