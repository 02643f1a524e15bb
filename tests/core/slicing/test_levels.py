"""Slices and the levels that they stand for."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.slicing.lattice import Grid
from legorize_addon.core.slicing.levels import levels_of

BRICKS = Grid(np.array([0.0, 0.0, 2.0]), 3, 4, 5)
LAYER = np.array([0, 1, 1, 1, 2], np.int32)
PLATE = np.array([1, 0, 1, 2, 1], np.int8)
HEIGHTS = 2.0 + LAYER * 9.6 + (PLATE + 0.5) * 3.2


def test_bricks_take_all_slices_of_their_layer():
    """In a grid of bricks every slice stands once for its layer, for as much of its height as its share."""
    levels = levels_of(HEIGHTS, LAYER, PLATE, BRICKS)
    np.testing.assert_array_equal(levels.slice, range(5))
    np.testing.assert_array_equal(levels.level, LAYER)
    np.testing.assert_allclose(levels.thickness, [9.6, 3.2, 3.2, 3.2, 9.6])
    np.testing.assert_allclose(levels.place, (HEIGHTS - 2) / 9.6)


def test_plates_take_their_own_slice_or_the_only_one():
    """In a grid of plates a layer's three slices stand for one plate each, its only slice for all three."""
    plates = BRICKS.plates()
    assert plates.shape == (9, 4, 5)
    assert plates.height == 3.2
    levels = levels_of(HEIGHTS, LAYER, PLATE, plates)
    np.testing.assert_array_equal(levels.level, range(9))
    np.testing.assert_array_equal(levels.slice, [0, 0, 0, 1, 2, 3, 4, 4, 4])
    np.testing.assert_allclose(levels.place, np.arange(9) + 0.5)
    np.testing.assert_allclose(levels.thickness, 3.2)


def test_things_are_repeated_level_by_level():
    """Things of a slice that stands for three levels come three times, all of a level before those of the next."""
    levels = levels_of(HEIGHTS, LAYER, PLATE, BRICKS.plates())
    thing, pair = levels.standing(np.array([0, 0, 2, 4]))
    np.testing.assert_array_equal(thing, [0, 1, 2, 3, 0, 1, 3, 0, 1, 3])
    np.testing.assert_array_equal(levels.level[pair], [0, 0, 4, 6, 1, 1, 7, 2, 2, 8])


def test_nothing_stands_for_nothing():
    """Without things there is nothing to repeat."""
    thing, pair = levels_of(HEIGHTS, LAYER, PLATE, BRICKS).standing(np.zeros(0, np.int64))
    assert len(thing) == len(pair) == 0
