"""Which slices represent which level of the grid.

A level is a layer of bricks or of plates. A layer of bricks has one slice or
three, the middles of its plates. For bricks each counts for the one layer; for
plates each counts for its own, and a layer's only slice for all three.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..geometry import ranges
from ..units import BRICK
from .lattice import Grid


@dataclass(frozen=True, slots=True, eq=False)
class Levels:
    """Pairs of a slice and a level that it represents, both ascending.

    Attributes
    ----------
    slice : (n,) int64 array
    level : (n,) int64 array
    place : (n,) float64 array
        Height that the slice stands for there, in levels from the ground.
    thickness : (n,) float64 array
        How much of the level's height it stands for, in mm.
    """

    slice: Ints
    level: Ints
    place: Floats
    thickness: Floats

    def standing(self, slice_: Ints) -> tuple[Ints, Ints]:
        """Repeat items of slices for every level that their slice represents.

        Parameters
        ----------
        slice_ : (n,) int64 array
            Slice of each thing.

        Returns
        -------
        thing : (m,) int64 array
            Row of `slice_`: all of them for their lowest levels, in order, then for the next ones.
        pair : (m,) int64 array
            Row of the pair.
        """
        first, count = np.unique(self.slice, return_index=True, return_counts=True)[1:]
        things = [np.flatnonzero(count[slice_] > step) for step in range(count.max(initial=0))]
        pairs = [first[slice_[rows]] + step for step, rows in enumerate(things)]
        none = [np.zeros(0, dtype=np.int64)]
        return np.concatenate(things or none), np.concatenate(pairs or none)


def levels_of(heights: Floats, layer: NDArray[np.int32], plate: NDArray[np.int8], grid: Grid) -> Levels:
    """Find which slices represent which levels of a grid.

    Parameters
    ----------
    heights : (n_slices,) float64 array
        Height of every slice in mm.
    layer : (n_slices,) int32 array
        Brick layer of every slice.
    plate : (n_slices,) int8 array
        Plate of that layer whose middle the slice is.
    grid : Grid
        Of bricks or of plates.

    Returns
    -------
    Levels
    """
    levels_a_layer = round(BRICK / grid.height)
    number = np.arange(len(heights))
    if levels_a_layer == 1:
        thickness = (BRICK / np.bincount(layer, minlength=1)[layer]).astype(np.float64)
        place: Floats = (heights - grid.origin[2]) / BRICK
        return Levels(number, layer.astype(np.int64), place, thickness)
    alone = np.bincount(layer, minlength=1)[layer] == 1
    first = levels_a_layer * layer.astype(np.int64) + np.where(alone, 0, plate)
    slice_, level = ranges(first, np.where(alone, levels_a_layer, 1))
    return Levels(slice_, level, (level + 0.5).astype(np.float64), np.full(len(level), grid.height))
