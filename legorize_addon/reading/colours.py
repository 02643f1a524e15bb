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

from ..core.colours import srgb_from_linear

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]

_MOST_TEXELS: Final = 4_000_000
_LARGEST_PATCH: Final = 64


def colour_patches(corners: Floats) -> tuple[Bytes, Bytes, NDArray[np.bool_], Floats]:
    """Paint triangles by the colours of their corners.

    Parameters
    ----------
    corners : (n_f, 3, 4) float64 array
        Linear RGB and alpha of the three corners of every triangle.

    Returns
    -------
    shared : (h, w, 4) uint8 array
        Image, sRGB and alpha, of the distinct colours of the triangles of one colour.
    patches : (h, w, 4) uint8 array
        Image of the patches of the others.
    plain : (n_f,) bool array
        Which triangles lie in ``shared``; the rest lie in ``patches``.
    uvs : (n_f, 3, 2) float64 array
        Coordinates in the image that holds the triangle.
    """
    encoded = _encoded(corners)
    plain = (encoded == encoded[:, :1]).all(axis=(1, 2))
    uvs = np.empty((len(corners), 3, 2))
    distinct, entry = np.unique(encoded[plain, 0], axis=0, return_inverse=True)
    shared, uvs[plain] = _laid_out(distinct[:, None, None], entry.ravel())
    mixed = corners[~plain]
    size = _patch_size(encoded[~plain])
    texels = _encoded(np.einsum("ijc,fcd->fijd", _weights(size), mixed))
    patches, uvs[~plain] = _laid_out(texels, np.arange(len(mixed)))
    return shared, patches, plain, uvs


def _encoded(corners: Floats) -> Bytes:
    """Return linear colours with alpha as bytes: sRGB, and alpha as it is."""
    alpha = np.rint(np.clip(corners[..., 3:], 0, 1) * 255).astype(np.uint8)
    return np.concatenate([srgb_from_linear(corners[..., :3]), alpha], axis=-1)


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
        return np.zeros((1, 1, patches.shape[-1]), dtype=np.uint8), np.zeros((0, 3, 2))
    columns = int(np.ceil(np.sqrt(count)))
    rows = -(-count // columns)
    image = np.zeros((rows * columns, size, size, patches.shape[-1]), dtype=np.uint8)
    image[:count] = patches
    image = image.reshape(rows, columns, size, size, -1).swapaxes(1, 2).reshape(rows * size, columns * size, -1)
    corner = np.array([(0.0, 0.0), (size - 1.0, 0.0), (0.0, size - 1.0)]) + 0.5
    lowest = np.stack([entry % columns, entry // columns], axis=-1) * size
    return image, (lowest[:, None] + corner) / (columns * size, rows * size)
