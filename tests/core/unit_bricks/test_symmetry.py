"""Cells that differ from their image by next to nothing become like it."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.unit_bricks.colour_votes import Ballot
from legorize_addon.core.unit_bricks.symmetry import CLOSE, NEAR, mirror_colours, mirror_shapes

RED, WHITE = 4, 15
CODES = np.array([RED, WHITE], dtype=np.int16)


def ballot_of(votes, apart):
    """Return the ballot of all cells, given the share of red votes of each, of two colours so far apart."""
    share = np.asarray(votes, dtype=float).reshape(-1)
    difference = np.array([[0.0, apart], [apart, 0.0]])
    both = np.stack([share, 1 - share], axis=1)
    return Ballot(CODES, both, -both @ difference, difference)


def test_missing_images_are_filled_where_the_mesh_is_the_same():
    """A cell that is half covered but for a little is filled as its image; one in which the mesh is not stays empty."""
    share = np.ones((6, 4, 10))
    solid = np.ones((6, 4, 10), dtype=bool)
    solid[0, 0, 0] = solid[0, 1, 9] = False
    share[0, 0, 0], share[0, 0, 9] = 0.5 - 0.9 * NEAR, 0.5
    share[0, 1, 9], share[0, 1, 0] = 0.5 - 1.1 * NEAR, 0.5
    found = mirror_shapes(solid, share, height=1)
    assert found[0, 0, 0]
    assert not found[0, 1, 9]
    assert found.sum() == solid.sum() + 1


def test_of_two_shapes_the_closer_one_is_taken():
    """Where one column has two plates and its image three, both become what the mesh is closer to."""
    for inside, wanted in ((0.3, 2), (0.7, 3)):
        solid, share = np.ones((6, 4, 10), dtype=bool), np.ones((6, 4, 10))
        solid[2, 1, 3] = False
        share[2, 1, [3, 6]] = inside
        found = mirror_shapes(solid, share, height=3)
        assert found[:3, 1, [3, 6]].sum(axis=0).tolist() == [wanted, wanted]
        np.testing.assert_array_equal(found, found[..., ::-1])


def test_bodies_without_symmetry_stay():
    """Nothing is added to a stair."""
    solid = np.tril(np.ones((8, 8), dtype=bool))[None]
    assert mirror_shapes(solid, np.ones(solid.shape), height=1) is solid
    colour = np.where(solid, RED, COLOUR_EMPTY).astype(np.int16)
    assert mirror_colours(colour, solid, ballot_of(np.ones(solid.sum()), 30), height=1) is colour


@pytest.mark.parametrize("height", [1, 3])
def test_close_votes_are_settled_for_both(height):
    """Of a cell and its image that nearly tie, both become the colour that both together see more of."""
    votes = np.full((3, 4, 10), 1.0)
    votes[:, 0, 0], votes[:, 0, 9] = 0.45, 0.65
    votes[:, 1, 0], votes[:, 1, 9] = 0.35, 0.55
    colour = np.where(votes >= 0.5, RED, WHITE).astype(np.int16)
    seen = np.ones(colour.shape, dtype=bool)
    found = mirror_colours(colour, seen, ballot_of(votes, 40), height=height)
    assert (found[:, 0] == RED).all()
    assert (found[:, 1, [0, 9]] == WHITE).all()
    assert (found[:, 1, 1:9] == RED).all()
    # the other half at the same votes takes the same
    flipped = mirror_colours(colour[..., ::-1], seen, ballot_of(votes[..., ::-1], 40), height=height)
    np.testing.assert_array_equal(flipped, found)


def test_what_is_painted_on_one_side_stays():
    """A patch on one eye is no tie: its colour stays, and the other eye is not painted."""
    votes = np.full((3, 4, 10), 1.0)
    votes[:, 2, 3] = 0.0
    colour = np.where(votes >= 0.5, RED, WHITE).astype(np.int16)
    seen = np.ones(colour.shape, dtype=bool)
    far, near = (ballot_of(votes, apart) for apart in (CLOSE + 0.1, CLOSE - 0.1))
    np.testing.assert_array_equal(mirror_colours(colour, seen, far, height=3), colour)
    assert (np.unique(mirror_colours(colour, seen, near, height=3)[:, 2, [3, 6]])).size == 1


def test_unseen_sides_do_not_soften_what_is_seen():
    """A column of which two plates have no surface keeps a colour that is clearly that of the third."""
    votes = np.full((3, 4, 10), 1.0)
    votes[2, 2, 3] = 0.0
    colour = np.full(votes.shape, RED, dtype=np.int16)
    colour[:, 2, 3] = WHITE
    ballot = ballot_of(votes, 2 * CLOSE)
    number = np.arange(votes.size).reshape(votes.shape)[:2, 2, [3, 6]].ravel()
    ballot.votes[number] = 0.0
    found = mirror_colours(colour, np.ones(votes.shape, dtype=bool), ballot, height=3)
    np.testing.assert_array_equal(found, colour)


def test_hidden_cells_stay():
    """Cells that nobody sees have no colour to settle."""
    votes = np.full((3, 4, 10), 0.45)
    votes[..., 5:] = 0.55
    seen = np.ones(votes.shape, dtype=bool)
    seen[1] = False
    colour = np.where(seen, np.where(votes >= 0.5, RED, WHITE), COLOUR_ANY).astype(np.int16)
    found = mirror_colours(colour, seen, ballot_of(votes[seen], 40), height=3)
    assert (found[1] == COLOUR_ANY).all()
    np.testing.assert_array_equal(found, found[..., ::-1])


@pytest.mark.parametrize(("moved", "like"), [(0, True), (1, False), (2, True)])
def test_what_was_moved_along_the_axis_stays(moved, like):
    """Half a stud along x, a cell is no image of that across the middle; along y it is."""
    share = np.ones((3, 4, 10))
    solid = np.ones((3, 4, 10), dtype=bool)
    solid[:, 0, 0] = False
    share[:, 0, 0], share[:, 0, 9] = 0.5 - 0.9 * NEAR, 0.5
    cells = np.zeros((1, 4, 10), np.uint8)
    cells[0, 0, 9] = moved
    assert mirror_shapes(solid, share, height=3, moved=cells)[:, 0, 0].all() == like
    colour = np.full((3, 4, 10), RED, np.int16)
    colour[:, 0, 0] = WHITE
    ballot = ballot_of(np.full(colour.shape, 0.5), 1.0)
    found = mirror_colours(colour, solid | True, ballot, height=3, moved=cells)
    assert (found[0, 0, 0] == found[0, 0, 9]) == like
