"""Lone bricks: features stay, specks take the colour around them."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.unit_bricks.colour_votes import Ballot
from legorize_addon.core.unit_bricks.specks import MISSED, OWN, without_specks

BLACK, GREY, WHITE, PALE = 0, 72, 15, 19
CODES = np.array([BLACK, WHITE, PALE, GREY], dtype=np.int16)
LIGHT = np.array([0.0, 100.0, 96.0, 50.0])
"""Differences between these are those of lightness: easy to count with."""


def ballot_of(votes) -> Ballot:
    """Return the ballot of cells with votes for black, white, pale and grey."""
    votes = np.asarray(votes, dtype=float)
    difference = np.abs(LIGHT[:, None] - LIGHT)
    return Ballot(CODES, votes, np.where(votes > 0, -votes @ difference, -np.inf), difference)


def wall(middle, votes, around=WHITE):
    """Return what becomes of the middle brick of three by three, a wall of one layer in another colour."""
    colour = np.full((1, 3, 3), around, dtype=np.int16)
    colour[0, 1, 1] = middle
    every = np.zeros((9, 4))
    every[:, np.flatnonzero(around == CODES)] = 1
    every[4] = votes
    found = without_specks(colour, np.ones(colour.shape, bool), ballot_of(every), height=1)
    assert (np.delete(found.ravel(), 4) == around).all()
    return found[0, 1, 1]


@pytest.mark.parametrize(
    ("middle", "votes", "becomes"),
    [
        # an eye: its surface is black, and would be missed
        (BLACK, [0.8, 0.2, 0, 0], BLACK),
        # half of it is enough, less is not
        (BLACK, [0.5, 0.5, 0, 0], WHITE),
        (BLACK, [0.6, 0.4, 0, 0], BLACK),
        # grey between black and white: nothing is grey here
        (GREY, [0.4, 0.6, 0, 0], WHITE),
        (GREY, [0.3, 0.4, 0, 0.3], WHITE),
        # a shade that hardly differs, all over the brick
        (PALE, [0, 0, 1, 0], WHITE),
        # nothing of a surface is seen there
        (GREY, [0, 0, 0, 0], WHITE),
    ],
)
def test_features_stay_and_specks_go(middle, votes, becomes):
    """Black eyes stay on white; greys of edges, shades and what has no surface become white."""
    assert wall(middle, votes) == becomes


def test_both_bounds_are_where_they_are_said_to_be():
    """A brick just above both keeps its colour, one just below either does not."""
    # of a share s of black and the rest white, white costs 100 s and black 100 (1 - s): missed by 200 s - 100
    share = max(OWN, (100 + MISSED) / 200)
    assert wall(BLACK, [share + 0.001, 1 - share - 0.001, 0, 0]) == BLACK
    assert wall(BLACK, [share - 0.001, 1 - share + 0.001, 0, 0]) == WHITE
    # black and grey, in equal parts, are missed by far, but a hair less of the own colour is too little
    assert wall(BLACK, [OWN, 0, 0, 1 - OWN]) == BLACK
    assert wall(BLACK, [OWN - 0.001, 0, 0, 1 - OWN + 0.001]) == WHITE


def test_a_column_of_plates_is_one_brick_and_two_bricks_are_a_patch():
    """Three plates above each other stand alone together; a neighbour at a corner is a companion."""
    colour = np.full((3, 3, 3), WHITE, dtype=np.int16)
    colour[:, 1, 1] = GREY
    seen = np.ones(colour.shape, bool)
    votes = np.tile([0.4, 0.6, 0, 0], (27, 1))
    assert (without_specks(colour, seen, ballot_of(votes), height=3) == WHITE).all()
    colour[0, 0, 0] = GREY
    np.testing.assert_array_equal(without_specks(colour, seen, ballot_of(votes), height=3), colour)


def test_specks_beside_each_other_go_one_after_the_other():
    """Two lone bricks of different colours do not take each other's, and what gets alone then goes as well."""
    colour = np.array([[[WHITE, GREY, PALE, WHITE, WHITE]]], dtype=np.int16)
    votes = np.tile([0.4, 0.6, 0, 0], (5, 1))
    found = without_specks(colour, np.ones(colour.shape, bool), ballot_of(votes), height=1)
    assert (found == WHITE).all()


def test_nothing_changes_where_nothing_is_known():
    """Without a colour that anybody votes for, or a neighbour to be like, everything stays."""
    colour = np.array([[[GREY, COLOUR_EMPTY, BLACK]]], dtype=np.int16)
    seen = colour != COLOUR_EMPTY
    np.testing.assert_array_equal(without_specks(colour, seen, ballot_of(np.ones((2, 4))), height=1), colour)
    none = Ballot(CODES[:0], np.zeros((2, 0)), np.zeros((2, 0)), np.zeros((0, 0)))
    np.testing.assert_array_equal(without_specks(colour, seen, none, height=1), colour)


def lone(colour, seen):
    """Return the visible cells that no visible neighbour is like, cell by cell."""
    found = np.zeros(seen.shape, bool)
    for place in np.argwhere(seen):
        near = [tuple(place + way) for way in product((-1, 0, 1), repeat=3) if any(way)]
        near = [each for each in near if min(each) >= 0 and (np.array(each) < seen.shape).all() and seen[each]]
        found[tuple(place)] = all(colour[each] != colour[tuple(place)] for each in near)
    return found


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_only_lone_bricks_change_and_only_to_colours_beside_them(seed):
    """In one round, a cell changes if it is alone, and becomes like a visible neighbour that is not."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, *CODES, WHITE, WHITE], size=(2, 4, 4)).astype(np.int16)
    seen = np.isin(colour, CODES) & (rng.random(colour.shape) < 0.9)
    ballot = ballot_of(rng.random((int(seen.sum()), 4)) * rng.integers(0, 2, (int(seen.sum()), 4)))
    found, before = without_specks(colour, seen, ballot, height=1), lone(colour, seen)
    np.testing.assert_array_equal(found[~seen], colour[~seen])
    # a patch of several bricks never changes, but may be joined by others
    assert (found == colour)[~before].all()
    for place in np.argwhere(found != colour):
        near = tuple(slice(max(each - 1, 0), each + 2) for each in place)
        assert found[tuple(place)] in found[near][seen[near]]
        assert (found[near][seen[near]] == found[tuple(place)]).sum() > 1
    np.testing.assert_array_equal(without_specks(found, seen, ballot, height=1), found)


@pytest.mark.parametrize(("weight", "becomes"), [(0.0, WHITE), (0.99, WHITE), (1.0, GREY), (3.0, GREY)])
def test_weighted_surface_has_no_specks(weight, becomes):
    """What counts at least twice as much as usual keeps its colour, even one that its surface hardly has."""
    colour = np.full((1, 3, 3), WHITE, dtype=np.int16)
    colour[0, 1, 1] = GREY
    votes = np.tile([0, 1.0, 0, 0], (9, 1))
    votes[4] = [0.4, 0.5, 0, 0.1]
    ballot = replace(ballot_of(votes), weight=np.where(np.arange(9) == 4, weight, 0.0))
    assert without_specks(colour, np.ones(colour.shape, bool), ballot, height=1)[0, 1, 1] == becomes
