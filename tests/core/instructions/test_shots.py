"""What the pictures of the steps show."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.steps import MAIN
from legorize_addon.core.instructions.shots import shots
from tests.core.instructions.built import arm, pair


@pytest.mark.parametrize("model", [arm, pair])
def test_in_the_end_the_model_is_there(model):
    """After the last step all bricks that stay are on the first table, and no support."""
    plan = model()
    seen = list(shots(plan.steps, temporary=plan.temporary))
    assert [shot.step.number for shot in seen if shot.submodel == shot.step.submodel] == list(range(len(plan.steps)))
    last = [shot for shot in seen if shot.submodel == MAIN][-1]
    there = np.union1d(last.stays, last.new if last.step.action != Action.REMOVE else last.new[:0])
    assert there.tolist() == np.flatnonzero(~plan.temporary).tolist()


@pytest.mark.parametrize("model", [arm, pair])
def test_every_brick_is_new_once(model):
    """Each brick is placed in one picture, and only what is there is taken out."""
    plan = model()
    seen = list(shots(plan.steps, temporary=plan.temporary))
    placed = [row for shot in seen if shot.step.action != Action.REMOVE for row in shot.placed.tolist()]
    assert sorted(placed) == list(range(len(plan.bricks)))
    for shot in seen:
        assert len(np.unique(shot.new)) == len(shot.new)
        if shot.step.action == Action.REMOVE:
            assert np.isin(shot.placed, shot.before).all()
            assert plan.temporary[shot.placed].all()
        else:
            assert not np.isin(shot.new, shot.before).any()


def test_supports_are_taken_out():
    """An arm has supports, which a step takes out."""
    plan = arm()
    assert plan.temporary.any()
    taken = [shot for shot in shots(plan.steps, temporary=plan.temporary) if shot.step.action == Action.REMOVE]
    assert sorted(row for shot in taken for row in shot.placed.tolist()) == np.flatnonzero(plan.temporary).tolist()


def test_pieces_are_put_on_whole():
    """The second piece comes to the first table in one step, as it was built on its own."""
    plan = pair()
    [joined] = [shot for shot in shots(plan.steps, temporary=plan.temporary) if shot.joined and not len(shot.placed)]
    assert joined.step.submodel == MAIN
    upper = np.flatnonzero((plan.bricks.piece == 1) & ~plan.temporary)
    assert sorted(joined.came.tolist()) == upper.tolist()
