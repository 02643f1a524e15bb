"""Numbers on the bricks that are seen: what is to be written, and where."""

from __future__ import annotations

from typing import Literal

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.model import load_catalogue
from ..core.units import PLATE
from ..scene import positions, world_from_mm
from .steps import steps_done, ways
from .visibility import bricks_in_renders

Numbers = Literal["steps", "parts"]


def brick_numbers(build: bpy.types.Collection, what: Numbers) -> tuple[Floats, list[str]]:
    """Return what is to be written on the bricks of a build that are seen, or on those of the step that is shown.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    what : {"steps", "parts"}
        The building step of each brick, counted from 1, or the LDraw number of its part.

    Returns
    -------
    places : (n, 3) float64 array
        Middles of the upper faces in world units.
    numbers : list of str
        One a place.

    Raises
    ------
    BuildError
        No brick is seen, or the build is damaged.
    """
    bricks, shown, found = bricks_in_renders(build)
    done = steps_done(build)
    if done:
        shown = shown & (bricks.step == done - 1)
    rows, catalogue = bricks.take(shown), load_catalogue()
    tops = positions(rows, catalogue) + np.outer(catalogue.height[rows.part], (0.0, 0.0, PLATE))
    tops = tops + ways(build, found, done)[shown]
    matrix = np.array(world_from_mm(build))
    places = tops @ matrix[:3, :3].T + matrix[:3, 3]
    if what == "parts":
        return places, [catalogue.parts[part].number for part in rows.part.tolist()]
    return places, [str(step + 1) for step in rows.step.tolist()]
