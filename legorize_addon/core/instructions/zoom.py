"""Maps of wide models: only the place that is worked on, so large that it can be read, and where it lies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import ceil
from typing import Final

import numpy as np

from ..arrays import Ints
from ..model import Bricks, Catalogue, stud_columns
from .canvas import WHITE, Item, Paint, Path, Rgb, rectangle
from .layers import Layer
from .map_frame import Frame
from .plans import plan_outlines

AROUND: Final = 2
"""Studs that are shown around what is laid."""

_WHOLE: Final[Rgb] = (196, 199, 204)
_LAID: Final[Rgb] = (94, 99, 107)
_BOX: Final[Rgb] = (200, 0, 0)


def zoomed(
    layers: Sequence[Layer], bricks: Bricks, catalogue: Catalogue, whole: Frame, room: tuple[float, float], least: float
) -> list[Layer]:
    """Cut layers out of maps on which a stud would be too small.

    Parameters
    ----------
    layers : sequence of Layer
    bricks : Bricks
    catalogue : Catalogue
    whole : Frame
        Of maps of the whole model.
    room : (float, float)
        mm that a map may be wide and high.
    least : float
        mm of a stud at least.

    Returns
    -------
    list of Layer
        The same if studs are large enough. Else each has the box around what is laid; where that is too large, it is
        divided into the fewest parts that can be read, of each of which the others are among the bricks between.
    """
    if whole.stud >= least:
        return list(layers)
    low, high = _boxes(bricks, catalogue)
    return [part for layer in layers for part in _parts(layer, low, high, whole, room, least)]


def _boxes(bricks: Bricks, catalogue: Catalogue) -> tuple[Ints, Ints]:
    """Return the lower and the upper corners of bricks in studs, (n, 2) each."""
    points, count = plan_outlines(bricks, catalogue)
    starts = np.cumsum(count) - count
    low, high = (each.reduceat(points, starts) for each in (np.minimum, np.maximum))
    return np.floor(low).astype(np.int64), np.ceil(high).astype(np.int64)


def _parts(
    layer: Layer, low: Ints, high: Ints, whole: Frame, room: tuple[float, float], least: float
) -> Iterator[Layer]:
    if layer.tile:
        yield layer
        return
    first, last = low[layer.new].min(axis=0), high[layer.new].max(axis=0)
    # a map of n studs, and what is shown around it
    most = np.array(room[:: -1 if whole.turned else 1]) / least - 2 * AROUND
    number = [max(1, ceil(size / n)) for size, n in zip((last - first).tolist(), most.tolist(), strict=True)]
    middle = (low[layer.new] + high[layer.new]) / 2 - first
    place = np.minimum((middle * number / (last - first)).astype(np.int64), np.array(number) - 1)
    # from the front, each row from the left
    keys = place[:, 1] * number[0] + place[:, 0]
    used = np.unique(keys).tolist()
    for turn, key in enumerate(used):
        here = keys == key
        mine = layer.new[here]
        box = _box(low[mine].min(axis=0) - AROUND, high[mine].max(axis=0) + AROUND, whole)
        title = f"{layer.title}, part {turn + 1} of {len(used)}" if len(used) > 1 else layer.title
        yield replace(layer, title=title, new=mine, through=np.concatenate([layer.through, layer.new[~here]]), box=box)


def _box(low: Ints, high: Ints, whole: Frame) -> tuple[tuple[int, int], tuple[int, int]]:
    (left, front), (right, back) = np.maximum(low, whole.low).tolist(), np.minimum(high, whole.high).tolist()
    return (left, front), (right, back)


def locator(layer: Layer, bricks: Bricks, catalogue: Catalogue, whole: Frame, size: tuple[float, float]) -> list[Item]:
    """Draw the whole layer small, with a box around what its map shows.

    Parameters
    ----------
    layer : Layer
        With a box.
    bricks : Bricks
    catalogue : Catalogue
    whole : Frame
    size : (float, float)
        mm that it may be wide and high.

    Returns
    -------
    list of Item
        From (0, 0) on.
    """
    sides = (whole.high - whole.low).tolist()
    wide, deep = sides[::-1] if whole.turned else sides
    stud = min(size[0] / wide, size[1] / deep)
    small = whole._replace(stud=stud, left=0.0, top=0.0)
    items: list[Item] = [rectangle(0, 0, wide * stud, deep * stud, Paint(fill=WHITE, stroke=_WHOLE, width=0.2))]
    for rows, colour in ((np.concatenate([layer.below, layer.through]), _WHOLE), (layer.new, _LAID)):
        if len(rows):
            items.append(_spots(bricks.take(rows), catalogue, small, colour))
    corners = [small.at(*corner) for corner in layer.box or ()]
    (x0, y0), (x1, y1) = np.min(corners, axis=0).tolist(), np.max(corners, axis=0).tolist()
    return [*items, rectangle(x0, y0, x1 - x0, y1 - y0, Paint(stroke=_BOX, width=0.5))]


def _spots(bricks: Bricks, catalogue: Catalogue, frame: Frame, colour: Rgb) -> Path:
    """Return where bricks lie, row by row, as few boxes."""
    brick, columns = stud_columns(bricks, catalogue)
    # which stud squares are covered, in whole or by half
    moved = columns[:, :2] + bricks.shift[brick, :2]
    cells = np.unique(np.concatenate([np.floor(moved), np.ceil(moved)])[:, ::-1].astype(np.int64), axis=0)
    ends = np.flatnonzero((np.diff(cells[:, 0]) != 0) | (np.diff(cells[:, 1]) != 1))
    first, last = cells[np.concatenate([[0], ends + 1])], cells[np.concatenate([ends, [len(cells) - 1]])]
    boxes = []
    for (y, x), (_, end) in zip(first.tolist(), last.tolist(), strict=True):
        boxes += [frame.at(x, y), frame.at(end + 1, y), frame.at(end + 1, y + 1), frame.at(x, y + 1)]
    return Path(np.array(boxes), np.full(len(first), 4), True, (Paint(fill=colour),))
