"""Images on coarser lattices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Floats
from ..geometry import ranges


def box_means(values: NDArray[np.floating], shape: tuple[int, ...]) -> Floats:
    """Return the means of an image over the boxes of a coarser lattice, exact also where texels lie in two of them.

    Parameters
    ----------
    values : (h, w) float array
    shape : two int
        Rows and columns of the result, at least 1 and at most those of the image.

    Returns
    -------
    (rows, columns) float64 array
    """
    means = values
    for n in shape:
        # one side and then, on the transposed image, the other
        means = _along(means, n).T
    result: Floats = np.asarray(means, dtype=np.float64)
    return result


def _along(values: NDArray[np.floating], boxes: int) -> NDArray[np.floating]:
    """Return the means over the boxes along the rows, (boxes, w)."""
    every, left = divmod(len(values), boxes)
    if left:
        means: NDArray[np.floating] = _weights(boxes, len(values)) @ values
        return means
    if every == 1:
        return values
    # whole texels alone: added in the same order as by the matrix, in a fraction of its time
    share = np.float32(1 / every)
    means = values[::every] * share
    for texel in range(1, every):
        means += values[texel::every] * share
    return means


def _weights(boxes: int, texels: int) -> sparse.csr_array:
    """Return the share of each texel in each box along one side, (boxes, texels)."""
    edge = np.arange(boxes + 1) * texels / boxes
    first = np.floor(edge[:-1]).astype(np.int64)
    box, texel = ranges(first, np.ceil(edge[1:]).astype(np.int64) - first)
    width = np.minimum(texel + 1, edge[1:][box]) - np.maximum(texel, edge[:-1][box])
    share = (width * boxes / texels).astype(np.float32)
    return sparse.csr_array((share, (box, texel)), shape=(boxes, texels))
