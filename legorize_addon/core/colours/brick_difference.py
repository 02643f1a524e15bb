"""How different bricks look from colours that are wanted."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..model import Catalogue
from .difference import ciede2000, lab_from_srgb

BLACK: Final = 0
"""LDraw code of Black."""


def brick_differences(wanted: Floats, codes: NDArray[np.int16], catalogue: Catalogue) -> Floats:
    """Return how different bricks look from what is wanted.

    LDraw's Black is a dark blue-grey, farther from pure black than Dark Brown is; the plastic is black, so whatever is
    nearer to pure black is Black as well.

    Parameters
    ----------
    wanted : (..., 3) float64 array
        CIELAB; the shape without its last axis broadcasts with that of `codes`.
    codes : (...) int16 array
        LDraw codes of the bricks' colours.
    catalogue : Catalogue

    Returns
    -------
    (...) float64 array
        CIEDE2000.
    """
    kinds, row = np.unique(codes, return_inverse=True)
    rgb = catalogue.rgb[[catalogue.colour_row(int(code)) for code in kinds]]
    difference = ciede2000(wanted, lab_from_srgb(rgb)[row.reshape(codes.shape)])
    pure = ciede2000(wanted, np.zeros(3))
    return np.where(codes == BLACK, np.minimum(difference, pure), difference)
