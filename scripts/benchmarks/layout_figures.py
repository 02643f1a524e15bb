"""How good a layout is beside the number of its bricks: small bricks, bonding, colours."""

from __future__ import annotations

from typing import Final

import networkx as nx
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter

from legorize_addon.core.arrays import Ints, Mask
from legorize_addon.core.layout.lay import FILLER
from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.problem import owners
from legorize_addon.core.layout.problem.shapes import Shapes, shapes
from legorize_addon.core.layout.problem.sheets import Sheets, split
from legorize_addon.core.layout.solvers.covering_lp import shares
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.model.contacts import ContactGraph
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.units import PLATES_PER_BRICK

GROUND: Final = -1
"""What the lowest bricks stand on, beside the rows of the bricks."""

NEAR: Final = 4
"""Studs around a 1 x 1 within which all cells are covered anew to find the fewest."""

ROUNDING: Final = 1e-6
"""By which the solver may be wrong."""


def single(bricks: Bricks, catalogue: Catalogue) -> Mask:
    """Return which bricks have one stud, shape (n,)."""
    small = np.array([part.length == part.width == 1 for part in catalogue.parts])
    return small[bricks.part]


def must_cells(grid: UnitGrid) -> int:
    """Count the cells that must be built, one brick high where bricks are laid and one plate high where plates are."""
    return sum(int(sheets.required.sum()) for sheets in split(grid))


def alone(grid: UnitGrid, catalogue: Catalogue) -> Mask:
    """Find the cells that no part but a 1 x 1 can cover: colours and heights forbid all others.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    (n_plates, n_y, n_x) bool array
        True at the lowest plate of such cells.
    """
    found = np.zeros((PLATES_PER_BRICK * len(grid.colour), *grid.colour.shape[2:]), dtype=bool)
    codes = np.unique(grid.colour[grid.colour >= 0])
    for sheets in split(grid):
        among = shapes(catalogue, sheets.height, codes, FILLER)
        for row in range(len(sheets)):
            found[sheets.level[row]] |= _alone(sheets.take(slice(row, row + 1)), among)
    return found


def _alone(sheet: Sheets, among: Shapes) -> Mask:
    every = placements(sheet, among)
    larger = every.take(np.flatnonzero(every.size > 1))
    left = sheet.required[0].copy()
    left.reshape(-1)[sheet.cells[larger.cells]] = False
    return left


def forced_singles(bricks: Bricks, grid: UnitGrid, catalogue: Catalogue) -> Mask:
    """Return which bricks are 1 x 1 because nothing else could lie there, shape (n,)."""
    x, y, z = bricks.corner.T
    return single(bricks, catalogue) & alone(grid, catalogue)[z, y, x]


def fewest_singles(bricks: Bricks, grid: UnitGrid, catalogue: Catalogue) -> int:
    """Return a number of 1 x 1 that no layout can do without: colours and heights force them.

    Parameters
    ----------
    bricks : Bricks
        A layout. Only near its 1 x 1 is it looked for others, so that wide
        areas without any cost nothing.
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    int
        The sum over all sheets of the least cost of covering these places, where
        a 1 x 1 costs one and all else nothing: a bound of the linear programme.
    """
    codes = np.unique(grid.colour[grid.colour >= 0])
    small = bricks.take(single(bricks, catalogue)).corner
    fewest = 0
    for sheets in split(grid):
        among = shapes(catalogue, sheets.height, codes, FILLER)
        for row in range(len(sheets)):
            here = small[small[:, 2] == sheets.level[row]]
            fewest += _fewest(sheets.take(slice(row, row + 1)), among, here[:, :2])
    return fewest


def _fewest(sheet: Sheets, among: Shapes, small: Ints) -> int:
    """Return the bound of one sheet, given the 1 x 1 on its level by x and y."""
    near = np.zeros(sheet.required[0].shape, dtype=bool)
    near[small[:, 1], small[:, 0]] = True
    near = maximum_filter(near, size=2 * NEAR + 1).reshape(-1)[sheet.cells]
    required = sheet.required.reshape(-1)[sheet.cells]
    found = placements(sheet, among)
    # places that need not be covered leave the bound a bound
    candidates = Candidates.of(found).within(near & required)
    if not len(candidates.rows):
        return 0
    cost = (found.size == 1)[candidates.rows].astype(np.float64)
    return int(np.ceil(cost @ shares(candidates, required & near, cost) - ROUNDING))


def articulations(bricks: Bricks, links: ContactGraph, left_out: Mask | None = None) -> int:
    """Count the bricks without which others would hold to the ground no more.

    Parameters
    ----------
    bricks : Bricks
        The layout.
    links : ContactGraph
        What holds to what.
    left_out : (n,) bool array, optional
        Bricks that do not count as others, nor by themselves.

    Returns
    -------
    int
    """
    level = bricks.corner[:, 2]
    graph = nx.Graph(links.pairs.tolist())
    graph.add_edges_from((GROUND, row) for row in np.flatnonzero(level == level.min()).tolist())
    if left_out is not None:
        graph.remove_nodes_from(np.flatnonzero(left_out).tolist())
    return len(set(nx.articulation_points(graph)) - {GROUND})


def coinciding_seams(links: ContactGraph, bridgeable: Mask | None = None) -> float:
    """Return the share of seams that another one lies upon, where a new level of bricks begins on both sides.

    Parameters
    ----------
    links : ContactGraph
        The bricks as cells.
    bridgeable : (2, n_z, n_y, n_x) bool array, optional
        As :func:`edges_to_bridge`: seams count as coinciding only where a part
        could lie across one of them.

    Returns
    -------
    float
        0 where no two bricks lie on each other beside two others.
    """
    below, above = links.owner[:-1], links.owner[1:]
    begins = (below != above) & (below != NOBODY) & (above != NOBODY)
    seams = coinciding = 0
    for axis in (1, 2):
        one, other = (_along(axis, side) for side in (slice(None, -1), slice(1, None)))
        seam = begins[one] & begins[other] & (below[one] != below[other])
        upon = seam & (above[one] != above[other])
        if bridgeable is not None:
            edges = bridgeable[axis - 1]
            upon &= (edges[:-1] | edges[1:])[one]
        seams += int(seam.sum())
        coinciding += int(upon.sum())
    return coinciding / max(seams, 1)


def edges_to_bridge(grid: UnitGrid, links: ContactGraph, catalogue: Catalogue) -> Mask:
    """Find the edges between cells across which some part could lie: its colour and height allow it.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    links : ContactGraph
        Its bricks as cells.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    (2, n_z, n_y, n_x) bool array
        For the plates of ``links.owner``: the edge beyond each cell along y, and along x.
    """
    can = np.zeros((2, PLATES_PER_BRICK * len(grid.colour), *grid.colour.shape[2:]), dtype=bool)
    codes = np.unique(grid.colour[grid.colour >= 0])
    for sheets in split(grid):
        among = shapes(catalogue, sheets.height, codes, FILLER)
        found = placements(sheets, among)
        along_x, along_y = among.inner[:, found.in_shapes(among)]
        for edges, inside in zip(can, (along_y, along_x), strict=True):
            across = np.zeros(sheets.colour.shape, dtype=bool)
            across.reshape(-1)[sheets.cells[found.cells[inside]]] = True
            for plate in range(sheets.height):
                edges[sheets.level + plate] |= across
    x, y, z = links.low
    n_z, n_y, n_x = links.owner.shape
    return can[:, z : z + n_z, y : y + n_y, x : x + n_x]


def _along(axis: int, part: slice) -> tuple[slice, ...]:
    return tuple(part if each == axis else slice(None) for each in range(3))


def colours_lost(grid: UnitGrid, bricks: Bricks, links: ContactGraph) -> tuple[int, int]:
    """Count the cells that are seen, and those of them in which no brick of their colour lies.

    Parameters
    ----------
    grid : UnitGrid
        The solid model before hollowing: what is seen of it has a colour.
    bricks : Bricks
        The layout.
    links : ContactGraph
        The same as cells.

    Returns
    -------
    seen, lost : int
    """
    colour = grid.colour.reshape(-1, *grid.colour.shape[2:])
    owner = owners(links, (len(colour) + 2, *colour.shape[1:]))[1:-1]
    built: NDArray[np.int16] = np.append(bricks.colour, np.int16(NOBODY))[owner]
    seen = colour >= 0
    return int(seen.sum()), int((seen & (built != colour)).sum())
