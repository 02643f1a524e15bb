"""Cells and what is around them: the outer air, and the cells that it touches."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from ..arrays import Mask


def outer_air(solid: Mask) -> Mask:
    """Return the empty cells that are joined, face to face, to the space around the grid.

    Parameters
    ----------
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    label, _ = ndimage.label(~np.pad(solid, 1))
    air: Mask = (label == label[0, 0, 0])[1:-1, 1:-1, 1:-1]
    return air


def visible(solid: Mask, air: Mask) -> Mask:
    """Return the solid cells with a face to the air, or to the rim of the grid."""
    seen: Mask = solid & ndimage.binary_dilation(air, border_value=1)
    return seen
