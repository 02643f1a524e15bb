"""What a user has weighted, at the vertices of a mesh: checked, and carried along when the mesh is repaired."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..errors import MeshError


def repaired_weight(
    weight: Floats | None, number: Ints, faces: NDArray[np.integer], first: Ints, surface: NDArray[np.integer]
) -> Floats | None:
    """Return the weights of the vertices of a repaired mesh.

    Parameters
    ----------
    weight : (n_v,) float64 array or None
        As read.
    number : (n_v,) int64 array
        Number of each vertex among those that faces use.
    faces : (n_f, 3) int array
        As read, rows in ``weight``.
    first : (n_used,) int64 array
        First vertex at the same place, of each used one.
    surface : (n, 3) int array
        Faces after the repair: rows in the used vertices, and in new ones behind them.

    Returns
    -------
    (n_all,) float64 array or None
        Of the used vertices and the new ones. Vertices that were merged have
        the greatest of their weights, new ones the mean of those beside them.

    Raises
    ------
    MeshError
        There is not one weight from 0 to 1 for each vertex.
    """
    if weight is None:
        return None
    _check(weight, len(number))
    own = np.zeros(len(first))
    own[number[faces]] = weight[faces]
    merged = np.zeros(max(len(first), int(surface.max(initial=-1)) + 1))
    np.maximum.at(merged, first, own)
    new = surface[(surface >= len(first)).any(axis=1)].astype(np.int64)
    known = np.where(new < len(first), merged[new], 0).sum(axis=1)
    many = np.count_nonzero(new < len(first), axis=1)
    rows, column = np.nonzero(new >= len(first))
    total, count = (np.bincount(new[rows, column], each[rows], len(merged)) for each in (known, many))
    return np.where(count > 0, total / np.maximum(count, 1), merged)


def _check(weight: Floats, n_vertices: int) -> None:
    """Refuse weights that are none."""
    if len(weight) != n_vertices:
        raise MeshError(f"There are {len(weight)} weights for {n_vertices} vertices: paint the mesh again.")
    bad = int(np.count_nonzero(~((weight >= 0) & (weight <= 1))))
    if bad:
        raise MeshError(f"{bad} of {n_vertices} weights are not from 0 to 1: paint them again.")
