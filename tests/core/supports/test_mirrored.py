"""Pillars on mirrored squares of a symmetric model."""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core.building.mirror import boxes
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.progress import silent
from legorize_addon.core.statics.forces import HOLD
from legorize_addon.core.supports.bracing import _tested
from legorize_addon.core.supports.mirrored import MORE, NEAR, mirror_pillars
from legorize_addon.core.supports.pillars import kept_pillars, places_below
from tests.core.standing import CATALOGUE, table

ROWS = (
    *(("3003", 20, 0, 3 * level) for level in range(4)),
    *(("3007", x, 0, 12) for x in (13, 21)),
    ("3001", 19, 0, 15),
    *(("3007", x, 0, 15) for x in (6, 28)),
)
"""A tower with arms on both sides, which go on a brick higher: mirrored between the squares 20 and 21."""

TOTAL = 41


def model(*more):
    """Return the tower with its arms."""
    return Assembly(table(*ROWS, *more), CATALOGUE)


def pillars_at(assembly, *squares):
    """Return pillars on some squares, up to the arms."""
    under = places_below(assembly, np.ones(len(assembly), dtype=bool), between=True)
    here = [(int(x), int(y)) for x, y in np.stack([under.x, under.y], axis=1) + assembly.graph.low[:2]]
    rows = [here.index(square) for square in squares]
    return kept_pillars(assembly, under.take(np.array(rows)))


def mirrored(propped, assembly):
    """Whether what stands behind the model is its own image."""
    added = propped[0].bricks.take(np.arange(len(assembly), len(propped[0])))
    rows = set(map(tuple, np.column_stack([boxes(added, CATALOGUE), added.corner[:, 2]]).tolist()))
    return {(TOTAL - x1, TOTAL - x0, y0, y1, z) for x0, x1, y0, y1, z in rows} == rows


def settled(assembly, *squares, stable=None, tests=20):
    """Return the model with pillars on some squares, what became of it, and how often it was tested.

    Parameters
    ----------
    assembly : Assembly
    squares : (int, int)
    stable : bool, optional
        How other pillars stand; tested by forces if it is not given.
    tests : int
    """
    real = partial(_tested, assembly, clutch=HOLD, progress=silent)
    pillars, asked = pillars_at(assembly, *squares), []

    def tested(pillars, **options):
        asked.append(pillars)
        if stable is None:
            return real(pillars, **options)
        return assembly.with_more(pillars), SimpleNamespace(stable=stable)

    propped = real(pillars)
    return propped, mirror_pillars(assembly, propped, pillars, tested, tests=tests), len(asked)


def test_one_of_two_pillars_moves_to_the_image_of_the_other():
    """They stand as far out on either side then, and as many as before."""
    assembly = model()
    before, after, asked = settled(assembly, (7, 0), (32, 1))
    assert before[1].stable
    assert after[1].stable
    assert asked == 1
    assert len(after[0]) == len(before[0])
    assert [mirrored(each, assembly) for each in (before, after)] == [False, True]


def test_mirrored_pillars_stay():
    """Those that are mirrored are not asked about."""
    before, after, asked = settled(model(), (7, 0), (TOTAL - 7, 0))
    assert after is before
    assert asked == 0


@pytest.mark.parametrize("tests", [1, 9])
def test_nothing_moves_where_the_model_would_fall(tests):
    """What does not stand is not taken, and no more is asked than may be: both ways, together and apart."""
    before, after, asked = settled(model(), (7, 0), (32, 1), stable=False, tests=tests)
    assert after is before
    assert asked == min(tests, 3)


@pytest.mark.parametrize("off", [NEAR, NEAR + 1])
def test_pillars_that_are_far_off_have_nothing_to_do_with_each_other(off):
    """Of two that are more than eight studs off each other's image, none moves; images of both are too many bricks."""
    before, after, _ = settled(model(), (7, 0), (TOTAL - 7 - off, 0), stable=True)
    assert (after is not before) == (off == NEAR)


@pytest.mark.parametrize("many", [False, True])
def test_a_lonely_pillar_gets_its_image_where_that_takes_few_bricks(many):
    """Two bricks between an arm and one that is mirrored: a hundredth of 200 bricks, more than that of a few."""
    bases = [("3005", x, 0, 3 * z) for x in (8, TOTAL - 8) for z in range(3)]
    floor = [("3005", x, y, 0) for x in range(10, 32) for y in range(4, 14)] if many else []
    assembly = model(*bases, *floor)
    before, after, asked = settled(assembly, (8, 0), stable=True)
    assert asked == many
    assert len(before[0]) - len(assembly) == 2
    assert len(after[0]) - len(assembly) == 2 + 2 * many
    assert int(MORE * len(assembly)) == 2 * many


def test_a_model_without_symmetry_keeps_its_pillars():
    """There is no plane, and nothing to ask."""
    stairs = [("3005", 0, 3 * k, 3 * k) for k in range(12)]
    before, after, asked = settled(model(*stairs), (7, 0), (32, 1), stable=True)
    assert after is before
    assert asked == 0
