"""The building order: every brick pushed on from above, what hangs with what it hangs from, supports out at the end."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.check import walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.items import MOST
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import _next, _Writer, plan_steps
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.building.tables import Put, Table
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.profiles import columns
from tests.core.building.heaps import cells_of, heap
from tests.core.standing import CATALOGUE, table

FOOT_BEAM_HANGER = (("3004", 0, 0, 0), ("3009", 0, 0, 3), ("3024", 5, 0, 2))
"""A foot, a beam on it, and a plate under the beam's free end."""


def planned(bricks, temporary=None):
    """Return the steps of bricks, and what the check finds."""
    gone = np.zeros(len(bricks), bool) if temporary is None else np.asarray(temporary, bool)
    contacts = building_contacts(Assembly(bricks, CATALOGUE), temporary=gone)
    steps = plan_steps(bricks, CATALOGUE, contacts.pairs, temporary=gone)
    return steps, walk(steps, Assembly(bricks, CATALOGUE), contacts, temporary=gone)


def sequence(steps):
    """Return the moves as (action, brick, submodel)."""
    moves = steps.moves
    columns = (moves.action.tolist(), moves.brick.tolist(), moves.submodel.tolist())
    return [(Action(action).name, brick, submodel) for action, brick, submodel in zip(*columns, strict=True)]


def test_towers_grow_from_the_ground():
    """A tower is built from below, whatever the order of its table, in one picture as it is small."""
    steps, found = planned(table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 3)))
    assert steps.moves.brick.tolist() == [1, 2, 0]
    assert len(steps) == 1
    assert found.buildable


def test_what_hangs_is_put_on_with_what_it_hangs_from():
    """The plate goes under its beam on the table, and both go onto the foot: nothing is pressed from below."""
    steps, found = planned(table(*FOOT_BEAM_HANGER))
    assert [each.kind for each in steps.submodels] == [Kind.MAIN, Kind.SUBASSEMBLY]
    assert sorted(steps.submodels[1].rows.tolist()) == [1, 2]
    told = sequence(steps)
    assert told[:2] == [("PLACE", 2, 1), ("PLACE", 1, 1)]
    assert told.index(("PLACE", 0, 0)) < told.index(("JOIN", -1, 1))
    assert not steps.moves.pressed.any()
    assert found.buildable


def test_what_hangs_on_what_hangs_is_a_sub_assembly_of_its_own():
    """A chain that steps down twice is built on the table from its lowest plate."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3023", 3, 0, 5), ("3024", 4, 0, 4))
    steps, found = planned(bricks)
    [small] = steps.submodels[1:]
    assert small.rows.tolist() == [4, 3, 2]
    assert found.buildable


def test_two_ends_that_hang_at_two_heights_nest():
    """In a sub-assembly that stands on its lower end, what hangs at the other end is one again."""
    mast = [("3003", 0, 0, 3 * k) for k in range(4)]
    bricks = table(*mast, ("3008", 0, 0, 12), ("3005", 7, 0, 9), ("3005", 7, 0, 6), ("3024", 4, 0, 11))
    steps, found = planned(bricks)
    assert found.buildable
    assert not steps.moves.pressed.any()
    assert sorted(steps.all_rows(1).tolist()) == [4, 5, 6, 7]


def test_pressed_where_a_piece_alone_holds_it():
    """A piece is whole when it is joined: what hangs from it alone is pressed under it, and marked."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 12), ("3003", 0, 0, 9), ("3001", 0, 0, 15), ("3024", 3, 0, 14))
    bricks = replace(bricks, piece=np.array([0, 1, 1, 1, 0], np.int16))
    high = [("3003", 0, 0, 3), ("3003", 0, 0, 6)]
    more = table(*high)
    together = type(bricks)(*(np.concatenate([getattr(bricks, k), getattr(more, k)]) for k in bricks.__slots__))
    steps, found = planned(together)
    assert together.part[steps.moves.brick[steps.moves.pressed]].tolist() == [CATALOGUE.part_row("3024")]
    assert found.buildable


def test_pressing_without_room_is_told():
    """With the ground two bricks below, no finger gets under the plate."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3001", 0, 0, 6), ("3024", 3, 0, 5))
    bricks = replace(bricks, piece=np.array([0, 1, 1, 0], np.int16))
    _, found = planned(bricks)
    assert found.cramped.tolist() == [3]


def test_support_stands_before_its_brick_and_goes_last():
    """The support under the free end is placed before the beam and taken out at the end, lowest brick first."""
    bricks = table(("3004", 0, 0, 0), ("3009", 0, 0, 6), ("3004", 0, 0, 3), ("3005", 5, 0, 0), ("3005", 5, 0, 3))
    steps, found = planned(bricks, [False, False, False, True, True])
    told = sequence(steps)
    assert told.index(("PLACE", 4, 0)) < told.index(("PLACE", 1, 0))
    assert told[-2:] == [("REMOVE", 3, 0), ("REMOVE", 4, 0)]
    assert found.buildable


def test_pieces_are_joined_before_what_comes_over_them():
    """The upper piece is built on the table and put on when the first has grown up to it; then the rest follows."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3003", 0, 0, 6), ("3005", 5, 0, 0), ("3004", 0, 0, 9))
    bricks = replace(bricks, piece=np.array([0, 1, 1, 0, 0], np.int16))
    steps, found = planned(bricks)
    told = sequence(steps)
    joint = told.index(("JOIN", -1, 1))
    assert told.index(("PLACE", 0, 0)) < joint < told.index(("PLACE", 4, 0))
    assert found.buildable
    assert steps.arrival(len(bricks))[[1, 2]].tolist() == [steps.moves.step[joint]] * 2


def test_the_mirror_image_of_a_submodel_is_found_among_others():
    """It has the images of all bricks and no others."""
    rows = {1: [0, 1], 2: [2, 3], 3: [5, 4], 4: [4], 5: [6]}
    planner = SimpleNamespace(image=np.array([4, 5, NOBODY, 6, 0, 1, 3]), all_rows=rows.__getitem__)
    assert [_Writer(planner)._images(number, list(rows)) for number in rows] == [[3], [], [1], [], []]


def test_equal_submodels_are_looked_for_in_twelve_steps():
    """The step itself and eleven more, as far as there are any."""
    table_of = Table([[]] * 30, [])
    assert list(_next([table_of], 5)) == list(range(5, 17))
    assert list(_next([table_of], 25)) == list(range(25, 30))


def test_a_step_is_mirrored_by_the_one_after_it():
    """The images of what is put on come right after it, not before and not later."""
    planner = SimpleNamespace(image=np.array([1, 0, NOBODY, 4, 3]))
    steps = [[Put(row, NOBODY, pressed=False)] for row in range(5)]
    found = [_Writer(planner)._mirrored(Table(steps, []), turn) for turn in range(4)]
    assert found == [True, False, False, True]


def test_floating_bricks_come_last():
    """What nothing holds is placed at the end of the order, all the same once."""
    steps, found = planned(table(("3005", 9, 9, 9), ("3003", 0, 0, 0), ("3003", 0, 0, 3)))
    assert steps.moves.brick.tolist() == [1, 2, 0]
    assert found.in_air.tolist() == [0]


@st.composite
def heaps(draw):
    """Draw bricks that do not overlap, on cells of a small box."""
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    rows, owner = [], np.zeros((8, 6, 6), bool)
    parts = (
        ("3005", 1, 1, 3),
        ("3004", 2, 1, 3),
        ("3003", 2, 2, 3),
        ("3024", 1, 1, 1),
        ("3023", 2, 1, 1),
        ("3010", 4, 1, 3),
    )
    for _ in range(draw(st.integers(1, 40))):
        number, a, b, height = parts[rng.integers(len(parts))]
        x, y, z = rng.integers(0, 7 - a), rng.integers(0, 7 - b), rng.integers(0, 9 - height)
        cells = np.s_[z : z + height, y : y + b, x : x + a]
        if not owner[cells].any():
            owner[cells] = True
            rows.append((number, int(x), int(y), int(z)))
    return table(*rows)


@settings(deadline=None, max_examples=150)
@given(heaps())
def test_every_brick_once_and_only_loose_ones_in_the_air(bricks):
    """All bricks are placed once, few a step; those in the air are in components that do not reach the ground."""
    steps, found = planned(bricks)
    moves = steps.moves
    assert sorted(moves.brick[moves.action == Action.PLACE].tolist()) == list(range(len(bricks)))
    assert np.isin(np.diff(moves.step), (0, 1)).all()
    assert np.bincount(moves.step).max() <= MOST
    floating = np.flatnonzero(~contact_graph(bricks, CATALOGUE).grounded)
    assert np.isin(found.in_air, floating).all()
    assert np.isin(found.covered, floating).all()
    assert len(found.squeezed) == len(found.wrong_end) == len(found.loose_pieces) == 0


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6))
def test_all_are_placed_joined_and_taken_out_once(seed):
    """Heaps in pieces with supports: no brick is forgotten, no support is left, no submodel is joined twice."""
    rng = np.random.default_rng(seed)
    bricks = heap(seed, most=25, n_pieces=1 + seed % 3, size=(6, 4, 12))
    temporary = rng.random(len(bricks)) < 0.3
    steps, found = planned(bricks, temporary)
    moves, cells = steps.moves, cells_of(bricks)
    placed, removed, joined = (moves.action == action for action in (Action.PLACE, Action.REMOVE, Action.JOIN))
    assert sorted(moves.brick[placed].tolist()) == list(range(len(bricks)))
    assert sorted(moves.brick[removed].tolist()) == np.flatnonzero(temporary).tolist()
    assert sorted(moves.submodel[joined].tolist()) == list(range(1, len(steps.submodels)))
    assert len(found.wrong_end) == 0
    for number in np.unique(moves.submodel[removed]):
        rows = moves.brick[removed & (moves.submodel == number)].tolist()
        for turn, row in enumerate(rows):
            low = min(z for *_, z in cells[row])
            squares = {(x, y) for x, y, _ in cells[row]}
            left = {(x, y) for other in rows[turn + 1 :] for x, y, z in cells[other] if z < low}
            assert not squares & left
    last = {int(number): int(moves.step[joined & (moves.submodel == number)][0]) for number in moves.submodel[joined]}
    for row in np.flatnonzero(placed | removed):
        assert moves.step[row] <= last.get(int(moves.submodel[row]), len(steps))


def test_what_lies_under_the_step_of_a_slope_goes_under_it_first():
    """A plate under the raised end of a curved slope stands on the table, though the slope reaches farther down."""
    for column, plate in ((1, 3), (0, 4)):
        bricks = table(("3001", 2, 0, 0), ("93606", 0, 0, 3), ("3023", column, 0, plate, 1), ("3001", 2, 2, 0))
        steps, found = planned(bricks)
        assert [each.kind for each in steps.submodels] == [Kind.MAIN, Kind.SUBASSEMBLY]
        assert sequence(steps)[:2] == [("PLACE", 2, 1), ("PLACE", 1, 1)]
        assert found.buildable


@pytest.mark.parametrize("part", [part for part in CATALOGUE.parts if part.wedge], ids=lambda part: part.number)
def test_wedge_plates_are_pressed_on_like_plates(part):
    """One on a plate, with a plate on its studs, is built from below; over studs in notches it hangs in the air."""
    bricks = table(("3958", 0, 0, 2), (part.number, 1, 1, 1, 1), ("3958", 0, 0, 0))
    steps, found = planned(bricks)
    assert steps.moves.brick.tolist() == [2, 1, 0]
    assert found.buildable
    own = columns(part, 1)
    alone = table(*(("3024", x, y, 0) for x, y in own.xy[~own.socket].tolist()), (part.number, 0, 0, 1, 1))
    _, found = planned(alone)
    assert not found.buildable
