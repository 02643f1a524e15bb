"""What was done by hand to the bricks of a build since it was shown: bricks deleted, bricks moved."""

from __future__ import annotations

from typing import Final

import bpy
import numpy as np

from ..core.units import PLATE
from .brick_points import BUILT_AT, ROW, read_column, read_positions
from .builds import point_objects
from .kept_steps import n_stored
from .state import state_of

CLOSE: Final = PLATE / 10
"""mm by which a brick may lie off its place: nobody sees it, and it is no other place of the grid."""


def changed_by_hand(build: bpy.types.Collection) -> tuple[int, int]:
    """Count the bricks that were deleted or moved since a build was shown.

    Parameters
    ----------
    build : bpy.types.Collection

    Returns
    -------
    deleted, moved : int
        0 where an earlier version has not kept what is needed to know.
    """
    points = point_objects(build)
    rows = [read_column(each.data, ROW) for each in points]
    n_left = len(np.unique(np.concatenate(rows))) if rows else 0
    return max(n_stored(state_of(build).steps) - n_left, 0), sum(map(_moved, points))


def _moved(points: bpy.types.Object) -> int:
    """Count the moved ones among the bricks of an object; all of them if it was moved itself."""
    if not np.allclose(points.matrix_basis, np.eye(4), atol=1e-6):
        return len(points.data.vertices)
    if BUILT_AT not in points.data.attributes:
        return 0
    way = np.abs(read_positions([points.data]) - read_column(points.data, BUILT_AT)).max(axis=1, initial=0.0)
    return int(np.count_nonzero(way > CLOSE))


def hand_remark(build: bpy.types.Collection) -> str:
    """Return a sentence on what was changed by hand and what to do about it, empty if nothing was."""
    deleted, moved = changed_by_hand(build)
    what = [
        f"{count} brick{'s were' if count > 1 else ' was'} {how}"
        for count, how in ((deleted, "deleted"), (moved, "moved"))
        if count
    ]
    if not what:
        return ""
    return (
        f"{' and '.join(what)} by hand since {build.name!r} was built, so steps, lists and proof may be "
        "wrong: undo that, or legorize the object again."
    )
