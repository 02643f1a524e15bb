"""Trajectories as lines in space, for a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..build import Draft
from ..model import Catalogue
from .colour_runs import colour_runs
from .sheet import Rgb
from .trajectory_maps import EXTERIOR, INTERIOR, Shown, colour_name, colour_rgb

Paint = tuple[str, Rgb]
"""A name and sRGB bytes."""


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Coloured lines in the layers of a model.

    Attributes
    ----------
    points : (n, 3) float64 array
        In mm from the corner of the grid, line after line.
    count : (n_lines,) int64 array
        Points of each line.
    layer : (n_lines,) int64 array
        Layer of each line, from 0.
    paint : (n_lines,) int64 array
        Row of its paint.
    paints : tuple of (str, (int, int, int))
        Name and sRGB bytes.
    closed : bool
        Whether each line ends where it begins.
    """

    points: Floats
    count: Ints
    layer: Ints
    paint: Ints
    paints: tuple[Paint, ...]
    closed: bool


def trajectory_lines(draft: Draft, catalogue: Catalogue, *, shown: Shown) -> Lines:
    """Return the trajectories of a model.

    Parameters
    ----------
    draft : Draft
    catalogue : Catalogue
    shown : {"sides", "colours"}
        Closed loops, blue outside and green inside, or open lines in their
        brick colours.

    Returns
    -------
    Lines
    """
    trajectories = draft.trajectories
    paints: tuple[Paint, ...]
    if shown == "sides":
        paint, paints = (trajectories.areas() <= 0).astype(np.int64), (("exterior", EXTERIOR), ("interior", INTERIOR))
        flat, count, loop = trajectories.points, np.diff(trajectories.loop_start), np.arange(len(paint))
    else:
        runs = colour_runs(trajectories)
        codes, paint = np.unique(runs.colour, return_inverse=True)
        paints = tuple((colour_name(code, catalogue), colour_rgb(code, catalogue)) for code in codes.tolist())
        flat, count, loop = runs.points, runs.count, runs.loop
    slices = trajectories.loop_slice[loop]
    heights = np.repeat(draft.cut.slices.heights[slices], count)
    points = np.column_stack([flat, heights]) - draft.grid.origin
    return Lines(points, count, draft.cut.layer[slices].astype(np.int64), paint, paints, shown == "sides")
