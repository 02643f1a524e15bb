"""Blocks of wide sheets."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.problem.blocks import SIDE, blocks


def cells_of(n_sheets, n_y, n_x):
    """Return the places of all cells of full sheets."""
    sheet, y, x = np.indices((n_sheets, n_y, n_x)).reshape(3, -1)
    return np.stack([x, y, sheet], axis=1)


@pytest.mark.parametrize(("shift", "side"), [(0, SIDE), (SIDE // 2, SIDE), (0, 7), (12, 24)])
def test_every_cell_is_in_one_block(shift, side):
    """Blocks cover all cells of all sheets once, and lie inside their windows on one sheet."""
    corner = cells_of(2, 40, 21)
    times = np.zeros(len(corner), dtype=int)
    for window, core in blocks(corner, shift, side):
        times += core
        assert window[core].all()
        assert len(np.unique(corner[window, 2])) == 1
        assert np.ptp(corner[core, :2], axis=0).max() < side
    assert (times == 1).all()


def test_neighbours_follow_each_other():
    """From block to block it is one step, also from row to row."""
    middles = np.array([corner.mean(axis=0) for corner in map(cells_of(1, 64, 64).__getitem__, _cores(64))])
    assert (np.abs(np.diff(middles[:, :2], axis=0)).sum(axis=1) == SIDE).all()


def test_blocks_without_cells_are_left_out():
    """Two far corners are two blocks."""
    assert len(list(blocks(np.array([[0, 0, 0], [99, 99, 0]])))) == 2


def _cores(side):
    return [core for _, core in blocks(cells_of(1, side, side))]
