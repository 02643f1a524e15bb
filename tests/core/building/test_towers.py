"""Towers that fall over while they grow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from legorize_addon.core.building import towers
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.building.towers import STEADY, _arrivals, tipping, unbalanced
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph, middles
from legorize_addon.core.statics.stability import stability
from tests.core.standing import CATALOGUE, table


def falling(bricks, **options):
    """Return the towers that fall as bricks are built in their order, one a step."""
    pairs = contact_graph(bricks, CATALOGUE).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=np.zeros(len(bricks), bool))
    moves = replace(steps.moves, step=np.arange(len(bricks), dtype=np.int32))
    return tipping(replace(steps, moves=moves), Assembly(bricks, CATALOGUE), pairs, **options)


def test_leaning_tower_falls_at_the_step_that_is_too_much():
    """A beam of eight studs held at its end by one brick tips it over; a beam of two does not."""
    [found] = falling(table(("3005", 0, 0, 0), ("3008", 0, 0, 3)))
    assert found.step == 1
    assert found.bricks.tolist() == [0, 1]
    assert falling(table(("3003", 0, 0, 0), ("3003", 0, 0, 3))) == []


@pytest.mark.parametrize(("n_beams", "distance"), [(2, 0.15), (4, 0.08)])
def test_feet_of_several_cells_have_an_edge_as_well(n_beams, distance):
    """Beams on a brick of two studs shift its weight towards its edge: what is left to it must be a tenth of a stud."""
    bricks = table(("3004", 1, 0, 0), *(("3009", 0, 0, 3 * (1 + level)) for level in range(n_beams)))
    middle = np.average(middles(bricks, CATALOGUE), axis=0, weights=CATALOGUE.mass[bricks.part])
    assert 3 - middle[0] == pytest.approx(distance, abs=0.01)
    assert bool(falling(bricks)) == (distance < STEADY)


def test_tower_that_is_caught_later_falls_before():
    """A bridge stands in the end, but one of its halves falls before the other half comes."""
    bridge = (("3005", 0, 0, 0), ("3010", 0, 0, 3), ("3005", 7, 0, 0), ("3010", 4, 0, 3), ("3008", 0, 0, 6))
    found = falling(table(*bridge))
    assert {tower.step for tower in found} == {2, 3}
    assert stability(Assembly(table(*bridge), CATALOGUE)).stable


def test_prop_keeps_a_tower_upright():
    """Where a prop is put under the free end, the tower stands; it is asked for with feet and middle."""
    asked = []

    def prop(tower):
        asked.append(tower)
        return 7, 0

    assert falling(table(("3005", 0, 0, 0), ("3008", 0, 0, 3)), prop=prop) == []
    assert asked[0].middle == pytest.approx([(0.43 * 0.5 + 3.03 * 4) / 3.46, 0.5])
    assert asked[0].feet.min(axis=0).tolist() == [0, 0]


def test_useless_prop_is_refused_in_the_end():
    """A prop that says None lets the tower fall, once."""
    assert len(falling(table(("3005", 0, 0, 0), ("3008", 0, 0, 3), ("3008", 0, 0, 6)), prop=lambda _: None)) == 1


def test_verdict_agrees_with_the_force_test():
    """Towers of beams on one brick: those that fall by their feet fall by forces as well."""
    for length, number in ((2, "3004"), (3, "3622"), (4, "3010"), (6, "3009"), (8, "3008")):
        bricks = table(("3003", 0, 0, 0), (number, 0, 0, 3))
        fell = bool(falling(bricks))
        tip = stability(Assembly(bricks, CATALOGUE)).tipping.min() < 0.8
        assert fell == tip, length


def plain(bricks, prop):
    """Look at all bricks in place anew after each one: what hangs together, its weight, and where it stands."""
    pairs, mass = contact_graph(bricks, CATALOGUE).pairs.tolist(), CATALOGUE.mass[bricks.part]
    place = middles(bricks, CATALOGUE)
    parts = [CATALOGUE.parts[part] for part in bricks.part.tolist()]
    cells = [
        {(x + i, y + j) for i in range(part.length) for j in range(part.width) if z == bricks.corner[:, 2].min()}
        for (x, y, z), part in zip(bricks.corner.tolist(), parts, strict=True)
    ]
    fallen, found, towers = set(), [], []
    for row in range(len(bricks)):
        touched = {one + other - row for one, other in pairs if row in (one, other)}
        joined = [tower for tower in towers if tower & touched]
        tower = {row}.union(*joined)
        towers = [each for each in towers if each not in joined] + [tower]
        rows = sorted(tower)
        while not tower & fallen and any(cells[each] for each in rows):
            feet = np.array([[x + i, y + j] for each in rows for x, y in cells[each] for i in (0, 1) for j in (0, 1)])
            middle = np.average(place[rows], axis=0, weights=mass[rows])
            within = -(ConvexHull(feet).equations @ (*middle, 1)).max()
            if within >= STEADY:
                break
            square = prop(row, middle)
            if square is None:
                fallen.add(row)
                found.append((row, rows, middle.round(6).tolist(), sorted(feet.tolist())))
            else:
                cells[row] = cells[row] | {square}
    return found


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 10**6))
def test_towers_that_fall_are_those_found_by_looking_at_all_bricks(seed):
    """Heaps of beams on few feet; a prop comes under the middle of some of them, once a step."""
    rng = np.random.default_rng(seed)
    rows, taken = [], np.zeros((9, 4, 12), bool)
    parts = (("3005", 1), ("3004", 2), ("3010", 4), ("3008", 8))
    for _ in range(rng.integers(1, 25)):
        number, wide = parts[rng.integers(4)]
        x, y, z = int(rng.integers(0, 13 - wide)), int(rng.integers(0, 4)), 3 * int(rng.integers(0, 3))
        cells = np.s_[z : z + 3, y, x : x + wide]
        if not taken[cells].any():
            taken[cells] = True
            rows.append((number, x, y, z))
    bricks = table(*sorted(rows, key=lambda row: row[3]))
    pairs = contact_graph(bricks, CATALOGUE).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=np.zeros(len(bricks), bool))
    asked = []

    def prop(step, middle):
        asked.append(step)
        corner = np.abs(middle % 1 - 0.5).max() > 0.4
        return None if step % 3 or corner or asked.count(step) > 1 else tuple(np.floor(middle).astype(int).tolist())

    moves = replace(
        steps.moves,
        action=np.zeros(len(bricks), np.uint8),
        brick=np.arange(len(bricks), dtype=np.int32),
        submodel=np.zeros(len(bricks), np.int32),
        step=np.arange(len(bricks), dtype=np.int32),
        piece=np.zeros(len(bricks), np.int16),
        pressed=np.zeros(len(bricks), bool),
    )
    main = replace(steps.submodels[0], rows=np.arange(len(bricks)))
    steps = replace(steps, moves=moves, submodels=(main,))
    found = tipping(steps, Assembly(bricks, CATALOGUE), pairs, prop=lambda tower: prop(tower.step, tower.middle))
    asked.clear()
    told = [
        (each.step, each.bricks.tolist(), each.middle.round(6).tolist(), sorted(each.feet.tolist())) for each in found
    ]
    assert told == plain(bricks, prop)


def test_what_comes_to_a_table_when():
    """Bricks by themselves, pieces as a whole without the supports that they lost, and nothing after a removal."""
    told = [
        *((Action.PLACE, 2, 1), (Action.PLACE, 4, 2), (Action.JOIN, -1, 2), (Action.PLACE, 3, 1)),
        *((Action.REMOVE, 3, 1), (Action.PLACE, 0, 0), (Action.JOIN, -1, 1), (Action.PLACE, 1, 0)),
        *((Action.REMOVE, 1, 0), (Action.PLACE, 5, 0)),
    ]
    action, brick, submodel = zip(*told, strict=True)
    n = len(told)
    moves = Moves(
        action=np.array(action, np.uint8),
        brick=np.array(brick, np.int32),
        piece=np.zeros(n, np.int16),
        submodel=np.array(submodel, np.int32),
        pressed=np.zeros(n, bool),
        step=np.arange(n, dtype=np.int32),
    )
    rows = ([0, 1, 5], [2, 3], [4])
    made = (Submodel(k, Kind.PIECE if k else Kind.MAIN, k - 1, k, np.array(rows[k]), k) for k in range(3))
    steps = Steps(moves, tuple(made))
    assert list(_arrivals(steps, 0)) == [(5, [0]), (6, [2, 4]), (7, [1])]
    assert list(_arrivals(steps, 1)) == [(0, [2]), (2, [4]), (3, [3])]
    assert list(_arrivals(steps, 2)) == [(1, [4])]


def test_a_tower_stands_on_the_foot_of_an_inverted_slope_alone():
    """What stands over the fall of an inverted slope pulls it over; a brick of the same size bears it."""
    tower = [("3005", 1, 0, 3 + 3 * level) for level in range(3)]
    for number, falls in (("3665", True), ("3004", False)):
        bricks = table((number, 0, 0, 0), *tower)
        assert stability(Assembly(bricks, CATALOGUE)).stands != falls
        assert bool(falling(bricks)) == falls


@pytest.mark.parametrize(
    ("arm", "plates", "falls"),
    [
        (("3007", 4, 8, 3), ((9, 8), (10, 8), (11, 8), (11, 9)), True),
        (("3007", 4, 8, 3), ((10, 8), (11, 8), (11, 9)), False),
        (("3001", 7, 8, 3), ((8, 8), (9, 8), (8, 9), (9, 9)), False),
    ],
    ids=["at its end", "between two fingers", "in the middle"],
)
def test_a_sub_assembly_that_leans_is_named(arm, plates, falls):
    """One that stands on what hangs from an end of it falls; not if that is below its middle, or it is small."""
    rows = [arm, *(("3024", x, y, 2) for x, y in plates)]
    bricks = table(*(("3008", 0, y, 0) for y in range(16)), *rows)
    gone = np.zeros(len(bricks), bool)
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=gone)
    assert [each.kind for each in steps.submodels] == [Kind.MAIN, Kind.SUBASSEMBLY]
    upright, leaning = unbalanced(steps, Assembly(bricks, CATALOGUE), pairs)
    assert upright == ()
    assert [found.bricks.tolist() for found in leaning] == [[16 + k for k in range(len(rows))]] * falls


def test_a_table_looks_at_its_own_bricks(monkeypatch):
    """Many small pieces take as long as one large model, not each as long as all."""
    seen = []
    bricks = table(*(("3005", 4 * each, 0, level) for each in range(6) for level in (0, 3)))
    bricks = replace(bricks, piece=np.repeat(np.arange(6, dtype=np.int16), 2))
    pairs = contact_graph(bricks, CATALOGUE).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=np.zeros(len(bricks), bool))
    monkeypatch.setattr(towers, "middles", lambda some, catalogue: seen.append(len(some)) or middles(some, catalogue))
    unbalanced(steps, Assembly(bricks, CATALOGUE), pairs)
    assert sorted(seen) == [2] * 5 + [12]
