"""Slabs of pictures: drawn from the farthest to the nearest, each moved by half a stud."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.instructions.half_slabs import slab_numbers, slabs_of
from legorize_addon.core.instructions.lattice import FRONT, Cells, View, look
from legorize_addon.core.instructions.picture import PLATE, STUD, Look
from legorize_addon.core.instructions.slopes import draw_all
from tests.core.half_studs.test_truth import CATALOGUE, GOOD, PLANES, model, set_apart

BRICKS = set_apart(model(*GOOD), PLANES).bricks


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
    assert slab_numbers(BRICKS).tolist() == [0, 0, 0, 1]
    slabs = list(slabs_of(sight(BRICKS, view)))
    assert [bool(slab.by.any()) for slab in slabs] == ([True, False] if view.below else [False, True])
    one = replace(BRICKS.take(np.array([3])), half=None)
    next_one = replace(one, corner=one.corner + np.array([1, 0, 0], np.int32))
    looks = Look(np.array([[9, 9, 9]]), np.ones(1, bool))
    before, after = (draw_all(sight(each, view), looks) for each in (one, next_one))
    [by] = [slab.by for slab in slabs if slab.by.any()]
    np.testing.assert_allclose(after.low - before.low, 2 * by)


def test_the_picture_has_the_brick_half_a_stud_on():
    """Its right edge is that of the brick on the grid, moved."""
    looks = Look(np.full((4, 3), 99), np.ones(4, bool))
    upper = np.array([3])
    moved = draw_all(sight(BRICKS.take(upper)), Look(looks.colour[:1], looks.new[:1]))
    still = draw_all(sight(replace(BRICKS, half=None).take(upper)), Look(looks.colour[:1], looks.new[:1]))
    assert np.abs(moved.low - still.low).tolist() == [STUD[0] / 2, STUD[1] / 2]
    assert np.ptp([moved.low[1], moved.high[1]]) == np.ptp([still.low[1], still.high[1]]) >= 3 * PLATE
