"""What goes on together."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.blocking import column_pairs
from legorize_addon.core.building.units import find_units, presses
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from tests.core.standing import CATALOGUE, table


def units(*rows, node=None, ground=None):
    """Return the units of bricks."""
    bricks = table(*rows)
    level = bricks.corner[:, 2].astype(np.int64)
    node = np.arange(len(bricks)) if node is None else np.array(node)
    ground = level == level.min() if ground is None else np.array(ground)
    pairs = contact_graph(bricks, CATALOGUE).pairs
    return find_units(node, level, pairs, column_pairs(bricks, CATALOGUE), ground=ground)


def groups(found):
    """Return the bricks of each unit."""
    return sorted(np.flatnonzero(found.unit == unit).tolist() for unit in np.unique(found.unit))


def test_standing_bricks_are_units_of_their_own():
    """A tower has one unit a brick, each before the next."""
    found = units(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6))
    assert groups(found) == [[0], [1], [2]]
    assert found.before.tolist() == [[0, 1], [1, 2]]


def test_what_rests_on_a_unit_comes_after_it():
    """Two beams over one hanging plate: one of them takes it along, the other is put onto both later."""
    found = units(("3003", 0, 0, 0), ("3003", 6, 0, 0), ("3010", 0, 0, 3), ("3010", 4, 0, 3), ("3023", 3, 0, 2))
    assert groups(found) == [[0], [1], [2, 4], [3]]
    assert [found.unit[2], found.unit[3]] in found.before.tolist()
    assert not found.pressed.any()


HOOKS = (
    *(("3003", 0, 0, 3 * k) for k in range(3)),
    ("3008", 0, 0, 9),
    ("3008", 0, 1, 9),
    ("3024", 3, 0, 8),
    ("3023", 3, 0, 7, 1),
    ("3024", 2, 1, 8),
    ("3023", 2, 0, 7, 1),
)
"""Two beams; below each hangs a plate that reaches under the other one without touching it."""


def test_units_that_each_wait_for_the_other_are_given_up():
    """Hooks that do not hang together cannot be put on as one: what hangs is pressed from below, what stands is not."""
    found = units(*HOOKS)
    assert np.flatnonzero(found.pressed).tolist() == [5, 6, 7, 8]
    assert groups(found) == [[row] for row in range(9)]
    assert not found.loose.any()


@pytest.mark.parametrize(("n", "together"), [(28, True), (27, False)])
def test_units_that_each_wait_for_the_other_become_one(n, together):
    """Hooks that a plate holds together are one sub-assembly, if it is at most a quarter of all bricks."""
    across = ("3023", 5, 0, 8, 1)
    found = units(*HOOKS, across, *(("3003", 0, 6, 3 * k) for k in range(n - 10)))
    assert (list(range(3, 10)) in groups(found)) == together
    assert found.pressed.any() != together


def test_under_a_piece_it_is_pressed():
    """A piece takes nothing along: what hangs from it alone is pressed, after it was joined."""
    bricks = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
    found = units(*bricks, node=[0, 1, 1, 2], ground=[True, False, False, False])
    assert found.pressed.tolist() == [False, False, False, True]
    assert [found.unit[2], found.unit[3]] in found.before.tolist()


def test_pieces_under_which_something_hangs_press():
    """What would have to be pressed under a piece is found before the piece is made."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
    below = column_pairs(bricks, CATALOGUE)
    assert presses(Assembly(bricks, CATALOGUE), below, np.array([0, 5, 5, 9]))
    assert not presses(Assembly(bricks, CATALOGUE), below, np.arange(4))


def test_what_nothing_holds_is_loose():
    """A brick in the air is named."""
    assert units(("3003", 0, 0, 0), ("3003", 9, 0, 3)).loose.tolist() == [False, True]


def test_rank_decides_who_takes_along_what_hangs():
    """Of two beams of one level over a plate, the one of the lesser rank takes it along."""
    bricks = table(("3003", 0, 0, 0), ("3003", 6, 0, 0), ("3010", 0, 0, 3), ("3010", 4, 0, 3), ("3023", 3, 0, 2))
    level = bricks.corner[:, 2].astype(np.int64)
    pairs, below = contact_graph(bricks, CATALOGUE).pairs, column_pairs(bricks, CATALOGUE)
    for first, expected in ((2, [2, 4]), (3, [3, 4])):
        rank = (np.arange(5) != first).astype(np.int64)
        found = find_units(np.arange(5), level, pairs, below, ground=level == 0, rank=rank)
        assert expected in groups(found)


def test_a_brick_takes_along_what_a_piece_would_leave_to_be_pressed():
    """Under a beam of a piece and a single beam of the same level, a plate goes with the single one."""
    bricks = (
        *(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6)),
        *(("3003", 6, 0, 0), ("3003", 6, 0, 3), ("3010", 4, 0, 6), ("3023", 3, 0, 5)),
    )
    found = units(*bricks, node=[0, 1, 1, 2, 3, 4, 5], ground=[True, False, False, True, False, False, False])
    assert not found.pressed.any()
    assert [5, 6] in groups(found)
