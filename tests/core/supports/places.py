"""Rooms for the tests of supports, and what must hold of every support."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.supports.boxes import sizes_in
from legorize_addon.core.supports.clearance import Clearance

CATALOGUE = load_catalogue()
WHITE = 15

STEEP = 2
"""Studs of each side of a patch of equal height."""


def room_under(height, n_z=None):
    """Return the room below a ceiling, given the free plates (n_y, n_x) under it."""
    height = np.asarray(height)
    levels = np.arange(height.max() if n_z is None else n_z)[:, None, None]
    free = levels < height
    return Clearance(free, free, ~free, np.zeros(3, np.int32))


def ceiling(height):
    """Return all cells at the underside of a ceiling, (n, 3)."""
    y, x = np.nonzero(np.asarray(height))
    return np.column_stack([x, y, np.asarray(height)[y, x]])


@st.composite
def ceilings(draw, *, most=16, density=(0.1, 0.9)):
    """Draw the room below a ceiling of patches, some without any, and some cells at its underside."""
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    n_y, n_x = draw(st.integers(2, 5)), draw(st.integers(2, 6))
    patch = rng.integers(0, most + 1, (n_y, n_x)) * (rng.random((n_y, n_x)) < 0.8)
    height = np.kron(patch, np.ones((STEEP, STEEP), dtype=int))
    cells = ceiling(height)
    chosen = rng.random(len(cells)) < draw(st.sampled_from(density))
    return room_under(height, most + 1), cells[chosen].astype(np.int32)


def triples(cells):
    """Return cells as tuples."""
    return [tuple(cell) for cell in np.asarray(cells).tolist()]


def owners(boxes, shape):
    """Return the row of the box in each cell (n_z, n_y, n_x); boxes must lie inside and not overlap."""
    owner = np.full(shape, NOBODY)
    for row, (x, y, z, a, b, height) in enumerate(boxes.tolist()):
        place = np.s_[z : z + height, y : y + b, x : x + a]
        assert owner[place].shape == (height, b, a)
        assert (owner[place] == NOBODY).all()
        owner[place] = row
    return owner


def contacts_between(boxes, owner):
    """Return the studs between boxes: a dictionary of (lower row, upper row)."""
    studs = {}
    for row, (x, y, z, a, b, _) in enumerate(boxes.tolist()):
        if z:
            lower, count = np.unique(owner[z - 1, y : y + b, x : x + a], return_counts=True)
            studs |= {(int(one), row): int(n) for one, n in zip(lower, count, strict=True) if one != NOBODY}
    return studs


def assert_sound(boxes, room, cells):
    """Assert that boxes are parts, lie in open room, are held below and needed above, and carry all cells."""
    assert boxes.dtype == np.int32
    sizes = sizes_in(CATALOGUE, WHITE)
    assert all((max(a, b), min(a, b), height) in sizes for _, _, _, a, b, height in boxes.tolist())
    owner = owners(boxes, room.open.shape)
    assert room.open[owner != NOBODY].all()
    studs = contacts_between(boxes, owner)
    lower, upper = {one for one, _ in studs}, {other for _, other in studs}
    for row, (x, y, z, a, b, height) in enumerate(boxes.tolist()):
        # what is held from below leads down to the ground, level by level
        assert z == 0 or row in upper
        on_top = any(z + height == at_z and 0 <= at_x - x < a and 0 <= at_y - y < b for at_x, at_y, at_z in cells)
        assert on_top or row in lower
    for x, y, z in cells:
        assert owner[z - 1, y, x] != NOBODY
    return owner
