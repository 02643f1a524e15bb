"""The building order: every brick on something that holds, none squeezed in, supports out at the end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.check import walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import order_moves
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from tests.core.standing import CATALOGUE, table

FOOT_BEAM_HANGER = (("3004", 0, 0, 0), ("3009", 0, 0, 3), ("3024", 5, 0, 2))
"""A foot, a beam on it, and a plate under the beam's free end."""


def order(bricks, temporary=None):
    """Return the moves of bricks, and which are taken out."""
    gone = np.zeros(len(bricks), bool) if temporary is None else np.asarray(temporary, bool)
    found = building_contacts(bricks, CATALOGUE, temporary=gone)
    return order_moves(bricks, found.pairs, temporary=gone), found, gone


def sequence(moves):
    """Return the moves as (action, brick)."""
    return [
        (Action(action).name, brick) for action, brick in zip(moves.action.tolist(), moves.brick.tolist(), strict=True)
    ]


def test_levels_from_below():
    """A tower is built from the ground, whatever the order of its table."""
    moves, _, _ = order(table(("3003", 0, 0, 6), ("3003", 0, 0, 0), ("3003", 0, 0, 3)))
    assert moves.brick.tolist() == [1, 2, 0]
    assert not moves.pressed.any()
    assert moves.step.tolist() == [0, 1, 2]


def test_what_hangs_is_pressed_from_below():
    """A plate under a beam comes after the beam, and is marked."""
    moves, _, _ = order(table(*FOOT_BEAM_HANGER))
    assert moves.brick.tolist() == [0, 1, 2]
    assert moves.pressed.tolist() == [False, False, True]


def test_nothing_is_squeezed_in():
    """Of a pillar under a beam that is wide open below, the lower plate goes onto the upper one, never between two."""
    bricks = table(("3009", 0, 0, 3), ("3004", 0, 0, 0), ("3024", 5, 0, 2), ("3024", 5, 0, 1), ("3005", 5, 0, 6))
    moves, found, gone = order(bricks)
    assert walk(moves, bricks, CATALOGUE, found, temporary=gone).buildable


def test_a_gap_of_several_bricks_is_closed_from_one_end():
    """A plate under a tall brick would close the column beside it from below: it comes after all of the column."""
    pillar = [("3005", 0, 0, 3 * k) for k in range(4)]
    column = [("3024", 3, 0, 11), ("3024", 3, 0, 10), ("3005", 3, 0, 7), ("3005", 3, 0, 4), ("3024", 3, 0, 3)]
    bricks = table(*pillar, ("3010", 0, 0, 12), ("14716", 2, 0, 3), *column, ("3023", 2, 0, 2))
    moves, found, gone = order(bricks)
    assert moves.brick.tolist()[-5:] == [7, 8, 9, 10, 11]
    assert walk(moves, bricks, CATALOGUE, found, temporary=gone).buildable


def test_support_stands_before_its_brick_and_goes_last():
    """The support under the free end is placed before the beam and taken out at the end, lowest brick first."""
    bricks = table(("3004", 0, 0, 0), ("3009", 0, 0, 6), ("3004", 0, 0, 3), ("3005", 5, 0, 0), ("3005", 5, 0, 3))
    moves, found, gone = order(bricks, [False, False, False, True, True])
    told = sequence(moves)
    assert told.index(("PLACE", 4)) < told.index(("PLACE", 1))
    assert told[-2:] == [("REMOVE", 3), ("REMOVE", 4)]
    assert walk(moves, bricks, CATALOGUE, found, temporary=gone).buildable


def test_pieces_are_built_first_and_joined_in_their_turn():
    """The upper piece is built on the table, then the first up to it; then it is joined, and the rest follows."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3003", 0, 0, 6), ("3005", 5, 0, 0), ("3004", 4, 0, 6))
    # the last brick hangs on nothing but the upper piece, on which it lies
    bricks = replace(bricks, piece=np.array([0, 1, 1, 0, 0], np.int16))
    moves, _, _ = order(bricks)
    told = sequence(moves)
    joint = told.index(("JOIN", NOBODY))
    assert {brick for _, brick in told[:2]} == {1, 2}
    assert {brick for action, brick in told[2:joint] if action == "PLACE"} == {0, 3}


def test_floating_bricks_come_last():
    """What nothing holds is placed at the end of the order, all the same once."""
    moves, _, _ = order(table(("3005", 9, 9, 9), ("3003", 0, 0, 0), ("3003", 0, 0, 3)))
    assert moves.brick.tolist() == [1, 2, 0]


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
    """All bricks are placed once; those in the air at their time are in components that do not reach the ground."""
    moves, found, gone = order(bricks)
    assert sorted(moves.brick.tolist()) == list(range(len(bricks)))
    assert (np.diff(moves.step) >= 0).all()
    told = walk(moves, bricks, CATALOGUE, found, temporary=gone)
    floating = np.flatnonzero(~contact_graph(bricks, CATALOGUE).grounded)
    assert np.isin(told.in_air, floating).all()
    assert len(told.squeezed) == len(told.wrong_end) == 0
