"""Small grids for the tests of the layout, and what must hold of every layout."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.problem import GROUND, pose, with_margins
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid

CATALOGUE = load_catalogue()

RED, WHITE = 4, 15


def with_part(catalogue, length, width, height=3):
    """Return a catalogue with a further part, made in all colours."""
    part = replace(
        catalogue.parts[0], number=f"made-{length}x{width}", length=length, width=width, height=height, profile="box"
    )
    return replace(
        catalogue,
        parts=(*catalogue.parts, part),
        exists=np.vstack([catalogue.exists, np.ones((1, len(catalogue.colours)), bool)]),
        element=np.vstack([catalogue.element, np.zeros((1, len(catalogue.colours)), np.int64)]),
    )


def grid_of(colour, cover=None, role=None):
    """Return a grid, given (n_layers, 3, n_y, n_x) arrays; everything filled is must unless said otherwise."""
    colour = np.asarray(colour, np.int16)
    if cover is None:
        cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED)
    role = np.zeros(colour.shape) if role is None else role
    return UnitGrid(colour, np.asarray(cover, np.uint8), np.asarray(role, np.uint8), np.zeros(3))


def brick_grid(colour, cover=None):
    """Return a grid of whole bricks, given (n_layers, n_y, n_x) arrays."""
    return grid_of(
        *(None if each is None else np.repeat(np.asarray(each)[:, None], 3, axis=1) for each in (colour, cover))
    )


def problem_of(colour, cover=None, owner=None):
    """Return the problem of a single sheet of bricks on the ground, or on given owners below it."""
    grid = brick_grid(np.asarray(colour)[None], None if cover is None else np.asarray(cover)[None])
    (sheets,) = split(grid)
    among = shapes(CATALOGUE, 3, np.unique(grid.colour[grid.colour >= 0]), 71)
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    owners = np.full(required.shape, NOBODY, np.int32)
    owners[0] = GROUND if owner is None else owner
    return pose(sheets, among, placements(sheets, among), owners, required)


def planes(cells):
    """Return (n_plates, n_y, n_x) of (n_layers, 3, n_y, n_x)."""
    return cells.reshape(-1, *cells.shape[2:])


def assert_covers(bricks, grid, catalogue=CATALOGUE):
    """Assert that bricks cover a grid: required cells once, optional cells at most once, colours kept, parts exist."""
    links = contact_graph(bricks, catalogue)
    assert links.collisions == 0
    owner = np.full(planes(grid.cover).shape, NOBODY)
    n_z, n_y, n_x = links.owner.shape
    owner[:n_z, :n_y, :n_x] = links.owner
    built = owner != NOBODY
    cover, colour = planes(grid.cover), planes(grid.colour)
    assert built[cover == Fill.REQUIRED].all()
    assert not built[cover == Fill.EMPTY].any()
    fixed = built & (colour >= 0)
    np.testing.assert_array_equal(bricks.colour[owner[fixed]], colour[fixed])
    assert catalogue.exists_in(bricks.part, bricks.colour).all()
    return links


def random_sheet(seed, shape=(8, 9)):
    """Return colours and cover of a sheet at random, in two colours and any, some cells optional."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, COLOUR_ANY, RED, RED, WHITE], shape)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED], shape))
    cover[0, 0], colour[0, 0] = Fill.REQUIRED, RED
    return colour, cover


def disc(radius):
    """Return the colours of a round sheet."""
    y, x = np.indices((2 * radius + 1, 2 * radius + 1)) - radius
    return np.where(x**2 + y**2 <= (radius + 0.3) ** 2, RED, COLOUR_EMPTY)


def ring(side):
    """Return the colours of a square ring two cells wide, in two colours."""
    colour = np.full((side, side), RED)
    colour[: side // 3] = WHITE
    colour[2:-2, 2:-2] = COLOUR_EMPTY
    return colour


def assert_covered_once(problem, rows):
    """Assert that placements cover the required cells of a problem once, the others at most once."""
    times = np.bincount(problem.placements.cells[problem.placements.entries(rows)], minlength=len(problem.required))
    assert times.max() == 1
    assert (times[problem.required] == 1).all()
