"""The weakest brick of a build, brought to light."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Vector

from ..core.errors import BuildError
from ..core.model import UNSUPPORTED, load_catalogue
from ..core.units import BRICK
from ..scene import MARGIN, check_whole, middles, point_objects, read_bricks, read_columns, world_from_mm
from .heat_map import has_margins, show_heat_map
from .visibility import show_layers


def show_weakest(scene: bpy.types.Scene, build: bpy.types.Collection) -> Vector:
    """Show the heat map of a build up to the layer of its weakest brick.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene whose view layers are changed.
    build : bpy.types.Collection
        The build.

    Returns
    -------
    mathutils.Vector
        Middle of the brick in the world.

    Raises
    ------
    BuildError
        The build is damaged, or does not know what its bricks have left.
    """
    check_whole(build)
    if not has_margins(build):
        raise BuildError(f"The stability of {build.name!r} was not checked: legorize the object again.")
    bricks, found = read_bricks(build), point_objects(build)
    margin = read_columns([points.data for points in found], [MARGIN])[MARGIN].astype(np.float64)
    # what hangs in the air is the panel's first line; of the others, the weakest one
    judged = np.where(margin == UNSUPPORTED, np.inf, margin)
    row = int(judged.argmin() if np.isfinite(judged).any() else margin.argmin())
    middle = middles(bricks.take(np.array([row])), load_catalogue())[0]
    show_heat_map(build, visible=True)
    show_layers(scene, build, int(middle[2] // BRICK) + 1)
    return world_from_mm(build) @ Vector(middle)
