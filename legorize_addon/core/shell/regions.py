"""The difference of the regions of two layers: the part of one layer that the other leaves uncovered.

A region is the set of cells of a layer. The paper has four cases, by how the regions of the two layers overlap; one
formula covers all of them.

References
----------
Paper, section on hollowing: the cases (a) to (d) of the difference of regions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Mask

IN_PLANE: Final = np.array([np.zeros((3, 3)), np.ones((3, 3)), np.zeros((3, 3))], dtype=bool)
"""Cells of one layer that touch, if only at a corner, belong to one region."""


@dataclass(frozen=True, slots=True)
class CaseTally:
    """How often each of the paper's cases occurs.

    Attributes
    ----------
    inside : int
        (a) The regions of the other layer that meet this one lie within it.
    crossing : int
        (b) The regions overlap, and each has cells of its own.
    covering : int
        (c) The other layer covers this region (or equals it).
    apart : int
        (d) The other layer has no cell of this region.
    """

    inside: int
    crossing: int
    covering: int
    apart: int


def outer4(layers: Mask) -> Mask:
    """Return the cells that share an edge with an empty one of their layer.

    This is the paper's chain of boundary bricks, joined at edges or corners.

    Parameters
    ----------
    layers : (..., n_y, n_x) bool array

    Returns
    -------
    (..., n_y, n_x) bool array
    """
    wide = _margin(layers)
    closed = wide[..., 1:-1, :-2] & wide[..., 1:-1, 2:] & wide[..., :-2, 1:-1] & wide[..., 2:, 1:-1]
    return layers & ~closed


def outer8(layers: Mask) -> Mask:
    """Return the cells that share an edge or a corner with an empty one of their layer.

    This chain is joined at edges: it closes the diagonal gaps of :func:`outer4`.

    Parameters
    ----------
    layers : (..., n_y, n_x) bool array

    Returns
    -------
    (..., n_y, n_x) bool array
    """
    wide = _margin(layers)
    rows = wide[..., :-2] & wide[..., 1:-1] & wide[..., 2:]
    return layers & ~(rows[..., :-2, :] & rows[..., 1:-1, :] & rows[..., 2:, :])


def difference(layers: Mask, others: Mask, *, corners: bool = False) -> Mask:
    """Return what must stay of each layer beside another one, by the paper's four cases.

    Parameters
    ----------
    layers, others : (..., n_y, n_x) bool arrays
        The layers at hand, and the layer that each is compared with.
    corners : bool
        Take outlines by :func:`outer8` instead of :func:`outer4`.

    Returns
    -------
    (..., n_y, n_x) bool array
        ``outer(R) | R - X | outer(X) & R``.
    """
    outer = outer8 if corners else outer4
    return outer(layers) | layers & ~others | outer(others) & layers


def kept(layers: Mask, *, upper_only: bool = False, open_bottom: bool = False, corners: bool = False) -> Mask:
    """Return what must stay of every layer of a stack.

    Parameters
    ----------
    layers : (n_layers, n_y, n_x) bool array
        Bottom-up; nothing lies above the last layer.
    upper_only : bool
        Compare each layer with the one above alone, as the paper does; else also
        with the one below.
    open_bottom : bool
        The lowest layer needs no cover from below. The upper layer alone never
        asks for one.
    corners : bool
        As in :func:`difference`.

    Returns
    -------
    (n_layers, n_y, n_x) bool array
        With both neighbours and `corners`, the cells with an empty one among
        their 26 neighbours.
    """
    empty = np.zeros_like(layers[:1])
    stay = difference(layers, np.concatenate([layers[1:], empty]), corners=corners)
    if not upper_only:
        ground = layers[:1] if open_bottom else empty
        stay |= difference(layers, np.concatenate([ground, layers[:-1]]), corners=corners)
    return stay


def tally_cases(layers: Mask, *, upper_only: bool = False) -> CaseTally:
    """Count the paper's cases over all regions and neighbouring layers.

    Parameters
    ----------
    layers : (n_layers, n_y, n_x) bool array
        A region is what hangs together in a layer by edges or corners.
    upper_only : bool
        Compare with the layer above alone; else also with the one below.

    Returns
    -------
    CaseTally
        Summed over the pairs of layers; the top layer has none above it.
    """
    label, n_regions = ndimage.label(layers, IN_PLANE)
    size = np.bincount(label.ravel(), minlength=n_regions + 1)
    counts = _cases(label[:-1], label[1:], size)
    if not upper_only:
        counts += _cases(label[1:], label[:-1], size)
    return CaseTally(*(int(count) for count in counts))


def _cases(label: NDArray[np.int32], other: NDArray[np.int32], size: NDArray[np.int64]) -> NDArray[np.int64]:
    """Count the cases of the regions in `label` beside those in `other`, both numbered from 1."""
    n = len(size)
    both = (label > 0) & (other > 0)
    covered = np.bincount(label[both], minlength=n)
    # a region that lies wholly on solid cells lies within one region, for it hangs together
    sticks_out = np.bincount(other[both], minlength=n) < size
    crossed = np.bincount(label[both & sticks_out[other]], minlength=n) > 0
    present = np.bincount(label.ravel(), minlength=n) > 0
    present[0] = False
    apart, covering = present & (covered == 0), present & (covered == size)
    rest = present & ~apart & ~covering
    return np.array([np.count_nonzero(case) for case in (rest & ~crossed, rest & crossed, covering, apart)])


def _margin(layers: Mask) -> Mask:
    """Put empty cells around every layer."""
    return np.pad(layers, [(0, 0)] * (layers.ndim - 2) + [(1, 1), (1, 1)])
