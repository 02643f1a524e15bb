"""Prisms that slopes fit exactly, with the cells that a model of them has."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model import COLOUR_EMPTY, Fill, UnitGrid, load_catalogue
from legorize_addon.core.units import PLATE, STUD
from tests.core.solids import mesh_of

CATALOGUE = load_catalogue()
RED, WHITE = 4, 15


def prism(corners, width):
    """Draw out a convex polygon of corners (x in studs, z in plates), counter-clockwise, along y from 1 stud on."""
    x, z = np.array(corners, float).T * np.array([[STUD], [PLATE]])
    n, far = len(x), (1 + width) * STUD
    vertices = [np.column_stack([x, np.full(n, y), z]) for y in (STUD, far)]
    ends = [(0, i, i + 1) for i in range(1, n - 1)]
    sides = [(i, n + i, (i + 1) % n) for i in range(n)] + [((i + 1) % n, n + i, n + (i + 1) % n) for i in range(n)]
    faces = [*ends, *((n + a, n + c, n + b) for a, b, c in ends), *sides]
    return mesh_of(np.concatenate(vertices), faces)


def ramp(width=4):
    """Return a block of two bricks' height whose upper edge falls as slopes do: its corners at the right."""
    return prism([(1, 0), (7, 0), (7, 3.5), (6, 6), (1, 6)], width)


def cells_of_ramp(width=4, colour=RED):
    """Return the cells that are filled by half in the ramp, with one free column around them."""
    colours = np.full((9, width + 2, 9), COLOUR_EMPTY, np.int16)
    colours[:6, 1:-1, 1:7] = colour
    colours[5, :, 6] = COLOUR_EMPTY
    colours = colours.reshape(3, 3, width + 2, 9)
    cover = np.where(colours == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colours, cover, np.zeros(colours.shape, np.uint8), np.zeros(3))
