"""The paper's four energies of a layer's layout; lower is better.

A layout is given as planes of owners: which brick lies in each cell of the layer,
and of the layers below and above.

References
----------
Paper, section on features: minimum unit connection, stability (vertical and
horizontal), symmetry, efficiency. Symmetry and efficiency are those of Min, Park,
Yang and Yun 2018, "Legorization from silhouette-fitted voxelization", KSII TIIS
12(6). The worked numbers of both texts are in the tests.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ...model import NOBODY, agree
from ..problem import Index, Rows

LARGEST: Final = 16
"""Studs of the largest brick."""

RING: Final = 24
"""Cells around the longest brick, 2 x 8."""

CORNER_AREA: Final = 4
"""What the paper counts for the corner part: 1 x 2 x 2."""

_AROUND: Final = tuple((y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0))
_DIAGONAL: Final = tuple((y, x) for y, x in _AROUND if y and x)


def minimum_unit_connection(owner: Rows, colour: NDArray[np.int16]) -> float:
    """Return the share of bricks that are 1 x 1 and have another such brick across a corner.

    Parameters
    ----------
    owner : (n_y, n_x) int array
        Brick in each cell, ``NOBODY`` where there is none.
    colour : (n,) int16 array
        Colour of each brick; ``COLOUR_ANY`` agrees with every other.

    Returns
    -------
    float
        0 for a layer without bricks.
    """
    size = _sizes(owner, len(colour))
    paired = np.zeros(len(colour), dtype=bool)
    for step in _DIAGONAL:
        here, there = _pairs(owner, step)
        single = (size[here] == 1) & (size[there] == 1)
        paired[here[single & agree(colour[here], colour[there])]] = True
    return _mean(paired)


def vertical_stability(owner: Rows, n: int, above: Mask, below: Mask) -> float:
    """Return how little of the bricks is covered from above and carried from below.

    Parameters
    ----------
    owner : (n_y, n_x) int array
    n : int
        Number of bricks.
    above, below : (n_y, n_x) bool arrays
        Cells that are filled in the neighbouring layers.

    Returns
    -------
    float
        Mean over the bricks of the uncovered share above plus that below, 0 to 2.
    """
    size = _sizes(owner, n)
    bare = sum(1 - _sizes(np.where(each, owner, NOBODY), n) / np.maximum(size, 1) for each in (above, below))
    return _mean(np.asarray(bare))


def horizontal_stability(owner: Rows, n: int, above: Rows | None, below: Rows) -> float:
    """Return how few cells around the bricks are held by bricks that lie across their sides.

    Parameters
    ----------
    owner : (n_y, n_x) int array
    n : int
        Number of bricks.
    above, below : (n_y, n_x) int arrays
        Bricks of the neighbouring layers; None where they are not laid yet.

    Returns
    -------
    float
        Mean over the bricks of (24 - r) / 24 for both neighbouring layers, where
        r counts the cells of the ring around a brick that lie under or on
        bricks which overlap it.
    """
    total = np.zeros(n)
    for other in (above, below):
        total += 1.0 if other is None else (RING - _bridged(owner, other, n)) / RING
    return _mean(total)


def symmetry(owner: Rows, colour: NDArray[np.int16]) -> float:
    """Return the share of bricks without a mirror image, for the better one of the two axes.

    Parameters
    ----------
    owner : (n_y, n_x) int array
    colour : (n,) int16 array

    Returns
    -------
    float
        0 for a symmetric layout. The axes run through the middle of the bricks'
        bounding box. A brick is balanced if the axis passes through its middle,
        or a brick of the same cells, mirrored, and of the same colour is there.
    """
    y, x = np.nonzero(owner != NOBODY)
    if len(y) == 0:
        return 0.0
    box = owner[y.min() : y.max() + 1, x.min() : x.max() + 1]
    return min(_mean(~_balanced(each, colour)) for each in (box, box.T))


def efficiency(size: Index, corner: Mask) -> float:
    """Return how small the bricks are: (16 - A) / 15 on average.

    Parameters
    ----------
    size : (n,) int array
        Studs of each brick.
    corner : (n,) bool array
        Corner parts, which count as 1 x 2 x 2.

    Returns
    -------
    float
        1 for single studs, 0 for 2 x 8.
    """
    area = np.where(corner, CORNER_AREA, size)
    return _mean((LARGEST - area) / (LARGEST - 1))


def gauss_normalised(values: Floats, mean: Floats, deviation: Floats) -> Floats:
    """Bring values to 0 to 1, so that three standard deviations reach the ends.

    Parameters
    ----------
    values : (n, d) float64 array
    mean, deviation : (d,) float64 arrays
        Of the samples that something was learned from.

    Returns
    -------
    (n, d) float64 array
        0.5 at the mean, and where there is no deviation.
    """
    spread = np.where(deviation > 0, 3 * deviation, 1)
    centred = np.where(deviation > 0, (values - mean) / spread, 0)
    normalised: Floats = np.clip((centred + 1) / 2, 0, 1)
    return normalised


def _mean(values: Floats | Mask) -> float:
    return float(np.mean(values)) if len(values) else 0.0


def _sizes(owner: Rows, n: int) -> Index:
    """Return how many cells each brick has, (n,)."""
    return np.bincount(owner[owner != NOBODY], minlength=n)


def _pairs(owner: Rows, step: tuple[int, int]) -> tuple[Rows, Rows]:
    """Return the bricks in cells and in those a step on, where both are there."""
    n_y, n_x = owner.shape
    y, x = step
    here = owner[max(-y, 0) : n_y - max(y, 0), max(-x, 0) : n_x - max(x, 0)]
    there = owner[max(y, 0) : n_y - max(-y, 0), max(x, 0) : n_x - max(-x, 0)]
    both = (here != NOBODY) & (there != NOBODY)
    return here[both], there[both]


def _bridged(owner: Rows, other: Rows, n: int) -> Index:
    """Count the cells of the ring around each brick in which a brick of the other layer lies that overlaps it."""
    padded, beyond = np.pad(owner, 1, constant_values=NOBODY), np.pad(other, 1, constant_values=NOBODY)
    n_other = int(other.max(initial=NOBODY)) + 1
    both = (padded != NOBODY) & (beyond != NOBODY)
    overlapping = np.unique(padded[both].astype(np.int64) * n_other + beyond[both])
    cell = np.arange(padded.size).reshape(padded.shape)
    ring = []
    for step in _AROUND:
        # the brick a step on has this cell in its ring
        near = np.roll(padded, (-step[0], -step[1]), axis=(0, 1))
        rows = (near != NOBODY) & (near != padded) & (beyond != NOBODY)
        ring.append(np.stack([near[rows].astype(np.int64), cell[rows]]))
    brick, place = np.unique(np.concatenate(ring, axis=1), axis=1)
    held = np.isin(brick * n_other + beyond.ravel()[place], overlapping)
    return np.minimum(np.bincount(brick[held], minlength=n), RING)


def _balanced(box: Rows, colour: NDArray[np.int16]) -> Mask:
    """Return which bricks have a mirror image to the left or right, themselves included, (n,)."""
    mirrored = box[:, ::-1]
    there = box != NOBODY
    size = _sizes(box, len(colour))
    pair = np.unique(np.stack([box[there], mirrored[there]]), axis=1, return_counts=True)
    (one, image), shared = pair
    whole = (image != NOBODY) & (shared == size[one]) & (shared == size[image]) & (colour[one] == colour[image])
    balanced = np.zeros(len(colour), dtype=bool)
    balanced[one[whole]] = True
    return balanced
