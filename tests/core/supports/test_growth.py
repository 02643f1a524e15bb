"""Whether a piece keeps its balance as it grows with its supports."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building import building_contacts, falling, plan_steps
from legorize_addon.core.model import Assembly, concatenate
from legorize_addon.core.progress import silent
from legorize_addon.core.supports.demand import support_demand
from legorize_addon.core.supports.growth import Growth, _guessed
from tests.core.standing import CATALOGUE, table

LEANING = (("3003", 0, 0, 0), ("3009", 0, 0, 3), ("3009", 1, 0, 6), ("3009", 2, 0, 9), ("3009", 3, 0, 12))
"""A stair that falls over when its third beam is laid; nothing of it hangs."""

NONE = np.zeros((0, 3), dtype=np.int32)


def growth_of(*rows):
    """Return the growth of some bricks, and their undersides."""
    model = Assembly(table(*rows), CATALOGUE)
    need = support_demand(model, deepest=3)
    return Growth(model, need), need


def with_supports(growth, *rows, touched=NONE, **options):
    """Return how a piece grows with some supports."""
    asked = {"add": True, "planned": False, "progress": silent, **options}
    return growth.with_supports(table(*rows) if rows else growth.assembly.bricks.take(NONE[:, 0]), touched, **asked)


def test_steps_are_planned_first_and_then_remembered():
    """What is asked first has to plan; what is asked then only if it shall; both tell the same of the same bricks."""
    growth, _ = growth_of(*LEANING)
    assert not growth.known
    first, second, third = (with_supports(growth, add=False, planned=planned) for planned in (False, False, True))
    assert growth.known
    assert [found.steps is None for found in (first, second, third)] == [False, True, False]
    towers = [[(tower.bricks.tolist(), tower.feet.tolist()) for tower in found.towers] for found in (first, second)]
    assert towers[0] == towers[1]
    assert [rows for rows, _ in towers[0]] == [[0, 1, 2, 3, 4]]
    assert len(first.steps) == len(third.steps)


@pytest.mark.parametrize("planned", [True, False])
def test_the_best_underside_is_told(planned):
    """Of all undersides the lowest that leaves a stud of room: the first beam, in the middle of the weight."""
    growth, need = growth_of(*LEANING)
    with_supports(growth)
    found = with_supports(growth, planned=planned)
    assert found.towers == []
    [brace] = found.braces
    x, _, z = (need.undersides[brace] + need.room.low).tolist()
    assert (x, z) == (4, 3)
    # what is propped there already is no place for another one
    again = with_supports(growth, planned=planned, touched=need.undersides[found.braces])
    assert again.braces != found.braces


def test_nothing_is_added_unless_it_may_be():
    """Towers that fall are told, and no underside."""
    growth, _ = growth_of(*LEANING)
    found = with_supports(growth, add=False)
    assert len(found.towers) == 1
    assert found.braces == []


def test_supports_come_right_before_what_they_carry():
    """A support under the first beam is there one step before it; those that carry nothing are there at once."""
    model, supports = table(*LEANING), table(("3005", 5, 0, 0), ("3005", 5, 5, 0), ("3005", 20, 0, 0))
    bricks = concatenate([model, supports])
    temporary = np.arange(8) >= 5
    found = _guessed(np.arange(5), bricks, building_contacts(Assembly(bricks, CATALOGUE), temporary=temporary))
    assert found == [(0, [6, 7]), (1, [0]), (2, [5]), (3, [1]), (5, [2]), (7, [3]), (9, [4])]


def test_a_chain_of_supports_hands_its_step_down():
    """Supports under each other all come before the first brick that the highest one carries, and in one step."""
    model, supports = (
        table(("3003", 0, 0, 0), ("3009", 0, 0, 3)),
        table(("3024", 5, 0, 2), ("3024", 5, 0, 1), ("3024", 5, 0, 0)),
    )
    bricks = concatenate([model, supports])
    temporary = np.arange(5) >= 2
    contacts = building_contacts(Assembly(bricks, CATALOGUE), temporary=temporary)
    assert _guessed(np.array([0, 1]), bricks, contacts) == [(1, [0]), (2, [2, 3, 4]), (3, [1])]


def test_a_guess_in_the_steps_that_were_planned_finds_the_same_towers():
    """Without supports the steps are those of the plan: so are the towers."""
    growth, _ = growth_of(*LEANING, ("3005", 9, 0, 0), ("3008", 9, 0, 3))
    planned, guessed = (with_supports(growth, add=False, planned=planned) for planned in (True, False))
    assert [tower.bricks.tolist() for tower in planned.towers] == [tower.bricks.tolist() for tower in guessed.towers]
    assert len(planned.towers) == 2
    bricks, contacts = growth.assembly.bricks, growth.assembly.graph.pairs
    steps = plan_steps(bricks, CATALOGUE, contacts, temporary=np.zeros(7, bool))
    alone = [(step, [row]) for row, step in enumerate(steps.arrival(7).tolist())]
    found = falling(sorted(alone), growth.assembly, contacts, floor=0)
    assert [tower.bricks.tolist() for tower in found] == [tower.bricks.tolist() for tower in planned.towers]
