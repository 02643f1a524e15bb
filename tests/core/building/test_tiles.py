"""Tiles of mosaics."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.tiles import tiles_of


def squares(wide, deep, levels=(0,)):
    """Return the boxes and levels of 1 x 1 parts on a floor."""
    y, x, z = (each.ravel() for each in np.meshgrid(np.arange(deep), np.arange(wide), levels, indexing="ij"))
    return np.stack([x, x, y, y], axis=1), z


def test_tiles_of_a_picture_of_48_by_32():
    """Three tiles in a row, two rows, all of 256 squares."""
    box, level = squares(48, 32)
    tile = tiles_of(box - 5, level)
    assert (np.unique(tile, return_counts=True)[1] == 256).all()
    assert len(np.unique(tile)) == 6
    assert tile[0] == 1
    assert tile[15] == 1 != tile[16]


def test_what_is_small_or_high_is_no_mosaic():
    """One tile needs no division, and neither does a model with layers upon layers."""
    assert not tiles_of(*squares(16, 16)).any()
    assert not tiles_of(*squares(48, 8)).any()
    assert not tiles_of(*squares(48, 32, levels=range(0, 30, 3))).any()
    assert not tiles_of(np.zeros((0, 4), np.int64), np.zeros(0, np.int64)).any()
