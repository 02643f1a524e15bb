"""The outer air of a model, and its visible cells."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from legorize_addon.core.geometry.neighbourhoods import outer_air, visible

FACES = ndimage.generate_binary_structure(3, 1)


def hollow_block() -> np.ndarray:
    """Return a block of cells with a closed hollow, and a notch from above, shape (layers, y, x)."""
    solid = np.ones((6, 5, 7), dtype=bool)
    solid[1:3, 1:4, 1:4] = False
    solid[4:, 2, 5] = False
    return solid


def test_closed_hollows_are_no_air() -> None:
    """The notch is air, the hollow is not."""
    air = outer_air(hollow_block())
    assert np.argwhere(air).tolist() == [[4, 2, 5], [5, 2, 5]]


def test_visible_cells_touch_the_air() -> None:
    """Cells at the rim of the grid and beside the notch are seen, the walls of the hollow are not from inside."""
    solid = hollow_block()
    seen = visible(solid, outer_air(solid))
    inner = np.zeros_like(solid)
    inner[1:-1, 1:-1, 1:-1] = True
    notch = ndimage.binary_dilation(outer_air(solid), FACES)
    assert np.array_equal(seen, solid & (~inner | notch))
