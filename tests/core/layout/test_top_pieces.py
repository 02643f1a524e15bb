"""What the top of one brick is cut into: the cheapest cover, against all covers of a few studs by hand."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.layout.top_pieces import HIDDEN, HOLDS, NONE, SEEN, Piece, Tops
from legorize_addon.core.model import footprint
from tests.core.any_bricks import CATALOGUE
from tests.core.layout.cells import RED

ROW = CATALOGUE.part_row


def pieces(number, studs, price, turn=0, colour=RED):
    """Return what a part is exchanged for: numbers, places and turns."""
    found = Tops(CATALOGUE, price).pieces(ROW(number), turn, colour, np.array(studs, np.uint8))
    return [(CATALOGUE.parts[each.part].number, each.corner, each.turn) for each in found]


def test_a_free_plate_is_a_tile():
    """Whatever a part costs: there is one as before."""
    for price in (0, 1, np.inf):
        assert pieces("3022", [[SEEN] * 2] * 2, price) == [("3068b", (0, 0, 0), 0)]
        assert pieces("3023", [[SEEN, HIDDEN]], price, turn=1) == [("3069b", (0, 0, 0), 1)]


def test_what_nobody_sees_stays():
    """Studs in hollows, and those that hold something, are no reason for a tile."""
    assert pieces("3023", [[HIDDEN], [HIDDEN]], 0) == []
    assert pieces("3023", [[HOLDS], [HOLDS]], 0) == []


def test_a_plate_is_cut_where_that_pays():
    """A 2 x 4 plate of which a half holds something: a part more for four studs."""
    studs = [[HOLDS] * 2] * 2 + [[SEEN] * 2] * 2
    assert pieces("3020", studs, 3.9) == [("3022", (0, 0, 0), 0), ("3068b", (2, 0, 0), 0)]
    assert pieces("3020", studs, 4) == []


def test_a_plate_of_which_there_is_no_tile():
    """Two tiles cover a 2 x 6 plate; not if there may be no part more."""
    assert len(pieces("3795", [[SEEN] * 2] * 6, 2)) == 2
    assert pieces("3795", [[SEEN] * 2] * 6, np.inf) == []


def test_a_brick_becomes_two_plates_and_a_tile():
    """Two parts more for eight studs."""
    studs = [[SEEN] * 2] * 4
    plate = ("3020", (0, 0, 0), 0)
    assert pieces("3001", studs, 3.9) == [plate, ("3020", (0, 0, 1), 0), ("87079", (0, 0, 2), 0)]
    assert pieces("3001", studs, 4) == []


def test_a_tall_brick_has_bricks_below():
    """Nine plates are two bricks, two plates and a tile."""
    found = pieces("14716", [[SEEN]], 0)
    assert [number for number, *_ in found] == ["3005", "3005", "3024", "3024", "3070b"]
    assert [corner[2] for _, corner, _ in found] == [0, 3, 6, 7, 8]


def test_corners():
    """The missing stud of a corner plate is covered by nothing."""
    assert len(pieces("2420", [[SEEN, SEEN], [SEEN, NONE]], 1)) == 2


def test_colours_without_tiles():
    """A plate stays where no tile is made in its colour."""
    tile, plate = ROW("3068b"), ROW("3022")
    code = next(c.code for c in CATALOGUE.colours if CATALOGUE.exists_in(plate, c.code))
    without = Tops(CATALOGUE, np.inf)
    for colour in CATALOGUE.codes.tolist():
        if CATALOGUE.exists_in(plate, colour):
            found = without.pieces(plate, 0, colour, np.full((2, 2), SEEN, np.uint8))
            assert found == ((Piece(tile, (0, 0, 0), 0),) if CATALOGUE.exists_in(tile, colour) else ())
    assert code in CATALOGUE.codes


@given(
    st.sampled_from(["3020", "3021", "3022", "3710", "2420", "3001", "3004", "2357"]),
    st.integers(0, 3),
    st.sampled_from([0.0, 1.0, 2.0]),
    st.integers(0, 2**32 - 1),
)
def test_same_cells_same_colour(number, turn, price, seed):
    """The pieces fill the cells of the part once, are made in its colour, and no tile lies where a stud holds."""
    part = CATALOGUE.parts[ROW(number)]
    xy = footprint(part, turn)
    studs = np.full(xy.max(axis=0) + 1, NONE, np.uint8)
    studs[tuple(xy.T)] = np.random.default_rng(seed).choice([HOLDS, HIDDEN, SEEN], len(xy))
    found = Tops(CATALOGUE, price).pieces(ROW(number), turn, RED, studs)
    cells = [
        (x + piece.corner[0], y + piece.corner[1], z + piece.corner[2])
        for piece in found
        for x, y in footprint(CATALOGUE.parts[piece.part], piece.turn).tolist()
        for z in range(CATALOGUE.parts[piece.part].height)
    ]
    if found:
        assert sorted(cells) == sorted((x, y, z) for x, y in xy.tolist() for z in range(part.height))
        left = 0
        for piece in found:
            own, (x, y, _) = CATALOGUE.parts[piece.part], piece.corner
            assert CATALOGUE.exists_in(piece.part, RED)
            under = studs[tuple(np.add(footprint(own, piece.turn), (x, y)).T)]
            if own.profile == "tile":
                assert HOLDS not in under
            elif piece.corner[2] + own.height == part.height:
                left += np.count_nonzero(under == SEEN)
        # it pays
        assert left + price * len(found) < np.count_nonzero(studs == SEEN) + price


@pytest.mark.parametrize("seed", range(20))
def test_the_fewest_parts(seed):
    """Along a row of four studs no cover costs less than the one that is found, all cuts tried."""
    studs = np.random.default_rng(seed).choice([HOLDS, SEEN], (4, 1)).astype(np.uint8)
    tile = {1: "3070b", 2: "3069b", 3: "63864", 4: "2431"}
    costs = []
    for cuts in range(8):
        ends = [0, *(n + 1 for n in range(3) if cuts >> n & 1), 4]
        runs = [studs[low:high, 0] for low, high in pairwise(ends)]
        seen = sum(np.count_nonzero(run == SEEN) for run in runs if (run == HOLDS).any())
        costs.append(1.5 * len(runs) + seen)
    found = pieces("3710", studs, 1.5)
    cost = 1.5 * len(found) + sum(
        np.count_nonzero(studs[x : x + CATALOGUE.parts[ROW(number)].length] == SEEN)
        for number, (x, _, _), _ in found
        if number not in tile.values()
    )
    whole = 1.5 + np.count_nonzero(studs == SEEN)
    assert (cost if found else whole) == min(*costs, whole)
