"""Planes of symmetry in the middle of a grid."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.geometry.mirroring import SYMMETRIC, mirror_axis


@pytest.mark.parametrize("axis", [1, 2])
def test_axis_is_found(axis):
    """A body of random cells and their images is symmetric along one axis alone."""
    half = np.random.default_rng(axis).random((4, 8, 8)) < 0.5
    assert mirror_axis(np.concatenate([half, np.flip(half, axis)], axis=axis)) == axis


def test_random_cells_and_nothing_are_not():
    """There is no plane where cells have no images, or where there are no cells."""
    assert mirror_axis(np.random.default_rng(0).random((4, 9, 9)) < 0.5) is None
    assert mirror_axis(np.zeros((2, 3, 4), dtype=bool)) is None


def test_limit():
    """The share counts the cells of both: as many as the limit says may lack an image, and no more."""
    cells = np.zeros((1, 3, 200), dtype=bool)
    cells[:, 1:] = True
    most = round((1 - SYMMETRIC) * 400 / 2)
    cells[:, 1, :most] = False
    assert mirror_axis(cells) == 2
    cells[:, 1, most] = False
    assert mirror_axis(cells) is None
