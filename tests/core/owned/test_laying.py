"""Layouts of owned parts: what is scarce is not laid."""

from __future__ import annotations

from functools import partial

import numpy as np

from legorize_addon.core.layout.lay import lay_unjoined
from legorize_addon.core.owned.laying import ROUNDS, lay_owned, usable
from tests.core.any_bricks import CATALOGUE
from tests.core.layout.cells import RED, brick_grid
from tests.core.owned_box import owning

GRID = brick_grid(np.full((1, 2, 8), RED))


def laid(lots, *, only):
    """Return the numbers of the parts of a layout of two rows of eight red studs."""
    lay, asked = partial(lay_unjoined, GRID, rng=np.random.default_rng(0)), []

    def counted(catalogue):
        asked.append(catalogue)
        return lay(catalogue)

    bricks = lay_owned(counted, CATALOGUE, owning(lots), only=only)
    assert 1 <= len(asked) <= ROUNDS
    return sorted(CATALOGUE.parts[part].number for part in bricks.part.tolist())


def test_only_owned_parts_are_laid():
    """Two 2 x 4 lie where a single 2 x 8 would, as there is none, in whatever colour."""
    assert laid({("3001", 4): 2}, only=True) == ["3001", "3001"]
    assert laid({("3001", 0): 1, ("3001", 14): 1}, only=True) == ["3001", "3001"]


def test_what_is_scarce_gives_way():
    """With a single 2 x 8 too few and many others, the model is laid of the others."""
    assert laid({("3001", 4): 1, ("3003", 4): 9}, only=True) in (["3001", "3003", "3003"], ["3003"] * 4)


def test_owned_parts_come_first():
    """Two owned 2 x 4 are better than a 2 x 8 that has to be bought; what nobody owns is bought as one part."""
    assert laid({("3001", 4): 2}, only=False) in (["3001", "3001"], ["3007"])
    assert laid({("3005", 0): 1}, only=False) == ["3007"]


def test_single_parts_that_fit_anywhere_are_plain():
    """A 1 x 1 brick and plate may be laid although they are missing; tiles and small slopes of that size may not."""
    there = usable(CATALOGUE, np.zeros(CATALOGUE.exists.shape, np.int64))
    assert {CATALOGUE.parts[row].number for row in np.flatnonzero(there)} == {"3005", "3024"}
