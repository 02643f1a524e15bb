"""Bricks from straight above."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Paint
from legorize_addon.core.instructions.plans import by_colour, hatched, plan_outlines, plan_studs
from legorize_addon.core.model import columns, outline
from legorize_addon.core.model.catalogue import footprint
from tests.core.any_bricks import CATALOGUE, everything

INK = Paint(stroke=(0, 0, 0), width=0.1)


def inside(points, x, y):
    """Whether a point is inside of a polygon."""
    found = False
    for (a, b), (c, d) in zip(points.tolist(), np.roll(points, -1, axis=0).tolist(), strict=True):
        if (b > y) != (d > y) and x < a + (y - b) / (d - b) * (c - a):
            found = not found
    return found


def _area(points):
    """Return the area of a polygon."""
    x, y = points.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def test_outlines_hold_the_cells_of_the_parts():
    """The outline of every part in every turn holds the middles of its cells and no other of its bounding box."""
    bricks = everything()
    points, count = plan_outlines(bricks, CATALOGUE)
    ends = np.cumsum(count)
    for row, (low, high) in enumerate(zip(ends - count, ends, strict=True)):
        cells = {tuple(cell) for cell in footprint(CATALOGUE.parts[bricks.part[row]], int(bricks.turn[row])).tolist()}
        x, y, _ = bricks.corner[row].tolist()
        part = CATALOGUE.parts[bricks.part[row]]
        longest = max(part.length, part.width)
        box = product(range(longest + 1), repeat=2)
        shown = {(i, j) for i, j in box if inside(points[low:high], x + i + 0.5, y + j + 0.5)}
        if part.wedge:
            # a square that slanted sides cut into may have its middle outside
            assert shown <= cells
            assert _area(points[low:high]) == pytest.approx(_area(outline(part)))
        else:
            assert shown == cells


def studded(part, turn):
    """Return the cells of a part, and which of them have studs."""
    found = columns(part, turn)
    return found.xy.tolist(), found.stud.tolist()


def test_a_dot_for_each_stud():
    """Studs lie in the middles of the squares; tiles have none, and jumpers another place for theirs."""
    bricks = everything()
    bricks = bricks.take(~np.array([part.jumper for part in CATALOGUE.parts])[bricks.part])
    dots = plan_studs(bricks, CATALOGUE, INK).points[::2]
    expected = [
        (x + i + 0.5, y + j + 0.5)
        for (x, y, _), part, turn in zip(bricks.corner.tolist(), bricks.part, bricks.turn, strict=True)
        for (i, j), stud in zip(*studded(CATALOGUE.parts[part], int(turn)), strict=True)
        if stud
    ]
    assert sorted(map(tuple, dots.tolist())) == sorted(expected)


def test_colours_part_the_rows():
    """Every row is in exactly one colour."""
    colour = np.array([[1, 2, 3], [9, 9, 9], [1, 2, 3]])
    assert [(rgb, rows.tolist()) for rgb, rows in by_colour(colour)] == [((1, 2, 3), [0, 2]), ((9, 9, 9), [1])]


def test_hatching_covers_the_outlines():
    """The slanting lines reach over all of the outlines, which clip them."""
    points = np.array([[2.0, 3], [6, 3], [6, 5], [2, 5]])
    group = hatched(points, np.array([4]), INK)
    assert group.clip.points.tolist() == points.tolist()
    [path] = group.items
    starts, ends = path.points[::2], path.points[1::2]
    assert np.allclose(ends - starts, 2)
    assert starts[:, 0].min() <= 0
    assert ends[:, 0].max() >= 6
