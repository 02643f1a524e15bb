"""The later of two edits rules the cells that they share."""

from __future__ import annotations

import pytest

from legorize_addon.core.edits import rules_of
from tests.core.any_bricks import CATALOGUE
from tests.core.edits.models import BRICK_1X1, BRICK_2X2, BRICK_2X4, WHITE, edit


def rules(*edits):
    """Return what edits say."""
    return rules_of(edits, CATALOGUE)


def test_apart():
    """Edits of different cells do not touch each other."""
    found = rules(edit("lock", BRICK_2X4, (0, 0, 0)), edit("delete", BRICK_2X4, (4, 0, 0)))
    assert [each.by for each in found] == [-1, -1]
    assert [len(each.cells) for each in found] == [24, 24]


@pytest.mark.parametrize("later", ["delete", "force", "lock"])
@pytest.mark.parametrize("earlier", ["force", "lock"])
def test_a_brick_goes_whole(earlier, later):
    """What is laid or taken away later, and were it one cell, takes the place of a brick."""
    found = rules(edit(earlier, BRICK_2X4, (0, 0, 0)), edit(later, BRICK_1X1, (3, 1, 0)))
    assert [each.by for each in found] == [1, -1]


@pytest.mark.parametrize("later", ["recolour", "delete", "force", "lock"])
def test_colours_are_ruled_by_cell(later):
    """Of a recoloured place what is left keeps its colour, until nothing is left."""
    first = edit("recolour", BRICK_2X4, (0, 0, 0))
    halves = [edit(later, BRICK_2X2, (x, 0, 0)) for x in (0, 2)]
    found = rules(first, *halves)
    assert len(rules(first, halves[0])[0].cells) == 12
    assert found[0].by == 2


def test_a_brick_in_another_colour():
    """A locked brick that is recoloured whole stays, in the new colour; recoloured in part it has to go."""
    lock = edit("lock", BRICK_2X2, (0, 0, 0))
    whole = rules(lock, edit("recolour", BRICK_2X4, (0, 0, 0), WHITE))[0]
    assert (whole.by, whole.edit.colour) == (-1, WHITE)
    assert rules(lock, edit("recolour", BRICK_1X1, (0, 0, 0), WHITE))[0].by == 1


def test_a_brick_in_a_colour_that_it_is_not_made_in():
    """It has to go too, for others that are."""
    column = next(column for column, made in enumerate(CATALOGUE.exists[CATALOGUE.part_row("14716")]) if not made)
    recolour = edit("recolour", BRICK_2X4, (0, 0, 0), CATALOGUE.colours[column].code)
    assert rules(edit("lock", "14716", (0, 0, 0)), recolour)[0].by == 1


def test_forbidden_and_laid():
    """The same part, forbidden and laid by force, is a contradiction: the later one rules. Other parts do not mind."""
    for one, other in (("forbid", "force"), ("lock", "forbid")):
        assert rules(edit(one, BRICK_2X4, (0, 0, 0)), edit(other, BRICK_2X4, (3, 0, 0)))[0].by == 1
        assert rules(edit(one, BRICK_2X4, (0, 0, 0)), edit(other, BRICK_2X2, (3, 0, 0)))[0].by == -1
    assert rules(edit("forbid", BRICK_2X4, (0, 0, 0)), edit("recolour", BRICK_2X4, (0, 0, 0)))[0].by == -1


def test_what_is_deleted_has_no_colour():
    """Recoloured afterwards it stays deleted; laid over it does not, where the new brick lies."""
    gone = edit("delete", BRICK_2X4, (0, 0, 0))
    assert len(rules(gone, edit("recolour", BRICK_2X4, (0, 0, 0)))[0].cells) == 24
    assert len(rules(gone, edit("force", BRICK_2X2, (0, 0, 0)))[0].cells) == 12
