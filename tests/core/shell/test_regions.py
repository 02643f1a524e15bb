"""Differences of regions: the paper's four cases, contours, shells of a layer, tallies."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.shell.regions import CaseTally, difference, kept, outer4, outer8, tally_cases

CROSS, SQUARE = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]]), np.ones((3, 3))


def bits(number, shape):
    """Return a mask from the binary digits of a number."""
    return np.array([number >> n & 1 for n in range(int(np.prod(shape)))], bool).reshape(shape)


stacks = st.integers(0, 2**100 - 1).map(lambda number: bits(number, (4, 5, 5)))


def four_cases(here, other):
    """Return the case, and what stays of a region by the paper's own words, case by case."""
    rim, other_rim = outer4(here), outer4(other)
    if not (here & other).any():
        return "apart", here
    if not (here & ~other).any():
        return "covering", rim
    if not (other & ~here).any():
        return "inside", here & ~other | other_rim
    return "crossing", here & ~other | rim & other | other_rim & here


def pairs(n):
    """Yield pairs of random layers that lie within, across, over and beside each other."""
    rng = np.random.default_rng(0)
    for number in range(n):
        a, b = (ndimage.binary_opening(rng.random((9, 11)) < 0.8, CROSS) for _ in range(2))
        yield [(a, b), (a, a & b), (a & b, b), (a, b & ~a)][number % 4]


def test_one_formula_covers_the_four_cases():
    """outer(R) | R - X | outer(X) & R is what the paper keeps, in each of its cases."""
    found = []
    for here, other in pairs(400):
        case, stays = four_cases(here, other)
        found.append(case)
        np.testing.assert_array_equal(difference(here, other), stays, err_msg=case)
    assert min(found.count(case) for case in ("inside", "crossing", "covering", "apart")) > 50


@given(stacks)
def test_contours_have_an_empty_neighbour(layers):
    """A cell of a contour has an empty one among its four, or its eight, neighbours."""
    for layer, four, eight in zip(layers, outer4(layers), outer8(layers), strict=True):
        np.testing.assert_array_equal(four, layer & ~ndimage.binary_erosion(layer, CROSS))
        np.testing.assert_array_equal(eight, layer & ~ndimage.binary_erosion(layer, SQUARE))


@given(stacks, st.booleans())
def test_both_neighbours_with_corners_are_the_26_neighbours(layers, open_bottom):
    """With both neighbours and corners stays what has an empty cell around it; the ground may count as solid."""
    around = np.pad(layers, 1)
    around[0] = open_bottom
    deep = ndimage.minimum_filter(around, size=3)[1:-1, 1:-1, 1:-1]
    np.testing.assert_array_equal(kept(layers, open_bottom=open_bottom, corners=True), layers & ~deep)


@given(stacks)
def test_upper_alone_keeps_a_part(layers):
    """The layer above alone keeps a part of what both keep, and never asks for a cover from below."""
    upper = kept(layers, upper_only=True)
    assert not (upper & ~kept(layers, open_bottom=True)).any()
    np.testing.assert_array_equal(upper[0], difference(layers[0], layers[1]))
    np.testing.assert_array_equal(upper[-1], layers[-1])


@pytest.mark.parametrize(("open_bottom", "ratio"), [(True, 0.7695), (False, 0.7290)])
def test_hollow_ratio_of_a_cube(open_bottom, ratio):
    """A cube of 20 bricks keeps its top, 19 or 18 rings of 76, and its bottom or not."""
    stay = kept(np.ones((20, 20, 20), bool), open_bottom=open_bottom)
    assert 1 - np.count_nonzero(stay) / 8000 == pytest.approx(ratio, abs=1e-12)


def test_tally_of_one_pair_for_each_case():
    """Every case is told from the others, and both directions are counted."""
    low, high = np.zeros((2, 8, 24), bool)
    low[2:7, 1:6] = high[3:5, 2:4] = True
    low[2:5, 8:11] = high[3:6, 9:12] = True
    low[3:5, 15:17] = high[2:6, 14:18] = True
    low[3, 20] = True
    assert tally_cases(np.stack([low, high]), upper_only=True) == CaseTally(1, 1, 1, 1)
    assert tally_cases(np.stack([low, high])) == CaseTally(2, 2, 2, 1)


@given(stacks)
def test_every_region_is_one_case(layers):
    """Each region below the top layer counts once, by the words of the four cases."""
    regions = [ndimage.label(layer, SQUARE)[0] for layer in layers]
    found = dict.fromkeys(("inside", "crossing", "covering", "apart"), 0)
    for label, above in pairwise(regions):
        for number in range(1, label.max() + 1):
            here = label == number
            found[four_cases(here, np.isin(above, above[here & (above > 0)]))[0]] += 1
    assert tally_cases(layers, upper_only=True) == CaseTally(**found)
