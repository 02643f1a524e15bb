"""What the pictures of the steps show."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import MAIN
from legorize_addon.core.instructions.shots import shots
from legorize_addon.core.model.assembly import Assembly
from tests.core.instructions.built import arm, pair
from tests.core.standing import CATALOGUE, table


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


def test_a_support_that_came_within_a_sub_assembly_is_taken_out_in_a_picture():
    """As in files of others: a plate that hangs from a brick, and goes again."""
    bricks = table(("3005", 0, 0, 0), ("3004", 0, 0, 3), ("3024", 1, 0, 2))
    gone = np.array([False, False, True])
    contacts = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone)
    *_, last = shots(plan_steps(bricks, CATALOGUE, contacts.pairs, temporary=gone), temporary=gone)
    assert last.step.action == Action.REMOVE
    assert last.placed.tolist() == [2]
