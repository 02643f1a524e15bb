"""The bricks of one part in one colour: what is counted, weighed, priced and bought."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..model import Assembly, Colour, Part


@dataclass(frozen=True, slots=True)
class Lot:
    """Bricks of one part in one colour.

    Every list is written from lots. Who knows prices puts them in with
    :func:`priced`, before the list is made; all lists and the panel then show
    them, and leave the cells empty where the price is None.

    Attributes
    ----------
    part : Part
    colour : Colour
    count : int
        Bricks, at least one.
    made : bool
        Whether the part was ever made in the colour.
    element : int
        LEGO's newest element number, 0 if none is known.
    second_element : int
        The newest one before that, 0 if there was only one.
    price : float or None
        Of one brick, in the currency of whoever gave it; None if it is not known.
    """

    part: Part
    colour: Colour
    count: int
    made: bool = True
    element: int = 0
    second_element: int = 0
    price: float | None = None

    @property
    def mass(self) -> float:
        """Mass of all bricks in grams."""
        return self.part.mass * self.count

    @property
    def cost(self) -> float | None:
        """Price of all bricks; None if it is not known."""
        return None if self.price is None else self.price * self.count


def count_lots(assembly: Assembly) -> tuple[Lot, ...]:
    """Count the bricks of each part in each colour.

    Parameters
    ----------
    assembly : Assembly
        What is to be bought.

    Returns
    -------
    tuple of Lot
        By the order of the catalogue's parts, then of its colours; without prices.

    Raises
    ------
    BuildError
        A brick has a colour that is not in the catalogue.
    """
    catalogue = assembly.catalogue
    codes, column = np.unique(assembly.bricks.colour, return_inverse=True)
    colours = np.array([catalogue.colour_row(int(code)) for code in codes], np.int64)
    pairs = assembly.bricks.part.astype(np.int64) * len(catalogue.colours) + colours[column.reshape(-1)]
    pair, count = np.unique(pairs, return_counts=True)
    rows = np.column_stack([*np.divmod(pair, len(catalogue.colours)), count]).tolist()
    return tuple(
        Lot(
            catalogue.parts[part],
            catalogue.colours[colour],
            number,
            made=bool(catalogue.exists[part, colour]),
            element=int(catalogue.element[part, colour]),
            second_element=int(catalogue.second_element[part, colour]),
        )
        for part, colour, number in rows
    )


def priced(lots: Iterable[Lot], price: Callable[[Part, Colour], float | None]) -> tuple[Lot, ...]:
    """Return lots with the price of one brick each, None where a function knows none."""
    return tuple(replace(lot, price=price(lot.part, lot.colour)) for lot in lots)


def totals(lots: Sequence[Lot]) -> tuple[int, float, float | None]:
    """Return bricks, grams, and the price of all lots whose price is known; None if no price is."""
    costs = [lot.cost for lot in lots if lot.cost is not None]
    return sum(lot.count for lot in lots), mass_of(lots), sum(costs) if costs else None


def mass_of(lots: Iterable[Lot]) -> float:
    """Return the mass of all bricks in grams."""
    return sum(lot.mass for lot in lots)


def not_made(lots: Iterable[Lot]) -> tuple[Lot, ...]:
    """Return the lots of which the part was never made in the colour."""
    return tuple(lot for lot in lots if not lot.made)
