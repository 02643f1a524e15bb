"""Lots and their pictures."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

from legorize_addon.core.instructions.lots import Lot, callout, lots_of, picture_of, placed, rgb_of, size_of
from legorize_addon.core.instructions.picture import MM
from tests.core.any_bricks import CATALOGUE, any_bricks, everything


@settings(deadline=None, max_examples=50)
@given(any_bricks())
def test_lots_are_the_bricks(bricks):
    """Each brick is in the lot of its part and colour, and counts add up."""
    lots, lot = lots_of(bricks, CATALOGUE)
    assert np.bincount(lot, minlength=len(lots)).tolist() == [each.count for each in lots]
    for row, number in enumerate(lot.tolist()):
        assert lots[number].part == bricks.part[row]
        assert CATALOGUE.colours[lots[number].colour].code == bricks.colour[row]
    assert len({(each.part, each.colour) for each in lots}) == len(lots)


def test_large_parts_come_first():
    """Of one colour the parts with more studs stand before those with fewer."""
    bricks = everything()
    lots, _ = lots_of(bricks, CATALOGUE)
    for one, other in pairwise(lots):
        first, second = (CATALOGUE.parts[each.part] for each in (one, other))
        if one.colour == other.colour:
            assert first.length * first.width >= second.length * second.width


def test_sizes_and_colours_are_told():
    """Sizes are those of the titles; colours those of the catalogue."""
    for part in CATALOGUE.parts:
        if not part.corner:
            assert part.title.endswith(size_of(part))
    bricks = everything()
    assert rgb_of(bricks, CATALOGUE)[0].tolist() == list(
        CATALOGUE.colours[CATALOGUE.colour_row(int(bricks.colour[0]))].rgb
    )


def test_callouts_keep_to_their_room():
    """Entries lie beside each other as long as there is room, and then below."""
    lots = [(Lot(part, 0, 3), None) for part in range(8)]
    wide, narrow = (callout(lots, CATALOGUE, room=room, scale=0.4) for room in (500.0, 40.0))
    assert wide.width > narrow.width
    assert narrow.width <= 40.0
    assert narrow.height > wide.height


def test_pictures_are_placed_by_their_corner():
    """A picture lies where it is put, as large as is asked."""
    picture = picture_of(Lot(0, 0, 1), CATALOGUE)
    group = placed(picture, 10.0, 20.0, 0.5)
    a, _, _, d, e, f = group.matrix
    assert a == d == pytest.approx(0.5 * MM)
    assert a * picture.low[0] + e == pytest.approx(10.0)
    assert d * picture.low[1] + f == pytest.approx(20.0)
