"""Numbers on bricks, drawn over the 3D viewports: nothing of them is in the scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import blf
import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from ..core.arrays import Floats
from ..core.errors import LegorizeError
from ..scene import damage
from ..view import brick_numbers
from .current import current_build

AT_MOST: Final = 300
"""Numbers in a viewport, of the nearest bricks: more of them cover each other, and drawing them takes too long."""

FONT: Final = 0
SIZE: Final = 12.0
"""Height of the digits in pixels, on a screen of usual resolution."""


@dataclass(slots=True)
class _Drawing:
    """What Blender gave for the function that draws.

    Attributes
    ----------
    handle : object, optional
        None while nothing is drawn.
    """

    handle: Any = None


_drawing = _Drawing()


def nearest(places: Floats, eye: Floats, at_most: int) -> list[int]:
    """Return the rows of the places that are nearest to the eye, nearest last, so that they are drawn over others."""
    away = np.linalg.norm(places - eye, axis=1)
    return np.argsort(away, kind="stable")[:at_most][::-1].tolist()


def _draw() -> None:
    """Draw the numbers into the region that is being drawn."""
    context = bpy.context
    what, build = context.scene.legorize.numbers, current_build(context.scene)
    if what == "none" or build is None or damage(build):
        return
    try:
        places, numbers = brick_numbers(build, what)
    except LegorizeError:
        # a section that hides all bricks has none to write on
        return
    eye = np.array(context.region_data.view_matrix.inverted().translation)
    blf.size(FONT, SIZE * context.preferences.system.ui_scale)
    blf.enable(FONT, blf.SHADOW)
    blf.shadow(FONT, 5, 0.0, 0.0, 0.0, 1.0)
    blf.color(FONT, 1.0, 1.0, 1.0, 1.0)
    for row in nearest(places, eye, AT_MOST):
        where = location_3d_to_region_2d(context.region, context.region_data, Vector(places[row]))
        if where is not None:
            width, height = blf.dimensions(FONT, numbers[row])
            blf.position(FONT, where.x - width / 2, where.y - height / 2, 0.0)
            blf.draw(FONT, numbers[row])
    blf.disable(FONT, blf.SHADOW)


def register() -> None:
    """Let every 3D viewport draw them."""
    _drawing.handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.types.SpaceView3D.draw_handler_remove(_drawing.handle, "WINDOW")
    _drawing.handle = None
