"""Sizes that cannot be built; the scale itself is shown with the pipeline."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.mesh.size import check_any
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from tests.core.solids import box


def test_nothing_to_build():
    """A grid without a solid cell is refused with the size of the model, one with a cell is not."""
    nothing = np.zeros((1, 3, 2, 2), np.uint8)
    empty = UnitGrid(
        np.full((1, 3, 2, 2), COLOUR_EMPTY, np.int16), nothing + Fill.EMPTY, nothing + Role.SHELL, np.zeros(3)
    )
    with pytest.raises(SettingsError, match=r"1 x 2 x 3 mm, too small for one brick .*\.$"):
        check_any(empty, box((0, 0, 0), (1, 2, 3)), keep_thin=False)
    cover = nothing.copy()
    cover[0, 0, 0, 0] = Fill.REQUIRED
    check_any(UnitGrid(empty.colour, cover, empty.role, empty.origin), box((0, 0, 0), (1, 2, 3)), keep_thin=True)


@pytest.mark.parametrize("size", [(40, 40, 41), (100, 1, 100), (90, 90, 2), (1, 1, 300)])
def test_thin_walls_are_told_apart_from_a_small_model(size):
    """A model of many studs without a cell that is half full asks for thin parts to be kept, unless they are."""
    cells = np.zeros((1, 3, 2, 2), np.uint8)
    nothing = UnitGrid(np.full(cells.shape, COLOUR_EMPTY, np.int16), cells + Fill.EMPTY, cells, np.zeros(3))
    with pytest.raises(SettingsError, match=r" mm, but it never fills half of a cell .*keep_thin"):
        check_any(nothing, box((0, 0, 0), size), keep_thin=False)
    with pytest.raises(SettingsError, match=r" mm, too thin for one brick .*: choose a larger size\.$"):
        check_any(nothing, box((0, 0, 0), size), keep_thin=True)


def test_sizes_of_flat_models_are_plain_numbers():
    """No power of ten is shown, however thin a sheet is or however large."""
    cells = np.zeros((1, 3, 2, 2), np.uint8)
    nothing = UnitGrid(np.full(cells.shape, COLOUR_EMPTY, np.int16), cells + Fill.EMPTY, cells, np.zeros(3))
    with pytest.raises(SettingsError, match=r"would be 152 x 1,480 x 0 mm, but"):
        check_any(nothing, box((0, 0, 0), (152, 1480, 3.5e-8)), keep_thin=False)
    with pytest.raises(SettingsError, match=r"would be 150\.4 x 0\.5 x 12 mm, but"):
        check_any(nothing, box((0, 0, 0), (150.44, 0.5, 12)), keep_thin=False)
