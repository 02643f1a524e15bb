"""Stud squares of bricks half a stud off each other, and the middles of jumpers' studs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.profiles import columns, jumper_turn
from legorize_addon.core.model.squares import column_facts, off_square, stud_middles
from tests.core.half_studs.test_truth import CATALOGUE, GOOD, model

JUMPERS = [row for row, part in enumerate(CATALOGUE.parts) if part.jumper]


@pytest.mark.parametrize("row", JUMPERS)
@pytest.mark.parametrize("turn", range(4))
def test_the_stud_of_a_jumper_is_in_its_middle(row, turn):
    """Whatever square it counts to, which its turn says, and every socket of the part holds."""
    part = CATALOGUE.parts[row]
    facts = columns(part, turn)
    assert facts.stud.sum() == 1
    assert facts.socket.all()
    bricks = model(*GOOD[:1]).bricks
    bricks = replace(bricks, part=np.array([row], np.int16), turn=np.array([turn], np.uint8))
    stud = column_facts(bricks, CATALOGUE).stud
    assert stud_middles(bricks, CATALOGUE)[stud].tolist() == [((facts.xy.max(axis=0) + 1) / 2).tolist()]


@pytest.mark.parametrize("row", JUMPERS)
@pytest.mark.parametrize("turn", range(2))
@pytest.mark.parametrize("half", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_turns_of_jumpers_follow_from_their_half_studs(row, turn, half):
    """The stud lies where the other number of half studs is, along the length or both ways."""
    part = CATALOGUE.parts[row]
    found = jumper_turn(part, turn, *half)
    assert found % 2 == turn or part.length == part.width
    beyond = np.array(half) + off_square(CATALOGUE.parts)[row, found]
    other = [True, True] if part.length == part.width else [turn == 0, turn == 1]
    assert beyond.tolist() == [1 - each if changes else each for each, changes in zip(half, other, strict=True)]
