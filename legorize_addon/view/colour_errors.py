"""The view of colour errors: each brick tinted by how far its colour is from what the surface asks for."""

from __future__ import annotations

from typing import Any, Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n
from mathutils import Vector
from numpy.typing import NDArray

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.model import load_catalogue
from ..core.units import BRICK
from ..scene import (
    COLOUR_ERROR,
    check_whole,
    colour_error_of,
    middles,
    point_objects,
    read_bricks,
    read_columns,
    world_from_mm,
)
from .tint import Tint, has_numbers, show_tint, tint_of
from .visibility import show_layers

NAME: Final = "colour error"

ERROR_LEGEND: Final = n(
    "Difference from the texture (CIEDE2000): blue none, yellow 11, red 22 or more. Grey: shows too little surface"
)
NOT_COMPARED: Final = n(
    "Colours are not compared with a texture: images and brick models have no mesh; legorize older models again."
)

NOT_JUDGED: Final = (150, 150, 150)
RAMP: Final = ((40, 95, 205), (246, 205, 30), (200, 16, 20))
"""From no difference, through half, to one that is clear at a glance, in sRGB bytes like the one above."""

TOP: Final = 22.0
"""CIEDE2000 from which a brick is red: where a border between two colours is clearly visible."""

STEPS: Final = 8
"""Colours of the ramp: a material each, and few enough to be told apart."""

BASE: Final = 100
"""Number of the first material; the heat map has those before."""


def error_colours() -> NDArray[np.uint8]:
    """Return the colours of the view in sRGB, shape (STEPS + 1, 3): not judged, from blue to red."""
    at, stops = np.linspace(0, 1, STEPS), np.linspace(0, 1, len(RAMP))
    ramp = np.stack([np.interp(at, stops, channel) for channel in np.transpose(RAMP)], axis=1)
    return np.vstack([NOT_JUDGED, np.rint(ramp)]).astype(np.uint8)


def row_of(error: Floats) -> NDArray[np.int32]:
    """Return the rows of :func:`error_colours` for errors of shape (n,), below 0 where there is none, shape (n,)."""
    # the last colour begins at the top, not one step before it
    step = 1 + np.minimum(np.floor(np.maximum(error, 0) / TOP * (STEPS - 1)), STEPS - 1)
    return np.where(error < 0, 0, step).astype(np.int32)


_TINT: Final = Tint(NAME, COLOUR_ERROR, "Colour Error", BASE, error_colours(), row_of)


def has_colour_errors(build: bpy.types.Collection) -> bool:
    """Return whether a build knows how far its colours are from the texture: one of a mesh, of this version."""
    return has_numbers(build, COLOUR_ERROR)


def colour_errors_shown(build: bpy.types.Collection) -> bool:
    """Tell whether a build shows its colour errors."""
    return tint_of(build) == NAME


def show_colour_errors(build: bpy.types.Collection, *, visible: bool) -> None:
    """Show the colour errors of a build or its own colours, in the viewport and in renders.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    visible : bool
        Whether to show them, in place of the heat map.

    Raises
    ------
    BuildError
        The build does not know them, or is damaged.
    """
    check_whole(build)
    if not has_colour_errors(build):
        raise BuildError(f"The colours of {build.name!r} are not compared with a texture: legorize a mesh again.")
    show_tint(build, _TINT, visible=visible)


def show_worst_colour(scene: bpy.types.Scene, build: bpy.types.Collection) -> Vector:
    """Show the colour errors of a build up to the layer of its worst brick.

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
        The build is damaged, or does not know its colour errors.
    """
    show_colour_errors(build, visible=True)
    error = read_columns([points.data for points in point_objects(build)], [COLOUR_ERROR])[COLOUR_ERROR]
    middle = middles(read_bricks(build).take(np.array([int(error.argmax())])), load_catalogue())[0]
    show_layers(scene, build, int(middle[2] // BRICK) + 1)
    return world_from_mm(build) @ Vector(middle)


def colour_error_lines(build: bpy.types.Collection) -> list[tuple[str, str]]:
    """Return the lines of the panel with the icon of each: the mean and the worst brick, or why there are none."""
    told: dict[str, Any] = colour_error_of(build)
    if not told or not has_colour_errors(build):
        return [(NOT_COMPARED, "INFO")]
    mean = iface("Colour error: {:.1f} on average").format(told["mean"])
    worst = iface("Worst: {} in layer {}, {:.1f}").format(told["name"], told["layer"], told["worst"])
    return [(mean, "COLOR"), (worst, "BLANK1")]
