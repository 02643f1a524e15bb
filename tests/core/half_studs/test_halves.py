"""Half studs of cells: those of the islands whose bricks would lie there, on a grid with room for what is moved."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.half_studs.halves import grid_together, halves_in, halves_of
from legorize_addon.core.half_studs.islands import PHASES, find_islands
from legorize_addon.core.half_studs.moving import draw_together
from legorize_addon.core.half_studs.regions import Choice, choose_regions
from legorize_addon.core.slicing.lattice import fit_grid
from legorize_addon.core.units import BRICK, STUD
from tests.core.half_studs.tower import BLOCK, table, tower


def chosen(mesh):
    """Choose regions on the usual grid."""
    grid = fit_grid(mesh, symmetric=True, plates=True)
    islands = find_islands(mesh, grid)
    return grid, islands, choose_regions(islands, price=1.0, anywhere=False)


@pytest.mark.parametrize("forward", [(0, 0), (1, 1)])
@pytest.mark.parametrize("make", [tower, table])
def test_set_apart_the_cells_lie_where_the_mesh_is(make, forward):
    """All of the mesh that is drawn together lies on whole cells, which their half studs move to where it was."""
    mesh = make(0.5)
    grid, islands, choice = chosen(mesh)
    choice = choice._replace(forward=forward)
    together = grid_together(grid, choice)
    half = halves_of(choice, islands)
    drawn = draw_together(mesh, float(grid.origin[2]), islands, half)
    away = (drawn.vertices[:, :2] - together.origin[:2]) / STUD
    leaning = np.abs(drawn.vertices[:, 2] / BRICK - BLOCK + 1 / 6) < 0.2
    np.testing.assert_allclose(away[~leaning], np.round(away[~leaning]), atol=1e-9)
    # with a free row of cells on every side
    assert away.min() >= 1
    assert (away.max(axis=0) <= (together.n_x - 1, together.n_y - 1)).all()
    halves = halves_in(together, islands, choice)
    assert halves.half.shape == together.shape
    for number, label in enumerate(islands.label):
        for island in np.unique(label[label >= 0]).tolist():
            y, x = np.argwhere(label == island).mean(axis=0)
            true = islands.corner + (np.array([x, y]) + 0.5) * STUD / 4
            cell = np.floor((true - together.origin[:2]) / STUD - half[island] / 2).astype(int)
            assert halves.at(np.array([[*cell, number]]))[0].tolist() == half[island].tolist()


def test_half_studs_of_a_model_that_begins_higher():
    """Layers without a cell are left out; regions are still known by their layers."""
    mesh = tower()
    grid, islands, choice = chosen(mesh)
    halves = halves_in(grid_together(grid, choice), islands, choice)
    n_layers, n_y, n_x = halves.half.shape
    higher = halves.lying_in(halves.origin + np.array([0, 0, BRICK]), (n_layers - 1, n_y, n_x))
    assert higher.half.tolist() == halves.half[1:].tolist()
    assert halves.near(np.array([BLOCK])) == higher.near(np.array([BLOCK - 1])) == choice.regions
    assert halves.lying_in(halves.origin.copy(), halves.half.shape) is halves


def test_half_studs_of_a_grid_with_room_for_feet():
    """Cells keep theirs, and those around have those of the nearest."""
    mesh = tower()
    grid, islands, choice = chosen(mesh)
    halves = halves_in(grid_together(grid, choice), islands, choice)
    n_layers, n_y, n_x = halves.half.shape
    wider = halves.lying_in(halves.origin - np.array([0, 2 * STUD, 0]), (n_layers, n_y + 4, n_x))
    assert wider.half.tolist() == np.pad(halves.half, ((0, 0), (2, 2), (0, 0)), mode="edge").tolist()
    assert wider.below == 0


def test_nothing_is_moved_without_regions():
    """The grid of all may lie half a stud further on, with a row of cells more."""
    mesh = tower()
    grid, islands, _ = chosen(mesh)
    for base in PHASES:
        choice = Choice(base, (1, 1), np.zeros(len(islands.layer), np.int64), ())
        together = grid_together(grid, choice)
        assert (together.n_x - grid.n_x, together.n_y - grid.n_y) == base
        assert ((grid.origin - together.origin)[:2] * 2 / STUD).tolist() == list(base)
