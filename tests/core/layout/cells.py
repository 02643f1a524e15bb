"""Small grids for the tests of the layout, and what must hold of every layout."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.catalogue import load_catalogue
from legorize_addon.core.connection import NOBODY, connect
from legorize_addon.core.model import COLOUR_EMPTY, Cover, UnitGrid

CATALOGUE = load_catalogue()


def grid_of(colour, cover=None, role=None):
    """Return a grid, given (n_layers, 3, n_y, n_x) arrays; everything filled is must unless said otherwise."""
    colour = np.asarray(colour, np.int16)
    if cover is None:
        cover = np.where(colour == COLOUR_EMPTY, Cover.EMPTY, Cover.MUST)
    role = np.zeros(colour.shape) if role is None else role
    return UnitGrid(colour, np.asarray(cover, np.uint8), np.asarray(role, np.uint8), np.zeros(3))


def brick_grid(colour, cover=None):
    """Return a grid of whole bricks, given (n_layers, n_y, n_x) arrays."""
    return grid_of(
        *(None if each is None else np.repeat(np.asarray(each)[:, None], 3, axis=1) for each in (colour, cover))
    )


def planes(cells):
    """Return (n_plates, n_y, n_x) of (n_layers, 3, n_y, n_x)."""
    return cells.reshape(-1, *cells.shape[2:])


def assert_covers(bricks, grid, catalogue=CATALOGUE):
    """Assert that bricks cover a grid: must cells once, may cells at most once, colours kept, parts exist."""
    links = connect(bricks, catalogue)
    assert links.collisions == 0
    owner = np.full(planes(grid.cover).shape, NOBODY)
    n_z, n_y, n_x = links.owner.shape
    owner[:n_z, :n_y, :n_x] = links.owner
    built = owner != NOBODY
    cover, colour = planes(grid.cover), planes(grid.colour)
    assert built[cover == Cover.MUST].all()
    assert not built[cover == Cover.EMPTY].any()
    fixed = built & (colour >= 0)
    np.testing.assert_array_equal(bricks.colour[owner[fixed]], colour[fixed])
    assert catalogue.exists_in(bricks.part, bricks.colour).all()
    return links
