"""A still picture of the builds of a scene, by Cycles on the processor.

The picture is taken in a studio that is removed afterwards, see :mod:`.studio`.
"""

from __future__ import annotations

import math
from contextlib import nullcontext
from pathlib import Path
from typing import Final, Literal

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.units import PLATE
from ..scene import hidden_side, state_of
from ..view import corners_while_building, shown_corners
from .outlines import outlined
from .studio import add_camera, add_ground, add_light, model_corners, set_up_render, studio_of

View = Literal["front_left", "front_right", "back_left", "back_right", "below", "section"]

AZIMUTH: Final[dict[View, float]] = {
    "front_left": -35.0,
    "front_right": 35.0,
    "back_left": -145.0,
    "back_right": 145.0,
    "below": 35.0,
}
"""Direction in which the camera stands, in degrees from -y counter-clockwise as seen from above."""

ELEVATION: Final = 24.0
BESIDE: Final = 28.0
"""How far beside the middle of an upright cut the camera stands, in degrees."""

ABOVE: Final = 55.0
"""Elevation from which a level cut is seen, and undersides from as far below, in degrees."""

LINE_PIXELS: Final = 2.75
LINE_PLATES: Final = 0.35
"""Reach of outlines from the edge, where they fade: in pixels, and in heights of a plate at most."""


def render_still(
    scene: bpy.types.Scene,
    path: Path,
    *,
    samples: int = 24,
    resolution: tuple[int, int] = (960, 720),
    view: View = "front_right",
    outlines: bool = False,
    whole_building: bool = False,
) -> None:
    """Write a picture of a scene's builds, from a little above, on a pale ground.

    Parameters
    ----------
    scene : bpy.types.Scene
        Its builds are shown as they are, with hidden layers left out.
    path : pathlib.Path
        PNG file to write, in a folder that exists.
    samples : int, optional
        Light paths a pixel.
    resolution : tuple of two int, optional
        Width and height in pixels.
    view : str, optional
        Corner from which the model is seen; "below" looks up at it, with no
        ground; "section" looks onto the cut through the first build that is
        cut open, else as "front_right".
    outlines : bool, optional
        Whether dark lines tell the bricks apart.
    whole_building : bool, optional
        Whether the camera takes in all places where bricks are in any building
        step, so that pictures of several steps match.

    Raises
    ------
    BuildError
        Nothing is to be seen, Cycles is switched off, or the file cannot be written there.
    """
    from ..core.files import replacing

    with replacing(path, "picture") as partial, studio_of(scene) as studio:
        corners = model_corners(studio, corners_while_building if whole_building else shown_corners)
        azimuth, elevation = _place(studio, view)
        set_up_render(studio, samples, resolution)
        add_light(studio, azimuth, elevation)
        if elevation > 0:
            add_ground(studio, corners)
        add_camera(studio, corners, azimuth, elevation)
        lines = outlined(_materials(studio), _line_width(studio, corners)) if outlines else nullcontext()
        with lines:
            bpy.ops.render.render("EXEC_DEFAULT", scene=studio.name)
        _save_render(studio, partial)


def _place(studio: bpy.types.Scene, view: View) -> tuple[float, float]:
    """Return the azimuth and elevation of the camera in degrees."""
    if view != "section":
        return AZIMUTH[view], -ABOVE if view == "below" else ELEVATION
    sides = [hidden_side(state_of(build).plane) for build in studio.collection.children]
    side = next((side for side in sides if side is not None), None)
    if side is None:
        return AZIMUTH["front_right"], ELEVATION
    x, y, z = side
    if math.hypot(x, y) < abs(z):
        # what is open from below only cannot be looked into, for the ground
        return AZIMUTH["front_right"], ABOVE if z > 0 else ELEVATION
    straight = math.degrees(math.atan2(x, -y))
    return min(straight - BESIDE, straight + BESIDE, key=abs), ELEVATION


def _save_render(studio: bpy.types.Scene, path: Path) -> None:
    """Write what was rendered; the path of a scene's output will not do, as words in braces are templates in it."""
    result = next(image for image in bpy.data.images if image.type == "RENDER_RESULT")
    try:
        result.save_render(str(path), scene=studio)
    except RuntimeError as error:
        raise BuildError(f"The picture cannot be written ({str(error).strip()}): choose another place.") from error


def _materials(studio: bpy.types.Scene) -> list[bpy.types.Material]:
    """Return the materials of all bricks, and of their heat maps."""
    variants = [variant for build in studio.collection.children for variant in state_of(build).parts.all_objects]
    found = {slot.material.name: slot.material for variant in variants for slot in variant.material_slots}
    return [found[name] for name in sorted(found)]


def _line_width(studio: bpy.types.Scene, corners: Floats) -> float:
    """Return the width of outlines in world units: some pixels, less where bricks are small in the picture."""
    camera, render = studio.camera, studio.render
    away = float(np.linalg.norm(corners.mean(axis=0) - np.array(camera.location)))
    pixel = away * camera.data.sensor_width / camera.data.lens / max(render.resolution_x, render.resolution_y)
    plates = [float(state_of(build).root.matrix_world.median_scale) for build in studio.collection.children]
    return min(LINE_PIXELS * pixel, LINE_PLATES * PLATE * min(plates))
