"""The heat map: each brick in the colour of what it has left before it fails."""

from __future__ import annotations

from typing import Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n
from numpy.typing import NDArray

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.model import UNSUPPORTED
from ..scene import MARGIN, NO_MARGIN, check_whole
from .tint import FIRST, Tint, has_numbers, show_tint, tint_of

LEGEND: Final = n(
    "Friction left: green much, yellow half, red none, or held by its neighbours alone. Black: loaded beyond its "
    "friction. Magenta: hangs in the air. Grey: a support, not checked"
)

HANGING: Final = (214, 20, 190)
FAILING: Final = (25, 5, 8)
NOT_CHECKED: Final = (150, 150, 150)
RAMP: Final = ((200, 16, 20), (246, 205, 30), (50, 170, 75))
"""From nothing left, through half, to all of the friction, in sRGB bytes like the three above."""

STEPS: Final = 8
"""Colours of the ramp: a material each, and few enough to be told apart."""


def heat_colours() -> NDArray[np.uint8]:
    """Return the colours of the map in sRGB, shape (STEPS + 3, 3): hanging, failing, from red to green, not checked."""
    at = np.linspace(0, 1, STEPS)
    stops = np.linspace(0, 1, len(RAMP))
    ramp = np.stack([np.interp(at, stops, channel) for channel in np.transpose(RAMP)], axis=1)
    return np.vstack([HANGING, FAILING, np.rint(ramp), NOT_CHECKED]).astype(np.uint8)


def heat_of(margin: Floats) -> NDArray[np.int32]:
    """Return the rows of :func:`heat_colours` for margins of shape (n,), shape (n,)."""
    step = 2 + np.clip(np.floor(margin * STEPS), 0, STEPS - 1)
    step = np.where(margin == NO_MARGIN, 2 + STEPS, step)
    return np.where(margin == UNSUPPORTED, 0, np.where(margin < 0, 1, step)).astype(np.int32)


_TINT: Final = Tint(FIRST, MARGIN, "Heat", 0, heat_colours(), heat_of)


def has_margins(build: bpy.types.Collection) -> bool:
    """Return whether a build knows what its bricks have left; builds of earlier versions do not."""
    return has_numbers(build, MARGIN)


def heat_map_shown(build: bpy.types.Collection) -> bool:
    """Tell whether a build shows its heat map."""
    return tint_of(build) == FIRST


def show_heat_map(build: bpy.types.Collection, *, visible: bool) -> None:
    """Show the heat map of a build or its own colours, in the viewport and in renders.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    visible : bool
        Whether to show the map.

    Raises
    ------
    BuildError
        The build does not know what its bricks have left, or is damaged.
    """
    check_whole(build)
    if not has_margins(build):
        raise BuildError(f"The stability of {build.name!r} was not checked: legorize the object again.")
    show_tint(build, _TINT, visible=visible)
