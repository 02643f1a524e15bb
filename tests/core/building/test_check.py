"""The check of a building order finds every fault that is put into one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.building.check import walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from tests.core.standing import CATALOGUE, table

TOWER = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6))
GATE = (("3005", 0, 0, 0), ("3005", 5, 0, 0), ("3009", 0, 0, 3), ("3005", 2, 0, 0))


def moves_of(*rows, pieces=None, pressed=()):
    """Return moves from (action, brick), each a step of its own; each piece is a submodel."""
    n = len(rows)
    return Moves(
        action=np.array([Action[action.upper()] for action, _ in rows], np.uint8),
        brick=np.array([brick for _, brick in rows], np.int32),
        piece=np.array(pieces or [0] * n, np.int16),
        submodel=np.array(pieces or [0] * n, np.int32),
        pressed=np.isin([brick for _, brick in rows], pressed),
        step=np.arange(n, dtype=np.int32),
    )


def steps_of(moves, bricks):
    """Return moves as the steps of a model and its pieces."""
    numbers = range(int(bricks.piece.max()) + 1)
    kinds = [Kind.PIECE if number else Kind.MAIN for number in numbers]
    rows = [np.flatnonzero(bricks.piece == number) for number in numbers]
    made = (Submodel(number, kinds[number], min(number, 1) - 1, number, rows[number], number) for number in numbers)
    return Steps(moves, tuple(made))


def walked(bricks, moves, temporary=()):
    """Return what the check finds."""
    gone = np.isin(np.arange(len(bricks)), temporary)
    return walk(
        steps_of(moves, bricks),
        Assembly(bricks, CATALOGUE),
        building_contacts(Assembly(bricks, CATALOGUE), temporary=gone),
        temporary=gone,
    )


def test_tower_can_be_built():
    """From below, nothing is wrong."""
    found = walked(table(*TOWER), moves_of(("place", 0), ("place", 1), ("place", 2)))
    assert found.buildable
    assert found.n_steps == 3


def test_brick_in_the_air_is_found():
    """The top before the middle touches nothing."""
    found = walked(table(*TOWER), moves_of(("place", 0), ("place", 2), ("place", 1)))
    assert found.in_air.tolist() == [2]
    assert found.squeezed.tolist() == [1]
    assert found.bad_steps.tolist() == [1, 2]
    assert not found.buildable


def test_missing_brick_is_found():
    """An order that forgets a brick, or leaves a support, does not end as the model."""
    assert walked(table(*TOWER), moves_of(("place", 0), ("place", 1))).wrong_end.tolist() == [2]
    gate = moves_of(("place", 0), ("place", 1), ("place", 3), ("place", 2))
    assert walked(table(*GATE), gate, temporary=[3]).wrong_end.tolist() == [3]


def test_support_that_comes_out():
    """A pillar under a gate can be pulled down; the gate stays."""
    gate = moves_of(("place", 0), ("place", 1), ("place", 3), ("place", 2), ("remove", 3))
    assert walked(table(*GATE), gate, temporary=[3]).buildable


def test_support_on_the_model_is_stuck():
    """A pillar between two bricks of the model cannot be pulled down."""
    bricks = table(("3003", 0, 0, 0), ("3005", 0, 0, 3), ("3005", 1, 1, 3), ("3003", 0, 0, 6))
    order = moves_of(("place", 0), ("place", 1), ("place", 2), ("place", 3), ("remove", 2))
    assert walked(bricks, order, temporary=[2]).stuck.tolist() == [2]


def test_supports_come_out_from_below():
    """The upper half of a pillar cannot go before the lower one."""
    bricks = table(("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3009", 0, 0, 6), ("3005", 5, 0, 0), ("3005", 5, 0, 3))
    build = [("place", row) for row in (0, 1, 3, 4, 2)]
    assert walked(bricks, moves_of(*build, ("remove", 3), ("remove", 4)), temporary=[3, 4]).buildable
    found = walked(bricks, moves_of(*build, ("remove", 4), ("remove", 3)), temporary=[3, 4])
    assert found.stuck.tolist() == [4]


def test_model_that_falls_without_its_support_is_found():
    """Taking away the only pillar leaves the brick on it in the air."""
    bricks = table(("3005", 0, 0, 0), ("3003", 5, 5, 0), ("3005", 0, 0, 3))
    order = moves_of(("place", 0), ("place", 1), ("place", 2), ("remove", 0))
    assert walked(bricks, order, temporary=[0]).in_air.tolist() == [2]


@pytest.mark.parametrize(
    ("corner", "loose"),
    [((0, 0, 3), []), ((3, 0, 3), [1])],
    ids=["on the first piece", "beside it"],
)
def test_piece_must_touch_when_joined(corner, loose):
    """A piece is joined where studs hold it, and nowhere else."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", *corner)), piece=np.array([0, 1], np.int16))
    found = walked(bricks, moves_of(("place", 1), ("place", 0), ("join", NOBODY), pieces=[1, 0, 1]))
    assert found.loose_pieces.tolist() == loose


def test_piece_cannot_pass_what_lies_over_it():
    """A piece that belongs under a roof cannot come from above."""
    bricks = table(("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3010", 0, 0, 6), ("3004", 1, 0, 9), ("3005", 3, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 0, 0, 0, 1], np.int16))
    rows = [("place", 4), *(("place", row) for row in range(4)), ("join", NOBODY)]
    assert walked(bricks, moves_of(*rows, pieces=[1, 0, 0, 0, 0, 1])).loose_pieces.tolist() == [1]


def test_pieces_do_not_hold_each_other_before_they_are_joined():
    """A brick over another piece is in the air until that is joined."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", 0, 0, 3)), piece=np.array([1, 0], np.int16))
    assert walked(bricks, moves_of(("place", 0), ("place", 1), pieces=[1, 0])).in_air.tolist() == []
    high = replace(table(("3003", 0, 0, 0), ("3003", 5, 0, 0), ("3003", 0, 0, 3)), piece=np.array([1, 0, 0], np.int16))
    found = walked(high, moves_of(("place", 0), ("place", 1), ("place", 2), pieces=[1, 0, 0]))
    assert found.in_air.tolist() == [2]
