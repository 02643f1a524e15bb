"""Linear colours as sRGB bytes, and colours at the corners of triangles as texels of an image.

A triangle whose corners agree takes one texel, shared by all triangles of that
colour. Every other triangle takes a square patch of n x n texels: its corners are
the centres of three corner texels of the patch, and every texel has the colour
interpolated at its place, in linear light as Blender's renderers do. n is the
largest number that keeps all patches within four million texels, but at most 64
and never more than the steps of a byte between the corners.

References
----------
IEC 61966-2-1 (sRGB).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]

_MOST_TEXELS: Final = 4_000_000
_LARGEST_PATCH: Final = 64


def srgb_from_linear(linear: NDArray[np.floating]) -> Bytes:
    """Return sRGB bytes of linear colours, cut to [0, 1]; any shape."""
    share = np.clip(linear, 0.0, 1.0)
    curve = np.where(share <= 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)
    return np.rint(curve * 255.0).astype(np.uint8)


def colour_patches(corners: Floats) -> tuple[Bytes, Bytes, NDArray[np.bool_], Floats]:
    """Paint triangles by the colours of their corners.

    Parameters
    ----------
    corners : (n_f, 3, 3) float64 array
        Linear RGB of the three corners of every triangle.

    Returns
    -------
    shared : (h, w, 3) uint8 array
        sRGB image of the distinct colours of the triangles of one colour.
    patches : (h, w, 3) uint8 array
        sRGB image of the patches of the others.
    plain : (n_f,) bool array
        Which triangles lie in ``shared``; the rest lie in ``patches``.
    uvs : (n_f, 3, 2) float64 array
        Coordinates in the image that holds the triangle.
    """
    encoded = srgb_from_linear(corners)
    plain = (encoded == encoded[:, :1]).all(axis=(1, 2))
    uvs = np.empty((len(corners), 3, 2))
    distinct, entry = np.unique(encoded[plain, 0], axis=0, return_inverse=True)
    shared, uvs[plain] = _laid_out(distinct[:, None, None], entry.ravel())
    mixed = corners[~plain]
    size = _patch_size(encoded[~plain])
    texels = srgb_from_linear(np.einsum("ijc,fcd->fijd", _weights(size), mixed))
    patches, uvs[~plain] = _laid_out(texels, np.arange(len(mixed)))
    return shared, patches, plain, uvs


def _patch_size(encoded: Bytes) -> int:
    if len(encoded) == 0:
        return 1
    steps = int(np.ptp(encoded.astype(np.int16), axis=1).max()) + 1
    return max(1, min(_LARGEST_PATCH, steps, int(np.sqrt(_MOST_TEXELS / len(encoded)))))


def _weights(size: int) -> Floats:
    """Return the barycentric weights of the texels of a patch, shape (size, size, 3): [row, column]."""
    if size == 1:
        return np.full((1, 1, 3), 1 / 3)
    place = np.arange(size) / (size - 1)
    along, up = np.meshgrid(place, place)
    # texels beyond the long side take the colour of the nearest point on it, in these coordinates
    beyond = np.maximum(along + up - 1, 0) / 2
    along, up = np.clip(along - beyond, 0, 1), np.clip(up - beyond, 0, 1)
    return np.stack([1 - along - up, along, up], axis=-1)


def _laid_out(patches: Bytes, entry: NDArray[np.integer]) -> tuple[Bytes, Floats]:
    """Put square patches side by side; return the image and the corners of the triangles that use the entries."""
    count, size = patches.shape[:2]
    if count == 0:
        return np.zeros((1, 1, 3), dtype=np.uint8), np.zeros((0, 3, 2))
    columns = int(np.ceil(np.sqrt(count)))
    rows = -(-count // columns)
    image = np.zeros((rows * columns, size, size, 3), dtype=np.uint8)
    image[:count] = patches
    image = image.reshape(rows, columns, size, size, 3).swapaxes(1, 2).reshape(rows * size, columns * size, 3)
    corner = np.array([(0.0, 0.0), (size - 1.0, 0.0), (0.0, size - 1.0)]) + 0.5
    lowest = np.stack([entry % columns, entry // columns], axis=-1) * size
    return image, (lowest[:, None] + corner) / (columns * size, rows * size)
