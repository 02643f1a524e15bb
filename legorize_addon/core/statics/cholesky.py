"""Sparse equations solved front by front: Cholesky's factors, each of a dense block.

A library for this would be native code; and one call of it may take minutes in
which nobody can stop it. Here the work is done in dense blocks of BLAS, between
which progress is told.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.blas import dsyrk, dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf
from scipy.sparse import csc_array, tril

from ..arrays import Floats, Ints
from .dissection import Front, dissect

Index = NDArray[np.intp]


class _Block(NamedTuple):
    """A front as it leaves: its own unknowns are neighbours in the order, those that it meets come later."""

    start: int
    met: Index
    factor: Floats
    below: Floats


class Cholesky:
    """Factors of a symmetric matrix that is positive definite.

    Parameters
    ----------
    matrix : (b n, b n) sparse float64 array
        Of n bodies with b unknowns each.
    place : (n, 3) float64 array
        Where the bodies are: those that touch lie near each other.
    progress : callable, optional
        Called with the share of the bodies that is done; may raise.

    Raises
    ------
    numpy.linalg.LinAlgError
        The matrix is not positive definite.

    References
    ----------
    J. W. H. Liu, "The multifrontal method for sparse matrix solution: theory
    and practice", SIAM Review 34(1), 1992.
    """

    def __init__(
        self, matrix: csc_array, place: Floats, progress: Callable[[float], None] = lambda share: None
    ) -> None:
        size = matrix.shape[0] // max(len(place), 1)
        fronts = dissect(_touching(matrix, size), place)
        bodies = np.concatenate([front.bodies for front in fronts]) if fronts else np.zeros(0, dtype=np.intp)
        self._order: Index = _unknowns(bodies, size)
        lower = csc_array(tril(matrix[self._order][:, self._order], format="csc"))
        self._blocks: list[_Block] = []
        # what a front leaves to those that it meets, until it is added to one of them
        left: dict[int, Floats] = {}
        end = 0
        for row, front in enumerate(fronts):
            progress(end / len(self._order))
            start, end = end, end + len(front.bodies) * size
            block, left[row] = self._eliminate(lower, start, end, front, left)
            self._blocks.append(block)

    def _eliminate(
        self, lower: csc_array, start: int, end: int, front: Front, left: dict[int, Floats]
    ) -> tuple[_Block, Floats]:
        own = slice(lower.indptr[start], lower.indptr[end])
        met = [self._blocks[part].met for part in front.parts]
        rows = np.unique(np.concatenate([lower.indices[own], np.arange(start, end), *met]))
        rows, n = rows[np.searchsorted(rows, start) :], end - start
        full = np.zeros((len(rows), len(rows)), order="F")
        column = np.repeat(np.arange(n), np.diff(lower.indptr[start : end + 1]))
        full[np.searchsorted(rows, lower.indices[own]), column] = lower.data[own]
        for part, theirs in zip(front.parts, met, strict=True):
            at = np.searchsorted(rows, theirs)
            # as it lies in memory: column by column
            full.T[np.ix_(at, at)] += left.pop(part).T
        factor, below = _factors(full[:n, :n], full[n:, :n], start)
        # only the lower half is kept up to date
        rest = dsyrk(-1.0, below, 1.0, full[n:, n:], lower=1) if len(below) else full[n:, n:]
        return _Block(start, rows[n:], factor, below), rest

    @property
    def entries(self) -> int:
        """Numbers in all factors, each 8 bytes."""
        return sum(block.factor.size + block.below.size for block in self._blocks)

    def solve(self, right: Floats) -> Floats:
        """Return the unknowns for one right-hand side, shape (b n,)."""
        sums = right[self._order]
        for start, met, factor, below in self._blocks:
            own = slice(start, start + len(factor))
            sums[own] = dtrsv(factor, sums[own], lower=1)
            sums[met] -= below @ sums[own]
        for start, met, factor, below in reversed(self._blocks):
            own = slice(start, start + len(factor))
            sums[own] = dtrsv(factor, sums[own] - sums[met] @ below, lower=1, trans=1)
        found = np.empty_like(sums)
        found[self._order] = sums
        return found


def _factors(own: Floats, below: Floats, start: int) -> tuple[Floats, Floats]:
    factor, failed = dpotrf(own, lower=1, clean=1)
    if failed:
        raise np.linalg.LinAlgError(f"unknown {start + failed - 1} of the order is not determined")
    if not len(below):
        return factor, below.copy(order="F")
    return factor, dtrsm(1.0, factor, below, side=1, lower=1, trans_a=1)


def _touching(matrix: csc_array, size: int) -> Ints:
    """Return the pairs of different bodies with an entry in common, each once."""
    entries = tril(matrix, k=-1, format="coo")
    pairs = np.stack([entries.row, entries.col], axis=1).astype(np.int64) // size
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    keys = np.unique(pairs[:, 0] * matrix.shape[0] + pairs[:, 1])
    return np.stack([keys // matrix.shape[0], keys % matrix.shape[0]], axis=1)


def _unknowns(bodies: Index, size: int) -> Index:
    found: Index = (bodies[:, None] * size + np.arange(size)).reshape(-1)
    return found
