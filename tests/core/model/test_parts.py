"""Parts: orientations and footprints."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.parts import footprint

CATALOGUE = load_catalogue()


@pytest.mark.parametrize("rows", [slice(0, 12), slice(12, 24)])
def test_twelve_parts_have_24_orientations(rows):
    """The 12 bricks have 24 different orientations, and so have the 12 plates."""
    shapes = {
        (part.number, tuple(map(tuple, footprint(part, turn)))) for part in CATALOGUE.parts[rows] for turn in range(4)
    }
    assert len(shapes) == 24
    assert sum(part.turns for part in CATALOGUE.parts[rows]) == 24


@pytest.mark.parametrize("part", CATALOGUE.parts, ids=lambda part: part.number)
def test_footprint_turns_counter_clockwise(part):
    """Each turn of a footprint is the one before rotated by (x, y) -> (-y, x) and moved back to zero."""
    for turn in range(4):
        cells = footprint(part, turn)
        assert cells.min(axis=0).tolist() == [0, 0]
        rotated = np.stack([-cells[:, 1], cells[:, 0]], axis=1)
        rotated -= rotated.min(axis=0)
        assert set(map(tuple, rotated)) == set(map(tuple, footprint(part, turn + 1)))


def test_footprint_of_a_corner_part_lacks_the_stated_cell():
    """A corner part covers its 2 x 2 box but for (1, 1), (0, 1), (0, 0), (1, 0) at the turns 0 to 3."""
    corner = CATALOGUE.parts[CATALOGUE.part_row("2357")]
    box = {(0, 0), (0, 1), (1, 0), (1, 1)}
    missing = [box - set(map(tuple, footprint(corner, turn).tolist())) for turn in range(4)]
    assert missing == [{(1, 1)}, {(0, 1)}, {(0, 0)}, {(1, 0)}]
