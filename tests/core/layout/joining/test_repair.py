"""Holding loose bricks: joins are found where cells allow them, and nothing is lost."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.joining.repair import _REACH, _Cells, _near, _offers, connect_loose
from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.problem import with_margins
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.layout.problem.table import gather
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.progress import silent
from tests.core.layout.cells import CATALOGUE, assert_covers, brick_grid

RED, WHITE = 4, 15


def held(bricks, grid, seed=0):
    """Return the bricks after the repair."""
    codes = np.unique(grid.colour[grid.colour >= 0])
    work = [(sheets, shapes(CATALOGUE, sheets.height, codes, 71)) for sheets in split(grid)]
    return connect_loose(bricks, grid, work, CATALOGUE, np.random.default_rng(seed), silent)


def singles(grid):
    """Return every required cell as a brick of its own, in red where the colour is free."""
    layer, y, x = np.nonzero(grid.cover[:, 0] == Fill.REQUIRED)
    n = len(x)
    colour = grid.colour[layer, 0, y, x]
    return Bricks(
        np.full(n, CATALOGUE.part_row("3005"), np.int16),
        np.stack([x, y, 3 * layer], axis=1).astype(np.int32),
        np.zeros(n, np.uint8),
        np.where(colour == COLOUR_ANY, RED, colour).astype(np.int16),
        np.zeros(n, np.uint8),
        np.zeros(n, np.int16),
        (layer).astype(np.int32),
    )


def test_a_hanging_column_is_joined_to_a_standing_one():
    """A column that ends above the ground, laid in bricks of one cell, gets a brick across to its neighbour."""
    colour = np.full((4, 1, 2), RED)
    colour[0, 0, 1] = COLOUR_EMPTY
    grid = brick_grid(colour)
    before = singles(grid)
    assert contact_graph(before, CATALOGUE).n_floating == 3
    assert assert_covers(held(before, grid), grid).n_floating == 0


def test_a_wide_roof_is_tied_from_below():
    """Bricks of a roof that touch nothing are held by bricks in the optional layer below them."""
    colour = np.full((3, 6, 24), COLOUR_EMPTY)
    cover = np.full(colour.shape, Fill.EMPTY)
    colour[:2, :, 0], cover[:2, :, 0] = RED, Fill.REQUIRED
    colour[1, :, 1:], cover[1, :, 1:] = COLOUR_ANY, Fill.OPTIONAL
    walls = singles(brick_grid(colour, cover))
    colour[2], cover[2] = RED, Fill.REQUIRED
    corner = [[x, y, 6] for x in range(0, 24, 4) for y in range(0, 6, 2)]
    roof = walls.take(np.zeros(len(corner), np.intp))
    part = np.full(len(corner), CATALOGUE.part_row("3001"), np.int16)
    before = gather([walls, replace(roof, part=part, corner=np.array(corner, np.int32))])
    grid = brick_grid(colour, cover)
    assert assert_covers(before, grid).n_floating == 15
    after = assert_covers(held(before, grid), grid)
    assert after.n_floating == 0
    assert after.n_components < contact_graph(before, CATALOGUE).n_components


def test_what_cannot_be_joined_is_left_alone():
    """A column of another colour that ends above the ground floats, and no brick is changed for it."""
    colour = np.full((3, 1, 2), RED)
    colour[:, 0, 1] = [COLOUR_EMPTY, WHITE, WHITE]
    grid = brick_grid(colour)
    before = singles(grid)
    assert held(before, grid) is before


def test_bricks_on_the_ground_are_joined_too():
    """Two bricks side by side on the ground, one component of cells, become one component of bricks."""
    grid = brick_grid(np.full((2, 1, 4), RED))
    before = singles(grid)
    assert contact_graph(before, CATALOGUE).n_components == 4
    assert assert_covers(held(before, grid), grid).n_components == 1


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25)
def test_repair_keeps_the_cover(seed):
    """Whatever is joined, required cells stay covered once, and no more bricks float than before."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, RED, WHITE], (4, 6, 6))
    cover = np.where(
        colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED, Fill.REQUIRED], colour.shape)
    )
    colour[0, 0, 0], cover[0, 0, 0] = RED, Fill.REQUIRED
    grid = brick_grid(colour, cover)
    before = singles(grid)
    links = assert_covers(held(before, grid), grid)
    assert links.n_floating <= contact_graph(before, CATALOGUE).n_floating


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_offers_are_the_placements_through_loose_cells(seed):
    """Each is worth 3.5 bricks a component that it joins to another; chance decides only if there are too many."""
    rng = np.random.default_rng(seed)
    grid = brick_grid(rng.choice([COLOUR_EMPTY, RED, RED], (1, 4, 5)))
    sheets = next(iter(split(grid)), None)
    if sheets is None:
        return
    found = placements(sheets, shapes(CATALOGUE, 3, np.array([RED]), 71))
    labels = rng.choice([-1, -1, 0, 0, 1, 2, 3], (3, len(sheets.cells)))
    all_of = [found.cells[found.start[row] : found.start[row + 1]] for row in range(len(found))]
    expected = [row for row, cells in enumerate(all_of) if (labels[:, cells] > 0).any()]
    most = max(len(expected) + int(rng.integers(-3, 2)), 1)
    before = deepcopy(rng)
    rows, reward = _offers(found, labels.astype(np.int32), most, rng)
    assert len(rows) == min(most, len(expected))
    assert set(rows.tolist()) <= set(expected)
    assert (np.diff(rows) > 0).all()
    assert (rng.random() == before.random()) == (len(expected) <= most)
    joins = [len(set(labels[:2, all_of[row]].ravel().tolist()) - {-1}) for row in rows]
    assert reward.tolist() == [3.5 * max(each - 1, 0) for each in joins]


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_cells_near_loose_ones_and_planes_that_they_reach(seed):
    """Near is what is eight studs away at most; a plane is reached if a loose brick is in it."""
    rng = np.random.default_rng(seed)
    loose = rng.random((2, 12, 25)) < rng.choice([0, 0.01, 0.03])
    places = np.argwhere(loose)
    sheet, y, x = np.indices(loose.shape)
    near = np.zeros(loose.shape, bool)
    for k, b, a in places:
        near |= (sheet == k) & (np.abs(y - b) <= _REACH) & (np.abs(x - a) <= _REACH)
    np.testing.assert_array_equal(_near(loose), near)
    grid = brick_grid(rng.choice([COLOUR_EMPTY, RED], (4, 2, 3)))
    bricks = singles(grid)
    if not len(bricks):
        return
    links, required = contact_graph(bricks, CATALOGUE), with_margins(grid.cover == Fill.REQUIRED, False)
    loose = rng.random(links.n_components)[links.component] < 0.3
    cells = _Cells.of(bricks, links, required, loose, CATALOGUE)
    planes = {1 + z + k for z in bricks.corner[loose, 2].tolist() for k in range(3)}
    assert set(np.flatnonzero(cells.reached).tolist()) == planes
    assert cells.n_loose == loose.sum()
    assert cells.label.tolist() == [*np.where(loose, links.component + 1, 0).tolist(), -1, -1]
