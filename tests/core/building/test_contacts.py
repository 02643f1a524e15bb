"""What touches what while a model is built."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from tests.core.building.heaps import cells_of, heap, shared_studs
from tests.core.standing import CATALOGUE, table


def test_one_piece_is_the_whole_connection():
    """A model in one piece with a support has exactly the contacts of all its bricks."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3005", 3, 0, 0))
    found = building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, True]))
    wanted = contact_graph(bricks, CATALOGUE)
    assert sorted(map(tuple, found.pairs.tolist())) == sorted(map(tuple, wanted.pairs.tolist()))
    assert found.studs.sum() == wanted.studs.sum()
    assert found.collisions == 0


def test_supports_of_a_piece_pass_through_the_others():
    """A support on the table of the upper piece meets nothing of the lower one, in whose cells it stands."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3001", 0, 0, 6), ("3005", 3, 0, 3), ("3004", 2, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 0, 1, 1, 0], np.int16))
    found = building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, False, True, False]))
    assert (3, 4) not in map(tuple, found.pairs.tolist())
    assert (3, 2) in map(tuple, found.pairs.tolist())
    assert found.collisions == 0


def test_supports_of_the_first_piece_are_in_the_way_of_all():
    """They are still there when the others are joined: sharing a cell with them is a collision."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3005", 3, 0, 3))
    bricks = replace(bricks, piece=np.array([0, 1, 0], np.int16))
    assert building_contacts(Assembly(bricks, CATALOGUE), temporary=np.array([False, False, True])).collisions == 3


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**6))
def test_contacts_are_those_of_bricks_that_ever_meet(seed):
    """Two bricks of the model always meet; a support meets its own piece, and one of the first piece all of them."""
    rng = np.random.default_rng(seed)
    model, supports = heap(seed, most=8, n_pieces=3), heap(seed + 1, most=8, n_pieces=3)
    joined = (np.concatenate([getattr(model, k), getattr(supports, k)]) for k in model.__slots__)
    bricks = type(model)(*joined).take(rng.permutation(len(model) + len(supports)))
    order = np.arange(len(model) + len(supports)) >= len(model)
    temporary = order[np.random.default_rng(seed).permutation(len(order))]
    piece, cells = bricks.piece.tolist(), cells_of(bricks)
    n, studs = len(bricks), {}
    groups = [[row for row in range(n) if not temporary[row]]]
    for number in sorted({piece[row] for row in range(n) if temporary[row]}):
        groups += [[row for row in range(n) if piece[row] == number or (number == 0 and not temporary[row])]]
    claims = []
    for group in groups:
        counted = [cell for row in group for cell in cells[row]]
        claims.append(len({cell for cell in counted if counted.count(cell) > 1}))
    found = building_contacts(Assembly(bricks, CATALOGUE), temporary=temporary)
    assert found.collisions == max(claims)
    if max(claims) == 0:
        for group in groups:
            for one in group:
                for other in group:
                    studs |= {(one, other): shared_studs(cells[one], cells[other])}
        expected = {pair: number for pair, number in studs.items() if number}
        assert dict(zip(map(tuple, found.pairs.tolist()), found.studs.tolist(), strict=True)) == expected
        assert len(found.pairs) == len(expected)
