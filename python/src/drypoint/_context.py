"""Contexts: threads and memory for drawing, kept from picture to picture."""

from __future__ import annotations

import contextlib
import os
import threading
import weakref
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Optional, Union

from . import _names
from ._camera import Camera
from ._errors import ArgumentError, Error
from ._generated import Style
from ._image import PLANES, Image
from ._library import Owned, call, ffi, lib
from ._progress import Progress, Reporter
from ._source import Source
from ._struct import coerce
from ._texture import filler

StyleLike = Union[Style, Mapping[str, object], None]
SLOTS = 2  # so that `image = context.draw(…)` in a loop never has to copy the last image's lines


class Slot:
    """A dp_context, and the image that it drew last."""

    def __init__(self, threads: int, memory: int) -> None:
        self.lock = threading.RLock()
        self.busy = False
        self.reporter = Reporter()
        self.keep: list[Any] = []  # what the last style points to
        self._image: Optional[weakref.ref[Image]] = None
        process = os.getpid()
        self._owned = Owned("dp_context", lambda pointer: _destroy(pointer, process))
        desc = {
            "threads": threads,
            "memory": memory,
            "progress": self.reporter.call,
            "user": self.reporter.pointer,
        }
        try:
            self._desc = ffi.new("dp_context_desc *", desc)
        except (TypeError, OverflowError) as error:
            raise ArgumentError(f"Context: {error}") from None
        self.pointer = self._owned.make(lib.dp_context_create, self._desc)

    @property
    def image(self) -> Optional[Image]:
        """The image that its lines belong to, if anybody still has it."""
        image = self._image() if self._image else None
        return image if image is not None and image._slot is self else None

    def give(self, image: Image) -> None:
        """Its lines are this image's now."""
        self._image, image._slot = weakref.ref(image), self
        image._segments = image._drawing = None

    @contextlib.contextmanager
    def lent_to(self, image: Image) -> Iterator[Any]:
        """The dp_context for one image's questions about its lines."""
        with self.lock:
            if self.busy or self.image is not image:
                raise Error("this image's context is drawing another one")
            yield self.pointer


def _destroy(pointer: Any, process: int) -> None:
    """A forked process has none of the threads that this would wait for."""
    if os.getpid() == process:
        lib.dp_context_destroy(pointer)


class Context:
    """Threads and memory, which stay for the next picture. draw() has one for each thread of
    Python's.

    Args:
        threads: 0: one for each processor.
        memory: beyond the picture's own, bytes; 0 means 256 MB, the least is 48 MB. Models that
            would take more are streamed.

    A context holds two of C's, by turns, so that the last image keeps its lines while the next
    one is drawn. It may be shared by threads, which then draw one after the other: for pictures
    at the same time each needs its own.

    >>> context = Context(threads=1)
    >>> context.draw(Source.shape("cube"), size=(40, 30)).rgba.shape
    (30, 40, 4)
    """

    def __init__(self, threads: int = 0, memory: int = 0) -> None:
        self._threads, self._memory = threads, memory
        self._lock = threading.RLock()
        self._process = os.getpid()
        self._slots = [Slot(threads, memory)]

    def draw(
        self,
        source: Source,
        *,
        camera: Optional[Camera] = None,
        style: StyleLike = None,
        size: tuple[int, int] = (800, 600),
        samples: int = 4,
        planes: Iterable[str] = (),
        group_styles: Optional[Mapping[Union[int, str], StyleLike]] = None,
        out: Optional[Image] = None,
        progress: Optional[Progress] = None,
    ) -> Image:
        """Draws a source.

        Args:
            camera: None: all of it, from the right, the front and above.
            style: None: every class of lines, 2 px wide, black on white.
            size: (width, height), px, 1 to 32768.
            samples: per pixel: 1, 4, 8 or 16.
            planes: what else the image is to hold: 'depth', 'normals', 'classes', 'id',
                'edge_map', 'eye_normals', 'distance'.
            group_styles: styles of groups, by number or name; all others have `style`.
            out: an image of an earlier call, whose memory is used again, and which is the result
                then.
            progress: is told the fraction that is done, now and then; True stops with Cancelled.

        Raises:
            ArgumentError, OutOfMemory, Cancelled, LimitError, and what the source fails with.
            `out` holds nothing to show then.
        """
        image = self._target(size, planes, out)
        with self._lock:
            slot = self._slot_for(image)
            with slot.lock, source._lock:
                if slot.busy:
                    raise Error(
                        "this context is drawing: a progress function must not draw with it"
                    )
                slot.busy = True
                try:
                    self._draw(slot, image, source, camera, style, samples, group_styles, progress)
                finally:
                    slot.busy = False
        return image

    @staticmethod
    def _target(size: tuple[int, int], planes: Iterable[str], out: Optional[Image]) -> Image:
        """The image to draw into."""
        if out is not None:
            return out
        try:
            width, height = (value.__index__() for value in size)
        except (AttributeError, TypeError, ValueError):
            raise ArgumentError(f"size: {size!r} is not (width, height)") from None
        if not (0 < width < 1 << 32 and 0 < height < 1 << 32):
            raise ArgumentError(f"size: {width} x {height} px is no picture")
        return Image((width, height), planes)

    def _slot_for(self, image: Image) -> Slot:
        """A dp_context that may draw: the image's own, else one whose last image is gone, or
        keeps its lines now."""
        if self._process != os.getpid():  # forked
            self._process, self._slots = os.getpid(), []
        free = next(
            (slot for slot in self._slots if image._slot is slot or slot.image is None), None
        )
        if free is None and len(self._slots) < SLOTS:
            free = Slot(self._threads, self._memory)
            self._slots.append(free)
        if free is None:
            free = self._slots[0]
            last = free.image
            if last is not None:
                last._keep_lines()
        self._slots.remove(free)
        self._slots.append(free)  # the one that drew longest ago is first
        return free

    def _draw(
        self,
        slot: Slot,
        image: Image,
        source: Source,
        camera: Optional[Camera],
        style: StyleLike,
        samples: int,
        group_styles: Any,
        progress: Optional[Progress],
    ) -> None:
        keep: list[Any] = []
        c_style = filler.new(coerce(Style, style, "style"), keep)
        groups, count = self._group_styles(c_style, group_styles, source, keep)
        c_camera = (camera or Camera())._resolve(source, image.size)
        target = _target_of(image, samples)
        slot._image, image._slot = None, None
        slot.reporter.run(
            progress,
            lambda: call(
                lib.dp_draw_grouped,
                slot.pointer,
                source._pointer,
                c_camera,
                c_style,
                groups,
                count,
                target,
            ),
        )
        slot.keep = keep
        image._stats = ffi.new("dp_stats *")
        lib.dp_stats_of(slot.pointer, image._stats)
        slot.give(image)

    @staticmethod
    def _group_styles(
        style: Any,
        given: Optional[Mapping[Union[int, str], StyleLike]],
        source: Source,
        keep: list[Any],
    ) -> tuple[Any, int]:
        """An array of dp_style, up to the last group that has one of its own."""
        if not given:
            return ffi.NULL, 0
        names: dict[str, int] = {}
        if any(isinstance(key, str) for key in given):
            names = {group.name: group.number for group in source.groups}
        numbers = {}
        for key, value in given.items():
            if isinstance(key, str) and key not in names:
                raise _names.unknown("group_styles", key, names)
            number = names[key] if isinstance(key, str) else key.__index__()
            if not 0 <= number < 65536:
                raise ArgumentError(f"group_styles: there is no group {number}")
            numbers[number] = value
        count = 1 + max(numbers)
        styles = ffi.new("dp_style[]", count)
        for number in range(count):
            styles[number] = style[0]
            if number in numbers:
                ffi.memmove(styles + number, bytes(ffi.sizeof("dp_style")), ffi.sizeof("dp_style"))
                filler.fill(
                    styles[number], coerce(Style, numbers[number], f"group_styles[{number}]"), keep
                )
        return styles, count


def _target_of(image: Image, samples: int) -> Any:
    """The dp_target of an image."""
    target = ffi.new("dp_target *")
    try:
        target.width, target.height, target.samples = image.width, image.height, samples
    except (TypeError, OverflowError) as error:
        raise ArgumentError(f"samples: {samples!r} does not fit: {error}") from None
    for name, array in image._planes.items():
        member, kind, _ = PLANES[name]
        pointer = {"u1": "uint8_t *", "u2": "uint16_t *", "f4": "float *"}[kind]
        setattr(target, member, ffi.cast(pointer, array.ctypes.data))
    return target


_own = threading.local()


def own_context() -> Context:
    """The calling thread's context, made when it is first needed."""
    if not hasattr(_own, "context"):
        _own.context = Context()
    return _own.context
