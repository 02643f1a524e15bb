"""The image that a mosaic is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import MeshError


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """An image as it is seen.

    Attributes
    ----------
    rgb : (h, w, 3) uint8 array
        sRGB; row 0 is the bottom.
    alpha : (h, w) uint8 array
        255 is opaque.
    """

    rgb: NDArray[np.uint8]
    alpha: NDArray[np.uint8]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        height, width = self.alpha.shape
        return width, height


def picture_of(rgb: NDArray[np.uint8], alpha: NDArray[np.uint8] | None = None) -> Picture:
    """Return the image that bytes stand for.

    Parameters
    ----------
    rgb : (h, w, 3) uint8 array
        sRGB; row 0 is the bottom.
    alpha : (h, w) uint8 array, optional
        255 is opaque, as everything is without it.

    Returns
    -------
    Picture

    Raises
    ------
    MeshError
        There is no pixel, or none that can be seen.
    """
    if not rgb.size:
        raise MeshError("The image has no pixels: choose another one.")
    opacity = np.full(rgb.shape[:2], 255, dtype=np.uint8) if alpha is None else alpha
    if not opacity.any():
        raise MeshError("The image is transparent everywhere: choose another one.")
    return Picture(rgb, opacity)
