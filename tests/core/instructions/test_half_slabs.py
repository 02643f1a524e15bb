"""Slabs of pictures: drawn from the farthest to the nearest, each moved by half a stud."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.instructions.half_slabs import slab_numbers, slabs_of
from legorize_addon.core.instructions.lattice import FRONT, Cells, View, look
from legorize_addon.core.instructions.picture import PLATE, STUD, Look
from legorize_addon.core.instructions.slopes import draw_all
from tests.core.half_studs.test_truth import CATALOGUE, GOOD, HALVES, model, set_apart

BRICKS = set_apart(model(*GOOD), HALVES).bricks


def sight(bricks, view=FRONT):
    """Look at bricks."""
    return look(Cells.of(bricks, CATALOGUE, view), len(bricks))


def test_bricks_on_one_grid_are_one_slab():
    """Nothing is drawn apart, whether half studs are known or not."""
    seen = sight(replace(BRICKS, half=None))
    assert [slab.sight for slab in slabs_of(seen)] == [seen]
    seen = sight(replace(BRICKS, half=np.zeros_like(BRICKS.half)))
    assert [slab.sight for slab in slabs_of(seen)] == [seen]


@pytest.mark.parametrize("view", [View(turns, below) for turns in range(4) for below in (False, True)])
def test_slabs_are_moved_as_whole_studs_are(view):
    """Two half studs go as far in a picture as the next cell; from below, the upper slab comes first."""
    cells = Cells.of(BRICKS, CATALOGUE, view)
    assert slab_numbers(cells).tolist() == [int(view.below) ^ int(brick == 4) for brick in cells.brick.tolist()]
    slabs = list(slabs_of(sight(BRICKS, view)))
    assert [bool(slab.by.any()) for slab in slabs] == ([True, False] if view.below else [False, True])
    one = replace(BRICKS.take(np.array([4])), half=None)
    next_one = replace(one, corner=one.corner + np.array([1, 0, 0], np.int32))
    looks = Look(np.array([[9, 9, 9]]), np.ones(1, bool))
    before, after = (draw_all(sight(each, view), looks) for each in (one, next_one))
    [by] = [slab.by for slab in slabs if slab.by.any()]
    np.testing.assert_allclose(after.low - before.low, 2 * by)


def test_the_picture_has_the_brick_half_a_stud_on():
    """Its right edge is that of the brick on the grid, moved."""
    looks = Look(np.full((5, 3), 99), np.ones(5, bool))
    upper = np.array([4])
    moved = draw_all(sight(BRICKS.take(upper)), Look(looks.colour[:1], looks.new[:1]))
    still = draw_all(sight(replace(BRICKS, half=None).take(upper)), Look(looks.colour[:1], looks.new[:1]))
    assert np.abs(moved.low - still.low).tolist() == [STUD[0] / 2, STUD[1] / 2]
    assert np.ptp([moved.low[1], moved.high[1]]) == np.ptp([still.low[1], still.high[1]]) >= 3 * PLATE


@pytest.mark.parametrize("turns", range(4))
def test_beside_each_other_the_nearer_slab_comes_last(turns):
    """Two columns in one layer, one half a stud off: whichever is nearer to the viewer is drawn over the other."""
    bricks = model(("3005", 0, 0, 0), ("3005", 2, 0, 0)).bricks
    bricks = replace(bricks, half=np.array([[0, 0], [1, 0]], np.uint8))
    cells = Cells.of(bricks, CATALOGUE, View(turns))
    nearer = cells.brick[cells.place[:, :2].sum(axis=1).argmax()]
    number = slab_numbers(cells)
    assert set(number[cells.brick == nearer].tolist()) == {1}
    assert set(number[cells.brick != nearer].tolist()) == {0}


def test_a_column_beside_a_tower_is_drawn_layer_by_layer():
    """A brick in front of the tower is hidden by nothing of its own layer, but by what lies above and before it."""
    rows = [("3005", 0, 0, 3 * layer) for layer in range(3)] + [("3005", 0, 2, 3)]
    bricks = model(*rows).bricks
    bricks = replace(bricks, half=np.array([[0, 0]] * 3 + [[1, 0]], np.uint8))
    cells = Cells.of(bricks, CATALOGUE, View(0))
    number = [int(slab_numbers(cells)[cells.brick == row][0]) for row in range(4)]
    assert number == [0, 0, 2, 1]
