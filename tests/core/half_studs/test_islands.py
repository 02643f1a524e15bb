"""Islands: what hangs together in a layer, how it fits the phases of a grid, and what lies on what."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.half_studs.islands import PHASES, find_islands
from legorize_addon.core.slicing.lattice import fit_grid
from tests.core.half_studs.tower import BLOCK, tower
from tests.core.solids import box, joined, sphere


def islands_of(mesh):
    """Find the islands of a mesh on its usual grid."""
    grid = fit_grid(mesh, symmetric=True, plates=True)
    return grid, find_islands(mesh, grid)


@pytest.mark.parametrize("off", [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)])
def test_a_tower_fits_the_phase_that_it_lies_in(off):
    """Its layers err in none of their plates there, and half of a row elsewhere; the block fits the grid."""
    _, found = islands_of(tower(*off))
    assert found.layer.tolist() == list(range(BLOCK + 4))
    phase = PHASES.index(tuple(int(2 * each) for each in off))
    assert found.error[:BLOCK, 0] == pytest.approx(0, abs=1e-6)
    assert found.error[BLOCK:, phase] == pytest.approx(0, abs=1e-6)
    wrong = np.delete(np.arange(4), phase)
    # half a stud off along one side, two rows of three cells are half full in each of three plates
    assert found.error[BLOCK:, wrong].min() == pytest.approx(9)


def test_what_lies_on_what():
    """Layers of the tower lie on each other with all of their nine studs."""
    _, found = islands_of(tower())
    assert found.links.tolist() == [[n, n + 1] for n in range(BLOCK + 3)]
    assert found.overlap == pytest.approx([36, 36, 9, 9, 9, 9])


def test_bricks_would_lie_where_the_mesh_is():
    """The cells of the tower in its phase are its nine, in half studs from the corner of the raster."""
    grid, found = islands_of(tower(0.5, 0.0))
    place = found.cells[BLOCK][PHASES.index((1, 0))]
    corner = (np.array([12, 8]) - grid.origin[:2]) / 4 + 4
    assert sorted(map(tuple, (place - corner).tolist())) == [(x, y) for x in (0, 2, 4) for y in (0, 2, 4)]


def test_two_bodies_are_two_islands():
    """A column beside another one is an island in each layer; nearest says whose each square is."""
    mesh = joined(box((0, 0, 0), (16, 16, 19.2)), box((32, 0, 0), (48, 16, 9.6)))
    _, found = islands_of(mesh)
    assert found.layer.tolist() == [0, 0, 1]
    near, far = found.nearest
    y, x = found.squares(np.array([[8.0, 8.0], [30.0, 8.0], [46.0, 8.0]]))
    assert near[0, y, x].tolist() == [0, 1, 1]
    assert near[1, y, x].tolist() == [2, 2, 2]
    assert far[0, y, x] == pytest.approx([0, 0.25, 0])


def test_large_models_are_cut_in_parts(monkeypatch):
    """A few layers at a time give the same islands."""
    ball = sphere(12, 40)
    grid, whole = islands_of(ball)
    monkeypatch.setattr("legorize_addon.core.half_studs.islands._SQUARES", 20_000)
    parts = find_islands(ball, grid)
    np.testing.assert_allclose(parts.error, whole.error)
    assert (parts.label == whole.label).all()
