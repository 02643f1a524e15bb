"""The order of elimination: nothing passes between the halves, and as little as possible is kept back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.statics.dissection import Front, dissect
from tests.core.lattices import lattice


def _later(fronts: list[Front]) -> list[set[int]]:
    """Return the fronts that each is a part of, with itself."""
    later = [{row} for row in range(len(fronts))]
    for row in reversed(range(len(fronts))):
        for piece in fronts[row].parts:
            assert piece < row
            later[piece] |= later[row]
    return later


@given(st.integers(0, 400), st.integers(0, 3), st.integers(0, 2**32 - 1))
def test_halves_have_nothing_to_do_with_each_other(n: int, degree: int, seed: int) -> None:
    """Each body is in one front, and of two that touch one's front is the other's or holds it as a part."""
    rng = np.random.default_rng(seed)
    place = rng.integers(0, 6, (n, 3)).astype(np.float64)
    pairs = rng.integers(0, max(n, 1), (n * degree // 2, 2))
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    fronts = dissect(pairs, place)
    assert sorted(np.concatenate([front.bodies for front in fronts]).tolist() if fronts else []) == list(range(n))
    of = np.empty(n, dtype=int)
    for row, front in enumerate(fronts):
        of[front.bodies] = row
    later = _later(fronts)
    for one, other in of[pairs]:
        assert one in later[other] or other in later[one]


@pytest.mark.parametrize(("shape", "most"), [((30, 10, 1), 10), ((10, 30, 1), 10), ((7, 9, 20), 63), ((300, 1, 1), 1)])
def test_cut_across_the_longest_way(shape: tuple[int, int, int], most: int) -> None:
    """Of a box, one cross-section at most is kept back at the first cut."""
    pairs, place = lattice(shape)
    assert 0 < len(dissect(pairs, place)[-1].bodies) <= most


def test_fewest_are_kept_back() -> None:
    """A body that all others across touch is kept back alone, on whichever side it is."""
    n = 100
    place = np.arange(n)[:, None] * np.array([1.0, 0, 0])
    chain = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1)
    for hub in (3, 96):
        others = np.arange(n // 2, n) if hub < n // 2 else np.arange(n // 2)
        star = np.stack([np.full(len(others), hub), others], axis=1)
        within = chain[(chain < n // 2).all(axis=1) | (chain >= n // 2).all(axis=1)]
        assert dissect(np.concatenate([star, within]), place)[-1].bodies.tolist() == [hub]


def test_bodies_apart_need_no_front_between_them() -> None:
    """What does not touch is not joined: every front is a whole by itself."""
    place = np.random.default_rng(1).normal(size=(500, 3))
    fronts = dissect(np.zeros((0, 2), dtype=np.int64), place)
    assert all(not front.parts for front in fronts)
    assert max(len(front.bodies) for front in fronts) <= 40
