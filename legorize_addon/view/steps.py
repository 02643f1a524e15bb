"""Pieces shown apart, and what is there after some building steps: inputs of the bricks' tree.

Only the objects whose bricks look otherwise are evaluated again; the others keep
an input that shows the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy
import numpy as np

from ..core.arrays import Floats, Mask
from ..core.errors import BuildError
from ..scene import (
    ASIDE,
    EXPLODE,
    JOINED,
    REMOVED,
    STEPS,
    TIER,
    bricks_modifier,
    check_whole,
    point_objects,
    read_column,
    read_columns,
    set_input,
    state_of,
    there_after,
    way_after,
)


def n_steps(build: bpy.types.Collection) -> int:
    """Return the building steps of a build; 0 where they are not known, as in those of earlier versions."""
    return int(state_of(build).building.get("steps", 0))


def n_pieces(build: bpy.types.Collection) -> int:
    """Return the pieces in which a build is put together, 1 where they are not known."""
    return int(state_of(build).building.get("pieces", 1))


def explode(build: bpy.types.Collection, share: float) -> None:
    """Lift the pieces of a build off each other, in the viewport and in renders.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    share : float
        How far each piece is lifted off the one below it, as a share of the
        model's height; at 0 they are joined.

    Raises
    ------
    BuildError
        The build does not know its pieces.
    """
    check_steps(build)
    state_of(build).exploded = share
    above = [points for points in point_objects(build) if read_column(points.data, TIER).any()]
    _set(above, EXPLODE, _lift(build))


def exploded(build: bpy.types.Collection) -> float:
    """Return how far apart the pieces of a build are shown, as :func:`explode` did it."""
    return state_of(build).exploded


def do_steps(build: bpy.types.Collection, steps: int) -> None:
    """Show what is there after some building steps, as far as its role is shown.

    Parameters
    ----------
    build : bpy.types.Collection
        The build, which knows its steps.
    steps : int
        Steps that are done; 0 shows all bricks.
    """
    before = steps_done(build)
    state_of(build).steps_done = steps
    objects = point_objects(build)
    if before and steps:
        low, high = sorted((before, steps))
        # what was new before is not any more
        objects = [points for points in objects if _changes(points, low - 1, high)]
    _set(objects, STEPS, steps)


def steps_done(build: bpy.types.Collection) -> int:
    """Return the steps after which a build is shown, 0 if it is shown whole."""
    return state_of(build).steps_done


def check_steps(build: bpy.types.Collection) -> None:
    """Refuse a build that does not know its steps.

    Raises
    ------
    BuildError
        It is of an earlier version, or damaged.
    """
    check_whole(build)
    if not n_steps(build):
        raise BuildError(
            f"{build.name!r} was built by an older version and has no building steps: legorize the object again."
        )


def bricks_there(build: bpy.types.Collection, found: Sequence[bpy.types.Object]) -> Mask:
    """Tell which bricks of some objects of a build are there after the steps shown, (n,) in their first order."""
    if not steps_done(build):
        return np.ones(sum(len(points.data.vertices) for points in found), dtype=bool)
    columns = read_columns([points.data for points in found], ["step", REMOVED])
    return there_after(steps_done(build), columns["step"], columns[REMOVED])


def ways(build: bpy.types.Collection, found: Sequence[bpy.types.Object], steps: int) -> Floats:
    """Return how far from their places bricks of some objects are after some steps, (n, 3) in mm, in first order."""
    if not n_steps(build):
        return np.zeros((sum(len(points.data.vertices) for points in found), 3))
    return way_after(steps, read_columns([points.data for points in found], [TIER, JOINED, ASIDE]), _lift(build))


def _changes(points: bpy.types.Object, low: int, high: int) -> bool:
    """Tell whether something is placed, taken out or joined in a row of steps."""
    # in whatever order
    columns = (read_column(points.data, name) for name in ("step", REMOVED, JOINED))
    return any(((low <= column) & (column < high)).any() for column in columns)


def _lift(build: bpy.types.Collection) -> float:
    """Return how far in mm each piece is lifted off the one below it."""
    low, high = state_of(build).extent
    return exploded(build) * (high[2] - low[2])


def _set(objects: Iterable[bpy.types.Object], name: str, value: float) -> None:
    for points in objects:
        set_input(bricks_modifier(points), name, value)
