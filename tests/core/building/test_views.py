"""From which corner steps are seen."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.building.views import quarter_turns
from legorize_addon.core.model.assembly import Assembly
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


def test_no_turn_helps_inside():
    """What is closed in on all sides is looked at from the front, as everything."""
    ring = [("3010", 0, 0, 0), ("3010", 0, 3, 0), ("3004", 0, 1, 0, 1), ("3004", 3, 1, 0, 1)]
    walls = [(number, x, y, 3 * level, *turn) for level in range(6) for number, x, y, _, *turn in ring]
    bricks = table(*walls, ("3003", 1, 1, 0))
    assert turns(bricks, [0] * len(walls) + [1]) == [0, 0]
