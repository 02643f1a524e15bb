"""Cells that join parts which touch only at an edge or a corner.

A thin leg that leans steps sideways from layer to layer, and its cells meet at
their edges: no stud holds there. One more cell beside the joint gives both a
brick in common.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints, Mask

_DIAGONALS: Final = (
    np.array([step for step in np.ndindex(3, 3, 3) if step > (1, 1, 1) and np.count_nonzero(np.array(step) - 1) > 1])
    - 1
)
"""Steps to the edge and corner neighbours along layer, y and x, one of each opposite pair."""


def bridging_cells(solid: Mask, surface: Floats) -> Mask:
    """Return cells to add so that parts that touch at an edge or a corner meet face to face.

    Parts that are joined elsewhere, or do not touch at all, stay as they are.

    Parameters
    ----------
    solid : (n_layers, n_y, n_x) bool array
    surface : (n_layers, n_y, n_x) float64 array
        Surface of the mesh in each cell: of two ways around a joint the one with more surface is used.

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    joined = np.pad(solid, 1)
    weight = np.pad(surface, 1)
    while True:
        part, n_parts = ndimage.label(joined)
        near, far = _touching(part, n_parts) if n_parts > 1 else ((), ())
        if len(near) == 0:
            return joined[1:-1, 1:-1, 1:-1] & ~solid
        for start, end in zip(near, far, strict=True):
            _join(joined, weight, start, end)


def under_steps(solid: Mask) -> Mask:
    """Return cells to add where thin walls step aside from layer to layer, below the upper of two that meet at an edge.

    Such walls may be joined elsewhere, so that they are one part, but here they hang and tear off. The added cells show
    only from below.

    Parameters
    ----------
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    under = np.zeros_like(solid)
    for across in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        upper, beside = _shifted(solid[1:], (0, *across))
        below, stair = _shifted(solid[:-1], (0, *across))
        cells, _ = _shifted(under[:-1], (0, *across))
        cells |= upper & ~beside & ~below & stair
    return under


def _touching(part: np.ndarray, n_parts: int) -> tuple[Ints, Ints]:
    """Return one pair of cells for each pair of parts that touch at an edge, or else at a corner."""
    pairs = []
    for rank, step in sorted((np.count_nonzero(step), tuple(step)) for step in _DIAGONALS):
        here, there = _shifted(part, step)
        rows = np.argwhere((here > 0) & (there > 0) & (here != there))
        first = rows + np.maximum(-np.array(step), 0)
        a, b = part[tuple(first.T)], part[tuple((first + step).T)]
        key = np.minimum(a, b).astype(np.int64) * (n_parts + 1) + np.maximum(a, b)
        pairs.append(np.column_stack([np.full(len(key), rank), key, first, first + step]))
    found = np.concatenate(pairs)
    # edges come before corners, so the first of each pair of parts is the shortest joint
    _, first_row = np.unique(found[:, 1], return_index=True)
    chosen = found[first_row]
    return chosen[:, 2:5], chosen[:, 5:8]


def _shifted(part: np.ndarray, step: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return the views of cells and of their neighbours at a step."""
    here = tuple(slice(max(-s, 0), min(-s, 0) or None) for s in step)
    there = tuple(slice(max(s, 0), min(s, 0) or None) for s in step)
    return part[here], part[there]


def _join(joined: Mask, weight: Floats, start: Ints, end: Ints) -> None:
    """Walk from one cell to the other, face by face, each time to the cell with more surface."""
    cell = start.copy()
    while (cell != end).sum() > 1:
        axes = np.flatnonzero(cell != end)
        ways = np.repeat(cell[None], len(axes), axis=0)
        ways[np.arange(len(axes)), axes] = end[axes]
        cell = ways[np.argmax(weight[tuple(ways.T)])]
        joined[tuple(cell)] = True
