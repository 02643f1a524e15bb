"""Parts that touch at an edge or a corner are joined face to face, and nothing else is touched."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from legorize_addon.core.unit_bricks.bridges import bridging_cells, under_steps


def model(*cells: tuple[int, int, int]) -> np.ndarray:
    """Make a small model of some cells."""
    solid = np.zeros((4, 4, 4), dtype=bool)
    solid[tuple(np.array(cells).T)] = True
    return solid


@pytest.mark.parametrize(("far", "added"), [((1, 1, 0), 1), ((1, 0, 1), 1), ((0, 1, 1), 1), ((1, 1, 1), 2)])
def test_diagonal_neighbours_are_joined(far, added):
    """Across an edge it takes one cell, across a corner two."""
    solid = model((0, 0, 0), far)
    bridge = bridging_cells(solid, np.ones(solid.shape))
    assert bridge.sum() == added
    assert ndimage.label(solid | bridge)[1] == 1


@pytest.mark.parametrize("better", [(1, 0, 0), (0, 1, 0)])
def test_the_way_with_more_surface_is_taken(better):
    """Of the two cells beside an edge the one that holds more of the mesh is added."""
    solid = model((0, 0, 0), (1, 1, 0))
    surface = np.zeros(solid.shape)
    surface[better] = 1
    np.testing.assert_array_equal(np.argwhere(bridging_cells(solid, surface)), [better])


def test_what_is_joined_or_apart_is_left_alone():
    """Cells that meet elsewhere, and parts with a gap between them, get nothing."""
    joined, apart = model((0, 0, 0), (1, 0, 0), (1, 1, 0)), model((0, 0, 0), (2, 0, 0))
    for solid in (joined, apart):
        assert not bridging_cells(solid, np.ones(solid.shape)).any()


@given(arrays(bool, (4, 5, 4), elements=st.booleans()))
def test_touching_parts_become_one(solid):
    """Afterwards parts that touch at all are connected face to face, and every old cell is still there."""
    bridge = bridging_cells(solid, np.ones(solid.shape))
    assert not (bridge & solid).any()
    faces, touching = ndimage.label(solid | bridge)[1], ndimage.label(solid | bridge, np.ones((3, 3, 3)))[1]
    assert faces == touching <= ndimage.label(solid, np.ones((3, 3, 3)))[1]


@pytest.mark.parametrize("axis", [1, 2])
@pytest.mark.parametrize("way", [1, -1])
def test_thin_stair_gets_a_cell_below_each_step(axis, way):
    """A wall of four steps, one aside of the other, gets three cells, each between two that met at an edge."""
    solid = np.moveaxis(np.eye(4, dtype=bool)[:, ::way, None].repeat(5, axis=2), 1, axis)
    under = under_steps(solid)
    assert under.sum() == 3 * 5
    assert (under[:-1] <= solid[1:]).all()
    assert ndimage.label(solid)[1] == 4
    assert ndimage.label(solid | under)[1] == 1


def test_thick_stair_gets_nothing():
    """What stands on more than an edge is left alone."""
    step = np.abs(np.subtract.outer(np.arange(6), np.arange(6)))[:, :, None]
    assert not under_steps(step <= 1).any()


@given(arrays(bool, (4, 5, 4), elements=st.booleans()))
def test_no_cells_are_left_one_above_the_other_at_an_edge(solid):
    """Afterwards every two cells of the model that met at an edge across a level have a face neighbour in common."""
    under = under_steps(solid)
    assert not (under & solid).any()
    whole = solid | under
    for axis in (1, 2):
        cells, all_cells = np.moveaxis(solid, axis, 2), np.moveaxis(whole, axis, 2)
        for way in (slice(None), slice(None, None, -1)):
            upper, below = cells[1:, :, way][:, :, 1:], cells[:-1, :, way][:, :, :-1]
            beside, under_it = all_cells[1:, :, way][:, :, :-1], all_cells[:-1, :, way][:, :, 1:]
            assert (beside | under_it)[upper & below].all()
