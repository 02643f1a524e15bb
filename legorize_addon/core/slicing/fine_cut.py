"""How much of the small parts of some cells lies inside a mesh: quarters of a stud and halves of a plate."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..mesh import TriangleMesh
from ..units import CELL_AREA, PLATE
from .coverage import covered_area_shares, cut_at_grid
from .slices import slice_mesh
from .trajectories import linked

ACROSS: Final = 4
UP: Final = 2
"""Parts of a stud along x and along y, and of a plate: slopes of all angles differ on them."""

_SLAB: Final = 1 << 21
"""Small cells that are cut at once."""


def fine_shares(mesh: TriangleMesh, origin: Floats, cells: Mask) -> NDArray[np.float32]:
    """Return which share of each part of some cells lies inside a mesh.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    origin : (3,) float64 array
        Corner of the first cell in mm.
    cells : (n_z, n_y, n_x) bool array
        Cells of plates.

    Returns
    -------
    (n_cells, UP, ACROSS, ACROSS) float32 array
        0 to 1, by part along z, y and x; cells by ascending z, y and x.
    """
    n_z, n_y, n_x = cells.shape
    height = origin[2] + (np.arange(n_z * UP) + 0.5) * PLATE / UP
    outline = linked(mesh.faces, slice_mesh(mesh, height))
    start, ends, level = outline.start, outline.ends, outline.slice.astype(np.int64)
    slab = max(_SLAB // (UP * n_y * n_x * ACROSS**2), 1)
    shares = [np.zeros((0, UP, ACROSS, ACROSS), np.float32)]
    for low in range(0, n_z, slab):
        there = cells[low : low + slab]
        inside = (level >= low * UP) & (level < (low + len(there)) * UP)
        pieces = cut_at_grid(start[inside] * ACROSS, ends[inside] * ACROSS, origin[:2] * ACROSS)
        of_piece = level[inside][pieces.edge] - low * UP
        area = covered_area_shares(pieces, of_piece, len(there) * UP, n_y * ACROSS, n_x * ACROSS)
        parts = area.reshape(len(there), UP, n_y, ACROSS, n_x, ACROSS).transpose(0, 2, 4, 1, 3, 5)
        shares.append(np.clip(parts[there] / CELL_AREA, 0, 1).astype(np.float32))
    return np.concatenate(shares)
