"""Textures that change within a stud: from afar they look like their mean in linear light.

An image is divided into blocks of about a stud. Where the texels of a block
differ clearly but its mean is much like those of the blocks around it, the
texture repeats or is noise finer than a stud, and no choice among its colours
would be right: its texels take the mean. Where the means change from block to
block there is something to be seen, such as the rim of an eye or a stripe, and
its texels stay.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats, Mask
from ..colours import linear_from_srgb, srgb_from_linear
from .box_means import box_means

_CLEAR: Final = 32.0
"""Spread within a block, in sRGB bytes, from which a texture is more than shades of one colour."""

_LEVEL: Final = 0.4
"""Difference from the blocks around as a share of the spread, below which a block is like them.

At a straight border it is 0.8 and more, on a line of a third of a stud 0.6, on noise of
a quarter of a stud 0.35, on checkers of half a stud 0.
"""

Bytes = NDArray[np.uint8]
Singles = NDArray[np.float32]


class FineTextures:
    """An image of which texture that is finer than a stud becomes its mean, for studs of any size in texels.

    Parameters
    ----------
    image : (h, w, 3) uint8 array
        sRGB.
    clamp : bool
        Whether the image ends at its rim; else it repeats.
    """

    def __init__(self, image: Bytes, *, clamp: bool) -> None:
        self._image, self._clamp = image, clamp
        self._means: dict[tuple[int, int], Singles] = {}

    def averaged(self, window: tuple[int, int]) -> Bytes:
        """Replace texture that is finer than a stud by its mean.

        Parameters
        ----------
        window : two int
            Rows and columns that make about a stud.

        Returns
        -------
        (h, w, 3) uint8 array
            The image itself if nothing in it is that fine.
        """
        image, clamp = self._image, self._clamp
        height, width = (max(1, round(size / each)) for size, each in zip(image.shape[:2], window, strict=True))
        shape = height, width
        if shape == image.shape[:2]:
            return image
        fine = _fine_blocks(self._over(shape), clamp=clamp)
        if not fine.any():
            return image
        row, column = (np.arange(size) * n // size for size, n in zip(image.shape[:2], shape, strict=True))
        means = srgb_from_linear(_smooth(_linear_means(image, shape), fine, clamp=clamp))
        made, (y, x) = image.copy(), np.nonzero(fine[row][:, column])
        made[y, x] = means[row[y], column[x]]
        return made

    def _over(self, shape: tuple[int, int]) -> Singles:
        """Return the means of the texels and of their squares over blocks, (2, 3, rows, columns)."""
        if shape not in self._means:
            # of smaller blocks without any rest, if there are some: whole numbers over powers of two, so exact
            parts = [each for each in self._means if not (each[0] % shape[0] or each[1] % shape[1])]
            finest = self._means[min(parts, key=math.prod)] if parts else _with_squares(self._image)
            made = [[box_means(channel, shape) for channel in of] for of in finest]
            self._means[shape] = np.array(made, dtype=np.float32)
        return self._means[shape]


def _with_squares(image: Bytes) -> Singles:
    """Return the texels and their squares by channels, (2, 3, h, w)."""
    texels = np.moveaxis(image, 2, 0).astype(np.float32)
    return np.stack([texels, texels**2])


def _fine_blocks(means: Singles, *, clamp: bool) -> Mask:
    """Return the blocks whose texels differ more than they do from the blocks around."""
    spread, difference = np.zeros((2, *means.shape[2:]))
    for mean, square in means.transpose(1, 0, 2, 3).astype(np.float64):
        spread += np.maximum(square - mean**2, 0)
        # the mean of squared differences, without a loop over the eight
        near, further = (_around(each, clamp=clamp) for each in (mean, mean**2))
        difference += np.maximum(mean**2 - 2 * mean * near + further, 0)
    fine: Mask = (spread > _CLEAR**2) & (difference < _LEVEL**2 * spread)
    return fine


def _around(values: Floats, *, clamp: bool) -> Floats:
    """Return the mean of the eight blocks around each."""
    wide = np.pad(values, 1, mode="edge" if clamp else "wrap")
    rows = wide[:-2] + wide[1:-1] + wide[2:]
    around: Floats = (rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:] - values) / 8
    return around


def _linear_means(image: Bytes, shape: tuple[int, int]) -> Floats:
    table = linear_from_srgb(np.arange(256, dtype=np.uint8)).astype(np.float32)
    return np.stack([box_means(table[image[..., channel]], shape) for channel in range(3)], axis=-1)


def _smooth(means: Floats, fine: Mask, *, clamp: bool) -> Floats:
    """Return the means of the fine blocks among each block and those around it: where they lie does not show."""
    mode = "nearest" if clamp else "wrap"
    count = ndimage.uniform_filter(fine.astype(float), 3, mode=mode)
    sums = np.stack(
        [ndimage.uniform_filter(np.where(fine, means[..., channel], 0), 3, mode=mode) for channel in range(3)], axis=-1
    )
    smooth: Floats = sums / np.maximum(count, 1e-9)[..., None]
    return smooth
