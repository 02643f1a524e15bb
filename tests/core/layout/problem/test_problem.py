"""What laying costs: one for a brick, more for what holds badly, less for what bridges seams."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.problem import GROUND, pose, standing, with_margins
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import Fill
from tests.core.layout.cells import CATALOGUE, brick_grid
from tests.core.standing import table


def row_problem(below, cover=None):
    """Pose the problem of a row of four red cells over a plane of owners."""
    grid = brick_grid(np.full((1, 1, 4), 4), cover)
    (sheets,) = split(grid)
    among = shapes(CATALOGUE, 3, np.array([4]), 71)
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    owner = np.full(required.shape, NOBODY, np.int32)
    owner[0] = below
    return pose(sheets, among, placements(sheets, among), owner, required)


def cost_at(problem, size, x):
    """Return the cost of the straight brick of a size that starts at x."""
    found = problem.placements
    [row] = np.flatnonzero((found.size == size) & (found.corner[:, 0] == x))
    return problem.cost[row]


def test_a_brick_on_the_ground_costs_one():
    """A larger brick costs one, a 1 x 1 twice as much, wherever they lie."""
    problem = row_problem(GROUND)
    assert cost_at(problem, 4, 0) == pytest.approx(1)
    assert [cost_at(problem, 1, x) for x in range(4)] == pytest.approx([2] * 4)


def test_hanging_costs_more():
    """What has nothing below and nothing above costs two bricks more."""
    hanging, standing = row_problem(NOBODY), row_problem(GROUND)
    assert cost_at(hanging, 2, 1) == pytest.approx(cost_at(standing, 2, 1) + 2)


def test_holding_to_one_brick_alone_costs_more():
    """A brick that lies on a single one, with nothing above, costs more than one across two or on the ground."""
    lying = row_problem([7, 7, 7, 7])
    assert cost_at(lying, 2, 0) == pytest.approx(1.2)
    assert cost_at(row_problem([7, 8, 8, 8]), 2, 0) < 1
    assert cost_at(row_problem(GROUND), 2, 0) == pytest.approx(1)


def test_bridging_a_seam_pays():
    """A brick across the seam between two bricks below is cheaper than one beside it."""
    problem = row_problem([7, 7, 8, 8])
    assert cost_at(problem, 2, 1) < cost_at(problem, 2, 0) == cost_at(problem, 2, 2)


def test_optional_cells_cost_a_little():
    """Each cell that need not be covered costs a little, far less than a brick."""
    cover = np.array([[[Fill.REQUIRED, Fill.OPTIONAL, Fill.OPTIONAL, Fill.REQUIRED]]])
    problem = row_problem(GROUND, cover)
    assert 1 < cost_at(problem, 2, 0) < cost_at(problem, 3, 0) < 1.05


def test_ground_is_below_the_lowest_must_cell():
    """Bricks stand in the planes of their cells; all planes below the lowest cell that must be built are ground."""
    required = np.zeros((7, 1, 2), dtype=bool)
    required[3:6] = True
    owner = standing(contact_graph(table(("3004", 0, 0, 2)), CATALOGUE), required)
    assert (owner[:3] == GROUND).all()
    assert (owner[3:6] == 0).all()
    assert (owner[6] == NOBODY).all()


def test_margins_are_one_plane_on_either_side():
    """The planes of a grid get one more below and one more above."""
    cells = np.arange(2 * 3 * 2 * 2).reshape(2, 3, 2, 2)
    padded = with_margins(cells, -1)
    assert padded.shape == (8, 2, 2)
    np.testing.assert_array_equal(padded[1:-1], cells.reshape(6, 2, 2))
    assert (padded[[0, -1]] == -1).all()
