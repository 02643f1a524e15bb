"""Bricks under the mouse, and the edges of those that are picked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import bpy
import numpy as np
from mathutils import Vector

from ..core.arrays import Floats
from ..core.model import CELL_SIZE, load_catalogue
from ..scene import box_corners, builds, damage, positions, read_bricks, world_from_mm

EDGES: Final = ((0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7))
"""Of a box, by the order of its corners in :func:`~legorize_addon.scene.box_corners`."""

_NEAR: Final = 0.1
"""Share of a cell within which an instance stands where its brick is."""


def brick_under(
    context: bpy.types.Context, origin: Vector, direction: Vector
) -> tuple[bpy.types.Collection, int] | None:
    """Return the first brick that a ray meets among all that is shown.

    Parameters
    ----------
    context : bpy.types.Context
    origin, direction : mathutils.Vector
        The ray in the world.

    Returns
    -------
    tuple of bpy.types.Collection and int, or None
        The build and the row of its brick; None where nothing is met, or
        something else. Bricks that are shown apart from their place, as pieces
        while they are pulled apart, are not found.
    """
    depsgraph = context.evaluated_depsgraph_get()
    hit, _, _, _, _, matrix = context.scene.ray_cast(depsgraph, origin, direction)
    if not hit:
        return None
    for build in builds(context.scene):
        if damage(build) is None and (row := _row_at(build, matrix.translation)) is not None:
            return build, row
    return None


def _row_at(build: bpy.types.Collection, place: Vector) -> int | None:
    """Return the brick whose instance stands at a place in the world; None if there is none."""
    at = np.array(world_from_mm(build).inverted() @ place)
    away = np.abs(positions(read_bricks(build), load_catalogue()) - at) / CELL_SIZE
    row = int(away.max(axis=1).argmin())
    return row if away[row].max() < _NEAR else None


def edges_of(build: bpy.types.Collection, rows: Sequence[int]) -> Floats:
    """Return the ends of the edges of some bricks in the world, (24 n, 3), two by two."""
    bricks = read_bricks(build)
    there = np.array([row for row in rows if row < len(bricks)], dtype=np.intp)
    corners = box_corners(bricks.take(there), load_catalogue()).reshape(-1, 8, 3)
    ends = corners[:, np.array(EDGES).reshape(-1)].reshape(-1, 3)
    matrix = np.array(world_from_mm(build))
    placed: Floats = ends @ matrix[:3, :3].T + matrix[:3, 3]
    return placed
