"""What a model has of edits is read off its bricks alone."""

from __future__ import annotations

import pytest

from legorize_addon.core.edits import Outcome, outcomes_of
from legorize_addon.core.model import Role
from tests.core.any_bricks import CATALOGUE, table
from tests.core.edits.models import BRICK_1X1, BRICK_2X2, BRICK_2X4, RED, ROW, WHITE, edit, wall


def reasons(bricks, *edits, refused=None):
    """Return why a model does not have edits."""
    return [each.reason for each in outcomes_of(bricks, CATALOGUE, edits, refused or {})]


@pytest.mark.parametrize(
    ("good", "bad"),
    [
        (edit("recolour", BRICK_2X2, (1, 0, 0)), edit("recolour", BRICK_2X2, (1, 0, 0), WHITE)),
        (edit("delete", BRICK_2X4, (20, 0, 0)), edit("delete", BRICK_2X4, (7, 0, 0))),
        (edit("lock", BRICK_2X4, (4, 0, 0)), edit("lock", BRICK_2X4, (3, 0, 0))),
        (edit("force", BRICK_2X4, (2, 0, 3), turn=2), edit("force", BRICK_2X4, (2, 0, 3), WHITE)),
        (edit("forbid", BRICK_2X2, (0, 0, 0)), edit("forbid", BRICK_2X4, (1, 1, 1))),
        (edit("recolour", BRICK_2X4, (7, 0, 0)), edit("recolour", BRICK_2X4, (30, 0, 0))),
    ],
)
def test_read_off_the_bricks(good, bad):
    """Each kind is seen where it is, and missed where it is not, inside the model or beyond it."""
    assert reasons(wall(), good) == [""]
    assert reasons(wall(), bad) == ["bricks were laid there after it"]


def test_reasons_of_others_come_first():
    """What was refused or overruled is told so; numbers count from 1."""
    lock = edit("lock", BRICK_2X4, (4, 0, 0))
    assert reasons(wall(), lock, refused={0: "of the weather"}) == ["of the weather"]
    assert reasons(wall(), lock, edit("force", BRICK_2X4, (3, 0, 0))) == [
        "edit 2 was made later in the same place",
        "bricks were laid there after it",
    ]


def test_a_pillar_in_an_empty_cell():
    """Where a pillar had to be put into what should be empty, that is the reason."""
    pillar = table([(ROW(BRICK_1X1), 0, 0, 0, 0, RED, int(Role.SUPPORT_KEPT), 0, 0)])
    assert reasons(pillar, edit("delete", BRICK_1X1, (0, 0, 0))) == ["a pillar had to be put there"]


def test_sentence():
    """It says what, where and why."""
    told = Outcome(edit("delete", BRICK_1X1, (0, 4, 9)), "a pillar had to be put there").sentence(CATALOGUE)
    assert told == (
        "An edit no longer fits: Delete Brick 1 x 1 in layer 4 at column 1, row 5 of the grid, because a pillar had to "
        "be put there."
    )
