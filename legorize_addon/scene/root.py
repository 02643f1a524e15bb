"""The root of a build: its frame on the ground, as large as the bricks for whoever looks at it, and never rendered.

It is a mesh without faces, since *View Selected* frames what an object's own
data spans, not what hangs on it, and the size of an empty is the same along
all axes. Earlier versions had an empty.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final
from uuid import uuid4

import bpy
import numpy as np

from ..core.units import STUD

MODEL_KEY: Final = "legorize_model"
"""Key, on roots, of a word that no other model has: a root that was pasted tells by it what it is a copy of."""

POINTS_KEY: Final = "legorize_points"
"""Key, on meshes, of the points of a build, and of the frame that is its root: those without users are removed."""

Outline = Mapping[str, Sequence[float]]
"""Lowest and highest corner of bricks, ``low`` and ``high``, in mm."""

RIM: Final = STUD / 2
"""Between bricks and frame in mm, chosen: on the edges of the lowest bricks it could be neither seen nor hit."""

PLANE: Final = "SINGLE_ARROW"
"""How the empty of a section is drawn, by which it is told from the root of an earlier version."""


def new_root(name: str, outline: Outline) -> bpy.types.Object:
    """Return a new root, in no collection yet.

    Parameters
    ----------
    name : str
        Of the build.
    outline : Outline
        Of the bricks that stay.

    Returns
    -------
    bpy.types.Object
        Its coordinates are in mm from below the middle of the bricks.
    """
    wide, deep, high = (np.subtract(outline["high"], outline["low"]) / (2.0, 2.0, 1.0)).tolist()
    wide, deep = wide + RIM, deep + RIM
    mesh = bpy.data.meshes.new(name)
    corners = [(-wide, -deep, 0.0), (wide, -deep, 0.0), (wide, deep, 0.0), (-wide, deep, 0.0)]
    # the last point belongs to no edge and is drawn by nobody: with it the object is as high as the bricks
    mesh.from_pydata([*corners, (0.0, 0.0, high)], [(0, 1), (1, 2), (2, 3), (3, 0)], [])
    mesh[POINTS_KEY] = True
    root = bpy.data.objects.new(name, mesh)
    root[MODEL_KEY] = uuid4().hex
    return root


def is_root(thing: bpy.types.Object) -> bool:
    """Tell whether an object of a build is its root, or a copy of one, by what it is alone."""
    # planes are hidden; one may be without a parent because that was deleted
    return MODEL_KEY in thing or (thing.type == "EMPTY" and thing.empty_display_type != PLANE)
