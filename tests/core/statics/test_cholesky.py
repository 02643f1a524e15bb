"""Sparse equations: what solves them, how much is kept for it, and that the work can be stopped."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.statics.cholesky import Cholesky
from tests.core.lattices import equations_of, lattice


@given(st.integers(1, 200), st.integers(0, 4), st.integers(1, 6), st.integers(0, 2**32 - 1))
def test_solves(n: int, degree: int, size: int, seed: int) -> None:
    """Any bodies that touch anyhow: the unknowns fulfil the equations."""
    rng = np.random.default_rng(seed)
    pairs = rng.integers(0, n, (n * degree // 2, 2))
    matrix = equations_of(pairs[pairs[:, 0] != pairs[:, 1]], n, size)
    right = rng.normal(size=n * size)
    found = Cholesky(matrix, rng.normal(size=(n, 3))).solve(right)
    np.testing.assert_allclose(matrix @ found, right, atol=1e-9)


def test_solves_as_another_does() -> None:
    """The same unknowns as by SciPy's own factors, and the right-hand side is left alone."""
    pairs, place = lattice((9, 8, 7))
    matrix = equations_of(pairs, len(place), 5)
    right = np.arange(matrix.shape[0]) % 11.0
    kept = right.copy()
    np.testing.assert_allclose(Cholesky(matrix, place).solve(right), splu(matrix).solve(right), rtol=1e-8, atol=1e-10)
    np.testing.assert_array_equal(right, kept)


@pytest.mark.parametrize("side", [20, 40, 80, 160])
def test_sheets_take_little_more_than_their_size(side: int) -> None:
    """What is kept of a sheet grows as n log n."""
    pairs, place = lattice((side, side, 1))
    n = len(place)
    assert Cholesky(equations_of(pairs, n, 1), place).entries < 5 * n * np.log2(n)


@pytest.mark.parametrize("side", [6, 9, 13, 18])
def test_solids_take_bounded_work(side: int) -> None:
    """What is kept of a cube grows as n to the power of 4/3, which is the least that is possible."""
    pairs, place = lattice((side, side, side))
    n = len(place)
    assert Cholesky(equations_of(pairs, n, 1), place).entries < 9 * n ** (4 / 3)


def test_nothing_to_solve() -> None:
    """No bodies, no unknowns."""
    assert Cholesky(csc_array((0, 0)), np.zeros((0, 3))).solve(np.zeros(0)).shape == (0,)


def test_what_is_not_definite_is_told() -> None:
    """A negative number on the diagonal has no root."""
    matrix = csc_array(diags_array(np.array([1.0, 2, -1, 1])))
    with pytest.raises(np.linalg.LinAlgError):
        Cholesky(matrix, np.zeros((4, 3)))


def test_progress_rises_and_stops_the_work() -> None:
    """The share rises from 0 to below 1, once for every front, and a callback that raises ends it."""
    pairs, place = lattice((10, 10, 10))
    matrix = equations_of(pairs, len(place), 1)
    shares: list[float] = []
    Cholesky(matrix, place, shares.append)
    assert shares[0] == 0
    assert shares == sorted(shares)
    assert shares[-1] < 1
    assert len(shares) >= len(place) / 40

    def stop(share: float) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        Cholesky(matrix, place, stop)


def test_entries_are_all_numbers_that_are_kept() -> None:
    """Eight bytes each, of the factors and of what lies below them."""
    pairs, place = lattice((9, 8, 7))
    found = Cholesky(equations_of(pairs, len(place), 3), place)
    assert sum(block.below.size > 0 for block in found._blocks) > 1
    assert 8 * found.entries == sum(block.factor.nbytes + block.below.nbytes for block in found._blocks)
