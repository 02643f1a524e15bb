"""Which placements a bar forbids: those of its part through its cells, in sheets of bricks and of plates."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.problem.bars import Bar, without_barred
from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from tests.core.layout.cells import CATALOGUE, brick_grid

RED = 4


@pytest.mark.parametrize("plate", [0, 1, 2])
def test_each_plate_of_a_brick_counts(plate):
    """A cell at any height of a layer of bricks bars those through it, and no others."""
    [sheets] = split(brick_grid(np.full((2, 3, 5), RED)))
    among = shapes(CATALOGUE, 3, np.array([RED], np.int16), 71)
    found = placements(sheets, among)
    cells = np.zeros((8, 3, 5), dtype=bool)
    cells[1 + 3 + plate, 1, 2] = True
    part = CATALOGUE.part_row("3003")
    left = without_barred(found, among, sheets, [Bar(part, cells)])
    x, y, sheet = found.corner.T
    through = (among.part[found.shape] == part) & (sheet == 1) & np.isin(x, [1, 2]) & np.isin(y, [0, 1])
    assert through.sum() == 4
    assert left.key.tolist() == found.key[~through].tolist()


def test_nothing_barred_is_the_same():
    """Bars elsewhere leave the placements as they are."""
    [sheets] = split(brick_grid(np.full((1, 2, 2), RED)))
    among = shapes(CATALOGUE, 3, np.array([RED], np.int16), 71)
    found = placements(sheets, among)
    assert without_barred(found, among, sheets, [Bar(0, np.zeros((5, 2, 2), dtype=bool))]) is found
