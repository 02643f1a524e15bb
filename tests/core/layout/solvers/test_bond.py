"""Running bond in the middle of wide areas."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.solvers.bond import running_bond
from tests.core.layout.cells import RED, WHITE, problem_of, ring


def test_running_bond_fills_the_middle():
    """Parts of a running bond are the largest, lie two studs from the edge and are shifted by half their length."""
    problem = problem_of(np.full((30, 30), RED))
    rows = running_bond(problem)
    found = problem.placements
    assert (found.size[rows] == 16).all()
    cells = problem.corner[found.cells[found.entries(rows)]]
    assert len(np.unique(cells, axis=0)) == len(cells) >= 0.75 * 26**2
    assert cells[:, :2].min() >= 2
    assert cells[:, :2].max() <= 27
    along = int(problem.shapes.extent[found.shape[rows[0]]].argmax())
    assert len(np.unique(found.corner[rows, along] % 8)) == 2


def test_no_running_bond_in_thin_walls():
    """Walls of two studs have no middle."""
    assert len(running_bond(problem_of(ring(40)))) == 0


def test_areas_of_two_colours_have_bonds_of_their_own():
    """No part lies within two studs of the border of two colours."""
    colour = np.full((20, 40), RED)
    colour[:, 20:] = WHITE
    problem = problem_of(colour)
    found = problem.placements
    cells = problem.corner[found.cells[found.entries(running_bond(problem))]]
    assert len(cells) > 0
    assert not np.isin(cells[:, 0], [18, 19, 20, 21]).any()


def test_the_bond_lies_across_the_seams_below():
    """Over rows along x the parts lie along y, and the other way round."""
    y, x = np.indices((30, 30))
    rows_along_x = (y // 2) * 4 + x // 8
    for below, along in ((rows_along_x, 1), (rows_along_x.T, 0)):
        problem = problem_of(np.full((30, 30), RED), owner=below.astype(np.int32))
        extent = problem.shapes.extent[problem.placements.shape[running_bond(problem)]]
        assert (extent.argmax(axis=1) == along).all()


@pytest.mark.parametrize("side", range(5, 13))
def test_parts_of_the_bond_share_no_cell(side):
    """In areas of any size, down to a middle of two by two studs, no cell is covered twice."""
    problem = problem_of(np.full((side, side), RED))
    found = problem.placements
    cells = found.cells[found.entries(running_bond(problem))]
    assert len(np.unique(cells)) == len(cells)
