"""Bodies of parts that fall along their length: their profile drawn out over the width, hollow from below.

Seen from the side (y grows away from the viewer) a body is one polygon: its underside from the start to the end, and
its top back again. Undersides that stand on something are open in high detail, under a roof that follows the top.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

import numpy as np

from ..core.model import Part, lines
from ..core.units import PLATE, STUD
from .lofts import BEVEL, GAP, ROOF, WALL, Detail, Floats, Loft, welded

_LEAST_EDGE: Final = 0.02
"""Length in mm of an edge below which it is left out."""

_LEAST_ROOM: Final = 0.3
"""Height in mm of a hollow below which it is left out."""


def slope_body(part: Part, detail: Detail) -> Loft:
    """Return the faces of the body of a part that falls along its length.

    Parameters
    ----------
    part : Part
    detail : {"low", "high"}
        Low: a closed prism. High: bevelled along the upper edges, hollow from below.

    Returns
    -------
    Loft
        In mm from the corner of the part's box, without studs and tubes.
    """
    top, bottom = (np.array(line) * (STUD, PLATE) for line in lines(part))
    across = (GAP, part.width * STUD - GAP)
    under = _within(bottom, GAP, part.length * STUD - GAP)
    high = detail == "high"
    upper = _within(top, GAP, part.length * STUD - GAP) - (0.0, GAP + BEVEL * high)
    faces = [_flat(np.concatenate([under, upper[::-1]]), across[0])]
    faces += [_flat(np.concatenate([upper, under[::-1]]), across[1])]
    faces += _strips(np.stack([upper[0], under[0]]), across)
    faces += _strips(np.stack([under[-1], upper[-1]]), across)
    faces += _bevelled(top, upper, across, part) if high else _strips(upper[::-1], across)
    for first, second in pairwise(under):
        room = _hollow(top, first, second) if high else None
        faces += _strips(np.stack([first, second]), across) if room is None else _open(first, second, room, across)
    return welded(faces)


def level(part: Part, x: float) -> float:
    """Return how high the top of a part is at a place along it, both in mm."""
    return float(_at(np.array(lines(part)[0]) * (STUD, PLATE), x))


def _at(line: Floats, x: Floats | float) -> Floats:
    return np.asarray(np.interp(x, line[:, 0], line[:, 1]))


def _within(line: Floats, start: float, end: float) -> Floats:
    """Return a line between two places, (n, 2); corners that lie hardly inside are left out."""
    inside = line[(line[:, 0] > start + _LEAST_EDGE) & (line[:, 0] < end - _LEAST_EDGE)]
    return np.array([(start, _at(line, start)), *inside, (end, _at(line, end))])


def _flat(points: Floats, y: float) -> Floats:
    """Return a face of one side."""
    return np.insert(points, 1, y, axis=1)


def _strips(line: Floats, across: tuple[float, float]) -> list[Floats]:
    """Return faces over the whole width along a line, outside on its right as seen from the side."""
    return [
        np.array([(*near[:1], across[0], near[1]), (near[0], across[1], near[1]), (far[0], across[1], far[1]),
                  (far[0], across[0], far[1])])
        for near, far in pairwise(line)
    ]  # fmt: skip


def _bevelled(top: Floats, upper: Floats, across: tuple[float, float], part: Part) -> Iterator[Floats]:
    """Yield the top, and the bevels from the sides up to it."""
    # a bevel ends before the next corner, as that of the narrow edge of a cheese slope
    start = min(GAP + BEVEL, upper[1, 0] - 2 * _LEAST_EDGE)
    lid = np.add(upper, (0.0, BEVEL))
    for row, x in ((0, start), (-1, part.length * STUD - GAP - BEVEL)):
        lid[row] = x, _at(top, x) - GAP
    inner = (across[0] + BEVEL, across[1] - BEVEL)
    yield from _strips(lid[::-1], inner)
    near, far = (np.concatenate([_flat(upper, y), _flat(lid, z)[::-1]]) for y, z in zip(across, inner, strict=True))
    count = len(upper)
    for row in range(count - 1):
        yield near[[row, row + 1, 2 * count - 2 - row, 2 * count - 1 - row]]
        yield far[[row + 1, row, 2 * count - 1 - row, 2 * count - 2 - row]]
    yield np.array([near[0], near[-1], far[-1], far[0]])
    yield np.array([far[count - 1], far[count], near[count], near[count - 1]])


def _hollow(top: Floats, first: Floats, second: Floats) -> Floats | None:
    """Return the roof over a level piece of the underside, None over others and where there is no room."""
    if first[1] != second[1] or second[0] - first[0] < 2 * WALL + _LEAST_ROOM:
        return None
    roof = _within(top, first[0] + WALL - GAP, second[0] - WALL + GAP) - (0.0, ROOF)
    roof[:, 1] = np.maximum(roof[:, 1], first[1] + _LEAST_ROOM)
    return roof if roof[0, 1] > first[1] + _LEAST_ROOM else None


def _open(first: Floats, second: Floats, roof: Floats, across: tuple[float, float]) -> Iterator[Floats]:
    """Yield the rim of a hollow and its inside: walls, ends, roof."""
    low = first[1]
    inner = (across[0] + WALL - GAP, across[1] - WALL + GAP)
    start, end = roof[0, 0], roof[-1, 0]
    rim = [
        np.array([(x, y, low) for x, y in ((u[0], v[0]), (u[0], v[1]), (u[1], v[1]), (u[1], v[0]))])
        for u, v in (((first[0], second[0]), across), ((start, end), inner))
    ]
    for row in range(4):
        after = (row + 1) % 4
        yield np.array([rim[0][row], rim[0][after], rim[1][after], rim[1][row]])
    floor = np.array([(start, low), (end, low)])
    yield _flat(np.concatenate([roof, floor[::-1]]), inner[0])
    yield _flat(np.concatenate([floor, roof[::-1]]), inner[1])
    yield from _strips(np.stack([floor[0], roof[0]]), inner)
    yield from _strips(roof, inner)
    yield from _strips(np.stack([roof[-1], floor[1]]), inner)
