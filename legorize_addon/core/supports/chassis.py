"""Long bricks under wide undersides, on both sides of their middle, which a tree then carries.

A wide underside has many contacts near each other. Bricks of 2 x 8 and 1 x 8 that
lie right under it share them, so that fewer branches carry it, each pair alike.

References
----------
Paper, section on supports: the chassis "that spans a wide dimension on both x and
y directions" lies on 2 x 8 and 1 x 8 white bricks, or transposed ones, on both
sides of the central axis. What counts as wide is our own choice.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints, Mask
from ..model import Rows
from ..units import PLATES_PER_BRICK
from .boxes import Area, Boxes, boxes_of
from .clearance import Clearance

LONG: Final = 8
"""Studs of the bricks, and of an underside from which on it is wide along its axis."""

ACROSS: Final = 4
"""Studs across the axis from which on an underside is wide: two bricks, two studs wide, lie side by side."""

_HELD: Final = (1, LONG - 2)
"""Studs of a long brick under which it is carried: the second one from either end."""


def chassis(undersides: Rows, contacts: Rows, room: Clearance) -> Boxes:
    """Lay long bricks under wide undersides, on both sides of their central axis.

    Parameters
    ----------
    undersides : (n, 3) int32 array
        Cells (x, y, z) in the room, z the plate of the brick above.
    contacts : (k, 3) int32 array
        Cells that supports have to reach, some of the undersides.
    room : Clearance

    Returns
    -------
    (m, 6) int32 array
        Boxes of 2 x 8 and 1 x 8 studs, in pairs that carry at least one contact, stand in no other contact's way to the
        ground, and have the room of a brick below.
    """
    found: list[tuple[int, int, int, int, int, int]] = []
    # a brick needs one more below it to stand on
    for z in np.unique(contacts[:, 2][(contacts[:, 2] % PLATES_PER_BRICK == 0) & (contacts[:, 2] > PLATES_PER_BRICK)]):
        under = np.zeros(room.open.shape[1:], dtype=bool)
        x, y = undersides[undersides[:, 2] == z, :2].T
        under[y, x] = True
        wanted, passing = (_plane(contacts[rows], under) for rows in (contacts[:, 2] == z, contacts[:, 2] > z))
        free = under & room.layer(int(z) // PLATES_PER_BRICK - 1) & ~passing
        number, _ = ndimage.label(under)
        for place in ndimage.find_objects(number):
            rows, columns = place
            for area in _laid(free[place], wanted[place]):
                x, y, a, b = area
                found.append((x + columns.start, y + rows.start, int(z) - PLATES_PER_BRICK, a, b, PLATES_PER_BRICK))
    return boxes_of(found)


def carried_by(boxes: Boxes, cells: Rows, load: Floats, straight: Mask) -> tuple[Rows, Floats, Mask]:
    """Put contacts under long bricks in place of those on them.

    Parameters
    ----------
    boxes : (m, 6) int32 array
        As :func:`chassis`.
    cells, load, straight
        Of the contacts, as :class:`~.plan.SupportContacts`.

    Returns
    -------
    cells, load, straight
        Two contacts for each brick, which share what lies on it, and those that lie on none.
    """
    x, y, z = cells.T
    on = np.zeros(len(cells), dtype=bool)
    more, weight = [], []
    for at_x, at_y, at_z, a, b, height in boxes.tolist():
        mine = (x >= at_x) & (x < at_x + a) & (y >= at_y) & (y < at_y + b) & (z == at_z + height)
        on |= mine
        more += [(at_x + step, at_y, at_z) if a >= b else (at_x, at_y + step, at_z) for step in _HELD]
        weight += [float(load[mine].sum()) / len(_HELD)] * len(_HELD)
    added = np.array(more, dtype=cells.dtype).reshape(-1, 3)
    return (
        np.concatenate([cells[~on], added]),
        np.concatenate([load[~on], weight]),
        np.concatenate([straight[~on], np.zeros(len(added), dtype=bool)]),
    )


def without(room: Clearance, boxes: Boxes) -> Clearance:
    """Return the room beside long bricks and below them."""
    if not len(boxes):
        return room
    free = room.open.copy()
    for x, y, z, a, b, height in boxes.tolist():
        free[z : z + height, y : y + b, x : x + a] = False
    return replace(room, open=free)


def _plane(cells: Ints, like: Mask) -> Mask:
    """Return where there are cells, seen from above."""
    plane = np.zeros_like(like)
    plane[cells[:, 1], cells[:, 0]] = True
    return plane


def _laid(free: Mask, wanted: Mask) -> Iterator[Area]:
    """Yield the bricks under one underside, which lie along its longer side."""
    if free.shape[0] > free.shape[1]:
        yield from ((x, y, a, b) for y, x, b, a in _laid(free.T, wanted.T))
        return
    n_y, n_x = free.shape
    if n_x < LONG or n_y < ACROSS:
        return
    left = free.copy()
    # from the axis outwards, a pair of rows on both sides at a time; from the middle along it
    starts = sorted(range(n_x - LONG + 1), key=lambda start: (abs(2 * start + LONG - n_x) % (2 * LONG), start))
    for wide in (2, 1):
        for step in range(0, n_y // 2 - wide + 1, wide):
            for start in starts:
                pair = [(start, n_y // 2 - step - wide, LONG, wide), (start, (n_y + 1) // 2 + step, LONG, wide)]
                if all(_fits(left, area) for area in pair) and any(_has(wanted, area) for area in pair):
                    for x, y, a, b in pair:
                        left[y : y + b, x : x + a] = False
                    yield from pair


def _fits(free: Mask, area: Area) -> bool:
    x, y, a, b = area
    return bool(free[y : y + b, x : x + a].all())


def _has(wanted: Mask, area: Area) -> bool:
    x, y, a, b = area
    return bool(wanted[y : y + b, x : x + a].any())
