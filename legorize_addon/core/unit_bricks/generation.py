"""Which cells of the grid are bricks, and in which colour.

A cell is a unit brick where at least half of it, 32 mm^2 of every 64, lies inside
the trajectories of its layer. Level surface, which no trajectory sees, is sampled by
vertical rays for the colours and for what is thin.

References
----------
Paper, sections "Unit bricks" (area criterion, inner cell) and "Colour of a unit
brick" (greatest length).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..colours import SurfaceColours
from ..geometry import outer_air, visible
from ..mesh import TriangleMesh, cell_factors
from ..model import COLOUR_ANY, COLOUR_EMPTY, Catalogue, Fill, Role, UnitGrid, ground_of
from ..progress import Progress, part, silent
from ..slicing import Grid, Levels, Pieces, Trajectories, covered_area_shares, cut_at_grid
from ..units import BRICK, CELL_AREA, PLATE, PLATES_PER_BRICK
from .bridges import bridging_cells, under_steps
from .colour_votes import Ballot, Codes, likeliest_colours
from .dithering import Dithering, dither, light_in_the_open
from .facing import Facing
from .longest_trajectory import Crossings, longest_colours
from .plates import Detail, settle_colours, settle_plates
from .specks import without_specks
from .surface_samples import SurfaceSamples, horizontal_samples, standing_pieces, surface_area, trajectory_samples
from .symmetry import mirror_colours, mirror_shapes
from .thin_features import thin_cells
from .visibility import air_around

_ROUNDING: Final = 1e-9
"""A cell that is half covered (32 mm^2 of 64) but for rounding counts as half covered."""


class Raster(NamedTuple):
    """The cells to fill.

    Attributes
    ----------
    grid : Grid
        Of bricks, or of plates where details shall be plates.
    levels : Levels
        What the slices stand for in the grid.
    """

    grid: Grid
    levels: Levels


@dataclass(frozen=True, slots=True, eq=False)
class Rules:
    """How cells are filled and coloured.

    Attributes
    ----------
    symmetric : bool
        Whether cells are made like their image in the middle of the grid where
        the mesh is.
    keep_thin : bool
        Add cells where the surface would otherwise be lost: legs, ears, thin
        walls.
    longest : bool
        Colour by the greatest trajectory length, as the paper does, instead of
        by likeness to all the surface of a cell.
    closed : bool
        Whether the mesh is watertight. Into an open one the air is let in, by
        every opening of a stud or more that does not face the ground: a vehicle
        whose windows are open stays hollow.
    detail : Detail or None
        Where a grid of plates keeps them.
    facing : Facing or None
        The way that a flat model is looked at, if from one side alone: what looks
        that way colours the bricks, unless by length.
    specks : bool
        Whether lone bricks whose colour is a mixture, or hardly differs from those around, keep it. They do in any case
        where colours go by length, and in pictures.
    dithering : Dithering or None
        How colours are mixed, after plates are decided; None leaves each cell its closest colour.
    """

    symmetric: bool = False
    keep_thin: bool = True
    longest: bool = False
    closed: bool = True
    detail: Detail | None = None
    facing: Facing | None = None
    specks: bool = False
    dithering: Dithering | None = None


def unit_bricks(
    mesh: TriangleMesh,
    trajectories: Trajectories,
    surface: SurfaceColours,
    raster: Raster,
    rules: Rules,
    *,
    catalogue: Catalogue,
    progress: Progress = silent,
) -> UnitGrid:
    """Turn trajectories into unit bricks.

    Parameters
    ----------
    mesh : TriangleMesh
    trajectories : Trajectories
    surface : SurfaceColours
    raster : Raster
    rules : Rules
    catalogue : Catalogue
    progress : Progress, optional
        Told between the steps.

    Returns
    -------
    UnitGrid
        All cells of the solid, the visible ones in their colour; without the
        layers below the lowest one in which there are any.
    """
    grid, levels = raster
    pieces = cut_at_grid(trajectories.points, trajectories.ends, grid.origin[:2])
    progress("unit bricks", 0.05)
    share = _shares(trajectories, pieces, levels, grid)
    progress("unit bricks", 0.1)
    standing = standing_pieces(trajectories, pieces, levels)
    samples = trajectory_samples(mesh, trajectories, pieces, standing, levels, grid).joined(
        horizontal_samples(mesh, surface, grid)
    )
    progress("unit bricks", 0.2)
    if not rules.closed:
        share[air_around(samples, grid.shape, on_ground=True).fills(grid.shape)] = 0
    factor = _factors(mesh, grid)
    solid = _solid(share, samples, factor, rules, progress=part(progress, 0.2, 0.6))
    if rules.symmetric:
        solid = mirror_shapes(solid, share, height=round(BRICK / grid.height), moved=grid.moved)
    progress("unit bricks", 0.6)
    air = outer_air(solid)
    progress("unit bricks", 0.65)
    seen = visible(solid, air)
    progress("unit bricks", 0.7)
    if rules.longest:
        crossings = Crossings(trajectories, pieces, standing[0])
        ballot = longest_colours(crossings, samples, solid, seen, catalogue, surface)
    else:
        shown = samples if rules.facing is None else rules.facing.weighed(samples)
        ballot = likeliest_colours(shown, air, seen, catalogue, surface)
    progress("unit bricks", 0.9)
    colour = np.full(grid.shape, COLOUR_EMPTY, dtype=np.int16)
    colour[solid] = COLOUR_ANY
    colour[seen] = ballot.winners(seen, grid.height)
    colour = _settled(colour, seen, ballot, rules, grid)
    if rules.dithering is not None:
        light = light_in_the_open(mesh, samples, grid)
        colour = dither(colour, seen, air, light, rules.dithering, catalogue)
    return _unit_grid(colour, grid)


def _settled(colour: Codes, seen: Mask, ballot: Ballot, rules: Rules, grid: Grid) -> Codes:
    """Let columns take other colours than their own best: for fewer parts, like their image, or as they are specks."""
    height = round(BRICK / grid.height)
    if rules.detail is not None:
        colour = settle_colours(colour, seen, ballot, rules.detail)
    # of a picture, little differences are what it shows
    if rules.symmetric and rules.facing is None:
        colour = mirror_colours(colour, seen, ballot, height=height, moved=grid.moved)
    if rules.specks or rules.longest or rules.facing is not None:
        return colour
    return without_specks(colour, seen, ballot, height=height)


def _factors(mesh: TriangleMesh, grid: Grid) -> Floats:
    """Return how many times as much as usual the shape of each cell counts: only plates are weighed."""
    if grid.height != PLATE:
        return np.broadcast_to(1.0, grid.shape)
    return cell_factors(mesh, grid.origin, grid.shape)


def _solid(share: Floats, samples: SurfaceSamples, factor: Floats, rules: Rules, progress: Progress) -> Mask:
    """Return the cells that are filled: half covered, or because the surface would otherwise be lost."""
    solid = half_covered(share)
    progress("unit bricks", 0.1)
    if rules.keep_thin:
        solid |= thin_cells(samples, solid)
        progress("unit bricks", 0.4)
        solid |= under_steps(solid)
    progress("unit bricks", 0.5)
    if rules.detail is not None:
        solid = settle_plates(solid, share, rules.detail, factor)
    progress("unit bricks", 0.7)
    if rules.keep_thin:
        solid |= bridging_cells(solid, surface_area(samples, share.shape))
    return solid


def _shares(trajectories: Trajectories, pieces: Pieces, levels: Levels, grid: Grid) -> Floats:
    """Return the share of every cell that lies inside, averaged over the slices of its level, 0 to 1."""
    n_slices = int(levels.slice.max(initial=-1)) + 1
    slice_of_edge = trajectories.loop_slice[trajectories.edge_loop].astype(np.int64)
    area = np.clip(covered_area_shares(pieces, slice_of_edge[pieces.edge], n_slices, grid.n_y, grid.n_x), 0, CELL_AREA)
    return mean_areas(area, levels, grid.n_layers) / CELL_AREA


def half_covered(share: Floats) -> Mask:
    """Return the cells that are valid unit bricks, given the share of each that lies inside.

    References
    ----------
    Paper: a unit brick is valid from 32 mm^2 of its 64.
    """
    half: Mask = share >= 0.5 - _ROUNDING
    return half


def mean_areas(area: Floats, levels: Levels, n_levels: int) -> Floats:
    """Return the mean of areas over the slices of every level.

    Parameters
    ----------
    area : (n_slices, n_y, n_x) float64 array
        Covered area of each cell in mm^2, 0 to 64.
    levels : Levels
    n_levels : int

    Returns
    -------
    (n_levels, n_y, n_x) float64 array
        Zero where a level has no slice.
    """
    mean = np.zeros((n_levels, *area.shape[1:]))
    present, start, count = np.unique(levels.level, return_index=True, return_counts=True)
    mean[present] = np.add.reduceat(area[levels.slice], start, axis=0) / count[:, None, None]
    return mean


def _unit_grid(colour: NDArray[np.int16], grid: Grid) -> UnitGrid:
    """Return a grid whose solid cells all must be built, given the colours of bricks or of plates.

    Parts too thin for cells may reach below all others; the ground is where the model stands.
    """
    times = round(grid.height / PLATE)
    planes = np.repeat(colour, times, axis=0)
    empty = ground_of(planes != COLOUR_EMPTY) // PLATES_PER_BRICK
    plates = planes.reshape(-1, PLATES_PER_BRICK, *colour.shape[1:])[empty:]
    cover = np.where(plates == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    role = np.where(plates == COLOUR_ANY, Role.INSIDE, Role.SHELL).astype(np.uint8)
    return UnitGrid(plates, cover, role, grid.origin + np.array([0.0, 0.0, empty * BRICK]))
