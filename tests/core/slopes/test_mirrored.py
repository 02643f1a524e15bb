"""Slopes of symmetric models: the image of each of them is laid as well, and where a model is askew, it may be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.slopes.candidates import candidates
from legorize_addon.core.slopes.choice import choose_slopes
from legorize_addon.core.slopes.forms import slopes_of
from legorize_addon.core.slopes.mirrored import in_pairs
from legorize_addon.core.slopes.site import Site
from tests.core.slopes.ramps import CATALOGUE, RED, WHITE, cells_of_ramp, prism

FORMS = slopes_of(CATALOGUE, plates=True)
LENGTH = 9
"""Of the grid, along which a roof is mirrored."""


def roof(width):
    """Return a block of two bricks' height whose upper edges fall on both sides of its middle."""
    return prism([(1, 0), (8, 0), (8, 3.5), (7, 6), (2, 6), (1, 3.5)], width)


def cells_of_roof(width):
    """Return the cells that are filled by half in the roof, with one free column around them."""
    colours = np.full((9, width + 2, LENGTH), COLOUR_EMPTY, np.int16)
    colours[:6, 1:-1, 1:8] = RED
    colours[5, :, [1, 7]] = COLOUR_EMPTY
    colours = colours.reshape(3, 3, width + 2, LENGTH)
    cover = np.where(colours == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colours, cover, np.zeros(colours.shape, np.uint8), np.zeros(3))


def laid(bricks):
    """Return bricks as part, turn and corner."""
    return sorted(zip(bricks.part.tolist(), bricks.turn.tolist(), map(tuple, bricks.corner.tolist()), strict=True))


def image(bricks):
    """Return the images of bricks along the length of the grid."""
    long, wide = (np.array([getattr(part, name) for part in CATALOGUE.parts]) for name in ("length", "width"))
    corner = bricks.corner.copy()
    corner[:, 0] = LENGTH - corner[:, 0] - np.where(bricks.turn % 2, wide[bricks.part], long[bricks.part])
    return replace(bricks, corner=corner, turn=np.array([2, 1, 0, 3])[bricks.turn])


def chequered(grid):
    """Return a roof one side of which has two colours in turn: each slope there would have half of them wrong."""
    colour = grid.colour.copy()
    side = colour[1, :, 1:-1:2, 1:3]
    side[side >= 0] = WHITE
    return replace(grid, colour=colour)


@pytest.mark.parametrize("width", [3, 5])
@pytest.mark.parametrize("price", [0.02, 0.1, 0.2])
def test_a_roof_is_mirrored(width, price):
    """Both sides of a roof get the same slopes in opposite turns, whatever their colours; or neither does."""
    plain = cells_of_roof(width)
    for grid in (plain, chequered(plain)):
        bricks = choose_slopes(roof(width), grid, grid, CATALOGUE, price=price, plates=True, symmetric=True).bricks
        assert laid(image(bricks)) == laid(bricks)
    assert (
        len(choose_slopes(roof(width), plain, plain, CATALOGUE, price=price, plates=True, symmetric=True).bricks) >= 2
    )


def test_colours_would_tell_sides_apart():
    """A chequered side gets other slopes than the plain one if a model need not be symmetric."""
    grid = chequered(cells_of_roof(4))
    bricks = choose_slopes(roof(4), grid, grid, CATALOGUE, price=0.1, plates=True).bricks
    assert len(bricks)
    assert laid(image(bricks)) != laid(bricks)


def test_pairs():
    """A candidate and its image have one number and one score, and neither claims what the other one needs."""
    grid = cells_of_roof(4)
    site = Site.of(roof(4), grid, grid)
    listed = candidates(site, FORMS, CATALOGUE, price=0.1)
    found, pair = in_pairs(site, FORMS, listed, 2)
    assert 0 < len(found.form) <= len(listed.form)
    # across the ridge, a model as wide as a form could get it in both turns, but not at once
    count = np.bincount(pair)
    assert set(count.tolist()) <= {0, 1, 2}
    assert (count == 2).any()
    for number in np.flatnonzero(count == 2):
        one, other = np.flatnonzero(pair == number)
        assert found.score[one] == found.score[other]
        assert FORMS[found.form[one]].part == FORMS[found.form[other]].part


def test_what_is_not_symmetric_stays_as_it_is():
    """A ramp has no image: its slopes are those of a model that need not be symmetric."""
    grid = cells_of_ramp()
    mesh = prism([(1, 0), (7, 0), (7, 3.5), (6, 6), (1, 6)], 4)
    both = [
        choose_slopes(mesh, grid, grid, CATALOGUE, price=0.3, plates=True, symmetric=symmetric).bricks
        for symmetric in (False, True)
    ]
    assert len(both[0])
    assert laid(both[0]) == laid(both[1])
