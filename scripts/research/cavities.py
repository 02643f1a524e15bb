"""Whether what trajectories run around on the inside, cavities and tunnels, stays empty in the unit bricks."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_fill_holes, label

from legorize_addon.core.build import Draft
from legorize_addon.core.slicing.coverage import covered_area_shares, cut_at_grid
from legorize_addon.core.slicing.lattice import Grid
from legorize_addon.core.slicing.levels import levels_of
from legorize_addon.core.units import BRICK, CELL_AREA, PLATE
from scripts.benchmarks.tables import Row

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

FINER: Final = 4
"""Squares along a stud in which trajectories are filled: walls of a quarter of a stud still enclose something."""


def cavities(draft: Draft) -> Row:
    """Compare the cavities in the trajectories with those in the solid model of the cells, plate by plate.

    Parameters
    ----------
    draft : Draft

    Returns
    -------
    dict
        ``cells``: how many cells are in a cavity of the trajectories: half of them is within an outline, but less than
        half is material; ``iou``: how many of them are empty, of these cells and of all that are empty and joined to
        them within the outlines; None where there are no cavities.
    """
    solid = draft.grid.solid.reshape(-1, *draft.grid.solid.shape[2:])
    within, cavity = masks_of_trajectories(draft, solid.shape)
    number, _ = label(within & ~solid)
    # what is empty at the outer surface is no cavity
    made = (number > 0) & np.isin(number, number[cavity])
    kept, either = int((cavity & made).sum()), int((cavity | made).sum())
    return {"cells": int(cavity.sum()), "iou": kept / either if either else None}


def masks_of_trajectories(draft: Draft, shape: tuple[int, int, int]) -> tuple[Mask, Mask]:
    """Return the cells, a plate high, of which half is within an outline, and those that are no valid bricks."""
    heights = draft.cut.slices.heights
    material = covered_shares(draft, *shape[1:], finer=FINER) >= 0.5
    filled = np.array([binary_fill_holes(each) for each in material]).reshape(material.shape)
    hole = (filled & ~material).reshape(len(heights), shape[1], FINER, shape[2], FINER).mean(axis=(2, 4))
    # by exact areas, as the squares round the outer edge
    share = covered_shares(draft, *shape[1:], finer=1)
    outlined, valid = share + hole >= 0.5, share >= 0.5
    layer = np.floor((heights - draft.grid.origin[2]) / BRICK).astype(np.int32)
    levels = levels_of(heights, layer, draft.cut.plate, Grid(draft.grid.origin, *shape, height=PLATE))
    # what sticks out below the ground has no cells
    there = levels.level >= 0
    masks = []
    for slices in (outlined, valid):
        mask = np.zeros(shape, dtype=bool)
        mask[levels.level[there]] = slices[levels.slice[there]]
        masks.append(mask)
    within, valid = masks
    return within, within & ~valid


def covered_shares(draft: Draft, n_y: int, n_x: int, *, finer: int) -> Floats:
    """Return the share of each square of a grid, so many times finer than studs, that trajectories enclose."""
    trajectories = draft.trajectories
    start, end = ((ends - draft.grid.origin[:2]) * finer for ends in (trajectories.points, trajectories.ends))
    pieces = cut_at_grid(start, end, np.zeros(2))
    slice_of = trajectories.loop_slice[trajectories.edge_loop[pieces.edge]].astype(np.int64)
    size = len(draft.cut.slices.heights), n_y * finer, n_x * finer
    return covered_area_shares(pieces, slice_of, *size) / CELL_AREA
