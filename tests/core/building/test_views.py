"""From which corner steps are seen."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.building.views import MOST, RISE, SEEN, WAYS, quarter_turns
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from tests.core.standing import CATALOGUE, table

WALL = [("3009", 0, 0, 3 * k) for k in range(8)]
"""Six studs wide, eight bricks high."""


def in_steps(bricks, step):
    """Return the steps in which bricks are placed."""
    n = len(bricks)
    order = np.argsort(step, kind="stable").astype(np.int32)
    moves = Moves(
        action=np.full(n, Action.PLACE, np.uint8),
        brick=order,
        piece=np.zeros(n, np.int16),
        submodel=np.zeros(n, np.int32),
        pressed=np.zeros(n, bool),
        step=np.array(step, np.int32)[order],
    )
    main = Submodel(0, Kind.MAIN, -1, 0, np.arange(n), 0)
    return Steps(moves, (main,))


def turns(bricks, step):
    """Return the quarter turns of steps in which bricks are placed."""
    return quarter_turns(in_steps(bricks, step), Assembly(bricks, CATALOGUE)).tolist()


def test_what_stands_in_front_is_seen_from_the_front():
    """A brick before a wall needs no turn, nor does the wall."""
    assert turns(table(*WALL, ("3005", 2, -2, 0)), [0] * 8 + [1]) == [0, 0]


@pytest.mark.parametrize(("place", "expected"), [((2, 2), (1, 2)), ((-2, 0), (0, 2, 3)), ((2, -2), (0,))])
def test_what_is_hidden_is_seen_from_another_corner(place, expected):
    """Behind the wall the model is turned; where it is seen from the front it is not."""
    assert turns(table(*WALL, ("3005", *place, 0)), [0] * 8 + [1])[1] in expected


def test_view_stays_as_long_as_it_helps_and_comes_back():
    """Two steps behind the wall are seen from the same corner, a third before it from the front."""
    bricks = table(*WALL, ("3005", 2, 2, 0), ("3005", 3, 2, 0), ("3005", 2, -2, 0))
    first, second, third, fourth = turns(bricks, [0] * 8 + [1, 2, 3])
    assert first == fourth == 0
    assert second == third != 0


def test_a_piece_hides_what_is_behind_it_once_it_is_joined():
    """A brick behind a wall that is a piece is seen from the front before the wall is put on, but not after."""
    bricks = table(*WALL, ("3005", 2, 2, 0), ("3005", 2, 3, 0))
    order = [*range(8), 8, NOBODY, 9]
    moves = Moves(
        action=np.array([Action.PLACE] * 9 + [Action.JOIN, Action.PLACE], np.uint8),
        brick=np.array(order, np.int32),
        piece=np.zeros(11, np.int16),
        submodel=np.array([1] * 8 + [0, 1, 0], np.int32),
        pressed=np.zeros(11, bool),
        step=np.array([0] * 8 + [1, 2, 3], np.int32),
    )
    main = Submodel(0, Kind.MAIN, NOBODY, 0, np.array([8, 9]), 0)
    wall = Submodel(1, Kind.PIECE, 0, 1, np.arange(8), 1)
    found = quarter_turns(Steps(moves, (main, wall)), Assembly(bricks, CATALOGUE)).tolist()
    assert found[1] == 0
    assert found[3] in (1, 2)


def test_no_turn_helps_inside():
    """What is closed in on all sides is looked at from the front, as everything."""
    ring = [("3010", 0, 0, 0), ("3010", 0, 3, 0), ("3004", 0, 1, 0, 1), ("3004", 3, 1, 0, 1)]
    walls = [(number, x, y, 3 * level, *turn) for level in range(6) for number, x, y, _, *turn in ring]
    bricks = table(*walls, ("3003", 1, 1, 0))
    assert turns(bricks, [0] * len(walls) + [1]) == [0, 0]


def plain_turns(bricks, step):
    """Follow each line of sight cell by cell, from each cell of each brick that is put on."""
    owner = {}
    for row, (part, (x, y, z)) in enumerate(zip(bricks.part.tolist(), bricks.corner.tolist(), strict=True)):
        size = CATALOGUE.parts[part]
        owner |= {
            (x + i, y + j, z + k): row
            for i in range(size.length)
            for j in range(size.width)
            for k in range(size.height)
        }
    top, found, last = max(z for *_, z in owner), [], 0

    def share(row, there, turn):
        alone = free = 0
        for x, y, z in (cell for cell, brick in owner.items() if brick == row):
            far = range(1, top - z + 2)
            met = {owner.get((x + WAYS[turn][0] * k, y + WAYS[turn][1] * k, z + RISE * k)) for k in far}
            alone += row not in met
            free += not met & there
        return free / max(alone, 1)

    for number in range(max(step) + 1):
        new = [row for row in range(len(bricks)) if step[row] == number]
        there = {row for row in range(len(bricks)) if step[row] <= number}
        seen = [sum(share(row, there, turn) >= SEEN for row in new) for turn in range(4)]
        good = [turn for turn in (0, last) if seen[turn] > MOST * len(new)]
        last = good[0] if good else max((0, last, 1, 3, 2), key=lambda turn: (seen[turn], turn == 0))
        found.append(last)
    return found


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10**6))
def test_turns_are_those_of_lines_of_sight_followed_cell_by_cell(seed):
    """Bricks at random in a small box, put on one or two a step."""
    rng = np.random.default_rng(seed)
    taken, rows = np.zeros((14, 7, 7), bool), []
    parts = (("3005", 1, 1, 3), ("3004", 2, 1, 3), ("3003", 2, 2, 3), ("3024", 1, 1, 1), ("3010", 4, 1, 3))
    for _ in range(rng.integers(2, 70)):
        number, a, b, height = parts[rng.integers(len(parts))]
        x, y, z = (int(rng.integers(0, most)) for most in (8 - a, 8 - b, 15 - height))
        cells = np.s_[z : z + height, y : y + b, x : x + a]
        if not taken[cells].any():
            taken[cells] = True
            rows.append((number, x - 3, y, z))
    step = (np.arange(len(rows)) // rng.integers(1, 5)).tolist()
    assert turns(table(*rows), step) == plain_turns(table(*rows), step)
