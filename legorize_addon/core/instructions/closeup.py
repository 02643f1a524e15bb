"""Pictures of large models: only the place that is worked on, so large that it can be read, and where it lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY
from .canvas import Group, Item, Paint, Path, Rgb, rectangle
from .lattice import Sight
from .picture import MM, at, extent
from .regions import outlines

Window = tuple[Floats, Floats]
"""Upper left and lower right corner of the part of a picture that is shown, in its units."""

SMALLEST: Final = 0.25
"""mm on paper for a mm of the model at least, if the whole of it is shown: a stud is then 2 mm wide."""

AROUND: Final = 45.0
"""mm of the model that are shown around what is new."""

LEAST: Final = (360.0, 150.0)
"""mm of the model that are shown at least, across and upwards: a quarter of a page."""

LOCATOR: Final = (34.0, 22.0)
"""mm on paper for the small picture of the whole."""

_RIM: Final = Paint(stroke=(176, 180, 186), width=3.0)
"""Around a picture that is cut off."""

_BEYOND: Final = 90.0
"""Units beyond the window that are drawn and cut off, so that no line ends in it."""

_WHOLE: Final[Rgb] = (206, 209, 214)
_NEW: Final[Rgb] = (94, 99, 107)
_BOX: Final[Rgb] = (200, 0, 0)


def window_of(sight: Sight, new: Ints, room: tuple[float, float]) -> Window | None:
    """Choose the part of a picture that is shown.

    Parameters
    ----------
    sight : Sight
    new : (k,) int64 array
        Rows of the new bricks.
    room : (float, float)
        mm on paper for the largest picture.

    Returns
    -------
    (low, high) or None
        None for the whole picture: it is large enough, or new bricks are seen all over it.
    """
    low, high = extent(sight)
    size = high - low
    if (size * MM * SMALLEST <= room).all():
        return None
    first, last = extent(sight, _mask(sight, new))
    shown = np.minimum(np.maximum(last - first + 2 * AROUND / MM, np.array(LEAST) / MM), size)
    if (shown >= size).all():
        return None
    return _around((first + last) / 2, shown, (low, high))


def grown(window: Window, sight: Sight, size: Floats) -> Window:
    """Return a window that is as large as there is room for, and as the picture is, around the same place."""
    low, high = extent(sight)
    shown = np.minimum(np.maximum(size, window[1] - window[0]), high - low)
    return _around((window[0] + window[1]) / 2, shown, (low, high))


def _around(middle: Floats, size: Floats, whole: Window) -> Window:
    """Return a window of a size around a place, as far as the whole picture goes."""
    begin = np.clip(middle - size / 2, whole[0], whole[1] - size)
    return begin, begin + size


def framed(items: Sequence[Item], window: Window) -> tuple[Item, ...]:
    """Cut things off at the border of a window, and draw that."""
    shape = rectangle(*window[0].tolist(), *(window[1] - window[0]).tolist(), _RIM)
    return Group(tuple(items), clip=shape), shape


def cut(sight: Sight, window: Window) -> Sight:
    """Return what is seen within a window, and a little beyond it."""
    m, n = np.indices(sight.nearest.shape[:2])
    place = at(np.stack([m.ravel(), n.ravel()], axis=1) + sight.low)
    near = ((place >= window[0] - _BEYOND) & (place <= window[1] + _BEYOND)).all(axis=1).reshape(m.shape)
    rows, columns = (np.flatnonzero(near.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return sight
    inside = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    # an empty square on every side, so that every piece that is seen has neighbours
    nearest = np.pad(np.where(near[..., None], sight.nearest, NOBODY)[inside], ((1, 1), (1, 1), (0, 0)),
                     constant_values=NOBODY)  # fmt: skip
    return replace(sight, nearest=nearest, low=sight.low + np.array([rows[0] - 1, columns[0] - 1]))


def locator(sight: Sight, new: Ints, window: Window) -> list[Item]:
    """Draw the whole small, with what is new and a box around the window, from (0, 0) on.

    Parameters
    ----------
    sight : Sight
        Of the whole.
    new : (k,) int64 array
        Rows of the new bricks.
    window : (low, high)
    """
    low, high = extent(sight)
    unit = float(np.min(LOCATOR / (high - low)))
    items: list[Item] = []
    for seen, colour in ((sight.nearest != NOBODY, _WHOLE), (_mask(sight, new), _NEW)):
        loops = outlines(np.where(seen, 0, NOBODY), sight.low)
        items.append(Path((at(loops.points) - low) * unit, loops.count, True, (Paint(fill=colour),)))
    (x0, y0), (x1, y1) = ((corner - low) * unit for corner in window)
    return [*items, rectangle(float(x0), float(y0), float(x1 - x0), float(y1 - y0), Paint(stroke=_BOX, width=0.4))]


def _mask(sight: Sight, rows: Ints) -> Mask:
    """Tell in which pieces of the plane some bricks are seen; anywhere, if in none."""
    found = np.zeros(len(sight.free) + 1, dtype=bool)
    found[rows] = True
    found[NOBODY] = False
    seen: Mask = found[sight.bricks]
    return seen if seen.any() else sight.nearest != NOBODY
