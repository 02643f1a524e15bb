"""Images that are not finer than needed at the size of the model.

From the usual distance, texels much smaller than a stud cannot be told apart: one
sees their mean, in linear light. So every face gets a reduced image whose texels
are not much smaller than the part of a stud that can decide a brick's colour.
That bounds the work, because the number of texels that an edge crosses is bounded
by its studs, whatever the image coordinates are. Hidden texels do not count;
where no visible texel is near they take the colour of the nearest visible ones.

References
----------
L. Williams, "Pyramidal parametrics", SIGGRAPH 1983 (means of halved images, one
for each size on the surface).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..colours import linear_from_srgb, srgb_from_linear
from ..mesh import TriangleMesh
from ..units import STUD
from .box_means import box_means
from .fine_textures import FineTextures

TEXELS_PER_STUD: Final = 16
"""Largest number of texels that a stud's length crosses along one side of an image."""

_MOST_CROSSED: Final = 128
"""Most texels that an edge crosses for each stud of its face, and one more stud, however odd the face is."""

_WIDTH: Final = 1 / 64
"""Width in studs of a triangle that is too narrow to tell how image coordinates rise across it."""

_GREAT: Final = 1000
"""Image coordinates beyond which texels are looked up less exactly."""

Bytes = NDArray[np.uint8]


def reduce_images(mesh: TriangleMesh, *, least: float, mean: bool = True) -> TriangleMesh:
    """Give each face an image that is not finer than needed.

    Parameters
    ----------
    mesh : TriangleMesh
        In the size of the model.
    least : float
        Least alpha of a visible texel, 0 to 1; others do not count. At 0, where everything is built, one half is used.
    mean : bool, optional
        Whether texture finer than a stud becomes its mean, see :mod:`.fine_textures`; never on weighted faces, where
        an eye is not to be mixed with the white around it.

    Returns
    -------
    TriangleMesh
        Without alpha. Images that are fine enough and wholly seen stay as they are.
    """
    halvings, windows = _resolutions(mesh)
    if not mean:
        windows[:] = 0
    elif mesh.weight is not None:
        windows[(mesh.weight[mesh.faces] > 0).any(axis=1)] = 0
    kinds, row = np.unique(np.column_stack([mesh.face_image, halvings, windows]), axis=0, return_inverse=True)
    made = _Images(mesh, least or 0.5)
    place = np.array([made.row(*kind) for kind in kinds.tolist()], dtype=np.int32)
    return replace(
        mesh,
        uvs=_near_zero(mesh),
        images=tuple(made.images),
        face_image=place[row.reshape(-1)],
        image_clamp=np.array(made.clamp, dtype=bool),
        opacities=(),
    )


class _Images:
    """Reduced images as they are made, each once."""

    def __init__(self, mesh: TriangleMesh, least: float) -> None:
        self.images: list[Bytes] = []
        self.clamp: list[bool] = []
        self._mesh, self._least = mesh, least
        self._reduced: tuple[tuple[int, int, int], FineTextures] | None = None

    def row(self, image: int, y: int, x: int, high: int, wide: int) -> int:
        """Return the row of an image, given how often its sides are halved and the logarithms of its windows."""
        clamp, key = bool(self._mesh.image_clamp[image]), (image, y, x)
        if self._reduced is None or self._reduced[0] != key:
            opacity = self._mesh.opacities[image] if self._mesh.opacities else None
            reduced = _reduced(self._mesh.images[image], opacity, (y, x), self._least)
            # of the last one alone, as they take much room and those of one image follow each other
            self._reduced = key, FineTextures(reduced, clamp=clamp)
        made = self._reduced[1].averaged((1 << high, 1 << wide))
        known = [row for row, each in enumerate(self.images) if each is made and self.clamp[row] == clamp]
        if known:
            return known[0]
        self.images.append(made)
        self.clamp.append(clamp)
        return len(self.images) - 1


def _near_zero(mesh: TriangleMesh) -> Floats:
    """Return the image coordinates, those of repeated images moved to the first repeats where they are great."""
    shift = np.floor(mesh.uvs.min(axis=1, keepdims=True))
    # only where it matters: subtracting rounds
    great = (np.abs(shift) > _GREAT) & ~mesh.image_clamp[mesh.face_image][:, None, None]
    moved: Floats = mesh.uvs - np.where(great, shift, 0)
    return moved


def _resolutions(mesh: TriangleMesh) -> tuple[Ints, Ints]:
    """Find how finely the image of each face is needed.

    Returns
    -------
    halvings : (n_f, 2) int64 array
        How often its rows and columns are to be halved.
    windows : (n_f, 2) int64 array
        Logarithm to the base 2 of the rows and columns that then make a stud, 0 where they make less.
    """
    size = np.array([image.shape[1::-1] for image in mesh.images])[mesh.face_image]
    corners = mesh.vertices[mesh.faces] / STUD
    edges, rises = corners[:, 1:] - corners[:, :1], (mesh.uvs[:, 1:] - mesh.uvs[:, :1]) * size[:, None]
    halvings, windows = np.zeros((2, len(size), 2), dtype=np.int64)
    rows = np.flatnonzero((np.abs(rises) > 1).any(axis=(1, 2)))
    edges, rises, size = edges[rows], rises[rows], size[rows]
    crossed = np.abs(rises).max(axis=1) / (_MOST_CROSSED * (1 + np.abs(edges).max(axis=(1, 2))[:, None]))
    per_stud = _steepness(edges, rises)
    least = np.ceil(np.log2(np.maximum(np.maximum(per_stud / TEXELS_PER_STUD, crossed), 1)))
    halved = np.minimum(least, np.ceil(np.log2(size)))
    halvings[rows] = halved[:, ::-1]
    windows[rows] = np.rint(np.log2(np.clip(per_stud / 2**halved, 1, TEXELS_PER_STUD)))[:, ::-1]
    return halvings, windows


def _steepness(edges: Floats, rises: Floats) -> Floats:
    """Return how steeply image coordinates rise on triangles, given two edges each and the rises along them.

    Parameters
    ----------
    edges : (k, 2, 3) float64 array
    rises : (k, 2, 2) float64 array

    Returns
    -------
    (k, 2) float64 array
        Along the triangle's plane. Widths far below ``_WIDTH`` count as none,
        for there the rises are rounding.
    """
    square = np.einsum("kij,kil->kjl", edges, edges) + _WIDTH**2 * np.eye(3)
    slope = np.linalg.solve(square, np.einsum("kij,kil->kjl", edges, rises))
    steepness: Floats = np.linalg.norm(slope, axis=1)
    return steepness


def _reduced(image: Bytes, opacity: Bytes | None, halvings: tuple[int, int], least: float) -> Bytes:
    """Return the means of the seen texels, in linear light."""
    seen = None if opacity is None else opacity >= least * 255
    if seen is not None and (seen.all() or not seen.any()):
        seen = None
    shape = max(1, image.shape[0] >> halvings[0]), max(1, image.shape[1] >> halvings[1])
    if seen is None and shape == image.shape[:2]:
        return image
    weight = np.ones(image.shape[:2], dtype=np.float32) if seen is None else seen.astype(np.float32)
    share = box_means(weight, shape)
    table = linear_from_srgb(np.arange(256, dtype=np.uint8)).astype(np.float32)
    sums = np.stack([box_means(table[image[..., channel]] * weight, shape) for channel in range(3)], axis=-1)
    return srgb_from_linear(_filled(sums, share))


def _filled(sums: Floats, share: Floats) -> Floats:
    """Return sums divided by their shares, where nothing was summed those of boxes twice as large."""
    means = sums / np.maximum(share, 1e-9)[..., None]
    empty = share <= 1e-6
    if not empty.any() or share.size == 1:
        return means
    shape = -(-share.shape[0] // 2), -(-share.shape[1] // 2)
    coarse = np.stack([box_means(sums[..., channel], shape) for channel in range(3)], axis=-1)
    larger = _filled(coarse, box_means(share, shape))
    row, column = (np.arange(n) * m // n for n, m in zip(share.shape, shape, strict=True))
    means[empty] = larger[row[:, None], column][empty]
    return means
