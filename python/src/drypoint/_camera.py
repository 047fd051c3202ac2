"""Cameras: how a model is seen."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np

from ._errors import ArgumentError
from ._generated import Fit
from ._library import call, error_of, ffi, lib
from ._source import Source
from ._struct import coerce
from ._texture import filler

Vector = Union[Sequence[float], np.ndarray]


class Camera:
    """View and projection, as in OpenGL: a right-handed camera space that looks along -z.

    A camera says how. It becomes two matrices when it is known what is seen, and in which format,
    by resolve(), which draw() calls.

    >>> Camera.look_at((3, 2, 4), (0, 0, 0)).perspective(fov_y=30)
    <drypoint.Camera, of the model and the picture>
    >>> Camera.fit(direction=(0, 0, 1)).resolve(Source.shape("cube"), (100, 100)).view.shape
    (4, 4)
    """

    def __init__(self, view: Optional[Any] = None, projection: Optional[Any] = None) -> None:
        """A camera of two matrices (4, 4), which multiply column vectors: world to camera space,
        camera to clip space (-w <= x, y, z <= w). Without any, one that fits the model."""
        self._view = None if view is None else _matrix(view, "view")
        self._projection = None if projection is None else _matrix(projection, "projection")
        self._fit: Optional[Fit] = None
        self._lens: Optional[
            tuple[str, float, Optional[float], Optional[float], Optional[float]]
        ] = None
        if view is None and projection is None:
            self._fit = Fit()

    @classmethod
    def fit(cls, fit: Union[Fit, Mapping[str, object], None] = None, **fields: Any) -> "Camera":
        """All that is drawn of the model fills the picture. Fields are Fit's: direction (towards
        the eye), up, fov_y, orthographic, zoom, …; its aspect is the picture's where it is 0."""
        camera = cls()
        camera._fit = coerce(Fit, fit, "fit").replace(**fields)
        return camera

    @classmethod
    def look_at(cls, eye: Vector, target: Vector, up: Vector = (0, 1, 0)) -> "Camera":
        """From eye to target, both world space. up need not be perpendicular to that. The
        projection is a perspective of 35 degrees unless perspective() or orthographic() says
        otherwise."""
        camera = ffi.new("dp_camera *")
        _refused(
            lib.dp_camera_look_at(
                camera, _three(eye, "eye"), _three(target, "target"), _three(up, "up")
            ),
            f"look_at: eye {tuple(eye)}, target {tuple(target)}, up {tuple(up)}",
        )
        made = cls(_array(camera.view))
        return made.perspective()

    def perspective(
        self,
        fov_y: float = 35,
        *,
        aspect: Optional[float] = None,
        near: Optional[float] = None,
        far: Optional[float] = None,
    ) -> "Camera":
        """This camera with a perspective. fov_y: vertical, degrees; aspect: width / height, None:
        the picture's; near, far: distances along the line of sight, world units, None: as the
        model needs."""
        return self._with_lens("perspective", fov_y, aspect, near, far)

    def orthographic(
        self,
        height: float,
        *,
        aspect: Optional[float] = None,
        near: Optional[float] = None,
        far: Optional[float] = None,
    ) -> "Camera":
        """The same without perspective. height: of what is seen, world units."""
        return self._with_lens("orthographic", height, aspect, near, far)

    def _with_lens(
        self,
        kind: str,
        size: float,
        aspect: Optional[float],
        near: Optional[float],
        far: Optional[float],
    ) -> "Camera":
        if self._view is None:
            raise ArgumentError(
                f"{kind}: first say from where, by look_at() or a view; fit() has fields for it"
            )
        made = copy.copy(self)
        made._projection, made._fit, made._lens = None, None, (kind, float(size), aspect, near, far)
        return made

    @property
    def view(self) -> np.ndarray:
        """(4, 4) world to camera space."""
        return self._known(self._view, "view")

    @property
    def projection(self) -> np.ndarray:
        """(4, 4) camera to clip space."""
        return self._known(self._projection, "projection")

    def _known(self, matrix: Optional[np.ndarray], what: str) -> np.ndarray:
        if matrix is None:
            raise ArgumentError(f"this camera's {what} depends on what it sees: resolve() it first")
        return matrix.copy()

    def resolve(self, source: Source, size: tuple[int, int] = (800, 600)) -> "Camera":
        """This camera for a model and a picture of (width, height) px: both matrices are known
        then."""
        camera = self._resolve(source, size)
        return Camera(_array(camera.view), _array(camera.projection))

    def _resolve(self, source: Source, size: tuple[int, int]) -> Any:
        """The same as a dp_camera."""
        camera = ffi.new("dp_camera *")
        aspect = size[0] / size[1]
        if self._fit is not None:
            fit = filler.new(self._fit, [])
            fit.aspect = fit.aspect or aspect
            call(lib.dp_camera_fit_source, camera, fit, source._pointer, ffi.NULL)
            return camera
        _fill(camera.view, self.view)
        if self._lens is not None:
            self._project(camera, source, aspect)
        else:
            _fill(camera.projection, self.projection)
        return camera

    def _project(self, camera: Any, source: Source, picture: float) -> None:
        """Sets the projection that the lens says."""
        assert self._lens
        kind, size, aspect, near, far = self._lens
        if near is None or far is None:
            extent, found = ffi.new("dp_extent *"), ffi.new("double[2]")
            call(lib.dp_source_extent, source._pointer, extent)
            lib.dp_camera_near_far(camera, extent.min, extent.max, found, found + 1)
            near, far = found[0] if near is None else near, found[1] if far is None else far
        function = getattr(lib, f"dp_camera_{kind}")
        _refused(
            function(camera, size, aspect or picture, near, far),
            f"{kind}: {size} with aspect {aspect or picture}, near {near} and far {far}",
        )

    def __repr__(self) -> str:
        fixed = self._view is not None and self._projection is not None
        return "<drypoint.Camera>" if fixed else "<drypoint.Camera, of the model and the picture>"


def _refused(result: int, what: str) -> None:
    """Raises where a call that fills no diagnostics failed."""
    if result:
        raise error_of(result, ffi.new("dp_diag *"), what)


def _three(vector: Vector, what: str) -> list[float]:
    try:
        numbers = [float(x) for x in vector]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 3:
        raise ArgumentError(f"{what}: {vector!r} is not three numbers")
    return numbers


def _matrix(values: Any, what: str) -> np.ndarray:
    matrix = np.array(values, dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ArgumentError(f"{what}: an array of shape {matrix.shape} is not (4, 4)")
    return matrix


def _array(numbers: Any) -> np.ndarray:
    """C's matrices are column by column."""
    return np.array(list(numbers)).reshape(4, 4).T.copy()


def _fill(target: Any, matrix: np.ndarray) -> None:
    for index, number in enumerate(matrix.T.reshape(-1).tolist()):
        target[index] = number
