"""The steps as data: submodels, their steps, and when what arrives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import MAIN, Kind
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from tests.core.building.heaps import heap
from tests.core.standing import CATALOGUE, table

MAST = [("3003", 0, 0, 3 * k) for k in range(4)]
NESTED = table(*MAST, ("3008", 0, 0, 12), ("3005", 7, 0, 9), ("3005", 7, 0, 6), ("3024", 4, 0, 11))
"""A mast, a beam on it, a long and a short thing under the beam."""

NO_PAIRS = np.zeros((0, 2), np.int32)


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
        assert set(owner[step.bricks].tolist()) <= {step.submodel, *step.made}
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
    assert [steps.floor(number, NESTED, NO_PAIRS) for number in range(3)] == [0, 6, 11]


def test_bricks_of_a_piece_arrive_there_before_the_piece_does():
    """What is placed in a piece comes to it at once, to the model when the piece is joined."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), *((part, x, y, z + 6) for part, x, y, z in HOOK))
    bricks = replace(bricks, piece=np.array([0, 0, 1, 1, 1, 1], np.int16))
    steps = planned(bricks)
    placed, piece, model = steps.moves.step_of(6), steps.arrival(6, within_pieces=True), steps.arrival(6)
    small = steps.submodel_of(6) == 2
    assert small.sum() == 2
    assert (piece[~small] == placed[~small]).all()
    assert (piece[small] == placed[small]).all()
    assert set(model[2:].tolist()) == {len(steps) - 1}


def test_bricks_arrive_with_what_they_are_part_of():
    """A brick of a nested sub-assembly comes to the model when the outer one is joined."""
    steps = planned(NESTED)
    moves = steps.moves
    joined = int(moves.step[(moves.action == Action.JOIN) & (moves.submodel == 1)][0])
    arrival = steps.arrival(len(NESTED))
    assert arrival[4:].tolist() == [joined] * 4
    assert (arrival[:4] <= joined).all()


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6))
def test_arrivals_are_those_of_moving_every_brick(seed):
    """Heaps in pieces are built move by move, each brick with the table on which it lies; only joins move it."""
    bricks = heap(seed, most=25, n_pieces=1 + seed % 3, size=(6, 4, 12))
    bricks.corner[:, 2] += seed % 4
    steps, n = planned(bricks), len(bricks)
    where, inside, model, piece = {}, {}, [NOBODY] * n, [NOBODY] * n
    moves = steps.moves
    columns = (moves.action.tolist(), moves.brick.tolist(), moves.submodel.tolist(), moves.step.tolist())
    for action, brick, submodel, step in zip(*columns, strict=True):
        parent = steps.submodels[submodel].parent
        came = [brick] if action == Action.PLACE else [row for row, table in where.items() if table == submodel]
        if action == Action.JOIN:
            assert sorted(came) == sorted(steps.all_rows(submodel).tolist())
            assert parent < submodel
            own = [int(bricks.corner[row, 2]) for row in came if bricks.piece[row] == steps.submodels[submodel].piece]
            assert steps.floor(submodel, bricks, NO_PAIRS) == min(own)
        where.update(dict.fromkeys(came, submodel if action == Action.PLACE else parent))
        inside.update(dict.fromkeys(came, submodel) if action == Action.PLACE else {})
        for row in came:
            model[row] = step if where[row] == MAIN else model[row]
            if steps.submodels[where[row]].kind != Kind.SUBASSEMBLY and piece[row] == NOBODY:
                piece[row] = step
    assert set(where.values()) == {MAIN}
    assert steps.submodel_of(n).tolist() == [inside[row] for row in range(n)]
    assert steps.arrival(n).tolist() == model
    assert steps.arrival(n, within_pieces=True).tolist() == piece


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6))
def test_steps_are_told_as_they_are_moved(seed):
    """Number, table, what is put on, what is joined, and how often, of every step, found among all moves."""
    bricks = heap(seed, most=25, n_pieces=1 + seed % 2, size=(6, 4, 12))
    steps = planned(bricks)
    moves, told = steps.moves, list(steps)
    assert [step.number for step in told] == list(range(len(steps))) == sorted(set(moves.step.tolist()))
    for step in told:
        rows = [row for row in range(len(moves)) if moves.step[row] == step.number]
        placed = [row for row in rows if moves.action[row] == Action.PLACE]
        joined = [int(moves.submodel[row]) for row in rows if moves.action[row] == Action.JOIN]
        assert step.bricks.tolist() == moves.brick[placed].tolist()
        assert step.joined == tuple(joined)
        assert step.action == (Action.PLACE if placed else Action.JOIN)
        assert step.pressed == any(moves.pressed[row] for row in rows)
        tables = {int(moves.submodel[row]) for row in placed} | {steps.submodels[each].parent for each in joined}
        assert (step.submodel, step.times) == (min(tables), len(tables))
