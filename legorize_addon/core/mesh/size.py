"""The size of the model, and whether it can be built."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats
from ..errors import SettingsError
from ..model import UnitGrid
from ..units import BRICK, MM_PER_CM, STUD
from .triangle_mesh import TriangleMesh

_ORIGINAL_SCALE: Final = 10.0
"""Scale factor k at which an object keeps its size (paper, section 3)."""


def model_scale(mesh: TriangleMesh, *, size_by: str, width: int, height: int, scale: float, cm: float) -> float:
    """Return the factor from the size of the mesh to that of the model.

    Parameters
    ----------
    mesh : TriangleMesh
        In world mm.
    size_by : {"width", "height", "scale", "cm"}
        Which of the following numbers sets the size.
    width : int
        Studs along the longer horizontal side.
    height : int
        Bricks.
    scale : float
        Scale factor k of the paper.
    cm : float
        Longest side.

    Returns
    -------
    float
        Model mm per world mm.

    Raises
    ------
    SettingsError
        The mesh has no extent along the side that should get the given size.

    References
    ----------
    Paper, section 3: a factor k of 10 keeps the size.
    """
    extent = np.ptp(mesh.vertices, axis=0)
    return scale_of_extent(extent, size_by=size_by, width=width, height=height, scale=scale, cm=cm)


def scale_of_extent(extent: Floats, *, size_by: str, width: int, height: int, scale: float, cm: float) -> float:
    """Return :func:`model_scale` of a mesh whose extent along x, y and z in mm is known."""
    if size_by == "scale":
        return scale / _ORIGINAL_SCALE
    if size_by == "cm":
        wanted, along, word = cm * MM_PER_CM, extent.max(), "size"
    elif size_by == "width":
        wanted, along, word = width * STUD, extent[:2].max(), "width"
    else:
        wanted, along, word = height * BRICK, extent[2], "height"
    if along <= 1e-9 * extent.max():
        raise SettingsError(f"The mesh has a {word} of {along:g} mm: set the size by something else than {word}.")
    return float(wanted / along)


def scale_mesh(mesh: TriangleMesh, factor: float) -> TriangleMesh:
    """Return the mesh scaled about the origin by a positive factor."""
    features = mesh.features and mesh.features.scaled(factor)
    return replace(mesh, vertices=mesh.vertices * factor, features=features)


def check_any(grid: UnitGrid, mesh: TriangleMesh, *, keep_thin: bool) -> None:
    """Refuse a model without bricks.

    Parameters
    ----------
    grid : UnitGrid
    mesh : TriangleMesh
        In its final size.
    keep_thin : bool
        Whether cells were added where the mesh is thin.

    Raises
    ------
    SettingsError
        The grid has no solid cell.
    """
    if grid.solid.any():
        return
    size = np.ptp(mesh.vertices, axis=0)
    model = f"The model would be {' x '.join(f'{round(float(along), 1):,g}' for along in size)} mm"
    small = (size < (STUD, STUD, BRICK)).all()
    if not (small or keep_thin):
        raise SettingsError(
            f"{model}, but it never fills half of a cell of {STUD:g} x {STUD:g} mm: turn keep_thin on, or choose a "
            "larger size."
        )
    raise SettingsError(
        f"{model}, too {'small' if small else 'thin'} for one brick of {STUD:g} x {STUD:g} x {BRICK:g} mm: choose a "
        "larger size."
    )
