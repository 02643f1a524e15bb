"""How far the colours of bricks are from what the surface asks for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..colours import brick_differences, lab_from_linear
from ..model import Bricks, Catalogue, column_facts, stud_columns
from ..unit_bricks import WantedColours
from ..units import STUD

LEAST: Final = (STUD / 3) ** 2
"""Surface in mm^2 that a brick must show to be judged: what one ray stands for. Less is a sliver of its neighbours'."""


@dataclass(frozen=True, slots=True, eq=False)
class ColourErrors:
    """How different each brick looks from the surface on it.

    Attributes
    ----------
    error : (n,) float32 array
        CIEDE2000 from the mean of the texels on the brick's cells; NaN for a brick that shows none, or less
        than ``LEAST``.
    area : (n,) float32 array
        Surface on each brick in mm^2.
    """

    error: NDArray[np.float32]
    area: NDArray[np.float32]

    @property
    def mean(self) -> float:
        """Mean error, weighted by surface; NaN if no brick shows any."""
        judged = ~np.isnan(self.error)
        if not judged.any():
            return float("nan")
        return float(np.average(self.error[judged].astype(np.float64), weights=self.area[judged].astype(np.float64)))

    @property
    def worst(self) -> int:
        """Row of the brick with the greatest error, the first of equal ones; -1 if no brick shows any surface."""
        return -1 if np.isnan(self.error).all() else int(np.nanargmax(self.error))


def colour_errors(bricks: Bricks, catalogue: Catalogue, wanted: WantedColours) -> ColourErrors:
    """Compare the colours of bricks with the surface.

    Parameters
    ----------
    bricks : Bricks
        On the grid of the cells, supports among them or not.
    catalogue : Catalogue
    wanted : WantedColours
        The surface on the cells.

    Returns
    -------
    ColourErrors
    """
    area, light = _surface_on(bricks, catalogue, wanted)
    shown = area >= LEAST
    error = np.full(len(bricks), np.nan)
    mean = light[shown] / area[shown, None]
    error[shown] = brick_differences(lab_from_linear(np.clip(mean, 0, 1)), bricks.colour[shown], catalogue)
    return ColourErrors(error.astype(np.float32), area.astype(np.float32))


def _surface_on(bricks: Bricks, catalogue: Catalogue, wanted: WantedColours) -> tuple[Floats, Floats]:
    """Return the surface on each brick in mm^2, (n,), and its light times that, (n, 3)."""
    column, cell = _cells_of(bricks, catalogue, wanted)
    brick, weight = stud_columns(bricks, catalogue)[0][column], wanted.area[cell].astype(np.float64)
    area = np.bincount(brick, weight, len(bricks))
    light = [np.bincount(brick, weight * channel[cell], len(bricks)) for channel in wanted.light.T]
    return area, np.stack(light, axis=1)


def _cells_of(bricks: Bricks, catalogue: Catalogue, wanted: WantedColours) -> tuple[Ints, Ints]:
    """Return pairs of a stud column of bricks and a cell with surface that it fills, wholly or partly."""
    _, place = stud_columns(bricks, catalogue)
    facts = column_facts(bricks, catalogue)
    x, y, low = place.astype(np.int64).T
    high = low + (facts.high - facts.low)
    # the cells of a column of the grid stand one after the other
    level, row, line = wanted.cell.astype(np.int64).T
    base = np.array([level.max(initial=0) + 1, line.max(initial=0) + 1])
    key = (row * base[1] + line) * base[0] + level
    order = np.argsort(key)
    inside = (x >= 0) & (x < base[1]) & (y >= 0)
    at = (y * base[1] + x) * base[0]
    first = np.searchsorted(key[order], at + np.clip(low // wanted.plates, 0, base[0]))
    last = np.searchsorted(key[order], at + np.clip(-(-high // wanted.plates), 0, base[0]))
    count = np.where(inside, last - first, 0)
    column = np.repeat(np.arange(len(count)), count)
    nth = np.arange(len(column)) - np.repeat(np.cumsum(count) - count, count)
    return column, order[first[column] + nth]
