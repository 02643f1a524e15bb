"""The check of a building order finds every fault that is put into one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.check import ROOM, walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from tests.core.standing import CATALOGUE, table

TOWER = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6))
GATE = (("3005", 0, 0, 0), ("3005", 5, 0, 0), ("3009", 0, 0, 3), ("3005", 2, 0, 0))


def moves_of(*rows, pieces=None, pressed=()):
    """Return moves from (action, brick), each a step of its own; each piece is a submodel."""
    n = len(rows)
    return Moves(
        action=np.array([Action[action.upper()] for action, _ in rows], np.uint8),
        brick=np.array([brick for _, brick in rows], np.int32),
        piece=np.array(pieces or [0] * n, np.int16),
        submodel=np.array(pieces or [0] * n, np.int32),
        pressed=np.isin([brick for _, brick in rows], pressed),
        step=np.arange(n, dtype=np.int32),
    )


def steps_of(moves, bricks):
    """Return moves as the steps of a model and its pieces."""
    numbers = range(int(bricks.piece.max()) + 1)
    kinds = [Kind.PIECE if number else Kind.MAIN for number in numbers]
    rows = [np.flatnonzero(bricks.piece == number) for number in numbers]
    made = (Submodel(number, kinds[number], min(number, 1) - 1, number, rows[number], number) for number in numbers)
    return Steps(moves, tuple(made))


def walked(bricks, moves, temporary=()):
    """Return what the check finds."""
    gone = np.isin(np.arange(len(bricks)), temporary)
    return walk(
        steps_of(moves, bricks),
        Assembly(bricks, CATALOGUE),
        building_contacts(Assembly(bricks, CATALOGUE), temporary=gone),
        temporary=gone,
    )


def test_tower_can_be_built():
    """From below, nothing is wrong."""
    found = walked(table(*TOWER), moves_of(("place", 0), ("place", 1), ("place", 2)))
    assert found.buildable
    assert found.n_steps == 3


def test_brick_in_the_air_is_found():
    """The top before the middle touches nothing."""
    found = walked(table(*TOWER), moves_of(("place", 0), ("place", 2), ("place", 1)))
    assert found.in_air.tolist() == [2]
    assert found.squeezed.tolist() == [1]
    assert found.bad_steps.tolist() == [1, 2]
    assert not found.buildable


def test_missing_brick_is_found():
    """An order that forgets a brick, or leaves a support, does not end as the model."""
    assert walked(table(*TOWER), moves_of(("place", 0), ("place", 1))).wrong_end.tolist() == [2]
    gate = moves_of(("place", 0), ("place", 1), ("place", 3), ("place", 2))
    assert walked(table(*GATE), gate, temporary=[3]).wrong_end.tolist() == [3]


def test_support_that_comes_out():
    """A pillar under a gate can be pulled down; the gate stays."""
    gate = moves_of(("place", 0), ("place", 1), ("place", 3), ("place", 2), ("remove", 3))
    assert walked(table(*GATE), gate, temporary=[3]).buildable


def test_support_on_the_model_is_stuck():
    """A pillar between two bricks of the model cannot be pulled down."""
    bricks = table(("3003", 0, 0, 0), ("3005", 0, 0, 3), ("3005", 1, 1, 3), ("3003", 0, 0, 6))
    order = moves_of(("place", 0), ("place", 1), ("place", 2), ("place", 3), ("remove", 2))
    assert walked(bricks, order, temporary=[2]).stuck.tolist() == [2]


def test_supports_come_out_from_below():
    """The upper half of a pillar cannot go before the lower one."""
    bricks = table(("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3009", 0, 0, 6), ("3005", 5, 0, 0), ("3005", 5, 0, 3))
    build = [("place", row) for row in (0, 1, 3, 4, 2)]
    assert walked(bricks, moves_of(*build, ("remove", 3), ("remove", 4)), temporary=[3, 4]).buildable
    found = walked(bricks, moves_of(*build, ("remove", 4), ("remove", 3)), temporary=[3, 4])
    assert found.stuck.tolist() == [4]


def test_model_that_falls_without_its_support_is_found():
    """Taking away the only pillar leaves the brick on it in the air."""
    bricks = table(("3005", 0, 0, 0), ("3003", 5, 5, 0), ("3005", 0, 0, 3))
    order = moves_of(("place", 0), ("place", 1), ("place", 2), ("remove", 0))
    assert walked(bricks, order, temporary=[0]).in_air.tolist() == [2]


@pytest.mark.parametrize(
    ("corner", "loose"),
    [((0, 0, 3), []), ((3, 0, 3), [1])],
    ids=["on the first piece", "beside it"],
)
def test_piece_must_touch_when_joined(corner, loose):
    """A piece is joined where studs hold it, and nowhere else."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", *corner)), piece=np.array([0, 1], np.int16))
    found = walked(bricks, moves_of(("place", 1), ("place", 0), ("join", NOBODY), pieces=[1, 0, 1]))
    assert found.loose_pieces.tolist() == loose


def test_piece_cannot_pass_what_lies_over_it():
    """A piece that belongs under a roof cannot come from above."""
    bricks = table(("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3010", 0, 0, 6), ("3004", 1, 0, 9), ("3005", 3, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 0, 0, 0, 1], np.int16))
    rows = [("place", 4), *(("place", row) for row in range(4)), ("join", NOBODY)]
    assert walked(bricks, moves_of(*rows, pieces=[1, 0, 0, 0, 0, 1])).loose_pieces.tolist() == [1]


def test_pieces_do_not_hold_each_other_before_they_are_joined():
    """A brick over another piece is in the air until that is joined."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", 0, 0, 3)), piece=np.array([1, 0], np.int16))
    assert walked(bricks, moves_of(("place", 0), ("place", 1), pieces=[1, 0])).in_air.tolist() == []
    high = replace(table(("3003", 0, 0, 0), ("3003", 5, 0, 0), ("3003", 0, 0, 3)), piece=np.array([1, 0, 0], np.int16))
    found = walked(high, moves_of(("place", 0), ("place", 1), ("place", 2), pieces=[1, 0, 0]))
    assert found.in_air.tolist() == [2]


@pytest.mark.parametrize(("n_plates", "cramped"), [(0, False), (2, False), (3, True), (4, True)])
def test_room_for_fingers_is_nine_plates(n_plates, cramped):
    """Below a plate that is pressed under a beam eleven plates up there is room over two plates, not over three."""
    mast = [("3003", 0, 0, 6 + 3 * k) for k in range(4)]
    plates = [("3024", 3, 0, 6 + k) for k in range(n_plates)]
    bricks = table(*mast, ("3010", 0, 0, 18), *plates, ("3024", 3, 0, 17))
    last = len(bricks) - 1
    found = walked(bricks, moves_of(*(("place", row) for row in range(last + 1)), pressed=[last]))
    assert found.cramped.tolist() == [last] * cramped


class Plain:
    """A walk through moves that looks at all cells of all bricks each time."""

    def __init__(self, steps, bricks, pairs):
        self.steps, self.table = steps, steps.submodel_of(len(bricks)).tolist()
        self.low, self.squares = bricks.corner[:, 2].tolist(), []
        parts = [CATALOGUE.parts[part] for part in bricks.part.tolist()]
        self.top = [low + part.height for low, part in zip(self.low, parts, strict=True)]
        for (x, y, _), part in zip(bricks.corner.tolist(), parts, strict=True):
            self.squares.append({(x + i, y + j) for i in range(part.length) for j in range(part.width)})
        self.floor = [steps.floor(each.number, bricks, pairs) for each in steps.submodels]
        self.pairs, self.placed = pairs.tolist(), set()
        self.faults = {name: [] for name in ("in_air", "squeezed", "covered", "cramped", "stuck", "loose_pieces")}
        self.bad = set()

    def there(self, table):
        """Return what is in place on a table."""
        return {row for row in self.placed if self.table[row] == table}

    def stands(self, row):
        """Tell whether a brick stands on its table."""
        return self.low[row] == self.floor[self.table[row]]

    def near(self, row, among):
        """Return those below a brick that it touches, and those above."""
        below = {one for one, other in self.pairs if other == row and one in among}
        return below, {other for one, other in self.pairs if one == row and other in among}

    def over(self, row, among):
        """Tell whether something lies over the place of a brick."""
        return any(self.squares[row] & self.squares[each] and self.top[each] > self.low[row] for each in among)

    def blame(self, fault, row, step, *, when=True):
        """Note a fault."""
        if when:
            self.faults[fault].append(row)
            self.bad.add(step)

    def place(self, row, step, pressed):
        """Put a brick in place."""
        there = self.there(self.table[row])
        below, above = self.near(row, there)
        self.blame("in_air", row, step, when=not (below or above or self.stands(row)))
        self.blame("squeezed", row, step, when=bool((below or self.stands(row)) and above))
        self.blame("covered", row, step, when=not pressed and self.over(row, there))
        lower = [each for each in there if self.squares[each] & self.squares[row] and self.low[each] < self.low[row]]
        ground = max([self.top[each] for each in lower] + [self.floor[self.table[row]]])
        self.blame("cramped", row, step, when=pressed and self.low[row] - ground < ROOM)
        self.placed.add(row)

    def join(self, number, step):
        """Put a submodel onto its parent."""
        parent, mine = self.steps.submodels[number].parent, self.there(number)
        there = self.there(parent) - mine
        in_the_way = any(self.over(row, there) for row in mine)
        self.table = [parent if each == number else each for each in self.table]
        held = any(self.stands(row) or self.near(row, there)[0] for row in mine)
        self.blame("loose_pieces", number, step, when=in_the_way or not held)

    def remove(self, rows, steps):
        """Take bricks out; what is left must be held, and each of them by what is left and by those after it."""
        there = self.there(self.table[rows[0]])
        for turn, row in enumerate(rows):
            left = there - set(rows[: turn + 1])
            lower = {each for each in left if self.squares[each] & self.squares[row] and self.low[each] < self.low[row]}
            self.blame("stuck", row, steps[turn], when=bool(lower))
        self.placed -= set(rows)
        left = there - set(rows)
        held = {row for row in left if self.stands(row)}
        while more := {row for row in left - held if set.union(*self.near(row, held))}:
            held |= more
        for row in left - held:
            self.blame("in_air", row, steps[-1])
        for row, step in zip(rows[::-1], steps[::-1], strict=True):
            holds = self.stands(row) or bool(set.union(*self.near(row, held)))
            held |= {row} if holds else set()
            self.blame("in_air", row, step, when=not holds)


def random_order(rng):
    """Return bricks in one to three pieces, some of which are taken out again, and moves mostly from below."""
    rows, taken = [], np.zeros((26, 5, 5), bool)
    parts = (("3005", 1, 1, 3), ("3004", 2, 1, 3), ("3003", 2, 2, 3), ("3024", 1, 1, 1), ("3010", 4, 1, 3))
    for _ in range(rng.integers(2, 36)):
        number, a, b, height = parts[rng.integers(len(parts))]
        x, y, z = (int(rng.integers(0, most)) for most in (6 - a, 6 - b, rng.choice([10, 27 - height])))
        cells = np.s_[z : z + height, y : y + b, x : x + a]
        if not taken[cells].any():
            taken[cells] = True
            rows.append((number, x - 2, y, z + 3))
    bricks, n = table(*rows), len(rows)
    piece = rng.integers(0, 3, n) * (rng.random(n) < rng.choice([0, 0.3]))
    bricks = replace(bricks, piece=np.unique(piece, return_inverse=True)[1].reshape(-1).astype(np.int16))
    order = np.argsort(bricks.corner[:, 2] + rng.integers(-1, 2, n) * rng.integers(0, 9, n), kind="stable").tolist()
    told = [("place", row, int(bricks.piece[row])) for row in order if rng.random() < 0.95]
    for number in range(1, int(bricks.piece.max()) + 1):
        told.insert(int(rng.integers(1, len(told) + 1)) if rng.random() < 0.3 else len(told), ("join", NOBODY, number))
    temporary = rng.random(n) < 0.3
    gone = [row for kind, row, _ in told if kind == "place" and temporary[row] and rng.random() < 0.9]
    told += [("remove", row, int(bricks.piece[row])) for row in gone]
    pressed = np.flatnonzero(rng.random(n) < 0.3)
    moves = moves_of(*((kind, row) for kind, row, _ in told), pieces=[each for *_, each in told], pressed=pressed)
    return bricks, moves, temporary


@settings(deadline=None, max_examples=120)
@given(st.integers(0, 10**6))
def test_faults_are_those_of_a_walk_that_looks_at_all_cells(seed):
    """Whatever is placed, joined and taken out in whatever order, the same bricks and steps are blamed."""
    bricks, moves, temporary = random_order(np.random.default_rng(seed))
    steps = steps_of(moves, bricks)
    contacts = building_contacts(Assembly(bricks, CATALOGUE), temporary=temporary)
    found = walk(steps, Assembly(bricks, CATALOGUE), contacts, temporary=temporary)
    plain, rows = Plain(steps, bricks, contacts.pairs), list(range(len(moves)))
    while rows:
        row, action = rows[0], moves.action[rows[0]]
        if action == Action.PLACE:
            plain.place(int(moves.brick[row]), row, bool(moves.pressed[row]))
        elif action == Action.JOIN:
            plain.join(int(moves.submodel[row]), row)
        else:
            same = [row for row in rows if moves.submodel[row] == moves.submodel[rows[0]]]
            run = [row for turn, row in enumerate(same) if row == rows[0] + turn]
            plain.remove(moves.brick[run].tolist(), run)
            rows = rows[len(run) - 1 :]
        rows = rows[1:]
    for name, blamed in plain.faults.items():
        assert sorted(getattr(found, name).tolist()) == sorted(blamed), name
    assert found.bad_steps.tolist() == sorted(plain.bad)
    wrong = {row for row in range(len(bricks)) if (row in plain.placed) == temporary[row]}
    assert set(found.wrong_end.tolist()) == wrong
    assert found.n_steps == len(moves)
