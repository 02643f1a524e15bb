"""Cycles in order, steps along them, their areas."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.slicing.loops import loop_areas, loop_ends, ordered_loops


def cycles(following) -> list[list[int]]:
    """Walk every cycle of a permutation, the plain way."""
    seen, found = set(), []
    for start in range(len(following)):
        cycle, here = [], start
        while here not in seen:
            seen.add(here)
            cycle.append(here)
            here = int(following[here])
        if cycle:
            found.append(cycle)
    return found


@given(st.integers(0, 200).flatmap(lambda n: st.permutations(range(n))))
def test_random_permutation_falls_into_its_cycles(following):
    """The order is that of a walk: cycle after cycle, each from its lowest element."""
    order, start = ordered_loops(np.array(following, dtype=np.int64))
    found = [order[a:b].tolist() for a, b in itertools.pairwise(start)]
    assert found == cycles(following)
    assert len(order) == len(following)


@pytest.mark.parametrize("n", [1, 2, 3, 1023, 1024, 1025])
def test_one_long_cycle(n):
    """A cycle of any length is found whole, forwards and backwards; so are as many of length one."""
    for step in (1, -1):
        order, start = ordered_loops((np.arange(n) + step) % n)
        assert start.tolist() == [0, n]
        np.testing.assert_array_equal(order, (step * np.arange(n)) % n)
    np.testing.assert_array_equal(ordered_loops(np.arange(n))[1], np.arange(n + 1))


def test_ends_are_the_next_points_of_their_loops():
    """The last point of a loop goes on to its first."""
    points = np.arange(10.0).reshape(5, 2)
    assert loop_ends(points, np.array([0, 3, 4, 5]))[:, 0].tolist() == [2, 4, 0, 6, 8]
    assert len(loop_ends(np.zeros((0, 2)), np.zeros(1, dtype=np.int64))) == 0


@pytest.mark.parametrize("away", [0.0, 1e5])
def test_areas_of_regular_polygons(away):
    """Areas are those of regular polygons, negative where they run clockwise, near and far from the origin."""
    turn = np.arange(12) * 2 * np.pi / 12
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = np.concatenate([5 * ring, (2 * ring)[::-1], ring[::4]]) + away
    expected = [6 * np.sin(np.pi / 6) * 25, -6 * np.sin(np.pi / 6) * 4, 1.5 * np.sin(2 * np.pi / 3)]
    np.testing.assert_allclose(loop_areas(points, np.array([0, 12, 24, 27])), expected, rtol=1e-9)


def test_no_loops_have_no_areas():
    """Nothing gives nothing; loops of one and of two points hold no area."""
    assert len(loop_areas(np.zeros((0, 2)), np.zeros(1, dtype=np.int64))) == 0
    assert loop_areas(np.array([[1.0, 2], [3, 4], [5, 7]]), np.array([0, 1, 3])).tolist() == [0, 0]
