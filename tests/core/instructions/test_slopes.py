"""Slopes in pictures: inside of their boxes, cut off by what stands before them, all else as without them."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Path
from legorize_addon.core.instructions.lattice import FRONT, Cells, View, look
from legorize_addon.core.instructions.picture import ACROSS, DOWN, Look, draw, extent
from legorize_addon.core.instructions.slopes import _faces, _normal, _shape, draw_all
from legorize_addon.core.model import footprint, solid
from tests.core.any_bricks import CATALOGUE, table

PART = {part.number: row for row, part in enumerate(CATALOGUE.parts)}
SLOPES = [part for part in CATALOGUE.parts if part.shaped]
VIEWS = [View(turns, below) for turns, below in product(range(4), (False, True))]


def seen(rows, view=FRONT):
    """Return what is seen of bricks, and how they look."""
    bricks = table([(PART[number], x, y, z, turn, 4, 0, 0, 0) for number, x, y, z, turn in rows])
    sight = look(Cells.of(bricks, CATALOGUE, view), len(bricks))
    return sight, Look(np.full((len(bricks), 3), 200), np.ones(len(bricks), dtype=bool), studs=not view.below)


def area(points):
    """Return the area of a polygon, positive counter-clockwise."""
    x, y = points.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


@pytest.mark.parametrize("part", SLOPES, ids=lambda part: part.number)
def test_faces_enclose_the_solid(part):
    """The faces are turned outwards, and their volume is that of fine samples."""
    volume = 0.0
    for points in _faces(part):
        fan = np.cross(points[1:-1], points[2:])
        volume += float((fan @ points[0]).sum()) / 6
    whole = len(footprint(part, 0)) * part.height
    assert volume == pytest.approx(solid(part, 0, 32, 32).mean() * whole, rel=0.02)


@pytest.mark.parametrize("part", SLOPES, ids=lambda part: part.number)
def test_shapes_lie_within_their_cells(part):
    """From all sides the faces turned to the viewer cover a part of what the cells of the box cover."""
    for turn, view in product(range(4), VIEWS):
        shape = _shape(part, turn, view)
        # two pieces a square; an underside in steps is drawn over itself
        shown = sum(abs(area(face)) for face in shape.faces)
        assert 0.3 * len(shape.pieces) / 2 < shown < 1.2 * len(shape.pieces) / 2
        points = np.concatenate(shape.faces)
        low, high = shape.pieces[:, :2].min(axis=0), shape.pieces[:, :2].max(axis=0) + 1
        assert (points >= low - 1e-9).all()
        assert (points <= high + 1e-9).all()


def test_pictures_without_slopes_are_as_before():
    """Without slopes, and with slopes that are not seen, nothing changes."""
    sight, looks = seen([("3001", 0, 0, 0, 0), ("3003", 1, 0, 3, 0)])
    one, other = draw_all(sight, looks), draw(sight, looks)
    assert len(one.items) == len(other.items)
    hidden, looks = seen([("30144", 0, 2, 0, 0), ("30144", 1, 4, 0, 0), ("54200", 0, 4, 0, 0)])
    assert hidden.shares[2] == 0
    assert len(draw_all(hidden, looks).items) == len(draw(hidden, looks).items)


def test_a_slope_alone_is_drawn_whole():
    """It is not cut off, and its lines and faces fill the picture from side to side."""
    sight, looks = seen([("3039", 2, 3, 4, 0)])
    picture = draw_all(sight, looks)
    assert not any(isinstance(item, Group) and item.clip for item in picture.items)
    points = np.concatenate([item.points for item in picture.items if isinstance(item, Path)])
    low, high = extent(sight)
    np.testing.assert_allclose(points.min(axis=0), low, atol=4 * DOWN)
    np.testing.assert_allclose(points.max(axis=0), high, atol=4 * ACROSS)
    assert (points >= low - 1e-9).all()
    assert (points <= high + 1e-9).all()


def test_a_slope_behind_a_brick_is_cut_off():
    """What stands before it hides it: the clip has the pieces that are left."""
    sight, looks = seen([("3039", 0, 0, 0, 0), ("3005", 1, -1, 0, 0)])
    groups = [item for item in draw_all(sight, looks).items if isinstance(item, Group) and item.clip]
    ends = np.cumsum(groups[-1].clip.count)
    loops = np.split(groups[-1].clip.points, ends[:-1])
    left = sum(abs(area(loop)) for loop in loops) / (2 * ACROSS * DOWN)
    assert left == pytest.approx(np.count_nonzero(sight.bricks == 0) / 2)


def test_nearer_slopes_are_drawn_later():
    """Of two slopes the one that stands before the other comes after it, whatever their rows."""
    for rows in ([("3040b", 0, 0, 0, 0), ("3040b", 0, -1, 0, 0)], [("3040b", 0, -1, 0, 0), ("3040b", 0, 0, 0, 0)]):
        sight, looks = seen(rows)
        paths = [item for item in draw_all(sight, looks).items if isinstance(item, Path) and item.paints[0].fill]
        # the nearer one lies lower in the picture
        half = len(paths) // 2
        assert np.mean([path.points[:, 1].mean() for path in paths[:half]]) < np.mean(
            [path.points[:, 1].mean() for path in paths[half:]]
        )


def test_normals_look_outwards():
    """The top of a plate-like face looks up."""
    assert _normal(np.array([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], dtype=float)).tolist() == [0, 0, 1]
