"""Which parts the layout prefers: the fewest, the cheapest, the lightest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from .arrays import Floats
from .errors import SettingsError
from .model import Bricks, Catalogue
from .settings import Settings
from .stock import Prices, read_prices

Lay = Callable[[Catalogue], Bricks]
"""Lays a model with what a catalogue says of parts and their costs."""


@dataclass(frozen=True, slots=True, eq=False)
class PartChoice:
    """What decides between parts besides their number.

    Attributes
    ----------
    catalogue : Catalogue
        What may be laid, and what the mass of parts costs in bricks.
    prices : Prices or None
        Of a price file.
    cheapest : bool
        Whether the layout shall cost little money.
    """

    catalogue: Catalogue
    prices: Prices | None = None
    cheapest: bool = False

    @classmethod
    def of(cls, settings: Settings, catalogue: Catalogue) -> Self:
        """Read the files that the settings name.

        Raises
        ------
        SettingsError
            One of them cannot be used, or one is missing.
        """
        if settings.goal == "cheapest" and not settings.prices:
            raise SettingsError(
                "goal is 'cheapest' but prices is empty: give a price file, or set the goal to 'fewest'."
            )
        prices = read_prices(settings.prices, catalogue) if settings.prices else None
        if prices is not None and settings.unpriced == "exclude":
            catalogue = replace(catalogue, exists=catalogue.exists & prices.stated)
        if settings.mass_weight:
            catalogue = replace(catalogue, cost=np.ones(catalogue.exists.shape) + _masses(catalogue, settings))
        return cls(catalogue, prices, settings.goal == "cheapest")

    def laid(self, lay: Lay) -> Bricks:
        """Lay a model.

        Parameters
        ----------
        lay : callable
            Lays it by a catalogue's costs.

        Returns
        -------
        Bricks
            Where money counts, the cheaper of two layouts: one of few bricks, and one in which a part costs as many
            bricks as its price is of the mean price in the first.
        """
        usual = lay(self.catalogue)
        if self.prices is None or not self.cheapest:
            return usual
        mean = float(self.prices.each(usual, self.catalogue).mean())
        if not mean:
            return usual
        extra = 0.0 if self.catalogue.cost is None else self.catalogue.cost - 1
        thrifty = lay(replace(self.catalogue, cost=self.prices.price / mean + extra))
        return min(usual, thrifty, key=self._price)

    def _price(self, bricks: Bricks) -> float:
        """Return what some bricks cost."""
        return 0.0 if self.prices is None else float(self.prices.each(bricks, self.catalogue).sum())


def _masses(catalogue: Catalogue, settings: Settings) -> Floats:
    """Return what the mass of each part costs, (n_parts, 1), in bricks."""
    return settings.mass_weight * catalogue.mass[:, None]
