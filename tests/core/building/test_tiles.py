"""Tiles of mosaics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.tiles import FLAT, SIDE, tile_places, tiles_of
from tests.core.any_bricks import CATALOGUE, table


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


@pytest.mark.parametrize(
    ("wide", "deep", "high", "n_tiles"),
    [(17, 16, 6, 2), (16, 17, 6, 2), (17, 15, 6, 0), (16, 16, 6, 0), (17, 16, 7, 0)],
)
def test_sides_and_height_from_which_on_there_are_tiles(wide, deep, high, n_tiles):
    """More than one tile long, at least one wide, and less than six plates high, wherever it stands."""
    box, level = squares(wide, deep, levels=range(20, 20 + high))
    assert len(np.unique(tiles_of(box + 7, level))) == max(n_tiles, 1)
    assert tiles_of(box + 7, level).any() == bool(n_tiles)


def test_wide_parts_lie_in_the_tile_of_their_middle():
    """Of a row of parts four studs long, those that reach over a tile's edge belong to where the most of them is."""
    x = np.arange(-6, 44, 4)
    box = np.stack([x, x + 3, 0 * x, 0 * x + 15], axis=1)
    low = (x + 1 - x.min()) // 16
    assert tiles_of(box, 0 * x).tolist() == (1 + low).tolist()


def test_places_of_bricks():
    """A brick belongs to the tile in which its middle lies; a model that is no mosaic has no tiles."""
    plate = CATALOGUE.part_row("3023")
    rows = [(plate, x, y, 0, 0, 4, 0, 0, 0) for x, y in ((0, 0), (14, 0), (15, 0), (16, 0), (46, 31), (0, 16))]
    assert tile_places(table(rows), CATALOGUE).tolist() == [[0, 0], [0, 0], [0, 0], [0, 1], [1, 2], [1, 0]]
    assert (tile_places(table(rows[:3]), CATALOGUE) == -1).all()
    assert tile_places(table([]), CATALOGUE).shape == (0, 2)


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_tiles_are_counted_from_the_corner(seed):
    """Each part's middle square is looked for in tile after tile, of models around the limits of a mosaic."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 20))
    low = rng.integers(0, rng.choice([12, 16, 50], 2), (n, 2)) - 20
    side = rng.integers(0, 5, (n, 2))
    box = np.stack([low[:, 0], low[:, 0] + side[:, 0], low[:, 1], low[:, 1] + side[:, 1]], axis=1)
    level = rng.integers(0, rng.choice([1, 6, 7]), n)
    wide, deep = (len(range(box[:, k].min(), box[:, k + 1].max() + 1)) for k in (0, 2))
    flat = len(range(level.min(), level.max() + 1)) <= FLAT
    expected = []
    for x0, x1, y0, y1 in box.tolist():
        middle = (x0 + (x1 - x0) // 2, y0 + (y1 - y0) // 2)
        tiles = [
            1 + row * len(range(0, box[:, 0].max() - box[:, 0].min() + 9, SIDE)) + column
            for row in range(9)
            for column in range(9)
            if middle[0] - box[:, 0].min() in range(SIDE * column, SIDE * column + SIDE)
            and middle[1] - box[:, 2].min() in range(SIDE * row, SIDE * row + SIDE)
        ]
        expected += tiles
    found = tiles_of(box, level)
    if flat and min(wide, deep) >= SIDE and max(wide, deep) > SIDE:
        # numbers grow row by row, without saying by how much
        order = np.unique(expected, return_inverse=True)[1]
        assert (np.unique(found, return_inverse=True)[1] == order).all()
        assert found.min() >= 1
    else:
        assert not found.any()
