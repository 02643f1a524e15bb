"""How each submodel is built on its table."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.building.tables import Planner
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.progress import silent
from tests.core.standing import CATALOGUE, table


def comb(*places, colour=None):
    """Return a bench on which arms lie at some places, each with a plate that hangs from its end."""
    rows = [("3008", 0, y, 0) for y in range(0, 16)]
    arms = [[("3010", 7, y, 3), ("3024", 10, y, 2)] for y in places]
    bricks = table(*rows, *(row for arm in arms for row in arm))
    if colour is not None:
        bricks.colour[-1] = colour
    return bricks


def planned(bricks):
    """Return the planner of bricks, and their steps."""
    gone = np.zeros(len(bricks), bool)
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone).pairs
    planner = Planner(bricks, CATALOGUE, pairs, gone)
    planner.plan_pieces(silent)
    return planner, plan_steps(bricks, CATALOGUE, pairs, temporary=gone)


def test_equal_sub_assemblies_have_the_same_shape():
    """Wherever they stand; another colour makes another shape."""
    planner, _ = planned(comb(0, 4))
    assert len(planner.shape) == 2
    assert len(set(planner.shape.values())) == 1
    planner, _ = planned(comb(0, 4, colour=15))
    assert len(set(planner.shape.values())) == 2


def test_equal_sub_assemblies_are_built_together():
    """Four of them in one step, each brick once, and each is put on by itself."""
    bricks = comb(0, 4, 8, 12)
    _, steps = planned(bricks)
    small = [each for each in steps.submodels if each.kind == Kind.SUBASSEMBLY]
    assert {each.like for each in small} == {small[0].number}
    [made] = [step for step in steps if step.times > 1]
    assert made.times == 4
    assert sorted(made.bricks.tolist()) == list(range(16, 24))
    moves = steps.moves
    assert (moves.action == Action.JOIN).sum() == 4
    for one, other in zip(small[0].rows.tolist(), small[1].rows.tolist(), strict=True):
        assert bricks.part[one] == bricks.part[other]


def test_other_colours_are_built_by_themselves():
    """What is not equal is not built together."""
    _, steps = planned(comb(0, 4, colour=15))
    assert {step.times for step in steps} == {1}


def test_a_small_sub_assembly_is_one_step():
    """What has few bricks is one picture, nested or not."""
    _, steps = planned(comb(0))
    small = next(each.number for each in steps.submodels if each.kind == Kind.SUBASSEMBLY)
    assert sum(step.submodel == small for step in steps) == 1
