"""Why components are not one: they lie apart, meet at edges, or side by side with no room for a part across."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.report.remarks import remarks
from legorize_addon.core.report.separation import meetings, reasons
from tests.core.standing import CATALOGUE, judged, table

ALONE, BESIDE = ("3003", 9, 0, 0), ("3003", 2, 0, 0)
BASE, EDGE, CORNER = ("3003", 0, 0, 0), ("3003", 2, 2, 0), ("3003", 2, 2, 3)
AWAY = ("3003", 15, 0, 0)


def sentence(*rows) -> str:
    """Return the one remark on bricks."""
    bricks = table(*rows)
    [told] = [
        each for each in remarks(Assembly(bricks, CATALOGUE), judged(bricks)) if "not joined" in each or "hang" in each
    ]
    return told


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (ALONE, "the smaller one touches nothing else: let the meshes touch"),
        (EDGE, "the smaller one touches others only at edges or corners"),
        (CORNER, "the smaller one touches others only at edges or corners"),
        (BESIDE, "the smaller one touches others side by side, but no part of a fitting colour could be laid"),
    ],
)
def test_the_nearest_meeting_is_named(row, words: str):
    """Two bricks on the ground, or one in the air, and how they meet."""
    assert words in sentence(BASE, ("3003", 0, 0, 3), row) or words in sentence(BASE, row)


def test_plates_in_a_sheet_are_told_of_by_themselves():
    """Single plates side by side, with nothing below or above, need another cure than what stands beside a body."""
    sheet = [("3022", 2 * x, 0, 0) for x in range(3)]
    assert "they touch others side by side in a layer one plate thick" in sentence(*sheet)
    assert "one plate thick" not in sentence(*sheet[:2], ("3022", 2, 0, 1))
    assert "one plate thick" not in sentence(BASE, BESIDE)


def test_several_are_counted_by_how_they_meet():
    """Each component but the largest is counted once, by the nearest that it comes to another one."""
    told = sentence(BASE, ("3003", 0, 0, 3), BESIDE, ALONE, AWAY)
    assert "1 of them touches others side by side" in told
    assert "2 of them touch nothing else" in told
    assert "they touch nothing else" in sentence(BASE, ALONE, AWAY)


def test_all_neighbours_are_looked_at():
    """Of two cells, every place of the second one around the first gives the meeting that it is."""
    for step in np.ndindex(3, 3, 3):
        away = np.abs(np.array(step) - 1)
        if away.any():
            owner = np.full((3, 3, 3), -1, dtype=np.int32)
            owner[1, 1, 1], owner[step] = 0, 1
            assert meetings(owner, np.array([0, 1], dtype=np.int32)).tolist() == [2 if away.sum() == 1 else 1] * 2


def test_cells_two_steps_away_do_not_meet():
    """An empty cell between keeps them apart; other bricks of a component do not count."""
    owner = np.array([[[0, 1, -1, 2]]], dtype=np.int32)
    assert meetings(owner, np.array([0, 0, 1], dtype=np.int32)).tolist() == [0, 0]
    assert reasons(owner, np.array([0, 0, 1], dtype=np.int32)).startswith("the smaller one touches nothing else")
