"""Bricks that would fall over by themselves."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.items import SMALL
from legorize_addon.core.building.leaning import Leaning
from legorize_addon.core.building.mirror import boxes
from tests.core.standing import CATALOGUE, table


@pytest.mark.parametrize(("first", "leans"), [(0, True), (3, False), (6, True)])
def test_weight_beside_the_lowest_bricks_leans(first, leans):
    """A beam of eight studs over four plates: they must be below its middle; fewer plates are held in a hand."""
    bricks = table(("3001", 20, 0, 0), ("3007", 0, 0, 1), *(("3024", first + x, y, 0) for x in (0, 1) for y in (0, 1)))
    leaning = Leaning(bricks, CATALOGUE, boxes(bricks, CATALOGUE))
    nodes = np.arange(len(bricks))
    assert leaning(nodes, [1, 2, 3, 4, 5]) == leans
    assert not leaning(nodes, [1, 2, 3, 4][:SMALL])
    assert leaning(nodes[::-1], [4, 3, 2, 1, 0]) == leans
