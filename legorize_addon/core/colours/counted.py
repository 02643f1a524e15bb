"""Colours and how often they occur, in bounded memory for any number of texels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints

Bytes = NDArray[np.uint8]

_MOST: Final = 1 << 18
"""Number of different colours up to which each counts by itself: k-means on so many takes seconds."""

_CELL_BITS: Final = 2
"""Bits a channel by which more colours may differ and still count as one, their mean: 2^18 cells of four levels."""

_AT_ONCE: Final = 1 << 20
"""Texels counted at once."""


class Counted(NamedTuple):
    """Different colours, in order.

    Attributes
    ----------
    totals : (n, 3) int64 array
        Sums of the sRGB bytes of all texels of a colour.
    counts : (n,) int64 array
        How many texels there are, above 0.
    """

    totals: Ints
    counts: Ints

    @property
    def means(self) -> Floats:
        """The colours, (n, 3) float64, sRGB from 0 to 255."""
        means: Floats = self.totals / self.counts[:, None]
        return means


def count_colours(texels: Bytes) -> Counted:
    """Count the colours of some texels, shape (n, 3), each different one by itself."""
    colours, counts = np.unique(packed(texels), return_counts=True)
    return Counted(unpacked(colours) * counts[:, None], counts)


def count_texels(images: Sequence[Bytes], opacities: Sequence[Bytes | None] = (), *, least: float = 0.0) -> Counted:
    """Count the colours of all texels of images.

    Parameters
    ----------
    images : sequence of (h, w, 3) uint8 arrays
        sRGB.
    opacities : sequence of (h, w) uint8 arrays or None, optional
        Alpha of each image, if there is any.
    least : float, optional
        Least alpha of a texel that counts, 0 to 1; if no texel of an image has it, all of them count.

    Returns
    -------
    Counted
        If there are more than 2^18 different colours, those that differ by less than four levels per channel are merged
        to their exact mean.
    """
    table = np.zeros(1 << 24, dtype=np.uint32)
    for row, image in enumerate(images):
        texels = image.reshape(-1, 3)
        opacity = opacities[row] if opacities else None
        seen = None if opacity is None else (opacity >= least * 255).reshape(-1)
        if seen is not None and seen.any() and not seen.all():
            texels = texels[seen]
        for start in range(0, len(texels), _AT_ONCE):
            np.add.at(table, packed(texels[start : start + _AT_ONCE]), 1)
    colours = np.flatnonzero(table).astype(np.uint32)
    counts = table[colours].astype(np.int64)
    del table
    exact = Counted(unpacked(colours) * counts[:, None], counts)
    return exact if len(colours) <= _MOST else _gathered(exact, colours)


def _gathered(exact: Counted, colours: NDArray[np.uint32]) -> Counted:
    """Add up the colours of each cell of the colour cube."""
    cell = packed((unpacked(colours) >> _CELL_BITS).astype(np.uint8))
    cells, of = np.unique(cell, return_inverse=True)
    columns = [np.bincount(of, each, len(cells)) for each in (*exact.totals.T, exact.counts)]
    # sums of whole numbers below 2^53 are exact
    totals = np.stack(columns, axis=1).astype(np.int64)
    return Counted(totals[:, :3], totals[:, 3])


def packed(rgb: Bytes) -> NDArray[np.uint32]:
    """Return sRGB bytes as one number each."""
    wide = rgb.astype(np.uint32)
    found: NDArray[np.uint32] = wide @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    return found


def unpacked(numbers: NDArray[np.uint32]) -> Bytes:
    """Return the sRGB bytes that numbers stand for."""
    return np.stack([numbers >> 16, numbers >> 8 & 255, numbers & 255], axis=-1).astype(np.uint8)
