"""Supports of one kind, until all stands at every step and bears its load."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.supports.demand import support_demand
from legorize_addon.core.supports.growth import Growth
from legorize_addon.core.supports.plan import plan_supports
from tests.core.standing import CATALOGUE, table

LEANING = (("3003", 0, 0, 0), ("3009", 0, 0, 3), ("3009", 1, 0, 6), ("3009", 2, 0, 9), ("3009", 3, 0, 12))
"""A stair that falls over when its third beam is laid; nothing of it hangs."""

APART = (("3003", 0, 0, 0), *(("3005", x, 0, 30) for x in (6, 9)), ("3003", 0, 9, 0))
"""Two single bricks high above the ground, three studs apart."""


def plan(*rows, ways=("tree",), clutch=0.98):
    """Return the plan for some bricks."""
    bricks = table(*rows)
    need = support_demand(Assembly(bricks, CATALOGUE), deepest=3)
    return plan_supports(Assembly(bricks, CATALOGUE), need, ways=ways, clutch=clutch), need


@pytest.mark.parametrize("way", ["tree", "columns"])
def test_contacts_are_added_where_a_tower_falls(way):
    """A stair in which every brick lies on another one still gets a support, and stands with it at every step."""
    found, need = plan(*LEANING, ways=[way])
    assert len(need.contacts) == 0
    assert len(found.contacts.cells) > 0
    assert found.unsteady == ()


@pytest.mark.parametrize("way", ["tree", "columns"])
def test_last_round_promises_nothing(way, monkeypatch):
    """Where rounds run out, contacts that were not laid do not count, and the tower is named."""
    monkeypatch.setattr("legorize_addon.core.supports.plan.ROUNDS", 1)
    found, _ = plan(*LEANING, ways=[way])
    assert len(found.contacts.cells) == len(found.supports) == 0
    assert len(found.unsteady) == 1


def test_without_supports_the_tower_is_named():
    """If nothing shall be added, the stair has to be held by hand."""
    found, _ = plan(*LEANING, ways=())
    assert len(found.supports) == 0
    assert len(found.unsteady) == 1


def test_near_contacts_share_a_trunk():
    """Two contacts near each other and high up grow together: fewer bricks than two columns."""
    tree, _ = plan(*APART)
    columns, _ = plan(*APART, ways=["columns"])
    assert tree.bears
    assert len(tree.supports) < len(columns.supports)


def test_branches_that_do_not_bear_are_straightened():
    """Under a load that lies on one branch alone, with studs that hold next to nothing, the rest is proven to bear."""
    heavy = [("3007", 6, 0, 30 + 3 * k) for k in range(12)]
    found, _ = plan(("3003", 0, 0, 0), *heavy, ("3005", 5, 4, 30), clutch=0.05)
    assert found.bears


def test_lightest_way_is_chosen():
    """Of several ways the plan is the lightest."""
    mass = {
        way: float(CATALOGUE.mass[plan(*APART, ways=[way])[0].supports.part].sum())
        for way in ("tree", "columns", "beams")
    }
    best, _ = plan(*APART, ways=["beams", "columns", "tree"])
    assert float(CATALOGUE.mass[best.supports.part].sum()) == min(mass.values())
    assert best.way == min(mass, key=mass.get)


def test_a_way_that_becomes_too_heavy_is_given_up(monkeypatch):
    """Columns that are light until the stair needs one are not tried once they weigh as much as others."""
    asked = []
    with_supports = Growth.with_supports

    def counted(growth, supports, *args, **options):
        """Count how often a piece is looked at with supports."""
        asked.append(len(supports))
        return with_supports(growth, supports, *args, **options)

    monkeypatch.setattr(Growth, "with_supports", counted)
    once, _ = plan(*LEANING, ("3005", 9, 9, 30), ways=["columns"])
    light, heavy, confirmed = asked
    assert light < heavy == confirmed
    twice, _ = plan(*LEANING, ("3005", 9, 9, 30), ways=["columns", "columns"])
    assert asked[3:] == [light, heavy, heavy, light]
    assert np.array_equal(once.supports.corner, twice.supports.corner)


def test_no_supports_where_nothing_is_needed():
    """A tower gets none."""
    found, _ = plan(("3003", 0, 0, 0), ("3003", 0, 0, 3), ways=["tree", "columns", "beams"])
    assert len(found.supports) == 0
    assert found.bears
    assert np.array_equal(found.contacts.straight, np.zeros(0, bool))
