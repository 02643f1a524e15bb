"""The plane beyond which bricks are hidden: an empty whose +z points to the hidden side.

All brick objects of a build read the plane through one node of their shared
tree, so a cut is moved by moving a single object, whatever the number of
bricks. Bricks are hidden whole, by the middles of their bodies.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

import bpy
import numpy as np
from mathutils import Euler, Vector

from ..core.arrays import Floats, Mask
from ..core.model import CELL_SIZE
from .root import PLANE

AXES: Final = ("x", "y", "z")

TURNS: Final = {"x": (0.0, math.pi / 2, 0.0), "y": (-math.pi / 2, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}
"""Rotations that bring +z to the axis."""

FLIPS: Final = {"x": (0.0, -math.pi / 2, 0.0), "y": (math.pi / 2, 0.0, 0.0), "z": (math.pi, 0.0, 0.0)}
"""Rotations that bring +z against the axis."""

NOWHERE: Final = 1e6
"""Height in mm above which there are no bricks."""

ROUNDING: Final = 1e-4
"""What a share of 32 bits may be off, in distances between neighbouring middles."""


@dataclass(frozen=True, slots=True)
class Section:
    """A cut through a build.

    Attributes
    ----------
    axis : {"none", "x", "y", "z"}
        Axis that the cut is upright to; "none" shows everything.
    at : float
        Share of the model's extent along the axis at which the cut lies, in
        [0, 1]. Bricks are hidden whose middle has a greater share; at 1 none
        are.
    flip : bool
        Hide the bricks whose middle has a smaller share instead.
    """

    axis: Literal["none", "x", "y", "z"] = "none"
    at: float = 0.5
    flip: bool = False


def add_plane(name: str) -> bpy.types.Object:
    """Return a new plane that hides nothing.

    Parameters
    ----------
    name : str
        Name of the build.

    Returns
    -------
    bpy.types.Object
        An empty, hidden itself, in no collection and without a parent yet.
    """
    plane = bpy.data.objects.new(f"{name} section", None)
    plane.empty_display_type = PLANE
    plane.hide_viewport = plane.hide_render = True
    place_plane(plane, Section(), ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    return plane


def place_plane(plane: bpy.types.Object, section: Section, extent: Sequence[Sequence[float]]) -> None:
    """Move a plane to where a section cuts.

    Parameters
    ----------
    plane : bpy.types.Object
        Made by :func:`add_plane`.
    section : Section
        The cut.
    extent : (2, 3) sequence of float
        Lowest and highest corner of the model in mm.
    """
    place = Vector((0.0, 0.0, NOWHERE))
    turn = TURNS["z"]
    if section.axis != "none":
        along = AXES.index(section.axis)
        low, high = (float(corner[along]) for corner in extent)
        place = Vector((0.0, 0.0, 0.0))
        place[along] = _between(low + section.at * (high - low), CELL_SIZE[along] / 2, flip=section.flip)
        turn = (FLIPS if section.flip else TURNS)[section.axis]
    # a dragged slider mostly stays between the same two middles: then nothing needs to be evaluated
    if plane.location != place or plane.rotation_euler != Euler(turn):
        plane.location, plane.rotation_euler = place, turn


def beyond(plane: bpy.types.Object, middle: Floats) -> Mask:
    """Tell which bricks a plane hides.

    Parameters
    ----------
    plane : bpy.types.Object
        Made by :func:`add_plane`; it may have been moved and turned by hand.
    middle : (n, 3) float64 array
        Middles of the bricks' bodies in mm.

    Returns
    -------
    (n,) bool array
    """
    inverse = np.array(plane.matrix_basis.inverted())
    hidden: Mask = middle @ inverse[2, :3] + inverse[2, 3] > 0
    return hidden


def hidden_side(plane: bpy.types.Object) -> Floats | None:
    """Return the unit vector (3,) to the side that a plane hides; None where it hides nothing."""
    if plane.location.z == NOWHERE:
        return None
    return np.array(plane.matrix_basis.to_3x3().normalized().col[2], dtype=np.float64)


def _between(at: float, step: float, *, flip: bool) -> float:
    """Return the place halfway between two middles of bricks where the same bricks are hidden as by a cut."""
    steps = at / step
    return (math.ceil(steps - ROUNDING) - 0.5 if flip else math.floor(steps + ROUNDING) + 0.5) * step
