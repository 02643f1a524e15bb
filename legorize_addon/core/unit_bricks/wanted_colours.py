"""What colour the surface asks for at every cell that shows it, whatever colours bricks may have.

The votes of :mod:`.colour_votes` know the brick colours of the texels alone. Here the texels themselves are kept, so
that a model can be compared with its texture after anything that gives cells other colours than the ones that they
voted for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..geometry import outer_air, visible
from ..mesh import TriangleMesh
from ..slicing import Grid
from ..units import PLATE, PLATES_PER_BRICK
from .facing import Facing
from .occlusion import occluded
from .surface_samples import light_samples
from .visibility import nearest_faces, reached_by_air


@dataclass(frozen=True, slots=True, eq=False)
class WantedColours:
    """The light of the surface on cells; cells without surface are left out.

    They take 22 bytes a cell.

    Attributes
    ----------
    cell : (n, 3) int16 array
        Level, y and x of each cell, rising.
    plates : int
        Height of a level in plates: 1, or 3 where cells are bricks.
    light : (n, 3) float32 array
        Mean of the texels on each cell: linear red, green and blue from 0 to 1.
    area : (n,) float32 array
        Surface on each cell in mm^2, above 0.
    """

    cell: NDArray[np.int16]
    plates: int
    light: NDArray[np.float32]
    area: NDArray[np.float32]

    def __len__(self) -> int:
        """Return the number of cells."""
        return len(self.area)


def wanted_colours(
    mesh: TriangleMesh, solid: Mask, origin: Floats, *, plates: bool, facing: Facing | None = None
) -> WantedColours:
    """Find the light of the surface on each cell.

    Rays along all three axes meet the surface; where the air around the model reaches it, it counts for the cell with
    the nearest outer face.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm of the model.
    solid : (n_layers, 3, n_y, n_x) bool array
        All cells of the solid model, before hollowing.
    origin : (3,) float64 array
        Corner of the first of them in mm.
    plates : bool
        Whether its cells are plates, not bricks.
    facing : Facing, optional
        The way that a flat model is looked at, if from one side alone: only what looks that way counts.

    Returns
    -------
    WantedColours
    """
    levels = 1 if plates else PLATES_PER_BRICK
    solid = solid.reshape(-1, *solid.shape[2:])[::levels]
    n_layers, n_y, n_x = solid.shape
    grid = Grid(origin, n_layers, n_y, n_x, levels * PLATE)
    light = light_samples(mesh, grid)
    light = light.at(reached_by_air(light, grid.shape) & ~occluded(light))
    if facing is not None:
        light = facing.weighed(light)
    air = outer_air(solid)
    cell = nearest_faces(light.place, light.sides, visible(solid, air), air)
    valid = (cell >= 0) & (light.area > 0)
    there, row = np.unique(cell[valid], return_inverse=True)
    weight = light.area[valid]
    area = np.bincount(row, weight, len(there))
    total = [np.bincount(row, weight * channel, len(there)) for channel in light.colour[valid].T]
    return WantedColours(
        cell=np.stack(np.unravel_index(there, solid.shape), axis=1).astype(np.int16).reshape(-1, 3),
        plates=levels,
        light=(np.stack(total, axis=1) / area[:, None]).astype(np.float32),
        area=area.astype(np.float32),
    )
