"""Parts that touch at an edge or a corner are joined face to face, and nothing else is touched."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from legorize_addon.core.bridges import bridging_cells


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
