"""Running bond in the middle of wide areas."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.solvers.bond import _WORTH, running_bond
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill
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


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_bond_is_the_best_of_all_lattices(seed):
    """All ways to begin rows of the longest part, along x and y, are laid out in each colour: none is worth more."""
    rng = np.random.default_rng(seed)
    colour = np.full((int(rng.integers(5, 15)), int(rng.integers(5, 20))), RED)
    colour[:, int(rng.integers(1, 20)) :] = WHITE
    colour[rng.random(colour.shape) < rng.choice([0, 0.01])] = COLOUR_EMPTY
    cover = np.where(rng.random(colour.shape) < 0.01, Fill.OPTIONAL, Fill.REQUIRED)
    problem = problem_of(colour, np.where(colour == COLOUR_EMPTY, Fill.EMPTY, cover))
    found, rows = problem.placements, running_bond(problem)
    deep = np.zeros(colour.shape, bool)
    for y, x in np.ndindex(*colour.shape):
        around = np.s_[max(y - 2, 0) : y + 3, max(x - 2, 0) : x + 3]
        whole = colour[around].shape == (5, 5) and len(set(colour[around].ravel().tolist())) == 1
        deep[y, x] = whole and colour[y, x] != COLOUR_EMPTY and (cover[around] == Fill.REQUIRED).all()
    for code in (RED, WHITE):
        parts = {}
        for row in np.flatnonzero(found.colour == code).tolist():
            (x, y, _), (a, b) = found.corner[row].tolist(), problem.shapes.extent[found.shape[row]].tolist()
            if deep[y : y + b, x : x + a].all() and min(a, b) == 2 and a * b == found.size[row]:
                parts.setdefault(max(a, b), []).append((row, (x, y), int(b > a)))
        length, worth = max(parts, default=0), {}
        for row, place, along in parts.get(length, ()):
            line, start = divmod(place[1 - along], 2)
            begin = (place[along] + line * (length // 2)) % length
            worth.setdefault((along, start, begin), []).append((_WORTH - problem.cost[row], row))
        best = max((sum(each[0] for each in rest) for rest in worth.values()), default=0)
        mine = sorted(row for row in rows.tolist() if found.colour[row] == code)
        lattices = [sorted(row for _, row in rest) for rest in worth.values()]
        assert mine in lattices if worth else mine == []
        assert sum(_WORTH - problem.cost[mine]) == pytest.approx(best)
