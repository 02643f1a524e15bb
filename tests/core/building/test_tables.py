"""How each submodel is built on its table."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building import tables
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.items import MOST, SMALL
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.building.tables import Planner, _due, _off_middle
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.progress import silent
from tests.core.standing import CATALOGUE, table

HANGING = (10, 9, 8, 11)
"""Where plates hang from an arm, in x."""


def comb(*places, colour=None, hanging=1):
    """Return a bench on which arms lie at some places, each with plates that hang from its end."""
    rows = [("3008", 0, y, 0) for y in range(0, 16)]
    arms = [[("3009", 7, y, 3), *(("3024", x, y, 2) for x in HANGING[:hanging])] for y in places]
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
    """Two of five bricks in a step of their own, each brick once, and each is put on by itself."""
    bricks = comb(0, 4, hanging=SMALL)
    _, steps = planned(bricks)
    small = [each for each in steps.submodels if each.kind == Kind.SUBASSEMBLY]
    assert {each.like for each in small} == {small[0].number}
    [made] = [step for step in steps if step.times > 1]
    assert made.times == 2
    assert not made.joined
    assert sorted(made.bricks.tolist()) == list(range(16, 26))
    moves = steps.moves
    assert (moves.action == Action.JOIN).sum() == 2
    for one, other in zip(small[0].rows.tolist(), small[1].rows.tolist(), strict=True):
        assert bricks.part[one] == bricks.part[other]


def test_other_colours_are_built_by_themselves():
    """What is not equal is not built together."""
    _, steps = planned(comb(0, 4, colour=15, hanging=SMALL))
    assert {step.times for step in steps} == {1}
    _, steps = planned(comb(0, 4, colour=15))
    assert {steps.times(step, each) for step in steps for each in step.made} == {1}


@pytest.mark.parametrize("hanging", [1, SMALL - 1, SMALL])
def test_a_small_sub_assembly_is_built_in_the_step_that_puts_it_on(hanging):
    """Up to four bricks; larger ones have a step of their own before that, and both are one picture."""
    _, steps = planned(comb(0, hanging=hanging))
    [small] = [each.number for each in steps.submodels if each.kind == Kind.SUBASSEMBLY]
    [put_on] = [step for step in steps if small in step.joined]
    own = [step for step in steps if step.submodel == small]
    assert len(own) == (hanging == SMALL)
    assert put_on.made == (() if own else (small,))
    bricks = steps.all_rows(small)
    assert np.isin(bricks, (own or [put_on])[0].bricks).all()
    assert put_on.submodel == 0


def test_equal_small_ones_are_built_at_once():
    """Three that are put on in one step are one model, three times; each is put on where it belongs."""
    _, steps = planned(comb(0, 4, 8))
    [step] = [step for step in steps if step.made]
    assert [steps.submodels[each].like for each in step.made] == [step.made[0]] * 3
    assert [steps.times(step, each) for each in (*step.made, 0)] == [3, 3, 3, 1]
    assert len(np.unique(step.bricks)) == len(step.bricks)


def test_small_ones_of_another_step_are_built_there():
    """Of four in a row the last is too far away for the same picture: it is built when it is wanted."""
    _, steps = planned(comb(0, 4, 8, 12))
    made = [step.made for step in steps if step.made]
    assert sorted(map(len, made)) == [1, 3]
    assert all(steps.submodels[each].like == numbers[0] for numbers in made for each in numbers)


@pytest.mark.parametrize("n", [12, 13])
def test_a_sub_assembly_of_as_many_bricks_as_a_step_has_is_one_step(n):
    """A beam from which plates hang in a column is built in one picture up to that number."""
    pillar = [("3003", 0, 0, 3 * k) for k in range(8)]
    planner, _ = planned(table(*pillar, ("3008", 0, 0, 24), *(("3024", 5, 0, 23 - k) for k in range(n - 1))))
    [small] = [each.number for each in planner.submodels if each.kind == Kind.SUBASSEMBLY]
    assert (len(planner.tables[small].steps) == 1) == (n == 12)


def test_progress_goes_on_from_piece_to_piece():
    """Pieces that need many steps, and then the model: what is told grows from 0 to no more than 1."""
    rows = [("3003", 2 * x, 8 * piece, 3 * z) for piece in range(3) for x in range(8) for z in range(4)]
    bricks = table(*rows)
    bricks = replace(bricks, piece=np.repeat([0, 1, 2], 32).astype(np.int16))
    # equal ones are planned once
    bricks.colour[-1] = 15
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=np.zeros(96, bool)).pairs
    told = []
    Planner(bricks, CATALOGUE, pairs, np.zeros(96, bool)).plan_pieces(lambda _, share: told.append(share))
    assert told == sorted(told)
    assert told[0] == 0
    assert 0.8 < told[-1] <= 1
    assert all(any(low < share < low + 0.25 for share in told) for low in (0, 0.25, 0.5))


def told(bricks, monkeypatch):
    """Return the items of the main table of bricks, those of each item, and the planner."""
    seen = []
    monkeypatch.setattr(tables, "_some", lambda items, *_: seen.append(items) or [list(range(len(items)))])
    gone = np.zeros(len(bricks), bool)
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone).pairs
    planner = Planner(bricks, CATALOGUE, pairs, gone)
    planner.plan_pieces(silent)
    puts = planner.tables[0].steps[0]
    return seen[-2], [[put.brick] if put.brick != NOBODY else planner.all_rows(put.submodel) for put in puts], planner


def test_items_are_what_their_bricks_are(monkeypatch):
    """Box, lowest plate, number and look of each item, and its image, found brick by brick."""
    far = [("3005", 20, y, 0) for y in (0, 15)] + [("3003", 22, 7, 0), ("3004", 22, 0, 0), ("3005", 20, 7, 0)]
    bricks = comb(0, 4, 7, 11, 15)
    bricks = type(bricks)(*(np.concatenate([getattr(bricks, k), getattr(table(*far), k)]) for k in bricks.__slots__))
    bricks.colour[16:18] = 15
    items, members, planner = told(bricks, monkeypatch)
    assert max(map(len, members)) == 2

    def look(rows):
        corner = bricks.corner[rows] - bricks.corner[rows].min(axis=0)
        return sorted(zip(bricks.part[rows].tolist(), bricks.colour[rows].tolist(), corner.tolist(), strict=True))

    for one, rows in enumerate(members):
        box = planner.box[rows]
        assert items.box[one].tolist() == [*(box[:, k].min() if k % 2 == 0 else box[:, k].max() for k in range(4))]
        assert items.level[one] == items.due[one] == bricks.corner[rows, 2].min()
        assert items.size[one] == len(rows)
        for other, others in enumerate(members):
            assert (items.lot[one] == items.lot[other]) == (look(rows) == look(others))
        images = {int(image) for image in planner.image[rows]}
        found = [k for k, others in enumerate(members) if images == set(others) and others != rows]
        assert [items.image[one]] == (found or [NOBODY])
    assert (items.image != NOBODY).any()


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 10**6))
def test_ranks_and_levels_are_those_of_plain_sums(seed):
    """How far bricks lie off the middle, in half studs, x before y; and what supports wait for, through each other."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 12))
    low = rng.integers(-9, 9, (n, 2))
    box = np.stack([low[:, 0], low[:, 0] + 1, low[:, 1], low[:, 1] + rng.integers(0, 3, n)], axis=1)
    middle = [(box[:, k].min() + box[:, k + 1].max()) / 2 for k in (0, 2)]
    off = [
        tuple(abs((each[k] + each[k + 1]) / 2 - middle[k // 2]) for k in (0, 2)) for each in box.astype(float).tolist()
    ]
    rank = _off_middle(box)
    assert all((rank[a] < rank[b]) == (off[a] < off[b]) for a in range(n) for b in range(n))
    level, temporary = np.arange(n) * 3 + rng.integers(0, 2), rng.random(n) < 0.6
    before = np.unique(np.sort(rng.integers(0, n, (n, 2)), axis=1), axis=0)
    before = before[before[:, 0] < before[:, 1]]

    def due(row):
        over = [due(upper) for lower, upper in before.tolist() if lower == row] if temporary[row] else []
        return min((each for each in over if each is not None), default=None if temporary[row] else int(level[row]))

    expected = [int(level[row]) if due(row) is None else due(row) for row in range(n)]
    assert _due(level, temporary, before).tolist() == expected


@pytest.mark.parametrize("n", [1, 3])
def test_a_piece_is_put_on_in_a_step_of_its_own(n):
    """However few bricks it has, nothing else is in its step, though a single brick lies beside it."""
    floor = [("3003", x, y, 0) for x in range(0, 8, 2) for y in (0, 2)]
    bricks = table(*floor, ("3003", 0, 0, 3), *(("3003", 2, 2, 3 * k) for k in range(1, n + 1)))
    _, steps = planned(replace(bricks, piece=(np.arange(len(bricks)) > 8).astype(np.int16)))
    [joined] = [step for step in steps if step.joined]
    assert len(joined.bricks) == 0
    assert joined.action == Action.JOIN


def test_what_holds_stands_on_the_table_or_on_what_is_there():
    """Of bricks in an order, each above the lowest level needs one below it that came before, and none after."""
    below = {0: [], 1: [], 2: [0], 3: [2, 9], 4: [9]}
    planner = SimpleNamespace(level={0: 5, 1: 5, 2: 8, 3: 9, 4: 9}, below=below)
    assert not Planner._holds(SimpleNamespace(level={0: 5, 1: 5}, below={0: [1], 1: []}), [0, 1])
    for order, holds in (([0, 1, 2, 3], True), ([0, 2, 1], True), ([0, 1, 4], False), ([1, 2], False), ([0, 3], False)):
        assert Planner._holds(planner, order) == holds


@pytest.mark.parametrize("small", [False, True])
def test_the_wide_floor_of_a_sub_assembly_is_no_picture(small):
    """What lies flat by itself is built tile by tile; what is put onto a model has steps like all of it."""
    bricks = table(*(("3460", x, y, 0) for x in (0, 8, 16) for y in range(17)))
    planner, _ = planned(bricks)
    rows = np.arange(len(bricks))
    units = planner._units(0, rows, rows, np.ones(len(rows), dtype=bool))
    assert planner._items(rows, units, {}, small=small).tile.any() != small


def test_the_wide_floor_of_a_piece_is_no_picture():
    """A plate of 48 bricks that is built by itself, and put onto four feet, has steps like all of the model."""
    feet = [("3003", x, y, z) for x in (0, 22) for y in (0, 14) for z in (0, 3)]
    floor = [("3024", x, y, 6) for x in range(24) for y in range(16)]
    top = [("3460", x, y, 7) for x in (0, 8, 16) for y in range(16)]
    bricks = table(*feet, *floor, *top)
    bricks = replace(bricks, piece=np.repeat([0, 1], [len(feet), len(floor) + len(top)]).astype(np.int16))
    _, steps = planned(bricks)
    of_piece = [step for step in steps if steps.submodels[step.submodel].kind == Kind.PIECE]
    assert len(of_piece) > len(floor) / MOST
    assert max(len(step.bricks) for step in of_piece) <= MOST
