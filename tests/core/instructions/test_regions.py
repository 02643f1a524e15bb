"""Outlines and borders of pieces of the plane."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from legorize_addon.core.instructions.regions import borders, neighbours, outlines
from legorize_addon.core.model.bricks import NOBODY

LOW = np.array([-3, 5])


@st.composite
def regions(draw):
    """Draw a plane of halves of squares with ground around."""
    size = draw(st.tuples(st.integers(1, 6), st.integers(1, 6)))
    inside = draw(arrays(np.int64, (*size, 2), elements=st.integers(-1, 2)))
    return np.pad(inside, ((1, 1), (1, 1), (0, 0)), constant_values=NOBODY)


def split(loops):
    """Yield what each loop belongs to, and its corners."""
    ends = np.cumsum(loops.count)
    for of, low, high in zip(loops.of.tolist(), ends - loops.count, ends, strict=True):
        yield of, loops.points[low:high]


def area(points):
    """Return the signed area of a polygon."""
    x, y = points.T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def winding(points, p, q):
    """Return how often a polygon goes round a point."""
    turns = 0
    for (x, y), (u, v) in zip(points.tolist(), np.roll(points, -1, axis=0).tolist(), strict=True):
        side = (u - x) * (q - y) - (v - y) * (p - x)
        if y <= q < v and side > 0:
            turns += 1
        if v <= q < y and side < 0:
            turns -= 1
    return turns


@settings(deadline=None, max_examples=80)
@given(regions())
def test_outlines_fill_exactly_their_regions(region):
    """Each piece is inside of the loops of its own region, once, and of no other."""
    loops = list(split(outlines(region, LOW)))
    for (m, n, half), of in np.ndenumerate(region):
        p, q = LOW + (m, n) + (np.array([0.7, 0.3]) if half else np.array([0.3, 0.7]))
        for kind in range(3):
            around = sum(winding(points, p, q) for each, points in loops if each == kind)
            assert around == (kind == of)


@settings(deadline=None, max_examples=80)
@given(regions())
def test_outlines_have_the_area_and_no_corner_in_vain(region):
    """Areas add up, loops are sorted by region, and no corner lies on a straight line."""
    loops = outlines(region, LOW)
    assert (np.diff(loops.of) >= 0).all()
    for kind in range(3):
        total = sum(area(points) for of, points in split(loops) if of == kind)
        assert total == (region == kind).sum() / 2
    for _, points in split(loops):
        ahead = np.roll(points, -1, axis=0) - points
        behind = points - np.roll(points, 1, axis=0)
        straight = (ahead[:, 0] * behind[:, 1] == ahead[:, 1] * behind[:, 0]) & ((ahead * behind).sum(axis=1) > 0)
        assert not straight.any()


@settings(deadline=None, max_examples=80)
@given(regions())
def test_borders_are_as_long_as_what_differs(region):
    """Merged lines are together as long as the edges between different regions."""
    left, right = neighbours(region)
    kind = np.where(left != right, 0, NOBODY)
    found = borders(kind, LOW)
    steps = np.abs(found.end - found.start).max(axis=1)
    assert steps.sum() == (left != right).sum()
    assert (steps > 0).all()


def test_a_straight_border_is_one_line():
    """A row of squares has one line along its long sides."""
    region = np.full((7, 3, 2), NOBODY)
    region[1:6, 1] = 0
    left, right = neighbours(region)
    found = borders(np.where(left != right, 4, NOBODY), LOW)
    assert set(found.of.tolist()) == {4}
    ends = sorted(map(tuple, np.concatenate([found.start - LOW, found.end - LOW], axis=1).tolist()))
    assert ends == [(1, 1, 1, 2), (1, 1, 6, 1), (1, 2, 6, 2), (6, 1, 6, 2)]


def test_nothing_has_no_outline():
    """The ground alone gives no loops and no lines."""
    region = np.full((3, 3, 2), NOBODY)
    assert len(outlines(region, LOW).count) == 0
    assert len(borders(np.full((3, 3, 3), NOBODY), LOW).of) == 0
