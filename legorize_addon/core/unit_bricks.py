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

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .bridges import bridging_cells
from .catalogue import Catalogue
from .cell_colours import likeliest_colours
from .colours import SurfaceColours
from .coverage import covered, cut_at_grid
from .eight_neighbours import longest_colours
from .exposure import air_around
from .grid import Grid
from .mesh import TriangleMesh
from .model import COLOUR_ANY, COLOUR_EMPTY, Cover, Floats, Mask, Role, UnitGrid
from .progress import Progress, silent
from .samples import horizontal_samples, surface_area, trajectory_samples
from .thin_features import thin_cells
from .trajectories import Trajectories
from .units import CELL_AREA, PLATES_PER_BRICK

_ROUNDING: Final = 1e-9
"""A cell that is half covered but for rounding counts as half covered."""


def unit_bricks(
    mesh: TriangleMesh,
    trajectories: Trajectories,
    surface: SurfaceColours,
    grid: Grid,
    *,
    layer: NDArray[np.int32],
    heights: Floats,
    keep_thin: bool,
    longest: bool,
    catalogue: Catalogue,
    closed: bool = True,
    progress: Progress = silent,
) -> UnitGrid:
    """Turn trajectories into unit bricks.

    Parameters
    ----------
    mesh : TriangleMesh
    trajectories : Trajectories
    surface : SurfaceColours
    grid : Grid
    layer : (n_slices,) int32 array
        Brick layer of every slice.
    heights : (n_slices,) float64 array
        Height of every slice in mm.
    keep_thin : bool
        Add cells where the surface would else be lost: legs, ears, thin walls.
    longest : bool
        Colour by the greatest trajectory length, as the paper does, instead of
        by likeness to all the surface of a cell.
    catalogue : Catalogue
    closed : bool, optional
        Whether the mesh is watertight. Into an open one the air is let in, by
        every opening of a stud or more that does not face the ground: a vehicle
        whose windows are open stays hollow.
    progress : Progress, optional
        Told between the steps.

    Returns
    -------
    UnitGrid
        All cells of the solid, the visible ones in their colour.
    """
    pieces = cut_at_grid(trajectories.points, trajectories.ends, grid.origin[:2])
    level = trajectories.loop_slice[trajectories.edge_loop].astype(np.int64)
    area = covered(pieces, level[pieces.edge], len(layer), grid.n_y, grid.n_x)
    solid = half_covered(np.clip(area, 0, CELL_AREA), layer, grid.n_layers)
    progress("unit bricks", 0.1)
    samples = trajectory_samples(mesh, trajectories, pieces, level, layer, heights, grid).joined(
        horizontal_samples(mesh, surface, grid)
    )
    progress("unit bricks", 0.3)
    if not closed:
        solid &= ~air_around(samples, grid.shape, on_ground=True).fills(grid.shape)
    progress("unit bricks", 0.4)
    if keep_thin:
        solid |= thin_cells(samples, solid)
        solid |= bridging_cells(solid, surface_area(samples, grid.shape))
    progress("unit bricks", 0.6)
    air = outer_air(solid)
    seen = visible(solid, air)
    colour = np.full(grid.shape, COLOUR_EMPTY, dtype=np.int16)
    colour[solid] = COLOUR_ANY
    if longest:
        colour[seen] = longest_colours(trajectories, pieces, samples, solid, seen)
    else:
        colour[seen] = likeliest_colours(samples, solid, air, seen, catalogue, surface)
    return _unit_grid(colour, grid.origin)


def half_covered(area: Floats, layer: NDArray[np.int32], n_layers: int) -> Mask:
    """Return the cells of which at least half lies inside, averaged over the slices of their layer.

    Parameters
    ----------
    area : (n_slices, n_y, n_x) float64 array
        Covered area of each cell in mm^2, 0 to 64.
    layer : (n_slices,) int32 array
        Layer of each slice, rising.
    n_layers : int

    Returns
    -------
    (n_layers, n_y, n_x) bool array

    References
    ----------
    Paper: a unit brick is valid from 32 mm^2.
    """
    total = np.zeros((n_layers, *area.shape[1:]))
    present, start = np.unique(layer, return_index=True)
    total[present] = np.add.reduceat(area, start, axis=0)
    slices = np.maximum(np.bincount(layer, minlength=n_layers), 1)
    half: Mask = total >= CELL_AREA * (0.5 - _ROUNDING) * slices[:, None, None]
    return half


def outer_air(solid: Mask) -> Mask:
    """Return the empty cells that are joined, face to face, to the space around the grid.

    Parameters
    ----------
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
    """
    label, _ = ndimage.label(~np.pad(solid, 1))
    air: Mask = (label == label[0, 0, 0])[1:-1, 1:-1, 1:-1]
    return air


def visible(solid: Mask, air: Mask) -> Mask:
    """Return the solid cells with a face to the air, or to the rim of the grid."""
    seen: Mask = solid & ndimage.binary_dilation(air, border_value=1)
    return seen


def _unit_grid(colour: NDArray[np.int16], origin: Floats) -> UnitGrid:
    """Return a grid whose three plates a brick are equal and whose solid cells all must be built."""
    plates = np.repeat(colour[:, None], PLATES_PER_BRICK, axis=1)
    cover = np.where(plates == COLOUR_EMPTY, Cover.EMPTY, Cover.MUST).astype(np.uint8)
    role = np.where(plates == COLOUR_ANY, Role.INSIDE, Role.SHELL).astype(np.uint8)
    return UnitGrid(plates, cover, role, origin)
