"""The steps as data: submodels, their steps, and when what arrives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from tests.core.standing import CATALOGUE, table

MAST = [("3003", 0, 0, 3 * k) for k in range(4)]
NESTED = table(*MAST, ("3008", 0, 0, 12), ("3005", 7, 0, 9), ("3005", 7, 0, 6), ("3024", 4, 0, 11))
"""A mast, a beam on it, a long and a short thing under the beam."""


HOOK = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
"""A mast with an arm, and a plate below its end."""


def planned(bricks):
    """Return the steps of bricks."""
    gone = np.zeros(len(bricks), bool)
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone).pairs
    return plan_steps(bricks, CATALOGUE, pairs, temporary=gone)


def test_steps_are_the_moves_in_portions():
    """All steps together hold every move, in order, with the submodel in which it is done."""
    steps = planned(NESTED)
    told = list(steps)
    assert [step.number for step in told] == list(range(len(steps)))
    assert np.concatenate([step.bricks for step in told]).tolist() == [
        brick for brick in steps.moves.brick.tolist() if brick != NOBODY
    ]
    owner = steps.submodel_of(len(NESTED))
    for step in told:
        assert set(owner[step.bricks].tolist()) <= {step.submodel}
        assert step.times == 1
        assert not step.pressed
    joined = [number for step in told for number in step.joined]
    assert sorted(joined) == [each.number for each in steps.submodels[1:]]


def test_submodels_nest():
    """Rows of a submodel are its own; all of it is there with what is put onto it."""
    steps = planned(NESTED)
    outer, inner = steps.submodels[1:]
    assert [outer.kind, inner.kind] == [Kind.SUBASSEMBLY] * 2
    assert (outer.parent, inner.parent) == (0, 1)
    assert [each.name for each in steps.submodels] == ["model", "sub-1", "sub-2"]
    assert sorted([*outer.rows.tolist(), *inner.rows.tolist()]) == sorted(steps.all_rows(1).tolist()) == [4, 5, 6, 7]
    assert steps.outermost().tolist() == [0, 1, 1]
    assert [steps.floor(number, NESTED) for number in range(3)] == [0, 6, 11]


def test_bricks_of_a_piece_arrive_there_before_the_piece_does():
    """What is placed in a piece comes to it at once, to the model when the piece is joined."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), *((part, x, y, z + 6) for part, x, y, z in HOOK))
    bricks = replace(bricks, piece=np.array([0, 0, 1, 1, 1, 1], np.int16))
    steps = planned(bricks)
    placed, piece, model = steps.moves.step_of(6), steps.arrival(6, within_pieces=True), steps.arrival(6)
    small = steps.submodel_of(6) == 2
    assert small.sum() == 2
    assert (piece[~small] == placed[~small]).all()
    assert (piece[small] > placed[small]).all()
    assert set(model[2:].tolist()) == {len(steps) - 1}


def test_bricks_arrive_with_what_they_are_part_of():
    """A brick of a nested sub-assembly comes to the model when the outer one is joined."""
    steps = planned(NESTED)
    moves = steps.moves
    joined = int(moves.step[(moves.action == Action.JOIN) & (moves.submodel == 1)][0])
    arrival = steps.arrival(len(NESTED))
    assert arrival[4:].tolist() == [joined] * 4
    assert (arrival[:4] <= joined).all()
