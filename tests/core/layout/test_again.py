"""Laid again: the same cells, the same colours from outside, never more parts."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import BuildError
from legorize_addon.core.layout.again import as_good, cells_of, faithful, lay_again, phases
from legorize_addon.core.layout.lay import lay
from legorize_addon.core.model.catalogue import footprint
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.any_bricks import CATALOGUE, table

ROW = CATALOGUE.part_row
ONE, PLATE, TALL = ROW("3005"), ROW("3024"), ROW("14716")


def lay_quickly(grid):
    """Cover a grid by the fast layout."""
    return lay(grid, CATALOGUE, rng=np.random.default_rng(0), tier="fast")


def shown(bricks):
    """Return the colour of each cell that can be seen, and None of those that cannot, by brute force."""
    cells = {}
    for part, (x, y, z), turn, colour in zip(
        bricks.part, bricks.corner.tolist(), bricks.turn, bricks.colour, strict=True
    ):
        for i, j in footprint(CATALOGUE.parts[part], int(turn)).tolist():
            for k in range(CATALOGUE.parts[part].height):
                assert (x + i, y + j, z + k) not in cells
                cells[x + i, y + j, z + k] = int(colour)
    low = np.array(list(cells)).min(axis=0) - 1
    high = np.array(list(cells)).max(axis=0) + 1
    air, agenda = set(), [tuple(low)]
    while agenda:
        cell = agenda.pop()
        if cell in air or cell in cells or (np.array(cell) < low).any() or (np.array(cell) > high).any():
            continue
        air.add(cell)
        agenda += near(cell)
    return {cell: colour if air & set(near(cell)) else None for cell, colour in cells.items()}


def near(cell):
    """Return the six cells beside one."""
    return [
        tuple(int(at) + step * (axis == each) for each, at in enumerate(cell)) for axis in range(3) for step in (-1, 1)
    ]


@st.composite
def blocks(draw):
    """Draw a block of columns of bricks, plates and tall bricks that begin a few plates up, in two colours."""
    rows = []
    for x in range(draw(st.integers(1, 3))):
        for y in range(draw(st.integers(1, 3))):
            level = draw(st.integers(0, 2))
            for part in draw(st.lists(st.sampled_from([ONE, PLATE, TALL]), max_size=4)):
                rows.append((part, x, y, level, 0, draw(st.sampled_from([4, 15])), 0, 0, 0))
                level += CATALOGUE.parts[part].height
    return table(rows or [(ONE, 0, 0, 0, 0, 4, 0, 0, 0)])


@settings(deadline=None, max_examples=25)
@given(blocks())
def test_laid_again_is_the_same_model(bricks):
    """Whatever it is: the same cells, the same colours where they can be seen, no more parts, no more components."""
    laid = lay_again(bricks, CATALOGUE, lay_quickly)
    assert shown(laid) == shown(bricks)
    assert len(laid) <= len(bricks)
    one, other = contact_graph(laid, CATALOGUE), contact_graph(bricks, CATALOGUE)
    assert one.n_components <= other.n_components
    assert one.n_floating <= other.n_floating
    assert not one.collisions
    assert laid is bricks or len(laid) < len(bricks)


def test_hidden_cells_are_free():
    """Of a block of 3 x 3 x 3 bricks all cells are required, the one inside in any colour; empty ones stay empty."""
    bricks = table([(ONE, x, y, 3 * z, 0, 4, 0, 0, 0) for x in range(3) for y in range(3) for z in range(3)])
    grid = cells_of(bricks, CATALOGUE, below=1)
    assert grid.colour.shape == (4, 3, 3, 3)
    planes = grid.colour.reshape(-1, 3, 3)
    assert (planes[[0, 10, 11]] == COLOUR_EMPTY).all()
    # a plate below the top and above the bottom
    assert (planes[2:9, 1, 1] == COLOUR_ANY).all()
    assert (planes == 4).sum() == 9 * 9 - 7
    assert (grid.cover == np.where(grid.colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED)).all()


def test_layers_begin_where_bricks_do():
    """Bricks a plate above the ground are tried with two planes below them first; plates alone in all ways."""
    bricks = table([(PLATE, 0, 0, 0, 0, 4, 0, 0, 0), *((ONE, 0, 0, 1 + 3 * z, 0, 4, 0, 0, 0) for z in range(3))])
    assert phases(bricks, CATALOGUE) == [2]
    assert phases(table([(ONE, 0, 0, 0, 0, 4, 0, 0, 0), (ONE, 1, 0, 1, 0, 4, 0, 0, 0)] * 2), CATALOGUE) == [0, 2]
    assert phases(table([(PLATE, 0, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE) == [0, 1, 2]
    # 2 x 2 columns: a plate and three bricks each become a 2 x 2 plate and three 2 x 2 bricks, or fewer
    many = table(
        [(p, x, y, z, 0, 4, 0, 0, 0) for x in (0, 1) for y in (0, 1) for p, z in ((PLATE, 0), (ONE, 1), (ONE, 4))]
    )
    assert len(lay_again(many, CATALOGUE, lay_quickly)) == 3


def test_best_layout_is_kept():
    """One brick cannot be laid better: it is handed back itself; nor is a layout taken that cannot be laid."""
    one = table([(ROW("3001"), 0, 0, 0, 0, 4, 0, 0, 0)])
    assert lay_again(one, CATALOGUE, lay_quickly) is one

    def impossible(grid):
        """Refuse."""
        raise BuildError("No part is made in this colour.")

    two = table([(ONE, 0, 0, 0, 0, 4, 0, 0, 0), (ONE, 1, 0, 0, 0, 4, 0, 0, 0)])
    assert lay_again(two, CATALOGUE, impossible) is two
    assert len(lay_again(two, CATALOGUE, lay_quickly)) == 1


def test_what_shows_otherwise_is_not_faithful():
    """Another colour outside, a cell more or less, or a place beside is another model; a colour inside is not."""
    rows = [(ONE, x, y, 3 * z, 0, 4, 0, 0, 0) for x in range(3) for y in range(3) for z in range(3)]
    block = table(rows)
    inside, outside = (
        [(*row[:5], 15, 0, 0, 0) if row[1:4] == at else row for row in rows] for at in ((1, 1, 3), (0, 1, 3))
    )
    assert faithful(table(inside), block, CATALOGUE)
    assert not faithful(table(outside), block, CATALOGUE)
    assert not faithful(table(rows[1:]), block, CATALOGUE)
    assert not faithful(table([*rows, (ONE, 0, 0, 9, 0, 4, 0, 0, 0)]), block, CATALOGUE)
    assert not faithful(table([(row[0], row[1] + 1, *row[2:]) for row in rows]), block, CATALOGUE)


def test_what_falls_apart_is_not_as_good():
    """Two bricks side by side show what one of two studs shows, but are two components."""
    whole = table([(ROW("3004"), 0, 0, 0, 0, 4, 0, 0, 0)])
    halves = table([(ONE, 0, 0, 0, 0, 4, 0, 0, 0), (ONE, 1, 0, 0, 0, 4, 0, 0, 0)])
    assert as_good(whole, halves, CATALOGUE)
    assert not as_good(halves, whole, CATALOGUE)


def test_tiles_and_large_plates_stay():
    """A row of bricks under tiles becomes one brick; the tiles, which have no studs, and large plates stay."""
    tile, large = ROW("3070b"), ROW("3031")
    rows = [(large, 0, 0, 0, 0, 2, 0, 0, 0)]
    rows += [(ONE, x, 0, 1, 0, 4, 0, 0, 0) for x in range(4)] + [(tile, x, 0, 4, 0, 15, 0, 0, 0) for x in range(4)]
    given = table(rows)
    laid = lay_again(given, CATALOGUE, lay_quickly)
    assert sorted(CATALOGUE.parts[part].number for part in laid.part) == ["3010", "3031", *["3070b"] * 4]
    assert shown(laid) == shown(given)
    alone = table(rows[:1])
    assert lay_again(alone, CATALOGUE, lay_quickly) is alone
