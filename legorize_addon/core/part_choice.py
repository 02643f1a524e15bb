"""Which parts the layout prefers: the fewest, the cheapest, the lightest, those that are owned."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final, Self

import numpy as np

from .arrays import Floats, Ints, Mask
from .errors import PartsError, SettingsError
from .model import Assembly, Bricks, Catalogue
from .owned import assign, exchange_small, lay_owned, merge_lots, repair_parts, usable, visible_cells
from .setting import SEPARATOR
from .settings import Settings
from .stock import Owned, Prices, read_owned, read_prices
from .supports import KINDS, AssemblyPlan, Wish

_NAMED: Final = 5
"""Parts that an error names."""

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
    owned : Owned or None
        What the user has.
    only : bool
        Whether nothing can be bought.
    few_lots : float
        Largest colour difference at which small lots are merged.
    """

    catalogue: Catalogue
    prices: Prices | None = None
    cheapest: bool = False
    owned: Owned | None = None
    only: bool = False
    few_lots: float = 0.0

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
        paths = [path.strip() for path in settings.owned.split(SEPARATOR) if path.strip()]
        owned = read_owned(paths, catalogue) if paths else None
        only = owned is not None and settings.owned_use == "only"
        return cls(catalogue, prices, settings.goal == "cheapest", owned, only, settings.few_lots)

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
        if self.owned is not None:
            return lay_owned(lay, self.catalogue, self.owned.count, only=self.only)
        usual = lay(self.catalogue)
        if self.prices is None or not self.cheapest:
            return usual
        mean = float(self.prices.each(usual, self.catalogue).mean())
        if not mean:
            return usual
        extra = 0.0 if self.catalogue.cost is None else self.catalogue.cost - 1
        thrifty = lay(replace(self.catalogue, cost=self.prices.price / mean + extra))
        return min(usual, thrifty, key=self._price)

    def burden(self, bricks: Bricks) -> float:
        """Return what a layout is compared with others by: its price, its bricks and what their mass costs, or both."""
        if self.cheapest:
            return self._price(bricks)
        cost = self.catalogue.cost
        if cost is None:
            return float(len(bricks))
        return float(cost[bricks.part, self.catalogue.colour_rows(bricks.colour)].sum())

    def told(self, bricks: Bricks) -> str:
        """Say how many bricks there are, and what counts besides: what they cost, or weigh."""
        count = "1 brick" if len(bricks) == 1 else f"{len(bricks)} bricks"
        if self.cheapest and self.prices is not None:
            return f"{count} for {self.prices.money(self._price(bricks))}"
        if self.catalogue.cost is not None:
            return f"{count} of {self.catalogue.mass[bricks.part].sum():.1f} g"
        return count

    @property
    def minds_lots(self) -> bool:
        """Whether it matters to the layout which parts it takes, and not only how many."""
        return self.cheapest or self.owned is not None or self.catalogue.cost is not None

    @property
    def files(self) -> dict[str, Any]:
        """What was read of files, as a build keeps it."""
        return {"prices": self.prices, "owned": self.owned}

    @property
    def joining(self) -> Catalogue:
        """What bricks that join others may be: of parts that are owned, if nothing can be bought."""
        if self.owned is None or not self.only:
            return self.catalogue
        there = usable(self.catalogue, self.owned.count)
        return replace(self.catalogue, exists=self.catalogue.exists & there[:, None], cost=None)

    @property
    def at_most(self) -> Ints | None:
        """How many of each part there are, (n_parts,), if nothing can be bought."""
        return self.owned.count.sum(axis=1) if self.owned is not None and self.only else None

    def check_volume(self, n_cells: int) -> None:
        """Refuse a model that is larger than all owned parts together, before the work begins.

        Parameters
        ----------
        n_cells : int
            Cells that have to be covered, a plate high.

        Raises
        ------
        PartsError
        """
        if self.owned is None or not self.only:
            return
        studs = np.array([part.length * part.width - part.corner for part in self.catalogue.parts])
        there = int((self.owned.count.sum(axis=1) * studs * self.catalogue.height).sum())
        if there < n_cells:
            raise PartsError(
                f"The owned parts do not suffice: the model fills {n_cells} studs of a plate's height, and all owned "
                f"bricks and plates together {there}: choose a smaller size, add an inventory, or set owned_use to "
                "'first'."
            )

    def settled(self, assembly: Assembly) -> Assembly:
        """Lay anew what goes beyond the owned parts, if nothing can be bought; the same object if nothing does.

        Raises
        ------
        PartsError
            The owned parts do not suffice.
        """
        if self.owned is None or not self.only:
            return assembly
        assembly = repair_parts(assembly, self.owned.count.sum(axis=1))
        found = assign(assembly, visible_cells(assembly.graph), self.owned.count, keep=False)
        if found.missing.any():
            raise PartsError(too_few(assembly, found.missing, self.owned, "model"))
        return assembly

    def supplied(self, plan: Callable[[Catalogue | None, Wish], AssemblyPlan], wish: Wish) -> AssemblyPlan:
        """Plan supports, and take all bricks from owned lots.

        Parameters
        ----------
        plan : callable
            Plans the building with supports of a kind, and of a catalogue's parts unless it gets None.
        wish : str
            Kind that was asked for.

        Returns
        -------
        AssemblyPlan
            Bricks have the colours of their lots. Supports come from what the model leaves; where nothing can be
            bought and those of the best kind need more, other kinds are tried.

        Raises
        ------
        PartsError
            The owned parts do not suffice for any of them.
        """
        if self.owned is None:
            return self._with_few_lots(plan(None, wish))
        for kind in dict.fromkeys((wish, *KINDS)) if wish == "best" else (wish,):
            made = plan(self._supporting, kind)
            found = assign(made.assembly, self._seen(made), self.owned.count, keep=not self.only)
            if not (self.only and found.missing.any()):
                bricks = replace(made.bricks, colour=found.colour.astype(np.int16))
                return replace(made, assembly=Assembly(bricks, made.assembly.catalogue))
        raise PartsError(too_few(made.assembly, found.missing, self.owned, "model with its supports"))

    def exchanged(self, assembly: Assembly) -> tuple[Assembly, str]:
        """Lay other parts in place of the bricks of small lots, if fewer lots are asked for, and say how many.

        The same object, and nothing to say, if nothing is exchanged.
        """
        if not self.few_lots or self.owned is not None:
            return assembly, ""
        found, n_split, n_joined = exchange_small(assembly, self.few_lots)
        what = [
            f"{count} {one if count == 1 else more}"
            for count, one, more in (
                (n_split, "brick was split", "bricks were split"),
                (n_joined, "pair of bricks was joined", "pairs of bricks were joined"),
            )
            if count
        ]
        return found, f"For fewer lots {' and '.join(what)} into parts that the model has anyway."

    def _with_few_lots(self, plan: AssemblyPlan) -> AssemblyPlan:
        """Merge small lots of the model; those of temporary supports are bought apart."""
        if not self.few_lots:
            return plan
        colour = plan.bricks.colour.copy()
        colour[~plan.temporary] = merge_lots(plan.final, visible_cells(plan.final.graph), self.few_lots)
        return replace(plan, assembly=Assembly(replace(plan.bricks, colour=colour), plan.assembly.catalogue))

    @property
    def _supporting(self) -> Catalogue | None:
        """What supports may be: parts that are owned, and the 1 x 1 that fits where nothing else does."""
        if self.owned is None or not self.only:
            return None
        there = usable(self.catalogue, self.owned.count)
        # in any colour, since they are taken out again
        return replace(self.catalogue, exists=np.repeat(there[:, None], len(self.catalogue.colours), axis=1), cost=None)

    @staticmethod
    def _seen(plan: AssemblyPlan) -> Ints:
        """Count the cells of each brick that can be seen in the end: none of what is taken out."""
        seen = np.zeros(len(plan.bricks), dtype=np.int64)
        seen[~plan.temporary] = visible_cells(plan.final.graph)
        return seen

    def _price(self, bricks: Bricks) -> float:
        """Return what some bricks cost."""
        return 0.0 if self.prices is None else float(self.prices.each(bricks, self.catalogue).sum())


def _masses(catalogue: Catalogue, settings: Settings) -> Floats:
    """Return what the mass of each part costs, (n_parts, 1), in bricks."""
    return settings.mass_weight * catalogue.mass[:, None]


def too_few(assembly: Assembly, missing: Mask, owned: Owned, what: str) -> str:
    """Say which parts are missing, and how many."""
    part, count = np.unique(assembly.bricks.part[missing], return_counts=True)
    order = np.argsort(-count, kind="stable")
    titles = [f"{count[row]} {assembly.catalogue.parts[part[row]].title}" for row in order[:_NAMED]]
    more = "" if len(order) <= _NAMED else f" and {count[order[_NAMED:]].sum()} others"
    return (
        f"The owned parts do not suffice: of the {len(assembly)} bricks of the {what} {int(missing.sum())} are missing "
        f"({', '.join(titles)}{more}), although {int(owned.count.sum())} are owned: choose a smaller size, add an "
        "inventory, or set owned_use to 'first'."
    )
