"""Places as a builder finds them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.report.places import SHOWN, listed, pillar_places, square_name
from tests.core.standing import CATALOGUE, table


def test_squares_count_from_the_front_left_corner():
    """Columns are numbers to the right, rows are letters to the back, whatever the model's coordinates are."""
    assembly = Assembly(table(("3001", -4, 7, 0), ("3005", 23, 34, 0)), CATALOGUE)
    assert square_name(assembly, 0) == "1 A"
    assert square_name(assembly, 1) == "28 AB"


def test_a_pillar_is_one_place():
    """Bricks on each other are named once, from the lowest layer to the highest, by their first step."""
    rows = [("3003", 0, 0, 0), *(("3005", 4, 2, z) for z in (0, 3, 6)), ("3024", 8, 1, 0)]
    bricks = replace(table(*rows), step=np.array([0, 4, 5, 6, 2], dtype=np.int32))
    places = pillar_places(Assembly(bricks, CATALOGUE), np.array([False, True, True, True, True]))
    assert places == ["9 B in layer 1 (step 3)", "5 C in layers 1 to 3 (step 5)"]


def test_long_lists_are_cut_short():
    """The first dozen is named, the rest is counted."""
    assert listed(["1 A"]) == "on the layer maps at 1 A"
    assert listed([str(each) for each in range(SHOWN + 3)]).endswith("11 and 3 more")
