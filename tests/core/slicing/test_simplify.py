"""Points left out of trajectories: never too far away, never where the colour changes."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.slicing.simplify import simplify

DEVIATIONS = (0.0, 0.01, 0.1, 0.4, 1.0, 2.0, 4.0)


def wavy(n=200, seed=0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Draw two bumpy rings in runs of three colours and one round one in a single colour."""
    rng = np.random.default_rng(seed)
    turn = np.arange(n) * 2 * np.pi / n
    rings = []
    for k in range(3):
        radius = 30 + 5 * k + (k < 2) * (3 * np.sin(5 * turn + k) + rng.normal(0, 0.3, n))
        rings.append(radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1))
    colour = np.repeat(rng.integers(0, 3, 3 * n // 20), 20).astype(np.int16)
    colour[2 * n :] = 4
    return np.concatenate(rings), colour, np.arange(4) * n


def distance(points, start, end) -> np.ndarray:
    """Return the distance of every point from the nearest of some line segments."""
    along = end - start
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    share = np.clip(((points[:, None] - start) * along).sum(axis=2) / length, 0, 1)
    return np.linalg.norm(points[:, None] - start - share[..., None] * along, axis=2).min(axis=1)


def rings(points, loop_start, keep=None):
    """Yield every loop as it was and as it is."""
    for a, b in itertools.pairwise(loop_start):
        yield points[a:b], points[a:b][slice(None) if keep is None else keep[a:b]]


@pytest.mark.parametrize("deviation", DEVIATIONS)
def test_distance_is_within_the_deviation_both_ways(deviation):
    """Hausdorff: all of the old outline is near the new one, and all of the new one near the old."""
    points, colour, loop_start = wavy()
    keep = simplify(points, colour, loop_start, deviation)
    for old, new in rings(points, loop_start, keep):
        for one, other in ((old, new), (new, old)):
            after = np.roll(one, -1, axis=0)
            dense = (one + np.linspace(0, 1, 9)[:, None, None] * (after - one)).reshape(-1, 2)
            assert distance(dense, other, np.roll(other, -1, axis=0)).max() <= deviation + 1e-9


def test_the_larger_the_deviation_the_fewer_points():
    """Points fall as the deviation grows, and those of a larger deviation are among those of a smaller one."""
    points, colour, loop_start = wavy()
    kept = [simplify(points, colour, loop_start, deviation) for deviation in DEVIATIONS]
    counts = [int(keep.sum()) for keep in kept]
    assert counts == sorted(counts, reverse=True)
    assert len(set(counts)) == len(DEVIATIONS)
    for fine, coarse in itertools.pairwise(kept):
        assert (fine | ~coarse).all()


def test_nothing_is_left_out_at_zero():
    """A deviation of 0 keeps every point, even those on a straight line."""
    points = np.array([[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]])
    assert simplify(points, np.zeros(5, np.int16), np.array([0, 5]), 0.0).all()
    assert len(simplify(np.zeros((0, 2)), np.zeros(0, np.int16), np.zeros(1, int), 1.0)) == 0


def test_ends_of_colour_runs_stay():
    """However large the deviation, every point where the colour changes is kept."""
    points, colour, loop_start = wavy()
    keep = simplify(points, colour, loop_start, 100.0)
    for a, b in itertools.pairwise(loop_start):
        changes = colour[a:b] != np.roll(colour[a:b], 1)
        changes[0] = True
        assert keep[a:b][changes].all()
        one_colour = changes.sum() == 1
        assert keep[a:b].sum() == (2 if one_colour else changes.sum())


def test_straight_runs_lose_their_inner_points():
    """Of a square with points on its sides the corners are left."""
    side = np.arange(10)
    points = np.concatenate([np.stack([side, 0 * side], 1), np.stack([0 * side + 10, side], 1)])
    points = np.concatenate([points, 10 - points]).astype(np.float64)
    keep = simplify(points, np.zeros(40, np.int16), np.array([0, 40]), 1e-6)
    assert np.flatnonzero(keep).tolist() == [0, 10, 20, 30]


@given(
    st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9), st.integers(0, 1)), min_size=1, max_size=30),
    st.floats(0.01, 5),
    st.data(),
)
def test_any_loops_stay_near(rows, deviation, data):
    """Loops that cross themselves, repeat points or have one point only are kept near as well, each by itself."""
    x, y, colour = np.array(rows).T
    cut = data.draw(st.integers(1, len(rows)))
    loop_start = np.unique([0, cut, len(rows)])
    points = np.stack([x, y], axis=1).astype(np.float64)
    keep = simplify(points, colour.astype(np.int16), loop_start, deviation)
    assert keep[loop_start[:-1]].all()
    for old, new in rings(points, loop_start, keep):
        assert distance(old, new, np.roll(new, -1, axis=0)).max() <= deviation + 1e-9
