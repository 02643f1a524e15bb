"""Lattices of bodies that touch their neighbours, as equations have them."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csc_array, eye_array


def lattice(shape: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return the pairs of neighbours, shape (k, 2), and the places, shape (n, 3)."""
    number = np.arange(np.prod(shape)).reshape(shape)
    pairs = [
        np.stack([number.take(range(n - 1), axis).ravel(), number.take(range(1, n), axis).ravel()], axis=1)
        for axis, n in enumerate(shape)
    ]
    return np.concatenate(pairs), np.indices(shape).reshape(3, -1).T.astype(np.float64)


def equations_of(pairs: np.ndarray, n: int, size: int) -> csc_array:
    """Return a definite matrix of n bodies with some unknowns each, all of which meet those of neighbours."""
    rng = np.random.default_rng(len(pairs))
    value = rng.uniform(-1, 1, (len(pairs), 2 * size))
    of = (pairs[:, :, None] * size + np.arange(size)).reshape(len(pairs), 2 * size)
    row = np.repeat(np.arange(len(pairs)), 2 * size)
    across = coo_array((value.ravel(), (row, of.ravel())), (len(pairs), n * size))
    return csc_array(across.T @ across + 0.1 * eye_array(n * size))
