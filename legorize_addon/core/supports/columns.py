"""Straight supports: a column under each contact; and what columns and beams share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ..arrays import Mask
from ..units import PLATES_PER_BRICK
from .boxes import Area, Boxes, boxes_of, cells_of
from .clearance import Clearance

Cells = NDArray[np.integer]

_FOOT: Final = 2
"""Studs along each side of a foot."""


def columns(contacts: Sequence[tuple[int, int, int]], room: Clearance) -> Boxes:
    """Put a straight column under each contact, with a wide foot where there is room.

    Parameters
    ----------
    contacts : sequence of (x, y, z)
        Cells in the room, z the plate on which the carried brick lies, more than
        0. Each has room from there down to the ground.
    room : Clearance

    Returns
    -------
    (n, 6) int32 array
        Boxes in the room's cells: bricks, and single plates right under contacts.
        Columns side by side share a foot.
    """
    rows = pillars(contacts)
    low = (rows[:, 5] == PLATES_PER_BRICK) & (rows[:, 2] == 0)
    feet = _feet([(x, y) for x, y, *_ in rows[low].tolist()], room.layer(0).copy())
    return np.concatenate([boxes_of((x, y, 0, a, b, PLATES_PER_BRICK) for x, y, a, b in feet), rows[~low]])


def pillars(contacts: Sequence[tuple[int, int, int]]) -> Boxes:
    """Put one brick of 1 x 1 a layer under each contact, and single plates right under it.

    Parameters
    ----------
    contacts : sequence of (x, y, z)
        As for :func:`columns`.

    Returns
    -------
    (n, 6) int32 array
        Boxes, from the ground up.
    """
    return boxes_of(
        row
        for x, y, z in contacts
        for row in (
            *((x, y, layer * PLATES_PER_BRICK, 1, 1, PLATES_PER_BRICK) for layer in range(z // PLATES_PER_BRICK)),
            *((x, y, plate, 1, 1, 1) for plate in range(z - z % PLATES_PER_BRICK, z)),
        )
    )


def within_clearance(cells: Cells, room: Clearance) -> Cells:
    """Return the cells, once each, below which there is room down to the ground."""
    x, y, z = cells.T
    raised = cells[z > 0]
    x, y, z = raised.T
    return np.unique(raised[room.open[z - 1, y, x]], axis=0)


def covered(cells: Mask, sizes: Sequence[tuple[int, int]]) -> NDArray[np.int64]:
    """Cover cells of several levels, each by itself, greedily with rectangles.

    Parameters
    ----------
    cells : (n_levels, n_y, n_x) bool array
    sizes : sequence of (int, int)
        Sides of the rectangles, in the order in which they are tried, either way
        round. Cells that none fits into stay uncovered.

    Returns
    -------
    (n, 5) int64 array
        Level, x, y and the lengths along x and y of each rectangle.
    """
    left = cells.copy()
    found = [np.zeros((0, 5), dtype=np.int64)]
    for a, b in dict.fromkeys(turned for long, short in sizes for turned in ((long, short), (short, long))):
        for y, x in np.argwhere(_fitting(left, a, b).any(axis=0)).tolist():
            # levels are independent of each other: a place is tried in all of them at once
            window = left[:, y : y + b, x : x + a]
            levels = np.flatnonzero(window.all(axis=(1, 2)))
            window[levels] = False
            found.append(np.column_stack([levels, np.tile([x, y, a, b], (len(levels), 1))]))
    return np.concatenate(found)


def _fitting(cells: Mask, a: int, b: int) -> Mask:
    """Return where a rectangle fits on each level, by its lowest corner."""
    if cells.shape[1] < b or cells.shape[2] < a:
        return np.zeros((len(cells), 0, 0), dtype=bool)
    along: Mask = sliding_window_view(cells, a, axis=2).all(axis=-1)
    fits: Mask = sliding_window_view(along, b, axis=1).all(axis=-1)
    return fits


def _feet(standing: Sequence[tuple[int, int]], ground: Mask) -> list[Area]:
    """Return one foot (x, y, length along x, length along y) for each column, or for several side by side."""
    waiting = dict.fromkeys(standing)
    feet = []
    while waiting:
        x, y = next(iter(waiting))
        box = max(_places(x, y, ground), key=lambda place: sum(cell in waiting for cell in cells_of(place)))
        # columns that stand on this foot need none of their own
        for cell in cells_of(box):
            waiting.pop(cell, None)
            ground[cell[1], cell[0]] = False
        feet.append(box)
    return feet


def _places(x: int, y: int, ground: Mask) -> list[Area]:
    """Return the free places of a foot of a column, or its own cell if there are none."""
    n_y, n_x = ground.shape
    wide = [
        (at_x, at_y, _FOOT, _FOOT)
        for at_y in range(max(y + 1 - _FOOT, 0), min(y, n_y - _FOOT) + 1)
        for at_x in range(max(x + 1 - _FOOT, 0), min(x, n_x - _FOOT) + 1)
        if ground[at_y : at_y + _FOOT, at_x : at_x + _FOOT].all()
    ]
    return wide or [(x, y, 1, 1)]
