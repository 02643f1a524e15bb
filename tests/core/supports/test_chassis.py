"""Long bricks under wide undersides: on both sides of the axis, in open room, and a tree carries them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.supports.assembly_plan import plan_assembly
from legorize_addon.core.supports.chassis import LONG, carried_by, chassis, without
from legorize_addon.core.supports.demand import support_demand
from legorize_addon.core.supports.plan import plan_supports
from legorize_addon.core.supports.tree import tree
from tests.core.standing import CATALOGUE, table
from tests.core.supports.places import assert_sound, ceilings, room_under, triples

ROOF = [(x, y, 9) for y in range(6) for x in range(10)]
"""A roof of 10 x 6 studs, three bricks high."""

OPEN = room_under(np.full((6, 10), 9))


def sides(boxes):
    """Return the places and sizes of boxes."""
    return sorted(tuple(box) for box in boxes[:, [0, 1, 3, 4]].tolist())


def cells(rows):
    """Return rows as cells."""
    return np.array(rows, dtype=np.int32).reshape(-1, 3)


def test_both_sides_of_the_axis_get_a_long_brick():
    """Two of 2 x 8 lie side by side in the middle of a roof of 10 x 6; at its rims there is room for 1 x 8."""
    found = chassis(cells(ROOF), cells([(4, 2, 9)]), OPEN)
    assert sides(found) == [(1, 1, 8, 2), (1, 3, 8, 2)]
    assert found[:, [2, 5]].tolist() == [[6, 3]] * 2
    assert sides(chassis(cells(ROOF), cells([(4, 0, 9)]), OPEN)) == [(1, 0, 8, 1), (1, 5, 8, 1)]


def test_a_long_side_along_y_turns_them():
    """The same roof, transposed, has them transposed."""
    turned = [(y, x, z) for x, y, z in ROOF]
    found = chassis(cells(turned), cells([(2, 4, 9)]), room_under(np.full((10, 6), 9)))
    assert sides(found) == [(1, 1, 2, 8), (3, 1, 2, 8)]


@pytest.mark.parametrize("roof", [[cell for cell in ROOF if cell[0] < 7], [cell for cell in ROOF if cell[1] < 3]])
def test_small_undersides_get_none(roof):
    """Shorter than eight studs, or narrower than four, is not wide."""
    assert len(chassis(cells(roof), cells(roof), OPEN)) == 0


def test_low_and_uneven_undersides_get_none():
    """There must be a brick below the long one, and whole bricks down to the ground."""
    for z in (3, 7, 8):
        low = [(x, y, z) for x, y, _ in ROOF]
        assert len(chassis(cells(low), cells(low), room_under(np.full((6, 10), z)))) == 0


def test_what_lies_on_one_is_carried_by_two():
    """Contacts on a long brick become two under it, at the second studs from its ends, with the same load together."""
    [box, _] = chassis(cells(ROOF), cells([(4, 2, 9)]), OPEN)
    on, beside = [(x, 1, 9) for x in (1, 4, 5)], [(0, 0, 9)]
    below, load, straight = carried_by(box[None], cells(on + beside), np.array([1.0, 2, 3, 5]), np.zeros(4, dtype=bool))
    assert triples(below) == [(0, 0, 9), (2, 1, 6), (7, 1, 6)]
    assert load.tolist() == [5, 3, 3]
    assert len(straight) == 3


@given(ceilings())
def test_a_tree_under_them_is_sound(case):
    """Whatever the ceiling: boxes are parts in open room that lead to the ground and carry every contact."""
    room, contacts = case
    wide = chassis(contacts, contacts, room)
    below, load, straight = carried_by(wide, contacts, np.ones(len(contacts)), np.zeros(len(contacts), dtype=bool))
    grown = tree(below, load, without(room, wide), straight=straight)
    assert_sound(np.concatenate([wide, grown]), room, triples(contacts))


def test_a_table_stands_on_them():
    """A wide plate far from its foot lies on white bricks of 2 x 8, and all is proven to bear."""
    table_top = [("3007", x, y, 9) for x in (0, 8) for y in (0, 2, 4)] + [
        ("3007", x, y, 12) for x in (4,) for y in (0, 2, 4)
    ]
    bricks = table(*(("3003", 15, 2, 3 * k) for k in range(3)), *table_top)
    model = Assembly(bricks, CATALOGUE)
    need = support_demand(model, deepest=0)
    found = plan_supports(model, need, ways=("tree",), clutch=0.7, long_bricks=True)
    long = np.array([CATALOGUE.parts[part].length for part in found.supports.part]) == 8
    assert long.any()
    assert found.bears


@pytest.mark.parametrize("rows", [8, 16])
def test_a_wide_underside_is_bridged(rows):
    """At least four fifths of its rows lie on bricks of eight studs, as many on either side, and all come out again."""
    floor = [("3007", x, y, 9) for x in (0, 8, 16) for y in range(0, rows, 2)]
    ties = [("3007", x, y, 12, 1) for x in (7, 15) for y in range(0, rows, 8)] + [("3007", 11, rows // 2 - 4, 12, 1)]
    foot = [("3003", 11, rows // 2 - 1, 3 * k) for k in range(3)]
    model = Assembly(table(*foot, *floor, *ties), CATALOGUE)
    need = support_demand(model, deepest=0)
    boxes = chassis(need.undersides, need.contacts, need.room)
    middle = need.undersides[:, 1].min() + rows // 2
    bridged = {y + step for y, wide in boxes[:, [1, 4]].tolist() for step in range(wide)}
    assert len(bridged & set(need.undersides[:, 1].tolist())) >= 0.8 * rows
    assert (boxes[:, 1] < middle).sum() == (boxes[:, 1] >= middle).sum() > 0
    found = plan_assembly(model, wish="tree", deepest=0, long_bricks=True)
    assert (np.array([CATALOGUE.parts[part].length for part in found.removed.part]) == LONG).sum() == len(boxes)
    assert len(found.walk.stuck) == 0
    assert found.walk.buildable
