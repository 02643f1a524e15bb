"""What all lists of one model are written from: its lots, and how large and long a work it is."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import Final

import numpy as np

from ..model import Assembly, footprint
from ..units import PLATE, STUD
from .lots import Lot, count_lots, mass_of, totals

SECONDS_A_BRICK: Final = 350 * 3600 / 133_000
"""Of practised hands: LEGO's builders needed 350 hours for the 133,000 bricks of the great 2 x 4 brick that they built
in January 2018 for its 60th birthday, as the company said then."""

MM_PER_CM: Final = 10.0


@dataclass(frozen=True, slots=True)
class ShoppingList:
    """The lots of a model with its figures.

    Attributes
    ----------
    title : str
        Name of the model.
    lots : tuple of Lot
        What is to be bought.
    studs : tuple of two int
        Extent along x and y in studs.
    plates : int
        Height in plates.
    seconds : float
        How long practised hands need to build it.
    """

    title: str
    lots: tuple[Lot, ...]
    studs: tuple[int, int]
    plates: int
    seconds: float

    @property
    def count(self) -> int:
        """Number of bricks."""
        return totals(self.lots)[0]

    @property
    def mass(self) -> float:
        """Mass in grams."""
        return mass_of(self.lots)

    @property
    def cost(self) -> float | None:
        """Price of all lots whose price is known; None if no price is."""
        return totals(self.lots)[2]

    @property
    def unpriced(self) -> int:
        """Number of bricks whose price is not known."""
        return sum(lot.count for lot in self.lots if lot.price is None)

    @property
    def cm(self) -> tuple[float, float, float]:
        """Extent along x, y and z in cm, without the studs on top."""
        x, y = self.studs
        return x * STUD / MM_PER_CM, y * STUD / MM_PER_CM, self.plates * PLATE / MM_PER_CM


def shopping_list(assembly: Assembly, *, title: str = "", moves: int | None = None) -> ShoppingList:
    """Return the list of a model, without prices.

    Parameters
    ----------
    assembly : Assembly
        What is to be bought; it may be empty.
    title : str, optional
        Name of the model.
    moves : int, optional
        How often a brick is placed or taken out again while it is built; by
        default each brick is placed once.

    Returns
    -------
    ShoppingList

    Raises
    ------
    BuildError
        A brick has a colour that is not in the catalogue.
    """
    x, y, plates = extent(assembly)
    seconds = SECONDS_A_BRICK * (len(assembly) if moves is None else moves)
    return ShoppingList(title, count_lots(assembly), (x, y), plates, seconds)


def extent(assembly: Assembly) -> tuple[int, int, int]:
    """Return how many studs along x and y, and how many plates in height, bricks take up."""
    if not len(assembly):
        return 0, 0, 0
    bricks = assembly.bricks
    sides = np.array(
        [[footprint(part, turn).max(axis=0) + 1 for turn in range(2)] for part in assembly.catalogue.parts]
    )
    top = bricks.corner + np.column_stack([sides[bricks.part, bricks.turn % 2], assembly.height])
    x, y, plates = ((top + bricks.shift).max(axis=0) - (bricks.corner + bricks.shift).min(axis=0)).tolist()
    return ceil(x), ceil(y), int(plates)
