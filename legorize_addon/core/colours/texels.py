"""Texels at image coordinates, and where the colours of an image change."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..mesh import TriangleMesh


def texel_at(uv: Floats, shape: tuple[int, ...], *, clamp: bool) -> tuple[Ints, Ints]:
    """Return the columns and rows of the texels at image coordinates.

    Parameters
    ----------
    uv : (k, 2) float64 array
        Image coordinates; 1 is the whole image.
    shape : tuple of int
        Rows and columns of the image; row 0 is v = 0.
    clamp : bool
        Whether coordinates outside the image take its edge texel; else it repeats.

    Returns
    -------
    column, row : (k,) int64 arrays
    """
    return _along(uv[:, 0], shape[1], clamp=clamp), _along(uv[:, 1], shape[0], clamp=clamp)


def _along(coordinate: Floats, size: int, *, clamp: bool) -> Ints:
    """Return the texels at coordinates along one side of an image."""
    texel = np.floor(coordinate * size)
    # in floating point: whole numbers divide several times slower
    texel = np.clip(texel, 0, size - 1) if clamp else texel - np.floor(texel / size) * size
    return texel.astype(np.int64)


def boxes_varied(table: NDArray[np.int32], low: Floats, high: Floats, *, clamp: bool) -> Mask:
    """Return whether boxes of an image may hold more than one colour.

    Parameters
    ----------
    table : (h + 1, w + 1) int32 array
        From ``border_table``.
    low, high : (k, 2) float64 arrays
        Corners of the boxes in image coordinates.
    clamp : bool
        As for ``texel_at``.

    Returns
    -------
    (k,) bool array
        False only where one colour fills the box.
    """
    size = np.array([table.shape[1] - 1, table.shape[0] - 1])
    (x0, y0), (x1, y1) = (texel_at(ends, table[1:, 1:].shape, clamp=clamp) for ends in (low, high))
    # boxes that cross the rim of a repeated image wrap around
    width, height = (np.floor(high * size) - np.floor(low * size)).T
    across = np.zeros(len(low), dtype=bool) if clamp else (x1 - x0 != width) | (y1 - y0 != height)
    x1, y1 = np.where(across, x0, x1), np.where(across, y0, y1)
    # a border between texels i and i + 1 is noted at i: the far sides of a box count too generously, at some cost
    upper, lower = (y1 + 1) * table.shape[1], y0 * table.shape[1]
    count = table.take(upper + x1 + 1) - table.take(lower + x1 + 1) - table.take(upper + x0) + table.take(lower + x0)
    varied: Mask = across | ((count > 0) & ((x0 != x1) | (y0 != y1)))
    return varied


def border_table(codes: NDArray[np.int16]) -> NDArray[np.int32]:
    """Return the summed-area table of texels that differ from the next one to the right or above.

    Parameters
    ----------
    codes : (h, w) int16 array
        Colour of each texel.

    Returns
    -------
    (h + 1, w + 1) int32 array
    """
    border = np.zeros(codes.shape, dtype=bool)
    border[:, :-1] |= codes[:, 1:] != codes[:, :-1]
    border[:-1] |= codes[1:] != codes[:-1]
    table = np.zeros((codes.shape[0] + 1, codes.shape[1] + 1), dtype=np.int32)
    np.cumsum(np.cumsum(border, axis=0, dtype=np.int32), axis=1, out=table[1:, 1:])
    return table


def texels_at(mesh: TriangleMesh, image: NDArray[np.integer], uv: Floats) -> NDArray[np.uint8]:
    """Return the texels at points of a mesh's images.

    Parameters
    ----------
    mesh : TriangleMesh
    image : (k,) int array
        Image of each point.
    uv : (k, 2) float64 array
        Image coordinates.

    Returns
    -------
    (k, 3) uint8 array
        sRGB.
    """
    texels = np.empty((len(uv), 3), dtype=np.uint8)
    for row, pixels in enumerate(mesh.images):
        here = image == row
        column, line = texel_at(uv[here], pixels.shape[:2], clamp=bool(mesh.image_clamp[row]))
        texels[here] = pixels[line, column]
    return texels
