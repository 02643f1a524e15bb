"""Shares of the parts of cells: exact for boxes and slopes, all of them together for cells of any size."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.slicing import fine_cut
from legorize_addon.core.slicing.fine_cut import ACROSS, UP, fine_shares
from legorize_addon.core.units import PLATE, STUD
from tests.core.slopes.ramps import ramp
from tests.core.solids import box


def test_a_box_fills_its_parts():
    """A box that ends within a cell fills the parts of the cell as far as it reaches."""
    mesh = box((0, 0, 0), (1.375 * STUD, STUD, PLATE * 1.5))
    cells = np.ones((2, 1, 2), bool)
    shares = fine_shares(mesh, np.zeros(3), cells).reshape(2, 2, UP, ACROSS, ACROSS)
    np.testing.assert_allclose(shares[0, 0], 1, atol=1e-6)
    np.testing.assert_allclose(shares[0, 1], np.broadcast_to([1, 0.5, 0, 0], (UP, ACROSS, ACROSS)), atol=1e-6)
    # the cuts go through the middles of the halves of a plate
    assert shares[1, 0, 0].min() > 0.999
    assert shares[1, 0, 1].max() == 0


def test_only_the_cells_that_are_asked_for():
    """Cells come in the order of the grid, and slabs of any size tell the same."""
    mesh, rng = ramp(), np.random.default_rng(0)
    cells = rng.random((7, 6, 8)) < 0.4
    every = fine_shares(mesh, np.zeros(3), np.ones_like(cells))
    np.testing.assert_array_equal(fine_shares(mesh, np.zeros(3), cells), every[cells.reshape(-1)])


def test_slabs_tell_the_same(monkeypatch):
    """Cut plate by plate, the shares are the same."""
    mesh, cells = ramp(), np.ones((7, 6, 8), bool)
    whole = fine_shares(mesh, np.zeros(3), cells)
    monkeypatch.setattr(fine_cut, "_SLAB", 1)
    np.testing.assert_allclose(fine_shares(mesh, np.zeros(3), cells), whole, atol=1e-6)


def test_the_volume_of_a_ramp():
    """All parts together have the volume of the mesh, but for what the steps of the cuts lose on its slope."""
    shares = fine_shares(ramp(), np.zeros(3), np.ones((6, 6, 8), bool))
    area = 6 * 6 - 2.5 / 2
    assert abs(shares.mean(axis=(1, 2, 3)).sum() - 4 * area) < 0.05
