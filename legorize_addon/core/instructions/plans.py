"""Bricks as seen from straight above: outlines, studs, hatching, in units of a stud with y upwards."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..model import Bricks, Catalogue, Part, column_facts, outline, stud_middles, turned
from .canvas import Group, Item, Paint, Path, Rgb, lines

STUD: Final = 0.6
"""Width of a stud."""

HATCH: Final = 0.35
"""Distance of the lines of a hatching."""


def plan_outlines(bricks: Bricks, catalogue: Catalogue) -> tuple[Floats, Ints]:
    """Return the outlines of bricks.

    Parameters
    ----------
    bricks : Bricks
        n rows.
    catalogue : Catalogue

    Returns
    -------
    points : (n_points, 2) float64 array
        Corners in studs, brick after brick.
    count : (n,) int64 array
        Corners of each.
    """
    parts = [catalogue.parts[row] for row in bricks.part.tolist()]
    found = [_outline(part, turn) for part, turn in zip(parts, (bricks.turn % 4).tolist(), strict=True)]
    count = np.array([len(corners) for corners in found], dtype=np.int64)
    shape = np.concatenate([np.zeros((0, 2)), *found])
    return shape + np.repeat((bricks.corner + bricks.shift)[:, :2], count, axis=0), count


@cache
def _outline(part: Part, turn: int) -> Floats:
    """Return the corners of a turned part from the lowest corner of its box, (n, 2) studs, the lowest one first."""
    corners = turned(part, turn, outline(part))
    return np.roll(corners, -int(np.lexsort(corners.T)[0]), axis=0)


def plan_studs(bricks: Bricks, catalogue: Catalogue, *paints: Paint) -> Path:
    """Return the studs of bricks as dots; the paints' lines are as wide as the dots."""
    middle = stud_middles(bricks, catalogue)[column_facts(bricks, catalogue).stud]
    dots = np.stack([middle, middle], axis=1)
    # a line without any length is not drawn everywhere
    dots[:, 1, 0] += 0.001
    return lines(dots, *paints)


def by_colour(colour: Ints) -> Iterator[tuple[Rgb, Ints]]:
    """Yield each colour of some bricks, (n, 3) bytes, with their rows."""
    colours, row = np.unique(colour, axis=0, return_inverse=True)
    for number, (red, green, blue) in enumerate(colours.tolist()):
        yield (red, green, blue), np.flatnonzero(row.reshape(-1) == number)


def hatched(points: Floats, count: Ints, paint: Paint) -> Item:
    """Return slanting lines within outlines, as :func:`plan_outlines` gives them."""
    low, high = points.min(axis=0), points.max(axis=0)
    starts = np.arange(low[0] - (high[1] - low[1]), high[0], HATCH)
    ends = starts + high[1] - low[1]
    across = np.stack([np.stack([x, np.full(len(x), y)], axis=1) for x, y in ((starts, low[1]), (ends, high[1]))], 1)
    return Group((lines(across, paint),), clip=Path(points, count, True, ()))
