"""Intervals cut at integers: nothing is lost, and no piece reaches over an integer."""

from __future__ import annotations

import doctest

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.geometry import grid_lines as module
from legorize_addon.core.geometry.grid_lines import split_at_integers, split_at_lattice

places = st.floats(-50, 50) | st.integers(-50, 50).map(float)
intervals = st.lists(st.tuples(places, places), min_size=1, max_size=20).map(lambda rows: np.array(rows).T)


@given(intervals)
def test_pieces_tile_every_interval(ends):
    """The pieces of an interval come in order, begin at 0, end at 1 and follow each other without a gap."""
    interval, low, high = split_at_integers(*ends)
    first = np.flatnonzero(np.diff(interval, prepend=-1))
    assert interval[first].tolist() == list(range(ends.shape[1]))
    last = np.append(first[1:], len(interval)) - 1
    assert not low[first].any()
    assert (high[last] == 1).all()
    inner = np.delete(np.arange(len(interval)), first)
    np.testing.assert_array_equal(low[inner], high[inner - 1])
    assert (low <= high).all()


@given(intervals)
def test_no_piece_reaches_over_an_integer(ends):
    """Every piece lies between two neighbouring integers, but for rounding."""
    first, last = ends
    interval, low, high = split_at_integers(first, last)
    a, b = (first[interval] + share * (last - first)[interval] for share in (low, high))
    unit = np.floor((a + b) / 2)
    for end in (a, b):
        assert (unit - 1e-9 <= end).all()
        assert (end <= unit + 1 + 1e-9).all()


@given(intervals)
def test_as_many_cuts_as_integers_inside(ends):
    """An interval has one piece more than there are integers strictly inside it, whichever way it runs."""
    count = np.bincount(split_at_integers(*ends)[0])
    inside = [sum(min(pair) < k < max(pair) for k in range(-50, 51)) for pair in ends.T.tolist()]
    assert (count - 1).tolist() == inside
    np.testing.assert_array_equal(np.bincount(split_at_integers(*ends[::-1])[0]), count)


def test_ends_on_integers_are_no_cuts():
    """From integer to neighbouring integer, or along one, is one piece."""
    interval, low, high = split_at_integers(np.array([2.0, 3.0, 4.0]), np.array([3.0, 2.0, 4.0]))
    assert interval.tolist() == [0, 1, 2]
    assert low.tolist() == [0, 0, 0]
    assert high.tolist() == [1, 1, 1]


@given(intervals, intervals)
def test_lattice_pieces_tile_and_stay_in_their_cells(x, y):
    """Segments in the plane are cut at both kinds of lines: pieces follow each other, each within one cell."""
    n = min(x.shape[1], y.shape[1])
    first, last = (np.stack([x[i, :n], y[i, :n]], axis=1) for i in (0, 1))
    segment, low, high = split_at_lattice(first, last)
    begin = np.flatnonzero(np.diff(segment, prepend=-1))
    assert segment[begin].tolist() == list(range(n))
    assert not low[begin].any()
    np.testing.assert_allclose(high[np.append(begin[1:], len(segment)) - 1], 1, rtol=1e-14)
    later = np.delete(np.arange(len(segment)), begin)
    np.testing.assert_allclose(low[later], high[later - 1], rtol=1e-14)
    a, b = (first[segment] + share[:, None] * (last - first)[segment] for share in (low, high))
    cell = np.floor((a + b) / 2)
    for end in (a, b):
        assert (np.abs(end - cell - 0.5) <= 0.5 + 1e-9).all()


def test_examples_are_true():
    """The docstrings' examples give what they say."""
    assert doctest.testmod(module).failed == 0
    assert doctest.testmod(module).attempted
