"""What an edit is about: cells, a brick, words; and what no edit may ask for."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.edits import check_edit, edit_of
from legorize_addon.core.errors import BuildError, EditError
from tests.core.any_bricks import CATALOGUE, everything, table
from tests.core.edits.models import BRICK_2X4, RED, ROW, edit, wall


def test_cells_of_a_turned_part():
    """Turned by a quarter, a 2 x 4 brick is four studs deep, and three plates high."""
    cells = edit("lock", BRICK_2X4, (3, 5, 6), turn=1).cells(CATALOGUE)
    assert cells == {(x, y, z) for x in (3, 4) for y in (5, 6, 7, 8) for z in (6, 7, 8)}


def test_a_brick_is_found_again():
    """The edit of a brick, whatever its part and turn, finds this brick alone in the table."""
    bricks = everything()
    for row in range(len(bricks)):
        assert edit_of("lock", bricks, row, CATALOGUE).rows_of(bricks, CATALOGUE).tolist() == [row]


def test_half_turns_are_the_same():
    """A brick that is turned by half a turn is the same brick; in another colour it is not."""
    bricks = table([(ROW(BRICK_2X4), 0, 0, 0, 2, RED, 0, 0, 0)])
    assert len(edit("lock", BRICK_2X4, (0, 0, 0)).rows_of(bricks, CATALOGUE)) == 1
    assert len(edit("lock", BRICK_2X4, (0, 0, 0), colour=15).rows_of(bricks, CATALOGUE)) == 0
    assert len(edit("lock", BRICK_2X4, (0, 0, 0), colour=15).rows_of(bricks, CATALOGUE, coloured=False)) == 1
    assert len(edit("lock", BRICK_2X4, (0, 0, 0), turn=1).rows_of(bricks, CATALOGUE)) == 0


def test_the_brick_of_an_edit():
    """It lies where the edit says, and its step is its layer."""
    brick = edit("force", BRICK_2X4, (1, 2, 6), turn=1).brick(CATALOGUE)
    assert brick.corner.tolist() == [[1, 2, 6]]
    assert (brick.part[0], brick.turn[0], brick.colour[0], brick.step[0]) == (ROW(BRICK_2X4), 1, RED, 2)
    assert [column.dtype for column in (brick.part, brick.corner, brick.step)] == [np.int16, np.int32, np.int32]


def test_words():
    """Place and colour are told as people count, from 1."""
    told = edit_of("recolour", wall(), 3, CATALOGUE, 15).told(CATALOGUE)
    assert edit_of("recolour", wall(), 3, CATALOGUE, 15).what(CATALOGUE) == "Recolour Brick 2 x 4 to White"
    assert told == "Recolour Brick 2 x 4 to White in layer 2 at column 7, row 1 of the grid"
    assert edit("delete", BRICK_2X4, (0, 0, 0)).told(CATALOGUE).startswith("Delete Brick 2 x 4 in layer 1")


def test_what_cannot_be_laid():
    """A base of mosaics, a part in a colour that it is not made in, and unknown parts and colours are refused."""
    part, colour = next(
        (part, colour)
        for row, part in enumerate(CATALOGUE.parts)
        for column, colour in enumerate(CATALOGUE.colours)
        if part.use == "model" and not CATALOGUE.exists[row, column]
    )
    with pytest.raises(EditError, match=f"{part.title} is not made in {colour.name}"):
        check_edit(edit("force", part.number, (0, 0, 0), colour.code), CATALOGUE)
    base = next(part for part in CATALOGUE.parts if part.use == "base")
    with pytest.raises(EditError, match="not laid by hand"):
        check_edit(edit("lock", base.number, (0, 0, 0)), CATALOGUE)
    with pytest.raises(BuildError, match="Part nothing"):
        check_edit(edit("delete", "nothing", (0, 0, 0)), CATALOGUE)
    with pytest.raises(BuildError, match="Colour 12345"):
        check_edit(edit("recolour", BRICK_2X4, (0, 0, 0), 12345), CATALOGUE)
    check_edit(edit("forbid", base.number, (0, 0, 0)), CATALOGUE)
