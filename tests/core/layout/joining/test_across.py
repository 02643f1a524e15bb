"""Ties across weak seams: where they are worth most, in no other colour, and no more than one between two parts."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.joining.across import tie_across
from legorize_addon.core.model.contacts import contact_graph
from tests.core.layout.cells import CATALOGUE, RED, WHITE, assert_covers, brick_grid
from tests.core.standing import table

WEAK = np.array([[0, 1]])


def towers(right=RED, layers=4):
    """Return two towers of 2 x 2 bricks side by side, their grid, and the part of each brick."""
    colour = np.full((layers, 2, 4), RED)
    colour[:, :, 2:] = right
    bricks = table(*(("3003", x, 0, 3 * level) for level in range(layers) for x in (0, 2)))
    shown = np.where(bricks.corner[:, 0] > 0, right, RED).astype(np.int16)
    bricks.colour[:] = shown
    return bricks, brick_grid(colour), bricks.corner[:, 0] // 2


@pytest.mark.parametrize(("sign", "end"), [(1, max), (-1, min)])
def test_tie_lies_where_it_is_worth_most(sign, end) -> None:
    """Two towers become one by one plate more than they had, as high or as low as is worth most."""
    bricks, grid, part = towers()
    tied, after = tie_across(
        bricks, grid, CATALOGUE, part, WEAK, lambda between, cells: sign * cells[:, 0].astype(float), plates=True
    )
    links = contact_graph(tied, CATALOGUE)
    assert links.n_components == 1
    assert links.collisions == 0
    assert_covers(tied, after)
    over = [row for row, (x, _, _) in enumerate(tied.corner.tolist()) if x < 2 and reach(tied, row) > 2]
    assert len(over) == 1
    # the middle plate of a brick is cut, if one is
    assert tied.corner[over[0], 2] // 3 == end(0, 3)


def reach(bricks, row):
    """Return where a brick ends along x."""
    part = CATALOGUE.parts[bricks.part[row]]
    return bricks.corner[row, 0] + (part.width if bricks.turn[row] % 2 else part.length)


def test_worth_is_asked_of_bricks_and_cells() -> None:
    """Each place is told by bricks of both parts and by a cell of the grid between them."""
    bricks, grid, part = towers()
    asked = []

    def worth(between, cells):
        asked.append((between, cells))
        return np.zeros(len(between))

    tie_across(bricks, grid, CATALOGUE, part, WEAK, worth, plates=True)
    [(between, cells)] = asked
    assert (part[between].sum(axis=1) == 1).all()
    assert (cells[:, 0] >= -1).all()
    assert cells[:, 0].max() <= 12
    assert set(cells[:, 2].tolist()) <= {1, 2}


def test_other_parts_are_left_alone() -> None:
    """Nothing is tied that is not told to be weak, and then the same bricks come back."""
    bricks, grid, part = towers()
    same, after = tie_across(
        bricks, grid, CATALOGUE, part, WEAK[:0], lambda between, _: np.zeros(len(between)), plates=True
    )
    assert same is bricks
    assert after is grid


def test_no_colour_is_given_up() -> None:
    """Between towers of two colours a plate is added at most: each cell that is seen keeps its colour."""
    bricks, grid, part = towers(WHITE)
    tied, after = tie_across(
        bricks, grid, CATALOGUE, part, WEAK, lambda between, _: np.zeros(len(between)), plates=True
    )
    links = contact_graph(tied, CATALOGUE)
    asked = grid.colour.reshape(-1, *grid.colour.shape[2:])
    owner = links.owner[: len(asked)]
    shown = np.where(asked >= 0, tied.colour[owner], asked)
    np.testing.assert_array_equal(shown, asked)
    assert_covers(tied, after)


def test_bricks_tie_where_there_may_be_no_plates() -> None:
    """Without plates a tie is a brick."""
    bricks, grid, part = towers()
    tied, _ = tie_across(bricks, grid, CATALOGUE, part, WEAK, lambda between, _: np.zeros(len(between)), plates=False)
    assert contact_graph(tied, CATALOGUE).n_components == 1
    assert {CATALOGUE.parts[row].height for row in tied.part} == {3}
