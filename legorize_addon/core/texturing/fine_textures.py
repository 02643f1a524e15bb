"""Textures that change within a stud: from afar they look like their mean in linear light.

An image is divided into blocks of about a stud. Where the texels of a block
differ clearly but its mean is much like those of the blocks around it, the
texture repeats or is noise finer than a stud, and no choice among its colours
would be right: its texels take the mean. Where the means change from block to
block there is something to be seen, such as the rim of an eye or a stripe, and
its texels stay.
"""

from __future__ import annotations

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


def average_windows(image: Bytes, window: tuple[int, int], *, clamp: bool) -> Bytes:
    """Replace texture that is finer than a stud by its mean.

    Parameters
    ----------
    image : (h, w, 3) uint8 array
        sRGB.
    window : two int
        Rows and columns that make about a stud.
    clamp : bool
        Whether the image ends at its rim; else it repeats.

    Returns
    -------
    (h, w, 3) uint8 array
        The image itself if nothing in it is that fine.
    """
    shape = tuple(max(1, round(size / each)) for size, each in zip(image.shape[:2], window, strict=True))
    if shape == image.shape[:2]:
        return image
    fine = _fine_blocks(image, shape, clamp=clamp)
    if not fine.any():
        return image
    row, column = (np.arange(size) * n // size for size, n in zip(image.shape[:2], shape, strict=True))
    means = srgb_from_linear(_smooth(_linear_means(image, shape), fine, clamp=clamp))
    return np.where(fine[row[:, None], column][..., None], means[row[:, None], column], image)


def _fine_blocks(image: Bytes, shape: tuple[int, int], *, clamp: bool) -> Mask:
    """Return the blocks whose texels differ more than they do from the blocks around."""
    spread, difference = np.zeros(shape), np.zeros(shape)
    around = np.ones((3, 3)) / 8
    around[1, 1] = 0
    mode = "nearest" if clamp else "wrap"
    for channel in range(3):
        values = image[..., channel].astype(np.float32)
        mean = box_means(values, shape)
        spread += np.maximum(box_means(values**2, shape) - mean**2, 0)
        # the mean of squared differences, without a loop over the eight
        near, square = (ndimage.convolve(each, around, mode=mode) for each in (mean, mean**2))
        difference += np.maximum(mean**2 - 2 * mean * near + square, 0)
    fine: Mask = (spread > _CLEAR**2) & (difference < _LEVEL**2 * spread)
    return fine


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
